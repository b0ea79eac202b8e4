/* SPDX-License-Identifier: MIT */
/*
 * Sleeping bodies in a step: what wakes them, and what does not. A body that wakes may touch another one that sleeps; the step
 * fails if the pairs of the one that wakes have no room.
 */
#include <string.h>

#include "lib/boxes.h"
#include "lib/test.h"
#include "world/world.h"

enum { GROUND, A, B, C, D };
enum { FLAT, CUBE, BAR };

static bool apart; /* A and B do not touch each other */

static bool ask(void *user, struct carom_touch *touch)
{
    (void)user;
    return !(apart && touch->a == B && touch->b == A);
}

/* A ground whose top is at z = 100, and cubes of half side 100. */
static struct carom_world *begin(uint32_t pairs)
{
    struct carom_world *world;
    struct carom_body_def def;

    boxes_begin();
    boxes_make(FLAT, 8000, 8000, 100);
    boxes_make(CUBE, 100, 100, 100);
    boxes_make(BAR, 20, 300, 10);
    boxes_config.caps.pairs = pairs;
    boxes_config.caps.extras = BOXES_EXTRAS;
    boxes_config.contact = ask;
    apart = true;
    world = boxes_world(0);
    def = boxes_def(FLAT, 0, 0, 0);
    def.stationary = true;
    CHECK_EQ(boxes_add(world, &def), GROUND);
    return world;
}

static int add_cube(struct carom_world *world, int x, int z)
{
    struct carom_body_def def = boxes_def(CUBE, x, 0, z);

    return boxes_add(world, &def);
}

/* A cube that slides without friction, by `speed` eighths of a place a frame. */
static int add_slider(struct carom_world *world, int x, int speed)
{
    struct carom_body_def def = boxes_def(CUBE, x, 0, 200);

    def.friction_q16 = 0;
    def.velocity.c[0] = BOXES_Q40(speed) / 8;
    return boxes_add(world, &def);
}

/* Step until A is awake; false if that takes too long. */
static bool wait(struct carom_world *world, int frames)
{
    for (int i = 0; i < frames; i++) {
        boxes_step(world, 1);
        if (!boxes_state(world, A).asleep) {
            return true;
        }
    }
    return false;
}

/*
 * A and B lie side by side and sleep, each for itself, since the caller wants no contact of them. Then it does. A third cube
 * wakes A, by a contact at the start of a frame or by a hit within it; A wakes B in the same frame.
 */
static void test_one_by_one(void)
{
    for (int hit = 0; hit < 2; hit++) {
        struct carom_world *world = begin(16);
        struct carom_body_def def = boxes_def(CUBE, 200, 0, 200);
        int hits;

        CHECK_EQ(add_cube(world, 0, 200), A);
        def.position.c[0] += BOXES_Q32(1) / 5; /* two skins apart: within the margin of contacts */
        CHECK_EQ(boxes_add(world, &def), B);
        CHECK_EQ(hit ? add_cube(world, 0, 3000) : add_slider(world, -208, 1), C);
        boxes_step(world, 35);
        CHECK(boxes_state(world, A).asleep && boxes_state(world, B).asleep);
        apart = false;
        boxes_step(world, 1);
        CHECK(boxes_state(world, A).asleep && boxes_state(world, B).asleep);
        CHECK(wait(world, 60));
        hits = boxes_events(world, CAROM_EVENT_HIT, C, A);
        CHECK_EQ(hits, hit);
        CHECK_EQ(boxes_events(world, CAROM_EVENT_WAKE, A, 0), 1);
        CHECK_EQ(boxes_events(world, CAROM_EVENT_WAKE, B, 0), 1);
        CHECK(!boxes_state(world, B).asleep);
    }
}

