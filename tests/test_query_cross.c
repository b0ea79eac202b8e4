/* SPDX-License-Identifier: MIT */
/*
 * Whether bodies have a common point. Triangles: against separating axes in whole numbers. Poses
 * that just touch, and that just do not: against separating axes in double precision.
 */
#include "lib/asked.h"
#include "query/cross.h"
#include "lib/real.h"

#ifdef TEST_LONG
#define PAIRS 400000
#define POSES 1500
#else
#define PAIRS 2000
#define POSES 12
#endif

/* ------------------------------------------------------------------ triangles */

struct whole {
    int64_t c[3];
};

static struct whole cross_of(const struct whole *a, const struct whole *b)
{
    return (struct whole){{a->c[1] * b->c[2] - a->c[2] * b->c[1],
                           a->c[2] * b->c[0] - a->c[0] * b->c[2],
                           a->c[0] * b->c[1] - a->c[1] * b->c[0]}};
}

/* Whether two triangles are separated along an axis, without touching. */
static bool apart_along(const struct whole *n, const struct interfere_vec p[3],
                        const struct interfere_vec q[3])
{
    int64_t low[2] = {INT64_MAX, INT64_MAX}, high[2] = {INT64_MIN, INT64_MIN};

    for (int i = 0; i < 6; i++) {
        const struct interfere_vec *v = i < 3 ? &p[i] : &q[i - 3];
        int64_t x = n->c[0] * v->c[0] + n->c[1] * v->c[1] + n->c[2] * v->c[2];

        low[i / 3] = x < low[i / 3] ? x : low[i / 3];
        high[i / 3] = x > high[i / 3] ? x : high[i / 3];
    }
    return high[0] < low[1] || high[1] < low[0];
}

static void edges_of(const struct interfere_vec t[3], struct whole e[3], struct whole *n)
{
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            e[i].c[k] = (int64_t)t[(i + 1) % 3].c[k] - t[i].c[k];
        }
    }
    *n = cross_of(&e[0], &e[1]);
}

/*
 * Two flat convex bodies are separated along a normal, across two edges, or across an edge in the
 * plane of its face.
 */
static bool meet_by_axes(const struct interfere_vec p[3], const struct interfere_vec q[3])
{
    struct whole e[3], f[3], n, m;

    edges_of(p, e, &n);
    edges_of(q, f, &m);
    if (apart_along(&n, p, q) || apart_along(&m, p, q)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        struct whole a = cross_of(&n, &e[i]), b = cross_of(&m, &f[i]);

        if (apart_along(&a, p, q) || apart_along(&b, p, q)) {
            return false;
        }
        for (int j = 0; j < 3; j++) {
            a = cross_of(&e[i], &f[j]);
            if (apart_along(&a, p, q)) {
                return false;
            }
        }
    }
    return true;
}

static void random_triangle(struct test_random *r, int most, int flat, struct interfere_vec t[3])
{
    struct whole e[3], n;

    do {
        for (int i = 0; i < 9; i++) {
            t[i / 3].c[i % 3] = i % 3 == flat ? 0 : (int32_t)test_random_range(r, -most, most);
        }
        edges_of(t, e, &n);
    } while ((n.c[0] | n.c[1] | n.c[2]) == 0);
}

static void test_triangles(void)
{
    struct test_random r = {5};
    int meet = 0, differ = 0;

    for (int n = 0; n < PAIRS; n++) {
        struct interfere_vec p[3], q[3];
        int flat = n % 4 == 0 ? n / 4 % 3 : 3, most = n % 3 == 0 ? 3 : n % 3 == 1 ? 8 : 20000;
        bool expected;

        random_triangle(&r, most, flat, p);
        random_triangle(&r, most, flat, q);
        expected = meet_by_axes(p, q);
        meet += expected;
        differ += cross_triangles(p, q) != expected;
        /* the same, moved and enlarged */
        for (int i = 0; i < 9; i++) {
            p[i / 3].c[i % 3] = p[i / 3].c[i % 3] * (int32_t)(500000000 / 20000 - 10) + 7 * i % 3;
            q[i / 3].c[i % 3] = q[i / 3].c[i % 3] * (int32_t)(500000000 / 20000 - 10) + 7 * i % 3;
        }
        differ += cross_triangles(p, q) != expected;
    }
    CHECK_EQ(differ, 0);
    CHECK_MORE(meet, PAIRS / 10);
    CHECK_LESS(meet, PAIRS * 9 / 10);
}

