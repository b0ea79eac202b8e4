/* SPDX-License-Identifier: MIT */
/*
 * A number in two parts over 2^s is to nearest, wherever the result fits.
 *
 * bound: |high|, |low| < 2^62, 30 bits between the parts, s of -2 to 40, a case each
 * cases: -2..40
 * mutant: src/num/fix.c: carom_shl(high, bits - s) + (uint64_t)carom_round(low, s) -> carom_shl(high, bits - s) + (uint64_t)(low >> s)
 */
#include "proof.h"
#include "num/fix.c"

void proof(void)
{
    int64_t high = proof_range(-(1LL << 62) + 1, (1LL << 62) - 1),
            low = proof_range(-(1LL << 61) + 1, (1LL << 61) - 1);
    wide sum = high * ((wide)1 << 30) + low;
    wide expected = CASE < 1
                        ? sum * ((wide)1 << (CASE < 0 ? -CASE : 0))
                        : (sum + ((wide)1 << (CASE > 0 ? CASE - 1 : 0))) >> (CASE > 0 ? CASE : 0);

    proof_assume(expected >= INT64_MIN && expected <= INT64_MAX);
    proof_check(fix_round_parts(high, low, 30, CASE) == expected);
}
