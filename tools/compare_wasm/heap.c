/* SPDX-License-Identifier: MIT */
/* Carom's heap of boxes for WebAssembly, made as in tools/heaps_carom.cpp. */
#include "../heaps_box.h"

#define EXPORT(name) __attribute__((export_name(#name))) name

enum { BOXES = 128 };
#define CAPS BOXES + 1, 16 * BOXES, 24 * BOXES, 65535, 1, 65535

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)], box_block[CAROM_MESH_BYTES(8, 12)],
    plane_block[CAROM_MESH_BYTES(4, 2)];
static struct carom_mesh box, plane;
static struct carom_world *world;

/* Make an empty world over the plane; an error is negative. */
int EXPORT(begin)(void)
{
    const struct carom_config config = {
        CAROM_CAPS(CAPS), {{0, 0, CAROM_GRAVITY_MM_S2(-9810, 60)}}, .sleep = false};
    const struct carom_body_def ground = {
        .mesh = &plane, .stationary = true, .friction_q16 = 32768};
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
