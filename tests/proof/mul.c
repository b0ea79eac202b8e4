/* SPDX-License-Identifier: MIT */
/*
 * A product of 64 and 32 bits over 2^s is to nearest wherever it fits. a b = (a >> 32) b 2^32 + (a mod 2^32) b by the
 * distributive law. A case is an s.
 *
 * bound: all a, b > INT32_MIN, 1 <= s <= 62, all of what fix.h allows
 * cases: 1..62
 * mutant: src/num/fix.h: carom_round(high + (low >> 32), s - 32) -> carom_round(high + (low >> 31), s - 32)
 * mutant: src/num/fix.h: (uint64_t)carom_round(low, s)) -> (uint64_t)(low >> s))
 */
#include "proof.h"

void proof(void)
{
    int64_t a = proof_word();
    int32_t b = (int32_t)proof_range(-INT32_MAX, INT32_MAX);
    wide product = (wide)(a >> 32) * b * ((wide)1 << 32) + (wide)(uint32_t)a * b;
    wide expected = (product + ((wide)1 << (CASE - 1))) >> CASE;

    proof_assume(expected >= INT64_MIN && expected <= INT64_MAX);
    proof_check(fix_mul(a, b, CASE) == expected);
}
