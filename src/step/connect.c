/* SPDX-License-Identifier: MIT */
/*
 * Joints in a step. What joints connect sets out together: when one body of a group hits or ends its slice, all leave their
 * paths and their joints are solved. A solve asks where anchors and axes are going to be at the end of the slice, on the
 * paths that the bodies would take, and changes velocities so that they are where they belong there. As paths bend this is
 * asked again for the paths after the solve, until what is left is a small part of a skin.
 *
 * At the end of a frame velocities are made to agree with the joints where the bodies are then, and energy is made good:
 * energy.c.
 */
#include "../world/joints.h"
#include "parts.h"

/* A slice shorter than this is not measured: what a row does in it is lost in the last places of positions. */
#define MEASURED_MIN_Q30 (CAROM_ONE_Q30 / 32)
/* Where an anchor is off it comes back in a part of a frame that is no shorter than this. */
#define RECOVERY_MIN_Q30 (CAROM_ONE_Q30 / 4)
/* What is left at the end of a slice: this part of a skin. */
#define LEFT_DIVISOR 8
/* A kinematic body that would leave so many skins stops. */
#define TORN_SKINS 4

/* A body of a joint that moves and is awake; JOINT_WORLD and kinematic bodies do not answer. */
static bool answers(const struct step *s, uint16_t body)
{
    return body != JOINT_WORLD && s->w->bodies[body].moving && step_active(s, body);
}

/* The kinematic body of a joint that is on its way; NULL: there is none. */
static const struct body *led_by(const struct step *s, const struct joint *j)
{
    const struct body *b = j->b == JOINT_WORLD ? NULL : &s->w->bodies[j->b];

    return b && body_travels(b) && !b->stands ? b : NULL;
}

/* ------------------------------------------------------------------------ slices */

/* What joints hold turns by so much in a slice at most: anchors part by what that bends, and solves see it as straight. */
#define TURN_MOST_Q30 (CAROM_ONE_Q30 / 8)

/* As much of a time as a spin may go on for. */
static int32_t slice_of_spin(const carom_v3_q40 *spin, int32_t left_q30)
{
    int64_t rate_q40 = fix_length(spin->c);

    return fix_mul_q30(rate_q40, left_q30) > (int64_t)TURN_MOST_Q30 << 10
               ? (int32_t)(((int64_t)TURN_MOST_Q30 << 30) / (rate_q40 >> 10))
               : left_q30;
}

/* The longest slice of a body by itself. */
static int32_t own_slice(const struct body *b, const struct body_state *state, int32_t left_q30)
{
    carom_m3_q30 r;
    carom_v3_q40 spin;

    fix_matrix(&r, &state->rotation);
    body_spin(b, state, &r, &spin);
    return slice_of_spin(&spin, left_q30) >> (2 * b->shorter);
}

/* The longest slice by the kinematic bodies that lead a group. */
static int32_t led_slice(const struct step *s, uint16_t group, int32_t left_q30)
{
    const struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        const struct joint *j = &list->joints[i];
        const struct body *led = joint_holds(list, i) ? led_by(s, j) : NULL;

        if (led && s->w->bodies[j->a].joined == group) {
            left_q30 = slice_of_spin(&led->extra->route.spin, left_q30);
        }
    }
    return left_q30;
}

static int32_t slice(const struct step *s, uint32_t i, int32_t left_q30)
{
    uint16_t group = s->w->bodies[i].joined;
    int32_t least_q30 = led_slice(s, group, left_q30);

    for (uint32_t k = 0; k < s->w->body_count && group != BODY_ALONE; k++) {
        if (s->w->bodies[k].mesh && s->w->bodies[k].joined == group && step_active(s, k) &&
            step_in_range(&s->w->bodies[k], &s->next->bodies[k])) {
            int32_t own_q30 = own_slice(&s->w->bodies[k], &s->next->bodies[k], left_q30);
            least_q30 = own_q30 < least_q30 ? own_q30 : least_q30;
        }
    }
    return least_q30;
}

/* ----------------------------------------------------------------------- measure */

/* Where a kinematic body is at a time: its route goes on as it does now. */
static struct joint_pose led_pose(struct step *s, uint16_t i, int32_t t_q30)
{
    struct body *b = &s->w->bodies[i];
    int32_t slice_q30 = CAROM_ONE_Q30 >> b->extra->route.slice_bits, from_q30 = b->to_q30;
    bool placed = b->placed;
    struct body_state state;

