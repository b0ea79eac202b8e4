/* SPDX-License-Identifier: MIT */
/*
 * Materials of bodies: friction, restitution and rolling friction by body and by face; surfaces
 * that move along themselves; masses that change.
 */
#include <string.h>

#include "lib/one_world.h"
#include "lib/real.h"
#include "lib/shapes.h"
#include "lib/test.h"
#include "world/world.h"

#define CAPS 3, 4, 48, 64, 0, 128, 0, 3, 0
#define ONE  ((int64_t)1 << 40) /* a unit, or a radian, a frame */
#define G    (ONE / 256)

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static uint8_t saved[4096];
static struct shape box, floor_shape, top;
static struct carom_config config;
static struct carom_body_def def, ground;

/* Boxes of side 1 above a floor of +-16 units and 4 x 4 squares; the floor is body 0. */
static void setup(int boxes)
{
    memset(&config, 0, sizeof config);
    config.caps = (struct carom_caps)CAROM_CAPS(CAPS);
    config.gravity.c[2] = -G;
    shape_box(&box, 12, 4096, 4096, 4096);
    shape_plane(&floor_shape, 9, 4, 4096);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    memset(&def, 0, sizeof def);
    memset(&ground, 0, sizeof ground);
    ground.mesh = &floor_shape.mesh;
    ground.stationary = true;
    ground.friction_q16 = def.friction_q16 = 1 << 15;
    def.mesh = &box.mesh;
    def.position.c[0] = -((int64_t)4 << 32);
    CHECK_EQ(carom_body_add(world, &ground), 0);
    for (int i = 1; i <= boxes; i++) {
        /* skins of 1/2365 apart */
        def.position.c[2] = (2 * i - 1) * ((int64_t)1 << 31) + i * ((int64_t)1 << 32) / 2365;
        CHECK_EQ(carom_body_add(world, &def), i);
    }
}

static void fall_asleep(void)
{
    for (int n = 0; n < 200 && !state_of(1).asleep; n++) {
        steps(1);
    }
    CHECK(state_of(1).asleep);
}

/* A box on the floor that sleeps. */
static void setup_asleep(void)
{
    setup(1);
    config.sleep = true;
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    CHECK_EQ(carom_body_add(world, &ground), 0);
    CHECK_EQ(carom_body_add(world, &def), 1);
    fall_asleep();
}

static struct carom_material material_of(int body)
{
    struct carom_material m;

    CHECK_EQ(carom_body_material(world, body, &m), CAROM_OK);
    return m;
}

/* ----------------------------------------------------------------- conveyors */

/*
 * The belt carries a stack of two. Each frame friction adds mu g, until the stack is as fast as the
 * belt. It is never faster, and its boxes stay together.
 */
static void test_conveyor(void)
{
    struct carom_material belt;
    const int64_t speed = ONE / 32; /* after 16 frames of g / 2 */

    setup(2);
    belt = material_of(0);
    /* a component that points outwards has no effect */
    belt.surface_velocity = (carom_v3_q40){{speed, 0, ONE}};
    CHECK_EQ(carom_body_set_material(world, 0, &belt), CAROM_OK);
    for (int n = 1; n <= 60; n++) {
        int64_t wanted = n * (G / 2) < speed ? n * (G / 2) : speed;

        steps(1);
        /* a frame's friction reaches the upper box a little late: within 3 % of the speed */
        CHECK_NEAR(state_of(1).velocity.c[0], wanted, speed / 32);
        CHECK_NEAR(state_of(2).velocity.c[0], wanted, speed / 32);
        CHECK_AT_MOST(state_of(1).velocity.c[0], speed + (speed >> 10));
        CHECK_NEAR(state_of(1).velocity.c[1], 0, speed >> 8);
        CHECK_NEAR(state_of(2).position.c[2], (int64_t)3 << 31, (int64_t)1 << 23);
    }
    /* the belt stops */
    belt.surface_velocity.c[0] = 0;
    CHECK_EQ(carom_body_set_material(world, 0, &belt), CAROM_OK);
    steps(40);
    CHECK_NEAR(state_of(1).velocity.c[0], 0, speed >> 8);
}

