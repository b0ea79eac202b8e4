/* SPDX-License-Identifier: MIT */
#include "scene_games.h"

#include "carom_body.h"

#define HALF_Q30     (CAROM_ONE_Q30 / 2)
#define FRICTION_Q16 (1u << 15)

/* --------------------------------------------------------------------- door */

static int door_fill(const struct scene *scene, struct carom_world *world)
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

static const struct carom_body_paint door_paints[] = {{NULL, SCENE_GREEN},
                                                      {NULL, SCENE_WOOD},
                                                      {NULL, SCENE_RED},
                                                      {NULL, SCENE_DARK},
                                                      {NULL, SCENE_DARK}};

const struct scene_game scene_door = {
    .caps = CAROM_CAPS(8, 16, 64, 256, 0, 1024, 1, 0),
    .camera = {POSITION(2600, -3800, 2900), POSITION(300, 0, 900), 1 << 16},
    .fill = door_fill,
    .paints = door_paints,
    .paint_count = sizeof door_paints / sizeof door_paints[0],
};

/* -------------------------------------------------------------------- chain */

#define LINK_MM  320 /* from one to the next: a ring hangs in the other */
#define CHAIN_MM 7500

/* Every other link is turned by a quarter about the chain. Links of the same chain go through each other. */
static int chain_fill(const struct scene *scene, struct carom_world *world)
{
    struct carom_body_def link = {.position = POSITION(0, 0, CHAIN_MM),
                                  .friction_q16 = FRICTION_Q16,
                                  .filter = {1, 0xffff, -1}};
    struct carom_joint_def joint = {
        .kind = CAROM_JOINT_BALL, .b = CAROM_WORLD, .anchor = POSITION(-LINK_MM / 2, 0, CHAIN_MM)};
    struct scene_parts parts = {scene, world, CAROM_OK};

    for (int i = 0; i < CHAIN_LINKS; i++) {
        link.rotation = i % 2 ? (carom_quat_q30){{759250125, 759250125, 0, 0}}
                              : (carom_quat_q30){{CAROM_ONE_Q30, 0, 0, 0}};
        scene_part(&parts, 0, &link);
        link.position.c[0] += CAROM_POSITION_MM(LINK_MM);
    }
    for (int i = 0; i < CHAIN_LINKS; i++) {
        joint.a = SCENE_BODY + i;
        joint.b = i > 0 ? SCENE_BODY + i - 1 : CAROM_WORLD;
        scene_joint(&parts, &joint);
        joint.anchor.c[0] += CAROM_POSITION_MM(LINK_MM);
    }
    return parts.result;
}

#define FOUR_LINKS                                                                                 \
    {NULL, SCENE_YELLOW}, {NULL, SCENE_DARK}, {NULL, SCENE_YELLOW},                                \
    {                                                                                              \
        NULL, SCENE_DARK                                                                           \
    }
static const struct carom_body_paint chain_paints[] = {{NULL, SCENE_GREEN}, FOUR_LINKS, FOUR_LINKS,
                                                       FOUR_LINKS,          FOUR_LINKS, FOUR_LINKS};

const struct scene_game scene_chain = {
    .caps = CAROM_CAPS(CHAIN_LINKS + 1, 64, 64, 256, 0, 1024, CHAIN_LINKS, 0),
    .camera = {POSITION(1500, -10000, 5500), POSITION(1400, 0, 4500), 1 << 16},
    .fill = chain_fill,
    .paints = chain_paints,
    .paint_count = sizeof chain_paints / sizeof chain_paints[0],
};

/* ------------------------------------------------------------------ crusher */

static int crusher_fill(const struct scene *scene, struct carom_world *world)
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

/* Down for half of the time and up again: what is in the way stops the block, until it goes up. */
static int crusher_before(struct carom_world *world, int frame, uint32_t keys)
{
    struct carom_pose pose = {.position = POSITION(0, 0, CRUSHER_HIGH_MM)};
    int phase = frame % CRUSHER_FRAMES;
    int down = phase < CRUSHER_FRAMES / 2 ? phase : CRUSHER_FRAMES - phase;

    (void)keys;
    pose.position.c[2] -= CAROM_POSITION_MM(CRUSHER_WAY_MM) * down / (CRUSHER_FRAMES / 2);
    return carom_body_move_to(world, CRUSHER_BLOCK, &pose);
}

static const struct carom_body_paint crusher_paints[] = {
    {NULL, SCENE_GREEN}, {NULL, SCENE_DARK}, {NULL, SCENE_WOOD}, {NULL, SCENE_RED}};

const struct scene_game scene_crusher = {
    .caps = CAROM_CAPS(4, 16, 64, 256, 0, 1024, 0, 1),
    .camera = {POSITION(2600, -4200, 2400), POSITION(0, 0, 1000), 1 << 16},
    .fill = crusher_fill,
    .before = crusher_before,
    .paints = crusher_paints,
    .paint_count = sizeof crusher_paints / sizeof crusher_paints[0],
};

/* ----------------------------------------------------------------- conveyor */

static int conveyor_fill(const struct scene *scene, struct carom_world *world)
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

static const struct carom_body_paint conveyor_paints[] = {{NULL, SCENE_GREEN},  {NULL, SCENE_DARK},
                                                          {NULL, SCENE_WOOD},   {NULL, SCENE_RED},
                                                          {NULL, SCENE_YELLOW}, {NULL, SCENE_WOOD}};

const struct scene_game scene_conveyor = {
    .caps = CAROM_CAPS(CONVEYOR_BOXES + 2, 32, 128, 512, 0, 1024, 0, 1),
    .camera = {POSITION(3400, -6200, 3800), POSITION(600, 0, 700), 1 << 16},
    .fill = conveyor_fill,
    .paints = conveyor_paints,
    .paint_count = sizeof conveyor_paints / sizeof conveyor_paints[0],
};
