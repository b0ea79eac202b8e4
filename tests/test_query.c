/* SPDX-License-Identifier: MIT */
/*
 * Queries at a pose, and the candidates of a step in which nothing moves, at special poses: faces
 * that touch, lie in one plane or stand on edge over the grid, bodies on the sides of cells,
 * slivers, one body inside the other. The oracle tries all pairs: faces in exact arithmetic,
 * features in double precision.
 */
#include "lib/crossing.h"
#include "interfere/interfere.h"
#include "lib/real.h"
#include "lib/solids.h"
#include "lib/test.h"

#ifdef TEST_LONG
#define POSES 200
#else
#define POSES 4
#endif

#define ROOM       4096
#define CANDIDATES 8192
#define FACES      2048
#define NEAR_Q22   64 /* features this near must be candidates */
#define CONE       (real(INTERFERE_CONE_Q30, 30) - 1e-6)

static struct shape shape_a, shape_b;
static struct solid a = {.shape = &shape_a}, b = {.shape = &shape_b};
static struct body bodies[2];
static struct body_state states[2];

static struct candidate candidates[CANDIDATES];
static struct carom_face_ref faces[FACES];
static struct pool candidate_pool, face_pool;
static struct interfere work;
static struct interfere_leaf leaf;
static struct carom_face_pair found[ROOM];

static int32_t corner_a[SHAPE_VERTICES][3], corner_b[SHAPE_VERTICES][3];
static struct crossing_face near_a[SHAPE_FACES], near_b[SHAPE_FACES];
static struct crossing_body exact_a = {&shape_a.mesh, corner_a, near_a};
static struct crossing_body exact_b = {&shape_b.mesh, corner_b, near_b};
static uint8_t bits[CROSSING_BITS(SHAPE_FACES, SHAPE_FACES)];
static struct crossing_tally tally;
static uint32_t features; /* features that had to be candidates */

/* -------------------------------------------------------------------- checks */

/* Make new bodies of both shapes, side by side in the middle of the world, not turned. */
static void make_bodies(void)
{
    shape_body(&shape_a, false, &bodies[0], &states[0]);
    shape_body(&shape_b, false, &bodies[1], &states[1]);
    solid_note_owned(&a);
    solid_note_owned(&b);
    memset(&tally, 0, sizeof tally);
    features = 0;
}

static struct interfere_placed placed(int i)
{
    return (struct interfere_placed){&bodies[i], &states[i]};
}

/* Query in both orders: every pair with a common point, each once, and the same pairs in both. */
static int query(void)
{
    int count = interfere_query(&work, placed(1), placed(0), found, ROOM);
    struct crossing_tally back = {0};

    CHECK_AT_LEAST(count, 0);
    crossing_place(&exact_a, &states[0].position, &states[0].rotation, &states[1].position);
    crossing_place(&exact_b, &states[1].position, &states[1].rotation, &states[1].position);
    crossing_compare(&exact_b, &exact_a, found, (uint32_t)count, bits, &back);
    CHECK_EQ(back.missed, 0);
    CHECK_EQ(back.repeated, 0);
    count = interfere_query(&work, placed(0), placed(1), found, ROOM);
    CHECK_AT_LEAST(count, 0);
    crossing_compare(&exact_a, &exact_b, found, (uint32_t)count, bits, &tally);
    CHECK_EQ(tally.missed, 0);
    CHECK_EQ(tally.repeated, 0);
    return count;
}

static bool is_candidate(int kind, uint32_t i, uint32_t j)
{
    const struct candidate wanted = {0, (uint8_t)kind, i, j};

    for (uint32_t k = 0; k < candidate_pool.used; k++) {
        if (candidate_compare(&candidates[k], &wanted) == 0) {
            return true;
        }
    }
    return false;
}

