/* SPDX-License-Identifier: MIT */
/*
 * mesh_shapes - raw meshes for the tests of the mesh stage, which tests may damage.
 *
 * One mesh at a time: a shape function fills `vertices` and `faces` and points `raw` at them, with
 * 10 quantum bits; build() makes `mesh` from them in `block`.
 */
#ifndef CAROM_TEST_MESH_SHAPES_H
#define CAROM_TEST_MESH_SHAPES_H

#include "mesh/mesh.h"
#include "test.h"

#define V_MAX 1600
#define F_MAX 2048

extern int16_t vertices[V_MAX][3];
extern uint16_t faces[F_MAX][3];
extern struct carom_mesh_raw raw;
extern struct carom_mesh mesh;
extern uint8_t block[CAROM_MESH_BYTES(V_MAX, F_MAX) + 8];

/* An empty mesh, to be filled by hand. add_vertex returns the vertex's number. */
void begin(int kind);
uint32_t add_vertex(int x, int y, int z);
void add_face(uint32_t a, uint32_t b, uint32_t c);

/* A prism over a counter-clockwise polygon, its top and bottom cut into triangles from corner 0. */
void make_prism(const int (*corner)[2], uint32_t n, int height);

/* A box with a corner at the origin. */
void make_box(int x, int y, int z);

/* A field of n by n squares of `side` quanta, up to `rough` high. */
void make_field(uint32_t n, int side, int rough, uint64_t seed);

/*
 * A solid with a rough top and a rough bottom: two fields, the lower one turned over, and a wall.
 */
void make_bumpy(uint32_t n, int side, int rough, uint64_t seed);

/* carom_mesh_build in exactly the bytes that it asks for. */
int build(void);

#endif