    step_look_away(s, i);
    state = step_state_at(s, i, t_q30 < from_q30 ? t_q30 : from_q30);
    for (; from_q30 < t_q30; from_q30 += slice_q30) {
        int32_t part_q30 = t_q30 - from_q30 < slice_q30 ? t_q30 - from_q30 : slice_q30;

        body_follow(b, &state);
        body_advance(b, &state, part_q30 << b->extra->route.slice_bits, slice_q30, NULL);
    }
    step_look_away(s, i);
    if (placed) {
        step_look_at(s, i, s->now_q30);
    }
    return (struct joint_pose){state.position, state.rotation};
}

/* Where a body is, or is going to be at the end of a slice that begins now. */
static struct joint_pose pose_of(struct step *s, uint16_t i, int32_t slice_q30)
{
    struct joint_pose pose = world_joint_pose(s->next->bodies, i);

    if (i != JOINT_WORLD && body_travels(&s->w->bodies[i]) && !s->w->bodies[i].stands) {
        return led_pose(s, i, s->now_q30 + slice_q30);
    }
    /* a body that is out of range goes nowhere: it retires when it sets out */
    if (answers(s, i) && slice_q30 > 0 && !s->w->bodies[i].stands &&
        step_in_range(&s->w->bodies[i], &s->next->bodies[i])) {
        struct body *b = &s->w->bodies[i];
        carom_v3_q32 way;

        body_predict(b, &s->next->bodies[i], slice_q30, b->in_contact ? NULL : &b->acceleration);
        way = body_way_at(b, CAROM_ONE_Q30);
        pose.rotation = body_rotation_at(b, CAROM_ONE_Q30);
        for (int k = 0; k < 3; k++) {
            pose.position.c[k] += way.c[k];
        }
        body_place(b, &s->next->bodies[i]);
    }
    return pose;
}

/* v over a time of the frame. */
static int64_t per_frame(int64_t v_q40, int32_t time_q30)
{
    struct fix_scaled by = fix_ratio(CAROM_ONE_Q30, time_q30);

    return fix_mul_scaled(v_q40, by);
}

/*
 * A spring over the frame: half of the change of the coordinate comes on top of where it is now. False when it has
 * neither stiffness nor damping.
 */
static bool measure_spring(struct joint_work *w, const struct carom_joint_drive *d, int64_t now_q40,
                           int64_t rate_q40)
{
    int64_t off_q40 = now_q40 - carom_shl(d->rest_q32, 8);
    struct fix_wide pull = fix_wide_mul(d->stiffness_q40, off_q40);
    struct fix_scaled loose; /* the velocity that leads to no pull: q80 over q40 */

    w->half_stiff_q40 = d->stiffness_q40 / 2;
    w->stiff_q40 = w->half_stiff_q40 + d->damping_q40;
    if (w->stiff_q40 == 0) {
        return false;
    }
    loose = fix_wide_over(&pull, w->stiff_q40);
    w->spring_q40 = -rate_q40 - fix_mul_scaled(1, loose);
    w->elastic_q40 = joint_product_q40(d->stiffness_q40, off_q40) +
                     joint_product_q40(w->half_stiff_q40, rate_q40);
    w->least_q40 += carom_abs(w->spring_q40);
    return true;
}

/* A slice as long as joints come back in at the soonest from where they are off. */
static int32_t recovery(int32_t slice_q30)
{
    return slice_q30 > RECOVERY_MIN_Q30 ? slice_q30 : RECOVERY_MIN_Q30;
}

/*
 * By how much V of a coordinate must change so that it gets to a limit that leaves it so much room. From beyond it comes
 * back no sooner than anchors do: in a short slice that would throw it back.
 */
static int64_t to_limit(int64_t room_q40, bool beyond, int64_t change_q40, int32_t time_q30)
{
    return per_frame(room_q40, beyond ? recovery(time_q30) : time_q30) -
           per_frame(change_q40, time_q30);
}

/* Limits, motor and spring of a coordinate, which changes by change_q40 in the slice. */
static void measure_drive(struct joint *j, const struct joint_state *state, int64_t now_q40,
                          int64_t change_q40, int32_t slice_q30, enum joint_solve solve)
{
    const struct carom_joint_drive *d = &state->drive;
    struct joint_work *w = &j->work;
    int32_t time_q30 = slice_q30 > MEASURED_MIN_Q30 ? slice_q30 : MEASURED_MIN_Q30;

    w->law.lower = w->law.upper = d->limited && solve != JOINT_PROJECT;
    w->law.motor = d->motor && solve == JOINT_FRAME;
    w->least_q40 = 0;
    if (d->limited) {
        int64_t below_q40 = carom_shl(d->lower_q32, 8) - now_q40;
        int64_t above_q40 = carom_shl(d->upper_q32, 8) - now_q40;

        w->low_q40 = to_limit(below_q40, below_q40 > 0, change_q40, time_q30);
        w->high_q40 = to_limit(above_q40, above_q40 < 0, change_q40, time_q30);
        w->least_q40 = w->low_q40 > 0 ? w->low_q40 : w->high_q40 < 0 ? -w->high_q40 : 0;
    }
    if (w->law.motor) {
        w->most_q40 = d->motor_most_q40;
        w->least_q40 += carom_abs(d->motor_speed_q40);
    }
    w->law.spring = d->spring && solve == JOINT_FRAME &&
                    measure_spring(w, d, now_q40, per_frame(change_q40, time_q30));
}

