/* SPDX-License-Identifier: MIT */
/*
 * A whole solution: a round comes after one that goes on, and after each row's part was taken out; after five it ends, within 5 2^60.
 *
 * bound: 15 rows; gauss_begin proves the beginning, gauss_rounds a round, gauss_residual that a correction is taken out
 * unwind: 120
 * contract: gauss_begin by any_beginning
 * contract: gauss_correct by any_round
 * contract: gauss_take_out by any_residual
 * mutant: src/num/gauss.c: i < n && more > 0; i++ -> i + 1 < n && more > 0; i++
 * mutant: src/num/gauss.c: while (more > 0) -> while (more >= 0)
 */
#include "proof.h"
#include "num/gauss.c"

static int32_t rows[GAUSS_MAX][GAUSS_MAX + 1];
static int said,
    taken; /* what the last part returned; rows whose residual knows of the last correction */

static void any_solution(struct gauss *g)
{
    const int64_t step = (int64_t)1 << 60;

    for (int i = 0; i < GAUSS_MAX; i++) {
        g->x_q40[i] = proof_range(-ROUNDS_MAX * step, ROUNDS_MAX * step);
        proof_assume(carom_abs(g->x_q40[i]) <= g->round * step);
    }
    said = (int)proof_range(-1, 1);
}

int any_beginning(struct gauss *g, int n)
{
    proof_check(n == GAUSS_MAX);
    g->round = g->first = g->last = 0;
    any_solution(g);
    taken = n;
    return said;
}

int any_round(struct gauss *g, int n)
{
    proof_check(n == GAUSS_MAX && g->round >= 0 && g->round <= ROUNDS_MAX);
    proof_check(said == 1 && taken == n && g->last >= 0 && g->last <= 117 * g->round);
    for (int i = 0; i < n; i++) {
        proof_check(carom_abs(g->x_q40[i]) <= g->round * ((int64_t)1 << 60));
    }
    if (g->round == ROUNDS_MAX) {
        said = -1;
        return -1;
    }
    g->round++;
    g->last = (int)proof_range(0, 117 * ROUNDS_MAX);
    proof_assume(g->last <= 117 * g->round);
    any_solution(g);
    taken = 0;
    return said;
}

void any_residual(struct gauss *g, int n, int i, const int32_t *row)
{
    (void)g;
    proof_check(n == GAUSS_MAX && i == taken && row == rows[i]);
    taken++;
}

void proof(void)
{
    struct gauss g;
    int failed = gauss_solve(&g, GAUSS_MAX, (const int32_t(*)[GAUSS_MAX + 1]) rows);

    proof_check(failed == said && failed <= 0 && g.round <= ROUNDS_MAX);
    for (int i = 0; i < GAUSS_MAX; i++) {
        proof_check(carom_abs(g.x_q40[i]) <= ROUNDS_MAX * ((int64_t)1 << 60));
    }
}
