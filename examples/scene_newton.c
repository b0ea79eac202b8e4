/* SPDX-License-Identifier: MIT */
/*
 * Scene newton: Newton's cradle. Five balls, each rigid with its two rods, hang on hinges under two beams. Some are lifted and
 * let go: A lifts one, LEFT two, UP three. As many swing out on the other side.
 */
#include <string.h>

#include "port.h"
#include "scene_games.h"

enum { MESH_PENDULUM, MESH_BEAM, MESH_POST };

/*
 * Hanging balls are 12 mm apart, so they meet two at a time: balls that touch would be solved at
 * once, as one body. A contact begins some skins away, and the skin depends on the radius of a ball
 * together with its rods.
 */
#define PITCH_MM 512
#define HIGH_MM  2400
#define ASIDE_MM 500
/* A turn about y by 40 degrees: its sine and cosine, and the sine and cosine of half the angle. */
#define SINE_Q30        690189683
#define COSINE_Q30      822533957
#define SINE_HALF_Q30   367241333
#define COSINE_HALF_Q30 1008983012

static carom_v3_q32 pivot(int ball)
{
    return (carom_v3_q32){
        {(ball - NEWTON_BALLS / 2) * CAROM_POSITION_MM(PITCH_MM), 0, CAROM_POSITION_MM(HIGH_MM)}};
}

/* Lift the first `count` balls; the others hang. All are still. */
static int lift(struct carom_world *world, int count)
{
    const int64_t below_q22 = carom_body_mesh(world, NEWTON_BALL)->mass.centre.c[2];
    int result = CAROM_OK;

    for (int i = 0; i < NEWTON_BALLS && result >= 0; i++) {
        struct carom_body_state state = {.position = pivot(i)};
        const bool up = i < count;

        state.rotation.c[0] = up ? COSINE_HALF_Q30 : CAROM_ONE_Q30;
        state.rotation.c[2] = up ? SINE_HALF_Q30 : 0;
        state.position.c[0] += up ? SINE_Q30 * below_q22 / (1 << 20) : 0;
        state.position.c[2] += (up ? COSINE_Q30 : CAROM_ONE_Q30) * below_q22 / (1 << 20);
        state.overlap = CAROM_OVERLAP_PASS; /* it may overlap balls that are not set yet */
        result = carom_body_set(world, NEWTON_BALL + i, &state);
    }
    return result;
}

static int fill(const struct scene *scene, struct carom_world *world)
{
    struct carom_body_def still = {.stationary = true}, ball = {.restitution_q30 = CAROM_ONE_Q30};
    struct carom_joint_def hinge = {
        .kind = CAROM_JOINT_HINGE, .b = CAROM_WORLD, .axis = {{0, CAROM_ONE_Q30, 0}}};
    struct scene_parts parts = {scene, world, CAROM_OK};

    for (int i = 0; i < NEWTON_BALLS; i++) {
        ball.position = pivot(i);
        scene_part(&parts, MESH_PENDULUM, &ball);
        hinge.a = NEWTON_BALL + i;
        hinge.anchor = ball.position;
        scene_joint(&parts, &hinge);
    }
    for (int side = -1; side <= 1; side += 2) {
        still.position = (carom_v3_q32)POSITION(0, side * ASIDE_MM, HIGH_MM);
        scene_part(&parts, MESH_BEAM, &still);
        for (int end = -1; end <= 1; end += 2) {
            still.position = (carom_v3_q32)POSITION(end * 1480, side * ASIDE_MM, 0);
            scene_part(&parts, MESH_POST, &still);
        }
    }
    return parts.result < 0 ? parts.result : lift(world, 1);
}

static uint32_t script(const struct carom_world *world, int frame)
{
    static const uint32_t keys[] = {PORT_PAD_A, PORT_PAD_LEFT, PORT_PAD_UP};

    (void)world;
    return frame % NEWTON_FRAMES == 0 ? keys[frame / NEWTON_FRAMES % 3] : 0;
}

static int before(struct carom_world *world, int frame, uint32_t keys)
{
    const int count = keys & PORT_PAD_A ? 1 : keys & PORT_PAD_LEFT ? 2 : keys & PORT_PAD_UP ? 3 : 0;

    (void)frame;
    return count > 0 ? lift(world, count) : CAROM_OK;
}

static void say(const struct carom_world *world, char text[SCENE_TEXT])
{
    (void)world;
    memcpy(text, "lift one: A, two: left, three: up", 34);
}

static const struct carom_body_paint paints[] = {
    {NULL, SCENE_GREEN},  {NULL, SCENE_RED},  {NULL, SCENE_YELLOW}, {NULL, SCENE_YELLOW},
    {NULL, SCENE_YELLOW}, {NULL, SCENE_RED},  {NULL, SCENE_WOOD},   {NULL, SCENE_WOOD},
    {NULL, SCENE_WOOD},   {NULL, SCENE_WOOD}, {NULL, SCENE_WOOD},   {NULL, SCENE_WOOD}};

const struct scene_game scene_newton = {
    .caps = CAROM_CAPS(NEWTON_BALL + NEWTON_BALLS + 6, 32, 32, 256, 0, 512, NEWTON_BALLS, 0),
    .camera = {POSITION(1500, -5200, 2600), POSITION(0, 0, 1250), 1 << 16},
    .fill = fill,
    .script = script,
    .before = before,
    .say = say,
    .paints = paints,
    .paint_count = sizeof paints / sizeof paints[0],
};
