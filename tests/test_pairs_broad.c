/* SPDX-License-Identifier: MIT */
/* Broad phase: pairs, their order, regions, full pools. */
#include "pairs/broad.h"
#include "lib/real.h"
#include "lib/shapes.h"
#include "lib/test.h"

#ifdef TEST_LONG
#define CASES 20000
#else
#define CASES 200
#endif

#define BODIES 4
#define PAIRS  16

static struct shape shape, ground;
static struct body bodies[BODIES];
static struct body_state states[BODIES];
static struct pair pairs[PAIRS];
static struct pool pool;

/*
 * Body 0 is a ground of 16 x 16 units, the others are boxes of 1 x 0.5 x 0.25; all are in the
 * middle.
 */
static void begin(void)
{
    pool = (struct pool){PAIRS, 0, 0, 0};
    shape_plane(&ground, 8, 2, 2048);
    shape_box(&shape, 12, 4096, 2048, 1024);
    for (int i = 0; i < BODIES; i++) {
        shape_body(i == 0 ? &ground : &shape, i > 0, &bodies[i], &states[i]);
    }
}

static int find(uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        bodies[i].search.region.at = states[i].position;
        bodies[i].search.region.q = states[i].rotation;
        bodies[i].search.state =
            broad_active(&bodies[i], &states[i]) ? BODY_REGION_MOVING : BODY_REGION_STANDING;
        if (bodies[i].def.mesh) {
            broad_set_box(&bodies[i]);
        }
    }
    return broad_pairs(pairs, &pool, bodies, states, count);
}

static bool found(uint16_t a, uint16_t b)
{
    for (uint32_t i = 0; i < pool.used; i++) {
        if (pairs[i].a == a && pairs[i].b == b) {
            return true;
        }
    }
    return false;
}

/* Every pair once: the active body first, two active ones as (higher, lower). */
static void test_order(void)
{
    static const struct pair all[] = {{1, 0}, {2, 0}, {2, 1}, {3, 0}, {3, 1}, {3, 2}};

    begin();
    CHECK_EQ(find(BODIES), CAROM_OK);
    CHECK_EQ(pool.used, 6);
    for (uint32_t i = 0; i < 6; i++) {
        CHECK_EQ(pairs[i].a, all[i].a);
        CHECK_EQ(pairs[i].b, all[i].b);
    }
    CHECK_EQ(find(2), CAROM_OK); /* forgets the last answer */
    CHECK_EQ(pool.used, 1);
}

static void test_left_out(void)
{
    begin();
    states[2].asleep = 1;
    CHECK_EQ(find(BODIES), CAROM_OK);
    CHECK(!found(2, 0));
    CHECK(found(2, 1));
    CHECK(found(3, 2)); /* an awake body may run into a sleeping one */
    CHECK_EQ(pool.used, 5);
    states[1].asleep = states[3].asleep = 1;
    CHECK_EQ(find(BODIES), CAROM_OK);
    CHECK_EQ(pool.used, 0);

    begin();
    states[2].out = 1;
    CHECK_EQ(find(BODIES), CAROM_OK);
    CHECK_EQ(pool.used, 3);
    CHECK(found(1, 0));
    CHECK(found(3, 0));
    CHECK(found(3, 1));

    begin();
    bodies[1].def.moving = bodies[3].def.moving = bodies[1].def.goes = bodies[3].def.goes = false;
    CHECK_EQ(find(BODIES), CAROM_OK);
    CHECK_EQ(pool.used, 3);
    CHECK(found(2, 0));
    CHECK(found(2, 1));
    CHECK(found(2, 3));

    begin();
    bodies[1].def.mesh = NULL; /* a free place */
    CHECK_EQ(find(BODIES), CAROM_OK);
    CHECK_EQ(pool.used, 3);
    CHECK(found(2, 0));
    CHECK(found(3, 0));
    CHECK(found(3, 2));
}

