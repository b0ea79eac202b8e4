/* SPDX-License-Identifier: MIT */
/*
 * The bytes of each call that a recorder writes are those that docs/replay.md says: this source makes them from what the call is
 * given, and from its result. Calls that fail are recorded, too.
 */
#include <string.h>

#include "carom_replay.h"
#include "lib/box.h"
#include "lib/test.h"
#include "lib/written.h"

#define CAPS  4, 6, 32, 64, 0, 64, 1, 2, 4
#define FACES 12
#define CALLS 400

static const int16_t corners[8][3] = BOX_CORNERS(128, 128, 128);
static const struct carom_mesh_raw cube = {corners, box_faces, 8, FACES, 8, CAROM_SOLID};

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)], mesh_block[CAROM_MESH_BYTES(8, FACES)];
static uint8_t said[2048];
static size_t said_bytes;
static struct carom_mesh mesh;
static struct carom_record record;
static struct carom_world *world;
static struct test_random chance;

static void hear(void *user, const void *bytes, size_t count)
{
    (void)user;
    CHECK_AT_MOST(said_bytes + count, sizeof said);
    memcpy(said + said_bytes, bytes, count);
    said_bytes += count;
}

/* The recorder has written what is in the file, and then the result where it is not 0. */
static void check_said(int result)
{
    if (result != 0) {
        put(0x3f, 1);
        put_n(result);
    }
    CHECK_EQ(said_bytes, file_bytes);
    CHECK_EQ(memcmp(said, file, file_bytes), 0);
    said_bytes = file_bytes = 0;
}

/* A number of any size up to so many bits. */
static int64_t any(int bits)
{
    int64_t most = (int64_t)1 << test_random_range(&chance, 0, bits);

    return test_random_range(&chance, -most, most - 1);
}

static void put_call(enum carom_replay_call call, int body)
{
    put(call, 1);
    put_n(body);
}

static void put_three(const int64_t v[3])
{
    for (int k = 0; k < 3; k++) {
        put_n(v[k]);
    }
}

static void put_rotation(const carom_quat_q30 *q)
{
    for (int k = 0; k < 4; k++) {
        put_n(q->c[k]);
    }
}

static void any_three(int64_t v[3], int bits)
{
    for (int k = 0; k < 3; k++) {
        v[k] = any(bits);
    }
}

static void any_rotation(carom_quat_q30 *q)
{
    for (int k = 0; k < 4; k++) {
        q->c[k] = (int32_t)any(31);
    }
}

/* -------------------------------------------------------------- kinds of calls */

/* Calls that give a body a vector, and some a point. */
static void call_vector(int body)
{
    static const struct {
        int (*made)(struct carom_record *, struct carom_world *, int, const carom_v3_q40 *);
        enum carom_replay_call call;
    } plain[] = {{carom_record_body_set_force, CAROM_CALL_body_set_force},
                 {carom_record_body_set_torque, CAROM_CALL_body_set_torque},
                 {carom_record_body_push_centre, CAROM_CALL_body_push_centre},
                 {carom_record_body_twist, CAROM_CALL_body_twist}};
    int which = (int)test_random_range(&chance, 0, 5);
    carom_v3_q40 vector;
    carom_v3_q32 point;

    any_three(vector.c, 62);
    any_three(point.c, 62);
    if (which < 4) {
        put_call(plain[which].call, body > 1 ? -1 : body);
        put_three(vector.c);
        check_said(plain[which].made(&record, world, body, &vector));
    } else {
        put_call(which == 4 ? CAROM_CALL_body_push : CAROM_CALL_body_set_force_at,
                 body > 1 ? -1 : body);
        put_three(vector.c);
        put_three(point.c);
        check_said(which == 4
                       ? carom_record_body_push(&record, world, body, &vector, &point)
                       : carom_record_body_set_force_at(&record, world, body, &vector, &point));
    }
}

