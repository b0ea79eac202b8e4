/* SPDX-License-Identifier: MIT */
/*
 * Recordings: each call that changes a world is recorded and played, with the answers of a contact
 * callback. A changed, cut or foreign file is named as such, wherever it was changed.
 */
#include <string.h>

#include "carom_replay.h"
#include "lib/test.h"
#include "lib/written.h"
#include "num/fnv.h"

#define CAPS   8, 16, 64, 256, 64, 256, 2, 6, 4
#define ROOM   60000
#define FRAMES 70 /* more than 64: a state is written in full */
#define FPS    60

#ifdef TEST_LONG
enum { APART = 37, BETWEEN = 4 };
#else
enum { APART = 379, BETWEEN = 20 };
#endif
/*
 * Every byte of the first calls is changed, and every one so far APART of the steps; recordings begin in the middle, so many frames
 * BETWEEN two.
 */
#define NEXT(at) ((at) < 400 ? 1 : APART)

static const int16_t corners[][3] = {{99, 99, 99}, {99, -99, -99}, {-99, 99, -99}, {-99, -99, 99}};
static const uint16_t sides[][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
static const int16_t far_corners[][3] = {{-9999, -9999, 0}, {9999, -9999, 0}, {0, 9999, 0}};
static const int16_t raised[][3] = {{-9999, -9999, 3}, {9999, -9999, 3}, {0, 9999, 3}};
static const struct carom_mesh_raw solid = {corners, sides, 4, 4, 8, CAROM_SOLID};
static const struct carom_mesh_raw flat = {far_corners, sides, 3, 1, 8, CAROM_SURFACE};
static const struct carom_material materials[2] = {
    {.friction_q16 = 1 << 14, .surface_velocity = {{1 << 30, 1 << 29, 0}}},
    {.friction_q16 = 1 << 15, .surface_velocity = {{0, 1 << 30, 1 << 29}}}};
static const uint8_t of_face[4] = {0, 1, 0, 1};

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)], ground_block[CAROM_SURFACE_BYTES(3, 1)],
    solid_block[CAROM_MESH_BYTES(4, 4)], room[ROOM], snapshot[4096];
static struct carom_mesh meshes[2];
static struct carom_record record;
static struct carom_replay player;

/* Drops contacts of body 3, and makes those of body 2 slippery. */
static bool contact(void *user, struct carom_touch *touch)
{
    (void)user;
    touch->friction_q16 = touch->a == 2 || touch->b == 2 ? 0 : touch->friction_q16;
    return touch->a != 3 && touch->b != 3;
}

static struct carom_world *make_world(void)
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS),
                                  .gravity = {{0, 0, CAROM_GRAVITY_MM_S2(-9810, FPS)}},
                                  .sleep = true,
                                  .contact = contact};
    struct carom_body_def def = {&meshes[0], .stationary = true, .friction_q16 = 1 << 15};
    struct carom_world *world = NULL;

    CHECK_EQ(carom_surface_build(&meshes[0], &flat, ground_block, sizeof ground_block), CAROM_OK);
    CHECK_EQ(carom_mesh_build(&meshes[1], &solid, solid_block, sizeof solid_block), CAROM_OK);
    CHECK_EQ(carom_record_world_init(&record, block, sizeof block, &config, &world), CAROM_OK);
    CHECK_EQ(carom_record_body_add(&record, world, &def), 0);
    for (int i = 1; i <= 6; i++) {
        const struct carom_body_def body = {
            &meshes[1], .kinematic = i == 6,
            .position = {{CAROM_POSITION_MM(1500) * (i % 3), CAROM_POSITION_MM(1500) * (i / 3),
                          CAROM_POSITION_MM(900)}},
            .spin = {{CAROM_SPIN_MRAD_S(900, FPS) * i, 0, CAROM_SPIN_MRAD_S(300, FPS)}},
            .friction_q16 = 1 << 15};

        CHECK_EQ(carom_record_body_add(&record, world, &body), i);
    }
    return world;
}

