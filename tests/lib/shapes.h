/* SPDX-License-Identifier: MIT */
/*
 * shapes - small meshes for tests, and bodies of them without a world.
 *
 * Each function makes the raw mesh and builds it; sizes are in quanta of 2^-quantum_bits units. The
 * same struct may be used again for another shape.
 */
#ifndef CAROM_TEST_SHAPES_H
#define CAROM_TEST_SHAPES_H

#include "interfere/interfere.h"
#include "scene.h"
#include "test.h"

#define SHAPE_VERTICES 625
#define SHAPE_FACES    1152

struct shape {
    int16_t vertices[SHAPE_VERTICES][3];
    uint16_t faces[SHAPE_FACES][3];
    struct carom_mesh_raw raw;
    struct carom_mesh mesh;
    _Alignas(8) uint8_t block[CAROM_MESH_BYTES(SHAPE_VERTICES, SHAPE_FACES)];
};

/* For the meshes of a scene; all tests share it, because a board's memory is small. */
extern uint8_t shape_scene_block[SCENE_MESH_BYTES];

/* A box of sides x, y, z about the origin; its vertex i has the sign of bit k along axis k. */
void shape_box(struct shape *s, int quantum_bits, int x, int y, int z);

/* A regular tetrahedron with corners at (+-size, +-size, +-size). */
void shape_tetrahedron(struct shape *s, int quantum_bits, int size);

/*
 * A tetrahedron whose random corners are whole 16ths of a unit, at most 12 from the origin along each axis; a
 * flat one is drawn anew.
 */
void shape_random_tetrahedron(struct shape *s, struct test_random *r);

/* An L of three cubes of the given side, about one of its corners. Has one concave edge. */
void shape_l(struct shape *s, int quantum_bits, int side);

/* A ball of 80 faces: an icosahedron whose faces are cut in four. */
void shape_ball(struct shape *s, int quantum_bits, int radius);

/* A SURFACE of n x n squares, each two triangles, at z = 0 about the origin; n <= 24. */
void shape_plane(struct shape *s, int quantum_bits, int n, int side);

/* The same, with random heights from 0 to `rough`. */
void shape_field(struct shape *s, int quantum_bits, int n, int side, int rough, uint64_t seed);

/*
 * A body of the shape at density 1, in the middle of the world, at rest: as carom_body_add makes
 * it, with e = mu = 0.
 */
void shape_body(const struct shape *s, bool moving, struct body *b, struct body_state *state);

/*
 * Whether a vertex or an edge of the mesh is tested: a convex one, and of a mesh with two sides one
 * that bends the other way.
 */
bool shape_owns_vertex(const struct shape *s, uint32_t vertex);
bool shape_owns_edge(const struct shape *s, uint32_t edge);

/*
 * Every vertex with every face, and every edge with every edge, of a pair of shapes, sorted: what
 * interfere would return if all features were near. Returns how many; at most `max` are written.
 */
uint32_t shape_candidates(const struct shape *a, const struct shape *b, uint16_t pair,
                          struct candidate *out, uint32_t max);

/* Any rotation, uniformly. */
carom_quat_q30 shape_random_turn(struct test_random *r);

#endif
