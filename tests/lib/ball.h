/* SPDX-License-Identifier: MIT */
/* ball - a body that is nearly a ball: an icosahedron, its faces cut in four again and again. Host only. */
#ifndef CAROM_TESTS_BALL_H
#define CAROM_TESTS_BALL_H

#include "carom_mesh.h"

#define BALL_CUTS        5
#define BALL_FACES(cuts) (20 << (2 * (cuts)))
#define BALL_QUANTA      16384 /* of its radius */

/* The one ball, and its vertices, which a test may move before a mesh is built. */
extern struct carom_mesh_raw ball_raw;
extern int16_t ball_vertices[BALL_FACES(BALL_CUTS) / 2 + 2][3];

/* Make it anew with so many cuts; cut each face once more. BALL_CUTS in all. */
void ball_make(int cuts);
void ball_cut(void);

#endif
