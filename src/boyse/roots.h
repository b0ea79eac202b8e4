/* SPDX-License-Identifier: MIT */
/* roots - P(t) in 32 bits: its value and slope, its roots in order of time, and 32-bit division. */
#ifndef CAROM_SRC_BOYSE_CURVE_H
#define CAROM_SRC_BOYSE_CURVE_H

#include "boyse.h"

/*
 * Bound on the error of a value of P, in its units: rounding of the coefficients, and Horner's
 * rule.
 */
#define CURVE_NOISE 12

/*
 * P; the sum of all |a_k| is below 2^29. Slopes and bends are kept in units of 8, so that they fit.
 */
struct curve {
    int32_t a[BOYSE_DEGREE + 1];
    int degree;    /* 2, 4 or 6 */
    int shift;     /* a = a_q40 / 2^shift, rounded down */
    int32_t bend8; /* bound on |P''| / 16 on [0, 1] */
};

/* v t / 2^30, rounded down; |v| < 2^29. */
static inline int32_t curve_times(int32_t v, int32_t t_q30)
{
    return (int32_t)(uint32_t)((uint64_t)((int64_t)(v * 4) * t_q30) >> 32);
}

static inline int32_t curve_at(const struct curve *q, int32_t t_q30)
{
    int32_t v = q->a[q->degree];

    for (const int32_t *a = q->a + q->degree; a > q->a; a -= 2) {
        v = curve_times(v, t_q30) + a[-1];
        v = curve_times(v, t_q30) + a[-2];
    }
    return v;
}

/* A q40 number in the curve's units. */
static inline int64_t curve_units(const struct curve *q, int64_t v_q40)
{
    return fix_shift(v_q40, -q->shift);
}

/*
 * Scale the coefficients. Returns false if the constant term outweighs all others, so that P has no
 * root on [0, 1].
 */
bool curve_init(struct curve *q, const int64_t a_q40[BOYSE_DEGREE + 1], int degree);

/*
 * n 2^30 / d, rounded down, too small by less than one part in 2^14 and one; UINT32_MAX if it does
 * not fit.
 */
uint32_t curve_quotient_q30(uint32_t n, uint32_t d);

/* A walk over the roots of P in order of time. */
struct walk {
    int32_t t_q30;
    int32_t side;      /* sign of P before the next root; 0 if unknown */
    int32_t stride;    /* least step over a root that is no hit, q30 */
    int32_t p, slope8; /* P and its slope at t */
    int rounds;
};

void walk_begin(struct walk *walk, const struct curve *q);
/* Go on to the next root, or to within rounding of one. Returns false if there is none up to 1. */
bool walk_next(struct walk *walk, const struct curve *q);
/* Step over a root that is no hit. */
void walk_over(struct walk *walk, const struct curve *q);

#endif
