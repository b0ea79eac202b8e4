/* SPDX-License-Identifier: MIT */
/*
 * fixture_shape - generators of closed meshes in doubles, with faces counter-clockwise seen from
 * outside. Each starts the shape anew. Building the mesh refuses a shape that is open or inverted.
 */
#ifndef CAROM_TESTS_FIXTURE_SHAPE_H
#define CAROM_TESTS_FIXTURE_SHAPE_H

#include <stdbool.h>
#include <stdint.h>

#define FIXTURE_VERTICES 4096
#define FIXTURE_FACES    8192

struct fixture_shape {
    double p[FIXTURE_VERTICES][3];
    uint16_t faces[FIXTURE_FACES][3];
    uint32_t vertex_count, face_count;
    bool surface;
};

void fixture_shape_begin(struct fixture_shape *s);
/* Returns the vertex's number. */
int fixture_shape_vertex(struct fixture_shape *s, double x, double y, double z);
void fixture_shape_face(struct fixture_shape *s, int a, int b, int c);
void fixture_shape_quad(struct fixture_shape *s, int a, int b, int c, int d);

/* A box with sides x, y, z, about the origin. */
void fixture_shape_box(struct fixture_shape *s, double x, double y, double z);
/* A surface of n x n squares at z = 0, `side` wide, about the origin. */
void fixture_shape_plane(struct fixture_shape *s, int n, double side);
/* A simple polygon over x, z, either way round, convex or not, between y = low and y = high. */
void fixture_shape_prism(struct fixture_shape *s, const double (*corner)[2], int n, double low,
                         double high);
/* A torus about the z axis; `tube` is the radius of the section's corners. */
void fixture_shape_torus(struct fixture_shape *s, double radius, double tube, int segments,
                         int sides);
/* A square base of +-half at z = 0 and a tip at z = height, which may be below. */
void fixture_shape_spike(struct fixture_shape *s, double half, double height);
/*
 * A block of +-half, from z = -thick to 0. It has a hole with the form of a spike of +-mouth,
 * `deep` units deep.
 */
void fixture_shape_hole(struct fixture_shape *s, double half, double thick, double mouth,
                        double deep);

/*
 * A thread along z: one pitch has four rows at heights row[] with radius radius[], and rises by a
 * pitch a turn in so many segments. A bolt has a number of rows; a nut has the thread inside, and
 * an outer radius.
 */
struct fixture_thread {
    double pitch, row[4], radius[4];
    int segments, rows;
};
void fixture_shape_bolt(struct fixture_shape *s, const struct fixture_thread *thread);
void fixture_shape_nut(struct fixture_shape *s, const struct fixture_thread *thread, double outer);

/*
 * A convex solid that stands on one face only: a long prism over a spiral that grows from below to
 * its top ridge, cut obliquely at both ends so that it is short above. After Conway and Guy (1969),
 * with more faces and therefore a margin. The section's ridge is a unit above the origin. `fine`
 * has very short sides, so that the solid nearly rolls, and a narrow standing face.
 */
void fixture_shape_monostable(struct fixture_shape *s, bool fine);

#endif
