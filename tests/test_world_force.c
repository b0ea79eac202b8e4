/* SPDX-License-Identifier: MIT */
/*
 * Gravity that changes, lasting forces and pushes: their effect on a body in free flight, where the
 * answer is known, and the calls that are refused.
 */
#include <string.h>

#include "lib/one_world.h"
#include "lib/real.h"
#include "lib/shapes.h"
#include "lib/test.h"

#define CAPS 3, 2, 16, 16, 16, 32
#define ONE  ((int64_t)1 << 40) /* a unit, or a radian, a frame */

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static struct shape box, needle;
static struct carom_body_def def;

enum { BOX, STILL };

/* Sides of the box in units, each half of the one before. */
static const double side[3] = {2, 1, 0.5};

/* A box of mass 4 in the middle of the world, and a static one far away. */
static void setup(void)
{
    const struct carom_config config = {.caps = CAROM_CAPS(CAPS)};

    shape_box(&box, 12, 8192, 4096, 2048);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    memset(&def, 0, sizeof def);
    def.mesh = &box.mesh;
    def.mass_q20 = 4 << 20;
    CHECK_EQ(carom_body_add(world, &def), BOX);
    def.stationary = true;
    def.position.c[0] = (int64_t)1000 << 32;
    CHECK_EQ(carom_body_add(world, &def), STILL);
    def.stationary = false;
    def.position.c[0] = 0;
}

/* ------------------------------------------------------------------- gravity */

/* v = g n, and the place lacks half of the last frame's way: each frame is an exact parabola. */
static void test_gravity(void)
{
    const carom_v3_q40 down = {{0, 0, -ONE / 256}}, aside = {{ONE / 512, 0, 0}};
    uint64_t hash;

    setup();
    hash = carom_world_hash(world);
    CHECK_EQ(carom_world_set_gravity(world, &down), CAROM_OK);
    CHECK_DIFFER(carom_world_hash(world), hash); /* gravity is a part of the state */
    steps(4);
    CHECK_EQ(state_of(BOX).velocity.c[2], -ONE / 64);
    CHECK_EQ(state_of(BOX).position.c[2], -(((int64_t)1 << 32) / 256 * 8));
    CHECK_EQ(carom_world_set_gravity(world, &aside), CAROM_OK);
    steps(4);
    CHECK_EQ(state_of(BOX).velocity.c[2], -ONE / 64);
    CHECK_EQ(state_of(BOX).velocity.c[0], ONE / 128);
    CHECK_EQ(state_of(BOX).position.c[0], ((int64_t)1 << 32) / 512 * 8);
    CHECK_EQ(state_of(BOX).position.c[2], -(((int64_t)1 << 32) / 256 * 24));
    CHECK_EQ(state_of(STILL).position.c[2], 0);
}

static void test_gravity_refused(void)
{
    carom_v3_q40 gravity = {{0, 0, 0}}, force = {{0, 4 * ONE, 0}};

    setup();
    REFUSE(carom_world_set_gravity(NULL, &gravity), CAROM_ERR_NULL);
    REFUSE(carom_world_set_gravity(world, NULL), CAROM_ERR_NULL);
    for (int k = 0; k < 3; k++) {
        static const int64_t bad[] = {ONE + 1, -ONE - 1, INT64_MAX, INT64_MIN};

        for (int i = 0; i < 4; i++) {
            gravity = (carom_v3_q40){{0, 0, 0}};
            gravity.c[k] = bad[i];
            REFUSE(carom_world_set_gravity(world, &gravity), CAROM_ERR_RANGE);
        }
        gravity.c[k] = -ONE;
        CHECK_EQ(carom_world_set_gravity(world, &gravity), CAROM_OK);
    }
    /* it is too much together with the body's force: already 1 along y */
    gravity = (carom_v3_q40){{0, 0, 0}};
    CHECK_EQ(carom_world_set_gravity(world, &gravity), CAROM_OK);
    CHECK_EQ(carom_body_set_force(world, BOX, &force), CAROM_OK);
    gravity.c[1] = 1;
    REFUSE(carom_world_set_gravity(world, &gravity), CAROM_ERR_RANGE);
    gravity.c[1] = -ONE;
    CHECK_EQ(carom_world_set_gravity(world, &gravity), CAROM_OK);
}

