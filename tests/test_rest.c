/* SPDX-License-Identifier: MIT */
#include "real.h"
#include "rest.h"
#include "shapes.h"
#include "test.h"

#ifdef TEST_LONG
#define CASES 20000
#else
#define CASES 40
#endif

#define CONTACTS 16

/* Body 0 is the ground, the others may move. */
#define BODIES 4
static struct shape ground, solid;
static struct body bodies[BODIES];
static struct body_state states[BODIES];
static const struct pair pairs[4] = {{1, 0}, {2, 1}, {3, 0}, {2, 0}};
static struct contact contacts[CONTACTS];
static struct rest_warm warm[CONTACTS];
static struct pool pool;
static struct rest rest;
static struct boyse_pair pair;

static int64_t q40(double v)
{
    return real_round(v * real_power2(40));
}

static void set_surface(double e, double mu)
{
    for (int i = 0; i < BODIES; i++) {
        bodies[i].restitution_q30 = (int32_t)real_round(e * CAROM_ONE_Q30);
        bodies[i].friction_q16 = (uint32_t)real_round(mu * 65536);
    }
}

static void set_motion(int body, const double v[3], const double w[3])
{
    carom_v3_q40 v_q40, w_q40;

    for (int k = 0; k < 3; k++) {
        v_q40.c[k] = q40(v[k]);
        w_q40.c[k] = q40(w[k]);
    }
    body_set_motion(&bodies[body], &states[body], &v_q40, &w_q40);
}

static void set_gravity(double x, double y, double z)
{
    for (int i = 0; i < BODIES; i++) {
        bodies[i].acceleration = (carom_v3_q40){{q40(x), q40(y), q40(z)}};
        bodies[i].acceleration_q40 = fix_length(bodies[i].acceleration.c);
    }
}

/* Forget the contacts; the paths are what contacts refer to. */
static void clear_contacts(void)
{
    pool = (struct pool){CONTACTS, 0, 0, 0};
    rest.sweeps = rest.impacts = rest.energy_rules = 0;
    for (int i = 0; i < BODIES; i++) {
        body_place(&bodies[i], &states[i]);
        bodies[i].in_contact = false;
    }
}

/* A solve over the ground and the first `moving` solids, all in the origin. */
static void begin(int moving, double fall)
{
    memset(&rest, 0, sizeof rest);
    for (int i = 0; i < BODIES; i++) {
        shape_body(i == 0 ? &ground : &solid, i > 0, &bodies[i], &states[i]);
    }
    set_gravity(0, 0, -fall);
    rest.list = (struct contact_list){contacts, &pool};
    rest.pairs = pairs;
    rest.bodies = bodies;
    rest.states = states;
    rest.body_count = (uint32_t)moving + 1;
    rest.warm = warm;
    clear_contacts();
}

/* A cube of side 1 and mass 1: J is 1/6 about every axis. Or a box of 1 x 0.6 x 0.3. */
static void make_cube(void)
{
    shape_plane(&ground, 9, 2, 4096);
    shape_box(&solid, 12, 4096, 4096, 4096);
}

static void make_box(void)
{
    shape_plane(&ground, 9, 2, 4096);
    shape_box(&solid, 12, 4096, 2458, 1228);
}

/*
 * A contact of a pair by hand, at a place from the centre of its first body, which the second
 * body's place must match. Every place has a vertex of its own.
 */
static void touch(uint16_t number, uint32_t vertex, const int32_t arm_q22[3], carom_v3_q30 normal,
                  int32_t gap_q22)
{
    const struct candidate key = {number, CANDIDATE_VERTEX_FACE, vertex, 0};
    const struct pair *p = &pairs[number];
    carom_v3_q40 arm[2];

    boyse_pair_init(&pair, &bodies[p->a], &bodies[p->b]);
    for (int k = 0; k < 3; k++) {
        arm[0].c[k] = carom_shl(arm_q22[k], 18);
        arm[1].c[k] =
            arm[0].c[k] + carom_shl(states[p->a].position.c[k] - states[p->b].position.c[k], 8);
    }
    CHECK(contact_insert(&rest.list, &pair, &key, &normal, gap_q22, arm));
}

