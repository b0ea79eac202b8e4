/* SPDX-License-Identifier: MIT */
/*
 * Surfaces whose vertices move. An update gives the mesh that a new build would give, vertices that
 * are no surface are refused, and the drift of an affine motion is exact.
 */
#include <string.h>

#include "contact/contact.h"
#include "lib/shapes.h"

#define SIDE  6
#define COUNT ((SIDE + 1) * (SIDE + 1))
#define FACES (2 * SIDE * SIDE)
#define BYTES CAROM_SURFACE_BYTES(COUNT, FACES)

static _Alignas(8) uint8_t block[2][BYTES];
static struct carom_mesh mesh, other;
static struct shape flat, solid;
static int16_t moved[COUNT][3];

static const int16_t (*moved_to(void))[3]
{
    return (const int16_t(*)[3])moved;
}

/* Squares of 1024 quanta of 2^-10 units. */
static void begin(void)
{
    shape_plane(&flat, 10, SIDE, 1024);
    CHECK_EQ(flat.raw.vertex_count, COUNT);
    CHECK_EQ(flat.raw.face_count, FACES);
    memset(block[0], 0x7f, BYTES); /* whatever was there */
    CHECK_EQ(carom_surface_build(&mesh, &flat.raw, block[0], BYTES), CAROM_OK);
    CHECK_EQ(mesh_drift_most(&mesh), 0);
    memcpy(moved, flat.vertices, sizeof moved);
}

static bool inside_leaf(const struct carom_mesh *m, const struct carom_leaf *leaf, uint16_t vertex)
{
    carom_v3_q22 p = mesh_vertex(m, vertex);
    int64_t d[3], height = carom_dot(leaf->axis.c, p.c) >> 30;

    for (int k = 0; k < 3; k++) {
        d[k] = p.c[k] - leaf->centre.c[k];
    }
    return fix_length(d) <= leaf->radius_q22 + 4 && height >= leaf->low_q22 - 1 &&
           height <= leaf->high_q22 + 1;
}

/*
 * Leaves may be divided in another way, but each holds its faces and tests the vertices that its
 * faces own.
 */
static void check_leaves(void)
{
    for (uint32_t i = 0; i < mesh.leaf_count; i++) {
        const struct carom_leaf *leaf = &mesh.leaves[i];
        int64_t low = INT64_MAX, high = INT64_MIN;
        uint32_t owned = 0;

        for (int v = 0; v < leaf->vertex_count; v++) {
            uint16_t vertex = mesh.leaf_vertices[leaf->first_vertex + (uint32_t)v];
            int64_t height = carom_dot(leaf->axis.c, mesh_vertex(&mesh, vertex).c) >> 30;

            CHECK(inside_leaf(&mesh, leaf, vertex));
            low = height < low ? height : low;
            high = height > high ? height : high;
        }
        /* the slab is no thicker than the leaf */
        CHECK_NEAR(leaf->low_q22, low, 1);
        CHECK_NEAR(leaf->high_q22, high, 1);
        for (uint32_t f = leaf->first_face; f < leaf->first_face + leaf->face_count; f++) {
            for (int k = 0; k < 3; k++) {
                if (mesh.faces[mesh.leaf_faces[f]].own & 1 << k) {
                    owned |= 1u << mesh.leaf_corners[f][k];
                }
            }
        }
        CHECK_EQ(leaf->owned, owned);
    }
}

/* An update gives the mesh that a build of the same vertices gives. */
static void check_same_as_built(void)
{
    struct carom_mesh_raw raw = flat.raw;

    raw.vertices = mesh.raw.vertices;
    CHECK_EQ(carom_mesh_build(&other, &raw, block[1], BYTES), CAROM_OK);
    CHECK_EQ(memcmp(mesh.faces, other.faces, FACES * sizeof mesh.faces[0]), 0);
    CHECK_EQ(mesh.edge_count, other.edge_count);
    CHECK_EQ(memcmp(mesh.edges, other.edges, mesh.edge_count * sizeof mesh.edges[0]), 0);
    CHECK_EQ(memcmp(mesh.box, other.box, sizeof mesh.box), 0);
    CHECK_EQ(mesh.radius_q22, other.radius_q22);
    CHECK_EQ(mesh.grid_x0, other.grid_x0);
    CHECK_EQ(mesh.grid_y0, other.grid_y0);
    CHECK_EQ(mesh.grid_shift, other.grid_shift);
    CHECK_EQ(mesh.grid_nx, other.grid_nx);
    CHECK_EQ(mesh.grid_ny, other.grid_ny);
    check_leaves();
}

