/* SPDX-License-Identifier: MIT */
/*
 * Bodies on a surface that the caller moves. They ride up, down and aside; the surface lifts them
 * out of itself, with the bodies on top of them; they wake and sleep with it. Both sources of its
 * z-lists give the same hashes, and a refused move changes nothing.
 */
#include <string.h>

#include "lib/one_world.h"
#include "lib/shapes.h"
#include "world/world.h"

#define CAPS(entries) 6, 12, 64, 256, entries, 512
#define MOST          512
#define SIDE          8
#define COUNT         ((SIDE + 1) * (SIDE + 1))
#define FACES         (2 * SIDE * SIDE)
#define HALF          CAROM_RATIO(1, 4, 32) /* half of the box's height */
#define FLOOR         0
#define BOX           1
/* 2^-12 of a unit in q32, q40 */
#define QUANTUM_Q32 ((int64_t)1 << 20)
#define QUANTUM_Q40 ((int64_t)1 << 28)

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS(MOST))];
static _Alignas(8) uint8_t surface_block[CAROM_SURFACE_BYTES(COUNT, FACES)];
static struct carom_mesh surface;
static struct shape flat, box;
static int16_t at[COUNT][3];
static struct carom_body_def box_def;

static int move(void)
{
    return carom_surface_move(world, FLOOR, (const int16_t(*)[3])at);
}

static int put(void)
{
    return carom_surface_set(world, FLOOR, (const int16_t(*)[3])at);
}

/* A flat surface of 8 x 8 units, and above it a falling box of 1 x 0.75 x 0.5. */
static void begin(uint32_t entries, int32_t e_q30, uint32_t mu_q16)
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS(entries)), .sleep = true};
    struct carom_body_def def;

    shape_plane(&flat, 12, SIDE, 4096);
    shape_box(&box, 12, 4096, 3072, 2048);
    memcpy(at, flat.vertices, sizeof at);
    CHECK_EQ(carom_surface_build(&surface, &flat.raw, surface_block, sizeof surface_block),
             CAROM_OK);
    config.gravity.c[2] = CAROM_GRAVITY_MM_S2(-9810, 60);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    memset(&def, 0, sizeof def);
    def.mesh = &surface;
    def.stationary = true;
    def.restitution_q30 = e_q30;
    def.friction_q16 = mu_q16;
    CHECK_EQ(carom_body_add(world, &def), FLOOR);
    def.mesh = &box.mesh;
    def.stationary = false;
    def.position.c[2] = CAROM_RATIO(26, 100, 32);
    box_def = def;
    CHECK_EQ(carom_body_add(world, &def), BOX);
}

static void settle(void)
{
    int frame = 0;

    while (frame++ < 200 && !state_of(BOX).asleep) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
    CHECK(state_of(BOX).asleep);
}

/* A triangle wave: 0 1 2 .. n .. 1 0 .. -n .. 0, a period of 4 n. */
static int32_t triangle(int32_t phase, int32_t n)
{
    int32_t p = ((phase % (4 * n)) + 4 * n) % (4 * n);

    return p < n ? p : p < 3 * n ? 2 * n - p : p - 4 * n;
}

/* Waves of parabolas run over it: about a tenth of a unit high, with steps of acceleration. */
static void wave(int frame)
{
    for (int v = 0; v < COUNT; v++) {
        int32_t x = triangle(5 * frame + 16 * (v % (SIDE + 1)), 64);
        int32_t y = triangle(4 * frame - 11 * (v / (SIDE + 1)), 64);

        at[v][2] = (int16_t)((x * (128 - carom_abs(x)) + y * (128 - carom_abs(y))) / 10);
    }
}

/* ------------------------------------------------------------------ two sources */

#define FRAMES 90