/* Rows of a joint as its bodies are, and what they lack on the way to the end of the slice. Whether more than a little. */
static bool measure_one(struct step *s, uint32_t i, enum joint_solve solve)
{
    struct joint *j = &s->w->rest.joints.joints[i];
    const struct joint_state *state = &s->next->joints[i];
    struct joint_work *w = &j->work;
    int32_t left_q30 = CAROM_ONE_Q30 - s->now_q30, slice_q30 = left_q30;
    const uint16_t side[2] = {j->a, j->b};
    struct joint_pose now[2], then[2];
    struct joint_error at, to;
    int64_t off_q40 = 0, skin_q40 = INT64_MAX;

    w->led = led_by(s, j);
    for (int k = 0; k < 2; k++) {
        bool own = answers(s, side[k]) && !s->w->bodies[side[k]].stands;

        w->lever[k].body = answers(s, side[k]) ? &s->w->bodies[side[k]] : NULL;
        if (own) {
            slice_q30 = slice(s, side[k], slice_q30);
            skin_q40 = carom_shl(s->w->bodies[side[k]].skin_q22, 18) < skin_q40
                           ? carom_shl(s->w->bodies[side[k]].skin_q22, 18)
                           : skin_q40;
        }
        now[k] = pose_of(s, side[k], 0);
    }
    for (int k = 0; k < 2; k++) {
        then[k] = pose_of(s, side[k], solve == JOINT_PROJECT ? 0 : slice_q30);
    }
    joint_set_rows(j, state, now);
    w->idle = !j->chosen || w->rows == 0 || (!w->lever[0].body && !w->lever[1].body);
    joint_measure(j, now, &at);
    joint_measure(j, then, &to);
    w->by_speed = solve == JOINT_PROJECT || slice_q30 < MEASURED_MIN_Q30;
    for (int k = 0; k < w->held; k++) {
        int64_t arm_q30 = (w->angular >> k & 1) != 0 ? s->w->bodies[j->a].radius_q22 : 1 << 22;
        int64_t left_q40 = w->by_speed ? 0 : to.row_q40[k];

        left_q40 = carom_abs(fix_mul(left_q40, (int32_t)arm_q30, 22));
        off_q40 = left_q40 > off_q40 ? left_q40 : off_q40;
        w->wanted_q40[k] =
            solve == JOINT_PROJECT ? 0 : -per_frame(at.row_q40[k], recovery(slice_q30));
        if (!w->by_speed) {
            w->wanted_q40[k] -= per_frame(to.row_q40[k] - at.row_q40[k], slice_q30);
        }
    }
    if (w->held < w->rows) {
        int64_t change_q40 = to.coordinate_q40 - at.coordinate_q40;

        if (j->kind == CAROM_JOINT_HINGE) {
            change_q40 = joint_turned_q40(at.coordinate_q40, to.coordinate_q40);
        }
        measure_drive(j, state, at.coordinate_q40, change_q40, slice_q30, solve);
    }
    w->torn = !w->by_speed && off_q40 > TORN_SKINS * skin_q40;
    return off_q40 > skin_q40 / LEFT_DIVISOR;
}

static bool measure(struct step *s, enum joint_solve solve)
{
    bool more = false;

    s->w->rest.joints.solve = solve;
    for (uint32_t i = 0; i < s->w->rest.joints.count; i++) {
        struct joint *j = &s->w->rest.joints.joints[i];

        j->work.idle = true;
        if (j->chosen && joint_holds(&s->w->rest.joints, i)) {
            more = measure_one(s, i, solve) || more;
        }
    }
    return more;
}

/* ------------------------------------------------------------------------ choose */

