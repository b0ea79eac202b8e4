/* SPDX-License-Identifier: MIT */
/* Scene door: a ball flies against a door on a hinge with limits, and opens it. */
#include "scene_games.h"

#define HALF_Q30     (CAROM_ONE_Q30 / 2)
#define FRICTION_Q16 (1u << 15)

static int fill(const struct scene *scene, struct carom_world *world)
{
    static const struct carom_body_def leaf = {.position = POSITION(0, 0, 20),
                                               .friction_q16 = FRICTION_Q16};
    static const struct carom_body_def ball = {.position = POSITION(650, -2000, 1300),
                                               .velocity = VELOCITY(0, 5000, 1000),
                                               .restitution_q30 = HALF_Q30,
                                               .friction_q16 = FRICTION_Q16};
    static const struct carom_joint_def hinge = {
        .kind = CAROM_JOINT_HINGE,
        .a = DOOR_LEAF,
        .b = CAROM_WORLD,
        .anchor = POSITION(0, 0, 1000),
        .axis = {{0, 0, -CAROM_ONE_Q30}},
        .drive = {.limited = true,
                  .lower_q32 = CAROM_RATIO(-DOOR_OPEN_MRAD, 1000, 32),
                  .upper_q32 = CAROM_RATIO(100, 1000, 32)}};
    struct carom_body_def wall = leaf;
    struct scene_parts parts = {scene, world, CAROM_OK};

    scene_part(&parts, 0, &leaf);
    scene_part(&parts, 1, &ball);
    wall.stationary = true;
    wall.position.c[0] = CAROM_POSITION_MM(-950);
    scene_part(&parts, 0, &wall);
    wall.position.c[0] = CAROM_POSITION_MM(950);
    scene_part(&parts, 0, &wall);
    return scene_joint(&parts, &hinge);
}

static const struct carom_body_paint paints[] = {{NULL, SCENE_GREEN},
                                                 {NULL, SCENE_WOOD},
                                                 {NULL, SCENE_RED},
                                                 {NULL, SCENE_DARK},
                                                 {NULL, SCENE_DARK}};

const struct scene_game scene_door = {
    .caps = CAROM_CAPS(8, 16, 64, 256, 0, 1024, 1, 0),
    .camera = {POSITION(2600, -3800, 2900), POSITION(300, 0, 900), 1 << 16},
    .fill = fill,
    .paints = paints,
    .paint_count = sizeof paints / sizeof paints[0],
};