static void run_waves(uint32_t entries, bool own_lists, uint64_t hashes[FRAMES])
{
    /* as carom_surface_build makes it, without the lists */
    static const struct mesh_moving keeps_lists = {
        mesh_drift_vertex, mesh_drift_edge, mesh_drift_face, NULL, NULL, NULL};

    begin(entries, CAROM_ONE_Q30 / 4, 1 << 15);
    if (own_lists) {
        surface.surface->does = &keeps_lists;
    }
    for (int frame = 0; frame < FRAMES; frame++) {
        wave(frame);
        CHECK_EQ(move(), CAROM_OK);
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        hashes[frame] = carom_world_hash(world);
    }
    CHECK_MORE(state_of(BOX).position.c[2], 0);
}

/* Lists in the surface's block, from a pool with room, and in chunks down to a single entry. */
static void test_sources(void)
{
    static const uint32_t short_of[] = {1, 5, 12};
    static uint64_t wanted[FRAMES], found[FRAMES];
    struct carom_usage usage[CAROM_POOL_COUNT];

    run_waves(MOST, true, wanted);
    CHECK_EQ(carom_usage(world, usage), CAROM_OK);
    CHECK_EQ(usage[CAROM_POOL_entries].peak, 0);
    run_waves(MOST, false, found);
    CHECK_EQ(memcmp(wanted, found, sizeof wanted), 0);
    CHECK_EQ(carom_usage(world, usage), CAROM_OK);
    CHECK_MORE(usage[CAROM_POOL_entries].peak, 12);
    CHECK_EQ(usage[CAROM_POOL_entries].refused, 0);
    for (int i = 0; i < 3; i++) {
        run_waves(short_of[i], false, found);
        CHECK_EQ(memcmp(wanted, found, sizeof wanted), 0);
        CHECK_EQ(carom_usage(world, usage), CAROM_OK);
        CHECK_MORE(usage[CAROM_POOL_entries].refused, 0);
    }
}

/*
 * While the surface stands still it is like a rigid mesh, except for its own entry in the snapshot.
 */
static void test_rigid(void)
{
    static uint8_t wanted[2048], found[2048];
    struct carom_body_def def;
    int size;

    for (int rigid = 0; rigid < 2; rigid++) {
        begin(MOST, CAROM_ONE_Q30 / 2, 1 << 15);
        for (int frame = 0; frame < 30; frame++) {
            CHECK_EQ(carom_world_step(world), CAROM_OK);
        }
        size = carom_snapshot_save(world, rigid ? found : wanted, sizeof wanted);
        if (!rigid) {
            continue;
        }
        begin(MOST, CAROM_ONE_Q30 / 2, 1 << 15);
        CHECK_EQ(carom_body_remove(world, FLOOR), CAROM_OK);
        def = box_def;
        def.mesh = &flat.mesh;
        def.stationary = true;
        def.position.c[2] = 0;
        CHECK_EQ(carom_body_add(world, &def), FLOOR);
        for (int frame = 0; frame < 30; frame++) {
            CHECK_EQ(carom_world_step(world), CAROM_OK);
        }
        CHECK_EQ(carom_snapshot_save(world, found, sizeof found), size - 8);
        CHECK_EQ(memcmp(wanted, found, (size_t)size - 16), 0);
    }
}

/* ------------------------------------------------------------------- carrying */

/*
 * Up and down by a parabola, accelerated by 1/3 of gravity at most. The box stays within about a
 * skin of where the surface is now or will be a frame later.
 */