/* Settings, made once. */
static void set_all(struct carom_world *w)
{
    static const carom_v3_q40 small = {{1 << 28, 1 << 27, 1 << 29}};
    static const carom_v3_q32 point = {{CAROM_POSITION_MM(1000), 0, CAROM_POSITION_MM(1000)}};
    static const struct carom_filter all = {.category = 2, .mask = 0xffff};
    const struct carom_material rough = {CAROM_ONE_Q30 / 4, 1 << 15, 1 << 11, {{0, 1 << 30, 0}}};
    struct carom_joint_def joint = {.kind = CAROM_JOINT_BALL, .a = 4, .b = 5};
    struct carom_body_state state;
    struct carom_record *r = &record;

    carom_body_get(w, 4, &state);
    joint.anchor = state.position;
    CHECK_EQ(carom_record_world_set_combine(r, w, CAROM_LARGER, CAROM_MEAN), CAROM_OK);
    CHECK_EQ(carom_record_body_set_filter(r, w, 1, &all), CAROM_OK);
    CHECK_EQ(carom_record_body_set_force(r, w, 1, &small), CAROM_OK);
    CHECK_EQ(carom_record_body_set_force_at(r, w, 2, &small, &point), CAROM_OK);
    CHECK_EQ(carom_record_body_set_torque(r, w, 1, &small), CAROM_OK);
    CHECK_EQ(carom_record_body_set_gravity_scale(r, w, 1, 3 << 15), CAROM_OK);
    CHECK_EQ(carom_record_body_set_damping(r, w, 1, 1 << 20, 1 << 21), CAROM_OK);
    CHECK_EQ(carom_record_body_set_material(r, w, 1, &rough), CAROM_OK);
    CHECK_EQ(carom_record_body_set_face_materials(r, w, 2, materials, 2, of_face), CAROM_OK);
    CHECK_EQ(carom_record_body_set_mass(r, w, 4, 1 << 20), CAROM_OK);
    CHECK_EQ(carom_record_joint_add(r, w, &joint), 0);
    joint.kind = CAROM_JOINT_DISTANCE;
    joint.drive =
        (struct carom_joint_drive){.limited = true, .upper_q32 = CAROM_POSITION_MM(1000) * 3};
    joint.anchor_b = joint.anchor;
    CHECK_EQ(carom_record_joint_add(r, w, &joint), 1);
    joint.drive.upper_q32 *= 2;
    CHECK_EQ(carom_record_joint_set(r, w, 1, &joint.drive), CAROM_OK);
    CHECK_LESS(carom_record_body_set_mass(r, w, 0, 1 << 20), 0); /* an error is recorded, too */
}

/* The calls before a frame, chosen by its number. */
static void act(struct carom_world *w, int frame, struct test_random *random)
{
    const carom_v3_q40 push = {{test_random_range(random, -(1 << 29), 1 << 29), 0, 1 << 30}};
    const carom_v3_q40 gravity = {{0, 1 << 20, CAROM_GRAVITY_MM_S2(-9000, FPS)}};
    const struct carom_pose pose = {
        .position = {{0, CAROM_POSITION_MM(3000 + 5 * frame), CAROM_POSITION_MM(900)}}};
    struct carom_record *r = &record;
    struct carom_body_state state;
    int bytes;

    CHECK_EQ(carom_record_body_move_to(r, w, 6, &pose), CAROM_OK);
    carom_body_get(w, 3, &state);
    switch (frame) {
    case 20:
        CHECK_EQ(carom_record_body_push(r, w, 3, &push, &state.position), CAROM_OK);
        CHECK_EQ(carom_record_body_push_centre(r, w, 2, &push), CAROM_OK);
        CHECK_EQ(carom_record_body_twist(r, w, 2, &push), CAROM_OK);
        break;
    case 30:
        state.position.c[2] += CAROM_POSITION_MM(1000);
        CHECK_EQ(carom_record_body_set(r, w, 3, &state), CAROM_OK);
        CHECK_EQ(carom_record_surface_move(r, w, 0, raised), CAROM_OK);
        CHECK_EQ(carom_record_world_set_gravity(r, w, &gravity), CAROM_OK);
        break;
    case 40:
        CHECK_EQ(carom_record_joint_remove(r, w, 1), CAROM_OK);
        CHECK_EQ(carom_record_body_remove(r, w, 5), CAROM_OK);
        CHECK_EQ(carom_record_surface_set(r, w, 0, raised), CAROM_OK);
        break;
    case 50:
        bytes = carom_snapshot_save(w, snapshot, sizeof snapshot);
        CHECK_MORE(bytes, 0);
        CHECK_EQ(carom_record_snapshot_load(r, w, snapshot, (size_t)bytes), CAROM_OK);
        break;
    default:
        break;
    }
}

