/* SPDX-License-Identifier: MIT */
/* The region of motion that candidates are gathered for. */
#include "body.h"

/* x times a q16 number that nearly always is 1. */
FIX_APART static int64_t longer(int64_t x, int32_t by_q16)
{
    return by_q16 == 1 << 16 ? x : fix_mul(x, by_q16, 16);
}

static void set_turn(struct body *b, int32_t longer_q16)
{
    struct body_region *region = &b->search.region;
    int64_t u2_q60 = 0;

    if (!b->path.turns) {
        memset(&region->turn, 0, sizeof region->turn);
        region->u_q30 = 0;
        return;
    }
    for (int k = 0; k < 3; k++) {
        region->u.c[k] = (int32_t)longer(body_path(b)->u.c[k], longer_q16);
        u2_q60 += (int64_t)region->u.c[k] * region->u.c[k];
    }
    carom_rotate(region->turn.c, &b->path.start.r, region->u.c);
    for (int k = 0; k < 3; k++) {
        region->turn.c[k] *= 2;
    }
    region->u_q30 = (int32_t)fix_sqrt((uint64_t)u2_q60) + 1;
}

void body_region_begin(struct body *b, const struct body_state *s, int32_t slice_q30,
                       int64_t time_q30, int32_t room_q22)
{
    struct body_region *region = &b->search.region;
    const struct body_path *path = body_path(b);
    int64_t turn_q30;
    /* 64 frames over the shortest slice that is continued, 2^-6 of a frame: below 2^29 */
    int32_t longer_q16 = time_q30 == slice_q30 ? 1 << 16 : (int32_t)((time_q30 << 16) / slice_q30);

    region->at = s->position;
    region->q = path->q;
    region->time_q30 = region->until_q30 = time_q30;
    region->room_q22 = room_q22;
    region->elapsed_q30 = 0;
    region->turned_off_q30 = 0;
    for (int k = 0; k < 3; k++) {
        region->way.c[k] = longer(path->v.c[k], longer_q16);
        region->bend.c[k] = longer(longer(path->g.c[k], longer_q16), longer_q16);
    }
    set_turn(b, longer_q16);
    region->length_q22 = (int32_t)(fix_length_bound(region->way.c) >> 18) +
                         (int32_t)(fix_length_bound(region->bend.c) >> 18) + 2;
    turn_q30 = 2 * (int64_t)region->u_q30;
    b->search.reach_q22 = region->length_q22 + (int32_t)fix_mul_q30(turn_q30, b->def.radius_q22) +
                          2 + room_q22 + BODY_MARGIN_SKINS * b->def.skin_q22;
}

int32_t body_region_turn_off_q30(const struct body *b)
{
    const struct body_region *region = &b->search.region;
    int64_t off_q30 = ((int64_t)region->room_q22 << 30) / b->def.radius_q22 + 1;
    int64_t most_q30 = CAROM_ONE_Q30 - 2 * (int64_t)region->u_q30;

    return (int32_t)(off_q30 < most_q30 ? off_q30 : most_q30);
}

/*
 * A part of a region's time, which is at most 2^36. For a long time the last bits are dropped, so
 * that the dividend is at most 2^63.
 */
static int32_t part_of(const struct body_region *region, int64_t elapsed_q30)
{
    uint64_t elapsed = (uint64_t)elapsed_q30, time = (uint64_t)region->time_q30;

    if (elapsed == time) {
        return CAROM_ONE_Q30;
    }
    if (time >> 33 != 0) {
        elapsed >>= 3;
        time >>= 3;
    }
    return (int32_t)((elapsed << 30) / time);
}

/* The rotation at a time of the region's turn. */
static void axes_at(const struct body_region *region, int32_t t_q30, carom_m3_q30 *axes)
{
    carom_v3_q30 u;

    for (int k = 0; k < 3; k++) {
        u.c[k] = carom_mul_q30(region->u.c[k], t_q30);
    }
    body_turned(&region->q, &u, axes);
}

/*
 * way t + bend t^2 from p on for w is (way + 2 bend p) w + bend w^2. Turns about one axis slow
 * down, so |u| w bounds the part's turn.
 */
void body_region_sweep(const struct body_region *region, int64_t from_q30, int64_t time_q30,
                       struct body_sweep *sweep)
{
    int32_t p_q30 = from_q30 > 0 ? part_of(region, from_q30) : 0;
    int32_t w_q30 =
        time_q30 < region->time_q30 - from_q30 ? part_of(region, time_q30) : CAROM_ONE_Q30 - p_q30;
    int64_t bend[3];

    for (int k = 0; k < 3; k++) {
        int64_t way = region->way.c[k] + 2 * fix_mul_q30(region->bend.c[k], p_q30);

        bend[k] = fix_mul_q30(fix_mul_q30(region->bend.c[k], w_q30), w_q30);
        sweep->way.c[k] = fix_mul_q30(way, w_q30) + bend[k];
        way = fix_mul_q30(region->way.c[k] + fix_mul_q30(region->bend.c[k], p_q30), p_q30);
        sweep->at.c[k] = region->at.c[k] + (way >> 8);
    }
    sweep->bend_q22 = (int32_t)(fix_length_bound(bend) >> 18) + 1;
    sweep->length_q22 = (int32_t)(fix_length_bound(sweep->way.c) >> 18) + 3 + sweep->bend_q22;
    sweep->whole_u_q30 = region->u_q30;
    sweep->u_q30 = region->u_q30 > 0 ? carom_mul_q30(region->u_q30, w_q30) + 2 : 0;
    fix_matrix(&sweep->start, &region->q);
    sweep->end = sweep->start;
    if (region->u_q30 > 0) {
        if (p_q30 > 0) {
            axes_at(region, p_q30, &sweep->start);
        }
        p_q30 = w_q30 < CAROM_ONE_Q30 - p_q30 ? p_q30 + w_q30 : CAROM_ONE_Q30;
        axes_at(region, p_q30, &sweep->end);
    }
}

