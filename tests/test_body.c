/* SPDX-License-Identifier: MIT */
/* Bodies and their paths: rotation, free fall, slices, inertia. */
#include "lib/real.h"
#include "lib/shapes.h"
#include "lib/test.h"

#ifdef TEST_LONG
#define CASES  3000
#define TUMBLE 1000000
#else
#define CASES  40
#define TUMBLE 1000
#endif

static struct shape shape;
static struct body body;
static struct body_state state;

/* A box of three different sides, about 1 unit: 1 x 0.6 x 0.3. */
static void make_box(void)
{
    shape_box(&shape, 12, 4096, 2458, 1228);
    shape_body(&shape, true, &body, &state);
}

/* A cube of side and mass 1, whose inertia is the same about every axis. */
static void make_cube(void)
{
    shape_box(&shape, 12, 4096, 4096, 4096);
    shape_body(&shape, true, &body, &state);
}

static void random_vector(struct test_random *r, double size, int64_t v[3], int bits)
{
    int64_t most = real_round(size * real_power2(bits) / 1.7320508);

    for (int k = 0; k < 3; k++) {
        v[k] = test_random_range(r, -most, most);
    }
}

/* Any place, rotation and motion. */
static void random_state(struct test_random *r, double speed, double spin)
{
    carom_v3_q40 v, w;

    state.rotation = shape_random_turn(r);
    random_vector(r, 2000, state.position.c, 32);
    random_vector(r, speed, v.c, 40);
    random_vector(r, spin, w.c, 40);
    body_set_motion(&body, &state, &v, &w);
}

static void real_vector(double out[3], const int64_t v[3], int bits)
{
    for (int k = 0; k < 3; k++) {
        out[k] = real(v[k], bits);
    }
}

static void real_quaternion(double m[3][3], const carom_quat_q30 *q)
{
    double p[4];

    for (int k = 0; k < 4; k++) {
        p[k] = q->c[k];
    }
    real_matrix(m, p);
}

static void real_sym3(double m[3][3], const struct carom_sym3 *s)
{
    static const uint8_t place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

    for (int k = 0; k < 9; k++) {
        m[k / 3][k % 3] = real(s->m[place[k / 3][k % 3]], s->e);
    }
}

/* ---------------------------------------------------------------- rotation */

static void test_matrix(void)
{
    struct test_random r = {1};

    for (int n = 0; n < CASES; n++) {
        carom_quat_q30 q = shape_random_turn(&r);
        carom_m3_q30 m;
        double exact[3][3];

        body_normalise(&q);
        fix_matrix(&m, &q);
        real_quaternion(exact, &q);
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 3; k++) {
                int64_t dot = carom_round(carom_dot(m.c[i], m.c[k]), 30);

                CHECK_NEAR(dot, i == k ? CAROM_ONE_Q30 : 0, 12);
                /* the check leaves |q|^2 within 4 units of 1, which doubles in the matrix */
                CHECK_NEAR(m.c[i][k], real_round(exact[i][k] * CAROM_ONE_Q30), 6);
            }
        }
    }
}

static void test_normalise(void)
{
    struct test_random r = {2};

    for (int n = 0; n < CASES; n++) {
        carom_quat_q30 unit = shape_random_turn(&r), q;
        double size = 0.95 + 0.1 * real(test_random_range(&r, 0, 1024), 10);

        for (int k = 0; k < 4; k++) {
            q.c[k] = (int32_t)real_round(size * unit.c[k]);
        }
        body_normalise(&q);
        for (int k = 0; k < 4; k++) {
            CHECK_NEAR(q.c[k], unit.c[k], 3);
        }
    }
}

/* out = v turned about the unit vector of u by 2 atan |u|: Rodrigues' formula. */
static void turn_by_cayley(double out[3], const double u[3], const double v[3])
{
    double s2 = real_dot(u, u), c[3], uv = real_dot(u, v);

    real_cross(c, u, v);
    for (int k = 0; k < 3; k++) {
        out[k] = ((1 - s2) * v[k] + 2 * c[k] + 2 * uv * u[k]) / (1 + s2);
    }
}

