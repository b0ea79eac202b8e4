/* SPDX-License-Identifier: MIT */
/*
 * Does a ray meet a face? Seen along the ray's main axis, and sheared so that the ray stands
 * upright, the ray is the point (0, 0) and a corner v has the integer coordinates
 *
 *   X_i = 2^30 v_i - at_i - slope_i v_z
 *
 * These are the same for all faces that have the corner. The sign of X_a Y_b - X_b Y_a is the side
 * of the edge from a to b on which the ray lies. Both faces of an edge get the same number with
 * opposite signs, so the ray cannot slip through between them.
 *
 * Nearly always the upper bits of X and Y decide; the full numbers are for the rest.
 */
#include "query.h"

/* A corner as the ray sees it: the upper bits of X and Y. */
struct seen {
    const int16_t *v;
    int32_t x, y;
};

/* X_i in full. Bounds: |v| <= 2^15, |at| < 2^60, and the slope is at most 2^30. */
static int64_t whole(const struct query_ray *ray, const int16_t *v, int i)
{
    return v[ray->axis[i]] * (int64_t)CAROM_ONE_Q30 - ray->at_q30[i] -
           (int64_t)ray->slope_q30[i] * v[ray->axis[2]];
}

/*
 * X_i without the bits that the early test ignores. A ray that is marched passes through the mesh's
 * box, or within a quantum of it: it is within 2^16 + 1 quanta of any corner along each axis, so
 * |X| < 2^48, and the result is below 2^31.
 */
static inline int32_t early(const struct query_ray *ray, const int16_t *v, int i)
{
    return (int32_t)(whole(ray, v, i) >> QUERY_EARLY_SHIFT);
}

/*
 * The side of an edge in full. A ray on the edge's line counts as moved a little along X, and far
 * less along Y, the same for all edges. 0 for an edge that the ray runs along. Bounds: |X|, |Y| <
 * 2^48, so products take 96 bits.
 */
static int exact_side(const struct query_ray *ray, const int16_t *a, const int16_t *b)
{
    int64_t xa = whole(ray, a, 0), ya = whole(ray, a, 1);
    int64_t xb = whole(ray, b, 0), yb = whole(ray, b, 1);
    struct fix_wide side = fix_wide_mul(xa, yb);
    int sign;

    fix_wide_add_product(&side, -xb, ya);
    sign = fix_wide_sign(&side);
    if (sign == 0) {
        sign = ya != yb ? (ya > yb ? 1 : -1) : xb != xa ? (xb > xa ? 1 : -1) : 0;
    }
    return sign;
}

/*
 * The side of an edge. The bits cut off x and y are worth less than one each, so the side is off by
 * less than their sum plus 2: below 2^33. |x|, |y| <= 2^31, so two products are below 2^63.
 */
static inline int side_of(const struct query_ray *ray, const struct seen *a, const struct seen *b)
{
    int64_t side = (int64_t)a->x * b->y - (int64_t)b->x * a->y;
    int32_t high = (int32_t)(side >> 34);

    if (high != 0 && high != -1) {
        return high < 0 ? -1 : 1;
    }
    return exact_side(ray, a->v, b->v);
}

/* The side that a ray through the face has on all three edges; 0 if they differ. */
static inline int crossing(const struct query_ray *ray, const struct seen p[3])
{
    int side = side_of(ray, &p[0], &p[1]);

    if (side == 0 || side_of(ray, &p[1], &p[2]) != side || side_of(ray, &p[2], &p[0]) != side) {
        return 0;
    }
    return side;
}

/*
 * floor(n / d), bit by bit, for d <= n < 2^62 d and d > 0 of at most 70 bits. n is below 2^116, and
 * the remainder is below 2 d.
 */
