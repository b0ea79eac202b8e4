/* SPDX-License-Identifier: MIT */
/* A box drops on a plane, tumbles and comes to rest. A unit is a metre, a frame 1/60 s. */
#include <stdio.h>
#include <stdlib.h>

#include "carom.h"

/* Two meshes, in quanta of 1/256 unit. Faces run counter-clockwise, seen from outside. */
enum { H = 128, FAR = 4096 };
static const int16_t box_vertices[8][3] = {{-H, -H, -H}, {H, -H, -H}, {H, H, -H}, {-H, H, -H},
                                           {-H, -H, H},  {H, -H, H},  {H, H, H},  {-H, H, H}};
static const uint16_t box_faces[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7},
                                          {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                                          {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
static const int16_t plane_vertices[4][3] = {
    {-FAR, -FAR, 0}, {FAR, -FAR, 0}, {FAR, FAR, 0}, {-FAR, FAR, 0}};
static const uint16_t plane_faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
static const struct carom_mesh_raw solid = {box_vertices, box_faces, 8, 12, 8, CAROM_SOLID};
static const struct carom_mesh_raw flat = {plane_vertices, plane_faces, 4, 2, 8, CAROM_SURFACE};

/* All the memory there will ever be. Bodies, pairs, contacts, faces, entries, candidates: */
#define CAPACITIES 2, 1, 16, 16, 32, 64
static _Alignas(8) uint8_t box_block[CAROM_MESH_BYTES(8, 12)];
static _Alignas(8) uint8_t plane_block[CAROM_MESH_BYTES(4, 2)];
static _Alignas(8) uint8_t world_block[CAROM_WORLD_BYTES(CAPACITIES)];

/* A result below zero is an error. */
static int check(int result)
{
    if (result < 0) {
        printf("%s\n", carom_result_text(result));
        exit(1);
    }
    return result;
}

int main(void)
{
    struct carom_config config = {.caps = {CAPACITIES}, .sleep = true};
    struct carom_body_def def = {.restitution_q30 = CAROM_ONE_Q30 / 2, .friction_q16 = 1 << 15};
    struct carom_body_state state = {.asleep = false};
    struct carom_mesh box, plane;
    struct carom_world *world;
    int body;

    check(carom_mesh_build(&box, &solid, box_block, sizeof box_block));
    check(carom_mesh_build(&plane, &flat, plane_block, sizeof plane_block));

    config.gravity.c[2] = CAROM_GRAVITY_MM_S2(-9810, 60);
    check(carom_world_init(world_block, sizeof world_block, &config, &world));

    def.mesh = &plane;
    def.stationary = true;
    check(carom_body_add(world, &def));
    def.mesh = &box;
    def.stationary = false;
    def.position.c[2] = CAROM_POSITION_MM(2000);
    def.spin.c[0] = CAROM_SPIN_MRAD_S(1500, 60);
    body = check(carom_body_add(world, &def));

    for (int frame = 1; frame <= 600 && !state.asleep; frame++) {
        check(carom_world_step(world));
        check(carom_body_get(world, body, &state));
        if (frame % 10 == 0 || state.asleep) {
            printf("frame %3d: height %4d mm%s\n", frame,
                   (int)carom_round(1000 * state.position.c[2], 32),
                   state.asleep ? ", at rest" : "");
        }
    }
    return 0;
}