/*
 * A body with the same inertia about every axis turns about its spin; the angle at t is 2 atan(t
 * |u|).
 */
static void test_turn(void)
{
    struct test_random r = {3};

    make_cube();
    for (int n = 0; n < CASES; n++) {
        int32_t tau_q30 = (int32_t)test_random_range(&r, 1 << 20, CAROM_ONE_Q30);
        int32_t t_q30 = (int32_t)test_random_range(&r, 0, CAROM_ONE_Q30);
        double start[3][3], w[3], u[3];
        carom_quat_q30 q;
        carom_m3_q30 m, turned;
        carom_v3_q40 spin;
        int32_t u_world[3];

        random_state(&r, 1, 0.4);
        fix_matrix(&m, &state.rotation);
        body_spin(&body, &state, &m, &spin);
        body_predict(&body, &state, tau_q30, NULL);
        q = body_rotation_at(&body, t_q30);
        fix_matrix(&turned, &q);
        real_vector(w, spin.c, 40);
        real_quaternion(start, &state.rotation);
        carom_rotate(u_world, &m, body.path.u.c);
        for (int k = 0; k < 3; k++) {
            u[k] = w[k] * real(tau_q30, 30) / 2;
            CHECK_NEAR(u_world[k], real_round(u[k] * CAROM_ONE_Q30), 4);
            u[k] *= real(t_q30, 30);
        }
        CHECK_EQ(body.path.turns, real_length(u) > 0);
        for (int axis = 0; axis < 3; axis++) {
            double from[3] = {start[0][axis], start[1][axis], start[2][axis]}, to[3];

            turn_by_cayley(to, u, from);
            for (int k = 0; k < 3; k++) {
                CHECK_NEAR(turned.c[k][axis], real_round(to[k] * CAROM_ONE_Q30), 20);
            }
        }
    }
}

/*
 * The largest body at a spin whose |L| / m takes more than 60 bits: a turn of half a radian, as above.
 */
static void test_large_turn(void)
{
    const int32_t tau_q30 = CAROM_ONE_Q30 / 10000;
    const carom_v3_q40 v = {{0, 0, 0}}, w = {{0, (int64_t)4999 << 40, 0}};

    shape_box(&shape, 7, 4608, 4608, 4608);
    shape_body(&shape, true, &body, &state);
    body_set_mass(&body, fix_scale(1, 0));
    body_set_motion(&body, &state, &v, &w);
    /* a cube of 36 units: J is 36^2 / 6 */
    CHECK_NEAR(state.angular.c[1] >> 40, 216 * 4999, 2);
    CHECK_EQ(fix_bits3(state.angular.c), 61);
    body_predict(&body, &state, tau_q30, NULL);
    CHECK_NEAR(body.path.u.c[1], real_round(4999. * tau_q30 / 2), 4);
    CHECK_EQ(body.path.u.c[0] | body.path.u.c[2], 0);
    CHECK(body.path.turns);
}

/* A body with the inverse inertia of the cube times 2^-e. */
static void make_inert(struct carom_mesh *mesh, int e)
{
    make_cube();
    *mesh = shape.mesh;
    mesh->inverse.e += e;
    mesh->inverse_rest.e += e;
    body.def.mesh = mesh;
    body_set_mass(&body, fix_scale(1, 0));
}

/*
 * Inertias that no convex body has, but a mesh with a part inside out may: the limit of calm momenta is m / 2n, n near J^-1, up
 * to 2^20, and 0 where it has no digit; a large inertia keeps a small momentum from turning the body.
 */
static void test_odd_inertia(void)
{
    const carom_v3_q40 least = {{1, 0, 0}};
    struct carom_mesh mesh;

    make_inert(&mesh, 0); /* J^-1 is 6 */
    CHECK_NEAR(body.def.calm_angular_q40, ((int64_t)1 << 40) / 12, 1 << 21);
    make_inert(&mesh, 40);
    CHECK_EQ(body.def.calm_angular_q40, (uint64_t)1 << 60);
    make_inert(&mesh, -80);
    CHECK_EQ(body.def.calm_angular_q40, 0);
    CHECK(!body_calm(&body, &state));
    make_inert(&mesh, 40);
    state.angular = least;
    body_predict(&body, &state, CAROM_ONE_Q30, NULL);
    CHECK_EQ(body.path.u.c[0] | body.path.u.c[1] | body.path.u.c[2], 0);
    CHECK(!body.path.turns);
}