/* The velocity is in the mesh's axes: a turned belt carries along its own axis. */
static void test_turned_conveyor(void)
{
    /* a quarter turn about z: x becomes y */
    const carom_quat_q30 quarter = {{759250125, 0, 0, 759250125}};
    struct carom_body_state s;
    struct carom_material belt;

    setup(1);
    s = state_of(0);
    s.rotation = quarter;
    CHECK_EQ(carom_body_set(world, 0, &s), CAROM_OK);
    belt = material_of(0);
    belt.surface_velocity.c[0] = ONE / 64;
    CHECK_EQ(carom_body_set_material(world, 0, &belt), CAROM_OK);
    steps(40);
    CHECK_NEAR(state_of(1).velocity.c[1], ONE / 64, ONE >> 14);
    CHECK_NEAR(state_of(1).velocity.c[0], 0, ONE >> 14);
}

/* A body whose own surface moves, like a tank's tracks, moves the other way on the ground. */
static void test_tracks(void)
{
    struct carom_material tracks;

    setup(1);
    tracks = material_of(1);
    tracks.surface_velocity.c[0] = ONE / 64;
    CHECK_EQ(carom_body_set_material(world, 1, &tracks), CAROM_OK);
    steps(4);
    CHECK_NEAR(state_of(1).velocity.c[0], -4 * (G / 2), ONE >> 13);
    steps(36);
    CHECK_NEAR(state_of(1).velocity.c[0], -ONE / 64, ONE >> 14);
}

/* A box on a slow belt does not fall asleep; a sleeping box wakes when its belt begins to move. */
static void test_conveyor_wakes(void)
{
    struct carom_material belt;

    setup_asleep();
    belt = material_of(0);
    belt.surface_velocity.c[1] = G / 64; /* half of the quiet speed */
    CHECK_EQ(carom_body_set_material(world, 0, &belt), CAROM_OK);
    CHECK(!state_of(1).asleep);
    steps(100);
    CHECK(!state_of(1).asleep);
    CHECK_NEAR(state_of(1).velocity.c[1], G / 64, G / 512);
    /* setting the same velocity again wakes no body */
    belt.surface_velocity.c[1] = 0;
    CHECK_EQ(carom_body_set_material(world, 0, &belt), CAROM_OK);
    fall_asleep();
    CHECK_EQ(carom_body_set_material(world, 0, &belt), CAROM_OK);
    CHECK(state_of(1).asleep);
}

/* ---------------------------------------------------------------- combining */

/* The speed that a sliding box loses in a frame, over g. */
static double braking(uint32_t mu_a_q16, uint32_t mu_b_q16, enum carom_combine rule)
{
    struct carom_body_state s;
    struct carom_material m;
    int64_t before;

    setup(1);
    CHECK_EQ(carom_world_set_combine(world, CAROM_SMALLER, rule), CAROM_OK);
    m = material_of(0);
    m.friction_q16 = mu_b_q16;
    CHECK_EQ(carom_body_set_material(world, 0, &m), CAROM_OK);
    m = material_of(1);
    m.friction_q16 = mu_a_q16;
    CHECK_EQ(carom_body_set_material(world, 1, &m), CAROM_OK);
    steps(2);
    s = state_of(1);
    s.velocity.c[0] = ONE / 8;
    CHECK_EQ(carom_body_set(world, 1, &s), CAROM_OK);
    steps(2);
    before = state_of(1).velocity.c[0];
    steps(4);
    return (double)(before - state_of(1).velocity.c[0]) / 4 / (double)G;
}

static void test_combine_friction(void)
{
    struct test_random r = {11};

    for (int n = 0; n < 4; n++) {
        uint32_t a = (uint32_t)test_random_range(&r, 1000, 40000);
        uint32_t b = (uint32_t)test_random_range(&r, 1000, 40000);
        double x = a / 65536.0, y = b / 65536.0;

        CHECK_LESS(real_abs(braking(a, b, CAROM_SMALLER) - (x < y ? x : y)), 0.005);
        CHECK_LESS(real_abs(braking(a, b, CAROM_LARGER) - (x > y ? x : y)), 0.005);
        CHECK_LESS(real_abs(braking(a, b, CAROM_PRODUCT) - x * y), 0.005);
        CHECK_LESS(real_abs(braking(a, b, CAROM_MEAN) - real_sqrt(x * y)), 0.005);
    }
}

