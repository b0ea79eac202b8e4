/* SPDX-License-Identifier: MIT */
/*
 * Recordings that no recorder writes, made byte by byte from the format in docs/replay.md: what comes too early, counts that do not
 * fit, bytes that mean nothing, memory that runs out anywhere.
 */
#include <string.h>

#include "carom_replay.h"
#include "lib/box.h"
#include "lib/test.h"
#include "lib/written.h"

#define CAPS  3, 4, 32, 64, 0, 64, 1, 2, 0
#define FACES 12
#define ROOM  100000

static const int16_t corners[8][3] = BOX_CORNERS(128, 128, 128); /* a side and a volume of 1 */
static const struct carom_mesh_raw cube = {corners, box_faces, 8, FACES, 8, CAROM_SOLID};

static _Alignas(8) uint8_t room[ROOM];
static struct carom_replay player;

static int play_in(size_t bytes)
{
    return play_file(&player, file_bytes, room, bytes);
}

/* ------------------------------------------------------------ files byte by byte */

static void put_header(void)
{
    file_bytes = 0;
    write_file(NULL, "CRPL", 4);
    put(1, 1); /* version */
    put(0, 2); /* no stages, no note */
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
        {0x3a},    /* of older recordings */
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

/* A byte that begins nothing is refused. */
static void test_unknown(void)
{
    for (int token = CAROM_CALL_COUNT; token < 0x3a; token++) {
        put_header();
        put_world();
        put((uint64_t)token, 1);
        CHECK_EQ(play_in(sizeof room), CAROM_ERR_FORMAT);
    }
}

/* A world with a body, and a call that succeeds. */
static void put_begin(void)
{
    put_header();
    put_mesh(&cube);
    put_world();
    put_body(1);
    put_gravity();
}

/* A step whose recorded state is wrong. */
static void put_step(void)
{
    put(CAROM_CALL_world_step, 1);
    put(0x3c, 1);
    put((carom_world_hash(player.world) ^ 1) & 0xffff, 2);
}

/* A call that returns another result than was recorded is the difference of its frame; the next frame has its own. */
static void test_results(void)
{
    put_begin();
    put(0x3f, 1);
    put_n(CAROM_ERR_RANGE);
    put_gravity();
    CHECK_EQ(play_in(sizeof room), CAROM_REPLAY_CUT);
    put_step();
    put_step();
    CHECK_EQ(carom_replay_begin(&player, file, file_bytes, room, sizeof room), CAROM_OK);
    CHECK_EQ(carom_replay_frame(&player), CAROM_REPLAY_DIFFERS);
    CHECK_EQ(player.difference, CAROM_REPLAY_IN_RESULT);
    CHECK_EQ(player.wanted, CAROM_ERR_RANGE);
    CHECK_EQ(player.found, CAROM_OK);
    CHECK_EQ(player.call, CAROM_CALL_world_set_gravity);
    CHECK_EQ(carom_replay_frame(&player), CAROM_REPLAY_DIFFERS);
    CHECK_EQ(player.difference, CAROM_REPLAY_IN_PART);
    CHECK_EQ(player.part, CAROM_REPLAY_STATE);
}

/* An answer to a question that nobody asks. */
static void test_answer(void)
{
    put_begin();
    put(0x3e, 1);
    put_n(1);
    put(1, 1); /* the contact stays */
    put_zeros(2);
    CHECK_EQ(play_in(sizeof room), CAROM_REPLAY_DIFFERS);
    CHECK_EQ(player.difference, CAROM_REPLAY_IN_ANSWER);
    CHECK_EQ(player.call, CAROM_CALL_world_set_gravity);
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
        put_mesh(&cube);
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

/* True is 1 and false is 0; other numbers are refused. */
static void test_truth(void)
{
    for (int still = -1; still <= 3; still++) {
        put_header();
        put_mesh(&cube);
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
    put_mesh(&cube);
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

/* Moves of a surface take memory once, however many there are. */
static void test_surface_again(void)
{
    size_t needed[2] = {0, 0};

    for (int more = 0; more < 2; more++) {
        put_header();
        put_mesh(&cube);
        put_world();
        put_body(1);
        for (int n = 0; n < (more ? 9 : 1); n++) {
            put(CAROM_CALL_surface_move, 1);
            put_n(0);
            put_n(8);
            for (int i = 0; i < 3 * 8; i++) {
                put((uint16_t)corners[i / 3][i % 3], 2);
            }
            put(0x3f, 1);
            put_n(CAROM_ERR_ARGUMENT); /* a solid does not move so */
        }
        while (play_in(needed[more]) == CAROM_ERR_MEMORY && needed[more] < sizeof room) {
            needed[more] += 8;
        }
        CHECK_EQ(play_in(needed[more]), CAROM_REPLAY_CUT);
    }
    CHECK_EQ(needed[0], needed[1]);
}

/* Memory may run out at each thing that takes some: the four parts of a mesh, the world, materials and their numbers. */
static void test_memory(void)
{
    size_t needed = 0;

    put_header();
    put_mesh(&cube);
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

const struct test tests_replay_made[] = {
    {"replay_made/early", test_early},
    {"replay_made/materials", test_materials},
    {"replay_made/truth", test_truth},
    {"replay_made/surface", test_surface},
    {"replay_made/surface_again", test_surface_again},
    {"replay_made/unknown", test_unknown},
    {"replay_made/results", test_results},
    {"replay_made/answer", test_answer},
    {"replay_made/memory", test_memory},
    {0},
};
