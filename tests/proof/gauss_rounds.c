/* SPDX-License-Identifier: MIT */
/*
 * A round of refinement: the residual that is solved for has 1 to 61 bits, the solution grows by 2^60 at most, and there are five rounds.
 *
 * bound: 15 rows, all residuals, every state that a round leaves; gauss_correction proves the correction, gauss_divide its digits
 * contract: correction by any_correction
 * mutant: src/num/gauss.c: bits > RESIDUAL_BITS || g->round -> bits > RESIDUAL_BITS + 2 || g->round
 * mutant: src/num/gauss.c: h < DIGITS_BITS - 20 || h -> h < DIGITS_BITS - 24 || h
 * mutant: src/num/gauss.c: g->round == ROUNDS_MAX -> g->round > ROUNDS_MAX
 */
#include "proof.h"
#include "num/gauss.c"

int any_correction(struct gauss *g, int n, int bits, int q)
{
    int h = (int)proof_range(-498, 117 * ROUNDS_MAX);

    proof_check(n == GAUSS_MAX && q == g->last && bits >= 1 && bits <= 61);
    for (int i = 0; i < n; i++) {
        proof_check(g->residual[i] >= -((int64_t)1 << bits) && g->residual[i] < (int64_t)1 << bits);
        g->a[i][GAUSS_MAX] = (int32_t)proof_range(-(1 << 29), 1 << 29);
    }
    proof_assume(h >= q - 498 && h <= q + 117);
    return h;
}

void proof(void)
{
    const int64_t step = (int64_t)1 << 60;
    struct gauss g;
    int more;

    g.round = (int)proof_range(0, ROUNDS_MAX);
    g.first = (int)proof_range(0, 117);
    g.last = (int)proof_range(0, 117 * ROUNDS_MAX);
    proof_assume(g.last <= 117 * g.round);
    for (int i = 0; i < GAUSS_MAX; i++) {
        g.residual[i] = proof_word();
        g.x_q40[i] = proof_range(-ROUNDS_MAX * step, ROUNDS_MAX * step);
        proof_assume(carom_abs(g.x_q40[i]) <= g.round * step);
    }
    more = gauss_correct(&g, GAUSS_MAX);
    proof_check(more >= -1 && more <= 1 && g.round <= ROUNDS_MAX);
    for (int i = 0; i < GAUSS_MAX; i++) {
        proof_check(carom_abs(g.x_q40[i]) <= g.round * step);
    }
    proof_check(more < 1 || (g.last >= 9 && g.last <= 117 * g.round && g.first <= 117));
}
