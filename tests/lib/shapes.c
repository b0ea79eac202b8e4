/* SPDX-License-Identifier: MIT */
/* Small meshes for tests, and bodies of them without a world. */
#include "box.h"
#include "shapes.h"
#include "real.h"

_Alignas(8) uint8_t shape_scene_block[SCENE_MESH_BYTES];

static void begin(struct shape *s, int quantum_bits, int kind)
{
    s->raw.vertices = (const int16_t(*)[3])s->vertices;
    s->raw.faces = (const uint16_t(*)[3])s->faces;
    s->raw.vertex_count = s->raw.face_count = 0;
    s->raw.quantum_bits = (uint8_t)quantum_bits;
    s->raw.kind = (uint8_t)kind;
}

static uint32_t add_vertex(struct shape *s, int x, int y, int z)
{
    int16_t *v = s->vertices[s->raw.vertex_count];

    v[0] = (int16_t)x;
    v[1] = (int16_t)y;
    v[2] = (int16_t)z;
    return s->raw.vertex_count++;
}

static void add_face(struct shape *s, uint32_t a, uint32_t b, uint32_t c)
{
    uint16_t *f = s->faces[s->raw.face_count++];

    f[0] = (uint16_t)a;
    f[1] = (uint16_t)b;
    f[2] = (uint16_t)c;
}

static void add_square(struct shape *s, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    add_face(s, a, b, c);
    add_face(s, a, c, d);
}

static void build(struct shape *s)
{
    CHECK_EQ(carom_mesh_build(&s->mesh, &s->raw, s->block, sizeof s->block), CAROM_OK);
}

void shape_box(struct shape *s, int quantum_bits, int x, int y, int z)
{
    const int low[3] = {-x / 2, -y / 2, -z / 2}, high[3] = {x / 2, y / 2, z / 2};

    begin(s, quantum_bits, CAROM_SOLID);
    box_corners(s->vertices, low, high);
    memcpy(s->faces, box_faces, sizeof box_faces);
    s->raw.vertex_count = 8;
    s->raw.face_count = 12;
    build(s);
}

static void tetrahedron(struct shape *s, int quantum_bits, int corners[4][3], int third, int fourth)
{
    begin(s, quantum_bits, CAROM_SOLID);
    for (int i = 0; i < 4; i++) {
        const int *at = corners[i == 2 ? third : i == 3 ? fourth : i];

        add_vertex(s, at[0], at[1], at[2]);
    }
    add_face(s, 0, 1, 2);
    add_face(s, 0, 2, 3);
    add_face(s, 0, 3, 1);
    add_face(s, 1, 3, 2);
    build(s);
}

void shape_tetrahedron(struct shape *s, int quantum_bits, int size)
{
    int corners[4][3] = {
        {size, size, size}, {size, -size, -size}, {-size, size, -size}, {-size, -size, size}};

    tetrahedron(s, quantum_bits, corners, 2, 3);
}

/* Six times the volume, with a sign. */
static int64_t volume_of(int corners[4][3])
{
    int32_t d[3][3];
    int64_t cross[3];

    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            d[i][k] = corners[i + 1][k] - corners[0][k];
        }
    }
    fix_cross(cross, d[0], d[1]);
    return cross[0] * d[2][0] + cross[1] * d[2][1] + cross[2] * d[2][2];
}

void shape_random_tetrahedron(struct shape *s, struct test_random *r)
{
    int corners[4][3];
    int64_t volume;

    do {
        for (int i = 0; i < 4; i++) {
            for (int k = 0; k < 3; k++) {
                corners[i][k] = (int)test_random_range(r, -12, 12) * 64;
            }
        }
        volume = volume_of(corners);
    } while (carom_abs(volume) < (int64_t)1 << 28);
    tetrahedron(s, 10, corners, volume < 0 ? 2 : 3, volume < 0 ? 3 : 2);
}

