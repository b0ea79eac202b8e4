/* SPDX-License-Identifier: MIT */
/*
 * The scenes of scene_games.h: each plays without an error, and the thing that it shows happens.
 * The expected values follow from the numbers of the scene.
 */
#include <string.h>

#include "carom_body.h"
#include "lib/one_world.h"
#include "port.h"
#include "scene_games.h"
#include "lib/shapes.h"
#include "lib/test.h"

#define SECOND 60

/* A frame of the car costs a board millions of instructions. */
#ifdef TEST_LONG
#define CAR_FRAMES (5 * SECOND)
#else
#define CAR_FRAMES SECOND
#endif

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
    CHECK_AT_LEAST(scene_before(&scene, world, frame), 0);
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

/*
 * The anchors of all joints except sliders are together, within some skins of body a along each
 * axis.
 */
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

/* The ball opens the door; the door stops at its limit and stays upright. */
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
    /* the free end began 6.1 units beside the anchor and passed below it, or nearly so */
    CHECK_LESS(low_q32, CAROM_POSITION_MM(7500 - 5000));
}

/*
 * The block moves down on the box, stops and reports that; it crosses nothing, and moves up again.
 */
static void test_crusher(void)
{
    int blocked = 0;

    begin("crusher");
    while (frame < CRUSHER_FRAMES - 1) {
        step();
        blocked += happened(CAROM_EVENT_BLOCKED, CRUSHER_BLOCK);
        CHECK_EQ(carom_query_faces(world, CRUSHER_BLOCK, CRUSHER_BOX, NULL, 0), 0);
        /* half of the block and all of the box, 1/2 high each */
        CHECK_MORE(state_of(CRUSHER_BLOCK).position.c[2], CAROM_POSITION_MM(750));
    }
    CHECK_MORE(blocked, 0);
    CHECK_EQ(state_of(CRUSHER_BLOCK).position.c[2],
             CAROM_POSITION_MM(CRUSHER_HIGH_MM) -
                 CAROM_POSITION_MM(CRUSHER_WAY_MM) / (CRUSHER_FRAMES / 2));
}

/* Half a second after they fell on it, all boxes move with the belt. */
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

/* ---------------------------------------------------------------------- car */

static void step_with(uint32_t keys)
{
    frame++;
    CHECK_AT_LEAST(scene_game_before(scene.game, world, frame, keys), 0);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
}

/* Component of a body's x axis along an axis of the world. */
static int64_t heading(int body, int axis)
{
    static const int64_t ahead_q30[3] = {CAROM_ONE_Q30, 0, 0};
    int64_t out_q30[3];

    CHECK_EQ(carom_body_world_vector(world, body, ahead_q30, out_q30), CAROM_OK);
    return out_q30[axis];
}

static void check_upright(int body)
{
    CHECK_NEAR(state_of(body).rotation.c[1], 0, CAROM_ONE_Q30 / 4);
    CHECK_NEAR(state_of(body).rotation.c[2], 0, CAROM_ONE_Q30 / 4);
}

static bool is_no_part(void *context, int body)
{
    (void)context;
    return body < CAR_CHASSIS || body >= CAR_RAMP;
}

/* The squared distance from the camera to the car, mm^2. Nothing is between the two. */
static int64_t look_at_car(void)
{
    static const struct carom_query_filter others = {.wants = is_no_part};
    struct carom_camera camera = *scene.camera;
    struct carom_ray ray;
    struct carom_ray_hit hit;
    int64_t square = 0;

    scene.game->look(world, &camera);
    ray.from = camera.target;
    for (int k = 0; k < 3; k++) {
        const int64_t mm = CAROM_TO_MM(camera.eye.c[k] - camera.target.c[k]);

        square += mm * mm;
        ray.way.c[k] = camera.eye.c[k] - camera.target.c[k];
        CHECK_EQ(camera.target.c[k], state_of(CAR_CHASSIS).position.c[k]);
    }
    CHECK_EQ(carom_cast_ray(world, &ray, &others, &hit), 0);
    return square;
}

/*
 * Without input the car jumps from a ramp on its wheels, and collects the balls on its way, one by
 * one. The camera is 6.62 m from it: 5.6 behind, 1.9 aside and 3 above. If a tower is in between,
 * the ray brings the camera nearer.
 */
