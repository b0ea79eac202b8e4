/* SPDX-License-Identifier: MIT */
/*
 * gauss - Gauss-Jordan elimination on block-floating integer rows, one routine for n = 3, 9, 15
 * (paper, section 3).
 *
 * A row may be multiplied by any number without changing the solution. So elimination needs no
 * division (row_i = a_kk row_i - a_ik row_k), and each row keeps its own exponent: a row that a
 * step leaves small is shifted up until its largest entry fills 30 bits again.
 *
 * The multipliers are kept, so that further right-hand sides cost little. The residual of the first
 * solution is solved for and added (iterative refinement), which gives the solution more digits
 * than the rows have. No copy of the rows is kept: the caller gives them once more for that.
 */
#ifndef CAROM_SRC_GAUSS_H
#define CAROM_SRC_GAUSS_H

#include "fix.h"

#define GAUSS_MAX      15
#define GAUSS_ADD_BITS 32

/* Workspace from the caller. a[i][n] is the right-hand side of row i. */
struct gauss {
    /*
     * in: the system, |entry| <= 2^30; destroyed. Later the last column is a correction of the
     * solution, and the last pivots are replaced by their inverses in q59, normalised.
     */
    int32_t a[GAUSS_MAX][GAUSS_MAX + 1];
    int64_t x_q40[GAUSS_MAX]; /* out: the solution */

    /* gauss's own; a step eliminates one column */
    uint8_t up[GAUSS_MAX];               /* how far each row was shifted up at first */
    int64_t residual[GAUSS_MAX];         /* residual of the solution so far, by row */
    int64_t y[GAUSS_MAX];                /* a right-hand side on its way through the steps */
    int32_t pivot[GAUSS_MAX];            /* pivot of each step, at that time */
    uint8_t inverse_shift[GAUSS_MAX];    /* shift that normalised each last pivot */
    uint8_t row[GAUSS_MAX];              /* the row chosen at each step */
    int8_t step[GAUSS_MAX];              /* the step at which each row was chosen; -1: not yet */
    uint8_t shift[GAUSS_MAX][GAUSS_MAX]; /* by row and step: shift of the products */
    int round, first, last; /* corrections so far; fractional bits of the first and of the last */
};

/*
 * Solve the n x n system in g->a; the solution goes to g->x_q40.
 *
 *   more = gauss_begin(g, n), and while more > 0: more = gauss_correct(g, n), and if that is > 0 as
 *   well gauss_take_out(g, n, i, row i) for every i.
 *
 *   n  3, 9 or 15 (any 1 .. GAUSS_MAX works)
 *   g  in/out  rows in any scale, a row's entries sharing one; |entry| <= 2^30
 *
 * Range    |x| < 2^20
 * Error    2^-41 plus 1e-9 of the largest component; see SPEC.md
 * Returns  1: to be corrected; 0: solved; -1 when the system is singular to working precision or x is
 *          out of range. Unless 0, x_q40 means nothing.
 * Source   paper section 3 (Gauss-Jordan elimination)
 */
int gauss_begin(struct gauss *g, int n);
int gauss_correct(struct gauss *g, int n);

/*
 * Subtract the last correction's effect from the residual of row i; `row` is that row of g->a as it
 * was at first.
 */
void gauss_take_out(struct gauss *g, int n, int i, const int32_t *row);

/* Solve in one call, for a caller that has the rows of g->a elsewhere, too. Returns 0 or -1. */
int gauss_solve(struct gauss *g, int n, const int32_t (*rows)[GAUSS_MAX + 1]);

/*
 * After a solve: solve the same rows for another right-hand side and add the result to x_q40. For a
 * caller that knows its equations to more digits than the rows hold: it gives their residual as b.
 *
 *   b_q10  in the scale of the rows with 10 more bits (rows in q30: in q40); |b| < 2^GAUSS_ADD_BITS
 *
 * Returns 0; or -1, with x_q40 unchanged, if b or the result is out of range.
 */
int gauss_add(struct gauss *g, int n, const int64_t *b_q10);

#endif
