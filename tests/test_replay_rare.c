/* SPDX-License-Identifier: MIT */
/* Recordings that are rare: long runs, a world made twice, materials by the hundred, meshes that are almost the same. */
#include <string.h>

#include "carom_replay.h"
#include "lib/box.h"
#include "lib/test.h"
#include "lib/written.h"

#define CAPS      3, 4, 32, 64, 0, 64, 1, 2, 0
#define MORE_CAPS 5, 8, 64, 128, 0, 64, 0, 4, 0
#define FACES     12
#define ROOM      100000

static const int16_t corners[8][3] = BOX_CORNERS(128, 128, 128); /* a side and a volume of 1 */
static const struct carom_mesh_raw cube = {corners, box_faces, 8, FACES, 8, CAROM_SOLID};

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(MORE_CAPS)],
    mesh_block[CAROM_MESH_BYTES(8, 12)], room[ROOM], memory[4096];
static struct carom_mesh mesh;
static struct carom_record record;
static struct carom_replay player;

static struct carom_world *begin(const struct carom_config *config)
{
    struct carom_world *world = NULL;

    CHECK_EQ(carom_mesh_build(&mesh, &cube, mesh_block, sizeof mesh_block), CAROM_OK);
    CHECK_EQ(carom_record_world_init(&record, block, sizeof block, config, &world), CAROM_OK);
    return world;
}

static const struct carom_config plain = {.caps = CAROM_CAPS(CAPS),
                                          .gravity = {{0, 0, CAROM_GRAVITY_MM_S2(-9810, 60)}}};

/* A still cube, and one that lies a unit and a half above it, which falls on it within 30 frames. */
static void add_bodies(struct carom_world *world, uint32_t mass_q20)
{
    const struct carom_body_def still = {&mesh, .stationary = true};
    const struct carom_body_def falls = {&mesh, .mass_q20 = mass_q20,
                                         .position = {{0, 0, CAROM_POSITION_MM(1500)}}};

    CHECK_EQ(carom_record_body_add(&record, world, &still), 0);
    CHECK_EQ(carom_record_body_add(&record, world, &falls), 1);
}

static void record_begin(void)
{
    file_bytes = 0;
    CHECK_EQ(carom_record_begin(&record, write_file, NULL, false, NULL), CAROM_OK);
}

static void record_steps(struct carom_world *world, int frames)
{
    for (int i = 0; i < frames; i++) {
        CHECK_AT_LEAST(carom_record_world_step(&record, world), 0);
    }
}

/* End the recording, and play it; its last state has the world's hash. */
static uint64_t play_recorded(struct carom_world *world, uint32_t frames)
{
    const uint64_t hash = carom_world_hash(world);

    CHECK_EQ(carom_record_end(&record), CAROM_OK);
    CHECK_EQ(play_file(&player, file_bytes, room, sizeof room), CAROM_REPLAY_END);
    CHECK_EQ(player.frames, frames);
    CHECK_EQ(carom_world_hash(player.world), hash);
    return hash;
}

/* A call made 301 times: once in full, once by its slot, and 299 times in runs of at most 128, a byte each. */
static void test_run(void)
{
    const carom_v3_q40 twist = {{1 << 20, 0, 0}};
    struct carom_world *world;
    size_t before, full;

    record_begin();
    world = begin(&plain);
    add_bodies(world, 0);
    before = file_bytes;
    CHECK_EQ(carom_record_body_twist(&record, world, 1, &twist), CAROM_OK);
    full = file_bytes - before;
    for (int i = 0; i < 300; i++) {
        CHECK_EQ(carom_record_body_twist(&record, world, 1, &twist), CAROM_OK);
    }
    CHECK_EQ(file_bytes - before, full + 1 + 2); /* the last run is not over */
    CHECK_EQ(file[file_bytes - 1], 0xff);
    before = file_bytes;
    record_steps(world, 1);
    CHECK_EQ(file[before], 0x80 + (299 - 2 * 128) - 1);
    play_recorded(world, 1);
}

/* A world is made again in its place, for more bodies: a player needs a larger block. */
static void test_twice(void)
{
    struct carom_config more = plain;
    struct carom_world *world;

    record_begin();
    world = begin(&plain);
    add_bodies(world, 0);
    record_steps(world, 2);
    more.caps = (struct carom_caps)CAROM_CAPS(MORE_CAPS);
    world = begin(&more);
    add_bodies(world, 0);
    record_steps(world, 30);
    play_recorded(world, 32);
}

