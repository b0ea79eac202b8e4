/* SPDX-License-Identifier: MIT */
/* Bodies that overlap at the start: refused, pushed out, or allowed to pass. */
#include <string.h>

#include "lib/boxes.h"

enum { PLATE, BOX, FLOOR, HUGE };

static uint8_t saved[4096];

static struct carom_world *make(void)
{
    struct carom_world *w;
    struct carom_body_def def;

    boxes_begin();
    boxes_make(PLATE, 2048, 2048, 128);
    boxes_make(BOX, 256, 200, 150);
    boxes_make(FLOOR, 4096, 4096, 256);
    boxes_make(HUGE, 32767, 32767, 32767);
    w = boxes_world(0);
    def = boxes_def(PLATE, 0, 0, 0);
    def.stationary = true;
    CHECK_EQ(boxes_add(w, &def), 0);
    return w;
}

/* Adding is refused and leaves no trace. */
static void refuse(struct carom_world *w, const struct carom_body_def *def, int error)
{
    uint64_t hash = carom_world_hash(w);
    int count = carom_body_count(w);

    CHECK_EQ(carom_body_add(w, def), error);
    CHECK_EQ(carom_world_hash(w), hash);
    CHECK_EQ(carom_body_count(w), count);
}

/*
 * The box's lowest face is at z - 150, the plate's highest at 128; a skin of the box is 360 / 2048
 * of a unit here.
 */
static void test_depth(void)
{
    struct carom_world *w = make();
    struct carom_body_def def = boxes_def(BOX, 0, 0, 0);
    int box;

    for (int depth = -40; depth <= 40; depth++) {
        def.position.c[2] = BOXES_Q32(278) - (int64_t)depth * BOXES_Q32(1) / 16;
        box = carom_body_add(w, &def);
        if (depth <= 2) { /* 2/16 of a unit: within a skin */
            CHECK_MORE(box, 0);
        } else if (depth >= 8) { /* half a unit: three of them */
            CHECK_EQ(box, CAROM_ERR_OVERLAP);
        }
        if (box > 0) {
            CHECK_EQ(carom_body_remove(w, box), CAROM_OK);
        }
    }
    for (int z = -270; z <= 270; z += 30) {
        def = boxes_def(BOX, 1000, -900, z);
        refuse(w, &def, CAROM_ERR_OVERLAP);
    }
    /* beside the plate, by the sum of their sides */
    def = boxes_def(BOX, 2048 + 256 + 1, 0, 0);
    box = boxes_add(w, &def);
    CHECK_EQ(carom_body_remove(w, box), CAROM_OK);
    def = boxes_def(BOX, 2048 + 256 - 1, 0, 0);
    refuse(w, &def, CAROM_ERR_OVERLAP);
}

static void test_who(void)
{
    struct carom_world *w = make();
    struct carom_body_def def = boxes_def(PLATE, 0, 0, 100);

    def.stationary = true; /* both are static */
    CHECK_EQ(boxes_add(w, &def), 1);
    def = boxes_def(BOX, 0, 0, 0);
    def.sensor = true;
    CHECK_EQ(boxes_add(w, &def), 2);
    def.sensor = false;
    def.filter = (struct carom_filter){2, 2, 0};
    CHECK_EQ(boxes_add(w, &def), 3);
    refuse(w, &def, CAROM_ERR_OVERLAP); /* the body before it has the same filter */
    def.filter = (struct carom_filter){0};
    refuse(w, &def, CAROM_ERR_OVERLAP);
    def.overlap = CAROM_OVERLAP_PASS + 1;
    refuse(w, &def, CAROM_ERR_ARGUMENT);
    /* wholly inside a moving body, and around one */
    def = boxes_def(FLOOR, 0, 0, 9000);
    CHECK_EQ(boxes_add(w, &def), 4);
    def = boxes_def(BOX, 1000, 100, 9000);
    refuse(w, &def, CAROM_ERR_OVERLAP);
    def = boxes_def(BOX, 1000, 100, 12000);
    CHECK_EQ(boxes_add(w, &def), 5);
    CHECK_EQ(boxes_set(w, 4, 0, 0, 12000, 0), CAROM_ERR_OVERLAP);
}

