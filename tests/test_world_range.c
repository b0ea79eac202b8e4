/* SPDX-License-Identifier: MIT */
/*
 * Whole steps at the ends of a world's ranges. These tests are most useful in a build with
 * sanitizers.
 */
#include <string.h>

#include "lib/shapes.h"
#include "lib/test.h"
#include "world/world.h"

#ifdef TEST_LONG
#define STRIDE 1
#else
#define STRIDE 40 /* every STRIDE-th spin on either side of a whole number of slices */
#endif

#define CAPS 2, 1, 32, 64, 0, 256
#define FEW  2, 1, 6, 64, 0, 256
#define ONE  ((int64_t)1 << 40)

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static _Alignas(8) uint8_t few_block[CAROM_WORLD_BYTES(FEW)];
static struct shape box, ground;

/* A box a few skins above a plane, near enough for the shortest region. */
static struct carom_world *make(void)
{
    const struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
    struct carom_body_def def = {.mesh = &ground.mesh, .stationary = true};
    struct carom_world *w = NULL;

    shape_box(&box, 12, 4096, 4096, 4096);
    shape_plane(&ground, 12, 1, 16384);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &w), CAROM_OK);
    CHECK_EQ(carom_body_add(w, &def), 0);
    def.mesh = &box.mesh;
    def.stationary = false;
    def.position.c[2] = CAROM_RATIO(501, 1000, 32);
    CHECK_EQ(carom_body_add(w, &def), 1);
    return w;
}

/*
 * Slices of half a radian may leave a few units of time in a frame. Regions are then that short,
 * and are gathered for in parts. The box turns about its own axis and stays clear of the plane.
 */
static void test_slice_ends(void)
{
    struct carom_world *w = make();
    struct carom_body_state start;
    struct carom_stats stats;

    CHECK_EQ(carom_body_get(w, 1, &start), CAROM_OK);
    for (int half = 1; half <= 3; half++) {
        for (int64_t off = -1000; off <= 1000; off += STRIDE) {
            struct carom_body_state s = start;
            uint32_t slices = 0;

            s.spin.c[2] = half * ONE / 2 + off;
            CHECK_EQ(carom_body_set(w, 1, &s), CAROM_OK);
            for (int frame = 0; frame < 3; frame++) {
                CHECK_EQ(carom_world_step(w), CAROM_OK);
                CHECK_EQ(carom_stats(w, &stats), CAROM_OK);
                slices += stats.substeps;
            }
            CHECK_AT_LEAST(slices, 3 * (uint32_t)half);
            CHECK_AT_MOST(slices, 3 * (uint32_t)half + 3);
            CHECK_EQ(carom_body_get(w, 1, &s), CAROM_OK);
            CHECK_EQ(s.position.c[2], start.position.c[2]);
            CHECK_NEAR(s.spin.c[2], half * ONE / 2 + off, 16);
        }
    }
}

/*
 * The corners of a box come down on vertices of the ground: each touches the six faces around a
 * vertex. Room for the places alone is enough, and changes nothing.
 */
static void test_merged_contacts(void)
{
    const struct carom_config config[2] = {
        {.caps = CAROM_CAPS(CAPS), .gravity = {{0, 0, -CAROM_RATIO(1, 400, 40)}}},
        {.caps = CAROM_CAPS(FEW), .gravity = {{0, 0, -CAROM_RATIO(1, 400, 40)}}}};
    struct carom_world *w[2] = {NULL, NULL};
    struct carom_stats stats;

    shape_box(&box, 12, 4096, 4096, 2048);
    shape_plane(&ground, 12, 8, 2048);
    CHECK_EQ(carom_world_init(block, sizeof block, &config[0], &w[0]), CAROM_OK);
    CHECK_EQ(carom_world_init(few_block, sizeof few_block, &config[1], &w[1]), CAROM_OK);
    for (int i = 0; i < 2; i++) {
        struct carom_body_def def = {.mesh = &ground.mesh, .stationary = true};

        CHECK_EQ(carom_body_add(w[i], &def), 0);
        def.mesh = &box.mesh;
        def.stationary = false;
        def.position.c[2] = CAROM_RATIO(27, 100, 32);
        CHECK_EQ(carom_body_add(w[i], &def), 1);
    }
    for (int frame = 0; frame < 30; frame++) {
        CHECK_EQ(carom_world_step(w[0]), CAROM_OK);
        CHECK_EQ(carom_world_step(w[1]), CAROM_OK);
        CHECK_EQ(carom_world_hash(w[0]), carom_world_hash(w[1]));
    }
    CHECK_EQ(carom_stats(w[1], &stats), CAROM_OK);
    CHECK_EQ(stats.contacts, 4);
}

/*
 * The spin of a needle is computed only where it fits: about its axis, an angular momentum that is
 * small for a box is a million radians a frame.
 */
