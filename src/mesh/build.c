/* SPDX-License-Identifier: MIT */
/* Build a mesh: checks, box, normals and radius here, the other steps in order from their files. */
#include "build.h"

/* ------------------------------------------------------------------ checks */

static int check_header(const struct carom_mesh_raw *raw)
{
    if (raw->kind > CAROM_SURFACE || raw->quantum_bits < 7 || raw->quantum_bits > 20) {
        return CAROM_ERR_ARGUMENT;
    }
    if (raw->face_count == 0) {
        return CAROM_ERR_MESH_EMPTY;
    }
    if (raw->vertex_count > 65535 || raw->face_count > 65535) {
        return CAROM_ERR_MESH_SIZE;
    }
    return CAROM_OK;
}

static int check_corners(const struct carom_mesh_raw *raw)
{
    for (uint32_t f = 0; f < raw->face_count; f++) {
        const uint16_t *v = raw->faces[f];

        if (v[0] >= raw->vertex_count || v[1] >= raw->vertex_count || v[2] >= raw->vertex_count ||
            v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
            return CAROM_ERR_MESH_INDEX;
        }
    }
    return CAROM_OK;
}

/*
 * Find the box. Refuse a side over 256 or a diagonal over 384 units: so differences of two
 * vertices, and of a vertex and a point that a moving body can reach, fit q22, and so do lengths
 * and the radius.
 */
static int find_box(struct carom_mesh *mesh)
{
    const struct carom_mesh_raw *raw = &mesh->raw;
    int64_t side_q22[3];
    bool fits = true;

    for (int k = 0; k < 3; k++) {
        mesh->box[0][k] = INT16_MAX;
        mesh->box[1][k] = INT16_MIN;
        for (uint32_t v = 0; v < raw->vertex_count; v++) {
            int16_t c = raw->vertices[v][k];

            mesh->box[0][k] = c < mesh->box[0][k] ? c : mesh->box[0][k];
            mesh->box[1][k] = c > mesh->box[1][k] ? c : mesh->box[1][k];
        }
        side_q22[k] = carom_shl(mesh->box[1][k] - mesh->box[0][k], 22 - raw->quantum_bits);
        fits = fits && side_q22[k] <= (int64_t)256 << 22;
    }
    return fits && fix_length(side_q22) <= (int64_t)384 << 22 ? CAROM_OK : (int)CAROM_ERR_RANGE;
}

/*
 * Find all normals; those of a SURFACE must look up. Bounds: a difference of corners is < 2^16, a
 * component of the cross product < 2^33.
 */
static int find_normals(struct mesh_builder *b)
{
    const struct carom_mesh_raw *raw = &b->mesh->raw;
    uint32_t up = 0, down = 0;

    for (uint32_t f = 0; f < raw->face_count; f++) {
        const uint16_t *corner = raw->faces[f];
        int32_t side[2][3];
        int64_t n[3];

        for (int k = 0; k < 3; k++) {
            int32_t from = raw->vertices[corner[0]][k];

            side[0][k] = raw->vertices[corner[1]][k] - from;
            side[1][k] = raw->vertices[corner[2]][k] - from;
        }
        fix_cross(n, side[0], side[1]);
        if (!fix_normalise(&b->faces[f].normal, n)) {
            return CAROM_ERR_MESH_DEGENERATE;
        }
        up += n[2] > 0;
        down += n[2] < 0;
    }
    return raw->kind == CAROM_SOLID || up == raw->face_count ? CAROM_OK
           : down == raw->face_count                         ? CAROM_ERR_MESH_INSIDE_OUT
                                                             : CAROM_ERR_MESH_SURFACE;
}

/* -------------------------------------------------------------------- build */

/* The smallest sphere around the centre of mass that holds every vertex, rounded up. */
static int32_t find_radius(const struct carom_mesh *mesh)
{
    int64_t radius = 0;

    for (uint32_t v = 0; v < mesh->raw.vertex_count; v++) {
        carom_v3_q22 p = mesh_vertex(mesh, v);
        int64_t wide[3] = {p.c[0], p.c[1], p.c[2]};

        radius = mesh_longest(radius, wide);
    }
    return (int32_t)radius;
}

/* Find the offsets of all faces' planes from the centre of mass. */
static void find_offsets(struct mesh_builder *b)
{
    for (uint32_t f = 0; f < b->mesh->raw.face_count; f++) {
        carom_v3_q22 corner = mesh_corner(b->mesh, f, 0);

        b->faces[f].offset_q22 =
            (int32_t)carom_round(carom_dot(b->faces[f].normal.c, corner.c), 30);
    }
}

