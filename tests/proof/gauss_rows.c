/* SPDX-License-Identifier: MIT */
/*
 * Normalising: each row is shifted up until its largest entry has 30 or 31 bits, its right-hand side with it; a row of zeros is refused.
 *
 * bound: 2 x 2 systems with all entries up to 2^30; rows do not meet, so a case is one row, by the bits of its larger entry, beside 2^30 0 0
 * cases: 0..63
 * unwind: 32
 * mutant: src/num/gauss.c: #define NORMAL         ((int32_t)1 << 29) -> #define NORMAL         ((int32_t)1 << 30)
 * mutant: src/num/gauss.c: carom_shl(g->a[i][n], z) -> carom_shl(g->a[i][n], z + 1)
 */
#include "proof.h"
#include "num/gauss.c"

enum { ROW = CASE / 32, BITS = CASE % 32 };

void proof(void)
{
    const int32_t most = BITS < 31 ? (int32_t)(((uint32_t)1 << BITS) - 1) : CAROM_ONE_Q30;
    const int32_t a = (int32_t)proof_range(-most, most), b = (int32_t)proof_range(-most, most),
                  right = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
    const uint32_t either = (uint32_t)fix_abs32(a) | (uint32_t)fix_abs32(b);
    struct gauss g;

    proof_assume(BITS == 0 || either >> (BITS - 1) == 1);
    g.a[1 - ROW][0] = CAROM_ONE_Q30;
    g.a[1 - ROW][1] = g.a[1 - ROW][2] = 0;
    g.a[ROW][0] = a;
    g.a[ROW][1] = b;
    g.a[ROW][2] = right;
    if (normalise_rows(&g, 2) < 0) {
        proof_check(BITS == 0);
        return;
    }
    proof_check(BITS > 0 && g.up[ROW] <= 29 && g.up[ROW] == (BITS < 30 ? 30 - BITS : 0));
    proof_check(g.a[ROW][0] == a * ((int64_t)1 << g.up[ROW]));
    proof_check(g.a[ROW][1] == b * ((int64_t)1 << g.up[ROW]));
    proof_check(g.residual[ROW] == right * ((int64_t)1 << g.up[ROW]));
    proof_check(g.a[1 - ROW][0] == CAROM_ONE_Q30 && g.a[1 - ROW][1] == 0 &&
                g.residual[1 - ROW] == 0);
}
