/* SPDX-License-Identifier: MIT */
/*
 * Whole steps on any board: a box with three different sides falls, bounces, rests and sleeps; the
 * events and the status of a step; a step does all or nothing.
 */
#include <string.h>

#include "carom.h"
#include "scene.h"
#include "lib/test.h"
#include "step/parts.h"

#define BOX_BYTES (SCENE_MESH(8, 12) + SCENE_MESH(4, 2))
/* Capacities for one box on one plane, a pair and a few contacts, with some to spare. */
#define CAPS 3, 2, 64, 64, 64, 256

static _Alignas(8) uint8_t mesh_block[BOX_BYTES];
static _Alignas(8) uint8_t world_block[CAROM_WORLD_BYTES(CAPS)];
static _Alignas(8) uint8_t other_block[CAROM_WORLD_BYTES(CAPS)];
static struct scene scene;
static struct carom_config config;

/* Half the sides of the box of scene.c; its skin is the radius over 2048. */
static const double half_side[3] = {0.5, 1434. / 4096, 0.25};
#define RADIUS 0.6598
#define SKIN   (RADIUS / 2048)

/* ------------------------------------------------------------------- helpers */

static double real(int64_t fixed, int bits)
{
    return (double)fixed / (double)((int64_t)1 << bits);
}

/* The scene `box`, with e and mu, in small pools and without sleep. */
static void load(int32_t e_q30, uint32_t mu_q16)
{
    const struct carom_caps caps = CAROM_CAPS(CAPS);

    CHECK_EQ(scene_load(&scene, "box", NULL, mesh_block, sizeof mesh_block), CAROM_OK);
    scene.ground.restitution_q30 = scene.body.restitution_q30 = e_q30;
    scene.ground.friction_q16 = scene.body.friction_q16 = mu_q16;
    config = scene_config();
    config.caps = caps;
    config.sleep = false;
}

static struct carom_world *start(void *block)
{
    struct carom_world *world = NULL;

    CHECK_EQ(scene_make(&scene, &config, block, sizeof world_block, &world), CAROM_OK);
    return world;
}

static struct carom_body_state state_of(const struct carom_world *world)
{
    struct carom_body_state state;

    memset(&state, 0, sizeof state);
    CHECK_EQ(carom_body_get(world, SCENE_BODY, &state), CAROM_OK);
    return state;
}

/* The index of an event of the last step; -1: none. */
static int find_event(const struct carom_world *world, int kind)
{
    const struct carom_event *events;
    int n = carom_events(world, &events);

    for (int i = 0; i < n; i++) {
        if (events[i].kind == kind) {
            return i;
        }
    }
    return -1;
}

/* The rows of the rotation matrix of a quaternion whose length is nearly 1. */
static void matrix(double m[3][3], const carom_quat_q30 *q)
{
    double w = real(q->c[0], 30), u[3] = {real(q->c[1], 30), real(q->c[2], 30), real(q->c[3], 30)};

    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;

        m[i][i] = 1 - 2 * (u[j] * u[j] + u[k] * u[k]);
        m[i][j] = 2 * (u[i] * u[j] - w * u[k]);
        m[j][i] = 2 * (u[i] * u[j] + w * u[k]);
    }
}

/* Height of the lowest corner of the box. */
static double lowest(const struct carom_world *world)
{
    struct carom_body_state s = state_of(world);
    double m[3][3], z = real(s.position.c[2], 32);

    matrix(m, &s.rotation);
    for (int k = 0; k < 3; k++) {
        z -= half_side[k] * (m[2][k] < 0 ? -m[2][k] : m[2][k]);
    }
    return z;
}

/*
 * Energy by mass: a box's inertia by mass about an axis is a third of the sum of the other two half
 * sides' squares.
 */
