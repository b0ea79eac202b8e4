/* SPDX-License-Identifier: MIT */
/*
 * A world of a few kilobytes: a box and a tetrahedron fall on a plane of two faces, collide and
 * come to rest. A second world has room to spare and must do the same.
 */
#include <string.h>

#include "lib/box.h"
#include "lib/crossing.h"
#include "lib/real.h"
#include "lib/test.h"

/* bodies, pairs, contacts, faces, entries, candidates */
#define CAPS   3, 3, 4, 5, 0, 6
#define AMPLE  3, 3, 64, 64, 0, 256
#define FRAMES 300

_Static_assert(sizeof(void *) > 4 || CAROM_WORLD_BYTES(CAPS) <= 6472, "a small world");

/* 1/4096 of a unit: a box of 1 x 0.6 x 0.3, a tetrahedron, a plane. */
enum { X = 2048, Y = 1229, Z = 614, T = 1500, P = 20000 };
static const int16_t corners[3][8][3] = {
    {{-P, -P, 0}, {P, -P, 0}, {P, P, 0}, {-P, P, 0}},
    BOX_CORNERS(X, Y, Z),
    {{T, T, T}, {T, -T, -T}, {-T, T, -T}, {-T, -T, T}},
};
static const uint16_t plane_faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
static const uint16_t tetrahedron_faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
static const struct carom_mesh_raw raws[3] = {
    {corners[0], plane_faces, 4, 2, 12, CAROM_SURFACE},
    {corners[1], box_faces, 8, 12, 12, CAROM_SOLID},
    {corners[2], tetrahedron_faces, 4, 4, 12, CAROM_SOLID},
};

static _Alignas(8) uint8_t mesh_blocks[3][CAROM_MESH_BYTES(8, 12)];
static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)], ample_block[CAROM_WORLD_BYTES(AMPLE)];
static struct carom_mesh meshes[3];

static struct carom_world *make(void *mem, size_t bytes, const struct carom_caps *caps)
{
    const struct carom_config config = {
        .caps = *caps, .gravity = {{0, 0, CAROM_GRAVITY_MM_S2(-9810, 60)}}, .sleep = true};
    struct carom_body_def defs[3] = {
        {.mesh = &meshes[0], .stationary = true},
        {.mesh = &meshes[1],
         .position = {{CAROM_POSITION_MM(2994), CAROM_POSITION_MM(-1906), CAROM_POSITION_MM(309)}},
         .spin = {{0, CAROM_SPIN_MRAD_S(200, 60), CAROM_SPIN_MRAD_S(-700, 60)}}},
        {.mesh = &meshes[2],
         .position = {{CAROM_POSITION_MM(3689), CAROM_POSITION_MM(-2131), CAROM_POSITION_MM(1557)}},
         .spin = {{CAROM_SPIN_MRAD_S(-400, 60), 0, 0}}},
    };
    struct carom_world *world = NULL;

    CHECK_EQ(carom_world_init(mem, bytes, &config, &world), CAROM_OK);
    for (int i = 0; i < 3; i++) {
        defs[i].restitution_q30 = CAROM_ONE_Q30 / 2;
        defs[i].friction_q16 = 1 << 16;
        CHECK_EQ(carom_mesh_build(&meshes[i], &raws[i], mesh_blocks[i], sizeof mesh_blocks[i]),
                 CAROM_OK);
        CHECK_EQ(carom_body_add(world, &defs[i]), i);
    }
    return world;
}

static struct carom_body_state state_of(const struct carom_world *world, int body)
{
    struct carom_body_state state;

    memset(&state, 0, sizeof state);
    CHECK_EQ(carom_body_get(world, body, &state), CAROM_OK);
    return state;
}

/* The number of face pairs of two bodies that have a common point. */
static uint32_t crossing(const struct carom_world *world, int a, int b)
{
    static int32_t points[2][8][3];
    static struct crossing_face near[2][12];
    static uint8_t bits[CROSSING_BITS(12, 12)];
    const int both[2] = {a, b};
    struct crossing_body bodies[2];
    struct crossing_tally tally = {.poses = 0};
    carom_v3_q32 origin = state_of(world, a).position;

    for (int i = 0; i < 2; i++) {
        struct carom_body_state state = state_of(world, both[i]);

        bodies[i] = (struct crossing_body){&meshes[both[i]], points[i], near[i]};
        crossing_place(&bodies[i], &state.position, &state.rotation, &origin);
    }
    crossing_compare(&bodies[0], &bodies[1], NULL, 0, bits, &tally);
    return tally.crossing;
}

/* Hits between the two bodies in the last step. */
static int hits(const struct carom_world *world)
{
    const struct carom_event *events;
    int count = carom_events(world, &events), found = 0;

    for (int i = 0; i < count; i++) {
        found += events[i].kind == CAROM_EVENT_HIT && events[i].b != 0;
    }
    return found;
}

static bool asleep(const struct carom_world *world)
{
    return state_of(world, 1).asleep && state_of(world, 2).asleep;
}

/*
 * The centres are as high as that of a box on its largest side, and as the sphere in a tetrahedron.
 */
static void check_heights(const struct carom_world *world)
{
    const double lie[3] = {0, Z / 4096.0, T / 4096.0 / real_sqrt(3)};

    for (int i = 1; i < 3; i++) {
        double gap = real(state_of(world, i).position.c[2], 32) - lie[i];

        /* a skin, 1/2048 of the radius, plus what a body may lean */
        CHECK_MORE(gap, 0);
        CHECK_LESS(gap, 2 * real(meshes[i].radius_q22, 22) / 2048);
    }
}

static void comes_to_rest(void)
{
    const struct carom_caps caps = CAROM_CAPS(CAPS), ample_caps = CAROM_CAPS(AMPLE);
    struct carom_world *world = make(block, sizeof block, &caps);
    struct carom_world *ample = make(ample_block, sizeof ample_block, &ample_caps);
    struct carom_usage usage[CAROM_POOL_COUNT];
    int frames = 0, met = 0;

    while (frames < FRAMES && !asleep(world)) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK_EQ(carom_world_step(ample), CAROM_OK);
        CHECK_EQ(carom_world_hash(world), carom_world_hash(ample));
        CHECK_EQ(crossing(world, 1, 0) + crossing(world, 2, 0) + crossing(world, 2, 1), 0);
        met += hits(world);
        frames++;
    }
    CHECK(asleep(world));
    CHECK_MORE(met, 0);
    check_heights(world);
    CHECK_EQ(carom_usage(world, usage), CAROM_OK);
    for (int i = 0; i < CAROM_POOL_COUNT; i++) {
        CHECK_EQ(usage[i].refused, 0);
    }
}

const struct test tests_world_small[] = {
    {"world_small/comes_to_rest", comes_to_rest},
    {0},
};
