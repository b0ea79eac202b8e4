/* SPDX-License-Identifier: MIT */
/*
 * Shapes made at run time are closed and convex, face outwards, and have the volume that geometry
 * gives.
 */
#include <string.h>

#include "carom_shapes.h"
#include "lib/real.h"
#include "lib/test.h"

#define V_MAX CAROM_CAPSULE_VERTICES(32)
#define F_MAX CAROM_CAPSULE_FACES(32)

static int16_t vertices[V_MAX][3];
static uint16_t faces[F_MAX][3];
static _Alignas(8) uint8_t block[CAROM_MESH_BYTES(V_MAX, F_MAX)];
static const struct carom_shape_room room = {vertices, faces, V_MAX, F_MAX, 10};
static struct carom_mesh_raw raw;
static struct carom_mesh mesh;

/* -------------------------------------------------------------- what is asked of all */

/*
 * Six times the volume between a face's plane and a place, in cubic quanta: negative for a place
 * inside.
 */
static int64_t outside6_of(int16_t (*v)[3], const uint16_t face[3], const int16_t place[3])
{
    int64_t e[3][3];

    for (int k = 0; k < 3; k++) {
        e[0][k] = v[face[1]][k] - v[face[0]][k];
        e[1][k] = v[face[2]][k] - v[face[0]][k];
        e[2][k] = place[k] - v[face[0]][k];
    }
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
           e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

static int64_t outside6(const uint16_t face[3], const int16_t place[3])
{
    return outside6_of(vertices, face, place);
}

/* Six times the volume, by tetrahedra from the origin. */
static int64_t volume6(void)
{
    static const int16_t origin[3];
    int64_t sum = 0;

    for (uint32_t f = 0; f < raw.face_count; f++) {
        sum -= outside6(faces[f], origin);
    }
    return sum;
}

/* Every vertex is on or inside the plane of every face. */
static bool is_convex(void)
{
    for (uint32_t f = 0; f < raw.face_count; f++) {
        for (uint32_t v = 0; v < raw.vertex_count; v++) {
            if (outside6(faces[f], vertices[v]) > 0) {
                return false;
            }
        }
    }
    return true;
}

/*
 * The shape has the counts of the macros and fulfils Euler's formula, by the edges that building
 * the mesh finds (the build refuses open, crowded, degenerate and inverted meshes). It is convex
 * against every vertex.
 */
static void check_shape(int result, uint32_t v_count, uint32_t f_count)
{
    CHECK_EQ(result, CAROM_OK);
    CHECK_EQ(raw.vertex_count, v_count);
    CHECK_EQ(raw.face_count, f_count);
    CHECK_SAME(raw.vertices, (const int16_t(*)[3])vertices);
    CHECK_EQ(raw.quantum_bits, 10);
    CHECK_EQ(carom_mesh_build(&mesh, &raw, block, sizeof block), CAROM_OK);
    CHECK_EQ(raw.vertex_count + raw.face_count, mesh.edge_count + 2);
    CHECK(is_convex());
}

/* ------------------------------------------------------------------- closed forms */

/*
 * The sine and cosine of 2 pi / n, n = 3 2^k or 4 2^k, by halving the angles of a triangle and a
 * square.
 */
static void first_step(uint32_t n, double *sine, double *cosine)
{
    uint32_t m = n % 3 == 0 ? 3 : 4;

    *cosine = m == 3 ? -0.5 : 0;
    *sine = m == 3 ? real_sqrt(0.75) : 1;
    for (; m < n; m *= 2) {
        const double half = real_sqrt((1 + *cosine) / 2);

        *sine = *sine / (2 * half);
        *cosine = half;
    }
}

/* A slice of height `high` between two regular polygons of radius r and s: a part of a pyramid. */
static double slice6(uint32_t n, double r, double s, double high)
{
    double sine, cosine;

    first_step(n, &sine, &cosine);
    return n * sine * high * (r * r + r * s + s * s);
}

/* Six times the volume of the unrounded polyhedron in a sphere or in a capsule. */
static double round6(uint32_t n, double radius, double half_length)
{
    double sine, cosine, c = 1, s = 0, sum = slice6(n, radius, radius, 2 * half_length);

    first_step(n, &sine, &cosine);
    for (uint32_t k = 0; k < n / 2; k++) {
        const double c_next = c * cosine - s * sine, s_next = s * cosine + c * sine;

        sum += slice6(n, radius * s, radius * s_next, radius * (c - c_next));
        c = c_next;
        s = s_next;
    }
    return sum;
}

/*
 * Rounding moves a vertex, and so the surface, by at most 0.87 quanta. The volume changes by at
 * most that times the area; the area of the bounding box is taken instead.
 */
static void check_volume(double expected6, double radius, double half_height)
{
    const double area = 8 * radius * radius + 16 * radius * half_height;

    CHECK_LESS(real_abs((double)volume6() - expected6), 6 * 0.88 * area);
}

/* ------------------------------------------------------------------------- tests */

static void box(void)
{
    const int32_t half[3] = {300, 200, 77};

    check_shape(carom_shape_box(&raw, &room, half), CAROM_BOX_VERTICES, CAROM_BOX_FACES);
    CHECK_EQ(volume6(), 6 * INT64_C(8) * 300 * 200 * 77);
    for (int k = 0; k < 3; k++) {
        CHECK_EQ(mesh.box[0][k], -half[k]);
        CHECK_EQ(mesh.box[1][k], half[k]);
    }
}

static void sphere(void)
{
    static const uint32_t sides[] = {4, 8, 12, 16, 24, 32};

    for (uint32_t i = 0; i < sizeof sides / sizeof sides[0]; i++) {
        const uint32_t n = sides[i];
        const double ball6 = 8 * REAL_PI * 3000.0 * 3000 * 3000;

        check_shape(carom_shape_sphere(&raw, &room, 3000, n), CAROM_SPHERE_VERTICES(n),
                    CAROM_SPHERE_FACES(n));
        check_volume(round6(n, 3000, 0), 3000, 3000);
        /* chords around z lose 2 pi^2 / 3 n^2 of the volume, chords along it pi^2 / n^2 */
        CHECK(n < 12 || real_abs((double)volume6() / ball6 - 1 + 16.45 / (n * n)) < 0.01);
    }
}

/* Every vertex of a sphere has the same distance from the origin, and each has its mirror image. */
static void sphere_is_round(void)
{
    check_shape(carom_shape_sphere(&raw, &room, 2048, 20), CAROM_SPHERE_VERTICES(20),
                CAROM_SPHERE_FACES(20));
    for (uint32_t v = 0; v < raw.vertex_count; v++) {
        const double x = vertices[v][0], y = vertices[v][1], z = vertices[v][2];
        uint32_t mirrored = 0;

        CHECK_LESS(real_abs(real_sqrt(x * x + y * y + z * z) - 2048), 0.88);
        for (uint32_t w = 0; w < raw.vertex_count; w++) {
            mirrored += vertices[w][0] == -vertices[v][0] && vertices[w][1] == vertices[v][1] &&
                        vertices[w][2] == -vertices[v][2];
        }
        CHECK_EQ(mirrored, 1);
    }
}

static void capsule(void)
{
    for (uint32_t n = 4; n <= 32; n *= 2) {
        check_shape(carom_shape_capsule(&raw, &room, 2000, 777, n), CAROM_CAPSULE_VERTICES(n),
                    CAROM_CAPSULE_FACES(n));
        check_volume(round6(n, 2000, 777), 2000, 2777);
        CHECK_EQ(mesh.box[1][2], 2777);
    }
}

static void cylinder_and_cone(void)
{
    static const uint32_t sides[] = {3, 4, 6, 8, 48, 128};

    for (uint32_t i = 0; i < sizeof sides / sizeof sides[0]; i++) {
        const uint32_t n = sides[i];

        check_shape(carom_shape_cylinder(&raw, &room, 9000, 100, n), CAROM_CYLINDER_VERTICES(n),
                    CAROM_CYLINDER_FACES(n));
        check_volume(slice6(n, 9000, 9000, 200), 9000, 100);
        check_shape(carom_shape_cone(&raw, &room, 9000, 5000, n), CAROM_CONE_VERTICES(n),
                    CAROM_CONE_FACES(n));
        check_volume(slice6(n, 9000, 0, 10000), 9000, 5000);
    }
}

/*
 * Random numbers of sides and random radii, without a closed form: each shape is convex, or the
 * call returns RANGE.
 */
static void any_size(void)
{
    struct test_random random = {77};
    uint32_t made = 0;

    for (int i = 0; i < 40; i++) {
        const int32_t radius = (int32_t)test_random_range(&random, 1, 2000);
        const int32_t half = (int32_t)test_random_range(&random, 1, 2000);
        const uint32_t n = 4 * (uint32_t)test_random_range(&random, 1, 5);
        const int result = carom_shape_capsule(&raw, &room, radius, half, n);

        CHECK(result == CAROM_OK || result == CAROM_ERR_RANGE);
        CHECK(result == CAROM_OK || radius < (int32_t)(n * n * n / 8));
        if (result == CAROM_OK) {
            made++;
            check_shape(result, CAROM_CAPSULE_VERTICES(n), CAROM_CAPSULE_FACES(n));
        }
    }
    CHECK_AT_LEAST(made, 20);
}

/*
 * Small balls of many sides whose rounded vertices lie in no convex order: a vertex is outside the last face that was put, which
 * looks outwards.
 */
static void dented(void)
{
    /* the dent is found at a pole; by the first triangle of a square, along either diagonal; by the second */
    static const int32_t cases[][2] = {{16, 7}, {20, 13}, {56, 61}, {16, 5}};
    static const int16_t origin[3];

    for (int n = 0; n < 4; n++) {
        const uint32_t sides = (uint32_t)cases[n][0];
        const uint32_t v_count = CAROM_SPHERE_VERTICES(sides), f_count = CAROM_SPHERE_FACES(sides);
        int16_t(*v)[3] = (int16_t(*)[3])block;
        uint16_t(*f)[3] = (uint16_t(*)[3])(v + v_count);
        const struct carom_shape_room large = {v, f, v_count, f_count, 10};
        uint32_t last = f_count - 1, outside = 0;

        CHECK_AT_MOST((v_count + f_count) * sizeof *v, sizeof block);
        memset(block, 0xff, sizeof block);
        CHECK_EQ(carom_shape_sphere(&raw, &large, cases[n][1], sides), CAROM_ERR_RANGE);
        while (f[last][0] == 0xffff) {
            last--;
        }
        CHECK_LESS(outside6_of(v, f[last], origin), 0);
        for (uint32_t i = 0; i < v_count; i++) {
            outside += outside6_of(v, f[last], v[i]) > 0;
        }
        CHECK_MORE(outside, 0);
    }
}

/*
 * The largest number of sides at the largest radius; only the first vertices, which lie on a
 * circle.
 */
static void largest_circle(void)
{
    CHECK_EQ(carom_shape_cone(&raw, &room, 32767, 1, 127), CAROM_OK);
    for (uint32_t v = 0; v < 127; v++) {
        const double x = vertices[v][0], y = vertices[v][1];

        CHECK_LESS(real_abs(real_sqrt(x * x + y * y) - 32767), 0.71);
    }
}

static void refusals(void)
{
    const struct carom_mesh_raw before = {NULL, NULL, 1, 2, 3, 0};
    const int32_t half[3] = {1, 1, 1}, none[3] = {1, 0, 1}, wide[3] = {1, 1, 32768};
    const struct carom_shape_room no_vertices = {NULL, faces, V_MAX, F_MAX, 10};
    const struct carom_shape_room no_faces = {vertices, NULL, V_MAX, F_MAX, 10};
    const struct carom_shape_room seven = {vertices, faces, 7, 12, 10};
    const struct carom_shape_room eleven = {vertices, faces, 8, 11, 10};
    const struct carom_shape_room coarse = {vertices, faces, V_MAX, F_MAX, 6};
    struct carom_shape_room small = room, fine = room;

    raw = before;
    small.face_count = CAROM_SPHERE_FACES(8) - 1;
    fine.quantum_bits = 21;
    CHECK_EQ(carom_shape_box(NULL, &room, half), CAROM_ERR_NULL);
    CHECK_EQ(carom_shape_box(&raw, NULL, half), CAROM_ERR_NULL);
    CHECK_EQ(carom_shape_box(&raw, &room, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_shape_box(&raw, &room, none), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_shape_box(&raw, &no_vertices, half), CAROM_ERR_NULL);
    CHECK_EQ(carom_shape_box(&raw, &no_faces, half), CAROM_ERR_NULL);
    CHECK_EQ(carom_shape_box(&raw, &seven, half), CAROM_ERR_MEMORY);
    CHECK_EQ(carom_shape_box(&raw, &eleven, half), CAROM_ERR_MEMORY);
    CHECK_EQ(carom_shape_box(&raw, &coarse, half), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_shape_box(&raw, &room, wide), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_shape_sphere(NULL, &room, 1000, 8), CAROM_ERR_NULL);
    CHECK_EQ(carom_shape_capsule(&raw, &room, 1000, -1, 8), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_shape_box(&raw, &fine, half), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_shape_sphere(&raw, &small, 1000, 8), CAROM_ERR_MEMORY);
    small.face_count++;
    small.vertex_count = CAROM_SPHERE_VERTICES(8) - 1;
    CHECK_EQ(carom_shape_sphere(&raw, &small, 1000, 8), CAROM_ERR_MEMORY);
    CHECK_EQ(carom_shape_sphere(&raw, &room, 0, 8), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_shape_sphere(&raw, &room, 32768, 8), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_shape_sphere(&raw, &room, 1000, 10), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_shape_sphere(&raw, &room, 1000, 0), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_shape_sphere(&raw, &room, 1000, 132), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_shape_sphere(&raw, &room, 10, 32),
             CAROM_ERR_RANGE); /* 1023 faces in 20 quanta */
    CHECK_EQ(carom_shape_capsule(&raw, &room, 1000, 0, 8), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_shape_capsule(&raw, &room, 1000, 31768, 8), CAROM_ERR_RANGE);
    CHECK_EQ(carom_shape_capsule(&raw, &room, 1000, 31767, 8), CAROM_OK);
    raw = before;
    CHECK_EQ(carom_shape_cylinder(&raw, &room, 1000, 1000, 2), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_shape_cylinder(&raw, &room, 1000, 0, 8), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_shape_cone(&raw, &room, 1000, 1000, 129), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_shape_cone(&raw, &room, 1000, 40000, 8), CAROM_ERR_ARGUMENT);
    CHECK_EQ(memcmp(&raw, &before, sizeof raw), 0);
    CHECK_EQ(carom_shape_sphere(&raw, &room, 1, 4), CAROM_OK); /* an octahedron of one quantum */
    CHECK_EQ(volume6(), 8);
}

const struct test tests_mesh_shapes[] = {
    {"mesh_shapes/box", box},
    {"mesh_shapes/sphere", sphere},
    {"mesh_shapes/sphere_is_round", sphere_is_round},
    {"mesh_shapes/capsule", capsule},
    {"mesh_shapes/cylinder_and_cone", cylinder_and_cone},
    {"mesh_shapes/any_size", any_size},
    {"mesh_shapes/dented", dented},
    {"mesh_shapes/largest_circle", largest_circle},
    {"mesh_shapes/refusals", refusals},
    {0},
};
