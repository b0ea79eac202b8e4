/* SPDX-License-Identifier: MIT */
/*
 * Scene dominoes: a row of dominoes with two turns. A ball runs into the first one. Dominoes that
 * the wave has not reached sleep. A throws the ball again.
 */
#include "port.h"
#include "scene_games.h"

enum { MESH_DOMINO, MESH_BALL };

#define FRICTION_Q16 (1u << 14)
#define SPACING_MM   400
#define FIRST_X_MM   (-1100)
#define FIRST_Y_MM   (-3000)

/* Straight ahead, or along an arc of 15 degrees from a domino to the next. */
static const struct {
    uint8_t count;
    int8_t turn;
} way[] = {{6, 0}, {12, 1}, {4, 0}, {12, -1}, {6, 0}};

static const struct carom_body_def ball = {.position = POSITION(-3200, FIRST_Y_MM, 270),
                                           .restitution_q30 = CAROM_ONE_Q30 / 4,
                                           .friction_q16 = FRICTION_Q16};
static const carom_v3_q40 ball_velocity = VELOCITY(3500, 0, 3100);

/* Cosine and sine of the sum of two angles. */
static void turn(int64_t h_q30[2], int64_t cosine_q30, int64_t sine_q30)
{
    const int64_t c = h_q30[0], s = h_q30[1];

    h_q30[0] = (c * cosine_q30 - s * sine_q30) / CAROM_ONE_Q30;
    h_q30[1] = (s * cosine_q30 + c * sine_q30) / CAROM_ONE_Q30;
}

static int fill(const struct scene *scene, struct carom_world *world)
{
    /* half the turn from a domino of an arc to the next, 15 degrees */
    const int64_t cosine_q30 = 1064555814, sine_q30 = 140151432;
    struct carom_body_def domino = {.position = POSITION(FIRST_X_MM, FIRST_Y_MM, 1),
                                    .restitution_q30 = CAROM_ONE_Q30 / 8,
                                    .friction_q16 = FRICTION_Q16};
    struct scene_parts parts = {scene, world, CAROM_OK};
    int64_t half_q30[2] = {CAROM_ONE_Q30, 0};

    for (size_t i = 0; i < sizeof way / sizeof way[0]; i++) {
        for (int k = 0; k < way[i].count; k++) {
            int64_t whole_q30[2] = {half_q30[0], half_q30[1]};

            turn(whole_q30, half_q30[0], half_q30[1]);
            domino.rotation = (carom_quat_q30){{(int32_t)half_q30[0], 0, 0, (int32_t)half_q30[1]}};
            scene_part(&parts, MESH_DOMINO, &domino);
            for (int axis = 0; axis < 2; axis++) {
                domino.position.c[axis] += whole_q30[axis] * SPACING_MM / 1000 * 4;
            }
            turn(half_q30, way[i].turn ? cosine_q30 : CAROM_ONE_Q30, way[i].turn * sine_q30);
        }
    }
    return scene_part(&parts, MESH_BALL, &ball);
}

static uint32_t script(const struct carom_world *world, int frame)
{
    (void)world;
    return frame == DOMINOES_START ? PORT_PAD_A : 0;
}

static int before(struct carom_world *world, int frame, uint32_t keys)
{
    (void)frame;
    return keys & PORT_PAD_A ? scene_throw(world, DOMINOES_BALL, &ball.position, &ball_velocity)
                             : CAROM_OK;
}

/* Count the dominoes that lean by more than 45 degrees. */
static void say(const struct carom_world *world, char text[SCENE_TEXT])
{
    int down = 0;

    for (int i = 0; i < DOMINOES; i++) {
        down += scene_upright(world, DOMINOES_FIRST + i) < 759250125;
    }
    text = scene_say_number(text, down, " of ");
    scene_say_number(text, DOMINOES, " dominoes are down");
}

#define TWO                                                                                        \
    {NULL, SCENE_YELLOW},                                                                          \
    {                                                                                              \
        NULL, SCENE_RED                                                                            \
    }
#define EIGHT TWO, TWO, TWO, TWO
static const struct carom_body_paint paints[] = {
    {NULL, SCENE_GREEN}, EIGHT, EIGHT, EIGHT, EIGHT, EIGHT, {NULL, SCENE_DARK}};

const struct scene_game scene_dominoes = {
    .caps = CAROM_CAPS(DOMINOES_BALL + 1, 128, 224, 512, 0, 1024),
    .camera = {POSITION(-2400, -7400, 4500), POSITION(250, -300, 0), 1 << 16},
    .fill = fill,
    .script = script,
    .before = before,
    .say = say,
    .paints = paints,
    .paint_count = sizeof paints / sizeof paints[0],
};
