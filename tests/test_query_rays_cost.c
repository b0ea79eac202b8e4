/* SPDX-License-Identifier: MIT */
/*
 * Instructions of carom_cast_ray on a Cortex-M3 that counts them, over the field of 3034 faces with
 * the head in the air. down: from above, within 45 degrees of upright; across: from one side of the
 * field to the other, from 3 units above to the ground or over it; near: a unit long, just above
 * the ground. Other boards check the hits only.
 */
#include "carom_query.h"
#include "port.h"
#include "scene.h"
#include "lib/shapes.h"
#include "lib/test.h"

enum { RAYS = 200, KINDS = 3, SWEEPS = 60 };

static _Alignas(8) uint8_t world_block[CAROM_WORLD_BYTES(SCENE_CAPS)];
static struct scene scene;
static struct shape box;
static struct carom_cast_workspace workspace;

static const struct {
    const char *name;
    uint32_t bar;
    int64_t from[3], spread[3], to[3]; /* 2^-8 units */
} kinds[KINDS] = {
    {"a ray down on the field", 15000, {0, 0, 2048}, {640, 640, 256}, {512, 512, 0}},
    {"a ray across it", 15000, {-2048, 0, 512}, {256, 1800, 400}, {4096, 1800, 300}},
    {"a ray of a unit, just above it", 15000, {0, 0, 256}, {1536, 1536, 128}, {192, 192, 200}}};

static void test_cost(void)
{
    const struct carom_config config = scene_config();
    struct test_random r = {2};
    struct carom_world *world;
    struct carom_ray_hit hit;

    CHECK_EQ(scene_load(&scene, "head", NULL, shape_scene_block, sizeof shape_scene_block),
             CAROM_OK);
    CHECK_EQ(scene_make(&scene, &config, world_block, sizeof world_block, &world), CAROM_OK);
    for (int kind = 0; kind < KINDS; kind++) {
        uint32_t sum = 0, most = 0, met = 0;

        for (int n = 0; n < RAYS; n++) {
            struct carom_ray ray;
            uint32_t start, cost;

            for (int k = 0; k < 3; k++) {
                int64_t spread = kinds[kind].spread[k], to = kinds[kind].to[k];

                ray.from.c[k] =
                    (kinds[kind].from[k] + test_random_range(&r, -spread, spread)) * (1 << 24);
                ray.way.c[k] = test_random_range(&r, -to, to) * (1 << 24);
            }
            if (kind == 0) {
                ray.way.c[2] = -((int64_t)16 << 32);
            } else if (kind == 1) {
                ray.way.c[0] = (int64_t)16 << 32;
                ray.way.c[2] -= (int64_t)1 << 32;
            }
            start = port_ticks();
            met += (uint32_t)carom_cast_ray(world, &ray, NULL, &hit);
            cost = port_instructions(port_ticks() - start);
            sum += cost;
            most = cost > most ? cost : most;
        }
        if (most > 0) {
            port_print("# %s: %lu instructions on average, %lu at most; %lu of %d met\n",
                       kinds[kind].name, (unsigned long)(sum / RAYS), (unsigned long)most,
                       (unsigned long)met, RAYS);
        }
        CHECK_MORE(met, 0);
        CHECK_BAR(sum / RAYS, kinds[kind].bar);
    }
}

/*
 * A box of 1 x 0.7 x 0.5 units in any pose. down: 4 units down and up to 2 aside, from 3 units above the field;
 * across: 4 units just above it.
 */
static void test_swept(void)
{
    static const struct {
        const char *name;
        int64_t height, aside, down; /* 2^-8 units */
    } ways[2] = {{"a box swept 4 units down on the field", 768, 512, -1024},
                 {"the same, just above it", 288, 1024, -32}};
    const struct carom_config config = scene_config();
    struct test_random r = {4};
    struct carom_world *world;

    CHECK_EQ(scene_load(&scene, "head", NULL, shape_scene_block, sizeof shape_scene_block),
             CAROM_OK);
    CHECK_EQ(scene_make(&scene, &config, world_block, sizeof world_block, &world), CAROM_OK);
    CHECK_EQ(carom_body_remove(world, SCENE_BODY), CAROM_OK);
    shape_box(&box, 12, 4096, 2868, 2048);
    for (int kind = 0; kind < 2; kind++) {
        uint32_t sum = 0, most = 0, met = 0;

        for (int n = 0; n < SWEEPS; n++) {
            struct carom_query_mesh mesh = {&box.mesh, {{0, 0, 0}}, shape_random_turn(&r)};
            struct carom_mesh_way way = {{{0, 0, 0}}, {{0, 0, 0}}};
            struct carom_mesh_hit hit;
            uint32_t start, cost;

            for (int k = 0; k < 3; k++) {
                mesh.position.c[k] =
                    (k == 2 ? ways[kind].height : test_random_range(&r, -640, 640)) * (1 << 24);
                way.way.c[k] =
                    (k == 2 ? ways[kind].down
                            : test_random_range(&r, -ways[kind].aside, ways[kind].aside)) *
                    (1 << 24);
            }
            start = port_ticks();
            met += carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit) > 0;
            cost = port_instructions(port_ticks() - start);
            sum += cost;
            most = cost > most ? cost : most;
        }
        if (most > 0) {
            port_print("# %s: %lu instructions on average, %lu at most; %lu of %d met\n",
                       ways[kind].name, (unsigned long)(sum / SWEEPS), (unsigned long)most,
                       (unsigned long)met, SWEEPS);
        }
        CHECK_MORE(met, 0);
        CHECK_BAR(sum / SWEEPS, 61500);
    }
}

const struct test tests_query_rays_cost[] = {
    {"query_rays_cost/field", test_cost}, {"query_rays_cost/swept", test_swept}, {0}};
