/* SPDX-License-Identifier: MIT */
/*
 * boyse - when does a vertex meet a face, or an edge an edge, while both bodies translate and
 * rotate? (paper, section 2, figures 2 and 3; Boyse's cases (i) and (ii))
 *
 * In: a pair of bodies with paths, a candidate. Out: the first time in [0, 1] of the path at which
 * the features meet, and the earlier time at which the bodies stop; or, of a pose, the distance and
 * normal.
 *
 * Steps, and the files that hold them:
 *   pair.c        how each body of a pair sees the other one's motion, with bounds
 *   early.c       early test by first-order motion and a bound: nearly every candidate ends here
 *   polynomial.c  features at the start of the path; the coefficients of P(t)
 *   roots.c       P(t) in 32 bits, a safe walk over its roots
 *   touch.c       exact test at a root: inside both features, normal in both normal cones
 *   event.c       back from the root to the time at which the gap is the event gap
 *   boyse.c       all of these in order: boyse_first
 *   static.c      the static check of a pose
 *
 * Both motions happen at once. Let p(t) be the signed distance of a vertex from a face's plane, or
 * w.d of two edges (w their cross product, d from one to the other), and s the length of a body's
 * Cayley vector. Then
 *
 *   P(t) = p(t) (1 + s_a^2 t^2) (1 + s_b^2 t^2) = a0 + a1 t + ... + a6 t^6
 *
 * If one body turns the degree is 4. Without rotation P is that of the paper's figures 2a and 3a,
 * degree 2; without translation that of figures 2b and 3b, a quadratic in t = tan(angle / 2).
 *
 * Everything is computed in the mesh axes of one body, the one with the face, or b for two edges.
 * So that body's features need no transformation, only the other body's do.
 */
#ifndef CAROM_SRC_BOYSE_H
#define CAROM_SRC_BOYSE_H

#include "../interfere/interfere.h"

#define BOYSE_DEGREE 6

/* Bounds on a point's displacement over a path, and on its distance from x + x' t. */
struct boyse_bound {
    int32_t way_q22, bend_q22;
};

/*
 * The motion of one body of a pair (`from`) as the other (`to`) sees it: in the mesh axes of `to`
 * as they stand at the start of the path, about its centre of mass.
 */
struct boyse_view {
    struct body *from, *to;
    carom_m3_q30 r;          /* from's mesh axes to view axes, at the start */
    carom_v3_q22 centre;     /* from's centre at the start */
    carom_v3_q24 v, g;       /* displacement of from's centre less that of to's: v t + g t^2 */
    carom_v3_q30 u;          /* from's Cayley vector, in view axes */
    carom_v3_q30 u_relative; /* u less to's Cayley vector */
    /*
     * initial velocity of a point x of from: field + 2 u x x,
     * and as `to` sees it field + 2 u_relative x x
     */
    carom_v3_q22 field;
    struct boyse_bound seen;  /* of from's points as seen from `to`, which may turn */
    struct boyse_bound fixed; /* of from's points relative to to's, in axes that do not turn */
    int fine;                 /* bits beyond q22 that the lengths in P can have, 0 .. 7 */
};

/*
 * A vertex and a face, or two edges, at some time of the path: in the mesh axes of view->to, from
 * its centre of mass.
 */
struct boyse_places {
    carom_v3_q22 vertex; /* the vertex, or where edge a starts; of view->from */
    const int32_t *n;    /* unit normal of the face */

    const struct carom_edge *edge_a, *edge_b;
    carom_v3_q22 start_b; /* where edge b starts */
    int32_t e[3];         /* unit directions of edges a and b */
    const int32_t *f;
    int32_t w[3], d[3]; /* w = e x f times 2^up; d from a point of b's line to a's start */
    int32_t up;         /* 0 unless the edges are nearly parallel */
    int32_t on_b_q22;   /* place of d's point along edge b */
};

/*
 * A pair of bodies on their paths, prepared for the tests of its candidates, and the features of
 * the candidate at hand. These are here and not on the stack, since a step is deepest there.
 */
struct boyse_pair {
    struct body *a, *b;
    int32_t offset_q22[3];     /* origin of b's path less that of a's */
    int32_t skin_q22;          /* EPS: the larger of both skins */
    int32_t turn_q30;          /* 2 (s_a + s_b): upper bound on what the bodies turn by, radians */
    struct boyse_view view[2]; /* [0]: a seen from b, [1]: b seen from a */
    struct boyse_places start; /* at the start of the path; boyse_place_start sets it */
    struct boyse_places now;   /* at the time of the exact test */
};

/* The exact test of two features at a time: whether they face each other. */
struct boyse_touch {
    int32_t gap_q22;     /* distance along the normal; negative: they overlap */
    carom_v3_q30 normal; /* N, unit, from b into a; set only if valid */
    bool valid; /* true if inside both features, normal in both cones, edges not parallel */
    /* of edges: N = sign w / |w|; -1 for a vertex behind a two-sided face: N = -n; else 1 */
    int8_t sign;
};

struct boyse_hit {
    int32_t t_q30; /* event: the bodies can go this far, and the gap there is still the event gap */
    int32_t root_q30; /* the surfaces meet */
    struct candidate candidate;
    struct boyse_touch
        touch; /* at the root; set by the caller, since many hits are not the first */
};

/* Set up both views of a pair. Both bodies must have paths. */
void boyse_pair_init(struct boyse_pair *pair, struct body *a, struct body *b);

/*
 * The two parts of boyse_pair_init. boyse_pair_begin sets up view 0, for vertices of a and edges.
 * boyse_pair_turn sets up view 1, for vertices of b and faces of a; most pairs never need it.
 */
void boyse_pair_begin(struct boyse_pair *pair, struct body *a, struct body *b);
void boyse_pair_turn(struct boyse_pair *pair);

/* Set up the view that a candidate needs, if it is not yet set up. */
static inline void boyse_pair_for(struct boyse_pair *pair, const struct candidate *c)
{
    if (c->kind == CANDIDATE_FACE_VERTEX && !pair->view[1].to) {
        boyse_pair_turn(pair);
    }
}

/*
 * Exact test at time t: whether the features face each other, how far apart they are, along which
 * normal (world axes).
 */
void boyse_touch(struct boyse_pair *pair, const struct candidate *c, int32_t t_q30,
                 struct boyse_touch *touch);

/*
 * The paper's static check: the exact test at the start. Returns false, and leaves `touch` unset,
 * if the features are farther apart than the margin, or a vertex is deeper below a face than
 * `deepest` (negative).
 *
 *   clear_q22  in/out  lowered to a bound on how far points of the bodies must approach each other
 *                      before the features meet; the margin limits it
 */
bool boyse_static(struct boyse_pair *pair, const struct candidate *c, int32_t deepest_q22,
                  int32_t margin_q22, struct boyse_touch *touch, int32_t *clear_q22);

/*
 * The first time in [0, 1] at which the features meet while approaching.
 *
 *   hit     out  both times; candidate and touch are left to the caller
 *   roots   in/out  counts the candidates that came to the exact test
 *
 * Times are of the slice, q30, rounded down so that the surfaces do not cross at them. Returns true
 * if there is a hit. The paper has this in section 2, figures 2 and 3; Boyse's cases (i) and (ii).
 */
bool boyse_first(struct boyse_pair *pair, const struct candidate *c, struct boyse_hit *hit,
                 uint32_t *roots);

#endif
