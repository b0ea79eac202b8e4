/* SPDX-License-Identifier: MIT */
/*
 * gauss_rows - solves a system from beginning to end, with a copy of its rows; also the rows of an
 * impact.
 */
#ifndef CAROM_TEST_GAUSS_ROWS_H
#define CAROM_TEST_GAUSS_ROWS_H

#include "solve/rows.h"

/* Solve what is in w->a: 0, or -1. */
static inline int gauss_rows_solve(struct gauss *w, int n)
{
    static int32_t rows[GAUSS_MAX][GAUSS_MAX + 1];

    memcpy(rows, w->a, sizeof rows);
    return gauss_solve(w, n, (const int32_t(*)[GAUSS_MAX + 1]) rows);
}

/*
 * The rows of an impact: for sticking, or for sliding where it slides and has a solution. Returns
 * the result of impact_solve.
 */
static inline int gauss_rows_of(struct gauss *w, const struct impact *in,
                                int32_t rows[GAUSS_MAX][GAUSS_MAX + 1])
{
    struct impact_problem p = {.gauss = w, .in = in, .frame.n = in->normal};
    struct impact_result out;
    struct impact_answer x;
    int result = impact_solve(w, in, &out);
    bool sticks;

    if (result != CAROM_OK) {
        return result;
    }
    p.wanted_q70 = fix_wide_mul(in->target_q40, CAROM_ONE_Q30);
    impact_add_speed_q70(&p.wanted_q70, in, &in->normal, -1);
    impact_prepare(&p);
    impact_set_frame(&p.frame, in->velocity.c);
    sticks = !out.slid || impact_slide(&p, in->friction_q16, &x) != 0;
    for (int i = 0; i < p.n; i++) {
        impact_row(&p, sticks, in->friction_q16, i, rows[i]);
    }
    return CAROM_OK;
}

#endif
