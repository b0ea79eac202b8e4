/* SPDX-License-Identifier: MIT */
/*
 * Joints: what they hold, how they are driven, what they refuse; energy and momentum of jointed
 * bodies.
 */
#include <string.h>

#include "carom_body.h"
#include "lib/jointed.h"
#include "lib/real.h"
#include "lib/test.h"
#include "num/fnv.h"
#include "solve/joint.h"

static _Alignas(8) uint8_t copy[CAROM_WORLD_BYTES(CAPS)];
static uint8_t snapshot[2048];

static void set_motion(int body, int64_t vx, int64_t vy, int64_t vz, int64_t wx, int64_t wy,
                       int64_t wz)
{
    struct carom_body_state s = state_of(body);

    s.velocity = (carom_v3_q40){{vx, vy, vz}};
    s.spin = (carom_v3_q40){{wx, wy, wz}};
    CHECK_EQ(carom_body_set(world, body, &s), CAROM_OK);
}

static void step(int frames)
{
    for (int i = 0; i < frames; i++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
}

/* A body hangs at rest: the joint carries its weight, and it moves by rounding only. */
static void test_hangs(void)
{
    int body, number;
    struct carom_joint_def j;

    setup(FALL);
    body = add(0, 0, -UNIT);
    j = joint(CAROM_JOINT_BALL, body, CAROM_WORLD, 0, 0, 0);
    number = carom_joint_add(world, &j);
    CHECK_EQ(number, 0);
    CHECK_EQ(carom_joint_count(world), 1);
    step(50);
    CHECK_LESS(apart(number), SKIN / 16);
    CHECK_LESS(carom_abs(state_of(body).position.c[2] + UNIT), SKIN / 16);
    CHECK_LESS(carom_abs(state_of(body).velocity.c[2]), FALL / 1024);
    /* half of a frame's weight before the frame and half after it, mass 1 */
    CHECK_NEAR((double)joint_of(number).impulse.c[2], (double)FALL, (double)FALL / 256);
}

/* Twice the kinetic and the potential energy, in units of ONE^2, exact enough in double. */
static double energy(int body, double gravity)
{
    /* from the sides 1, 1/2, 1/4 and mass 1: (b^2 + c^2) / 12 */
    static const double inertia[3] = {(0.25 + 0.0625) / 12, (1 + 0.0625) / 12, (1 + 0.25) / 12};
    struct carom_body_state s = state_of(body);
    double w = s.rotation.c[0] / 0x1p30, x = s.rotation.c[1] / 0x1p30, y = s.rotation.c[2] / 0x1p30,
           z = s.rotation.c[3] / 0x1p30, sum = 0;
    double r[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                      {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                      {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};

    for (int k = 0; k < 3; k++) {
        double own = 0, v = (double)s.velocity.c[k] / 0x1p40;

        for (int m = 0; m < 3; m++) {
            own += r[m][k] * (double)s.spin.c[m] / 0x1p40;
        }
        sum += v * v + inertia[k] * own * own;
    }
    return sum + 2 * gravity * (double)s.position.c[2] / 0x1p32;
}

/* A pendulum that swings in space, and turns about its own axis as well, keeps its energy. */
static void test_pendulum(void)
{
    int body, number, frames = 400;
    struct carom_joint_def j;
    double first, swing;

    setup(FALL);
    body = add(0, 0, -UNIT);
    set_motion(body, ONE / 40, ONE / 90, 0, 0, 0, ONE / 30);
    j = joint(CAROM_JOINT_BALL, body, CAROM_WORLD, UNIT / 8, 0, 0);
    number = carom_joint_add(world, &j);
    step(1);
    first = energy(body, 1 / 367.0);
    swing = first + 2 / 367.0;
#ifdef TEST_LONG
    frames = 4000;
#endif
    for (int i = 0; i < frames; i++) {
        step(1);
        CHECK_NEAR(energy(body, 1 / 367.0) * 0x1p60, first * 0x1p60, swing * 1e-4 * 0x1p60);
        CHECK_LESS(apart(number), 4 * SKIN);
    }
}

/* Two bodies with a hinge fly freely: their momentum stays to the last bit. */
static void test_momentum(void)
{
    int a, b, number;
    struct carom_joint_def j;
    int64_t before[3], skew = 0;

    setup(0);
    a = add(UNIT, 0, 0);
    b = add(-UNIT, 0, 0);
    set_motion(a, ONE / 50, ONE / 70, -ONE / 33, ONE / 20, ONE / 9, ONE / 30);
    j = joint(CAROM_JOINT_HINGE, a, b, UNIT / 5, UNIT / 7, 0);
    j.axis = (carom_v3_q30){{644245094, 0, 858993459}}; /* 3/5, 0, 4/5 */
    number = carom_joint_add(world, &j);
    CHECK_AT_LEAST(number, 0);
    /* masses of 1: momenta are velocities */
    for (int k = 0; k < 3; k++) {
        before[k] = state_of(a).velocity.c[k] + state_of(b).velocity.c[k];
    }
    for (int i = 0; i < 200; i++) {
        step(1);
        for (int k = 0; k < 3; k++) {
            skew |= before[k] ^ (state_of(a).velocity.c[k] + state_of(b).velocity.c[k]);
        }
        CHECK_LESS(apart(number), 4 * SKIN);
    }
    CHECK_EQ(skew, 0);
}

/* A wheel on a hinge whose motor has a largest torque: w' = w + T / I until the wanted speed. */
static void test_motor(void)
{
    int body, number;
    struct carom_joint_def j;
    /* about z: (1 + 1/4) / 12; T = I / 1000 a frame */
    const int64_t torque = ONE * 5 / 48 / 1000, wanted = ONE / 20;

    setup(0);
    body = add(0, 0, 0);
    j = joint(CAROM_JOINT_HINGE, body, CAROM_WORLD, 0, 0, 0);
    j.drive.motor = true;
    j.drive.motor_speed_q40 = wanted;
    j.drive.motor_most_q40 = torque;
    number = carom_joint_add(world, &j);
    for (int i = 1; i <= 60; i++) {
        double expected = i < 50 ? (double)ONE * i / 1000 : (double)wanted;

        step(1);
        CHECK_NEAR((double)state_of(body).spin.c[2], expected, (double)ONE * 2e-7);
        CHECK_NEAR((double)joint_of(number).speed_q40, expected, (double)ONE * 2e-7);
    }
    CHECK_EQ(state_of(body).position.c[0], 0);
}

/* A door swings to its limit and stays there; it never goes beyond. */
static void test_limits(void)
{
    int body, number;
    struct carom_joint_def j;
    int64_t limit = UNIT / 2;

    setup(0);
    body = add(0, 0, 0);
    j = joint(CAROM_JOINT_HINGE, body, CAROM_WORLD, -UNIT / 2, 0, 0);
    j.drive.limited = true;
    j.drive.lower_q32 = -limit;
    j.drive.upper_q32 = limit;
    number = carom_joint_add(world, &j);
    set_motion(body, 0, ONE / 60, 0, 0, 0, ONE / 30);
    for (int i = 0; i < 60; i++) {
        step(1);
        CHECK_LESS(joint_of(number).coordinate_q32, limit + UNIT / 1024);
    }
    CHECK_NEAR((double)joint_of(number).coordinate_q32, (double)limit, (double)UNIT / 512);
    CHECK_LESS(carom_abs(joint_of(number).speed_q40), ONE / 4096);
}

/* A slider falls along its axis like a free body; a stiff one holds the other directions. */
static void test_slider(void)
{
    int body, number;
    struct carom_joint_def j;

    setup(FALL);
    body = add(0, 0, 0);
    j = joint(CAROM_JOINT_SLIDER, body, CAROM_WORLD, UNIT / 3, 0, 0);
    number = carom_joint_add(world, &j);
    step(30);
    /* g t^2 / 2 */
    CHECK_NEAR((double)joint_of(number).coordinate_q32, -900 / 2 / 367.0 * (double)UNIT,
               (double)UNIT / 1000);
    CHECK_LESS(carom_abs(state_of(body).position.c[0]), SKIN / 16);
    CHECK_LESS(carom_abs(state_of(body).rotation.c[1]), CAROM_ONE_Q30 / 4096);
}

/* A rope lets its body fall up to its length; a rod keeps it. */
static void test_distance(void)
{
    for (int rod = 0; rod < 2; rod++) {
        int body, number;
        struct carom_joint_def j;
        int64_t most = 0, least = 8 * UNIT;

        setup(FALL);
        body = add(UNIT, 0, 0);
        j = joint(CAROM_JOINT_DISTANCE, body, CAROM_WORLD, UNIT, 0, 0);
        j.drive.limited = true;
        j.drive.lower_q32 = rod ? UNIT : 0;
        j.drive.upper_q32 = rod ? UNIT : UNIT * 5 / 4;
        number = carom_joint_add(world, &j);
        CHECK_AT_LEAST(number, 0);
        for (int i = 0; i < 150; i++) {
            int64_t long_q32;

            step(1);
            long_q32 = joint_of(number).coordinate_q32;
            most = long_q32 > most ? long_q32 : most;
            least = long_q32 < least ? long_q32 : least;
        }
        CHECK_NEAR((double)most, rod ? (double)UNIT : (double)UNIT * 1.25, (double)UNIT / 256);
        CHECK(rod ? least > UNIT - UNIT / 256 : least >= UNIT - UNIT / 256);
    }
}

/* A spring without damping has the period of sqrt(k / m), and keeps its energy. */
static void test_spring(void)
{
    int body, number, turns = 0;
    struct carom_joint_def j;
    int64_t last;

    setup(0);
    body = add(UNIT, 0, 0);
    j = joint(CAROM_JOINT_SLIDER, body, CAROM_WORLD, UNIT, 0, 0);
    j.axis = (carom_v3_q30){{CAROM_ONE_Q30, 0, 0}};
    j.drive.spring = true;
    j.drive.rest_q32 = -UNIT / 4;
    /* (2 pi / 60)^2: a period of 60 frames */
    j.drive.stiffness_q40 = (int64_t)(0.010966227112321508 * (double)ONE);
    number = carom_joint_add(world, &j);
    last = 0;
    for (int i = 0; i < 600; i++) {
        int64_t at;

        step(1);
        at = joint_of(number).coordinate_q32 + UNIT / 4;
        turns += (at > 0) != (last > 0) && i > 0;
        CHECK_LESS(at, UNIT / 4 + UNIT / 64);
        CHECK_MORE(at, -UNIT / 4 - UNIT / 64);
        last = at;
    }
    CHECK_AT_LEAST(turns, 19);
    CHECK_AT_MOST(turns, 21); /* two a period, ten periods */
}

/* An anchor is at most 64 radii from each of its bodies: of a box, 36.7 units. */
static void test_far_anchor(void)
{
    struct carom_joint_def j;
    int a, b;

    setup(0);
    a = add(0, 0, 0);
    b = add(40 * UNIT, 0, 0);
    j = joint(CAROM_JOINT_BALL, a, b, 0, 0, 0);
    CHECK_EQ(carom_joint_add(world, &j), CAROM_ERR_RANGE);
    j.anchor.c[0] = 4 * UNIT;
    CHECK_EQ(carom_joint_add(world, &j), 0);
    j = joint(CAROM_JOINT_DISTANCE, a, b, 0, 0, 0);
    CHECK_EQ(carom_joint_add(world, &j), CAROM_ERR_RANGE);
    j.anchor_b.c[0] = 40 * UNIT;
    CHECK_EQ(carom_joint_add(world, &j), 1);
}

/* A spring without stiffness and damping is none. */
static void test_no_spring(void)
{
    struct carom_body_state without, with;

    for (int spring = 0; spring < 2; spring++) {
        struct carom_joint_def j;
        int body;

        setup(FALL);
        body = add(UNIT, 0, 0);
        j = joint(CAROM_JOINT_HINGE, body, CAROM_WORLD, 0, 0, 0);
        j.axis = (carom_v3_q30){{0, CAROM_ONE_Q30, 0}};
        j.drive.spring = spring > 0;
        j.drive.rest_q32 = UNIT;
        CHECK_EQ(carom_joint_add(world, &j), 0);
        step(40);
        *(spring ? &with : &without) = state_of(body);
    }
    CHECK_DIFFER(with.position.c[2], 0);
    for (int k = 0; k < 3; k++) { /* its row is solved, and rounds otherwise */
        CHECK_NEAR((double)with.position.c[k], (double)without.position.c[k],
                   (double)UNIT / (1 << 16));
    }
}

/*
 * A kinematic box leads another one by a joint, by 2 units a frame, against a wall 1.5 units before it. The hit is the last one
 * that the world allows, so the led box stops there, and the one that leads it stops with it.
 */
static void test_led_to_wall(void)
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS), .substep_cap = 1};
    struct carom_joint_def j;
    enum { LEADER, WALL, LED };

    setup(0);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    def.kinematic = true;
    def.velocity.c[0] = 2 * ONE;
    CHECK_EQ(add(0, 0, 0), LEADER);
    def.kinematic = false;
    def.stationary = true;
    def.velocity.c[0] = 0;
    CHECK_EQ(add(4 * UNIT, 0, 0), WALL);
    def.stationary = false;
    def.velocity.c[0] = 2 * ONE;
    CHECK_EQ(add(3 * UNIT / 2, 0, 0), LED);
    j = joint(CAROM_JOINT_BALL, LED, LEADER, 3 * UNIT / 4, 0, 0);
    CHECK_EQ(carom_joint_add(world, &j), 0);
    CHECK_EQ(carom_world_step(world), CAROM_SUBSTEP_CAP);
    CHECK_EQ(events_of(CAROM_EVENT_HIT, LED, WALL), 1);
    CHECK_EQ(events_of(CAROM_EVENT_CUT, LED, WALL), 1);
    CHECK_EQ(events_of(CAROM_EVENT_BLOCKED, LEADER, LED), 1);
    CHECK_NEAR((double)state_of(LEADER).position.c[0], 1.5 * (double)UNIT, (double)UNIT / 256);
    CHECK_NEAR((double)state_of(LED).position.c[0], 3.0 * (double)UNIT, (double)UNIT / 256);
    CHECK_AT_MOST(state_of(LED).position.c[0], 3 * UNIT);
}

