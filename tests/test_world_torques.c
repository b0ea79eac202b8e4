/* SPDX-License-Identifier: MIT */
/*
 * Torques, damping, the scale of gravity, and impulses: against recurrences in whole numbers, and
 * their part of a snapshot. Plain forces and pushes are in test_world_force.c.
 */
#include <string.h>

#include "num/fnv.h"
#include "lib/one_world.h"
#include "lib/real.h"
#include "lib/shapes.h"
#include "lib/test.h"
#include "world/world.h"

#define CAPS 3, 2, 16, 16, 0, 32, 0, 2, 0
#define ONE  ((int64_t)1 << 40) /* a unit, or a radian, a frame */

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static uint8_t saved[1024], changed[1024];
static struct shape box, floor_shape;
static struct carom_body_def def;
static struct carom_config config;

enum { BOX, STILL, SECOND };

/* A world with the box and the floor; `def` is the box's again. */
static void begin(void)
{
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    CHECK_EQ(carom_body_add(world, &def), BOX);
    def.stationary = true;
    def.mesh = &floor_shape.mesh;
    def.position.c[2] = -((int64_t)100 << 32);
    CHECK_EQ(carom_body_add(world, &def), STILL);
    def.stationary = false;
    def.mesh = &box.mesh;
    def.position.c[2] = 0;
}

/* A box of three sides and mass 4 in the middle of the world, and a floor far away. */
static void setup(void)
{
    memset(&config, 0, sizeof config);
    config.caps = (struct carom_caps)CAROM_CAPS(CAPS);
    shape_box(&box, 12, 8192, 4096, 2048);
    shape_plane(&floor_shape, 9, 1, 8192);
    memset(&def, 0, sizeof def);
    def.mesh = &box.mesh;
    def.mass_q20 = 4 << 20;
    begin();
}

static const struct body_state *state(int body)
{
    return &world_now(world)->bodies[body];
}

/* ------------------------------------------------------------------- torque */

/*
 * In free flight the angular momentum after n frames is n times the torque, however the body turns.
 */
static void test_torque(void)
{
    struct test_random r = {3};

    setup();
    for (int n = 0; n < 8; n++) {
        struct carom_body_state s = state_of(BOX);
        carom_v3_q40 torque, before;

        s.rotation = shape_random_turn(&r);
        for (int k = 0; k < 3; k++) {
            s.spin.c[k] = test_random_range(&r, -ONE / 16, ONE / 16);
            torque.c[k] = test_random_range(&r, -ONE / 64, ONE / 64);
        }
        CHECK_EQ(carom_body_set(world, BOX, &s), CAROM_OK);
        CHECK_EQ(carom_body_set_torque(world, BOX, &torque), CAROM_OK);
        before = state(BOX)->angular;
        for (int frame = 1; frame <= 20; frame++) {
            CHECK_EQ(carom_world_step(world), CAROM_OK);
            for (int k = 0; k < 3; k++) {
                CHECK_EQ(state(BOX)->angular.c[k], before.c[k] + frame * torque.c[k]);
            }
        }
        for (int k = 0; k < 3; k++) {
            CHECK_EQ(state(BOX)->momentum.c[k], 0);
        }
    }
}

/*
 * About a principal axis: I = m (b^2 + c^2) / 12. After n frames the spin is n T / I and the angle
 * n (n + 1) / 2 T / I, because a frame turns at the spin with which it ends.
 */
static void test_torque_turns(void)
{
    /* sides 2, 1, 0.5 and mass 4: 4 (4 + 1) / 12 about z */
    const double inertia = 4 * 5 / 12.0, torque = 1 / 512.0;
    const carom_v3_q40 about_z = {{0, 0, ONE / 512}};
    struct carom_body_state s;
    double sine, cosine;

    setup();
    CHECK_EQ(carom_body_set_torque(world, BOX, &about_z), CAROM_OK);
    for (int n = 1; n <= 30; n++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        s = state_of(BOX);
        CHECK_LESS(real_abs(real(s.spin.c[2], 40) - n * torque / inertia), 1e-8);
        real_sine_cosine(n * (n + 1) / 4.0 * torque / inertia, &sine, &cosine);
        /* a Cayley turn lags by the cube of the angle of a frame, up to 0.035, over 12 */
        CHECK_LESS(real_abs(real(s.rotation.c[3], 30) - sine), 1e-4);
        CHECK_LESS(real_abs(real(s.rotation.c[0], 30) - cosine), 1e-4);
    }
}