static void check_vertices(const struct solid *from, const struct solid *to, int kind)
{
    for (uint32_t v = 0; v < from->shape->raw.vertex_count; v++) {
        for (uint32_t f = 0; f < to->shape->raw.face_count && from->own_vertex[v]; f++) {
            if (solid_vertex_near(from, v, to, f, NEAR_Q22) &&
                solid_vertex_cone(from, v, to->normal[f], CONE)) {
                CHECK(is_candidate(kind, v, f));
                features++;
            }
        }
    }
}

static void check_edges(void)
{
    for (uint32_t i = 0; i < shape_a.mesh.edge_count; i++) {
        for (uint32_t j = 0; j < shape_b.mesh.edge_count && a.own_edge[i]; j++) {
            if (b.own_edge[j] && solid_edges_near(&a, i, &b, j, NEAR_Q22) &&
                solid_edge_cones(&a, i, &b, j, CONE)) {
                CHECK(is_candidate(CANDIDATE_EDGE_EDGE, i, j));
                features++;
            }
        }
    }
}

static void visit_none(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    (void)self;
    (void)c;
    CHECK_LESS(n, CANDIDATES); /* all of them fit */
}

/* The candidates when nothing moves are all features that are near and face each other. */
static uint32_t step(void)
{
    const struct pair pair = {0, 1};
    struct candidate_visitor visitor = {visit_none};

    for (int i = 0; i < 2; i++) {
        body_place(&bodies[i], &states[i]);
        body_region_begin(&bodies[i], &states[i], CAROM_ONE_Q30, CAROM_ONE_Q30, NEAR_Q22);
    }

    CHECK_EQ(interfere_visit(&work, bodies, &pair, 1, &visitor), CAROM_OK);
    solid_place(&a, &states[0]);
    solid_place(&b, &states[1]);
    check_vertices(&a, &b, CANDIDATE_VERTEX_FACE);
    check_vertices(&b, &a, CANDIDATE_FACE_VERTEX);
    check_edges();
    return candidate_pool.used;
}

static void begin(void)
{
    candidate_pool = (struct pool){CANDIDATES, 0, 0, 0};
    face_pool = (struct pool){FACES, 0, 0, 0};
    memset(&work, 0, sizeof work);
    work.leaf = &leaf;
    work.candidates = candidates;
    work.candidate_pool = &candidate_pool;
    work.faces = faces;
    work.face_pool = &face_pool;
}

/* Place body i; x, y and z are in 2^-12 units. */
static void put(int i, int64_t x, int64_t y, int64_t z)
{
    states[i].position = (carom_v3_q32){{x * (1 << 20), y * (1 << 20), z * (1 << 20)}};
}

/* A quarter turn n times about an axis. */
static carom_quat_q30 quarters(int axis, int n)
{
    static const double part[4][2] = {{1, 0},
                                      {0.70710678118654752, 0.70710678118654752},
                                      {0, 1},
                                      {0.70710678118654752, -0.70710678118654752}};
    carom_quat_q30 q = {{(int32_t)real_round(part[n][0] * CAROM_ONE_Q30), 0, 0, 0}};

    q.c[1 + axis] = (int32_t)real_round(part[n][1] * CAROM_ONE_Q30);
    return q;
}

/* ------------------------------------------------------------------- by hand */

/*
 * An upright needle through one of a plane's two triangles: its eight side faces and that triangle.
 */
static void test_needle(void)
{
    begin();
    shape_box(&shape_a, 12, 64, 48, 4096);
    shape_plane(&shape_b, 12, 1, 8192);
    make_bodies();
    put(0, 2000, -1500, 300);
    CHECK_EQ(query(), 8);
    for (int i = 0; i < 8; i++) {
        const uint16_t *c = shape_a.faces[found[i].a];

        CHECK_EQ(found[i].b, 0); /* the lower right one */
        CHECK(shape_a.vertices[c[0]][2] != shape_a.vertices[c[1]][2] ||
              shape_a.vertices[c[0]][2] != shape_a.vertices[c[2]][2]);
    }
    CHECK_EQ(tally.crossing, 8);
    put(0, 2000, -1500, 2049);
    CHECK_EQ(query(), 0);
    put(0, 2000, -1500, -2049);
    CHECK_EQ(query(), 0);
    put(0, 4096 + 33, -1500, 0);
    CHECK_EQ(query(), 0);
}

