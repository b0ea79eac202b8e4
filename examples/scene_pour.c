/* SPDX-License-Identifier: MIT */
/*
 * Scene pour: a bucket full of non-convex things is tipped over its lip into a tray. Right and left tip it and set it up
 * again.
 */
#include "port.h"
#include "scene_games.h"

#define FRICTION_Q16 (1u << 14)

/* Meshes: the shapes first. */
enum { SHAPES = 4, BUCKET = SHAPES, TRAY };

/* mm: the inside of the bucket, and its lip, which stays in place */
#define HALF_MM  680
#define DEEP_MM  900
#define WALL_MM  60
#define LIP_X_MM 0
#define LIP_Z_MM 1650
#define CELL_MM  440 /* room for each thing at first */
#define TRAY_MM  1230

#define CAPS 35, 256, 512, 2048, 0, 4096, 0, 1
#ifndef BOARD_GAME_CAPS /* a board that has less memory lacks this scene */
_Static_assert(CAROM_WORLD_BYTES(CAPS) <= SCENE_WORLD_BYTES, "it fits where any scene does");
#endif

static int fill(const struct scene *scene, struct carom_world *world)
{
    struct carom_body_def thing = {.friction_q16 = FRICTION_Q16};
    static const struct carom_body_def bucket = {
        .kinematic = true,
        .position = POSITION(LIP_X_MM - HALF_MM - WALL_MM, 0, LIP_Z_MM - DEEP_MM),
        .friction_q16 = FRICTION_Q16 / 4};
    static const struct carom_body_def tray = {
        .stationary = true, .position = POSITION(TRAY_MM, 0, 80), .friction_q16 = FRICTION_Q16};
    struct scene_parts parts = {scene, world, CAROM_OK};

    /* layers of three by three */
    for (int i = 0; i < POUR_THINGS; i++) {
        thing.position.c[0] = bucket.position.c[0] + CAROM_POSITION_MM(CELL_MM) * (i % 3 - 1);
        thing.position.c[1] = CAROM_POSITION_MM(CELL_MM) * (i / 3 % 3 - 1);
        thing.position.c[2] = bucket.position.c[2] + CAROM_POSITION_MM(CELL_MM) * (i / 9) +
                              CAROM_POSITION_MM(CELL_MM / 2);
        scene_part(&parts, i % SHAPES, &thing);
    }
    scene_part(&parts, BUCKET, &bucket);
    return scene_part(&parts, TRAY, &tray);
}

/* Largest tangent of a quarter of the angle, and its change in a frame. */
#define MOST_Q30 (CAROM_ONE_Q30 / 10 * 7) /* 140 degrees */
#define STEP_Q30 (MOST_Q30 / 300)

/* Wait until all lie still, tip, wait, and come back. */
static uint32_t script(const struct carom_world *world, int frame)
{
    (void)world;
    return frame > FPS && frame <= 6 * FPS ? PORT_PAD_RIGHT : frame > 7 * FPS ? PORT_PAD_LEFT : 0;
}

/* The pose of the bucket when it is tipped about its lip, by cosine and sine of half the angle. */
static struct carom_pose tipped(const struct carom_world *world, int64_t cosine_q30,
                                int64_t sine_q30)
{
    const carom_v3_q22 *centre = &carom_body_mesh(world, POUR_BUCKET)->mass.centre;
    const int64_t x_q32 = centre->c[0] * 1024ll - CAROM_POSITION_MM(HALF_MM + WALL_MM);
    const int64_t z_q32 = centre->c[2] * 1024ll - CAROM_POSITION_MM(DEEP_MM);
    const int64_t c_q15 = (CAROM_ONE_Q30 - 2 * (sine_q30 * sine_q30 >> 30)) >> 15;
    const int64_t s_q15 = 2 * (cosine_q30 * sine_q30 >> 30) >> 15;
    struct carom_pose pose = {POSITION(LIP_X_MM, 0, LIP_Z_MM),
                              {{(int32_t)cosine_q30, 0, (int32_t)sine_q30, 0}}};

    pose.position.c[0] += (x_q32 * c_q15 + z_q32 * s_q15) >> 15;
    pose.position.c[2] += (z_q32 * c_q15 - x_q32 * s_q15) >> 15;
    return pose;
}

/*
 * The tangent t of a quarter of the angle changes evenly, and the angle changes nearly evenly. Half
 * the angle has the cosine (1 - t^2) / (1 + t^2) and the sine 2 t / (1 + t^2).
 */
static int before(struct carom_world *world, int frame, uint32_t keys)
{
    const int way = !!(keys & PORT_PAD_RIGHT) - !!(keys & PORT_PAD_LEFT);
    struct carom_body_state bucket;
    struct carom_pose pose;
    int64_t t_q30, square_q30, c_q30, s_q30;
    int result = carom_body_get(world, POUR_BUCKET, &bucket);

    (void)frame;
    if (result < 0) {
        return result;
    }
    c_q30 = bucket.rotation.c[0];
    s_q30 = bucket.rotation.c[2];
    t_q30 = (s_q30 << 30) / (CAROM_ONE_Q30 + c_q30) + way * STEP_Q30;
    t_q30 = t_q30 < 0 ? 0 : t_q30 > MOST_Q30 ? MOST_Q30 : t_q30;
    square_q30 = t_q30 * t_q30 >> 30;
    c_q30 = ((CAROM_ONE_Q30 - square_q30) << 30) / (CAROM_ONE_Q30 + square_q30);
    s_q30 = (2 * t_q30 << 30) / (CAROM_ONE_Q30 + square_q30);
    pose = tipped(world, c_q30, s_q30);
    return way ? carom_body_move_to(world, POUR_BUCKET, &pose) : CAROM_OK;
}

/* Count the things above the tray that are as low as its walls. */
static void say(const struct carom_world *world, char text[SCENE_TEXT])
{
    int count = 0;

    for (int i = 0; i < POUR_THINGS; i++) {
        struct carom_body_state thing;

        count += carom_body_get(world, POUR_THING + i, &thing) >= 0 && thing.position.c[0] > 0 &&
                 thing.position.c[2] < CAROM_POSITION_MM(600);
    }
    scene_say_number(text, count, " of 32 poured");
}

#define FOUR                                                                                       \
    {NULL, SCENE_YELLOW}, {NULL, SCENE_RED}, {NULL, SCENE_WOOD},                                   \
    {                                                                                              \
        NULL, SCENE_MEADOW                                                                         \
    }
static const struct carom_body_paint paints[] = {
    {NULL, SCENE_GREEN}, FOUR, FOUR, FOUR, FOUR, FOUR, FOUR, FOUR, FOUR, {NULL, SCENE_DARK},
    {NULL, SCENE_DARK}};

const struct scene_game scene_pour = {
    .caps = CAROM_CAPS(CAPS),
    .camera = {POSITION(1500, -4200, 3700), POSITION(420, 0, 1060), 1 << 16},
    .fill = fill,
    .script = script,
    .before = before,
    .say = say,
    .paints = paints,
    .paint_count = sizeof paints / sizeof paints[0],
};
