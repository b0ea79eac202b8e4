/* SPDX-License-Identifier: MIT */
/*
 * carom_mesh.h - meshes: the triangles that a caller has, and what is built of them. carom.h includes it, and the
 * rules at its top hold.
 */
#ifndef CAROM_MESH_H
#define CAROM_MESH_H

#include "carom_fix.h"

#ifdef __cplusplus
extern "C" {
#endif

enum carom_mesh_kind {
    CAROM_SOLID = 0,  /* closed, oriented outwards */
    CAROM_SURFACE = 1 /* a height field: open, one z over each x, y, solid below; stationary */
};

/*
 * A mesh as it comes from a converter: triangles over int16 vertices. One quantum, the step of a
 * vertex coordinate, is 2^-quantum_bits world units.
 */
struct carom_mesh_raw {
    const int16_t (*vertices)[3]; /* quanta */
    const uint16_t (*faces)[3];   /* vertex numbers, counter-clockwise from outside */
    uint32_t vertex_count;        /* 3 .. 65535 */
    uint32_t face_count;          /* 1 .. 65535 */
    uint8_t quantum_bits;         /* 7 .. 20 */
    uint8_t kind;                 /* enum carom_mesh_kind */
};

/* A symmetric 3 x 3 matrix: xx, yy, zz, xy, yz, zx, each times 2^-e. */
struct carom_sym3 {
    int32_t m[6];
    int32_t e;
};

/* Mass properties of a SOLID at density 1. */
struct carom_mass {
    int64_t volume_q32;        /* cubic units */
    carom_v3_q22 centre;       /* of mass, in the mesh's coordinates */
    struct carom_sym3 inertia; /* divided by the mass, about the centre of mass; square units */
};

/*
 * H with H H^T = J^-1, J being the inertia over the mass: three columns, each times its 2^-e, in 1 / units.
 * No place of the mesh, nor one within some skins of it, has a component of H_k x place above 2^reach_bits.
 */
struct carom_spread {
    int32_t column[3][3];
    int8_t e[3], reach_bits;
};

/* All up to carom_mesh is Carom's own: visible so that you can reserve room for it. */
struct carom_edge {
    uint16_t vertex[2];
    uint16_t face[2];       /* face[0] runs with the edge; face[1] is CAROM_NO_FACE at a border */
    carom_v3_q30 direction; /* from vertex[0] to vertex[1] */
    int32_t length_q22;
};
#define CAROM_NO_FACE 0xffffu

struct carom_face {
    carom_v3_q30 normal;
    int32_t offset_q22; /* of its plane along the normal, from the centre of mass */
    uint32_t edge[3];   /* edge k joins corners k and k+1 */
    uint8_t own;        /* bits 0-2: corner k is tested for this face; bits 3-5: edge k is */
};

/* A cluster of neighbouring faces: what interference detection culls first. */
#define CAROM_LEAF_FACES    14
#define CAROM_LEAF_VERTICES 32
struct carom_leaf {
    carom_v3_q22 centre; /* of a sphere around the leaf, about the centre of mass */
    int32_t radius_q22;
    carom_v3_q30 axis;         /* the mean normal of its faces, and how far it reaches */
    int32_t low_q22, high_q22; /* along that from the centre of mass */
    uint32_t owned;            /* its vertices that are tested for one of its faces, a bit each */
    uint32_t first_face;       /* into leaf_faces */
    uint32_t first_vertex;     /* into leaf_vertices */
    uint8_t face_count, vertex_count;
};

/* An entry of a mesh's own z-lists. */
struct carom_zref {
    int16_t z0, z1; /* quanta */
    uint16_t face;
};

struct carom_surface;

/* An indexed mesh, ready to be used by bodies of any world. Read only after the build. */
struct carom_mesh {
    struct carom_mesh_raw raw;
    struct carom_mass mass;                  /* SOLID; zero for a SURFACE */
    struct carom_sym3 inverse, inverse_rest; /* their sum: of mass.inertia; zero if it has none */
    struct carom_spread spread;              /* zero as well then */
    uint32_t edge_count, leaf_count, zref_count;
    int32_t radius_q22;       /* of the sphere around the centre of mass (SURFACE: the origin) */
    int16_t box[2][3];        /* quanta: lowest and highest corner */
    int32_t grid_x0, grid_y0; /* quanta: corner of the cell grid over x, y */
    uint8_t grid_shift, grid_nx, grid_ny; /* cells of 2^shift quanta */
    const struct carom_face *faces;
    const struct carom_edge *edges;
    const uint32_t *ring_start; /* vertex v's edges are ring[ring_start[v] .. ring_start[v+1]) */
    const uint32_t *ring; /* edge number * 2 + 1 when the edge ends at v, + 0 when it starts */
    const struct carom_leaf *leaves;
    const uint16_t *leaf_faces;
    const uint16_t *leaf_vertices;
    const uint8_t (*leaf_corners)[3]; /* a leaf face's corners as places in its leaf's vertices */
    const uint32_t *cell_start; /* cell c's entries are zrefs[cell_start[c] .. cell_start[c+1]) */
    const struct carom_zref *zrefs; /* sorted by z1, highest first */
    struct carom_surface *surface;  /* of carom_surface_build; else NULL */
};

/*
 * Memory that carom_mesh_build needs for any mesh of so many vertices and faces; a constant
 * expression and a multiple of 8, so that blocks can lie end to end. Derived in SPEC.md.
 */
#define CAROM_MESH_BYTES(vertices, faces) CAROM_MESH_BYTES_((size_t)(vertices), (size_t)(faces))
#define CAROM_MESH_BYTES_(v, f)                                                                    \
    (CAROM_ARRAY_(struct carom_face, f) +                                                          \
     CAROM_ARRAY_(struct carom_edge, CAROM_MESH_EDGES_(v, f)) + CAROM_ARRAY_(uint32_t, (v) + 1) +  \
     CAROM_ARRAY_(uint32_t, 2 * CAROM_MESH_EDGES_(v, f)) +                                         \
     CAROM_ARRAY_(struct carom_leaf, CAROM_MESH_LEAVES_(v, f)) + CAROM_ARRAY_(uint16_t, f) +       \
     CAROM_ARRAY_(uint16_t, CAROM_MESH_LEAF_VERTICES_(v, f)) + CAROM_ARRAY_(uint8_t, 3 * (f)) +    \
     CAROM_ARRAY_(uint32_t, CAROM_MESH_CELLS_(f) + 1) +                                            \
     CAROM_ARRAY_(struct carom_zref, CAROM_MESH_ENTRIES_(f)))
/* The most there may be of edges, of leaves and their vertices, of cells and of their entries. */
#define CAROM_MESH_EDGES_(v, f)                                                                    \
    CAROM_MORE_(3 * (f) / 2, CAROM_LESS_(3 * (f), 3 * (v)-6)) /* v is 3 or more */
#define CAROM_MESH_LEAVES_(v, f)                                                                   \
    (((f) + CAROM_LEAF_FACES - 1) / CAROM_LEAF_FACES * ((v) > CAROM_LEAF_VERTICES ? 2 : 1))
#define CAROM_MESH_LEAF_VERTICES_(v, f) CAROM_LESS_(3 * (f), (v)*CAROM_MESH_LEAVES_(v, f))
#define CAROM_MESH_CELLS_(f)            CAROM_LESS_(1024, 2 * (f) / 3 + 1)
#define CAROM_MESH_ENTRIES_(f)          (8 * (f))
#define CAROM_ARRAY_(type, n)           (((n) * sizeof(type) + 7) / 8 * 8)
#define CAROM_LESS_(a, b)               ((a) < (b) ? (a) : (b))
#define CAROM_MORE_(a, b)               ((a) > (b) ? (a) : (b))

/* The same where the counts are known only at run time. */
size_t carom_mesh_bytes(uint32_t vertices, uint32_t faces);

/*
 * Whether a raw mesh can be built: what carom_mesh_build would return.
 *   scratch  CAROM_MESH_BYTES(vertices, faces) bytes, aligned to 8; overwritten
 */
int carom_mesh_check(const struct carom_mesh_raw *raw, void *scratch, size_t bytes);

/*
 * Check and index a mesh: edges, planes, bounds, clusters, mass and its own z-lists.
 *
 *   mesh   out  ready to use; refers to raw's arrays and to mem
 *   raw    in   its arrays must outlive the mesh
 *   mem    in   CAROM_MESH_BYTES(vertices, faces) bytes, aligned to 8; overwritten
 *
 * Returns  CAROM_OK; CAROM_ERR_ARGUMENT for kind or quantum_bits; CAROM_ERR_MEMORY;
 *          CAROM_ERR_RANGE for a box with a side over 256 or a diagonal over 384 units, or one that
 *          winds around itself so often that its volume does not fit;
 *          or the first CAROM_ERR_MESH_... that holds. mesh is written only for CAROM_OK.
 */
int carom_mesh_build(struct carom_mesh *mesh, const struct carom_mesh_raw *raw, void *mem,
                     size_t bytes);

/*
 * A SURFACE whose vertices may be moved while it is in a world, by carom_surface_move. As
 * carom_mesh_build, but
 *
 *   mesh   must stay where it is; for one body of one world
 *   raw    its vertices are copied and not needed any more; its faces must outlive the mesh
 *   mem    CAROM_SURFACE_BYTES(vertices, faces) bytes of RAM: what is built and two copies of the
 *          vertices live in it
 *
 * Returns  CAROM_ERR_ARGUMENT for a SOLID as well.
 */
#define CAROM_SURFACE_BYTES(vertices, faces)                                                       \
    (CAROM_MESH_BYTES(vertices, faces) + ((size_t)12 * (size_t)(vertices) + 80 + 7) / 8 * 8)
int carom_surface_build(struct carom_mesh *mesh, const struct carom_mesh_raw *raw, void *mem,
                        size_t bytes);

/*
 * Read a mesh from the binary blob that the mesh converter writes (layout: SPEC.md).
 *   mem  receives vertices and faces: CAROM_BLOB_BYTES(vertices, faces) bytes, aligned to 8
 * Returns CAROM_OK; CAROM_ERR_FORMAT for a blob that is truncated or altered; CAROM_ERR_MEMORY.
 */
#define CAROM_BLOB_BYTES(vertices, faces)                                                          \
    ((size_t)6 * (size_t)(vertices) + (size_t)6 * (size_t)(faces) + 16)
int carom_mesh_read(struct carom_mesh_raw *raw, const void *blob, size_t blob_bytes, void *mem,
                    size_t bytes);

#ifdef __cplusplus
}
#endif

#endif
