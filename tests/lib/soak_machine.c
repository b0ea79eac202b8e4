/* SPDX-License-Identifier: MIT */
/* Machines: the parts that a random world of soak_world.c gets besides bodies, before it starts. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "real.h"
#include "soak.h"

#define ARM_RADII 50 /* anchors are within so many radii of a body */

static struct carom_body_def *def_of(struct soak_world *w, int body)
{
    return &w->crowd->bodies[body].def;
}

static bool moves(struct soak_world *w, int body)
{
    return !def_of(w, body)->stationary && !def_of(w, body)->kinematic;
}

static double radius_of(const struct soak_world *w, int body)
{
    return w->crowd->meshes[w->crowd->bodies[body].mesh].radius;
}

static void stop(struct carom_body_def *def)
{
    memset(&def->velocity, 0, sizeof def->velocity);
    memset(&def->spin, 0, sizeof def->spin);
}

/* ------------------------------------------------------------------ kinds of bodies */

static void lead_some(struct soak_world *w, struct test_random *r)
{
    struct soak_machine *m = w->machine;

    for (int i = m->first; i < w->crowd->body_count; i++) {
        if (soak_pick(r, 4) == 0) {
            def_of(w, i)->kinematic = true;
            stop(def_of(w, i));
            soak_leader_begin(&m->leaders[i], def_of(w, i), fmin(radius_of(w, i), 3), r);
        }
    }
}

/* Put a body near another one; they may overlap. */
static void put_anywhere(struct soak_world *w, int body, struct test_random *r)
{
    int other = soak_pick(r, w->crowd->body_count);
    double far_off = radius_of(w, body) + fmin(radius_of(w, other), 5), at[3];

    for (int k = 0; k < 3; k++) {
        at[k] = real(def_of(w, other)->position.c[k], 32) + far_off * soak_uniform(r, -1, 1);
    }
    crowd_place(def_of(w, body), at[0], at[1], at[2]);
}

static void sense_some(struct soak_world *w, struct test_random *r)
{
    for (int i = w->machine->first; i < w->crowd->body_count; i++) {
        if (moves(w, i) && soak_pick(r, 6) == 0) {
            def_of(w, i)->sensor = true;
            put_anywhere(w, i, r);
            if (soak_pick(r, 2) == 0) {
                def_of(w, i)->stationary = true;
                stop(def_of(w, i));
            }
        }
    }
}

/* A filter for one of three kinds of bodies; the default one is more likely than the others. */
static struct carom_filter any_filter(struct test_random *r)
{
    static const uint16_t masks[] = {0xffff, 0xffff, 7, 1, 3, 6};
    static const int16_t groups[] = {0, 0, 0, 1, -1, -2};
    struct carom_filter filter = {(uint16_t)(1 << soak_pick(r, 3)), masks[soak_pick(r, 6)],
                                  groups[soak_pick(r, 6)]};

    return filter;
}

static void filter_some(struct soak_world *w, struct test_random *r)
{
    for (int i = w->machine->first; i < w->crowd->body_count; i++) {
        if (soak_pick(r, 2) == 0) {
            def_of(w, i)->filter = any_filter(r);
        }
    }
}

static void open_some(struct soak_world *w, struct test_random *r)
{
    for (int i = w->ground == SOAK_OBSTACLES ? 0 : w->machine->first; i < w->crowd->body_count;
         i++) {
        if (soak_pick(r, 4) == 0) {
            def_of(w, i)->one_way = (uint8_t)(1 + soak_pick(r, 6));
        }
    }
}

/* ---------------------------------------------------------------------------- joints */

/*
 * Put a body next to another one: 60 % of the time apart from all bodies, otherwise overlapping the
 * other.
 */
static void put_beside(struct soak_world *w, struct soak_joint *joint, struct test_random *r)
{
    const int a = joint->def.a, b = joint->def.b;
    struct carom_body_def *def = def_of(w, a);
    const carom_v3_q32 was = def->position;
    const bool across = !joint->def.touch && moves(w, b) && soak_pick(r, 5) < 2;
    const double far_off = (radius_of(w, a) + radius_of(w, b)) *
                           (across ? soak_uniform(r, 0.1, 0.6) : soak_uniform(r, 0.6, 1.1));

    for (int tries = 0; tries < 30; tries++) {
        double to[3], at[3];

        soak_direction(r, to);
        for (int k = 0; k < 3; k++) {
            at[k] = real(def_of(w, b)->position.c[k], 32) + far_off * to[k];
        }
        crowd_place(def, at[0], at[1], at[2]);
        if (soak_is_clear(w, a, across ? b : a)) {
            def->overlap = across ? CAROM_OVERLAP_PASS : CAROM_OVERLAP_REFUSE;
            return;
        }
    }
    def->position = was;
}

