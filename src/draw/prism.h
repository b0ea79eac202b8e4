/* SPDX-License-Identifier: MIT */
/*
 * prism - the volumes that a solid shades. Its outline, as the light sees it, is cut into triangles.
 * Each keeps the light from a prism behind it, whose sides run through the triangle's edges along the
 * light. Everything is in view coordinates, which are linear in the world's.
 */
#ifndef CAROM_SRC_DRAW_PRISM_H
#define CAROM_SRC_DRAW_PRISM_H

#include "outline.h"

#define PRISM_SIDES 4

/* Bounds across the light: right and up. */
struct prism_extent {
    int32_t low[2], high[2];
};

/* The extent of no point. */
#define PRISM_NOTHING                                                                              \
    (struct prism_extent)                                                                          \
    {                                                                                              \
        {INT32_MAX, INT32_MAX},                                                                    \
        {                                                                                          \
            INT32_MIN, INT32_MIN                                                                   \
        }                                                                                          \
    }

/* The volume that a triangle of the outline shades. */
struct prism {
    carom_v3_q30 side[PRISM_SIDES]; /* inward normals; the last is the triangle's own plane */
    int32_t corner[3][3];           /* corner k lies on side k, corner 0 on the last */
    struct prism_extent extent;
};

/* All prisms of a solid. */
struct prism_set {
    struct draw_outline outline;
    struct prism *prisms;
    uint32_t count;
    struct prism_extent extent; /* of the whole outline */
};

/* Grow an extent to hold a point. */
static inline void prism_reach(struct prism_extent *extent, const struct draw_outline *o,
                               const int32_t at[3])
{
    int32_t pq[2];

    draw_outline_across(o, at, pq);
    for (int k = 0; k < 2; k++) {
        extent->low[k] = fix_smaller(extent->low[k], pq[k]);
        extent->high[k] = fix_larger(extent->high[k], pq[k]);
    }
}

static inline bool prism_overlap(const struct prism_extent *a, const struct prism_extent *b)
{
    return a->low[0] <= b->high[0] && b->low[0] <= a->high[0] && a->low[1] <= b->high[1] &&
           b->low[1] <= a->high[1];
}

/*
 * Make a placed solid's outline and prisms in scratch memory aligned to 8; `sun` points towards the
 * light. Returns false if there is no room.
 */
bool prism_make_all(struct prism_set *set, const struct draw_body *body, const int32_t sun[3],
                    void *scratch, size_t bytes);

/* Cut a polygon of n corners to the inside of a prism. Returns the number of corners left. */
int prism_cut(const struct prism *prism, int32_t polygon[DRAW_CLIP_MAX][3], int n);

#endif