/* Axes of a torque-free body after `frames`, by small steps of the midpoint rule in double. */
static void integrate(double axes[3][3], double inverse[3][3], const double l[3], int frames)
{
    const int steps = 8; /* steps a frame */

    for (int n = 0; n < frames * steps; n++) {
        double start[3][3], w[3];

        memcpy(start, axes, sizeof start);
        for (int half = 2; half >= 1; half--) {
            double lb[3], wb[3];

            real_rotate_back(lb, axes, l);
            real_rotate(wb, inverse, lb);
            real_rotate(w, axes, wb);
            for (int axis = 0; axis < 3; axis++) {
                double from[3] = {start[0][axis], start[1][axis], start[2][axis]}, u[3], to[3];

                for (int k = 0; k < 3; k++) {
                    u[k] = w[k] / steps / half / 2;
                }
                turn_by_cayley(to, u, from);
                for (int k = 0; k < 3; k++) {
                    axes[k][axis] = to[k];
                }
            }
        }
    }
}

/* A body with three different moments of inertia nutates as the equations of motion say. */
static void test_nutation(void)
{
    enum { FRAMES = 40 };
    struct test_random r = {4};
    double axes[3][3], inertia[3][3], inverse[3][3], l[3];
    carom_m3_q30 m;

    make_box();
    random_state(&r, 0, 0.06);
    real_quaternion(axes, &state.rotation);
    real_vector(l, state.angular.c, 40);
    real_sym3(inertia, &shape.mesh.mass.inertia);
    memset(inverse, 0, sizeof inverse);
    for (int k = 0; k < 3; k++) {
        /* the box lies along the axes of its mesh */
        CHECK_LESS(real_abs(inertia[k][(k + 1) % 3]), 1e-8);
        inverse[k][k] = 1 / (inertia[k][k] * real(shape.mesh.mass.volume_q32, 32));
    }
    integrate(axes, inverse, l, FRAMES);
    for (int n = 0; n < FRAMES; n++) {
        body_predict(&body, &state, CAROM_ONE_Q30, NULL);
        body_advance(&body, &state, CAROM_ONE_Q30, CAROM_ONE_Q30, NULL);
    }
    fix_matrix(&m, &state.rotation);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            /* turned by 2 radians in all; the error of a frame's step is a few times 0.06^3 / 12 */
            CHECK_LESS(real_abs(real(m.c[i][k], 30) - axes[i][k]), 2e-3);
        }
    }
}

/* Kinetic energy of a long torque-free tumble. The angular momentum is the state itself. */
static void test_tumble(void)
{
    /* close to the middle axis, where it tumbles, at 0.1 radians a frame */
    const carom_v3_q40 v = {{0, 0, 0}};
    const carom_v3_q40 w = {{CAROM_RATIO(1, 100, 40), CAROM_RATIO(1, 10, 40), 0}};
    carom_v3_q40 angular;
    double first = 0, most = 0;
    int64_t square_q60 = 0;

    make_box();
    body_set_motion(&body, &state, &v, &w);
    angular = state.angular;
    for (int n = 0; n < TUMBLE; n++) {
        struct fix_wide e = {0, 0};
        double energy;
        carom_m3_q30 m;

        body_predict(&body, &state, CAROM_ONE_Q30, NULL);
        body_advance(&body, &state, CAROM_ONE_Q30, CAROM_ONE_Q30, NULL);
        fix_matrix(&m, &state.rotation);
        body_add_kinetic2(&e, &body, &state, &m);
        energy = real(e.hi, -64) + (double)e.lo;
        first = n == 0 ? energy : first;
        most = real_abs(energy / first - 1) > most ? real_abs(energy / first - 1) : most;
    }
    CHECK_LESS(most, 5e-6);
    CHECK_EQ(memcmp(&angular, &state.angular, sizeof angular), 0);
    for (int k = 0; k < 4; k++) {
        square_q60 += (int64_t)state.rotation.c[k] * state.rotation.c[k];
    }
    CHECK_NEAR(square_q60, (int64_t)1 << 60, (int64_t)1 << 33);
}