static double energy(const struct carom_world *world)
{
    struct carom_body_state s = state_of(world);
    double m[3][3], sum = -real(config.gravity.c[2], 40) * real(s.position.c[2], 32);

    matrix(m, &s.rotation);
    for (int k = 0; k < 3; k++) {
        double a = half_side[(k + 1) % 3], b = half_side[(k + 2) % 3],
               v = real(s.velocity.c[k], 40);
        double w = 0;

        for (int i = 0; i < 3; i++) {
            w += m[i][k] * real(s.spin.c[i], 40);
        }
        sum += v * v / 2 + w * w * (a * a + b * b) / 6;
    }
    return sum;
}

/* ---------------------------------------------------------------------- tests */

/* A world without bodies, and one in which nothing can move. */
static void test_nothing(void)
{
    struct carom_world *world = NULL;
    uint64_t hash;

    load(CAROM_ONE_Q30, 0);
    CHECK_EQ(carom_world_init(world_block, sizeof world_block, &config, &world), CAROM_OK);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK_EQ(carom_body_add(world, &scene.ground), 0);
    CHECK_EQ(carom_body_add(world, &scene.ground), 1);
    hash = carom_world_hash(world);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK_EQ(carom_world_hash(world), hash);
    CHECK_EQ(find_event(world, CAROM_EVENT_BEGIN), -1);
}

/*
 * Free fall is the exact parabola: after n frames z0 - g n^2 / 2, x0 + v n. Each frame rounds a
 * place to 2^-32 once and a velocity to 2^-40.
 */
static void test_parabola(void)
{
    struct carom_world *world;
    const int n = 24;

    load(CAROM_ONE_Q30 / 2, 1 << 15);
    world = start(world_block);
    CHECK_EQ(carom_body_remove(world, SCENE_GROUND), CAROM_OK);
    for (int frame = 1; frame <= n; frame++) {
        struct carom_body_state s;
        const int64_t drop_q40 = config.gravity.c[2] * frame * frame / 2;

        CHECK_EQ(carom_world_step(world), CAROM_OK);
        s = state_of(world);
        CHECK_NEAR(s.position.c[2], scene.body.position.c[2] + (drop_q40 >> 8), n);
        CHECK_NEAR(s.position.c[0],
                   scene.body.position.c[0] + (scene.body.velocity.c[0] * frame >> 8), n);
        CHECK_NEAR(s.velocity.c[2], config.gravity.c[2] * frame, 16 * n);
    }
}

/*
 * Without friction and with e = 1 energy stays. Rounding a rotation to 2^-30 may change it by 2^-30
 * a frame; the bound is the sum over 300 frames.
 */
static void test_energy(void)
{
    struct carom_world *world;
    double before;
    int hits = 0;

    load(CAROM_ONE_Q30, 0);
    world = start(world_block);
    before = energy(world);
    for (int frame = 0; frame < 300; frame++) {
        double change;

        CHECK_EQ(carom_world_step(world), CAROM_OK);
        change = energy(world) / before - 1;
        CHECK_LESS(change, 300e-9);
        CHECK_MORE(change, -300e-9);
        CHECK_MORE(lowest(world), 0);
        hits += find_event(world, CAROM_EVENT_HIT) >= 0;
    }
    CHECK_AT_LEAST(hits, 3);
}

