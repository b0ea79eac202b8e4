/* SPDX-License-Identifier: MIT */
/*
 * Regions of motion and sweeps. What they say about a body's way is compared with its places, which
 * the test computes in double precision from the parabola and the Cayley vector.
 */
#include "lib/real.h"
#include "lib/shapes.h"
#include "lib/test.h"

#ifdef TEST_LONG
#define CASES 4000
#else
#define CASES 60
#endif
#define CORNERS 8

/* A pose: a centre, and axes as columns. */
struct place {
    double at[3], axes[3][3];
};

static struct shape shape;
static struct body body;
static struct body_state state;
static struct body_path whole; /* a path before it is cut */

static void random_vector(struct test_random *r, double size, int64_t v[3], int bits)
{
    int64_t most = real_round(size * real_power2(bits) / 1.7320508);

    for (int k = 0; k < 3; k++) {
        v[k] = test_random_range(r, -most, most);
    }
}

static double length_q40(const carom_v3_q40 *v)
{
    return real_length((double[3]){real(v->c[0], 40), real(v->c[1], 40), real(v->c[2], 40)});
}

static double length_q30(const carom_v3_q30 *v)
{
    return real_length((double[3]){real(v->c[0], 30), real(v->c[1], 30), real(v->c[2], 30)});
}

/* Sometimes a vector along one axis, whose length is not rounded up. */
static void straighten(struct test_random *r, int64_t v[3])
{
    int axis = (int)test_random_range(r, 0, 11);

    for (int k = 0; k < 3 && axis < 3; k++) {
        v[k] = k == axis ? v[k] : 0;
    }
}

/* A box of three different sides with any place and rotation, and a motion. */
static void throw_box(struct test_random *r, double speed, double spin)
{
    carom_v3_q40 v, w;

    shape_box(&shape, 12, 4096, 2458, 1228);
    shape_body(&shape, true, &body, &state);
    state.rotation = shape_random_turn(r);
    random_vector(r, 100, state.position.c, 32);
    random_vector(r, speed, v.c, 40);
    straighten(r, v.c);
    random_vector(r, spin, w.c, 40);
    body_set_motion(&body, &state, &v, &w);
}

/* The axes of q turned on by t times a Cayley vector in them: Rodrigues' formula. */
static void turn_axes(double axes[3][3], const carom_quat_q30 *q, const carom_v3_q30 *u, double t)
{
    double w[3], first[3][3];

    real_matrix(first, (double[4]){q->c[0], q->c[1], q->c[2], q->c[3]});
    for (int k = 0; k < 3; k++) {
        w[k] = real(u->c[k], 30) * t;
    }
    for (int axis = 0; axis < 3; axis++) {
        double e[3] = {axis == 0, axis == 1, axis == 2}, across[3], turned[3], column[3];

        real_cross(across, w, e);
        for (int k = 0; k < 3; k++) {
            turned[k] = ((1 - real_dot(w, w)) * e[k] + 2 * across[k] + 2 * w[axis] * w[k]) /
                        (1 + real_dot(w, w));
        }
        real_rotate(column, first, turned);
        for (int k = 0; k < 3; k++) {
            axes[k][axis] = column[k];
        }
    }
}

/* The region's place at t of its time. */
static struct place region_place(double t)
{
    const struct body_region *region = &body.search.region;
    struct place found;

    for (int k = 0; k < 3; k++) {
        found.at[k] = real(region->at.c[k], 32) + real(region->way.c[k], 40) * t +
                      real(region->bend.c[k], 40) * t * t;
    }
    turn_axes(found.axes, &region->q, &region->u, t);
    return found;
}

/* The place at t of a path from the state. */
static struct place place_on(const struct body_path *path, double t)
{
    struct place found;

    for (int k = 0; k < 3; k++) {
        found.at[k] = real(state.position.c[k], 32) + real(path->v.c[k], 40) * t +
                      real(path->g.c[k], 40) * t * t;
    }
    turn_axes(found.axes, &state.rotation, &path->u, t);
    return found;
}

static struct place path_place(double t)
{
    return place_on(body_path(&body), t);
}

static struct place whole_place(double t)
{
    return place_on(&whole, t);
}

/* The largest distance of a corner in one place from itself in another. */
static double apart(const struct place *a, const struct place *b)
{
    double most = 0;

    for (uint32_t corner = 0; corner < CORNERS; corner++) {
        carom_v3_q22 local = mesh_vertex(&shape.mesh, corner);
        double d[3];

        for (int k = 0; k < 3; k++) {
            d[k] = a->at[k] - b->at[k];
            for (int j = 0; j < 3; j++) {
                d[k] += (a->axes[k][j] - b->axes[k][j]) * real(local.c[j], 22);
            }
        }
        most = real_length(d) > most ? real_length(d) : most;
    }
    return most;
}

