/* SPDX-License-Identifier: MIT */
/*
 * A right-hand side goes through a step: nothing overflows, and it ends within 2^30, scaled down by 31 bits at most.
 *
 * bound: 15 rows; entries, pivots and right-hand sides up to 2^30, shifts of 1 to 32; a case has results of as many bits, or within 30
 * cases: 31..61
 * contract: fix_bits by as_many_bits
 * mutant: src/num/gauss.c: s = fix_bits(used) - 30; -> s = fix_bits(used) - 31;
 */
#include "proof.h"
#include "num/gauss.c"

/* The step asks once: of more than 30 bits and of no more than the cases have. */
int as_many_bits(uint64_t v)
{
    proof_check(v >> 30 != 0 && v >> 61 == 0);
    proof_assume(v >> (CASE - 1) == 1);
    return CASE;
}

void proof(void)
{
    struct gauss g;
    int s;

    g.row[0] = (uint8_t)proof_range(0, GAUSS_MAX - 1);
    g.pivot[0] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
    for (int i = 0; i < GAUSS_MAX; i++) {
        g.y[i] = proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        g.a[i][0] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        g.shift[i][0] = (uint8_t)proof_range(1, 32);
    }
    s = carry(&g, GAUSS_MAX, 0);
    proof_check(s >= 0 && s <= 31);
    for (int i = 0; i < GAUSS_MAX; i++) {
        proof_check(g.y[i] >= -CAROM_ONE_Q30 && g.y[i] <= CAROM_ONE_Q30);
    }
}
