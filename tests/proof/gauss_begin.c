/* SPDX-License-Identifier: MIT */
/*
 * The first part of a solution: it goes on as long as no part refuses, with no solution yet, and says if there is a residual.
 *
 * bound: 15 rows, entries up to 2^30; gauss_rows proves rows made normal, gauss_factor the elimination, every_inverse the diagonal
 * unwind: 250
 * contract: normalise_rows by any_normal_rows
 * contract: factor by any_factors
 * contract: invert_diagonal by any_inverses
 * mutant: src/num/gauss.c: normalise_rows(g, n) || factor(g, n) || invert_diagonal(g, n) -> normalise_rows(g, n) || invert_diagonal(g, n) || factor(g, n)
 * mutant: src/num/gauss.c: g->round = g->first = g->last = 0; -> g->round = g->first = 0;
 */
#include "proof.h"
#include "num/gauss.c"

static int parts;

static void check_entries(struct gauss *g, int n, int former)
{
    proof_check(n == GAUSS_MAX && parts == former);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            proof_check(g->a[i][j] >= -FULL && g->a[i][j] <= FULL);
        }
    }
    parts++;
}

static void any_entries(struct gauss *g)
{
    for (int i = 0; i < GAUSS_MAX; i++) {
        for (int j = 0; j < GAUSS_MAX; j++) {
            g->a[i][j] = (int32_t)proof_range(-FULL, FULL);
        }
    }
}

/* Each part is done, or refuses. */
int any_normal_rows(struct gauss *g, int n)
{
    check_entries(g, n, 0);
    any_entries(g);
    for (int i = 0; i < n; i++) {
        g->up[i] = (uint8_t)proof_range(0, 29);
        g->residual[i] = proof_range(-((int64_t)1 << 59), (int64_t)1 << 59);
    }
    return (int)proof_range(-1, 0);
}

int any_factors(struct gauss *g, int n)
{
    check_entries(g, n, 1);
    any_entries(g);
    for (int i = 0; i < n; i++) {
        g->row[i] = (uint8_t)proof_range(0, n - 1);
    }
    return (int)proof_range(-1, 0);
}

int any_inverses(struct gauss *g, int n)
{
    check_entries(g, n, 2);
    for (int k = 0; k < n; k++) {
        proof_check(g->row[k] < n);
        g->inverse_shift[k] = (uint8_t)proof_range(0, 29);
    }
    return (int)proof_range(-1, 0);
}

void proof(void)
{
    struct gauss g;
    bool any = false;
    int more;

    parts = 0;
    any_entries(&g);
    for (int i = 0; i < GAUSS_MAX; i++) {
        g.a[i][GAUSS_MAX] = (int32_t)proof_range(-FULL, FULL);
    }
    g.last = (int)proof_range(0, 1);
    more = gauss_begin(&g, GAUSS_MAX);
    proof_check(more >= -1 && more <= 1 && (more < 0 || parts == 3));
    for (int i = 0; i < GAUSS_MAX && more >= 0; i++) {
        any = any || g.residual[i] < -1 || g.residual[i] > 0;
        proof_check(g.x_q40[i] == 0);
    }
    proof_check(more < 0 || (more == any && g.round == 0 && g.first == 0 && g.last == 0));
}