/*
 * A triangle rounded to a line, of which its longest edge is all: through the middle of a triangle, beside it, in its plane across it,
 * and in its plane beside it.
 */
static void test_line(void)
{
    static const struct interfere_vec t[3] = {{{-5, -5, 0}}, {{5, -5, 0}}, {{0, 7, 0}}};
    static const int lines[4][2][3] = {{{0, 0, -4}, {1, 0, 8}},
                                       {{9, 0, -4}, {9, 0, 8}},
                                       {{-9, 1, 0}, {9, 1, 0}},
                                       {{-9, -6, 0}, {9, -6, 0}}};

    for (int n = 0; n < 4; n++) {
        for (int order = 0; order < 3; order++) {
            struct interfere_vec line[3], *end = &line[order], *next = &line[(order + 1) % 3];

            for (int k = 0; k < 3; k++) {
                end->c[k] = 2 * lines[n][0][k];
                next->c[k] = 2 * lines[n][1][k];
                line[(order + 2) % 3].c[k] = lines[n][0][k] + lines[n][1][k];
            }
            CHECK_EQ(cross_triangles(t, line), n == 0 || n == 2);
            CHECK_EQ(cross_triangles(line, t), n == 0 || n == 2);
        }
    }
}

/* ---------------------------------------------------------------------- poses */