static const carom_v3_q30 up = {{0, 0, CAROM_ONE_Q30}};

/* The four lower corners of a pair's first box, its sides along the axes. */
static void touch_corners_of(uint16_t number, int32_t gap_q22)
{
    for (uint32_t v = 0; v < 4; v++) {
        int32_t arm[3];

        for (int k = 0; k < 3; k++) {
            arm[k] = solid.vertices[v][k] * 1024;
        }
        touch(number, v, arm, up, gap_q22);
    }
}

static void touch_corners(int32_t gap_q22)
{
    touch_corners_of(0, gap_q22);
}

static void velocity_of(int body, double v[3], double w[3])
{
    carom_v3_q40 v_q40, w_q40;

    body_velocity(&bodies[body], &states[body], &v_q40);
    body_spin(&bodies[body], &states[body], &bodies[body].path.start.r, &w_q40);
    for (int k = 0; k < 3; k++) {
        v[k] = real(v_q40.c[k], 40);
        w[k] = real(w_q40.c[k], 40);
    }
}

static double energy(void)
{
    double sum = 0;

    for (uint32_t i = 1; i < rest.body_count; i++) {
        struct fix_wide e = body_kinetic2(&bodies[i], &states[i], &bodies[i].path.start.r);

        sum += real(e.hi, 16) + (double)e.lo * real_power2(-80);
    }
    return sum / 2;
}

/* P along the normal, and its length across, of one contact. */
static double pressure(const struct contact *c, double *across)
{
    double p[3], n[3], along;

    for (int k = 0; k < 3; k++) {
        p[k] = real(c->impulse_q40.c[k], 40);
        n[k] = real(c->normal.c[k], 30);
    }
    along = real_dot(p, n);
    for (int k = 0; k < 3; k++) {
        p[k] -= along * n[k];
    }
    *across = real_length(p);
    return along;
}

/* ----------------------------------------------------------------- one impact */

/* A contact right under the centre of mass: no spin by the normal impulse, P = m (1 + e) v. */
static void test_particle(void)
{
    static const int32_t below[3] = {0, 0, -(1 << 21)};

    make_cube();
    for (int n = 0; n <= 8; n++) {
        double e = n / 8.0, v[3], w[3], across;

        begin(1, 1 / 1024.0);
        set_surface(e, 0);
        set_motion(1, (double[3]){0.0625, -0.03125, -0.25}, (double[3]){0, 0, 0});
        touch(0, 0, below, up, 0);
        CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, false), CAROM_OK);
        velocity_of(1, v, w);
        CHECK(real_abs(v[2] - 0.25 * e) < 1e-9);
        CHECK(real_abs(v[0] - 0.0625) < 1e-9 && real_abs(v[1] + 0.03125) < 1e-9);
        CHECK(real_length(w) < 1e-9);
        CHECK(real_abs(pressure(&contacts[0], &across) - 0.25 * (1 + e)) < 1e-9);
        CHECK(across < 1e-9);
        CHECK(rest.impacts == 1 && rest.sweeps == 0);
    }
}

/*
 * The same with friction and slip v along x. The slip ends by an impulse m v / (1 + m r^2 / I),
 * r^2 / J = 1/4 * 6; less than that when mu m (1 + e) |v_n| is less.
 */
