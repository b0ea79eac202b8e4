/* SPDX-License-Identifier: MIT */
/*
 * Kinematic bodies: they arrive where they are led, to the last bit; a body that they push or carry
 * gets the right speed; a body that they would crush stops them.
 */
#include <string.h>

#include "carom_body.h"
#include "num/fnv.h"
#include "lib/one_world.h"
#include "lib/real.h"
#include "lib/shapes.h"
#include "lib/test.h"

#define CAPS 4, 4, 48, 64, 0, 64, 0, 2
#define ONE  ((int64_t)1 << 40) /* a unit, or a radian, a frame */
#define UNIT ((int64_t)1 << 32)

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static uint8_t saved[1024];
static struct shape box, plate;
static struct carom_body_def def;
static const double pi = 3.14159265358979;

static void setup(uint32_t candidates)
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS), .sleep = true};

    config.caps.candidates = candidates;
    shape_box(&box, 12, 4096, 2048, 1024);
    shape_box(&plate, 12, 16384, 16384, 1024);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    memset(&def, 0, sizeof def);
}

/* A body of a kind at a height, centre to centre. */
enum kind { MOVES, STANDS, LED };
static int add(const struct shape *s, enum kind kind, double x, double z)
{
    def.mesh = &s->mesh;
    def.stationary = kind == STANDS;
    def.kinematic = kind == LED;
    def.mass_q20 = 1 << 20;
    def.position.c[0] = real_round(x * (double)UNIT);
    def.position.c[2] = real_round(z * (double)UNIT);
    return carom_body_add(world, &def);
}

static double at(int body, int k)
{
    return real(state_of(body).position.c[k], 32);
}

/* Lead a body by an offset from where it is. */
static int lead(int body, double x, double z)
{
    struct carom_body_state s = state_of(body);
    struct carom_pose pose = {s.position, s.rotation};

    pose.position.c[0] += real_round(x * (double)UNIT);
    pose.position.c[2] += real_round(z * (double)UNIT);
    return carom_body_move_to(world, body, &pose);
}

static carom_quat_q30 random_turn(struct test_random *r)
{
    carom_quat_q30 q;
    double v[4], sum = 0;

    for (int k = 0; k < 4; k++) {
        v[k] = (double)test_random_range(r, -1000000, 1000000) / 1000000;
        sum += v[k] * v[k];
    }
    for (int k = 0; k < 4; k++) {
        q.c[k] = (int32_t)real_round(v[k] / real_sqrt(sum + 1e-9) * CAROM_ONE_Q30);
    }
    body_normalise(&q);
    return q;
}

/* ----------------------------------------------------------------------- routes */

/* Consecutive slices end at the route's end; none turns by more than a slice may. */
static void test_slices(void)
{
    struct test_random r = {71};
    struct body b;
    struct body_extra extra;

    shape_box(&box, 12, 4096, 2048, 1024);
    memset(&b, 0, sizeof b);
    memset(&extra, 0, sizeof extra);
    b.def.mesh = &box.mesh;
    b.def.radius_q22 = box.mesh.radius_q22;
    b.def.extra = &extra;
    for (int n = 0; n < 2000; n++) {
        struct body_state s = {.rotation = random_turn(&r)}, to = {.rotation = random_turn(&r)};
        int sign = 0;
        double axis = 0;

        for (int k = 0; k < 3; k++) {
            to.position.c[k] = test_random_range(&r, -30, 30) * (UNIT >> (n % 40));
        }
        body_route_to(&b, &s, &to.position, &to.rotation, &extra.route);
        for (int slice = 0; slice < 1 << extra.route.slice_bits; slice++) {
            body_follow(&b, &s);
            CHECK_AT_MOST(b.path.u2_q30, CAROM_ONE_Q30 / 64 + 64);
            body_advance(&b, &s, CAROM_ONE_Q30, CAROM_ONE_Q30, NULL);
        }
        for (int k = 0; k < 4; k++) { /* q and -q are one rotation */
            double same = real(s.rotation.c[k], 30) * real(to.rotation.c[k], 30);

            sign = same > 0.2 ? 1 : same < -0.2 ? -1 : sign;
        }
        for (int k = 0; k < 4; k++) {
            CHECK_NEAR(s.rotation.c[k], sign * to.rotation.c[k], 8 << extra.route.slice_bits);
        }
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(s.position.c[k], to.position.c[k], 1 << extra.route.slice_bits);
            axis += real(extra.route.spin.c[k], 40) * real(extra.route.spin.c[k], 40);
        }
        CHECK_LESS(axis, pi * pi * 1.0001);
    }
}

