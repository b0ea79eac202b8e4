/* SPDX-License-Identifier: MIT */
/*
 * A step of elimination: entries of 2^30 times factors up to 2^31 do not overflow, and the new entry is at most 2^30 again.
 *
 * bound: all entries up to 2^30, all factors of 32 bits, a row of 15
 * mutant: src/num/gauss.c: row[j] = (int32_t)(t >> 32) -> row[j] = (int32_t)(t >> 31)
 */
#include "proof.h"
#include "num/gauss.c"

void proof(void)
{
    int32_t row[15], other[15], scale = (int32_t)proof_range(INT32_MIN, INT32_MAX);
    int32_t factor = (int32_t)proof_range(INT32_MIN, INT32_MAX);
    uint32_t used;

    for (int j = 0; j < 15; j++) {
        row[j] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        other[j] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
    }
    used = combine(row, other, scale, factor, 0, 15);
    for (int j = 0; j < 15; j++) {
        proof_check(row[j] >= -CAROM_ONE_Q30 && row[j] <= CAROM_ONE_Q30);
    }
    proof_check(used <= INT32_MAX);
}
