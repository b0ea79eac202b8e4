/* SPDX-License-Identifier: MIT */
/* Filters: the pairs that may touch, and the bodies that a filter separates or lets touch. */
#include <string.h>

#include "lib/boxes.h"
#include "pairs/broad.h"

enum { PLATE, BOX, FLOOR };

static uint8_t saved[2048];

static void begin(void)
{
    boxes_begin();
    boxes_make(PLATE, 2048, 2048, 128);
    boxes_make(BOX, 256, 200, 150);
    boxes_make(FLOOR, 4096, 4096, 256);
}

/* A plate as body 0, a box above it as body 1. */
static struct carom_world *make(int number, struct carom_filter plate, struct carom_filter box)
{
    struct carom_world *w = boxes_world(number);
    struct carom_body_def def = boxes_def(PLATE, 0, 0, 0);

    def.stationary = true;
    def.filter = plate;
    CHECK_EQ(boxes_add(w, &def), 0);
    def = boxes_def(BOX, 30, 20, 400);
    def.filter = box;
    def.spin.c[0] = CAROM_RATIO(1, 100, 40);
    CHECK_EQ(boxes_add(w, &def), 1);
    return w;
}

/* The box alone. */
static struct carom_world *make_free(int number)
{
    struct carom_world *w = boxes_world(number);
    struct carom_body_def def = boxes_def(BOX, 30, 20, 400);

    def.spin.c[0] = CAROM_RATIO(1, 100, 40);
    CHECK_EQ(boxes_add(w, &def), 0);
    return w;
}

/* The rule, bit by bit, as in Box2D's manual. */
static bool may_touch(const struct carom_filter *a, const struct carom_filter *b)
{
    bool ab = false, ba = false;

    for (int bit = 0; bit < 16; bit++) {
        ab = ab || ((a->category >> bit & 1) && (b->mask >> bit & 1));
        ba = ba || ((b->category >> bit & 1) && (a->mask >> bit & 1));
    }
    if (a->group != 0 && a->group == b->group) {
        return a->group > 0;
    }
    return ab && ba;
}

static uint16_t random_bits(struct test_random *r)
{
    return (uint16_t)(test_random_next(r) & test_random_next(r) & test_random_next(r));
}

static void test_rule(void)
{
    struct test_random r = {1};
    int touch = 0;

    for (int i = 0; i < 4000; i++) {
        struct carom_filter f[2];
        struct body b[2];

        memset(b, 0, sizeof b);
        for (int k = 0; k < 2; k++) {
            f[k] = (struct carom_filter){random_bits(&r), (uint16_t)test_random_next(&r),
                                         (int16_t)test_random_range(&r, -2, 2)};
            b[k].def.category = f[k].category;
            b[k].def.mask = f[k].mask;
            b[k].def.group = f[k].group;
        }
        touch += may_touch(&f[0], &f[1]);
        CHECK_EQ(broad_may_meet(&b[0], &b[1]), may_touch(&f[0], &f[1]));
        CHECK_EQ(broad_may_meet(&b[1], &b[0]), may_touch(&f[0], &f[1]));
    }
    CHECK_MORE(touch, 1000);
    CHECK_LESS(touch, 3000);
}

/* Bodies that may not touch move as if they were alone, and make no pair. */
static void check_through(struct carom_filter plate, struct carom_filter box)
{
    struct carom_world *w = make(0, plate, box), *alone = make_free(1);

    for (int frame = 0; frame < 40; frame++) {
        boxes_step_alike(w, 1, alone, 0);
        CHECK_EQ(boxes_pairs(w), 0);
    }
    CHECK_LESS(boxes_state(w, 1).position.c[2], BOXES_Q32(-1024));
}

static void check_held(struct carom_filter plate, struct carom_filter box)
{
    struct carom_world *w = make(0, plate, box);

    boxes_step(w, 60);
    CHECK_MORE(boxes_state(w, 1).position.c[2], BOXES_Q32(256));
}

static void test_touch(void)
{
    const struct carom_filter none = {0}, second = {2, 0xffff, 0}, first_only = {1, 1, 0};
    const struct carom_filter group = {1, 0xffff, -3}, other = {1, 0xffff, -4};
    const struct carom_filter together = {1, 0, 5}, nobody = {1, 0, 0};

    begin();
    check_held(none, none);
    check_held(none, second);
    check_through(second, first_only);
    check_through(first_only, second);
    check_through(group, group);
    check_held(group, other);
    check_held(together, together);
    check_through(nobody, none);
}

/*
 * A sleeping box falls when a filter lets it. Halfway through the plate the filter makes it solid
 * again, and it still falls.
 */
