/* SPDX-License-Identifier: MIT */
/*
 * Recordings that no recorder writes, made byte by byte from the format in docs/replay.md: what comes too early, counts that do not
 * fit, memory that runs out anywhere. And calls that recorders see seldom: long runs, a world made twice, materials by the hundred.
 */
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

/* Play the file in so much memory; returns the result it ends with. */
static int play_in(size_t bytes)
{
    int result = carom_replay_begin(&player, file, file_bytes, room, bytes);

    while (result == CAROM_OK || result == CAROM_REPLAY_FRAME) {
        result = carom_replay_frame(&player);
        if (result == CAROM_REPLAY_END) {
            break;
        }
    }
    return result;
}

/* ------------------------------------------------------------ files byte by byte */

static void put(uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        const uint8_t byte = (uint8_t)(value >> 8 * i);

        write_file(NULL, &byte, 1);
    }
}

/* An `n` of the format. */
static void put_n(int64_t v)
{
    uint64_t left = v < 0 ? ~((uint64_t)v * 2) : (uint64_t)v * 2;

    for (; left > 0x7f; left >>= 7) {
        put(left % 0x80 + 0x80, 1);
    }
    put(left, 1);
}

static void put_zeros(int count)
{
    for (int i = 0; i < count; i++) {
        put_n(0);
    }
}

static void put_header(void)
{
    file_bytes = 0;
    write_file(NULL, "CRPL", 4);
    put(1, 1); /* version */
    put(0, 2); /* no stages, no note */
}

static void put_mesh(void)
{
    put(0x3d, 1);
    put(0, 1); /* it does not move */
    put(CAROM_SOLID, 1);
    put(8, 1);
    put(8, 4);
    put(FACES, 4);
    for (int i = 0; i < 3 * 8; i++) {
        put((uint16_t)corners[i / 3][i % 3], 2);
    }
    for (int i = 0; i < 3 * FACES; i++) {
        put(box_faces[i / 3][i % 3], 2);
    }
}

static void put_world(void)
{
    static const int caps[] = {CAPS};

    put(CAROM_CALL_world_init, 1);
    for (int i = 0; i < 9; i++) {
        put_n(caps[i]);
    }
    put_zeros(3 + 4); /* gravity; sleep, two bounds, and nobody is asked about contacts */
}

/* Body 0 of mesh 0; `still` is 1 or 0 in a file that means something. */
static void put_body(int still)
{
    put(CAROM_CALL_body_add, 1);
    put_zeros(2); /* no body is meant; the mesh */
    put_n(still);
    put_zeros(1 + 3 + 4 + 3 + 3 + 3 + 3 + 3);
}

/* Materials by face, all of them zeros, and numbers of materials. */
static void put_materials(int body, int faces, int count)
{
    put(CAROM_CALL_body_set_face_materials, 1);
    put_n(body);
    put_n(faces);
    put_n(count);
    put_zeros(6 * count);
    for (int i = 0; i < faces; i++) {
        put(0, 1);
    }
}

/* A call that always succeeds; if the call before it returned something else than was recorded, the player has noticed by then. */
static void put_gravity(void)
{
    put(CAROM_CALL_world_set_gravity, 1);
    put_zeros(4);
}

/* A file that was right so far ends without its end, and nothing differed. */
static void check_right(void)
{
    CHECK_EQ(play_in(sizeof room), CAROM_REPLAY_CUT);
    CHECK_EQ(player.at, file_bytes);
    CHECK_EQ(player.difference, CAROM_REPLAY_SAME);
}

