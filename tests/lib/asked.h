/* SPDX-License-Identifier: MIT */
/* asked - small worlds of shapes at random places, for the tests of queries between steps. */
#ifndef CAROM_TEST_ASKED_H
#define CAROM_TEST_ASKED_H

#include "query/query.h"
#include "shapes.h"
#include "test.h"

#define ASKED_WORLDS 2
#define ASKED_BODIES 6
#define UNIT         ((int64_t)1 << 32)

extern const carom_quat_q30 upright;

/* A world, 0 or 1, without bodies; gravity of half a unit a frame. */
struct carom_world *asked_world(int number);
/* Add a body that passes what it overlaps, e = 1/2; returns its number or an error. A SURFACE never moves. */
int asked_add(struct carom_world *world, const struct carom_mesh *mesh, bool moving, int64_t x,
              int64_t y, int64_t z, carom_quat_q30 turn);
/* The vertices of a posed mesh in world coordinates, in double precision. */
void asked_place(const struct carom_mesh *mesh, const carom_v3_q32 *position,
                 const carom_quat_q30 *rotation, double out[][3]);

#endif
