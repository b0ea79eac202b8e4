/* SPDX-License-Identifier: MIT */
/* The joints of an island, as a solve calls them (struct joint_calls). */
#include "joint_parts.h"

#define FOR_JOINTS(r, j) for (struct joint *j = at(r, (r)->joints.first); j; j = at(r, j->next))

static inline struct joint *at(const struct rest *r, uint16_t i)
{
    return i == 0 ? NULL : &r->joints.joints[i - 1];
}

static inline struct joint_state *state_of(const struct rest *r, const struct joint *j)
{
    return &r->joints.states[j - r->joints.joints];
}

static void join(struct rest *r, const struct body_state *states)
{
    for (uint32_t i = 0; i < r->joints.count; i++) {
        const struct joint *j = &r->joints.joints[i];

        if (joint_holds(&r->joints, i) && j->b != JOINT_WORLD &&
            !(states && (states[j->a].out || states[j->b].out))) {
            const struct pair p = {j->a, j->b};

            island_join(r->bodies, &p);
        }
    }
}

/*
 * Join islands by the joints that are solved now: a body that its joints do not move has no
 * velocity loaded.
 */
static void join_solved(struct rest *r)
{
    for (uint32_t i = 0; i < r->joints.count; i++) {
        const struct joint *j = &r->joints.joints[i];

        if (joint_holds(&r->joints, i) && !j->work.idle && j->work.lever[0].body &&
            j->work.lever[1].body) {
            const struct pair p = {j->a, j->b};

            island_join(r->bodies, &p);
        }
    }
}

/* Load velocities of bodies that joints hold, unless a contact has loaded them. */
static void load_velocities(struct rest *r)
{
    for (uint32_t i = 0; i < r->joints.count; i++) {
        const struct joint *j = &r->joints.joints[i];

        for (int s = 0; s < 2 && joint_holds(&r->joints, i) && !j->work.idle; s++) {
            struct body *b = j->work.lever[s].body;
            const struct body_state *state = &r->states[s == 0 ? j->a : j->b];

            if (b && !b->solve.solving) {
                b->solve.solving = true;
                body_velocity(b, state, &b->solve.velocity);
                body_spin(b, state, &b->path.start.r, &b->solve.spin);
            }
        }
    }
}

/* The island of a joint to be solved; one of its bodies may be out of the world. */
static uint16_t island_of(const struct joint *j)
{
    const struct joint_lever *lever = j->work.lever;

    return lever[0].body ? lever[0].body->island.lowest : lever[1].body->island.lowest;
}

static bool take(struct rest *r)
{
    bool idle = true;

    r->joints.first = 0;
    for (uint32_t i = r->joints.count; i-- > 0;) {
        struct joint *j = &r->joints.joints[i];

        if (joint_holds(&r->joints, i) && !j->work.idle && island_of(j) == r->island) {
            j->next = r->joints.first;
            r->joints.first = (uint16_t)(i + 1);
            idle = false;
        }
    }
    return idle;
}

static bool take_next(struct rest *r)
{
    for (uint32_t i = 0; i < r->joints.count; i++) {
        if (joint_holds(&r->joints, i) && !r->joints.joints[i].work.idle) {
            r->island = island_of(&r->joints.joints[i]);
            r->count = 0;
            return !take(r);
        }
    }
    return false;
}

/*
 * Bodies that joints connect take gravity together; else a body that hangs on others would be left
 * behind.
 */
static void enter(struct rest *r)
{
    bool again = true;

    while (again) {
        again = false;
        for (uint32_t i = 0; i < r->joints.count; i++) {
            const struct joint *j = &r->joints.joints[i];
            struct body *a = &r->bodies[j->a];
            struct body *b = j->b == JOINT_WORLD ? NULL : &r->bodies[j->b];

            if (!joint_holds(&r->joints, i) || !b || !b->def.moving ||
                (a->clock.contact == BODY_ENTERS) == (b->clock.contact == BODY_ENTERS)) {
                continue;
            }
            b = a->clock.contact == BODY_ENTERS ? b : a;
            CAROM_ASSERT(b->clock.contact == BODY_FLIES); /* or its group had entered before */
            b->clock.contact = BODY_ENTERS;
            again = true;
        }
    }
    for (uint32_t i = 0; i < r->joints.count; i++) {
        struct joint *j = &r->joints.joints[i];

        /* b has entered only if a has */
        j->chosen = j->chosen && r->bodies[j->a].clock.contact == BODY_ENTERS;
    }
}