/* Move the vertices to `moved`. */
static int move(int64_t *rise_q22)
{
    int result = mesh_surface_try(mesh.surface, moved_to(), true, rise_q22);

    if (result == CAROM_OK) {
        mesh_surface_keep(mesh.surface);
    }
    return result;
}

/* Move up and down only, then also sideways, then with its own lists, then back. */
static void test_refresh(void)
{
    static const struct mesh_moving keeps_lists = {NULL, NULL, NULL, NULL, NULL, NULL};
    const struct mesh_moving *usual;
    struct test_random r = {7};
    int64_t rise_q22;

    begin();
    usual = mesh.surface->does;
    for (int round = 0; round < 12; round++) {
        const bool own_lists = round % 4 == 2;

        for (int v = 0; v < COUNT; v++) {
            for (int k = 0; k < 3; k++) {
                int range = k == 2 ? 700 : round % 3 == 1 ? 200 : 0;

                moved[v][k] = (int16_t)(flat.vertices[v][k] + test_random_range(&r, -range, range));
            }
        }
        if (round == 11) {
            memcpy(moved, flat.vertices, sizeof moved);
        }
        mesh.surface->does = own_lists ? &keeps_lists : usual;
        CHECK_EQ(move(&rise_q22), CAROM_OK);
        CHECK_MORE(rise_q22, 0);
        CHECK_EQ(memcmp(mesh.raw.vertices, moved, sizeof moved), 0);
        check_same_as_built();
        if (own_lists) {
            CHECK_EQ(mesh.zref_count, other.zref_count);
            CHECK_EQ(memcmp(mesh.zrefs, other.zrefs, mesh.zref_count * sizeof mesh.zrefs[0]), 0);
        }
    }
}

/*
 * The rise of a surface at a fixed place: a slope that moves sideways rises by slope times
 * distance.
 */
static void test_rise(void)
{
    int64_t rise_q22;

    begin();
    for (int v = 0; v < COUNT; v++) {
        moved[v][2] = (int16_t)(moved[v][0] / 2);
    }
    CHECK_EQ(move(&rise_q22), CAROM_OK);
    CHECK_EQ(rise_q22, (int64_t)(SIDE * 1024 / 4) << 12); /* the highest corner */
    for (int v = 0; v < COUNT; v++) {
        moved[v][2] = (int16_t)(moved[v][2] - 300);
    }
    CHECK_EQ(move(&rise_q22), CAROM_OK);
    CHECK_EQ(rise_q22, 0);
    for (int v = 0; v < COUNT; v++) {
        moved[v][0] = (int16_t)(moved[v][0] - 64);
    }
    CHECK_EQ(move(&rise_q22), CAROM_OK);
    CHECK_AT_LEAST(rise_q22, 32 << 12);
    CHECK_AT_MOST(rise_q22, 80 << 12); /* 64 / 2, and not much above 64 / n.z */

    /* one steep side: a slope of 3 rises by 3 * 64, and 1 / n.z is sqrt(10) */
    begin();
    for (int v = 0; v < COUNT; v++) {
        moved[v][2] = (int16_t)(moved[v][0] > 0 ? 3 * moved[v][0] : 0);
    }
    CHECK_EQ(move(&rise_q22), CAROM_OK);
    for (int v = 0; v < COUNT; v++) {
        moved[v][0] = (int16_t)(moved[v][0] - 64);
    }
    CHECK_EQ(move(&rise_q22), CAROM_OK);
    CHECK_AT_LEAST(rise_q22, 192 << 12);
    CHECK_AT_MOST(rise_q22, 205 << 12);
}

/* A refused update leaves the mesh as it was. */
static void check_refused(int error)
{
    static _Alignas(8) uint8_t before[BYTES];
    struct carom_mesh as_it_was = mesh;
    int64_t rise_q22;

    memcpy(before, block[0], BYTES);
    CHECK_EQ(move(&rise_q22), error);
    CHECK_EQ(memcmp(&as_it_was, &mesh, sizeof mesh), 0);
    CHECK_EQ(memcmp(before, block[0], (size_t)((const uint8_t *)mesh.cell_start - block[0])), 0);
    CHECK_EQ(memcmp(mesh.surface, before + ((uint8_t *)mesh.surface - block[0]),
                    BYTES - (size_t)((uint8_t *)mesh.surface - block[0])),
             0);
    memcpy(moved, mesh.raw.vertices, sizeof moved);
}

