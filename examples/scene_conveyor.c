/* SPDX-License-Identifier: MIT */
/* Scene conveyor: boxes on a belt whose surface moves while the belt stays in place. */
#include "carom_body.h"
#include "scene_games.h"

#define FRICTION_Q16 (1u << 15)

static int fill(const struct scene *scene, struct carom_world *world)
{
    static const struct carom_body_def belt = {
        .stationary = true, .position = POSITION(0, 0, 900), .friction_q16 = FRICTION_Q16};
    static const struct carom_material moving = {.friction_q16 = FRICTION_Q16,
                                                 .rolling_q16 = CAROM_ROLLING_Q16,
                                                 .surface_velocity = VELOCITY(CONVEYOR_MM_S, 0, 0)};
    struct carom_body_def box = {.position = POSITION(0, 0, 1300), .friction_q16 = FRICTION_Q16};
    struct scene_parts parts = {scene, world, CAROM_OK};
    int result;

    scene_part(&parts, 1, &belt);
    for (int i = 0; i < CONVEYOR_BOXES; i++) {
        box.position.c[0] = CAROM_POSITION_MM(900 - 1150 * i);
        scene_part(&parts, 0, &box);
    }
    result = carom_body_set_material(world, CONVEYOR_BELT, &moving);
    return parts.result < 0 ? parts.result : result;
}

static const struct carom_body_paint paints[] = {{NULL, SCENE_GREEN},  {NULL, SCENE_DARK},
                                                 {NULL, SCENE_WOOD},   {NULL, SCENE_RED},
                                                 {NULL, SCENE_YELLOW}, {NULL, SCENE_WOOD}};

const struct scene_game scene_conveyor = {
    .caps = CAROM_CAPS(CONVEYOR_BOXES + 2, 32, 128, 512, 0, 1024, 0, 1),
    .camera = {POSITION(3400, -6200, 3800), POSITION(600, 0, 700), 1 << 16},
    .fill = fill,
    .paints = paints,
    .paint_count = sizeof paints / sizeof paints[0],
};
