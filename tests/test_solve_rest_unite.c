/* SPDX-License-Identifier: MIT */
/* An island that moves as one rigid body, or rests: the last resort of a step. */
#include "solve/rigid.h"
#include "lib/hand.h"
#include "lib/real.h"

static const struct pair chain[2] = {{2, 1}, {3, 2}};

static void join(uint32_t count)
{
    island_begin(hand.bodies, HAND_BODIES);
    for (uint32_t i = 0; i + 1 < count; i++) {
        island_join(hand.bodies, &chain[i]);
    }
    island_end(hand.bodies, HAND_BODIES);
}

static void put(int body, const double x[3])
{
    for (int k = 0; k < 3; k++) {
        hand.states[body].position.c[k] = real_round(x[k] * real_power2(32));
    }
    body_place(&hand.bodies[body], &hand.states[body]);
}

/* Twice the energy of bodies 1 to `count`, from their masses and their inertia about their axes. */
static double energy2(uint32_t count)
{
    double sum = 0;

    for (uint32_t i = 1; i <= count; i++) {
        double v[3], w[3], p[3], l[3];

        hand_velocity_of((int)i, v, w);
        for (int k = 0; k < 3; k++) {
            p[k] = real(hand.states[i].momentum.c[k], 40);
            l[k] = real(hand.states[i].angular.c[k], 40);
        }
        sum += real_dot(p, v) + real_dot(l, w);
    }
    return sum;
}

/* Sums of p and, about the origin, of x x p + L with 72 fractional bits, both modulo 2^64. */
struct sums {
    uint64_t linear[3], angular[3];
};

static struct sums sums_of(uint32_t count)
{
    struct sums sums = {{0}, {0}};

    for (uint32_t i = 1; i <= count; i++) {
        const struct body_state *s = &hand.states[i];

        for (int k = 0; k < 3; k++) {
            int m = (k + 1) % 3, n = (k + 2) % 3;

            sums.linear[k] += (uint64_t)s->momentum.c[k];
            sums.angular[k] += (uint64_t)s->position.c[m] * (uint64_t)s->momentum.c[n] -
                               (uint64_t)s->position.c[n] * (uint64_t)s->momentum.c[m] +
                               ((uint64_t)s->angular.c[k] << 32);
        }
    }
    return sums;
}

static void check_kept(const struct sums *before, uint32_t count)
{
    struct sums after = sums_of(count);

    for (int k = 0; k < 3; k++) {
        /* half a unit of the last place, 2^-40 */
        int64_t off_q72 = (int64_t)(after.angular[k] - before->angular[k]);

        CHECK_EQ(after.linear[k], before->linear[k]);
        CHECK_AT_MOST(off_q72, (int64_t)1 << 31);
        CHECK_AT_LEAST(off_q72, -((int64_t)1 << 31));
    }
}

/*
 * Whether all bodies move as body 1 does: v - v1 = w1 x (x - x1), and w = w1. Bodies that are far
 * apart may be off by 2^-20 of their speeds, because arms and spins have 30 bits.
 */
static bool moves_as_one(uint32_t count)
{
    double v1[3], w1[3];
    bool one = true;

    hand_velocity_of(1, v1, w1);
    for (uint32_t i = 2; i <= count; i++) {
        double v[3], w[3], x[3], speed;

        hand_velocity_of((int)i, v, w);
        for (int k = 0; k < 3; k++) {
            x[k] = real(hand.states[i].position.c[k] - hand.states[1].position.c[k], 32);
        }
        speed = real_length(v1) + real_length(w1) * (1 + real_length(x));
        for (int k = 0; k < 3; k++) {
            int m = (k + 1) % 3, n = (k + 2) % 3;

            one = one && real_abs(w[k] - w1[k]) < speed * real_power2(-20) &&
                  real_abs(v[k] - v1[k] - w1[m] * x[n] + w1[n] * x[m]) < speed * real_power2(-20);
        }
    }
    return one;
}

