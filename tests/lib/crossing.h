/* SPDX-License-Identifier: MIT */
/*
 * crossing - the oracle of queries: the faces of two posed meshes that have a common point, by a
 * test of all pairs in exact arithmetic. It shares no code with the engine.
 *
 * Corners are moved into the world in double precision and rounded once, to q22; everything after
 * that is in whole numbers. The answer is exact for the rounded corners, which are within one unit
 * of q22 of the true ones.
 */
#ifndef CAROM_TEST_CROSSING_H
#define CAROM_TEST_CROSSING_H

#include "carom.h"

/*
 * True if two triangles have a common point. Touching counts, and so does an overlap in one plane.
 * A triangle without area has no common point with any other. Range: |p|, |q| < 2^28
 */
bool crossing_triangles(const int32_t p[3][3], const int32_t q[3][3]);

/* A posed face and its box. */
struct crossing_face {
    int32_t p_q22[3][3];
    int32_t low_q22[3], high_q22[3];
    uint32_t number;
};

/* A posed mesh. The caller gives memory for every vertex and every face. */
struct crossing_body {
    const struct carom_mesh *mesh;
    int32_t (*p_q22)[3];
    struct crossing_face *near; /* faces that overlap the box of the other body */
};

/* Pose a mesh relative to `origin`; it must be within 64 units of it. */
void crossing_place(struct crossing_body *body, const carom_v3_q32 *position,
                    const carom_quat_q30 *rotation, const carom_v3_q32 *origin);

/* Sums over all comparisons. */
struct crossing_tally {
    uint32_t poses, touching; /* touching: poses with crossing pairs */
    uint32_t crossing;        /* pairs that have a common point */
    uint32_t found;           /* pairs that the query found */
    uint32_t missed, repeated;
};

/*
 * Compare the pairs that a query found with all crossing pairs.
 *   bits  a bit for each pair of faces, all 0 before and after
 */
void crossing_compare(struct crossing_body *a, struct crossing_body *b,
                      const struct carom_face_pair *found, uint32_t count, uint8_t *bits,
                      struct crossing_tally *tally);
/*
 * A convex body in doubles: its corners, and the directions that can separate it from another body.
 */
#define CROSSING_CORNERS 16
#define CROSSING_SIDES   64
struct crossing_hull {
    double p[CROSSING_CORNERS][3], normal[CROSSING_SIDES][3], edge[CROSSING_SIDES][3];
    uint32_t corners, faces, edges;
};

/* Move a convex mesh of few corners into the world; w, x, y, z of any length. */
void crossing_place_hull(struct crossing_hull *hull, const struct carom_mesh *mesh,
                         const double position[3], const double rotation[4]);
/*
 * The largest gap between two convex bodies along any direction. Below 0 it is their depth: the least motion that
 * separates them.
 */
double crossing_apart(const struct crossing_hull *a, const struct crossing_hull *b);

#define CROSSING_BITS(faces_a, faces_b) ((size_t)(faces_a) * (size_t)(faces_b) / 8 + 1)

#endif
