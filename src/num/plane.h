/* SPDX-License-Identifier: MIT */
/* plane - does a point lie over a triangle, seen along an axis? Two coordinates are left then. */
#ifndef CAROM_SRC_PLANE_H
#define CAROM_SRC_PLANE_H

#include "fix.h"

/* The axis along which a triangle of this normal looks largest; the last one of a tie. */
static inline int plane_axis(const int32_t n[3])
{
    const int32_t x = fix_abs32(n[0]), y = fix_abs32(n[1]), z = fix_abs32(n[2]);

    return x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
}

/*
 * True if a point lies right of an edge by more than a reach; left of it if the triangle looks
 * clockwise.
 *   edge   from its start to its end
 *   p      from the edge's start, in any unit, which reach shares
 *   reach  how far the point may be off along either axis
 * Range: products below 2^62.
 */
static inline bool plane_outside(const int32_t edge[2], const int32_t p[2], const int32_t reach[2],
                                 bool clockwise)
{
    int64_t left = (int64_t)edge[0] * p[1] - (int64_t)edge[1] * p[0];

    return (clockwise ? -left : left) <
           -((int64_t)fix_abs32(edge[0]) * reach[1] + (int64_t)fix_abs32(edge[1]) * reach[0]);
}

/*
 * 1 if a point is left of an edge seen from above, -1 if it is right of it; 0 for an edge along z.
 * A point on the edge's line counts as shifted a little along x, and far less along y, the same for
 * all edges: so no vertical line slips between two faces or meets both. Range: lengths below 2^30,
 * so the products are below 2^62.
 */
static inline int plane_side(const int32_t from[3], const int32_t to[3], const int32_t p[3])
{
    const int64_t ex = (int64_t)to[0] - from[0], ey = (int64_t)to[1] - from[1];
    int64_t left = ex * ((int64_t)p[1] - from[1]) - ey * ((int64_t)p[0] - from[0]);

    left = left != 0 ? left : ey != 0 ? -ey : ex;
    return (left > 0) - (left < 0);
}

/*
 * For a triangle above or below the point: 1 if it looks up, -1 if it looks down. 0 for any other
 * triangle.
 */
static inline int plane_over(const int32_t a[3], const int32_t b[3], const int32_t c[3],
                             const int32_t p[3])
{
    const int side = plane_side(a, b, p);

    return plane_side(b, c, p) == side && plane_side(c, a, p) == side ? side : 0;
}

#endif