/*
 * A route from a quaternion: a quarter turn, and a half turn, about the tilted axis 1/3, 2/3, 2/3.
 */
static void test_spin(void)
{
    static const double axis[3] = {1.0 / 3, 2.0 / 3, 2.0 / 3};

    setup(64);
    for (int half = 0; half < 2; half++) {
        double sine = half ? 1 : real_sqrt(0.5);
        struct body_state s = {.rotation = {{CAROM_ONE_Q30, 0, 0, 0}}};
        carom_quat_q30 q = {{half ? 0 : (int32_t)real_round(sine * CAROM_ONE_Q30)}};
        struct body_route route;
        struct body b;

        memset(&b, 0, sizeof b);
        b.def.mesh = &box.mesh;
        b.def.radius_q22 = box.mesh.radius_q22;
        for (int k = 0; k < 3; k++) {
            q.c[1 + k] = (int32_t)real_round(sine * axis[k] * CAROM_ONE_Q30);
        }
        body_normalise(&q);
        body_route_to(&b, &s, &s.position, &q, &route);
        for (int k = 0; k < 3; k++) {
            CHECK_LESS(real_abs(real(route.spin.c[k], 40) - axis[k] * pi / (half ? 1 : 2)), 1e-5);
        }
    }
}

/* ------------------------------------------------------------------------ poses */

static void test_arrives(void)
{
    struct test_random r = {72};
    struct carom_body_state s;
    int led;

    setup(64);
    led = add(&box, LED, 0, 0);
    add(&box, MOVES, 100, 0);
    for (int n = 0; n < 100; n++) {
        struct carom_pose pose = {.rotation = random_turn(&r)};
        uint64_t hash;

        for (int k = 0; k < 3; k++) {
            pose.position.c[k] = test_random_range(&r, -UNIT, UNIT) * (n % 16);
        }
        CHECK_EQ(carom_body_move_to(world, led, &pose), CAROM_OK);
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        s = state_of(led);
        CHECK_EQ(memcmp(&s.position, &pose.position, sizeof pose.position), 0);
        CHECK_EQ(memcmp(&s.rotation, &pose.rotation, sizeof pose.rotation), 0);
        hash = carom_world_hash(world);
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK_EQ(carom_world_hash(world), hash);
    }
}

