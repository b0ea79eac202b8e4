/* SPDX-License-Identifier: MIT */
/* Arguments that no world can take: the call names the error and the world stays as it was. Numbers at the edge of a range are taken. */
#include <string.h>

#include "carom_joint.h"
#include "lib/one_world.h"
#include "lib/shapes.h"
#include "lib/test.h"

#define CAPS  4, 3, 16, 16, 0, 32, 3, 2, 0
#define UNIT  ((int64_t)1 << 32)
#define FRAME ((int64_t)1 << 40) /* a unit, or a radian, a frame */

enum { LEFT, RIGHT, GROUND };

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static struct shape box;
static struct carom_config config;
static struct carom_body_def def;

/* Two boxes of mass 4, four units apart, and one that never moves a long way off; `def` is a kinematic one. */
static void setup(int64_t left_x)
{
    memset(&config, 0, sizeof config);
    config.caps = (struct carom_caps)CAROM_CAPS(CAPS);
    shape_box(&box, 12, 8192, 4096, 2048);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    memset(&def, 0, sizeof def);
    def.mesh = &box.mesh;
    def.mass_q20 = 4 << 20;
    def.position.c[0] = left_x;
    CHECK_EQ(carom_body_add(world, &def), LEFT);
    def.position.c[0] = left_x + 4 * UNIT;
    CHECK_EQ(carom_body_add(world, &def), RIGHT);
    def.stationary = true;
    def.position.c[2] = -100 * UNIT;
    CHECK_EQ(carom_body_add(world, &def), GROUND);
    def.stationary = false;
    def.kinematic = true;
    def.position.c[2] = 100 * UNIT;
}

static void test_null(void)
{
    const struct carom_material material = {.friction_q16 = 1};
    const struct carom_joint_drive drive = {.limited = false};
    const carom_v3_q40 v = {{0, 0, 0}};
    const carom_v3_q32 p = {{0, 0, 0}};
    const uint8_t of_face[12] = {0};
    struct carom_joint_state joint;
    struct carom_material got;
    uint32_t mass;

    setup(0);
    REFUSE(carom_body_set_force_at(NULL, LEFT, &v, &p), CAROM_ERR_NULL);
    REFUSE(carom_body_set_force_at(world, LEFT, NULL, &p), CAROM_ERR_NULL);
    REFUSE(carom_body_set_force_at(world, LEFT, &v, NULL), CAROM_ERR_NULL);
    REFUSE(carom_body_push_centre(NULL, LEFT, &v), CAROM_ERR_NULL);
    REFUSE(carom_body_push_centre(world, LEFT, NULL), CAROM_ERR_NULL);
    REFUSE(carom_body_twist(NULL, LEFT, &v), CAROM_ERR_NULL);
    REFUSE(carom_body_twist(world, LEFT, NULL), CAROM_ERR_NULL);
    REFUSE(carom_body_matrix(world, LEFT, NULL), CAROM_ERR_NULL);
    REFUSE(carom_body_velocity_at(world, LEFT, &p, NULL), CAROM_ERR_NULL);
    REFUSE(carom_body_velocity_at(world, LEFT, NULL, NULL), CAROM_ERR_NULL);
    REFUSE(carom_body_material(NULL, LEFT, &got), CAROM_ERR_NULL);
    REFUSE(carom_body_mass(NULL, LEFT, &mass), CAROM_ERR_NULL);
    REFUSE(carom_body_mass(world, LEFT, NULL), CAROM_ERR_NULL);
    REFUSE(carom_body_set_face_materials(NULL, LEFT, &material, 1, of_face), CAROM_ERR_NULL);
    REFUSE(carom_body_set_face_materials(world, LEFT, &material, 1, NULL), CAROM_ERR_NULL);
    REFUSE(carom_joint_count(NULL), CAROM_ERR_NULL);
    REFUSE(carom_joint_remove(NULL, 0), CAROM_ERR_NULL);
    REFUSE(carom_joint_set(NULL, 0, &drive), CAROM_ERR_NULL);
    REFUSE(carom_joint_set(world, 0, NULL), CAROM_ERR_NULL);
    REFUSE(carom_joint_get(NULL, 0, &joint), CAROM_ERR_NULL);
    REFUSE(carom_joint_get(world, 0, NULL), CAROM_ERR_NULL);
}

/* ------------------------------------------------------------------------------- joints */

static struct carom_joint_def joint_of(int kind)
{
    struct carom_joint_def joint = {.kind = (uint8_t)kind, .a = LEFT, .b = RIGHT};

    joint.anchor.c[0] = UNIT;
    joint.anchor_b.c[0] = 3 * UNIT;
    joint.axis.c[2] = CAROM_ONE_Q30;
    return joint;
}