/* A hit changes the momentum by its impulse; the speed after is e times the speed before. */
static void test_hit(void)
{
    struct carom_world *world;
    struct carom_body_state before, after;
    const struct carom_event *events;
    double mass = 8 * half_side[0] * half_side[1] * half_side[2], fall, rise;
    int hit = -1;

    load(CAROM_ONE_Q30 / 4 * 3, 1 << 15);
    memset(&scene.body.spin, 0, sizeof scene.body.spin);
    memset(&scene.body.velocity, 0, sizeof scene.body.velocity);
    world = start(world_block);
    for (int frame = 0; frame < 60 && hit < 0; frame++) {
        before = state_of(world);
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        hit = find_event(world, CAROM_EVENT_HIT);
    }
    CHECK_AT_LEAST(hit, 0);
    if (hit < 0) {
        return;
    }
    CHECK_MORE(find_event(world, CAROM_EVENT_BEGIN), hit);
    after = state_of(world);
    carom_events(world, &events);
    CHECK_EQ(events[hit].a, SCENE_BODY);
    CHECK_EQ(events[hit].b, SCENE_GROUND);
    /* v^2 = 2 g h from both sides of the hit to the height where the surfaces met, half a skin
     * up */
    fall = real(scene.body.position.c[2], 32) - half_side[2] - SKIN / 2;
    rise = real(events[hit].speed_q40, 40);
    CHECK_NEAR((int64_t)(rise * rise * 1e9),
               (int64_t)(-2 * real(config.gravity.c[2], 40) * fall * 1e9), 100);
    rise = real(after.velocity.c[2] - before.velocity.c[2] - config.gravity.c[2], 40);
    /* four corners share the impulse; the event reports the largest part */
    CHECK_LESS(real(events[hit].impulse_q40, 40) / mass, rise);
    CHECK_MORE(real(events[hit].impulse_q40, 40) / mass, rise / 8);
    CHECK_NEAR((int64_t)(rise * 1e9), (int64_t)(1.75 * real(events[hit].speed_q40, 40) * 1e9), 100);
}

/* A box comes to rest, its lowest corner within the skin, falls asleep with an event, and wakes. */
static void test_sleep(void)
{
    struct carom_world *world;
    struct carom_body_state s;
    int rest = -1, frame;
    uint64_t hash;

    load(CAROM_ONE_Q30 / 2, 1 << 15);
    config.sleep = true;
    world = start(world_block);
    for (frame = 0; frame < 400 && rest < 0; frame++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        rest = find_event(world, CAROM_EVENT_REST);
        CHECK_EQ((rest >= 0), state_of(world).asleep);
        CHECK_MORE(lowest(world), 0);
    }
    CHECK_AT_LEAST(rest, 0);
    CHECK_LESS(lowest(world), 1.1 * SKIN);
    hash = carom_world_hash(world);
    for (frame = 0; frame < 10; frame++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK_EQ(carom_world_hash(world), hash);
        CHECK_EQ(find_event(world, CAROM_EVENT_END), -1);
    }
    s = state_of(world);
    s.position.c[2] += (int64_t)1 << 31;
    CHECK_EQ(carom_body_set(world, SCENE_BODY, &s), CAROM_OK);
    CHECK(!state_of(world).asleep);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK_AT_LEAST(find_event(world, CAROM_EVENT_END), 0);
    CHECK_LESS(state_of(world).velocity.c[2], 0);
}

/* Working pools of one place each: the same hash on every frame, and places were refused. */
static void test_working_pools(void)
{
    struct carom_usage usage[CAROM_POOL_COUNT];
    struct carom_world *world, *other;

    load(CAROM_ONE_Q30 / 2, 1 << 15);
    world = start(world_block);
    config.caps.entries = config.caps.candidates = 1;
    other = start(other_block);
    for (int frame = 0; frame < 120; frame++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK_EQ(carom_world_step(other), CAROM_OK);
        CHECK_EQ(carom_world_hash(world), carom_world_hash(other));
    }
    carom_usage(other, usage);
    CHECK_MORE(usage[CAROM_POOL_candidates].refused, 0);
    CHECK_EQ(usage[CAROM_POOL_candidates].peak, 1);
}

/*
 * A step that fails leaves the world as it was. A snapshot of it, loaded into a world with room,
 * goes on like a world that never failed.
 */
