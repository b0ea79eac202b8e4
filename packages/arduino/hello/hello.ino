/* SPDX-License-Identifier: MIT */
/* examples/hello.c as a sketch: the same world, and the same lines on Serial. */
#include <carom.h>

static const int16_t corners[][3] = {{99, 99, 99}, {99, -99, -99}, {-99, 99, -99}, {-99, -99, 99}};
static const uint16_t sides[][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
static const int16_t far_corners[][3] = {{-9999, -9999, 0}, {9999, -9999, 0}, {0, 9999, 0}};
static const carom_mesh_raw solid = {corners, sides, 4, 4, 8, CAROM_SOLID};
static const carom_mesh_raw flat = {far_corners, sides, 3, 1, 8, CAROM_SURFACE};

#define CAPS 2, 1, 16, 16, 32, 64
alignas(8) static uint8_t block[CAROM_WORLD_BYTES(CAPS)], mesh_block[2][CAROM_MESH_BYTES(4, 4)];
static carom_mesh meshes[2];
static carom_world *world;
static carom_body_state state;
static int frame;

void setup()
{
    carom_config config = {};
    carom_body_def ground = {}, body = {};

    Serial.begin(115200);
    config.caps = CAROM_CAPS(CAPS);
    config.gravity.c[2] = CAROM_GRAVITY_MM_S2(-9810, 60);
    config.sleep = true;
    ground.mesh = &meshes[0];
    ground.stationary = true;
    ground.friction_q16 = 1 << 15;
    body.mesh = &meshes[1];
    body.position.c[2] = CAROM_POSITION_MM(2000);
    body.spin.c[0] = CAROM_SPIN_MRAD_S(900, 60);
    body.friction_q16 = 1 << 15;
    if (carom_version() != CAROM_VERSION ||
        carom_mesh_build(&meshes[0], &flat, mesh_block[0], sizeof mesh_block[0]) < 0 ||
        carom_mesh_build(&meshes[1], &solid, mesh_block[1], sizeof mesh_block[1]) < 0 ||
        carom_world_init(block, sizeof block, &config, &world) < 0 ||
        carom_body_add(world, &ground) < 0 || carom_body_add(world, &body) < 0) {
        Serial.println("error");
    }
}

void loop()
{
    char line[40];

    if (state.asleep || carom_world_step(world) < 0) {
        return;
    }
    carom_body_get(world, 1, &state);
    if (++frame % 10 == 0) {
        snprintf(line, sizeof line, "frame %2d: %4d mm up", frame, (int)(state.position.c[2] * 1000 >> 32));
        Serial.println(line);
    }
}