/* --------------------------------------------------------------------- forces */

/* A force of m a for 8 frames, then one that cancels gravity, then none. */
static void test_force(void)
{
    const carom_v3_q40 gravity = {{0, 0, -ONE / 256}}, none = {{0, 0, 0}};
    const carom_v3_q40 up = {{0, 0, ONE / 64}}, push = {{4 * ONE / 128, 0, 0}};
    struct carom_body_state s;

    setup();
    CHECK_EQ(carom_body_set_force(world, BOX, &push), CAROM_OK);
    steps(8);
    s = state_of(BOX);
    CHECK_EQ(s.velocity.c[0], ONE / 16);
    CHECK_EQ(s.position.c[0], (int64_t)1 << 30);                            /* 64 / 2 / 128 */
    CHECK_EQ(s.spin.c[0] | s.spin.c[1] | s.spin.c[2] | s.rotation.c[1], 0); /* on the centre */
    CHECK_EQ(carom_world_set_gravity(world, &gravity), CAROM_OK);
    CHECK_EQ(carom_body_set_force(world, BOX, &up), CAROM_OK);
    steps(8);
    CHECK_EQ(state_of(BOX).velocity.c[2], 0);
    CHECK_EQ(state_of(BOX).velocity.c[0], ONE / 16);
    /* the force stays when the body is set */
    CHECK_EQ(carom_body_set(world, BOX, &s), CAROM_OK);
    steps(1);
    CHECK_EQ(state_of(BOX).velocity.c[2], 0);
    CHECK_EQ(carom_body_set_force(world, BOX, &none), CAROM_OK);
    steps(4);
    CHECK_EQ(state_of(BOX).velocity.c[2], -ONE / 64);
    /* and the next body with that number does not have it */
    CHECK_EQ(carom_body_set_force(world, BOX, &up), CAROM_OK);
    CHECK_EQ(carom_body_remove(world, BOX), CAROM_OK);
    CHECK_EQ(carom_body_add(world, &def), BOX);
    steps(1);
    CHECK_EQ(state_of(BOX).velocity.c[2], -ONE / 256);
}

static void test_force_refused(void)
{
    const carom_v3_q40 gravity = {{0, 0, -ONE / 2}};
    carom_v3_q40 force = {{0, 0, 0}};

    setup();
    CHECK_EQ(carom_world_set_gravity(world, &gravity), CAROM_OK);
    REFUSE(carom_body_set_force(NULL, BOX, &force), CAROM_ERR_NULL);
    REFUSE(carom_body_set_force(world, BOX, NULL), CAROM_ERR_NULL);
    REFUSE(carom_body_set_force(world, -1, &force), CAROM_ERR_BODY);
    REFUSE(carom_body_set_force(world, 2, &force), CAROM_ERR_BODY);
    REFUSE(carom_body_set_force(world, INT32_MIN, &force), CAROM_ERR_BODY);
    REFUSE(carom_body_set_force(world, STILL, &force), CAROM_ERR_ARGUMENT);
    for (int k = 0; k < 3; k++) {
        /* by mass, the rest up to 1 and down to -1 */
        int64_t most = 4 * (ONE - gravity.c[k]), least = 4 * (-ONE - gravity.c[k]);
        const int64_t bad[] = {most + 4, least - 4, INT64_MAX, INT64_MIN, 16 * ONE, -16 * ONE};

        for (int i = 0; i < 6; i++) {
            force = (carom_v3_q40){{0, 0, 0}};
            force.c[k] = bad[i];
            REFUSE(carom_body_set_force(world, BOX, &force), CAROM_ERR_RANGE);
        }
        force.c[k] = most;
        CHECK_EQ(carom_body_set_force(world, BOX, &force), CAROM_OK);
        force.c[k] = least;
        CHECK_EQ(carom_body_set_force(world, BOX, &force), CAROM_OK);
    }
}