static void test_refused(void)
{
    const int middle = COUNT / 2;
    int64_t rise_q22;

    begin();
    shape_box(&solid, 10, 1024, 1024, 1024);
    CHECK_EQ(carom_surface_build(&other, &solid.raw, block[1], BYTES), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_surface_build(&other, &flat.raw, block[1], BYTES - 8), CAROM_ERR_MEMORY);
    CHECK_EQ(carom_surface_build(NULL, &flat.raw, block[1], BYTES), CAROM_ERR_NULL);
    CHECK_EQ(carom_surface_build(&other, NULL, block[1], BYTES), CAROM_ERR_NULL);
    CHECK_EQ(carom_surface_build(&other, &flat.raw, NULL, BYTES), CAROM_ERR_NULL);
    CHECK_EQ(carom_mesh_build(&other, &flat.raw, block[1], BYTES), CAROM_OK);
    CHECK_SAME(other.surface, NULL);

    moved[middle][0] = (int16_t)(moved[middle][0] + 1500); /* beyond the next vertex */
    check_refused(CAROM_ERR_MESH_SURFACE);
    for (int v = 0; v < COUNT; v++) {
        moved[v][0] = (int16_t)-moved[v][0];
    }
    check_refused(CAROM_ERR_MESH_INSIDE_OUT);
    moved[middle][0] = moved[middle + 1][0];
    moved[middle][1] = moved[middle + 1][1];
    moved[middle][2] = moved[middle + 1][2];
    check_refused(CAROM_ERR_MESH_DEGENERATE);
    moved[middle][2] = 16 * 1024 + 1;
    check_refused(CAROM_ERR_RANGE);
    moved[middle][2] = 16 * 1024;
    CHECK_EQ(move(&rise_q22), CAROM_OK);
    CHECK_EQ(mesh_drift_most(&mesh), 16 << 22);
    moved[middle][2] = 0; /* that is no distance from the last step */
    CHECK_EQ(move(&rise_q22), CAROM_OK);
    CHECK_EQ(mesh_drift_most(&mesh), 0);
}

/* Two squares side by side: one moves over the other, while all faces still look up. */
static void test_overlap(void)
{
    static const int16_t apart[8][3] = {{0, 0, 0},       {900, 0, 0},    {900, 1000, 0},
                                        {0, 1000, 0},    {1000, 0, 0},   {1900, 0, 0},
                                        {1900, 1000, 0}, {1000, 1000, 0}};
    static const uint16_t faces[4][3] = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
    struct carom_mesh_raw raw = {apart, faces, 8, 4, 10, CAROM_SURFACE};
    int64_t rise_q22;
    int16_t to[8][3];

    CHECK_EQ(carom_surface_build(&mesh, &raw, block[0], BYTES), CAROM_OK);
    memcpy(to, apart, sizeof to);
    for (int way = 99; way <= 103; way++) {
        for (int v = 0; v < 4; v++) {
            to[v][0] = (int16_t)(apart[v][0] + way);
            to[v][2] = 50; /* lying higher does not excuse the overlap */
        }
        CHECK_EQ(mesh_surface_try(mesh.surface, (const int16_t(*)[3])to, true, &rise_q22),
                 way <= 100 ? CAROM_OK : CAROM_ERR_MESH_SURFACE);
    }
}

/* Every vertex moves by (x/8, y/4, x/16 + y/32), so every point between them does, too. */
static void move_evenly(void)
{
    int64_t rise_q22;

    begin();
    for (int v = 0; v < COUNT; v++) {
        const int16_t *p = flat.vertices[v];

        moved[v][0] = (int16_t)(p[0] + p[0] / 8);
        moved[v][1] = (int16_t)(p[1] + p[1] / 4);
        moved[v][2] = (int16_t)(p[0] / 16 + p[1] / 32);
    }
    CHECK_EQ(move(&rise_q22), CAROM_OK);
}