/*
 * Eight boxes around a ninth, joined with it rigidly, all turning about it. Their 48 rows couple with each other, which is more
 * than the room for solving them at once holds, so joints are swept. They still hold, and the wheel turns on as it began.
 */
#define HUB_CAPS 9, 8, 24, 32, 0, 32, 8
static void test_hub(void)
{
    static _Alignas(8) uint8_t wheel[CAROM_WORLD_BYTES(HUB_CAPS)];
    static const int at[8][3] = {{2, 0, 0}, {-2, 0, 0},  {0, 2, 0},  {0, -2, 0},
                                 {2, 2, 0}, {-2, -2, 0}, {2, -2, 0}, {-2, 2, 0}};
    const struct carom_config config = {.caps = CAROM_CAPS(HUB_CAPS)};
    double sine, cosine;

    setup(0);
    CHECK_EQ(carom_world_init(wheel, sizeof wheel, &config, &world), CAROM_OK);
    def.spin.c[2] = ONE / 50;
    CHECK_EQ(add(0, 0, 0), 0);
    for (int i = 0; i < 8; i++) {
        struct carom_joint_def j =
            joint(CAROM_JOINT_FIXED, i + 1, 0, at[i][0] * UNIT / 2, at[i][1] * UNIT / 2, 0);

        def.velocity = (carom_v3_q40){{-at[i][1] * ONE / 50, at[i][0] * ONE / 50, 0}};
        CHECK_EQ(add(at[i][0] * UNIT, at[i][1] * UNIT, 0), i + 1);
        CHECK_EQ(carom_joint_add(world, &j), i);
    }
    for (int frame = 0; frame < 100; frame++) {
        step(1);
        for (int i = 0; i < 8; i++) {
            CHECK_AT_MOST(apart(i), 2 * SKIN); /* sweeps end a little earlier */
        }
    }
    real_sine_cosine(0.02 * 100, &sine, &cosine);
    for (int i = 0; i < 8; i++) {
        const double x = at[i][0] * cosine - at[i][1] * sine;

        CHECK_NEAR((double)state_of(i + 1).position.c[0], x * (double)UNIT, (double)UNIT / 32);
    }
}