/* The lightest body of the island's joints. */
static const struct body *lightest_of(const struct rest *r)
{
    const struct body *lightest = NULL;

    FOR_JOINTS(r, j)
    {
        for (int s = 0; s < 2; s++) {
            const struct body *b = j->work.lever[s].body;

            if (b && (!lightest || fix_mul_scaled((int64_t)1 << 40, b->def.mass) <
                                       fix_mul_scaled((int64_t)1 << 40, lightest->def.mass))) {
                lightest = b;
            }
        }
    }
    return lightest;
}

static bool prepare(struct rest *r)
{
    const struct body *lightest = lightest_of(r);
    bool fit = true;

    FOR_JOINTS(r, j)
    {
        /* the other half would press what rests on a contact into it at the end of each frame */
        j->work.halved = j->work.halved && r->count == 0;
        fit = joint_prepare(j, &state_of(r, j)->drive, lightest) && fit;
    }
    r->joints.factored = fit && joint_factor(r);
    return fit;
}

static int64_t largest_q40(const struct rest *r)
{
    int64_t most = 0;

    FOR_JOINTS(r, j)
    {
        int64_t own = joint_largest_q40(j);

        most = own > most ? own : most;
    }
    return most;
}

static void drop(struct rest *r)
{
    FOR_JOINTS(r, j)
    {
        memset(j->work.impulse, 0, sizeof j->work.impulse);
    }
}

static void begin(struct rest *r, const struct rest_sweep *sw)
{
    FOR_JOINTS(r, j)
    {
        joint_begin(j, state_of(r, j), sw);
    }
    drop(r);
}

static void load_warm(struct rest *r, const struct rest_sweep *sw)
{
    FOR_JOINTS(r, j)
    {
        joint_load(j, state_of(r, j), sw);
    }
}

static void enlarge(struct rest *r, const struct rest_sweep *sw, int bits)
{
    FOR_JOINTS(r, j)
    {
        joint_begin(j, state_of(r, j), sw);
        for (int i = 0; i < j->work.rows; i++) {
            j->work.impulse[i] /= (int64_t)1 << bits;
        }
    }
}

/*
 * First each joint with a driven coordinate, or each joint if there was no room to factor; then all
 * held rows at once.
 */
static int64_t sweep(struct rest *r, int32_t quiet)
{
    int64_t most = 0;

    FOR_JOINTS(r, j)
    {
        if (!r->joints.factored || j->work.held < j->work.rows) {
            int64_t moved = joint_sweep(j, quiet);

            most = moved > most ? moved : most;
        }
    }
    if (r->joints.factored) {
        int64_t moved = joint_solve_held(r, quiet);

        most = moved > most ? moved : most;
    }
    return most;
}

static int64_t agrees(const struct rest *r, int32_t most)
{
    int64_t sum = 0;

    FOR_JOINTS(r, j)
    {
        for (int i = 0; i < j->work.rows; i++) {
            int64_t x = (int64_t)j->work.gain[i] + j->work.way[i];

            if (x > most || x < -most) {
                return INT64_MIN / 2;
            }
            sum += j->work.gain[i] * x >> 13;
        }
    }
    return sum;
}

static void accelerate(struct rest *r, int32_t part_q30)
{
    FOR_JOINTS(r, j)
    {
        struct joint_work *work = &j->work;

        for (int i = 0; i < work->rows; i++) {
            work->way[i] =
                part_q30 == 0 ? 0 : carom_mul_q30(work->way[i] + work->gain[i], part_q30);
            work->impulse[i] += work->way[i];
            work->gain[i] = 0;
        }
    }
}

static void end(struct rest *r, const struct rest_sweep *sw)
{
    FOR_JOINTS(r, j)
    {
        joint_end(j, sw);
    }
}

static void apply(struct rest *r)
{
    FOR_JOINTS(r, j)
    {
        joint_apply(r, j);
    }
}

/* A velocity that is booked, q40; a body this fast is out of range, and freezes. */
#define BOOKED_BITS 60

/* Reload the velocities of a joint's bodies after a solve. */
static void refresh(const struct rest *r, struct joint *j)
{
    for (int s = 0; s < 2; s++) {
        struct body *b = j->work.lever[s].body;

        if (b) {
            body_velocity(b, &r->states[s == 0 ? j->a : j->b], &b->solve.velocity);
            body_spin(b, &r->states[s == 0 ? j->a : j->b], &b->path.start.r, &b->solve.spin);
            for (int k = 0; k < 3; k++) {
                b->solve.velocity.c[k] = joint_limited(b->solve.velocity.c[k], BOOKED_BITS);
            }
        }
    }
}

