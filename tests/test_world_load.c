/* SPDX-License-Identifier: MIT */
/*
 * Snapshots with a changed number and a corrected check sum: each is refused and the world is as it
 * was, or the following steps are clean and end. These tests are most useful in a build with
 * sanitizers.
 */
#include <string.h>

#include "lib/bytes.h"
#include "lib/shapes.h"
#include "lib/test.h"

#if defined TEST_LONG
#define CHANGES 2000 /* changes for each state of each world */
#elif defined CAROM_DEBUG
#define CHANGES 300
#else
#define CHANGES 30
#endif

#define CAPS   6, 15, 64, 128, 0, 512
#define BODIES 5
#define STATES 3
#define ONE    ((int64_t)1 << 40)

/* Parts of a snapshot: gravity, and where places, kept impulses and touching pairs begin. */
enum { AT_GRAVITY = 4, AT_PLACES = 28, AT_BODY = 32, BODY_BYTES = 117, WARM_BYTES = 60 };

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static uint8_t saved[8192], changed[8192];
static struct shape ground, box, thin;
static struct test_random rnd;

static struct carom_world *empty(bool sleep)
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS), .sleep = sleep};
    struct carom_world *w = NULL;

    config.gravity.c[2] = CAROM_GRAVITY_MM_S2(-9810, 60);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &w), CAROM_OK);
    return w;
}

/*
 * A stack of boxes, one of them light, or needles and boxes that fly at each other, above a plane.
 */
static struct carom_world *make(bool stack)
{
    struct carom_body_def def = {.mesh = &ground.mesh, .stationary = true, .friction_q16 = 1 << 15};
    struct carom_world *w = empty(stack);

    shape_plane(&ground, 12, 1, 16384);
    shape_box(&box, 12, 4096, 4096, 2048);
    shape_box(&thin, 12, 8, 12, 6000);
    CHECK_EQ(carom_body_add(w, &def), 0);
    def.stationary = false;
    for (int i = 1; i < BODIES; i++) {
        def.mesh = !stack && i % 2 == 0 ? &thin.mesh : &box.mesh;
        def.mass_q20 = i == 3 ? 1 << 12 : 0;
        def.mass_q20 = !stack && i % 2 == 0 ? 1 << 14 : def.mass_q20;
        def.position.c[0] = CAROM_RATIO(stack ? i : 13 * i, stack ? 50 : 10, 32);
        def.position.c[2] = CAROM_RATIO(52 * i - 26, stack ? 100 : 40, 32);
        def.velocity.c[0] = stack ? 0 : -ONE / 16 * i;
        def.spin.c[1] = stack ? 0 : ONE / 3 * i;
        CHECK_EQ(carom_body_add(w, &def), i);
    }
    return w;
}

/* A number in the snapshot: its offset and its length in bytes. */
struct field {
    int at, bytes;
};

static struct field field_from(const uint8_t *sizes, int count, int at, int n)
{
    struct field f = {at, sizes[0]};

    for (int i = 0; i < n % count; i++) {
        f.at += sizes[i];
        f.bytes = sizes[i + 1];
    }
    return f;
}

/* A random number of the snapshot. */
static struct field choose(void)
{
    static const uint8_t of_body[21] = {1, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8,
                                        8, 8, 4, 4, 4, 4, 1, 1, 1, 1};
    static const uint8_t of_warm[12] = {2, 2, 4, 4, 4, 4, 4, 4, 8, 8, 8, 8};
    static const uint8_t of_pair[2] = {2, 2};
    const int at_warm = AT_BODY + BODIES * BODY_BYTES;
    const int warm = (int)bytes_number(saved + at_warm, 4);
    const int at_touching = at_warm + 4 + warm * WARM_BYTES;
    const int touching = (int)bytes_number(saved + at_touching, 4);
    const int n = (int)test_random_range(&rnd, 0, 10000);

    switch (test_random_range(&rnd, 0, 9)) {
    case 0:
        return (struct field){AT_GRAVITY + n % 3 * 8, 8};
    case 1:
        return (struct field){n % 3 == 0 ? AT_PLACES : n % 3 == 1 ? at_warm : at_touching, 4};
    case 2:
        return touching > 0 ? field_from(of_pair, 2, at_touching + 4 + n % touching * 4, n / 100)
                            : (struct field){at_touching, 4};
    case 3:
    case 4:
    case 5:
        return warm > 0 ? field_from(of_warm, 12, at_warm + 4 + n % warm * WARM_BYTES, n / 100)
                        : (struct field){at_warm, 4};
    default:
        return field_from(of_body, 21, AT_BODY + n % BODIES * BODY_BYTES, n / 100);
    }
}