static void begin(struct step *s)
{
    struct joint_list *list = &s->w->rest.joints;

    list->states = s->next->joints;
    memcpy(s->next->joints, world_now(s->w)->joints, list->count * sizeof *list->states);
    for (uint32_t i = 0; i < list->count; i++) {
        struct joint_state *state = &list->states[i];

        if (list->joints[i].used && answers(s, list->joints[i].a)) {
            memset(&state->push, 0, sizeof state->push);
            memset(&state->moment, 0, sizeof state->moment);
            state->axial_q40 = 0;
        }
    }
}

/* Bodies of a chosen joint are looked at where they are. */
static void place_sides(struct step *s, const struct joint *j)
{
    const uint16_t side[2] = {j->a, j->b};

    for (int k = 0; k < 2; k++) {
        if (j->chosen && answers(s, side[k])) {
            body_place(&s->w->bodies[side[k]], &s->next->bodies[side[k]]);
        }
    }
}

/* All joints of bodies that are awake. */
static bool choose_all(struct step *s)
{
    struct joint_list *list = &s->w->rest.joints;
    bool any = false;

    for (uint32_t i = 0; i < list->count; i++) {
        struct joint *j = &list->joints[i];

        j->chosen = joint_holds(list, i) && (answers(s, j->a) || answers(s, j->b));
        any = any || j->chosen;
        place_sides(s, j);
    }
    return any;
}

static bool is_member(const struct step *s, uint16_t body)
{
    return body != JOINT_WORLD && s->w->bodies[body].member;
}

static void choose_members(struct step *s)
{
    struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        struct joint *j = &list->joints[i];

        j->chosen = joint_holds(list, i) && (is_member(s, j->a) || is_member(s, j->b));
    }
}

/* A body that is connected with a member and is none; ISLAND_END when there is none. */
static uint32_t connected(const struct step *s)
{
    const struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        const struct joint *j = &list->joints[i];

        if (!joint_holds(list, i) || is_member(s, j->a) == is_member(s, j->b)) {
            continue;
        }
        if (!is_member(s, j->a) && answers(s, j->a)) {
            return j->a;
        }
        if (!is_member(s, j->b) && answers(s, j->b)) {
            return j->b;
        }
    }
    return ISLAND_END;
}

/* ---------------------------------------------------------------------------- end */

/* Whether nothing touched the bodies that joints connect with one, and all of them went their way. */
static bool group_is_free(const struct step *s, uint16_t group)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        const struct body *b = &s->w->bodies[i];

        if (b->mesh && b->joined == group && (!step_active(s, i) || b->in_contact || b->stands)) {
            return false;
        }
    }
    return true;
}

/* Velocities as the joints have them where the bodies are at the end, in groups that nothing touched. */
static void project(struct step *s)
{
    struct joint_list *list = &s->w->rest.joints;
    bool any = false;

    for (uint32_t i = 0; i < list->count; i++) {
        struct joint *j = &list->joints[i];

        j->chosen = joint_holds(list, i) && group_is_free(s, s->w->bodies[j->a].joined);
        any = any || j->chosen;
        place_sides(s, j);
    }
    if (any) {
        s->now_q30 = CAROM_ONE_Q30;
        measure(s, JOINT_PROJECT);
        PHASE_BEGIN(s->w->scratch_phase, WORLD_SOLVE);
        rest_project(&s->w->rest);
        for (uint32_t i = 0; i < list->count; i++) {
            place_sides(
                s, &list->joints[i]); /* a solve leaves no path, and what falls asleep needs one */
        }
    }
}

/* Joints that took more than they bear hold nothing any more. */
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
            result = world_part_joint(s->w, s->next, j);
        }
    }
    return result;
}

/* ------------------------------------------------------------------------- energy */

/* Add `times` twice what a spring has stored: k x^2, q80. */
static void add_spring2(struct fix_wide *sum, const struct joint *j,
                        const struct joint_state *state, const struct body_state *bodies, int times)
{
    struct joint_pose pose[2] = {world_joint_pose(bodies, j->a), world_joint_pose(bodies, j->b)};
    struct joint_error error;
    struct fix_wide pull;
    int64_t x_q40;

    joint_measure(j, pose, &error);
    x_q40 = error.coordinate_q40 - carom_shl(state->drive.rest_q32, 8);
    pull = fix_wide_mul(state->drive.stiffness_q40, x_q40);
    fix_wide_add_product(sum, fix_wide_shift(&pull, 40), times * x_q40);
}

/* Add what springs of an island have taken up in the frame. */
static void add_springs2(const struct step *s, uint32_t first, struct fix_wide *sum)
{
    const struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        const struct joint *j = &list->joints[i];

        if (joint_holds(list, i) && s->w->bodies[j->a].island == first &&
            s->next->joints[i].drive.spring) {
            add_spring2(sum, j, &list->states[i], s->next->bodies, 1);
            add_spring2(sum, j, &list->states[i], world_now(s->w)->bodies, -1);
        }
    }
}

