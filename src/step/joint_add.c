/* SPDX-License-Identifier: MIT */
/* Adding a joint. With the first joint, a world gets the functions that solve joints. */
#include "../solve/parts.h"
#include "../world/joints.h"
#include "parts.h"

/* Longest arm of an anchor, in radii of its body. */
#define ARM_RADII 64

/* Check a joint's definition. Its bodies' ids become indices. */
static int check(const struct carom_world *w, struct carom_joint_def *def)
{
    int64_t length_q60 = 0;

    if (!world_find_body(w, &def->a) || (def->b != CAROM_WORLD && !world_find_body(w, &def->b))) {
        return CAROM_ERR_BODY;
    }
    if (def->kind > CAROM_JOINT_FIXED || def->a == def->b || !w->bodies[def->a].def.moving) {
        return CAROM_ERR_ARGUMENT;
    }
    if (def->kind == CAROM_JOINT_HINGE || def->kind == CAROM_JOINT_SLIDER) {
        for (int k = 0; k < 3; k++) {
            if (carom_abs(def->axis.c[k]) > CAROM_ONE_Q30 + (CAROM_ONE_Q30 >> 10)) {
                return CAROM_ERR_ARGUMENT;
            }
            length_q60 += (int64_t)def->axis.c[k] * def->axis.c[k];
        }
        if (carom_abs(length_q60 - ((int64_t)1 << 60)) > (int64_t)1 << 51) {
            return CAROM_ERR_ARGUMENT;
        }
    }
    if (def->most_impulse_q40 < 0 || !world_position_in_range(&def->anchor) ||
        (def->kind == CAROM_JOINT_DISTANCE && !world_position_in_range(&def->anchor_b))) {
        return CAROM_ERR_RANGE;
    }
    return world_check_drive(def->kind, &def->drive);
}

static bool arm_is_short(const struct carom_world *w, const struct joint *j, int side)
{
    const uint16_t body = side == 0 ? j->a : j->b;

    return body == JOINT_WORLD || !w->bodies[body].def.moving ||
           fix_length(j->arm[side].c) <= carom_shl(w->bodies[body].def.radius_q22, 18) * ARM_RADII;
}

/* Set the arm of an anchor from the body's centre, in the mesh's axes. False if it is too long. */
static bool set_arm(const struct carom_world *w, struct joint *j, int side,
                    const carom_v3_q32 *anchor)
{
    uint16_t body = side == 0 ? j->a : j->b;
    struct joint_pose pose = world_joint_pose(world_now(w)->bodies, body);
    carom_m3_q30 r;

    fix_matrix(&r, &pose.rotation);
    for (int k = 0; k < 3; k++) {
        j->arm[side].c[k] = carom_shl(anchor->c[k] - pose.position.c[k], 8);
    }
    fix_rotate_back(j->arm[side].c, &r, j->arm[side].c);
    return arm_is_short(w, j, side);
}

/* Rotation that takes z to an axis: about z x axis, or about x if they are opposite. */
static carom_quat_q30 to_axis(const carom_v3_q30 *axis)
{
    /* (1 + z.axis, z x axis), normalised */
    const int64_t whole[3] = {axis->c[0], axis->c[1], axis->c[2]};
    carom_quat_q30 q = {{0, CAROM_ONE_Q30, 0, 0}};
    carom_v3_q30 n = *axis;
    int64_t v[4], square = 0;
    int64_t length;

    (void)fix_normalise(&n, whole);
    v[0] = (int64_t)CAROM_ONE_Q30 + n.c[2];
    v[1] = -n.c[1];
    v[2] = n.c[0];
    v[3] = 0;
    for (int k = 0; k < 3; k++) {
        square += v[k] * v[k]; /* 2 (1 + z.axis) in q60: below 2^62 */
    }
    length = fix_sqrt((uint64_t)square);
    if (v[0] < CAROM_ONE_Q30 >> 12) {
        return q;
    }
    for (int k = 0; k < 4; k++) {
        q.c[k] = (int32_t)(v[k] * CAROM_ONE_Q30 / length);
    }
    body_normalise(&q);
    return q;
}

