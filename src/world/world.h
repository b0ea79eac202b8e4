/* SPDX-License-Identifier: MIT */
/*
 * world - bodies in one block of memory: init, add, remove, query, snapshot and hash.
 */
#ifndef CAROM_SRC_WORLD_H
#define CAROM_SRC_WORLD_H

#include "../solve/rest.h"

/*
 * All that a step changes and a later step reads. Two of them: a step builds the next beside the
 * current one and exchanges them last, so that an error leaves the world as it was, bit for bit.
 */
struct world_state {
    struct body_state *bodies;
    struct rest_warm *warm; /* impulses of the last frame's resting contacts */
    uint32_t warm_count;
    struct pair *touching; /* pairs that touched, in order: for events, and to wake islands */
    uint32_t touching_count;
};

/*
 * What stages work in while they run: who looks for candidates and who solves, never at the same time.
 * Contacts to solve take as much as the capacities say: the room is the larger of both.
 */
union world_scratch { /* by PHASE_TAG scratch_phase; world_pair */
    struct {
        struct interfere_leaf leaf;
        struct boyse_pair pair; /* of the candidates at hand */
    } gather;
    struct gauss gauss;
};
enum world_scratch_phase { WORLD_IDLE, WORLD_GATHER, WORLD_SOLVE };

/* 560 bytes where a pointer has 32 bits. What is asked for most comes first: code for that is shorter. */
struct carom_world {
    /* world: what the caller gave, and the arrays in the block; 84 bytes */
    struct carom_config config; /* gravity: the present one */
    uint32_t body_count;        /* places in use, free ones in between included */
    bool idle; /* the last step found nothing awake, and nothing has changed since */
    PHASE_TAG(scratch_phase)
    struct body *bodies;
    union world_scratch *scratch;
    struct carom_event *events; /* finish */

    /* regions: in order; and what search, answer and interfere keep of each; 8 bytes */
    struct pair *pairs;
    struct pair_work *meetings;

    /* commit: the dynamic state, 44 bytes */
    struct world_state *now; /* which of the two is current */
    struct world_state states[2];

    /* all stages: how much of each capacity is used; 96 bytes */
    struct pool pools[CAROM_POOL_COUNT];

    /* interfere, 144 bytes */
    struct interfere interfere;

    /* contact and solve, 68 bytes */
    struct rest rest;

    /* commit: what happened in the step, and its cost; 108 bytes */
    uint32_t event_count;
    struct carom_stats stats;
    uint32_t start_tick, mark_tick; /* of the step, and of its last stage mark */
};

/* Whoever looks for candidates has the scratch from here on. */
static inline void world_begin_gather(struct carom_world *w)
{
    (void)w;
    PHASE_BEGIN(w->scratch_phase, WORLD_GATHER);
}

/* The pair of the candidates at hand. */
static inline struct boyse_pair *world_pair(const struct carom_world *w)
{
    PHASE_ASSERT(w->scratch_phase, WORLD_GATHER);
    return &w->scratch->gather.pair;
}

static inline const struct world_state *world_now(const struct carom_world *w)
{
    return w->now;
}

/* The one that is not current. */
static inline struct world_state *world_next(struct carom_world *w)
{
    return &w->states[w->now == w->states];
}

/* Whether a state's place and speed are within what the formats hold. */
bool world_in_range(const struct body *b, const struct body_state *s);

/* Whether each coordinate is within BODY_WORLD_LIMIT. */
bool world_position_in_range(const carom_v3_q32 *p);
/* The force that a body is to have: it waits in the velocity, which is a step's, until all is read. */
carom_v3_q40 *world_force_read(const struct carom_world *w, uint32_t body);
/* Whether a state that was read, with those forces and this gravity, could be what a step has left. */
bool world_plausible(const struct carom_world *w, const struct world_state *s,
                     const carom_v3_q40 *gravity);

/* Whether there is a body of this number. */
static inline bool world_has_body(const struct carom_world *w, int body)
{
    return (uint32_t)body < w->body_count && w->bodies[body].mesh; /* none has a number of 2^31 */
}

/* Whether each component is at most `limit` in size. */
bool world_each_within(const int64_t v[3], int64_t limit);

/* Whether a body may be given this velocity and spin. */
bool world_motion_in_range(const struct body *b, const carom_v3_q40 *v, const carom_v3_q40 *w);

/* Whether each component of a gravity is within +-1. */
bool world_gravity_in_range(const carom_v3_q40 *gravity);

/* What gravity and a force give a body, 0 for one that stands still; false when out of range. */
bool world_acceleration(const struct body *b, const carom_v3_q40 *gravity,
                        const carom_v3_q40 *force, carom_v3_q40 *out);

/*
 * Give a body a state, in both of the world's: a step need not copy what stands still. What follows
 * from it is worked out again.
 */
void world_put(struct carom_world *w, uint32_t body, const struct body_state *state);

/* Set what gravity and force give a body in a frame, after one of them has changed. */
void world_accelerate(struct carom_world *w, uint32_t body);

/* Wake every body. */
void world_wake_all(struct carom_world *world);

/* Wake a body with its island. */
void world_wake_island(struct carom_world *world, uint32_t body);

/* Wake a body, and the islands that touch it or are near to where it is. */
void world_wake_around(struct carom_world *world, uint32_t body);

/* Wake the islands that have a contact in the list; returns whether there was any. */
bool world_wake_touched(struct carom_world *world, struct body_state *states);

/* Surfaces that were moved stand still again. */
void world_halt_surfaces(struct carom_world *world);

#endif
