/* SPDX-License-Identifier: MIT */
/*
 * rigid - islands that move as one rigid body: used when energy is taken out of the rest of their
 * motion, and as the last resort for an island that no solve sets right.
 */
#ifndef CAROM_SRC_RIGID_H
#define CAROM_SRC_RIGID_H

#include "rest.h"

/* The active bodies of an island, in order: the first, the next; ISLAND_END after the last. */
uint32_t rest_island_first(const struct rest *r, uint32_t island);
uint32_t rest_island_next(const struct rest *r, uint32_t i);

/* The motion of an island as one rigid body. */
struct rest_rigid {
    uint32_t first, heavy; /* bodies: the first active one; a heaviest one */
    carom_v3_q32 centre;
    carom_v3_q40 velocity, spin;
    int32_t mass_e, length_bits; /* units of sums */
    int64_t mass_q30;
};

/*
 * Find the rigid motion that has the momentum and the angular momentum of the island's active
 * bodies, to 30 bits. Uses the room of the dense system, which contact_work shares. Returns false
 * if the island has no active body, or is a line so thin that it has no inertia about it.
 */
bool rest_rigid_motion(const struct rest *r, uint32_t island, struct rest_rigid *rigid);
/* True if an island has fewer than two active bodies, so that its motion is that of a rigid body. */
bool rest_is_alone(const struct rest *r, uint32_t island);
/* The state of a body with the momenta that it has in that motion. */
struct body_state rest_rigid_state(const struct rest *r, const struct rest_rigid *rigid,
                                   uint32_t i);

/*
 * Scale an island's motion relative to its rigid motion. Nothing outside acts on it, so its momenta
 * stay: linear momentum to the last place, angular momentum to half of one. A heavy body gets what
 * rounding takes of them.
 */
void rest_scale_free(struct rest *r, const struct rest_rigid *rigid, int32_t factor_q30);

/*
 * The same relative to a rigid motion without spin: the island keeps its momentum, and its angular
 * momentum is scaled.
 */
void rest_scale_turn(struct rest *r, const struct rest_rigid *common, int32_t factor_q30);

/* The same for an island that touches a stationary body: it has no motion to keep. */
void rest_scale_grounded(struct rest *r, uint32_t island, int32_t factor_q30);

/*
 * The last resort. Afterwards no two bodies of the island approach each other, nor, if it is
 * grounded, a stationary body. A free island moves as one rigid body, with all of its momentum and
 * angular momentum; a grounded one is at rest. Its energy does not rise. Changes nothing of a free
 * island that is so thin that its turn is unknown.
 */
void rest_unite(struct rest *r, uint32_t island, bool grounded);

/*
 * Move a free island for a whole frame as one rigid body, from its present poses: its bodies keep
 * their places to each other, and it keeps its momenta and the energy of its rigid motion, within
 * 2^-25; within 2^-22 if it is thin and turns in many slices. `rigid` is that motion, with a spin of
 * at most STEP_AS_ONE_SPIN_MAX_Q40; `pull`, units / frame^2, accelerates all of its bodies.
 */
void rest_go_rigid(struct rest *r, struct rest_rigid *rigid, const carom_v3_q40 *pull);

#endif
