/* SPDX-License-Identifier: MIT */
/* outline - a solid's outline, as the light sees it. */
#ifndef CAROM_SRC_DRAW_OUTLINE_H
#define CAROM_SRC_DRAW_OUTLINE_H

#include "view.h"

/* An edge of the outline. q: height along across[1]. p: place along across[0]. */
struct draw_outline_edge {
    int32_t at[2][3]; /* lower and upper end, view coordinates */
    int32_t p[2], q[2];
    int16_t up;         /* 1 if the lit side is on the left, -1 if on the right */
    uint16_t trapezoid; /* the last one with this edge on its left */
};

/* The area between two edges and two heights. */
struct draw_trapezoid {
    uint16_t left, right;
    int32_t low, high;
};

struct draw_outline {
    carom_v3_q30 across[2]; /* right and up as seen from the light; view coordinates */
    struct draw_outline_edge *edges;
    uint32_t edge_count;
    struct draw_trapezoid *trapezoids;
    uint32_t trapezoid_count;
    uint64_t *keys;   /* ends of edges, sorted by height */
    uint16_t *active; /* edges at the present height, and the place of each */
    int64_t *place;
};

/*
 * Find the outline of a placed solid and its trapezoids, in scratch memory aligned to 8.
 *   sun  towards the light, view coordinates
 * Returns false if there was not enough room.
 */
bool draw_outline_find(struct draw_outline *outline, const struct draw_body *body,
                       const int32_t sun[3], void *scratch, size_t bytes);
/* The point of an edge at a height. */
void draw_outline_point(const struct draw_outline *outline, uint32_t edge, int32_t q,
                        int32_t at[3]);
/* The place and height of a point across the light. */
void draw_outline_across(const struct draw_outline *outline, const int32_t at[3], int32_t pq[2]);

#endif
