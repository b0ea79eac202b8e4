/* SPDX-License-Identifier: MIT */
/* Raw meshes for the tests of the mesh stage, which tests may damage. */
#include "mesh_shapes.h"

int16_t vertices[V_MAX][3];
uint16_t faces[F_MAX][3];
struct carom_mesh_raw raw;
struct carom_mesh mesh;
_Alignas(8) uint8_t block[CAROM_MESH_BYTES(V_MAX, F_MAX) + 8];

void begin(int kind)
{
    raw.vertices = (const int16_t(*)[3])vertices;
    raw.faces = (const uint16_t(*)[3])faces;
    raw.vertex_count = raw.face_count = 0;
    raw.quantum_bits = 10;
    raw.kind = (uint8_t)kind;
}

uint32_t add_vertex(int x, int y, int z)
{
    int16_t *v = vertices[raw.vertex_count];

    v[0] = (int16_t)x;
    v[1] = (int16_t)y;
    v[2] = (int16_t)z;
    return raw.vertex_count++;
}

void add_face(uint32_t a, uint32_t b, uint32_t c)
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

void make_prism(const int (*corner)[2], uint32_t n, int height)
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

void make_box(int x, int y, int z)
{
    const int corner[4][2] = {{0, 0}, {x, 0}, {x, y}, {0, y}};

    make_prism(corner, 4, z);
}

void make_field(uint32_t n, int side, int rough, uint64_t seed)
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

void make_bumpy(uint32_t n, int side, int rough, uint64_t seed)
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

int build(void)
{
    return carom_mesh_build(&mesh, &raw, block, CAROM_MESH_BYTES(raw.vertex_count, raw.face_count));
}
