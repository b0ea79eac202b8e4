/* SPDX-License-Identifier: MIT */
/*
 * A correction: a residual comes to 30 bits for the steps, and the scale of the answer is that of the residual less 498 to plus 117.
 *
 * bound: 15 rows, residuals of 1 to 61 bits, a case has those of as many; gauss_carry proves a step, gauss_divide the division
 * cases: 1..61
 * unwind: 240
 * contract: carry by any_step
 * contract: divide_diagonal by any_digits
 * mutant: src/num/gauss.c: int s = bits - 30; -> int s = bits - 31;
 */
#include "proof.h"
#include "num/gauss.c"

static void check_within_30_bits(const struct gauss *g)
{
    for (int i = 0; i < GAUSS_MAX; i++) {
        proof_check(carom_abs(g->y[i]) <= CAROM_ONE_Q30);
    }
}

int any_step(struct gauss *g, int n, int k)
{
    proof_check(n == GAUSS_MAX && k >= 0 && k < n);
    check_within_30_bits(g);
    for (int i = 0; i < GAUSS_MAX; i++) {
        g->y[i] = proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
    }
    return (int)proof_range(0, 31);
}

int any_digits(struct gauss *g, int n)
{
    proof_check(n == GAUSS_MAX);
    check_within_30_bits(g);
    return (int)proof_range(-29, 61);
}

void proof(void)
{
    const int64_t most = (int64_t)1 << CASE;
    const int q = (int)proof_range(0, 600);
    struct gauss g;
    int h;

    for (int i = 0; i < GAUSS_MAX; i++) {
        g.residual[i] = proof_range(-most, most - 1);
        g.inverse_shift[i] = 0; /* the rest is for this machine, which runs the steps */
        g.row[i] = (uint8_t)i;
        g.pivot[i] = CAROM_ONE_Q30;
        for (int k = 0; k < GAUSS_MAX; k++) {
            g.a[i][k] = i == k ? CAROM_ONE_Q30 : 0;
        }
    }
    h = correction(&g, GAUSS_MAX, CASE, q);
    proof_check(h >= q - 498 && h <= q + 117);
}