static void test_particle_friction(void)
{
    static const int32_t below[3] = {0, 0, -(1 << 21)};

    make_cube();
    for (int n = 0; n <= 8; n++) {
        double mu = n / 8.0, v[3], w[3], across, needed = 0.25 / 2.5, limit = mu * 0.25 * 1.5;

        begin(1, 1 / 1024.0);
        set_surface(0.5, mu);
        set_motion(1, (double[3]){0.25, 0, -0.25}, (double[3]){0, 0, 0});
        touch(0, 0, below, up, 0);
        CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, false), CAROM_OK);
        velocity_of(1, v, w);
        CHECK(real_abs(pressure(&contacts[0], &across) - 0.375) < 1e-8);
        CHECK(real_abs(across - (limit < needed ? limit : needed)) < 1e-8);
        CHECK(real_abs(v[0] - (0.25 - across)) < 1e-8);
        /* r x P = (0, 0, -1/2) x (-across, 0, 0), I = 1/6 */
        CHECK(real_abs(w[1] - 3 * across) < 1e-7);
    }
}

/* ------------------------------------------------------------------- resting */

/* A box at rest is held up by m g in one frame, and does not move. */
static void test_weight(void)
{
    double v[3], w[3], sum = 0, across;

    make_box();
    begin(1, 1 / 367.0);
    set_surface(0.5, 0.5);
    touch_corners(bodies[1].skin_q22);
    CHECK(rest_enter_contact(&rest, CAROM_ONE_Q30));
    CHECK(bodies[1].in_contact);
    velocity_of(1, v, w);
    CHECK(real_abs(v[2] + 1 / 367.0) < 1e-9);
    CHECK(!rest_enter_contact(&rest, CAROM_ONE_Q30)); /* once a frame */
    velocity_of(1, v, w);
    CHECK(real_abs(v[2] + 1 / 367.0) < 1e-9);
    CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, true), CAROM_OK);
    CHECK_EQ(rest.impacts, 0);
    for (uint32_t i = 0; i < 4; i++) {
        double p = pressure(&contacts[i], &across);

        CHECK(p >= 0);
        sum += p;
    }
    CHECK(real_abs(sum / (real(solid.mesh.mass.volume_q32, 32) / 367.0) - 1) < 1e-3);
    velocity_of(1, v, w);
    CHECK(real_length(v) < 1e-3 / 367 && real_length(w) < 4e-3 / 367);
    CHECK_EQ(rest.warm_count, 4);
}

/* A second frame starts from the impulses of the first and needs fewer sweeps. */
static void test_warm(void)
{
    uint32_t cold;
    double v[3], w[3];

    make_box();
    begin(1, 1 / 367.0);
    set_surface(0.5, 0.5);
    for (int frame = 0; frame < 3; frame++) {
        clear_contacts();
        set_motion(1, (double[3]){0, 0, 0}, (double[3]){0, 0, 0});
        touch_corners(bodies[1].skin_q22);
        CHECK(rest_enter_contact(&rest, CAROM_ONE_Q30));
        CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, true), CAROM_OK);
        if (frame == 0) {
            cold = rest.sweeps;
            CHECK(cold > 2);
        } else {
            CHECK(rest.sweeps < cold);
        }
        velocity_of(1, v, w);
        CHECK(real_length(v) < 1e-3 / 367);
    }
    /* the impulses of other bodies, places or normals are not these */
    for (int change = 0; change < 3; change++) {
        clear_contacts();
        set_motion(1, (double[3]){0, 0, 0}, (double[3]){0, 0, 0});
        touch_corners(bodies[1].skin_q22);
        CHECK_EQ(rest.warm_count, 4);
        for (int i = 0; i < 4; i++) {
            warm[i].b = (uint16_t)(change == 0 ? 2 : warm[i].b);
            warm[i].arm.c[2] += change == 1 ? 1 << 21 : 0;
            warm[i].normal = change == 2 ? (carom_v3_q30){{CAROM_ONE_Q30, 0, 0}} : warm[i].normal;
        }
        CHECK(rest_enter_contact(&rest, CAROM_ONE_Q30));
        CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, true), CAROM_OK);
        CHECK_EQ(rest.sweeps, cold);
    }
    /* no contacts, nothing to keep */
    clear_contacts();
    CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, true), CAROM_OK);
    CHECK_EQ(rest.warm_count, 0);
}

