/* SPDX-License-Identifier: MIT */
/*
 * Closest points: by hand, and in double precision against every pair of edges and every corner
 * with every face.
 */
#include "lib/asked.h"

#ifdef TEST_LONG
#define POSES 3000
#else
#define POSES 6
#endif

static struct shape shape[4];

static void test_by_hand(void)
{
    struct carom_world *world = asked_world(0);
    struct carom_closest c;

    shape_box(&shape[0], 12, 4096, 4096, 4096);
    shape_plane(&shape[1], 12, 2, 16384);
    CHECK_EQ(asked_add(world, &shape[1].mesh, true, 0, 0, 0, upright), 0);
    CHECK_EQ(asked_add(world, &shape[0].mesh, true, UNIT / 4, UNIT / 8, 2 * UNIT, upright), 1);
    CHECK_EQ(carom_closest_points(world, 1, 0, &c), CAROM_OK);
    CHECK_NEAR(c.distance_q32, 3 * UNIT / 2, 64); /* a length is rounded up */
    CHECK_EQ(c.point[0].c[2], 3 * UNIT / 2);
    CHECK_EQ(c.point[1].c[2], 0);
    CHECK_EQ(c.normal.c[2], CAROM_ONE_Q30);
    CHECK_EQ(carom_closest_points(world, 0, 1, &c), CAROM_OK);
    CHECK_EQ(c.normal.c[2], -CAROM_ONE_Q30);
    CHECK_EQ(carom_closest_points(world, 0, 0, &c), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_closest_points(world, 0, 2, &c), CAROM_ERR_BODY);
    CHECK_EQ(carom_closest_points(NULL, 0, 1, &c), CAROM_ERR_NULL);
    CHECK_EQ(carom_closest_points(world, 0, 1, NULL), CAROM_ERR_NULL);
    world->now->bodies[1].position.c[2] = UNIT / 4;
    CHECK_EQ(carom_closest_points(world, 1, 0, &c), CAROM_ERR_OVERLAP);
    world->now->bodies[1].position.c[2] = -9 * UNIT;
    CHECK_EQ(carom_closest_points(world, 1, 0, &c), CAROM_ERR_OVERLAP);
    shape_box(&shape[2], 12, 512, 512, 512); /* inside the box, and nowhere at its surface */
    CHECK_EQ(asked_add(world, &shape[2].mesh, true, UNIT / 4, UNIT / 8, -9 * UNIT, upright), 2);
    CHECK_EQ(carom_closest_points(world, 1, 2, &c), CAROM_ERR_OVERLAP);
    CHECK_EQ(carom_closest_points(world, 2, 1, &c), CAROM_ERR_OVERLAP);
    CHECK_EQ(carom_body_remove(world, 2), CAROM_OK);
    world->now->bodies[1].position.c[2] = 501 * UNIT;
    CHECK_EQ(carom_closest_points(world, 1, 0, &c), CAROM_ERR_RANGE);
    /* beside the plane's border, above it: 3, 4 and 5 */
    world->now->bodies[1].position =
        (carom_v3_q32){{4 * UNIT + 7 * UNIT / 2, 0, 4 * UNIT + UNIT / 2}};
    CHECK_EQ(carom_closest_points(world, 1, 0, &c), CAROM_OK);
    CHECK_NEAR(c.distance_q32, 5 * UNIT, 1 << 10);
}

/* ----------------------------------------------------------------- by doubles */

