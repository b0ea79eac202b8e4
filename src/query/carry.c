/* SPDX-License-Identifier: MIT */
/*
 * Carry a ray into the frame of a mesh. Start from the ray's point nearest to the body, so that
 * rounding there is not multiplied by the distance to the ray's start.
 */
#include "query.h"

/* Places and ways between bodies and rays, q14: below 2^30. */
#define FAR_SHIFT 18

/* n / d in q30, for 0 <= n <= d; d > 0. */
static int32_t part_q30(int64_t n, int64_t d)
{
    int shift = fix_bits((uint64_t)d) - 32;

    if (shift > 0) {
        n >>= shift;
        d >>= shift;
    }
    return n >= d ? CAROM_ONE_Q30 : (int32_t)((uint64_t)n * CAROM_ONE_Q30 / (uint64_t)d);
}

/*
 * The part of the way at which the ray is nearest to a point; precision does not matter. Bounds:
 * `to` and the way are below 2^30 in q14, so sums of three products are below 2^61.
 */
static int32_t nearest_q30(const int64_t to_q32[3], const carom_v3_q32 *way)
{
    int64_t along = 0, square = 0;

    for (int k = 0; k < 3; k++) {
        int32_t d = (int32_t)(way->c[k] >> FAR_SHIFT), x = (int32_t)(to_q32[k] >> FAR_SHIFT);

        along += (int64_t)d * x;
        square += (int64_t)d * d;
    }
    return along <= 0 ? 0 : part_q30(along, square);
}

/* True if the ray's box and the box of the body's sphere are apart. */
static bool boxes_apart(const struct carom_ray *ray, const struct body *body,
                        const struct body_state *state)
{
    int64_t radius_q32 = (int64_t)body->def.mesh->radius_q22 << 10;

    for (int k = 0; k < 3; k++) {
        int64_t start = ray->from.c[k] - state->position.c[k], end = start + ray->way.c[k];

        if ((start > radius_q32 && end > radius_q32) ||
            (start < -radius_q32 && end < -radius_q32)) {
            return true;
        }
    }
    return false;
}

/*
 * True if the ray's point nearest to a body is outside the body's sphere; the limit allows for the
 * rounded part. Components are below 2^22 in q12 when this may be false.
 */
static bool outside(const int64_t at_q32[3], int32_t radius_q22)
{
    int64_t limit = (radius_q22 >> 10) + (radius_q22 >> 12) + 16, square = 0;

    for (int k = 0; k < 3; k++) {
        int64_t x = at_q32[k] >> 20;

        if (carom_abs(x) > limit) {
            return true;
        }
        square += x * x;
    }
    return square > limit * limit;
}

/*
 * d / along in q30, to nearest, |d| <= |along|; of numbers above 32 bits the upper ones count.
 * Bounds: below 2^62 after the shift. A shift leaves `by` at least 2^31, so the unit that it may add
 * to |d| is half a unit of the quotient, which rounds away.
 */
static int32_t slope(int64_t d, int64_t along, int shift)
{
    int64_t n = (d >> shift) * CAROM_ONE_Q30, by = along >> shift;

    if (by < 0) {
        n = -n;
        by = -by;
    }
    n = n + by / 2;
    n = n / by - (n % by < 0);
    CAROM_ASSERT(carom_abs(n) <= CAROM_ONE_Q30);
    return (int32_t)n;
}

/* The main axis: the largest component's. */
static int main_axis(const int64_t d[3])
{
    int axis = carom_abs(d[1]) > carom_abs(d[0]) ? 1 : 0;

    return carom_abs(d[2]) > carom_abs(d[axis]) ? 2 : axis;
}

/*
 * Set the ray through `at`, the part t of the way, in the mesh's coordinates. The way has a component
 * of 2^12 or more in world axes, so its largest one is above 2^11 in any axes.
 */
static void set_ray(struct query_ray *ray, const int64_t at_q32[3], const int64_t way_q32[3],
                    int32_t t_q30)
{
    const int z = main_axis(way_q32), up = ray->mesh->raw.quantum_bits - 2;
    int shift = fix_bits((uint64_t)carom_abs(way_q32[z])) - 32;

    CAROM_ASSERT(way_q32[z] != 0);
    shift = shift > 0 ? shift : 0;
    ray->axis[2] = z;
    ray->axis[0] = fix_next(z);
    ray->axis[1] = fix_next(ray->axis[0]);
    for (int i = 0; i < 2; i++) {
        ray->slope_q30[i] = slope(way_q32[ray->axis[i]], way_q32[z], shift);
        ray->at_q30[i] = carom_shl(at_q32[ray->axis[i]], up) -
                         fix_mul_q30(carom_shl(at_q32[z], up), ray->slope_q30[i]);
    }
    ray->start_q32 = at_q32[z] - fix_mul_q30(way_q32[z], t_q30);
    ray->up = way_q32[z] > 0;
    ray->length_q32 = carom_abs(way_q32[z]);
    ray->end_q32 = ray->length_q32;
}

bool query_carry(struct query_ray *out, const struct carom_ray *ray, const struct body *body,
                 const struct body_state *state)
{
    const int32_t *q = state->rotation.c;
    int64_t at[3], way[3];
    int32_t t_q30;

    if (boxes_apart(ray, body, state)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        at[k] = state->position.c[k] - ray->from.c[k];
    }
    t_q30 = nearest_q30(at, &ray->way);
    for (int k = 0; k < 3; k++) {
        at[k] = fix_mul_q30(ray->way.c[k], t_q30) - at[k];
        way[k] = ray->way.c[k];
    }
    if (outside(at, body->def.mesh->radius_q22)) {
        return false;
    }
    if ((q[1] | q[2] | q[3]) != 0) { /* skipped for most ground */
        carom_m3_q30 r;

        fix_matrix(&r, &state->rotation);
        fix_rotate_back(at, &r, at);
        fix_rotate_back(way, &r, way);
    }
    for (int k = 0; k < 3; k++) {
        at[k] += carom_shl(body->def.mesh->mass.centre.c[k], 10);
    }
    out->mesh = body->def.mesh;
    set_ray(out, at, way, t_q30);
    return true;
}
