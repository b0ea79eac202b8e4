/* SPDX-License-Identifier: MIT */
/*
 * place - where the features of a candidate are: shared by the exact test, the early test and
 * the polynomial.
 */
#ifndef CAROM_SRC_BOYSE_PLACE_H
#define CAROM_SRC_BOYSE_PLACE_H

#include "boyse.h"

/* Units of the last place of q22 that rounding may be off by in the place of a point. */
#define BOYSE_POINT_NOISE_Q22 4
/* Gaps that the early test looks at: rounding, and the nearer surface of boyse_first. */
#define BOYSE_NEAR_Q22 12
/* Below this sine, 1/16, w and d are kept to more digits. */
#define BOYSE_FINE_Q30 (1 << 26)
/* Sine of the angle below which edges count as parallel, 2^-25: that of directions' rounding. */
#define BOYSE_PARALLEL_Q30 (1 << 5)

/* How `to` sees `from` in the role of a candidate: of a face the vertex, of b's edge a's. */
static inline const struct boyse_view *boyse_view(const struct boyse_pair *pair,
                                                  const struct candidate *c)
{
    return &pair->view[c->kind == CANDIDATE_FACE_VERTEX];
}

/*
 * A vertex and a face, or two edges, at the start of the path or at some time of it: in the mesh
 * axes of view->to, about its centre of mass.
 */
struct boyse_places {
    carom_v3_q22 vertex; /* of the vertex, or where a's edge starts; of view->from */
    const int32_t *n;    /* normal of the face */

    const struct carom_edge *edge_a, *edge_b;
    carom_v3_q22 start_b; /* where b's edge starts */
    int32_t e[3];         /* directions of the edges */
    const int32_t *f;
    int32_t w[3], d[3]; /* e x f times 2^up, and from a point of b's line to a's start */
    int32_t up,
        on_b_q22; /* 0 but for edges that are nearly parallel; where on b's edge that point is */
};

/* Everything of two edges but `vertex` and e, which are given. */
void boyse_complete_edges(struct boyse_places *p);

/* Whether neither body turns, so that w stays as it is at the start. */
static inline bool boyse_steady(const struct boyse_pair *pair)
{
    return !pair->a->path.turns && !pair->b->path.turns;
}

/* n.vertex - offset, kept whole: q52. */
static inline int64_t boyse_plane_gap_q52(const struct boyse_view *view, const struct candidate *c,
                                          const struct boyse_places *p)
{
    return carom_dot(p->n, p->vertex.c) - carom_shl(view->to->mesh->faces[c->j].offset_q22, 30);
}

/* The features at the start. */
void boyse_place_start(const struct boyse_pair *pair, const struct candidate *c,
                       struct boyse_places *p);

/*
 * Whether they can meet on the path, by first-order motion and a bound of the rest. False for
 * nearly every candidate.
 */
bool boyse_may_meet(const struct boyse_pair *pair, const struct candidate *c);

/*
 * The coefficients of P up to the degree, q40, |a_k| < 2^52; returns the degree: 2, 4 or 6. Of edges in
 * bodies that do not turn it is 2^up times as much as |w| times the gap.
 */
int boyse_polynomial(const struct boyse_pair *pair, const struct candidate *c,
                     const struct boyse_places *start, int64_t a_q40[BOYSE_DEGREE + 1]);

/* |w| of two edges at a time, as the gap is multiplied by it in P. */
int32_t boyse_scale(const struct boyse_pair *pair, const struct boyse_places *start, int32_t t_q30);

/*
 * The exact test without the places in the world: fills in touch->gap_q22, valid and sign. Returns
 * |w| of two edges at that time, as it is in P, 1 for a vertex and a face.
 */
int32_t boyse_test(const struct boyse_pair *pair, const struct candidate *c,
                   const struct boyse_places *start, int32_t t_q30, struct boyse_touch *touch);

/* boyse_touch at the start, where the places are at hand. */
void boyse_touch_start(const struct boyse_pair *pair, const struct candidate *c,
                       const struct boyse_places *start, struct boyse_touch *touch);

#endif