/* Calls with one number or two; the place of the second one is always there. */
static void call_numbers(int body)
{
    const int64_t first = any(31), second = any(31);

    switch (test_random_range(&chance, 0, 3)) {
    case 0:
        put_call(CAROM_CALL_body_set_gravity_scale, body > 1 ? -1 : body);
        put_n(first);
        put_n(0);
        check_said(carom_record_body_set_gravity_scale(&record, world, body, (int32_t)first));
        break;
    case 1:
        put_call(CAROM_CALL_body_set_damping, body > 1 ? -1 : body);
        put_n(first);
        put_n(second);
        check_said(
            carom_record_body_set_damping(&record, world, body, (int32_t)first, (int32_t)second));
        break;
    case 2:
        put_call(CAROM_CALL_body_set_mass, body > 1 ? -1 : body);
        put_n((uint32_t)first);
        put_n(0);
        check_said(carom_record_body_set_mass(&record, world, body, (uint32_t)first));
        break;
    default:
        put_call(CAROM_CALL_world_set_combine, 0);
        put_n(second & 7);
        put_n(first & 7);
        check_said(carom_record_world_set_combine(&record, world, (enum carom_combine)(second & 7),
                                                  (enum carom_combine)(first & 7)));
        break;
    }
}

static void call_gravity(void)
{
    carom_v3_q40 gravity;

    any_three(gravity.c, 62);
    put_call(CAROM_CALL_world_set_gravity, 0);
    put_three(gravity.c);
    check_said(carom_record_world_set_gravity(&record, world, &gravity));
}

static void call_place(int body)
{
    struct carom_body_state state = {.overlap = (uint8_t)(any(8) & 3)};
    struct carom_pose pose;

    any_three(state.position.c, 62);
    any_rotation(&state.rotation);
    any_three(state.velocity.c, 62);
    any_three(state.spin.c, 62);
    pose.position = state.position;
    pose.rotation = state.rotation;
    if (any(8) & 1) {
        put_call(CAROM_CALL_body_move_to, body > 1 ? -1 : body);
        put_three(pose.position.c);
        put_rotation(&pose.rotation);
        check_said(carom_record_body_move_to(&record, world, body, &pose));
        return;
    }
    put_call(CAROM_CALL_body_set, body > 1 ? -1 : body);
    put_three(state.position.c);
    put_rotation(&state.rotation);
    put_three(state.velocity.c);
    put_three(state.spin.c);
    put_n(state.overlap);
    check_said(carom_record_body_set(&record, world, body, &state));
}

static void call_look(int body)
{
    struct carom_filter filter = {(uint16_t)any(16), (uint16_t)any(16), (int16_t)any(15)};
    struct carom_material material = {.restitution_q30 = (int32_t)any(31),
                                      .friction_q16 = (uint32_t)any(31),
                                      .rolling_q16 = (uint32_t)any(31)};

    any_three(material.surface_velocity.c, 62);
    put_call(CAROM_CALL_body_set_filter, body > 1 ? -1 : body);
    put_n(filter.category);
    put_n(filter.mask);
    put_n(filter.group);
    check_said(carom_record_body_set_filter(&record, world, body, &filter));
    put_call(CAROM_CALL_body_set_material, body > 1 ? -1 : body);
    put_n(material.restitution_q30);
    put_n(material.friction_q16);
    put_n(material.rolling_q16);
    put_three(material.surface_velocity.c);
    check_said(carom_record_body_set_material(&record, world, body, &material));
}

static void put_drive(const struct carom_joint_drive *d)
{
    put_n(d->limited);
    put_n(d->lower_q32);
    put_n(d->upper_q32);
    put_n(d->motor);
    put_n(d->motor_speed_q40);
    put_n(d->motor_most_q40);
    put_n(d->spring);
    put_n(d->rest_q32);
    put_n(d->stiffness_q40);
    put_n(d->damping_q40);
}

