/* SPDX-License-Identifier: MIT */
/*
 * The cost of carom_draw over the head scene, in instructions of a Cortex-M3 that counts them.
 * Other boards check the pictures only.
 */
#include <string.h>

#include "draw/draw.h"
#include "port.h"
#include "scene.h"
#include "lib/shapes.h"
#include "lib/test.h"

/*
 * Instructions: pictures of 320 x 240 and of 512 x 512 pixels in all frames that are drawn, a
 * picture of the background alone, and a body that is out of sight. With unrolled loops, which the
 * board has, pictures cost 1 % more.
 */
enum { WIDTH = 320, HEIGHT = 240, SIDE = 512, FRAMES = 120, EACH = 15 };
enum { WORST_SMALL = 2460000, WORST_LARGE = 3310000, EMPTY_SMALL = 88100, EACH_BODY = 150 };

static _Alignas(8) uint8_t world_block[CAROM_WORLD_BYTES(SCENE_PILE_CAPS)];
static _Alignas(8) uint8_t workspace[CAROM_DRAW_BYTES(SCENE_HEAD_VERTICES + SCENE_FIELD_VERTICES,
                                                      SCENE_HEAD_FACES + SCENE_FIELD_FACES)];
static uint8_t pixels[SIDE * SIDE], reference[WIDTH * HEIGHT];
static struct scene scene;

static struct carom_world *new_scene(const char *name)
{
    struct carom_config config = scene_config();
    struct carom_world *world = NULL;

    CHECK_EQ(scene_load(&scene, name, NULL, shape_scene_block, sizeof shape_scene_block), CAROM_OK);
    CHECK_EQ(scene_make(&scene, &config, world_block, sizeof world_block, &world), CAROM_OK);
    return world;
}

static uint32_t cost(const struct carom_world *world, const struct carom_camera *camera,
                     int32_t width, int32_t height, size_t bytes)
{
    struct carom_picture picture = {.pixels = pixels,
                                    .width = width,
                                    .height = height,
                                    .stride = width,
                                    .format = CAROM_PALETTE8,
                                    .workspace = workspace,
                                    .workspace_bytes = bytes};
    uint32_t start = port_ticks(), ticks;

    CHECK_EQ(carom_draw(world, camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
    ticks = port_ticks() - start;
    return port_instructions(ticks);
}

static void report(const char *what, uint32_t spent)
{
    if (port_instructions(port_ticks_hz)) {
        port_print("# %s: %lu instructions\n", what, (unsigned long)spent);
    }
}

/*
 * A fall until the head begins to rest: the head before the sky, before the field and on the field.
 */
static void head(void)
{
    struct carom_world *world = new_scene("head");
    uint32_t small = 0, large = 0;

    for (int frame = 0; frame <= FRAMES; frame++) {
        if (frame % EACH == 0) {
            uint32_t a = cost(world, scene.camera, WIDTH, HEIGHT, sizeof workspace);
            uint32_t b = cost(world, scene.camera, SIDE, SIDE, sizeof workspace);

            small = a > small ? a : small;
            large = b > large ? b : large;
        }
        CHECK_AT_LEAST(carom_world_step(world), 0);
    }
    report("320 x 240, at most", small);
    report("512 x 512, at most", large);
    CHECK_BAR(small, WORST_SMALL);
    CHECK_BAR(large, WORST_LARGE);
}

/* Seventeen bodies out of sight cost little more than none. */
static void out_of_sight(void)
{
    struct carom_world *world = new_scene("pile");
    struct carom_camera away = *scene.camera;
    uint32_t spent, empty;

    for (int k = 0; k < 3; k++) {
        away.target.c[k] = 2 * away.eye.c[k] - away.target.c[k];
    }
    spent = cost(world, &away, WIDTH, HEIGHT, sizeof workspace);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        CHECK_LESS(pixels[i], DRAW_SHADES);
    }
    for (int body = 0; body < scene.other_count + 2; body++) {
        CHECK_EQ(carom_body_remove(world, body), CAROM_OK);
    }
    empty = cost(world, &away, WIDTH, HEIGHT, sizeof workspace);
    report("nothing in sight", spent);
    report("nothing at all", empty);
    CHECK_BAR(empty, EMPTY_SMALL);
    CHECK_BAR(spent, empty + ((uint32_t)scene.other_count + 2) * EACH_BODY);
}

/* Pictures drawn in parts are the same, down to the smallest workspace, which needs many parts. */
static void parts(void)
{
    static const size_t sizes[] = {CAROM_DRAW_BYTES_LEAST(SCENE_FIELD_VERTICES, SCENE_FIELD_FACES),
                                   24000, 48000};
    struct carom_world *world = new_scene("head");

    for (int frame = 0; frame < 50; frame++) {
        CHECK_AT_LEAST(carom_world_step(world), 0);
    }
    cost(world, scene.camera, WIDTH, HEIGHT, sizeof workspace);
    memcpy(reference, pixels, sizeof reference);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        memset(pixels, 0xee, sizeof pixels);
        memset(workspace, 0x5a, sizeof workspace);
        report("in parts", cost(world, scene.camera, WIDTH, HEIGHT, sizes[i]));
        CHECK_EQ(memcmp(reference, pixels, sizeof reference), 0);
        CHECK_EQ(workspace[sizes[i]], 0x5a);
    }
}

/*
 * The field from so near that it fills the picture: neighbouring faces leave no pixel between them.
 */
static void no_gaps(void)
{
    struct carom_world *world = new_scene("head");
    struct carom_camera camera = *scene.camera;

    CHECK_EQ(carom_body_remove(world, SCENE_BODY), CAROM_OK);
    for (int view = 0; view < 8; view++) {
        camera.target.c[0] = camera.target.c[1] = camera.target.c[2] = 0;
        camera.eye.c[0] = (view - 4) * ((int64_t)1 << 30);
        camera.eye.c[1] = (3 - view) * ((int64_t)1 << 29);
        camera.eye.c[2] = (int64_t)5 << 31;
        cost(world, &camera, WIDTH, HEIGHT, sizeof workspace);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            CHECK_EQ(pixels[i] / DRAW_SHADES, DRAW_STATIONARY);
        }
    }
}

const struct test tests_draw_cost[] = {{"draw_cost/head", head},
                                       {"draw_cost/out_of_sight", out_of_sight},
                                       {"draw_cost/parts", parts},
                                       {"draw_cost/no_gaps", no_gaps},
                                       {0}};
