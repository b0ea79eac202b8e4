/* SPDX-License-Identifier: MIT */
/*
 * place - where the features of a candidate are, for the exact test, the early test and the
 * polynomial.
 */
#ifndef CAROM_SRC_BOYSE_PLACE_H
#define CAROM_SRC_BOYSE_PLACE_H

#include "boyse.h"

/* Bound on the rounding of a point's place, units of q22. */
#define BOYSE_POINT_NOISE_Q22 4
/* Tolerance of the early test: rounding, and the nearer surface of boyse_first (ROOT_LEVEL_Q22). */
#define BOYSE_NEAR_Q22 12
/*
 * Touches of a two-sided mesh that are deeper than this count on its front alone, see touch.c. The
 * search for a root shifts a surface by as much (BOYSE_ROOT_LEVEL_Q22).
 */
#define BOYSE_BEHIND_Q22 (-BOYSE_ROOT_LEVEL_Q22)
/* Below this sine, 1/16, w and d get more digits. */
#define BOYSE_FINE_Q30 (1 << 26)
/*
 * Sine below which edges count as parallel, 2^-25: rounding of directions turns edges by as much.
 */
#define BOYSE_PARALLEL_Q30 (1 << 5)

/* The view of a candidate: `from` has the vertex, or edge a; `to` has the face, or edge b. */
static inline const struct boyse_view *boyse_view(const struct boyse_pair *pair,
                                                  const struct candidate *c)
{
    return &pair->view[c->kind == CANDIDATE_FACE_VERTEX];
}

/* True if a vertex of a may touch a face of b from both sides. */
static inline bool boyse_either_side(const struct boyse_pair *pair, const struct candidate *c)
{
    return c->kind == CANDIDATE_VERTEX_FACE && mesh_two_sided(pair->b->def.mesh);
}

/* Set everything of two edges but `vertex` and e, which are given. */
void boyse_complete_edges(struct boyse_places *p);

/* True if neither body turns: w keeps its value of the start. */
static inline bool boyse_steady(const struct boyse_pair *pair)
{
    return !pair->a->path.turns && !pair->b->path.turns;
}

/* n.vertex - offset, unrounded: q52. */
static inline int64_t boyse_plane_gap_q52(const struct boyse_view *view, const struct candidate *c,
                                          const struct boyse_places *p)
{
    return carom_dot(p->n, p->vertex.c) - carom_shl(view->to->def.mesh->faces[c->j].offset_q22, 30);
}

/* Set pair->start: place the features of the candidate at hand at the start. */
void boyse_place_start(struct boyse_pair *pair, const struct candidate *c);

/*
 * Early test: true if the features may meet on the path, by first-order motion and a bound of the
 * rest. False for nearly every candidate.
 */
bool boyse_may_meet(const struct boyse_pair *pair, const struct candidate *c);

/*
 * The coefficients of P, q40, |a_k| < 2^52. Returns the degree: 2, 4 or 6. If neither body turns
 * edges have P = 2^up |w| gap, else P has the factor |w| alone.
 */
int boyse_polynomial(const struct boyse_pair *pair, const struct candidate *c,
                     int64_t a_q40[BOYSE_DEGREE + 1]);

/* |w| of two edges at a time, as it is a factor of P. */
int32_t boyse_scale(const struct boyse_pair *pair, int32_t t_q30);

/*
 * Exact test from pair->start without world places: sets touch->gap_q22, valid and sign. Returns
 * |w| of two edges at that time as it is in P; 1 for a vertex and a face.
 */
int32_t boyse_test(struct boyse_pair *pair, const struct candidate *c, int32_t t_q30,
                   struct boyse_touch *touch);

/* boyse_touch at the start, from pair->start. */
void boyse_touch_start(const struct boyse_pair *pair, const struct candidate *c,
                       struct boyse_touch *touch);

#endif
