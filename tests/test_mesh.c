/* SPDX-License-Identifier: MIT */
/* Building meshes: which are refused, the order of errors, and the index of good meshes. */
#include <string.h>

#include "lib/mesh_shapes.h"

static int64_t dot64(const int64_t a[3], const int64_t b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The vector from vertex a to vertex b, in quanta. */
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

/* build() and the check must refuse with `error` and leave the mesh alone. */
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

    /* one face turned over: three sides are used twice in one direction */
    make_box(100, 100, 100);
    memcpy(face, faces[4], sizeof face);
    faces[4][0] = face[1];
    faces[4][1] = face[0];
    CHECK_REFUSED(CAROM_ERR_MESH_EDGE);

    /* two tetrahedra share an edge: four faces meet there */
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

    /* a second face that uses an edge of a surface in the same direction; a third face in either */
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

    /* a vertical face, then an overhanging face */
    make_field(4, 100, 50, 1);
    vertices[12][0] = vertices[13][0];
    CHECK_REFUSED(CAROM_ERR_MESH_SURFACE);
    make_field(4, 100, 50, 1);
    vertices[12][0] = (int16_t)(vertices[13][0] + 1);
    CHECK_REFUSED(CAROM_ERR_MESH_SURFACE);

    /* a second sheet: over everything, over a part of one face, beside */
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
     * Nine points and twelve faces; every pair of points is in exactly one face. That makes 36
     * edges, more than a planar graph with nine points can have. On a parabola any three points are
     * in order.
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

/*
 * Faces side by side are not above each other, even when only a side of one of them separates the
 * two.
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

/* A mesh with several errors is refused with the one that carom.h names first. */
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

    /* a surface with a wrong edge and a face that looks down */
    make_field(2, 100, 10, 1);
    for (uint32_t f = 0; f < raw.face_count; f++) {
        memcpy(faces[f], (uint16_t[]){faces[f][1], faces[f][0], faces[f][2]}, sizeof faces[f]);
    }
    add_face(faces[0][0], faces[0][1], add_vertex(200, -50, 60));
    CHECK_REFUSED(CAROM_ERR_MESH_EDGE);
}

/*
 * A box with these sides in quanta of 2^-7 units, centred at the origin; an odd side leans upwards.
 */
static void make_large(int32_t x, int32_t y, int32_t z)
{
    int32_t side[3] = {x, y, z};

    make_box(1, 1, 1);
    raw.quantum_bits = 7;
    for (uint32_t v = 0; v < 8; v++) {
        for (int k = 0; k < 3; k++) {
            vertices[v][k] = (int16_t)(vertices[v][k] ? side[k] - side[k] / 2 : -(side[k] / 2));
        }
    }
}

/*
 * No side may be above 256 units and no diagonal above 384: 256, 256 and 128 units have that
 * diagonal.
 */
static void test_range(void)
{
    make_large(32768, 32768, 16383);
    CHECK_EQ(build(), CAROM_OK);
    /* half the diagonal: sqrt(2 256^2 + (16383 / 128)^2) / 2 units */
    CHECK_NEAR(mesh.radius_q22, 805300906, 8);
    make_large(32768, 32768, 16385);
    CHECK_REFUSED(CAROM_ERR_RANGE);
    make_large(32769, 100, 100);
    CHECK_REFUSED(CAROM_ERR_RANGE);
    make_large(100, 32769, 100);
    CHECK_REFUSED(CAROM_ERR_RANGE);
    make_large(100, 100, 32769);
    CHECK_REFUSED(CAROM_ERR_RANGE);
    make_large(100, 100, 32768);
    CHECK_EQ(build(), CAROM_OK);
    CHECK_NEAR(mesh.edges[0].length_q22, (int64_t)100 << 15, 1);
}

/* ----------------------------------------------------------------------- edges */

