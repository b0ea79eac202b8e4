/* SPDX-License-Identifier: MIT */
/*
 * Scene gears: toothed wheels on hinges in front of a board. A motor turns the first wheel, and teeth turn the others.
 * Left and right turn the motor.
 */
#include "port.h"
#include "scene_games.h"

/* The places of the axles, as in tools/machines.py: wheels that touch roll on each other. */
static const struct carom_body_def wheels[GEARS] = {{.position = POSITION(-1500, 0, 950)},
                                                    {.position = POSITION(0, 0, 1750)},
                                                    {.position = POSITION(1600, 0, 2950)},
                                                    {.position = POSITION(2440, 0, 1830)}};

#define SPEED_Q40 CAROM_SPIN_MRAD_S(GEARS_TURNS_A_MINUTE * 6283 / 60, FPS)

static int fill(const struct scene *scene, struct carom_world *world)
{
    struct carom_joint_def hinge = {.kind = CAROM_JOINT_HINGE,
                                    .b = CAROM_WORLD,
                                    .axis = {{0, -CAROM_ONE_Q30, 0}},
                                    .drive = {.motor = true,
                                              .motor_speed_q40 = SPEED_Q40,
                                              .motor_most_q40 = CAROM_TORQUE_N_M(12, FPS)}};
    static const struct carom_body_def board = {.stationary = true,
                                                .position = POSITION(500, 250, 0)};
    struct scene_parts parts = {scene, world, CAROM_OK};

    for (int i = 0; i < GEARS; i++) {
        scene_part(&parts, i, &wheels[i]);
    }
    scene_part(&parts, GEARS, &board);
    for (int i = 0; i < GEARS; i++) {
        hinge.a = GEARS_FIRST + i;
        hinge.anchor = wheels[i].position;
        scene_joint(&parts, &hinge);
        hinge.drive.motor = false;
    }
    return parts.result;
}

/* Six seconds one way, one second of rest, and back. */
static uint32_t script(const struct carom_world *world, int frame)
{
    int phase = frame % (14 * FPS);

    (void)world;
    return phase < 6 * FPS                        ? PORT_PAD_RIGHT
           : phase >= 7 * FPS && phase < 13 * FPS ? PORT_PAD_LEFT
                                                  : 0;
}

static int before(struct carom_world *world, int frame, uint32_t keys)
{
    struct carom_joint_state state;
    int result = carom_joint_get(world, 0, &state);

    (void)frame;
    if (result >= 0) {
        state.drive.motor_speed_q40 = keys & PORT_PAD_RIGHT  ? -SPEED_Q40
                                      : keys & PORT_PAD_LEFT ? SPEED_Q40
                                                             : 0;
        result = carom_joint_set(world, 0, &state.drive);
    }
    return result;
}

/* Turns a minute, rounded to nearest. */
static void say(const struct carom_world *world, char text[SCENE_TEXT])
{
    for (int i = 0; i < GEARS; i++) {
        struct carom_joint_state state;
        int64_t mrad_s = 0;

        if (carom_joint_get(world, i, &state) >= 0) {
            mrad_s = CAROM_TO_MRAD_S(carom_abs(state.speed_q40), FPS);
        }
        text = scene_say_number(text, (int)((mrad_s * 60 + 3142) / 6283),
                                i < GEARS - 1 ? "  " : " turns a minute");
    }
}

static const struct carom_body_paint paints[] = {{NULL, SCENE_GREEN},  {NULL, SCENE_RED},
                                                 {NULL, SCENE_YELLOW}, {NULL, SCENE_WOOD},
                                                 {NULL, SCENE_MEADOW}, {NULL, SCENE_DARK}};

const struct scene_game scene_gears = {
    .caps = CAROM_CAPS(GEARS + 2, 16, 64, 512, 0, 2048, GEARS, 0),
    .camera = {POSITION(-900, -6000, 3000), POSITION(480, 0, 1870), 1 << 16},
    .fill = fill,
    .script = script,
    .before = before,
    .say = say,
    .paints = paints,
    .paint_count = sizeof paints / sizeof paints[0],
};