static int64_t divide(const struct fix_wide *n, const struct fix_wide *d)
{
    int shift = fix_wide_bits(n) - fix_wide_bits(d);
    struct fix_wide rest = *n, by = *d;
    int64_t quotient = 0;

    CAROM_ASSERT(shift >= 0 && shift < 64);
    fix_wide_shift_up(&by, shift);
    for (; shift >= 0; shift--) {
        quotient = 2 * quotient;
        if (rest.hi > by.hi || (rest.hi == by.hi && rest.lo >= by.lo)) {
            fix_wide_subtract(&rest, &by);
            quotient++;
        }
        by.lo = by.lo >> 1 | (uint64_t)by.hi << 63;
        by.hi >>= 1;
    }
    return quotient;
}

/*
 * Where the ray meets a face's plane, along its main axis, in units q32, rounded down. With n the
 * cross product of two sides, n . (p - corner 0) is 0 at
 *
 *   z = (2^30 n . corner - n_0 at_0 - n_1 at_1) / (2^30 n_z + n_0 slope_0 + n_1 slope_1)
 *
 * Bounds: sides are below 2^16, n below 2^34, n . corner below 2^51. `at` is below 2^49 if the ray
 * passes through the box; the numerator is below 2^86 and the denominator below 2^66. Counted from
 * 2^16 quanta below the origin z is 2^15 quanta or more, since the ray meets the face between its
 * corners, and below 2^17 quanta: 2^27 .. 2^42 in q32.
 */
static int64_t meeting(const struct query_ray *ray, const struct seen p[3])
{
    const int *axis = ray->axis;
    const int bits = ray->mesh->raw.quantum_bits;
    struct fix_wide above, below, down = {0, 0};
    int32_t side[2][3];
    int64_t n[3], dot = 0;

    for (int k = 0; k < 3; k++) {
        side[0][k] = p[1].v[axis[k]] - p[0].v[axis[k]];
        side[1][k] = p[2].v[axis[k]] - p[0].v[axis[k]];
    }
    fix_cross(n, side[0], side[1]);
    for (int k = 0; k < 3; k++) {
        dot += n[k] * p[0].v[axis[k]];
    }
    above = fix_wide_mul(dot, CAROM_ONE_Q30);
    below = fix_wide_mul(n[2], CAROM_ONE_Q30);
    for (int i = 0; i < 2; i++) {
        fix_wide_add_product(&above, -n[i], ray->at_q30[i]);
        fix_wide_add_product(&below, n[i], ray->slope_q30[i]);
    }
    if (below.hi < 0) {
        fix_wide_subtract(&down, &above);
        above = down;
        down = (struct fix_wide){0, 0};
        fix_wide_subtract(&down, &below);
        below = down;
    }
    down = below;
    fix_wide_shift_up(&down, 16);
    fix_wide_add(&above, &down);
    fix_wide_shift_up(&above, 32 - bits);
    return divide(&above, &below) - ((int64_t)1 << (16 + 32 - bits));
}

bool query_strike(const struct query_ray *ray, uint16_t face, struct query_strike *out)
{
    const struct carom_mesh *mesh = ray->mesh;
    const uint16_t *corner = mesh->raw.faces[face];
    struct seen p[3];
    int64_t way;
    int side;

    for (int k = 0; k < 3; k++) {
        p[k].v = mesh->raw.vertices[corner[k]];
        p[k].x = early(ray, p[k].v, 0);
    }
    /* the ray is at 0: all corners on one side of it, along X or along Y, rule the face out */
    if ((p[0].x & p[1].x & p[2].x) < 0 || (p[0].x > 0 && p[1].x > 0 && p[2].x > 0)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        p[k].y = early(ray, p[k].v, 1);
    }
    if ((p[0].y & p[1].y & p[2].y) < 0 || (p[0].y > 0 && p[1].y > 0 && p[2].y > 0)) {
        return false;
    }
    side = crossing(ray, p);
    /* corners counter-clockwise seen from the axis's upper end: the face looks up */
    if (side == 0 || (!ray->back && (side > 0) == ray->up)) {
        return false;
    }
    way = meeting(ray, p) - ray->start_q32;
    way = ray->up ? way : -way;
    out->face = face;
    out->way_q32 = way;
    return way >= 0 && way <= ray->end_q32;
}