static double root(double v)
{
    double r = v > 1 ? v : 1;

    for (int i = 0; i < 60; i++) {
        r = (r + v / r) / 2;
    }
    return r;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double clamp01(double v)
{
    return v < 0 ? 0 : v > 1 ? 1 : v;
}

/* The squared distance of two segments: the smallest of the inner point and the four ends. */
static double segments2(const double *p0, const double *p1, const double *q0, const double *q1)
{
    double d[3], e[3], r[3], best = 1e30;

    for (int k = 0; k < 3; k++) {
        d[k] = p1[k] - p0[k];
        e[k] = q1[k] - q0[k];
        r[k] = p0[k] - q0[k];
    }
    double a = dot(d, d), b = dot(d, e), c = dot(e, e), f = dot(d, r), g = dot(e, r);
    double den = a * c - b * b;
    double s[5] = {den > 0 ? clamp01((b * g - c * f) / den) : 0, 0, 1, 0, 0}, t[5];

    t[0] = clamp01((b * s[0] + g) / c);
    s[0] = clamp01((b * t[0] - f) / a);
    t[1] = clamp01(g / c);
    t[2] = clamp01((b + g) / c);
    t[3] = 0;
    s[3] = clamp01(-f / a);
    t[4] = 1;
    s[4] = clamp01((b - f) / a);
    for (int i = 0; i < 5; i++) {
        double x[3];

        for (int k = 0; k < 3; k++) {
            x[k] = r[k] + s[i] * d[k] - t[i] * e[k];
        }
        best = dot(x, x) < best ? dot(x, x) : best;
    }
    return best;
}

/* The squared height of a point over a triangle, if it is over the triangle. */
static double height2(const double *p, const double *a, const double *b, const double *c)
{
    const double *corner[3] = {a, b, c};
    double u[3], v[3], n[3], h;

    for (int k = 0; k < 3; k++) {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
    }
    for (int k = 0; k < 3; k++) {
        n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    }
    for (int i = 0; i < 3; i++) {
        double e[3], w[3], x[3];

        for (int k = 0; k < 3; k++) {
            e[k] = corner[(i + 1) % 3][k] - corner[i][k];
            w[k] = p[k] - corner[i][k];
        }
        for (int k = 0; k < 3; k++) {
            x[k] = e[(k + 1) % 3] * w[(k + 2) % 3] - e[(k + 2) % 3] * w[(k + 1) % 3];
        }
        if (dot(x, n) < 0) {
            return 1e30;
        }
    }
    for (int k = 0; k < 3; k++) {
        u[k] = p[k] - a[k];
    }
    h = dot(u, n);
    return h * h / dot(n, n);
}

static double corners2(const struct carom_mesh *ma, double p[][3], const struct carom_mesh *mb,
                       double q[][3])
{
    double best = 1e30;

    for (uint32_t v = 0; v < ma->raw.vertex_count; v++) {
        for (uint32_t f = 0; f < mb->raw.face_count; f++) {
            const uint16_t *c = mb->raw.faces[f];
            double h = height2(p[v], q[c[0]], q[c[1]], q[c[2]]);

            best = h < best ? h : best;
        }
    }
    return best;
}

static double distance_of(const struct carom_world *w, const struct carom_mesh *ma,
                          const struct carom_mesh *mb)
{
    static double p[SHAPE_VERTICES][3], q[SHAPE_VERTICES][3];
    const struct body_state *s = w->now->bodies;
    double best, other;

    asked_place(ma, &s[0].position, &s[0].rotation, p);
    asked_place(mb, &s[1].position, &s[1].rotation, q);
    best = corners2(ma, p, mb, q);
    other = corners2(mb, q, ma, p);
    best = other < best ? other : best;
    for (uint32_t i = 0; i < ma->edge_count; i++) {
        for (uint32_t j = 0; j < mb->edge_count; j++) {
            other = segments2(p[ma->edges[i].vertex[0]], p[ma->edges[i].vertex[1]],
                              q[mb->edges[j].vertex[0]], q[mb->edges[j].vertex[1]]);
            best = other < best ? other : best;
        }
    }
    return root(best);
}

static void test_random(void)
{
    struct test_random r = {8};
    int asked = 0;

    shape_box(&shape[0], 12, 4096, 2868, 1500);
    shape_l(&shape[1], 12, 1500);
    shape_ball(&shape[2], 12, 2000);
    shape_tetrahedron(&shape[3], 12, 1800);
    for (int n = 0; n < POSES; n++) {
        const struct carom_mesh *ma = &shape[n % 4].mesh, *mb = &shape[n / 4 % 2].mesh;
        struct carom_world *world = asked_world(0);
        struct carom_closest c;
        int64_t at[3], size = n % 3 ? UNIT : 4 * UNIT;
        int result;

        for (int k = 0; k < 3; k++) {
            at[k] = test_random_range(&r, -size, size);
        }
        asked_add(world, ma, true, at[0], at[1], at[2], n % 5 ? shape_random_turn(&r) : upright);
        asked_add(world, mb, true, 0, 0, 0, n % 7 ? shape_random_turn(&r) : upright);
        result = carom_closest_points(world, 0, 1, &c);
        if (result == CAROM_OK) {
            double expected = distance_of(world, ma, mb),
                   found = (double)c.distance_q32 / 4294967296.0;

            CHECK_MORE(found, expected - 4e-6);
            CHECK_LESS(found, expected + 4e-6 + expected * 1e-6);
            CHECK_LESS(c.face[0], ma->raw.face_count);
            CHECK_LESS(c.face[1], mb->raw.face_count);
            asked++;
        } else {
            CHECK_EQ(result, CAROM_ERR_OVERLAP);
        }
    }
    CHECK_MORE(asked, POSES / 3);
}

const struct test tests_query_nearest[] = {
    {"query_nearest/by_hand", test_by_hand}, {"query_nearest/random", test_random}, {0}};