/*
 * Two cubes of mass 1 and J = 1/6 at x = -1/2 and 1/2 fly past each other along y: they turn about
 * z by L / I, L = 2 * 1/2 * v and I = 2 (1/6 + 1/4) = 5/6. They also fly along z.
 */
static void test_pair(void)
{
    struct sums before;
    double v[3], w[3];

    hand_make_cube();
    hand_begin(2, 0);
    put(1, (double[3]){-0.5, 0, 0});
    put(2, (double[3]){0.5, 0, 0});
    hand_set_motion(1, (double[3]){0.25, -0.125, 0.0625}, (double[3]){0.25, 0, 0});
    hand_set_motion(2, (double[3]){-0.25, 0.125, 0.0625}, (double[3]){-0.25, 0, 0});
    join(2);
    before = sums_of(2);
    rest_unite(&hand.rest, hand.bodies[2].island.lowest, false);
    check_kept(&before, 2);
    for (int i = 1; i <= 2; i++) {
        hand_velocity_of(i, v, w);
        CHECK_LESS(real_abs(v[0]), 1e-9);
        CHECK_LESS(real_abs(v[2] - 0.0625), 1e-9);
        CHECK_LESS(real_abs(v[1] - (i == 1 ? -0.075 : 0.075)), 1e-9); /* 1/2 w */
        CHECK_LESS(real_abs(w[0]), 1e-9);
        CHECK_LESS(real_abs(w[1]), 1e-9);
        CHECK_LESS(real_abs(w[2] - 0.15), 1e-9);
    }
}

/* An island on the ground is at rest; a single body in the air keeps its motion. */
static void test_grounded(void)
{
    for (int grounded = 0; grounded < 2; grounded++) {
        struct body_state before;

        hand_make_box();
        hand_begin(3, 0);
        for (int i = 1; i <= 3; i++) {
            hand_set_motion(i, (double[3]){0.25, -0.5, 1}, (double[3]){0.5, 0.25, 0.125});
        }
        join(grounded ? 2 : 1);
        before = hand.states[1];
        rest_unite(&hand.rest, 1, grounded);
        if (grounded) {
            for (int i = 1; i <= 2; i++) {
                for (int k = 0; k < 3; k++) {
                    CHECK_EQ(hand.states[i].momentum.c[k], 0);
                    CHECK_EQ(hand.states[i].angular.c[k], 0);
                }
            }
        } else {
            CHECK_EQ(memcmp(&before, &hand.states[1], sizeof before), 0);
        }
        /* no other body moves */
        CHECK_EQ(hand.states[3].momentum.c[2], hand.states[3].momentum.c[0] * 4);
        CHECK_MORE(hand.states[3].momentum.c[2], 0);
    }
}

/* Any poses, motions and masses to 1000:1: both total momenta stay, and energy does not rise. */
static void test_random(void)
{
    struct test_random r = {12};

    for (int n = 0; n < (TEST_BARS ? 50 : 2000); n++) {
        uint32_t count = n % 2 ? 3 : 2;
        struct sums before;
        double energy;

        shape_plane(&hand.ground, 9, 2, 4096);
        shape_box(&hand.solid, 12, 4096, (int)test_random_range(&r, 200, 4096),
                  (int)test_random_range(&r, 200, 4096));
        hand_begin(3, 0);
        for (uint32_t i = 1; i <= count; i++) {
            double x[3], v[3], w[3];

            for (int k = 0; k < 3; k++) {
                x[k] = (double)test_random_range(&r, -4096, 4096) / (n % 3 ? 1024 : 512);
                v[k] = (double)test_random_range(&r, -4096, 4096) / (n % 5 ? 4096 : 256);
                w[k] = (double)test_random_range(&r, -4096, 4096) / 4096;
            }
            body_set_mass(&hand.bodies[i], fix_scale(test_random_range(&r, 1, 1000) << 30, 39));
            hand.states[i].rotation = shape_random_turn(&r);
            put((int)i, x);
            hand_set_motion((int)i, v, w);
        }
        join(count);
        before = sums_of(count);
        energy = energy2(count);
        rest_unite(&hand.rest, 1, false);
        check_kept(&before, count);
        CHECK_AT_MOST(energy2(count), energy * (1 + 1e-9));
        CHECK(moves_as_one(count));
        /* doing it twice changes nothing more */
        energy = energy2(count);
        before = sums_of(count);
        rest_unite(&hand.rest, 1, false);
        check_kept(&before, count);
        CHECK_AT_MOST(real_abs(energy2(count) - energy), energy * 1e-7);
    }
}