/*
 * A torque about the normal of a floor without friction: contact neither changes it nor takes it
 * for a gain of energy.
 */
static void test_torque_on_floor(void)
{
    const carom_v3_q40 gravity = {{0, 0, -ONE / 400}}, about_z = {{0, 0, ONE / 512}};
    struct carom_body_state s = {.rotation = {{0}}};

    setup();
    s.position.c[2] = -((int64_t)100 << 32) + ((int64_t)1 << 30) + ((int64_t)1 << 21);
    CHECK_EQ(carom_world_set_gravity(world, &gravity), CAROM_OK);
    CHECK_EQ(carom_body_set(world, BOX, &s), CAROM_OK);
    CHECK_EQ(carom_body_set_torque(world, BOX, &about_z), CAROM_OK);
    for (int n = 1; n <= 30; n++) {
        struct carom_contact contact;

        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK_MORE(carom_contacts(world, &contact, 1), 0);
        CHECK_NEAR(state(BOX)->angular.c[2], n * (ONE / 512), ONE >> 22);
    }
}

/*
 * A torque that spins a body beyond the range of the formats takes it out of the world, as a fall
 * does.
 */
static void test_torque_out(void)
{
    carom_v3_q40 torque = {{0, 0, 0}};
    int frames = 0;

    setup();
    torque.c[0] = world_most_angular_q40(&world->bodies[BOX]);
    CHECK_EQ(carom_body_set_torque(world, BOX, &torque), CAROM_OK);
    while (!state_of(BOX).out && frames++ < 2000) {
        CHECK_AT_LEAST(carom_world_step(world), 0);
    }
    CHECK(state_of(BOX).out);
    /* and a body that sleeps or is out takes none */
    torque = state(BOX)->angular;
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK_EQ(memcmp(&torque, &state(BOX)->angular, sizeof torque), 0);
}

/* ------------------------------------------------------------------ damping */

/* v minus its part, to nearest; v below 2^32 */
static int64_t damped(int64_t v, int32_t part_q30)
{
    return v - ((v * part_q30 + (1 << 29)) >> 30);
}

/*
 * Momenta follow the recurrence, to the last place; so does the angular one while rounding gains
 * nothing.
 */
static void test_damping(void)
{
    struct test_random r = {4};

    setup();
    for (int n = 0; n < 30; n++) {
        struct carom_body_state s = state_of(BOX);
        int32_t linear = (int32_t)test_random_range(&r, 0, CAROM_ONE_Q30);
        int32_t angular = (int32_t)test_random_range(&r, 0, CAROM_ONE_Q30);
        struct body_state was;

        s.rotation = shape_random_turn(&r);
        for (int k = 0; k < 3; k++) {
            s.velocity.c[k] = test_random_range(&r, -(1 << 28), 1 << 28);
            s.spin.c[k] = test_random_range(&r, -(1 << 28), 1 << 28);
        }
        CHECK_EQ(carom_body_set(world, BOX, &s), CAROM_OK);
        CHECK_EQ(carom_body_set_damping(world, BOX, linear, angular), CAROM_OK);
        for (int frame = 0; frame < 5; frame++) {
            was = *state(BOX);
            CHECK_EQ(carom_world_step(world), CAROM_OK);
            for (int k = 0; k < 3; k++) {
                CHECK_EQ(state(BOX)->momentum.c[k], damped(was.momentum.c[k], linear));
                CHECK_NEAR(state(BOX)->angular.c[k], damped(was.angular.c[k], angular), 1);
            }
        }
    }
}

