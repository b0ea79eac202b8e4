/* SPDX-License-Identifier: MIT */
/*
 * The part of a vector along a direction is the sum of three products in q30, each to nearest.
 *
 * bound: |v| < 2^61 by component, directions up to 1 by component
 * mutant: src/num/fix.h: fix_mul_q30(v[1], d_q30[1]) -> fix_mul_q30(v[1], d_q30[2])
 */
#include "proof.h"

void proof(void)
{
    int64_t v[3];
    int32_t d[3];
    wide sum = 0;

    for (int k = 0; k < 3; k++) {
        v[k] = proof_range(-(1LL << 61), 1LL << 61);
        d[k] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        sum += ((wide)(v[k] >> 32) * d[k] * ((wide)1 << 32) + (wide)(uint32_t)v[k] * d[k] +
                (1 << 29)) >>
               30;
    }
    proof_assume(sum <= INT64_MAX && sum >= INT64_MIN);
    proof_check(fix_dot_q30(v, d) == sum);
}
