/* SPDX-License-Identifier: MIT */
/* Bodies that are solid from one side: a platform to jump through. */
#include <string.h>

#include "lib/boxes.h"
#include "num/fix.h"

enum { PLATFORM, BOX, FLOOR };

static uint8_t saved[4096];
static const int axes[3][3] = {{64, 2048, 2048}, {2048, 64, 2048}, {2048, 2048, 64}};

/* A rotation that brings an axis of the mesh up, or down. */
static carom_quat_q30 turn_up(int one_way)
{
    const int32_t half = 759250125; /* sqrt(1/2) */
    static const int8_t turns[7][4] = {{1, 0, 0, 0}, {1, 0, -1, 0}, {1, 1, 0, 0}, {1, 0, 0, 0},
                                       {1, 0, 1, 0}, {1, -1, 0, 0}, {0, 1, 0, 0}};
    carom_quat_q30 q;
    int parts = 0;

    for (int k = 0; k < 4; k++) {
        parts += turns[one_way][k] != 0;
    }
    for (int k = 0; k < 4; k++) {
        q.c[k] = turns[one_way][k] * (parts == 1 ? CAROM_ONE_Q30 : half);
    }
    return q;
}

static struct carom_world *make(int one_way)
{
    int axis = (one_way - 1) % 3;
    struct carom_world *w;
    struct carom_body_def def;

    boxes_begin();
    boxes_make(PLATFORM, axes[axis][0], axes[axis][1], axes[axis][2]);
    boxes_make(BOX, 128, 100, 75);
    boxes_make(FLOOR, 4096, 4096, 256);
    w = boxes_world(0);
    def = boxes_def(PLATFORM, 0, 0, 0);
    def.stationary = true;
    def.one_way = (uint8_t)one_way;
    def.rotation = turn_up(one_way);
    CHECK_EQ(boxes_add(w, &def), 0);
    return w;
}

/* The height of the box's lowest corner. */
static int64_t lowest_q32(const struct carom_body_state *state)
{
    const int half[3] = {128, 100, 75};
    int64_t low_q32 = state->position.c[2];
    carom_m3_q30 r;

    fix_matrix(&r, &state->rotation);
    for (int k = 0; k < 3; k++) {
        low_q32 -= carom_abs(r.c[2][k]) * half[k] >> 8;
    }
    return low_q32;
}

/* Boxes that fall from above stay on top and come to rest there. */
static void test_above(void)
{
    struct test_random r = {5};

    for (int i = 0; i < 24; i++) {
        struct carom_world *w = make(1 + i % 6);
        struct carom_body_def def = boxes_def(BOX, (int)test_random_range(&r, -1000, 1000),
                                              (int)test_random_range(&r, -1000, 1000), 400);

        for (int k = 0; k < 3; k++) {
            def.spin.c[k] = test_random_range(&r, BOXES_Q40(-200), BOXES_Q40(200));
        }
        def.velocity.c[2] = test_random_range(&r, BOXES_Q40(-3000), BOXES_Q40(-10));
        boxes_add(w, &def);
        for (int frame = 0; frame < 140; frame++) {
            struct carom_body_state state;

            boxes_step(w, 1);
            state = boxes_state(w, 1);
            CHECK_MORE(lowest_q32(&state), BOXES_Q32(64));
        }
        CHECK(boxes_state(w, 1).asleep);
    }
}

/*
 * Boxes thrown up from below pass as if there were no platform; then they come down and stay on
 * top.
 */
static void test_below(void)
{
    struct test_random r = {7};
    int rode = 0;

    for (int i = 0; i < 18; i++) {
        struct carom_world *w = make(1 + i % 6), *alone = boxes_world(1);
        struct carom_body_def def = boxes_def(BOX, (int)test_random_range(&r, -1000, 1000),
                                              (int)test_random_range(&r, -1000, 1000), -400);
        bool out = false;

        for (int k = 0; k < 3; k++) {
            def.spin.c[k] = test_random_range(&r, BOXES_Q40(-60), BOXES_Q40(60));
        }
        /* up to 500 .. 1000 above its start: v^2 / 2 g */
        def.velocity.c[2] = test_random_range(&r, BOXES_Q40(65), BOXES_Q40(75));
        boxes_add(w, &def);
        boxes_add(alone, &def);
        for (int frame = 0; frame < 160; frame++) {
            struct carom_body_state one, other;
            bool in;

            boxes_step(w, 1);
            boxes_step(alone, 1);
            one = boxes_state(w, 1);
            other = boxes_state(alone, 0);
            in = boxes_overlap(w, 1, 0);
            out = out || (one.position.c[2] > BOXES_Q32(64) && !in);
            CHECK(out || boxes_same(&one, &other));
            CHECK(!out || lowest_q32(&one) > BOXES_Q32(64));
            if (in && frame % 3 == 0) { /* a snapshot holds that the box is passing */
                int size = carom_snapshot_save(w, saved, sizeof saved);

                CHECK_MORE(size, 0);
                boxes_step(w, 3);
                CHECK_EQ(carom_snapshot_load(w, saved, (size_t)size), CAROM_OK);
            }
        }
        CHECK(out);
        CHECK_MORE(boxes_state(w, 1).position.c[2], BOXES_Q32(64));
        rode += boxes_state(w, 1).asleep;
    }
    CHECK_MORE(rode, 14);
}