/*
 * A needle of 700:1. Its moments of inertia across its axis differ by 2 parts in a million, as much
 * as the moment about the axis. If the inverse had 30 bits, 12 of them across the axis, this
 * difference would be noise, and the noise would grow.
 */
static void test_needle(void)
{
    const carom_v3_q40 v = {{0, 0, 0}};
    const carom_v3_q40 w = {{CAROM_RATIO(1, 5, 40), CAROM_RATIO(1, 5, 40), CAROM_RATIO(3, 10, 40)}};
    double first = 0, most = 0, fastest = 0;

    shape_box(&shape, 12, 7005, 10, 14);
    shape_body(&shape, true, &body, &state);
    body_set_mass(&body, fix_scale(1, 0)); /* the mesh's own mass is below the least */
    body_set_motion(&body, &state, &v, &w);
    for (int n = 0; n < TUMBLE / 20; n++) {
        struct fix_wide e = {0, 0};
        carom_v3_q40 spin;
        double energy, now[3];
        carom_m3_q30 m;

        body_predict(&body, &state, CAROM_ONE_Q30, NULL);
        body_advance(&body, &state, CAROM_ONE_Q30, CAROM_ONE_Q30, NULL);
        fix_matrix(&m, &state.rotation);
        body_spin(&body, &state, &m, &spin);
        body_add_kinetic2(&e, &body, &state, &m);
        energy = real(e.hi, -64) + (double)e.lo;
        first = n == 0 ? energy : first;
        most = real_abs(energy / first - 1) > most ? real_abs(energy / first - 1) : most;
        real_vector(now, spin.c, 40);
        fastest = real_length(now) > fastest ? real_length(now) : fastest;
    }
    CHECK_LESS(most, 2e-6);
    /*
     * Across the axis the spin keeps its 0.36 radians a frame, W. Euler's equations about it are
     * the equations of a pendulum: w^2 rises by W^2 (14^2 - 10^2) / (14^2 + 10^2) at most, so |w,
     * W|^2 stays below 0.2^2 + 1.33 W^2.
     */
    CHECK_LESS(fastest, 0.5);
}

/* ---------------------------------------------------------------- parabola */

/* Mass 1, and numbers with spare low bits: nothing is ever rounded, x = x0 + n v + n^2 g / 2. */
static void test_free_fall(void)
{
    const carom_v3_q40 g = {{3 << 10, -5 * 1024, 7 * -12345678 * (int64_t)1024}};
    const carom_v3_q40 v = {{(int64_t)1 << 30, -(int64_t)12345 * 4096, (int64_t)99 << 34}};
    const carom_v3_q40 none = {{0, 0, 0}};
    carom_v3_q32 start;

    make_cube();
    state.position = (carom_v3_q32){{-((int64_t)7 << 32), 5, 123456789}};
    start = state.position;
    body_set_motion(&body, &state, &v, &none);
    for (int n = 1; n <= 100; n++) {
        body_predict(&body, &state, CAROM_ONE_Q30, &g);
        body_advance(&body, &state, CAROM_ONE_Q30, CAROM_ONE_Q30, &g);
        for (int k = 0; k < 3; k++) {
            CHECK_EQ(state.position.c[k],
                     start.c[k] + (2 * n * v.c[k] + (int64_t)n * n * g.c[k]) / 512);
            CHECK_EQ(state.momentum.c[k], v.c[k] + n * g.c[k]);
        }
    }
}