/* --------------------------------------------------------------------- pushes */

/* Through the centre: P / m in any pose, and no spin. */
static void test_push_centre(void)
{
    struct test_random r = {1};

    setup();
    for (int n = 0; n < 20; n++) {
        struct carom_body_state s = state_of(BOX);
        carom_v3_q40 p;

        s.rotation = shape_random_turn(&r);
        for (int k = 0; k < 3; k++) {
            s.position.c[k] = test_random_range(&r, -((int64_t)4000 << 32), (int64_t)4000 << 32);
            s.velocity.c[k] = test_random_range(&r, -ONE, ONE);
            p.c[k] = 4 * test_random_range(&r, -ONE, ONE);
        }
        memset(&s.spin, 0, sizeof s.spin);
        CHECK_EQ(carom_body_set(world, BOX, &s), CAROM_OK);
        CHECK_EQ(carom_body_push(world, BOX, &p, &s.position), CAROM_OK);
        for (int k = 0; k < 3; k++) {
            CHECK_EQ(state_of(BOX).velocity.c[k], s.velocity.c[k] + p.c[k] / 4);
            CHECK_EQ(state_of(BOX).spin.c[k], 0);
            CHECK_EQ(state_of(BOX).position.c[k], s.position.c[k]);
        }
    }
}

/*
 * Anywhere else the spin grows by w = R I^-1 R^T (r x P); I = m (b^2 + c^2) / 12 about an axis,
 * with b and c the sides across it.
 */
static void test_push_aside(void)
{
    struct test_random r = {2};

    setup();
    for (int n = 0; n < 20; n++) {
        struct carom_body_state s = state_of(BOX), after;
        double q[4], m[3][3], arm[3], p[3], moment[3], own[3], w[3];
        carom_v3_q40 p_q40;
        carom_v3_q32 point;

        s.rotation = shape_random_turn(&r);
        for (int k = 0; k < 3; k++) {
            s.spin.c[k] = test_random_range(&r, -ONE, ONE);
            p_q40.c[k] = test_random_range(&r, -ONE, ONE);
            point.c[k] =
                s.position.c[k] + test_random_range(&r, -((int64_t)2 << 32), (int64_t)2 << 32);
        }
        CHECK_EQ(carom_body_set(world, BOX, &s), CAROM_OK);
        s = state_of(BOX);
        CHECK_EQ(carom_body_push(world, BOX, &p_q40, &point), CAROM_OK);
        after = state_of(BOX);
        for (int k = 0; k < 4; k++) {
            q[k] = s.rotation.c[k];
        }
        real_matrix(m, q);
        for (int k = 0; k < 3; k++) {
            arm[k] = real(point.c[k] - s.position.c[k], 32);
            p[k] = real(p_q40.c[k], 40);
        }
        for (int k = 0; k < 3; k++) {
            moment[k] = arm[(k + 1) % 3] * p[(k + 2) % 3] - arm[(k + 2) % 3] * p[(k + 1) % 3];
        }
        for (int k = 0; k < 3; k++) {
            double b = side[(k + 1) % 3], c = side[(k + 2) % 3];

            own[k] = m[0][k] * moment[0] + m[1][k] * moment[1] + m[2][k] * moment[2];
            own[k] *= 12 / (4 * (b * b + c * c));
        }
        real_rotate(w, m, own);
        for (int k = 0; k < 3; k++) {
            double change = real(after.spin.c[k] - s.spin.c[k], 40);

            CHECK_LESS(real_abs(change - w[k]), 1e-7);
        }
    }
}

