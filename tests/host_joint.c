/* SPDX-License-Identifier: MIT */
/*
 * host_joint - joints in worlds that are too large for small boards: a door that swings and is
 * hit, chains, a pendulum, a motor, and random worlds of random joints. Anchors, axes, energy and
 * crossings are judged in double precision, from what the public interface reports.
 *
 *   host_joint.elf [long | led WORLD | drags WORLD]
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "carom_joint.h"
#include "lib/real.h"
#include "lib/soak.h"

#define FRAMES      2000
#define FRAMES_LONG 100000
#define WORLDS      30
#define WORLDS_LONG 1000
#define LINKS       20

/* The largest errors of a run's joints. */
struct seen {
    double apart; /* anchors, in skins of the smaller body */
    double axes;  /* for hinges, radians */
    long frame;   /* frame of the worst gap */
};

static struct crowd *begin(bool ground)
{
    struct crowd *crowd = crowd_new();

    crowd->config.caps.joints = 32;
    if (ground) {
        crowd_body(crowd, crowd_mesh(crowd, &lab_sheet));
    }
    return crowd;
}

static struct carom_joint_def joint(int kind, int a, int b, double x, double y, double z)
{
    struct carom_joint_def def;

    memset(&def, 0, sizeof def);
    def.kind = (uint8_t)kind;
    def.touch = true;
    def.a = a;
    def.b = b;
    def.anchor = (carom_v3_q32){{lab_fixed(x, 32), lab_fixed(y, 32), lab_fixed(z, 32)}};
    def.axis.c[2] = CAROM_ONE_Q30;
    return def;
}

static int add(struct crowd *crowd, const struct carom_joint_def *def)
{
    int number = carom_joint_add(crowd->world, def);

    lab_expect(number < 0 ? number : CAROM_OK, "joint");
    return number;
}

/* A direction that turns with the body; the body was not turned when the scene began. */
static void turned(const struct crowd *crowd, int body, const double was[3], double now[3])
{
    struct carom_body_state s;
    double q[4];
    double across[3], twice[3];

    lab_expect(carom_body_get(crowd->world, body, &s), "get");
    for (int k = 0; k < 4; k++) {
        q[k] = lab_double(s.rotation.c[k], 30);
    }
    real_cross(across, q + 1, was);
    for (int k = 0; k < 3; k++) {
        across[k] += q[0] * was[k];
    }
    real_cross(twice, q + 1, across);
    for (int k = 0; k < 3; k++) {
        now[k] = was[k] + 2 * twice[k];
    }
}

/*
 * Look at all joints. `axis` is the axis of the hinges when they were added; their bodies were not
 * turned then.
 */
static void look(const struct crowd *crowd, const double axis[3], struct seen *seen, long frame)
{
    for (int i = 0; i < carom_joint_count(crowd->world); i++) {
        struct carom_joint_state s;
        double square = 0, skin, own[3], other[3], across[3];

        if (carom_joint_get(crowd->world, i, &s) < 0 || s.broken ||
            s.kind == CAROM_JOINT_DISTANCE || s.kind == CAROM_JOINT_SLIDER) {
            continue;
        }
        skin = crowd->meshes[crowd->bodies[s.a].mesh].skin;
        if (s.b != CAROM_WORLD && !crowd->bodies[s.b].def.stationary) {
            skin = fmin(skin, crowd->meshes[crowd->bodies[s.b].mesh].skin);
        }
        for (int k = 0; k < 3; k++) {
            square += pow(lab_double(s.anchor[0].c[k] - s.anchor[1].c[k], 32), 2);
            other[k] = axis[k];
        }
        if (sqrt(square) / skin > seen->apart) {
            seen->apart = sqrt(square) / skin;
            seen->frame = frame;
        }
        if (s.kind == CAROM_JOINT_HINGE) {
            turned(crowd, s.a, axis, own);
            if (s.b != CAROM_WORLD) {
                turned(crowd, s.b, axis, other);
            }
            real_cross(across, own, other);
            seen->axes = fmax(seen->axes, sqrt(real_dot(across, across)));
        }
    }
}

static void report(struct crowd *crowd, const char *name, const struct crowd_tally *t,
                   const struct seen *seen, double most)
{
    lab_report(
        t->crossed == 0 && t->inside == 0 && t->out == 0 && seen->apart <= most &&
            seen->axes <= 1e-3,
        name,
        "%ld frames, %ld cross, %ld inside, %ld out, %ld capped; anchors %.2f skins apart at "
        "most (frame %ld), bound %.0f; axes %.1e",
        t->frames, t->crossed, t->inside, t->out, t->capped, seen->apart, seen->frame, most,
        seen->axes);
    crowd_free(crowd);
}

