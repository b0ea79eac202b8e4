/* SPDX-License-Identifier: MIT */
/*
 * crossing - which faces of two placed meshes have a point in common, by trying all in exact
 * arithmetic: what queries are held against. Shares no code with the engine.
 *
 * Corners are carried into the world in double precision and rounded once, to q22. From then on all
 * is whole numbers: the answer is that of the rounded corners, and they are within one unit of q22 of
 * the true ones.
 */
#ifndef CAROM_TEST_CROSSING_H
#define CAROM_TEST_CROSSING_H

#include "carom.h"

/*
 * Whether two triangles have a point in common; touching counts, and so do overlaps in one plane. A
 * triangle without area has nothing in common with any.
 * Range: |p|, |q| < 2^28
 */
bool crossing_triangles(const int32_t p[3][3], const int32_t q[3][3]);

/* A face in a pose, and its box. */
struct crossing_face {
    int32_t p_q22[3][3];
    int32_t low_q22[3], high_q22[3];
    uint32_t number;
};

/* A mesh in a pose. The caller gives the memory, for every vertex and every face. */
struct crossing_body {
    const struct carom_mesh *mesh;
    int32_t (*p_q22)[3];
    struct crossing_face *near; /* those that meet the box of the other body */
};

/* Carry a mesh into the world, seen from `origin`; it must be within 64 units of that. */
void crossing_place(struct crossing_body *body, const carom_v3_q32 *position,
                    const carom_quat_q30 *rotation, const carom_v3_q32 *origin);

/* What came of comparisons, added up. */
struct crossing_tally {
    uint32_t poses, touching; /* touching: poses with crossing pairs */
    uint32_t crossing;        /* pairs that have a point in common */
    uint32_t found;           /* pairs that the query found */
    uint32_t missed, repeated;
};

/*
 * Hold the pairs of a query against all there are.
 *   bits  a bit for each pair of faces, all 0; left so
 */
void crossing_compare(struct crossing_body *a, struct crossing_body *b,
                      const struct carom_face_pair *found, uint32_t count, uint8_t *bits,
                      struct crossing_tally *tally);
/* A convex body in doubles: its corners, and the directions that can part it from another. */
#define CROSSING_CORNERS 16
#define CROSSING_SIDES   64
struct crossing_hull {
    double p[CROSSING_CORNERS][3], normal[CROSSING_SIDES][3], edge[CROSSING_SIDES][3];
    uint32_t corners, faces, edges;
};

/* Carry a convex mesh of few corners into the world; w, x, y, z of any length. */
void crossing_place_hull(struct crossing_hull *hull, const struct carom_mesh *mesh,
                         const double position[3], const double rotation[4]);
/*
 * How far two convex bodies can be told apart: a gap that some direction shows, or, below 0, the least
 * way that parts them, which is how deep they overlap.
 */
double crossing_apart(const struct crossing_hull *a, const struct crossing_hull *b);

#define CROSSING_BITS(faces_a, faces_b) ((size_t)(faces_a) * (size_t)(faces_b) / 8 + 1)

#endif