/* Another number: a near one, an extreme one, a multiple, or a random one with that many bits. */
static uint64_t other_number(uint64_t v, int bytes)
{
    const int bits = 8 * bytes, n = (int)test_random_range(&rnd, 0, bits - 1);
    const int64_t signed_v = (int64_t)(v << (64 - bits)) >> (64 - bits);

    switch (test_random_range(&rnd, 0, 7)) {
    case 0:
        return v + (uint64_t)test_random_range(&rnd, -3, 3);
    case 1:
        return ((uint64_t)1 << n) + (uint64_t)test_random_range(&rnd, -1, 1);
    case 2:
        return 0 - ((uint64_t)1 << n) + (uint64_t)test_random_range(&rnd, -1, 1);
    case 3:
        return v ^ (uint64_t)1 << n;
    case 4:
        return 0 - v;
    case 5:
        return v + (uint64_t)(signed_v / 8 * test_random_range(&rnd, -16, 64));
    case 6:
        return (uint64_t)test_random_range(&rnd, 0, 255);
    default:
        return test_random_next(&rnd) >> (63 - n);
    }
}

/* Change one to three numbers, preferably of a body or an impulse. */
static void change(int size)
{
    memcpy(changed, saved, (size_t)size);
    for (int64_t n = test_random_range(&rnd, 0, 3); n >= 0; n -= 2) {
        struct field f = choose();

        bytes_put(changed + f.at, other_number(bytes_number(saved + f.at, f.bytes), f.bytes),
                  f.bytes);
    }
    bytes_mend(changed, (size_t)size);
}

/* Take a step; it may be refused because a pool is short or a body too fast for a mesh. */
static void go_on(struct carom_world *w)
{
    for (int frame = 0; frame < 3; frame++) {
        uint64_t hash = carom_world_hash(w);
        int result = carom_world_step(w);

        CHECK(result >= 0 || (result >= CAROM_ERR_FACES_FULL && result <= CAROM_ERR_PAIRS_FULL) ||
              result == CAROM_ERR_RANGE);
        CHECK(result >= 0 || carom_world_hash(w) == hash);
    }
}

static void check_changes(struct carom_world *w, int *taken, int *refused)
{
    int size = carom_snapshot_save(w, saved, sizeof saved);

    CHECK_MORE(size, 0);
    for (int i = 0; i < CHANGES; i++) {
        uint64_t hash = carom_world_hash(w);
        int result;

        change(size);
        result = carom_snapshot_load(w, changed, (size_t)size);
        if (result == CAROM_OK) {
            (*taken)++;
            go_on(w);
            /* a snapshot of a stepped world is always accepted */
            CHECK_MORE(carom_snapshot_save(w, changed, sizeof changed), 0);
            CHECK_EQ(carom_snapshot_load(w, changed, (size_t)carom_snapshot_size(w)), CAROM_OK);
        } else {
            (*refused)++;
            CHECK_EQ(result, CAROM_ERR_FORMAT);
            CHECK_EQ(carom_world_hash(w), hash);
        }
        CHECK_EQ(carom_snapshot_load(w, saved, (size_t)size), CAROM_OK);
    }
}

static void check_world(bool stack)
{
    struct carom_world *w = make(stack);
    int taken = 0, refused = 0, asleep = 0;

    rnd.state = stack;
    for (int state = 0; state < STATES; state++) {
        /* just in contact or in flight; lying or among hits; asleep or scattered */
        for (int frame = 0; frame < (state < 2 ? 12 : stack ? 150 : 20); frame++) {
            CHECK_AT_LEAST(carom_world_step(w), 0);
        }
        check_changes(w, &taken, &refused);
    }
    for (int i = 1; i < BODIES; i++) {
        struct carom_body_state s;

        CHECK_EQ(carom_body_get(w, i, &s), CAROM_OK);
        asleep += s.asleep;
    }
    CHECK_EQ(asleep, stack ? BODIES - 1 : 0);
    CHECK_MORE(taken, CHANGES * STATES / 10);
    CHECK_MORE(refused, CHANGES * STATES / 10);
}

static void test_stack(void)
{
    check_world(true);
}

static void test_flight(void)
{
    check_world(false);
}

const struct test tests_world_load[] = {
    {"world_load/stack", test_stack},
    {"world_load/flight", test_flight},
    {0},
};
