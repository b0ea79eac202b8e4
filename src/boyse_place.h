/* SPDX-License-Identifier: MIT */
/*
 * boyse_place - where the features of a candidate are at time t: shared by the exact test and the
 * polynomial.
 */
#ifndef CAROM_SRC_BOYSE_PLACE_H
#define CAROM_SRC_BOYSE_PLACE_H

#include "boyse.h"

/* Units of the last place of q22 that rounding may be off by in the place of a point. */
#define BOYSE_POINT_NOISE_Q22 2
/* Sine of the angle below which edges count as parallel: 0.01. */
#define BOYSE_PARALLEL_Q30 10737418

/* A vertex against a face: the vertex, a corner of the face and its normal at t. */
struct boyse_vertex_face {
    carom_v3_q22 vertex, corner;
    int32_t n[3];
    struct body *vertex_body, *face_body;
    bool vertex_on_a;
};

/* An edge of a against an edge of b: start points and directions, w = e x f and its length. */
struct boyse_edge_edge {
    const struct carom_edge *edge_a, *edge_b;
    carom_v3_q22 start_a, start_b;
    int32_t e[3], f[3], w[3], d[3];
    int64_t sine_q30;
};

/* d = p - q */
static inline void boyse_difference(int32_t d[3], const carom_v3_q22 *p, const carom_v3_q22 *q)
{
    for (int k = 0; k < 3; k++) {
        d[k] = p->c[k] - q->c[k];
    }
}

void boyse_place_vertex_face(const struct boyse_pair *pair, const struct candidate *c,
                             int32_t t_q30, struct boyse_vertex_face *vf);
void boyse_place_edge_edge(const struct boyse_pair *pair, const struct candidate *c, int32_t t_q30,
                           struct boyse_edge_edge *ee);

#endif
