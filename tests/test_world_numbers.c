/* SPDX-License-Identifier: MIT */
/*
 * Numbers at the interface: SI units in both directions, sizes known at run time, speeds at the
 * limit, places and vectors between a body's axes and the world's, the texts of results.
 */
#include <string.h>

#include "lib/real.h"
#include "lib/shapes.h"
#include "lib/test.h"
#include "world/world.h"

#define CAPS 2, 2, 16, 16, 0, 32
#define ONE  ((int64_t)1 << 40)

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static struct shape box;

/* ------------------------------------------------------------------------ SI */

#define PI 3.14159265358979323846

static void test_si(void)
{
    CHECK_EQ(CAROM_POSITION_M(-3), -((int64_t)3 << 32));
    CHECK_EQ(CAROM_POSITION_MM(1500), (int64_t)3 << 31);
    CHECK_EQ(CAROM_VELOCITY_M_S(30, 60), ONE / 2);
    CHECK_EQ(CAROM_VELOCITY_MM_S(-30000, 60), -ONE / 2);
    CHECK_EQ(CAROM_GRAVITY_MM_S2(-3600000, 60), -ONE);
    CHECK_EQ(CAROM_ANGLE_MRAD(-500), -(CAROM_ONE_Q30 / 2));
    CHECK_EQ(CAROM_MASS_KG(7), 7 << 20);
    CHECK_EQ(CAROM_MASS_G(500), 1 << 19);
    CHECK_EQ(CAROM_FORCE_N(3600, 60), ONE);
    CHECK_EQ(CAROM_FORCE_MN(450000, 30), ONE / 2);
    CHECK_EQ(CAROM_IMPULSE_N_S(60, 60), ONE);
    CHECK_EQ(CAROM_IMPULSE_MN_S(30000, 60), ONE / 2);
    CHECK_EQ(CAROM_TORQUE_N_M(7200, 60), 2 * ONE);
    CHECK_EQ(CAROM_TORQUE_MN_M(-3600000, 60), -ONE);
    CHECK_EQ(CAROM_TWIST_N_M_S(120, 60), 2 * ONE);
    CHECK_EQ(CAROM_TWIST_MN_M_S(60000, 60), ONE);
    for (int deg = -1000000; deg <= 1000000; deg += 12345) {
        CHECK_LESS(real_abs(real(CAROM_SPIN_DEG_S(deg, 60), 40) - deg / 60.0 * PI / 180),
                   real_power2(-39) + real_abs(deg) * real_power2(-52));
        CHECK(deg < -114 || deg > 114 ||
              real_abs(real(CAROM_ANGLE_DEG(deg), 30) - deg * PI / 180) < real_power2(-29));
    }
    CHECK_NEAR(CAROM_ANGLE_DEG(90), 1686629713, 1); /* pi / 2 */
}

/* There and back gives the same whole number, at any frame rate. */
static void test_back(void)
{
    struct test_random r = {31};

    for (int i = 0; i < 500; i++) {
        int fps = (int)test_random_range(&r, 10, 1000);
        int64_t n = test_random_range(&r, -600 * (int64_t)fps, 600 * (int64_t)fps);
        int64_t v = test_random_range(&r, -64 * ONE, 64 * ONE);
        double by_hand = real(v, 40) * fps * 1000;

        CHECK_EQ(CAROM_TO_MM(CAROM_POSITION_MM(n)), n);
        CHECK_EQ(CAROM_TO_MM_S(CAROM_VELOCITY_MM_S(n, fps), fps), n);
        CHECK_EQ(CAROM_TO_MM_S2(CAROM_GRAVITY_MM_S2(n, fps), fps), n);
        CHECK_EQ(CAROM_TO_MRAD_S(CAROM_SPIN_MRAD_S(n, fps), fps), n);
        CHECK_EQ(CAROM_TO_MN(CAROM_FORCE_MN(n, fps), fps), n);
        CHECK_EQ(CAROM_TO_MN_S(CAROM_IMPULSE_MN_S(n, fps), fps), n);
        CHECK_NEAR(CAROM_TO_MDEG_S(CAROM_SPIN_DEG_S(n / 1000, fps), fps), n / 1000 * 1000,
                   1 + carom_abs(n) / 10000000);
        CHECK_EQ(CAROM_TO_G(CAROM_MASS_G(carom_abs(n) + 1)), carom_abs(n) + 1);
        /* rounded to nearest, for any number */
        CHECK_AT_MOST(real_abs((double)CAROM_TO_MM_S(v, fps) - by_hand), 0.5001);
    }
    CHECK_EQ(CAROM_TO_MM((int64_t)1 << 31), 500);
    CHECK_EQ(carom_scaled(-1, 1, 1), 0); /* ties go up */
    CHECK_EQ(carom_scaled(-3, 1, 1), -1);
    CHECK_EQ(CAROM_AS(double, -(ONE / 2), 40), -0.5);
}

