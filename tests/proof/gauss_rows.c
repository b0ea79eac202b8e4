/* SPDX-License-Identifier: MIT */
/*
 * Normalising: each row is shifted up until its largest entry has 30 or 31 bits, its right-hand side with it; a row of zeros is refused.
 *
 * bound: 2 x 2 systems with all entries up to 2^30; rows are treated one by one
 * unwind: 32
 * mutant: src/num/gauss.c: #define NORMAL         ((int32_t)1 << 29) -> #define NORMAL         ((int32_t)1 << 30)
 */
#include "proof.h"
#include "num/gauss.c"

void proof(void)
{
    struct gauss g;
    int32_t in[2][3];

    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 3; j++) {
            in[i][j] = g.a[i][j] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        }
    }
    if (normalise_rows(&g, 2) < 0) {
        proof_check((in[0][0] == 0 && in[0][1] == 0) || (in[1][0] == 0 && in[1][1] == 0));
        return;
    }
    for (int i = 0; i < 2; i++) {
        proof_check(g.up[i] <= 29 && g.residual[i] == in[i][2] * ((int64_t)1 << g.up[i]));
        for (int j = 0; j < 2; j++) {
            proof_check(g.a[i][j] == in[i][j] * ((int64_t)1 << g.up[i]) &&
                        fix_abs32(g.a[i][j]) <= CAROM_ONE_Q30);
        }
        proof_check((fix_abs32(g.a[i][0]) | fix_abs32(g.a[i][1])) >= 1 << 29);
    }
}