/* A joint that is there, or is refused; then its drive, and then it goes. */
static void call_joint(void)
{
    const bool good = any(8) & 1;
    struct carom_joint_def def = {.kind = good ? CAROM_JOINT_HINGE : (uint8_t)any(8),
                                  .touch = any(8) & 1,
                                  .a = 1,
                                  .b = any(8) & 1 ? 0 : CAROM_WORLD,
                                  .axis = {{0, 0, good ? CAROM_ONE_Q30 : 0}},
                                  .drive = {any(8) & 1, -any(20), any(62), any(8) & 1, any(62),
                                            any(62), any(8) & 1, any(62), any(62), any(62)},
                                  .most_impulse_q40 = any(62)};
    int joint;

    any_three(def.anchor.c, good ? 20 : 62);
    any_three(def.anchor_b.c, 62);
    put_call(CAROM_CALL_joint_add, 0);
    put_n(def.kind);
    put_n(def.touch);
    put_n(def.a);
    put_n(def.b);
    put_three(def.anchor.c);
    put_three(def.anchor_b.c);
    for (int k = 0; k < 3; k++) {
        put_n(def.axis.c[k]);
    }
    put_drive(&def.drive);
    put_n(def.most_impulse_q40);
    joint = carom_record_joint_add(&record, world, &def);
    check_said(joint);
    put_call(CAROM_CALL_joint_set, joint);
    put_drive(&def.drive);
    check_said(carom_record_joint_set(&record, world, joint, &def.drive));
    put_call(CAROM_CALL_joint_remove, joint);
    check_said(carom_record_joint_remove(&record, world, joint));
}

/* ------------------------------------------------------------------- a world */

/* Numbers that a body may have, in the order of the struct. */
static void call_add(bool first)
{
    struct carom_body_def def = {.mesh = &mesh,
                                 .stationary = first,
                                 .position = {{any(32), any(32), any(32)}},
                                 .rotation = {{0, CAROM_ONE_Q30, 0, 0}},
                                 .velocity = {{any(30), any(30), any(30)}},
                                 .spin = {{any(30), any(30), any(30)}},
                                 .mass_q20 = 1 << 21,
                                 .restitution_q30 = 1 << 29,
                                 .friction_q16 = 1 << 15,
                                 .filter = {3, 7, -2},
                                 .sensor = !first,
                                 .one_way = CAROM_BOTH_WAYS,
                                 .overlap = CAROM_OVERLAP_PASS};

    if (first) {
        put_mesh(&cube);
    }
    put_call(CAROM_CALL_body_add, 0);
    put_n(0); /* the mesh */
    put_n(def.stationary);
    put_n(def.kinematic);
    put_three(def.position.c);
    put_rotation(&def.rotation);
    put_three(def.velocity.c);
    put_three(def.spin.c);
    put_n(def.mass_q20);
    put_n(def.restitution_q30);
    put_n(def.friction_q16);
    put_n(def.filter.category);
    put_n(def.filter.mask);
    put_n(def.filter.group);
    put_n(def.sensor);
    put_n(def.one_way);
    put_n(def.overlap);
    check_said(carom_record_body_add(&record, world, &def));
}

static void begin(void)
{
    static const int caps[] = {CAPS};
    struct carom_config config = {.caps = CAROM_CAPS(CAPS),
                                  .gravity = {{1, -2, 300}},
                                  .sleep = true,
                                  .substep_cap = 9,
                                  .sweep_cap = 77};

    CHECK_EQ(carom_mesh_build(&mesh, &cube, mesh_block, sizeof mesh_block), CAROM_OK);
    file_bytes = said_bytes = 0;
    write_file(NULL, "CRPL", 4);
    put(1, 1); /* version */
    put(0, 1); /* no stages */
    put(5, 1);
    write_file(NULL, "a car", 5);
    CHECK_EQ(carom_record_begin(&record, hear, NULL, false, "a car"), CAROM_OK);
    check_said(0);
    put(CAROM_CALL_world_init, 1);
    for (int i = 0; i < 9; i++) {
        put_n(caps[i]);
    }
    put_three(config.gravity.c);
    put_n(1);
    put_n(9);
    put_n(77);
    put_n(0); /* nobody is asked about contacts */
    check_said(carom_record_world_init(&record, block, sizeof block, &config, &world));
}

static void test_calls(void)
{
    chance = (struct test_random){8};
    for (int n = 0; n < CALLS; n++) {
        int body = (int)test_random_range(&chance, 0, 2); /* of three numbers the last is none */

        if (n % 6 == 0) { /* no call comes again in the same recording, where it would be shorter */
            begin();
            call_add(true);
            call_add(false);
        }
        switch (n % 6) {
        case 0:
            call_vector(body);
            break;
        case 1:
            call_numbers(body);
            break;
        case 2:
            call_gravity();
            break;
        case 3:
            call_place(body);
            break;
        case 4:
            call_look(body);
            break;
        default:
            call_joint();
            break;
        }
    }
}

const struct test tests_replay_bytes[] = {{"replay_bytes/calls", test_calls}, {0}};
