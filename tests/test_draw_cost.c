/* SPDX-License-Identifier: MIT */
/*
 * What carom_draw costs: instructions of a Cortex-M3 that counts them, over the head scene. Where no
 * board counts, only the pictures are looked at.
 */
#include <string.h>

#include "port.h"
#include "scene.h"
#include "test.h"

enum { SIDE_MAX = 512 };

static _Alignas(8) uint8_t mesh_block[SCENE_MESH_BYTES], world_block[SCENE_WORLD_BYTES];
static _Alignas(8) uint8_t workspace[CAROM_DRAW_BYTES(SCENE_HEAD_VERTICES + SCENE_FIELD_VERTICES,
                                                      SCENE_HEAD_FACES + SCENE_FIELD_FACES)];
static uint8_t pixels[SIDE_MAX * SIDE_MAX];
static struct scene scene;

static struct carom_world *head_scene(void)
{
    struct carom_config config = scene_config();
    struct carom_world *world = NULL;

    CHECK_EQ(scene_load(&scene, "head", NULL, mesh_block, sizeof mesh_block), CAROM_OK);
    CHECK_EQ(scene_make(&scene, &config, world_block, sizeof world_block, &world), CAROM_OK);
    return world;
}

static uint32_t cost(const struct carom_world *world, const struct carom_camera *camera,
                     int32_t width, int32_t height)
{
    struct carom_picture picture = {.pixels = pixels,
                                    .width = width,
                                    .height = height,
                                    .stride = width,
                                    .format = CAROM_PALETTE8,
                                    .workspace = workspace,
                                    .workspace_bytes = sizeof workspace};
    uint32_t start = port_ticks(), ticks;

    CHECK_EQ(carom_draw(world, camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
    ticks = port_ticks() - start;
    return port_instructions(ticks);
}

static void dev(void)
{
    struct carom_world *world = head_scene();

    for (int frame = 0; frame <= 90; frame++) {
        if (frame % 45 == 0) {
            port_print("# frame %d: %lu %lu\n", frame,
                       (unsigned long)cost(world, &scene.camera, 320, 240),
                       (unsigned long)cost(world, &scene.camera, 512, 512));
        }
        CHECK(carom_world_step(world) >= 0);
    }
}

static void prof(void)
{
    struct carom_world *world = head_scene();

    for (int frame = 0; frame < 45; frame++) {
        CHECK(carom_world_step(world) >= 0);
    }
    cost(world, &scene.camera, 320, 240);
}

const struct test tests_draw_cost[] = {{"draw_cost/dev", dev}, {"draw_prof", prof}, {0}};