/* Set one number of a slider's drive: it is taken up to `edge`, and refused one beyond. */
#define CHECK_EDGE(number, edge, beyond)                                                           \
    do {                                                                                           \
        drive = none;                                                                              \
        number = (edge);                                                                           \
        CHECK_EQ(carom_joint_set(world, 0, &drive), CAROM_OK);                                     \
        number = (beyond);                                                                         \
        REFUSE(carom_joint_set(world, 0, &drive), CAROM_ERR_RANGE);                                \
    } while (0)

static void test_drives(void)
{
    const int64_t most_q32 = 8192 * UNIT, fastest_q40 = 64 * FRAME, most_q40 = FRAME << 20;
    const struct carom_joint_def joint = joint_of(CAROM_JOINT_SLIDER);
    const struct carom_joint_drive with_limit = {.limited = true, .upper_q32 = 8192 * UNIT};
    const struct carom_joint_drive with_motor = {.motor = true}, with_spring = {.spring = true};
    struct carom_joint_drive drive, none = with_limit;

    setup(0);
    CHECK_EQ(carom_joint_add(world, &joint), 0);
    CHECK_EDGE(drive.lower_q32, -most_q32, -most_q32 - 1);
    CHECK_EDGE(drive.upper_q32, most_q32, most_q32 + 1);
    none = with_motor;
    CHECK_EDGE(drive.motor_speed_q40, fastest_q40, fastest_q40 + 1);
    CHECK_EDGE(drive.motor_speed_q40, -fastest_q40, -fastest_q40 - 1);
    CHECK_EDGE(drive.motor_most_q40, most_q40, most_q40 + 1);
    CHECK_EDGE(drive.motor_most_q40, 0, -1);
    none = with_spring;
    CHECK_EDGE(drive.rest_q32, most_q32, most_q32 + 1);
    CHECK_EDGE(drive.rest_q32, -most_q32, -most_q32 - 1);
    CHECK_EDGE(drive.stiffness_q40, most_q40, most_q40 + 1);
    CHECK_EDGE(drive.damping_q40, most_q40, most_q40 + 1);
    CHECK_EDGE(drive.damping_q40, 0, -1);
    drive = with_motor;
    drive.spring = true;
    REFUSE(carom_joint_set(world, 0, &drive), CAROM_ERR_ARGUMENT);
}

static void test_joints(void)
{
    struct carom_joint_def joint = joint_of(CAROM_JOINT_BALL);
    struct carom_joint_drive drive = {.motor = true};

    setup(0);
    CHECK_EQ(carom_joint_add(world, &joint), 0);
    REFUSE(carom_joint_set(world, 0, &drive), CAROM_ERR_ARGUMENT); /* a ball has no coordinate */
    drive.motor = false;
    drive.spring = true;
    REFUSE(carom_joint_set(world, 0, &drive), CAROM_ERR_ARGUMENT);
    joint = joint_of(CAROM_JOINT_HINGE);
    joint.axis.c[0] = CAROM_ONE_Q30 + (CAROM_ONE_Q30 >> 10) + 1;
    REFUSE(carom_joint_add(world, &joint), CAROM_ERR_ARGUMENT);
    joint = joint_of(CAROM_JOINT_DISTANCE);
    joint.anchor_b.c[1] = 4097 * UNIT;
    REFUSE(carom_joint_add(world, &joint), CAROM_ERR_RANGE);
    joint.kind = CAROM_JOINT_BALL; /* which does not ask for that anchor */
    CHECK_EQ(carom_joint_add(world, &joint), 1);
    joint.anchor.c[1] = 4097 * UNIT;
    REFUSE(carom_joint_add(world, &joint), CAROM_ERR_RANGE);
}

/* A joint that has broken is there until it is removed, and nothing that it holds changes then. */
static void test_broken(void)
{
    struct carom_joint_def joint = joint_of(CAROM_JOINT_BALL);
    const carom_v3_q40 push = {{-FRAME / 64, 0, 0}};
    struct carom_joint_state got;
    struct carom_body_state before, after;

    setup(0);
    joint.most_impulse_q40 = 1;
    CHECK_EQ(carom_joint_add(world, &joint), 0);
    CHECK_EQ(carom_body_push_centre(world, LEFT, &push), CAROM_OK);
    steps(2);
    CHECK_EQ(carom_joint_get(world, 0, &got), CAROM_OK);
    CHECK(got.broken);
    before = state_of(RIGHT);
    CHECK_EQ(carom_joint_remove(world, 0), CAROM_OK);
    CHECK_EQ(carom_joint_get(world, 0, &got), CAROM_ERR_JOINT);
    after = state_of(RIGHT);
    CHECK_EQ(memcmp(&before.position, &after.position, sizeof before.position), 0);
    CHECK_EQ(memcmp(&before.rotation, &after.rotation, sizeof before.rotation), 0);
    CHECK_EQ(memcmp(&before.velocity, &after.velocity, sizeof before.velocity), 0);
    CHECK_EQ(memcmp(&before.spin, &after.spin, sizeof before.spin), 0);
}

