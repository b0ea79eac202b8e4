/* SPDX-License-Identifier: MIT */
/* Scene crusher: a kinematic block comes down on a box, stops there, and goes up again; a ball rides on it. */
#include "scene_games.h"

#define HALF_Q30     (CAROM_ONE_Q30 / 2)
#define FRICTION_Q16 (1u << 15)

static int fill(const struct scene *scene, struct carom_world *world)
{
    static const struct carom_body_def block = {.kinematic = true,
                                                .position = POSITION(0, 0, CRUSHER_HIGH_MM),
                                                .friction_q16 = FRICTION_Q16};
    static const struct carom_body_def box = {.position = POSITION(100, 50, 260),
                                              .friction_q16 = FRICTION_Q16};
    static const struct carom_body_def ball = {.position = POSITION(-300, 0, 2600),
                                               .restitution_q30 = HALF_Q30,
                                               .friction_q16 = FRICTION_Q16};
    struct scene_parts parts = {scene, world, CAROM_OK};

    scene_part(&parts, 0, &block);
    scene_part(&parts, 0, &box);
    return scene_part(&parts, 1, &ball);
}

/* Down for half of the time, then up. Whatever is in the way stops the block until it goes up. */
static int before(struct carom_world *world, int frame, uint32_t keys)
{
    struct carom_pose pose = {.position = POSITION(0, 0, CRUSHER_HIGH_MM)};
    int phase = frame % CRUSHER_FRAMES;
    int down = phase < CRUSHER_FRAMES / 2 ? phase : CRUSHER_FRAMES - phase;

    (void)keys;
    pose.position.c[2] -= CAROM_POSITION_MM(CRUSHER_WAY_MM) * down / (CRUSHER_FRAMES / 2);
    return carom_body_move_to(world, CRUSHER_BLOCK, &pose);
}

static const struct carom_body_paint paints[] = {
    {NULL, SCENE_GREEN}, {NULL, SCENE_DARK}, {NULL, SCENE_WOOD}, {NULL, SCENE_RED}};

const struct scene_game scene_crusher = {
    .caps = CAROM_CAPS(4, 16, 64, 256, 0, 1024, 0, 1),
    .camera = {POSITION(2600, -4200, 2400), POSITION(0, 0, 1000), 1 << 16},
    .fill = fill,
    .before = before,
    .paints = paints,
    .paint_count = sizeof paints / sizeof paints[0],
};
