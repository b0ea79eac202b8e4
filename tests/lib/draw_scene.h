/* SPDX-License-Identifier: MIT */
/*
 * draw_scene.h - the base of the tests of drawing: small meshes, a world, a picture of SIZE x SIZE.
 *
 * Most scenes look straight down from 4 units above the origin at a focal length of one picture
 * height, 64 pixels: at z = 0 a unit is 16 pixels, x to the right and y up the page.
 */
#ifndef CAROM_TESTS_DRAW_SCENE_H
#define CAROM_TESTS_DRAW_SCENE_H

#include "box.h"
#include "carom_draw.h"
#include "draw/draw.h"
#include "test.h"

#define SIZE      64
#define CAPS      6, 8, 64, 256, 256, 512
#define Q32(n, d) CAROM_RATIO(n, d, 32)

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static _Alignas(8) uint8_t workspace[CAROM_DRAW_BYTES(48, 72) + 12288]; /* with shadows */
static uint8_t pixels[SIZE][SIZE];

static const struct carom_camera above = {
    .eye = {{0, 0, Q32(4, 1)}}, .target = {{0, 0, 0}}, .focal_q16 = 1 << 16};
static const enum carom_draw_style styles[] = {CAROM_DRAW_FLAT, CAROM_DRAW_WIRE};
/* (1, 2, 2, 4) / 5 */
static const carom_quat_q30 oblique = {{214748365, 429496730, 429496730, 858993459}};
static const carom_quat_q30 upright = {{CAROM_ONE_Q30, 0, 0, 0}};

/* ------------------------------------------------------------------- meshes */

/* A square of +-1 unit in z = 0 that looks up, and its lower left half. */
static const int16_t square_vertices[][3] = {
    {-4096, -4096, 0}, {4096, -4096, 0}, {4096, 4096, 0}, {-4096, 4096, 0}};
static const uint16_t square_faces[][3] = {{0, 1, 2}, {0, 2, 3}};
static const uint16_t half_faces[][3] = {{0, 1, 3}};
static const int16_t half_vertices[][3] = {
    {-4096, -4096, 0}, {4096, -4096, 0}, {0, 0, 0}, {-4096, 4096, 0}};

/* A cube of +-1/2 unit. */
static const int16_t cube_vertices[8][3] = BOX_CORNERS(2048, 2048, 2048);

static struct carom_mesh square, half, cube, plain;

static void build(struct carom_mesh *mesh, struct carom_mesh_raw raw, void *mem, size_t bytes)
{
    CHECK_EQ(carom_mesh_build(mesh, &raw, mem, bytes), CAROM_OK);
}

#define MESH_MEMORY(name, v, f) static _Alignas(8) uint8_t name[CAROM_MESH_BYTES(v, f)]

static void build_meshes(void)
{
    MESH_MEMORY(square_mem, 4, 2);
    MESH_MEMORY(plain_mem, 4, 2);
    MESH_MEMORY(half_mem, 4, 1);
    MESH_MEMORY(cube_mem, 8, 12);
    struct carom_mesh_raw raw = {square_vertices, square_faces, 4, 2, 12, CAROM_SURFACE};

    build(&square, raw, square_mem, sizeof square_mem);
    raw.quantum_bits = 7; /* the same square, +-32 units wide */
    build(&plain, raw, plain_mem, sizeof plain_mem);
    raw = (struct carom_mesh_raw){half_vertices, half_faces, 4, 1, 12, CAROM_SURFACE};
    build(&half, raw, half_mem, sizeof half_mem);
    raw = (struct carom_mesh_raw){cube_vertices, box_faces, 8, 12, 12, CAROM_SOLID};
    build(&cube, raw, cube_mem, sizeof cube_mem);
}

/* ------------------------------------------------------------------- scenes */

static inline struct carom_world *new_world(void)
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
    struct carom_world *world = NULL;

    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    build_meshes();
    return world;
}

static void add(struct carom_world *world, const struct carom_mesh *mesh, carom_v3_q32 position,
                carom_quat_q30 rotation, bool moving)
{
    struct carom_body_def def = {.mesh = mesh,
                                 .stationary = !moving,
                                 .position = position,
                                 .rotation = rotation,
                                 .restitution_q30 = CAROM_ONE_Q30 / 2,
                                 .overlap = CAROM_OVERLAP_PASS};

    CHECK_AT_LEAST(carom_body_add(world, &def), 0);
}

static inline carom_v3_q32 at(int64_t x, int64_t y, int64_t z)
{
    carom_v3_q32 p = {{x, y, z}};

    return p;
}

/* A picture of 8-bit pixels, whose rows have no gaps. */
static inline struct carom_picture picture_of_size(void *to, int32_t width, int32_t height,
                                                   void *space, size_t bytes)
{
    struct carom_picture picture = {.pixels = to,
                                    .width = width,
                                    .height = height,
                                    .stride = width,
                                    .format = CAROM_PALETTE8,
                                    .workspace = space,
                                    .workspace_bytes = bytes};

    return picture;
}

static inline struct carom_picture picture_8(void)
{
    return picture_of_size(pixels, SIZE, SIZE, workspace, sizeof workspace);
}

static inline void draw_8(const struct carom_world *world, const struct carom_camera *camera,
                          enum carom_draw_style style)
{
    struct carom_picture picture = picture_8();

    memset(pixels, 0xee, sizeof pixels);
    CHECK_EQ(carom_draw(world, camera, &picture, style), CAROM_OK);
}

static inline int ramp_at(int x, int y)
{
    return pixels[y][x] / DRAW_SHADES;
}

static inline int count_ramp(int ramp)
{
    int n = 0;

    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            n += ramp_at(x, y) == ramp;
        }
    }
    return n;
}

/* A turned cube over a plain. */
static inline void add_scene(struct carom_world *world)
{
    add(world, &plain, at(0, 0, Q32(-1, 1)), upright, false);
    add(world, &cube, at(0, 0, 0), oblique, true);
}

#endif