/* Products keep 40 fractional bits, and stay within 2^60. */
static void test_products(void)
{
    const int64_t large = (int64_t)1 << 62, most = (int64_t)1 << 60;

    CHECK_EQ(joint_product_q40(3 * ONE, -5 * ONE), -15 * ONE);
    CHECK_EQ(joint_product_q40(large, large), most);
    CHECK_EQ(joint_product_q40(large, -large), -most);
}

static int hits_in(int frames)
{
    int hits = 0;

    for (int i = 0; i < frames; i++) {
        const struct carom_event *events;

        step(1);
        for (int k = carom_events(world, &events) - 1; k >= 0; k--) {
            hits += events[k].kind == CAROM_EVENT_HIT;
        }
    }
    return hits;
}

/* Bodies of a joint ignore each other unless they are to touch. */
static void test_ignore(void)
{
    for (int touch = 0; touch < 2; touch++) {
        int a, b;
        struct carom_joint_def j;

        setup(0);
        a = add(UNIT * 5 / 8, 0, 0);
        b = add(-UNIT * 5 / 8, 0, 0);
        j = joint(CAROM_JOINT_SLIDER, a, b, 0, 0, 0);
        j.axis = (carom_v3_q30){{CAROM_ONE_Q30, 0, 0}};
        j.touch = touch;
        CHECK_EQ(carom_joint_add(world, &j), 0);
        set_motion(a, -ONE / 60, 0, 0, 0, 0, 0);
        CHECK_EQ((hits_in(40) > 0), (touch != 0));
        CHECK_EQ((joint_of(0).coordinate_q32 < -UNIT / 2), (touch == 0));
    }
}

