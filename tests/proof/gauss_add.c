/* SPDX-License-Identifier: MIT */
/*
 * Another right-hand side: it fits its scale in 61 bits, and the solution grows by 2^60 at most, or stays as it was.
 *
 * bound: 15 rows, all right-hand sides, rows shifted up by 0 to 29, solutions up to 6 2^60; gauss_correction proves the correction
 * contract: correction by any_correction
 * mutant: src/num/gauss.h: GAUSS_ADD_BITS 32 -> GAUSS_ADD_BITS 33
 * mutant: src/num/gauss.c: h < DIGITS_BITS - 20) -> h < DIGITS_BITS - 24)
 */
#include "proof.h"
#include "num/gauss.c"

static int64_t b_q10[GAUSS_MAX];

int any_correction(struct gauss *g, int n, int bits, int q)
{
    int h = (int)proof_range(-498, 117 * ROUNDS_MAX);

    proof_check(n == GAUSS_MAX && q == 10 && bits >= 1 && bits <= 61);
    for (int i = 0; i < n; i++) {
        proof_check(g->residual[i] >> g->up[i] == b_q10[i]);
        g->a[i][GAUSS_MAX] = (int32_t)proof_range(-(1 << 29), 1 << 29);
    }
    proof_assume(h >= q - 498 && h <= q + 117);
    return h;
}

void proof(void)
{
    const int64_t step = (int64_t)1 << 60;
    int64_t former[GAUSS_MAX];
    struct gauss g;
    int failed;

    for (int i = 0; i < GAUSS_MAX; i++) {
        b_q10[i] = proof_word();
        g.up[i] = (uint8_t)proof_range(0, 29);
        former[i] = g.x_q40[i] = proof_range(-6 * step, 6 * step);
    }
    failed = gauss_add(&g, GAUSS_MAX, b_q10);
    proof_check(failed == 0 || failed == -1);
    for (int i = 0; i < GAUSS_MAX; i++) {
        proof_check(failed ? g.x_q40[i] == former[i]
                           : g.x_q40[i] >= former[i] - step && g.x_q40[i] <= former[i] + step);
    }
}
