/* SPDX-License-Identifier: MIT */
/* hand - the ground and up to three solids, with contacts that a test sets by hand, for tests of rest. */
#ifndef CAROM_TEST_HAND_H
#define CAROM_TEST_HAND_H

#include "solve/rest.h"
#include "shapes.h"
#include "test.h"

#define HAND_CONTACTS 16
#define HAND_BODIES   4 /* body 0 is the ground, the others may move */

struct hand {
    struct shape ground, solid;
    struct body bodies[HAND_BODIES];
    struct body_state states[HAND_BODIES];
    struct contact contacts[HAND_CONTACTS];
    struct contact_work works[HAND_CONTACTS];
    struct contact_roll rolls[4]; /* rolls of hand_pairs */
    struct rest_warm warm[HAND_CONTACTS];
    struct pool pool;
    struct rest rest;
    struct gauss gauss;
    struct boyse_pair pair;
};

extern struct hand hand;
extern const struct pair hand_pairs[4];
extern const carom_v3_q30 hand_up;

/* The solid: a cube of side 1 and mass 1, J is 1/6 about every axis; or a box of 1 x 0.6 x 0.3. */
void hand_make_cube(void);
void hand_make_box(void);
/*
 * Begin a solve of the ground and the first `moving` solids, all in the origin, without contacts.
 */
void hand_begin(int moving, double fall);
/* Remove the contacts and the paths to which they refer. */
void hand_clear_contacts(void);

/* Set e and mu of all bodies; set gravity, units / frame^2. */
void hand_set_surface(double e, double mu);
void hand_set_gravity(double x, double y, double z);
/* Set a body's motion, units and radians a frame. */
void hand_set_motion(int body, const double v[3], const double w[3]);
void hand_velocity_of(int body, double v[3], double w[3]);

/*
 * Add a contact of a pair, at a place relative to the centre of its first body; the second body's
 * place must match. Every place has a vertex of its own.
 */
void hand_touch(uint16_t number, uint32_t vertex, const int32_t arm_q22[3], carom_v3_q30 normal,
                int32_t gap_q22);
/*
 * Add contacts at the four lower corners of a pair's first box, whose sides are along the axes; or
 * of pair 0.
 */
void hand_touch_corners_of(uint16_t number, int32_t gap_q22);
void hand_touch_corners(int32_t gap_q22);

/* Let bodies enter contact as in a step: they take this part of a frame's gravity. */
bool hand_enter_contact(int32_t tau_q30);

/* The normal part of P of one contact, and the length of its tangential part. */
double hand_pressure(const struct contact *c, double *across);

#endif