/* An `out` that is too short gives an error; one that is just long enough gives none. */
static void test_room(void)
{
    begin();
    shape_ball(&shape_a, 12, 2048);
    shape_field(&shape_b, 12, 4, 1024, 500, 3);
    make_bodies();
    for (int i = 0; i < 2; i++) {
        int count = query();

        CHECK_MORE(count, 4);
        CHECK_EQ(interfere_query(&work, placed(i), placed(1 - i), found, (uint32_t)count), count);
        CHECK_EQ(interfere_query(&work, placed(i), placed(1 - i), found, (uint32_t)count - 1),
                 CAROM_ERR_FACES_FULL);
        CHECK_EQ(interfere_query(&work, placed(i), placed(1 - i), NULL, 0), CAROM_ERR_FACES_FULL);
        CHECK_EQ(work.error, CAROM_OK);
    }
    put(0, 0, 0, 4096);
    CHECK_EQ(interfere_query(&work, placed(0), placed(1), NULL, 0), 0);
    /* far away, where differences of places need more than 32 bits */
    states[0].position.c[0] = (int64_t)4096 << 32;
    states[1].position.c[0] = -((int64_t)4096 << 32);
    CHECK_EQ(interfere_query(&work, placed(0), placed(1), NULL, 0), 0);
}

/*
 * The largest meshes, and the same in 2^-12 units, where all numbers are well within the formats:
 * the same pairs in the same order.
 */
static void test_large(void)
{
    static struct carom_face_pair small[ROOM];
    struct test_random r = {17};
    int touching = 0;

    begin();
    for (int n = 0; n < POSES; n++) {
        carom_quat_q30 turn[2] = {shape_random_turn(&r), shape_random_turn(&r)};
        int64_t at[3], count[2];

        for (int k = 0; k < 3; k++) {
            at[k] = test_random_range(&r, -18000, 18000);
        }
        for (int large = 0; large < 2; large++) {
            int bits = large ? 7 : 12;

            shape_box(&shape_a, bits, 32766, 30000, 18000);
            shape_ball(&shape_b, bits, 14000);
            make_bodies();
            for (int k = 0; k < 3; k++) {
                states[0].position.c[k] = at[k] * ((int64_t)1 << (32 - bits));
            }
            states[0].rotation = turn[0];
            states[1].rotation = turn[1];
            count[large] =
                interfere_query(&work, placed(0), placed(1), large ? found : small, ROOM);
            CHECK(!interfere_inside(placed(0), placed(1)) || count[large] != 0);
        }
        CHECK_AT_LEAST(count[0], 0);
        CHECK_EQ(count[0], count[1]);
        CHECK_EQ(memcmp(small, found, (size_t)count[0] * sizeof small[0]), 0);
        touching += count[0] > 0;
    }
    CHECK_MORE(2 * touching, POSES);
}

/* ----------------------------------------------------------------- containment */

/* Whether a point is in the L of shape_l with this side, in 2^-12 units; -1 on its surface. */
static int in_l(const int64_t p[3], int64_t side)
{
    bool inside = p[2] > 0 && p[2] < side && p[0] > 0 && p[1] > 0 && p[0] < 2 * side &&
                  p[1] < 2 * side && (p[0] < side || p[1] < side);
    bool outside = p[2] < 0 || p[2] > side || p[0] < 0 || p[1] < 0 || p[0] > 2 * side ||
                   p[1] > 2 * side || (p[0] > side && p[1] > side);

    return inside ? 1 : outside ? 0 : -1;
}

/*
 * A small box around the points of a lattice; some of these lie in the planes of the L's sides,
 * over its edges and over its vertices. The shape's own coordinates tell whether the box is inside.
 */
