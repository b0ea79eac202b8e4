/* SPDX-License-Identifier: MIT */
/*
 * Short scenes of one and two moving boxes, on any board, each with a known answer: boxes that meet
 * head-on; a box that slides to a stop; a stack that falls, rests and sleeps, and is woken. All
 * expected values are computed in whole numbers.
 */
#include <string.h>

#include "lib/one_world.h"
#include "lib/shapes.h"
#include "lib/test.h"

#define CAPS 3, 3, 64, 64, 64, 256
/* Thousandths of a unit a second, as units a frame. */
#define SPEED(mm_s) CAROM_VELOCITY_MM_S(mm_s, 60)
/* g of 9.81 units / s^2. */
#define WEIGHT (-CAROM_GRAVITY_MM_S2(-9810, 60))
/* Half the box's height, and the skin of its radius by 2048, in q32. */
#define HALF CAROM_RATIO(1, 4, 32)
#define SKIN CAROM_RATIO(6598, 20480000, 32)

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static struct shape box, ground;

/* A world with or without a floor of 8 x 8 units; the floor is body 0. */
static void begin(bool floor, int32_t e_q30, uint32_t mu_q16)
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS), .sleep = true};
    struct carom_body_def def;

    shape_box(&box, 12, 4096, 2868, 2048);
    shape_plane(&ground, 12, 2, 16384);
    config.gravity.c[2] = floor ? -WEIGHT : 0;
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    memset(&def, 0, sizeof def);
    def.mesh = &ground.mesh;
    def.stationary = true;
    def.restitution_q30 = e_q30;
    def.friction_q16 = mu_q16;
    if (floor) {
        CHECK_EQ(carom_body_add(world, &def), 0);
    }
}

/* A box of 1 x 0.7 x 0.5 units at x, z, moving along x. Returns its number. */
static int add_box(int64_t x_q32, int64_t z_q32, int64_t speed_q40, int mass, int32_t e_q30,
                   uint32_t mu_q16)
{
    struct carom_body_def def;
    int body;

    memset(&def, 0, sizeof def);
    def.mesh = &box.mesh;
    def.position.c[0] = x_q32;
    def.position.c[2] = z_q32;
    def.velocity.c[0] = speed_q40;
    def.mass_q20 = (uint32_t)mass << 20;
    def.restitution_q30 = e_q30;
    def.friction_q16 = mu_q16;
    body = carom_body_add(world, &def);
    CHECK_AT_LEAST(body, 0);
    return body;
}

/* An event of the last step about a body; NULL: none. */
static const struct carom_event *find(int kind, int body)
{
    const struct carom_event *events = NULL;
    int n = carom_events(world, &events);

    for (int i = 0; i < n; i++) {
        if (events[i].kind == kind && (events[i].a == body || events[i].b == body)) {
            return &events[i];
        }
    }
    return NULL;
}

/* Step until all boxes sleep. Returns the number of frames, at most 200. */
static int settle(int boxes)
{
    for (int frame = 1; frame <= 200; frame++) {
        int asleep = 0;

        CHECK_EQ(carom_world_step(world), CAROM_OK);
        for (int body = 1; body <= boxes; body++) {
            CHECK_AT_MOST((find(CAROM_EVENT_REST, body) != NULL), state_of(body).asleep);
            asleep += state_of(body).asleep;
        }
        if (asleep == boxes) {
            return frame;
        }
    }
    return 200;
}

/* ------------------------------------------------------------------- impacts */

/*
 * Boxes of masses 1 and 4 meet head-on, flat on flat, without gravity. Momentum is kept to the last
 * bits. Velocities are those of two points, v = c -+ e m / M (v1 - v2), and nothing turns. Several
 * contacts solve the impact to 2^-26 of the closing speed.
 */
static void meet(int quarters)
{
    const int32_t e_q30 = CAROM_ONE_Q30 / 4 * quarters;
    const int64_t v1 = SPEED(4000), v2 = SPEED(-1500), common = (v1 + 4 * v2) / 5;
    const int64_t apart = (v1 - v2) / 20 * quarters; /* e (v1 - v2) / M */
    const struct carom_event *hit = NULL;
    struct carom_body_state s[2];

    begin(false, 0, 0);
    add_box(-CAROM_RATIO(3, 4, 32), 0, v1, 1, e_q30, 1 << 15);
    add_box(CAROM_RATIO(3, 4, 32), 0, v2, 4, e_q30, 1 << 15);
    for (int frame = 0; frame < 12; frame++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        hit = find(CAROM_EVENT_HIT, 1);
        s[0] = state_of(0);
        s[1] = state_of(1);
        CHECK_NEAR(s[0].velocity.c[0] + 4 * s[1].velocity.c[0], v1 + 4 * v2, 8);
        if (hit) {
            CHECK_NEAR(hit->speed_q40, v1 - v2, (v1 - v2) >> 24);
            CHECK_MORE(hit->impulse_q40, 0);
            break;
        }
    }
    CHECK(hit != NULL);
    CHECK_NEAR(s[0].velocity.c[0], common - 4 * apart, (v1 - v2) >> 18);
    CHECK_NEAR(s[1].velocity.c[0], common + apart, (v1 - v2) >> 18);
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(s[i].spin.c[k], 0, (v1 - v2) >> 16);
            CHECK(k == 0 || carom_abs(s[i].velocity.c[k]) <= (v1 - v2) >> 16);
        }
    }
}

static void test_meet(void)
{
    for (int quarters = 0; quarters <= 4; quarters += 2) {
        meet(quarters);
    }
}

/* --------------------------------------------------------------------- slide */