/* A body falls no faster than g / d: v' = (1 - d) v + g. */
static void test_damping_falls(void)
{
    const carom_v3_q40 gravity = {{0, 0, -ONE / 256}};
    int64_t p = 0;

    setup();
    CHECK_EQ(carom_world_set_gravity(world, &gravity), CAROM_OK);
    CHECK_EQ(carom_body_set_damping(world, BOX, CAROM_ONE_Q30 / 8, 0), CAROM_OK);
    for (int n = 0; n < 40; n++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        p = p - (p + 4) / 8 - 4 * ONE / 256; /* p < 0: the half is up */
        CHECK_NEAR(state(BOX)->momentum.c[2], p, 8);
    }
    CHECK_MORE(state_of(BOX).velocity.c[2], -8 * (ONE / 256));
    CHECK_LESS(state_of(BOX).velocity.c[2], -7 * (ONE / 256));
}

/* Energy never rises, for any momenta, even of a few units of their last place. */
static void test_damping_loses(void)
{
    struct test_random r = {5};

    setup();
    for (int n = 0; n < 1000; n++) {
        int bits = (int)test_random_range(&r, 2, n % 4 ? 8 : 38);
        struct fix_wide before = {0, 0}, after = {0, 0};
        struct body_state *s = &world->now->bodies[BOX];
        carom_m3_q30 turn;

        s->rotation = shape_random_turn(&r);
        for (int k = 0; k < 3; k++) {
            s->momentum.c[k] =
                n % 2 ? 0 : test_random_range(&r, -((int64_t)1 << bits), (int64_t)1 << bits);
            s->angular.c[k] = test_random_range(&r, -((int64_t)1 << bits), (int64_t)1 << bits);
        }
        CHECK_EQ(
            carom_body_set_damping(world, BOX, (int32_t)test_random_range(&r, 0, CAROM_ONE_Q30),
                                   (int32_t)test_random_range(&r, 0, CAROM_ONE_Q30 >> (bits % 28))),
            CAROM_OK);
        fix_matrix(&turn, &s->rotation);
        body_add_kinetic2(&before, &world->bodies[BOX], s, &turn);
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        /* in the earlier pose: a turn keeps energy up to rounding */
        body_add_kinetic2(&after, &world->bodies[BOX], state(BOX), &turn);
        fix_wide_subtract(&after, &before);
        CHECK_AT_MOST(fix_wide_sign(&after), 0);
    }
}

/* ------------------------------------------------------------ scale of gravity */

static void test_gravity_scale(void)
{
    const carom_v3_q40 gravity = {{ONE / 512, 0, -ONE / 256}};
    static const int32_t scales[] = {0, 1 << 15, 1 << 16, -(1 << 16), 3 << 16, 16 << 16};

    for (int i = 0; i < 6; i++) {
        setup();
        CHECK_EQ(carom_world_set_gravity(world, &gravity), CAROM_OK);
        CHECK_EQ(carom_body_set_gravity_scale(world, BOX, scales[i]), CAROM_OK);
        for (int n = 1; n <= 3; n++) {
            CHECK_EQ(carom_world_step(world), CAROM_OK);
            CHECK_EQ(state_of(BOX).velocity.c[2], -(ONE / 256 * n * scales[i] / (1 << 16)));
            CHECK_EQ(state_of(BOX).velocity.c[0], ONE / 512 * n * scales[i] / (1 << 16));
        }
    }
}

/* -------------------------------------------------------------------- impulses */

/*
 * A linear impulse at the centre and an angular one about it: together they are a push at a point.
 */