static void test_parabola(void)
{
    struct test_random r = {6};

    make_box();
    for (int n = 0; n < CASES; n++) {
        int32_t tau_q30 = (int32_t)test_random_range(&r, 1, CAROM_ONE_Q30);
        int32_t t_q30 =
            n % 4 == 0 ? CAROM_ONE_Q30 : (int32_t)test_random_range(&r, 0, CAROM_ONE_Q30);
        double tau = real(tau_q30, 30), t = real(t_q30, 30);
        struct body_state next;
        carom_v3_q32 way_at;
        carom_v3_q40 g, v;

        random_state(&r, 60, 0.1);
        random_vector(&r, 1, g.c, 40);
        body_velocity(&body, &state, &v);
        body_predict(&body, &state, tau_q30, &g);
        way_at = body_way_at(&body, t_q30);
        next = state;
        body_advance(&body, &next, t_q30, tau_q30, &g);
        for (int k = 0; k < 3; k++) {
            double way = real(v.c[k], 40) * tau * t + real(g.c[k], 40) * tau * tau / 2 * t * t;
            double dv = real(g.c[k], 40) * tau * t;

            /* the origin is the position to 22 bits */
            CHECK_NEAR(state.position.c[k], carom_shl(body.path.origin_q22[k], 10), 512);
            CHECK_NEAR(next.position.c[k] - state.position.c[k], real_round(way * real_power2(32)),
                       1);
            CHECK_EQ(next.position.c[k], state.position.c[k] + way_at.c[k]);
            CHECK_NEAR(next.momentum.c[k] - state.momentum.c[k],
                       real_round(dv * real(shape.mesh.mass.volume_q32, 32) * real_power2(40)),
                       real_round(real_abs(dv) * 2048) + 3);
        }
        CHECK_EQ(memcmp(&next.angular, &state.angular, sizeof next.angular), 0);
        /* at 0 the body is where it was */
        next = state;
        body_advance(&body, &next, 0, tau_q30, &g);
        CHECK_EQ(memcmp(&next.position, &state.position, sizeof next.position), 0);
        CHECK_EQ(memcmp(&next.rotation, &state.rotation, sizeof next.rotation), 0);
    }
}

/* Stationary, sleeping and frozen bodies do not move. */
static void test_still(void)
{
    struct test_random r = {7};
    const carom_v3_q40 g = {{0, 0, -((int64_t)1 << 30)}};

    make_box();
    for (int n = 0; n < 3; n++) {
        struct body_state before;
        int64_t way_q22, turn_q30;

        random_state(&r, 1, 0.3);
        body.def.moving = n != 0;
        state.asleep = n == 1;
        state.out = n == 2;
        before = state;
        body_predict(&body, &state, CAROM_ONE_Q30, &g);
        body_advance(&body, &state, CAROM_ONE_Q30, CAROM_ONE_Q30, NULL);
        CHECK_EQ(memcmp(&before, &state, sizeof before), 0);
        body_path_length(&body, CAROM_ONE_Q30, &way_q22, &turn_q30);
        CHECK_AT_MOST(way_q22, 8);
        CHECK_AT_MOST(turn_q30, 1);
    }
}

/* ------------------------------------------------------------------ bounds */

/* A vertex relative to the origin of the path. */
static void vertex_at(double out[3], uint32_t v, int32_t t_q30)
{
    carom_v3_q22 local = mesh_vertex(&shape.mesh, v);
    carom_v3_q32 way = body_way_at(&body, t_q30);
    carom_quat_q30 q = body_rotation_at(&body, t_q30);
    carom_m3_q30 r;

    fix_matrix(&r, &q);
    carom_rotate(local.c, &r, local.c);
    for (int k = 0; k < 3; k++) {
        out[k] = real(local.c[k], 22) + real(body.path.start_x_q32[k] + way.c[k], 32);
    }
}