static void test_all_or_nothing(void)
{
    static uint8_t snapshot[2048];
    struct carom_world *world, *other;
    struct carom_contact contact;
    int result, bytes, failures = 0;

    load(CAROM_ONE_Q30 / 2, 1 << 15);
    world = start(world_block);
    config.caps.contacts = 1;
    other = start(other_block);
    for (int frame = 0; frame < 200; frame++) {
        const uint64_t hash = carom_world_hash(other);

        CHECK_EQ(carom_world_step(world), CAROM_OK);
        result = carom_world_step(other);
        if (result == CAROM_OK) {
            CHECK_EQ(carom_world_hash(world), carom_world_hash(other));
            continue;
        }
        failures++;
        CHECK_EQ(result, CAROM_ERR_CONTACTS_FULL);
        CHECK_EQ(carom_world_hash(other), hash);
        CHECK_EQ(carom_contacts(other, &contact, 1), 0);
        config.caps.contacts = 64;
        bytes = carom_snapshot_save(other, snapshot, sizeof snapshot);
        CHECK_MORE(bytes, 0);
        other = start(other_block);
        CHECK_EQ(carom_snapshot_load(other, snapshot, (size_t)bytes), CAROM_OK);
        CHECK_EQ(carom_world_step(other), CAROM_OK);
        CHECK_EQ(carom_world_hash(world), carom_world_hash(other));
    }
    CHECK_EQ(failures, 1);
}

/*
 * A body that has used up its hits stands still for the rest of the frame: the status, an event and
 * a count report that. It gains no energy, and the next frame goes on.
 */
static void test_cap(void)
{
    struct carom_world *world;
    double before;
    int cut = 0;

    load(CAROM_ONE_Q30 / 2, 1 << 15);
    config.substep_cap = 1;
    world = start(world_block);
    before = energy(world);
    for (int frame = 0; frame < 120; frame++) {
        struct carom_stats stats;
        int status = carom_world_step(world);
        double now = energy(world);

        CHECK(status == CAROM_OK || status == CAROM_SUBSTEP_CAP);
        CHECK_EQ(carom_stats(world, &stats), CAROM_OK);
        CHECK_EQ(stats.hits, status == CAROM_SUBSTEP_CAP);
        CHECK_EQ(stats.cut_islands, status == CAROM_SUBSTEP_CAP);
        CHECK_EQ(find_event(world, CAROM_EVENT_CUT) >= 0, status == CAROM_SUBSTEP_CAP);
        CHECK_MORE(lowest(world), 0);
        CHECK_AT_MOST(now, before * (1 + 1e-6) + 0.2 * -real(config.gravity.c[2], 40) * SKIN);
        before = now;
        cut += status == CAROM_SUBSTEP_CAP;
    }
    CHECK_MORE(cut, 2);
    CHECK_LESS(cut, 60);
}

/*
 * With few sweeps a solve of several contacts ends sooner. Energy still rises only by what lifts
 * the box within its skin, and the box comes to rest on the plane.
 */
static void test_sweep_cap(void)
{
    const double lift = -real(scene_config().gravity.c[2], 40) * 0.2 * SKIN;
    uint32_t most = 0, rested = 0;

    for (int cap = 1; cap <= 16; cap *= 4) {
        struct carom_world *world;
        double before;

        load(CAROM_ONE_Q30 / 2, 1 << 15);
        config.sleep = true;
        config.sweep_cap = (uint8_t)cap;
        world = start(world_block);
        before = energy(world);
        for (int frame = 0; frame < 400; frame++) {
            struct carom_stats stats;
            double now;

            CHECK_EQ(carom_world_step(world), CAROM_OK);
            CHECK_EQ(carom_stats(world, &stats), CAROM_OK);
            CHECK_AT_MOST(stats.sweeps, (uint32_t)cap * (stats.substeps + 1));
            now = energy(world);
            CHECK_AT_MOST(now, before * (1 + 1e-8) + lift);
            before = now;
            most = stats.sweeps > most ? stats.sweeps : most;
        }
        rested += state_of(world).asleep;
        CHECK_MORE(lowest(world), 0);
        CHECK_LESS(lowest(world), 2 * SKIN);
    }
    CHECK_AT_LEAST(most, 8); /* the cap was reached */
    CHECK_EQ(rested, 3);
}

