/* SPDX-License-Identifier: MIT */
/*
 * build - what the files that build a mesh share. Not for other stages.
 *
 * The block is filled from its start with what stays. A temporary work table lies at its end, where
 * the z-lists' entries, carved last, will be.
 */
#ifndef CAROM_SRC_MESH_BUILD_H
#define CAROM_SRC_MESH_BUILD_H

#include "../num/sort.h"
#include "mesh.h"

#define MESH_GRID_SIDE_MAX 32

struct mesh_builder {
    struct carom_mesh *mesh;
    struct arena arena;
    uint64_t *keys; /* the work table: 3 for each face */
    struct carom_face *faces;
    struct carom_edge *edges;
    struct carom_leaf *leaves;
};

/* carom_mesh_build; also sets the builder's pointers to faces, edges and leaves in the block. */
int mesh_make(struct mesh_builder *b, struct carom_mesh *mesh, const struct carom_mesh_raw *raw,
              void *mem, size_t bytes);

/*
 * Work out anew everything that depends on vertices' places, except z-lists. Returns CAROM_OK,
 * CAROM_ERR_RANGE, CAROM_ERR_MESH_DEGENERATE, _INSIDE_OUT or _SURFACE.
 */
int mesh_refresh(struct mesh_builder *b);

/*
 * The larger of `longest` and the length of v, |v| < 2^31 each. Takes no root if v is clearly
 * shorter, by more than lengths are rounded up.
 */
int64_t mesh_longest(int64_t longest, const int64_t v[3]);

/* Build edges, rings and owners. Returns CAROM_OK or CAROM_ERR_MESH_OPEN, _EDGE, _SURFACE. */
int mesh_build_edges(struct mesh_builder *b);

/* Set what depends on vertices' places: of edges, and who owns what. */
void mesh_shape_edges(struct mesh_builder *b);

/* Cut the faces into leaves. */
void mesh_build_leaves(struct mesh_builder *b);
/* Set what depends on vertices' places: spheres and slabs of leaves. */
void mesh_shape_leaves(struct mesh_builder *b);

/* Build the mesh's own z-lists. Returns CAROM_OK or CAROM_ERR_MESH_SURFACE. */
int mesh_build_zlists(struct mesh_builder *b);

#endif