/* A door on a tilted hinge swings between its limits and hits a ball and a box. */
static void test_door(long frames)
{
    static const double axis[3] = {0.6, 0, 0.8};
    struct crowd *crowd = begin(true);
    struct crowd_tally t = {0};
    struct seen seen = {0};
    struct carom_joint_def def;

    crowd_place(crowd_body(crowd, crowd_box(crowd, 0.1, 2, 1.5)), 0, 1, 1.2);
    crowd_place(crowd_body(crowd, crowd_ball(crowd, 0.3)), 0.9, 1.2, 2.4);
    crowd_place(crowd_body(crowd, crowd_box(crowd, 0.5, 0.4, 0.3)), -0.7, 0.9, 1.3);
    crowd_surface(crowd, 0.4, 0.4);
    lab_expect(crowd_start(crowd), "door");
    def = joint(CAROM_JOINT_HINGE, 1, CAROM_WORLD, 0, 0, 1.2);
    for (int k = 0; k < 3; k++) {
        def.axis.c[k] = (int32_t)lab_fixed(axis[k], 30);
    }
    def.drive.limited = true;
    def.drive.lower_q32 = lab_fixed(-2.5, 32);
    def.drive.upper_q32 = lab_fixed(2.5, 32);
    add(crowd, &def);
    for (long frame = 1; frame <= frames; frame++) {
        if (frame % 600 == 0) { /* somebody pushes it */
            carom_v3_q40 push = {{lab_fixed(frame % 1200 == 0 ? 0.02 : -0.02, 40), 0, 0}};
            struct carom_body_state s;

            lab_expect(carom_body_get(crowd->world, 1, &s), "get");
            lab_expect(carom_body_push(crowd->world, 1, &push, &s.position), "push");
        }
        lab_expect(crowd_step(crowd, &t), "step");
        look(crowd, axis, &seen, frame);
    }
    report(crowd, "joint/door", &t, &seen, 4);
}

/* Twenty links on ball joints hang from one end and swing, or fall on the ground. */
static void test_chain(long frames, bool hangs)
{
    static const double axis[3] = {0, 0, 1};
    struct crowd *crowd = begin(true);
    struct crowd_tally t = {0};
    struct seen seen = {0};
    int link = crowd_box(crowd, 0.22, 0.1, 0.1);

    for (int i = 0; i < LINKS; i++) {
        crowd_place(crowd_body(crowd, link), 0.15 + 0.3 * i, 0, hangs ? 8 : 2);
    }
    for (int i = 1; i < LINKS; i++) {
        crowd_let_pass(crowd, i, i + 1, CROWD_PASS);
    }
    if (!hangs) {
        crowd_move(&crowd->bodies[1].def, (double[3]){0, 0.03, 0.05}, (double[3]){0, 0, 0.1});
    }
    lab_expect(crowd_start(crowd), "chain");
    for (int i = hangs ? 0 : 1; i < LINKS; i++) {
        struct carom_joint_def def =
            joint(CAROM_JOINT_BALL, i + 1, i > 0 ? i : CAROM_WORLD, 0.3 * i, 0, hangs ? 8 : 2);

        def.touch = false;
        add(crowd, &def);
    }
    for (long frame = 1; frame <= frames; frame++) {
        lab_expect(crowd_step(crowd, &t), "step");
        look(crowd, axis, &seen, frame);
    }
    /*
     * many contacts and joints at once settle over some frames. Chains of 24 lengths of links came
     * 1.2 to 6.0 skins apart where their ends crack like a whip
     */
    report(crowd, hangs ? "joint/chain_swings" : "joint/chain_falls", &t, &seen, hangs ? 8 : 16);
}

static double energy(const struct crowd *crowd, int body, double gravity)
{
    const struct crowd_seen *now = &crowd->bodies[body].now;

    return now->kinetic +
           gravity * crowd->bodies[body].mass * lab_double(now->state.position.c[2], 32);
}

