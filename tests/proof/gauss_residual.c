/* SPDX-License-Identifier: MIT */
/*
 * Taking a correction out of a residual, bringing it to the next scale and adding it to the solution: no shift is out of range.
 *
 * bound: 2 x 2 systems, entries up to 2^30, digits below 2^30, scales of 9 to 120; x below 2^61
 * mutant: src/num/gauss.c: up < 64 ? (int64_t) -> up < 65 ? (int64_t)
 */
#include "proof.h"
#include "num/gauss.c"

void proof(void)
{
    struct gauss g;
    int32_t row[2];
    int h = (int)proof_range(9, 120);

    for (int i = 0; i < 2; i++) {
        row[i] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        g.a[i][GAUSS_MAX] = (int32_t)proof_range(-CAROM_ONE_Q30 + 1, CAROM_ONE_Q30 - 1);
        g.up[i] = (uint8_t)proof_range(0, 29);
        g.residual[i] = proof_word();
        g.x_q40[i] = proof_range(-(1LL << 61), 1LL << 61);
    }
    gauss_take_out(&g, 2, 0, row);
    g.last = (int)proof_range(9, 120);
    proof_assume(h >= g.last);
    add_digits(&g, 2, h);
    proof_check(go_on(&g, 2, h) == 1 && g.last == h);
    proof_check(block_bits(g.residual, 2) >= 0 && block_bits(g.residual, 2) <= 63);
}
