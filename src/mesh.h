/* SPDX-License-Identifier: MIT */
/*
 * mesh - check and index a mesh: edges, planes, bounds, clusters, mass and its own z-lists.
 */
#ifndef CAROM_SRC_MESH_H
#define CAROM_SRC_MESH_H

#include "carom.h"
#include "mass.h"
#include "zlist.h"

/* Vertex v relative to the centre of mass, exact. */
static inline carom_v3_q22 mesh_vertex(const struct carom_mesh *mesh, uint32_t v)
{
    const int16_t *quanta = mesh->raw.vertices[v];
    carom_v3_q22 p;

    for (int k = 0; k < 3; k++) {
        p.c[k] = (int32_t)carom_shl(quanta[k], 22 - mesh->raw.quantum_bits) -
                 mesh->mass.centre.c[k];
    }
    return p;
}

/* The grid of the mesh's own z-lists. */
static inline struct scan_grid mesh_grid(const struct carom_mesh *mesh)
{
    struct scan_grid grid = {mesh->grid_x0, mesh->grid_y0, mesh->grid_shift, mesh->grid_nx,
                             mesh->grid_ny};

    return grid;
}

#endif