static void test_pushes(void)
{
    struct test_random r = {6};

    setup();
    def.overlap = CAROM_OVERLAP_PASS;
    CHECK_EQ(carom_body_add(world, &def), SECOND);
    for (int n = 0; n < 20; n++) {
        struct carom_body_state s = state_of(BOX);
        carom_v3_q40 p, moment, force;
        struct carom_forces f;
        carom_v3_q32 point;

        s.rotation = shape_random_turn(&r);
        for (int k = 0; k < 3; k++) {
            s.position.c[k] = test_random_range(&r, -((int64_t)100 << 32), (int64_t)100 << 32);
            s.velocity.c[k] = s.spin.c[k] = test_random_range(&r, -ONE, ONE);
            p.c[k] = test_random_range(&r, -ONE, ONE);
            point.c[k] = s.position.c[k] + test_random_range(&r, -4, 4) * ((int64_t)1 << 32);
        }
        /* arms of whole units: the products are exact */
        for (int k = 0; k < 3; k++) {
            int i = (k + 1) % 3, j = (k + 2) % 3;

            moment.c[k] = ((point.c[i] - s.position.c[i]) >> 32) * p.c[j] -
                          ((point.c[j] - s.position.c[j]) >> 32) * p.c[i];
        }
        CHECK_EQ(carom_body_set(world, BOX, &s), CAROM_OK);
        CHECK_EQ(carom_body_set(world, SECOND, &s), CAROM_OK);
        CHECK_EQ(carom_body_push(world, BOX, &p, &point), CAROM_OK);
        CHECK_EQ(carom_body_push_centre(world, SECOND, &p), CAROM_OK);
        CHECK_EQ(carom_body_twist(world, SECOND, &moment), CAROM_OK);
        CHECK_EQ(memcmp(state(BOX), state(SECOND), sizeof *state(BOX)), 0);
        for (int k = 0; k < 3; k++) {
            force.c[k] = p.c[k] / 2;
        }
        CHECK_EQ(carom_body_set_force_at(world, BOX, &force, &point), CAROM_OK);
        CHECK_EQ(carom_body_forces(world, BOX, &f), CAROM_OK);
        for (int k = 0; k < 3; k++) {
            CHECK_EQ(f.force.c[k], force.c[k]);
            CHECK_NEAR(f.torque.c[k], moment.c[k] / 2, 8);
        }
    }
}

/* --------------------------------------------------------------------- refused */

static void test_refused(void)
{
    const carom_v3_q40 none = {{0, 0, 0}};
    carom_v3_q40 much = {{0, 0, 0}};
    carom_v3_q32 point = {{0, 0, 0}};
    struct carom_forces f;

    setup();
    REFUSE(carom_body_set_torque(NULL, BOX, &none), CAROM_ERR_NULL);
    REFUSE(carom_body_set_torque(world, BOX, NULL), CAROM_ERR_NULL);
    REFUSE(carom_body_set_force_at(world, BOX, &none, NULL), CAROM_ERR_NULL);
    REFUSE(carom_body_set_force_at(world, BOX, NULL, &point), CAROM_ERR_NULL);
    REFUSE(carom_body_set_damping(NULL, BOX, 0, 0), CAROM_ERR_NULL);
    REFUSE(carom_body_set_gravity_scale(NULL, BOX, 0), CAROM_ERR_NULL);
    REFUSE(carom_body_push_centre(world, BOX, NULL), CAROM_ERR_NULL);
    REFUSE(carom_body_twist(NULL, BOX, &none), CAROM_ERR_NULL);
    REFUSE(carom_body_forces(world, BOX, NULL), CAROM_ERR_NULL);
    REFUSE(carom_body_forces(NULL, BOX, &f), CAROM_ERR_NULL);
    REFUSE(carom_body_set_torque(world, STILL, &none), CAROM_ERR_ARGUMENT);
    REFUSE(carom_body_set_force_at(world, STILL, &none, &point), CAROM_ERR_ARGUMENT);
    REFUSE(carom_body_set_damping(world, STILL, 0, 0), CAROM_ERR_ARGUMENT);
    REFUSE(carom_body_set_gravity_scale(world, STILL, 0), CAROM_ERR_ARGUMENT);
    REFUSE(carom_body_push_centre(world, STILL, &none), CAROM_ERR_ARGUMENT);
    REFUSE(carom_body_twist(world, STILL, &none), CAROM_ERR_ARGUMENT);
    REFUSE(carom_body_set_damping(world, BOX, -1, 0), CAROM_ERR_ARGUMENT);
    REFUSE(carom_body_set_damping(world, BOX, 0, CAROM_ONE_Q30 + 1), CAROM_ERR_ARGUMENT);
    REFUSE(carom_body_set_gravity_scale(world, BOX, (16 << 16) + 1), CAROM_ERR_ARGUMENT);
    REFUSE(carom_body_set_gravity_scale(world, BOX, INT32_MIN), CAROM_ERR_ARGUMENT);
    for (int k = 0; k < 3; k++) {
        much = none;
        much.c[k] = world_most_angular_q40(&world->bodies[BOX]);
        CHECK_EQ(carom_body_set_torque(world, BOX, &much), CAROM_OK);
        much.c[k] += 1;
        REFUSE(carom_body_set_torque(world, BOX, &much), CAROM_ERR_RANGE);
        REFUSE(carom_body_twist(world, BOX, &much), CAROM_ERR_RANGE);
        much.c[k] = INT64_MIN;
        REFUSE(carom_body_set_torque(world, BOX, &much), CAROM_ERR_RANGE);
        REFUSE(carom_body_twist(world, BOX, &much), CAROM_ERR_RANGE);
        REFUSE(carom_body_push_centre(world, BOX, &much), CAROM_ERR_RANGE);
        REFUSE(carom_body_set_force_at(world, BOX, &much, &point), CAROM_ERR_RANGE);
    }
    point.c[1] = ((int64_t)4096 << 32) + 1;
    REFUSE(carom_body_set_force_at(world, BOX, &none, &point), CAROM_ERR_RANGE);
    /* with gravity 1 / 2 no scale beyond 2, and the other way around */
    much = (carom_v3_q40){{0, -ONE / 2, 0}};
    CHECK_EQ(carom_world_set_gravity(world, &much), CAROM_OK);
    REFUSE(carom_body_set_gravity_scale(world, BOX, (2 << 16) + 1), CAROM_ERR_RANGE);
    CHECK_EQ(carom_body_set_gravity_scale(world, BOX, 2 << 16), CAROM_OK);
    much.c[1]--;
    REFUSE(carom_world_set_gravity(world, &much), CAROM_ERR_RANGE);
}