/* A ramp of 20 degrees: tan is 0.364. Friction of 0.5 holds the box, of 0.3 does not. */
static void test_ramp(void)
{
    const double sine = 0.34202014332566873, cosine = 0.93969262078590838, g = 1 / 367.0;

    make_box();
    for (int slides = 0; slides < 2; slides++) {
        double mu = slides ? 0.3 : 0.5, v[3], w[3];

        begin(1, g);
        set_surface(0.5, mu);
        set_gravity(g * sine, 0, -g * cosine);
        for (int frame = 1; frame <= 10; frame++) {
            clear_contacts();
            touch_corners(bodies[1].skin_q22);
            CHECK(rest_enter_contact(&rest, CAROM_ONE_Q30));
            CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, true), CAROM_OK);
            velocity_of(1, v, w);
            if (slides) {
                CHECK(real_abs(v[0] / (frame * g * (sine - mu * cosine)) - 1) < 1e-2);
            } else {
                CHECK(real_abs(v[0]) < 2e-3 * g);
            }
            CHECK(real_abs(v[1]) < 2e-3 * g && real_abs(v[2]) < 2e-3 * g);
            CHECK(real_length(w) < 1e-2 * g);
        }
    }
}

/* Gaps: what is open may close in the time that is left; what overlaps opens slowly. */
static void test_gaps(void)
{
    static const int32_t below[3] = {0, 0, -(1 << 21)};
    double skin, v[3], w[3], across;

    make_cube();
    begin(1, 1 / 367.0);
    skin = real(bodies[1].skin_q22, 22);
    set_surface(0.5, 0);
    for (int n = 0; n < 4; n++) {
        int32_t tau_q30 = n == 3 ? CAROM_ONE_Q30 / 4 : CAROM_ONE_Q30;
        int32_t gap = (n == 2 ? 0 : 3) * bodies[1].skin_q22;
        double speed = n == 0 ? -1 * skin : n == 2 ? 0 : -9 * skin;

        clear_contacts();
        set_motion(1, (double[3]){0, 0, speed}, (double[3]){0, 0, 0});
        touch(0, 0, below, up, gap);
        CHECK_EQ(rest_solve(&rest, tau_q30, false), CAROM_OK);
        velocity_of(1, v, w);
        CHECK(real_length(w) < 1e-8);
        if (n == 0) { /* it does not get there */
            CHECK(v[2] == speed && pressure(&contacts[0], &across) == 0);
        } else {
            /* stops at the skin; leaves (the deeper half at a fifth a frame); has a quarter of a frame to close two skins */
            CHECK(real_abs(v[2] - (n == 1   ? -2 * skin
                                   : n == 2 ? skin / 64 + skin / 10
                                            : -8 * skin)) < 3e-8);
        }
    }
}

/* Bodies that bounce without loss, and those that are too fast, do not enter contact. */
static void test_enter(void)
{
    make_cube();
    for (int n = 0; n < 4; n++) {
        double g = 1 / 367.0, v[3], w[3];

        begin(1, g);
        set_surface(n == 1 ? 1 : 0.5, 0);
        set_motion(1,
                   (double[3]){0, 0,
                               n == 2   ? -4.01 * g
                               : n == 3 ? -3.99 * g
                                        : 0},
                   (double[3]){0, 0, 0});
        touch_corners(bodies[1].skin_q22);
        CHECK_EQ(rest_enter_contact(&rest, CAROM_ONE_Q30 / 2), n == 0 || n == 3);
        velocity_of(1, v, w);
        if (n == 0) {
            CHECK(real_abs(v[2] + g / 2) < 1e-9); /* of the time that is left */
        }
    }
    bodies[0].restitution_q30 = 5;
    bodies[1].restitution_q30 = 3;
    bodies[0].friction_q16 = 7;
    bodies[1].friction_q16 = 9;
    CHECK_EQ(rest_restitution(&bodies[0], &bodies[1]), 3);
    CHECK_EQ(rest_friction(&bodies[1], &bodies[0]), 7);
}