/* The speed of rebound over the speed of approach for a box that drops onto its face. */
static double rebound(int32_t e_a_q30, int32_t e_b_q30, enum carom_combine rule)
{
    struct carom_body_state s;
    struct carom_material m;
    int64_t fastest = 0, back = 0;

    setup(1);
    CHECK_EQ(carom_world_set_combine(world, rule, CAROM_SMALLER), CAROM_OK);
    m = material_of(0);
    m.restitution_q30 = e_b_q30;
    CHECK_EQ(carom_body_set_material(world, 0, &m), CAROM_OK);
    m = material_of(1);
    m.restitution_q30 = e_a_q30;
    CHECK_EQ(carom_body_set_material(world, 1, &m), CAROM_OK);
    s = state_of(1);
    s.position.c[2] = (int64_t)3 << 31;
    s.velocity.c[2] = -ONE / 16;
    CHECK_EQ(carom_body_set(world, 1, &s), CAROM_OK);
    for (int n = 0; n < 30 && back == 0; n++) {
        const struct carom_event *events;
        int count;

        steps(1);
        count = carom_events(world, &events);
        for (int i = 0; i < count; i++) {
            if (events[i].kind == CAROM_EVENT_HIT) {
                fastest = events[i].speed_q40;
                back = state_of(1).velocity.c[2];
            }
        }
    }
    return (double)back / (double)fastest;
}

static void test_combine_restitution(void)
{
    const int32_t a = CAROM_ONE_Q30 / 2, b = CAROM_ONE_Q30 / 8 * 7;

    /* within what gravity adds in the rest of the frame: g / (16 g) */
    CHECK_LESS(real_abs(rebound(a, b, CAROM_SMALLER) - 0.5), 0.07);
    CHECK_LESS(real_abs(rebound(b, a, CAROM_SMALLER) - 0.5), 0.07);
    CHECK_LESS(real_abs(rebound(a, b, CAROM_LARGER) - 0.875), 0.07);
    CHECK_LESS(real_abs(rebound(a, b, CAROM_PRODUCT) - 0.4375), 0.06);
    CHECK_LESS(real_abs(rebound(a, b, CAROM_MEAN) - 0.6875), 0.07);
}

/* A box sleeps on a slope by the larger friction. By the smaller one it must slide. */
static void test_combine_wakes(void)
{
    struct carom_material slippery;
    int64_t before;

    setup(1);
    config.sleep = true;
    config.gravity.c[0] = G / 4;
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    CHECK_EQ(carom_world_set_combine(world, CAROM_SMALLER, CAROM_LARGER), CAROM_OK);
    CHECK_EQ(carom_body_add(world, &ground), 0);
    CHECK_EQ(carom_body_add(world, &def), 1);
    slippery = material_of(1);
    slippery.friction_q16 = 0;
    CHECK_EQ(carom_body_set_material(world, 1, &slippery), CAROM_OK);
    fall_asleep();
    before = state_of(1).position.c[0];
    CHECK_EQ(carom_world_set_combine(world, CAROM_SMALLER, CAROM_LARGER), CAROM_OK);
    CHECK(state_of(1).asleep);
    CHECK_EQ(carom_world_set_combine(world, CAROM_SMALLER, CAROM_SMALLER), CAROM_OK);
    steps(20);
    /* half of what a free fall along the slope takes */
    CHECK_MORE(state_of(1).position.c[0] - before, (20 * 20 * (G / 4) / 4) >> 8);
}

/* --------------------------------------------------------------------- faces */

/*
 * The floor is slippery where x < 0, and rough elsewhere: a box that slides across is braked only
 * there.
 */