static void test_path_length(void)
{
    struct test_random r = {9};

    make_box();
    for (int n = 0; n < CASES; n++) {
        int64_t way_q22, turn_q30;
        int32_t tau_q30;
        double start[8][3], most = 0;
        carom_v3_q40 g;

        random_state(&r, n % 3 ? 0.2 : 40, n % 2 ? 0.49 : 3);
        random_vector(&r, n % 5 ? 0.01 : 1, g.c, 40);
        tau_q30 = body_slice(&body, &state, (int32_t)test_random_range(&r, 1 << 20, CAROM_ONE_Q30));
        body_predict(&body, &state, tau_q30, &g);
        for (uint32_t v = 0; v < 8; v++) {
            vertex_at(start[v], v, 0);
        }
        for (int32_t i = 1; i <= 8; i++) {
            int32_t t_q30 = CAROM_ONE_Q30 / 8 * i;

            body_path_length(&body, t_q30, &way_q22, &turn_q30);
            for (uint32_t v = 0; v < 8; v++) {
                double p[3];

                vertex_at(p, v, t_q30);
                for (int k = 0; k < 3; k++) {
                    p[k] -= start[v][k];
                }
                most = real_length(p) > most ? real_length(p) : most;
                /* the places themselves are rounded */
                CHECK_AT_MOST(real_length(p), real(way_q22, 22) + 2 * real_power2(-22));
            }
            /* 2 atan |t u| <= 2 t |u| */
            CHECK_AT_MOST(
                2 *
                    real_length((double[3]){real(body.path.u.c[0], 30), real(body.path.u.c[1], 30),
                                            real(body.path.u.c[2], 30)}) *
                    real(t_q30, 30),
                real(turn_q30, 30));
        }
        CHECK_AT_LEAST(real(way_q22, 22), most); /* and the bound is not much too large */
    }
}

static void test_slice(void)
{
    struct test_random r = {10};

    make_cube();
    for (int n = 0; n < CASES; n++) {
        int32_t tau_q30 = (int32_t)test_random_range(&r, 1 << 10, CAROM_ONE_Q30), slice_q30;
        double w[3], turn;
        carom_v3_q40 spin;
        carom_m3_q30 m;

        random_state(&r, 0, n % 2 ? 0.7 : 60);
        fix_matrix(&m, &state.rotation);
        body_spin(&body, &state, &m, &spin);
        slice_q30 = body_slice(&body, &state, tau_q30);
        real_vector(w, spin.c, 40);
        turn = real_length(w) * real(slice_q30, 30);
        CHECK_AT_LEAST(slice_q30, 1);
        CHECK_AT_MOST(slice_q30, tau_q30);
        CHECK_AT_MOST(turn, 0.5 * (1 + 1e-9));
        /* the longest slice: the whole frame, or within a millionth of the limit */
        CHECK(slice_q30 == tau_q30 || turn >= 0.5 * (1 - 1e-6));
    }
}

/* ------------------------------------------------------------------ momenta */

/* A box of any mass, thin or not. Each component of its velocity and of its spin has a limit. */
static void throw_box(struct test_random *r, bool thin, double most_v, double most_w,
                      carom_v3_q40 *v, carom_v3_q40 *w)
{
    if (thin) {
        shape_box(&shape, 12, 8192, 82, 1000);
        shape_body(&shape, true, &body, &state);
    } else {
        make_box();
    }
    body_set_mass(&body, fix_scale(test_random_range(r, 1 << 10, 1 << 30), 20));
    random_state(r, 0, 0);
    random_vector(r, most_v, v->c, 40);
    random_vector(r, most_w, w->c, 40);
    body_set_motion(&body, &state, v, w);
}

static void test_motion(void)
{
    struct test_random r = {11};

    for (int n = 0; n < CASES; n++) {
        double most_v = n % 2 ? 60 : 0.01, most_w = n % 2 ? 60 : 0.01;
        carom_v3_q40 v, w, v2, w2;
        carom_m3_q30 m;

        throw_box(&r, n % 3 == 0, most_v, most_w, &v, &w);
        fix_matrix(&m, &state.rotation);
        body_velocity(&body, &state, &v2);
        body_spin(&body, &state, &m, &w2);
        for (int k = 0; k < 3; k++) {
            /* momenta of a light body have few bits: a unit of 2^-40 is 2^-30 of its speed */
            CHECK_NEAR(v2.c[k], v.c[k], real_round(most_v * real_power2(40 - 28)) + 2048);
            CHECK_NEAR(w2.c[k], w.c[k], real_round(most_w * real_power2(40 - 22)) + 4000000);
            /* p = m v */
            CHECK_NEAR(state.momentum.c[k],
                       real_round((double)v.c[k] * real(body.def.mass.m, body.def.mass.e)), 1 << 8);
        }
    }
}

