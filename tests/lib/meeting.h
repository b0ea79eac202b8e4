/* SPDX-License-Identifier: MIT */
/*
 * meeting - two bodies whose motions are chosen so that two features meet squarely, and the true
 * places of these features: on the path that the engine was given, computed in the widest floating
 * point of the machine.
 *
 * One or both bodies move; everything is turned at random and lies far out in the world.
 */
#ifndef CAROM_TESTS_MEETING_H
#define CAROM_TESTS_MEETING_H

#include "boyse/boyse.h"
#include "shapes.h"

#define MEETING_UNIT (1.0L / 4194304) /* a unit of the last place of q22 */

/* The meeting that a test wants. */
struct meeting_plan {
    int kind;             /* kind of the candidate */
    bool both;            /* b moves as well */
    bool translate, turn; /* motion of the bodies that move */
};

struct meeting {
    struct shape shape[2]; /* a, b */
    struct body body[2];
    struct body_state state[2];
    struct boyse_pair pair;
    struct candidate candidate;
    long double time;   /* the features meet at this time, perhaps not for the first time */
    long double length; /* bound on the path length of any point of a relative to b */
};

/* The features at one time; places are relative to the origin of a's path. */
struct meeting_features {
    long double x[2][3], r[2][3][3]; /* centre and axes of the bodies */
    long double n[3];                /* unit vector: the face's normal, or along e x f */
    long double gap;                 /* signed distance along n */
    long double sine;                /* sine of the angle between the edges; 1 for a face */
    long double p[3], corner[3][3];  /* vertex and face */
    long double from[2][3], e[2][3], edge[2]; /* edges: start, direction, length */
};

/* Choose another pair of shapes of about a unit; `which` is any number. */
void meeting_shapes(struct meeting *m, unsigned which, const struct meeting_plan *plan);

/* Choose motions and features; sets the paths of both bodies and the pair. */
void meeting_make(struct meeting *m, struct test_random *r, const struct meeting_plan *plan);

void meeting_at(const struct meeting *m, long double t, struct meeting_features *f);

/* The gap's rate of change, units a slice. */
long double meeting_slope(const struct meeting *m, long double t);

/* Distance of the vertex from the border of the face, or of the nearest points from the ends of their edges. */
long double meeting_inside(const struct meeting *m, const struct meeting_features *f);

/*
 * The margin of sign * n within the normal cones, a cosine: for edges as N from b into a, for a
 * face as the face's normal (sign is 1). Below 0: outside of a cone.
 */
long double meeting_in_cones(const struct meeting *m, const struct meeting_features *f, int sign);

#endif
