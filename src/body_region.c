/* SPDX-License-Identifier: MIT */
/* The region of motion that candidates are gathered for. */
#include "body.h"

static void set_turn(struct body_region *region, const struct body_path *path)
{
    carom_rotate(region->turn.c, &path->start.r, path->u.c);
    for (int k = 0; k < 3; k++) {
        region->turn.c[k] *= 2;
    }
    region->u_q30 = path->turns ? (int32_t)fix_sqrt((uint64_t)(path->u2_q30 + 1) << 30) + 1 : 0;
}

void body_region_begin(struct body *b, const struct body_state *s, int32_t time_q30,
                       int32_t room_q22)
{
    struct body_region *region = &b->region;
    const struct body_path *path = &b->path;
    int64_t turn_q30;

    region->at = s->position;
    region->r = region->end_r = path->start.r;
    region->way = path->v;
    region->bend = path->g;
    region->time_q30 = time_q30;
    region->room_q22 = room_q22;
    region->elapsed_q30 = 0;
    region->turned_off_q30 = 0;
    for (int k = 0; k < 3; k++) {
        region->end.c[k] = path->v.c[k] + path->g.c[k];
    }
    set_turn(region, path);
    region->bend_q22 = (int32_t)(fix_length_bound(path->g.c) >> 18) + 1;
    region->length_q22 = (int32_t)(fix_length_bound(path->v.c) >> 18) + 1 + region->bend_q22;
    turn_q30 = 2 * (int64_t)region->u_q30;
    b->reach_q22 = region->length_q22 + (int32_t)fix_mul_q30(turn_q30, b->radius_q22) + 2 +
                   room_q22 + BODY_MARGIN_SKINS * b->skin_q22;
    turn_q30 += ((int64_t)room_q22 << 30) / b->radius_q22 + 1;
    b->turn_q30 = turn_q30 < CAROM_ONE_Q30 ? (int32_t)turn_q30 : CAROM_ONE_Q30;
}

void body_region_end(struct body *b)
{
    if (b->path.turns) {
        carom_quat_q30 end = body_rotation_at(b, CAROM_ONE_Q30);

        body_matrix(&b->region.end_r, &end);
    }
}

/* How far the centre is off the region's path at a time, x_q32 being where it is. */
static int64_t off_q22(const struct body_region *region, const int64_t x_q32[3],
                       int32_t elapsed_q30)
{
    /* the region's own time, in [0, 1] */
    int32_t t_q30 = elapsed_q30 == region->time_q30
                        ? CAROM_ONE_Q30
                        : (int32_t)(((int64_t)elapsed_q30 << 30) / region->time_q30);
    int64_t d[3];

    for (int k = 0; k < 3; k++) {
        int64_t way_q40 =
            fix_mul(region->way.c[k] + fix_mul(region->bend.c[k], t_q30, 30), t_q30, 30);

        d[k] = x_q32[k] - region->at.c[k] - (way_q40 >> 8);
    }
    return (fix_length_bound(d) >> 10) + 1;
}

/*
 * How much the angle between body and region grows over a path of time_q30. Rotations are no farther
 * apart than the vectors that stand for them; those are the Cayley vectors twice, less a third of
 * their cubes.
 */
static int64_t turns_off_q30(const struct body *b, int32_t time_q30)
{
    const struct body_region *region = &b->region;
    const struct body_path *path = &b->path;
    int64_t d[3], cubes_q30;
    int32_t turn[3], part_q30;

    if (!path->turns && region->u_q30 == 0) {
        return 0;
    }
    part_q30 = (int32_t)(((int64_t)time_q30 << 30) / region->time_q30);
    carom_rotate(turn, &path->start.r, path->u.c);
    for (int k = 0; k < 3; k++) {
        d[k] = 2 * (int64_t)turn[k] - carom_mul_q30(region->turn.c[k], part_q30);
        turn[k] = (int32_t)carom_abs(turn[k]);
    }
    cubes_q30 = fix_mul((int64_t)turn[0] + turn[1] + turn[2], path->u2_q30, 30);
    cubes_q30 += carom_mul_q30(carom_mul_q30(region->u_q30, region->u_q30), region->u_q30);
    return fix_length_bound(d) + 2 * cubes_q30 + 4;
}

bool body_region_holds(const struct body *b, int32_t time_q30)
{
    const struct body_region *region = &b->region;
    const struct body_path *path = &b->path;
    int64_t start[3], end[3], off, at_end;
    int32_t until_q30 = region->elapsed_q30 + time_q30;

    if (until_q30 > region->time_q30) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        start[k] = carom_shl(path->origin_q22[k], 10) + path->start.x.c[k];
        end[k] = start[k] + ((path->v.c[k] + path->g.c[k]) >> 8);
    }
    off = off_q22(region, start, region->elapsed_q30);
    at_end = off_q22(region, end, until_q30);
    off = off > at_end ? off : at_end;
    /* between the ends two parabolas are farther apart by an eighth of their second derivatives */
    off += (fix_length_bound(path->g.c) + fix_length_bound(region->bend.c)) >> 20;
    off += fix_mul(region->turned_off_q30 + turns_off_q30(b, time_q30), b->radius_q22, 30);
    return off <= region->room_q22;
}

void body_region_advance(struct body *b, int32_t t_q30, int32_t time_q30)
{
    struct body_region *region = &b->region;

    /* the path turns evenly but for cubes */
    region->turned_off_q30 += turns_off_q30(b, time_q30);
    region->elapsed_q30 += (int32_t)(((int64_t)time_q30 * t_q30) >> 30);
}
