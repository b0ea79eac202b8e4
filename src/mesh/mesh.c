/* SPDX-License-Identifier: MIT */
/* Questions about a mesh that several stages ask. */
#include "build.h"

extern inline bool mesh_vertex_cone(const struct carom_mesh *mesh, uint32_t v,
                                    const int32_t n_q30[3], int32_t tolerance_q30);
extern inline carom_v3_q22 mesh_vertex(const struct carom_mesh *mesh, uint32_t v);

bool mesh_over_face(const struct carom_mesh *mesh, uint32_t face, const carom_v3_q22 *p,
                    int32_t tolerance_q22)
{
    const int32_t *n = mesh->faces[face].normal.c;
    int32_t nx = fix_abs32(n[0]), ny = fix_abs32(n[1]), nz = fix_abs32(n[2]);
    int axis = nx > ny ? (nx > nz ? 0 : 2) : (ny > nz ? 1 : 2);
    int x = axis == 2 ? 0 : axis + 1, y = axis == 0 ? 2 : axis - 1;
    int32_t one = (int32_t)1 << (22 - mesh->raw.quantum_bits);
    int32_t px = p->c[x] + mesh->mass.centre.c[x], py = p->c[y] + mesh->mass.centre.c[y];
    const uint16_t *corner = mesh->raw.faces[face];
    const int16_t *from = mesh->raw.vertices[corner[2]];

    /* edges in quanta, so that the products need no more than 48 bits */
    for (int k = 0; k < 3; k++) {
        const int16_t *to = mesh->raw.vertices[corner[k]];
        int32_t ex = to[x] - from[x], ey = to[y] - from[y];
        int64_t side = (int64_t)ex * (py - from[y] * one) - (int64_t)ey * (px - from[x] * one);

        if ((n[axis] > 0 ? side : -side) <
            -(int64_t)(fix_abs32(ex) + fix_abs32(ey)) * tolerance_q22) {
            return false;
        }
        from = to;
    }
    return true;
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
