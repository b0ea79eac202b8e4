/* SPDX-License-Identifier: MIT */
/* Joints as the caller sees them: removed, changed, queried. src/step/joint_add.c adds them. */
#include "joints.h"

#define LIMIT_MOST_Q32 ((int64_t)8192 << 32)
#define ANGLE_MOST_Q32 ((int64_t)31 << 32)
#define MOST_Q40       ((int64_t)1 << 60)

static bool has_joint(const struct carom_world *w, int joint)
{
    return joint >= 0 && (uint32_t)joint < w->rest.joints.count &&
           w->rest.joints.joints[joint].used;
}

struct joint_pose world_joint_pose(const struct body_state *states, uint16_t body)
{
    struct joint_pose pose = {{{0, 0, 0}}, {{CAROM_ONE_Q30, 0, 0, 0}}};

    if (body != JOINT_WORLD) {
        pose.position = states[body].position;
        pose.rotation = states[body].rotation;
    }
    return pose;
}

static bool within(int64_t v, int64_t low, int64_t high)
{
    return v >= low && v <= high;
}

int world_check_drive(uint8_t kind, const struct carom_joint_drive *d)
{
    int64_t most = kind == CAROM_JOINT_HINGE ? ANGLE_MOST_Q32 / 10 : LIMIT_MOST_Q32;

    if ((!joint_has_coordinate(kind) && (d->limited || d->motor || d->spring)) ||
        (d->motor && (d->spring || kind == CAROM_JOINT_DISTANCE))) {
        return CAROM_ERR_ARGUMENT;
    }
    if ((d->limited && (d->lower_q32 > d->upper_q32 || !within(d->lower_q32, -most, most) ||
                        !within(d->upper_q32, -most, most))) ||
        (d->motor && (!within(d->motor_speed_q40, -((int64_t)64 << 40), (int64_t)64 << 40) ||
                      !within(d->motor_most_q40, 0, MOST_Q40))) ||
        (d->spring &&
         (!within(d->rest_q32, -most, most) || !within(d->stiffness_q40, 0, MOST_Q40) ||
          !within(d->damping_q40, 0, MOST_Q40)))) {
        return CAROM_ERR_RANGE;
    }
    return CAROM_OK;
}

bool world_joint_plausible(const struct joint *j, const struct joint_state *state)
{
    const int64_t most = (int64_t)1 << 60;
    bool good = world_check_drive(j->kind, &state->drive) == CAROM_OK && state->broken <= 1 &&
                within(state->axial_q40, -most, most) && within(state->owed2.hi, -most, most);

    for (int i = 0; i < JOINT_ROWS; i++) {
        good = good && within(state->impulse_q40[i], -most, most);
    }
    return good && world_each_within(state->push.c, most) &&
           world_each_within(state->moment.c, most);
}

/* --------------------------------------------------------------------- groups */

static void ignore(struct carom_world *w, const struct joint *j)
{
    bool first = !w->bodies[j->b].def.moving || j->a > j->b;
    const struct pair p = {first ? j->a : j->b, first ? j->b : j->a};
    uint32_t place;

    (void)broad_find(w->ignored, w->ignored_count, p.a, p.b, &place);
    memmove(&w->ignored[place + 1], &w->ignored[place],
            (w->ignored_count - place) * sizeof *w->ignored);
    w->ignored[place] = p;
    w->ignored_count++;
}

void world_group_joints(struct carom_world *w)
{
    const struct joint_list *list = &w->rest.joints;

    w->ignored_count = 0;
    island_begin(w->bodies, w->body_count);
    for (uint32_t i = 0; i < w->body_count; i++) {
        w->bodies[i].def.joined = BODY_ALONE;
    }
    for (uint32_t i = 0; i < list->count; i++) {
        const struct joint *j = &list->joints[i];

        if (!j->used || w->now->joints[i].broken) {
            continue;
        }
        w->bodies[j->a].def.joined = (uint16_t)(j->a + 1);
        if (j->b == JOINT_WORLD) {
            continue;
        }
        if (!j->touch) {
            ignore(w, j);
        }
        if (w->bodies[j->b].def.moving) {
            const struct pair p = {j->a, j->b};

            w->bodies[j->b].def.joined = (uint16_t)(j->b + 1);
            island_join(w->bodies, &p);
        }
    }
    island_end(w->bodies, w->body_count);
    for (uint32_t i = 0; i < w->body_count; i++) {
        if (w->bodies[i].def.joined != BODY_ALONE) {
            w->bodies[i].def.joined = (uint16_t)(w->bodies[i].island.lowest + 1);
        }
    }
    w->rest.joints.states = w->now->joints;
    w->regions_stale = true;
}