/*
 * A body follows its region for a while, and gets another motion. If its region is said to hold,
 * all of it stays within the room; if not, it goes at least a part of the room away.
 */
static void test_holds(void)
{
    struct test_random r = {31};
    int held = 0, left = 0;

    for (int n = 0; n < CASES; n++) {
        const double sizes[] = {0.3, 0.1, 0.02, 0.003};
        double size = sizes[n % 4], most = 0, room;
        carom_v3_q40 v, w, change, g;
        carom_m3_q30 m;
        int32_t since_q30, tau_q30;
        bool holds;

        throw_box(&r, 0.3, 0.3);
        random_vector(&r, 0.02, g.c, 40);
        body_predict(&body, &state, CAROM_ONE_Q30, &g);
        body_region_begin(&body, &state, CAROM_ONE_Q30, CAROM_ONE_Q30,
                          (int32_t)real_round(0.2 * size * real_power2(22)));
        since_q30 = (int32_t)test_random_range(&r, 0, CAROM_ONE_Q30 / 2);
        tau_q30 = (int32_t)test_random_range(&r, 1 << 24, CAROM_ONE_Q30 - since_q30);
        fix_matrix(&m, &state.rotation);
        body_velocity(&body, &state, &v);
        body_spin(&body, &state, &m, &w);
        body_advance(&body, &state, since_q30, CAROM_ONE_Q30, &g);
        body_region_advance(&body, since_q30, CAROM_ONE_Q30);
        random_vector(&r, size, change.c, 40);
        for (int k = 0; k < 3; k++) {
            /* some turn back, some go on with a little more or less */
            w.c[k] = n % 3 == 0 ? -w.c[k] : w.c[k] + change.c[(k + 1) % 3];
            v.c[k] += change.c[k];
        }
        body_set_motion(&body, &state, &v, &w);
        body_predict(&body, &state, tau_q30, &g);
        holds = body_region_holds(&body, tau_q30);
        for (int i = 0; i <= 8; i++) {
            struct place in = region_place(real(since_q30, 30) + real(tau_q30, 30) * i / 8);
            struct place on = path_place(i / 8.0);

            most = apart(&in, &on) > most ? apart(&in, &on) : most;
        }
        room = real(body.search.region.room_q22, 22);
        *(holds ? &held : &left) += 1;
        if (holds) {
            CHECK_AT_MOST(most, room);
        } else {
            /* turns that did not begin together are compared but for their cubes */
            double u_path = length_q30(&body_path(&body)->u),
                   u_region = length_q30(&body.search.region.u);
            double cubes = 1.74 * u_path * u_path * u_path + u_region * u_region * u_region;

            CHECK_MORE(3 * most + 2 * cubes * real(body.def.radius_q22, 22), room);
        }
    }
    CHECK_MORE(held, CASES / 10);
    CHECK_MORE(left, CASES / 10);
}

/* The least room with which the body's region holds over a path of tau_q30. */
static int32_t least_room(int32_t tau_q30)
{
    int32_t low = 0, high = INT32_MAX;

    while (high - low > 1) {
        int32_t middle = low + (high - low) / 2;

        body.search.region.room_q22 = middle;
        *(body_region_holds(&body, tau_q30) ? &high : &low) = middle;
    }
    return high;
}

/* Along one axis bounds are exact, but for their rounding: 2 units for the way and its bend, 2 more for a turn. */
static void check_reach(int axis)
{
    const struct body_region *region = &body.search.region;
    double way = real(region->way.c[axis] + region->bend.c[axis], 40);
    double reach =
        real(body.search.reach_q22 - region->room_q22 - BODY_MARGIN_SKINS * body.def.skin_q22, 22);

    CHECK_AT_LEAST(reach, way);
    CHECK_AT_MOST(reach, way + real(4, 22));
}

/*
 * A body flies along one axis with its region. Then it is put aside on this axis, and flies straight to where gravity would have
 * led it from there: it is farthest from its region halfway. That is the least room with which the region holds, up to the
 * rounding of a few numbers, which may be no less.
 */
