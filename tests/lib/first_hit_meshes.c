/* SPDX-License-Identifier: MIT */
/* Meshes of the first-hit test: a head, a needle, a torus, a field. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "first_hit.h"
#include "lab.h"

#define PI   3.14159265358979323846
#define BITS 12 /* quantum bits */

struct first_hit_mesh first_hit_meshes[FIRST_HIT_SIZES][FIRST_HIT_MESHES];

/* ---------------------------------------------------------------- generators */

#define VERTICES_MAX 128
#define FACES_MAX    200
struct drawing {
    int16_t vertices[VERTICES_MAX][3];
    uint16_t faces[FACES_MAX][3];
    uint32_t vertex_count, face_count;
};

static void add_vertex(struct drawing *d, double x, double y, double z)
{
    const double p[3] = {x, y, z};

    for (int k = 0; k < 3; k++) {
        d->vertices[d->vertex_count][k] = (int16_t)lround(ldexp(p[k], BITS));
    }
    d->vertex_count++;
}

static void add_face(struct drawing *d, int a, int b, int c)
{
    uint16_t *face = d->faces[d->face_count++];

    face[0] = (uint16_t)a;
    face[1] = (uint16_t)b;
    face[2] = (uint16_t)c;
}

/* A bumpy ball of 200 faces: 10 rings of 10 between two poles. */
static void draw_head(struct drawing *d)
{
    const int rings = 11, segments = 10, last = 1 + (rings - 1) * segments;

    for (int i = 0; i <= rings; i++) {
        double theta = PI * i / rings;

        for (int k = 0; k < (i % rings == 0 ? 1 : segments); k++) {
            double phi = 2 * PI * k / segments;
            double r =
                0.5 + 0.08 * cos(5 * theta) + 0.12 * pow(sin(theta), 3) * sin(3 * phi + theta);

            add_vertex(d, r * sin(theta) * cos(phi), r * sin(theta) * sin(phi), r * cos(theta));
        }
    }
    for (int i = 1; i < rings; i++) {
        for (int k = 0; k < segments; k++) {
            int a = 1 + (i - 1) * segments + k, b = 1 + (i - 1) * segments + (k + 1) % segments;

            if (i == 1) {
                add_face(d, 0, a, b);
            }
            if (i == rings - 1) {
                add_face(d, last, b, a);
            } else {
                add_face(d, a, a + segments, b + segments);
                add_face(d, a, b + segments, b);
            }
        }
    }
}

/* Two long pyramids base to base: 1.6 long, 0.02 thick. */
static void draw_needle(struct drawing *d)
{
    add_vertex(d, -0.8, 0, 0);
    for (int k = 0; k < 4; k++) {
        add_vertex(d, 0, 0.01 * cos(PI / 2 * k), 0.01 * sin(PI / 2 * k));
    }
    add_vertex(d, 0.8, 0, 0);
    for (int k = 0; k < 4; k++) {
        add_face(d, 0, 1 + (k + 1) % 4, 1 + k);
        add_face(d, 5, 1 + k, 1 + (k + 1) % 4);
    }
}

/* A ring of 12 by 8 squares. */
static void draw_torus(struct drawing *d)
{
    const int around = 12, across = 8;

    for (int i = 0; i < around * across; i++) {
        double phi = 2 * PI * (i / across) / around, theta = 2 * PI * (i % across) / across;
        double r = 0.5 + 0.15 * cos(theta);

        add_vertex(d, r * cos(phi), r * sin(phi), 0.15 * sin(theta));
    }
    for (int i = 0; i < around * across; i++) {
        int next = i / across * across + (i + 1) % across;
        int over = (i + across) % (around * across), far = (next + across) % (around * across);

        add_face(d, i, over, far);
        add_face(d, i, far, next);
    }
}

/* A height field of 10 by 10 squares, 4 units wide. */
static void draw_field(struct drawing *d)
{
    const int side = 10;
    uint64_t random = 5;

    for (int i = 0; i < (side + 1) * (side + 1); i++) {
        add_vertex(d, 0.4 * (i % (side + 1)) - 2, 0.4 * (i / (side + 1)) - 2,
                   lab_random(&random, 0, 0.3));
    }
    for (int i = 0; i < side * side; i++) {
        int a = i / side * (side + 1) + i % side, b = a + side + 1;

        add_face(d, a, a + 1, b + 1);
        add_face(d, a, b + 1, b);
    }
}

