/* SPDX-License-Identifier: MIT */
/* Where joints will be at the end of a slice, and by how much velocities must change for that. */
#include "connect.h"

/* Part of a time over which a spin turns by at most STEP_JOINT_TURN_Q30. */
static int32_t slice_of_spin(const carom_v3_q40 *spin, int32_t left_q30)
{
    int64_t rate_q40 = fix_length(spin->c);

    return fix_mul_q30(rate_q40, left_q30) > (int64_t)STEP_JOINT_TURN_Q30 << 10
               ? (int32_t)(((int64_t)STEP_JOINT_TURN_Q30 << 30) / (rate_q40 >> 10))
               : left_q30;
}

/* Longest slice of a body by itself. */
static int32_t own_slice(const struct body *b, const struct body_state *state, int32_t left_q30)
{
    carom_m3_q30 r;
    carom_v3_q40 spin;

    fix_matrix(&r, &state->rotation);
    body_spin(b, state, &r, &spin);
    return slice_of_spin(&spin, left_q30) >> (2 * b->clock.shorter);
}

/* Longest slice by the pull of a spring: to its end, or to the end of the next one. */
static int32_t pulled_slice(const struct step *s, const struct joint *j, int32_t left_q30)
{
    int32_t most_q30 = j->work.pulled_q30 - s->now_q30;

    most_q30 = most_q30 < STEP_SLICE_MIN_Q30 ? j->work.pull_most_q30 : most_q30;
    return most_q30 < left_q30 ? most_q30 : left_q30;
}

/* Longest slice by the springs of a group, and by the kinematic bodies that lead it. */
static int32_t drive_slice(const struct step *s, uint16_t group, int32_t left_q30)
{
    const struct joint_list *list = &s->w->rest.joints;

    for (uint32_t i = 0; i < list->count; i++) {
        const struct joint *j = &list->joints[i];
        const struct body *led;

        if (!joint_holds(list, i) || s->w->bodies[j->a].def.joined != group) {
            continue;
        }
        led = connect_led_by(s, j);
        left_q30 = led ? slice_of_spin(&led->def.extra->route.spin, left_q30) : left_q30;
        left_q30 = list->states[i].drive.spring ? pulled_slice(s, j, left_q30) : left_q30;
    }
    return left_q30;
}

int32_t connect_slice(const struct step *s, uint32_t i, int32_t left_q30)
{
    uint16_t group = s->w->bodies[i].def.joined;
    int32_t least_q30 = drive_slice(s, group, left_q30);

    for (uint32_t k = 0; k < s->w->body_count; k++) {
        if (s->w->bodies[k].def.mesh && s->w->bodies[k].def.joined == group && step_active(s, k) &&
            step_in_range(&s->w->bodies[k], &s->next->bodies[k])) {
            int32_t own_q30 = own_slice(&s->w->bodies[k], &s->next->bodies[k], left_q30);
            least_q30 = own_q30 < least_q30 ? own_q30 : least_q30;
        }
    }
    return least_q30;
}

bool connect_group_is_free(const struct step *s, uint16_t group)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        const struct body *b = &s->w->bodies[i];

        if (b->def.mesh && b->def.joined == group &&
            (!step_active(s, i) || b->clock.contact != BODY_FLIES || b->clock.stands ||
             b->clock.pressed)) {
            return false;
        }
    }
    return true;
}

/* ----------------------------------------------------------------------- measure */

/* Pose of a kinematic body at a time, if its route continues as it does now. */
static struct joint_pose led_pose(struct step *s, uint16_t i, int32_t t_q30)
{
    struct body *b = &s->w->bodies[i];
    int32_t slice_q30 = CAROM_ONE_Q30 >> b->def.extra->route.slice_bits, from_q30 = b->clock.to_q30;
    bool placed = b->clock.placed;
    struct body_state state;

    step_look_away(s, i);
    state = step_state_at(s, i, t_q30 < from_q30 ? t_q30 : from_q30);
    for (; from_q30 < t_q30; from_q30 += slice_q30) {
        int32_t part_q30 = t_q30 - from_q30 < slice_q30 ? t_q30 - from_q30 : slice_q30;

        body_follow(b, &state);
        body_advance(b, &state, part_q30 << b->def.extra->route.slice_bits, slice_q30, NULL);
    }
    step_look_away(s, i);
    if (placed) {
        step_look_at(s, i, s->now_q30);
    }
    return (struct joint_pose){state.position, state.rotation};
}

/* Pose of a body now, or at the end of a slice that begins now. */
static struct joint_pose pose_of(struct step *s, uint16_t i, int32_t slice_q30)
{
    struct joint_pose pose = world_joint_pose(s->next->bodies, i);

