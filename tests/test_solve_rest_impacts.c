/* SPDX-License-Identifier: MIT */
/* Several contacts at once. */
#include "lib/hand.h"
#include "lib/real.h"
#include "solve/parts.h"

#ifdef TEST_LONG
#define CASES 20000
#else
#define CASES 40
#endif

static double energy(void)
{
    double sum = 0;

    for (uint32_t i = 1; i < hand.rest.body_count; i++) {
        struct fix_wide e = {0, 0};

        body_add_kinetic2(&e, &hand.bodies[i], &hand.states[i], &hand.bodies[i].path.start.r);
        sum += real(e.hi, 16) + (double)e.lo * real_power2(-80);
    }
    return sum / 2;
}

/* Up to five contacts at random corners, with normals within 45 degrees of up. */
static void random_contacts(struct test_random *r, uint16_t number)
{
    int count = (int)test_random_range(r, 1, 5);

    for (int n = 0; n < count; n++) {
        uint32_t v = (uint32_t)test_random_range(r, 0, 7);
        int64_t n_long[3] = {test_random_range(r, -700, 700), test_random_range(r, -700, 700),
                             1000};
        carom_v3_q30 normal;
        int32_t arm[3];

        for (int k = 0; k < 3; k++) {
            arm[k] = hand.solid.vertices[v][k] * 1024;
        }
        carom_rotate(arm, &hand.bodies[hand_pairs[number].a].path.start.r, arm);
        fix_normalise(&normal, n_long);
        hand_touch(number, v + 8 * (uint32_t)n, arm, normal,
                   (int32_t)test_random_range(r, -800, 3 * hand.bodies[1].def.skin_q22));
    }
}

static void random_motion(struct test_random *r, int body)
{
    double v[3], w[3], size = real_power2(-(int)test_random_range(r, 0, 10));

    hand.states[body].rotation = shape_random_turn(r);
    body_normalise(&hand.states[body].rotation);
    for (int k = 0; k < 3; k++) {
        v[k] = size * real(test_random_range(r, -1000, 1000), 10);
        w[k] = size * real(test_random_range(r, -1000, 1000), 10);
    }
    v[2] -= body == 1 ? size : 0;
    hand_set_motion(body, v, w);
}

/* The bodies gain the momentum that the contacts give: P at r on a, -P at r on b. */
static void check_momenta(const struct body_state before[HAND_BODIES])
{
    carom_v3_q40 p[3] = {{{0}}};
    double l[3][3] = {{0}};

    for (uint32_t i = 0; i < hand.pool.used; i++) {
        const struct contact *c = &hand.contacts[i];

        for (int s = 0; s < 2; s++) {
            int body = s == 0 ? hand_pairs[c->key.pair].a : hand_pairs[c->key.pair].b;
            double arm[3], impulse[3], moment[3];

            for (int k = 0; k < 3; k++) {
                int64_t part = s == 0 ? c->impulse_q40.c[k] : -c->impulse_q40.c[k];

                p[body].c[k] += part;
                arm[k] = c->side[s].body
                             ? real(c->side[s].arm_q30[k], contact_arm_bits(c->side[s].body))
                             : 0;
                impulse[k] = (double)part;
            }
            real_cross(moment, arm, impulse);
            for (int k = 0; k < 3; k++) {
                l[body][k] +=
                    moment[k] + (double)(s == 0 ? rest_moment(c)->c[k] : -rest_moment(c)->c[k]);
            }
        }
    }
    for (uint32_t i = 1; i < hand.rest.body_count; i++) {
        for (int k = 0; k < 3; k++) {
            CHECK_EQ(hand.states[i].momentum.c[k] - before[i].momentum.c[k], p[i].c[k]);
            CHECK_NEAR(hand.states[i].angular.c[k] - before[i].angular.c[k], real_round(l[i][k]),
                       2 * HAND_CONTACTS);
        }
    }
}

/* Impulses push, and lie in the friction cone. */
static void check_cones(void)
{
    double mu = real(hand.bodies[1].def.friction_q16, 16), largest = 0;

    for (uint32_t i = 0; i < hand.pool.used; i++) {
        double across, along = hand_pressure(&hand.contacts[i], &across);

        largest = along > largest ? along : largest;
        /* 2e-7 is five units of the last place in which the fastest impulses are counted */
        CHECK_AT_MOST(across, mu * along + 1e-6 * largest + 2e-7);
    }
}

/*
 * Impacts at several places, or at one, between one or two moving bodies. The momentum comes from
 * the contacts, impulses are in the friction cone, and energy never rises, for any e and mu.
 */
