/* SPDX-License-Identifier: MIT */
/*
 * Shifts of 128 bits, up modulo 2^128 and down to the floor.
 *
 * bound: all numbers, every shift that fix.h allows, a case each
 * cases: 0..127
 * mutant: src/num/fix.c: (int64_t)(sum->lo >> (64 - s)) -> (int64_t)(sum->lo >> (63 - s))
 * mutant: src/num/fix.c: | (a->lo >> s)) -> | (a->lo >> (s - 1)))
 */
#include "proof.h"
#include "num/fix.c"

static wide whole(const struct fix_wide *a)
{
    return (wide)((unsigned __int128)(uint64_t)a->hi << 64 | a->lo);
}

void proof(void)
{
    struct fix_wide a = {proof_word(), (uint64_t)proof_word()}, up = a;

    proof_check(fix_wide_shift(&a, CASE) == (int64_t)(whole(&a) >> CASE));
    if (CASE < 64) {
        struct fix_wide floor = fix_wide_down(&a, CASE);

        fix_wide_shift_up(&up, CASE);
        proof_check((unsigned __int128)whole(&up) == (unsigned __int128)whole(&a) << CASE);
        proof_check(whole(&floor) == whole(&a) >> CASE);
    }
}