/* A pendulum on a hinge, or one that swings in space on a ball joint. */
static void test_pendulum(long frames, int kind)
{
    struct crowd *crowd = begin(false);
    struct crowd_tally t = {0};
    struct carom_joint_def def;
    double g = -lab_double(crowd->config.gravity.c[2], 40), first = 0, off = 0, apart = 0;

    crowd->config.sleep = false;
    crowd_place(crowd_body(crowd, crowd_box(crowd, 0.3, 0.5, 1)), 0, 0, -1);
    crowd_move(&crowd->bodies[0].def, (double[3]){0.05, kind == CAROM_JOINT_BALL ? 0.02 : 0, 0},
               (double[3]){0, -0.05, 0});
    lab_expect(crowd_start(crowd), "pendulum");
    def = joint(kind, 0, CAROM_WORLD, 0, 0, 0);
    def.axis = (carom_v3_q30){{0, CAROM_ONE_Q30, 0}};
    add(crowd, &def);
    for (long frame = 1; frame <= frames; frame++) {
        struct seen seen = {0};
        double now;

        lab_expect(crowd_step(crowd, &t), "step");
        now = energy(crowd, 0, g) + g * crowd->bodies[0].mass;
        first = frame == 1 ? now : first;
        off = fmax(off, fabs(now / first - 1));
        look(crowd, (double[3]){0, 1, 0}, &seen, frame);
        apart = fmax(apart, seen.apart);
    }
    lab_report(
        off < 1e-4 && apart < 4,
        kind == CAROM_JOINT_BALL ? "joint/pendulum_ball" : "joint/pendulum_hinge",
        "%ld frames; energy of the swing off by %.1e at most, bound 1e-4; anchors %.2f skins",
        frames, off, apart);
    crowd_free(crowd);
}

/*
 * A motor turns two free bodies against each other: its work is their energy, and their momenta do
 * not change.
 */
static void test_motor(long frames)
{
    struct crowd *crowd = begin(false);
    struct crowd_tally t = {0};
    struct carom_joint_def def;
    double work = 0, off = 0, before = 0;
    int64_t skew = 0, sum[3] = {0, 0, 0};
    int number;

    crowd->config.gravity = (carom_v3_q40){{0, 0, 0}};
    crowd_place(crowd_body(crowd, crowd_box(crowd, 1, 0.5, 0.5)), 0, 0, 0);
    crowd_place(crowd_body(crowd, crowd_box(crowd, 0.5, 1, 0.5)), 0, 0, 0.6);
    crowd->bodies[0].def.mass_q20 = crowd->bodies[1].def.mass_q20 = 1 << 20;
    crowd_move(&crowd->bodies[0].def, (double[3]){0.01, 0.02, -0.01}, (double[3]){0, 0, 0});
    crowd_move(&crowd->bodies[1].def, (double[3]){0.01, 0.02, -0.01}, (double[3]){0, 0, 0});
    lab_expect(crowd_start(crowd), "motor");
    def = joint(CAROM_JOINT_HINGE, 1, 0, 0, 0, 0.3);
    def.drive.motor = true;
    def.drive.motor_speed_q40 = lab_fixed(0.2, 40);
    def.drive.motor_most_q40 = lab_fixed(2e-5, 40);
    number = add(crowd, &def);
    for (long frame = 0; frame < frames; frame++) {
        struct carom_joint_state s;
        double now = 0, speed;

        if (frame % 200 == 100) { /* the other direction */
            def.drive.motor_speed_q40 = -def.drive.motor_speed_q40;
            lab_expect(carom_joint_set(crowd->world, number, &def.drive), "set");
        }
        lab_expect(carom_joint_get(crowd->world, number, &s), "get");
        speed = lab_double(s.speed_q40, 40);
        lab_expect(crowd_step(crowd, &t), "step");
        lab_expect(carom_joint_get(crowd->world, number, &s), "get");
        for (int i = 0; i < 2; i++) {
            now += crowd->bodies[i].now.kinetic;
        }
        if (frame > 0) {
            work += lab_double(s.drive_q40, 40) * (speed + lab_double(s.speed_q40, 40)) / 2;
            off = fmax(off, fabs(now - before - work) / fmax(now, 1e-4));
        } else {
            before = now;
        }
        for (int k = 0; k < 3; k++) {
            int64_t all =
                crowd->bodies[0].now.state.velocity.c[k] + crowd->bodies[1].now.state.velocity.c[k];

            sum[k] = frame == 0 ? all : sum[k];
            skew |= all ^ sum[k];
        }
    }
    lab_report(off < 1e-6 && skew == 0, "joint/motor",
               "%ld frames; work and energy differ by %.1e of it at most, bound 1e-6; momentum %s",
               frames, off, skew == 0 ? "to the last bit" : "changes");
    crowd_free(crowd);
}