/* Boxes side by side are a pair as soon as the gap is within the sum of both reaches. */
static void test_reach(void)
{
    for (int axis = 0; axis < 3; axis++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            for (int32_t reach_q22 = 0; reach_q22 < 3 << 22; reach_q22 += 1 << 21) {
                int64_t side_q22 = (int64_t)1 << (22 - axis);

                begin();
                bodies[1].search.reach_q22 = reach_q22 / 3;
                bodies[2].search.reach_q22 = reach_q22 - reach_q22 / 3;
                states[2].position.c[axis] = sign * ((side_q22 + reach_q22) << 10);
                CHECK_EQ(find(3), CAROM_OK);
                CHECK(found(2, 1));
                states[2].position.c[axis] = sign * ((side_q22 + reach_q22 + 64) << 10);
                CHECK_EQ(find(3), CAROM_OK);
                CHECK(!found(2, 1));
            }
        }
    }
}

/* The box around a body in the world, grown by its reach, in double. */
static void real_bounds(int body, double low[3], double high[3])
{
    double q[4], m[3][3];

    for (int k = 0; k < 4; k++) {
        q[k] = states[body].rotation.c[k];
    }
    real_matrix(m, q);
    for (int k = 0; k < 3; k++) {
        low[k] = 1e9;
        high[k] = -1e9;
    }
    for (uint32_t v = 0; v < 8; v++) {
        double p[3], turned[3];

        for (int k = 0; k < 3; k++) {
            p[k] = real(shape.vertices[v][k], 12);
        }
        real_rotate(turned, m, p);
        for (int k = 0; k < 3; k++) {
            double reach = real(bodies[body].search.reach_q22, 22);
            double x = turned[k] + real(states[body].position.c[k], 32);

            low[k] = x - reach < low[k] ? x - reach : low[k];
            high[k] = x + reach > high[k] ? x + reach : high[k];
        }
    }
}

/* Any poses, far out in the world, against the boxes in double. */
static void test_poses(void)
{
    struct test_random r = {1};
    int near = 0, far = 0;

    begin();
    for (int n = 0; n < CASES; n++) {
        double low[2][3], high[2][3], gap = -1e9;

        for (int i = 1; i <= 2; i++) {
            states[i].rotation = shape_random_turn(&r);
            bodies[i].search.reach_q22 = (int32_t)test_random_range(&r, 0, 1 << 20);
            for (int k = 0; k < 3; k++) {
                states[i].position.c[k] =
                    ((int64_t)4000 << 32) + test_random_range(&r, 0, (int64_t)3 << 31);
            }
            real_bounds(i, low[i - 1], high[i - 1]);
        }
        for (int k = 0; k < 3; k++) {
            double a = low[0][k] - high[1][k], b = low[1][k] - high[0][k];

            gap = a > gap ? a : gap;
            gap = b > gap ? b : gap;
        }
        CHECK_EQ(find(3), CAROM_OK);
        if (gap <= 0) {
            CHECK(found(2, 1));
            near++;
        } else if (gap > 1e-4) {
            CHECK(!found(2, 1));
            far++;
        }
    }
    CHECK_MORE(near, CASES / 10);
    CHECK_MORE(far, CASES / 10);
}

static void test_full(void)
{
    begin();
    pool.size = 6;
    CHECK_EQ(find(BODIES), CAROM_OK);
    CHECK_EQ(pool.peak, 6);
    CHECK_EQ(pool.refused, 0);
    pool.size = 5;
    CHECK_EQ(find(BODIES), CAROM_ERR_PAIRS_FULL);
    CHECK_EQ(pool.refused, 1);
}

const struct test tests_pairs_broad[] = {
    {"pairs_broad/order", test_order}, {"pairs_broad/left_out", test_left_out},
    {"pairs_broad/reach", test_reach}, {"pairs_broad/poses", test_poses},
    {"pairs_broad/full", test_full},   {0},
};
