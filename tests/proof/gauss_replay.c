/* SPDX-License-Identifier: MIT */
/*
 * A right-hand side on its way through the steps: nothing overflows, and it ends within 2^30.
 *
 * bound: 2 x 2 systems; entries and pivots up to 2^30, shifts of 1 to 32, right-hand sides up to 2^30
 * mutant: src/num/gauss.c: int s = fix_bits(used) - 30; -> int s = fix_bits(used) - 31;
 */
#include "proof.h"
#include "num/gauss.c"

void proof(void)
{
    struct gauss g;

    for (int i = 0; i < 2; i++) {
        g.row[i] = (uint8_t)i;
        g.pivot[i] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        g.y[i] = proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        for (int j = 0; j < 2; j++) {
            g.a[i][j] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
            g.shift[i][j] = (uint8_t)proof_range(1, 32);
        }
    }
    proof_check(replay(&g, 2) >= 0);
    for (int i = 0; i < 2; i++) {
        proof_check(carom_abs(g.y[i]) <= CAROM_ONE_Q30);
    }
}
