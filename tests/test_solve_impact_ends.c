/* SPDX-License-Identifier: MIT */
/*
 * Impacts at the ends of the solver's numbers: an approach that its unit does not show beside V, a slip that is rounding, a contact that
 * wedges exactly, an impulse of less than the last place.
 */
#include "solve/rows.h"
#include "lib/real.h"
#include "lib/test.h"

#define ONE ((int64_t)1 << 40)

static struct gauss w;
static struct impact_result out;

/* A body of some mass touches something that is stationary; I is `inertia_q30` m about each axis. */
static struct impact touch(int64_t mass_q20, int32_t inertia_q30, double x, double y, double z)
{
    struct impact in = {.a = {.moving = true}};
    const double arm[3] = {x, y, z};

    in.a.inverse_mass = fix_scaled_inverse(fix_scale(mass_q20, 20));
    in.a.inertia.e = 30;
    in.a.arm.e = 22;
    for (int k = 0; k < 3; k++) {
        in.a.inertia.m[k] = inertia_q30;
        in.a.arm.c[k] = (int32_t)(arm[k] * (1 << 22));
    }
    in.normal.c[2] = CAROM_ONE_Q30;
    return in;
}

/* Without inertia nothing can be solved, with friction or without. */
static void no_solution(void)
{
    struct impact in = touch(1 << 20, 0, 0, 0, -1);

    in.velocity.c[2] = -ONE;
    for (int friction = 0; friction < 2; friction++) {
        in.friction_q16 = (uint32_t)friction << 15;
        out.normal_q40 = 77;
        CHECK_EQ(impact_solve(&w, &in, &out), CAROM_ERR_RANGE);
        CHECK_EQ(out.normal_q40, 77);
    }
}

/*
 * N is (1, 1, 1) / sqrt(3), and the contact pushes through the centre. V.N < 0 and no slip is to be left, so P = -m V = (-0.5025,
 * 0.4975, 0.4975) units of the last place, within mu = 4. Rounded it is (-1, 0, 0), which would pull.
 */
static void last_place(void)
{
    struct impact in = touch((1 << 20) / 199, CAROM_ONE_Q30 / 2, 0, 0, 0);

    for (int k = 0; k < 3; k++) {
        in.normal.c[k] = 619925131; /* 2^30 / sqrt(3) */
        in.velocity.c[k] = k == 0 ? 100 : -99;
    }
    in.friction_q16 = 4 << 16;
    CHECK_EQ(impact_solve(&w, &in, &out), CAROM_OK);
    CHECK(!out.slid);
    CHECK_EQ(out.impulse.c[0], -1);
    CHECK_EQ(out.impulse.c[1], 0);
    CHECK_EQ(out.impulse.c[2], 0);
    CHECK_EQ(out.normal_q40, 0);
}

/*
 * The target is 2^-20 above V.N = -1, and V slips by 2^-30: less than N's rounding, so friction has no direction; but more than mu =
 * 2^-16 can hold. No slip is left to be opposed: P is m 2^-20 along N.
 */
static void no_direction(void)
{
    struct impact in = touch(3 << 20, CAROM_ONE_Q30 / 2, 0, 0, -1);

    in.velocity.c[0] = ONE >> 30;
    in.velocity.c[2] = -ONE;
    in.target_q40 = -ONE + (ONE >> 20);
    in.friction_q16 = 1;
    CHECK_EQ(impact_solve(&w, &in, &out), CAROM_OK);
    CHECK(out.slid);
    CHECK_EQ(out.impulse.c[0], 0);
    CHECK_EQ(out.impulse.c[1], 0);
    CHECK_NEAR(out.impulse.c[2], 3 * (ONE >> 20), 1);
}

/*
 * V.N is to grow by 2^-40, and V by the normal is 2^11: in the unit that holds V it is nothing. P.N is at most a unit of the last place,
 * and so is mu P.N, whatever the slip is.
 */
static void hidden_approach(void)
{
    for (int slip = 0; slip < 3; slip++) {
        struct impact in = touch(1 << 20, CAROM_ONE_Q30 / 2, 0, 0, -1);

        in.velocity.c[0] = slip == 0 ? 0 : slip == 1 ? 1 << 16 : 1 << 30;
        in.velocity.c[2] = -2048 * ONE;
        in.target_q40 = in.velocity.c[2] + 1;
        in.friction_q16 = 1 << 16;
        CHECK_EQ(impact_solve(&w, &in, &out), CAROM_OK);
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(out.impulse.c[k], 0, 1);
        }
        CHECK_NEAR(out.normal_q40, 0, 1);
    }
}