/* A box that does not get through falls back, and a box from the side passes. */
static void test_back(void)
{
    struct carom_world *w = make(CAROM_ONE_WAY_Z);
    struct carom_body_def def = boxes_def(BOX, 0, 0, -400);
    bool was_in = false;

    def.velocity.c[2] = BOXES_Q40(45); /* 400 above it after half a second */
    boxes_add(w, &def);
    for (int frame = 0; frame < 60; frame++) {
        boxes_step(w, 1);
        was_in = was_in || boxes_overlap(w, 1, 0);
    }
    CHECK(was_in);
    CHECK_LESS(boxes_state(w, 1).position.c[2], BOXES_Q32(-400));

    w = make(CAROM_ONE_WAY_Z);
    def = boxes_def(BOX, -2400, 0, 30);
    def.velocity.c[0] = BOXES_Q40(100);
    boxes_add(w, &def);
    boxes_step(w, 30);
    CHECK_NEAR(boxes_state(w, 1).velocity.c[0], BOXES_Q40(100), 1000);
    CHECK_LESS(boxes_state(w, 1).position.c[2], BOXES_Q32(-500));
}

/*
 * A box that stands on the floor below the platform, within reach of its contacts, is not held by
 * it.
 */
static void test_under(void)
{
    struct carom_world *w = make(CAROM_ONE_WAY_Z);
    struct carom_body_def def = boxes_def(FLOOR, 0, 0, -64 - 150 - 256);
    const carom_v3_q40 up = {{0, 0, BOXES_Q40(3)}};
    int box;

    def.stationary = true;
    boxes_add(w, &def);
    def = boxes_def(BOX, 0, 0, -64 - 75);
    box = boxes_add(w, &def);
    boxes_step(w, 3);
    CHECK_EQ(boxes_events(w, CAROM_EVENT_HIT, box, 0), 0);
    CHECK_EQ(carom_body_set_force(w, box, &up), CAROM_OK);
    for (int frame = 0; frame < 200; frame++) {
        boxes_step(w, 1);
        CHECK_EQ(boxes_events(w, CAROM_EVENT_HIT, box, 0), 0);
        CHECK_EQ(boxes_events(w, CAROM_EVENT_BEGIN, box, 0), 0);
    }
    CHECK_MORE(boxes_state(w, box).position.c[2], BOXES_Q32(500));
}

/*
 * Two boxes, one above the other, stand just below the platform, without gravity. A third one hits the lower one from below within a
 * frame. Contacts with the platform are found last, and do not count: all three boxes go up together, with a third of its speed.
 */
static void test_from_below(void)
{
    struct carom_world *w = make(CAROM_ONE_WAY_Z);
    int64_t top = BOXES_Q32(-64) - BOXES_Q32(1) / 4;

    CHECK_EQ(carom_world_set_gravity(w, &(carom_v3_q40){{0}}), CAROM_OK);
    for (int i = 1; i <= 3; i++) {
        struct carom_body_def def = boxes_def(BOX, 700, -300, 0);

        def.position.c[2] = top - BOXES_Q32(75);
        top -= i == 1 ? BOXES_Q32(150) + BOXES_Q32(1) / 16 : BOXES_Q32(170);
        def.velocity.c[2] = i == 3 ? BOXES_Q40(45) : 0;
        CHECK_EQ(boxes_add(w, &def), i);
    }
    boxes_step(w, 1);
    CHECK_EQ(boxes_events(w, CAROM_EVENT_HIT, 3, 2), 1);
    boxes_step(w, 3);
    for (int i = 1; i <= 3; i++) {
        const struct carom_body_state state = boxes_state(w, i);

        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(state.velocity.c[k], k == 2 ? BOXES_Q40(15) : 0, BOXES_Q40(1) / 16);
            CHECK_NEAR(state.spin.c[k], 0, BOXES_Q40(1) / 4);
        }
    }
}

static void test_refused(void)
{
    struct carom_world *w = make(CAROM_ONE_WAY_Z);
    struct carom_body_def def = boxes_def(BOX, 0, 0, 1000);

    def.one_way = CAROM_ONE_WAY_MINUS_Z + 1;
    CHECK_EQ(carom_body_add(w, &def), CAROM_ERR_ARGUMENT);
}

const struct test tests_world_oneway[] = {{"world_oneway/above", test_above},
                                          {"world_oneway/below", test_below},
                                          {"world_oneway/back", test_back},
                                          {"world_oneway/under", test_under},
                                          {"world_oneway/from_below", test_from_below},
                                          {"world_oneway/refused", test_refused},
                                          {0}};