/* The invariants of edges and rings, which hold for any mesh. */
static void check_edges(void)
{
    uint32_t sides = 0;

    for (uint32_t f = 0; f < raw.face_count; f++) {
        for (int k = 0; k < 3; k++) {
            uint32_t number = mesh.faces[f].edge[k];
            const struct carom_edge *e = &mesh.edges[number];
            int side = e->face[0] == f ? 0 : 1;

            CHECK_LESS(number, mesh.edge_count);
            CHECK_EQ(e->face[side], f);
            CHECK_EQ(e->vertex[side], raw.faces[f][k]);
            CHECK_EQ(e->vertex[1 - side], raw.faces[f][(k + 1) % 3]);
        }
    }
    for (uint32_t i = 0; i < mesh.edge_count; i++) {
        const struct carom_edge *e = &mesh.edges[i];
        int64_t d[3], length = e->length_q22, length2_q44;

        sides += e->face[1] == CAROM_NO_FACE ? 1 : 2;
        between(d, e->vertex[0], e->vertex[1]);
        /* a quantum is 4096 units of q22; rounded up */
        length2_q44 = dot64(d, d) << 24;
        CHECK_AT_LEAST(length * length, length2_q44);
        CHECK_LESS((length - 1) * (length - 1), length2_q44);
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(carom_round(e->direction.c[k] * length, 30), d[k] * 4096, 2);
        }
    }
    CHECK_EQ(sides, 3 * raw.face_count);
    CHECK_EQ(mesh.ring_start[0], 0);
    CHECK_EQ(mesh.ring_start[raw.vertex_count], 2 * mesh.edge_count);
    for (uint32_t v = 0; v < raw.vertex_count; v++) {
        for (uint32_t i = mesh.ring_start[v]; i < mesh.ring_start[v + 1]; i++) {
            CHECK_EQ(mesh.edges[mesh.ring[i] / 2].vertex[mesh.ring[i] % 2], v);
            CHECK(i == mesh.ring_start[v] || mesh.ring[i - 1] < mesh.ring[i]);
        }
    }
}

/*
 * How the surface bends at an edge, by exact signs: whether face 1's opposite corner is below face
 * 0's plane (1), above it (-1) or in it. A border counts as 1.
 */
static int exact_bend(const struct carom_edge *e)
{
    int64_t n[3], d[3], below;
    const uint16_t *corner;
    int k = 0;

    if (e->face[1] == CAROM_NO_FACE) {
        return 1;
    }
    corner = raw.faces[e->face[1]];
    while (corner[k] == e->vertex[0] || corner[k] == e->vertex[1]) {
        k++;
    }
    exact_normal(n, e->face[0]);
    between(d, e->vertex[0], corner[k]);
    below = dot64(n, d);
    /* the test meshes have no edge that is nearly flat, so the sign decides */
    CHECK(below == 0 ||
          (double)below * (double)below > 1e-8 * (double)dot64(n, n) * (double)dot64(d, d));
    return below < 0 ? 1 : below > 0 ? -1 : 0;
}

/*
 * The edges that bend outwards and the vertices at them are in `own`; the others that bend, and the
 * vertices at these alone, in `behind`. Each is there once.
 */
