/* SPDX-License-Identifier: MIT */
/*
 * A box falls on the ground, bounces and comes to rest; a second later it falls again. Open the
 * serial plotter: it draws the height of the box in millimetres, and its speed in millimetres a
 * second.
 */
#include <carom.h>

/* 256 quanta a metre: sides of 500, 400 and 300 mm. Corners run counter-clockwise seen from outside. */
static const int16_t corners[8][3] = {{-64, -51, -38}, {64, -51, -38}, {64, 51, -38}, {-64, 51, -38},
                                      {-64, -51, 38},  {64, -51, 38},  {64, 51, 38},  {-64, 51, 38}};
static const uint16_t sides[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                      {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
static const int16_t far_corners[3][3] = {{-9999, -9999, 0}, {9999, -9999, 0}, {0, 9999, 0}};
static const uint16_t far_sides[1][3] = {{0, 1, 2}};
static const carom_mesh_raw box = {corners, sides, 8, 12, 8, CAROM_SOLID};
static const carom_mesh_raw flat = {far_corners, far_sides, 3, 1, 8, CAROM_SURFACE};

#define CAPS 2, 1, 8, 8, 0, 32 /* bodies, pairs, contacts, faces, entries, candidates */
#define FPS  60
alignas(8) static uint8_t block[CAROM_WORLD_BYTES(CAPS)];
alignas(8) static uint8_t box_block[CAROM_MESH_BYTES(8, 12)], flat_block[CAROM_MESH_BYTES(3, 1)];
static carom_mesh meshes[2];
static carom_world *world;

/* A result below zero is an error: print it, and stop. */
static int sure(int result)
{
    if (result < 0) {
        Serial.println(carom_result_text(result));
        while (true) {
            delay(1000);
        }
    }
    return result;
}

/* A world with the box three metres up, tilted and turning. */
static void begin_again()
{
    carom_config config = {};
    carom_body_def ground = {}, body = {};

    config.caps = CAROM_CAPS(CAPS);
    config.gravity.c[2] = CAROM_GRAVITY_MM_S2(-9810, FPS);
    config.sleep = true;
    sure(carom_world_init(block, sizeof block, &config, &world));
    ground.mesh = &meshes[0];
    ground.stationary = true;
    sure(carom_body_add(world, &ground));
    body.mesh = &meshes[1];
    body.position.c[2] = CAROM_POSITION_M(3);
    body.spin.c[0] = CAROM_SPIN_DEG_S(70, FPS);
    body.spin.c[1] = CAROM_SPIN_DEG_S(40, FPS);
    body.restitution_q30 = CAROM_ONE_Q30 / 2;
    body.friction_q16 = 1 << 15;
    sure(carom_body_add(world, &body));
}

void setup()
{
    Serial.begin(115200);
    sure(carom_mesh_build(&meshes[0], &flat, flat_block, sizeof flat_block));
    sure(carom_mesh_build(&meshes[1], &box, box_block, sizeof box_block));
    begin_again();
}

void loop()
{
    carom_body_state state;

    sure(carom_world_step(world));
    sure(carom_body_get(world, 1, &state));
    Serial.print("height:");
    Serial.print((long)CAROM_TO_MM(state.position.c[2]));
    Serial.print(" speed:");
    Serial.println((long)CAROM_TO_MM_S(state.velocity.c[2], FPS));
    if (state.asleep) {
        delay(1000);
        begin_again();
    }
    delay(1000 / FPS);
}
