/* SPDX-License-Identifier: MIT */
/*
 * The pivot is an unused row whose entry is not noise; none is larger by more than one.
 *
 * bound: three rows of which any are used, entries up to 2^30
 * mutant: src/num/gauss.c: g->step[i] < 0 && entry > largest -> entry > largest
 */
#include "proof.h"
#include "num/gauss.c"

void proof(void)
{
    struct gauss g;
    int best;

    for (int i = 0; i < 3; i++) {
        g.a[i][1] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        g.step[i] = (int8_t)proof_range(-1, 0);
    }
    best = choose_pivot(&g, 3, 1);
    proof_check(best >= -1 && best < 3);
    proof_check(best < 0 || (g.step[best] < 0 && fix_abs32(g.a[best][1]) >= SMALLEST_PIVOT));
    for (int i = 0; i < 3; i++) {
        proof_check(g.step[i] >= 0 ||
                    fix_abs32(g.a[i][1]) <=
                        (best < 0 ? SMALLEST_PIVOT : fix_abs32(g.a[best][1]) + 1));
    }
}