/* ---------------------------------------------------------------- any contacts */

/* Up to five contacts of random corners, normals within half a right angle of up. */
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
            arm[k] = solid.vertices[v][k] * 1024;
        }
        carom_rotate(arm, &bodies[pairs[number].a].path.start.r, arm);
        fix_normalise(&normal, n_long);
        touch(number, v + 8 * (uint32_t)n, arm, normal,
              (int32_t)test_random_range(r, -800, 3 * bodies[1].skin_q22));
    }
}

static void random_motion(struct test_random *r, int body)
{
    double v[3], w[3], size = real_power2(-(int)test_random_range(r, 0, 10));

    states[body].rotation = shape_random_turn(r);
    body_normalise(&states[body].rotation);
    for (int k = 0; k < 3; k++) {
        v[k] = size * real(test_random_range(r, -1000, 1000), 10);
        w[k] = size * real(test_random_range(r, -1000, 1000), 10);
    }
    v[2] -= body == 1 ? size : 0;
    set_motion(body, v, w);
}

/* What the bodies gained is what the contacts gave: P at r on a, -P at r on b. */
static void check_momenta(const struct body_state before[BODIES])
{
    carom_v3_q40 p[3] = {{{0}}};
    double l[3][3] = {{0}};

    for (uint32_t i = 0; i < pool.used; i++) {
        const struct contact *c = &contacts[i];

        for (int s = 0; s < 2; s++) {
            int body = s == 0 ? pairs[c->key.pair].a : pairs[c->key.pair].b;
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
                l[body][k] += moment[k] +
                              (double)(s == 0 ? c->roll.moment_q40.c[k] : -c->roll.moment_q40.c[k]);
            }
        }
    }
    for (uint32_t i = 1; i < rest.body_count; i++) {
        for (int k = 0; k < 3; k++) {
            CHECK_EQ(states[i].momentum.c[k] - before[i].momentum.c[k], p[i].c[k]);
            CHECK_NEAR(states[i].angular.c[k] - before[i].angular.c[k], real_round(l[i][k]),
                       2 * CONTACTS);
        }
    }
}

/* Impulses push, and lie in the friction cone. */
static void check_cones(void)
{
    double mu = real(bodies[1].friction_q16, 16), largest = 0;

    for (uint32_t i = 0; i < pool.used; i++) {
        double across, along = pressure(&contacts[i], &across);

        largest = along > largest ? along : largest;
        /* 1e-8 is five units of the last place in which the fastest impulses are counted */
        CHECK(across <= mu * along + 1e-6 * largest + 1e-8);
    }
}

/*
 * Impacts at several places, and at one, between one or two moving bodies: momentum is what the
 * contacts gave, impulses are in the friction cone, and energy never rises, whatever e and mu.
 */
static void test_impacts(void)
{
    struct test_random r = {1};
    uint32_t impacts = 0, rules = 0;

    make_box();
    for (int n = 0; n < CASES; n++) {
        struct body_state before[BODIES];
        double e0;

        begin(1 + n % 2, 1 / 2000.0);
        set_surface(n % 3 ? real(test_random_range(&r, 0, 8), 3) : n % 2,
                    n % 5 ? real(test_random_range(&r, 0, 12), 3) : 0);
        random_motion(&r, 1);
        if (n % 2) {
            random_motion(&r, 2);
            body_set_mass(&bodies[2], fix_scale(test_random_range(&r, 1 << 14, 1 << 24), 20));
        }
        clear_contacts();
        random_contacts(&r, 0);
        if (n % 2) {
            random_contacts(&r, 1);
        }
        memcpy(before, states, sizeof before);
        e0 = energy();
        CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, false), CAROM_OK);
        impacts += rest.impacts > 0;
        rules += rest.energy_rules;
        if (rest.impacts > 0) {
            CHECK(energy() <= e0 * (1 + real_power2(-24)) + 1e-12);
        }
        check_momenta(before);
        check_cones();
    }
    CHECK(impacts > CASES / 4);
    CHECK(rules > 0 && rules < CASES / 2);
}

