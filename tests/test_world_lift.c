/* SPDX-License-Identifier: MIT */
/*
 * A surface that the caller moves lifts bodies, in rare cases: a body with a higher number below one with a lower number, a body that has
 * left the world, more bodies above each other than a move lifts, no room for their pairs.
 */
#include <string.h>

#include "lib/one_world.h"
#include "lib/shapes.h"
#include "world/world.h"

#ifdef TEST_LONG
#define PILE (WORLD_LIFT_ROUNDS + 1)
#else
#define PILE 4
#endif
#define CAPS  (PILE + 1), (16 * PILE), 32, 64, 64, 64
#define COUNT 9
#define FACES 8
#define FLOOR 0
#define EDGE  ((int64_t)4096 << 32)
#define UNIT  ((int64_t)1 << 32)
#define THICK 64 /* of a box, quanta of 2^-12 */
#define PITCH 72
/* Heights in q32 from quanta. */
#define HEIGHT(quanta) ((int64_t)(quanta) * (1 << 20))

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static _Alignas(8) uint8_t surface_block[CAROM_SURFACE_BYTES(COUNT, FACES)];
static struct carom_mesh surface;
static struct shape flat, box;
static int16_t at[COUNT][3];

/* Raise the whole surface by so many quanta. */
static int raise_by(int quanta)
{
    for (int v = 0; v < COUNT; v++) {
        at[v][2] = (int16_t)(at[v][2] + quanta);
    }
    return carom_surface_move(world, FLOOR, (const int16_t(*)[3])at);
}

/* A flat surface of 2 x 2 units in a world without gravity. */
static void begin(int64_t x)
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
    struct carom_body_def def = {.mesh = &surface, .stationary = true, .position = {{x, 0, 0}}};

    shape_plane(&flat, 12, 2, 4096);
    shape_box(&box, 12, 4096, 3072, THICK);
    memcpy(at, flat.vertices, sizeof at);
    CHECK_EQ(carom_surface_build(&surface, &flat.raw, surface_block, sizeof surface_block),
             CAROM_OK);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    CHECK_EQ(carom_body_add(world, &def), FLOOR);
}

/* A box at place `level` of a pile, the lowest of which is a gap above the surface. */
static int add(int64_t x, int level, int64_t speed_q40)
{
    struct carom_body_def def = {.mesh = &box.mesh};

    def.position.c[0] = x;
    def.position.c[2] = HEIGHT(THICK / 2 + (PITCH - THICK) + level * PITCH);
    def.velocity.c[0] = speed_q40;
    return carom_body_add(world, &def);
}

static int64_t height(int body)
{
    return state_of(body).position.c[2];
}

/* The upper box has the lower number. Both go up by the same way. */
static void test_below(void)
{
    begin(0);
    CHECK_EQ(add(0, 1, 0), 1);
    CHECK_EQ(add(0, 0, 0), 2);
    CHECK_EQ(raise_by(100), CAROM_OK);
    CHECK_EQ(height(1) - height(2), HEIGHT(PITCH));
    CHECK_MORE(height(2), HEIGHT(100 + THICK / 2));
    CHECK_LESS(height(2), HEIGHT(100 + THICK / 2 + 2)); /* half a skin is below 1 */
    steps(1);
}

/* Boxes 1 and 3 leave the world above the surface; they stay where they left, and lift nothing. */
static void test_out(void)
{
    int64_t before[4];

    begin(EDGE - UNIT / 2);
    CHECK_EQ(add(EDGE - UNIT / 16, 1, (int64_t)1 << 37), 1);
    CHECK_EQ(add(EDGE - UNIT / 2, 3, 0), 2);
    CHECK_EQ(add(EDGE - UNIT / 16, 0, (int64_t)1 << 37), 3);
    steps(1);
    CHECK(state_of(1).out && !state_of(2).out && state_of(3).out);
    for (int i = 1; i <= 3; i++) {
        before[i] = height(i);
    }
    CHECK_EQ(raise_by(100), CAROM_OK);
    CHECK_EQ(height(1), before[1]);
    CHECK_EQ(height(2), before[2]); /* it lies higher than the surface comes */
    CHECK_EQ(height(3), before[3]);
    CHECK_EQ(raise_by(3 * PITCH), CAROM_OK);
    CHECK_EQ(height(1), before[1]);
    CHECK_MORE(height(2), before[2]);
    CHECK_EQ(height(3), before[3]);
}

/* Two boxes lie side by side, and there is room for one pair: nothing moves. A third one lies beside the surface. */
static void test_no_room(void)
{
    int64_t beside;

    begin(0);
    CHECK_EQ(add(-UNIT * 3 / 4, 0, 0), 1);
    CHECK_EQ(add(UNIT * 3 / 4, 0, 0), 2);
    CHECK_EQ(add(8 * UNIT, 0, 0), 3);
    beside = height(3);
    world->pools[CAROM_POOL_pairs].size = 1;
    REFUSE(raise_by(100), CAROM_ERR_PAIRS_FULL);
    CHECK_EQ(surface.raw.vertices[0][2], 0);
    world->pools[CAROM_POOL_pairs].size = 2;
    CHECK_EQ(carom_surface_move(world, FLOOR, (const int16_t(*)[3])at), CAROM_OK);
    CHECK_EQ(height(1), height(2));
    CHECK_MORE(height(1), HEIGHT(100));
    CHECK_EQ(height(3), beside);
}

/* Box 1 lies on a flat part, and touches box 2, under which the surface rises: both go up by the same way, though 1 is not in its way. */
static void test_touching(void)
{
    int64_t before;

    begin(0);
    for (int i = 0; i < 2; i++) {
        CHECK_EQ(add((2 * i - 1) * (UNIT / 2 + (UNIT >> 14)), 0, 0), i + 1);
    }
    steps(1);
    CHECK_EQ(events_of(CAROM_EVENT_BEGIN, 2, 1), 1);
    before = height(1);
    CHECK_EQ(height(2), before);
    for (int v = 0; v < COUNT; v++) {
        at[v][2] = (int16_t)(at[v][0] > 0 ? 200 : 0);
    }
    CHECK_EQ(carom_surface_move(world, FLOOR, (const int16_t(*)[3])at), CAROM_OK);
    CHECK_MORE(height(2), before);
    CHECK_EQ(height(1), height(2));
}

#ifdef TEST_LONG
/* Each box of a pile lifts the next one. A move lifts 64 in a row, and is refused where there is one more. */
static void test_pile(void)
{
    const int rise = PILE * (PITCH - THICK) + PITCH;

    begin(0);
    for (int i = 0; i < PILE; i++) {
        CHECK_EQ(add(0, i, 0), i + 1);
    }
    REFUSE(raise_by(rise), CAROM_ERR_BLOCKED);
    CHECK_EQ(surface.raw.vertices[0][2], 0);
    CHECK_EQ(carom_body_remove(world, PILE), CAROM_OK);
    CHECK_EQ(carom_surface_move(world, FLOOR, (const int16_t(*)[3])at), CAROM_OK);
    for (int i = 1; i < PILE; i++) {
        CHECK_EQ(height(i) - height(1), HEIGHT((i - 1) * PITCH));
    }
    CHECK_MORE(height(1), HEIGHT(rise));
}
#endif

const struct test tests_world_lift[] = {
    {"world_lift/below", test_below},
    {"world_lift/out", test_out},
    {"world_lift/no_room", test_no_room},
    {"world_lift/touching", test_touching},
#ifdef TEST_LONG
    {"world_lift/pile", test_pile},
#endif
    {0},
};
