/* SPDX-License-Identifier: MIT */
/* The index of a mesh: leaves, z-lists, memory. */
#include <string.h>

#include "lib/mesh_shapes.h"

#ifdef TEST_LONG
#define POINT_STEP 1 /* steps between the places of a face that are looked up in the z-lists */
#else
#define POINT_STEP 11
#endif

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

        CHECK_EQ(leaf->first_face, face);
        CHECK_EQ(leaf->first_vertex, vertex);
        CHECK_AT_LEAST(leaf->face_count, 1);
        CHECK_AT_MOST(leaf->face_count, CAROM_LEAF_FACES);
        CHECK_AT_LEAST(leaf->vertex_count, 3);
        CHECK_AT_MOST(leaf->vertex_count, CAROM_LEAF_VERTICES);
        for (int i = 0; i < leaf->face_count; i++, face++) {
            seen[mesh.leaf_faces[face]]++;
            for (int k = 0; k < 3; k++) {
                CHECK_EQ(leaf_vertices[mesh.leaf_corners[face][k]],
                         raw.faces[mesh.leaf_faces[face]][k]);
                CHECK_LESS(mesh.leaf_corners[face][k], leaf->vertex_count);
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
                CHECK_DIFFER(leaf_vertices[j], leaf_vertices[i]);
            }
        }
        CHECK_AT_MOST(most2, radius2);
        CHECK_AT_MOST(radius2, most2 * 1.001 + 1e4);
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

    /* Full leaves of a flat field: 7 squares. */
    make_field(16, 128, 0, 1);
    CHECK_EQ(build(), CAROM_OK);
    check_leaves();
    CHECK_EQ(mesh.leaf_count, (16 * 16 * 2 + CAROM_LEAF_FACES - 1) / CAROM_LEAF_FACES);
    for (uint32_t l = 0; l < mesh.leaf_count; l++) {
        CHECK_LESS(mesh.leaves[l].radius_q22, 4 * 128 << 12);
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
    CHECK_EQ(mesh.edge_count, 750);
}

/* --------------------------------------------------------------------- z-lists */

/* A point of a face, given by weights that sum to 8, must be in an entry of the cell below it. */
static void check_point(uint32_t f, int a, int b, const struct scan_grid *g)
{
    int32_t p[3], cell[2];

    for (int k = 0; k < 3; k++) {
        p[k] = a * raw.vertices[raw.faces[f][0]][k] + b * raw.vertices[raw.faces[f][1]][k] +
               (8 - a - b) * raw.vertices[raw.faces[f][2]][k];
    }
    cell[0] = (p[0] - 8 * g->x0) >> (g->shift + 3);
    cell[1] = (p[1] - 8 * g->y0) >> (g->shift + 3);
    /* a point on the far side of the last cell belongs to that cell */
    cell[0] -= cell[0] == g->nx && p[0] == 8 * (g->x0 + (g->nx << g->shift));
    cell[1] -= cell[1] == g->ny && p[1] == 8 * (g->y0 + (g->ny << g->shift));
    CHECK_AT_LEAST(cell[0], 0);
    CHECK_LESS(cell[0], g->nx);
    CHECK_AT_LEAST(cell[1], 0);
    CHECK_LESS(cell[1], g->ny);
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

    CHECK_AT_MOST(cells, ZLIST_CELLS_MAX);
    CHECK_AT_MOST(mesh.zref_count, 8 * raw.face_count);
    CHECK_AT_MOST((const uint8_t *)(mesh.zrefs + mesh.zref_count) - block,
                  CAROM_MESH_BYTES(raw.vertex_count, raw.face_count));
    CHECK_AT_MOST(g.x0, mesh.box[0][0]);
    CHECK_AT_LEAST(g.x0 + (g.nx << g.shift), mesh.box[1][0]);
    CHECK_AT_MOST(g.y0, mesh.box[0][1]);
    CHECK_AT_LEAST(g.y0 + (g.ny << g.shift), mesh.box[1][1]);
    CHECK_EQ(mesh.cell_start[0], 0);
    CHECK_EQ(mesh.cell_start[cells], mesh.zref_count);
    for (uint32_t c = 0; c < cells; c++) {
        CHECK_AT_MOST(mesh.cell_start[c], mesh.cell_start[c + 1]);
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
#ifdef TEST_LONG
    /* a regular field on a power of two, 32 cells wide */
    make_field(32, 64, 100, 7);
    CHECK_EQ(build(), CAROM_OK);
    CHECK_EQ(mesh.grid_nx, 32);
    CHECK_EQ(mesh.grid_ny, 32);
    check_zlists();
#endif

    /* slivers across the whole surface: the cells grow until the lists fit */
    begin(CAROM_SURFACE);
    for (int i = 0; i < 80; i++) {
        uint32_t v = add_vertex(0, 10 * i, i % 7);

        add_vertex(8000, 10 * i + 4000, 5);
        add_vertex(8000, 10 * i + 4009, i % 11);
        add_face(v, v + 1, v + 2);
    }
    CHECK_EQ(build(), CAROM_OK);
    CHECK_MORE(mesh.grid_nx, 1);
    check_zlists();
}

/* ---------------------------------------------------------------------- memory */

/* Nothing beyond the block is touched, and the earlier content of the block has no effect. */
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
        CHECK_EQ(memcmp(block + bytes, guard, sizeof guard), 0);
        CHECK_AT_MOST((const uint8_t *)(mesh.zrefs + mesh.zref_count) - block, bytes);
        for (const uint8_t *p = block; p < (const uint8_t *)(mesh.zrefs + mesh.zref_count); p++) {
            hash[pass] = hash[pass] * 31 + *p;
        }
    }
    CHECK_EQ(hash[0], hash[1]);
}

/*
 * Faces without a common vertex have the most edges. A prism with 16 sides has 32 vertices: no leaf
 * of it has too many.
 */
static void test_small(void)
{
    static const int corner[16][2] = {{400, 0},  {370, 153},   {283, 283},   {153, 370},
                                      {0, 400},  {-153, 370},  {-283, 283},  {-370, 153},
                                      {-400, 0}, {-370, -153}, {-283, -283}, {-153, -370},
                                      {0, -400}, {153, -370},  {283, -283},  {370, -153}};

    begin(CAROM_SURFACE);
    for (int i = 0; i < 7; i++) {
        uint32_t v = add_vertex(300 * i, 0, 0);

        add_vertex(300 * i + 200, 0, 5);
        add_vertex(300 * i, 200, 9);
        add_face(v, v + 1, v + 2);
        CHECK_EQ(build(), CAROM_OK);
        CHECK_EQ(mesh.edge_count, 3 * (i + 1));
        check_zlists();
    }
    make_prism(corner, 16, 300);
    CHECK_EQ(build(), CAROM_OK);
    CHECK_EQ(mesh.leaf_count, (mesh.raw.face_count + CAROM_LEAF_FACES - 1) / CAROM_LEAF_FACES);
    check_zlists();
    CHECK_AT_MOST(CAROM_MESH_BYTES(8, 12), 1800); /* a box */
}

const struct test tests_mesh_index[] = {
    {"mesh_index/leaves", test_leaves},
    {"mesh_index/zlists", test_zlists},
    {"mesh_index/memory", test_memory},
    {"mesh_index/small", test_small},
    {0},
};
