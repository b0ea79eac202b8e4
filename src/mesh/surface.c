/* SPDX-License-Identifier: MIT */
/*
 * Surfaces whose vertices move: what a build derives from vertices is worked out anew in the same
 * place.
 */
#include "build.h"

_Static_assert(sizeof(struct carom_surface) <= 80, "CAROM_SURFACE_BYTES");

int mesh_surface_build(struct carom_mesh *mesh, const struct carom_mesh_raw *raw, void *mem,
                       size_t bytes, const struct mesh_moving *does)
{
    struct carom_mesh built;
    struct carom_surface *s;
    struct mesh_builder b;
    size_t vertices, offset;
    int error;

    if (!mesh) {
        return CAROM_ERR_NULL;
    }
    error = mesh_make(&b, &built, raw, mem, bytes);
    if (error) {
        return error;
    }
    vertices = built.raw.vertex_count;
    offset = CAROM_MESH_BYTES(vertices, built.raw.face_count);
    if (built.raw.kind != CAROM_SURFACE) {
        return CAROM_ERR_ARGUMENT;
    }
    if (bytes < CAROM_SURFACE_BYTES(vertices, built.raw.face_count)) {
        return CAROM_ERR_MEMORY;
    }
    s = (struct carom_surface *)((uint64_t *)mem + offset / 8);
    memset(s, 0, sizeof *s);
    s->does = does;
    s->mesh = mesh;
    s->now = (int16_t(*)[3])(s + 1);
    s->before = s->now + vertices;
    s->faces = b.faces;
    s->edges = b.edges;
    s->leaves = b.leaves;
    s->lists = (uint32_t *)mem + (size_t)(built.cell_start - (const uint32_t *)mem);
    memcpy(s->now, raw->vertices, vertices * sizeof s->now[0]);
    memcpy(s->before, raw->vertices, vertices * sizeof s->before[0]);
    built.raw.vertices = (const int16_t(*)[3])s->now;
    built.surface = s;
    *mesh = built;
    return CAROM_OK;
}

/* A number of quanta as a length. */
static int64_t length_q22(const struct carom_surface *s, int32_t quanta)
{
    return carom_shl(quanta, 22 - s->mesh->raw.quantum_bits);
}

/* The largest change of a coordinate, in quanta. */
static int32_t largest_change(const struct carom_surface *s, const int16_t (*a)[3],
                              const int16_t (*b)[3])
{
    int32_t most = 0;

    for (uint32_t i = 0; i < 3 * s->mesh->raw.vertex_count; i++) {
        most = fix_larger(fix_abs32(a[i / 3][i % 3] - b[i / 3][i % 3]), most);
    }
    return most;
}

/*
 * A bound on how much higher the new surface is. A point of the new surface is a mean of new
 * corners; the same mean of the old corners lies on the old surface. It is lower by at most dz and
 * aside by at most dx + dy, and there the old surface is lower by at most that times its steepest
 * slope, 1 / n.z. The heights of both boxes bound the rise, too.
 */
static int64_t find_rise_q22(const struct carom_surface *s, const int16_t (*vertices)[3])
{
    const struct carom_mesh *mesh = s->mesh;
    int32_t up = 0, aside = 0, steepest_q30 = CAROM_ONE_Q30, low = mesh->box[0][2],
            high = mesh->box[1][2];
    int64_t rise_q22;

    for (uint32_t v = 0; v < mesh->raw.vertex_count; v++) {
        int32_t dx = vertices[v][0] - s->now[v][0], dy = vertices[v][1] - s->now[v][1];
        int32_t z = vertices[v][2], dz = z - s->now[v][2];
        int32_t d = fix_abs32(dx) + fix_abs32(dy);

        up = dz > up ? dz : up;
        aside = d > aside ? d : aside;
        low = z < low ? z : low;
        high = z > high ? z : high;
    }
    for (uint32_t f = 0; f < mesh->raw.face_count && aside > 0; f++) {
        int32_t z_q30 = mesh->faces[f].normal.c[2];

        steepest_q30 = z_q30 < steepest_q30 ? z_q30 : steepest_q30;
    }
    /* aside < 2^17 quanta, so the quotient is below 2^47 / n.z; a normal's z may be rounded to 0 */
    rise_q22 = up;
    if (aside > 0) {
        rise_q22 += carom_shl(aside, 30) / (steepest_q30 > 0 ? steepest_q30 : 1) + 1;
    }
    rise_q22 = rise_q22 < high - low ? rise_q22 : high - low;
    return carom_shl(rise_q22, 22 - mesh->raw.quantum_bits);
}

static bool moves_aside(const struct carom_surface *s, const int16_t (*vertices)[3])
{
    for (uint32_t v = 0; v < s->mesh->raw.vertex_count; v++) {
        if (vertices[v][0] != s->now[v][0] || vertices[v][1] != s->now[v][1]) {
            return true;
        }
    }
    return false;
}

/*
 * Rebuild from the vertices of mesh->raw. Faces that look up and whose x and y have not changed
 * cannot overlap: only then may the z-lists be skipped.
 */
static int refresh(struct carom_surface *s, bool lists)
{
    struct mesh_builder b = {
        .mesh = s->mesh, .faces = s->faces, .edges = s->edges, .leaves = s->leaves};
    int error = mesh_refresh(&b);

    if (error == CAROM_OK && (lists || !s->does->make_lists)) {
        arena_init(&b.arena, s->lists, (size_t)((uint8_t *)s - (uint8_t *)s->lists));
        error = mesh_build_zlists(&b);
    }
    return error;
}

