/* SPDX-License-Identifier: MIT */
/*
 * A world in which all bodies sleep skips its steps. A second world is the same, except that a body
 * far away hovers and spins for ever, so it skips no step. Whatever is done to both, the box on the
 * plane must do the same in both.
 */
#include <string.h>

#include "carom.h"
#include "scene.h"
#include "lib/test.h"

#define CAPS      3, 2, 64, 64, 0, 256
#define FAR       2
#define BOX_BYTES (SCENE_MESH(8, 12) + SCENE_MESH(4, 2))

static _Alignas(8) uint8_t mesh_block[BOX_BYTES];
static _Alignas(8) uint8_t blocks[2][CAROM_WORLD_BYTES(CAPS)];
static uint8_t saved[2][2048];
static struct scene scene;
static struct carom_config config;
static struct carom_world *worlds[2];

static struct carom_body_state box_of(int world)
{
    struct carom_body_state state;

    memset(&state, 0, sizeof state);
    CHECK_EQ(carom_body_get(worlds[world], SCENE_BODY, &state), CAROM_OK);
    return state;
}

static void check_same(void)
{
    struct carom_body_state one = box_of(0), other = box_of(1);

    CHECK_EQ(memcmp(&one.position, &other.position, sizeof one.position), 0);
    CHECK_EQ(memcmp(&one.rotation, &other.rotation, sizeof one.rotation), 0);
    CHECK_EQ(memcmp(&one.velocity, &other.velocity, sizeof one.velocity), 0);
    CHECK_EQ(memcmp(&one.spin, &other.spin, sizeof one.spin), 0);
    CHECK_EQ(one.asleep, other.asleep);
}

/* Events of the box and the plane are the same; the far body has none. */
static void step_both(void)
{
    const struct carom_event *events[2];
    int count[2];

    for (int i = 0; i < 2; i++) {
        CHECK_EQ(carom_world_step(worlds[i]), CAROM_OK);
        count[i] = carom_events(worlds[i], &events[i]);
    }
    CHECK_EQ(count[0], count[1]);
    for (int e = 0; e < count[0] && e < count[1]; e++) {
        CHECK_EQ(events[0][e].kind, events[1][e].kind);
        CHECK_EQ(events[0][e].speed_q40, events[1][e].speed_q40);
    }
    check_same();
}

/* Both worlds; the box lies on the plane and sleeps. */
static void setup(void)
{
    const struct carom_caps caps = CAROM_CAPS(CAPS);
    struct carom_body_def hovering;
    carom_v3_q40 lift;
    int frames = 0;

    CHECK_EQ(scene_load(&scene, "box", NULL, mesh_block, sizeof mesh_block), CAROM_OK);
    config = scene_config();
    config.caps = caps;
    scene.body.position.c[2] = CAROM_POSITION_MM(260);
    memset(&scene.body.velocity, 0, sizeof scene.body.velocity);
    memset(&scene.body.spin, 0, sizeof scene.body.spin);
    for (int i = 0; i < 2; i++) {
        CHECK_EQ(scene_make(&scene, &config, blocks[i], sizeof blocks[i], &worlds[i]), CAROM_OK);
    }
    hovering = scene.body;
    hovering.position.c[0] = CAROM_POSITION_MM(900000);
    hovering.mass_q20 = 1 << 20;
    hovering.spin.c[1] = CAROM_SPIN_MRAD_S(700, 60);
    CHECK_EQ(carom_body_add(worlds[1], &hovering), FAR);
    lift = config.gravity;
    lift.c[2] = -lift.c[2];
    CHECK_EQ(carom_body_set_force(worlds[1], FAR, &lift), CAROM_OK);
    while (!box_of(0).asleep && frames++ < 100) {
        step_both();
    }
    CHECK(box_of(0).asleep);
}

static void steps(int n, bool *woke)
{
    *woke = false;
    while (n-- > 0) {
        step_both();
        *woke = *woke || !box_of(0).asleep;
    }
}

/* An idle step reports nothing, and changes nothing that a caller can see. */
static void test_nothing(void)
{
    uint64_t hash;
    struct carom_stats first, stats;
    const struct carom_face_ref *faces;
    struct carom_contact contact;
    bool woke;

    setup();
    hash = carom_world_hash(worlds[0]);
    step_both();
    CHECK_EQ(carom_stats(worlds[0], &first), CAROM_OK);
    CHECK_EQ(first.substeps, 1);
    CHECK_EQ(first.hits + first.candidates + first.roots + first.contacts + first.sweeps, 0);
    steps(5, &woke);
    CHECK(!woke);
    CHECK_EQ(carom_stats(worlds[0], &stats), CAROM_OK);
    CHECK_EQ(memcmp(&first, &stats, sizeof first), 0);
    CHECK_EQ(carom_interfering_faces(worlds[0], &faces), 0);
    CHECK_EQ(carom_contacts(worlds[0], &contact, 1), 0);
    CHECK_EQ((int64_t)carom_world_hash(worlds[0]), (int64_t)hash);
}

