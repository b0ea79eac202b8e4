/* SPDX-License-Identifier: MIT */
/*
 * gauss - Gauss-Jordan elimination on block-floating integer rows, one routine for n = 3, 9, 15.
 *
 * A row may be multiplied by any number without changing the solution, because its right-hand side
 * is in the row. So elimination needs no division (row_i = a_kk row_i - a_ik row_k) and each row
 * keeps its own exponent: after each step it is shifted so that its largest entry fills 29 bits.
 */
#ifndef CAROM_SRC_GAUSS_H
#define CAROM_SRC_GAUSS_H

#include "fix.h"

#define GAUSS_MAX 15

/* Workspace from the caller. a[i][n] is the right-hand side of row i. */
struct gauss {
    int32_t a[GAUSS_MAX][GAUSS_MAX + 1];  /* in: the system, |entry| <= 2^29; destroyed */
    int32_t original[GAUSS_MAX][GAUSS_MAX + 1]; /* the normalised rows, kept for the refinement */
    int32_t multiplier[GAUSS_MAX][GAUSS_MAX];
    int32_t pivot[GAUSS_MAX];
    int8_t shift[GAUSS_MAX][GAUSS_MAX];
    uint8_t row[GAUSS_MAX]; /* the row chosen at each step */
    int64_t b[GAUSS_MAX];   /* right-hand side of the refinement */
    int64_t x_q40[GAUSS_MAX]; /* out: the solution */
};

/*
 * Solve the n x n system in w->a; the solution goes to w->x_q40.
 *
 *   n  3, 9 or 15 (any 1 .. GAUSS_MAX works)
 *   w  in/out  rows in any scale, a row's entries sharing one; |entry| <= 2^29
 *
 * Range    |x| < 2^20
 * Error    partial pivoting and one step of iterative refinement; see SPEC.md
 * Returns  0; -1 when the system is singular to working precision or x is out of range.
 * Source   paper section 3 (Gauss-Jordan elimination)
 */
int gauss_solve(struct gauss *w, int n);

#endif
