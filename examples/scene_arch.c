/* SPDX-License-Identifier: MIT */
/*
 * Scene arch: a round arch of 13 stones on two plinths, without mortar. Each stone is held only by its neighbours. The arch
 * stands until A throws a heavy ball at it.
 */
#include <string.h>

#include "port.h"
#include "scene_games.h"

enum { MESH_STONE, MESH_PLINTH, MESH_BALL };

#define FRICTION_Q16 52429 /* 0.8 */
#define RADIUS_MM    2000  /* radius of the middle of a stone */
#define PLINTH_MM    800

static const struct carom_body_def ball = {.position = POSITION(-4200, 0, 270),
                                           .friction_q16 = FRICTION_Q16,
                                           .mass_q20 = CAROM_MASS_KG(3),
                                           .restitution_q30 = CAROM_ONE_Q30 / 4};
static const carom_v3_q40 ball_velocity = VELOCITY(5000, 0, 6200);

/* The keystone, then pairs to its right and left, down to the plinths. */
static int fill(const struct scene *scene, struct carom_world *world)
{
    /* half the turn from stone to stone: pi / 26 */
    const int64_t cosine_q30 = 1065913037, sine_q30 = 129425275;
    struct carom_body_def stone = {.friction_q16 = FRICTION_Q16}, plinth = stone;
    struct scene_parts parts = {scene, world, CAROM_OK};
    int64_t c = CAROM_ONE_Q30, s = 0; /* half the turn of a stone */

    for (int i = 0; i < ARCH_STONES; i++) {
        const int64_t side = i % 2 ? 1 : -1;
        const int64_t up_q30 = (c * c - s * s) / CAROM_ONE_Q30, out_q30 = 2 * c * s / CAROM_ONE_Q30;

        stone.rotation = (carom_quat_q30){{(int32_t)c, 0, (int32_t)(side * s), 0}};
        stone.position = (carom_v3_q32)POSITION(0, 0, PLINTH_MM);
        stone.position.c[0] += side * out_q30 * RADIUS_MM / 1000 * 4;
        stone.position.c[2] += up_q30 * RADIUS_MM / 1000 * 4;
        scene_part(&parts, MESH_STONE, &stone);
        if (i % 2 == 0) { /* both stones of a pair are placed: go on to the next pair */
            const int64_t last_q30 = c;

            c = (c * cosine_q30 - s * sine_q30) / CAROM_ONE_Q30;
            s = (s * cosine_q30 + last_q30 * sine_q30) / CAROM_ONE_Q30;
        }
    }
    plinth.stationary = true;
    for (int side = -1; side <= 1; side += 2) {
        plinth.position = (carom_v3_q32)POSITION(side * RADIUS_MM, 0, 0);
        scene_part(&parts, MESH_PLINTH, &plinth);
    }
    return scene_part(&parts, MESH_BALL, &ball);
}

static uint32_t script(const struct carom_world *world, int frame)
{
    (void)world;
    return frame == ARCH_START ? PORT_PAD_A : 0;
}

static int before(struct carom_world *world, int frame, uint32_t keys)
{
    (void)frame;
    return keys & PORT_PAD_A ? scene_throw(world, ARCH_BALL, &ball.position, &ball_velocity)
                             : CAROM_OK;
}

static void say(const struct carom_world *world, char text[SCENE_TEXT])
{
    struct carom_body_state key = {.asleep = false};

    carom_body_get(world, ARCH_KEYSTONE, &key);
    strcpy(text, key.position.c[2] > CAROM_POSITION_MM(PLINTH_MM + RADIUS_MM - 300)
                     ? "no mortar: it stands. A throws the ball"
                     : "it is down");
}

#define TWO(ramp)                                                                                  \
    {NULL, ramp},                                                                                  \
    {                                                                                              \
        NULL, ramp                                                                                 \
    }
static const struct carom_body_paint paints[] = {
    {NULL, SCENE_GREEN}, {NULL, SCENE_RED}, TWO(SCENE_WOOD), TWO(SCENE_YELLOW),
    TWO(SCENE_WOOD),     TWO(SCENE_YELLOW), TWO(SCENE_WOOD), TWO(SCENE_YELLOW),
    TWO(SCENE_DARK),     {NULL, SCENE_DARK}};

const struct scene_game scene_arch = {
    .caps = CAROM_CAPS(ARCH_BALL + 1, 80, 192, 384, 0, 768),
    .camera = {POSITION(-1700, -6800, 3000), POSITION(-750, 0, 1500), 1 << 16},
    .fill = fill,
    .script = script,
    .before = before,
    .say = say,
    .paints = paints,
    .paint_count = sizeof paints / sizeof paints[0],
};