static void check_owned(void)
{
    static bool sharp[V_MAX], bent[V_MAX];
    static uint16_t owner[V_MAX];

    memset(sharp, 0, sizeof sharp);
    memset(bent, 0, sizeof bent);
    for (uint32_t f = raw.face_count; f-- > 0;) {
        for (int k = 0; k < 3; k++) {
            owner[raw.faces[f][k]] = (uint16_t)f;
        }
    }
    for (uint32_t i = 0; i < mesh.edge_count; i++) {
        const struct carom_edge *e = &mesh.edges[i];
        int bend = exact_bend(e);

        for (int side = 0; side < 2 && e->face[side] != CAROM_NO_FACE; side++) {
            const struct carom_face *face = &mesh.faces[e->face[side]];
            int k = face->edge[0] == i ? 3 : face->edge[1] == i ? 4 : 5;

            CHECK_EQ(face->own >> k & 1, side == 0 && bend > 0);
            CHECK_EQ(face->behind >> k & 1, side == 0 && bend < 0);
        }
        for (int k = 0; k < 2; k++) {
            sharp[e->vertex[k]] |= bend > 0;
            bent[e->vertex[k]] |= bend < 0;
        }
    }
    for (uint32_t f = 0; f < raw.face_count; f++) {
        CHECK_EQ((mesh.faces[f].own | mesh.faces[f].behind) >> 6, 0);
        for (int k = 0; k < 3; k++) {
            uint16_t v = raw.faces[f][k];

            CHECK_EQ(mesh.faces[f].own >> k & 1, sharp[v] && owner[v] == f);
            CHECK_EQ(mesh.faces[f].behind >> k & 1, bent[v] && !sharp[v] && owner[v] == f);
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
    CHECK_EQ(count_owned(3, 5), 12); /* without the six diagonals */
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

/* An L has one concave edge, and flat edges where its sides are cut. */
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
 * Thin blades: the faces at an edge are nearly back to back, and the edge is still sharp. In the
 * second blade two faces turn by half a turn less 5e-10, an angle whose sine looks like a flat
 * edge.
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

/* The sphere around the centre of mass has no vertex outside and one on it. */
static void check_radius(void)
{
    double most2 = 0, radius = mesh.radius_q22;

    for (uint32_t v = 0; v < raw.vertex_count; v++) {
        carom_v3_q22 p = mesh_vertex(&mesh, v);
        double d2 = (double)p.c[0] * p.c[0] + (double)p.c[1] * p.c[1] + (double)p.c[2] * p.c[2];

        most2 = d2 > most2 ? d2 : most2;
    }
    CHECK_AT_LEAST(radius * radius, most2);
    CHECK_LESS((radius - 2) * (radius - 2), most2);
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
        CHECK_EQ(mesh.mass.volume_q32, 0);
        CHECK_EQ(mesh.mass.centre.c[0], 0);
    }
}

/*
 * Points over and under a steep field, and beside it, against exact signs: seen along z the point is
 * left of all sides of one face, and below its plane.
 */
static void test_under(void)
{
    struct test_random r = {7};
    int found = 0;

    make_field(8, 100, 300, 3);
    CHECK_EQ(build(), CAROM_OK);
    for (int i = 0; i < 4000; i++) {
        int64_t one = (int64_t)1 << (22 - raw.quantum_bits), low[3], high[3], sum = 0;
        carom_v3_q22 p;
        bool under = false;

        for (int k = 0; k < 3; k++) {
            low[k] = (mesh.box[0][k] - 20) * one;
            high[k] = (mesh.box[1][k] + 20) * one;
            p.c[k] = (int32_t)test_random_range(&r, low[k], high[k]);
        }
        for (uint32_t f = 0; f < raw.face_count; f++) {
            bool over = true;
            int64_t n[3];

            for (int k = 0; k < 3; k++) {
                const int16_t *a = raw.vertices[raw.faces[f][k]];
                const int16_t *b = raw.vertices[raw.faces[f][(k + 1) % 3]];

                over = over && (b[0] - a[0]) * (p.c[1] - a[1] * one) >
                                   (b[1] - a[1]) * (p.c[0] - a[0] * one);
            }
            exact_normal(n, f);
            for (int k = 0; k < 3; k++) {
                sum = k == 0 ? 0 : sum;
                sum += n[k] * (p.c[k] - raw.vertices[raw.faces[f][0]][k] * one);
            }
            under |= over && sum < 0;
        }
        CHECK_EQ(mesh_under(&mesh, &p), under);
        found += under;
    }
    CHECK_MORE(found, 1000);
    CHECK_LESS(found, 3000);
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
    {"mesh/under", test_under},
    {0},
};
