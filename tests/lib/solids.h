/* SPDX-License-Identifier: MIT */
/*
 * solids - posed meshes in double precision: distances and normal cones of their features, computed from all faces.
 * The oracle of interference detection.
 */
#ifndef CAROM_TEST_SOLIDS_H
#define CAROM_TEST_SOLIDS_H

#include "shapes.h"

#define SOLID_EDGES 1800

/* A box along the axes of the world, in whole numbers, because boards compare these faster. */
struct solid_bounds {
    int64_t low_q22[3], high_q22[3];
};

/* A shape in world axes. */
struct solid {
    struct shape *shape;
    double p[SHAPE_VERTICES][3];
    double normal[SHAPE_FACES][3];
    struct solid_bounds vertex[SHAPE_VERTICES], face[SHAPE_FACES], edge[SOLID_EDGES];
    bool own_vertex[SHAPE_VERTICES], own_edge[SOLID_EDGES]; /* the features that the mesh tests */
    bool behind[SOLID_EDGES]; /* edges that are tested against bodies behind the mesh alone */
};

/* Note which features a new shape owns. */
void solid_note_owned(struct solid *s);
void solid_place(struct solid *s, const struct body_state *state);

/* Whether a vertex is within the reach of a face, or two edges of each other. */
bool solid_vertex_near(const struct solid *from, uint32_t vertex, const struct solid *to,
                       uint32_t face, int64_t reach_q22);
bool solid_edges_near(const struct solid *a, uint32_t i, const struct solid *b, uint32_t j,
                      int64_t reach_q22);

/* Whether no edge of the vertex goes down along n by more than the tolerance, a cosine. */
bool solid_vertex_cone(const struct solid *s, uint32_t vertex, const double n[3], double tolerance);

/*
 * Whether the normal of two edges, or its opposite, lies in the cones of both. If b's edge bends
 * inwards it must lead behind b and into a, not only within the tolerance.
 */
bool solid_edge_cones(const struct solid *a, uint32_t i, const struct solid *b, uint32_t j,
                      double tolerance);

#endif