/* No contact closes after an inelastic impact at several places. */
static void test_plastic(void)
{
    struct test_random r = {2};

    make_box();
    for (int n = 0; n < CASES; n++) {
        double v[3], w[3];

        begin(1, 0);
        set_surface(0, 0);
        random_motion(&r, 1);
        clear_contacts();
        random_contacts(&r, 0);
        for (uint32_t i = 0; i < pool.used; i++) {
            contacts[i].gap_q22 = bodies[1].skin_q22;
        }
        CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, false), CAROM_OK);
        velocity_of(1, v, w);
        for (uint32_t i = 0; i < pool.used && rest.sweeps < REST_SWEEPS_MAX; i++) {
            double arm[3], at[3], normal[3];

            for (int k = 0; k < 3; k++) {
                arm[k] = real(contacts[i].side[0].arm.c[k], 22);
                normal[k] = real(contacts[i].normal.c[k], 30);
            }
            real_cross(at, w, arm);
            for (int k = 0; k < 3; k++) {
                at[k] += v[k];
            }
            /* slow sweeps may end a little early */
            CHECK(real_dot(at, normal) > -1e-4);
        }
    }
}

/* ---------------------------------------------------------------------- sleep */

static void frame_of_sleep(const struct pair *touching, uint32_t count)
{
    rest_sleep(bodies, states, rest.body_count, touching, count);
}

static void test_sleep(void)
{
    const carom_v3_q40 zero = {{0, 0, 0}};
    int frames = 0;

    make_cube();
    begin(1, 1 / 367.0);
    bodies[1].in_contact = true;
    set_motion(1, (double[3]){1e-5, 0, 0}, (double[3]){0, 1e-5, 0});
    while (!states[1].asleep && frames < 100) {
        frame_of_sleep(pairs, 1);
        frames++;
    }
    CHECK_EQ(frames, 20);
    CHECK(memcmp(&states[1].momentum, &zero, sizeof zero) == 0);
    CHECK(memcmp(&states[1].angular, &zero, sizeof zero) == 0);
    CHECK(!states[0].asleep); /* what does not move need not sleep */

    /* one frame that is too fast, or without a contact, starts the count again */
    for (int n = 0; n < 3; n++) {
        states[1].asleep = states[1].quiet = 0;
        for (int frame = 0; frame < 19; frame++) {
            frame_of_sleep(pairs, 1);
        }
        CHECK_EQ(states[1].quiet, 19);
        bodies[1].in_contact = n != 2;
        set_motion(1, (double[3]){n == 0 ? 1. / 367 / 7 : 0, 0, 0},
                   (double[3]){0, 0, n == 1 ? 1. / 367 / 6 : 0});
        frame_of_sleep(pairs, 1);
        CHECK(states[1].quiet == 0 && !states[1].asleep);
        set_motion(1, (double[3]){0, 0, 0}, (double[3]){0, 0, 0});
        bodies[1].in_contact = true;
    }
}

/*
 * Bodies that touch fall asleep together, however long the chain; those that do not, each for
 * itself.
 */
static void test_islands(void)
{
    static const struct pair chain[3] = {{1, 0}, {2, 1}, {3, 2}},
                             apart[3] = {{1, 0}, {2, 0}, {3, 0}};

    make_cube();
    for (int touching = 0; touching < 2; touching++) {
        const struct pair *island = touching ? chain : apart;

        begin(3, 1 / 367.0);
        bodies[1].in_contact = bodies[2].in_contact = bodies[3].in_contact = true;
        set_motion(3, (double[3]){0.1, 0, 0}, (double[3]){0, 0, 0});
        for (int frame = 0; frame < 30; frame++) {
            rest_sleep(bodies, states, 4, island, 3);
        }
        CHECK(states[1].asleep == !touching && states[2].asleep == !touching);
        CHECK(!states[3].asleep);
        set_motion(3, (double[3]){0, 0, 0}, (double[3]){0, 0, 0});
        for (int frame = 0; frame < 19; frame++) {
            rest_sleep(bodies, states, 4, island, 3);
            CHECK(!states[3].asleep);
        }
        for (int frame = 0; frame < 2; frame++) {
            rest_sleep(bodies, states, 4, island, 3);
        }
        CHECK(states[1].asleep && states[2].asleep && states[3].asleep);
    }
}