static void test_inertia(void)
{
    struct test_random r = {12};

    for (int n = 0; n < CASES; n++) {
        struct carom_sym3 turned;
        double j[3][3], m[3][3], mine[3][3], sum;
        double p[3], l[3], w[3], wb[3], lb[3], energy, mass;
        struct fix_wide e = {0, 0};
        carom_m3_q30 matrix;
        carom_v3_q40 spin;

        if (n % 2) {
            shape_l(&shape, 12, 2048);
            shape_body(&shape, true, &body, &state);
        } else {
            make_box();
        }
        random_state(&r, 2, 2);
        fix_matrix(&matrix, &state.rotation);
        body_world_inertia(&body, &matrix, &turned);
        real_sym3(mine, &turned);
        real_sym3(j, &shape.mesh.mass.inertia);
        real_quaternion(m, &state.rotation);
        for (int a = 0; a < 3; a++) {
            for (int b = 0; b < 3; b++) {
                sum = 0;
                for (int i = 0; i < 3; i++) {
                    for (int k = 0; k < 3; k++) {
                        sum += m[a][i] * j[i][k] * m[b][k];
                    }
                }
                CHECK_AT_MOST(real_abs(sum - mine[a][b]), 12 * real_power2(-turned.e));
            }
        }
        /* L = R J R^T w m, and twice the energy is p.v + L.w */
        body_spin(&body, &state, &matrix, &spin);
        body_add_kinetic2(&e, &body, &state, &matrix);
        real_vector(p, state.momentum.c, 40);
        real_vector(l, state.angular.c, 40);
        real_vector(w, spin.c, 40);
        real_rotate(lb, mine, w);
        real_rotate_back(wb, m, w);
        mass = real(body.def.mass.m, body.def.mass.e);
        energy = real_dot(p, p) / mass;
        for (int i = 0; i < 3; i++) {
            CHECK_LESS(real_abs(lb[i] * mass - l[i]), 1e-7);
            for (int k = 0; k < 3; k++) {
                energy += mass * wb[i] * j[i][k] * wb[k];
            }
        }
        CHECK_LESS(real_abs((real(e.hi, 16) + (double)e.lo * real_power2(-80)) / energy - 1), 1e-7);
    }
}

/* Calm bodies turn by less than half a radian, are slower than the limit, and are not rare. */
static void test_calm(void)
{
    struct test_random r = {23};
    const int cases = 10 * CASES; /* few of the thin boxes are calm */
    int calm = 0, thin = 0;

    for (int n = 0; n < cases; n++) {
        double most_v = n % 2 ? 120 : 1, most_w = n % 4 ? 0.05 : 0.6;
        carom_v3_q40 v, w;
        carom_m3_q30 m;

        throw_box(&r, n % 3 == 0, most_v, most_w, &v, &w);
        if (!body_calm(&body, &state)) {
            continue;
        }
        *(n % 3 ? &calm : &thin) += 1;
        fix_matrix(&m, &state.rotation);
        body_velocity(&body, &state, &v);
        body_spin(&body, &state, &m, &w);
        CHECK_LESS(real_length((double[3]){real(v.c[0], 40), real(v.c[1], 40), real(v.c[2], 40)}),
                   64);
        CHECK_LESS(real_length((double[3]){real(w.c[0], 40), real(w.c[1], 40), real(w.c[2], 40)}),
                   0.5);
    }
    CHECK_MORE(calm, cases / 5);
    CHECK_MORE(thin, 0);
}

const struct test tests_body[] = {
    {"body/matrix", test_matrix},
    {"body/normalise", test_normalise},
    {"body/turn", test_turn},
    {"body/large_turn", test_large_turn},
    {"body/odd_inertia", test_odd_inertia},
    {"body/nutation", test_nutation},
    {"body/tumble", test_tumble},
    {"body/needle", test_needle},
    {"body/free_fall", test_free_fall},
    {"body/parabola", test_parabola},
    {"body/still", test_still},
    {"body/path_length", test_path_length},
    {"body/calm", test_calm},
    {"body/slice", test_slice},

    {"body/motion", test_motion},
    {"body/inertia", test_inertia},
    {0},
};
