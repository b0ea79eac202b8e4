/* SPDX-License-Identifier: MIT */
/*
 * Springs of joints: weights on them by the closed form, what presses against a limit, a slider that
 * swings many times a frame, one that is too soft for its time; and what hangs on a body that left
 * the world.
 */
#include "body/body.h"
#include "lib/jointed.h"
#include "lib/real.h"
#include "lib/test.h"
#include "solve/joint_parts.h"

/*
 * A weight on a spring that carries three quarters of it: x = -(g / 4 w^2) (1 - cos w t). With the
 * whole impulse of a frame at its start the weight would rise.
 */
static void test_weight(void)
{
    static const double w[] = {0.05, 0.5, 2, 4}; /* radians a frame */
    static const double cosine[] = {0.9987502603949663, 0.8775825618903728, -0.4161468365471424,
                                    -0.6536436208636119};

    for (int i = 0; i < 4; i++) {
        const double g = (double)FALL / (double)ONE, most = g / 4 / (w[i] * w[i]);
        double before = cosine[i], now = 1; /* cos w (t - 1), cos w t */
        struct carom_joint_def j;
        int body;

        setup(FALL);
        body = add(0, 0, 0);
        j = joint(CAROM_JOINT_SLIDER, body, CAROM_WORLD, 0, 0, 0);
        j.drive.spring = true;
        j.drive.stiffness_q40 = real_round(w[i] * w[i] * (double)ONE);
        j.drive.rest_q32 = real_round(3 * most * (double)UNIT);
        CHECK_EQ(carom_joint_add(world, &j), 0);
        for (int t = 1; t <= 6 || t * w[i] < 6; t++) {
            double x, next = 2 * cosine[i] * now - before;

            before = now;
            now = next;
            steps(1);
            x = (double)state_of(body).position.c[2] / (double)UNIT;
            /* the phase is off by up to 0.6 % */
            CHECK_AT_MOST(real_abs(x + most * (1 - now)), most * (0.02 + 0.01 * t * w[i]));
        }
    }
}

/*
 * A spring pushes a body up, which is fixed to another one whose own slider is at its limit. All
 * stay at rest, with no velocity at the end of a frame.
 */
static void test_presses(void)
{
    struct carom_joint_def j;
    int low, high;

    setup(0);
    low = add(0, 0, 0);
    high = add(0, 0, UNIT);
    j = joint(CAROM_JOINT_SLIDER, low, CAROM_WORLD, 0, 0, 0);
    j.drive.spring = true;
    j.drive.stiffness_q40 = ONE / 100;
    j.drive.rest_q32 = UNIT / 8;
    CHECK_EQ(carom_joint_add(world, &j), 0);
    j = joint(CAROM_JOINT_SLIDER, high, CAROM_WORLD, 0, 0, UNIT);
    j.drive.limited = true;
    j.drive.lower_q32 = -UNIT;
    CHECK_EQ(carom_joint_add(world, &j), 1);
    j = joint(CAROM_JOINT_FIXED, high, low, 0, 0, UNIT / 2);
    CHECK_EQ(carom_joint_add(world, &j), 2);
    for (int i = 0; i < 30; i++) {
        steps(1);
        CHECK_LESS(carom_abs(state_of(low).position.c[2]), UNIT >> 14);
        CHECK_LESS(carom_abs(state_of(low).velocity.c[2]), ONE >> 20);
        CHECK_LESS(carom_abs(state_of(high).velocity.c[2]), ONE >> 20);
    }
}

/*
 * Two bodies far beside the axis of a slider turn as it moves, which makes its own mass small: the
 * spring swings several times a frame. It never gets farther than it began.
 */