/* Whatever needs a world is refused before there is one, and is read after. */
static void test_early(void)
{
    static const uint8_t early[][3] = {
        {0x3a},    /* sleeping bodies look for sensors */
        {0x3b, 0}, /* no joint in a place */
        {CAROM_CALL_world_set_combine, 0, 0},
        {CAROM_CALL_body_set_face_materials, 0, 0},
        {CAROM_CALL_surface_move, 0, 0},
        {CAROM_CALL_snapshot_load, 0, 0},
    };
    static const size_t sizes[] = {1, 2, 4, 4, 3, 3};

    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        uint8_t bytes[4] = {0};

        memcpy(bytes, early[i], sizeof early[i]);
        put_header();
        write_file(NULL, bytes, sizes[i]);
        CHECK_EQ(play_in(sizeof room), CAROM_ERR_FORMAT);
        put_header();
        put_world();
        write_file(NULL, bytes, sizes[i]);
        CHECK_EQ(play_in(sizeof room), CAROM_REPLAY_CUT);
        CHECK_EQ(player.at, file_bytes);
    }
}

/* Counts of materials that do not fit the body, or no world, are refused. */
static void test_materials(void)
{
    static const struct {
        int body, faces, count;
        bool right;
    } cases[] = {{0, FACES, 1, true},      {0, FACES, 256, true},    {0, 0, 0, true},
                 {0, FACES, 257, false},   {0, FACES, 0, false},     {0, 0, 1, false},
                 {0, FACES - 1, 1, false}, {0, FACES + 1, 1, false}, {1, FACES, 1, false}};

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        put_header();
        put_mesh();
        put_world();
        put_body(1);
        put_materials(cases[i].body, cases[i].faces, cases[i].count);
        put_gravity();
        if (cases[i].right) {
            check_right();
        } else {
            CHECK_EQ(play_in(sizeof room), CAROM_ERR_FORMAT);
        }
    }
}

/* What is true or false is 1 or 0; other numbers are refused. */
static void test_truth(void)
{
    for (int still = -1; still <= 3; still++) {
        put_header();
        put_mesh();
        put_world();
        put_body(still);
        put_gravity();
        if (still == 0 || still == 1) {
            check_right();
        } else {
            CHECK_EQ(play_in(sizeof room), CAROM_ERR_FORMAT);
        }
    }
}

/* Vertices of a surface may be the last bytes of a file, which is refused if one of them is missing. */
static void test_surface(void)
{
    put_header();
    put_mesh();
    put_world();
    put_body(1);
    put(CAROM_CALL_surface_move, 1);
    put_zeros(1);
    put_n(8);
    for (int i = 0; i < 3 * 8; i++) {
        put((uint16_t)corners[i / 3][i % 3], 2);
    }
    check_right();
    file_bytes--;
    CHECK_EQ(play_in(sizeof room), CAROM_ERR_FORMAT);
}

/* Memory may run out at each thing that takes some: the four parts of a mesh, the world, materials and their numbers. */
static void test_memory(void)
{
    size_t needed = 0;

    put_header();
    put_mesh();
    put_world();
    put_body(1);
    put_materials(0, FACES, 2);
    put_gravity();
    check_right();
    while (play_in(needed) == CAROM_ERR_MEMORY && needed < sizeof room) {
        needed += 8;
    }
    CHECK_MORE(needed, CAROM_MESH_BYTES(8, FACES) + 6 * (8 + FACES) + CAROM_WORLD_BYTES(CAPS));
    CHECK_LESS(needed, sizeof room);
    CHECK_EQ(play_in(needed), CAROM_REPLAY_CUT);
}

/* ------------------------------------------------------------- recorded, but rare */

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
    CHECK_EQ(play_in(sizeof room), CAROM_REPLAY_END);
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

const struct test tests_replay_made[] = {
    {"replay_made/early", test_early},
    {"replay_made/materials", test_materials},
    {"replay_made/truth", test_truth},
    {"replay_made/surface", test_surface},
    {"replay_made/memory", test_memory},
    {"replay_made/run", test_run},
    {"replay_made/twice", test_twice},
    {"replay_made/mass", test_mass},
    {"replay_made/all_materials", test_all_materials},
    {"replay_made/forgets", test_forgets},
#if SIZE_MAX > UINT32_MAX
    {"replay_made/too_many", test_too_many},
#endif
    {0},
};