/*
 * V.N is short of the target by N's rounding alone: by 2^-70 for a slow V, by 46341 2^-70 for a fast one that slips. No impulse, but no
 * error.
 */
static void rounding_of_normal(void)
{
    for (int n = 0; n < 4; n++) {
        struct impact in = touch(1 << 20, CAROM_ONE_Q30 / 2, 0, 0, -1);

        in.normal.c[0] = 46341; /* sqrt(2^31) */
        in.normal.c[2] = CAROM_ONE_Q30 - 1;
        in.velocity.c[2] = in.target_q40 = 1;
        if (n / 2) {
            in.velocity.c[0] = -(1 << 30) - 1;
            in.velocity.c[2] = -2048 * ONE;
            in.target_q40 = in.velocity.c[2] + (1 << 21) - 46341;
        }
        in.friction_q16 = n % 2 ? 1 << 16 : 0;
        CHECK_EQ(impact_solve(&w, &in, &out), CAROM_OK);
        for (int k = 0; k < 3; k++) {
            CHECK_EQ(out.impulse.c[k], 0);
        }
        CHECK_EQ(out.normal_q40, 0);
    }
}

/*
 * m = 1, I = (64, 1/2, 64) and an arm of (2, 0, -1): K is 1 + (1/64 + 4/64) along y, and ((3, 4), (4, 9)) in x and z. A slip along (3/5,
 * 4/5) at mu = 15/4 gives N.K (N - mu t) = 9 - 15/4 3/5 4 = 0: no impulse of a sliding contact changes V.N. So P is on the way from the
 * frictionless impulse to the sticking one, where it meets the cone. A little more friction hardly changes that.
 */
static void wedges(void)
{
    const double speed = 10, approach = 1.0 / 16, free = approach / 9;
    const double stick[3] = {-(9 * 0.6 * speed + 4 * approach) / 11, -0.8 * speed * 64 / 69,
                             (4 * 0.6 * speed + 3 * approach) / 11};
    const double across = real_sqrt(stick[0] * stick[0] + stick[1] * stick[1]);
    const double part = 3.75 * free / (across - 3.75 * (stick[2] - free));

    CHECK_LESS(part, 1); /* the sticking impulse is outside */
    for (int more = 0; more < 20; more++) {
        struct impact in = touch(1 << 20, 0, 2, 0, -1);

        in.a.inertia = (struct carom_sym3){{64 << 23, 1 << 22, 64 << 23, 0, 0, 0}, 23};
        in.velocity.c[0] = 6 * ONE;
        in.velocity.c[1] = 8 * ONE;
        in.velocity.c[2] = -ONE / 16;
        in.friction_q16 = (uint32_t)((15 << 14) + more);
        CHECK_EQ(impact_solve(&w, &in, &out), CAROM_OK);
        CHECK(out.slid && !out.energy_rule);
        CHECK_LESS(real_abs(real(out.impulse.c[0], 40) - part * stick[0]), 1e-3);
        CHECK_LESS(real_abs(real(out.impulse.c[1], 40) - part * stick[1]), 1e-3);
        CHECK_LESS(real_abs(real(out.impulse.c[2], 40) - free - part * (stick[2] - free)), 1e-3);
        CHECK_NEAR(out.normal_q40, out.impulse.c[2], 1);
    }
}

/*
 * An arm of (x, 0, -z) and I = 1/8 wedge at mu = (I + x^2) / (x z). Here mu is rounded, and less by some units: the impulse is up to 2^20
 * times that of an impact without friction. It is taken if it is below 2^17 units, and else there is none.
 */