/* Twice the mass that the mesh has: the mantissa is that of the volume, and only the exponent differs. */
static void test_mass(void)
{
    const carom_v3_q40 push = {{1 << 30, 0, 0}};
    uint64_t hash[2];

    for (uint32_t mass = 1; mass <= 2; mass++) {
        struct carom_world *world;
        struct carom_body_state s;

        memset(&record, 0, sizeof record);
        world = begin(&plain);
        add_bodies(world, mass << 20);
        record_begin();
        CHECK_EQ(carom_record_world(&record, world, memory, sizeof memory), CAROM_OK);
        CHECK_EQ(carom_record_body_push_centre(&record, world, 1, &push), CAROM_OK);
        record_steps(world, 10);
        hash[mass - 1] = play_recorded(world, 10);
        CHECK_EQ(carom_body_get(player.world, 1, &s), CAROM_OK);
        CHECK_EQ(s.velocity.c[0], push.c[0] / mass);
    }
    CHECK_DIFFER(hash[0], hash[1]);
}

/* 256 materials, and a face has the last of them: a recording from the middle has no room for one more. */
static void test_all_materials(void)
{
    static struct carom_material materials[256];
    static const uint8_t of_face[FACES] = {255, 255, 255, 255, 255, 255,
                                           255, 255, 255, 255, 255, 255};
    struct carom_body_state s;
    size_t before;

    for (int bouncy = 0; bouncy < 2; bouncy++) {
        struct carom_world *world;

        memset(&record, 0, sizeof record);
        materials[255].restitution_q30 = bouncy * CAROM_ONE_Q30;
        world = begin(&plain);
        add_bodies(world, 0);
        for (int body = 0; body < 2; body++) {
            CHECK_EQ(carom_body_set_face_materials(world, body, materials, 256, of_face), CAROM_OK);
        }
        record_begin();
        CHECK_EQ(carom_record_world(&record, world, memory, sizeof memory), CAROM_OK);
        before = file_bytes;
        CHECK_EQ(carom_record_body_set_face_materials(&record, world, 0, materials, 256, of_face),
                 CAROM_OK);
        CHECK_MORE(file_bytes, before + 256); /* it is recorded, with all materials */
        record_steps(world, 30);
        play_recorded(world, 30);
        CHECK_EQ(carom_body_get(player.world, 1, &s), CAROM_OK);
        CHECK_EQ(s.velocity.c[2] > 1 << 30, bouncy); /* it fell for 20 frames, and flies up again */
    }
}

/* A body is set into another one: what is to happen then is recorded, too. */
static void test_overlaps(void)
{
    const int results[] = {CAROM_ERR_OVERLAP, CAROM_OK, CAROM_OK};
    const struct carom_body_state into = {.position = {{0, 0, CAROM_POSITION_MM(700)}}};

    for (uint8_t overlap = CAROM_OVERLAP_REFUSE; overlap <= CAROM_OVERLAP_PASS; overlap++) {
        struct carom_body_state s = into;
        struct carom_world *world;

        record_begin();
        world = begin(&plain);
        add_bodies(world, 0);
        s.overlap = overlap;
        CHECK_EQ(carom_record_body_set(&record, world, 1, &s), results[overlap]);
        record_steps(world, 5);
        play_recorded(world, 5);
    }
}

/* Two meshes of the same corners, in which a square is cut along one or the other diagonal, are two; each is written once. */
static void test_meshes(void)
{
    static uint16_t other_faces[FACES][3];
    static _Alignas(8) uint8_t other_block[CAROM_MESH_BYTES(8, FACES)];
    struct carom_mesh_raw other_cube = cube;
    struct carom_mesh other;
    struct carom_world *world;

    memcpy(other_faces, box_faces, sizeof other_faces);
    CHECK_EQ(box_faces[0][0], box_faces[1][0]); /* a b c and a c d become a b d and b c d */
    CHECK_EQ(box_faces[0][2], box_faces[1][1]);
    other_faces[0][2] = box_faces[1][2];
    other_faces[1][0] = box_faces[0][1];
    other_cube.faces = (const uint16_t(*)[3])other_faces;
    record_begin();
    world = begin(&plain);
    CHECK_EQ(carom_mesh_build(&other, &other_cube, other_block, sizeof other_block), CAROM_OK);
    for (int i = 0; i < 3; i++) {
        const struct carom_body_def still = {i % 2 ? &other : &mesh, .stationary = true};
        const size_t before = file_bytes;

        CHECK_EQ(carom_record_body_add(&record, world, &still), i);
        CHECK_EQ(file_bytes - before > 6 * (8 + FACES), i < 2);
    }
    play_recorded(world, 0);
}

/* A body that bounces falls on one that does not: the rule by which they mix is in a recording from the middle, too. */
static void test_rules(void)
{
    uint64_t hash[4];

    for (int rule = 0; rule < 4; rule++) {
        struct carom_material bouncy = {.restitution_q30 = CAROM_ONE_Q30};
        struct carom_world *world;

        memset(&record, 0, sizeof record);
        world = begin(&plain);
        add_bodies(world, 0);
        CHECK_EQ(carom_world_set_combine(world, (enum carom_combine)rule, (enum carom_combine)rule),
                 CAROM_OK);
        CHECK_EQ(carom_body_set_material(world, 1, &bouncy), CAROM_OK);
        record_begin();
        CHECK_EQ(carom_record_world(&record, world, memory, sizeof memory), CAROM_OK);
        record_steps(world, 40);
        hash[rule] = play_recorded(world, 40);
    }
    CHECK_DIFFER(hash[CAROM_SMALLER], hash[CAROM_LARGER]);
    CHECK_DIFFER(hash[CAROM_LARGER], hash[CAROM_MEAN]);
}