static void test_drift(void)
{
    struct test_random r = {99};

    move_evenly();
    for (int i = 0; i < 300; i++) {
        uint32_t face = (uint32_t)test_random_range(&r, 0, FACES - 1);
        uint32_t edge = mesh.faces[face].edge[i % 3];
        int64_t w1 = test_random_range(&r, 0, 512), w2 = test_random_range(&r, 0, 512);
        const uint16_t *corner = mesh.raw.faces[face], *end = mesh.edges[edge].vertex;
        carom_v3_q22 on_face, on_edge;
        carom_v3_q40 by_face, by_edge, by_vertex;

        for (int k = 0; k < 3; k++) {
            /* means with weights of 1/1024: 12 bits from quanta to q22, 10 of them weight */
            on_face.c[k] = (int32_t)(4 * ((1024 - w1 - w2) * moved[corner[0]][k] +
                                          w1 * moved[corner[1]][k] + w2 * moved[corner[2]][k]));
            on_edge.c[k] = (int32_t)(4 * ((1024 - w1) * moved[end[0]][k] + w1 * moved[end[1]][k]));
        }
        mesh_drift_face(&mesh, face, &on_face, &by_face);
        mesh_drift_edge(&mesh, edge, &on_edge, &by_edge);
        mesh_drift_vertex(&mesh, corner[0], &by_vertex);
        for (int k = 0; k < 3; k++) {
            /* x' = 9/8 x, so x/8 = x'/9; and the same in y */
            int64_t f[2] = {(int64_t)on_face.c[0] * (1 << 18) / 9,
                            (int64_t)on_face.c[1] * (1 << 18) / 5};
            int64_t e[2] = {(int64_t)on_edge.c[0] * (1 << 18) / 9,
                            (int64_t)on_edge.c[1] * (1 << 18) / 5};

            /* weights are right to some units of 2^-30, and distances are at most 1 unit */
            CHECK_NEAR(by_face.c[k], k < 2 ? f[k] : f[0] / 2 + f[1] / 8, 1 << 13);
            CHECK_NEAR(by_edge.c[k], k < 2 ? e[k] : e[0] / 2 + e[1] / 8, 1 << 20);
            CHECK_EQ(by_vertex.c[k],
                     (int64_t)(moved[corner[0]][k] - flat.vertices[corner[0]][k]) * (1 << 30));
        }
        for (int e = 0; e < 2; e++) { /* beyond an end an edge moves as that end does */
            for (int k = 0; k < 3; k++) {
                on_edge.c[k] = 4096 * (2 * moved[end[e]][k] - moved[end[1 - e]][k]);
            }
            mesh_drift_edge(&mesh, edge, &on_edge, &by_edge);
            mesh_drift_vertex(&mesh, end[e], &by_vertex);
            for (int k = 0; k < 3; k++) {
                CHECK_NEAR(by_edge.c[k], by_vertex.c[k], 1 << 8);
            }
        }
    }
    mesh_surface_halt(mesh.surface);
    CHECK_EQ(mesh_drift_most(&mesh), 0);
}

/*
 * A contact drifts as its feature of the surface does, in world axes: the body is turned by 90
 * degrees about x.
 */
static void test_contact_drift(void)
{
    static const int kinds[] = {CANDIDATE_VERTEX_FACE, CANDIDATE_FACE_VERTEX, CANDIDATE_EDGE_EDGE};
    const carom_m3_q30 turned = {
        {{CAROM_ONE_Q30, 0, 0}, {0, 0, -CAROM_ONE_Q30}, {0, CAROM_ONE_Q30, 0}}};
    struct test_random r = {98};
    struct body body;
    struct boyse_pair pair = {.b = &body};

    move_evenly();
    memset(&body, 0, sizeof body);
    body.def.mesh = &mesh;
    body.path.start.r = turned;
    for (int i = 0; i < 300; i++) {
        uint32_t face = (uint32_t)test_random_range(&r, 0, FACES - 1);
        uint32_t edge = mesh.faces[face].edge[i % 3];
        const uint16_t *end = mesh.edges[edge].vertex;
        const int16_t *from = moved[end[0]], *to = moved[end[1]];
        struct candidate key = {.kind = (uint8_t)kinds[i % 3], .i = end[0], .j = face};
        int64_t weight = key.kind == CANDIDATE_FACE_VERTEX ? 0 : test_random_range(&r, 0, 1024);
        carom_v3_q40 arm, drift;
        int64_t at_q32[3];

        key.j = key.kind == CANDIDATE_EDGE_EDGE ? edge : face;
        for (int k = 0; k < 3; k++) {
            at_q32[k] = ((1024 - weight) * from[k] + weight * to[k]) * 4096;
        }
        arm = (carom_v3_q40){{at_q32[0] * 256, at_q32[2] * -256, at_q32[1] * 256}};
        contact_drift(&pair, &key, &arm, &drift);
        /* x' = 9/8 x, y' = 5/4 y; the displacement is (x/8, y/4, x/16 + y/32) */
        CHECK_NEAR(drift.c[0] >> 8, at_q32[0] / 9, 1 << 12);
        CHECK_NEAR(drift.c[1] >> 8, -(at_q32[0] / 18 + at_q32[1] / 40), 1 << 22);
        CHECK_NEAR(drift.c[2] >> 8, at_q32[1] / 5, 1 << 12);
    }
}

const struct test tests_mesh_surface[] = {
    {"mesh_surface/refresh", test_refresh},
    {"mesh_surface/rise", test_rise},
    {"mesh_surface/refused", test_refused},
    {"mesh_surface/overlap", test_overlap},
    {"mesh_surface/drift", test_drift},
    {"mesh_surface/contact_drift", test_contact_drift},
    {0},
};
