/* SPDX-License-Identifier: MIT */
/*
 * Lists of a step that become full. Events that have no room are left out, and bodies move as they would with room. Pairs that
 * touch have as much room as pairs that are near each other: more are an error.
 */
#include <string.h>

#include "lib/boxes.h"
#include "lib/test.h"

enum { FLAT, CUBE };
enum { LEADERS = 4, HELD = LEADERS };

static void begin(uint32_t bodies, uint32_t pairs)
{
    boxes_begin();
    boxes_make(FLAT, 8000, 8000, 100);
    boxes_make(CUBE, 100, 100, 100);
    boxes_config.caps.bodies = bodies;
    boxes_config.caps.pairs = pairs;
    boxes_config.caps.extras = BOXES_EXTRAS;
}

/* Four kinematic cubes on their way to a cube in their middle, which each reaches later in the frame than the one before. */
static struct carom_world *crossing(int number)
{
    static const int way[LEADERS][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    struct carom_world *world = boxes_world(number);
    struct carom_body_def def;

    for (int i = 0; i < LEADERS; i++) {
        const int far_off = 200 + 50 * (i + 1);

        def = boxes_def(CUBE, -far_off * way[i][0], -far_off * way[i][1], 0);
        def.kinematic = true;
        def.velocity.c[0] = BOXES_Q40(400) * way[i][0];
        def.velocity.c[1] = BOXES_Q40(400) * way[i][1];
        CHECK_EQ(boxes_add(world, &def), i);
    }
    def = boxes_def(CUBE, 0, 0, 0);
    CHECK_EQ(boxes_add(world, &def), HELD);
    return world;
}

/*
 * Each hit is the last one that the cube is allowed, so each is three events: the hit, the cut, and the kinematic cube that is
 * blocked. Before the end of the frame there is room for one event a pair and a body: for nine, which are those of three hits.
 */
static void test_events(void)
{
    struct carom_world *small, *large;

    begin(LEADERS + 1, LEADERS);
    boxes_config.gravity.c[2] = 0;
    boxes_config.substep_cap = 1;
    small = crossing(0);
    boxes_config.caps.pairs = 24;
    large = crossing(1);
    CHECK_EQ(carom_world_step(small), CAROM_SUBSTEP_CAP);
    CHECK_EQ(carom_world_step(large), CAROM_SUBSTEP_CAP);
    for (int i = 0; i <= LEADERS; i++) {
        struct carom_body_state one = boxes_state(small, i), two = boxes_state(large, i);

        CHECK(boxes_same(&one, &two));
    }
    for (int i = 0; i < LEADERS; i++) {
        CHECK_EQ(boxes_events(large, CAROM_EVENT_HIT, HELD, i), 1);
        CHECK_EQ(boxes_events(large, CAROM_EVENT_CUT, HELD, i), 1);
        CHECK_EQ(boxes_events(large, CAROM_EVENT_BLOCKED, i, HELD), 1);
        CHECK_EQ(boxes_events(small, CAROM_EVENT_HIT, HELD, i), i < 3);
        CHECK_EQ(boxes_events(small, CAROM_EVENT_CUT, HELD, i), i < 3);
        CHECK_EQ(boxes_events(small, CAROM_EVENT_BLOCKED, i, HELD), i < 3);
        CHECK_EQ(boxes_events(small, CAROM_EVENT_BEGIN, HELD, i),
                 1); /* these have room of their own */
    }
}

/* A frame in which so many cubes lie on the ground, three of them asleep. Returns the result of the step that fails, or OK. */
static int lie_down(uint32_t pairs, int more)
{
    struct carom_world *world;
    struct carom_body_def def;
    uint64_t hash = 0;
    int result = CAROM_OK;

    begin(10, pairs);
    world = boxes_world(0);
    def = boxes_def(FLAT, 0, 0, 0);
    def.stationary = true;
    CHECK_EQ(boxes_add(world, &def), 0);
    for (int i = 1; i <= 3 + more; i++) {
        if (i == 4) {
            boxes_step(world, 35);
            CHECK(boxes_state(world, 1).asleep && boxes_state(world, 3).asleep);
        }
        def = boxes_def(CUBE, 500 * i, 0, 201);
        CHECK_EQ(boxes_add(world, &def), i);
    }
    for (int i = 0; i < 30 && result == CAROM_OK; i++) {
        hash = carom_world_hash(world);
        result = carom_world_step(world);
    }
    if (result < 0) {
        CHECK_EQ(carom_world_hash(world), hash);
        for (int i = 4; i <= 3 + more; i++) {
            CHECK_EQ(carom_body_remove(world, i), CAROM_OK);
        }
        boxes_step(world, 1);
    }
    return result;
}

/* Pairs at rest are no near pairs, but they touch: five do not fit into a list for three or four. */
static void test_touching(void)
{
    CHECK_EQ(lie_down(3, 2), CAROM_ERR_PAIRS_FULL);
    CHECK_EQ(lie_down(4, 2), CAROM_ERR_PAIRS_FULL);
    CHECK_EQ(lie_down(5, 2), CAROM_OK);
}

/*
 * A cube flies to and fro between two walls, 60 apart from both, by 40000 in a frame: more often than a pair counts its hits, and
 * as often as the world allows. It stays between the walls and gains no speed.
 */
static void test_hits(void)
{
    struct carom_world *world;
    struct carom_body_def def;
    struct carom_body_state state;
    struct carom_stats stats;

    begin(3, 4);
    boxes_config.gravity.c[2] = 0;
    boxes_config.substep_cap = 255;
    world = boxes_world(0);
    for (int i = 0; i < 2; i++) {
        def = boxes_def(FLAT, 0, 0, i ? -230 : 230);
        def.stationary = true;
        def.restitution_q30 = CAROM_ONE_Q30;
        CHECK_EQ(boxes_add(world, &def), i);
    }
    def = boxes_def(CUBE, 0, 0, 0);
    def.restitution_q30 = CAROM_ONE_Q30;
    def.velocity.c[2] = BOXES_Q40(40000);
    CHECK_EQ(boxes_add(world, &def), 2);
    CHECK_EQ(carom_world_step(world), CAROM_SUBSTEP_CAP);
    CHECK_EQ(carom_stats(world, &stats), CAROM_OK);
    CHECK_EQ(stats.hits, 255);
    CHECK_EQ(
        boxes_events(world, CAROM_EVENT_CUT, 2, 0) + boxes_events(world, CAROM_EVENT_CUT, 2, 1), 1);
    state = boxes_state(world, 2);
    CHECK_AT_MOST(carom_abs(state.position.c[2]), BOXES_Q32(30));
    CHECK_AT_MOST(carom_abs(state.velocity.c[2]), BOXES_Q40(40001));
}

const struct test tests_world_full[] = {{"world_full/events", test_events},
                                        {"world_full/touching", test_touching},
                                        {"world_full/hits", test_hits},
                                        {0}};