static void test_least_room(void)
{
    struct test_random r = {34};

    for (int n = 0; n < CASES; n++) {
        const int axis = n % 3;
        const int32_t since_q30 = (int32_t)test_random_range(&r, 0, CAROM_ONE_Q30 / 2) & -(n % 2);
        const int32_t tau_q30 = (int32_t)test_random_range(&r, 1 << 24, CAROM_ONE_Q30 - since_q30);
        carom_v3_q40 v, none = {{0, 0, 0}}, g = {{0, 0, 0}};
        double most = 0, room;

        throw_box(&r, 0.3, 0);
        v = none;
        v.c[axis] = test_random_range(&r, 0, 1 << 30);
        body_set_motion(&body, &state, &v, &none);
        g.c[axis] = test_random_range(&r, 1 << 20, 1 << 30);
        body_predict(&body, &state, CAROM_ONE_Q30, &g);
        body_region_begin(&body, &state, CAROM_ONE_Q30, CAROM_ONE_Q30, n);
        check_reach(axis);
        if (since_q30 > 0) {
            body_advance(&body, &state, since_q30, CAROM_ONE_Q30, &g);
            body_region_advance(&body, since_q30, CAROM_ONE_Q30);
        }
        body_velocity(&body, &state, &v);
        v.c[axis] += fix_mul_q30(g.c[axis], tau_q30) / 2;
        body_set_motion(&body, &state, &v, &none);
        state.position.c[axis] += test_random_range(&r, 0, 1 << 20);
        body_predict(&body, &state, tau_q30, NULL);
        for (int i = 0; i <= 32; i++) {
            struct place in = region_place(real(since_q30, 30) + real(tau_q30, 30) * i / 32);
            struct place on = path_place(i / 32.0);

            most = apart(&in, &on) > most ? apart(&in, &on) : most;
        }
        room = real(least_room(tau_q30), 22);
        CHECK_AT_LEAST(room, most);
        CHECK_AT_MOST(room, most + real(4, 22));
    }
}

static void check_axes(const carom_m3_q30 *found, double wanted[3][3])
{
    for (int k = 0; k < 9; k++) {
        CHECK_LESS(real_abs(real(found->c[k / 3][k % 3], 30) - wanted[k / 3][k % 3]), 1e-7);
    }
}

/* The way between two places, as a sweep says it; `bends` is the length of its t^2 term. */
static void check_sweep(const struct body_sweep *sweep, struct place (*place)(double), double from,
                        double to, double bends)
{
    struct place start = place(from), end = place(to), before = start;
    double length = 0;

    for (int i = 1; i <= 16; i++) {
        struct place next = place(from + (to - from) * i / 16);
        double d[3] = {next.at[0] - before.at[0], next.at[1] - before.at[1],
                       next.at[2] - before.at[2]};

        length += real_length(d);
        before = next;
    }
    for (int k = 0; k < 3; k++) {
        CHECK_LESS(real_abs(real(sweep->way.c[k], 40) - (end.at[k] - start.at[k])), 1e-8);
        CHECK_LESS(real_abs(real(sweep->at.c[k], 32) - start.at[k]), 1e-6);
    }
    /* fix_length_bound is at most sqrt(3 / 2) of a length, for sides of 2 : 1 : 1 */
    CHECK_AT_LEAST(real(sweep->length_q22, 22), length);
    CHECK_AT_MOST(real(sweep->length_q22, 22), 1.23 * (length + 2 * bends) + 3e-6);
    CHECK_AT_LEAST(real(sweep->bend_q22, 22), bends);
    CHECK_AT_MOST(real(sweep->bend_q22, 22), 1.23 * bends + 1e-6);
    check_axes(&sweep->start, start.axes);
    check_axes(&sweep->end, end.axes);
}

/* A region lets its body turn away as far as its room at its radius, but both together by 1 at most. */
static void check_turn_off(void)
{
    const struct body_region *region = &body.search.region;
    double off = real(region->room_q22, 22) / real(body.def.radius_q22, 22);
    double most = 1 - 2 * length_q30(&region->u), found = real(body_region_turn_off_q30(&body), 30);

    CHECK_AT_LEAST(found, off < most ? off : most - real(4, 30));
    CHECK_AT_MOST(found, (off < most ? off : most) + real(2, 30));
}

/* Parts of regions that last longer than the path that they continue, up to 64 frames. */
static void test_region_sweep(void)
{
    struct test_random r = {32};

    for (int n = 0; n < CASES; n++) {
        const int frames = n % 7 ? 8 : 64;
        int64_t time_q30 = test_random_range(&r, CAROM_ONE_Q30, frames * (int64_t)CAROM_ONE_Q30);
        int64_t from_q30 = n % 4 ? test_random_range(&r, 0, time_q30 - 1) : 0;
        int64_t part_q30 =
            n % 3 ? test_random_range(&r, 1, time_q30 - from_q30) : time_q30 - from_q30;
        const struct body_region *region = &body.search.region;
        double from = (double)from_q30 / (double)time_q30,
               part = (double)part_q30 / (double)time_q30, slow = 8.0 / frames;
        struct body_sweep sweep;
        carom_v3_q40 g;

        throw_box(&r, 0.3 * slow, n % 5 ? 0.06 * slow : 0);
        random_vector(&r, n % 6 ? 0.02 * slow * slow : 0, g.c, 40);
        straighten(&r, g.c);
        body_predict(&body, &state, CAROM_ONE_Q30, &g);
        body_region_begin(&body, &state, CAROM_ONE_Q30, time_q30, n % 2 ? 1 << 18 : 1 << 22);
        body_region_sweep(region, from_q30, part_q30, &sweep);
        check_sweep(&sweep, region_place, from, from + part,
                    length_q40(&region->bend) * part * part);
        CHECK_AT_LEAST(real(sweep.u_q30, 30), length_q30(&region->u) * part);
        CHECK_AT_MOST(real(sweep.u_q30, 30), length_q30(&region->u) * part + 1e-8);
        CHECK_AT_LEAST(real(sweep.whole_u_q30, 30), length_q30(&region->u));
        CHECK_AT_MOST(real(sweep.whole_u_q30, 30), length_q30(&region->u) + 1e-8);
        check_turn_off();
    }
}