static void test_inside_l(void)
{
    const int64_t side = 1024;
    int inside = 0, outside = 0;

    begin();
    shape_box(&shape_a, 12, 32, 32, 32);
    shape_l(&shape_b, 12, (int)side);
    make_bodies();
    for (int n = 0; n < 7 * 7 * 5; n++) {
        static const int level[5] = {-505, 7, 519, 1022, 1031};
        const int64_t at[3] = {(n % 7 - 1) * side / 2, (n / 7 % 7 - 1) * side / 2, level[n / 49]};
        const int16_t *first = shape_a.vertices[0];
        int64_t p[3], centre[3];
        int expected;

        for (int k = 0; k < 3; k++) {
            /* the first vertex is in the lattice; b's frame begins at b's centre */
            p[k] = at[k] - first[k];
            centre[k] = shape_b.mesh.mass.centre.c[k];
            states[0].position.c[k] = p[k] * (1 << 20) - centre[k] * (1 << 10);
        }
        expected = in_l(at, side);
        CHECK(!interfere_inside(placed(1), placed(0)));
        if (expected >= 0) {
            CHECK_EQ(interfere_inside(placed(0), placed(1)), expected);
            inside += expected;
            outside += 1 - expected;
        }
    }
    CHECK_EQ(inside, 15); /* five places in the outline, on three levels */
    CHECK_MORE(outside, 100);
}

/* Both bodies are turned together, in any way: the inner body stays inside, and no faces cross. */
static void test_inside_turned(void)
{
    struct test_random r = {9};

    begin();
    shape_ball(&shape_a, 12, 400);
    shape_l(&shape_b, 12, 2048);
    make_bodies();
    for (int n = 0; n < POSES; n++) {
        /* from the corner of the L: in either arm, where they meet, in the notch, beside the L */
        static const int16_t at[5][4] = {{3000, 1000, 1000, 1},
                                         {1000, 3200, 1100, 1},
                                         {900, 900, 900, 1},
                                         {3000, 3000, 1000, 0},
                                         {-900, 1000, 1000, 0}};
        const int16_t *p = at[n % 5];
        carom_m3_q30 m;

        states[0].rotation = shape_random_turn(&r);
        states[1].rotation = shape_random_turn(&r);
        fix_matrix(&m, &states[1].rotation);
        for (int k = 0; k < 3; k++) {
            int64_t d_q32 = 0;

            for (int i = 0; i < 3; i++) {
                int64_t from_q22 = p[i] * (1 << 10) - shape_b.mesh.mass.centre.c[i];

                d_q32 += m.c[k][i] * from_q22 / (1 << 20);
            }
            states[1].position.c[k] = test_random_range(&r, -((int64_t)9 << 40), (int64_t)9 << 40);
            states[0].position.c[k] = states[1].position.c[k] + d_q32;
        }
        CHECK_EQ(query(), 0);
        CHECK_EQ(interfere_inside(placed(0), placed(1)), p[3]);
        CHECK(!interfere_inside(placed(1), placed(0)));
        CHECK_EQ(step(), 0);
    }
    CHECK_EQ(tally.crossing, 0);
}

/* A body below a surface is inside it, at any depth; above it, or beside it, is outside. */
static void test_inside_surface(void)
{
    begin();
    shape_ball(&shape_a, 12, 400);
    shape_field(&shape_b, 12, 8, 512, 600, 4);
    make_bodies();
    for (int n = 0; n < 25; n++) {
        int x = (n % 5 - 2) * 600, y = (n / 5 - 2) * 600;

        put(0, x, y, -500);
        CHECK_EQ(query(), 0);
        CHECK(interfere_inside(placed(0), placed(1)));
        CHECK(!interfere_inside(placed(1), placed(0)));
        put(0, x, y, -500000);
        CHECK(interfere_inside(placed(0), placed(1)));
        put(0, x, y, 1001);
        CHECK_EQ(query(), 0);
        CHECK(!interfere_inside(placed(0), placed(1)));
        put(0, x + 4000, y, -500);
        CHECK_EQ(interfere_inside(placed(0), placed(1)), false);
        put(0, x + 5000000, y, -500);
        CHECK_EQ(interfere_inside(placed(0), placed(1)), false);
    }
}