/* --------------------------------------------------------------------- sizes */

static void test_sizes(void)
{
    struct test_random r = {32};

    for (int i = 0; i < 500; i++) {
        uint32_t v = (uint32_t)test_random_range(&r, 3, 65535);
        uint32_t f = (uint32_t)test_random_range(&r, 1, 65535);
        struct carom_caps caps;

#define PICK(name, bytes, low, high) caps.name = (uint32_t)test_random_range(&r, low, high);
        CAROM_POOLS(PICK)
#undef PICK
        if (i % 2) {
            caps.extras = caps.entries = 0;
        }
        CHECK_EQ(carom_mesh_bytes(v, f), CAROM_MESH_BYTES(v, f));
        CHECK_EQ(carom_world_bytes(&caps),
                 CAROM_WORLD_BYTES(caps.bodies, caps.pairs, caps.contacts, caps.faces, caps.entries,
                                   caps.candidates, caps.joints, caps.extras, caps.hits));
        CHECK_EQ(carom_world_bytes(&caps) % 8, 0);
    }
    CHECK_EQ(carom_world_bytes(NULL), 0);
}

/* --------------------------------------------------------------------- speeds */

/* Just below the limit a motion is accepted and goes on; at the limit it is refused. */
static void test_limit(void)
{
    struct test_random r = {33};
    const struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
    struct carom_world *world;

    shape_box(&box, 12, 8192, 4096, 2048);
    for (int n = 0; n < 200; n++) {
        struct carom_body_def def;
        struct carom_body_state s;
        int k = n % 3;

        memset(&def, 0, sizeof def);
        def.mesh = &box.mesh;
        def.mass_q20 = (uint32_t)test_random_range(&r, 1 << 10, 1 << 30);
        def.rotation = shape_random_turn(&r);
        CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
        if (n % 4 == 3) { /* 3 : 4 : 12 : 13 */
            static const int parts[3] = {3, 4, 12};

            for (int i = 0; i < 3; i++) {
                def.velocity.c[(k + i) % 3] = parts[i] * (64 * ONE / 13);
            }
        } else {
            def.velocity.c[k] = 64 * ONE - 1 - test_random_range(&r, 0, n % 4 ? 1 << 20 : 2);
        }
        CHECK_EQ(carom_body_add(world, &def), 0);
        CHECK_EQ(carom_body_get(world, 0, &s), CAROM_OK);
        for (int i = 0; i < 3; i++) {
            CHECK_NEAR(s.velocity.c[i], def.velocity.c[i], (64 * ONE) >> 24);
        }
        CHECK_EQ(carom_world_step(world), CAROM_OK);
        CHECK_EQ(carom_body_get(world, 0, &s), CAROM_OK);
        CHECK(!s.out);
        memset(&def.velocity, 0, sizeof def.velocity);
        def.velocity.c[k] = 64 * ONE;
        CHECK_EQ(carom_body_add(world, &def), CAROM_ERR_RANGE);
        /* a radius of 1.1456: with its spin */
        def.velocity.c[k] = 32 * ONE;
        def.spin.c[k] = 27 * ONE;
        CHECK_EQ(carom_body_add(world, &def), 1);
        def.spin.c[k] = 28 * ONE;
        CHECK_EQ(carom_body_remove(world, 1), CAROM_OK);
        CHECK_EQ(carom_body_add(world, &def), CAROM_ERR_RANGE);
    }
}

/* --------------------------------------------------------------------- places */