static void test_stiff(void)
{
    struct carom_joint_def j;
    int a, b;

    setup(0);
    a = add(0, 0, 0);
    b = add(8 * UNIT, 8 * UNIT, 0);
    j = joint(CAROM_JOINT_SLIDER, a, b, 8 * UNIT, 0, 0);
    j.drive.spring = true;
    j.drive.stiffness_q40 = ONE;
    j.drive.rest_q32 = UNIT / 2;
    CHECK_EQ(carom_joint_add(world, &j), 0);
    for (int i = 0; i < 100; i++) {
        steps(1);
        CHECK_AT_LEAST(joint_of(0).coordinate_q32, -UNIT >> 3);
        CHECK_AT_MOST(joint_of(0).coordinate_q32, UNIT + (UNIT >> 3));
    }
}

/* Twice the kinetic energy of a box with sides of 1, 1/2 and 1/4 and a mass of 1. */
static double energy_of(int body)
{
    static const double inertia[3] = {5.0 / 192, 17.0 / 192, 20.0 / 192};
    struct carom_body_state s = state_of(body);
    carom_m3_q30 axes;
    int64_t spin[3];
    double sum = 0;

    fix_matrix(&axes, &s.rotation);
    fix_rotate_back(spin, &axes, s.spin.c);
    for (int k = 0; k < 3; k++) {
        double v = real(s.velocity.c[k], 40), w = real(spin[k], 40);

        sum += v * v + inertia[k] * w * w;
    }
    return sum;
}

/*
 * Two bodies swing on another one that leaves the world and stays there. They hang on that place,
 * and nothing brakes them.
 */
static void test_hangs_on_gone(void)
{
    const int64_t end = (int64_t)BODY_WORLD_LIMIT << 32;
    struct carom_joint_def j;
    struct carom_body_state now;
    double first;
    int gone, left, last;

    setup(0);
    gone = add(end - UNIT / 64, 0, 0);
    left = add(end - 2 * UNIT, 0, 0);
    j = joint(CAROM_JOINT_BALL, left, gone, end - UNIT, 0, 0);
    CHECK_EQ(carom_joint_add(world, &j), 0);
    last = add(end - 4 * UNIT, 0, 0);
    j.a = last;
    j.b = left;
    j.anchor.c[0] -= 2 * UNIT;
    CHECK_EQ(carom_joint_add(world, &j), 1);
    now = state_of(gone);
    now.velocity.c[0] = now.velocity.c[1] = ONE / 32;
    CHECK_EQ(carom_body_set(world, gone, &now), CAROM_OK);
    steps(4);
    CHECK(state_of(gone).out);
    first = energy_of(left) + energy_of(last);
    CHECK_MORE(first, 0.0);
    for (int i = 0; i < 100; i++) {
        steps(1);
        CHECK_AT_MOST(real_abs(energy_of(left) + energy_of(last) - first), first / 100);
    }
}

/*
 * A soft spring pulls for a short time: by a unit of the last place, and the change of that by
 * velocity rounds to none. So the pull does not depend on velocity, also where the row moves no body.
 */
static void test_too_soft(void)
{
    static struct body light;
    const struct carom_joint_drive drive = {.spring = true, .stiffness_q40 = 64};
    struct joint_work work;

    light.def.inverse_mass = fix_scale(CAROM_ONE_Q30, 30);
    memset(&work, 0, sizeof work);
    work.lightest = &light;
    work.rows = 1;
    work.inverse_bits = 30;
    work.law.spring = true;
    work.off_q40 = ONE;
    for (int row = 0; row < 2; row++) {
        work.inverse[0][0] = row == 0 ? 0 : CAROM_ONE_Q30;
        work.pull_q30 = CAROM_ONE_Q30 / 64;
        joint_prepare_spring(&work, &drive);
        CHECK_EQ(work.law.soft_q30, 0);
        CHECK_EQ(work.elastic_q40, 1);
    }
}

const struct test tests_solve_joint_spring[] = {
    {"solve_joint_spring/weight", test_weight},
    {"solve_joint_spring/presses", test_presses},
    {"solve_joint_spring/stiff", test_stiff},
    {"solve_joint_spring/hangs_on_gone", test_hangs_on_gone},
    {"solve_joint_spring/too_soft", test_too_soft},
    {0},
};
