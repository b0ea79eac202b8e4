/* SPDX-License-Identifier: MIT */
/*
 * world - bodies in one block of memory: init, add, remove, query, snapshot and hash.
 */
#ifndef CAROM_SRC_WORLD_H
#define CAROM_SRC_WORLD_H

#include "rest.h"

/*
 * All that a step changes and a later step reads. Two of them: a step builds the next beside the
 * current one and exchanges them last, so that an error leaves the world as it was, bit for bit.
 */
struct world_state {
    struct body_state *bodies;
    struct rest_warm *warm; /* impulses of the last frame's resting contacts */
    uint32_t warm_count;
    struct pair *touching; /* pairs that touched: for begin and end events */
    uint32_t touching_count;
};

struct carom_world {
    struct carom_config config;
    size_t bytes;
    uint32_t body_count; /* places in use, free ones in between included */
    struct pool pools[CAROM_POOL_COUNT];

    /* set by add and remove */
    struct body *bodies;

    /* dynamic state */
    struct world_state states[2];
    uint32_t now; /* which of the two is current */

    /* set by broad */
    struct pair *pairs;

    /* set by interfere */
    struct interfere interfere;

    /* set by contact and rest */
    struct rest rest;

    /* set by commit */
    struct carom_event *events;
    uint32_t event_count;
    struct carom_stats stats;
    uint32_t start_tick, mark_tick; /* of the step, and of its last stage mark */
};

static inline struct world_state *world_now(const struct carom_world *w)
{
    return (struct world_state *)&w->states[w->now];
}

/* Twice the kinetic and potential energy of all active bodies, 80 fractional bits. */
struct fix_wide world_energy2(const struct carom_world *world, const struct world_state *state);

/* Whether a state's place and speed are within what the formats hold. */
bool world_in_range(const struct body *b, const struct body_state *s);

/* The mesh of a body and whether it moves; NULL when there is no such body. */
const struct carom_mesh *world_mesh(const struct carom_world *world, int body, bool *moving);

/* Body numbers run below this. */
int world_body_places(const struct carom_world *world);

#endif