/*
 * Two bodies of a joint ignored each other and overlap when the joint is removed or breaks. They
 * pass each other until they are apart: a box falls through a ledge on which it would otherwise
 * lie, and then hits the next ledge.
 */
static void test_parts(void)
{
    for (int breaks = 0; breaks < 2; breaks++) {
        int a, size;
        struct carom_joint_def j;

        setup(FALL);
        a = add(UNIT / 3, 0, UNIT * 3 / 8);
        def.stationary = true;
        j = joint(CAROM_JOINT_SLIDER, a, add(0, 0, 0), 0, 0, 0);
        add(0, 0, -UNIT * 2);
        j.most_impulse_q40 = breaks ? ONE / 1000 : 0;
        CHECK_EQ(carom_joint_add(world, &j), 0);
        CHECK_EQ(hits_in(14), 0);
        CHECK_LESS(carom_abs(state_of(a).position.c[2]), UNIT / 4);
        if (breaks) {
            const carom_v3_q40 push = {{ONE / 500, 0, 0}};
            const carom_v3_q32 centre = state_of(a).position;

            CHECK_EQ(carom_body_push(world, a, &push, &centre), CAROM_OK);
            CHECK_EQ(hits_in(1), 0);
            CHECK(joint_of(0).broken);
        } else {
            CHECK_EQ(carom_joint_remove(world, 0), CAROM_OK);
        }
        size = carom_snapshot_save(world, snapshot, sizeof snapshot);
        CHECK_EQ(carom_snapshot_load(world, snapshot, (size_t)size), CAROM_OK);
        CHECK_EQ(hits_in(15), 0);
        CHECK_LESS(state_of(a).position.c[2], -UNIT / 4);
        CHECK_MORE(hits_in(40), 0);
        CHECK_MORE(state_of(a).position.c[2], -UNIT * 2);
    }
}

