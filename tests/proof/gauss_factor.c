/* SPDX-License-Identifier: MIT */
/*
 * Elimination: each row is the pivot of one step, entries stay within 2^30, and each multiplier has a shift of 1 to 32.
 *
 * bound: 3 x 3 systems, entries up to 2^30; gauss_pivot proves the choice of a pivot, gauss_eliminate a row of a step
 * contract: choose_pivot by any_pivot
 * contract: eliminate by any_row
 * mutant: src/num/gauss.c: g->step[p] = (int8_t)k; -> g->step[k] = (int8_t)p;
 * mutant: src/num/gauss.c: i != p && g->a[i][k] != 0 -> g->a[i][k] != 0
 */
#include "proof.h"
#include "num/gauss.c"

enum { N = 3 };

static bool within_full(const int32_t *row)
{
    for (int j = 0; j < N; j++) {
        if (row[j] < -FULL || row[j] > FULL) {
            return false;
        }
    }
    return true;
}

int any_pivot(const struct gauss *g, int n, int k)
{
    int p = (int)proof_range(-1, N - 1);

    proof_check(n == N && k >= 0 && k < n);
    if (p >= 0) {
        proof_assume(g->step[p] < 0 && fix_abs32(g->a[p][k]) >= SMALLEST_PIVOT);
    }
    return p;
}

void any_row(struct gauss *g, int n, int k, int i)
{
    const int own = g->step[i], p = g->row[k];

    proof_check(n == N && i != p && own >= -1 && own < k && own != k);
    proof_check(g->pivot[k] == g->a[p][k] && fix_abs32(g->pivot[k]) >= SMALLEST_PIVOT);
    proof_check(within_full(g->a[i]) && within_full(g->a[p]));
    for (int j = 0; j < N; j++) {
        if (j > k || j == own) {
            g->a[i][j] = (int32_t)proof_range(-FULL, FULL);
        }
    }
    g->shift[i][k] = (uint8_t)proof_range(1, 32);
}

void proof(void)
{
    struct gauss g;

    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            g.a[i][j] = (int32_t)proof_range(-FULL, FULL);
            g.shift[i][j] = 0;
        }
    }
    if (factor(&g, N) < 0) {
        return;
    }
    for (int k = 0; k < N; k++) {
        proof_check(g.row[k] < N && g.step[g.row[k]] == k);
        proof_check(fix_abs32(g.pivot[k]) >= SMALLEST_PIVOT && fix_abs32(g.pivot[k]) <= FULL);
        proof_check(within_full(g.a[k]));
        for (int i = 0; i < N; i++) {
            proof_check(i == g.row[k] || g.a[i][k] == 0 ||
                        (g.shift[i][k] >= 1 && g.shift[i][k] <= 32));
        }
    }
}