static void test_car(void)
{
    int64_t high_q32 = 0;
    int near = 0, far = 0;

    begin("car");
    while (frame < CAR_FRAMES) {
        int64_t square;

        step();
        check_anchors(4);
        check_upright(CAR_CHASSIS);
        if (state_of(CAR_CHASSIS).position.c[2] > high_q32) {
            high_q32 = state_of(CAR_CHASSIS).position.c[2];
        }
        if (frame == 30) {
            CHECK(carom_body_mesh(world, CAR_PICKUP) != NULL);
        }
        square = look_at_car();
        near += square < 6300 * 6300;
        far += square > 6500 * 6500 && square < 6700 * 6700;
    }
    CHECK_MORE(far, CAR_FRAMES * 4 / 5);
    CHECK(carom_body_mesh(world, CAR_PICKUP + CAR_PICKUPS - 1) != NULL);
    if (CAR_FRAMES < 5 * SECOND) {
        return;
    }
    CHECK_MORE(near, 5);
    /* the ramp is 350 mm high, and the chassis is as high above it as above the ground */
    CHECK_MORE(high_q32, CAROM_POSITION_MM(350 + 670));
    CHECK_SAME(carom_body_mesh(world, CAR_PICKUP), NULL);
    CHECK_SAME(carom_body_mesh(world, CAR_PICKUP + 1), NULL);
}

/*
 * The pad: forwards and to the left, or to the right. The car brakes when nothing is held, and
 * reverses.
 */
static void drive(uint32_t side, int sign)
{
    begin("car");
    while (frame < SECOND / 2) {
        step_with(PORT_PAD_UP);
    }
    CHECK_MORE(state_of(CAR_CHASSIS).velocity.c[0], CAROM_VELOCITY_MM_S(500, FPS));
    CHECK_NEAR(heading(CAR_CHASSIS, 1), 0, CAROM_ONE_Q30 / 100);
    while (frame < 5 * SECOND / 4) {
        step_with(PORT_PAD_UP | side);
    }
    CHECK_MORE(sign * heading(CAR_CHASSIS, 1), CAROM_ONE_Q30 / 16);
    while (frame < 4 * SECOND) {
        step_with(0);
    }
    CHECK_NEAR(state_of(CAR_CHASSIS).velocity.c[0], 0, CAROM_VELOCITY_MM_S(200, FPS));
    while (frame < 5 * SECOND) {
        step_with(PORT_PAD_DOWN);
    }
    CHECK_LESS(state_of(CAR_CHASSIS).velocity.c[0], -CAROM_VELOCITY_MM_S(300, FPS));
    check_upright(CAR_CHASSIS);
}

static void test_car_pad(void)
{
#ifdef TEST_LONG
    drive(PORT_PAD_LEFT, 1);
    drive(PORT_PAD_RIGHT, -1);
#else
    begin("car");
    for (int i = 0; i < SECOND / 2; i++) {
        step_with(PORT_PAD_UP);
    }
    CHECK_MORE(state_of(CAR_CHASSIS).velocity.c[0], CAROM_VELOCITY_MM_S(500, FPS));
    (void)drive;
#endif
}

/* ------------------------------------------------------------------- walker */

static int64_t height_mm(void)
{
    return CAROM_TO_MM(state_of(WALKER).position.c[2]);
}

/*
 * Without input the walker climbs the steps, rides the platform, descends the ramp, passes the
 * door, climbs the block.
 */
static void test_walker(void)
{
    int64_t platform_q32, high_mm = 0;

    begin("walker");
    while (frame < 200) {
        step();
    }
    /* the platform has not left; a walker on it is as high as half a body above the box */
    platform_q32 = state_of(WALKER_PLATFORM).position.c[0];
    CHECK_NEAR(state_of(WALKER).position.c[0], platform_q32, CAROM_POSITION_MM(100));
    CHECK_NEAR(height_mm(), 550 + 875, 1);
    while (frame < 240 + 3 * SECOND / 2) {
        step();
        CHECK_EQ(carom_query_faces(world, WALKER, WALKER_PLATFORM, NULL, 0), 0);
    }
    CHECK_MORE(state_of(WALKER_PLATFORM).position.c[0], platform_q32 + CAROM_POSITION_M(2));
    CHECK_NEAR(state_of(WALKER).position.c[0], state_of(WALKER_PLATFORM).position.c[0],
               CAROM_POSITION_MM(100));
    while (frame < 680) {
        step();
        CHECK_EQ(carom_query_faces(world, WALKER, WALKER_DOOR, NULL, 0), 0);
    }
    CHECK_MORE(state_of(WALKER).position.c[0], CAROM_POSITION_M(6));
    CHECK_NEAR(height_mm(), 875, 1);
    while (frame < 1540) {
        step();
        CHECK_EQ(carom_query_faces(world, WALKER, WALKER_BLOCK, NULL, 0), 0);
        high_mm = frame > 1000 && height_mm() > high_mm ? height_mm() : high_mm;
    }
    CHECK_MORE(high_mm, 500 + 875);
    CHECK_NEAR(state_of(WALKER).position.c[0], CAROM_POSITION_MM(-5500), CAROM_POSITION_MM(100));
}

/* Set the walker where the ground is flat and nothing is near. */
static void put_walker(int64_t up_mm)
{
    struct carom_body_state s = state_of(WALKER);

    s.position = (carom_v3_q32){
        {CAROM_POSITION_MM(-5000), CAROM_POSITION_MM(3000), up_mm * CAROM_POSITION_MM(1)}};
    CHECK_EQ(carom_body_set(world, WALKER, &s), CAROM_OK);
}