static void test_faces(void)
{
    static struct carom_material materials[2];
    static uint8_t of_face[32];
    struct carom_body_state s;
    int64_t before;

    setup(1);
    memset(materials, 0, sizeof materials);
    materials[1].friction_q16 = 1 << 15;
    materials[0].rolling_q16 = materials[1].rolling_q16 = CAROM_ROLLING_Q16;
    for (int f = 0; f < 32; f++) {
        of_face[f] = f / 2 % 4 >= 2; /* two faces a square, four squares a row */
    }
    CHECK_EQ(carom_body_set_face_materials(world, 0, materials, 2, of_face), CAROM_OK);
    steps(2);
    s = state_of(1);
    s.velocity.c[0] = ONE / 4;
    CHECK_EQ(carom_body_set(world, 1, &s), CAROM_OK);
    steps(13); /* to -0.75 */
    CHECK_NEAR(state_of(1).velocity.c[0], ONE / 4, ONE >> 12);
    steps(6); /* beyond 0.5 */
    before = state_of(1).velocity.c[0];
    steps(4);
    CHECK_NEAR(before - state_of(1).velocity.c[0], 4 * (G / 2), G / 32);
    /* and back to one material for all faces */
    CHECK_EQ(carom_body_set_face_materials(world, 0, NULL, 0, NULL), CAROM_OK);
    CHECK_EQ(carom_body_set(world, 1, &s), CAROM_OK);
    steps(2);
    before = state_of(1).velocity.c[0];
    steps(4);
    CHECK_NEAR(before - state_of(1).velocity.c[0], 4 * (G / 2), G / 32);
}

/*
 * One side of the box bounces and the opposite one does not; faces of a belt go different ways. The
 * box is dropped on each.
 */
static void test_faces_of_box(void)
{
    static struct carom_material materials[2];
    static uint8_t of_face[12];

    memset(materials, 0, sizeof materials);
    materials[1].restitution_q30 = CAROM_ONE_Q30;
    for (int up = -1; up <= 1; up += 2) {
        struct carom_body_state s;
        struct carom_material m;

        setup(1);
        m = material_of(0);
        m.restitution_q30 = CAROM_ONE_Q30;
        CHECK_EQ(carom_body_set_material(world, 0, &m), CAROM_OK);
        for (uint32_t f = 0; f < box.raw.face_count; f++) {
            of_face[f] = up * box.mesh.faces[f].normal.c[2] < -(CAROM_ONE_Q30 / 2);
        }
        CHECK_EQ(carom_body_set_face_materials(world, 1, materials, 2, of_face), CAROM_OK);
        s = state_of(1);
        s.position.c[2] = (int64_t)5 << 30;
        s.velocity.c[2] = -ONE / 16;
        CHECK_EQ(carom_body_set(world, 1, &s), CAROM_OK);
        for (int n = 0; n < 20; n++) {
            steps(1);
        }
        CHECK_EQ(state_of(1).velocity.c[2] > ONE / 64, up == 1);
    }
}

/* ------------------------------------------------------------------- rolling */

/*
 * A body that stands on a tip: an octahedron of half axis 1, whose moment about an axis is m / 10
 * times 2.
 */