/* Disturbance number n: some wake the box, some do not. */
static void disturb(int n)
{
    static const carom_v3_q40 impulse = {{1 << 30, 0, (int64_t)1 << 34}};
    static const carom_v3_q32 point = {{0, 0, 0}};

    for (int i = 0; i < 2; i++) {
        struct carom_world *w = worlds[i];
        struct carom_body_state state;
        carom_v3_q40 gravity = config.gravity;

        switch (n) {
        case 0:
            CHECK_EQ(carom_body_push(w, SCENE_BODY, &impulse, &point), CAROM_OK);
            break;
        case 1:
            CHECK_EQ(carom_body_set_force(w, SCENE_BODY, &impulse), CAROM_OK);
            break;
        case 2:
            gravity.c[0] = gravity.c[2] / 8;
            CHECK_EQ(carom_world_set_gravity(w, &gravity), CAROM_OK);
            break;
        case 3:
            CHECK_EQ(carom_body_get(w, SCENE_GROUND, &state), CAROM_OK);
            state.position.c[2] -= (int64_t)1 << 30;
            CHECK_EQ(carom_body_set(w, SCENE_GROUND, &state), CAROM_OK);
            break;
        case 4:
            CHECK_EQ(carom_body_get(w, SCENE_BODY, &state), CAROM_OK);
            state.position.c[2] += (int64_t)1 << 30;
            CHECK_EQ(carom_body_set(w, SCENE_BODY, &state), CAROM_OK);
            break;
        case 5:
            CHECK_EQ(carom_body_remove(w, SCENE_GROUND), CAROM_OK);
            break;
        default:
            memset(saved[i], 0x5a, 100);
            CHECK_EQ(carom_snapshot_load(w, saved[i], sizeof saved[i]), CAROM_ERR_FORMAT);
            break;
        }
    }
}

static void test_disturbed(void)
{
    for (int n = 0; n <= 6; n++) {
        bool woke;

        setup();
        steps(3, &woke);
        CHECK(!woke);
        disturb(n);
        steps(10, &woke);
        CHECK_EQ(woke, n < 6);
    }
}

/* A snapshot of the fall is loaded into the sleeping world. */
static void test_snapshot(void)
{
    int size[2];
    bool woke;

    setup();
    disturb(4);
    steps(3, &woke);
    for (int i = 0; i < 2; i++) {
        size[i] = carom_snapshot_save(worlds[i], saved[i], sizeof saved[i]);
        CHECK_MORE(size[i], 0);
    }
    steps(100, &woke);
    CHECK(box_of(0).asleep);
    for (int i = 0; i < 2; i++) {
        CHECK_EQ(carom_snapshot_load(worlds[i], saved[i], (size_t)size[i]), CAROM_OK);
    }
    CHECK(!box_of(0).asleep);
    steps(20, &woke);
    CHECK(woke);
}

/* Heights cached for another place of the plane, or another gravity, are dropped. */
static void test_detour(void)
{
    uint64_t hash;
    int32_t size;
    int64_t height;
    bool woke;

    setup();
    height = box_of(0).position.c[2];
    disturb(4);
    steps(1, &woke);
    size = carom_snapshot_save(worlds[0], saved[0], sizeof saved[0]);
    steps(100, &woke);
    hash = carom_world_hash(worlds[0]);
    CHECK_NEAR(box_of(0).position.c[2], height, 1 << 22);
    disturb(3);
    steps(100, &woke);
    CHECK_NEAR(box_of(0).position.c[2], height - ((int64_t)1 << 30), 1 << 22);
    disturb(2);
    steps(10, &woke);
    CHECK_EQ(carom_snapshot_load(worlds[0], saved[0], (size_t)size), CAROM_OK);
    for (int n = 0; n < 100; n++) {
        CHECK_EQ(carom_world_step(worlds[0]), CAROM_OK);
    }
    CHECK_EQ((int64_t)carom_world_hash(worlds[0]), (int64_t)hash);
}

const struct test tests_world_idle[] = {
    {"world_idle/nothing", test_nothing},
    {"world_idle/disturbed", test_disturbed},
    {"world_idle/snapshot", test_snapshot},
    {"world_idle/detour", test_detour},
    {0},
};