/* The speed of a coordinate is that of the kinematic body that leads, seen from the one that rests. */
static void test_led_speed(void)
{
    struct carom_joint_def joint = joint_of(CAROM_JOINT_DISTANCE);
    struct carom_joint_state got;

    setup(0);
    CHECK_EQ(carom_body_remove(world, RIGHT), CAROM_OK);
    def.position = (carom_v3_q32){{4 * UNIT, 0, 0}};
    def.velocity = (carom_v3_q40){{FRAME / 64, FRAME / 32, 0}};
    CHECK_EQ(carom_body_add(world, &def), RIGHT);
    CHECK_EQ(carom_joint_add(world, &joint), 0);
    CHECK_EQ(carom_joint_get(world, 0, &got), CAROM_OK);
    CHECK_NEAR(got.speed_q40, FRAME / 64, FRAME >> 28); /* along the line of the anchors only */
    joint.kind = CAROM_JOINT_BALL;
    CHECK_EQ(carom_joint_add(world, &joint), 1);
    CHECK_EQ(carom_joint_get(world, 1, &got), CAROM_OK);
    CHECK_EQ(got.speed_q40, 0); /* a ball has no coordinate */
    joint.kind = CAROM_JOINT_SLIDER;
    joint.b = GROUND; /* which stands */
    CHECK_EQ(carom_joint_add(world, &joint), 2);
    CHECK_EQ(carom_joint_get(world, 2, &got), CAROM_OK);
    CHECK_EQ(got.speed_q40, 0);
}

/* ------------------------------------------------------------------------------- bodies */

/* A moment of more than 2^21 does not fit, whatever makes it. */
static void test_far_pushes(void)
{
    const carom_v3_q32 far = {{4096 * UNIT, 0, 0}};
    const carom_v3_q40 push = {{0, 500 * FRAME, 0}}, force = {{0, 2047 * FRAME, 0}};

    setup(-4000 * UNIT);
    REFUSE(carom_body_push(world, LEFT, &push, &far), CAROM_ERR_RANGE);
    CHECK_EQ(carom_body_set_mass(world, LEFT, 1024u << 20), CAROM_OK);
    REFUSE(carom_body_set_force_at(world, LEFT, &force, &far), CAROM_ERR_RANGE);
}

/* Twice the mass has the same mantissa; the motion stays. The same mass again changes nothing and wakes nothing. */
static void test_mass(void)
{
    const carom_v3_q40 push = {{FRAME, FRAME / 2, 0}};
    struct carom_body_state before, after;
    uint32_t mass;

    setup(0);
    CHECK_EQ(carom_body_push_centre(world, LEFT, &push), CAROM_OK);
    before = state_of(LEFT);
    CHECK_EQ(carom_body_set_mass(world, LEFT, 8 << 20), CAROM_OK);
    CHECK_EQ(carom_body_mass(world, LEFT, &mass), CAROM_OK);
    CHECK_EQ(mass, 8 << 20);
    after = state_of(LEFT);
    for (int k = 0; k < 3; k++) {
        CHECK_NEAR(after.velocity.c[k], before.velocity.c[k], 16);
    }
    CHECK_EQ(carom_body_push_centre(world, LEFT, &push), CAROM_OK);
    CHECK_NEAR(state_of(LEFT).velocity.c[0], FRAME / 4 + FRAME / 8, 16);
    REFUSE(carom_body_set_mass(world, LEFT, 8 << 20), CAROM_OK);
}

/* Extras run out: those who have one keep it. */
static void test_extras(void)
{
    struct carom_material material = {.friction_q16 = 1, .rolling_q16 = 1};
    const uint8_t of_face[12] = {0};

    setup(0);
    CHECK_EQ(carom_body_set_material(world, LEFT, &material), CAROM_OK);
    CHECK_EQ(carom_body_set_face_materials(world, GROUND, &material, 1, of_face), CAROM_OK);
    REFUSE(carom_body_set_face_materials(world, RIGHT, &material, 1, of_face),
           CAROM_ERR_EXTRAS_FULL);
    REFUSE(carom_body_set_material(world, RIGHT, &material), CAROM_ERR_EXTRAS_FULL);
    REFUSE(carom_body_add(world, &def), CAROM_ERR_EXTRAS_FULL);
    CHECK_EQ(carom_body_set_face_materials(world, RIGHT, NULL, 0, NULL), CAROM_OK);
    CHECK_EQ(carom_body_material(world, RIGHT, &material), CAROM_OK);
    material.friction_q16 = 1; /* this fits into the body itself */
    CHECK_EQ(carom_body_set_material(world, RIGHT, &material), CAROM_OK);
    REFUSE(carom_body_set_material(world, RIGHT, &material), CAROM_OK);
    material.restitution_q30 = 1;
    CHECK_EQ(carom_body_set_material(world, RIGHT, &material), CAROM_OK);
}