/*
 * A player has nothing that a world kept from frames before the recording, and the digests of its stages
 * are the same: so the world has forgotten what it kept, of its first body and of its last.
 */
static void test_forgets(void)
{
    const struct carom_body_def falls = {
        &mesh, .position = {{CAROM_POSITION_MM(400), 0, CAROM_POSITION_MM(1100)}},
        .spin = {{0, CAROM_SPIN_MRAD_S(900, 60), CAROM_SPIN_MRAD_S(500, 60)}}};
    const struct carom_body_def still = {&mesh, .stationary = true};

    for (int frames = 1; frames < 40; frames += 3) {
        for (int first = 0; first < 2; first++) {
            struct carom_world *world;

            memset(&record, 0, sizeof record);
            world = begin(&plain);
            CHECK_EQ(carom_body_add(world, first ? &still : &falls), 0);
            CHECK_EQ(carom_body_add(world, first ? &falls : &still), 1);
            record_steps(world, frames);
            file_bytes = 0;
            CHECK_EQ(carom_record_begin(&record, write_file, NULL, true, NULL), CAROM_OK);
            CHECK_EQ(carom_record_world(&record, world, memory, sizeof memory), CAROM_OK);
            record_steps(world, 30);
            play_recorded(world, 30);
        }
    }
}

#if SIZE_MAX > UINT32_MAX
/* More bytes than a recording can hold are no snapshot, and are not written. */
static void test_too_many(void)
{
    struct carom_world *world;
    size_t before;
    int bytes;

    record_begin();
    world = begin(&plain);
    add_bodies(world, 0);
    bytes = carom_snapshot_save(world, memory, sizeof memory);
    CHECK_MORE(bytes, 0);
    before = file_bytes;
    CHECK_EQ(carom_record_snapshot_load(&record, world, memory, (size_t)bytes + UINT32_MAX + 1),
             CAROM_ERR_FORMAT);
    CHECK_EQ(file_bytes, before);
    record_steps(world, 1);
    play_recorded(world, 1);
}
#endif

/*
 * A sensor was put around a cube that sleeps just before a recording begins: the first step reports the cube, here and when it is
 * played, with the same digests of its stages.
 */
static void test_sensor(void)
{
    struct carom_config sleepy = plain;
    struct carom_body_def around = {&mesh, .stationary = true, .sensor = true,
                                    .position = {{0, 0, CAROM_POSITION_MM(1300)}}};
    const struct carom_event *events;
    struct carom_body_state state;
    struct carom_world *world;

    memset(&record, 0, sizeof record);
    sleepy.sleep = true;
    world = begin(&sleepy);
    add_bodies(world, 0);
    record_steps(world, 120);
    CHECK_EQ(carom_body_get(world, 1, &state), CAROM_OK);
    CHECK(state.asleep);
    CHECK_EQ(carom_body_add(world, &around), 2);
    file_bytes = 0;
    CHECK_EQ(carom_record_begin(&record, write_file, NULL, true, NULL), CAROM_OK);
    CHECK_EQ(carom_record_world(&record, world, memory, sizeof memory), CAROM_OK);
    record_steps(world, 2);
    CHECK_EQ(carom_record_end(&record), CAROM_OK);
    CHECK_EQ(carom_replay_begin(&player, file, file_bytes, room, sizeof room), CAROM_OK);
    CHECK_EQ(carom_replay_frame(&player), CAROM_REPLAY_FRAME);
    CHECK_EQ(carom_events(player.world, &events), 1);
    CHECK_EQ(events[0].kind, CAROM_EVENT_SENSOR_BEGIN);
    CHECK_EQ(events[0].a, 2);
    CHECK_EQ(events[0].b, 1);
    CHECK_EQ(carom_replay_frame(&player), CAROM_REPLAY_FRAME);
    CHECK_EQ(carom_events(player.world, &events), 0);
    CHECK_EQ(carom_replay_frame(&player), CAROM_REPLAY_END);
}

const struct test tests_replay_rare[] = {
    {"replay_rare/run", test_run},
    {"replay_rare/twice", test_twice},
    {"replay_rare/mass", test_mass},
    {"replay_rare/sensor", test_sensor},
    {"replay_rare/all_materials", test_all_materials},
    {"replay_rare/overlaps", test_overlaps},
    {"replay_rare/meshes", test_meshes},
    {"replay_rare/rules", test_rules},
    {"replay_rare/forgets", test_forgets},
#if SIZE_MAX > UINT32_MAX
    {"replay_rare/too_many", test_too_many},
#endif
    {0},
};
