/* SPDX-License-Identifier: MIT */
/*
 * A right-hand side is divided by the diagonal: no shift is out of range, digits are within 2^29 and their scale is -29 to 61.
 *
 * bound: 3 rows in any order; right-hand sides and inverses up to 2^30, shifts of inverses 0 to 29; a case has quotients of as many bits
 * cases: 0..61
 * contract: fix_bits by as_many_bits
 * mutant: src/num/gauss.c: top = fix_bits(used) + most - DIGITS_BITS -> top = fix_bits(used) + most - DIGITS_BITS - 1
 * mutant: src/num/gauss.c: top - g->inverse_shift[k]); -> top - most);
 */
#include "proof.h"
#include "num/gauss.c"

enum { N = 3 };
/* The division asks once: of no more bits than the cases have. */
int as_many_bits(uint64_t v)
{
    proof_check(v >> 61 == 0);
    proof_assume(CASE == 0 ? v == 0 : v >> (CASE - 1) == 1);
    return CASE;
}

void proof(void)
{
    struct gauss g;
    int top;

    for (int i = 0; i < N; i++) {
        g.row[i] = (uint8_t)proof_range(0, N - 1);
        g.y[i] = proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        g.inverse_shift[i] = (uint8_t)proof_range(0, 29);
        for (int k = 0; k < N; k++) {
            g.a[i][k] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        }
    }
    top = divide_diagonal(&g, N);
    proof_check(top >= -29 && top <= 61);
    for (int k = 0; k < N; k++) {
        proof_check(g.a[k][GAUSS_MAX] >= -(1 << 29) && g.a[k][GAUSS_MAX] <= 1 << 29);
    }
}