static void make_top(void)
{
    static const uint16_t faces[8][3] = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                                         {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
    static const int16_t tips[6][3] = {{1024, 0, 0},  {0, 1024, 0}, {-1024, 0, 0},
                                       {0, -1024, 0}, {0, 0, 1024}, {0, 0, -1024}};

    memcpy(top.faces, faces, sizeof faces);
    memcpy(top.vertices, tips, sizeof tips);
    top.raw = (struct carom_mesh_raw){
        (const int16_t(*)[3])top.vertices, (const uint16_t(*)[3])top.faces, 6, 8, 10, CAROM_SOLID};
    CHECK_EQ(carom_mesh_build(&top.mesh, &top.raw, top.block, sizeof top.block), CAROM_OK);
}

/*
 * A top spins upright on its tip. The moment of rolling friction is arm x m g, so the spin falls by
 * arm g / (I / m) a frame. The arm is 64 times the product of both bodies' rolling friction, of the
 * radius 1; I / m = 1 / 5. At 1/4 a frame the top spins so fast that it stands.
 */
static void test_rolling(void)
{
    static const uint32_t rolling[][2] = {
        {CAROM_ROLLING_Q16, CAROM_ROLLING_Q16},
        {0, CAROM_ROLLING_Q16},
        {CAROM_ROLLING_Q16, 0},
        {2 * CAROM_ROLLING_Q16, CAROM_ROLLING_Q16},
        {CAROM_ROLLING_Q16, 3 * CAROM_ROLLING_Q16},
        {2 * CAROM_ROLLING_Q16, CAROM_ROLLING_Q16 / 2},
        {CAROM_ROLLING_Q16 / 32, CAROM_ROLLING_Q16 / 32}, /* the least product that counts */
        {1 << 16, 1 << 16},
    };

    for (int i = 0; i < 8; i++) {
        double arm = rolling[i][0] / 65536.0 * (rolling[i][1] / 65536.0) * 64;
        double lost, wanted = 5 * (arm < 1 ? arm : 1) / 256;
        int frames = i < 7 ? 8 : 4;
        struct carom_material m;
        int64_t before;

        setup(0);
        make_top();
        def.mesh = &top.mesh;
        def.position = (carom_v3_q32){
            {(int64_t)3 << 32, (int64_t)1 << 32, ((int64_t)1 << 32) + ((int64_t)1 << 21)}};
        def.spin.c[2] = ONE / 4;
        CHECK_EQ(carom_body_add(world, &def), 1);
        for (int body = 0; body < 2; body++) {
            m = material_of(body);
            m.rolling_q16 = rolling[i][body];
            CHECK_EQ(carom_body_set_material(world, body, &m), CAROM_OK);
        }
        steps(2);
        before = state_of(1).spin.c[2];
        steps(frames);
        lost = real(before - state_of(1).spin.c[2], 40) / frames;
        CHECK_AT_MOST(real_abs(lost - wanted), wanted / 50 + 1e-7);
    }
}

/* ---------------------------------------------------------------------- mass */

static void test_mass(void)
{
    struct test_random r = {12};
    struct carom_body_state s, after;

    setup(1);
    for (int n = 0; n < 40; n++) {
        uint32_t mass_q20 = (uint32_t)test_random_range(&r, 1 << 10, 1 << 30), got;

        s = state_of(1);
        s.position.c[2] = (int64_t)100 << 32;
        s.rotation = shape_random_turn(&r);
        for (int k = 0; k < 3; k++) {
            s.velocity.c[k] = test_random_range(&r, -10 * ONE, 10 * ONE);
            s.spin.c[k] = test_random_range(&r, -ONE, ONE);
        }
        CHECK_EQ(carom_body_set(world, 1, &s), CAROM_OK);
        CHECK_EQ(carom_body_set_mass(world, 1, mass_q20), CAROM_OK);
        CHECK_EQ(carom_body_mass(world, 1, &got), CAROM_OK);
        CHECK_NEAR(got, mass_q20, 1);
        after = state_of(1);
        for (int k = 0; k < 3; k++) {
            /* 2^-29 of the largest, and the last place of a small mass's momentum */
            CHECK_NEAR(after.velocity.c[k], s.velocity.c[k], ONE >> 24);
            CHECK_NEAR(after.spin.c[k], s.spin.c[k], ONE >> 24);
        }
    }
    CHECK_EQ(carom_body_set_mass(world, 1, 0), CAROM_OK);
    CHECK_EQ(world->bodies[1].def.mass.m, fix_scale((int64_t)1 << 32, 32).m);
}

/*
 * A heavier body on top presses harder; sleeping bodies wake; a force that is too large for a
 * lighter mass is refused.
 */
static void test_mass_acts(void)
{
    const carom_v3_q40 force = {{ONE / 2, 0, 0}};
    struct carom_contact contact[16];
    int64_t sum = 0;
    int count;

    setup_asleep();
    CHECK_EQ(carom_body_set_mass(world, 1, 1 << 20), CAROM_OK);
    CHECK(state_of(1).asleep); /* setting the same mass changes nothing */
    CHECK_EQ(carom_body_set_mass(world, 1, 3 << 20), CAROM_OK);
    CHECK(!state_of(1).asleep);
    steps(1);
    count = carom_contacts(world, contact, 16);
    for (int i = 0; i < count && i < 16; i++) {
        sum += contact[i].impulse_q40;
    }
    CHECK_NEAR(sum, 3 * G, G / 50);
    CHECK_EQ(carom_body_set_force(world, 1, &force), CAROM_OK);
    CHECK_EQ(carom_body_set_mass(world, 1, 1 << 18), CAROM_ERR_RANGE);
    CHECK_EQ(carom_body_set_mass(world, 1, (1 << 10) - 1), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_body_set_mass(world, 1, (1 << 30) + 1), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_body_set_mass(world, 0, 1 << 20), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_body_set_mass(NULL, 1, 1 << 20), CAROM_ERR_NULL);
}

/* ------------------------------------------------------------- snapshots, errors */

/*
 * Kept impulses never exceed what the smaller friction allows: a snapshot saved at that moment can
 * be loaded.
 */
static void test_snapshot(void)
{
    struct carom_body_state s;
    struct carom_material m;
    int size;

    setup(2);
    steps(2);
    s = state_of(2);
    s.velocity.c[0] = ONE / 32;
    CHECK_EQ(carom_body_set(world, 2, &s), CAROM_OK);
    steps(2);
    CHECK_MORE(world->now->warm_count, 0);
    m = material_of(1);
    m.friction_q16 = 100;
    CHECK_EQ(carom_body_set_material(world, 1, &m), CAROM_OK);
    CHECK_EQ(world->now->warm_count, 0); /* all of them were body 1's */
    size = carom_snapshot_save(world, saved, sizeof saved);
    CHECK_MORE(size, 0);
    CHECK_EQ(carom_snapshot_load(world, saved, (size_t)size), CAROM_OK);
    steps(2);
    CHECK_EQ(carom_world_set_combine(world, CAROM_LARGER, CAROM_LARGER), CAROM_OK);
    steps(2);
    CHECK_EQ(carom_world_set_combine(world, CAROM_LARGER, CAROM_PRODUCT), CAROM_OK);
    size = carom_snapshot_save(world, saved, sizeof saved);
    CHECK_EQ(carom_snapshot_load(world, saved, (size_t)size), CAROM_OK);
}

static void test_refused(void)
{
    static const uint8_t of_face[32] = {[31] = 1};
    struct carom_material good, bad;
    uint64_t hash;

    setup(1);
    steps(2);
    hash = carom_world_hash(world);
    good = material_of(1);
    for (int i = 0; i < 9; i++) {
        bad = good;
        switch (i) {
        case 0:
            bad.restitution_q30 = -1;
            break;
        case 1:
            bad.restitution_q30 = CAROM_ONE_Q30 + 1;
            break;
        case 2:
            bad.friction_q16 = CAROM_MU_MAX_Q16 + 1;
            break;
        case 3:
            bad.rolling_q16 = (1 << 16) + 1;
            break;
        default:
            bad.surface_velocity.c[i % 3] = i < 6 ? 16 * ONE + 1 : INT64_MIN;
            break;
        }
        CHECK_EQ(carom_body_set_material(world, 1, &bad), CAROM_ERR_ARGUMENT);
        CHECK_EQ(carom_body_set_face_materials(world, 0, &bad, 1, of_face), CAROM_ERR_ARGUMENT);
    }
    CHECK_EQ(carom_body_set_face_materials(world, 0, &good, 1, of_face), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_body_set_face_materials(world, 0, &good, 0, of_face), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_body_set_face_materials(world, 0, &good, 257, of_face), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_body_set_face_materials(world, 0, &good, 1, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_set_material(world, 1, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_set_material(NULL, 1, &good), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_material(world, 1, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_world_set_combine(NULL, CAROM_MEAN, CAROM_MEAN), CAROM_ERR_NULL);
    CHECK_EQ(carom_world_set_combine(world, (enum carom_combine)4, CAROM_MEAN), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_world_set_combine(world, CAROM_MEAN, (enum carom_combine) - 1),
             CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_world_hash(world), hash);
    CHECK_EQ(world->pools[CAROM_POOL_extras].used, 0);
}

const struct test tests_world_material[] = {
    {"world_material/conveyor", test_conveyor},
    {"world_material/turned_conveyor", test_turned_conveyor},
    {"world_material/tracks", test_tracks},
    {"world_material/conveyor_wakes", test_conveyor_wakes},
    {"world_material/combine_friction", test_combine_friction},
    {"world_material/combine_restitution", test_combine_restitution},
    {"world_material/combine_wakes", test_combine_wakes},
    {"world_material/faces", test_faces},
    {"world_material/faces_of_box", test_faces_of_box},
    {"world_material/rolling", test_rolling},
    {"world_material/mass", test_mass},
    {"world_material/mass_acts", test_mass_acts},
    {"world_material/snapshot", test_snapshot},
    {"world_material/refused", test_refused},
    {0},
};
