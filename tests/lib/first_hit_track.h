/* SPDX-License-Identifier: MIT */
/*
 * first_hit_track - the true motion of two bodies on the paths of a step, in double precision:
 * their poses, whether their faces cross, and the distance of two features. Host only.
 */
#ifndef CAROM_TESTS_FIRST_HIT_TRACK_H
#define CAROM_TESTS_FIRST_HIT_TRACK_H

#include "first_hit.h"

/* A body's path: its centre at x + v t + g t^2, its axes by the quaternion q (1, t u). */
struct first_hit_track {
    double x[3], v[3], g[3], q[4], u[3];
    double radius;
};

/* The tracks of the bodies of a step; places are relative to the start of body 0. */
void first_hit_read_tracks(struct first_hit_track track[2], const struct step *s);

struct oracle_pose first_hit_pose(const struct first_hit_track *track, const double centre[3],
                                  double t);

/* A bound on the speed of any point of one body relative to the other, units a slice. */
double first_hit_speed(const struct first_hit_track track[2]);

/* Whether faces cross at one time. */
bool first_hit_cross(const struct first_hit_motion *motion, const struct first_hit_track track[2],
                     double t);

/*
 * The first of at least 300 times up to `end` at which faces cross, or 2. Between two of them
 * nothing moves by more than half the thinnest part of either mesh.
 */
double first_hit_crossing(const struct first_hit_motion *motion,
                          const struct first_hit_track track[2], double end);

/* A vertex of a mesh in a pose. */
void first_hit_point(double out[3], const struct first_hit_mesh *mesh,
                     const struct oracle_pose *pose, uint32_t vertex);

/* Two features of a candidate at one time. */
struct first_hit_features {
    double gap;      /* signed distance of the plane or the lines, along N */
    double distance; /* distance of the closed features */
    double sine;     /* sine of the edges' angle; 1 for a face */
    double sharp;    /* sine of the face's least angle; 1 for edges */
};

/*
 * The features at one time. N leads from body 0 into body 1, and only tells the sides of the lines.
 */
struct first_hit_features first_hit_features(const struct first_hit_motion *motion,
                                             const struct first_hit_track track[2],
                                             const struct candidate *c, const double n[3],
                                             double t);

#endif
