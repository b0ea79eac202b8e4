/* SPDX-License-Identifier: MIT */
/*
 * The scenes of scene_games.h as they are to go: each plays without an error, and what it is about happens. What is
 * expected follows from the numbers of the scene.
 */
#include <string.h>

#include "carom_body.h"
#include "one_world.h"
#include "scene_games.h"
#include "shapes.h"
#include "test.h"

#define SECOND 60

static _Alignas(8) uint8_t block[128 * 1024];
static struct scene scene;
static int frame;

static void begin(const char *name)
{
    struct carom_config config = scene_config();

    frame = 0;
    CHECK_EQ(scene_load(&scene, name, NULL, shape_scene_block, sizeof shape_scene_block), CAROM_OK);
    CHECK_EQ(scene_make(&scene, &config, block, sizeof block, &world), CAROM_OK);
}

static void step(void)
{
    frame++;
    CHECK(scene_before(&scene, world, frame) >= 0);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
}

static struct carom_joint_state joint_of(int joint)
{
    struct carom_joint_state s;

    memset(&s, 0, sizeof s);
    CHECK_EQ(carom_joint_get(world, joint, &s), CAROM_OK);
    return s;
}

/* Whether the last step had an event of a body. */
static bool happened(int kind, int body)
{
    const struct carom_event *events = NULL;
    int n = carom_events(world, &events);
    bool found = false;

    for (int i = 0; i < n; i++) {
        found = found || (events[i].kind == kind && events[i].a == body);
    }
    return found;
}

/* The anchors of all joints but sliders are together, within some skins of body a along each axis. */
static void check_anchors(int64_t skins)
{
    for (int i = 0; i < carom_joint_count(world); i++) {
        const struct carom_joint_state s = joint_of(i);
        const int64_t skin_q32 = (int64_t)carom_body_mesh(world, s.a)->radius_q22 >> 1;

        for (int k = 0; k < 3 && s.kind != CAROM_JOINT_SLIDER; k++) {
            CHECK_NEAR(s.anchor[0].c[k], s.anchor[1].c[k], skins * skin_q32);
        }
    }
}

/* The ball opens the door, which stops at its limit, upright. */
static void test_door(void)
{
    const int64_t limit_q32 = CAROM_RATIO(-DOOR_OPEN_MRAD, 1000, 32);
    int64_t least_q32 = 0;

    begin("door");
    while (frame < 2 * SECOND) {
        struct carom_body_state leaf;

        step();
        check_anchors(1);
        leaf = state_of(DOOR_LEAF);
        CHECK_NEAR(leaf.rotation.c[1], 0, CAROM_ONE_Q30 >> 12);
        CHECK_NEAR(leaf.rotation.c[2], 0, CAROM_ONE_Q30 >> 12);
        if (joint_of(DOOR_HINGE).coordinate_q32 < least_q32) {
            least_q32 = joint_of(DOOR_HINGE).coordinate_q32;
        }
    }
    CHECK_NEAR(least_q32, limit_q32, CAROM_RATIO(1, 1000, 32));
}

/* 20 links swing down by themselves, and hold together. */
static void test_chain(void)
{
    int64_t low_q32 = INT64_MAX;

    begin("chain");
    CHECK_EQ(carom_joint_count(world), CHAIN_LINKS);
    while (frame < 2 * SECOND) {
        step();
        check_anchors(4);
        if (state_of(CHAIN_LINKS).position.c[2] < low_q32) {
            low_q32 = state_of(CHAIN_LINKS).position.c[2];
        }
    }
    /* the free end began 6.1 units beside the anchor and has come by below it, or nearly */
    CHECK(low_q32 < CAROM_POSITION_MM(7500 - 5000));
}