int mesh_surface_try(struct carom_surface *s, const int16_t (*vertices)[3], bool drifts,
                     int64_t *rise_q22)
{
    bool aside = moves_aside(s, vertices);
    int error;

    if (drifts && length_q22(s, largest_change(s, vertices, (const int16_t(*)[3])s->before)) >
                      (int64_t)MESH_STEP_MAX << 22) {
        return CAROM_ERR_RANGE;
    }
    *rise_q22 = find_rise_q22(s, vertices);
    s->mesh->raw.vertices = vertices;
    error = refresh(s, aside);
    if (error) {
        mesh_surface_undo(s);
    }
    return error;
}

void mesh_surface_keep(struct carom_surface *s)
{
    memcpy(s->now, s->mesh->raw.vertices, s->mesh->raw.vertex_count * sizeof s->now[0]);
    s->mesh->raw.vertices = (const int16_t(*)[3])s->now;
    s->moves++;
    s->most_q22 = (int32_t)length_q22(
        s, largest_change(s, s->mesh->raw.vertices, (const int16_t(*)[3])s->before));
}

void mesh_surface_undo(struct carom_surface *s)
{
    s->mesh->raw.vertices = (const int16_t(*)[3])s->now;
    (void)refresh(s, true); /* it was good before */
}

void mesh_surface_halt(struct carom_surface *s)
{
    memcpy(s->before, s->now, s->mesh->raw.vertex_count * sizeof s->now[0]);
    s->most_q22 = 0;
}

/* ------------------------------------------------------------------- drift */

/* The weighted mean of vertices' displacements; weights are 0 .. 1 and sum to 1. */
static void mean_drift(const struct carom_mesh *mesh, const uint16_t *vertex,
                       const int32_t *weight_q30, int n, carom_v3_q40 *out)
{
    const struct carom_surface *s = mesh->surface;
    int digits = mesh->raw.quantum_bits - 10;

    for (int k = 0; k < 3; k++) {
        int64_t sum = 0; /* n < 4 products below 2^17 2^30 */

        for (int i = 0; i < n; i++) {
            sum += (int64_t)(s->now[vertex[i]][k] - s->before[vertex[i]][k]) * weight_q30[i];
        }
        out->c[k] = fix_round_shift(sum, -digits);
    }
}

void mesh_drift_vertex(const struct carom_mesh *mesh, uint32_t v, carom_v3_q40 *out)
{
    const uint16_t vertex = (uint16_t)v;
    const int32_t whole = CAROM_ONE_Q30;

    mean_drift(mesh, &vertex, &whole, 1, out);
}

/* part / whole, clamped to 0 .. 1; whole > 0 */
static int32_t share_q30(int64_t part, int64_t whole)
{
    int down = fix_bits((uint64_t)whole) - 31;

    part = part < 0 ? 0 : part > whole ? whole : part;
    if (down > 0) {
        part >>= down;
        whole >>= down;
    }
    return (int32_t)(carom_shl(part, 30) / whole);
}

void mesh_drift_edge(const struct carom_mesh *mesh, uint32_t edge, const carom_v3_q22 *at,
                     carom_v3_q40 *out)
{
    const struct carom_edge *e = &mesh->edges[edge];
    carom_v3_q22 from = mesh_vertex(mesh, e->vertex[0]);
    int32_t way[3], weight[2];

    for (int k = 0; k < 3; k++) {
        way[k] = at->c[k] - from.c[k];
    }
    weight[1] = share_q30(carom_dot(e->direction.c, way) >> 30, e->length_q22);
    weight[0] = CAROM_ONE_Q30 - weight[1];
    mean_drift(mesh, e->vertex, weight, 2, out);
}

/* Twice the area, seen from above, between an edge and a place; the edge in quanta. */
static int64_t area(const int16_t *from, const int16_t *to, const int32_t at_q22[2], int shift)
{
    int64_t x = at_q22[0] - carom_shl(from[0], shift), y = at_q22[1] - carom_shl(from[1], shift);

    return (to[0] - from[0]) * y - (to[1] - from[1]) * x;
}

void mesh_drift_face(const struct carom_mesh *mesh, uint32_t face, const carom_v3_q22 *at,
                     carom_v3_q40 *out)
{
    const uint16_t *corner = mesh->raw.faces[face];
    int shift = 22 - mesh->raw.quantum_bits;
    const int16_t *p[3];
    const int32_t place[2] = {at->c[0], at->c[1]}; /* a SURFACE's centre is its origin */
    int32_t weight[3];
    int64_t part[3], whole = 0;

    for (int k = 0; k < 3; k++) {
        p[k] = mesh->raw.vertices[corner[k]];
    }
    for (int k = 0; k < 3; k++) {
        part[k] = area(p[fix_next(k)], p[fix_next(fix_next(k))], place, shift);
        part[k] = part[k] < 0 ? 0 : part[k];
        whole += part[k];
    }
    /* all three parts, signed, add up to the area of the face, which looks up */
    CAROM_ASSERT(whole > 0);
    weight[1] = share_q30(part[1], whole);
    weight[2] = share_q30(part[2], whole);
    weight[0] = CAROM_ONE_Q30 - weight[1] - weight[2];
    mean_drift(mesh, corner, weight, 3, out);
}