static void test_thin_spin(void)
{
    const int64_t most = (int64_t)1 << (40 + BODY_SPIN_BITS);

    for (int axis = 0; axis < 3; axis++) {
        carom_m3_q30 r;
        struct body b;
        struct body_state s;

        shape_box(&box, 12, axis == 0 ? 16000 : 8, axis == 1 ? 16000 : 8, axis == 2 ? 16000 : 8);
        shape_body(&box, true, &b, &s);
        body_set_mass(&b, fix_scale(ONE, 40));
        fix_matrix(&r, &s.rotation);
        for (int bits = 0; bits < 61; bits++) {
            carom_v3_q40 w;

            s.angular.c[axis] = (int64_t)1 << bits;
            body_spin(&b, &s, &r, &w);
            /* J = (64 + 64) / 12 quanta^2, so w = L 3 2^19 */
            CHECK_EQ(body_spin_fits(&b, &s, &r), bits + 20 < 40 + BODY_SPIN_BITS);
            CHECK_MORE(w.c[axis], 0);
            CHECK_AT_MOST(w.c[axis], most);
            CHECK(w.c[axis] == most ||
                  (w.c[axis] >> 20 >= s.angular.c[axis] && w.c[axis] >> 21 <= s.angular.c[axis]));
        }
    }
}

/* A box of half a thousandth of a unit, near the smallest radius, falls on a plane and comes to rest on its largest side. */
static void test_smallest(void)
{
    enum { HALF_Q20 = 200 };
    const struct carom_config config = {
        .caps = CAROM_CAPS(CAPS), .gravity = {{0, 0, -(ONE >> 20)}}, .sleep = true};
    const int64_t skin_q32 = (int64_t)256 << 10, lies_q32 = (int64_t)HALF_Q20 << 12;
    struct carom_body_def def = {.mesh = &ground.mesh, .stationary = true};
    struct carom_body_state s;
    struct carom_world *w = NULL;

    shape_box(&box, 20, 600, 500, 2 * HALF_Q20);
    shape_plane(&ground, 12, 1, 16384);
    CHECK_AT_MOST(box.mesh.radius_q22, 1 << 11);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &w), CAROM_OK);
    def.friction_q16 = 1 << 15;
    CHECK_EQ(carom_body_add(w, &def), 0);
    def.mesh = &box.mesh;
    def.stationary = false;
    def.mass_q20 = 1 << 20;
    def.position.c[2] = 3 * lies_q32;
    CHECK_EQ(carom_body_add(w, &def), 1);
    for (int frame = 0; frame < 400; frame++) {
        CHECK_EQ(carom_world_step(w), CAROM_OK);
    }
    CHECK_EQ(carom_body_get(w, 1, &s), CAROM_OK);
    CHECK(s.asleep);
    CHECK_MORE(s.position.c[2], lies_q32);
    CHECK_LESS(s.position.c[2], lies_q32 + 2 * skin_q32);
}

/*
 * A plate with a radius of 28 units over one with 181: places that one may reach from the other have to be within 256 units. A
 * slow plate's are. One that goes 60 units in the frame may reach 269: an error, and nothing changes.
 */
static void test_far_reach(void)
{
    const struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
    const int64_t speeds[] = {ONE, 60 * ONE};

    for (int i = 0; i < 2; i++) {
        struct carom_body_def def = {.mesh = &ground.mesh, .stationary = true};
        struct carom_world *w = NULL;
        uint64_t hash;

        shape_plane(&ground, 7, 1, 256 * 128);
        shape_box(&box, 8, 40 * 256, 40 * 256, 512);
        CHECK_EQ(carom_world_init(block, sizeof block, &config, &w), CAROM_OK);
        CHECK_EQ(carom_body_add(w, &def), 0);
        def.mesh = &box.mesh;
        def.stationary = false;
        def.mass_q20 = 1 << 20;
        def.position.c[2] = CAROM_RATIO(4, 1, 32);
        def.velocity.c[0] = speeds[i];
        CHECK_EQ(carom_body_add(w, &def), 1);
        hash = carom_world_hash(w);
        CHECK_EQ(carom_world_step(w), i == 0 ? CAROM_OK : CAROM_ERR_RANGE);
        CHECK_EQ(carom_world_hash(w) == hash, i == 1);
    }
}

/*
 * The mean square of the speeds by which the points of a body turn is J^-1 (L / m) . L / m, which is below 2^20: with J^-1 = (1, 1, 2) it
 * is the sum of x^2, y^2 and 2 z^2. The first three numbers give 2^100 - 1 units of 2^-80, the largest that is in range.
 */
static void test_mean_square(void)
{
    static const int64_t parts[3] = {795550400750197, 30411510653202, 562949953421359};
    struct body b;
    struct body_state s;

    shape_box(&box, 12, 4096, 4096, 4096);
    shape_body(&box, true, &b, &s);
    box.mesh.inverse = (struct carom_sym3){{1 << 29, 1 << 29, 1 << 30, 0, 0, 0}, 29};
    memset(&box.mesh.inverse_rest, 0, sizeof box.mesh.inverse_rest);
    body_set_mass(&b, fix_scale(1, 0));
    memcpy(s.angular.c, parts, sizeof parts);
    CHECK(world_in_range(&b, &s));
    s.angular.c[1]++;
    CHECK(!world_in_range(&b, &s));
    s.angular = (carom_v3_q40){{ONE << 10, 0, 0}};
    CHECK(!world_in_range(&b, &s));
    s.angular.c[0]--;
    CHECK(world_in_range(&b, &s));
}

const struct test tests_world_range[] = {
    {"world_range/far_reach", test_far_reach},
    {"world_range/thin_spin", test_thin_spin},
    {"world_range/merged_contacts", test_merged_contacts},
    {"world_range/slice_ends", test_slice_ends},
    {"world_range/smallest", test_smallest},
    {"world_range/mean_square", test_mean_square},
    {0},
};