/* A body that leaves the world is frozen where it was, with one event. */
static void test_out(void)
{
    struct carom_world *world;
    struct carom_body_state s;
    int out = -1;

    load(CAROM_ONE_Q30 / 2, 1 << 15);
    scene.body.position.c[1] = (int64_t)4090 << 32;
    scene.body.velocity.c[1] = (int64_t)4 << 40;
    world = start(world_block);
    for (int frame = 0; frame < 3 && out < 0; frame++) {
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        out = find_event(world, CAROM_EVENT_OUT);
    }
    CHECK_AT_LEAST(out, 0);
    s = state_of(world);
    CHECK(s.out);
    /* the momentum is the state, and the velocity has 4 bits less for a mass of 30 bits */
    CHECK_NEAR(s.position.c[1], (int64_t)4094 << 32, 16);
    CHECK_EQ(carom_world_step(world), CAROM_OK);
    CHECK_EQ(find_event(world, CAROM_EVENT_OUT), -1);
    CHECK_EQ(state_of(world).position.c[2], s.position.c[2]);
}

/* A counter that advances by a thousand at every reading. */
static uint32_t fake_ticks(void)
{
    static uint32_t ticks;

    return ticks += 1000;
}

/* Timing and a budget report, and change nothing. */
static void test_budget(void)
{
    struct carom_world *world, *other;
    struct carom_stats stats;

    load(CAROM_ONE_Q30 / 2, 1 << 15);
    world = start(world_block);
    config.ticks = fake_ticks;
    config.budget_ticks = 500;
    other = start(other_block);
    for (int frame = 0; frame < 60; frame++) {
        uint32_t sum = 0;

        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK_EQ(carom_world_step(other), CAROM_OVER_BUDGET);
        CHECK_EQ(carom_world_hash(world), carom_world_hash(other));
        CHECK_EQ(carom_stats(other, &stats), CAROM_OK);
        for (int stage = 0; stage < CAROM_STAGE_COUNT; stage++) {
            sum += stats.ticks[stage];
            CHECK_AT_MOST(stats.ticks[stage], stats.ticks[stats.over_stage]);
        }
        CHECK_MORE(sum, 0);
        CHECK_AT_MOST(sum, stats.total_ticks);
    }
    config.budget_ticks = UINT32_MAX; /* no step takes more */
    other = start(other_block);
    CHECK_EQ(carom_world_step(other), CAROM_OK);
}

/* A root belongs to the part of the window that it is in; the window's end belongs to the last part. */
static void test_parts(void)
{
    const struct step_visitor v = {.parts = 4};
    struct boyse_hit hit = {.root_q30 = CAROM_ONE_Q30};

    CHECK_EQ(step_part_of(&v, &hit), 3);
    hit.root_q30 = CAROM_ONE_Q30 / 2;
    CHECK_EQ(step_part_of(&v, &hit), 2);
    hit.root_q30--;
    CHECK_EQ(step_part_of(&v, &hit), 1);
    hit.root_q30 = 0;
    CHECK_EQ(step_part_of(&v, &hit), 0);
}

const struct test tests_world_step[] = {{"world_step/nothing", test_nothing},
                                        {"world_step/parabola", test_parabola},
                                        {"world_step/energy", test_energy},
                                        {"world_step/hit", test_hit},
                                        {"world_step/sleep", test_sleep},
                                        {"world_step/working_pools", test_working_pools},
                                        {"world_step/all_or_nothing", test_all_or_nothing},
                                        {"world_step/cap", test_cap},
                                        {"world_step/sweep_cap", test_sweep_cap},
                                        {"world_step/parts", test_parts},
                                        {"world_step/out", test_out},
                                        {"world_step/budget", test_budget},
                                        {0}};