static void set_frames(const struct carom_world *w, struct joint *j,
                       const struct carom_joint_def *def)
{
    const carom_quat_q30 none = {{CAROM_ONE_Q30, 0, 0, 0}};
    bool axis = def->kind == CAROM_JOINT_HINGE || def->kind == CAROM_JOINT_SLIDER;
    carom_quat_q30 frame = axis ? to_axis(&def->axis) : none;
    const uint16_t side[2] = {j->a, j->b};

    for (int s = 0; s < 2; s++) {
        struct joint_pose pose = world_joint_pose(world_now(w)->bodies, side[s]);

        fix_turn_between(&j->frame[s], &pose.rotation, &frame);
        body_normalise(&j->frame[s]);
    }
}

/*
 * Put a joint at a place of the list. With the first joint, the world gets the functions that solve
 * joints.
 */
static void put(struct carom_world *w, uint32_t place, const struct joint *made,
                const struct carom_joint_drive *drive)
{
    struct joint_list *list = &w->rest.joints;

    list->count = place == list->count ? place + 1 : list->count;
    list->joints[place] = *made;
    for (int k = 0; k < 2; k++) {
        memset(&w->states[k].joints[place], 0, sizeof w->states[k].joints[place]);
        w->states[k].joints[place].drive = *drive;
    }
    list->states = w->now->joints;
    list->calls = &joint_calls;
    w->joint_steps = &step_joint_calls;
    world_group_joints(w);
}

/* True if a joint that was read could have been added to these bodies. */
static bool could_be(const struct carom_world *w, const struct joint *j)
{
    const int64_t most_q40 = (int64_t)1 << 54; /* twice the width of the world */
    bool good = j->kind <= CAROM_JOINT_FIXED && j->most_impulse_q40 >= 0 && j->a != j->b &&
                j->a < w->body_count && w->bodies[j->a].def.mesh && w->bodies[j->a].def.moving &&
                (j->b == JOINT_WORLD || (j->b < w->body_count && w->bodies[j->b].def.mesh));

    for (int s = 0; good && s < 2; s++) {
        good = world_is_unit(j->frame[s].c, 4, 26) && world_each_within(j->arm[s].c, most_q40) &&
               arm_is_short(w, j, s);
    }
    return good;
}

int step_restore_joint(struct carom_world *w, const struct joint *made)
{
    /* the drive comes with the snapshot */
    static const struct carom_joint_drive none = {.limited = false};

    if (made->used && !could_be(w, made)) {
        return CAROM_ERR_FORMAT;
    }
    if (w->rest.joints.count >= w->pools[CAROM_POOL_joints].size) {
        return CAROM_ERR_JOINTS_FULL;
    }
    if (made->used) { /* no more joints are used than the list has */
        (void)pool_take(&w->pools[CAROM_POOL_joints]);
    }
    put(w, w->rest.joints.count, made, &none);
    return CAROM_OK;
}

int carom_joint_add(struct carom_world *w, const struct carom_joint_def *given)
{
    struct carom_joint_def numbered;
    const struct carom_joint_def *def = &numbered;
    struct joint_list *list;
    struct joint made;
    uint32_t place = 0;
    int result;

    if (!w || !given) {
        return CAROM_ERR_NULL;
    }
    numbered = *given;
    result = check(w, &numbered);
    if (result < 0) {
        return result;
    }
    memset(&made, 0, sizeof made);
    made.used = true;
    made.kind = def->kind;
    made.touch = def->touch;
    made.a = (uint16_t)def->a;
    made.b = def->b == CAROM_WORLD ? JOINT_WORLD : (uint16_t)def->b;
    made.most_impulse_q40 = def->most_impulse_q40;
    if (!set_arm(w, &made, 0, &def->anchor) ||
        !set_arm(w, &made, 1, def->kind == CAROM_JOINT_DISTANCE ? &def->anchor_b : &def->anchor)) {
        return CAROM_ERR_RANGE;
    }
    set_frames(w, &made, def);
    if (pool_take(&w->pools[CAROM_POOL_joints]) < 0) {
        return CAROM_ERR_JOINTS_FULL;
    }
    list = &w->rest.joints;
    while (place < list->count && list->joints[place].used) {
        place++;
    }
    put(w, place, &made, &def->drive);
    world_wake_joint(w, &list->joints[place]);
    return (int)place;
}