static void almost_wedges(void)
{
    struct test_random r = {7};
    int taken = 0;

    for (int n = 0; n < 400; n++) {
        const double x = real(test_random_range(&r, 300, 900), 10);
        const double z = real(test_random_range(&r, 300, 900), 10);
        struct impact in = touch(1 << 20, CAROM_ONE_Q30 / 8, x, 0, -z);
        struct impact_problem p = {.gauss = &w, .in = &in, .frame = {.n = in.normal}};
        struct impact_answer x_slides;

        in.velocity.c[0] = ONE;
        in.velocity.c[2] = -ONE;
        in.friction_q16 = (uint32_t)(real_round((1. / 8 + x * x) / (x * z) * 65536) - n % 16);
        p.wanted_q70 = fix_wide_mul(ONE, CAROM_ONE_Q30);
        impact_prepare(&p);
        CHECK(impact_set_frame(&p.frame, in.velocity.c));
        if (impact_slide(&p, in.friction_q16, &x_slides) == 0) {
            taken++;
            for (int k = 0; k < 3; k++) {
                CHECK_LESS(carom_abs(x_slides.p_q40[k]), (int64_t)1 << 57);
            }
        }
    }
    CHECK_MORE(taken, 20);
    CHECK_LESS(taken, 380);
}

/*
 * Without a slip u is across N and the axis from which N is farthest, so it has no part along that axis; v is across both. They are
 * unit vectors, whichever axis it is.
 */
static void no_slip(void)
{
    static const double lengths[3] = {0.1, 0.6, 0.79};
    static const int64_t none[3] = {0, 0, 0};

    for (int n = 0; n < 6; n++) {
        struct impact_frame f;
        int64_t normal[3];
        int far = n % 3;

        normal[far] = (int64_t)(lengths[0] * (double)ONE);
        normal[(far + 1) % 3] = -(int64_t)(lengths[n < 3 ? 1 : 2] * (double)ONE);
        normal[(far + 2) % 3] = (int64_t)(lengths[n < 3 ? 2 : 1] * (double)ONE);
        fix_normalise(&f.n, normal);
        CHECK(!impact_set_frame(&f, none));
        CHECK_EQ(f.u.c[far], 0);
        CHECK_NEAR(carom_dot(f.u.c, f.u.c) >> 30, CAROM_ONE_Q30, 4);
        CHECK_NEAR(carom_dot(f.v.c, f.v.c) >> 30, CAROM_ONE_Q30, 4);
        CHECK_NEAR(carom_dot(f.u.c, f.n.c) >> 30, 0, 4);
        CHECK_NEAR(carom_dot(f.v.c, f.n.c) >> 30, 0, 4);
        CHECK_NEAR(carom_dot(f.u.c, f.v.c) >> 30, 0, 4);
    }
}

/*
 * I about z is 2^-29 of that about x and y, less than the elimination tells from 0: where the contact slides along its slip, where it
 * slides though V has no slip, and where sticking would gain energy, no frictionless impulse is found. Only where P sticks it is not
 * needed.
 */
static void thin(void)
{
    static const struct {
        double slip;
        uint32_t friction_q16;
        bool elastic;
        int result;
    } cases[] = {{-1, 1 << 10, false, CAROM_ERR_RANGE},
                 {0, 1 << 10, false, CAROM_ERR_RANGE},
                 {-0.5, 4 << 16, true, CAROM_ERR_RANGE},
                 {-0.5, 4 << 16, false, CAROM_OK}};

    for (int n = 0; n < 4; n++) {
        struct impact in = touch(1 << 20, CAROM_ONE_Q30 / 2, 1, 0, -1);

        in.a.inertia.m[2] = 1;
        in.velocity.c[0] = (int64_t)(cases[n].slip * (double)ONE);
        in.velocity.c[2] = -ONE;
        in.target_q40 = cases[n].elastic ? ONE : 0;
        in.friction_q16 = cases[n].friction_q16;
        out.normal_q40 = 77;
        CHECK_EQ(impact_solve(&w, &in, &out), cases[n].result);
        CHECK_EQ(out.normal_q40 == 77, cases[n].result < 0);
    }
}

const struct test tests_solve_impact_ends[] = {
    {"solve_impact_ends/no_solution", no_solution},
    {"solve_impact_ends/last_place", last_place},
    {"solve_impact_ends/no_direction", no_direction},
    {"solve_impact_ends/hidden_approach", hidden_approach},
    {"solve_impact_ends/rounding_of_normal", rounding_of_normal},
    {"solve_impact_ends/wedges", wedges},
    {"solve_impact_ends/almost_wedges", almost_wedges},
    {"solve_impact_ends/no_slip", no_slip},
    {"solve_impact_ends/thin", thin},
    {0},
};