static void test_set(void)
{
    struct carom_world *w = make();
    struct carom_body_def def = boxes_def(BOX, 0, 0, 2000);
    struct carom_body_state state;
    uint64_t hash;

    CHECK_EQ(boxes_add(w, &def), 1);
    boxes_step(w, 3);
    hash = carom_world_hash(w);
    CHECK_EQ(boxes_set(w, 1, 0, 0, 100, CAROM_OVERLAP_REFUSE), CAROM_ERR_OVERLAP);
    CHECK_EQ(boxes_set(w, 0, 0, 0, 1990, CAROM_OVERLAP_REFUSE), CAROM_ERR_OVERLAP);
    CHECK_EQ(boxes_set(w, 1, 0, 0, 100, CAROM_OVERLAP_PASS + 1), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_world_hash(w), hash);
    CHECK_EQ(boxes_set(w, 1, 0, 0, 300, CAROM_OVERLAP_REFUSE), CAROM_OK);
    CHECK_EQ(boxes_set(w, 1, 0, 0, 100, CAROM_OVERLAP_PUSH_OUT), CAROM_OK);
    CHECK_NEAR(boxes_state(w, 1).position.c[2], BOXES_Q32(278), BOXES_Q32(1));
    CHECK(!boxes_overlap(w, 1, 0));
    /* the motion of a body may be set while it passes the plate */
    CHECK_EQ(boxes_set(w, 1, 0, 0, 100, CAROM_OVERLAP_PASS), CAROM_OK);
    state = boxes_state(w, 1);
    state.velocity.c[0] = BOXES_Q40(5);
    CHECK_EQ(carom_body_set(w, 1, &state), CAROM_OK);
    CHECK_EQ(boxes_set(w, 1, 5, 0, 90, CAROM_OVERLAP_REFUSE), CAROM_OK);
}

/* The shortest way out is known by hand: as far as the box is inside, through the nearest side. */
static void test_push(void)
{
    static const struct {
        int at[3], out[3];
    } cases[] = {{{0, 0, 200}, {0, 0, 278}},
                 {{0, 0, -200}, {0, 0, -278}},
                 {{2250, 0, 0}, {2304, 0, 0}},
                 {{0, -2200, 20}, {0, -2248, 20}}};

    for (int i = 0; i < 4; i++) {
        struct carom_world *w = make();
        struct carom_body_def def = boxes_def(BOX, cases[i].at[0], cases[i].at[1], cases[i].at[2]);
        struct carom_body_state state;

        def.overlap = CAROM_OVERLAP_PUSH_OUT;
        CHECK_EQ(boxes_add(w, &def), 1);
        state = boxes_state(w, 1);
        CHECK(!boxes_overlap(w, 1, 0));
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(state.position.c[k], BOXES_Q32(cases[i].out[k]), BOXES_Q32(1));
        }
        boxes_step(w, 20);
    }
}

/* Between two plates the box fits nowhere but beside them; in a huge body nowhere. */
static void test_blocked(void)
{
    struct carom_world *w = make();
    struct carom_body_def def = boxes_def(PLATE, 0, 0, 500);
    struct carom_body_state state;

    def.stationary = true;
    CHECK_EQ(boxes_add(w, &def), 1);
    def = boxes_def(BOX, 0, 0, 260);
    def.overlap = CAROM_OVERLAP_PUSH_OUT;
    CHECK_EQ(boxes_add(w, &def), 2);
    state = boxes_state(w, 2);
    CHECK_NEAR(state.position.c[2], BOXES_Q32(500 + 278), BOXES_Q32(2));
    CHECK(!boxes_overlap(w, 2, 0));
    CHECK(!boxes_overlap(w, 2, 1));
    CHECK_EQ(carom_body_remove(w, 2), CAROM_OK);
    CHECK_EQ(carom_body_remove(w, 1), CAROM_OK);
    for (int i = 0; i < 8; i++) {
        def = boxes_def(HUGE, 32000 * ((i & 1) * 2 - 1), 32000 * ((i & 2) - 1),
                        32000 * ((i & 4) / 2 - 1));
        def.stationary = true;
        CHECK_EQ(boxes_add(w, &def), 1 + i);
    }
    def = boxes_def(BOX, 100, 0, 60);
    def.overlap = CAROM_OVERLAP_PUSH_OUT;
    refuse(w, &def, CAROM_ERR_BLOCKED);
}

/* A passing body falls as if nothing were there, and is solid again when it is out. */
static void test_pass(void)
{
    struct carom_world *w = make(), *alone = boxes_world(1);
    struct carom_body_def def = boxes_def(BOX, 30, 40, 100);
    bool out = false;
    int size;

    def.spin.c[1] = CAROM_RATIO(1, 50, 40);
    boxes_add(alone, &def);
    def.overlap = CAROM_OVERLAP_PASS;
    CHECK_EQ(boxes_add(w, &def), 1);
    for (int frame = 0; frame < 40; frame++) {
        boxes_step_alike(w, 1, alone, 0);
        out = out || !boxes_overlap(w, 1, 0);
        size = carom_snapshot_save(w, saved, sizeof saved);
        CHECK_EQ(carom_snapshot_load(w, saved, (size_t)size), CAROM_OK);
    }
    CHECK(out);
    boxes_held_down(w, 300);
}

