/* SPDX-License-Identifier: MIT */
/*
 * Sums, differences and signs of 128 bits wrap as those of a processor with 128 bits.
 *
 * bound: all numbers
 * mutant: src/num/fix.c: uint64_t borrow = sum->lo < v->lo -> uint64_t borrow = sum->lo <= v->lo
 */
#include "proof.h"
#include "num/fix.c"

static unsigned __int128 whole(const struct fix_wide *a)
{
    return (unsigned __int128)(uint64_t)a->hi << 64 | a->lo;
}

void proof(void)
{
    struct fix_wide a = {proof_word(), (uint64_t)proof_word()},
                    b = {proof_word(), (uint64_t)proof_word()};
    struct fix_wide sum = a, difference = a;

    fix_wide_add(&sum, &b);
    fix_wide_subtract(&difference, &b);
    proof_check(whole(&sum) == whole(&a) + whole(&b));
    proof_check(whole(&difference) == whole(&a) - whole(&b));
    proof_check(fix_wide_sign(&a) == ((wide)whole(&a) > 0) - ((wide)whole(&a) < 0));
}