/* Without room for the pair that would pass, the joint stays. */
static void test_parts_without_room(void)
{
    int a, b;
    struct carom_joint_def j;

    setup_pairs(0, 1);
    a = add(UNIT * 3 / 4, 0, 0);
    b = add(-UNIT * 3 / 4, 0, 0);
    j = joint(CAROM_JOINT_SLIDER, a, b, 0, 0, 0);
    j.axis = (carom_v3_q30){{CAROM_ONE_Q30, 0, 0}};
    CHECK_EQ(carom_joint_add(world, &j), 0);
    set_motion(a, -ONE / 20, 0, 0, 0, 0, 0);
    step(15);
    set_motion(a, 0, 0, 0, 0, 0, 0);
    set_motion(b, 0, 0, 0, 0, 0, 0);
    def.overlap = CAROM_OVERLAP_PASS;
    add(0, UNIT * 40, 0);
    add(0, UNIT * 40, 0);
    CHECK_EQ(carom_joint_remove(world, 0), CAROM_ERR_PAIRS_FULL);
    CHECK_EQ(joint_of(0).kind, CAROM_JOINT_SLIDER);
    CHECK_EQ(carom_body_remove(world, 3), CAROM_OK);
    CHECK_EQ(carom_joint_remove(world, 0), CAROM_OK);
}

