/* SPDX-License-Identifier: MIT */
/*
 * Scene bowl: cups and balls fall into a bowl. Hollow bodies touch by their faces, inside and out. A tosses up the bodies
 * that have come to rest.
 */
#include <string.h>

#include "port.h"
#include "scene_games.h"

enum { MESH_BOWL, MESH_CUP, MESH_BALL };

#define FRICTION_Q16 (1u << 14)

/* Their starts: places in mm, spins in mrad/s. */
static const struct {
    int16_t mesh, x_mm, y_mm, z_mm, spin;
} start[BOWL_PIECES] = {
    {MESH_CUP, -500, 100, 1400, 900},   {MESH_CUP, 450, -250, 2200, -1500},
    {MESH_BALL, -450, 100, 3000, 0},    {MESH_CUP, 0, 400, 3900, 2500},
    {MESH_BALL, 400, -200, 4900, 1000}, {MESH_CUP, -100, -150, 6000, -2000},
};

static int fill(const struct scene *scene, struct carom_world *world)
{
    struct carom_body_def bowl = {.stationary = true,
                                  .restitution_q30 = CAROM_ONE_Q30 / 4,
                                  .friction_q16 = FRICTION_Q16},
                          piece = bowl;
    struct scene_parts parts = {scene, world, CAROM_OK};

    scene_part(&parts, MESH_BOWL, &bowl);
    piece.stationary = false;
    for (int i = 0; i < BOWL_PIECES; i++) {
        piece.position = (carom_v3_q32)POSITION(start[i].x_mm, start[i].y_mm, start[i].z_mm);
        piece.spin = (carom_v3_q40)SPIN(start[i].spin, 700, 0);
        scene_part(&parts, start[i].mesh, &piece);
    }
    return parts.result;
}

static uint32_t script(const struct carom_world *world, int frame)
{
    (void)world;
    return frame == BOWL_TOSS ? PORT_PAD_A : 0;
}

static int before(struct carom_world *world, int frame, uint32_t keys)
{
    int result = CAROM_OK;

    (void)frame;
    for (int i = 0; i < BOWL_PIECES && keys & PORT_PAD_A && result >= 0; i++) {
        struct carom_body_state state;

        result = carom_body_get(world, BOWL_PIECE + i, &state);
        if (result >= 0 && state.asleep) {
            state.velocity = (carom_v3_q40)VELOCITY(0, 0, 4500 + 300 * i);
            state.spin = (carom_v3_q40)SPIN(1500 - 600 * i, 800, 0);
            result = carom_body_set(world, BOWL_PIECE + i, &state);
        }
    }
    return result;
}

static void say(const struct carom_world *world, char text[SCENE_TEXT])
{
    (void)world;
    strcpy(text, "hollow in hollow. A tosses them up");
}

static const struct carom_body_paint paints[] = {
    {NULL, SCENE_GREEN}, {NULL, SCENE_WOOD},   {NULL, SCENE_YELLOW}, {NULL, SCENE_RED},
    {NULL, SCENE_DARK},  {NULL, SCENE_MEADOW}, {NULL, SCENE_DARK},   {NULL, SCENE_YELLOW}};

const struct scene_game scene_bowl = {
    .caps = CAROM_CAPS(BOWL_PIECE + BOWL_PIECES, 32, 64, 192, 0, 512),
    .camera = {POSITION(-700, -3900, 3800), POSITION(0, 0, 800), 1 << 16},
    .fill = fill,
    .script = script,
    .before = before,
    .say = say,
    .paints = paints,
    .paint_count = sizeof paints / sizeof paints[0],
};
