/* SPDX-License-Identifier: MIT */
/*
 * The cost of a whole step with little to do, in instructions where the board counts them: a body
 * sleeps on another, or flies far from it, with and without spin.
 */
#include "port.h"
#include "scene.h"
#include "lib/test.h"

#define BOX_BYTES (SCENE_MESH(8, 12) + SCENE_MESH(4, 2))
static _Alignas(8) uint8_t mesh_block[BOX_BYTES];
static _Alignas(8) uint8_t world_block[CAROM_WORLD_BYTES(SCENE_CAPS)];

/* The box scene after so many frames. */
static struct carom_world *box_world(struct scene *scene, bool spin, uint32_t frames)
{
    struct carom_config config = scene_config();
    struct carom_world *world = NULL;

    CHECK_EQ(scene_load(scene, "box", NULL, mesh_block, sizeof mesh_block), CAROM_OK);
    if (!spin) {
        scene->body.spin = (carom_v3_q40){{0, 0, 0}};
    }
    CHECK_EQ(scene_make(scene, &config, world_block, sizeof world_block, &world), CAROM_OK);
    while (frames-- > 0) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
    return world;
}

static uint32_t step_cost(struct carom_world *world)
{
    uint32_t start, empty, ticks;

    start = port_ticks();
    empty = port_ticks() - start;
    start = port_ticks();
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    ticks = port_ticks() - start;
    return port_instructions(ticks) - port_instructions(empty);
}

static void cost_end(const char *name, uint32_t cost, uint32_t bar)
{
    if (cost > 0) {
        port_print("# %s: %lu instructions\n", name, (unsigned long)cost);
    }
    CHECK_BAR(cost, bar);
}

static void test_asleep(void)
{
    static struct scene scene;
    struct carom_world *world = box_world(&scene, true, 0);
    struct carom_body_state state = {.asleep = false};
    uint32_t frames = 0;

    while (!state.asleep && frames++ < 600) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK_EQ(carom_body_get(world, SCENE_BODY, &state), CAROM_OK);
    }
    CHECK(state.asleep);
    for (int i = 0; i < 3; i++) {
        cost_end("asleep", step_cost(world), 500);
    }
}

static void test_flight(void)
{
    static struct scene scene;

    cost_end("in flight without spin", step_cost(box_world(&scene, false, 5)), 3000);
    /* half of the cost is the midpoint rule of the rotation, in 60 bits */
    cost_end("in flight with spin", step_cost(box_world(&scene, true, 5)), 6100);
}

const struct test tests_world_cost[] = {
    {"world_cost/asleep", test_asleep},
    {"world_cost/flight", test_flight},
    {0},
};