/*
 * Two bodies of half a 2^-11 of a unit, 64 units from each other: about the line through both they have no inertia that 30 bits would
 * show, so no rigid motion is found. They go on as they do.
 */
static void test_line(void)
{
    const double x[2][3] = {{-32, 0, 0}, {32, 0, 0}};
    struct body_state before[2];

    shape_plane(&hand.ground, 9, 2, 4096);
    shape_box(&hand.solid, 12, 2, 2, 2);
    hand_begin(2, 0);
    for (int i = 1; i <= 2; i++) {
        body_set_mass(&hand.bodies[i], fix_scale(1 << 30, 30));
        put(i, x[i - 1]);
        hand_set_motion(i, (double[3]){i, 1, 0}, (double[3]){0.5, 0, 0});
    }
    join(2);
    memcpy(before, &hand.states[1], sizeof before);
    rest_unite(&hand.rest, 1, false);
    CHECK_EQ(memcmp(before, &hand.states[1], sizeof before), 0);
    put(2, (double[3]){-31.9995, 0, 0}); /* side by side they have one */
    rest_unite(&hand.rest, 1, false);
    CHECK(moves_as_one(2));
    CHECK_DIFFER(memcmp(before, &hand.states[1], sizeof before), 0);
}

/* An island whose bodies all sleep, or are out of the world, has no motion. */
static void test_nobody(void)
{
    struct rest_rigid rigid;

    hand_make_cube();
    hand_begin(2, 0);
    join(2);
    CHECK(rest_rigid_motion(&hand.rest, 1, &rigid));
    CHECK(!rest_is_alone(&hand.rest, 1));
    hand.states[1].asleep = 1;
    CHECK(rest_is_alone(&hand.rest, 1));
    CHECK(rest_rigid_motion(&hand.rest, 1, &rigid));
    CHECK_EQ(rigid.first, 2);
    hand.states[2].out = 1;
    CHECK(rest_is_alone(&hand.rest, 1));
    CHECK(!rest_rigid_motion(&hand.rest, 1, &rigid));
}

/* ----------------------------------------------------------------- a whole frame */

/* The place and the axes of a body as body 1 sees them. */
struct view {
    double place[3], axes[3][3];
};

static struct view view_of(int body)
{
    double m[2][3][3], q[4], x[3];
    struct view view;

    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 4; k++) {
            q[k] = real(hand.states[i == 0 ? 1 : body].rotation.c[k], 30);
        }
        real_matrix(m[i], q);
    }
    for (int k = 0; k < 3; k++) {
        x[k] = real(hand.states[body].position.c[k] - hand.states[1].position.c[k], 32);
    }
    real_rotate_back(view.place, m[0], x);
    for (int k = 0; k < 3; k++) {
        double column[3] = {m[1][0][k], m[1][1][k], m[1][2][k]};

        real_rotate_back(view.axes[k], m[0], column);
    }
    return view;
}

static void check_views(const struct view *a, const struct view *b)
{
    double far = 1 + real_length(a->place);

    for (int k = 0; k < 3; k++) {
        CHECK_LESS(real_abs(a->place[k] - b->place[k]), far * 3e-8);
        for (int j = 0; j < 3; j++) {
            CHECK_LESS(real_abs(a->axes[k][j] - b->axes[k][j]), 3e-8);
        }
    }
}