/* A joint that takes more than it bears breaks, reports that, and holds nothing. */
static void test_breaks(void)
{
    int body, broken = 0;
    struct carom_joint_def j;

    setup(FALL);
    body = add(0, 0, -UNIT);
    j = joint(CAROM_JOINT_BALL, body, CAROM_WORLD, 0, 0, 0);
    j.most_impulse_q40 = 2 * FALL;
    CHECK_EQ(carom_joint_add(world, &j), 0);
    step(20);
    CHECK(!joint_of(0).broken);
    set_motion(body, ONE / 8, 0, 0, 0, 0, 0);
    for (int i = 0; i < 20; i++) {
        const struct carom_event *events;
        int n;

        step(1);
        n = carom_events(world, &events);
        for (int k = 0; k < n; k++) {
            broken += events[k].kind == CAROM_EVENT_BREAK && events[k].a == 0;
        }
    }
    CHECK_EQ(broken, 1);
    CHECK(joint_of(0).broken);
    CHECK_MORE(apart(0), UNIT / 4);
}

/* A snapshot holds the joints, and the same frames follow. */
static void test_snapshot(void)
{
    int body, size;
    struct carom_joint_def j;
    uint64_t hash;

    setup(FALL);
    body = add(UNIT / 2, 0, -UNIT);
    add(UNIT / 2, 0, UNIT);
    j = joint(CAROM_JOINT_HINGE, body, CAROM_WORLD, 0, 0, 0);
    j.axis = (carom_v3_q30){{0, CAROM_ONE_Q30, 0}};
    CHECK_EQ(carom_joint_add(world, &j), 0);
    step(7);
    size = carom_snapshot_save(world, snapshot, sizeof snapshot);
    CHECK_MORE(size, 0);
    step(20);
    hash = carom_world_hash(world);
    CHECK_EQ(carom_snapshot_load(world, snapshot, (size_t)size), CAROM_OK);
    step(20);
    CHECK_EQ(carom_world_hash(world), hash);
    /* cut anywhere, it is refused and the world stays as it was */
    for (int cut = 1; cut < 120; cut += 7) {
        CHECK_EQ(carom_snapshot_load(world, snapshot, (size_t)(size - cut)), CAROM_ERR_FORMAT);
    }
    CHECK_EQ(carom_world_hash(world), hash);
    /* a number that no step could have left, with a correct check sum: limits in reverse order */
    {
        uint64_t fnv = FNV_START;
        int at =
            size - 8 - 16 - 8 - 48 - 48 - 56; /* lower_q32: the last 180 bytes are the joint's */

        snapshot[at - 3] = 1;
        snapshot[at] = 1;
        for (int i = 0; i < size - 8; i++) {
            fnv = fnv_add(fnv, snapshot[i]);
        }
        for (int i = 0; i < 8; i++) {
            snapshot[size - 8 + i] = (uint8_t)(fnv >> (8 * i));
        }
        CHECK_EQ(carom_snapshot_load(world, snapshot, (size_t)size), CAROM_ERR_FORMAT);
        CHECK_EQ(carom_world_hash(world), hash);
    }
}

