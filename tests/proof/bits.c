/* SPDX-License-Identifier: MIT */
/*
 * Numbers of bits: v has n of them if 2^(n - 1) <= v < 2^n, 0 has none.
 *
 * bound: all numbers of 32, 64 and 128 bits; of vectors, components above INT64_MIN
 * mutant: src/num/fix.h: return high ? 32 + fix_bits32(high) -> return high ? 31 + fix_bits32(high)
 * mutant: src/num/fix.c: size.hi ? 64 + fix_bits -> size.hi ? 63 + fix_bits
 */
#include "proof.h"
#include "num/fix.c"

static bool has(unsigned __int128 v, int bits)
{
    return bits >= 0 && bits <= 128 && (bits == 128 || v >> bits == 0) &&
           (bits == 0 ? v == 0 : v >> (bits - 1) == 1);
}

void proof(void)
{
    uint64_t v = (uint64_t)proof_word();
    struct fix_wide a = {proof_word(), (uint64_t)proof_word()};
    unsigned __int128 whole = (unsigned __int128)(uint64_t)a.hi << 64 | a.lo;

    proof_check(has((uint32_t)v, fix_bits32((uint32_t)v)) && has(v, fix_bits(v)));
    proof_check(has(a.hi < 0 ? 0 - whole : whole, fix_wide_bits(&a)));
}
