/* SPDX-License-Identifier: MIT */
/*
 * boyse - when does a vertex meet a face, or an edge an edge, while the bodies translate and
 * rotate?
 *
 * Boyse's two cases, for a motion that does both together. With p(t) the signed distance of a
 * vertex from a face's plane, or w.d for two edges (w their cross product, d from one to the
 * other), and s the length of the Cayley vector,
 *
 *   P(t) = p(t) (1 + s^2 t^2) = a0 + a1 t + a2 t^2 + a3 t^3 + a4 t^4
 *
 * Without rotation this is the paper's figures 2a and 3a; without translation its figures 2b and
 * 3b, a quadratic in t = tan(angle / 2).
 *
 * All points are relative to the origin of body a's path; N points from b into a.
 */
#ifndef CAROM_SRC_BOYSE_H
#define CAROM_SRC_BOYSE_H

#include "interfere.h"

/* The two bodies of a pair and what the tests need to know of them. */
struct boyse_pair {
    struct body *a, *b;
    int32_t offset_q22[3]; /* origin of b's path relative to a's */
    int32_t skin_q22;      /* EPS */
};

/* Where two features meet, or nearly do. */
struct boyse_touch {
    int32_t gap_q22; /* distance along the normal; negative: they overlap */
    carom_v3_q30 normal;
    carom_v3_q22 on_a, on_b;
    bool valid;  /* inside both features, normal in both cones, edges not parallel */
    int8_t sign; /* edges: N = sign w / |w| */
};

struct boyse_hit {
    int32_t t_q30; /* the bodies can go this far: the gap is still the event gap there */
    struct candidate candidate;
    struct boyse_touch touch; /* at the root, where the surfaces meet */
};

/* Set up a pair; both paths must be placed. */
void boyse_pair_init(struct boyse_pair *pair, struct body *a, struct body *b);

/*
 * The exact test at time t. `touch` is always filled in for candidates that are near; valid says
 * whether the features really face each other there.
 */
void boyse_touch(const struct boyse_pair *pair, const struct candidate *c, int32_t t_q30,
                 struct boyse_touch *touch);

/* Distance at time t, rounded down; cheaper than the whole test. sign as in boyse_touch (1 for
 * faces). */
int32_t boyse_gap(const struct boyse_pair *pair, const struct candidate *c, int32_t t_q30,
                  int sign);

/* The five coefficients of P, 40 fractional bits. |a_k| < 2^49. One moving body: b stands still. */
void boyse_polynomial(const struct boyse_pair *pair, const struct candidate *c, int64_t a_q40[5]);

/*
 * The first time in [0, 1] at which the features meet while approaching.
 *
 *   hit     out  t_q30 and touch, when they do; candidate is left to the caller
 *   roots   in/out  counts the candidates that came to the exact test
 *
 * Units    t in slices, q30, rounded down so that the surfaces do not cross at it
 * Returns  true when there is a hit
 * Source   paper section 2, figures 2 and 3; Boyse's cases (i) and (ii)
 */
bool boyse_first(const struct boyse_pair *pair, const struct candidate *c, struct boyse_hit *hit,
                 uint32_t *roots);

#endif
