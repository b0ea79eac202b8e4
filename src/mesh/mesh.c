/* SPDX-License-Identifier: MIT */
/* Questions about a mesh that several stages ask. */
#include "../num/plane.h"
#include "build.h"

extern inline bool mesh_vertex_cone(const struct carom_mesh *mesh, uint32_t v,
                                    const int32_t n_q30[3], int32_t tolerance_q30);
extern inline carom_v3_q22 mesh_vertex(const struct carom_mesh *mesh, uint32_t v);

/* mesh_over_face, seen along an axis, along which the corners may run clockwise. */
static inline bool over_along(const struct carom_mesh *mesh, uint32_t face, const carom_v3_q22 *p,
                              int32_t tolerance_q22, int axis, bool clockwise)
{
    const int x = fix_next(axis), y = fix_next(x);
    const int32_t reach[2] = {tolerance_q22, tolerance_q22};
    int32_t one = (int32_t)1 << (22 - mesh->raw.quantum_bits);
    int32_t px = p->c[x] + mesh->mass.centre.c[x], py = p->c[y] + mesh->mass.centre.c[y];
    const uint16_t *corner = mesh->raw.faces[face];
    const int16_t *from = mesh->raw.vertices[corner[2]];

    /* edges in quanta, so that the products need no more than 48 bits */
    for (int k = 0; k < 3; k++) {
        const int16_t *to = mesh->raw.vertices[corner[k]];
        const int32_t edge[2] = {to[x] - from[x], to[y] - from[y]};
        const int32_t off[2] = {px - from[x] * one, py - from[y] * one};

        if (plane_outside(edge, off, reach, clockwise)) {
            return false;
        }
        from = to;
    }
    return true;
}

bool mesh_under(const struct carom_mesh *mesh, const carom_v3_q22 *p)
{
    int to_quanta = 22 - mesh->raw.quantum_bits;
    int32_t col = ((p->c[0] >> to_quanta) - mesh->grid_x0) >> mesh->grid_shift;
    int32_t row = ((p->c[1] >> to_quanta) - mesh->grid_y0) >> mesh->grid_shift;
    const struct carom_zref *r, *end;

    if (col < 0 || col >= mesh->grid_nx || row < 0 || row >= mesh->grid_ny) {
        return false;
    }
    r = &mesh->zrefs[mesh->cell_start[row * mesh->grid_nx + col]];
    end = &mesh->zrefs[mesh->cell_start[row * mesh->grid_nx + col + 1]];
    while (r < end && !over_along(mesh, r->face, p, 0, 2, false)) {
        r++;
    }
    return r < end && carom_dot(mesh->faces[r->face].normal.c, p->c) <
                          carom_shl(mesh->faces[r->face].offset_q22, 30);
}

/* The flag of an edge in `own` and `behind` of its face 0. */
static unsigned flag_of(const struct carom_mesh *mesh, uint32_t edge)
{
    const struct carom_face *face = &mesh->faces[mesh->edges[edge].face[0]];

    return face->edge[0] == edge ? 8 : face->edge[1] == edge ? 16 : 32;
}

bool mesh_edge_behind(const struct carom_mesh *mesh, uint32_t edge)
{
    return (mesh->faces[mesh->edges[edge].face[0]].behind & flag_of(mesh, edge)) != 0;
}

bool mesh_vertex_behind(const struct carom_mesh *mesh, uint32_t v)
{
    unsigned bent = 0;

    for (uint32_t i = mesh->ring_start[v]; i < mesh->ring_start[v + 1]; i++) {
        uint32_t edge = mesh->ring[i] >> 1;
        const struct carom_face *face = &mesh->faces[mesh->edges[edge].face[0]];

        if (face->own & flag_of(mesh, edge)) {
            return false;
        }
        bent |= face->behind & flag_of(mesh, edge);
    }
    return bent != 0;
}

bool mesh_vertex_below(const struct carom_mesh *mesh, uint32_t v, const int32_t n_q30[3],
                       int32_t tolerance_q30)
{
    const int32_t down_q30[3] = {-n_q30[0], -n_q30[1], -n_q30[2]};

    return mesh_vertex_cone(mesh, v, down_q30, tolerance_q30);
}

bool mesh_over_face(const struct carom_mesh *mesh, uint32_t face, const carom_v3_q22 *p,
                    int32_t tolerance_q22)
{
    const int32_t *n = mesh->faces[face].normal.c;
    const int axis = plane_axis(n);

    return over_along(mesh, face, p, tolerance_q22, axis, n[axis] <= 0);
}

int64_t mesh_longest(int64_t longest, const int64_t v[3])
{
    uint64_t limit = (uint64_t)(longest * longest), square = 0; /* 3 2^62 fits */
    int64_t length;

    for (int k = 0; k < 3; k++) {
        square += (uint64_t)(v[k] * v[k]);
    }
    if (square < limit - (limit >> 20)) {
        return longest;
    }
    length = fix_length(v);
    return length > longest ? length : longest;
}

size_t carom_mesh_bytes(uint32_t vertices, uint32_t faces)
{
    return CAROM_MESH_BYTES(vertices, faces);
}