/* Random bodies in the air, connected by random joints, fall on the ground. */
static void test_random(long worlds)
{
    static const double axis[3] = {0, 0, 1};
    struct seen all = {0};
    long crossed = 0, frames = 0, capped = 0, errors = 0;

    for (long n = 1; n <= worlds; n++) {
        uint64_t random = (uint64_t)n * 7919 + 5;
        struct crowd *crowd = begin(true);
        struct crowd_tally t = {0};
        struct seen seen = {0};
        int count = 3 + (int)(lab_random(&random, 0, 1) * 6);

        for (int i = 0; i < count; i++) {
            double side[3];

            for (int k = 0; k < 3; k++) {
                side[k] = lab_random(&random, 0.2, 0.8);
            }
            crowd_place(crowd_body(crowd, crowd_box(crowd, side[0], side[1], side[2])), 1.2 * i, 0,
                        lab_random(&random, 1.2, 2.5));
        }
        crowd_surface(crowd, lab_random(&random, 0, 0.8), lab_random(&random, 0, 1));
        lab_expect(crowd_start(crowd), "random");
        for (int i = 1; i < count; i++) {
            int kind = (int)(lab_random(&random, 0, 1) * 5);
            struct carom_joint_def def =
                joint(kind, i + 1, i, 1.2 * i - 0.6, lab_random(&random, -0.3, 0.3), 1.8);

            def.anchor_b = def.anchor;
            def.anchor_b.c[0] -= lab_fixed(0.4, 32);
            if (kind == CAROM_JOINT_DISTANCE) {
                def.drive.limited = true;
                def.drive.lower_q32 = lab_fixed(0.2, 32);
                def.drive.upper_q32 = lab_fixed(0.6, 32);
            } else if (kind == CAROM_JOINT_HINGE && i % 2 == 0) {
                def.drive.limited = true;
                def.drive.lower_q32 = lab_fixed(-0.7, 32);
                def.drive.upper_q32 = lab_fixed(0.7, 32);
            } else if (kind == CAROM_JOINT_SLIDER) {
                def.drive.limited = true;
                def.drive.lower_q32 = lab_fixed(-0.3, 32);
                def.drive.upper_q32 = lab_fixed(0.3, 32);
            }
            add(crowd, &def);
        }
        for (int frame = 1; frame <= 300; frame++) {
            int result = crowd_step(crowd, &t);

            errors += result < 0;
            if (result < 0) {
                printf("# world %ld: %s\n", n, carom_result_text(result));
                break;
            }
            look(crowd, axis, &seen, frame);
        }
        if (seen.apart > all.apart) {
            all = seen;
            all.frame = n * 1000 + seen.frame;
        }
        all.axes = fmax(all.axes, seen.axes);
        crossed += t.crossed + t.inside;
        if (t.crossed + t.inside > 0) {
            printf("# world %ld crosses in frame %ld\n", n, t.crossed_first);
        }
        frames += t.frames;
        capped += t.capped;
        crowd_free(crowd);
    }
    lab_report(crossed == 0 && errors == 0 && all.apart < 8 && all.axes < 1e-3, "joint/random",
               "%ld worlds, %ld frames: %ld cross, %ld errors, %ld capped; anchors %.1f skins "
               "(%ld), axes %.1e",
               worlds, frames, crossed, errors, capped, all.apart, all.frame, all.axes);
}

/* The motion of a kinematic body: to and fro along a line, and about an axis. */
struct wander {
    double centre[3], way[3], rate, axis[3], angle, turn_rate;
};

static void wander(struct crowd *crowd, int body, const struct wander *w, long frame)
{
    struct carom_pose pose;

    for (int k = 0; k < 3; k++) {
        pose.position.c[k] = lab_fixed(w->centre[k] + w->way[k] * sin(w->rate * (double)frame), 32);
    }
    pose.rotation =
        lab_turn(w->axis[0], w->axis[1], w->axis[2], w->angle * sin(w->turn_rate * (double)frame));
    lab_expect(carom_body_move_to(crowd->world, body, &pose), "move");
}

/*
 * Random bodies hang on a kinematic body and on each other by random joints. The kinematic body
 * moves at random: so high above the ground that the bodies touch nothing, or so low that they
 * drag.
 */
