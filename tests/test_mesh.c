/* SPDX-License-Identifier: MIT */
#include <string.h>

#include "mesh.h"
#include "test.h"

#ifdef TEST_LONG
#define POINT_STEP 1 /* of the places on a face that are looked up in the z-lists */
#else
#define POINT_STEP 11
#endif

/* ---------------------------------------------------------------------- shapes */

#define V_MAX 1600
#define F_MAX 2048

[V_MAX][3];
static uint16_t faces[F_MAX][3];
static struct carom_mesh_raw raw;
static struct carom_mesh mesh;
static _Alignas(8) uint8_t block[CAROM_MESH_BYTES(V_MAX, F_MAX) + 8];

static void begin(int kind)
{
    raw.vertices = (const int16_t(*)[3])vertices;
    raw.faces = (const uint16_t(*)[3])faces;
    raw.vertex_count = raw.face_count = 0;
    raw.quantum_bits = 10;
    raw.kind = (uint8_t)kind;
}

static uint32_t add_vertex(int x, int y, int z)
{
    int16_t *v = vertices[raw.vertex_count];

    v[0] = (int16_t)x;
    v[1] = (int16_t)y;
    v[2] = (int16_t)z;
    return raw.vertex_count++;
}

static void add_face(uint32_t a, uint32_t b, uint32_t c)
{
    uint16_t *f = faces[raw.face_count++];

    f[0] = (uint16_t)a;
    f[1] = (uint16_t)b;
    f[2] = (uint16_t)c;
}

static void add_quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    add_face(a, b, c);
    add_face(a, c, d);
}

/* A prism over a counter-clockwise polygon, its top and bottom cut into triangles from corner 0. */
static void make_prism(const int (*corner)[2], uint32_t n, int height)
{
    begin(CAROM_SOLID);
    for (uint32_t i = 0; i < 2 * n; i++) {
        add_vertex(corner[i % n][0], corner[i % n][1], i < n ? 0 : height);
    }
    for (uint32_t i = 0; i < n; i++) {
        uint32_t next = (i + 1) % n;

        if (i >= 1 && i + 1 < n) {
            add_face(0, next, i);
            add_face(n, n + i, n + next);
        }
        add_quad(i, next, n + next, n + i);
    }
}

static void make_box(int x, int y, int z)
{
    const int corner[4][2] = {{0, 0}, {x, 0}, {x, y}, {0, y}};

    make_prism(corner, 4, z);
}

/* A field of n by n squares of `side` quanta, up to `rough` high. */
static void make_field(uint32_t n, int side, int rough, uint64_t seed)
{
    struct test_random r = {seed};

    begin(CAROM_SURFACE);
    for (uint32_t i = 0; i < (n + 1) * (n + 1); i++) {
        add_vertex((int)(i % (n + 1)) * side, (int)(i / (n + 1)) * side,
                   (int)test_random_range(&r, 0, rough));
    }
    for (uint32_t y = 0; y < n; y++) {
        for (uint32_t x = 0; x < n; x++) {
            uint32_t v = y * (n + 1) + x;

            add_quad(v, v + 1, v + n + 2, v + n + 1);
        }
    }
}

/* A solid with a rough top and a rough bottom: two fields, the lower one turned over, and a wall.
 */
static void make_bumpy(uint32_t n, int side, int rough, uint64_t seed)
{
    uint32_t lower, count;

    make_field(n, side, rough, seed);
    raw.kind = CAROM_SOLID;
    lower = raw.vertex_count;
    count = raw.face_count;
    for (uint32_t v = 0; v < lower; v++) {
        add_vertex(vertices[v][0], vertices[v][1], vertices[v][2] / 2 - rough);
    }
    for (uint32_t f = 0; f < count; f++) {
        add_face(lower + faces[f][0], lower + faces[f][2], lower + faces[f][1]);
    }
    for (uint32_t i = 0; i < n; i++) {
        uint32_t south = i, east = i * (n + 1) + n, north = (n + 1) * (n + 1) - 1 - i;
        uint32_t west = (n - i) * (n + 1);

        add_quad(lower + south, lower + south + 1, south + 1, south);
        add_quad(lower + east, lower + east + n + 1, east + n + 1, east);
        add_quad(lower + north, lower + north - 1, north - 1, north);
        add_quad(lower + west, lower + west - n - 1, west - n - 1, west);
    }
}

static int build(void)
{
    return carom_mesh_build(&mesh, &raw, block, CAROM_MESH_BYTES(raw.vertex_count, raw.face_count));
}

