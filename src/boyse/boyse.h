/* SPDX-License-Identifier: MIT */
/*
 * boyse - when does a vertex meet a face, or an edge an edge, while both bodies translate and
 * rotate?
 *
 * Boyse's two cases, for a motion that does both together. With p(t) the signed distance of a
 * vertex from a face's plane, or w.d for two edges (w their cross product, d from one to the
 * other), and s the length of a body's Cayley vector,
 *
 *   P(t) = p(t) (1 + s_a^2 t^2) (1 + s_b^2 t^2) = a0 + a1 t + ... + a6 t^6
 *
 * One turning body gives a polynomial of degree 4. Without rotation it is the paper's figures 2a
 * and 3a, degree 2; without translation its figures 2b and 3b, a quadratic in t = tan(angle / 2).
 *
 * The question is asked in the axes of a mesh: of the body whose face it is, of b for two edges. So
 * the features of one body lie ready, and only those of the other are carried over.
 */
#ifndef CAROM_SRC_BOYSE_H
#define CAROM_SRC_BOYSE_H

#include "../interfere/interfere.h"

#define BOYSE_DEGREE 6

/* How far points move at most on a path, and how far they are at most from x + x' t. */
struct boyse_bound {
    int32_t way_q22, bend_q22;
};

/*
 * The motion of one body of a pair (`from`) as the other (`to`) sees it: in the mesh axes of `to`
 * as they stand at the start of the path, about its centre of mass.
 */
struct boyse_view {
    struct body *from, *to;
    carom_m3_q30 r;           /* from's mesh axes to these, at the start */
    carom_v3_q22 centre;      /* of from, at the start */
    carom_v3_q24 v, g;        /* the way of from's centre less that of to's: v t + g t^2 */
    carom_v3_q30 u;           /* from's Cayley vector */
    carom_v3_q30 u_relative;  /* less that of to */
    carom_v3_q22 field;       /* a point of from at x starts with the velocity field + 2 u x x, */
                              /* and as to sees it with field + 2 u_relative x x */
    struct boyse_bound seen;  /* of from's points, by `to`, which turns */
    struct boyse_bound fixed; /* between points of both, in axes that do not turn */
    int fine;                 /* bits that the lengths of P can have beyond q22 */
};

/* The two bodies of a pair and what the tests need to know of them. */
struct boyse_pair {
    struct body *a, *b;
    int32_t offset_q22[3];     /* origin of b's path relative to a's */
    int32_t skin_q22;          /* EPS */
    int32_t turn_q30;          /* 2 (s_a + s_b): radians that the bodies turn, at least */
    struct boyse_view view[2]; /* a seen from b, b seen from a */
};

/* How two features meet, or nearly do. */
struct boyse_touch {
    int32_t gap_q22;     /* distance along the normal; negative: they overlap */
    carom_v3_q30 normal; /* N, from b into a; only when valid */
    bool valid;          /* inside both features, normal in both cones, edges not parallel */
    int8_t sign;         /* edges: N = sign w / |w| */
};

struct boyse_hit {
    int32_t t_q30;    /* the bodies can go this far: the gap is still the event gap there */
    int32_t root_q30; /* the surfaces meet */
    struct candidate candidate;
    struct boyse_touch touch; /* at the root; left to the caller, as many hits are not the first */
};

/* Set up a pair; both paths must be placed. */
void boyse_pair_init(struct boyse_pair *pair, struct body *a, struct body *b);

/*
 * The same in two parts: what every candidate needs, and how a sees b, for vertices of b and faces of
 * a. Of most pairs none comes up.
 */
void boyse_pair_begin(struct boyse_pair *pair, struct body *a, struct body *b);
void boyse_pair_turn(struct boyse_pair *pair);

/* Complete a pair that has begun for a candidate. */
static inline void boyse_pair_for(struct boyse_pair *pair, const struct candidate *c)
{
    if (c->kind == CANDIDATE_FACE_VERTEX && !pair->view[1].to) {
        boyse_pair_turn(pair);
    }
}

/*
 * The exact test at time t: whether the features really face each other there, how far apart they
 * are and along which normal.
 */
void boyse_touch(const struct boyse_pair *pair, const struct candidate *c, int32_t t_q30,
                 struct boyse_touch *touch);

/*
 * The paper's static check: the same at the start. False when the features are farther apart than a margin,
 * or a vertex is deeper below a face than `deepest` (negative); `touch` is not set then.
 *
 *   clear_q22  in/out  lowered to how far points of the bodies must go towards each other, at least, before
 *                      the features meet, as far as the margin tells
 */
bool boyse_static(const struct boyse_pair *pair, const struct candidate *c, int32_t deepest_q22,
                  int32_t margin_q22, struct boyse_touch *touch, int32_t *clear_q22);

/*
 * The first time in [0, 1] at which the features meet while approaching.
 *
 *   hit     out  the times, when they do; candidate and touch are left to the caller
 *   roots   in/out  counts the candidates that came to the exact test
 *
 * Units    t in slices, q30, rounded down so that the surfaces do not cross at it
 * Returns  true when there is a hit
 * Source   paper section 2, figures 2 and 3; Boyse's cases (i) and (ii)
 */
bool boyse_first(const struct boyse_pair *pair, const struct candidate *c, struct boyse_hit *hit,
                 uint32_t *roots);

#endif
