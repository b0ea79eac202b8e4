/* SPDX-License-Identifier: MIT */
/*
 * hello.cpp in C, with all the checks of carom.hpp: a mesh that was not built counts as none, the
 * body has the number that the world returned, and a state that could not be read is zero. The cost
 * of hello.cpp is compared with the cost of this program.
 */
#include <stdio.h>
#include "carom.h"

static const int16_t corners[][3] = {{99, 99, 99}, {99, -99, -99}, {-99, 99, -99}, {-99, -99, 99}};
static const uint16_t sides[][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
static const int16_t far_corners[][3] = {{-9999, -9999, 0}, {9999, -9999, 0}, {0, 9999, 0}};
static const uint16_t side[][3] = {{0, 1, 2}};

#define CAPS 2, 1, 16, 16, 32, 64 /* bodies, pairs, contacts, faces, entries, candidates */
static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static struct carom_world *world;

struct built {
    int result;
    struct carom_mesh mesh;
};

static const struct carom_mesh *mesh_of(const struct built *built)
{
    return built->result < 0 ? NULL : &built->mesh;
}

int main(void)
{
    const struct carom_mesh_raw flat = {far_corners, side, 3, 1, 8, CAROM_SURFACE};
    const struct carom_mesh_raw solid = {corners, sides, 4, 4, 8, CAROM_SOLID};
    _Alignas(8) uint8_t ground_block[CAROM_MESH_BYTES(3, 1)], solid_block[CAROM_MESH_BYTES(4, 4)];
    struct built grounds, solids;
    int number;

    grounds.result = carom_mesh_build(&grounds.mesh, &flat, ground_block, sizeof ground_block);
    solids.result = carom_mesh_build(&solids.mesh, &solid, solid_block, sizeof solid_block);
    if (grounds.result < 0 || solids.result < 0) {
        return 1;
    }
    {
        struct carom_config config = {
            CAROM_CAPS(CAPS), {{0, 0, CAROM_GRAVITY_MM_S2(-9810, 60)}}, .sleep = true};

        if (carom_world_init(block, sizeof block, &config, &world) < 0) {
            return 1;
        }
    }
    {
        struct carom_body_def def = {mesh_of(&grounds), .stationary = true,
                                     .friction_q16 = 1 << 15};

        if (carom_body_add(world, &def) < 0) {
            return 1;
        }
    }
    {
        struct carom_body_def def = {
            mesh_of(&solids), .position = {{0, 0, CAROM_POSITION_MM(2000)}},
            .spin = {{CAROM_SPIN_MRAD_S(900, 60)}}, .friction_q16 = 1 << 15};

        number = carom_body_add(world, &def);
    }
    if (number < 0) {
        return 1;
    }
    for (int frame = 1; carom_world_step(world) >= 0; frame++) {
        struct carom_body_state state;

        if (carom_body_get(world, number, &state) < 0) {
            state = (struct carom_body_state){.asleep = false};
        }
        if (frame % 10 == 0) {
            printf("frame %2d: %4d mm up\n", frame, (int)(state.position.c[2] * 1000 >> 32));
        }
        if (state.asleep) {
            break;
        }
    }
    return 0;
}