/*
 * A whole path, or a part of one. Its rate of turn is 2 u / N with N = (1 + c t)^2 + u^2 t^2, which is at least 1; so the rate falls
 * by 2 u N' at most, and N' is at most 2 (c + c^2 + u^2).
 */
static void test_path_sweep(void)
{
    struct test_random r = {33};

    for (int n = 0; n < CASES; n++) {
        const struct body_path *path;
        double from = 0, to = 1, u, c;
        struct body_sweep sweep;
        carom_v3_q40 g;
        int32_t tau_q30;

        throw_box(&r, 0.3, n % 5 ? 0.5 : 0);
        random_vector(&r, n % 6 ? 0.02 : 0, g.c, 40);
        straighten(&r, g.c);
        tau_q30 = body_slice(&body, &state, (int32_t)test_random_range(&r, 1 << 24, CAROM_ONE_Q30));
        body_predict(&body, &state, tau_q30, &g);
        path = body_path(&body);
        whole = *path;
        if (n % 2) {
            int32_t from_q30 = (int32_t)test_random_range(&r, 0, CAROM_ONE_Q30 - 1);
            int32_t to_q30 = (int32_t)test_random_range(&r, from_q30 + 1, CAROM_ONE_Q30);

            body_cut_path(&body, &state, from_q30, to_q30);
            from = real(from_q30, 30);
            to = real(to_q30, 30);
        }
        body_path_sweep(&body, &sweep);
        check_sweep(&sweep, whole_place, from, to, length_q40(&path->g));
        u = length_q30(&path->u);
        c = real(path->c_q30, 30);
        CHECK_AT_LEAST(real(sweep.u_q30, 30), u);
        CHECK_AT_MOST(real(sweep.u_q30, 30), u + 1e-4);
        CHECK_AT_LEAST(real(sweep.whole_u_q30, 30), 2 * (c + c * c + u * u));
        CHECK_AT_MOST(real(sweep.whole_u_q30, 30), 2 * (c + c / 8 + u * u) + 1e-8);
    }
}

/*
 * A body that turns against its region, by 1/4 + 1/4 radian in each path: the bound on what it has turned off never falls and ends
 * at the largest number, and the region holds no more.
 */
static void test_turned_off(void)
{
    struct test_random r = {4};
    int32_t before = 0;

    throw_box(&r, 1, 0);
    state.angular.c[2] = 0;
    body_set_motion(&body, &state, &(carom_v3_q40){{0, 0, 0}},
                    &(carom_v3_q40){{0, 0, (int64_t)1 << 38}});
    body_predict(&body, &state, CAROM_ONE_Q30, NULL);
    body_region_begin(&body, &state, CAROM_ONE_Q30, 8 * (int64_t)CAROM_ONE_Q30, 1 << 20);
    for (int k = 0; k < 3; k++) {
        state.angular.c[k] = -state.angular.c[k];
    }
    body_predict(&body, &state, CAROM_ONE_Q30, NULL);
    for (int n = 1; n <= 8; n++) {
        body_region_advance(&body, CAROM_ONE_Q30, CAROM_ONE_Q30);
        CHECK_AT_LEAST(body.search.region.turned_off_q30, before);
        before = body.search.region.turned_off_q30;
        CHECK(n > 3 || real(before, 30) >= 0.49 * n);
    }
    CHECK_EQ(before, INT32_MAX);
    CHECK_EQ(body.search.region.elapsed_q30, 8 * (int64_t)CAROM_ONE_Q30);
    CHECK(!body_region_holds(&body, CAROM_ONE_Q30));
}

const struct test tests_body_region[] = {
    {"body_region/turned_off", test_turned_off}, {"body_region/holds", test_holds},
    {"body_region/least_room", test_least_room}, {"body_region/region_sweep", test_region_sweep},
    {"body_region/path_sweep", test_path_sweep}, {0},
};