/* A part of a spring's last pull was taken back. */
static void take_back(struct joint_work *work)
{
    struct fix_scaled part = fix_ratio(work->back_q30, work->given_q30);

    work->second_q40 -= fix_mul_scaled(work->second_q40, part);
    work->given_q40 += work->push_q40;
    work->given_q30 -= work->back_q30;
    work->pulled_q30 -= work->back_q30;
}

/*
 * Book the work of the last row's impulse: that which a motor does, and apart from it that of limits and
 * damping. In an island with contacts, work against a motor counts as theirs: a contact that the motor
 * presses opens a gap. A spring's own is not booked, since add_joints2 counts what it stores.
 */
static void book_drive(const struct rest *r, struct joint *j)
{
    struct joint_work *work = &j->work;
    struct body *own = work->lever[0].body ? work->lever[0].body : work->lever[1].body;
    int last = work->rows - 1;
    int64_t before_q40 = work->speed_q40[last], p_q40 = work->row_q40[last];
    int64_t after_q40 = joint_speed_q40(work, last);

    if (work->law.spring) {
        int64_t pull_q40 =
            -work->elastic_q40 - joint_product_q40(work->half_stiff_q40, after_q40 - before_q40);

        if (work->back_q30 > 0) {
            take_back(work);
        } else {
            /* a limit may have given a part of the impulse; a motor is not beside a spring */
            work->given_q40 = work->law.lower ? pull_q40 : p_q40 - work->push_q40;
            work->given_q30 = work->pull_q30;
            work->pulled_q30 += work->pull_q30;
            work->second_q40 = work->halved ? pull_q40 : 0;
        }
        p_q40 -= pull_q40 + work->push_q40;
    }
    if (work->law.motor) {
        bool limited = work->law.lower; /* and upper: then a limit may have given a part of it */
        int64_t motor_q40 = limited && p_q40 > work->most_q40    ? work->most_q40
                            : limited && p_q40 < -work->most_q40 ? -work->most_q40
                                                                 : p_q40;

        if (r->count == 0 || (motor_q40 < 0) == (before_q40 + after_q40 < 0)) {
            fix_wide_add_product(&own->solve.work2, motor_q40, before_q40 + after_q40);
            p_q40 -= motor_q40;
        }
    }
    fix_wide_add_product(&work->given2, p_q40, before_q40 + after_q40);
}

/*
 * Book the work of a kinematic body through a joint. An impulse P changes twice the kinetic energy
 * of the bodies that answer by P (V + V'), without the kinematic body's part of V. book_drive books
 * the other half of the last row.
 */
static void book_led(struct rest *r, const struct joint *j)
{
    const struct joint_work *work = &j->work;
    struct fix_wide *sum = &r->bodies[j->a].solve.work2;

    for (int i = 0; i < work->rows; i++) {
        fix_wide_add_product(sum, work->row_q40[i], -2 * joint_led_speed_q40(work, i));
        if (i < work->held) {
            fix_wide_add_product(sum, work->row_q40[i],
                                 work->speed_q40[i] + joint_speed_q40(work, i));
        }
    }
}

static void book(struct rest *r)
{
    FOR_JOINTS(r, j)
    {
        struct joint_state *state = state_of(r, j);
        struct joint_work *work = &j->work;

        work->idle = true;
        for (int k = 0; k < 3; k++) {
            state->push.c[k] = joint_limited(state->push.c[k] + work->push.c[k], 60);
            state->moment.c[k] = joint_limited(state->moment.c[k] + work->moment.c[k], 60);
        }
        state->axial_q40 = joint_limited(
            state->axial_q40 + (work->held < work->rows ? work->row_q40[work->held] : 0), 60);
        refresh(r, j);
        if (work->held < work->rows && r->joints.solve != JOINT_PROJECT) {
            book_drive(r, j);
        }
        if (work->led) {
            book_led(r, j);
        }
        for (int i = 0; i < JOINT_ROWS && r->joints.solve <= JOINT_MORE; i++) {
            int64_t kept = r->joints.solve == JOINT_MORE ? state->impulse_q40[i] : 0;

            state->impulse_q40[i] =
                joint_limited(kept + (i < work->rows ? work->row_q40[i] : 0), 60);
        }
    }
}

const struct joint_calls joint_calls = {
    .join = join,
    .join_solved = join_solved,
    .load_velocities = load_velocities,
    .enter = enter,
    .take = take,
    .take_next = take_next,
    .prepare = prepare,
    .largest_q40 = largest_q40,
    .begin = begin,
    .load_warm = load_warm,
    .enlarge = enlarge,
    .sum_up = joint_sum_up,
    .drop = drop,
    .sweep = sweep,
    .agrees = agrees,
    .accelerate = accelerate,
    .end = end,
    .apply = apply,
    .book = book,
};