void shape_l(struct shape *s, int quantum_bits, int side)
{
    static const int8_t corner[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

    begin(s, quantum_bits, CAROM_SOLID);
    for (uint32_t i = 0; i < 12; i++) {
        add_vertex(s, corner[i % 6][0] * side, corner[i % 6][1] * side, i < 6 ? 0 : side);
    }
    for (uint32_t i = 0; i < 6; i++) {
        uint32_t next = (i + 1) % 6;

        if (i >= 1 && i < 5) {
            add_face(s, 0, next, i);
            add_face(s, 6, 6 + i, 6 + next);
        }
        add_square(s, i, next, 6 + next, 6 + i);
    }
    build(s);
}

/* The vertex halfway between two, lifted to the sphere; each is made once. */
static uint32_t between(struct shape *s, uint32_t a, uint32_t b, int radius)
{
    double p[3], scale;
    int16_t q[3];

    for (int k = 0; k < 3; k++) {
        p[k] = s->vertices[a][k] + s->vertices[b][k];
    }
    scale = radius / real_length(p);
    for (int k = 0; k < 3; k++) {
        q[k] = (int16_t)real_round(scale * p[k]);
    }
    for (uint32_t v = 0; v < s->raw.vertex_count; v++) {
        if (memcmp(s->vertices[v], q, sizeof q) == 0) {
            return v;
        }
    }
    return add_vertex(s, q[0], q[1], q[2]);
}

void shape_ball(struct shape *s, int quantum_bits, int radius)
{
    static const uint8_t ico[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                       {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                       {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                       {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    /* corners (0, +-1, +-golden ratio) and their cyclic permutations, on the sphere */
    int x = (int)real_round(radius * 0.52573111211913360603);
    int z = (int)real_round(radius * 0.85065080835203993218);

    begin(s, quantum_bits, CAROM_SOLID);
    for (int turn = 0; turn < 3; turn++) {
        for (int i = 0; i < 4; i++) {
            int p[3] = {0, 0, 0};

            p[turn] = i & 1 ? x : -x;
            p[(turn + 1) % 3] = i & 2 ? -z : z;
            add_vertex(s, p[0], p[1], p[2]);
        }
    }
    for (int f = 0; f < 20; f++) {
        uint32_t a = ico[f][0], b = ico[f][1], c = ico[f][2];
        uint32_t ab = between(s, a, b, radius), bc = between(s, b, c, radius);
        uint32_t ca = between(s, c, a, radius);

        add_face(s, a, ab, ca);
        add_face(s, b, bc, ab);
        add_face(s, c, ca, bc);
        add_face(s, ab, bc, ca);
    }
    build(s);
}

void shape_field(struct shape *s, int quantum_bits, int n, int side, int rough, uint64_t seed)
{
    struct test_random r = {seed};
    int corner = -n * side / 2;

    begin(s, quantum_bits, CAROM_SURFACE);
    for (int y = 0; y <= n; y++) {
        for (int x = 0; x <= n; x++) {
            add_vertex(s, corner + x * side, corner + y * side,
                       (int)test_random_range(&r, 0, rough));
        }
    }
    for (int y = 0; y < n; y++) {
        for (int x = 0; x < n; x++) {
            uint32_t v = (uint32_t)(y * (n + 1) + x), above = v + (uint32_t)n + 1;

            add_square(s, v, v + 1, above + 1, above);
        }
    }
    build(s);
}

void shape_plane(struct shape *s, int quantum_bits, int n, int side)
{
    shape_field(s, quantum_bits, n, side, 0, 0);
}

void shape_body(const struct shape *s, bool moving, struct body *b, struct body_state *state)
{
    memset(b, 0, sizeof *b);
    memset(state, 0, sizeof *state);
    state->rotation.c[0] = CAROM_ONE_Q30;
    b->def.category = 1;
    b->def.mask = 0xffff;
    b->def.mesh = &s->mesh;
    b->def.moving = b->def.goes = moving;
    b->def.radius_q22 = s->mesh.radius_q22;
    if (moving) {
        body_set_mass(b, fix_scale(s->mesh.mass.volume_q32, 32));
        b->def.unit_bits = (int8_t)fix_bits((uint64_t)b->def.radius_q22);
        b->def.skin_q22 = b->def.radius_q22 >> 11 > 256 ? b->def.radius_q22 >> 11 : 256;
    }
    body_place(b, state);
}

/* The bits of a face's features that are tested: with those behind it if the mesh has two sides. */
static unsigned tested(const struct shape *s, uint32_t face)
{
    const struct carom_face *f = &s->mesh.faces[face];

    return mesh_two_sided(&s->mesh) ? f->own | f->behind : f->own;
}

bool shape_owns_vertex(const struct shape *s, uint32_t vertex)
{
    for (uint32_t f = 0; f < s->raw.face_count; f++) {
        for (int k = 0; k < 3; k++) {
            if (s->faces[f][k] == vertex && tested(s, f) >> k & 1) {
                return true;
            }
        }
    }
    return false;
}

bool shape_owns_edge(const struct shape *s, uint32_t edge)
{
    const uint32_t face = s->mesh.edges[edge].face[0];

    for (int k = 0; k < 3; k++) {
        if (s->mesh.faces[face].edge[k] == edge) {
            return tested(s, face) >> (3 + k) & 1;
        }
    }
    return false;
}

uint32_t shape_candidates(const struct shape *a, const struct shape *b, uint16_t pair,
                          struct candidate *out, uint32_t max)
{
    const struct shape *sides[3][2] = {{a, b}, {b, a}, {a, b}};
    uint32_t count = 0;

    for (uint8_t kind = CANDIDATE_VERTEX_FACE; kind <= CANDIDATE_EDGE_EDGE; kind++) {
        const struct shape *from = sides[kind][0], *to = sides[kind][1];
        bool edges = kind == CANDIDATE_EDGE_EDGE;
        uint32_t ni = edges ? from->mesh.edge_count : from->raw.vertex_count;
        uint32_t nj = edges ? to->mesh.edge_count : to->raw.face_count;

        for (uint32_t i = 0; i < ni; i++) {
            bool owns = edges ? shape_owns_edge(from, i) : shape_owns_vertex(from, i);

            for (uint32_t j = 0; j < nj && owns; j++) {
                if (edges && !shape_owns_edge(to, j)) {
                    continue;
                }
                if (count < max) {
                    out[count] = (struct candidate){pair, kind, i, j};
                }
                count++;
            }
        }
    }
    return count;
}

carom_quat_q30 shape_random_turn(struct test_random *r)
{
    carom_quat_q30 q;
    double p[4], sum = 2;

    /* a random point of the ball, moved to the sphere */
    while (sum > 1 || sum < 0.01) {
        sum = 0;
        for (int k = 0; k < 4; k++) {
            p[k] = real(test_random_range(r, -(1 << 30), 1 << 30), 30);
            sum += p[k] * p[k];
        }
    }
    for (int k = 0; k < 4; k++) {
        q.c[k] = (int32_t)real_round(p[k] / real_sqrt(sum) * CAROM_ONE_Q30);
    }
    return q;
}