static struct shape shape[4];
static double at_a[SHAPE_VERTICES][3], at_b[SHAPE_VERTICES][3];

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(double out[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

/* The gap between two triangles along an axis. An axis of almost no length separates nothing. */
static double gap_along(const double n[3], const double *const p[3], const double *const q[3])
{
    double low[2] = {1e30, 1e30}, high[2] = {-1e30, -1e30}, length = real_sqrt(dot(n, n));

    if (length < 1e-7) {
        return -1e30;
    }
    for (int i = 0; i < 6; i++) {
        double x = dot(n, i < 3 ? p[i] : q[i - 3]) / length;

        low[i / 3] = x < low[i / 3] ? x : low[i / 3];
        high[i / 3] = x > high[i / 3] ? x : high[i / 3];
    }
    return low[1] - high[0] > low[0] - high[1] ? low[1] - high[0] : low[0] - high[1];
}

static double larger(double a, double b)
{
    return a > b ? a : b;
}

/* The largest gap that a separating axis shows between two triangles; below 0, the depth of their overlap. */
static double gap_of(const double *const p[3], const double *const q[3])
{
    double e[3][3], f[3][3], n[3], m[3], axis[3], gap = -1e30;

    for (int i = 0; i < 9; i++) {
        e[i / 3][i % 3] = p[(i / 3 + 1) % 3][i % 3] - p[i / 3][i % 3];
        f[i / 3][i % 3] = q[(i / 3 + 1) % 3][i % 3] - q[i / 3][i % 3];
    }
    cross(n, e[0], e[1]);
    cross(m, f[0], f[1]);
    gap = larger(gap_along(n, p, q), gap_along(m, p, q));
    for (int i = 0; i < 3; i++) {
        cross(axis, n, e[i]);
        gap = larger(gap, gap_along(axis, p, q));
        cross(axis, m, f[i]);
        gap = larger(gap, gap_along(axis, p, q));
        for (int j = 0; j < 3; j++) {
            cross(axis, e[i], f[j]);
            gap = larger(gap, gap_along(axis, p, q));
        }
    }
    return gap;
}

/* The smallest gap between any face of a and any face of b. */
static double least_gap(const struct carom_query_mesh *a, const struct carom_mesh *mb,
                        const struct body_state *b)
{
    double least = 1e30;

    asked_place(a->mesh, &a->position, &a->rotation, at_a);
    asked_place(mb, &b->position, &b->rotation, at_b);
    for (uint32_t i = 0; i < a->mesh->raw.face_count; i++) {
        const uint16_t *f = a->mesh->raw.faces[i];
        const double *const p[3] = {at_a[f[0]], at_a[f[1]], at_a[f[2]]};

        for (uint32_t j = 0; j < mb->raw.face_count; j++) {
            const uint16_t *g = mb->raw.faces[j];
            const double *const q[3] = {at_b[g[0]], at_b[g[1]], at_b[g[2]]};
            double gap = gap_of(p, q);

            least = gap < least ? gap : least;
        }
    }
    return least;
}

/* Move a mesh that is apart from a body straight to the body, until it is just apart. */
static void bring_near(struct carom_world *w, struct carom_query_mesh *a, struct test_random *r)
{
    const carom_v3_q32 from = a->position;
    int32_t near = CAROM_ONE_Q30, far = 0;
    int64_t off;

    while (near - far > 1) {
        int32_t middle = far + (near - far) / 2;

        for (int k = 0; k < 3; k++) {
            a->position.c[k] = from.c[k] - fix_mul_q30(from.c[k], middle);
        }
        *(carom_overlap_mesh(w, a, NULL, NULL, 0) != 0 ? &near : &far) = middle;
    }
    /* from 2^-31 to 2^-10 units from there, to either side */
    off = test_random_range(r, -1, 1) * ((int64_t)1 << test_random_range(r, 1, 22));
    for (int k = 0; k < 3; k++) {
        a->position.c[k] += off * (from.c[k] >> 24) / 256;
    }
}

/*
 * The oracle's double precision leaves 1e-9 units open; for bodies of this size places and axes are
 * rounded by less than 2^-24 units.
 */
static void test_near(void)
{
    const double open = real_power2(-24);
    struct test_random r = {17};
    int wrong = 0, close[2] = {0, 0};

    shape_box(&shape[0], 12, 4096, 2868, 1024);
    shape_l(&shape[1], 12, 1500);
    shape_ball(&shape[2], 12, 2400);
    shape_tetrahedron(&shape[3], 12, 2000);
    for (int n = 0; n < POSES; n++) {
        struct carom_world *world = asked_world(0);
        const struct carom_mesh *mb = &shape[test_random_range(&r, 0, 3)].mesh;
        struct carom_query_mesh a = {&shape[test_random_range(&r, 0, 3)].mesh, {{0}}, upright};
        double gap;
        bool meets;

        CHECK_EQ(asked_add(world, mb, true, 0, 0, 0, shape_random_turn(&r)), 0);
        a.rotation = shape_random_turn(&r);
        do {
            for (int k = 0; k < 3; k++) {
                a.position.c[k] = test_random_range(&r, -3 * UNIT, 3 * UNIT);
            }
        } while (carom_overlap_mesh(world, &a, NULL, NULL, 0) != 0);
        bring_near(world, &a, &r);
        gap = least_gap(&a, mb, &world->now->bodies[0]);
        meets = carom_overlap_mesh(world, &a, NULL, NULL, 0) != 0;
        wrong += (gap > open && meets) || (gap < -open && !meets);
        close[meets] += real_abs(gap) > open && real_abs(gap) < 1e-3;
    }
    CHECK_EQ(wrong, 0);
    CHECK_MORE(close[0], POSES / 16);
    CHECK_MORE(close[1], POSES / 16);
}

/* One body inside another, below a surface, beside it: no faces meet. */
static void test_inside(void)
{
    struct carom_world *world = asked_world(0);
    struct carom_query_mesh mesh = {&shape[1].mesh, {{0, 0, 0}}, upright};
    struct test_random r = {2};

    shape_ball(&shape[0], 12, 12000);
    shape_l(&shape[1], 12, 600);
    shape_field(&shape[2], 11, 8, 4000, 900, 6);
    CHECK_EQ(asked_add(world, &shape[0].mesh, true, 0, 0, 40 * UNIT, shape_random_turn(&r)), 0);
    CHECK_EQ(asked_add(world, &shape[1].mesh, true, 0, 0, 80 * UNIT, shape_random_turn(&r)), 1);
    CHECK_EQ(asked_add(world, &shape[2].mesh, false, 0, 0, 0, upright), 2);
    for (int n = 0; n < 20; n++) {
        uint16_t body = 9;

        mesh.rotation = shape_random_turn(&r);
        mesh.mesh = &shape[1].mesh;
        mesh.position = (carom_v3_q32){{UNIT / 2, UNIT / 3, 41 * UNIT}};
        CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, &body, 1), 1);
        CHECK_EQ(body, 0);
        mesh.mesh = &shape[0].mesh;
        mesh.position.c[2] = 81 * UNIT;
        CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, &body, 1), 1);
        CHECK_EQ(body, 1);
        mesh.position.c[2] = 90 * UNIT;
        CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, &body, 1), 0);
        mesh.mesh = &shape[1].mesh;
        mesh.position.c[2] = -20 * UNIT;
        CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, &body, 1), 1);
        CHECK_EQ(body, 2);
        mesh.position.c[0] = 30 * UNIT;
        CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, &body, 1), 0);
    }
}

const struct test tests_query_cross[] = {{"query_cross/triangles", test_triangles},
                                         {"query_cross/line", test_line},
                                         {"query_cross/near", test_near},
                                         {"query_cross/inside", test_inside},
                                         {0}};