/* What the joints of an island owe, of which the first is to keep what is left. */
static struct fix_wide *owed2(const struct step *s, uint32_t first)
{
    const struct joint_list *list = &s->w->rest.joints;
    struct joint_state *keeper = NULL;

    for (uint32_t i = 0; i < list->count; i++) {
        if (joint_holds(list, i) && s->w->bodies[list->joints[i].a].island == first) {
            struct joint_state *state = &list->states[i];

            if (!keeper) {
                keeper = state;
            } else {
                fix_wide_add(&keeper->owed2, &state->owed2);
                state->owed2 = (struct fix_wide){0, 0};
            }
        }
    }
    return keeper ? &keeper->owed2 : NULL;
}

/* Whether a joint holds a body to a kinematic one that travels. */
static bool is_led(const struct step *s, uint32_t i)
{
    const struct joint_list *list = &s->w->rest.joints;
    const struct joint *j = &list->joints[i];

    return joint_holds(list, i) && j->b != JOINT_WORLD && body_travels(&s->w->bodies[j->b]);
}

static uint32_t find_led(const struct step *s, uint32_t first, uint32_t led)
{
    const struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        const struct joint *j = &list->joints[i];

        if (is_led(s, i) && s->w->bodies[j->a].island == first &&
            (led == ISLAND_END || j->b == led)) {
            return j->a;
        }
    }
    return ISLAND_END;
}

/* What leads members stops. */
static void block_leaders(struct step *s)
{
    const struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        if (is_led(s, i) && is_member(s, list->joints[i].a)) {
            step_block(s, list->joints[i].b, list->joints[i].a);
        }
    }
}

/* Kinematic bodies that lead a group stop. */
static bool block_group(struct step *s, uint16_t group)
{
    const struct joint_list *list = &s->w->rest.joints;
    bool any = false;

    for (uint32_t i = 0; i < list->count; i++) {
        const struct joint *j = &list->joints[i];

        if (s->w->bodies[j->a].joined == group && joint_holds(list, i) && led_by(s, j)) {
            step_block(s, j->b, j->a);
            any = true;
        }
    }
    return any;
}

/*
 * Kinematic bodies that lead others where these cannot go stop: what a solve has left over of a joint of theirs is more
 * than some skins. Whether any did.
 */
static bool yield(struct step *s)
{
    const struct joint_list *list = &s->w->rest.joints;
    bool any = false;

    for (uint32_t i = 0; i < list->count; i++) {
        const struct joint *j = &list->joints[i];

        if (!j->work.idle && j->work.torn) {
            any = block_group(s, s->w->bodies[j->a].joined) || any;
        }
    }
    return any;
}

/*
 * Bodies that hang on what does not answer are grounded; those that hang on a kinematic body are touched as well: it
 * gives them whatever energy its way takes, and to keep theirs would hold it back.
 */
static void ground(struct step *s)
{
    const struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        const struct joint *j = &list->joints[i];

        if (joint_holds(list, i) && (j->b == JOINT_WORLD || !s->w->bodies[j->b].moving)) {
            s->w->bodies[j->a].grounded = true;
            s->w->bodies[j->a].touched |= is_led(s, i);
        }
    }
}

/* What a kinematic body leads along has not been quiet. */
static void keep_awake(struct step *s)
{
    const struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        if (is_led(s, i)) {
            s->next->bodies[list->joints[i].a].quiet = 0;
        }
    }
}

/* --------------------------------------------------------------------------- calls */

static void wake_led(struct carom_world *w, uint16_t body)
{
    for (uint32_t i = 0; i < w->rest.joints.count; i++) {
        if (joint_holds(&w->rest.joints, i) && w->rest.joints.joints[i].b == body) {
            world_wake_joint(w, &w->rest.joints.joints[i]);
        }
    }
}

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
    .slice = slice,
    .choose_all = choose_all,
    .choose_members = choose_members,
    .connected = connected,
    .measure = measure,
    .project = project,
    .break_joints = break_joints,
    .add_springs2 = add_springs2,
    .owed2 = owed2,
    .ground = ground,
    .led_by = find_led,
    .block_leaders = block_leaders,
    .yield = yield,
    .keep_awake = keep_awake,
    .wake_led = wake_led,
    .forget_body = forget_body,
    .regroup = world_group_joints,
    .plausible = world_joint_plausible,
};