/* No more pairs pass than there is room for. */
static void test_full(void)
{
    struct carom_world *w;
    struct carom_body_def def;

    make();
    boxes_config.caps.pairs = 2;
    w = boxes_world(0);
    for (int i = 0; i < 3; i++) {
        def = boxes_def(PLATE, 0, 0, 400 * i);
        def.stationary = true;
        CHECK_EQ(boxes_add(w, &def), i);
    }
    def = boxes_def(BOX, 0, 0, 200);
    def.overlap = CAROM_OVERLAP_PASS;
    CHECK_EQ(boxes_add(w, &def), 3); /* two plates */
    def = boxes_def(BOX, 1000, 0, 200);
    def.overlap = CAROM_OVERLAP_PASS;
    refuse(w, &def, CAROM_ERR_PAIRS_FULL);
    CHECK_EQ(carom_body_remove(w, 3), CAROM_OK);
    CHECK_EQ(boxes_add(w, &def), 3);
    boxes_step(w, 1);
}

/*
 * Two boxes pass the plate, half a unit deep in it, and one of them is removed. The other one rises until it is hardly in the
 * plate, comes down, and still moves as if nothing were there.
 */
static void test_removed(void)
{
    make();
    boxes_config.gravity = (carom_v3_q40){{0}};
    for (int gone = 1; gone <= 2; gone++) {
        struct carom_world *w = boxes_world(0), *alone = boxes_world(1);
        struct carom_body_def def = boxes_def(PLATE, 0, 0, 0);
        struct carom_body_state state;

        def.stationary = true;
        CHECK_EQ(boxes_add(w, &def), 0);
        def = boxes_def(BOX, 30, 40, 278);
        def.position.c[2] -= BOXES_Q32(1) / 2;
        def.velocity.c[2] = BOXES_Q40(1) / 16;
        def.overlap = CAROM_OVERLAP_PASS;
        boxes_add(alone, &def);
        for (int i = 1; i <= 2; i++) {
            def.position.c[0] = BOXES_Q32(i == gone ? 1000 : 30);
            CHECK_EQ(boxes_add(w, &def), i);
        }
        CHECK_EQ(carom_body_remove(w, gone), CAROM_OK);
        for (int frame = 0; frame < 7; frame++) {
            boxes_step_alike(w, 3 - gone, alone, 0);
        }
        state = boxes_state(alone, 0);
        state.velocity.c[2] = -BOXES_Q40(1);
        CHECK_EQ(carom_body_set(alone, 0, &state), CAROM_OK);
        CHECK_EQ(carom_body_set(w, 3 - gone, &state), CAROM_OK);
        for (int frame = 0; frame < 10; frame++) {
            boxes_step_alike(w, 3 - gone, alone, 0);
        }
    }
}

/* At the edge of the world the shortest way out may leave it: then the shortest one that stays inside counts. */
static void test_edge(void)
{
    const int most = 4096 * 1024, side = 512,
              aside = 600; /* of 1024, the cubes' sides; half of one */

    for (int sign = -1; sign <= 1; sign += 2) {
        for (int inside = 0; inside < 2; inside++) {
            const int x = sign * (most - 8 * 1024 * inside);
            struct carom_body_def def;
            struct carom_body_state s;
            struct carom_world *w;

            boxes_begin();
            boxes_make(0, side, side, side);
            boxes_config.gravity = (carom_v3_q40){{0}};
            w = boxes_world(0);
            def = boxes_def(0, x - sign * aside, 0, 0);
            def.stationary = true;
            CHECK_EQ(boxes_add(w, &def), 0);
            def = boxes_def(0, x, 0, 0);
            def.overlap = CAROM_OVERLAP_PUSH_OUT;
            CHECK_EQ(boxes_add(w, &def), 1);
            s = boxes_state(w, 1);
            CHECK(!boxes_overlap(w, 0, 1));
            CHECK_AT_MOST(sign * s.position.c[0], BOXES_Q32(most));
            if (inside) { /* 424 outward */
                CHECK_NEAR(sign * (s.position.c[0] - BOXES_Q32(x)), BOXES_Q32(2 * side - aside),
                           BOXES_Q32(8));
                CHECK_EQ(s.position.c[1] | s.position.c[2], 0);
            } else { /* 1024 along another axis */
                const int64_t y = s.position.c[1] < 0 ? -s.position.c[1] : s.position.c[1];
                const int64_t z = s.position.c[2] < 0 ? -s.position.c[2] : s.position.c[2];

                CHECK_EQ(s.position.c[0], BOXES_Q32(x));
                CHECK_NEAR(y + z, BOXES_Q32(2 * side), BOXES_Q32(8));
                CHECK(y == 0 || z == 0);
            }
        }
    }
}

const struct test tests_world_overlap[] = {
    {"world_overlap/depth", test_depth},     {"world_overlap/who", test_who},
    {"world_overlap/set", test_set},         {"world_overlap/push", test_push},
    {"world_overlap/blocked", test_blocked}, {"world_overlap/pass", test_pass},
    {"world_overlap/full", test_full},       {"world_overlap/removed", test_removed},
    {"world_overlap/edge", test_edge},       {0}};