static void test_lift(void)
{
    int32_t before = 0;
    int64_t skin;

    begin(MOST, 0, 1 << 15);
    skin = (int64_t)box.mesh.radius_q22 << 10 >> 11;
    settle();
    for (int frame = 1; frame <= 400; frame++) {
        int32_t phase = triangle(frame, 64), height = phase * (128 - (int32_t)carom_abs(phase)) / 4;
        struct carom_body_state s;
        int64_t above_q32;

        for (int v = 0; v < COUNT; v++) {
            at[v][2] = (int16_t)height;
        }
        CHECK_EQ(move(), CAROM_OK);
        CHECK(!state_of(BOX).asleep);
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        s = state_of(BOX);
        above_q32 = s.position.c[2] - HALF - height * QUANTUM_Q32;
        CHECK_MORE(above_q32, 0);
        CHECK_LESS(above_q32, 3 * skin + (height > before ? height - before : 0) * QUANTUM_Q32);
        /* 2 quanta: the change of its speed in a frame, plus what opens skins */
        CHECK_NEAR(s.velocity.c[2], (height - before) * QUANTUM_Q40, 5 * QUANTUM_Q40);
        CHECK_LESS(carom_abs(s.position.c[0]) + carom_abs(s.position.c[1]), 24 * QUANTUM_Q32);
        before = height;
    }
    settle();
    CHECK_EQ(put(), CAROM_OK);
    CHECK(state_of(BOX).asleep); /* nothing moved */
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK(state_of(BOX).asleep);
    at[0][2]++; /* a corner far away moves, but the box lies on this surface */
    CHECK_EQ(move(), CAROM_OK);
    CHECK(!state_of(BOX).asleep);
    settle();
}