/* ------------------------------------------------------- touching, in one plane */

/*
 * Two boxes side by side on all six sides, shifted along the common side: their faces touch in one
 * plane, or only at edges and corners.
 */
static void test_touching(void)
{
    static const int size_a[3] = {2000, 1200, 600}, size_b[3] = {1600, 2400, 800};

    begin();
    shape_box(&shape_a, 12, size_a[0], size_a[1], size_a[2]);
    shape_box(&shape_b, 12, size_b[0], size_b[1], size_b[2]);
    make_bodies();
    for (int side = 0; side < 6; side++) {
        int axis = side / 2, sign = side % 2 ? 1 : -1;

        for (int n = 0; n < 9; n++) {
            int i = (axis + 1) % 3, j = (axis + 2) % 3, at[3];
            uint32_t before = tally.crossing;

            at[axis] = sign * (size_a[axis] + size_b[axis]) / 2;
            /* overlapping, aligned at one side, edge on edge or corner on corner */
            at[i] = (n % 3) * (size_a[i] + size_b[i]) / 4;
            at[j] = (n / 3) * (size_a[j] + size_b[j]) / 4;
            put(0, at[0], at[1], at[2]);
            CHECK_MORE(query(), 0);
            CHECK_MORE(tally.crossing, before);
            CHECK_MORE(step(), 0);
            /* a little apart: nothing */
            at[axis] += sign;
            put(0, at[0], at[1], at[2]);
            CHECK_EQ(query(), 0);
        }
    }
    CHECK_MORE(features, 6 * 9);
}

/* Boxes on a plane of triangles: their lower sides are in the plane of all its faces. */
static void test_coplanar(void)
{
    begin();
    shape_box(&shape_a, 12, 2000, 1200, 600);
    shape_plane(&shape_b, 12, 6, 512);
    make_bodies();
    for (int n = 0; n < 16; n++) {
        put(0, (n % 4) * 256, (n / 4) * 128, 300);
        states[0].rotation = quarters(2, n % 4);
        CHECK_MORE(query(), 10);
        CHECK_MORE(step(), 0);
    }
    CHECK_MORE(features, 16);
}

/*
 * Two plates turned against each other in a common plane, up to some millionths of a radian and of
 * a unit: only rounding decides which corners are above a plane.
 */
static void test_nearly_coplanar(void)
{
    struct test_random r = {31};

    begin();
    shape_box(&shape_a, 12, 3000, 900, 200);
    shape_box(&shape_b, 12, 1800, 2200, 160);
    make_bodies();
    for (int n = 0; n < 5 * POSES; n++) {
        int64_t size = (int64_t)1 << test_random_range(&r, 4, 16);
        carom_quat_q30 q = {{CAROM_ONE_Q30, 0, 0, 0}};

        for (int k = 0; k < 3; k++) {
            int64_t most = k == 2 ? CAROM_ONE_Q30 : size;

            q.c[1 + k] = (int32_t)test_random_range(&r, -most, most);
            states[0].position.c[k] = test_random_range(&r, -1500, 1500) * (1 << 20);
        }
        states[0].position.c[2] =
            (n % 2 ? 180 : -180) * (1 << 20) + test_random_range(&r, -size, size) * 4;
        body_normalise(&q);
        body_normalise(&q);
        states[0].rotation = q;
        query();
    }
    CHECK_MORE(tally.touching, POSES);
}

/* --------------------------------------------------------- on edge, on the grid */

/*
 * A box with upright and level faces in an L with such faces, by quarter turns of both: some faces
 * are lines or points on the grid.
 */
static void test_edge_on(void)
{
    begin();
    shape_box(&shape_a, 12, 1400, 1000, 700);
    shape_l(&shape_b, 12, 1024);
    make_bodies();
    for (int n = 0; n < 3 * 4 * 4; n++) {
        states[0].rotation = quarters(n % 3, n / 3 % 4);
        for (int k = 0; k < 3; k++) {
            states[0].position.c[k] =
                (n / 12 - 1) * (k + 1) * ((int64_t)150 << 20) + (n % 2) * ((int64_t)(1 << 21) + k);
        }
        query();
        step();
    }
    CHECK_MORE(tally.touching, 24);
    CHECK_MORE(tally.crossing, 400);
}