/* The turn of body 1 since `before` as a rotation vector, for less than a radian. */
static void turn_since(const struct body_state *before, double turn[3])
{
    double q[4], p[4], dot = 0, length;

    for (int k = 0; k < 4; k++) {
        p[k] = real(before->rotation.c[k], 30);
        q[k] = real(hand.states[1].rotation.c[k], 30);
        dot += p[k] * q[k];
    }
    /* the vector part of q p^-1 */
    turn[0] = q[1] * p[0] - q[0] * p[1] - q[2] * p[3] + q[3] * p[2];
    turn[1] = q[2] * p[0] - q[0] * p[2] - q[3] * p[1] + q[1] * p[3];
    turn[2] = q[3] * p[0] - q[0] * p[3] - q[1] * p[2] + q[2] * p[1];
    length = real_length(turn);
    for (int k = 0; k < 3; k++) {
        /* asin x is x + x^3 / 6 */
        turn[k] *= (dot < 0 ? -2 : 2) * (1 + length * length / 6);
    }
}

/* Move the bodies for a frame as one body. The bodies' paths are those of their new places. */
static void go(uint32_t count, const carom_v3_q40 *pull)
{
    struct rest_rigid rigid;

    CHECK(rest_rigid_motion(&hand.rest, 1, &rigid));
    rest_go_rigid(&hand.rest, &rigid, pull);
    for (uint32_t i = 1; i <= count; i++) {
        body_place(&hand.bodies[i], &hand.states[i]);
    }
}

/* A random island that moves as one rigid body. */
static void make_island(struct test_random *r, uint32_t count, int n)
{
    shape_plane(&hand.ground, 9, 2, 4096);
    shape_box(&hand.solid, 12, 4096, (int)test_random_range(r, 400, 4096),
              (int)test_random_range(r, 400, 4096));
    hand_begin(3, 0);
    for (uint32_t i = 1; i <= count; i++) {
        double x[3], v[3], w[3];

        for (int k = 0; k < 3; k++) {
            x[k] = (double)test_random_range(r, -4096, 4096) / 2048;
            v[k] = (double)test_random_range(r, -4096, 4096) / (n % 5 ? 16384 : 1024);
            w[k] = (double)test_random_range(r, -4096, 4096) / (n % 5 ? 16384 : 1024);
        }
        body_set_mass(&hand.bodies[i], fix_scale(test_random_range(r, 1, 50) << 30, 39));
        hand.states[i].rotation = shape_random_turn(r);
        put((int)i, x);
        hand_set_motion((int)i, v, w);
    }
    join(count);
    rest_unite(&hand.rest, 1, false);
}

/*
 * A frame as one rigid body: the bodies keep their places to each other, and the island its momenta and its energy. The turn is that of
 * the mean of the spins before and after, but for the third order.
 */
