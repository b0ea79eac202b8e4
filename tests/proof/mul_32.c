/* SPDX-License-Identifier: MIT */
/*
 * A product in q30 is to nearest: |2^30 found - a b| is at most 2^29.
 *
 * bound: a > INT32_MIN, |b| up to 1
 * mutant: include/carom_fix.h: carom_round((int64_t)a * b, 30) -> carom_round((int64_t)a * b, 29)
 */
#include "proof.h"

void proof(void)
{
    int32_t a = (int32_t)proof_range(-INT32_MAX, INT32_MAX),
            b = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
    wide apart = (wide)carom_mul_q30(a, b) * ((wide)1 << 30) - (wide)a * b;

    proof_check(apart > -(1 << 29) && apart <= 1 << 29);
}