/*
 * Boxes with sides on the sides of b's cells, to the quantum and one more or less: over a field and
 * in a ball.
 */
static void check_cells(int64_t z)
{
    const struct carom_mesh *mesh = &shape_b.mesh;
    int64_t cell = (int64_t)1 << mesh->grid_shift, origin[3];
    int64_t width = 2 * cell > 256 ? 2 * cell : 256;

    shape_box(&shape_a, 12, (int)width, (int)width, 512);
    make_bodies();
    for (int k = 0; k < 2; k++) {
        origin[k] = k == 0 ? mesh->grid_x0 : mesh->grid_y0;
        origin[k] = origin[k] * (1 << 20) - mesh->mass.centre.c[k] * (int64_t)(1 << 10);
    }
    for (int col = 0; col <= mesh->grid_nx; col++) {
        for (int off = -1; off <= 1; off++) {
            int row = (3 * col + off + 1) % (mesh->grid_ny + 1);

            states[0].position.c[0] =
                origin[0] + (col * cell + width / 2) * (1 << 20) + off * (1 << 20);
            states[0].position.c[1] =
                origin[1] + (row * cell - width / 2) * (1 << 20) + off * (1 << 10);
            states[0].position.c[2] = z * (1 << 20) + off;
            query();
            step();
        }
    }
    CHECK_MORE(tally.touching, mesh->grid_nx);
    CHECK_MORE(tally.crossing, 10u * mesh->grid_nx);
}

static void test_cells(void)
{
    begin();
    shape_field(&shape_b, 12, 8, 512, 400, 11);
    check_cells(200);
    shape_plane(&shape_b, 12, 8, 512);
    check_cells(256); /* and on the plane */
    shape_ball(&shape_b, 12, 2000);
    check_cells(900);
}

/* -------------------------------------------------------------------- slivers */

/* Boxes with one side or two of a few quanta, overlapping in any way. Returns how many touch. */
static uint32_t check_slivers(uint64_t seed)
{
    struct test_random r = {seed};

    make_bodies();
    for (int n = 0; n < POSES; n++) {
        for (int i = 0; i < 2; i++) {
            states[i].rotation = shape_random_turn(&r);
            for (int k = 0; k < 3; k++) {
                states[i].position.c[k] = test_random_range(&r, -200, 200) * (1 << 20);
            }
        }
        query();
        step();
    }
    return tally.touching;
}

static void test_slivers(void)
{
    uint32_t touching;

    begin();
    shape_box(&shape_a, 12, 4096, 2, 2);
    shape_box(&shape_b, 12, 3000, 2500, 2);
    touching = check_slivers(21);
    shape_box(&shape_a, 12, 4000, 3000, 2);
    touching += check_slivers(22);
    shape_box(&shape_a, 12, 30000, 4, 200);
    shape_ball(&shape_b, 12, 300);
    touching += check_slivers(23);
    /* a large face and a very small one */
    shape_box(&shape_a, 14, 4, 6, 20);
    shape_plane(&shape_b, 8, 1, 30000);
    touching += check_slivers(24);
    CHECK_AT_LEAST(touching, POSES);
}

const struct test tests_query[] = {
    {"query/needle", test_needle},
    {"query/room", test_room},
    {"query/large", test_large},
    {"query/inside_l", test_inside_l},
    {"query/inside_turned", test_inside_turned},
    {"query/inside_surface", test_inside_surface},
    {"query/touching", test_touching},
    {"query/coplanar", test_coplanar},
    {"query/nearly_coplanar", test_nearly_coplanar},
    {"query/edge_on", test_edge_on},
    {"query/cells", test_cells},
    {"query/slivers", test_slivers},
    {0},
};