static void play_led(long n, bool drags, struct seen *all, struct crowd_tally *t)
{
    static const double axis[3] = {0, 0, 1};
    uint64_t random = (uint64_t)n * 104729 + 11;
    struct crowd *crowd = begin(true);
    struct wander w;
    struct seen seen = {0};
    int count = 1 + (int)(lab_random(&random, 0, 1) * 4);
    double z = drags ? 0.9 : 9;

    for (int k = 0; k < 3; k++) {
        w.centre[k] = k == 2 ? z : 0;
        w.way[k] = lab_random(&random, -1, 1) * (k == 2 && drags ? 0.3 : 2);
        w.axis[k] = lab_random(&random, -1, 1);
    }
    w.rate = lab_random(&random, 0.002, 0.03);
    w.angle = drags ? 0 : lab_random(&random, 0, 1.5);
    w.turn_rate = lab_random(&random, 0.002, 0.1);
    crowd_body(crowd, crowd_box(crowd, 0.5, 0.5, 0.5))->kinematic = true;
    crowd_place(&crowd->bodies[1].def, 0, 0, z);
    for (int i = 0; i < count; i++) {
        double side[3];

        for (int k = 0; k < 3; k++) {
            side[k] = lab_random(&random, 0.2, 0.8);
        }
        crowd_place(crowd_body(crowd, crowd_box(crowd, side[0], side[1], side[2])), 1.2 * (i + 1),
                    0, z + lab_random(&random, -0.2, 0.4));
    }
    crowd_surface(crowd, lab_random(&random, 0, 0.8), lab_random(&random, 0, 1));
    lab_expect(crowd_start(crowd), "led");
    for (int i = 0; i < count; i++) {
        int kind = (int)(lab_random(&random, 0, 1) * 5);
        struct carom_joint_def def =
            joint(kind, i + 2, i + 1, 1.2 * i + 0.6, lab_random(&random, -0.3, 0.3), z + 0.1);

        def.anchor_b = def.anchor;
        def.anchor_b.c[0] -= lab_fixed(0.3, 32);
        def.drive.limited = kind == CAROM_JOINT_DISTANCE || kind == CAROM_JOINT_SLIDER;
        def.drive.lower_q32 = lab_fixed(kind == CAROM_JOINT_SLIDER ? -0.3 : 0.2, 32);
        def.drive.upper_q32 = lab_fixed(0.6, 32);
        add(crowd, &def);
    }
    for (long frame = 1; frame <= 300; frame++) {
        int result;

        wander(crowd, 1, &w, frame);
        result = crowd_step(crowd, t);
        lab_expect(result < 0 ? result : CAROM_OK, "step");
        look(crowd, axis, &seen, n * 1000 + frame);
    }
    if (seen.apart > all->apart) {
        *all = seen;
    }
    all->axes = fmax(all->axes, seen.axes);
    crowd_free(crowd);
}

static void report_led(bool drags, long worlds, const struct seen *all, const struct crowd_tally *t)
{
    /* where a kinematic body wedges a body that it leads, it stops a little too late */
    double most = drags && worlds > WORLDS ? 512 : 8,
           bent = drags && worlds > WORLDS ? 0.1 : 1.5e-3;

    lab_report(t->crossed == 0 && t->inside == 0 && all->apart < most && all->axes < bent,
               drags ? "joint/led_drags" : "joint/led",
               "%ld worlds, %ld frames: %ld cross, %ld inside, %ld capped; anchors %.1f skins "
               "(%ld), bound %.0f; axes %.1e, bound %.1e",
               worlds, t->frames, t->crossed, t->inside, t->capped, all->apart, all->frame, most,
               all->axes, bent);
}

static void test_led(long worlds, bool drags)
{
    struct seen all = {0};
    struct crowd_tally t = {0};

    for (long n = 1; n <= worlds; n++) {
        long before = t.crossed + t.inside;

        play_led(n, drags, &all, &t);
        if (t.crossed + t.inside > before) {
            printf("# world %ld crosses\n", n);
        }
    }
    report_led(drags, worlds, &all, &t);
}

/* Run one world of led bodies again. */
static int again(long n, bool drags)
{
    struct seen seen = {0};
    struct crowd_tally t = {0};

    play_led(n, drags, &seen, &t);
    report_led(drags, 1, &seen, &t);
    if (t.crossed > 0) {
        printf("# crosses from frame %ld on, %d and %d, by %.2e skins\n", t.crossed_first,
               t.crossed_pair[0], t.crossed_pair[1], t.crossed_skins);
    }
    return lab_finish();
}

int main(int argc, char **argv)
{
    bool all = argc > 1 && strcmp(argv[1], "long") == 0;
    long frames = all ? FRAMES_LONG : FRAMES;

    if (argc > 2) {
        return again(atol(argv[2]), strcmp(argv[1], "drags") == 0);
    }
    test_pendulum(frames, CAROM_JOINT_HINGE);
    test_pendulum(frames, CAROM_JOINT_BALL);
    test_motor(frames);
    test_door(frames);
    test_chain(all ? frames : frames / 4, true);
    test_chain(all ? frames : frames / 4, false);
    test_random(all ? WORLDS_LONG : WORLDS);
    test_led(all ? WORLDS_LONG : WORLDS, false);
    test_led(all ? WORLDS_LONG : WORLDS, true);
    return lab_finish();
}