/* Sideways at a speed: friction takes the box along, and no farther. */
static void test_aside(void)
{
    begin(MOST, 0, 1 << 15);
    settle();
    for (int frame = 0; frame < 60; frame++) {
        for (int v = 0; v < COUNT; v++) {
            at[v][0] = (int16_t)(at[v][0] + 20);
            at[v][1] = (int16_t)(at[v][1] - 10);
        }
        CHECK_EQ(move(), CAROM_OK);
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
    /* g mu is 5.6 quanta a frame: 22.4 after four frames */
    CHECK_NEAR(state_of(BOX).velocity.c[0], 20 * QUANTUM_Q40, QUANTUM_Q40 / 16);
    CHECK_NEAR(state_of(BOX).velocity.c[1], -10 * QUANTUM_Q40, QUANTUM_Q40 / 16);
    CHECK_NEAR(state_of(BOX).position.c[0], 60 * 20 * QUANTUM_Q32, 60 * QUANTUM_Q32);
}

/*
 * A jump by more than the box's height: the box is on top, thrown up by the way of a frame and no
 * more.
 */
static void test_jump(void)
{
    int64_t skin, lower_q32, upper_q32, apart_q32;
    int other;

    begin(MOST, 0, 1 << 15);
    skin = (int64_t)box.mesh.radius_q22 << 10 >> 11;
    box_def.position.c[2] += 3 * HALF;
    other = carom_body_add(world, &box_def);
    settle();
    apart_q32 = state_of(other).position.c[2] - state_of(BOX).position.c[2];
    lower_q32 = state_of(BOX).position.c[2];
    for (int v = 0; v < COUNT; v++) {
        at[v][2] = 3000;
    }
    CHECK_EQ(move(), CAROM_OK);
    upper_q32 = state_of(BOX).position.c[2];
    CHECK_MORE(upper_q32 - lower_q32, 3000 * QUANTUM_Q32 - skin);
    CHECK_LESS(upper_q32 - lower_q32, 3000 * QUANTUM_Q32 + skin);
    CHECK_EQ(state_of(other).position.c[2] - upper_q32, apart_q32);
    CHECK_EQ(state_of(BOX).velocity.c[2], 0);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK_MORE(state_of(BOX).velocity.c[2], 2900 * QUANTUM_Q40);
    CHECK_LESS(state_of(BOX).velocity.c[2], 3002 * QUANTUM_Q40);
}

/* A body that flies by is lifted where the surface rises, together with the body that it meets. */
static void test_spread(void)
{
    struct carom_body_state s;
    int other;

    begin(MOST, 0, 1 << 15);
    box_def.position.c[0] = CAROM_RATIO(1, 2, 32);
    box_def.position.c[2] = 3 * HALF + CAROM_RATIO(5, 100, 32);
    other = carom_body_add(world, &box_def);
    for (int v = 0; v < COUNT; v++) {
        at[v][2] = 1000;
    }
    CHECK_EQ(move(), CAROM_OK);
    s = state_of(BOX);
    CHECK_MORE(s.position.c[2], 1000 * QUANTUM_Q32 + HALF);
    CHECK_MORE(state_of(other).position.c[2], s.position.c[2] + 2 * HALF);
    CHECK_MORE(state_of(other).position.c[2], box_def.position.c[2]);
    CHECK_LESS(state_of(other).position.c[2], box_def.position.c[2] + 1000 * QUANTUM_Q32);
}

/* ------------------------------------------------------------------- refusals */

static void test_refused(void)
{
    struct carom_body_def lid;
    uint64_t hash;
    int16_t good[COUNT][3];

    begin(MOST, 0, 1 << 15);
    lid = box_def;
    lid.stationary = true;
    lid.position.c[2] = 3 * HALF + CAROM_RATIO(30, 100, 32);
    CHECK_EQ(carom_body_add(world, &lid), 2);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    hash = carom_world_hash(world);
    memcpy(good, at, sizeof good);

    CHECK_EQ(carom_surface_move(NULL, FLOOR, flat.raw.vertices), CAROM_ERR_NULL);
    CHECK_EQ(carom_surface_move(world, FLOOR, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_surface_move(world, 3, flat.raw.vertices), CAROM_ERR_BODY);
    CHECK_EQ(carom_surface_move(world, -1, flat.raw.vertices), CAROM_ERR_BODY);
    CHECK_EQ(carom_surface_move(world, BOX, flat.raw.vertices), CAROM_ERR_ARGUMENT);
    at[40][0] = (int16_t)(at[40][0] + 5000);
    CHECK_EQ(move(), CAROM_ERR_MESH_SURFACE);
    CHECK_EQ(put(), CAROM_ERR_MESH_SURFACE);
    CHECK_EQ(carom_world_hash(world), hash);
    CHECK_EQ(memcmp(surface.raw.vertices, good, sizeof good), 0);
    memcpy(at, good, sizeof at);
    for (int v = 0; v < COUNT; v++) {
        at[v][2] = 1000; /* the lid is 0.29 units above the box */
    }
    CHECK_EQ(move(), CAROM_OK);
    for (int v = 0; v < COUNT; v++) {
        at[v][2] = 2200;
    }
    hash = carom_world_hash(world);
    CHECK_EQ(move(), CAROM_ERR_BLOCKED);
    CHECK_EQ(carom_world_hash(world), hash);
    for (int v = 0; v < COUNT; v++) {
        CHECK_EQ(surface.raw.vertices[v][2], 1000);
    }
}

/* A step that fails keeps the surface's move; the next step with room goes on from there. */
static void test_all_or_nothing(void)
{
    struct carom_world *w = NULL;
    uint64_t hash;

    begin(MOST, 0, 1 << 15);
    settle();
    w = world;
    for (int v = 0; v < COUNT; v++) {
        at[v][2] = 40;
    }
    CHECK_EQ(move(), CAROM_OK);
    hash = carom_world_hash(w);
    w->pools[CAROM_POOL_contacts].size = 1;
    CHECK_EQ(carom_world_step(w), CAROM_ERR_CONTACTS_FULL);
    CHECK_EQ(carom_world_hash(w), hash);
    CHECK_EQ(mesh_drift_most(&surface), 40 << 10);
    w->pools[CAROM_POOL_contacts].size = w->config.caps.contacts;
    CHECK_EQ(carom_world_step(w), CAROM_OK);
    CHECK_EQ(mesh_drift_most(&surface), 0);
    CHECK_NEAR(state_of(BOX).velocity.c[2], 40 * QUANTUM_Q40, 5 * QUANTUM_Q40);
}

/* Random heights that change by some units a frame: nothing overflows, and the box stays above. */
static void test_wild(void)
{
    struct test_random r = {5};

    for (int e = 0; e < 2; e++) {
        begin(MOST, e ? CAROM_ONE_Q30 : 0, 1 << 15);
        for (int frame = 0; frame < 60; frame++) {
            int range = frame % 3 == 0 ? 30000 : frame % 3 == 1 ? 5000 : 200;

            for (int v = 0; v < COUNT; v++) {
                at[v][2] = (int16_t)test_random_range(&r, -range, range);
            }
            CHECK_EQ(move(), CAROM_OK);
            CHECK_AT_LEAST(carom_world_step(world), 0);
            if (carom_abs(state_of(BOX).position.c[0]) < CAROM_RATIO(3, 1, 32) &&
                carom_abs(state_of(BOX).position.c[1]) < CAROM_RATIO(3, 1, 32)) {
                /* no vertex below it is lower than -range */
                CHECK_MORE(state_of(BOX).position.c[2], -range * QUANTUM_Q32);
            }
        }
    }
}

/* A move is refused while the box sleeps and another body does not: the box stays where it lies. */
static void test_refused_asleep(void)
{
    struct carom_body_def lid;
    struct carom_body_state lies;

    begin(MOST, 0, 1 << 15);
    lid = box_def;
    lid.stationary = true;
    lid.position.c[2] = 3 * HALF + CAROM_RATIO(30, 100, 32);
    CHECK_EQ(carom_body_add(world, &lid), 2);
    settle();
    lid.stationary = false;
    lid.position.c[0] = CAROM_RATIO(3, 1, 32);
    lid.position.c[2] = CAROM_RATIO(20, 1, 32);
    CHECK_EQ(carom_body_add(world, &lid), 3);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    lies = state_of(BOX);
    for (int v = 0; v < COUNT; v++) {
        at[v][2] = 2200;
    }
    CHECK_EQ(move(), CAROM_ERR_BLOCKED);
    for (int frame = 0; frame < 5; frame++) {
        struct carom_body_state s;

        CHECK_EQ(carom_world_step(world), CAROM_OK);
        s = state_of(BOX);
        CHECK(s.asleep);
        CHECK_EQ(memcmp(&s.position, &lies.position, sizeof s.position), 0);
    }
}

static void test_no_entries(void)
{
    struct carom_config config = {.caps = CAROM_CAPS(CAPS(0))};
    struct carom_body_def def;

    begin(MOST, 0, 1 << 15);
    CHECK_EQ(carom_world_init(block, CAROM_WORLD_BYTES(CAPS(0)), &config, &world), CAROM_OK);
    def = box_def;
    def.stationary = true;
    def.mesh = &surface;
    CHECK_EQ(carom_body_add(world, &def), CAROM_ERR_NO_ENTRIES);
    def.mesh = &flat.mesh;
    CHECK_EQ(carom_body_add(world, &def), FLOOR);
}

/* ----------------------------------------------------------------- worlds at rest */

/* A move while nothing is awake lasts for one frame; the next one does not know about it. */
static void test_idle(void)
{
    begin(MOST, 0, 1 << 15);
    CHECK_EQ(carom_body_remove(world, BOX), CAROM_OK);
    for (int frame = 0; frame < 3; frame++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
    CHECK(world->idle);
    for (int v = 0; v < COUNT; v++) {
        at[v][2] = 400;
    }
    CHECK_EQ(move(), CAROM_OK);
    CHECK_EQ(mesh_drift_most(&surface), 400 << 10);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK_EQ(mesh_drift_most(&surface), 0);
    box_def.position.c[2] += 400 * QUANTUM_Q32;
    CHECK_EQ(carom_body_add(world, &box_def), BOX);
    settle();
    CHECK_NEAR(state_of(BOX).position.c[2], HALF + 400 * QUANTUM_Q32, 4 * QUANTUM_Q32);
}

/*
 * A surface that moves wakes what lies on it: the box counts its 20 quiet frames anew. A box on other ground does not, and falls
 * asleep when it would have.
 */
static void test_stirs(void)
{
    enum { GROUND = 2, OTHER };
    int alone = 0;

    for (int moved = 0; moved < 2; moved++) {
        struct carom_body_def def;
        int awake[2] = {0, 0};

        begin(MOST, 0, 1 << 15);
        def = box_def;
        def.position = (carom_v3_q32){{CAROM_RATIO(40, 1, 32), 0, 0}};
        def.stationary = true;
        CHECK_EQ(carom_body_add(world, &def), GROUND);
        def.stationary = false;
        def.position.c[2] = 2 * HALF + CAROM_RATIO(1, 100, 32);
        CHECK_EQ(carom_body_add(world, &def), OTHER);
        for (int frame = 1; frame <= 100; frame++) {
            if (moved && frame == alone) { /* before its last quiet frame */
                at[0][2] = -1;             /* a corner far from it */
                CHECK_EQ(put(), CAROM_OK);
                CHECK_EQ(carom_contacts(world, NULL, 0), 0); /* their pairs are gone */
            }
            CHECK_EQ(carom_world_step(world), CAROM_OK);
            awake[0] += !state_of(BOX).asleep;
            awake[1] += !state_of(OTHER).asleep;
        }
        alone = moved ? alone : awake[0] + 1;
        CHECK_EQ(awake[0] + 1, moved ? alone + 19 : alone); /* frame `alone` is the first of 20 */
        CHECK_EQ(awake[1] + 1, alone);
    }
}

/* The surface comes from far below after it stood still for a while, and the box is found. */
static void test_from_afar(void)
{
    begin(MOST, 0, 1 << 15);
    box_def.position.c[2] = CAROM_RATIO(8, 1, 32);
    CHECK_EQ(carom_body_remove(world, BOX), CAROM_OK);
    CHECK_EQ(carom_body_add(world, &box_def), BOX);
    for (int frame = 0; frame < 10; frame++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
    for (int v = 0; v < COUNT; v++) {
        at[v][2] = 7 * 4096;
    }
    CHECK_EQ(put(), CAROM_OK);
    settle();
    CHECK_NEAR(state_of(BOX).position.c[2], HALF + CAROM_RATIO(7, 1, 32), 4 * QUANTUM_Q32);
}

/* ------------------------------------------------------------------------ queries */

static bool listed(const struct carom_face_pair *list, int count, struct carom_face_pair pair)
{
    int i = 0;

    while (i < count && (list[i].a != pair.a || list[i].b != pair.b)) {
        i++;
    }
    return i < count;
}

/* Queries of a surface that has moved answer like queries of a rigid mesh with its shape. */
static void ask(int rigid)
{
    enum { ROOM = 128 };
    static struct carom_face_pair wanted[ROOM], found[ROOM];
    int expected = carom_query_faces(world, BOX, rigid, wanted, ROOM);
    int count = carom_query_faces(world, BOX, FLOOR, found, ROOM);

    CHECK_AT_LEAST(expected, 0);
    CHECK_EQ(count, expected);
    for (int i = 0; i < expected && i < count; i++) {
        CHECK(listed(found, count, wanted[i]));
    }
    CHECK_EQ(carom_query_faces(world, FLOOR, BOX, found, ROOM), expected);
    for (int i = 0; i < expected; i++) {
        CHECK(listed(found, expected, (struct carom_face_pair){wanted[i].b, wanted[i].a}));
    }
    CHECK_EQ(carom_query_inside(world, BOX, FLOOR), carom_query_inside(world, BOX, rigid));
}

static void test_queries(void)
{
    static const uint32_t entries[] = {1, 12, MOST};
    struct carom_body_state s;
    struct carom_body_def def;
    int met = 0, inside = 0, rigid;

    for (int i = 0; i < 3; i++) {
        begin(entries[i], 0, 1 << 15);
        CHECK_EQ(carom_body_remove(world, BOX), CAROM_OK);
        shape_ball(&box, 12, 3000); /* it has several leaves */
        CHECK_MORE(box.mesh.leaf_count, 1);
        box_def.overlap = CAROM_OVERLAP_PASS;
        CHECK_EQ(carom_body_add(world, &box_def), BOX);
        wave(20);
        for (int v = 0; v < COUNT; v++) {
            at[v][2] = (int16_t)(8 * at[v][2] + 4096);
        }
        CHECK_EQ(put(), CAROM_OK);
        memcpy(flat.vertices, at, sizeof at);
        CHECK_EQ(carom_mesh_build(&flat.mesh, &flat.raw, flat.block, sizeof flat.block), CAROM_OK);
        def = box_def;
        def.stationary = true;
        def.mesh = &flat.mesh;
        def.position.c[2] = 0;
        rigid = carom_body_add(world, &def);
        s = state_of(BOX);
        s.rotation = (carom_quat_q30){{900000000, 400000000, 300000000, 303000000}};
        for (int k = -40; k <= 40; k++) {
            static struct carom_face_pair one[1];

            s.position.c[0] = CAROM_RATIO(k, 10, 32);
            s.position.c[1] = CAROM_RATIO(k % 7, 3, 32);
            s.position.c[2] = CAROM_RATIO(k % 3 + 2, 2, 32);
            CHECK_EQ(carom_body_set(world, BOX, &s), CAROM_OK);
            ask(rigid);
            met += carom_query_faces(world, BOX, FLOOR, one, 1) != 0;
            inside += carom_query_inside(world, BOX, FLOOR);
        }
    }
    CHECK_MORE(met, 20);
    CHECK_MORE(inside, 20);
}

/* A snapshot is accepted when the surface is where it was, and is refused otherwise. */
static void test_snapshot(void)
{
    static uint8_t bytes[4096];
    uint64_t hashes[20], mark;
    int size;

    begin(MOST, CAROM_ONE_Q30 / 4, 1 << 15);
    for (int frame = 0; frame < 40; frame++) {
        wave(frame);
        CHECK_EQ(move(), CAROM_OK);
        CHECK_EQ(carom_world_step(world), CAROM_OK);
    }
    wave(40);
    CHECK_EQ(move(), CAROM_OK); /* and while a surface is moving */
    size = carom_snapshot_save(world, bytes, sizeof bytes);
    CHECK_EQ(size, carom_snapshot_size(world));
    mark = carom_world_hash(world);
    for (int again = 0; again < 2; again++) {
        for (int frame = 0; frame < 20; frame++) {
            if (frame > 0) {
                wave(40 + frame);
                CHECK_EQ(move(), CAROM_OK);
            }
            CHECK_EQ(carom_world_step(world), CAROM_OK);
            CHECK(!again || hashes[frame] == carom_world_hash(world));
            hashes[frame] = carom_world_hash(world);
        }
        mark = again ? mark : carom_world_hash(world);
        CHECK_EQ(carom_snapshot_load(world, bytes, (size_t)size), CAROM_ERR_FORMAT);
        CHECK_EQ(carom_world_hash(world), mark);
        wave(40);
        CHECK_EQ(put(), CAROM_OK);
        CHECK_EQ(carom_snapshot_load(world, bytes, (size_t)size), CAROM_ERR_FORMAT);
        wave(39);
        CHECK_EQ(put(), CAROM_OK);
        wave(40);
        CHECK_EQ(move(), CAROM_OK);
        CHECK_EQ(carom_snapshot_load(world, bytes, (size_t)size), CAROM_OK);
    }
}

const struct test tests_world_surface[] = {
    {"world_surface/sources", test_sources},
    {"world_surface/rigid", test_rigid},
    {"world_surface/lift", test_lift},
    {"world_surface/aside", test_aside},
    {"world_surface/jump", test_jump},
    {"world_surface/spread", test_spread},
    {"world_surface/all_or_nothing", test_all_or_nothing},
    {"world_surface/wild", test_wild},
    {"world_surface/refused", test_refused},
    {"world_surface/refused_asleep", test_refused_asleep},
    {"world_surface/no_entries", test_no_entries},
    {"world_surface/idle", test_idle},
    {"world_surface/stirs", test_stirs},
    {"world_surface/from_afar", test_from_afar},
    {"world_surface/queries", test_queries},
    {"world_surface/snapshot", test_snapshot},
    {0},
};