/*
 * A part of a path turns by (1 + c t, u t), so at its end the axes are turned by u / (1 + c). With
 * N = (1 + c t)^2 + |u|^2 t^2 >= 1 it turns at the rate 2 |u| / N, which changes by 2 |u| N' / N^2;
 * N' is at most 2 (c + c^2 + |u|^2), c below 1/8. A sweep expresses that as 2 |u| times whole_u.
 */
void body_path_sweep(const struct body *b, struct body_sweep *sweep)
{
    const struct body_path *path = body_path(b);
    carom_v3_q30 u;

    for (int k = 0; k < 3; k++) {
        sweep->at.c[k] = carom_shl(path->origin_q22[k], 10);
        sweep->way.c[k] = path->v.c[k] + path->g.c[k];
        u.c[k] = path->u.c[k];
        if (path->c_q30 != 0) {
            u.c[k] = (int32_t)(((int64_t)u.c[k] * CAROM_ONE_Q30) / (CAROM_ONE_Q30 + path->c_q30));
        }
    }
    sweep->bend_q22 = (int32_t)(fix_length_bound(path->g.c) >> 18) + 1;
    sweep->length_q22 = (int32_t)(fix_length_bound(sweep->way.c) >> 18) + 3 + sweep->bend_q22;
    sweep->u_q30 = path->turns ? (int32_t)fix_sqrt_above((uint64_t)(path->u2_q30 + 1) << 30) : 0;
    sweep->whole_u_q30 = 2 * (path->c_q30 + path->c_q30 / 8 + path->u2_q30 + 2);
    sweep->start = sweep->end = path->start.r;
    if (path->turns) {
        body_turned(&path->q, &u, &sweep->end);
    }
}

/* The distance of a centre at x_q32 from the region's path at a time. */
static int64_t off_q22(const struct body_region *region, const int64_t x_q32[3],
                       int64_t elapsed_q30)
{
    int32_t t_q30 = part_of(region, elapsed_q30); /* in units of the region's time, [0, 1] */
    int64_t d[3];

    for (int k = 0; k < 3; k++) {
        int64_t way_q40 =
            fix_mul_q30(region->way.c[k] + fix_mul_q30(region->bend.c[k], t_q30), t_q30);

        d[k] = x_q32[k] - region->at.c[k] - (way_q40 >> 8);
    }
    /* the time is off by at most 2^-26 */
    return (fix_length_bound(d) >> 10) + (region->length_q22 >> 25) + 1;
}

/*
 * Bound on the growth of the angle between body and region over a path of time_q30. Rotations are
 * no farther apart than their rotation vectors, and those are twice the Cayley vectors less a third
 * of their cubes.
 */
static int64_t turns_off_q30(const struct body *b, int32_t time_q30)
{
    const struct body_region *region = &b->search.region;
    const struct body_path *path = body_path(b);
    int64_t d[3], cubes_q30;
    int32_t turn[3], part_q30;

    if (!path->turns && region->u_q30 == 0) {
        return 0;
    }
    part_q30 = part_of(region, time_q30);
    carom_rotate(turn, &path->start.r, path->u.c);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        d[k] = 2 * (int64_t)turn[k] - carom_mul_q30(region->turn.c[k], part_q30);
        turn[k] = (int32_t)carom_abs(turn[k]);
    }
    if (region->elapsed_q30 == 0) {
        return fix_length_bound(d) +
               4; /* from a common start both turn about the same by any time */
    }
    cubes_q30 = fix_mul_q30((int64_t)turn[0] + turn[1] + turn[2], path->u2_q30);
    /* the region's rate of turn falls by its square on the way */
    cubes_q30 += fix_mul_q30(
        carom_mul_q30(carom_mul_q30(region->u_q30, region->u_q30), region->u_q30), part_q30);
    return fix_length_bound(d) + 2 * cubes_q30 + 4;
}

bool body_region_holds(const struct body *b, int32_t time_q30)
{
    const struct body_region *region = &b->search.region;
    const struct body_path *path = body_path(b);
    int64_t start[3], end[3], bend[3], off, at_end;
    int64_t until_q30 = region->elapsed_q30 + time_q30;
    int32_t part_q30;

    if (until_q30 > region->until_q30) {
        return false;
    }
    part_q30 = part_of(region, time_q30);
    for (int k = 0; k < 3; k++) {
        start[k] = carom_shl(path->origin_q22[k], 10) + path->start_x_q32[k];
        end[k] = start[k] + ((path->v.c[k] + path->g.c[k]) >> 8);
        bend[k] = path->g.c[k] - fix_mul_q30(fix_mul_q30(region->bend.c[k], part_q30), part_q30);
    }
    off = off_q22(region, start, region->elapsed_q30);
    at_end = off_q22(region, end, until_q30);
    off = off > at_end ? off : at_end;
    /* between the ends two parabolas differ by another quarter of the difference of their bends */
    off += (fix_length_bound(bend) >> 20) + 1;
    off += fix_mul_q30(region->turned_off_q30 + turns_off_q30(b, time_q30), b->def.radius_q22);
    return off <= region->room_q22;
}

void body_region_advance(struct body *b, int32_t part_q30, int32_t time_q30)
{
    struct body_region *region = &b->search.region;
    /* the path turns evenly but for cubes; no room allows two radians */
    int64_t off_q30 = region->turned_off_q30 + turns_off_q30(b, time_q30);

    region->turned_off_q30 = off_q30 < INT32_MAX ? (int32_t)off_q30 : INT32_MAX;
    region->elapsed_q30 += part_q30;
}