/* There is room for the pairs of a cube that comes, and none for the ground of A, which it wakes: the step changes nothing. */
static void test_no_room(void)
{
    for (int hit = 0; hit < 2; hit++) {
        struct carom_world *world = begin(hit ? 1 : 2);
        uint64_t hash = 0;
        int result = CAROM_OK, other;

        CHECK_EQ(add_cube(world, 0, 200), A);
        boxes_step(world, 35);
        CHECK(boxes_state(world, A).asleep);
        other = hit ? add_cube(world, 0, 600) : add_slider(world, -202, 1);
        for (int i = 0; i < 60 && result == CAROM_OK; i++) {
            hash = carom_world_hash(world);
            result = carom_world_step(world);
        }
        CHECK_EQ(result, CAROM_ERR_PAIRS_FULL);
        CHECK_EQ(carom_world_hash(world), hash);
        CHECK(boxes_state(world, A).asleep);
        CHECK_EQ(carom_world_step(world), CAROM_ERR_PAIRS_FULL);
        CHECK_EQ(carom_body_remove(world, other), CAROM_OK);
        boxes_step(world, 1);
    }
}

/*
 * A sleeps while it passes a bar, though another body moves. A push wakes it, and it still passes: it slides on at the height
 * where it was, with half of the other one's speed, as neither has friction and the hit takes no energy back.
 */
static void test_passing(void)
{
    struct carom_world *world = begin(16);
    struct carom_body_def def = boxes_def(CUBE, 0, 0, 200);
    struct carom_body_state before, after;

    def.friction_q16 = 0;
    CHECK_EQ(boxes_add(world, &def), A);
    def = boxes_def(BAR, 0, 0, 200);
    def.stationary = true;
    def.overlap = CAROM_OVERLAP_PASS;
    CHECK_EQ(boxes_add(world, &def), B);
    CHECK_EQ(add_slider(world, -480, 32), C); /* 280 apart, 4 a frame */
    boxes_step(world, 40);
    before = boxes_state(world, A);
    CHECK(before.asleep);
    for (int i = 0; i < 20; i++) {
        boxes_step(world, 1);
        after = boxes_state(world, A);
        CHECK(boxes_same(&before, &after));
    }
    CHECK(wait(world, 20));
    boxes_step(world, 20);
    after = boxes_state(world, A);
    CHECK_NEAR((double)(after.position.c[0] - before.position.c[0]), (double)BOXES_Q32(41),
               (double)BOXES_Q32(3));
    CHECK_NEAR((double)after.position.c[2], (double)before.position.c[2], (double)BOXES_Q32(1));
    CHECK(boxes_overlap(world, A, B));
}

/* A bar falls flat on two cubes that sleep apart from each other: both wake in the frame of the hit. */
static void test_both(void)
{
    struct carom_world *world = begin(16);
    struct carom_body_def def = boxes_def(BAR, 0, 0, 350);
    int woken = 0;

    boxes_make(BAR, 300, 50, 20);
    CHECK_EQ(add_cube(world, -250, 200), A);
    CHECK_EQ(add_cube(world, 250, 200), B);
    boxes_step(world, 35);
    CHECK(boxes_state(world, A).asleep && boxes_state(world, B).asleep);
    def.position.c[2] += BOXES_Q32(100);
    CHECK_EQ(boxes_add(world, &def), C);
    for (int i = 0; i < 40 && woken == 0; i++) {
        boxes_step(world, 1);
        woken = boxes_events(world, CAROM_EVENT_WAKE, A, 0);
        CHECK_EQ(boxes_events(world, CAROM_EVENT_WAKE, B, 0), woken);
    }
    CHECK_EQ(woken, 1);
}

/*
 * A and B sleep as one island, since the world says that they touched; they have parted, so no contact leads from one to the other.
 * D slides on the ground, and has a solve of its own in each frame. A cube falls on A: B wakes in the same frame, and lies still as
 * before. `first`: B is the first body of the world, and its ground comes after it.
 */
