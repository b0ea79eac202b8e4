/* SPDX-License-Identifier: MIT */
/*
 * physics - motions whose outcome has a closed form or was published, measured through the public interface: the rows of
 * docs/physics.md. Expected numbers are computed here in double precision, from the formula that the row names and from
 * mass and inertia of the mesh. Host only.
 *
 *   struct fixture *f = physics_begin("drop", 0.5);       bodies as for a fixture
 *   physics_start(f, 1);
 *   physics_step(f);
 *   physics_row("time of a fall", "sqrt(2 s / g)", expected, measured, 1e-6, NULL);
 *   fixture_free(f);
 *
 * Lengths in metres, times in seconds: a frame is 1/60 s.
 */
#ifndef CAROM_TESTS_PHYSICS_H
#define CAROM_TESTS_PHYSICS_H

#include "fixture.h"

#define PHYSICS_FPS 60.0
#define PHYSICS_G   9.81

/*
 * One row of the table. The error is relative, or absolute where 0 is expected; the row holds if it is at most `bar`.
 *   from  formula or source of the expected number
 *   why   the reason of an error above rounding; NULL: none needed
 */
void physics_row(const char *name, const char *from, double expected, double measured, double bar,
                 const char *why);
/* A row that is known to miss its bar: `most` is what its error may be all the same. */
void physics_miss(const char *name, const char *from, double expected, double measured, double bar,
                  double most, const char *why);

/* A fixture without bodies: gravity down, e = 0, every body's mu as said, no sleep. The name must outlive it. */
struct fixture *physics_begin(const char *name, double mu);
/* Gravity along any direction, m / s^2. */
void physics_gravity(struct fixture *f, double x, double y, double z);
/* Make the world, with e of every body. There is no rolling friction, which also keeps bodies from tipping over an edge. */
void physics_start(struct fixture *f, double e);
void physics_step(struct fixture *f);
/* A joint of a body and the world, or another body. Once the world is made. */
int physics_joint(struct fixture *f, int kind, int a, int b, const double anchor[3],
                  const double axis[3]);

/* Meshes: a box; a prism of n sides about the y axis; the ball of ball.h. Each returns its number. */
int physics_box(struct fixture *f, double x, double y, double z);
int physics_roller(struct fixture *f, double radius, double length, int sides);
int physics_ball(struct fixture *f, double radius, int cuts);

/* A body now: metres and seconds, inertia as a part of the mass. */
struct oracle_body physics_body(const struct fixture *f, int body);
/* A direction of the body in the world; the spin, or any vector of the world, along the body's axes. */
void physics_axis(const struct oracle_body *body, int axis, double out[3]);
void physics_local(const struct oracle_body *body, const double world[3], double out[3]);
/* The largest speed of a HIT event of two bodies in the last step; 0: there was none. */
double physics_hit(const struct fixture *f, int a, int b);

/* The times at which a number that a frame gives goes up through 0, each found by the line between two frames. */
struct physics_crossings {
    long frames, count;
    double before, first, last; /* the first and the last time, in seconds */
};
void physics_cross(struct physics_crossings *c, double now);
/* The mean time from one to the next. */
double physics_period(const struct physics_crossings *c);

/* The complete elliptic integral of the first kind, K(k), by the arithmetic-geometric mean. */
double physics_elliptic(double k);
/* The largest x in low .. high for which a test holds, by halving: it holds at low, not at high. */
double physics_threshold(bool (*holds)(double x), double low, double high, int halvings);

/* The motions. */
void physics_fall(void);
void physics_slope(void);
void physics_roll(void);
void physics_swing(void);
void physics_spin(void);
void physics_stone(void);

#endif