    if (i != JOINT_WORLD && body_travels(&s->w->bodies[i]) && !s->w->bodies[i].clock.stands) {
        return led_pose(s, i, s->now_q30 + slice_q30);
    }
    /* a body out of range goes nowhere: it retires when it sets out */
    if (connect_answers(s, i) && slice_q30 > 0 && !s->w->bodies[i].clock.stands &&
        step_in_range(&s->w->bodies[i], &s->next->bodies[i])) {
        struct body *b = &s->w->bodies[i];
        carom_v3_q32 way;

        body_predict(b, &s->next->bodies[i], slice_q30,
                     b->clock.contact != BODY_FLIES ? NULL : &b->def.acceleration);
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

/* Time in which a joint that is off comes back: the slice, but no less than STEP_RECOVERY_MIN_Q30. */
static int32_t recovery(int32_t slice_q30)
{
    return slice_q30 > STEP_RECOVERY_MIN_Q30 ? slice_q30 : STEP_RECOVERY_MIN_Q30;
}

/*
 * Change of V that takes a coordinate to a limit, room_q40 away. From beyond the limit it comes
 * back no sooner than anchors do: in a short slice it would be thrown back.
 */
static int64_t to_limit(int64_t room_q40, bool beyond, int64_t change_q40, int32_t time_q30)
{
    return per_frame(room_q40, beyond ? recovery(time_q30) : time_q30) -
           per_frame(change_q40, time_q30);
}

/*
 * Measure a spring: it pulls from where it left off to the end of the slice. In a group that flies
 * it gives a half of its impulse at the start of that time, and a half at the end. So it moves its
 * bodies as far as their weight does, which bends their paths; bodies that touch take their weight
 * at the start, too.
 *
 * A body that the pull sets spinning has a shorter slice, and at the end of it the spring has
 * another direction or meets another mass. Then the next round takes back what was given for the
 * time after the slice.
 */
static void measure_spring(const struct step *s, struct joint *j, const struct joint_state *state,
                           int32_t slice_q30, enum joint_solve solve)
{
    struct joint_work *work = &j->work;
    bool flies = connect_group_is_free(s, s->w->bodies[j->a].def.joined);
    bool begins = solve == JOINT_FRAME || solve == JOINT_HIT;
    int32_t over_q30;

    if (work->pulled_q30 == 0) {
        work->pulled_q30 = s->now_q30; /* the group may be awake only now */
    }
    over_q30 = work->pulled_q30 - s->now_q30 - slice_q30;
    work->pull_q30 = begins ? fix_larger(-over_q30, 0) : 0;
    work->ahead_q30 = fix_larger(work->pulled_q30 - s->now_q30, 0);
    work->push_q40 = work->pull_q30 > 0 || !flies || solve == JOINT_PROJECT ? work->second_q40 : 0;
    work->given_q30 = begins ? 0 : work->given_q30;
    work->back_q30 = solve != JOINT_PROJECT && over_q30 > work->given_q30 / STEP_PULL_OVER_DIVISOR
                         ? fix_smaller(over_q30, work->given_q30)
                         : 0;
    if (work->back_q30 > 0) {
        work->push_q40 =
            -fix_mul_scaled(work->given_q40, fix_ratio(work->back_q30, work->given_q30));
    }
    work->halved = flies;
    work->law.spring =
        state->drive.spring && (work->pull_q30 > 0 || work->push_q40 != 0 || work->back_q30 > 0);
}

/*
 * Impulse with which a limit holds its coordinate at the end of a frame; sign: 1 lower, -1 upper.
 * The row's motor presses it there through the whole frame, and so do other joints, by as much as the
 * limit gave when the frame began.
 */
static int64_t held_at(const struct carom_joint_drive *d, int64_t given_q40, int sign)
{
    int64_t limit_q40 = given_q40 * sign, motor_q40 = 0;

    if (d->motor && d->motor_speed_q40 * sign < 0) {
        motor_q40 = d->motor_most_q40;
    } else if (d->motor) {
        limit_q40 -= d->motor_most_q40; /* it leads off, and may have given so much of this */
    }
    return motor_q40 + (limit_q40 > 0 ? limit_q40 : 0);
}

/*
 * At the end of a frame a limit that is closer than close_q40 stops what moves on to it, and holds
 * there. Where both are so close, they stop all.
 */
static void stop_at_limits(struct joint_work *work, const struct joint_state *state,
                           int64_t now_q40, int64_t close_q40)
{
    const struct carom_joint_drive *d = &state->drive;

    work->law.lower = now_q40 - close_q40 < carom_shl(d->lower_q32, 8);
    work->law.upper = now_q40 + close_q40 > carom_shl(d->upper_q32, 8);
    work->most_q40 = held_at(d, state->impulse_q40[work->held], work->law.lower ? 1 : -1);
    work->law.motor = !d->spring && work->law.lower != work->law.upper && work->most_q40 > 0;
}

/*
 * Measure limits, motor and spring of a coordinate that changes by change_q40 in the slice. A motor
 * acts once a frame, a spring in each slice: the pull of a stiff one changes on the way. close_q40 is
 * in the coordinate's unit.
 */
static void measure_drive(const struct step *s, struct joint *j, const struct joint_state *state,
                          int64_t now_q40, int64_t change_q40, int32_t slice_q30, int64_t close_q40,
                          enum joint_solve solve)
{
    const struct carom_joint_drive *d = &state->drive;
    struct joint_work *work = &j->work;
    int32_t time_q30 = slice_q30 > STEP_MEASURED_MIN_Q30 ? slice_q30 : STEP_MEASURED_MIN_Q30;

    work->law.lower = work->law.upper = d->limited;
    work->law.motor = d->motor && solve == JOINT_FRAME;
    work->least_q40 = 0;
    work->stops = solve == JOINT_PROJECT;
    if (d->limited && work->stops) {
        stop_at_limits(work, state, now_q40, close_q40);
    } else if (d->limited) {
        int64_t below_q40 = carom_shl(d->lower_q32, 8) - now_q40;
        int64_t above_q40 = carom_shl(d->upper_q32, 8) - now_q40;

        work->low_q40 = to_limit(below_q40, below_q40 > 0, change_q40, time_q30);
        work->high_q40 = to_limit(above_q40, above_q40 < 0, change_q40, time_q30);
        work->least_q40 = work->low_q40 > 0    ? work->low_q40
                          : work->high_q40 < 0 ? -work->high_q40
                                               : 0;
    }
    if (work->law.motor && !work->stops) {
        work->most_q40 = d->motor_most_q40;
        work->least_q40 += carom_abs(d->motor_speed_q40);
    }
    measure_spring(s, j, state, slice_q30, solve);
    if (d->spring) { /* without one rest_q32 may be anything */
        work->off_q40 = now_q40 - carom_shl(d->rest_q32, 8);
    }
    work->rate_q40 = per_frame(change_q40, time_q30);
}

/* Size of a row's change at the farthest point of body a, in units, q40. */
static int64_t as_way(const struct step *s, const struct joint *j, int row, int64_t v_q40)
{
    bool turns = joint_is_angular(&j->work, row);

    return carom_abs(turns ? fix_mul(v_q40, s->w->bodies[j->a].def.radius_q22, 22) : v_q40);
}

/* Part of the present error that may remain at the end of a slice. */
static int64_t rest_of(int64_t off_q40, int32_t slice_q30)
{
    return off_q40 - fix_mul_scaled(off_q40, fix_ratio(slice_q30, recovery(slice_q30)));
}

/* By how much a coordinate is beyond its limits. */
static int64_t beyond(const struct carom_joint_drive *d, int64_t q_q40)
{
    int64_t below_q40 = carom_shl(d->lower_q32, 8) - q_q40;
    int64_t above_q40 = q_q40 - carom_shl(d->upper_q32, 8);
    int64_t most_q40 = below_q40 > above_q40 ? below_q40 : above_q40;

    return most_q40 > 0 ? most_q40 : 0;
}

/*
 * Set the bodies of a joint that answer. Returns their slice; *skin_q40 becomes the smaller of
 * their skins, or without bound where neither moves.
 */
static int32_t measure_sides(struct step *s, struct joint *j, int64_t *skin_q40)
{
    const uint16_t side[2] = {j->a, j->b};
    int32_t slice_q30 = CAROM_ONE_Q30 - s->now_q30;

    *skin_q40 = INT64_MAX / STEP_TORN_SKINS;
    for (int k = 0; k < 2; k++) {
        struct body *b = connect_answers(s, side[k]) ? &s->w->bodies[side[k]] : NULL;

        j->work.lever[k].body = b;
        if (b && !b->clock.stands) {
            int64_t own_q40 = carom_shl(b->def.skin_q22, 18);

            slice_q30 = connect_slice(s, side[k], slice_q30);
            *skin_q40 = own_q40 < *skin_q40 ? own_q40 : *skin_q40;
        }
    }
    j->work.led = connect_led_by(s, j);
    return slice_q30;
}

/*
 * Set the change of V wanted in the rows that always hold. Returns the largest error at the end of
 * the slice.
 */
static int64_t measure_held(const struct step *s, struct joint *j, const struct joint_error *at,
                            const struct joint_error *to, int32_t slice_q30)
{
    struct joint_work *work = &j->work;
    int64_t most_q40 = 0;

    for (int k = 0; k < work->held; k++) {
        int64_t off_q40 = work->by_speed ? 0 : as_way(s, j, k, to->row_q40[k]);

        most_q40 = off_q40 > most_q40 ? off_q40 : most_q40;
        work->wanted_q40[k] = -per_frame(at->row_q40[k], recovery(slice_q30));
        if (!work->by_speed) {
            work->wanted_q40[k] -= per_frame(to->row_q40[k] - at->row_q40[k], slice_q30);
        }
    }
    return most_q40;
}

/*
 * Set the law of the coordinate. Returns how far beyond its limits it ends on the present paths,
 * less the part that later slices correct.
 */
static int64_t measure_last(const struct step *s, struct joint *j, const struct joint_state *state,
                            const struct joint_error *at, const struct joint_error *to,
                            int32_t slice_q30, int64_t skin_q40, enum joint_solve solve)
{
    const struct carom_joint_drive *d = &state->drive;
    int64_t now_q40 = at->coordinate_q40, change_q40 = to->coordinate_q40 - now_q40, off_q40;

    if (j->kind == CAROM_JOINT_HINGE) {
        change_q40 = joint_turned_q40(now_q40, to->coordinate_q40);
    }
    measure_drive(s, j, state, now_q40, change_q40, slice_q30, skin_q40 / STEP_LEFT_DIVISOR, solve);
    if (!d->limited || j->work.by_speed) {
        return 0;
    }
    off_q40 = beyond(d, now_q40 + change_q40) - rest_of(beyond(d, now_q40), slice_q30);
    return off_q40 > 0 ? as_way(s, j, j->work.held, off_q40) : 0;
}

/*
 * Set the rows of a joint where its bodies are, and its errors at the end of the slice. True if
 * these are large.
 */
static bool measure_one(struct step *s, uint32_t i, enum joint_solve solve)
{
    struct joint *j = &s->w->rest.joints.joints[i];
    const struct joint_state *state = &s->next->joints[i];
    struct joint_work *work = &j->work;
    const uint16_t side[2] = {j->a, j->b};
    struct joint_pose now[2], then[2];
    struct joint_error at, to;
    int64_t held_q40, last_q40 = 0, skin_q40;
    int32_t slice_q30 = measure_sides(s, j, &skin_q40);

    for (int k = 0; k < 2; k++) {
        now[k] = pose_of(s, side[k], 0);
    }
    for (int k = 0; k < 2; k++) {
        then[k] = pose_of(s, side[k], solve == JOINT_PROJECT ? 0 : slice_q30);
    }
    joint_set_rows(j, state, now);
    work->idle = work->rows == 0; /* one of the bodies of a chosen joint is awake */
    joint_measure(j, now, &at);
    joint_measure(j, then, &to);
    work->by_speed = solve == JOINT_PROJECT || slice_q30 < STEP_MEASURED_MIN_Q30;
    held_q40 = measure_held(s, j, &at, &to, slice_q30);
    if (solve == JOINT_PROJECT) {
        memset(work->wanted_q40, 0, sizeof work->wanted_q40);
    }
    if (work->held < work->rows) {
        last_q40 = measure_last(s, j, state, &at, &to, slice_q30, skin_q40, solve);
    }
    work->torn = !work->by_speed && held_q40 > STEP_TORN_SKINS * skin_q40;
    return work->back_q30 > 0 ||
           (held_q40 > last_q40 ? held_q40 : last_q40) > skin_q40 / STEP_LEFT_DIVISOR;
}

/* Note the bodies that contacts press when the frame begins: connect_group_is_free asks. */
static void note_pressed(struct step *s)
{
    const struct contact_list *list = &s->w->rest.list;

    for (uint32_t i = 0; i < list->pool->used; i++) {
        const struct contact *c = &list->contacts[i];
        const struct pair *p = &s->w->pairs[c->key.pair];

        if (!c->idle && rest_along_q40(contact_impulse(c), &c->normal) != 0) {
            s->w->bodies[p->a].clock.pressed = s->w->bodies[p->b].clock.pressed = true;
        }
    }
}

bool connect_measure(struct step *s, enum joint_solve solve)
{
    bool more = false;

    s->w->rest.joints.solve = solve;
    if (solve == JOINT_MORE) { /* after a solve at the start of the frame */
        note_pressed(s);
    }
    for (uint32_t i = 0; i < s->w->rest.joints.count; i++) {
        struct joint *j = &s->w->rest.joints.joints[i];

        j->work.idle = true;
        if (j->chosen) {
            more = measure_one(s, i, solve) || more;
        }
    }
    return more;
}