static void wake_both(bool first)
{
    struct carom_world *world = begin(16);
    static const struct pair parted[] = {{B, A}, {A, GROUND}};
    const int ground = first ? B : GROUND, b = first ? GROUND : B;
    struct carom_body_def def = boxes_def(FLAT, 0, 0, 0);
    struct carom_body_state before, after;

    def.stationary = true;
    CHECK_EQ(carom_body_remove(world, GROUND), CAROM_OK);
    CHECK_EQ(first ? add_cube(world, 2000, 200) : boxes_add(world, &def), GROUND);
    CHECK_EQ(add_cube(world, 0, 200), A);
    CHECK_EQ(first ? boxes_add(world, &def) : add_cube(world, 2000, 200), B);
    boxes_step(world, 35);
    CHECK(boxes_state(world, A).asleep && boxes_state(world, b).asleep);
    CHECK_EQ(world->now->touching_count, 2); /* each its ground */
    world->now->touching[world->now->touching_count++] = parted[first];
    CHECK_EQ(add_cube(world, -100, 1000), C);
    CHECK_EQ(add_slider(world, 5000, 8), D);
    before = boxes_state(world, b);
    CHECK(wait(world, 60));
    after = boxes_state(world, b);
    CHECK_EQ(boxes_events(world, CAROM_EVENT_HIT, C, A), 1);
    CHECK_EQ(boxes_events(world, CAROM_EVENT_WAKE, A, 0), 1);
    CHECK_EQ(boxes_events(world, CAROM_EVENT_WAKE, b, 0), 1);
    CHECK_EQ(boxes_events(world, CAROM_EVENT_HIT, b, ground), 0);
    for (int k = 0; k < 3; k++) { /* the fall of a tenth of a frame is 5 times as much */
        CHECK_NEAR(after.position.c[k], before.position.c[k], BOXES_Q32(1) / 1024);
    }
}

static void test_whole_island(void)
{
    wake_both(false);
    wake_both(true);
}

/*
 * B slides over A without friction and leaves the world there. Nothing moves A any more, so it falls asleep at once, and keeps what
 * touched it. A cube that falls on A wakes A, and not B, which has gone; only then do A and B end to touch.
 */
static void test_left_behind(void)
{
    const int edge = 4096 * 1024;
    struct carom_world *world = begin(16);
    struct carom_body_def def = boxes_def(FLAT, edge, 0, 0);
    struct carom_body_state out;
    int ended = 0;

    boxes_make(BAR, 1000, 200, 20);
    def.stationary = true;
    CHECK_EQ(carom_body_remove(world, GROUND), CAROM_OK);
    CHECK_EQ(boxes_add(world, &def), GROUND);
    def = boxes_def(BAR, edge - 500, 0, 120);
    CHECK_EQ(boxes_add(world, &def), A);
    def = boxes_def(CUBE, edge - 300, 0, 240);
    def.friction_q16 = 0;
    def.velocity.c[0] = BOXES_Q40(8);
    CHECK_EQ(boxes_add(world, &def), B);
    apart = false;
    boxes_step(world, 37);
    CHECK(!boxes_state(world, A).asleep && !boxes_state(world, B).out);
    boxes_step(world, 1);
    out = boxes_state(world, B);
    CHECK(boxes_state(world, A).asleep && out.out);
    boxes_step(world, 1);
    CHECK_EQ(boxes_events(world, CAROM_EVENT_END, B, A), 0);
    CHECK_EQ(add_cube(world, edge - 900, 400), C);
    CHECK(wait(world, 40));
    CHECK_EQ(boxes_events(world, CAROM_EVENT_WAKE, A, 0), 1);
    CHECK_EQ(boxes_events(world, CAROM_EVENT_WAKE, B, 0), 0);
    CHECK_EQ(boxes_events(world, CAROM_EVENT_END, B, A), 1);
    for (int i = 0; i < 5; i++) {
        struct carom_body_state now = boxes_state(world, B);

        CHECK(now.out && boxes_same(&now, &out));
        boxes_step(world, 1);
        ended += boxes_events(world, CAROM_EVENT_END, B, A);
    }
    CHECK_EQ(ended, 0);
}

const struct test tests_world_wake[] = {{"world_wake/one_by_one", test_one_by_one},
                                        {"world_wake/no_room", test_no_room},
                                        {"world_wake/passing", test_passing},
                                        {"world_wake/both", test_both},
                                        {"world_wake/left_behind", test_left_behind},
                                        {"world_wake/whole_island", test_whole_island},
                                        {0}};
