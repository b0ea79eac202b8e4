/* SPDX-License-Identifier: MIT */
/*
 * Bodies that meet a surface from below. A mirror is the oracle: a surface that is turned upside down
 * and seen from below is the surface seen from above. A box that is its own mirror image must do on
 * one the mirror image of what it does on the other. (That no face crosses is for the random worlds.)
 */
#include <string.h>

#include "lib/one_world.h"
#include "lib/shapes.h"

#define CAPS   2, 2, 256, 512, 512, 512
#define FRAMES 90
#define CELLS  4 /* squares along a side of the surface */
#define HALF   4 /* half side of the surface, units */
#define COUNT  ((CELLS + 1) * (CELLS + 1))
#define FACES  (2 * CELLS * CELLS)
#define FLOOR  0
#define BOX    1

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static struct shape floor_shape, box;
static struct carom_body_state seen[FRAMES], above[FRAMES];
static _Alignas(8) uint8_t one_sided_block[CAROM_SURFACE_BYTES(COUNT, FACES)];

/* How a box begins, and how it is shaped. */
struct launch {
    carom_quat_q30 rotation;
    int64_t place_q32[3], velocity_q40[3], spin_q40[3];
    int side[3];
    int64_t gravity_q40;
    int32_t e_q30;
};

/* Replace the surface by its mirror image in z = 0. */
static void turn_over(struct shape *s)
{
    for (uint32_t v = 0; v < s->raw.vertex_count; v++) {
        s->vertices[v][2] = (int16_t)-s->vertices[v][2];
    }
    CHECK_EQ(carom_mesh_build(&s->mesh, &s->raw, s->block, sizeof s->block), CAROM_OK);
}

/*
 * Throw a box, from above or in the mirror from below. Sets `seen`; returns the frame of the first
 * hit, or FRAMES.
 */
static int run(const struct launch *t, const struct carom_mesh *floor, bool below)
{
    const int sign = below ? -1 : 1;
    struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
    struct carom_body_def def;
    int first = FRAMES;

    memset(&def, 0, sizeof def);
    config.gravity.c[2] = -sign * t->gravity_q40;
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    def.mesh = floor;
    def.stationary = true;
    def.restitution_q30 = t->e_q30;
    def.friction_q16 = 1 << 15;
    CHECK_EQ(carom_body_add(world, &def), FLOOR);
    def.mesh = &box.mesh;
    def.stationary = false;
    def.mass_q20 = 1 << 20;
    /* a mirror keeps the part of a turn about its own axis, and reverses the others */
    def.rotation = t->rotation;
    for (int k = 0; k < 3; k++) {
        def.position.c[k] = (k == 2 ? sign : 1) * t->place_q32[k];
        def.velocity.c[k] = (k == 2 ? sign : 1) * t->velocity_q40[k];
        def.spin.c[k] = (k == 2 ? 1 : sign) * t->spin_q40[k];
        def.rotation.c[k + 1] *= k == 2 ? 1 : sign;
    }
    CHECK_EQ(carom_body_add(world, &def), BOX);
    for (int frame = 0; frame < FRAMES; frame++) {
        steps(1);
        seen[frame] = state_of(BOX);
        first = first == FRAMES && events_of(CAROM_EVENT_HIT, BOX, FLOOR) > 0 ? frame : first;
    }
    return first;
}

/* Check that a state is the mirror image of another one. */
static void check_mirrored(const struct carom_body_state *a, const struct carom_body_state *b)
{
    for (int k = 0; k < 3; k++) {
        const int through = k == 2 ? -1 : 1;

        CHECK_NEAR(a->position.c[k], through * b->position.c[k], (int64_t)1 << 18);
        CHECK_NEAR(a->velocity.c[k], through * b->velocity.c[k], (int64_t)1 << 24);
        /* a thin box gets a large spin out of a small difference */
        CHECK_NEAR(a->spin.c[k], -through * b->spin.c[k],
                   ((int64_t)1 << 26) + (carom_abs(a->spin.c[k]) >> 12));
    }
}

/* Begin beside the surface, higher than its hills, and move to a point of it. */
static void any_throw(struct launch *t, struct test_random *r, int rough)
{
    const int64_t frames = test_random_range(r, 4, 40);

    memset(t, 0, sizeof *t);
    t->rotation = shape_random_turn(r);
    t->place_q32[0] = -((int64_t)(HALF + 2) << 32);
    t->place_q32[1] = test_random_range(r, -2, 2) * ((int64_t)1 << 32);
    t->place_q32[2] = ((int64_t)2 << 32) + ((int64_t)rough << 20);
    for (int k = 0; k < 3; k++) {
        int64_t to_q32 =
            k == 2 ? 0 : test_random_range(r, -3 * ((int64_t)1 << 32), 3 * ((int64_t)1 << 32));

        t->velocity_q40[k] = (to_q32 - t->place_q32[k]) * 256 / frames;
        t->spin_q40[k] = test_random_range(r, -((int64_t)1 << 38), (int64_t)1 << 38);
        t->side[k] = (int)test_random_range(r, 40, 6000);
    }
    t->gravity_q40 = test_random_range(r, 0, 2) * CAROM_GRAVITY_MM_S2(4905, 60);
    t->e_q30 = (int32_t)test_random_range(r, 0, CAROM_ONE_Q30);
}

/*
 * Throws at random at a surface with hills of a height in quanta of 2^-12 units. Roundings differ, so
 * the mirror image is compared until the frame after the first hit.
 */