static void test_change(void)
{
    const struct carom_filter off = {2, 2, 0}, on = {0};
    struct carom_world *w, *alone;
    struct carom_filter now;
    int below = 0;

    begin();
    w = make(0, on, on);
    boxes_step(w, 120);
    CHECK(boxes_state(w, 1).asleep);
    CHECK_EQ(carom_body_set_filter(w, 1, &on), CAROM_OK); /* the same */
    CHECK(boxes_state(w, 1).asleep);
    CHECK_EQ(carom_body_set_filter(w, 1, &off), CAROM_OK);
    CHECK(!boxes_state(w, 1).asleep);
    CHECK_EQ(carom_body_get_filter(w, 1, &now), CAROM_OK);
    CHECK_EQ(now.category, 2);
    CHECK_EQ(now.mask, 2);
    CHECK_EQ(now.group, 0);
    alone = make_free(1);
    {
        struct carom_body_state state = boxes_state(w, 1);

        CHECK_EQ(carom_body_set(alone, 0, &state), CAROM_OK);
    }
    for (int frame = 0; frame < 40; frame++) {
        if (frame == 13) {
            CHECK(boxes_overlap(w, 1, 0));
            CHECK_EQ(carom_body_set_filter(w, 1, &on), CAROM_OK);
            CHECK_MORE(carom_snapshot_save(w, saved, sizeof saved), 0);
        }
        if (frame == 16) { /* a snapshot holds the pair that passes */
            int size = carom_snapshot_size(w);

            CHECK_MORE(size, 0);
            CHECK(boxes_overlap(w, 1, 0));
            CHECK_EQ(carom_snapshot_save(w, saved, sizeof saved), size);
            boxes_step(w, 2);
            CHECK_EQ(carom_snapshot_load(w, saved, (size_t)size), CAROM_OK);
        }
        boxes_step_alike(w, 1, alone, 0);
        below += frame > 13 && !boxes_overlap(w, 1, 0);
    }
    CHECK_MORE(below, 5);
    /* it is out: from below it hits */
    boxes_held_down(w, 200);
}

/* Filters are in a snapshot, and it gives them back. */
static void test_snapshot(void)
{
    const struct carom_filter off = {2, 2, -7}, on = {0};
    struct carom_world *w;
    struct carom_filter now;
    uint64_t hash[2];
    int plain, size;

    begin();
    w = make(0, on, on);
    hash[0] = carom_world_hash(w);
    plain = carom_snapshot_size(w);
    CHECK_EQ(carom_body_set_filter(w, 1, &off), CAROM_OK);
    hash[1] = carom_world_hash(w);
    CHECK_DIFFER(hash[0], hash[1]);
    size = carom_snapshot_save(w, saved, sizeof saved);
    CHECK_EQ(size, plain + 4 + 2 * 6); /* a tag, two bodies */
    CHECK_EQ(carom_body_set_filter(w, 1, &on), CAROM_OK);
    CHECK_EQ(carom_world_hash(w), hash[0]);
    CHECK_EQ(carom_snapshot_load(w, saved, (size_t)size), CAROM_OK);
    CHECK_EQ(carom_body_get_filter(w, 1, &now), CAROM_OK);
    CHECK_EQ(now.category, 2);
    CHECK_EQ(now.mask, 2);
    CHECK_EQ(now.group, -7);
    CHECK_EQ(carom_world_hash(w), hash[1]);
    for (int cut = 0; cut < size; cut++) {
        CHECK_EQ(carom_snapshot_load(w, saved, (size_t)cut), CAROM_ERR_FORMAT);
    }
    CHECK_EQ(carom_world_hash(w), hash[1]);
    /* a snapshot with default filters removes the others */
    w = make(0, on, on);
    size = carom_snapshot_save(w, saved, sizeof saved);
    CHECK_EQ(carom_body_set_filter(w, 1, &off), CAROM_OK);
    CHECK_EQ(carom_snapshot_load(w, saved, (size_t)size), CAROM_OK);
    CHECK_EQ(carom_world_hash(w), hash[0]);
}

static void test_errors(void)
{
    const struct carom_filter on = {0};
    struct carom_filter now;
    struct carom_world *w;

    begin();
    w = make(0, on, on);
    CHECK_EQ(carom_body_set_filter(NULL, 0, &on), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_set_filter(w, 0, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_get_filter(NULL, 0, &now), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_get_filter(w, 0, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_set_filter(w, 2, &on), CAROM_ERR_BODY);
    CHECK_EQ(carom_body_set_filter(w, -1, &on), CAROM_ERR_BODY);
    CHECK_EQ(carom_body_get_filter(w, 2, &now), CAROM_ERR_BODY);
    CHECK_EQ(carom_body_get_filter(w, 0, &now), CAROM_OK);
    CHECK_EQ(now.category, 1);
    CHECK_EQ(now.mask, 0xffff);
    CHECK_EQ(now.group, 0);
}

const struct test tests_world_filter[] = {
    {"world_filter/rule", test_rule},     {"world_filter/touch", test_touch},
    {"world_filter/change", test_change}, {"world_filter/snapshot", test_snapshot},
    {"world_filter/errors", test_errors}, {0}};
