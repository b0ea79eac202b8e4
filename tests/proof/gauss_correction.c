/* SPDX-License-Identifier: MIT */
/*
 * A correction: a residual comes to 30 bits for the steps, and the scale of the answer counts every shift: it changes by -498 to 117.
 *
 * bound: 15 rows, residuals of 1 to 61 bits, a case has those of as many; gauss_carry proves a step, gauss_divide the division
 * cases: 1..61
 * unwind: 240
 * contract: carry by any_step
 * contract: divide_diagonal by any_digits
 * mutant: src/num/gauss.c: return q + 59 - divide -> return q + 58 - divide
 * mutant: src/num/gauss.c: int s = bits - 30; -> int s = bits - 31;
 */
#include "proof.h"
#include "num/gauss.c"

static int down, top; /* by what the steps scaled down, and the scale that the division says */

static void check_within_30_bits(const struct gauss *g)
{
    for (int i = 0; i < GAUSS_MAX; i++) {
        proof_check(g->y[i] >= -CAROM_ONE_Q30 && g->y[i] <= CAROM_ONE_Q30);
    }
}

int any_step(struct gauss *g, int n, int k)
{
    int s;

    proof_check(n == GAUSS_MAX && k >= 0 && k < n);
    check_within_30_bits(g);
    for (int i = 0; i < GAUSS_MAX; i++) {
        g->y[i] = proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
    }
    s = (int)proof_range(0, 31);
    down += s;
    return s;
}

int any_digits(struct gauss *g, int n)
{
    proof_check(n == GAUSS_MAX);
    check_within_30_bits(g);
    top = (int)proof_range(-29, 61);
    return top;
}

void proof(void)
{
    const int64_t most = (int64_t)1 << CASE;
    const int q = (int)proof_range(0, 600);
    struct gauss g;
    int h;

    for (int i = 0; i < GAUSS_MAX; i++) {
        g.residual[i] = proof_range(-most, most - 1);
    }
    down = 0;
    h = correction(&g, GAUSS_MAX, CASE, q);
    proof_check(h == q + (30 - CASE) + (59 - top) - down);
    proof_check(59 - top >= -2 && 59 - top <= 88 && down >= 0 && down <= 465);
}
