/* SPDX-License-Identifier: MIT */
/*
 * mesh - check a mesh, and index it for everything that later stages ask (the paper's object data,
 * section 1).
 *
 * In: vertices, faces, kind. Out: struct carom_mesh in the caller's block.
 *
 * Steps, and the files that hold them:
 *   build.c    carom_mesh_build: all steps in order; box, normals, radius
 *   edge.c     edges, the ring of edges at each vertex, which face owns which feature
 *   mass.c     volume, centre of mass, inertia
 *   leaves.c   leaves: clusters of faces, each with a sphere and a slab
 *   grid.c     the grid of cells and the mesh's own z-lists
 *   scan.c     cells that a face touches
 *   zlist.c    z-lists in a pool, and intervals of z
 *   surface.c  surfaces whose vertices move
 *   mesh.c     questions about a mesh that later stages share
 *
 * Beside it: blob.c (the binary form), shapes.c (boxes, spheres and the like).
 */
#ifndef CAROM_SRC_MESH_H
#define CAROM_SRC_MESH_H

#include "carom.h"
#include "mass.h"
#include "zlist.h"

/* Vertex v relative to the centre of mass, exact. */
inline carom_v3_q22 mesh_vertex(const struct carom_mesh *mesh, uint32_t v)
{
    const int16_t *quanta = mesh->raw.vertices[v];
    const int32_t *centre = mesh->mass.centre.c, one = (int32_t)1 << (22 - mesh->raw.quantum_bits);

    return (carom_v3_q22){
        {quanta[0] * one - centre[0], quanta[1] * one - centre[1], quanta[2] * one - centre[2]}};
}

struct body;
struct interfere;
struct interfere_area;
struct interfere_place;
struct pair;

/*
 * Functions of a surface that may move. A step calls them through the surface, so that a program
 * without such surfaces does not link it: mesh_drift_vertex, mesh_drift_edge, mesh_drift_face,
 * mesh_list_face (below), interfere_area_under, interfere_make_lists.
 */
struct mesh_moving {
    void (*drift_vertex)(const struct carom_mesh *mesh, uint32_t v, carom_v3_q40 *out);
    void (*drift_edge)(const struct carom_mesh *mesh, uint32_t edge, const carom_v3_q22 *at,
                       carom_v3_q40 *out);
    void (*drift_face)(const struct carom_mesh *mesh, uint32_t face, const carom_v3_q22 *at,
                       carom_v3_q40 *out);
    bool (*list_face)(const struct carom_mesh *mesh, uint32_t face, struct zlist *lists,
                      uint32_t *cells);
    struct interfere_area (*area_under)(const struct body *bodies, const struct pair *pairs,
                                        uint32_t pair_count, uint16_t b);
    /* NULL: the surface keeps z-lists of its own, made anew with each move; no step makes any */
    bool (*make_lists)(struct interfere *in, const struct carom_mesh *mesh,
                       const struct interfere_area *area, struct interfere_place *from);
};

/* A surface whose vertices the caller may move; behind its mesh in the caller's block. */
struct carom_surface {
    const struct mesh_moving *does;
    struct carom_mesh *mesh;
    int16_t (*now)[3];    /* its present vertices */
    int16_t (*before)[3]; /* its vertices when the last step ended */
    struct carom_face *faces;
    struct carom_edge *edges;
    struct carom_leaf *leaves;
    uint32_t *lists;  /* room for z-lists of its own */
    int32_t most_q22; /* bound on any vertex's displacement since `before` */
    uint32_t moves;   /* counts the moves */
};

/* carom_surface_build with the table of functions of the surface. */
int mesh_surface_build(struct carom_mesh *mesh, const struct carom_mesh_raw *raw, void *mem,
                       size_t bytes, const struct mesh_moving *does);

/*
 * Give the mesh other vertices, on trial: mesh_surface_keep accepts them, mesh_surface_undo goes
 * back.
 *
 *   drifts  the surface moves there, by at most MESH_STEP_MAX units; else it is put there
 *   rise    out  bound on how much higher the surface is than before, anywhere; 0 or above
 *
 * Returns CAROM_OK, CAROM_ERR_RANGE for a step of more than MESH_STEP_MAX units or too large a box,
 * CAROM_ERR_MESH_DEGENERATE, _INSIDE_OUT or _SURFACE; then nothing has changed.
 */
#define MESH_STEP_MAX 16
int mesh_surface_try(struct carom_surface *s, const int16_t (*vertices)[3], bool drifts,
                     int64_t *rise_q22);
void mesh_surface_keep(struct carom_surface *s);
void mesh_surface_undo(struct carom_surface *s);

/* End the surface's motion: it stands still where it is. */
void mesh_surface_halt(struct carom_surface *s);

/* True if steps make the mesh's z-lists: its own ones are those of the shape it was built with. */
static inline bool mesh_lists_in_step(const struct carom_mesh *mesh)
{
    return mesh->surface && mesh->surface->does->make_lists;
}

