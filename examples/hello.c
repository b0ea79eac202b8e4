/* SPDX-License-Identifier: MIT */
/* A tetrahedron falls on a triangle and comes to rest: a first program. */
#include <stdio.h>
#include "carom.h"

/* A tetrahedron and a triangle to fall on, counter-clockwise from outside; 256 quanta a metre. */
static const int16_t corners[][3] = {{99, 99, 99}, {99, -99, -99}, {-99, 99, -99}, {-99, -99, 99}};
static const uint16_t sides[][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
static const int16_t far_corners[][3] = {{-9999, -9999, 0}, {9999, -9999, 0}, {0, 9999, 0}};
static const struct carom_mesh_raw solid = {corners, sides, 4, 4, 8, CAROM_SOLID};
static const struct carom_mesh_raw flat = {far_corners, sides, 3, 1, 8, CAROM_SURFACE};

#define CAPS 2, 1, 16, 16, 32, 64 /* bodies, pairs, contacts, faces, entries, candidates */
static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)], mesh_block[2][CAROM_MESH_BYTES(4, 4)];

int main(void)
{
    struct carom_config config = {
        CAROM_CAPS(CAPS), {{0, 0, CAROM_GRAVITY_MM_S2(-9810, 60)}}, .sleep = true};
    struct carom_mesh meshes[2];
    struct carom_body_def ground = {&meshes[0], .stationary = true, .friction_q16 = 1 << 15};
    struct carom_body_def body = {&meshes[1], .position = {{0, 0, CAROM_POSITION_MM(2000)}},
                                  .spin = {{CAROM_SPIN_MRAD_S(900, 60)}}, .friction_q16 = 1 << 15};
    struct carom_body_state state = {.asleep = false};
    struct carom_world *world;

    if (carom_mesh_build(&meshes[0], &flat, mesh_block[0], sizeof mesh_block[0]) < 0 ||
        carom_mesh_build(&meshes[1], &solid, mesh_block[1], sizeof mesh_block[1]) < 0 ||
        carom_world_init(block, sizeof block, &config, &world) < 0 ||
        carom_body_add(world, &ground) < 0 || carom_body_add(world, &body) < 0) {
        return 1;
    }
    for (int frame = 1; !state.asleep && carom_world_step(world) >= 0; frame++) {
        carom_body_get(world, 1, &state);
        if (frame % 10 == 0) {
            printf("frame %2d: %4d mm up\n", frame, (int)(state.position.c[2] * 1000 >> 32));
        }
    }
    return 0;
}
