/* SPDX-License-Identifier: MIT */
/*
 * The place of a contact, to more digits than the collision test needs: an impulse is as good as
 * its arms. Mesh coordinates are exact in q22; turned into the world they are rounded once, to q40.
 */
#include "contact.h"

/* Below this sine, 1/512, edges are nearly parallel, and nearest to each other far off both. */
#define PARALLEL_Q30 (1 << 21)
/* Below this sine, 2^-20, rounding decides where edges are nearest. */
#define ROUNDING_Q30 (1 << 10)

/* A point of a body's mesh from its centre, in world axes. */
static carom_v3_q40 turned(const struct body *b, carom_v3_q22 local)
{
    const carom_m3_q30 *r = &b->path.start.r;

    return (carom_v3_q40){{carom_round(carom_dot(r->c[0], local.c), 12),
                           carom_round(carom_dot(r->c[1], local.c), 12),
                           carom_round(carom_dot(r->c[2], local.c), 12)}};
}

/* to + s d, s in q40 */
static carom_v3_q40 along(carom_v3_q40 to, int64_t s_q40, const int32_t d_q30[3])
{
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        to.c[k] += fix_mul_q30(s_q40, d_q30[k]);
    }
    return to;
}

/* The way from b's centre to a's. */
static carom_v3_q40 between(const struct boyse_pair *pair)
{
    const struct body_path *a = &pair->a->path, *b = &pair->b->path;
    carom_v3_q40 d;

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        d.c[k] = carom_shl(a->start_x_q32[k] - b->start_x_q32[k], 8) -
                 carom_shl(pair->offset_q22[k], 18);
    }
    return d;
}

/* True if edges with the product w are so parallel that w says little. */
static bool is_small(const int64_t w_q60[3], int64_t sine_q30)
{
    return carom_abs(w_q60[0]) >> 30 < sine_q30 && carom_abs(w_q60[1]) >> 30 < sine_q30 &&
           carom_abs(w_q60[2]) >> 30 < sine_q30;
}

/* A component of d x f, q40. */
static int64_t cross_part(const carom_v3_q40 *d, const int32_t f[3], int i, int j)
{
    return fix_mul_q30(d->c[i], f[j]) - fix_mul_q30(d->c[j], f[i]);
}

/*
 * The distance along a's edge e to the point nearest to b's edge f: s = -d.(f x w) / |w|^2, w = e x
 * f, d from b's start to a's. Bounds: |d| < 2^10 units, so d x f is below 2^51; products fit 128
 * bits. The middle of a's edge if the edges are parallel up to rounding.
 */
static int64_t nearest_q40(const carom_v3_q40 *d, const int64_t w_q60[3], const int32_t f[3],
                           int32_t length_q22)
{
    const int64_t df_q40[3] = {cross_part(d, f, 1, 2), cross_part(d, f, 2, 0),
                               cross_part(d, f, 0, 1)};
    struct fix_wide part = {0, 0}, square = {0, 0};
    struct fix_scaled ratio;

    if (is_small(w_q60, ROUNDING_Q30)) {
        return (int64_t)length_q22 << 17;
    }
    fix_wide_add_dot(&part, df_q40, w_q60);
    fix_wide_add_dot(&square, w_q60, w_q60);
    ratio = fix_wide_ratio(&part, &square);
    ratio.e -= 60; /* q100 over q120, to q40 */
    return -fix_mul_scaled(1, ratio);
}

static int64_t limited(int64_t s, int64_t one, int64_t other)
{
    int64_t low = one < other ? one : other, high = one < other ? other : one;

    return s < low ? low : s > high ? high : s;
}

/*
 * nearest_q40, limited to a place on both edges. Nearly parallel edges are nearest to each other
 * far off one of them until they lie over each other; a place on both is nearer to where they will
 * meet, and in range.
 */
static int64_t on_both_q40(const carom_v3_q40 *d, const int32_t e[3], const int32_t f[3],
                           int32_t length_a_q22, int32_t length_b_q22)
{
    int64_t w_q60[3], s_q40;

    fix_cross(w_q60, e, f);
    s_q40 = nearest_q40(d, w_q60, f, length_a_q22);
    if (is_small(w_q60, PARALLEL_Q30)) {
        int64_t from_q40 = -fix_dot_q30(d->c, e);
        int64_t along_b_q40 = (carom_dot(e, f) >> 30) * length_b_q22 >> 12;

        s_q40 = limited(s_q40, from_q40, from_q40 + along_b_q40);
        s_q40 = limited(s_q40, 0, (int64_t)length_a_q22 << 18);
    }
    return s_q40;
}

/*
 * The point on a's edge. Sets b's start, from b's centre; `apart` is the way from b's centre to
 * a's.
 */
static carom_v3_q40 edge_point(const struct boyse_pair *pair, const struct candidate *c,
                               const carom_v3_q40 *apart, carom_v3_q40 *start_b)
{
    const struct carom_edge *edge_a = &pair->a->def.mesh->edges[c->i];
    const struct carom_edge *edge_b = &pair->b->def.mesh->edges[c->j];
    carom_v3_q40 start_a = turned(pair->a, mesh_vertex(pair->a->def.mesh, edge_a->vertex[0]));
    carom_v3_q40 d;
    int32_t e[3], f[3];

    *start_b = turned(pair->b, mesh_vertex(pair->b->def.mesh, edge_b->vertex[0]));
    carom_rotate(e, &pair->a->path.start.r, edge_a->direction.c);
    carom_rotate(f, &pair->b->path.start.r, edge_b->direction.c);
    for (int k = 0; k < 3; k++) {
        d.c[k] = apart->c[k] + start_a.c[k] - start_b->c[k];
    }
    return along(start_a, on_both_q40(&d, e, f, edge_a->length_q22, edge_b->length_q22), e);
}

void contact_place(const struct boyse_pair *pair, const struct candidate *c,
                   const carom_v3_q30 *normal, carom_v3_q40 arm[2])
{
    carom_v3_q40 apart = between(pair), on[2], gap;
    int known = 0; /* the side whose point is known; of the other side only the plane is */

    if (c->kind == CANDIDATE_EDGE_EDGE) {
        on[0] = edge_point(pair, c, &apart, &on[1]);
    } else {
        const struct body *of_vertex = c->kind == CANDIDATE_VERTEX_FACE ? pair->a : pair->b;
        const struct body *of_face = c->kind == CANDIDATE_VERTEX_FACE ? pair->b : pair->a;

        known = c->kind == CANDIDATE_VERTEX_FACE ? 0 : 1;
        on[known] = turned(of_vertex, mesh_vertex(of_vertex->def.mesh, c->i));
        on[1 - known] = turned(of_face, mesh_corner(of_face->def.mesh, c->j, 0));
    }
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        gap.c[k] = on[0].c[k] + apart.c[k] - on[1].c[k];
    }
    arm[known] =
        along(on[known], (known == 0 ? -1 : 1) * fix_dot_q30(gap.c, normal->c) / 2, normal->c);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        arm[1 - known].c[k] = arm[known].c[k] + (known == 0 ? apart.c[k] : -apart.c[k]);
    }
}