/* ----------------------------------------------------------------- calls */

void world_wake_joint(struct carom_world *w, const struct joint *j)
{
    world_wake_island(w, j->a);
    if (j->b != JOINT_WORLD) {
        world_wake_island(w, j->b);
    }
}

int world_part_joint(struct carom_world *w, struct world_state *state, const struct joint *j)
{
    struct interfere_placed a, b;
    struct pair p;

    if (j->touch || j->b == JOINT_WORLD || state->bodies[j->a].out || state->bodies[j->b].out) {
        return CAROM_OK; /* a body that left the world passes through nothing */
    }
    p = world_name_pair(w, j->a, j->b);
    a = (struct interfere_placed){&w->bodies[p.a], &state->bodies[p.a]};
    b = (struct interfere_placed){&w->bodies[p.b], &state->bodies[p.b]};
    if (!world_overlap(w, a, b)) {
        return CAROM_OK;
    }
    w->passing = true;
    return world_note_through(w, state, &p);
}

void world_write_off(const struct carom_world *w, struct joint_state *states, const struct joint *j)
{
    for (uint32_t i = 0; i < w->rest.joints.count; i++) {
        const struct joint *own = &w->rest.joints.joints[i];

        if (own->used && w->bodies[own->a].def.joined == w->bodies[j->a].def.joined &&
            fix_wide_sign(&states[i].owed2) < 0) {
            states[i].owed2 = (struct fix_wide){0, 0};
        }
    }
}

void world_drop_joint(struct carom_world *w, uint32_t i)
{
    struct joint_list *list = &w->rest.joints;

    world_wake_joint(w, &list->joints[i]);
    world_write_off(w, w->now->joints, &list->joints[i]);
    memset(&list->joints[i], 0, sizeof list->joints[i]);
    for (int k = 0; k < 2; k++) {
        memset(&w->states[k].joints[i], 0, sizeof w->states[k].joints[i]);
    }
    w->pools[CAROM_POOL_joints].used--;
}

int carom_joint_remove(struct carom_world *w, int joint)
{
    int result = CAROM_OK;

    if (!w) {
        return CAROM_ERR_NULL;
    }
    if (!has_joint(w, joint)) {
        return CAROM_ERR_JOINT;
    }
    if (joint_holds(&w->rest.joints, (uint32_t)joint)) {
        result = world_part_joint(w, w->now, &w->rest.joints.joints[joint]);
    }
    if (result == CAROM_OK) {
        world_drop_joint(w, (uint32_t)joint);
        world_group_joints(w);
    }
    return result;
}

/* Compare members, because the bytes between the members of a caller's drive mean nothing. */
static bool same_drive(const struct carom_joint_drive *a, const struct carom_joint_drive *b)
{
    return a->limited == b->limited && a->lower_q32 == b->lower_q32 &&
           a->upper_q32 == b->upper_q32 && a->motor == b->motor &&
           a->motor_speed_q40 == b->motor_speed_q40 && a->motor_most_q40 == b->motor_most_q40 &&
           a->spring == b->spring && a->rest_q32 == b->rest_q32 &&
           a->stiffness_q40 == b->stiffness_q40 && a->damping_q40 == b->damping_q40;
}

int carom_joint_set(struct carom_world *w, int joint, const struct carom_joint_drive *drive)
{
    struct joint_state *state;
    int result;

    if (!w || !drive) {
        return CAROM_ERR_NULL;
    }
    if (!has_joint(w, joint)) {
        return CAROM_ERR_JOINT;
    }
    result = world_check_drive(w->rest.joints.joints[joint].kind, drive);
    if (result < 0) {
        return result;
    }
    state = &w->now->joints[joint];
    if (!same_drive(&state->drive, drive)) {
        state->drive = *drive;
        world_wake_joint(w, &w->rest.joints.joints[joint]);
    }
    return CAROM_OK;
}