static int64_t dot64(const int64_t a[3], const int64_t b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* From vertex a to vertex b, quanta. */
static void between(int64_t out[3], uint32_t a, uint32_t b)
{
    for (int k = 0; k < 3; k++) {
        out[k] = raw.vertices[b][k] - raw.vertices[a][k];
    }
}

static void exact_normal(int64_t out[3], uint32_t face)
{
    int64_t u[3], v[3];

    between(u, raw.faces[face][0], raw.faces[face][1]);
    between(v, raw.faces[face][0], raw.faces[face][2]);
    for (int k = 0; k < 3; k++) {
        out[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    }
}

/* ---------------------------------------------------------------------- errors */

/* build() must refuse with `error`, as must the check, and leave the mesh alone. */
static void check_refused(int error, int line)
{
    struct carom_mesh before;

    memset(&mesh, 0x5a, sizeof mesh);
    before = mesh;
    test_check_near(build(), error, 0, __FILE__, line, "error");
    test_check_near(carom_mesh_check(&raw, block, sizeof block), error, 0, __FILE__, line, "check");
    test_check(memcmp(&mesh, &before, sizeof mesh) == 0, __FILE__, line, "mesh untouched");
}
#define CHECK_REFUSED(error) check_refused(error, __LINE__)

static void test_arguments(void)
{
    make_box(100, 100, 100);
    CHECK_EQ(build(), CAROM_OK);
    CHECK_EQ(carom_mesh_check(&raw, block, sizeof block), CAROM_OK);
    CHECK_EQ(carom_mesh_build(NULL, &raw, block, sizeof block), CAROM_ERR_NULL);
    CHECK_EQ(carom_mesh_build(&mesh, NULL, block, sizeof block), CAROM_ERR_NULL);
    CHECK_EQ(carom_mesh_build(&mesh, &raw, NULL, sizeof block), CAROM_ERR_NULL);
    CHECK_EQ(carom_mesh_check(&raw, NULL, sizeof block), CAROM_ERR_NULL);
    CHECK_EQ(carom_mesh_build(&mesh, &raw, block, CAROM_MESH_BYTES(8, 12) - 1), CAROM_ERR_MEMORY);
    CHECK_EQ(carom_mesh_build(&mesh, &raw, block + 4, sizeof block - 4), CAROM_ERR_MEMORY);
    raw.quantum_bits = 6;
    CHECK_REFUSED(CAROM_ERR_ARGUMENT);
    raw.quantum_bits = 21;
    CHECK_REFUSED(CAROM_ERR_ARGUMENT);
    raw.quantum_bits = 20;
    CHECK_EQ(build(), CAROM_OK);
    raw.kind = 2;
    CHECK_REFUSED(CAROM_ERR_ARGUMENT);
    begin(CAROM_SOLID);
    raw.vertices = NULL;
    CHECK_REFUSED(CAROM_ERR_NULL);
}

static void test_bad_faces(void)
{
    make_box(100, 100, 100);
    raw.face_count = 0;
    CHECK_REFUSED(CAROM_ERR_MESH_EMPTY);
    raw.face_count = 65536;
    CHECK_REFUSED(CAROM_ERR_MESH_SIZE);
    raw.face_count = 12;
    raw.vertex_count = 65536;
    CHECK_REFUSED(CAROM_ERR_MESH_SIZE);
    raw.vertex_count = 7;
    CHECK_REFUSED(CAROM_ERR_MESH_INDEX);
    raw.vertex_count = 0;
    CHECK_REFUSED(CAROM_ERR_MESH_INDEX);
    raw.vertex_count = 8;
    for (int k = 0; k < 3; k++) {
        uint16_t v = faces[5][k];

        faces[5][k] = faces[5][(k + 1) % 3];
        CHECK_REFUSED(CAROM_ERR_MESH_INDEX);
        faces[5][k] = v;
    }
    /* corners 0, 1, 2 of the bottom in line */
    vertices[2][0] = 50;
    vertices[2][1] = 0;
    CHECK_REFUSED(CAROM_ERR_MESH_DEGENERATE);
}

static void test_bad_edges(void)
{
    uint16_t face[3];

    make_box(100, 100, 100);
    raw.face_count = 11;
    CHECK_REFUSED(CAROM_ERR_MESH_OPEN);

    /* one face turned over: three sides run twice in one direction */
    make_box(100, 100, 100);
    memcpy(face, faces[4], sizeof face);
    faces[4][0] = face[1];
    faces[4][1] = face[0];
    CHECK_REFUSED(CAROM_ERR_MESH_EDGE);

    /* two tetrahedra on one edge: four faces meet there */
    begin(CAROM_SOLID);
    add_vertex(0, 0, 0);
    add_vertex(0, 0, 100);
    add_vertex(100, 0, 0);
    add_vertex(0, 100, 0);
    add_vertex(-100, 0, 0);
    add_vertex(0, -100, 0);
    for (uint32_t i = 2; i <= 4; i += 2) {
        add_face(0, 1, i);
        add_face(1, 0, i + 1);
        add_face(0, i, i + 1);
        add_face(1, i + 1, i);
    }
    CHECK_REFUSED(CAROM_ERR_MESH_EDGE);

    /* a second face of one direction on an edge of a surface; a third face of either */
    make_field(2, 100, 10, 1);
    add_face(faces[0][0], faces[0][1], add_vertex(50, -50, 60));
    CHECK_REFUSED(CAROM_ERR_MESH_EDGE);
    make_field(2, 100, 10, 1);
    add_face(faces[0][0], faces[0][2], add_vertex(-50, 50, 60));
    CHECK_REFUSED(CAROM_ERR_MESH_EDGE);
    make_field(2, 100, 10, 1);
    add_face(faces[0][2], faces[0][0], add_vertex(50, -50, 60));
    CHECK_REFUSED(CAROM_ERR_MESH_EDGE);
}

static void test_bad_orientation(void)
{
    make_box(100, 100, 100);
    for (uint32_t f = 0; f < raw.face_count; f++) {
        uint16_t v = faces[f][0];

        faces[f][0] = faces[f][1];
        faces[f][1] = v;
    }
    CHECK_REFUSED(CAROM_ERR_MESH_INSIDE_OUT);

    make_field(4, 100, 50, 1);
    CHECK_EQ(build(), CAROM_OK);
    for (uint32_t f = 0; f < raw.face_count; f++) {
        uint16_t v = faces[f][0];

        faces[f][0] = faces[f][1];
        faces[f][1] = v;
    }
    CHECK_REFUSED(CAROM_ERR_MESH_INSIDE_OUT);

    /* no volume: two sides of a sheet */
    begin(CAROM_SOLID);
    add_vertex(0, 0, 0);
    add_vertex(100, 0, 3);
    add_vertex(0, 100, 5);
    add_face(0, 1, 2);
    add_face(0, 2, 1);
    CHECK_REFUSED(CAROM_ERR_MESH_EMPTY);
}

static void test_bad_surface(void)
{
    uint32_t n;

    /* a vertical face, a face that hangs over */
    make_field(4, 100, 50, 1);
    vertices[12][0] = vertices[13][0];
    CHECK_REFUSED(CAROM_ERR_MESH_SURFACE);
    make_field(4, 100, 50, 1);
    vertices[12][0] = (int16_t)(vertices[13][0] + 1);
    CHECK_REFUSED(CAROM_ERR_MESH_SURFACE);

    /* a second sheet: over all, over a part of one face, beside */
    for (int x = 0; x <= 400; x += 100) {
        make_field(4, 100, 50, 1);
        n = raw.vertex_count;
        add_vertex(x == 100 ? 230 : x, 320, 500);
        add_vertex(x == 100 ? 235 : x + 100, 320, 500);
        add_vertex(x == 100 ? 230 : x, 325, 500);
        add_face(n, n + 1, n + 2);
        if (x < 400) {
            CHECK_REFUSED(CAROM_ERR_MESH_SURFACE);
        } else {
            CHECK_EQ(build(), CAROM_OK);
        }
    }

    /*
     * Nine points and twelve faces, every pair of points in exactly one: 36 edges, more than a
     * plane graph of nine points can have. On a parabola any three points are in order.
     */
    begin(CAROM_SURFACE);
    for (int i = 0; i < 9; i++) {
        add_vertex(i * 10, i * i, i);
    }
    for (uint32_t a = 0; a < 9; a++) {
        for (uint32_t b = a + 1; b < 9; b++) {
            for (uint32_t c = b + 1; c < 9; c++) {
                if ((a / 3 + b / 3 + c / 3) % 3 == 0 && (a + b + c) % 3 == 0) {
                    add_face(a, b, c);
                }
            }
        }
    }
    CHECK_EQ(raw.face_count, 12);
    CHECK_REFUSED(CAROM_ERR_MESH_SURFACE);
}

/* Faces side by side are not over each other, though only a side of one of them keeps them apart.
 */
static void test_good_surface(void)
{
    for (int higher = 0; higher < 2; higher++) {
        begin(CAROM_SURFACE);
        add_vertex(-100, 0, 7 * higher);
        add_vertex(0, -100, 0);
        add_vertex(0, 100, 0);
        add_vertex(10, 0, 5);
        add_vertex(100, -200, 0);
        add_vertex(100, 200, 0);
        add_face(0, 1, 2);
        add_face(3, 4, 5);
        CHECK_EQ(build(), CAROM_OK);
        /* corner to corner, side to side */
        vertices[3][0] = 0;
        CHECK_EQ(build(), CAROM_OK);
        vertices[3][0] = -1;
        CHECK_REFUSED(CAROM_ERR_MESH_SURFACE);
    }
}

/* Where several errors hold, the first named in carom.h is returned. */
static void test_error_order(void)
{
    make_box(100, 100, 100);
    raw.face_count = 11;
    memcpy(faces[4], (uint16_t[]){faces[4][1], faces[4][0], faces[4][2]}, sizeof faces[4]);
    CHECK_REFUSED(CAROM_ERR_MESH_OPEN);
    vertices[2][0] = 50;
    vertices[2][1] = 0;
    CHECK_REFUSED(CAROM_ERR_MESH_DEGENERATE);
    faces[10][0] = 8;
    CHECK_REFUSED(CAROM_ERR_MESH_INDEX);
    raw.vertex_count = 65536;
    CHECK_REFUSED(CAROM_ERR_MESH_SIZE);

    /* a surface with a wrong edge that looks down */
    make_field(2, 100, 10, 1);
    for (uint32_t f = 0; f < raw.face_count; f++) {
        memcpy(faces[f], (uint16_t[]){faces[f][1], faces[f][0], faces[f][2]}, sizeof faces[f]);
    }
    add_face(faces[0][0], faces[0][1], add_vertex(200, -50, 60));
    CHECK_REFUSED(CAROM_ERR_MESH_EDGE);
}

/* A side of 256 units is the longest, 32768 quanta at 7 bits. */
static void test_range(void)
{
    make_box(100, 100, 100);
    raw.quantum_bits = 7;
    for (uint32_t v = 0; v < 8; v++) {
        for (int k = 0; k < 3; k++) {
            vertices[v][k] = vertices[v][k] ? 16384 : -16384;
        }
    }
    CHECK_EQ(build(), CAROM_OK);
    /* half the diagonal of 256 units: sqrt(3) 128 */
    CHECK_NEAR(mesh.radius_q22, 929887697, 8);
    CHECK_EQ(mesh.edges[0].length_q22, 1 << 30);
    for (int k = 0; k < 3; k++) {
        for (uint32_t v = 0; v < 8; v++) {
            vertices[v][k] += vertices[v][k] > 0;
        }
        CHECK_REFUSED(CAROM_ERR_RANGE);
        for (uint32_t v = 0; v < 8; v++) {
            vertices[v][k] -= vertices[v][k] > 0;
        }
    }
}

/* ----------------------------------------------------------------------- edges */

/* What must hold of the edges and rings of any mesh. */
static void check_edges(void)
{
    uint32_t sides = 0;

    for (uint32_t f = 0; f < raw.face_count; f++) {
        for (int k = 0; k < 3; k++) {
            uint32_t number = mesh.faces[f].edge[k];
            const struct carom_edge *e = &mesh.edges[number];
            int side = e->face[0] == f ? 0 : 1;

            CHECK(number < mesh.edge_count && e->face[side] == f);
            CHECK(e->vertex[side] == raw.faces[f][k]);
            CHECK(e->vertex[1 - side] == raw.faces[f][(k + 1) % 3]);
        }
    }
    for (uint32_t i = 0; i < mesh.edge_count; i++) {
        const struct carom_edge *e = &mesh.edges[i];
        int64_t d[3], length = e->length_q22, length2_q44;

        sides += e->face[1] == CAROM_NO_FACE ? 1 : 2;
        between(d, e->vertex[0], e->vertex[1]);
        /* a quantum is 4096 units of q22; rounded up */
        length2_q44 = dot64(d, d) << 24;
        CHECK(length * length >= length2_q44 && (length - 1) * (length - 1) < length2_q44);
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(carom_round(e->direction.c[k] * length, 30), d[k] * 4096, 2);
        }
    }
    CHECK_EQ(sides, 3 * raw.face_count);
    CHECK(mesh.ring_start[0] == 0 && mesh.ring_start[raw.vertex_count] == 2 * mesh.edge_count);
    for (uint32_t v = 0; v < raw.vertex_count; v++) {
        for (uint32_t i = mesh.ring_start[v]; i < mesh.ring_start[v + 1]; i++) {
            CHECK(mesh.edges[mesh.ring[i] / 2].vertex[mesh.ring[i] % 2] == v);
            CHECK(i == mesh.ring_start[v] || mesh.ring[i - 1] < mesh.ring[i]);
        }
    }
}

/* Ownership against exact signs: is face 1's opposite corner below face 0's plane? */
static void check_owned(void)
{
    static bool sharp[V_MAX];
    static uint16_t owner[V_MAX];
    static uint8_t owners[3 * F_MAX];

    memset(sharp, 0, sizeof sharp);
    memset(owners, 0, sizeof owners);
    for (uint32_t f = raw.face_count; f-- > 0;) {
        for (int k = 0; k < 3; k++) {
            uint32_t edge = mesh.faces[f].edge[k];

            owner[raw.faces[f][k]] = (uint16_t)f;
            if (mesh.faces[f].own & 8 << k) {
                owners[edge]++;
                CHECK(mesh.edges[edge].face[0] == f);
            }
        }
    }
    for (uint32_t i = 0; i < mesh.edge_count; i++) {
        const struct carom_edge *e = &mesh.edges[i];
        bool convex = e->face[1] == CAROM_NO_FACE;

        if (!convex) {
            const uint16_t *corner = raw.faces[e->face[1]];
            int64_t n[3], d[3], below;
            double area;
            int k = 0;

            while (corner[k] == e->vertex[0] || corner[k] == e->vertex[1]) {
                k++;
            }
            exact_normal(n, e->face[0]);
            between(d, e->vertex[0], corner[k]);
            below = dot64(n, d);
            area = (double)dot64(n, n);
            convex = below < 0;
            /* the test meshes have no edge that is nearly flat, so that the sign decides */
            CHECK(below == 0 || (double)below * (double)below > 1e-8 * area * (double)dot64(d, d));
        }
        CHECK_EQ(owners[i], convex);
        sharp[e->vertex[0]] |= convex;
        sharp[e->vertex[1]] |= convex;
    }
    for (uint32_t f = 0; f < raw.face_count; f++) {
        CHECK_EQ(mesh.faces[f].own >> 6, 0);
        for (int k = 0; k < 3; k++) {
            uint16_t v = raw.faces[f][k];

            CHECK_EQ(mesh.faces[f].own >> k & 1, sharp[v] && owner[v] == f);
        }
    }
}

static int count_owned(int first, int last)
{
    int count = 0;

    for (uint32_t f = 0; f < raw.face_count; f++) {
        for (int bit = first; bit <= last; bit++) {
            count += mesh.faces[f].own >> bit & 1;
        }
    }
    return count;
}

static void test_box(void)
{
    make_box(1000, 2000, 3000);
    CHECK_EQ(build(), CAROM_OK);
    check_edges();
    check_owned();
    CHECK_EQ(mesh.edge_count, 18);
    CHECK_EQ(count_owned(3, 5), 12); /* not the six diagonals */
    CHECK_EQ(count_owned(0, 2), 8);
    for (uint32_t f = 0; f < 12; f++) {
        const int32_t *n = mesh.faces[f].normal.c;

        CHECK_EQ(carom_abs(n[0]) + carom_abs(n[1]) + carom_abs(n[2]), CAROM_ONE_Q30);
    }
    for (int k = 0; k < 3; k++) {
        CHECK_EQ(mesh.box[0][k], 0);
        CHECK_EQ(mesh.box[1][k], 1000 * (k + 1));
        CHECK_EQ(mesh.mass.centre.c[k], 500 * (k + 1) << 12);
        CHECK_EQ(mesh_vertex(&mesh, 6).c[k], 500 * (k + 1) << 12);
    }
    /* half the diagonal: sqrt(14) 500 quanta */
    CHECK_NEAR(mesh.radius_q22, 7662915, 2);
}

/* An L: one concave edge, and flat ones where the sides are cut. */
static void test_concave(void)
{
    const int corner[6][2] = {{0, 0}, {200, 0}, {200, 50}, {100, 50}, {100, 100}, {0, 100}};

    make_prism(corner, 6, 70);
    CHECK_EQ(build(), CAROM_OK);
    check_edges();
    check_owned();
    /* 18 edges of the prism, one of them concave */
    CHECK_EQ(count_owned(3, 5), 17);
    CHECK_EQ(count_owned(0, 2), 12);
    CHECK_EQ(mesh.edge_count, 18 + 6 + 6);
}

/*
 * Thin blades: the faces at an edge are nearly back to back, and still the edge is sharp. In the
 * second one two faces turn by half a turn less 5e-10, whose sine says that the edge is flat.
 */
static void test_blade(void)
{
    static const int corner[2][4][3] = {
        {{0, -30000, 0}, {0, 30000, 0}, {30000, 0, 1}, {30000, 0, 0}},
        {{0, 0, 0}, {1, 0, 0}, {0, 29999, 29998}, {0, 30000, 29999}},
    };

    for (int n = 0; n < 2; n++) {
        begin(CAROM_SOLID);
        for (int v = 0; v < 4; v++) {
            add_vertex(corner[n][v][0], corner[n][v][1], corner[n][v][2]);
        }
        add_face(0, 2, 1);
        add_face(1, 3, 0);
        add_face(1, 2, 3);
        add_face(0, 3, 2);
        CHECK_EQ(build(), CAROM_OK);
        CHECK_EQ(count_owned(3, 5), 6);
        CHECK_EQ(count_owned(0, 2), 4);
    }
}

/* The sphere around the centre of mass: no vertex outside, one on it. */
static void check_radius(void)
{
    double most2 = 0, radius = mesh.radius_q22;

    for (uint32_t v = 0; v < raw.vertex_count; v++) {
        carom_v3_q22 p = mesh_vertex(&mesh, v);
        double d2 = (double)p.c[0] * p.c[0] + (double)p.c[1] * p.c[1] + (double)p.c[2] * p.c[2];

        most2 = d2 > most2 ? d2 : most2;
    }
    CHECK(radius * radius >= most2 && (radius - 2) * (radius - 2) < most2);
}

static void test_bumpy(void)
{
    for (uint64_t seed = 1; seed <= 3; seed++) {
        make_bumpy(6, 100, 300, seed);
        CHECK_EQ(build(), CAROM_OK);
        CHECK_EQ(raw.vertex_count - mesh.edge_count + raw.face_count, 2); /* Euler */
        check_edges();
        check_owned();
        check_radius();
        make_field(8, 100, 300, seed);
        CHECK_EQ(build(), CAROM_OK);
        check_edges();
        check_owned();
        check_radius();
        CHECK(mesh.mass.volume_q32 == 0 && mesh.mass.centre.c[0] == 0);
    }
}

/* ---------------------------------------------------------------------- leaves */

static void check_leaves(void)
{
    static uint8_t seen[F_MAX];
    uint32_t face = 0, vertex = 0;

    memset(seen, 0, sizeof seen);
    for (uint32_t l = 0; l < mesh.leaf_count; l++) {
        const struct carom_leaf *leaf = &mesh.leaves[l];
        const uint16_t *leaf_vertices = &mesh.leaf_vertices[leaf->first_vertex];
        double radius2 = (double)leaf->radius_q22 * leaf->radius_q22;
        double most2 = 0;

        CHECK(leaf->first_face == face && leaf->first_vertex == vertex);
        CHECK(leaf->face_count >= 1 && leaf->face_count <= CAROM_LEAF_FACES);
        CHECK(leaf->vertex_count >= 3 && leaf->vertex_count <= CAROM_LEAF_VERTICES);
        for (int i = 0; i < leaf->face_count; i++, face++) {
            seen[mesh.leaf_faces[face]]++;
            for (int k = 0; k < 3; k++) {
                CHECK(leaf_vertices[mesh.leaf_corners[face][k]] ==
                      raw.faces[mesh.leaf_faces[face]][k]);
                CHECK(mesh.leaf_corners[face][k] < leaf->vertex_count);
            }
        }
        for (int i = 0; i < leaf->vertex_count; i++, vertex++) {
            carom_v3_q22 p = mesh_vertex(&mesh, leaf_vertices[i]);
            double d2 = 0;

            for (int k = 0; k < 3; k++) {
                double d = (double)p.c[k] - leaf->centre.c[k];

                d2 += d * d;
            }
            most2 = d2 > most2 ? d2 : most2;
            for (int j = 0; j < i; j++) {
                CHECK(leaf_vertices[j] != leaf_vertices[i]);
            }
        }
        CHECK(most2 <= radius2 && radius2 <= most2 * 1.001 + 1e4);
    }
    CHECK_EQ(face, raw.face_count);
    for (uint32_t f = 0; f < raw.face_count; f++) {
        CHECK_EQ(seen[f], 1);
    }
}

static void test_leaves(void)
{
    uint32_t n;

    make_box(10, 10, 10);
    CHECK_EQ(build(), CAROM_OK);
    check_leaves();
    CHECK_EQ(mesh.leaf_count, 1);

    make_bumpy(8, 100, 300, 5);
    CHECK_EQ(build(), CAROM_OK);
    check_leaves();

    /* Full leaves of a flat field: 8 squares, at best 2 by 4 with a radius of sqrt(5) squares. */
    make_field(16, 128, 0, 1);
    CHECK_EQ(build(), CAROM_OK);
    check_leaves();
    CHECK_EQ(mesh.leaf_count, 16 * 16 * 2 / 16);
    for (uint32_t l = 0; l < mesh.leaf_count; l++) {
        CHECK(mesh.leaves[l].radius_q22 < 4 * 128 << 12);
    }

    /* faces that share no vertices: at most 10 a leaf */
    begin(CAROM_SURFACE);
    for (n = 0; n < 250; n++) {
        uint32_t v = add_vertex((int)(n % 25) * 100, (int)(n / 25) * 100, (int)n);

        add_vertex((int)(n % 25) * 100 + 60, (int)(n / 25) * 100 + 10, 0);
        add_vertex((int)(n % 25) * 100 + 20, (int)(n / 25) * 100 + 70, 9);
        add_face(v, v + 1, v + 2);
    }
    CHECK_EQ(build(), CAROM_OK);
    check_leaves();
    check_edges();
    CHECK_EQ(mesh.edge_count, 750);
}

/* --------------------------------------------------------------------- z-lists */

/* A face's point, by weights that sum to 8, must be in an entry of the cell that it is over. */
static void check_point(uint32_t f, int a, int b, const struct scan_grid *g)
{
    int32_t p[3], cell[2];

    for (int k = 0; k < 3; k++) {
        p[k] = a * raw.vertices[raw.faces[f][0]][k] + b * raw.vertices[raw.faces[f][1]][k] +
               (8 - a - b) * raw.vertices[raw.faces[f][2]][k];
    }
    cell[0] = (p[0] - 8 * g->x0) >> (g->shift + 3);
    cell[1] = (p[1] - 8 * g->y0) >> (g->shift + 3);
    /* a point on the far side of the last cell belongs to it */
    cell[0] -= cell[0] == g->nx && p[0] == 8 * (g->x0 + (g->nx << g->shift));
    cell[1] -= cell[1] == g->ny && p[1] == 8 * (g->y0 + (g->ny << g->shift));
    CHECK(cell[0] >= 0 && cell[0] < g->nx && cell[1] >= 0 && cell[1] < g->ny);
    if (cell[0] >= 0 && cell[0] < g->nx && cell[1] >= 0 && cell[1] < g->ny) {
        uint32_t c = (uint32_t)(cell[1] * g->nx + cell[0]);
        bool found = false;

        for (uint32_t i = mesh.cell_start[c]; i < mesh.cell_start[c + 1]; i++) {
            const struct carom_zref *z = &mesh.zrefs[i];

            found |= z->face == f && 8 * z->z0 <= p[2] && p[2] <= 8 * z->z1;
        }
        CHECK(found);
    }
}

static void check_zlists(void)
{
    struct scan_grid g = mesh_grid(&mesh);
    uint32_t cells = (uint32_t)g.nx * g.ny;

    CHECK(cells <= ZLIST_CELLS_MAX && mesh.zref_count <= 8 * raw.face_count);
    CHECK(g.x0 <= mesh.box[0][0] && g.x0 + (g.nx << g.shift) >= mesh.box[1][0]);
    CHECK(g.y0 <= mesh.box[0][1] && g.y0 + (g.ny << g.shift) >= mesh.box[1][1]);
    CHECK(mesh.cell_start[0] == 0 && mesh.cell_start[cells] == mesh.zref_count);
    for (uint32_t c = 0; c < cells; c++) {
        CHECK(mesh.cell_start[c] <= mesh.cell_start[c + 1]);
        for (uint32_t i = mesh.cell_start[c] + 1; i < mesh.cell_start[c + 1]; i++) {
            const struct carom_zref *a = &mesh.zrefs[i - 1], *b = &mesh.zrefs[i];

            CHECK(a->z1 > b->z1 || (a->z1 == b->z1 && a->face < b->face));
        }
    }
    for (uint32_t f = 0; f < raw.face_count; f++) {
        for (int n = 0; n < 81; n += POINT_STEP) {
            if (n / 9 + n % 9 <= 8) {
                check_point(f, n / 9, n % 9, &g);
            }
        }
    }
}

static void test_zlists(void)
{
    make_box(10, 300, 7);
    CHECK_EQ(build(), CAROM_OK);
    check_zlists();
    make_bumpy(10, 100, 300, 7);
    CHECK_EQ(build(), CAROM_OK);
    check_zlists();
    make_field(12, 77, 100, 7);
    CHECK_EQ(build(), CAROM_OK);
    check_zlists();
    /* a regular field on a power of two, as wide as 32 cells */
    make_field(32, 64, 100, 7);
    CHECK_EQ(build(), CAROM_OK);
    CHECK(mesh.grid_nx == 32 && mesh.grid_ny == 32);
    check_zlists();

    /* slivers across the whole surface: the cells grow until the lists fit */
    begin(CAROM_SURFACE);
    for (int i = 0; i < 80; i++) {
        uint32_t v = add_vertex(0, 10 * i, i % 7);

        add_vertex(8000, 10 * i + 4000, 5);
        add_vertex(8000, 10 * i + 4009, i % 11);
        add_face(v, v + 1, v + 2);
    }
    CHECK_EQ(build(), CAROM_OK);
    CHECK(mesh.grid_nx > 1);
    check_zlists();
}

/* ---------------------------------------------------------------------- memory */

/* Nothing past the block is touched, and what the block held before does not show. */
static void test_memory(void)
{
    static const uint8_t guard[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    uint64_t hash[2] = {0, 0};

    for (int pass = 0; pass < 2; pass++) {
        size_t bytes;

        make_bumpy(5, 100, 300, 3);
        bytes = CAROM_MESH_BYTES(raw.vertex_count, raw.face_count);
        memset(block, pass ? 0xa5 : 0, sizeof block);
        memcpy(block + bytes, guard, sizeof guard);
        CHECK_EQ(build(), CAROM_OK);
        CHECK(memcmp(block + bytes, guard, sizeof guard) == 0);
        CHECK((const uint8_t *)(mesh.zrefs + mesh.zref_count) <= block + bytes);
        for (const uint8_t *p = block; p < (const uint8_t *)(mesh.zrefs + mesh.zref_count); p++) {
            hash[pass] = hash[pass] * 31 + *p;
        }
    }
    CHECK(hash[0] == hash[1]);
}

/* ------------------------------------------------------------------------ blob */

#define BLOB_MAX 1024
static uint8_t blob[BLOB_MAX];

static size_t put(size_t at, uint64_t v, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        blob[at++] = (uint8_t)(v >> 8 * i);
    }
    return at;
}

/* The 64-bit FNV-1a prime is 2^40 + 0x1b3. */
static size_t seal(size_t bytes)
{
    uint64_t h = 14695981039346656037u;

    for (size_t i = 0; i < bytes; i++) {
        h ^= blob[i];
        h = (h << 40) + h * 0x1b3;
    }
    return put(bytes, h, 8);
}

static size_t write_blob(void)
{
    size_t at = put(0, 0x314d5243, 4); /* CRM1 */

    at = put(at, 1, 1);
    at = put(at, raw.kind, 1);
    at = put(at, raw.quantum_bits, 1);
    at = put(at, 0, 1);
    at = put(at, raw.vertex_count, 4);
    at = put(at, raw.face_count, 4);
    for (uint32_t i = 0; i < 3 * raw.vertex_count; i++) {
        at = put(at, (uint16_t)raw.vertices[i / 3][i % 3], 2);
    }
    for (uint32_t i = 0; i < 3 * raw.face_count; i++) {
        at = put(at, raw.faces[i / 3][i % 3], 2);
    }
    return seal(at);
}

static void test_read(void)
{
    static _Alignas(8) uint8_t mem[CAROM_BLOB_BYTES(8, 12)];
    struct carom_mesh_raw read, before;
    size_t bytes;

    make_box(100, 200, 300);
    vertices[0][0] = -32768;
    vertices[7][2] = 32767;
    vertices[3][1] = -1;
    bytes = write_blob();
    CHECK_EQ(carom_mesh_read(&read, blob, bytes, mem, sizeof mem), CAROM_OK);
    CHECK(read.vertex_count == 8 && read.face_count == 12 && read.quantum_bits == 10);
    CHECK(read.kind == CAROM_SOLID);
    CHECK(memcmp(read.vertices, vertices, 8 * sizeof vertices[0]) == 0);
    CHECK(memcmp(read.faces, faces, 12 * sizeof faces[0]) == 0);

    memset(&read, 0x5a, sizeof read);
    before = read;
    CHECK_EQ(carom_mesh_read(NULL, blob, bytes, mem, sizeof mem), CAROM_ERR_NULL);
    CHECK_EQ(carom_mesh_read(&read, NULL, bytes, mem, sizeof mem), CAROM_ERR_NULL);
    CHECK_EQ(carom_mesh_read(&read, blob, bytes, NULL, sizeof mem), CAROM_ERR_NULL);
    CHECK_EQ(carom_mesh_read(&read, blob, bytes, mem, sizeof mem - 1), CAROM_ERR_MEMORY);
    CHECK_EQ(carom_mesh_read(&read, blob, bytes, mem + 2, sizeof mem - 2), CAROM_ERR_MEMORY);
    CHECK(memcmp(&read, &before, sizeof read) == 0);
}

/* Every truncation, every altered byte, and headers that lie under a right seal. */
static void test_read_altered(void)
{
    static _Alignas(8) uint8_t mem[CAROM_BLOB_BYTES(8, 12)];
    static const struct {
        size_t at;
        int bytes;
        uint32_t value;
    } lies[] = {{0, 1, 'X'}, {4, 1, 2},      {5, 1, 2}, {6, 1, 6},
                {6, 1, 21},  {7, 1, 1},      {8, 4, 2}, {8, 4, 65536},
                {12, 4, 0},  {12, 4, 65536}, {8, 4, 9}, {12, 4, 1u << 31}};
    struct carom_mesh_raw read;
    size_t bytes;

    make_box(100, 200, 300);
    bytes = write_blob();
    for (size_t n = 0; n < bytes; n++) {
        CHECK_EQ(carom_mesh_read(&read, blob, n, mem, sizeof mem), CAROM_ERR_FORMAT);
        blob[n] ^= (uint8_t)(1 << n % 8);
        CHECK_EQ(carom_mesh_read(&read, blob, bytes, mem, sizeof mem), CAROM_ERR_FORMAT);
        blob[n] ^= (uint8_t)(1 << n % 8);
    }
    CHECK_EQ(carom_mesh_read(&read, blob, bytes + 1, mem, sizeof mem), CAROM_ERR_FORMAT);
    for (unsigned i = 0; i < sizeof lies / sizeof lies[0]; i++) {
        write_blob();
        put(lies[i].at, lies[i].value, lies[i].bytes);
        seal(bytes - 8);
        CHECK_EQ(carom_mesh_read(&read, blob, bytes, mem, sizeof mem), CAROM_ERR_FORMAT);
    }
    write_blob();
    CHECK_EQ(carom_mesh_read(&read, blob, bytes, mem, sizeof mem), CAROM_OK);
    raw.vertex_count = 2;
    CHECK_EQ(carom_mesh_read(&read, blob, write_blob(), mem, sizeof mem), CAROM_ERR_FORMAT);
    raw.vertex_count = 8;
    raw.face_count = 0;
    CHECK_EQ(carom_mesh_read(&read, blob, write_blob(), mem, sizeof mem), CAROM_ERR_FORMAT);
}

const struct test tests_mesh[] = {
    {"mesh/arguments", test_arguments},
    {"mesh/bad_faces", test_bad_faces},
    {"mesh/bad_edges", test_bad_edges},
    {"mesh/bad_orientation", test_bad_orientation},
    {"mesh/bad_surface", test_bad_surface},
    {"mesh/good_surface", test_good_surface},
    {"mesh/error_order", test_error_order},
    {"mesh/range", test_range},
    {"mesh/box", test_box},
    {"mesh/concave", test_concave},
    {"mesh/blade", test_blade},
    {"mesh/bumpy", test_bumpy},
    {"mesh/leaves", test_leaves},
    {"mesh/zlists", test_zlists},
    {"mesh/memory", test_memory},
    {"mesh/read", test_read},
    {"mesh/read_altered", test_read_altered},
    {0},
};