static void check_throws(int rough, uint64_t seed, int throws)
{
    struct test_random r = {seed};
    int hits = 0;

    for (int i = 0; i < throws; i++) {
        struct launch t;
        int first, other;

        any_throw(&t, &r, rough);
        shape_box(&box, 12, t.side[0], t.side[1], t.side[2]);
        shape_field(&floor_shape, 12, CELLS, 2 * HALF * 4096 / CELLS, rough, seed + (uint64_t)i);
        first = run(&t, &floor_shape.mesh, false);
        memcpy(above, seen, sizeof above);
        turn_over(&floor_shape);
        other = run(&t, &floor_shape.mesh, true);
        CHECK_EQ(other, first);
        for (int frame = 0; frame < FRAMES && frame <= first + 1; frame++) {
            check_mirrored(&above[frame], &seen[frame]);
        }
        hits += first < FRAMES;
    }
    CHECK_AT_LEAST(2 * hits, throws);
}

static void test_plane(void)
{
    check_throws(0, 1, 40);
}

static void test_hills(void)
{
    check_throws(1000, 2, 40);
}

static void test_peaks(void)
{
    check_throws(8000, 3, 40);
}

/*
 * A surface whose vertices could move has one side. As long as bodies stay above it, the other side of
 * one that cannot move changes nothing: shallow hills, whose pits are nearly flat.
 */
static void test_above(void)
{
    struct test_random r = {4};
    struct carom_mesh one_sided;

    for (int i = 0; i < 40; i++) {
        const int rough = i % 2 ? 60 : 1000;
        struct launch t;

        any_throw(&t, &r, rough);
        t.gravity_q40 = CAROM_GRAVITY_MM_S2(9810, 60);
        t.place_q32[0] = t.velocity_q40[0] = t.velocity_q40[1] = 0;
        shape_box(&box, 12, t.side[0], t.side[1], t.side[2]);
        shape_field(&floor_shape, 12, CELLS, 2 * HALF * 4096 / CELLS, rough, 100 + (uint64_t)i);
        CHECK_EQ(carom_surface_build(&one_sided, &floor_shape.raw, one_sided_block,
                                     sizeof one_sided_block),
                 CAROM_OK);
        (void)run(&t, &one_sided, false);
        memcpy(above, seen, sizeof above);
        CHECK_LESS(run(&t, &floor_shape.mesh, false), FRAMES);
        CHECK_EQ(memcmp(seen, above, sizeof seen), 0);
    }
}

/* From 2 units above the surface and x units along it, level, at a speed along x: it falls on the surface. */
static struct launch level(int x, int64_t speed_q40)
{
    return (struct launch){.rotation = {{CAROM_ONE_Q30, 0, 0, 0}},
                           .place_q32 = {x * ((int64_t)1 << 32), 0, (int64_t)2 << 32},
                           .velocity_q40 = {speed_q40},
                           .gravity_q40 = CAROM_GRAVITY_MM_S2(9810, 60)};
}

/*
 * The upper side of a plate thinner than half of its skin is within reach of the surface, and so is the
 * lower side of one that hangs below. Neither touches: all contacts have the same normal, and the plate
 * gets away as fast as it is pushed.
 */
static void check_thin(bool below)
{
    const int64_t speed_q40 = CAROM_RATIO(1, 100, 40);
    const int sign = below ? -1 : 1;
    const carom_v3_q40 away = {{0, 0, sign * 3 * speed_q40}};
    const struct launch t = level(-8, CAROM_RATIO(16, 100, 40));
    struct carom_contact contacts[32];
    carom_v3_q32 centre;
    int64_t height_q32;
    int n;

    shape_box(&box, 12, 16000, 16000, 2);
    shape_plane(&floor_shape, 12, CELLS, 2 * HALF * 4096 / CELLS);
    CHECK_LESS(run(&t, &floor_shape.mesh, below), FRAMES);
    n = carom_contacts(world, contacts, 32);
    CHECK_MORE(n, 2);
    for (int i = 0; i < n && i < 32; i++) {
        CHECK_MORE(sign * contacts[i].normal.c[2], 0);
    }
    centre = state_of(BOX).position;
    height_q32 = centre.c[2];
    CHECK_EQ(carom_body_push(world, BOX, &away, &centre), CAROM_OK);
    steps(1);
    CHECK_MORE(sign * (state_of(BOX).position.c[2] - height_q32), 2 * (speed_q40 >> 8));
}

static void test_thin(void)
{
    check_thin(false);
    check_thin(true);
}

/* ------------------------------------------------------------------ at rest below */

/*
 * Under gravity that points up a box comes to rest on the other side of the surface, on contacts whose
 * normals lead down.
 */
static void test_rest(void)
{
    const int64_t one = (int64_t)1 << 32;
    const struct launch t = level(-5, CAROM_RATIO(6, 100, 40));
    struct carom_contact contacts[32];
    int n;

    shape_box(&box, 12, 4096, 4096, 2048);
    shape_plane(&floor_shape, 12, CELLS, 2 * HALF * 4096 / CELLS);
    CHECK_LESS(run(&t, &floor_shape.mesh, true), FRAMES);
    steps(60);
    n = carom_contacts(world, contacts, 32);
    CHECK_MORE(n, 2);
    for (int i = 0; i < n && i < 32; i++) {
        CHECK_EQ(contacts[i].normal.c[2], -CAROM_ONE_Q30);
        CHECK_MORE(contacts[i].impulse_q40, -1);
    }
    CHECK_LESS(state_of(BOX).position.c[2], -one / 4);
    CHECK_NEAR(state_of(BOX).position.c[2], -one / 4, one / 512);
    CHECK_NEAR(state_of(BOX).velocity.c[0], 0, (int64_t)1 << 24);
}

const struct test tests_world_under[] = {
    {"world_under/plane", test_plane},
    {"world_under/hills", test_hills},
    {"world_under/peaks", test_peaks},
    {"world_under/above", test_above},
    {"world_under/thin", test_thin},
    {"world_under/rest", test_rest},
    {0},
};