/* Anchors between two bodies, or near one of them; false when none is within their reach. */
static bool set_anchors(struct soak_world *w, struct soak_joint *joint, struct test_random *r)
{
    const int a = joint->def.a, b = joint->def.b < 0 ? a : joint->def.b;
    double share = soak_uniform(r, 0, 1), off = soak_uniform(r, 0, 0.5), x[2][3], far_off[2][3];

    for (int k = 0; k < 3; k++) {
        const double from = real(def_of(w, a)->position.c[k], 32);
        const double to = real(def_of(w, b)->position.c[k], 32);
        const double at = from + share * (to - from) +
                          off * soak_uniform(r, -1, 1) * (a == b ? 4 : 1) * radius_of(w, a);
        const double other = to + soak_uniform(r, -1, 1) * radius_of(w, b);

        joint->def.anchor.c[k] = lab_fixed(at, 32);
        joint->def.anchor_b.c[k] = lab_fixed(other, 32);
        x[0][k] = at - from;
        x[1][k] = at - to;
        far_off[0][k] = at - other;
        far_off[1][k] = other - to;
    }
    return real_length(x[0]) < ARM_RADII * radius_of(w, a) &&
           real_length(x[1]) < ARM_RADII * radius_of(w, b) &&
           real_length(far_off[1]) < ARM_RADII * radius_of(w, b) &&
           real_length(far_off[0]) > 0.01 * radius_of(w, a);
}

/* Limits around the first coordinate, a motor or a spring, in proportion to the lighter body. */
static void set_drive(struct soak_world *w, struct soak_joint *joint, struct test_random *r)
{
    const struct carom_joint_def *def = &joint->def;
    struct carom_joint_drive *d = &joint->def.drive;
    double size = def->kind == CAROM_JOINT_HINGE ? 1 : radius_of(w, def->a), begin = 0, mass, arm;
    double apart[3];

    if (def->kind == CAROM_JOINT_BALL || def->kind == CAROM_JOINT_FIXED) {
        return;
    }
    for (int k = 0; k < 3; k++) {
        apart[k] = real(def->anchor.c[k] - def->anchor_b.c[k], 32);
    }
    begin = def->kind == CAROM_JOINT_DISTANCE ? real_length(apart) : 0;
    mass = real(def_of(w, def->a)->mass_q20, 20);
    arm = def->kind == CAROM_JOINT_HINGE ? radius_of(w, def->a) * radius_of(w, def->a) : 1;
    d->limited = def->kind == CAROM_JOINT_DISTANCE ? soak_pick(r, 4) > 0 : soak_pick(r, 2) == 0;
    d->lower_q32 = lab_fixed(
        fmax(def->kind == CAROM_JOINT_DISTANCE ? 0 : -3, begin - size * soak_powers(r, 0.01, 3)),
        32);
    d->upper_q32 = lab_fixed(
        fmin(def->kind == CAROM_JOINT_HINGE ? 3 : 1e4, begin + size * soak_powers(r, 0.01, 3)), 32);
    if (d->limited && soak_pick(r, 4) == 0 && def->kind == CAROM_JOINT_DISTANCE) {
        d->lower_q32 = d->upper_q32 = lab_fixed(begin, 32); /* a rod */
    }
    d->motor = w->machine->driven && def->kind != CAROM_JOINT_DISTANCE && soak_pick(r, 3) == 0;
    d->motor_speed_q40 = lab_fixed(soak_uniform(r, -0.3, 0.3) * size, 40);
    d->motor_most_q40 = lab_fixed(mass * arm * soak_powers(r, 1e-6, 0.1), 40);
    d->spring = !d->motor && soak_pick(r, 3) == 0;
    d->rest_q32 = lab_fixed(begin + size * soak_uniform(r, -0.5, 0.5), 32);
    d->stiffness_q40 = lab_fixed(mass * arm * soak_powers(r, 1e-5, 2), 40);
    d->damping_q40 = soak_pick(r, 2) ? 0 : lab_fixed(mass * arm * soak_powers(r, 1e-5, 1), 40);
}

static void fill(struct soak_world *w, struct soak_joint *joint, struct test_random *r)
{
    double axis[3];

    soak_direction(r, axis);
    if (soak_pick(r, 4) == 0) {
        axis[0] = axis[1] = 0;
        axis[2] = soak_pick(r, 2) ? 1 : -1;
    }
    for (int k = 0; k < 3; k++) {
        joint->def.axis.c[k] = (int32_t)real_round(axis[k] * CAROM_ONE_Q30);
    }
    set_drive(w, joint, r);
    if (soak_pick(r, 5) == 0) {
        joint->def.most_impulse_q40 =
            lab_fixed(real(def_of(w, joint->def.a)->mass_q20, 20) * soak_powers(r, 1e-3, 20), 40);
    }
}

