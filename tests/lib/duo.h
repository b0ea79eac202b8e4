/* SPDX-License-Identifier: MIT */
/*
 * duo - a moving body and another body, still or moving, on their paths, with the places of their
 * features in double precision. This true motion is the oracle of the collision kernels.
 */
#ifndef CAROM_TEST_DUO_H
#define CAROM_TEST_DUO_H

#include "boyse/boyse.h"
#include "shapes.h"

#define DUO_UNIT (1.0 / 4194304) /* a unit of the last place of q22 */

/* A body's path: centre x + v t + g t^2, axes by the quaternion q (1, t u). */
struct duo_motion {
    double x[3], v[3], g[3], q[4], u[3];
};

struct duo {
    struct shape shape[2];
    struct body body[2]; /* 0 is a, which moves; b may move */
    struct body_state state[2];
    struct boyse_pair pair;
    struct duo_motion motion[2];
};

extern struct duo duo;

/* Bodies of both shapes, in the middle of the world. */
void duo_begin(bool b_moves);

/* Give a body its motion, in units and radians a frame. */
void duo_set_motion(int side, const double v[3], const double w[3]);
/* Set both paths over a whole frame, with this motion of a. */
void duo_set_paths(const double v[3], const double w[3], const carom_v3_q40 *gravity);

/* Read the paths again after they were changed by hand. */
void duo_read_motion(void);

/* A body at one time: centre and axes. */
struct duo_pose {
    double x[3], r[3][3];
};

/* The two features of a candidate at one time. */
struct duo_features {
    struct duo_pose pose[2];
    double gap;           /* signed distance; for edges, of the lines, along w = e x f */
    double n[3];          /* the unit vector along which the gap is measured */
    double p[3], c[3][3]; /* vertex and face */
    double e[2][3], from[2][3], length[2], sine; /* edges, a's first; 1 for a face */
};

void duo_features_at(struct duo_features *f, const struct candidate *c, double t);
double duo_gap_at(const struct candidate *c, double t);

/* The body to which a candidate's vertex belongs. */
int duo_vertex_side(int kind);

/*
 * The distance of the vertex from the border of the face, or of the nearest points from the ends of
 * their edges.
 */
double duo_inside(const struct duo_features *f, const struct candidate *c);

/*
 * The margin of the normal within the cone tolerance. For edges, `sign` times n is N from b into a;
 * for a vertex and a face, the face's normal.
 */
double duo_in_cones(struct duo_features *f, const struct candidate *c, int sign);

#endif