/* A velocity and a spin go on; sixteen 32nds of pi are a quarter turn. */
static void test_goes_on(void)
{
    struct carom_body_state s;
    carom_v3_q32 point;
    carom_v3_q40 at;
    int led;

    setup(64);
    led = add(&box, LED, 0, 0);
    s = state_of(led);
    s.velocity.c[1] = ONE / 16;
    s.spin.c[2] = real_round(pi / 32 * (double)ONE);
    CHECK_EQ(carom_body_set(world, led, &s), CAROM_OK);
    for (int n = 0; n < 16; n++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
    CHECK_EQ(state_of(led).position.c[1], UNIT);
    CHECK_EQ(state_of(led).velocity.c[1], ONE / 16);
    /* at a unit along x from the centre, the spin adds a velocity along y */
    point = state_of(led).position;
    point.c[0] += UNIT;
    CHECK_EQ(carom_body_velocity_at(world, led, &point, &at), CAROM_OK);
    CHECK_EQ(at.c[0], 0);
    CHECK_EQ(at.c[1], ONE / 16 + s.spin.c[2]);
    CHECK_LESS(real_abs(real(state_of(led).rotation.c[0], 30) - real_sqrt(0.5)), 1e-6);
    CHECK_LESS(real_abs(real(state_of(led).rotation.c[3], 30) - real_sqrt(0.5)), 1e-6);
    /* a led body stands still at its goal, and so does one without a velocity */
    CHECK_EQ(lead(led, 1, 0), CAROM_OK);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK_EQ(state_of(led).position.c[0], UNIT);
    CHECK_EQ(state_of(led).position.c[1], UNIT);
}

static void test_refused(void)
{
    struct carom_pose pose = {.rotation = {{0, 0, 0, 0}}};
    struct carom_body_state s;
    int led, moves;

    setup(64);
    led = add(&box, LED, 0, 0);
    moves = add(&box, MOVES, 100, 0);
    REFUSE(carom_body_move_to(NULL, led, &pose), CAROM_ERR_NULL);
    REFUSE(carom_body_move_to(world, led, NULL), CAROM_ERR_NULL);
    REFUSE(carom_body_move_to(world, 7, &pose), CAROM_ERR_BODY);
    REFUSE(carom_body_move_to(world, moves, &pose), CAROM_ERR_ARGUMENT);
    pose.rotation.c[1] = CAROM_ONE_Q30 / 2;
    REFUSE(carom_body_move_to(world, led, &pose), CAROM_ERR_ARGUMENT);
    /* a half turn moves the box's corners by 0.57 pi units: less than 64 are left for the way */
    pose.rotation.c[1] = CAROM_ONE_Q30;
    pose.position.c[0] = 62 * UNIT;
    CHECK_EQ(carom_body_move_to(world, led, &pose), CAROM_OK);
    pose.position.c[0] = 62 * UNIT + UNIT / 2;
    REFUSE(carom_body_move_to(world, led, &pose), CAROM_ERR_RANGE);
    pose.position.c[0] = INT64_MIN;
    REFUSE(carom_body_move_to(world, led, &pose), CAROM_ERR_RANGE);
    s = state_of(led);
    s.spin.c[0] = real_round(3.2 * (double)ONE);
    REFUSE(carom_body_set(world, led, &s), CAROM_ERR_RANGE);
    /* there are two extras; neither kind may be both */
    CHECK_MORE(add(&box, LED, 200, 0), 0);
    REFUSE(add(&box, LED, 300, 0), CAROM_ERR_EXTRAS_FULL);
    def.stationary = def.kinematic = true;
    REFUSE(carom_body_add(world, &def), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_body_remove(world, led), CAROM_OK);
    CHECK_EQ(add(&box, LED, 0, 0), led);
}

/* ---------------------------------------------------------------- what they push */

/*
 * A kinematic body acts like one of infinite mass: a body with e = 1 leaves it at twice its speed.
 */
static void test_hits(void)
{
    int led, hit;

    setup(64);
    def.restitution_q30 = CAROM_ONE_Q30;
    led = add(&plate, LED, 0, 0);
    hit = add(&box, MOVES, 0, 0.5);
    for (int n = 0; n < 4; n++) {
        CHECK_EQ(lead(led, 0, 0.125), CAROM_OK);
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
    CHECK_LESS(real_abs(real(state_of(hit).velocity.c[2], 40) - 0.25), 1e-6);
    CHECK_LESS(real_abs(at(led, 2) - 0.5), 1e-9);
}

/*
 * A box on a plate that moves sideways and up moves with it, and stays awake; on a plate that
 * stands it sleeps.
 */
static void test_carries(void)
{
    const carom_v3_q40 gravity = {{0, 0, -ONE / 367}};
    int led, box_on;
    double x, z;

    setup(64);
    CHECK_EQ(carom_world_set_gravity(world, &gravity), CAROM_OK);
    def.friction_q16 = 1 << 16;
    led = add(&plate, LED, 0, 0);
    box_on = add(&box, MOVES, 0.25, 0.2502);
    for (int n = 0; n < 60; n++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
    CHECK(state_of(box_on).asleep);
    x = at(box_on, 0);
    z = at(box_on, 2);
    for (int n = 1; n <= 60; n++) {
        double speed = n < 30 ? n * 0.0005 : 0.015;

        CHECK_EQ(lead(led, speed, speed / 2), CAROM_OK);
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK(!state_of(box_on).asleep);
        CHECK_LESS(real_abs(at(box_on, 0) - at(led, 0) - x), 1e-4);
        CHECK_LESS(real_abs(at(box_on, 2) - at(led, 2) - z), 3e-4);
    }
    for (int n = 0; n < 60; n++) { /* slower than the speed below which bodies sleep */
        CHECK_EQ(lead(led, 0.00004, 0), CAROM_OK);
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK(!state_of(box_on).asleep);
    }
    for (int n = 0; n < 90; n++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
    CHECK(state_of(box_on).asleep);
    CHECK_EQ(lead(led, 0.001, 0), CAROM_OK);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK_EQ(events_of(CAROM_EVENT_WAKE, box_on, 0), 1);
}

/* A plate comes down on a box on the ground, is stopped by it, and goes up again. */
static void test_crushes(void)
{
    const carom_v3_q40 gravity = {{0, 0, -ONE / 367}};
    int led, crushed, ground, blocked = 0;
    double lowest;

    setup(64);
    CHECK_EQ(carom_world_set_gravity(world, &gravity), CAROM_OK);
    ground = add(&plate, STANDS, 0, 0);
    led = add(&plate, LED, 0, 1);
    crushed = add(&box, MOVES, 0.25, 0.2502);
    CHECK_EQ(ground, 0);
    for (int n = 0; n < 60; n++) {
        CHECK_EQ(lead(led, 0, -0.02), CAROM_OK);
        CHECK_AT_LEAST(carom_world_step(world), 0);
        blocked += events_of(CAROM_EVENT_BLOCKED, led, crushed);
        /* half of both plates, and the box */
        CHECK_MORE(at(led, 2), 0.5);
        CHECK_MORE(at(crushed, 2), 0.25);
        CHECK_MORE(at(led, 2) - at(crushed, 2), 0.25);
    }
    CHECK_AT_LEAST(blocked, 30);
    CHECK_LESS(at(led, 2), 0.502);
    lowest = at(led, 2);
    CHECK_EQ(lead(led, 0, 0.02), CAROM_OK);
    CHECK_AT_LEAST(carom_world_step(world), 0);
    CHECK_EQ(events_of(CAROM_EVENT_BLOCKED, led, crushed), 0);
    CHECK_LESS(real_abs(at(led, 2) - lowest - 0.02), 1e-9);
}

/* -------------------------------------------------------------------------- state */

static void push_on(int led, int frame)
{
    CHECK_EQ(lead(led, frame % 8 < 4 ? 0.03 : -0.03, 0), CAROM_OK);
    CHECK_AT_LEAST(carom_world_step(world), 0);
}

/*
 * A plate on end pushes a box to and fro on another one: the same bits with room for one candidate.
 */
static uint64_t play(uint32_t candidates, int frames, int *led)
{
    const carom_v3_q40 gravity = {{0, 0, -ONE / 367}};

    setup(candidates);
    CHECK_EQ(carom_world_set_gravity(world, &gravity), CAROM_OK);
    def.friction_q16 = 1 << 15;
    add(&plate, STANDS, 0, 0);
    *led = add(&box, LED, -1.1, 0.4);
    add(&box, MOVES, 0, 0.2502);
    for (int n = 0; n < frames; n++) {
        push_on(*led, n / 4);
    }
    return carom_world_hash(world);
}

static void test_pools(void)
{
    int led;
    uint64_t hash = play(64, 40, &led);

    CHECK_MORE(at(2, 0), 0.01); /* it was pushed */
    CHECK_EQ(play(1, 40, &led), hash);
}

/*
 * A snapshot holds a drive, which decides the following frames. A drive that no call could leave is
 * refused.
 */
static void test_snapshot(void)
{
    struct carom_body_state s;
    uint64_t after, fnv = FNV_START;
    int led, size, plain;

    play(64, 10, &led);
    plain = carom_snapshot_size(world);
    CHECK_EQ(lead(led, 0.03, 0), CAROM_OK);
    size = carom_snapshot_save(world, saved, sizeof saved);
    CHECK_EQ(size, plain + 40);
    CHECK_AT_LEAST(carom_world_step(world), 0);
    after = carom_world_hash(world);
    for (int n = 0; n < 5; n++) {
        push_on(led, 40);
    }
    CHECK_EQ(carom_snapshot_load(world, saved, (size_t)size), CAROM_OK);
    CHECK_AT_LEAST(carom_world_step(world), 0);
    CHECK_EQ(carom_world_hash(world), after);
    s = state_of(led);
    s.spin.c[0] = ONE;
    CHECK_EQ(carom_body_set(world, led, &s), CAROM_OK);
    size = carom_snapshot_save(world, saved, sizeof saved);
    CHECK_EQ(size, plain + 48);
    /* the top byte of the first number of its spin; two more numbers and the hash follow */
    saved[size - 8 - 17 - 1] = 64;
    for (int n = 0; n < size - 8; n++) {
        fnv = fnv_add(fnv, saved[n]);
    }
    for (int n = 0; n < 8; n++) {
        saved[size - 8 + n] = (uint8_t)(fnv >> (8 * n));
    }
    REFUSE(carom_snapshot_load(world, saved, (size_t)size), CAROM_ERR_FORMAT);
}

const struct test tests_world_kinematic[] = {{"world_kinematic/slices", test_slices},
                                             {"world_kinematic/spin", test_spin},
                                             {"world_kinematic/arrives", test_arrives},
                                             {"world_kinematic/goes_on", test_goes_on},
                                             {"world_kinematic/refused", test_refused},
                                             {"world_kinematic/hits", test_hits},
                                             {"world_kinematic/carries", test_carries},
                                             {"world_kinematic/crushes", test_crushes},
                                             {"world_kinematic/pools", test_pools},
                                             {"world_kinematic/snapshot", test_snapshot},
                                             {0}};