/* Record a world that gets every kind of call; returns the hash of its last state. */
static uint64_t record_all(bool stages, uint64_t seed)
{
    struct test_random random = {seed};
    struct carom_world *world;

    file_bytes = 0;
    CHECK_EQ(carom_record_begin(&record, write_file, NULL, stages, "test"), CAROM_OK);
    world = make_world();
    set_all(world);
    for (int frame = 1; frame <= FRAMES; frame++) {
        act(world, frame, &random);
        CHECK_AT_LEAST(carom_record_world_step(&record, world), 0);
    }
    CHECK_EQ(carom_record_end(&record), CAROM_OK);
    return carom_world_hash(world);
}

static int play_in(size_t bytes, size_t memory)
{
    return play_file(&player, bytes, room, memory);
}

static int play(size_t bytes)
{
    return play_in(bytes, sizeof room);
}

static void test_same(void)
{
    for (uint64_t seed = 1; seed <= 4; seed++) {
        const uint64_t hash = record_all(seed % 2 == 0, seed);

        CHECK_EQ(play(file_bytes), CAROM_REPLAY_END);
        CHECK_EQ(player.frames, FRAMES);
        CHECK_EQ(carom_world_hash(player.world), hash);
        CHECK_EQ(player.note_bytes, 4);
        CHECK_EQ(memcmp(player.note, "test", 4), 0);
    }
}

/*
 * Files of users stay readable: the calls give the same bytes as ever, on every machine. Another
 * hash is another format, which needs another number in its head.
 */
static void test_format(void)
{
    uint64_t hash = FNV_START;

    file_bytes = 0;
    CHECK_EQ(carom_record_begin(&record, write_file, NULL, true, "test"), CAROM_OK);
    set_all(make_world());
    CHECK_EQ(carom_record_end(&record), CAROM_OK);
    for (size_t i = 0; i < file_bytes; i++) {
        hash = fnv_add(hash, file[i]);
    }
    CHECK_EQ(hash, 0xe7276e4a05c7be15u);
}

/* A file that ends early is played up to its end, or refused; no byte behind its end is read. */
static void test_cut(void)
{
    record_all(true, 1);
    for (size_t bytes = 0; bytes < file_bytes; bytes += NEXT(bytes)) {
        const int result = play(bytes);

        CHECK(result < 0 || result == CAROM_REPLAY_CUT);
        CHECK_AT_MOST(player.at, bytes);
    }
}

/* A changed byte anywhere is found. */
static void test_altered(void)
{
    record_all(true, 1);
    for (size_t at = 0; at < file_bytes; at += NEXT(at)) {
        const uint8_t flip = (uint8_t)(1 << at % 8);
        int result;

        file[at] ^= flip;
        result = play(file_bytes);
        CHECK(result < 0 || result == CAROM_REPLAY_DIFFERS || result == CAROM_REPLAY_CUT);
        file[at] ^= flip;
    }
    CHECK_EQ(play(file_bytes), CAROM_REPLAY_END);
}

/* A digest that differs is reported with its frame and its stage. */
static void test_named(void)
{
    const uint8_t check_bytes = 2 * CAROM_REPLAY_PARTS;

    for (int part = 0; part < CAROM_REPLAY_PARTS; part++) {
        struct carom_world *world;
        size_t end;

        file_bytes = 0;
        CHECK_EQ(carom_record_begin(&record, write_file, NULL, true, NULL), CAROM_OK);
        world = make_world();
        for (int frame = 1; frame <= 5; frame++) {
            CHECK_AT_LEAST(carom_record_world_step(&record, world), 0);
        }
        end = file_bytes; /* the last bytes are the check of frame 5 */
        CHECK_AT_LEAST(carom_record_world_step(&record, world), 0);
        file[end - check_bytes + 2 * (size_t)part] ^= 1;
        CHECK_EQ(play(file_bytes), CAROM_REPLAY_DIFFERS);
        CHECK_EQ(player.frames, 5);
        CHECK_EQ(player.difference, CAROM_REPLAY_IN_PART);
        CHECK_EQ(player.part, part);
    }
}