/* ------------------------------------------------------------------- building */

static void *need(size_t count, size_t bytes)
{
    void *memory = calloc(count, bytes);

    if (!memory) {
        puts("Bail out! no memory");
        exit(1);
    }
    return memory;
}

/* The features that the faces of a mesh own. */
static void list_owned(struct first_hit_mesh *m)
{
    const struct carom_mesh *mesh = &m->mesh;

    m->vertices = need(mesh->raw.vertex_count, sizeof *m->vertices);
    m->edges = need(mesh->edge_count, sizeof *m->edges);
    for (uint32_t f = 0; f < mesh->raw.face_count; f++) {
        for (int k = 0; k < 3; k++) {
            if (mesh->faces[f].own >> k & 1) {
                m->vertices[m->vertex_count++] = mesh->raw.faces[f][k];
            }
            if (mesh->faces[f].own >> (3 + k) & 1) {
                m->edges[m->edge_count++] = mesh->faces[f].edge[k];
            }
        }
    }
}

void first_hit_make_mesh(struct first_hit_mesh *m, const char *name, double thin)
{
    const struct carom_mesh_raw *raw = &m->mesh.raw;

    m->name = name;
    m->thin = thin;
    m->radius = lab_double(m->mesh.radius_q22, 22);
    m->doubles = oracle_mesh_make(raw->vertices, raw->vertex_count, raw->faces, raw->face_count,
                                  raw->quantum_bits);
    for (int k = 0; k < 3; k++) {
        m->centre[k] = lab_double(m->mesh.mass.centre.c[k], 22);
    }
    list_owned(m);
}

void first_hit_free_mesh(struct first_hit_mesh *m)
{
    oracle_mesh_free(&m->doubles);
    free(m->vertices);
    free(m->edges);
}

static void make(struct first_hit_mesh *m, const char *name, double thin,
                 const struct carom_mesh_raw *raw)
{
    size_t bytes = CAROM_MESH_BYTES(raw->vertex_count, raw->face_count);
    int result = carom_mesh_build(&m->mesh, raw, need(1, bytes), bytes);

    if (result < 0) {
        printf("Bail out! %s: %s\n", name, carom_result_text(result));
        exit(1);
    }
    first_hit_make_mesh(m, name, thin);
}

/* Make the mesh in all sizes that other quanta give. */
static void make_sizes(int number, const char *name, double thin, const struct carom_mesh_raw *raw)
{
    static const int8_t finer[FIRST_HIT_SIZES] = {0, 3, -3, 7, -5};

    for (int i = 0; i < FIRST_HIT_SIZES; i++) {
        struct carom_mesh_raw sized = *raw;

        sized.quantum_bits = (uint8_t)(raw->quantum_bits + finer[i]);
        if (sized.quantum_bits >= 7) {
            make(&first_hit_meshes[i][number], name, ldexp(thin, -finer[i]), &sized);
        }
    }
}

static void make_drawn(int number, const char *name, double thin, void (*draw)(struct drawing *))
{
    struct drawing *d = need(1, sizeof *d);
    struct carom_mesh_raw raw;

    draw(d);
    raw.vertices = (const int16_t(*)[3])d->vertices;
    raw.faces = (const uint16_t(*)[3])d->faces;
    raw.vertex_count = d->vertex_count;
    raw.face_count = d->face_count;
    raw.quantum_bits = BITS;
    raw.kind = number == FIRST_HIT_FIELD ? CAROM_SURFACE : CAROM_SOLID;
    make_sizes(number, name, thin, &raw);
}

void first_hit_make_meshes(void)
{
    make_drawn(FIRST_HIT_HEAD, "head200", 0.5, draw_head);
    make_sizes(FIRST_HIT_BOX, "box", 0.3, &lab_box);
    make_drawn(FIRST_HIT_NEEDLE, "needle", 0.02, draw_needle);
    make_sizes(FIRST_HIT_PLATE, "plate", 1.0 / 64, &lab_plate);
    make_drawn(FIRST_HIT_TORUS, "torus", 0.25, draw_torus);
    make_sizes(FIRST_HIT_L, "l", 0.25, &lab_l);
    make_drawn(FIRST_HIT_FIELD, "field200", 0.5, draw_field);
    make_sizes(FIRST_HIT_HEAD1876, "head1876", 0.5, &head_mesh);
}
