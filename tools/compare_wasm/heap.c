/* SPDX-License-Identifier: MIT */
/* Carom's heap of boxes for WebAssembly, as tools/heaps_carom.cpp makes it. */
#include "carom.h"

#define EXPORT(name) __attribute__((export_name(#name))) name

enum { BOXES = 128, H = 2048, G = 32 * 256 };
#define CAPS BOXES + 1, 16 * BOXES, 24 * BOXES, 65535, 1, 65535

static const int16_t box_vertices[8][3] = {{-H, -H, -H}, {H, -H, -H}, {H, H, -H}, {-H, H, -H},
                                           {-H, -H, H},  {H, -H, H},  {H, H, H},  {-H, H, H}};
static const uint16_t box_faces[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7},
                                          {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                                          {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
static const int16_t plane_vertices[4][3] = {{-G, -G, 0}, {G, -G, 0}, {G, G, 0}, {-G, G, 0}};
static const uint16_t plane_faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
static const struct carom_mesh_raw box_raw = {box_vertices, box_faces, 8, 12, 12, CAROM_SOLID},
                                   plane_raw = {plane_vertices, plane_faces, 4, 2, 8,
                                                CAROM_SURFACE};

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)], box_block[CAROM_MESH_BYTES(8, 12)],
    plane_block[CAROM_MESH_BYTES(4, 2)];
static struct carom_mesh box, plane;
static struct carom_world *world;

/* An empty world over the plane; an error is below zero. */
int EXPORT(begin)(void)
{
    const struct carom_config config = {{CAPS}, {{0, 0, CAROM_GRAVITY_MM_S2(-9810, 60)}}};
    const struct carom_body_def ground = {.mesh = &plane, .stationary = true, .friction_q16 = 32768};
    int result = carom_mesh_build(&plane, &plane_raw, plane_block, sizeof plane_block);

    result = result < 0 ? result : carom_mesh_build(&box, &box_raw, box_block, sizeof box_block);
    result = result < 0 ? result : carom_world_init(block, sizeof block, &config, &world);
    return result < 0 ? result : carom_body_add(world, &ground);
}

int EXPORT(add)(double x, double y, double z, double qw, double qx, double qy, double qz)
{
    const double position[3] = {x, y, z}, quaternion[4] = {qw, qx, qy, qz};
    struct carom_body_def def = {.mesh = &box, .friction_q16 = 32768};

    for (int k = 0; k < 3; k++) {
        def.position.c[k] = (int64_t)__builtin_rint(position[k] * 4294967296.0);
    }
    for (int k = 0; k < 4; k++) {
        def.rotation.c[k] = (int32_t)__builtin_rint(quaternion[k] * 1073741824.0);
    }
    return carom_body_add(world, &def);
}

int EXPORT(step)(void)
{
    return carom_world_step(world);
}

double EXPORT(height)(int number)
{
    struct carom_body_state state = {.asleep = false};

    carom_body_get(world, number + 1, &state);
    return (double)state.position.c[2] / 4294967296.0;
}
