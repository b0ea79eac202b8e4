/* SPDX-License-Identifier: MIT */
/*
 * A correction is taken out of a residual, which then comes to the next scale, and is added to the solution: no shift is out of range.
 *
 * bound: 15 rows of any entries, digits up to 2^29, scales of 9 to 600, the former one of 0 to 600; x up to 6 2^60, which grows by 2^60
 * mutant: src/num/gauss.c: up < 64 ? (int64_t) -> up < 65 ? (int64_t)
 * mutant: src/num/gauss.c: h - 40 > 62 ? 0 -> h - 40 > 64 ? 0
 */
#include "proof.h"
#include "num/gauss.c"

void proof(void)
{
    const int64_t step = (int64_t)1 << 60;
    const int h = (int)proof_range(9, 600), i = (int)proof_range(0, GAUSS_MAX - 1);
    int32_t row[GAUSS_MAX];
    int64_t former[GAUSS_MAX];
    struct gauss g;

    for (int k = 0; k < GAUSS_MAX; k++) {
        row[k] = (int32_t)proof_range(INT32_MIN, INT32_MAX);
        g.a[k][GAUSS_MAX] = (int32_t)proof_range(-(1 << 29), 1 << 29);
        g.up[k] = (uint8_t)proof_range(0, 29);
        g.residual[k] = proof_word();
        former[k] = g.x_q40[k] = proof_range(-6 * step, 6 * step);
    }
    gauss_take_out(&g, GAUSS_MAX, i, row);
    g.last = (int)proof_range(0, 600);
    proof_assume(h >= g.last);
    add_digits(&g, GAUSS_MAX, h);
    proof_check(go_on(&g, GAUSS_MAX, h) == 1 && g.last == h);
    for (int k = 0; k < GAUSS_MAX; k++) {
        proof_check(g.x_q40[k] >= former[k] - step && g.x_q40[k] <= former[k] + step);
    }
    proof_check(block_bits(g.residual, GAUSS_MAX) >= 0 && block_bits(g.residual, GAUSS_MAX) <= 63);
}
