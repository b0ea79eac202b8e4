/* SPDX-License-Identifier: MIT */
/*
 * Joints in a step. Bodies that joints connect set out together: when one body of a group hits or
 * ends its slice, all leave their paths and their joints are solved. A solve computes where anchors
 * and axes will be at the end of the slice, on the paths that the bodies would take. It changes
 * velocities so that they are where they belong there. As paths bend, this repeats on the paths
 * after the solve until the rest is a small part of a skin.
 *
 * At the end of a frame, velocities are made to agree with the joints at the bodies' final places,
 * and energy is corrected: energy.c.
 */
#include "connect.h"

/* ------------------------------------------------------------------------ choose */

static void begin(struct step *s)
{
    struct joint_list *list = &s->w->rest.joints;

    list->states = s->next->joints;
    memcpy(s->next->joints, world_now(s->w)->joints, list->count * sizeof *list->states);
    for (uint32_t i = 0; i < list->count; i++) {
        struct joint_state *state = &list->states[i];

        list->joints[i].work.pulled_q30 = 0;
        list->joints[i].work.given2 = (struct fix_wide){0, 0};
        list->joints[i].work.given_q30 = list->joints[i].work.back_q30 = 0;
        list->joints[i].work.second_q40 = 0;
        list->joints[i].work.pull_most_q30 = CAROM_ONE_Q30;
        if (list->joints[i].used && connect_answers(s, list->joints[i].a)) {
            memset(&state->push, 0, sizeof state->push);
            memset(&state->moment, 0, sizeof state->moment);
            state->axial_q40 = 0;
        }
    }
}

/* Place the bodies of a chosen joint where they are. */
static void place_sides(struct step *s, const struct joint *j)
{
    const uint16_t side[2] = {j->a, j->b};

    for (int k = 0; k < 2; k++) {
        if (j->chosen && connect_answers(s, side[k])) {
            body_place(&s->w->bodies[side[k]], &s->next->bodies[side[k]]);
        }
    }
}

/* Choose all joints of bodies that are awake. False if there are none. */
static bool choose_all(struct step *s)
{
    struct joint_list *list = &s->w->rest.joints;
    bool any = false;

    for (uint32_t i = 0; i < list->count; i++) {
        struct joint *j = &list->joints[i];

        j->chosen = joint_holds(list, i) && (connect_answers(s, j->a) || connect_answers(s, j->b));
        any = any || j->chosen;
        place_sides(s, j);
    }
    return any;
}

static void choose_members(struct step *s)
{
    struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        struct joint *j = &list->joints[i];

        j->chosen =
            joint_holds(list, i) && (connect_is_member(s, j->a) || connect_is_member(s, j->b));
    }
}

/* A body that is connected with a member and is none itself; ISLAND_END: none. */
static uint32_t connected(const struct step *s)
{
    const struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        const struct joint *j = &list->joints[i];

        if (!joint_holds(list, i) || connect_is_member(s, j->a) == connect_is_member(s, j->b)) {
            continue;
        }
        if (!connect_is_member(s, j->a) && connect_answers(s, j->a)) {
            return j->a;
        }
        if (!connect_is_member(s, j->b) && connect_answers(s, j->b)) {
            return j->b;
        }
    }
    return ISLAND_END;
}

/* ---------------------------------------------------------------------------- end */

/*
 * Make velocities agree with the joints at the bodies' final places, in groups that nothing
 * touched.
 */
static void project(struct step *s)
{
    struct joint_list *list = &s->w->rest.joints;
    bool any = false;

    for (uint32_t i = 0; i < list->count; i++) {
        struct joint *j = &list->joints[i];

        j->chosen = joint_holds(list, i) && connect_group_is_free(s, s->w->bodies[j->a].def.joined);
        any = any || j->chosen;
        place_sides(s, j);
    }
    if (any) {
        s->now_q30 = CAROM_ONE_Q30;
        connect_measure(s, JOINT_PROJECT);
        PHASE_BEGIN(s->w->scratch_phase, WORLD_SOLVE);
        rest_project(&s->w->rest);
        /* a solve leaves no path, and a body that falls asleep needs one */
        for (uint32_t i = 0; i < list->count; i++) {
            place_sides(s, &list->joints[i]);
        }
    }
}

/* Break the joints whose impulse exceeded their limit. */
static int break_joints(struct step *s)
{
    struct joint_list *list = &s->w->rest.joints;
    int result = CAROM_OK;

    for (uint32_t i = 0; i < list->count && result == CAROM_OK; i++) {
        const struct joint *j = &list->joints[i];
        struct joint_state *state = &s->next->joints[i];

        if (joint_holds(list, i) && j->most_impulse_q40 > 0 &&
            fix_length(state->push.c) > j->most_impulse_q40) {
            state->broken = 1;
            memset(state->impulse_q40, 0, sizeof state->impulse_q40);
            step_add_event(s->w, CAROM_EVENT_BREAK, (uint16_t)i, 0);
            s->broke = true;
            world_write_off(s->w, s->next->joints, j);
            result = world_part_joint(s->w, s->next, j);
        }
    }
    return result;
}

/* --------------------------------------------------------------------------- calls */

static void forget_body(struct carom_world *w, uint16_t body)
{
    for (uint32_t i = 0; i < w->rest.joints.count; i++) {
        const struct joint *j = &w->rest.joints.joints[i];

        if (j->used && (j->a == body || j->b == body)) {
            world_drop_joint(w, i);
        }
    }
    world_group_joints(w);
}

const struct step_joint_calls step_joint_calls = {
    .begin = begin,
    .slice = connect_slice,
    .choose_all = choose_all,
    .choose_members = choose_members,
    .connected = connected,
    .measure = connect_measure,
    .project = project,
    .break_joints = break_joints,
    .add_joints2 = connect_add_joints2,
    .owed2 = connect_owed2,
    .conserve = connect_conserve,
    .ground = connect_ground,
    .led_by = connect_find_led,
    .block_leaders = connect_block_leaders,
    .yield = connect_yield,
    .keep_awake = connect_keep_awake,
    .wake_led = connect_wake_led,
    .forget_body = forget_body,
    .regroup = world_group_joints,
    .plausible = world_joint_plausible,
};