int carom_joint_count(const struct carom_world *w)
{
    return w ? (int)w->rest.joints.count : CAROM_ERR_NULL;
}

/* The change of the coordinate in a frame, by the bodies' present motion. */
static int64_t speed_q40(const struct carom_world *w, const struct joint *j)
{
    const struct body_state *states = world_now(w)->bodies;
    const uint16_t side[2] = {j->a, j->b};
    struct joint_pose pose[2] = {world_joint_pose(states, j->a), world_joint_pose(states, j->b)};
    carom_v3_q30 axis = joint_axis(j, &pose[1]);
    int64_t apart[3], v[2][3] = {{0, 0, 0}, {0, 0, 0}}, spin[2][3] = {{0, 0, 0}, {0, 0, 0}};
    carom_v3_q32 at[2] = {joint_anchor(j, 0, &pose[0]), joint_anchor(j, 1, &pose[1])};

    for (int k = 0; k < 3; k++) {
        apart[k] = at[0].c[k] - at[1].c[k];
    }
    for (int s = 0; s < 2; s++) {
        carom_m3_q30 r;
        carom_v3_q40 own, turn;

        if (side[s] == JOINT_WORLD) {
            continue;
        }
        fix_matrix(&r, &states[side[s]].rotation);
        if (w->bodies[side[s]].def.moving) {
            body_velocity(&w->bodies[side[s]], &states[side[s]], &own);
            body_spin(&w->bodies[side[s]], &states[side[s]], &r, &turn);
        } else if (world_is_kinematic(&w->bodies[side[s]]) &&
                   w->bodies[side[s]].def.extra->drive.kind == BODY_DRIVE_ON) {
            own = w->bodies[side[s]].def.extra->drive.velocity;
            turn = w->bodies[side[s]].def.extra->drive.spin;
        } else {
            continue;
        }
        memcpy(spin[s], turn.c, sizeof spin[s]);
        for (int k = 0; k < 3; k++) {
            int m = fix_next(k), n = fix_next(m);
            /* both sides of a slider use the point on a */
            const int64_t *to = at[j->kind == CAROM_JOINT_SLIDER ? 0 : s].c;
            struct fix_wide sum = fix_wide_mul(turn.c[m], to[n] - pose[s].position.c[n]);

            fix_wide_add_product(&sum, -turn.c[n], to[m] - pose[s].position.c[m]);
            v[s][k] = own.c[k] + fix_wide_shift(&sum, 32);
        }
    }
    if (j->kind == CAROM_JOINT_DISTANCE) {
        (void)fix_normalise(&axis, apart);
    }
    for (int k = 0; k < 3; k++) {
        v[0][k] = j->kind == CAROM_JOINT_HINGE ? spin[0][k] - spin[1][k] : v[0][k] - v[1][k];
    }
    return joint_has_coordinate(j->kind) ? fix_dot_q30(v[0], axis.c) : 0;
}

int carom_joint_get(const struct carom_world *w, int joint, struct carom_joint_state *out)
{
    const struct joint_state *state;
    const struct joint *j;
    struct joint_pose pose[2];
    struct joint_error error;

    if (!w || !out) {
        return CAROM_ERR_NULL;
    }
    if (!has_joint(w, joint)) {
        return CAROM_ERR_JOINT;
    }
    j = &w->rest.joints.joints[joint];
    state = &world_now(w)->joints[joint];
    pose[0] = world_joint_pose(world_now(w)->bodies, j->a);
    pose[1] = world_joint_pose(world_now(w)->bodies, j->b);
    joint_measure(j, pose, &error);
    out->kind = j->kind;
    out->broken = state->broken != 0;
    out->a = j->a;
    out->b = j->b == JOINT_WORLD ? CAROM_WORLD : (int)j->b;
    out->anchor[0] = joint_anchor(j, 0, &pose[0]);
    out->anchor[1] = joint_anchor(j, 1, &pose[1]);
    out->axis = joint_axis(j, &pose[1]);
    out->coordinate_q32 = carom_round(error.coordinate_q40, 8);
    out->speed_q40 = speed_q40(w, j);
    out->impulse = state->push;
    out->moment = state->moment;
    out->drive_q40 = state->axial_q40;
    out->drive = state->drive;
    return CAROM_OK;
}