static void test_push_refused(void)
{
    const carom_v3_q40 small = {{ONE / 16, 0, 0}};
    const carom_v3_q32 origin = {{0, 0, 0}};
    struct carom_body_state s;

    setup();
    REFUSE(carom_body_push(NULL, BOX, &small, &origin), CAROM_ERR_NULL);
    REFUSE(carom_body_push(world, BOX, NULL, &origin), CAROM_ERR_NULL);
    REFUSE(carom_body_push(world, BOX, &small, NULL), CAROM_ERR_NULL);
    REFUSE(carom_body_push(world, -1, &small, &origin), CAROM_ERR_BODY);
    REFUSE(carom_body_push(world, 2, &small, &origin), CAROM_ERR_BODY);
    REFUSE(carom_body_push(world, STILL, &small, &origin), CAROM_ERR_ARGUMENT);
    for (int k = 0; k < 3; k++) {
        static const int64_t bad_place[] = {((int64_t)4096 << 32) + 1, -((int64_t)4096 << 32) - 1,
                                            INT64_MAX, INT64_MIN};
        /* mass 4, and the speed must stay below 64 */
        static const int64_t bad_push[] = {256 * ONE, -256 * ONE, 600 * ONE, INT64_MAX, INT64_MIN};

        for (int i = 0; i < 4; i++) {
            carom_v3_q32 point = origin;

            point.c[k] = bad_place[i];
            REFUSE(carom_body_push(world, BOX, &small, &point), CAROM_ERR_RANGE);
        }
        for (int i = 0; i < 5; i++) {
            carom_v3_q40 p = {{0, 0, 0}};
            carom_v3_q32 point = {{0, 0, 0}};

            p.c[k] = bad_push[i];
            REFUSE(carom_body_push(world, BOX, &p, &point), CAROM_ERR_RANGE);
            /* and far from its centre, where the moment does not fit 64 bits */
            point.c[(k + 1) % 3] = (int64_t)4096 << 32;
            REFUSE(carom_body_push(world, BOX, &p, &point), CAROM_ERR_RANGE);
        }
    }
    /* from one limit to the other: 63 to -63 */
    s = state_of(BOX);
    s.velocity.c[0] = 63 * ONE;
    CHECK_EQ(carom_body_set(world, BOX, &s), CAROM_OK);
    REFUSE(carom_body_push(world, BOX, &(carom_v3_q40){{4 * ONE, 0, 0}}, &origin), CAROM_ERR_RANGE);
    CHECK_EQ(carom_body_push(world, BOX, &(carom_v3_q40){{-4 * 126 * ONE, 0, 0}}, &origin),
             CAROM_OK);
    CHECK_EQ(state_of(BOX).velocity.c[0], -63 * ONE);
}

/*
 * A bar of 2 x 1/512 x 1/512 units. A push across it turns it as the formula says; about its axis
 * the same moment would make it a million times as fast.
 */
static void test_push_needle(void)
{
    const carom_v3_q40 p = {{0, ONE, 0}};
    carom_v3_q32 point = {{(int64_t)1 << 32, 0, 0}};
    int body;

    setup();
    shape_box(&needle, 12, 8192, 8, 8);
    def.mesh = &needle.mesh;
    def.mass_q20 = 1 << 20;
    def.position.c[1] = (int64_t)100 << 32;
    body = carom_body_add(world, &def);
    CHECK_EQ(body, 2);
    point.c[1] = def.position.c[1];
    CHECK_EQ(carom_body_push(world, body, &p, &point), CAROM_OK);
    CHECK_LESS(real_abs(real(state_of(body).spin.c[2], 40) - 3), 1e-5); /* 12 / (2^2) */
    point.c[0] = 0;
    point.c[2] = (int64_t)1 << 32;
    REFUSE(carom_body_push(world, body, &p, &point), CAROM_ERR_RANGE);
}

const struct test tests_world_force[] = {{"world_force/gravity", test_gravity},
                                         {"world_force/gravity_refused", test_gravity_refused},
                                         {"world_force/force", test_force},
                                         {"world_force/force_refused", test_force_refused},
                                         {"world_force/push_centre", test_push_centre},
                                         {"world_force/push_aside", test_push_aside},
                                         {"world_force/push_refused", test_push_refused},
                                         {"world_force/push_needle", test_push_needle},
                                         {0}};