/* Contacts lie some skins off the mesh: 1 / REACH_DIVISOR of the radius covers that. */
#define REACH_DIVISOR 256

/* See carom_spread. */
static int reach_bits(const struct carom_mesh *mesh)
{
    int most = 0;

    for (int k = 0; k < 3; k++) {
        const int32_t *column = mesh->spread.column[k];
        const int64_t all[3] = {column[0], column[1], column[2]};
        int64_t off = fix_length_bound(all) * (mesh->radius_q22 / REACH_DIVISOR + 1), longest = 0;
        int bits;

        for (uint32_t v = 0; v < mesh->raw.vertex_count; v++) {
            carom_v3_q22 at = mesh_vertex(mesh, v);
            int64_t across[3], length;

            fix_cross(across, column, at.c);
            length = fix_length_bound(across);
            longest = length > longest ? length : longest;
        }
        bits = fix_bits((uint64_t)(longest + off)) - 22 - mesh->spread.e[k];
        most = bits > most ? bits : most;
    }
    return most;
}

/*
 * All steps of the build, in order. The block holds CAROM_MESH_BYTES, so no carve fails.
 * Orientation is reported after the edges, because it means nothing while a mesh is not closed.
 */
static int build(struct mesh_builder *b)
{
    struct carom_mesh *mesh = b->mesh;
    int error = check_corners(&mesh->raw), orientation;

    if (error) {
        return error;
    }
    error = find_box(mesh);
    if (error) {
        return error;
    }
    ARENA_CARVE(&b->arena, b->faces, mesh->raw.face_count);
    mesh->faces = b->faces;
    orientation = find_normals(b);
    if (orientation == CAROM_ERR_MESH_DEGENERATE) {
        return orientation;
    }
    error = mesh_build_edges(b);
    if (error) {
        return error;
    }
    if (orientation == CAROM_OK && mesh->raw.kind == CAROM_SOLID) {
        orientation = mass_of_mesh(&mesh->raw, &mesh->mass);
    }
    if (orientation) {
        return orientation;
    }
    find_offsets(b);
    mesh->radius_q22 = find_radius(mesh);
    /* a mesh too thin for an inverse may still be a stationary body */
    if (mass_invert(&mesh->mass.inertia, &mesh->inverse, &mesh->inverse_rest) == 0) {
        mass_spread(&mesh->mass.inertia, &mesh->spread);
        mesh->spread.reach_bits = (int8_t)reach_bits(mesh);
    }
    mesh_build_leaves(b);
    return mesh_build_zlists(b);
}

int mesh_refresh(struct mesh_builder *b)
{
    int error = find_box(b->mesh);

    if (error == CAROM_OK) {
        error = find_normals(b);
    }
    if (error == CAROM_OK) {
        mesh_shape_edges(b);
        find_offsets(b);
        b->mesh->radius_q22 = find_radius(b->mesh);
        mesh_shape_leaves(b);
    }
    return error;
}

int mesh_make(struct mesh_builder *b, struct carom_mesh *mesh, const struct carom_mesh_raw *raw,
              void *mem, size_t bytes)
{
    struct carom_mesh built;
    int error;

    if (!mesh || !raw || !raw->vertices || !raw->faces || !mem) {
        return CAROM_ERR_NULL;
    }
    error = check_header(raw);
    if (error) {
        return error;
    }
    if ((uintptr_t)mem % 8 || bytes < CAROM_MESH_BYTES(raw->vertex_count, raw->face_count)) {
        return CAROM_ERR_MEMORY;
    }
    memset(&built, 0, sizeof built);
    built.raw = *raw;
    b->mesh = &built;
    arena_init(&b->arena, mem, bytes);
    b->keys = (uint64_t *)mem + bytes / 8 - (size_t)3 * raw->face_count;
    error = build(b);
    b->mesh = mesh;
    if (error == CAROM_OK) {
        *mesh = built;
    }
    return error;
}

int carom_mesh_build(struct carom_mesh *mesh, const struct carom_mesh_raw *raw, void *mem,
                     size_t bytes)
{
    struct mesh_builder b;

    return mesh_make(&b, mesh, raw, mem, bytes);
}

int carom_mesh_check(const struct carom_mesh_raw *raw, void *scratch, size_t bytes)
{
    struct carom_mesh mesh;

    return carom_mesh_build(&mesh, raw, scratch, bytes);
}
