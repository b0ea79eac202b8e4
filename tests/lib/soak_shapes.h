/* SPDX-License-Identifier: MIT */
/*
 * soak_shapes - solids and surfaces of any kind from a stream of whole numbers. They are the same
 * on every machine, because only whole numbers and basic operations of doubles make them.
 */
#ifndef CAROM_TESTS_SOAK_SHAPES_H
#define CAROM_TESTS_SOAK_SHAPES_H

#include "carom.h"
#include "test.h"

#define SOAK_VERTICES 640
#define SOAK_FACES    1152

enum soak_kind {
    SOAK_HULL,   /* the hull of points on an ellipsoid */
    SOAK_BOX,    /* a box with three sides */
    SOAK_L,      /* an L, a U, a star with n points, all extended along z */
    SOAK_U,      /*   */
    SOAK_STAR,   /*   */
    SOAK_SPIKES, /* a hull with a spike on every face */
    SOAK_PLATE,  /* a thin polygon */
    SOAK_TORUS,  /*   */
    SOAK_NEEDLE, /* a long and thin prism, spindle or tetrahedron */
    SOAK_KINDS
};
extern const char *const soak_kind_names[SOAK_KINDS];

/* A mesh and its arrays; it must not be moved in memory. */
struct soak_shape {
    struct carom_mesh_raw raw;
    int16_t vertices[SOAK_VERTICES][3];
    uint16_t faces[SOAK_FACES][3];
};

/* Uniform in [low, high); by powers, every doubling is equally likely. */
double soak_uniform(struct test_random *r, double low, double high);
double soak_powers(struct test_random *r, double low, double high);
/* A random number of 0 .. count - 1. */
int soak_pick(struct test_random *r, int count);
/* A random point of the unit sphere, and a random rotation: w, x, y, z. */
void soak_direction(struct test_random *r, double out[3]);
void soak_any_turn(struct test_random *r, double out[4]);

/*
 * A solid of 4 to 500 faces that reaches about `size` units from its middle. Returns the number of
 * earlier tries that carom_mesh_build or carom_body_add would refuse: some are flat once they are
 * rounded, or too thin to be turned.
 */
int soak_solid(struct soak_shape *shape, enum soak_kind kind, double size, struct test_random *r);
/*
 * Turn the points, at most SOAK_POINTS, into their hull, and remove the inner ones. No faces when
 * the first four lie in a plane. Differences of coordinates are below 2^16.
 */
#define SOAK_POINTS 252
void soak_wrap(struct soak_shape *shape);
/* The hull of `count` points on a sphere of that size. */
int soak_hull_of(struct soak_shape *shape, int count, double size, struct test_random *r);
/* A box with whole sides, about the origin. */
void soak_box(struct soak_shape *shape, double x, double y, double z);
/* A surface of n x n squares with a given side; heights from 0 to `rough`; n <= 24. */
void soak_surface(struct soak_shape *shape, int n, double side, double rough,
                  struct test_random *r);

#endif