/*
 * Two islands: 1 and 2, which touch each other and the ground, and 3, which has pairs between
 * theirs. With a bit for each: which of them have contacts.
 */
enum { TWO = 1, ONE = 2 };

static void begin_apart(int islands, double fall, double one_gap)
{
    static const int32_t on_top[3] = {1 << 18, 1 << 17, -(1 << 21)};

    begin(3, fall);
    set_surface(0.5, 0.5);
    set_motion(1, (double[3]){0.001, 0, -fall}, (double[3]){0, 0, 0.002});
    set_motion(2, (double[3]){0, -0.003, -fall}, (double[3]){0.001, 0, 0});
    set_motion(3, (double[3]){3, 1, -8}, (double[3]){0.5, -0.3, 0.1});
    if (islands & TWO) {
        touch_corners_of(0, bodies[1].skin_q22);
        touch(1, 9, on_top, up, bodies[1].skin_q22);
        touch_corners_of(3, bodies[2].skin_q22);
    }
    if (islands & ONE) {
        touch_corners_of(2, (int32_t)(one_gap * bodies[3].skin_q22));
    }
}

static bool same_state(int body, const struct body_state *as)
{
    return memcmp(&states[body], as, sizeof *as) == 0;
}

/* A fast impact of one island changes nothing in what another comes to, to the bit. */
static void test_apart(void)
{
    struct body_state alone[BODIES], at_first[BODIES];

    make_box();
    begin_apart(TWO, 1 / 367.0, 1);
    CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, false), CAROM_OK);
    memcpy(alone, states, sizeof alone);
    begin_apart(ONE, 1 / 367.0, 1);
    memcpy(at_first, states, sizeof at_first);
    CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, false), CAROM_OK);
    CHECK(!same_state(3, &at_first[3]) && !same_state(1, &alone[1]) && !same_state(2, &alone[2]));
    alone[3] = states[3];
    begin_apart(TWO | ONE, 1 / 367.0, 1);
    CHECK_EQ(pool.used, 13);
    CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, false), CAROM_OK);
    CHECK(same_state(1, &alone[1]) && same_state(2, &alone[2]) && same_state(3, &alone[3]));
}

/* After a hit only islands that hit are solved: by pair, or since they are as near and as fast. */
static void test_keep_hits(void)
{
    struct body_state before[BODIES];

    make_box();
    for (int n = 0; n < 3; n++) {
        /* the hit is of pair 2, of pair 0 while 3 is to hit later, and while 3 hits as well */
        static const double gap[3] = {0.5, 1.5, 0.5};
        bool two = n > 0, one = n != 1;

        begin_apart(TWO | ONE, 1 / 367.0, gap[n]);
        memcpy(before, states, sizeof before);
        rest_keep_hits(&rest, two ? 0 : 2);
        CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, false), CAROM_OK);
        CHECK(same_state(1, &before[1]) == !two && same_state(2, &before[2]) == !two);
        CHECK(same_state(3, &before[3]) == !one);
        /* and what is left alone does not take gravity early */
        CHECK_EQ(rest_enter_contact(&rest, CAROM_ONE_Q30), two);
        CHECK(bodies[1].in_contact == two && bodies[2].in_contact == two && !bodies[3].in_contact);
    }
}