/*
 * A recording that begins in the middle of a world's life: earlier calls are included, and ids name
 * the same bodies.
 */
static void test_middle(void)
{
    static _Alignas(8) uint8_t mem[4096];
    static const carom_v3_q40 weak = {{1 << 20, 0, 0}};
    const struct carom_body_def again = {
        &meshes[1], .position = {{CAROM_POSITION_MM(-1500), 0, CAROM_POSITION_MM(900)}}};

    for (int from = 2; from <= FRAMES; from += BETWEEN) {
        struct test_random random = {1};
        struct carom_world *world;
        int id;

        memset(&record, 0, sizeof record);
        world = make_world();
        set_all(world);
        CHECK_EQ(carom_record_body_remove(&record, world, 1), CAROM_OK);
        CHECK_EQ(carom_record_body_add(&record, world, &again), 1);
        for (int frame = 1; frame <= FRAMES; frame++) {
            if (frame == from) {
                file_bytes = 0;
                CHECK_EQ(carom_record_world(&record, world, mem, sizeof mem), CAROM_ERR_ARGUMENT);
                CHECK_EQ(carom_record_begin(&record, write_file, NULL, from % (2 * BETWEEN) == 2,
                                            "middle"),
                         CAROM_OK);
                CHECK_EQ(carom_record_world(&record, world, mem, 16), CAROM_ERR_MEMORY);
                CHECK_EQ(carom_record_world(&record, NULL, mem, sizeof mem), CAROM_ERR_NULL);
                CHECK_EQ(carom_record_world(&record, world, mem, sizeof mem), CAROM_OK);
                CHECK_EQ(carom_record_world(&record, world, mem, sizeof mem), CAROM_ERR_ARGUMENT);
                id = carom_body_id(world, 1); /* id of the second body with that number */
                CHECK_MORE(id, 4096 + 1);
                CHECK_EQ(carom_record_body_set_torque(&record, world, id, &weak), CAROM_OK);
            }
            act(world, frame, &random);
            CHECK_AT_LEAST(carom_record_world_step(&record, world), 0);
        }
        CHECK_EQ(carom_record_end(&record), CAROM_OK);
        CHECK_EQ(play(file_bytes), CAROM_REPLAY_END);
        CHECK_EQ(player.frames, FRAMES - from + 1);
        CHECK_EQ(carom_world_hash(player.world), carom_world_hash(world));
    }
}

