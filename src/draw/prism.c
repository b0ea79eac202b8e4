/* SPDX-License-Identifier: MIT */
/* The prisms behind a solid's outline, and the parts of polygons inside them. */
#include "prism.h"

/*
 * Set the inward normal of the plane through an edge and the light. Returns false for an edge along
 * the light.
 */
static bool side_through(carom_v3_q30 *side, const int32_t sun[3], const int32_t a[3],
                         const int32_t b[3])
{
    int64_t across[3], edge[3];

    for (int k = 0; k < 3; k++) {
        edge[k] = (int64_t)b[k] - a[k];
    }
    /* the sun is at most 2^30 long, an edge less than 2^31: below 2^62 */
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;

        across[k] = sun[i] * edge[j] - sun[j] * edge[i];
    }
    return fix_normalise(side, across);
}

/* Set the plane of a triangle; inward is away from the light. */
static bool plane_of(carom_v3_q30 *side, int32_t corner[3][3])
{
    int32_t to[3];

    for (int k = 0; k < 3; k++) {
        to[k] = (corner[0][k] >> 1) - (corner[1][k] >> 1);
    }
    return side_through(side, to, corner[0], corner[2]);
}

/*
 * Set the sides of a triangle's prism; the triangle runs counter-clockwise as the light sees it.
 * Returns false if it is edge-on to the light.
 */
static bool make_prism(struct prism *prism, const int32_t sun[3])
{
    bool is = true;

    for (int k = 0; k < 3; k++) {
        is = is &&
             side_through(&prism->side[k], sun, prism->corner[k], prism->corner[k < 2 ? k + 1 : 0]);
    }
    return is && plane_of(&prism->side[3], prism->corner);
}

/* Add the prisms of a trapezoid, at most two. */
static void add_prisms(struct prism_set *set, const struct draw_trapezoid *t, const int32_t sun[3])
{
    const struct draw_outline *o = &set->outline;
    int32_t corner[4][3];

    draw_outline_point(o, t->left, t->low, corner[0]);
    draw_outline_point(o, t->right, t->low, corner[1]);
    draw_outline_point(o, t->right, t->high, corner[2]);
    draw_outline_point(o, t->left, t->high, corner[3]);
    for (int i = 2; i < 4; i++) {
        struct prism *prism = &set->prisms[set->count];

        prism->extent = PRISM_NOTHING;
        for (int k = 0; k < 3; k++) {
            const int32_t *at = corner[k == 0 ? 0 : i + k - 2];

            memcpy(prism->corner[k], at, sizeof corner[0]);
            prism_reach(&prism->extent, o, at);
        }
        set->count += make_prism(prism, sun);
    }
}

bool prism_make_all(struct prism_set *set, const struct draw_body *body, const int32_t sun[3],
                    void *scratch, size_t bytes)
{
    const struct draw_outline *o = &set->outline;
    const uint8_t *end = (const uint8_t *)scratch + bytes;

    if (!draw_outline_find(&set->outline, body, sun, scratch, bytes)) {
        return false;
    }
    set->prisms = (struct prism *)(void *)(o->trapezoids + o->trapezoid_count);
    set->count = 0;
    if ((size_t)(end - (const uint8_t *)set->prisms) / sizeof *set->prisms <
        2 * o->trapezoid_count) {
        return false;
    }
    for (uint32_t i = 0; i < o->trapezoid_count; i++) {
        add_prisms(set, &o->trapezoids[i], sun);
    }
    set->extent = PRISM_NOTHING;
    for (uint32_t i = 0; i < 2 * o->edge_count; i++) {
        prism_reach(&set->extent, o, o->edges[i / 2].at[i % 2]);
    }
    return true;
}

/*
 * Distances are rounded down, so a cut may be one unit inside of its plane, and never outside:
 * where two sides meet at a small angle, a unit beyond both would lengthen the polygon by many
 * pixels. A gap of some units between prisms is far less than the growth of decals.
 */
int prism_cut(const struct prism *prism, int32_t polygon[DRAW_CLIP_MAX][3], int n)
{
    for (int s = 0; s < PRISM_SIDES && n > 0; s++) {
        const int32_t *corner = prism->corner[s % 3];
        int64_t inside[DRAW_CLIP_MAX];
        bool any = false, all = true;

        for (int i = 0; i < n; i++) {
            int32_t from[3];

            for (int k = 0; k < 3; k++) {
                from[k] = polygon[i][k] - corner[k];
            }
            inside[i] = carom_dot(prism->side[s].c, from) >> 30;
            any = any || inside[i] > 0;
            all = all && inside[i] >= 0;
        }
        n = !any ? 0 : all ? n : draw_cut(polygon, inside, n);
    }
    return n;
}
