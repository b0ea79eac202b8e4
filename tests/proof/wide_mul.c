/* SPDX-License-Identifier: MIT */
/*
 * The product of two numbers of 64 bits, exact: a b = a1 b1 2^64 + (a1 b0 + b1 a0) 2^32 + a0 b0, by the distributive law.
 *
 * bound: all a and b
 * mutant: src/num/fix.c: (mid >> 32) + (mid2 >> 32) -> (mid2 >> 32)
 */
#include "proof.h"
#include "num/fix.c"

void proof(void)
{
    int64_t a = proof_word(), b = proof_word();
    int32_t a1 = (int32_t)(a >> 32), b1 = (int32_t)(b >> 32);
    uint32_t a0 = (uint32_t)a, b0 = (uint32_t)b;
    wide cross = (wide)a1 * b0 + (wide)b1 * a0;
    unsigned __int128 product =
        ((unsigned __int128)((wide)a1 * b1) << 64) + ((unsigned __int128)cross << 32);
    struct fix_wide found = fix_wide_mul(a, b);

    product += (uint64_t)a0 * b0;
    proof_check(found.lo == (uint64_t)product && found.hi == (int64_t)(product >> 64));
}
