/* SPDX-License-Identifier: MIT */
/* Clip faces and edges that reach out of the guard band. */
#include "draw.h"

/*
 * The distance of a point inside a plane, up to a factor: 0 the near plane, then left, right, top
 * and bottom of the guard band. |result| <= 2^30.
 */
static int32_t clip_distance(const struct draw_body *body, const int32_t at[3], int plane)
{
    switch (plane) {
    case 0:
        return at[2] - body->near;
    case 1:
        return at[2] + at[0];
    case 2:
        return at[2] - at[0];
    case 3:
        return at[2] + at[1];
    default:
        return at[2] - at[1];
    }
}

/*
 * Where an edge crosses a plane. Always computed from the inner end, so that two faces get the same
 * point of a shared edge.
 */
static void cross_plane(int32_t out[3], const int32_t inner[3], const int32_t outer[3],
                        int64_t d_inner, int64_t d_outer)
{
    /* d_inner >= 0 > d_outer, both at most 2^32: the fraction is below 1, the product below 2^63 */
    int64_t t_q30 = d_inner * CAROM_ONE_Q30 / (d_inner - d_outer);

    for (int k = 0; k < 3; k++) {
        out[k] = inner[k] + (int32_t)carom_round(((int64_t)outer[k] - inner[k]) * t_q30, 30);
    }
}

int draw_cut(int32_t polygon[DRAW_CLIP_MAX][3], const int64_t inside[DRAW_CLIP_MAX], int n)
{
    int32_t kept[DRAW_CLIP_MAX][3];
    int m = 0;

    for (int i = 0; i < n; i++) {
        int next = i + 1 < n ? i + 1 : 0;
        const int32_t *a = polygon[i], *b = polygon[next];
        int64_t da = inside[i], db = inside[next];

        /* a convex polygon gains at most one corner a plane */
        CAROM_ASSERT(m + (da >= 0) + ((da >= 0) != (db >= 0)) <= DRAW_CLIP_MAX);
        if (da >= 0) {
            memcpy(kept[m++], a, sizeof kept[0]);
        }
        if (da >= 0 && db < 0) {
            cross_plane(kept[m++], a, b, da, db);
        } else if (da < 0 && db >= 0) {
            cross_plane(kept[m++], b, a, db, da);
        }
    }
    memcpy(polygon, kept, sizeof kept[0] * (size_t)m);
    return m;
}

/*
 * Rounding leaves no corner outside: the fraction of cross_plane is rounded down, so the exact point
 * is inside its plane, as it is inside those before, being between two corners. The planes have
 * whole-numbered normals, a + b >= 0 and a >= b; both stay true when a and b are rounded.
 */
struct draw_vertex draw_clipped_vertex(const struct draw_body *body, const int32_t at[3])
{
    CAROM_ASSERT(at[2] >= body->near && carom_abs(at[0]) <= at[2] && carom_abs(at[1]) <= at[2]);
    return draw_project(body, at);
}

int draw_clip_placed(const struct draw_body *body, int32_t polygon[DRAW_CLIP_MAX][3], int n,
                     struct draw_vertex out[DRAW_CLIP_MAX])
{
    for (int plane = 0; plane < DRAW_SIDES; plane++) {
        int64_t inside[DRAW_CLIP_MAX];

        for (int i = 0; i < n; i++) {
            inside[i] = clip_distance(body, polygon[i], plane);
        }
        n = draw_cut(polygon, inside, n);
    }
    for (int i = 0; i < n; i++) {
        out[i] = draw_clipped_vertex(body, polygon[i]);
    }
    return n;
}

int draw_clip(const struct draw_body *body, const uint16_t *numbers, int n,
              struct draw_vertex out[DRAW_CLIP_MAX])
{
    int32_t polygon[DRAW_CLIP_MAX][3];

    for (int i = 0; i < n; i++) {
        draw_place(body, numbers[i], polygon[i]);
    }
    return draw_clip_placed(body, polygon, n, out);
}
