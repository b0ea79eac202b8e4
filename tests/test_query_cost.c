/* SPDX-License-Identifier: MIT */
/*
 * Instructions of carom_query_faces on a Cortex-M3 that counts them: the head of 1876 faces over
 * the field of 3034. apart: two units above the first contact; near: the boxes overlap and no faces
 * cross; contact: the head grazes the field; deep: it is half a unit, a quarter of its height,
 * below the first contact. Other boards check the number of pairs only.
 */
#include "port.h"
#include "scene.h"
#include "lib/shapes.h"
#include "lib/test.h"

enum { POSES = 24, ROOM = 2048 };

static _Alignas(8) uint8_t world_block[CAROM_WORLD_BYTES(SCENE_CAPS)];
static struct scene scene;
static struct carom_world *world;
static struct carom_body_state state;
static struct carom_face_pair pairs[ROOM];

static const struct phase {
    const char *name;
    int32_t sink; /* distance below the place where the head begins to touch, 2^-12 units */
    uint32_t bar; /* instructions on average */
} phases[] = {
    {"apart", -8192, 1000}, {"near", -200, 100000}, {"contact", 8, 165000}, {"deep", 2048, 750000}};
enum { PHASES = sizeof phases / sizeof phases[0], TOUCHING = 2 };

static int query_at(int64_t z_q32, uint32_t *cost)
{
    uint32_t start;
    int count;

    state.position.c[2] = z_q32;
    state.overlap = CAROM_OVERLAP_PASS;
    CHECK_EQ(carom_body_set(world, SCENE_BODY, &state), CAROM_OK);
    start = port_ticks();
    count = carom_query_faces(world, SCENE_BODY, SCENE_GROUND, pairs, ROOM);
    *cost = port_instructions(port_ticks() - start);
    CHECK_AT_LEAST(count, 0);
    return count;
}

/* The lowest height, to 2^-12 units, at which a head that comes from above does not touch. */
static int64_t touching_height(void)
{
    int64_t apart = (int64_t)5 << 32, touching = 0, step = (int64_t)1 << 28;
    uint32_t cost;

    while (apart > 0 && query_at(apart - step, &cost) == 0) {
        apart -= step;
    }
    touching = apart - step;
    while (apart - touching > (int64_t)1 << 20) {
        int64_t middle = (apart + touching) / 2;

        if (query_at(middle, &cost) == 0) {
            apart = middle;
        } else {
            touching = middle;
        }
    }
    return apart;
}

static void test_cost(void)
{
    const struct carom_config config = scene_config();
    struct test_random r = {1};
    uint32_t sum[PHASES] = {0}, most[PHASES] = {0}, found[PHASES] = {0};

    CHECK_EQ(scene_load(&scene, "head", NULL, shape_scene_block, sizeof shape_scene_block),
             CAROM_OK);
    CHECK_EQ(scene_make(&scene, &config, world_block, sizeof world_block, &world), CAROM_OK);
    CHECK_EQ(carom_body_get(world, SCENE_BODY, &state), CAROM_OK);
    for (int i = 0; i < POSES; i++) {
        int64_t height_q32;

        state.rotation = shape_random_turn(&r);
        for (int k = 0; k < 2; k++) {
            state.position.c[k] = test_random_range(&r, -((int64_t)2 << 32), (int64_t)2 << 32);
        }
        height_q32 = touching_height();
        for (int k = 0; k < PHASES; k++) {
            uint32_t cost;
            int count = query_at(height_q32 - phases[k].sink * ((int64_t)1 << 20), &cost);

            CHECK_EQ((count == 0), (k < TOUCHING));
            sum[k] += cost;
            most[k] = cost > most[k] ? cost : most[k];
            found[k] += (uint32_t)count;
        }
    }
    for (int k = 0; k < PHASES; k++) {
        if (most[k] > 0) {
            port_print(
                "# head and field, %s: %lu instructions on average, %lu at most; %lu pairs\n",
                phases[k].name, (unsigned long)(sum[k] / POSES), (unsigned long)most[k],
                (unsigned long)(found[k] / POSES));
        }
        CHECK_BAR(sum[k] / POSES, phases[k].bar);
    }
}

const struct test tests_query_cost[] = {{"query_cost/head", test_cost}, {0}};