/* A wrong definition is refused, and nothing changes. */
static void test_refuses(void)
{
    int body;
    struct carom_joint_def good, j;
    struct carom_joint_state s;
    struct carom_joint_drive drive;

    setup(FALL);
    body = add(0, 0, 0);
    def.stationary = true;
    CHECK_EQ(add(4 * UNIT, 0, 0), 1);
    good = joint(CAROM_JOINT_HINGE, body, CAROM_WORLD, 0, 0, 0);
    memcpy(copy, block, sizeof block);
#define REFUSE_DEF(change, error)                                                                  \
    do {                                                                                           \
        j = good;                                                                                  \
        change;                                                                                    \
        CHECK_EQ(carom_joint_add(world, &j), error);                                               \
    } while (0)
    CHECK_EQ(carom_joint_add(NULL, &good), CAROM_ERR_NULL);
    CHECK_EQ(carom_joint_add(world, NULL), CAROM_ERR_NULL);
    REFUSE_DEF(j.a = 7, CAROM_ERR_BODY);
    REFUSE_DEF(j.b = 7, CAROM_ERR_BODY);
    REFUSE_DEF(j.a = CAROM_WORLD, CAROM_ERR_BODY);
    REFUSE_DEF(j.a = 1, CAROM_ERR_ARGUMENT);
    REFUSE_DEF(j.b = body, CAROM_ERR_ARGUMENT);
    REFUSE_DEF(j.kind = 5, CAROM_ERR_ARGUMENT);
    REFUSE_DEF(j.axis.c[2] = CAROM_ONE_Q30 / 2, CAROM_ERR_ARGUMENT);
    REFUSE_DEF(j.anchor.c[0] = 100 * UNIT, CAROM_ERR_RANGE);
    REFUSE_DEF(j.most_impulse_q40 = -1, CAROM_ERR_RANGE);
    REFUSE_DEF(j.drive.limited = true; j.drive.lower_q32 = 1, CAROM_ERR_RANGE);
    REFUSE_DEF(j.drive.limited = true; j.drive.upper_q32 = 4 * UNIT, CAROM_ERR_RANGE);
    REFUSE_DEF(j.drive.motor = j.drive.spring = true, CAROM_ERR_ARGUMENT);
    REFUSE_DEF(j.kind = CAROM_JOINT_BALL; j.drive.limited = true, CAROM_ERR_ARGUMENT);
    REFUSE_DEF(j.kind = CAROM_JOINT_DISTANCE; j.drive.motor = true, CAROM_ERR_ARGUMENT);
    REFUSE_DEF(j.drive.spring = true; j.drive.stiffness_q40 = -1, CAROM_ERR_RANGE);
    CHECK_EQ(memcmp(copy, block, sizeof block), 0);
    for (int i = 0; i < 3; i++) {
        CHECK_EQ(carom_joint_add(world, &good), i);
    }
    CHECK_EQ(carom_joint_add(world, &good), CAROM_ERR_JOINTS_FULL);
    CHECK_EQ(carom_joint_remove(world, 3), CAROM_ERR_JOINT);
    CHECK_EQ(carom_joint_remove(world, 1), CAROM_OK);
    CHECK_EQ(carom_joint_remove(world, 1), CAROM_ERR_JOINT);
    CHECK_EQ(carom_joint_get(world, 1, &s), CAROM_ERR_JOINT);
    memset(&drive, 0, sizeof drive);
    CHECK_EQ(carom_joint_set(world, 1, &drive), CAROM_ERR_JOINT);
    CHECK_EQ(carom_joint_add(world, &good), 1);
    /* a removed body takes its joints with it */
    CHECK_EQ(carom_body_remove(world, body), CAROM_OK);
    CHECK_EQ(carom_joint_get(world, 0, &s), CAROM_ERR_JOINT);
    step(2);
}

