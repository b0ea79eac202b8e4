/* SPDX-License-Identifier: MIT */
/*
 * impact_real - one impact in real numbers: random impacts, their rounding to the input of
 * impact_solve, and the right impulse, by a method that is not the engine's.
 *
 * The engine eliminates all 9 or 15 unknowns. Here the impulse is found in contact space: K P = dV
 * with K = sum of (1/m) 1 - [r] I^-1 [r], a 3 x 3 matrix, in long double.
 */
#ifndef CAROM_TESTS_IMPACT_REAL_H
#define CAROM_TESTS_IMPACT_REAL_H

#include "solve/impact.h"

/* ---------------------------------------------------------------- arithmetic */

typedef long double scalar;

struct vector {
    scalar c[3];
};

struct matrix {
    scalar c[3][3];
};

/* a 2^e */
scalar scaled(scalar a, int e);
scalar square_root(scalar a);
/* To the nearest number with so many fractional bits, and back. */
int64_t rounded(scalar v, int bits);
scalar fixed(int64_t v, int bits);

static inline scalar magnitude(scalar a)
{
    return a < 0 ? -a : a;
}

static inline scalar dot(struct vector a, struct vector b)
{
    return a.c[0] * b.c[0] + a.c[1] * b.c[1] + a.c[2] * b.c[2];
}

scalar length(struct vector a);
struct vector cross(struct vector a, struct vector b);
struct vector times(scalar s, struct vector a);
/* a + s b */
struct vector plus(struct vector a, scalar s, struct vector b);
struct vector difference(struct vector a, struct vector b);
struct vector matrix_times(const struct matrix *m, struct vector v);
struct matrix matrix_inverse(const struct matrix *m);

struct vector vector_q40(const int64_t v[3]);
struct vector vector_q30(const int32_t v[3]);

/* ------------------------------------------------------------------- impact */

struct real_body {
    bool moving; /* false: the other fields mean nothing */
    scalar mass;
    struct matrix inertia; /* divided by the mass */
    struct vector arm;
};

struct real_impact {
    struct real_body body[2]; /* a, b */
    struct vector normal, velocity;
    scalar restitution, target; /* e, and the wanted V'.N */
    scalar friction;
};

/*
 * The input of impact_solve, everything rounded to its format.
 *   arm_bits  fractional bits of arms, at most; they never take more than 30 in all
 */
struct impact real_to_engine(const struct real_impact *real, int arm_bits);
/* The real numbers of this input; the restitution is left open. */
struct real_impact real_from_engine(const struct impact *in);

/* ------------------------------------------------------------------- oracle */

enum real_way { REAL_STICKS, REAL_SLIDES, REAL_WEDGES };

/* The quantities of an impact that do not depend on whether it sticks or slides. */
struct real_contact {
    struct matrix k, inverse_k;
    scalar speed; /* V.N */
    struct vector frictionless, stick;
    bool slips;           /* V has a tangential part */
    struct vector along;  /* direction of that part, or of the slip that a frictionless impact
                           * leaves */
    scalar stick_excess;  /* -1 .. 1: above 0, sticking is outside of the cone */
    scalar wedge_measure; /* 1 without friction; not above 0: sliding would need an impulse that
                           * pulls */
};

struct real_answer {
    struct vector impulse;
    bool energy_rule;
};

void real_prepare(const struct real_impact *in, struct real_contact *c);
/* The way that the rules choose; the impulse of a given way. */
enum real_way real_choose(const struct real_impact *in, const struct real_contact *c);
void real_solve(const struct real_impact *in, const struct real_contact *c, enum real_way way,
                struct real_answer *out);

/* ------------------------------------------------------------ random impacts */

/* splitmix64; uniform in [low, high); log-uniform from 2^low to 2^high. */
uint64_t real_random(uint64_t *state);
scalar real_uniform(uint64_t *state, scalar low, scalar high);
scalar real_spread(uint64_t *state, int low, int high);
struct vector real_direction(uint64_t *state);

/*
 * Turned boxes of radius 1/4 .. 2 with moments of inertia up to 50:1, a sixteenth of them rods at
 * that limit; masses 2^-5 .. 2^5; with the contact at a corner, on an edge or on a face. Speeds
 * 1/4 .. 8, a quarter of them grazing, none with |V.N| below 2^-graze |V|, an eighth straight on.
 * e = 0 and e = 1 a quarter each; mu 0 .. 1.5, in steps of 2^-16, an eighth without friction.
 *   movers  1: one of the two, a or b; 2: both
 */
void real_random_impact(uint64_t *state, int movers, int graze, struct real_impact *out);

#endif
