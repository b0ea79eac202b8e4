/* SPDX-License-Identifier: MIT */
/*
 * boxes - small worlds of boxes, for tests of what bodies do to each other. Lengths are in 2^-10 world units;
 * bodies have e = 0, mu = 1/2 and density 1.
 */
#ifndef CAROM_TEST_BOXES_H
#define CAROM_TEST_BOXES_H

#include "carom.h"
#include "test.h"

#define BOXES_CAPS   10, 24, 96, 256, 0, 256
#define BOXES_EXTRAS 4 /* most extras that a configuration may ask for; none by default */
#define BOXES_WORLDS 2
#define BOXES_MESHES 4

/* The configuration that boxes_world makes worlds with. boxes_begin sets its defaults. */
extern struct carom_config boxes_config;
extern struct carom_mesh boxes_mesh[BOXES_MESHES];

/* Build mesh `number`, a box of half sides x, y, z. */
void boxes_make(int number, int x, int y, int z);
/*
 * Make world 0 or 1: gravity of 9.81 units / s^2 at 60 frames, sleep on, unless the configuration
 * says otherwise.
 */
struct carom_world *boxes_world(int number);
void boxes_begin(void);
/* The definition of a body of a mesh at a place. */
struct carom_body_def boxes_def(int mesh, int x, int y, int z);
/* Add a body, which must be accepted; returns its number. */
int boxes_add(struct carom_world *world, const struct carom_body_def *def);
struct carom_body_state boxes_state(const struct carom_world *world, int body);
/* Put a body in another place; its rotation and motion stay. */
int boxes_set(struct carom_world *world, int body, int x, int y, int z, int overlap);
/* Take steps that must succeed. */
void boxes_step(struct carom_world *world, int frames);
/* Count the events of a kind between two bodies in the last step. */
int boxes_events(const struct carom_world *world, int kind, int a, int b);
/* Whether faces of two bodies cross, or one is inside the other. */
bool boxes_overlap(struct carom_world *world, int a, int b);
/* True if two states have the same pose and motion, bit for bit. */
bool boxes_same(const struct carom_body_state *a, const struct carom_body_state *b);
/* Step two worlds. A body of one must move like body `other`, which is alone in the other world. */
void boxes_step_alike(struct carom_world *world, int body, struct carom_world *alone, int other);
/*
 * Throw body 1 upwards against a plate of +-128 in the middle, by BOXES_Q40(speed) a frame: it
 * stays below.
 */
void boxes_held_down(struct carom_world *world, int speed);
/* The number of pairs in use. */
uint32_t boxes_pairs(const struct carom_world *world);

#define BOXES_Q32(units) ((int64_t)(units) * ((int64_t)1 << 22))
#define BOXES_Q40(units) ((int64_t)(units) * ((int64_t)1 << 30))

#endif