/* Calls of another world, and calls after the end, go through and are not written. */
static void test_others(void)
{
    struct carom_world *world;
    size_t bytes;

    record_all(false, 1);
    bytes = file_bytes;
    world = (struct carom_world *)block;
    CHECK_AT_LEAST(carom_record_world_step(&record, world), 0);
    CHECK_AT_LEAST(carom_record_world_step(NULL, world), 0);
    CHECK_EQ(carom_record_body_set(NULL, world, 1, NULL), CAROM_ERR_NULL);
    CHECK_EQ(file_bytes, bytes);
    CHECK_EQ(carom_record_begin(&record, NULL, NULL, false, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_replay_frame(NULL), CAROM_ERR_NULL);
}

/* What the plain call refuses for its pointers, the recorded call refuses, too; the recording goes on and is played to its end. */
static void test_null(void)
{
    const carom_v3_q40 v = {{1, 0, 0}};
    const carom_v3_q32 p = {{1, 0, 0}};
    const struct carom_body_def no_mesh = {.stationary = true};
    const struct carom_joint_def no_body = {.kind = CAROM_JOINT_BALL, .a = 99, .b = 1};
    struct carom_record *r = &record;
    struct carom_world *w;
    size_t bytes;

    file_bytes = 0;
    CHECK_EQ(carom_record_begin(r, write_file, NULL, false, NULL), CAROM_OK);
    w = make_world();
    CHECK_EQ(carom_record_body_set_material(r, w, 1, &materials[0]), CAROM_OK);
    bytes = file_bytes;
    CHECK_EQ(carom_record_body_add(r, w, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_record_body_add(r, w, &no_mesh), CAROM_ERR_NULL);
    CHECK_EQ(carom_record_joint_add(r, w, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_record_body_set_force_at(r, w, 1, NULL, &p), CAROM_ERR_NULL);
    CHECK_EQ(carom_record_body_set_force_at(r, w, 1, &v, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_record_body_push(r, w, 1, NULL, &p), CAROM_ERR_NULL);
    CHECK_EQ(carom_record_body_push(r, w, 1, &v, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_record_world_set_gravity(r, w, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_record_body_set_face_materials(r, w, 1, materials, 2, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_record_body_set_face_materials(r, w, 99, materials, 2, of_face), CAROM_ERR_BODY);
    CHECK_EQ(carom_record_body_set_face_materials(r, w, 1, materials, 0, of_face),
             CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_record_body_set_face_materials(r, w, 1, materials, 257, of_face),
             CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_record_surface_move(r, w, 0, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_record_snapshot_load(r, w, NULL, 0), CAROM_ERR_NULL);
    CHECK_EQ(file_bytes, bytes); /* none of these is written */
    CHECK_LESS(carom_record_surface_move(r, w, 99, raised), 0);
    CHECK_EQ(carom_record_joint_add(r, w, &no_body), CAROM_ERR_BODY);
    CHECK_EQ(carom_record_body_set_face_materials(r, w, 1, NULL, 0, NULL), CAROM_OK);
    CHECK_MORE(file_bytes, bytes); /* these are */
    CHECK_AT_LEAST(carom_record_world_step(r, w), 0);
    CHECK_EQ(carom_record_end(r), CAROM_OK);
    CHECK_EQ(play(file_bytes), CAROM_REPLAY_END);
    CHECK_EQ(player.frames, 1);
}

/* A recorder without a file, one that has its world, and no recorder at all: the world is made, and not recorded. */
static void test_unrecorded(void)
{
    static _Alignas(8) uint8_t other_block[CAROM_WORLD_BYTES(CAPS)];
    const struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
    struct carom_world *world, *other = NULL;
    size_t bytes;

    CHECK_EQ(carom_record_begin(NULL, write_file, NULL, false, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_record_end(NULL), CAROM_ERR_NULL);
    file_bytes = 0;
    CHECK_EQ(carom_record_begin(&record, write_file, NULL, false, NULL), CAROM_OK);
    world = make_world();
    bytes = file_bytes;
    CHECK_EQ(carom_record_world_init(&record, other_block, sizeof other_block, &config, &other),
             CAROM_OK);
    CHECK_AT_LEAST(carom_record_world_step(&record, other), 0);
    CHECK_EQ(carom_record_world_init(NULL, other_block, sizeof other_block, &config, &other),
             CAROM_OK);
    CHECK_EQ(carom_record_world_init(&record, block, 16, &config, &other), CAROM_ERR_MEMORY);
    CHECK_EQ(carom_record_world_init(&record, block, sizeof block, NULL, &other), CAROM_ERR_NULL);
    CHECK_EQ(carom_record_world_init(&record, block, sizeof block, &config, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_record_world_step(&record, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_record_world(NULL, world, other_block, sizeof other_block), CAROM_ERR_NULL);
    CHECK_EQ(carom_record_world(&record, world, NULL, 0), CAROM_ERR_NULL);
    CHECK_EQ(file_bytes, bytes);
}

/* A note is cut after 63 characters. */
static void test_note(void)
{
    char note[65];

    memset(note, 'n', sizeof note);
    note[64] = 0;
    for (int length = 62; length <= 64; length++) {
        note[length] = 0;
        file_bytes = 0;
        CHECK_EQ(carom_record_begin(&record, write_file, NULL, false, note), CAROM_OK);
        make_world();
        CHECK_EQ(carom_record_end(&record), CAROM_OK);
        CHECK_EQ(play(file_bytes), CAROM_REPLAY_END);
        CHECK_EQ(player.note_bytes, length < 63 ? length : 63);
        note[length] = 'n';
    }
}

/* Faces whose surfaces run are played: e and mu are in the callback's recorded answers, this is not. */
static void test_face_materials(void)
{
    const struct carom_material running[2] = {
        {.friction_q16 = 1 << 15, .surface_velocity = {{1 << 30, 1 << 29, 0}}},
        {.friction_q16 = 1 << 15, .surface_velocity = {{0, 1 << 30, 1 << 29}}}};
    uint64_t hash[2];

    for (int with = 0; with < 2; with++) {
        struct carom_world *world;

        file_bytes = 0;
        CHECK_EQ(carom_record_begin(&record, write_file, NULL, false, NULL), CAROM_OK);
        world = make_world();
        if (with) {
            CHECK_EQ(carom_record_body_set_face_materials(&record, world, 4, running, 2, of_face),
                     CAROM_OK);
        }
        for (int frame = 1; frame <= FRAMES; frame++) {
            CHECK_AT_LEAST(carom_record_world_step(&record, world), 0);
        }
        CHECK_EQ(carom_record_end(&record), CAROM_OK);
        hash[with] = carom_world_hash(world);
        CHECK_EQ(play(file_bytes), CAROM_REPLAY_END);
        CHECK_EQ(player.frames, FRAMES);
        CHECK_EQ(carom_world_hash(player.world), hash[with]);
    }
    CHECK_DIFFER(hash[0], hash[1]);
}

/* The player's own arguments, and the names that it gives. */
static void test_player(void)
{
    uint64_t digests[CAROM_REPLAY_PARTS];

    record_all(false, 1);
    CHECK_EQ(carom_replay_begin(NULL, file, file_bytes, room, sizeof room), CAROM_ERR_NULL);
    CHECK_EQ(carom_replay_begin(&player, NULL, file_bytes, room, sizeof room), CAROM_ERR_NULL);
    CHECK_EQ(carom_replay_begin(&player, file, file_bytes, NULL, 0), CAROM_ERR_NULL);
    CHECK_EQ(carom_replay_begin(&player, file, file_bytes, room + 4, 1000), CAROM_ERR_MEMORY);
    CHECK_EQ(carom_replay_digests(NULL, digests), CAROM_ERR_NULL);
    CHECK_EQ(carom_replay_digests((struct carom_world *)block, NULL), CAROM_ERR_NULL);
    CHECK_EQ(strcmp(carom_replay_call_name(0), "none"), 0);
    CHECK_EQ(strcmp(carom_replay_call_name(CAROM_CALL_world_init), "carom_world_init"), 0);
    CHECK_EQ(strcmp(carom_replay_call_name(CAROM_CALL_joint_set), "carom_joint_set"), 0);
    CHECK_EQ(strcmp(carom_replay_call_name(CAROM_CALL_COUNT), "unknown"), 0);
    CHECK_EQ(strcmp(carom_replay_call_name(-1), "unknown"), 0);
    CHECK_SAME(carom_replay_part_name(CAROM_REPLAY_BOYSE), carom_stage_name(CAROM_STAGE_BOYSE));
    CHECK_SAME(carom_replay_part_name(CAROM_REPLAY_STATE), carom_stage_name(CAROM_STAGE_COMMIT));
    CHECK_SAME(carom_replay_part_name(-1), carom_stage_name(-1));
    CHECK_SAME(carom_replay_part_name(CAROM_REPLAY_PARTS), carom_stage_name(-1));
}

/* However little memory the player has, it says so; with enough it plays to the end. */
static void test_room(void)
{
    bool enough = false;

    record_all(false, 1);
    for (size_t bytes = 0; bytes <= sizeof room; bytes += 64) {
        const int result = play_in(file_bytes, bytes);

        CHECK(result == CAROM_ERR_MEMORY || result == CAROM_REPLAY_END);
        CHECK(!enough || result == CAROM_REPLAY_END); /* more is never too little */
        enough = result == CAROM_REPLAY_END;
    }
    CHECK(enough);
}

const struct test tests_replay[] = {
    {"replay/same", test_same},
    {"replay/format", test_format},
    {"replay/cut", test_cut},
    {"replay/altered", test_altered},
    {"replay/named", test_named},
    {"replay/others", test_others},
    {"replay/middle", test_middle},
    {"replay/null", test_null},
    {"replay/unrecorded", test_unrecorded},
    {"replay/note", test_note},
    {"replay/player", test_player},
    {"replay/room", test_room},
    {"replay/face_materials", test_face_materials},
    {0},
};