/* A vertex of the mesh in the world, by the matrix and by the call; there and back; v + w x r. */
static void test_places(void)
{
    struct test_random r = {34};
    const struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
    struct carom_body_def def;
    struct carom_world *world;

    shape_l(&box, 10, 1024);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    memset(&def, 0, sizeof def);
    def.mesh = &box.mesh;
    CHECK_EQ(carom_body_add(world, &def), 0);
    for (int n = 0; n < 50; n++) {
        double q[4], m[3][3], arm[3], w[3], turn[3];
        struct carom_matrix matrix;
        struct carom_body_state s;
        carom_v3_q32 local, point, back;
        carom_v3_q40 velocity;
        int64_t vector[3], out[3];

        memset(&s, 0, sizeof s);
        s.rotation = shape_random_turn(&r);
        for (int k = 0; k < 3; k++) {
            s.position.c[k] = test_random_range(&r, -((int64_t)4000 << 32), (int64_t)4000 << 32);
            s.velocity.c[k] = test_random_range(&r, -ONE, ONE);
            s.spin.c[k] = test_random_range(&r, -ONE, ONE);
            local.c[k] = test_random_range(&r, -((int64_t)9 << 32), (int64_t)9 << 32);
            vector[k] = test_random_range(&r, -((int64_t)1 << 59), (int64_t)1 << 59);
        }
        for (int k = 0; k < 4; k++) {
            q[k] = real(s.rotation.c[k], 30);
        }
        real_matrix(m, q);
        CHECK_EQ(carom_body_set(world, 0, &s), CAROM_OK);
        CHECK_EQ(carom_body_matrix(world, 0, &matrix), CAROM_OK);
        CHECK_EQ(carom_body_world_point(world, 0, &local, &point), CAROM_OK);
        CHECK_EQ(carom_body_local_point(world, 0, &point, &back), CAROM_OK);
        CHECK_EQ(carom_body_velocity_at(world, 0, &point, &velocity), CAROM_OK);
        CHECK_EQ(carom_body_get(world, 0, &s), CAROM_OK);
        for (int k = 0; k < 3; k++) {
            w[k] = real(s.spin.c[k], 40);
            arm[k] = real(point.c[k] - s.position.c[k], 32);
        }
        real_cross(turn, w, arm);
        CHECK_EQ(carom_body_world_vector(world, 0, vector, out), CAROM_OK);
        for (int i = 0; i < 3; i++) {
            double wanted = 0, by_matrix = real(matrix.origin.c[i], 32), turned = 0;

            for (int k = 0; k < 3; k++) {
                wanted += m[i][k] * (real(local.c[k], 32) - real(box.mesh.mass.centre.c[k], 22));
                by_matrix += real(matrix.r.c[i][k], 30) * real(local.c[k], 32);
                turned += m[i][k] * (double)vector[k];
            }
            CHECK_LESS(real_abs(real(point.c[i] - s.position.c[i], 32) - wanted), 1e-7);
            CHECK_LESS(real_abs(real(point.c[i], 32) - by_matrix), 1e-6);
            CHECK_NEAR(back.c[i], local.c[i], 256); /* 2^-24 */
            CHECK_LESS(real_abs(real(velocity.c[i] - s.velocity.c[i], 40) - turn[i]), 1e-8);
            CHECK_LESS(real_abs((double)out[i] - turned), real_power2(32));
        }
        CHECK_EQ(carom_body_local_vector(world, 0, out, out), CAROM_OK);
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(out[k], vector[k], (int64_t)1 << 35);
        }
        vector[n % 3] = n % 2 ? INT64_MIN : (int64_t)1 << 60;
        CHECK_EQ(carom_body_world_vector(world, 0, vector, out), CAROM_ERR_RANGE);
        CHECK_EQ(carom_body_local_vector(world, 0, vector, out), CAROM_ERR_RANGE);
        point.c[n % 3] = n % 2 ? INT64_MIN : ((int64_t)8192 << 32) + 1;
        CHECK_EQ(carom_body_world_point(world, 0, &point, &back), CAROM_ERR_RANGE);
        CHECK_EQ(carom_body_local_point(world, 0, &point, &back), CAROM_ERR_RANGE);
        CHECK_EQ(carom_body_velocity_at(world, 0, &point, &velocity), CAROM_ERR_RANGE);
    }
    CHECK_EQ(carom_body_matrix(world, 0, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_world_point(NULL, 0, NULL, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_body_velocity_at(world, 0, NULL, NULL), CAROM_ERR_NULL);
}

/* ---------------------------------------------------------------------- texts */

/* Every error has a text of its own; a number above the sums of status bits is a count. */
static void test_texts(void)
{
    const char *count = carom_result_text(4);

    for (int i = 1; i <= -CAROM_ERR_EXTRAS_FULL; i++) {
        CHECK_DIFFER(strcmp(carom_result_text(-i), carom_result_text(-1000)), 0);
        for (int k = 1; k < i; k++) {
            CHECK_DIFFER(strcmp(carom_result_text(-i), carom_result_text(-k)), 0);
        }
    }
    for (int i = 4; i < 100; i++) {
        CHECK_SAME(carom_result_text(i), count);
    }
    CHECK_SAME(carom_result_text(INT32_MAX), count);
    for (int i = 0; i < 4; i++) {
        CHECK_DIFFER(strcmp(carom_result_text(i), count), 0);
    }
}

const struct test tests_world_numbers[] = {
    {"world_numbers/si", test_si},
    {"world_numbers/back", test_back},
    {"world_numbers/sizes", test_sizes},
    {"world_numbers/limit", test_limit},
    {"world_numbers/places", test_places},
    {"world_numbers/texts", test_texts},
    {0},
};