/*
 * True if bodies touch the mesh from both sides: a SURFACE whose vertices cannot move. Its other
 * side has no features of its own; the side that a touch is on follows from the other body's ones.
 */
static inline bool mesh_two_sided(const struct carom_mesh *mesh)
{
    return mesh->raw.kind == CAROM_SURFACE && !mesh->surface;
}

/* Bound on any vertex's displacement since the last step; 0 for a mesh that cannot move. */
static inline int32_t mesh_drift_most(const struct carom_mesh *mesh)
{
    return mesh->surface ? mesh->surface->most_q22 : 0;
}

/*
 * The displacement of a vertex, a place on an edge or a place on a face since the last step, in the
 * mesh's axes. A place not on the feature counts as the feature's nearest.
 */
void mesh_drift_vertex(const struct carom_mesh *mesh, uint32_t v, carom_v3_q40 *out);
void mesh_drift_edge(const struct carom_mesh *mesh, uint32_t edge, const carom_v3_q22 *at,
                     carom_v3_q40 *out);
void mesh_drift_face(const struct carom_mesh *mesh, uint32_t face, const carom_v3_q22 *at,
                     carom_v3_q40 *out);

/* Start the walk over the cells of the mesh's grid that a face touches. */
void mesh_scan_face(struct scan_cells *s, const struct carom_mesh *mesh, uint32_t face);
/* A face in the form that z-lists take. */
struct zface mesh_zface(const struct carom_mesh *mesh, uint32_t face);
/*
 * Enter a face in z-lists, in its cells from number `cells` on. Returns false if the pool is full,
 * with `cells` the number of cells done.
 */
bool mesh_list_face(const struct carom_mesh *mesh, uint32_t face, struct zlist *lists,
                    uint32_t *cells);

/* The grid of the mesh's own z-lists. */
static inline struct scan_grid mesh_grid(const struct carom_mesh *mesh)
{
    struct scan_grid grid = {mesh->grid_x0, mesh->grid_y0, mesh->grid_shift, mesh->grid_nx,
                             mesh->grid_ny};

    return grid;
}

/* Corner k of a face, about the centre of mass. */
static inline carom_v3_q22 mesh_corner(const struct carom_mesh *mesh, uint32_t face, int k)
{
    return mesh_vertex(mesh, mesh->raw.faces[face][k]);
}

/*
 * The unit vector in the plane of one of an edge's two faces that is square to the edge and points
 * into the face, which must be there.
 */
static inline carom_v3_q30 mesh_edge_inward(const struct carom_mesh *mesh,
                                            const struct carom_edge *edge, int side)
{
    const int32_t *n = mesh->faces[edge->face[side]].normal.c;
    carom_v3_q30 in = {{0, 0, 0}};

    CAROM_ASSERT(edge->face[side] != CAROM_NO_FACE);
    /* face 0 runs along the edge, face 1 against it */
    if (side == 0) {
        carom_cross(in.c, n, edge->direction.c, 30);
    } else {
        carom_cross(in.c, edge->direction.c, n, 30);
    }
    return in;
}

/*
 * True if a point lies over a face, seen along the largest axis of its normal, or beyond its border
 * by at most the tolerance times 1 to sqrt 2. Range: p within 512 units of the mesh's origin.
 */
bool mesh_over_face(const struct carom_mesh *mesh, uint32_t face, const carom_v3_q22 *p,
                    int32_t tolerance_q22);

/*
 * True if n lies in the normal cone of a vertex: no edge that leaves the vertex descends along n by
 * more than the tolerance, a cosine. (Then the body lies above a plane of normal n through the
 * vertex.)
 */
inline bool mesh_vertex_cone(const struct carom_mesh *mesh, uint32_t v, const int32_t n_q30[3],
                             int32_t tolerance_q30)
{
    int64_t low_q60 = -((int64_t)tolerance_q30 << 30);

    for (uint32_t i = mesh->ring_start[v]; i < mesh->ring_start[v + 1]; i++) {
        int64_t rise_q60 = carom_dot(mesh->edges[mesh->ring[i] >> 1].direction.c, n_q30);

        if ((mesh->ring[i] & 1 ? -rise_q60 : rise_q60) < low_q60) {
            return false;
        }
    }
    return true;
}

/* True if a point, from the mesh's origin, is under a SURFACE whose vertices do not move. */
bool mesh_under(const struct carom_mesh *mesh, const carom_v3_q22 *p);

/* True if only a body behind the mesh can touch an edge or a vertex: see `behind` of carom_face. */
bool mesh_edge_behind(const struct carom_mesh *mesh, uint32_t edge);
bool mesh_vertex_behind(const struct carom_mesh *mesh, uint32_t v);

/* True if -n lies in the normal cone of a vertex: the body lies below a plane of normal n there. */
bool mesh_vertex_below(const struct carom_mesh *mesh, uint32_t v, const int32_t n_q30[3],
                       int32_t tolerance_q30);

#endif
