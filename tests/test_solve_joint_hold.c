/* SPDX-License-Identifier: MIT */
/*
 * Joints in hard cases: limits on a bent way, what is owed when a joint breaks, a light body
 * between heavy ones.
 */
#include "lib/jointed.h"
#include "lib/test.h"
#include "solve/joint_parts.h"

/* A box a sixteenth as large. */
static struct shape small;

/*
 * A body that whirls at a rope by 0.4 radian a frame stays within the rope's length plus four
 * skins. Its way bends by 8 % of the length.
 */
static void test_rope(void)
{
    struct carom_joint_def j;
    struct carom_joint_state s;
    int body;

    setup(0);
    def.velocity.c[1] = ONE * 2 / 5;
    body = add(UNIT, 0, 0);
    j = joint(CAROM_JOINT_DISTANCE, body, CAROM_WORLD, UNIT, 0, 0);
    j.drive.limited = true;
    j.drive.upper_q32 = UNIT;
    CHECK_EQ(carom_joint_add(world, &j), 0);
    for (int i = 0; i < 100; i++) {
        steps(1);
        CHECK_EQ(carom_joint_get(world, 0, &s), CAROM_OK);
        CHECK_LESS(s.coordinate_q32, UNIT + (UNIT >> 10));
    }
    CHECK_MORE(s.coordinate_q32, UNIT - (UNIT >> 6)); /* and the rope is fully stretched */
}

/*
 * A body moves along a slider. A joint that is about to break holds another body to it, which comes
 * from the side. The energy that the other body has lost in the frame may not be given back to
 * anyone.
 */
static void test_break_owes_nothing(void)
{
    struct carom_joint_def j;
    int rider, other;
    int64_t speed;

    setup(0);
    def.velocity.c[0] = ONE / 64;
    rider = add(0, 0, 0);
    def.velocity.c[1] = ONE / 4;
    other = add(0, 2 * UNIT, 0);
    j = joint(CAROM_JOINT_SLIDER, rider, CAROM_WORLD, 0, 0, 0);
    j.axis = (carom_v3_q30){{CAROM_ONE_Q30, 0, 0}};
    CHECK_EQ(carom_joint_add(world, &j), 0);
    j = joint(CAROM_JOINT_FIXED, other, rider, 0, UNIT, 0);
    j.most_impulse_q40 = ONE / 64;
    CHECK_EQ(carom_joint_add(world, &j), 1);
    steps(1);
    CHECK_EQ(carom_joint_get(world, 1, &(struct carom_joint_state){.broken = false}), CAROM_OK);
    speed = state_of(rider).velocity.c[0];
    CHECK_MORE(speed, ONE / 128);
    steps(20);
    CHECK_NEAR((double)state_of(rider).velocity.c[0], (double)speed, (double)speed / 256);
}

/*
 * A small and light body connects a heavy body far away with the world. It hangs, and no anchor is
 * off by a skin of the large body.
 */
static void test_light_between(void)
{
    struct carom_joint_def j;
    int light, heavy;

    setup(FALL);
    shape_box(&small, 12, 256, 128, 64);
    def.mesh = &small.mesh;
    def.mass_q20 = 1 << 16;
    light = add(0, 0, 0);
    def.mesh = &box.mesh;
    def.mass_q20 = 4 << 20;
    heavy = add(UNIT, UNIT / 2, -UNIT);
    j = joint(CAROM_JOINT_FIXED, light, CAROM_WORLD, UNIT / 8, 0, UNIT / 2);
    CHECK_EQ(carom_joint_add(world, &j), 0);
    j = joint(CAROM_JOINT_FIXED, heavy, light, UNIT / 4, UNIT / 4, -UNIT / 4);
    CHECK_EQ(carom_joint_add(world, &j), 1);
    for (int i = 0; i < 100; i++) {
        steps(1);
        CHECK_LESS(apart(0), UNIT >> 14);
        CHECK_LESS(apart(1), UNIT >> 14);
    }
    CHECK_LESS(carom_abs(state_of(heavy).position.c[2] + UNIT), UNIT >> 12);
}

/*
 * A grain, a 10,000th of a slab wide, is fixed to the slab, which turns. In the slab's units a turn of the grain is more than the rows
 * hold, so they are scaled down more than once. The grain goes round with the slab.
 */