/* To set the drive that a joint has wakes nobody, whatever lies between the members of the caller's structure. */
static void test_set_again(void)
{
    const struct carom_config config = {
        .caps = CAROM_CAPS(CAPS), .gravity = {{0, 0, -ONE / 256}}, .sleep = true};
    struct carom_joint_def j = joint(CAROM_JOINT_HINGE, 0, CAROM_WORLD, 0, 0, UNIT);
    struct carom_joint_drive drive;

    setup(0);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    add(0, 0, 0);
    CHECK_EQ(carom_joint_add(world, &j), 0);
    for (int i = 0; i < 100 && !state_of(0).asleep; i++) {
        step(1);
    }
    CHECK(state_of(0).asleep);
    memset(&drive, 0xff, sizeof drive);
    drive.limited = drive.motor = drive.spring = false;
    drive.lower_q32 = drive.upper_q32 = drive.motor_speed_q40 = drive.motor_most_q40 = 0;
    drive.rest_q32 = drive.stiffness_q40 = drive.damping_q40 = 0;
    CHECK_EQ(carom_joint_set(world, 0, &drive), CAROM_OK);
    CHECK(state_of(0).asleep);
    drive.limited = true;
    CHECK_EQ(carom_joint_set(world, 0, &drive), CAROM_OK);
    CHECK(!state_of(0).asleep);
}

/* The way from one angle to another is the shorter one around. */
static void test_turned(void)
{
    for (int from = -31; from <= 31; from++) {
        for (int to = -31; to <= 31; to++) {
            double way = 0.1 * (to - from);

            way -= way > REAL_PI ? 2 * REAL_PI : way < -REAL_PI ? -2 * REAL_PI : 0;
            CHECK_NEAR(joint_turned_q40(real_round(0.1 * from * real_power2(40)),
                                        real_round(0.1 * to * real_power2(40))),
                       real_round(way * real_power2(40)), 4);
        }
    }
}

const struct test tests_solve_joint[] = {
    {"solve_joint/turned", test_turned},
    {"solve_joint/hangs", test_hangs},
    {"solve_joint/pendulum", test_pendulum},
    {"solve_joint/momentum", test_momentum},
    {"solve_joint/motor", test_motor},
    {"solve_joint/limits", test_limits},
    {"solve_joint/slider", test_slider},
    {"solve_joint/distance", test_distance},
    {"solve_joint/spring", test_spring},
    {"solve_joint/far_anchor", test_far_anchor},
    {"solve_joint/no_spring", test_no_spring},
    {"solve_joint/led_to_wall", test_led_to_wall},
    {"solve_joint/hub", test_hub},
    {"solve_joint/products", test_products},
    {"solve_joint/ignore", test_ignore},
    {"solve_joint/parts", test_parts},
    {"solve_joint/parts_without_room", test_parts_without_room},
    {"solve_joint/breaks", test_breaks},
    {"solve_joint/snapshot", test_snapshot},
    {"solve_joint/refuses", test_refuses},
    {"solve_joint/set_again", test_set_again},
    {0},
};