/* A sliding box loses mu g a frame until it stops; then it sleeps. */
static void test_slide(void)
{
    const int64_t first = SPEED(1500), brake = WEIGHT / 4;
    const int last = (int)(first / brake);
    struct carom_body_state s;

    begin(true, 0, 1 << 14);
    add_box(-CAROM_RATIO(1, 1, 32), HALF + SKIN, first, 1, 0, 1 << 14);
    for (int frame = 1; frame <= last; frame++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        s = state_of(1);
        CHECK_NEAR(s.velocity.c[0], first - brake * frame, brake / 100);
        CHECK_MORE(s.position.c[2], HALF);
    }
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    s = state_of(1);
    CHECK_NEAR(s.velocity.c[0], 0, brake / 100);
    /* the distance is the sum of the velocities: last first - brake (1 + ... + last) */
    CHECK_NEAR(s.position.c[0] + CAROM_RATIO(1, 1, 32),
               (last * first - brake * (last * (last + 1) / 2)) >> 8, (last * first) >> 8 >> 8);
    CHECK_LESS(settle(1), 60);
}

/* ---------------------------------------------------------------- rest, wake */

/* Boxes lie on the floor, one on the other, each with about a skin below it. */
static void check_stack(int boxes)
{
    for (int i = 1; i <= boxes; i++) {
        const struct carom_body_state s = state_of(i);

        CHECK(s.asleep);
        CHECK_NEAR(s.position.c[2], (2 * i - 1) * HALF + i * SKIN, i * SKIN / 2);
        for (int k = 1; k < 3; k++) {
            CHECK_NEAR(s.rotation.c[k], 0, CAROM_ONE_Q30 >> 10);
        }
    }
}

/*
 * A box falls, rests and sleeps. Another box falls on it and wakes it in the frame of the hit. Both
 * sleep again in the same frame, because they are one island.
 */
static void test_stack(void)
{
    bool woke = false;

    begin(true, CAROM_ONE_Q30 / 4, 1 << 15);
    add_box(0, HALF + CAROM_RATIO(1, 8, 32), 0, 1, CAROM_ONE_Q30 / 4, 1 << 15);
    CHECK_LESS(settle(1), 120);
    check_stack(1);
    add_box(0, 3 * HALF + CAROM_RATIO(1, 8, 32), 0, 1, CAROM_ONE_Q30 / 4, 1 << 15);
    CHECK(state_of(1).asleep);
    for (int frame = 0; frame < 30 && !woke; frame++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        woke = find(CAROM_EVENT_HIT, 2) != NULL;
        CHECK_EQ((find(CAROM_EVENT_WAKE, 1) != NULL), woke);
        CHECK_EQ(state_of(1).asleep, !woke);
    }
    CHECK(woke);
    CHECK_LESS(settle(2), 120);
    CHECK(find(CAROM_EVENT_REST, 1));
    CHECK(find(CAROM_EVENT_REST, 2));
    check_stack(2);
}

/* A push wakes a sleeping box, which slides off at impulse / mass; a box beside it sleeps on. */
static void test_push(void)
{
    const carom_v3_q40 impulse = {{SPEED(2000), 0, 0}};
    struct carom_body_state s;
    uint64_t hash;

    begin(true, 0, 1 << 14);
    add_box(0, HALF + SKIN, 0, 2, 0, 1 << 14);
    add_box(-CAROM_RATIO(2, 1, 32), HALF + SKIN, 0, 2, 0, 1 << 14);
    CHECK_LESS(settle(2), 60);
    check_stack(1);
    hash = carom_world_hash(world);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK_EQ(carom_world_hash(world), hash);
    s = state_of(1);
    CHECK_EQ(carom_body_push(world, 1, &impulse, &s.position), CAROM_OK);
    CHECK_NEAR(state_of(1).velocity.c[0], SPEED(1000), 2);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK(find(CAROM_EVENT_WAKE, 1));
    CHECK(!find(CAROM_EVENT_WAKE, 2));
    CHECK_NEAR(state_of(1).velocity.c[0], SPEED(1000) - WEIGHT / 4, WEIGHT / 400);
    CHECK(state_of(2).asleep);
    CHECK_LESS(settle(1), 90);
    CHECK_MORE(state_of(1).position.c[0], s.position.c[0]);
}

/* A force of twice its weight wakes a sleeping box and lifts it by g n^2 / 2 in n frames. */
static void test_lift(void)
{
    const carom_v3_q40 force = {{0, 0, 2 * WEIGHT}};
    const int n = 20;
    struct carom_body_state s;

    begin(true, 0, 1 << 14);
    add_box(0, HALF + SKIN, 0, 1, 0, 1 << 14);
    CHECK_LESS(settle(1), 60);
    s = state_of(1);
    CHECK_EQ(carom_body_set_force(world, 1, &force), CAROM_OK);
    for (int frame = 1; frame <= n; frame++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK_EQ((find(CAROM_EVENT_WAKE, 1) != NULL), (frame == 1));
    }
    /* in contact it moves with its velocity after the frame's gravity, not after half of it */
    CHECK_NEAR(state_of(1).position.c[2] - s.position.c[2], (WEIGHT >> 9) * n * n,
               (WEIGHT >> 8) * n / 2);
    CHECK_NEAR(state_of(1).velocity.c[2], WEIGHT * n, WEIGHT >> 10);
}

const struct test tests_scene[] = {
    {"scene/meet", test_meet}, {"scene/slide", test_slide}, {"scene/stack", test_stack},
    {"scene/push", test_push}, {"scene/lift", test_lift},   {0},
};