static void test_grain(void)
{
    static struct shape slab;
    struct carom_joint_def j;

    setup(0);
    shape_box(&slab, 8, 4096, 2048, 1024);
    shape_box(&small, 13, 10, 10, 10);
    def.mesh = &slab.mesh;
    def.spin.c[2] = ONE / 64;
    CHECK_EQ(add(0, 0, 0), 0);
    def.mesh = &small.mesh;
    def.velocity.c[1] = ONE / 8; /* w r */
    CHECK_EQ(add(8 * UNIT + UNIT / 1024, 0, 0), 1);
    j = joint(CAROM_JOINT_FIXED, 0, 1, 8 * UNIT, 0, 0);
    CHECK_EQ(carom_joint_add(world, &j), 0);
    for (int frame = 0; frame < 100; frame++) {
        steps(1);
        CHECK_LESS(apart(0), 16 * SKIN);
    }
    for (int k = 0; k < 4; k++) {
        CHECK_NEAR(state_of(0).rotation.c[k], state_of(1).rotation.c[k], 1 << 20);
    }
    CHECK_NEAR(state_of(0).spin.c[2], ONE / 64, ONE >> 16);
}

/*
 * A hinge and a fixed joint hold the same two bodies, so rows repeat each other: their solution is
 * not unique. The bodies fly as one. No joint pushes more than the motion asks for, which is some part of the
 * momentum; impulses that cancel each other would grow, and rounding would turn the bodies.
 */
static void test_twice(void)
{
    struct test_random r = {19};

    for (int n = 0; n < (TEST_BARS ? 4 : 60); n++) {
        struct carom_joint_def j;
        int a, b;

        setup(0);
        a = add(0, 0, 0);
        def.mass_q20 = (uint32_t)1 << test_random_range(&r, 14, 20);
        def.rotation = shape_random_turn(&r);
        for (int k = 0; k < 3; k++) {
            def.velocity.c[k] = test_random_range(&r, -ONE / 1024, ONE / 1024);
            def.spin.c[k] = test_random_range(&r, -ONE / 1024, ONE / 1024);
        }
        b = add(test_random_range(&r, -UNIT, UNIT), test_random_range(&r, -UNIT, UNIT),
                test_random_range(&r, UNIT, 2 * UNIT));
        for (int i = 0; i < 2; i++) {
            j = joint(i == 0 ? CAROM_JOINT_HINGE : CAROM_JOINT_FIXED, b, a,
                      test_random_range(&r, -UNIT, UNIT), test_random_range(&r, -UNIT, UNIT),
                      test_random_range(&r, 0, UNIT));
            CHECK_EQ(carom_joint_add(world, &j), i);
        }
        for (int i = 0; i < 60; i++) {
            steps(1);
            for (int k = 0; k < 3; k++) {
                CHECK_LESS(carom_abs(joint_of(0).impulse.c[k]), ONE / 64);
                CHECK_LESS(carom_abs(joint_of(1).impulse.c[k]), ONE / 64);
            }
        }
        CHECK_LESS(apart(0), SKIN);
        CHECK_LESS(apart(1), SKIN);
    }
}

/* A velocity, q40, in units of 2^10, is at most 2^27 of them, however large it is. */
static void test_units(void)
{
    static const int64_t change_q40[] = {0, 3 << 10, -(5 << 10), INT64_MAX / 2, -INT64_MAX / 2};
    static const int32_t before[] = {0, -3, 5, -(1 << 27), 1 << 27};
    static struct joint one;
    const struct joint_state state = {.broken = 0};
    const struct rest_sweep sweep = {.unit = 10};

    memset(&one, 0, sizeof one);
    one.work.rows = one.work.held = 5;
    for (int i = 0; i < 5; i++) {
        one.work.change_q40[i] = change_q40[i];
    }
    joint_begin(&one, &state, &sweep);
    for (int i = 0; i < 5; i++) {
        CHECK_EQ(one.work.before[i], before[i]);
    }
}

const struct test tests_solve_joint_hold[] = {
    {"solve_joint_hold/rope", test_rope},
    {"solve_joint_hold/break_owes_nothing", test_break_owes_nothing},
    {"solve_joint_hold/light_between", test_light_between},
    {"solve_joint_hold/grain", test_grain},
    {"solve_joint_hold/twice", test_twice},
    {"solve_joint_hold/units", test_units},
    {0},
};