/* A kinematic body can be led no faster than half a turn and 64 units a frame. */
static void test_led(void)
{
    struct carom_pose pose = {.position = {{0, 0, 100 * UNIT}}};
    const carom_v3_q40 push = {{FRAME, 0, 0}};

    setup(0);
    CHECK_EQ(carom_body_remove(world, RIGHT), CAROM_OK);
    def.spin.c[0] = 4 * FRAME;
    REFUSE(carom_body_add(world, &def), CAROM_ERR_RANGE);
    def.spin.c[0] = 3 * FRAME;
    def.stationary = true;
    REFUSE(carom_body_add(world, &def), CAROM_ERR_ARGUMENT);
    def.stationary = false;
    CHECK_EQ(carom_body_add(world, &def), RIGHT);
    pose.position.c[0] = 4 * UNIT + 65 * UNIT;
    REFUSE(carom_body_move_to(world, RIGHT, &pose), CAROM_ERR_RANGE);
    pose.position.c[0] = 4097 * UNIT;
    REFUSE(carom_body_move_to(world, RIGHT, &pose), CAROM_ERR_RANGE);
    REFUSE(carom_body_push_centre(world, RIGHT, &push), CAROM_ERR_ARGUMENT);
    REFUSE(carom_body_push_centre(world, 3, &push), CAROM_ERR_BODY);
}

/* A body that has left the world cannot be pushed; put where it is, it is back. */
static void test_out(void)
{
    const carom_v3_q40 push = {{-FRAME, 0, 0}}, away = {{40 * FRAME, 0, 0}};
    struct carom_body_state s;

    setup(4000 * UNIT);
    CHECK_EQ(carom_body_push_centre(world, LEFT, &away), CAROM_OK);
    for (int frame = 0; frame < 40 && !state_of(LEFT).out; frame++) {
        CHECK_AT_LEAST(carom_world_step(world), 0);
    }
    s = state_of(LEFT);
    CHECK(s.out);
    REFUSE(carom_body_push_centre(world, LEFT, &push), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_body_set(world, LEFT, &s), CAROM_OK);
    CHECK(!state_of(LEFT).out);
    CHECK_EQ(carom_body_push_centre(world, LEFT, &push), CAROM_OK);
}

/* ------------------------------------------------------------------------------ filters */

/* Bodies in one place that begin to touch pass each other until they part, so each pair takes a place in the pool. */
static void test_filters(void)
{
    const struct carom_filter none = {.category = 1}, on = {.category = 1, .mask = 0xffff};
    const struct carom_filter grouped = {.category = 1, .mask = 0xffff, .group = 5};

    setup(0);
    CHECK_EQ(carom_body_set_filter(world, LEFT, &grouped), CAROM_OK); /* only the group is new */
    CHECK_EQ(carom_body_set_filter(world, RIGHT, &none), CAROM_OK);
    def.kinematic = false;
    def.filter = none;
    def.position = (carom_v3_q32){{4 * UNIT, 0, 0}};
    CHECK_EQ(carom_body_add(world, &def), 3);
    CHECK_EQ(carom_body_remove(world, GROUND), CAROM_OK);
    CHECK_EQ(carom_body_add(world, &def), GROUND);
    CHECK_EQ(carom_body_set_filter(world, RIGHT, &on), CAROM_OK); /* the others want none */
    steps(1);
    CHECK_EQ(carom_body_set_filter(world, 3, &on), CAROM_OK);      /* one pair passes */
    CHECK_EQ(carom_body_set_filter(world, GROUND, &on), CAROM_OK); /* three do */
    CHECK_EQ(carom_body_remove(world, LEFT), CAROM_OK);
    def.overlap = CAROM_OVERLAP_PASS;
    def.filter = on;
    REFUSE(carom_body_add(world, &def), CAROM_ERR_PAIRS_FULL);
    def.filter = none;
    CHECK_EQ(carom_body_add(world, &def), LEFT);
    REFUSE(carom_body_set_filter(world, LEFT, &on), CAROM_ERR_PAIRS_FULL);
}

const struct test tests_world_given[] = {
    {"world_given/null", test_null},
    {"world_given/drives", test_drives},
    {"world_given/joints", test_joints},
    {"world_given/broken", test_broken},
    {"world_given/led_speed", test_led_speed},
    {"world_given/far_pushes", test_far_pushes},
    {"world_given/mass", test_mass},
    {"world_given/extras", test_extras},
    {"world_given/led", test_led},
    {"world_given/out", test_out},
    {"world_given/filters", test_filters},
    {0},
};
