/* SPDX-License-Identifier: MIT */
/**
 * @file
 * Meshes: the triangles of the caller, and the index that is built from them. carom.h includes this header. @ref rules
 * hold.
 */
#ifndef CAROM_MESH_H
#define CAROM_MESH_H

#include "carom_fix.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup meshes Meshes
 * Build a mesh from triangles, or read one that the converter wrote.
 *
 * carom_shapes.h makes boxes, spheres and the like; build/tools/carom-mesh converts files. A built mesh serves bodies
 * of any number of worlds.
 * @{
 */

/** Kinds of meshes. */
enum carom_mesh_kind {
    CAROM_SOLID = 0,  /**< closed and oriented outwards */
    CAROM_SURFACE = 1 /**< a height field: open, one z over each x, y; stationary */
};

/** Triangles over int16 vertices, as the converter or the caller makes them. */
struct carom_mesh_raw {
    const int16_t (*vertices)[3]; /**< coordinates, quanta */
    const uint16_t (*faces)[3];   /**< vertex numbers, counter-clockwise from outside */
    uint32_t vertex_count;        /**< 3 to 65535 */
    uint32_t face_count;          /**< 1 to 65535 */
    uint8_t quantum_bits;         /**< a quantum is 2^-quantum_bits world units; 7 to 20 */
    uint8_t kind;                 /**< #carom_mesh_kind */
};

/** @} */
/**
 * @defgroup mesh_index The index of a mesh
 * The result of carom_mesh_build(). It is Carom's own: visible so that the caller can reserve room for it.
 * @{
 */

/** A symmetric 3 x 3 matrix: xx, yy, zz, xy, yz, zx, each times 2^-e. */
struct carom_sym3 {
    int32_t m[6]; /**< xx, yy, zz, xy, yz, zx */
    int32_t e;    /**< exponent of them all */
};

/** Mass properties of a SOLID at density 1. */
struct carom_mass {
    int64_t volume_q32;        /**< cubic units */
    carom_v3_q22 centre;       /**< centre of mass, in the mesh's coordinates, units */
    struct carom_sym3 inertia; /**< inertia about the centre of mass, over the mass, square units */
};

/**
 * H with H H^T = J^-1, where J is the inertia over the mass.
 *
 * No place of the mesh, nor within some skins of it, has a component of H_k x place above 2^reach_bits.
 */
struct carom_spread {
    int32_t column[3][3]; /**< the three columns of H, 1 / units; column k times 2^-e[k] */
    int8_t e[3];          /**< exponent of each column */
    int8_t reach_bits;    /**< bound of H_k x place */
};

/** An edge of a mesh. */
struct carom_edge {
    uint16_t vertex[2]; /**< first and last vertex */
    /** face[0] runs with the edge; face[1] against it, #CAROM_NO_FACE at a border */
    uint16_t face[2];
    carom_v3_q30 direction; /**< unit vector from vertex[0] to vertex[1] */
    int32_t length_q22;     /**< units */
};
/** In place of a face: an edge at a border has no second one. */
#define CAROM_NO_FACE 0xffffu

/** A face of a mesh. */
struct carom_face {
    carom_v3_q30 normal; /**< unit normal, outwards */
    int32_t offset_q22;  /**< of its plane along the normal, from the centre of mass, units */
    uint32_t edge[3];    /**< edge k joins corners k and k+1 */
    /** bits 0-2: the face owns corner k; bits 3-5: edge k. The owner emits its candidates */
    uint8_t own;
    /**
     * the same bits for features that only a body behind the surface can touch: an edge that bends inwards, and a
     * vertex all of whose edges are flat or bend inwards
     */
    uint8_t behind;
};

/** Most faces of a leaf. */
#define CAROM_LEAF_FACES 14
/** Most vertices of a leaf. */
#define CAROM_LEAF_VERTICES 32
/** A leaf: a cluster of neighbouring faces, the first that interference detection culls. */
struct carom_leaf {
    carom_v3_q22 centre; /**< centre of a sphere around the leaf, from the centre of mass, units */
    int32_t radius_q22;  /**< radius of that sphere, units */
    carom_v3_q30 axis;   /**< mean normal of the faces */
    /** least coordinate of the leaf along the axis, from the centre of mass, units */
    int32_t low_q22;
    int32_t high_q22;      /**< largest one */
    uint32_t owned;        /**< a bit for each vertex that one of the leaf's faces owns */
    uint32_t first_face;   /**< index into leaf_faces */
    uint32_t first_vertex; /**< index into leaf_vertices */
    uint8_t face_count;    /**< 1 to #CAROM_LEAF_FACES */
    uint8_t vertex_count;  /**< 3 to #CAROM_LEAF_VERTICES */
};

/** An entry of a mesh's z-lists: a face over a cell. */
struct carom_zref {
    int16_t z0;    /**< lowest z of the face, quanta */
    int16_t z1;    /**< highest z of the face, quanta */
    uint16_t face; /**< face number */
};

struct carom_surface;

/** An indexed mesh. Nothing writes to it after the build, except carom_surface_move(). */
struct carom_mesh {
    struct carom_mesh_raw raw;      /**< the triangles */
    struct carom_mass mass;         /**< mass properties of a SOLID; zero for a SURFACE */
    struct carom_sym3 inverse;      /**< inverse of mass.inertia; zero if it has none */
    struct carom_sym3 inverse_rest; /**< the exact inverse less `inverse` */
    struct carom_spread spread;     /**< root of the inverse; zero if it has none */
    uint32_t edge_count;            /**< edges */
    uint32_t leaf_count;            /**< leaves */
    uint32_t zref_count;            /**< entries of all z-lists */
    int32_t radius_q22; /**< of a sphere around the centre of mass (SURFACE: the origin), units */
    int16_t box[2][3];  /**< lowest and highest corner, quanta */
    int32_t grid_x0;    /**< corner of the cell grid over x and y, quanta */
    int32_t grid_y0;    /**< the same in y */
    uint8_t grid_shift; /**< a cell is 2^grid_shift quanta wide */
    uint8_t grid_nx;    /**< cells along x */
    uint8_t grid_ny;    /**< cells along y */
    const struct carom_face *faces; /**< faces */
    const struct carom_edge *edges; /**< edges */
    /** the edges of vertex v are ring[ring_start[v]..ring_start[v+1]) */
    const uint32_t *ring_start;
    const uint32_t *ring;            /**< edge number * 2, + 1 if the edge ends at the vertex */
    const struct carom_leaf *leaves; /**< leaves */
    const uint16_t *leaf_faces;      /**< face numbers, leaf by leaf */
    const uint16_t *leaf_vertices;   /**< vertex numbers, leaf by leaf */
    /** corners of a leaf's faces, as indices into the leaf's vertices */
    const uint8_t (*leaf_corners)[3];
    /** the entries of cell c are zrefs[cell_start[c]..cell_start[c+1]) */
    const uint32_t *cell_start;
    const struct carom_zref *zrefs; /**< entries, each list sorted by z1, highest first */
    struct carom_surface *surface;  /**< of carom_surface_build(); otherwise NULL */
};

/** @} */

/**
 * @addtogroup meshes
 * @{
 */

/**
 * Bytes that carom_mesh_build() needs for any mesh of so many vertices and faces.
 *
 * A constant expression and a multiple of 8, so blocks can lie end to end. SPEC.md derives it.
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
/* Upper bounds: edges, leaves and their vertices, cells and their entries. */
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

/** As #CAROM_MESH_BYTES, for counts known only at run time. */
size_t carom_mesh_bytes(uint32_t vertices, uint32_t faces);

/**
 * Check if a mesh can be built.
 *
 * @param raw      the mesh
 * @param scratch  aligned to 8; overwritten
 * @param bytes    size of `scratch`, at least #CAROM_MESH_BYTES of the mesh
 * @return what carom_mesh_build() would return
 */
int carom_mesh_check(const struct carom_mesh_raw *raw, void *scratch, size_t bytes);

/**
 * Check and index a mesh: edges, planes, bounds, leaves, mass and z-lists.
 *
 * @param[out] mesh  ready to use; refers to the arrays of `raw` and to `mem`, which outlive it
 * @param raw        the triangles
 * @param mem        aligned to 8; holds the index
 * @param bytes      size of `mem`, at least #CAROM_MESH_BYTES of the mesh
 * @return CAROM_OK; CAROM_ERR_ARGUMENT for `kind` or `quantum_bits`; CAROM_ERR_MEMORY;
 *         CAROM_ERR_RANGE for a box with a side over 256 or a diagonal over 384 units, or a mesh that winds around
 *         itself so often that its volume does not fit;
 *         or the first CAROM_ERR_MESH_... that holds. `mem` is overwritten even then.
 */
int carom_mesh_build(struct carom_mesh *mesh, const struct carom_mesh_raw *raw, void *mem,
                     size_t bytes);

/** Bytes that carom_surface_build() needs. A constant expression and a multiple of 8. */
#define CAROM_SURFACE_BYTES(vertices, faces)                                                       \
    (CAROM_MESH_BYTES(vertices, faces) + ((size_t)12 * (size_t)(vertices) + 80 + 7) / 8 * 8)

/**
 * Build a SURFACE whose vertices may move while it is in a world: carom_surface_move().
 *
 * It stops bodies from above only; one of carom_mesh_build() stops them from both sides.
 *
 * @param[out] mesh  must stay where it is; for one body of one world
 * @param raw        its vertices are copied; its faces must outlive the mesh
 * @param mem        aligned to 8, in RAM: holds the index and two copies of the vertices
 * @param bytes      size of `mem`, at least #CAROM_SURFACE_BYTES of the mesh
 * @return as carom_mesh_build(); CAROM_ERR_ARGUMENT for a SOLID too
 */
int carom_surface_build(struct carom_mesh *mesh, const struct carom_mesh_raw *raw, void *mem,
                        size_t bytes);

/** Bytes that carom_mesh_read() needs. */
#define CAROM_BLOB_BYTES(vertices, faces)                                                          \
    ((size_t)6 * (size_t)(vertices) + (size_t)6 * (size_t)(faces) + 16)

/**
 * Read a mesh from the binary blob that the mesh converter writes. SPEC.md has the layout.
 *
 * @param[out] raw    the mesh; refers to `mem`
 * @param blob        the blob; not needed after the call
 * @param blob_bytes  its size
 * @param mem         aligned to 8; receives vertices and faces
 * @param bytes       size of `mem`, at least #CAROM_BLOB_BYTES of the mesh
 * @return CAROM_OK; CAROM_ERR_FORMAT for a blob that is cut or altered; CAROM_ERR_MEMORY
 */
int carom_mesh_read(struct carom_mesh_raw *raw, const void *blob, size_t blob_bytes, void *mem,
                    size_t bytes);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