/* ------------------------------------------------------------------- snapshots */

static void give_all(int body)
{
    const carom_v3_q40 torque = {{ONE / 512, -ONE / 777, ONE / 300}};

    CHECK_EQ(carom_body_set_torque(world, body, &torque), CAROM_OK);
    CHECK_EQ(carom_body_set_gravity_scale(world, body, 12345), CAROM_OK);
    CHECK_EQ(carom_body_set_damping(world, body, 1 << 20, 1 << 24), CAROM_OK);
}

/* After loading, the same frames follow; extras come and go with the snapshot. */
static void test_snapshot(void)
{
    const carom_v3_q40 gravity = {{0, 0, -ONE / 512}};
    uint64_t plain, hash;
    int plain_size, size;

    setup();
    CHECK_EQ(carom_world_set_gravity(world, &gravity), CAROM_OK);
    def.position.c[0] += (int64_t)10 << 32;
    CHECK_EQ(carom_body_add(world, &def), SECOND);
    plain = carom_world_hash(world);
    plain_size = carom_snapshot_save(world, changed, sizeof changed);
    CHECK_MORE(plain_size, 0);
    give_all(BOX);
    CHECK_DIFFER(carom_world_hash(world), plain);
    size = carom_snapshot_save(world, saved, sizeof saved);
    CHECK_EQ(size, plain_size + 8 + 2 + 24 + 12);
    for (int n = 0; n < 5; n++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
    hash = carom_world_hash(world);
    /* one without: the body has no torque, damping or scale any more, and the bytes are those from
     * before */
    CHECK_EQ(carom_snapshot_load(world, changed, (size_t)plain_size), CAROM_OK);
    CHECK_EQ(carom_world_hash(world), plain);
    CHECK_EQ(carom_snapshot_load(world, saved, (size_t)size), CAROM_OK);
    for (int n = 0; n < 5; n++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
    CHECK_EQ(carom_world_hash(world), hash);
    /* into a world whose bodies have no extra yet */
    setup();
    def.position.c[0] += (int64_t)10 << 32;
    CHECK_EQ(carom_body_add(world, &def), SECOND);
    CHECK_EQ(carom_snapshot_load(world, saved, (size_t)size), CAROM_OK);
    for (int n = 0; n < 5; n++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
    CHECK_EQ(carom_world_hash(world), hash);
    /* and into a world that has no extra left */
    config.caps.extras = 0;
    begin();
    def.position.c[0] += (int64_t)10 << 32;
    CHECK_EQ(carom_body_add(world, &def), SECOND);
    REFUSE(carom_snapshot_load(world, saved, (size_t)size), CAROM_ERR_EXTRAS_FULL);
}

/*
 * Changed bytes of the section with a corrected check sum: refused unless a world could have them.
 */
static void test_snapshot_bad(void)
{
    static const struct {
        int at, bytes;
        int64_t value;
        int result;
    } changes[] = {
        {4, 4, 0, CAROM_ERR_FORMAT},
        {4, 4, 2, CAROM_ERR_FORMAT},
        {4, 4, -1, CAROM_ERR_FORMAT},
        {0, 4, 0, CAROM_ERR_FORMAT},
        {8, 2, STILL, CAROM_ERR_FORMAT},
        {8, 2, 3, CAROM_ERR_FORMAT},
        {8, 2, 65535, CAROM_ERR_FORMAT},
        {8, 2, SECOND, CAROM_OK},
        {10, 8, INT64_MIN, CAROM_ERR_FORMAT},
        {18, 8, INT64_MAX, CAROM_ERR_FORMAT},
        {10, 8, ONE / 100, CAROM_OK},
        {34, 4, (16 << 16) + 1, CAROM_ERR_FORMAT},
        {34, 4, INT32_MIN, CAROM_ERR_FORMAT},
        {34, 4, -(1 << 16), CAROM_OK},
        {38, 4, -1, CAROM_ERR_FORMAT},
        {38, 4, CAROM_ONE_Q30, CAROM_OK},
        {42, 4, CAROM_ONE_Q30 + 1, CAROM_ERR_FORMAT},
    };
    int size;

    setup();
    def.position.c[0] += (int64_t)10 << 32;
    CHECK_EQ(carom_body_add(world, &def), SECOND);
    give_all(BOX);
    size = carom_snapshot_save(world, saved, sizeof saved);
    CHECK_MORE(size, 0);
    for (unsigned i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        uint64_t sum = FNV_START, hash = carom_world_hash(world);
        uint8_t *section = changed + size - 8 - 46;

        memcpy(changed, saved, (size_t)size);
        for (int n = 0; n < changes[i].bytes; n++) {
            section[changes[i].at + n] = (uint8_t)((uint64_t)changes[i].value >> 8 * n);
        }
        for (int n = 0; n < size - 8; n++) {
            sum = fnv_add(sum, changed[n]);
        }
        for (int n = 0; n < 8; n++) {
            changed[size - 8 + n] = (uint8_t)(sum >> 8 * n);
        }
        for (int n = size - 8; n < size; n++) {
            sum = fnv_add(sum, changed[n]); /* the check sum covers all bytes */
        }
        CHECK_EQ(carom_snapshot_load(world, changed, (size_t)size), changes[i].result);
        if (changes[i].result < 0) {
            CHECK_EQ(carom_world_hash(world), hash);
        } else {
            CHECK_EQ(carom_world_hash(world), sum);
        }
    }
    /* cut off anywhere */
    for (int n = 0; n < size; n++) {
        CHECK_EQ(carom_snapshot_load(world, saved, (size_t)n), CAROM_ERR_FORMAT);
    }
}

const struct test tests_world_torques[] = {
    {"world_torques/torque", test_torque},
    {"world_torques/torque_turns", test_torque_turns},
    {"world_torques/torque_on_floor", test_torque_on_floor},
    {"world_torques/torque_out", test_torque_out},
    {"world_torques/damping", test_damping},
    {"world_torques/damping_falls", test_damping_falls},
    {"world_torques/damping_loses", test_damping_loses},
    {"world_torques/gravity_scale", test_gravity_scale},
    {"world_torques/pushes", test_pushes},
    {"world_torques/refused", test_refused},
    {"world_torques/snapshot", test_snapshot},
    {"world_torques/snapshot_bad", test_snapshot_bad},
    {0},
};