static void test_impacts(void)
{
    struct test_random r = {1};
    uint32_t impacts = 0, rules = 0;

    hand_make_box();
    for (int n = 0; n < CASES; n++) {
        struct body_state before[HAND_BODIES];
        double e0;

        hand_begin(1 + n % 2, 1 / 2000.0);
        hand_set_surface(n % 3 ? real(test_random_range(&r, 0, 8), 3) : n % 2,
                         n % 5 ? real(test_random_range(&r, 0, 12), 3) : 0);
        random_motion(&r, 1);
        if (n % 2) {
            random_motion(&r, 2);
            body_set_mass(&hand.bodies[2], fix_scale(test_random_range(&r, 1 << 14, 1 << 24), 20));
        }
        hand_clear_contacts();
        random_contacts(&r, 0);
        if (n % 2) {
            random_contacts(&r, 1);
        }
        memcpy(before, hand.states, sizeof before);
        e0 = energy();
        CHECK_EQ(rest_solve(&hand.rest, CAROM_ONE_Q30, false), CAROM_OK);
        impacts += hand.rest.impacts > 0;
        rules += hand.rest.energy_rules;
        if (hand.rest.impacts > 0) {
            CHECK_AT_MOST(energy(), e0 * (1 + real_power2(-24)) + 1e-12);
        }
        check_momenta(before);
        check_cones();
    }
    CHECK_MORE(impacts, CASES / 4);
    CHECK_MORE(rules, 0);
    CHECK_LESS(rules, CASES / 2);
}

/* No contact closes after an inelastic impact at several places. */
static void test_plastic(void)
{
    struct test_random r = {2};

    hand_make_box();
    for (int n = 0; n < CASES; n++) {
        double v[3], w[3];

        hand_begin(1, 0);
        hand_set_surface(0, 0);
        random_motion(&r, 1);
        hand_clear_contacts();
        random_contacts(&r, 0);
        for (uint32_t i = 0; i < hand.pool.used; i++) {
            hand.contacts[i].gap_q22 = hand.bodies[1].def.skin_q22;
        }
        CHECK_EQ(rest_solve(&hand.rest, CAROM_ONE_Q30, false), CAROM_OK);
        hand_velocity_of(1, v, w);
        for (uint32_t i = 0; i < hand.pool.used && hand.rest.sweeps < REST_SWEEPS_MAX; i++) {
            double arm[3], at[3], normal[3];

            for (int k = 0; k < 3; k++) {
                arm[k] = real(contact_arm(&hand.contacts[i]).c[k], 22);
                normal[k] = real(hand.contacts[i].normal.c[k], 30);
            }
            real_cross(at, w, arm);
            for (int k = 0; k < 3; k++) {
                at[k] += v[k];
            }
            /* slow sweeps may end a little early */
            CHECK_MORE(real_dot(at, normal), -1e-4);
        }
    }
}

/*
 * An impact without rebound at a gap of 0: V.N opens a quarter of a skin in a frame, if the path does not bend back. If it
 * does, it makes up for that, and opens half a skin.
 */
static void test_target(void)
{
    const int64_t speed_q40 = -((int64_t)1 << 34);

    for (int64_t bend = -1; bend <= 1; bend++) { /* of the mean speed, which has fewer bits */
        struct contact *c = hand.contacts;
        int64_t skin_q40;

        hand_make_cube();
        hand_begin(1, 0);
        hand_set_surface(0, 0);
        hand_touch_corners(0);
        skin_q40 = carom_shl(c->skin_q22, 18);
        c->work = hand.works;
        c->speed_q40 = speed_q40;
        c->chord_q28 = (int32_t)((speed_q40 >> 12) + bend);
        rest_prepare_target(&hand.rest, c, CAROM_ONE_Q30);
        CHECK(c->impact);
        CHECK_NEAR(c->work->target_q40, bend < 0 ? 4096 + skin_q40 / 2 : skin_q40 / 4, 1 << 18);
    }
}

/* K is 1 along an axis, and 2^n along the others: it has an inverse unless its determinant is below 2^9 units. */
static void test_uneven(void)
{
    for (int n = 1; n <= 24; n++) {
        struct contact *c = hand.contacts;
        int32_t *inverse;
        int axis = n % 3;

        hand_make_cube();
        hand_begin(1, 0);
        hand_touch_corners(0);
        c->work = hand.works;
        PHASE_BEGIN(c->work->phase, CONTACT_INVERSE);
        inverse = contact_inverse(c);
        c->work->k_shift = (int8_t)(n + 2);
        for (int k = 0; k < 6; k++) { /* the largest has 29 bits */
            inverse[k] = k >= 3 ? 0 : k == axis ? 1 << (28 - n) : 1 << 28;
        }
        rest_invert(c);
        /* the determinant is 2^28 2^28 2^(28 - n) over 2^60 */
        CHECK_EQ(c->work->inverted, 24 - n >= 9);
        for (int k = 0; k < 6 && c->work->inverted; k++) {
            CHECK_NEAR(inverse[k], k >= 3 ? 0 : k == axis ? CAROM_ONE_Q30 : CAROM_ONE_Q30 >> n, 1);
        }
    }
}

const struct test tests_solve_rest_impacts[] = {
    {"solve_rest_impacts/impacts", test_impacts},
    {"solve_rest_impacts/plastic", test_plastic},
    {"solve_rest_impacts/target", test_target},
    {"solve_rest_impacts/uneven", test_uneven},
    {0},
};
