/* SPDX-License-Identifier: MIT */
/*
 * Eliminating a column from a row: nothing overflows, entries stay within 2^30, and the shift that is kept is 1 to 32.
 *
 * bound: 3 x 3 systems, entries up to 2^30, pivots of 2^6 to 2^30 of both signs; a row that has been the pivot and one that has not
 * unwind: 32
 * mutant: src/num/gauss.c: up = 31 - z; -> up = 33 - z;
 */
#include "proof.h"
#include "num/gauss.c"

static void check(struct gauss *g, int own)
{
    g->step[0] = (int8_t)own;
    g->pivot[1] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
    proof_assume(fix_abs32(g->pivot[1]) >= SMALLEST_PIVOT);
    g->row[1] = 1;
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 3; j++) {
            g->a[i][j] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        }
    }
    eliminate(g, 3, 1, 0);
    proof_check(g->shift[0][1] >= 1 && g->shift[0][1] <= 32);
    for (int j = 0; j < 3; j++) {
        proof_check(g->a[0][j] >= -CAROM_ONE_Q30 && g->a[0][j] <= CAROM_ONE_Q30);
    }
}

void proof(void)
{
    struct gauss g;

    check(&g, -1);
    check(&g, 0);
}
