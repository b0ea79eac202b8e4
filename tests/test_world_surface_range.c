/* SPDX-License-Identifier: MIT */
/*
 * Surfaces that move at the ends of their ranges: a face so steep that its normal has no height, a box that grows too large. The move
 * is refused, and the surface and the world are as they were.
 */
#include "carom_body.h"
#include "lib/one_world.h"

#define CAPS 2, 2, 8, 16, 64, 16

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static _Alignas(8) uint8_t surface_block[CAROM_SURFACE_BYTES(3, 1)];

/* One face, of 2^-8 units a quantum. */
static void make(struct carom_mesh *mesh, const int16_t (*corner)[3])
{
    static const uint16_t face[1][3] = {{0, 1, 2}};
    const struct carom_mesh_raw raw = {corner, face, 3, 1, 8, CAROM_SURFACE};
    const struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
    const struct carom_body_def def = {.mesh = mesh, .stationary = true};

    CHECK_EQ(carom_surface_build(mesh, &raw, surface_block, sizeof surface_block), CAROM_OK);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    CHECK_EQ(carom_body_add(world, &def), 0);
}

/*
 * The face is 256 units high and rises 2^32 times as much as it goes aside. Moved aside by a quantum it may lift what lies on it by all
 * of its height, and 60 units are allowed; moved up it lifts by no more than that.
 */
static void test_steep(void)
{
    static const int16_t corner[3][3] = {
        {0, -32768, -32768}, {1, 32767, -32768}, {0, -32767, 32767}};
    int16_t moved[3][3];
    struct carom_mesh mesh;

    make(&mesh, corner);
    memcpy(moved, corner, sizeof moved);
    for (int v = 0; v < 3; v++) {
        moved[v][0]++;
    }
    REFUSE(carom_surface_move(world, 0, (const int16_t(*)[3])moved), CAROM_ERR_RANGE);
    CHECK_EQ(memcmp(mesh.raw.vertices, corner, sizeof corner), 0);
    memcpy(moved, corner, sizeof moved);
    moved[0][2] += 256;
    moved[1][2] += 256;
    CHECK_EQ(carom_surface_move(world, 0, (const int16_t(*)[3])moved), CAROM_OK);
    steps(1);
}

/* A box of 256 x 256 units may be 128 high, which is 384 from corner to corner, and no higher. */
static void test_box(void)
{
    int16_t corner[3][3] = {{-32768, -32768, 0}, {32767, -32768, 0}, {-32768, 32767, 0}};
    struct carom_mesh mesh;

    make(&mesh, (const int16_t(*)[3])corner);
    for (int high = 32760; high <= 32767; high += 7) {
        int16_t raised[3][3];

        memcpy(raised, corner, sizeof raised);
        raised[1][2] = (int16_t)high;
        CHECK_EQ(carom_surface_set(world, 0, (const int16_t(*)[3])raised), CAROM_OK); /* 128 high */
        raised[2][2] = -100;
        REFUSE(carom_surface_set(world, 0, (const int16_t(*)[3])raised), CAROM_ERR_RANGE);
        CHECK_EQ(mesh.raw.vertices[1][2], high);
        CHECK_EQ(mesh.raw.vertices[2][2], 0);
    }
    steps(1);
}

const struct test tests_world_surface_range[] = {
    {"world_surface_range/steep", test_steep},
    {"world_surface_range/box", test_box},
    {0},
};