/* A walker in the air falls by n (n + 1) / 2 times gravity in n frames, then stands. */
static void test_walker_falls(void)
{
    const int64_t gravity_q40 = CAROM_GRAVITY_MM_S2(-9810, FPS);

    begin("walker");
    put_walker(4000);
    for (int n = 1; n <= 30; n++) {
        step_with(0);
        CHECK_NEAR(state_of(WALKER).position.c[2],
                   CAROM_POSITION_MM(4000) + gravity_q40 / 256 * n * (n + 1) / 2,
                   CAROM_POSITION_MM(1));
    }
    while (frame < 2 * SECOND) {
        step_with(0);
    }
    CHECK_NEAR(height_mm(), 875, 1);
    CHECK_EQ(state_of(WALKER).velocity.c[0] | state_of(WALKER).velocity.c[1], 0);
}

/*
 * The pad: a quarter turn to the left at 120 degrees a second, forwards at 1.5 m/s, a jump of v^2 /
 * 2 g.
 */
static void test_walker_pad(void)
{
    int64_t high_mm = 0, y_q32;

    begin("walker");
    put_walker(900);
    while (frame < 20) {
        step_with(0);
    }
    while (frame < 20 + 45) {
        step_with(PORT_PAD_LEFT);
    }
    CHECK_NEAR(heading(WALKER, 1), CAROM_ONE_Q30, CAROM_ONE_Q30 / 1000);
    y_q32 = state_of(WALKER).position.c[1];
    while (frame < 65 + SECOND) {
        step_with(PORT_PAD_UP);
    }
    CHECK_NEAR(state_of(WALKER).position.c[1] - y_q32, CAROM_POSITION_MM(1500),
               CAROM_POSITION_MM(5));
    step_with(PORT_PAD_A);
    while (frame < 65 + 2 * SECOND) {
        step_with(0);
        high_mm = height_mm() > high_mm ? height_mm() : high_mm;
    }
    /* 3.6^2 / (2 * 9.81) = 0.661, plus half a frame's way */
    CHECK_NEAR(high_mm, 875 + 661 + 30, 35);
    CHECK_NEAR(height_mm(), 875, 20);
}

/* The door is shut until the walker stands on the mat, and shuts again. */
static void test_walker_door(void)
{
    struct carom_body_state s;

    begin("walker");
    for (int i = 0; i < SECOND; i++) {
        step_with(0);
    }
    CHECK_NEAR(heading(WALKER_DOOR, 1), CAROM_ONE_Q30, 16);
    s = state_of(WALKER);
    s.position = (carom_v3_q32){{CAROM_POSITION_MM(4300), 0, CAROM_POSITION_MM(900)}};
    CHECK_EQ(carom_body_set(world, WALKER, &s), CAROM_OK);
    for (int i = 0; i < 2 * SECOND; i++) {
        step_with(0);
    }
    CHECK_NEAR(heading(WALKER_DOOR, 0), CAROM_ONE_Q30, 16);
    put_walker(900);
    for (int i = 0; i < 2 * SECOND; i++) {
        step_with(0);
    }
    CHECK_NEAR(heading(WALKER_DOOR, 1), CAROM_ONE_Q30, 16);
}

/* A walker that walks into the crate pushes it. */
static void test_walker_pushes(void)
{
    struct carom_body_state s;
    int64_t x_q32;

    begin("walker");
    s = state_of(WALKER);
    s.position =
        (carom_v3_q32){{CAROM_POSITION_MM(1000), CAROM_POSITION_MM(1800), CAROM_POSITION_MM(900)}};
    CHECK_EQ(carom_body_set(world, WALKER, &s), CAROM_OK);
    x_q32 = state_of(WALKER_CRATE).position.c[0];
    while (frame < 3 * SECOND) {
        step_with(PORT_PAD_UP);
        CHECK_EQ(carom_query_faces(world, WALKER, WALKER_CRATE, NULL, 0), 0);
    }
    CHECK_MORE(state_of(WALKER_CRATE).position.c[0], x_q32 + CAROM_POSITION_MM(500));
}

const struct test tests_scene_games[] = {
    {"scene_games/door", test_door},
    {"scene_games/chain", test_chain},
    {"scene_games/crusher", test_crusher},
    {"scene_games/conveyor", test_conveyor},
    {"scene_games/car", test_car},
    {"scene_games/car_pad", test_car_pad},
    {"scene_games/walker", test_walker},
    {"scene_games/walker_falls", test_walker_falls},
    {"scene_games/walker_pad", test_walker_pad},
    {"scene_games/walker_door", test_walker_door},
    {"scene_games/walker_pushes", test_walker_pushes},
    {0},
};