/* Largest motion of a body in a frame, in its radii, unless the world is wild. */
#define CALM 0.5
static void calm(struct soak_world *w, int body)
{
    struct carom_body_def *def = def_of(w, body);
    double v[3], spin[3], radius = radius_of(w, body), speed;

    for (int k = 0; k < 3; k++) {
        v[k] = real(def->velocity.c[k], 40);
        spin[k] = real(def->spin.c[k], 40);
    }
    speed = real_length(v) + radius * real_length(spin);
    for (int k = 0; k < 3 && speed > CALM * radius; k++) {
        def->velocity.c[k] = lab_fixed(v[k] * CALM * radius / speed, 40);
        def->spin.c[k] = lab_fixed(spin[k] * CALM * radius / speed, 40);
    }
}

/* The partner of a body's joint: the world, or an earlier body. */
static int partner(const struct soak_machine *m, int body, bool chain, struct test_random *r)
{
    int other;

    if (chain && body > m->first) {
        return body - 1;
    }
    if (body == 0 || soak_pick(r, 4) == 0) {
        return CAROM_WORLD;
    }
    other =
        soak_pick(r, 4) == 0 ? soak_pick(r, body) : m->first + soak_pick(r, body - m->first + 1);
    return other == body ? CAROM_WORLD : other;
}

/* Join a body with an earlier one or with the world; some bodies get two joints. */
static void join_some(struct soak_world *w, struct test_random *r)
{
    struct soak_machine *m = w->machine;
    const bool chain = soak_pick(r, 3) == 0, beside = soak_pick(r, 4) != 0;
    const int share = 1 + soak_pick(r, 4), kind = soak_pick(r, 8);
    int last = -1;

    for (int i = m->first; i < w->crowd->body_count && m->joint_count < SOAK_JOINTS; i++) {
        struct soak_joint *joint = &m->joints[m->joint_count];
        bool again = soak_pick(r, 6) == 0 && i > m->first;

        memset(joint, 0, sizeof *joint);
        if (!moves(w, i) || (!chain && soak_pick(r, 4) >= share)) {
            continue;
        }
        joint->def.kind = (uint8_t)(kind <= CAROM_JOINT_FIXED ? kind : soak_pick(r, 5));
        joint->def.touch = soak_pick(r, 2) == 0;
        joint->def.a = i;
        joint->def.b = partner(m, i, chain, r);
        if (joint->def.b >= m->first && beside && i != last) {
            put_beside(w, joint, r);
        }
        if (!set_anchors(w, joint, r)) {
            continue;
        }
        fill(w, joint, r);
        if (!m->wild) {
            calm(w, i);
            calm(w, joint->def.b < 0 ? i : joint->def.b);
        }
        m->joint_count++;
        last = i;
        i -= again; /* the same body once more */
    }
}

/* ------------------------------------------------------------------------------ all */

void soak_machine_make(struct soak_world *w, bool wild)
{
    struct soak_machine *m = lab_need(sizeof *m);
    struct test_random *r = &m->r;

    w->machine = m;
    w->seen = lab_need(sizeof *w->seen);
    r->state = w->seed * 0xa0761d6478bd642fu;
    m->seed = w->seed;
    m->wild = wild;
    m->first = w->crowd->body_count - w->moving;
    m->driven = soak_pick(r, 3) == 0;
    if (soak_pick(r, 3) == 0) {
        m->led = true;
        lead_some(w, r);
    }
    if (soak_pick(r, 3) == 0) {
        sense_some(w, r);
    }
    if (soak_pick(r, 4) == 0) {
        m->filtered = true;
        filter_some(w, r);
    }
    if (soak_pick(r, 6) == 0) {
        open_some(w, r);
    }
    m->asks = soak_pick(r, 6) == 0;
    m->belts = soak_pick(r, 8) == 0;
    m->damped = soak_pick(r, 8) == 0;
    if (soak_pick(r, 4) > 0) {
        join_some(w, r);
    }
    for (int i = 0; i < w->crowd->body_count; i++) {
        m->filters[i] = def_of(w, i)->filter;
    }
    w->crowd->config.caps.joints = SOAK_JOINTS;
    w->crowd->config.caps.hits = 64;
    soak_machine_ask(w);
}
