/* SPDX-License-Identifier: MIT */
/*
 * Is a body inside another one, or below a SURFACE? The winding number of one vertex answers, if no
 * faces of the two cross.
 */
#include "../num/plane.h"
#include "narrow.h"

/* Place a's first vertex in b's mesh, q22 from its origin. Returns false if it does not fit. */
static bool place_probe(carom_v3_q22 *out, struct interfere_placed a, struct interfere_placed b)
{
    const struct carom_mesh *mb = b.body->def.mesh;
    carom_v3_q22 v = mesh_vertex(a.body->def.mesh, 0);
    int64_t p_q32[3];
    carom_m3_q30 r;

    for (int k = 0; k < 3; k++) {
        p_q32[k] = carom_shl(v.c[k], 10);
    }
    fix_matrix(&r, &a.state->rotation);
    fix_rotate(p_q32, &r, p_q32);
    for (int k = 0; k < 3; k++) {
        p_q32[k] += a.state->position.c[k] - b.state->position.c[k];
    }
    fix_matrix(&r, &b.state->rotation);
    fix_rotate_back(p_q32, &r, p_q32);
    for (int k = 0; k < 3; k++) {
        p_q32[k] += carom_shl(mb->mass.centre.c[k], 10);
        if (carom_abs(p_q32[k]) >= (int64_t)256 << 32) {
            return false; /* meshes are within 256 units */
        }
        out->c[k] = (int32_t)(p_q32[k] >> 10);
    }
    return true;
}

/* For a face above the point: 1 if it looks up, -1 if it looks down. 0 for any other face. */
static int face_over(const struct carom_mesh *mesh, uint16_t face, const carom_v3_q22 *p)
{
    carom_v3_q22 corner[3], d;
    int64_t height;
    int side;

    for (int k = 0; k < 3; k++) {
        const int16_t *quanta = mesh->raw.vertices[mesh->raw.faces[face][k]];

        for (int i = 0; i < 3; i++) {
            corner[k].c[i] = quanta[i] * ((int32_t)1 << (22 - mesh->raw.quantum_bits));
        }
    }
    side = plane_over(corner[0].c, corner[1].c, corner[2].c, p->c);
    if (side == 0) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        d.c[k] = p->c[k] - corner[0].c[k];
    }
    height = carom_dot(mesh->faces[face].normal.c, d.c);
    return (side > 0 ? height < 0 : height > 0) ? side : 0;
}

/* Winding number: upward minus downward faces above a point, from the z-list of its cell. */
static int winding_at(const struct carom_mesh *mesh, const carom_v3_q22 *p)
{
    int to_quanta = 22 - mesh->raw.quantum_bits, winding = 0;
    int32_t col = ((p->c[0] >> to_quanta) - mesh->grid_x0) >> mesh->grid_shift;
    int32_t row = ((p->c[1] >> to_quanta) - mesh->grid_y0) >> mesh->grid_shift;
    const struct carom_zref *r, *end;
    uint32_t cell;

    if (col < 0 || col >= mesh->grid_nx || row < 0 || row >= mesh->grid_ny) {
        return 0;
    }
    cell = (uint32_t)(row * mesh->grid_nx + col);
    end = &mesh->zrefs[mesh->cell_start[cell + 1]];
    for (r = &mesh->zrefs[mesh->cell_start[cell]]; r < end && r->z1 >= p->c[2] >> to_quanta; r++) {
        winding += face_over(mesh, r->face, p);
    }
    return winding;
}

/* winding_at over all faces, for a mesh whose own z-lists are out of date. */
static int winding_of_all(const struct carom_mesh *mesh, const carom_v3_q22 *p)
{
    int winding = 0;

    for (uint32_t face = 0; face < mesh->raw.face_count; face++) {
        winding += face_over(mesh, (uint16_t)face, p);
    }
    return winding;
}

bool interfere_inside(struct interfere_placed a, struct interfere_placed b)
{
    const struct carom_mesh *mb = b.body->def.mesh;
    carom_v3_q22 p;

    return place_probe(&p, a, b) &&
           (mesh_lists_in_step(mb) ? winding_of_all(mb, &p) : winding_at(mb, &p)) > 0;
}