/* The block comes down on the box, stops and says so; it crosses nothing, and goes up again. */
static void test_crusher(void)
{
    int blocked = 0;

    begin("crusher");
    while (frame < CRUSHER_FRAMES - 1) {
        step();
        blocked += happened(CAROM_EVENT_BLOCKED, CRUSHER_BLOCK);
        CHECK_EQ(carom_query_faces(world, CRUSHER_BLOCK, CRUSHER_BOX, NULL, 0), 0);
        /* half of the block and all of the box, 1/2 high each */
        CHECK(state_of(CRUSHER_BLOCK).position.c[2] > CAROM_POSITION_MM(750));
    }
    CHECK(blocked > 0);
    CHECK_EQ(state_of(CRUSHER_BLOCK).position.c[2],
             CAROM_POSITION_MM(CRUSHER_HIGH_MM) -
                 CAROM_POSITION_MM(CRUSHER_WAY_MM) / (CRUSHER_FRAMES / 2));
}

/* Half a second after they fell on it all boxes go with the belt. */
static void test_conveyor(void)
{
    const int64_t speed_q40 = CAROM_VELOCITY_MM_S(CONVEYOR_MM_S, FPS);

    begin("conveyor");
    while (frame < SECOND) {
        step();
    }
    for (int i = 0; i < CONVEYOR_BOXES; i++) {
        const struct carom_body_state s = state_of(CONVEYOR_BOX + i);

        CHECK_NEAR(s.velocity.c[0], speed_q40, speed_q40 / 100);
        CHECK_NEAR(s.velocity.c[1], 0, speed_q40 / 100);
    }
}

/* The car drives over the ramps on its wheels and to the left, and picks up two things and the third not. */
static void test_car(void)
{
    struct carom_body_state car;

    begin("car");
    while (frame < 5 * SECOND) {
        step();
        check_anchors(4);
    }
    car = state_of(CAR_CHASSIS);
    CHECK(car.position.c[0] > CAROM_POSITION_M(10));
    CHECK(car.position.c[1] > CAROM_POSITION_M(1));
    /* upright: the axes x and y turned by less than half a radian */
    CHECK_NEAR(car.rotation.c[1], 0, CAROM_ONE_Q30 / 4);
    CHECK_NEAR(car.rotation.c[2], 0, CAROM_ONE_Q30 / 4);
    CHECK(carom_body_mesh(world, CAR_PICKUP) == NULL);
    CHECK(carom_body_mesh(world, CAR_PICKUP + 1) == NULL);
}

/* Up the steps, onto the platform and off again, down the ramp, through the door. */
static void test_walker(void)
{
    int64_t platform_q32;

    begin("walker");
    while (frame < 150) {
        step();
    }
    /* the platform has not left; whoever stands on it does so as high as half a body and the box */
    platform_q32 = state_of(WALKER_PLATFORM).position.c[0];
    CHECK_NEAR(state_of(WALKER).position.c[0], platform_q32, CAROM_POSITION_MM(250));
    CHECK_NEAR(state_of(WALKER).position.c[2], CAROM_POSITION_MM(550 + 875), CAROM_POSITION_MM(1));
    while (frame < 290) {
        step();
    }
    CHECK(state_of(WALKER_PLATFORM).position.c[0] > platform_q32 + CAROM_POSITION_M(3));
    CHECK_NEAR(state_of(WALKER).position.c[0], state_of(WALKER_PLATFORM).position.c[0],
               CAROM_POSITION_MM(250));
    while (frame < 520) {
        step();
        CHECK_EQ(carom_query_faces(world, WALKER, WALKER_DOOR, NULL, 0), 0);
    }
    CHECK(state_of(WALKER).position.c[0] > CAROM_POSITION_M(6));
    CHECK_NEAR(state_of(WALKER).position.c[2], CAROM_POSITION_MM(875), CAROM_POSITION_MM(1));
}

const struct test tests_games[] = {
    {"games/door", test_door},
    {"games/chain", test_chain},
    {"games/crusher", test_crusher},
    {"games/conveyor", test_conveyor},
    {"games/car", test_car},
    {"games/walker", test_walker},
    {0},
};