static void test_frame(void)
{
    static const carom_v3_q40 none = {{0, 0, 0}};
    const carom_v3_q40 pull = {{(int64_t)1 << 36, -((int64_t)1 << 37), (int64_t)3 << 35}};
    struct test_random r = {31};

    for (int n = 0; n < (TEST_BARS ? 20 : 400); n++) {
        uint32_t count = n % 2 ? 3 : 2;
        struct body_state before[HAND_BODIES], after[HAND_BODIES];
        struct view views[HAND_BODIES], seen;
        struct sums sums;
        double energy, v0[3], w0[3], v[3], w[3], turn[3], fast;

        make_island(&r, count, n);
        memcpy(before, hand.states, sizeof before);
        sums = sums_of(count);
        energy = energy2(count);
        hand_velocity_of(1, v0, w0);
        for (uint32_t i = 2; i <= count; i++) {
            views[i] = view_of((int)i);
        }
        go(count, &none);
        for (uint32_t i = 2; i <= count; i++) {
            seen = view_of((int)i);
            check_views(&views[i], &seen);
        }
        CHECK(moves_as_one(count));
        /* the inertia has 30 bits, and thin islands turn by many slices */
        CHECK_LESS(real_abs(energy2(count) - energy), energy * (n % 5 ? 3e-8 : 2e-7));
        for (int k = 0; k < 3; k++) {
            CHECK_EQ(sums_of(count).linear[k], sums.linear[k]);
            /* the way is rounded to 2^-32, and momenta are below 2^7 */
            CHECK_LESS(real_abs(real((int64_t)(sums_of(count).angular[k] - sums.angular[k]), 72)),
                       real_power2(-24));
        }
        hand_velocity_of(1, v, w);
        fast = real_length(w0) > real_length(w) ? real_length(w0) : real_length(w);
        if (fast < 0.9) {
            turn_since(&before[1], turn);
            for (int k = 0; k < 3; k++) {
                CHECK_LESS(real_abs(turn[k] - (w0[k] + w[k]) / 2), 0.3 * fast * fast * fast + 1e-7);
            }
        }
        /* what pulls on all of them changes their common way and velocity, and no turn */
        memcpy(after, hand.states, sizeof after);
        memcpy(hand.states, before, sizeof before);
        go(count, &pull);
        hand_velocity_of(1, v0, w0);
        for (int k = 0; k < 3; k++) {
            CHECK_LESS(real_abs(v0[k] - v[k] - real(pull.c[k], 40)), 1e-7);
            CHECK_LESS(real_abs(w0[k] - w[k]), 1e-7 * (1 + fast));
            for (uint32_t i = 1; i <= count; i++) {
                int64_t way_q32 = hand.states[i].position.c[k] - after[i].position.c[k];

                CHECK_LESS(real_abs(real(way_q32, 32) - real(pull.c[k], 41)), 1e-9);
            }
        }
        for (uint32_t i = 1; i <= count; i++) {
            CHECK_EQ(memcmp(&hand.states[i].rotation, &after[i].rotation, sizeof after[i].rotation),
                     0);
        }
    }
}

/*
 * The turn of an island about its centre is scaled: velocities against the common one, P over the mass, and spins. The momentum stays to
 * the last bit.
 */
static void test_turn(void)
{
    struct test_random r = {32};

    for (int n = 0; n < (TEST_BARS ? 20 : 400); n++) {
        const uint32_t count = n % 2 ? 3 : 2;
        const int32_t factor_q30 = (int32_t)test_random_range(&r, 0, CAROM_ONE_Q30);
        double factor = real(factor_q30, 30), all = 0, common[3] = {0}, v[4][3], w[4][3];
        struct rest_rigid motion;
        struct sums before;

        make_island(&r, count, n);
        before = sums_of(count);
        for (uint32_t i = 1; i <= count; i++) {
            double m = real(hand.bodies[i].def.mass.m, hand.bodies[i].def.mass.e);

            hand_velocity_of((int)i, v[i], w[i]);
            all += m;
            for (int k = 0; k < 3; k++) {
                common[k] += m * v[i][k];
            }
        }
        CHECK(rest_rigid_motion(&hand.rest, 1, &motion));
        memset(&motion.spin, 0, sizeof motion.spin);
        rest_scale_turn(&hand.rest, &motion, factor_q30);
        for (int k = 0; k < 3; k++) {
            CHECK_EQ(sums_of(count).linear[k], before.linear[k]);
        }
        for (uint32_t i = 1; i <= count; i++) {
            double after[3], spin[3];

            hand_velocity_of((int)i, after, spin);
            for (int k = 0; k < 3; k++) {
                double x = common[k] / all;

                CHECK_LESS(real_abs(after[k] - x - factor * (v[i][k] - x)), 1e-7);
                CHECK_LESS(real_abs(spin[k] - factor * w[i][k]), 1e-7);
            }
        }
    }
}

const struct test tests_solve_rest_unite[] = {
    {"solve_rest_unite/pair", test_pair},
    {"solve_rest_unite/grounded", test_grounded},
    {"solve_rest_unite/random", test_random},
    {"solve_rest_unite/line", test_line},
    {"solve_rest_unite/nobody", test_nobody},
    {"solve_rest_unite/frame", test_frame},
    {"solve_rest_unite/turn", test_turn},

    {0},
};