/* Only the islands of bodies that newly took gravity are left to solve. */
static void test_enter_apart(void)
{
    struct body_state before[BODIES];

    make_box();
    begin_apart(TWO | ONE, 1 / 367.0, 1);
    set_motion(3, (double[3]){0, 0, 0}, (double[3]){0, 0, 0});
    bodies[3].in_contact = true;
    memcpy(before, states, sizeof before);
    CHECK(rest_enter_contact(&rest, CAROM_ONE_Q30));
    CHECK(bodies[1].in_contact && bodies[2].in_contact);
    CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, true), CAROM_OK);
    CHECK(!same_state(1, &before[1]) && !same_state(2, &before[2]) && same_state(3, &before[3]));
    CHECK_EQ(rest.warm_count, 9); /* of what was solved */
}

/* The impulse of an impact is nothing to start the next frame from; nor is what was kept before. */
static void test_impact_warm(void)
{
    static const int32_t below[3] = {0, 0, -(1 << 21)};

    make_cube();
    for (int n = 1; n <= 4; n += 3) {
        begin(1, 1 / 367.0);
        set_surface(0.5, 0.5);
        touch_corners(bodies[1].skin_q22);
        CHECK(rest_enter_contact(&rest, CAROM_ONE_Q30));
        CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, true), CAROM_OK);
        CHECK_EQ(rest.warm_count, 4);
        clear_contacts();
        set_motion(1, (double[3]){0, 0, -0.5}, (double[3]){0, 0, 0});
        if (n == 1) {
            touch(0, 0, below, up, bodies[1].skin_q22);
        } else {
            touch_corners(bodies[1].skin_q22);
        }
        CHECK_EQ(rest_solve(&rest, CAROM_ONE_Q30, true), CAROM_OK);
        CHECK_EQ(rest.impacts, n);
        CHECK_EQ(rest.warm_count, 0);
    }
}

#define MANY 60

/* Islands of random pairs, against colours that spread until nothing changes. */
static void test_island_numbers(void)
{
    static struct body many[MANY];
    static struct pair joined[MANY];
    struct test_random r = {1};

    for (int n = 0; n < 20; n++) {
        int colour[MANY], count = (int)test_random_range(&r, 0, MANY);
        bool again = true;

        for (int i = 0; i < MANY; i++) {
            many[i].moving = test_random_range(&r, 0, 9) > 0;
            colour[i] = i;
        }
        rest_islands_begin(many, MANY);
        for (int i = 0; i < count; i++) {
            joined[i].a = (uint16_t)test_random_range(&r, 1, MANY - 1);
            joined[i].b = (uint16_t)test_random_range(&r, 0, joined[i].a - 1);
            rest_islands_join(many, &joined[i]);
        }
        rest_islands_end(many, MANY);
        while (again) {
            again = false;
            for (int i = 0; i < count; i++) {
                int a = joined[i].a, b = joined[i].b;

                if (many[a].moving && many[b].moving && colour[a] != colour[b]) {
                    colour[a] = colour[b] = colour[a] < colour[b] ? colour[a] : colour[b];
                    again = true;
                }
            }
        }
        for (int i = 0; i < MANY; i++) {
            int next = i + 1;

            CHECK_EQ(many[i].island, colour[i]);
            while (next < MANY && colour[next] != colour[i]) {
                next++;
            }
            CHECK_EQ(many[i].next_in_island, next < MANY ? next : (int)REST_ISLAND_END);
        }
    }
}

const struct test tests_rest[] = {
    {"rest/particle", test_particle},
    {"rest/particle_friction", test_particle_friction},
    {"rest/weight", test_weight},
    {"rest/warm", test_warm},
    {"rest/ramp", test_ramp},
    {"rest/gaps", test_gaps},
    {"rest/enter", test_enter},
    {"rest/impacts", test_impacts},
    {"rest/plastic", test_plastic},
    {"rest/sleep", test_sleep},
    {"rest/islands", test_islands},
    {"rest/apart", test_apart},
    {"rest/keep_hits", test_keep_hits},
    {"rest/enter_apart", test_enter_apart},
    {"rest/impact_warm", test_impact_warm},
    {"rest/island_numbers", test_island_numbers},
    {0},
};
