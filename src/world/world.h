/* SPDX-License-Identifier: MIT */
/*
 * world - bodies in one block of memory: everything between steps (no counterpart in the paper).
 *
 * In: the caller's block, configuration, bodies, calls. Out: the block with everything that a step
 * reads; state, events and statistics of the last step; snapshots and hashes.
 *
 * Files:
 *   world.c      the block carved
 *   bodies.c     add, remove, get and set bodies
 *   range.c      are numbers within what the formats hold
 *   identity.c   numbers and ids; frame.c: points of a body in world axes
 *   force.c      gravity, forces, pushes; material.c: e, mu, mass; filter.c: who may touch
 *   apart.c      bodies start apart; through.c: pairs that overlap and do not touch
 *   wake.c       waking, by islands
 *   moving.c     surfaces that the caller moves; kinematic.c: bodies that the caller leads
 *   joints.c     joints as the caller sees them
 *   extra.c      the pool of what few bodies have
 *   snapshot.c   state hash and snapshots; stream.c: their numbers; plausible.c: checks when loaded
 *   report.c     events, contacts, statistics; query.c: faces that cross, inside
 */
#ifndef CAROM_SRC_WORLD_H
#define CAROM_SRC_WORLD_H

#include "../solve/rest.h"

/*
 * Everything that a step changes and a later step reads. There are two: a step builds the next one
 * beside the current one and exchanges them last, so that an error leaves the world unchanged, bit
 * for bit.
 */
struct world_state {
    struct body_state *bodies;
    struct rest_warm *warm; /* kept impulses of the last frame's resting contacts */
    uint32_t warm_count;
    struct pair *touching; /* pairs that touched, in order: for events, and to wake islands */
    uint32_t touching_count;
    /*
     * pairs that pass through each other, in order, at the end of the room of `touching`:
     * world_through
     */
    uint32_t through_count;
    struct joint_state *joints;
};

/*
 * Room for stages while they run: the search for candidates and the solve, never at the same time.
 * Contacts to be solved take as much as the capacities say; the room is the larger of both.
 */
union world_scratch { /* by PHASE_TAG scratch_phase; see world_pair */
    struct {
        struct interfere_leaf leaf;
        struct boyse_pair pair; /* of the candidates at hand */
    } gather;
    struct gauss gauss;
};
enum world_scratch_phase { WORLD_IDLE, WORLD_GATHER, WORLD_SOLVE };

/*
 * 720 bytes where a pointer has 32 bits. The fields used most come first, which makes code for them
 * shorter.
 */
struct carom_world {
    /* world: what the caller gave, and arrays in the block; 108 bytes */
    struct carom_config config; /* with the present gravity */
    uint32_t body_count;        /* places in use, with free ones between */
    bool idle;              /* the last step found no body awake, and nothing has changed since */
    bool passing;           /* pairs may pass through each other: there is or was a reason for it */
    bool regions_stale : 1; /* bodies have changed since regions and pairs were set */
    bool sense_anew : 1;    /* since a load, or bodies came: what sleeps may be in another sensor */
    PHASE_TAG(scratch_phase)
    struct body *bodies;
    union world_scratch *scratch;
    struct carom_event *events; /* finish */

    /* regions: the pairs, in order, and what search, answer and interfere keep of each; 8 bytes */
    struct pair *pairs;
    struct pair_work *meetings;

    /* commit: the state, 60 bytes */
    struct world_state *now; /* the current one of both */
    struct world_state states[2];

    /* interfere, 144 bytes */
    struct interfere interfere;

    /* contact and solve, 124 bytes */
    struct rest rest;

    /* commit: events and cost of the step; 104 bytes */
    struct carom_stats stats;
    uint32_t start_tick, mark_tick; /* of the step; of its last stage mark */
    uint32_t event_count;

    /* all stages: counters of each capacity; 144 bytes */
    struct pool pools[CAROM_POOL_COUNT];

    /* world: what the optional capacities hold; 28 bytes */
    struct body_extra *extras;
    struct carom_hit *hits; /* contacts: details of the events' hits, in their order */
    uint16_t sensors;       /* number of sensors */
    uint16_t ignored_count;
    struct pair *ignored; /* pairs whose joints let them ignore each other, in order */
    const struct step_joint_calls *joint_steps; /* NULL until a joint is added */
    body_route_maker *route_to; /* NULL until a body is led to a pose, which keeps it unlinked */
};

/*
 * The functions that a step calls for joints. carom_joint_add sets the table, so that programs
 * without joints link none of them.
 */
struct step;
struct step_joint_calls {
    void (*begin)(struct step *s); /* copy the joints' state to the next one, before any solve */
    /* the longest slice of a body, the same for all bodies connected with it */
    int32_t (*slice)(const struct step *s, uint32_t i, int32_t left_q30);
    /*
     * choose the joints to be solved: of all awake bodies, false if there are none; of the members
     */
    bool (*choose_all)(struct step *s);
    void (*choose_members)(struct step *s);
    /* a body that must become a member; ISLAND_END: none */
    uint32_t (*connected)(const struct step *s);
    /* measure errors before a solve; true if it is needed */
    bool (*measure)(struct step *s, enum joint_solve solve);
    void (*project)(struct step *s);
    int (*break_joints)(struct step *s); /* CAROM_OK or CAROM_ERR_PAIRS_FULL */
    /*
     * energy of an island: add what springs took up, and what limits and damping took; what is
     * owed; conserve it where nothing touched; note islands held by stationary bodies
     */
    void (*add_joints2)(const struct step *s, uint32_t first, struct fix_wide *gained,
                        struct fix_wide *taken, struct fix_wide *kept);
    struct fix_wide *(*owed2)(const struct step *s, uint32_t first);
    void (*conserve)(struct step *s, uint32_t first, struct fix_wide *owed2);
    void (*ground)(struct step *s);
    /*
     * a body of the island that the kinematic body `led` leads, or that any does if `led` is
     * ISLAND_END; ISLAND_END: none
     */
    uint32_t (*led_by)(const struct step *s, uint32_t first, uint32_t led);
    void (*block_leaders)(struct step *s); /* stop the kinematic bodies that lead members */
    bool (*yield)(struct step *s);         /* true if leading bodies had to stop after a solve */
    void (*keep_awake)(struct step *s);    /* bodies that kinematic bodies lead */
    void (*wake_led)(struct carom_world *w, uint16_t body);
    /* between steps: a body is removed; joints came back from a snapshot */
    void (*forget_body)(struct carom_world *w, uint16_t body);
    void (*regroup)(struct carom_world *w);
    /* of a joint that was read */
    bool (*plausible)(const struct joint *j, const struct joint_state *state);
};

/* From here on the search for candidates uses the scratch. */
static inline void world_begin_gather(struct carom_world *w)
{
    (void)w;
    PHASE_BEGIN(w->scratch_phase, WORLD_GATHER);
}

/* The boyse_pair of the candidates at hand. */
static inline struct boyse_pair *world_pair(const struct carom_world *w)
{
    PHASE_ASSERT(w->scratch_phase, WORLD_GATHER);
    return &w->scratch->gather.pair;
}

static inline const struct world_state *world_now(const struct carom_world *w)
{
    return w->now;
}

/* The state that is not current. */
static inline struct world_state *world_next(struct carom_world *w)
{
    return &w->states[w->now == w->states];
}

/* True if a state's place and speed are within what the formats hold. */
bool world_in_range(const struct body *b, const struct body_state *s);

/*
 * True if a rotation has length 1 within 2^-10; makes it exactly 1. All zero becomes no rotation.
 */
bool world_rotation_valid(carom_quat_q30 *q);

/* True if each coordinate is within BODY_WORLD_LIMIT. */
bool world_position_in_range(const carom_v3_q32 *p);
/*
 * True if a state that was read, with the forces in body_loaded and this gravity, could be what a
 * step has left.
 */
bool world_plausible(struct carom_world *w, const struct world_state *s,
                     const carom_v3_q40 *gravity);

/* An id is a body's number with its generation in the bits above. */
#define WORLD_NUMBER_BITS 12

/*
 * Turn a number or id into the number; false if there is no such body. Every public function that
 * takes a body calls this first.
 */
bool world_find_body(const struct carom_world *w, int *body);

/*
 * The extra of a body; takes one from the pool if it has none; NULL if the pool is full. A new
 * extra changes nothing: its fields say what holds for a body without one.
 */
struct body_extra *world_extra(struct carom_world *w, uint32_t body);
/* Give the extra of a body back, if it has one; the body is cleared next. */
void world_drop_extra(struct carom_world *w, uint32_t body);

/* True if each component is at most `limit` in size. */
bool world_each_within(const int64_t v[3], int64_t limit);

/* True if a body may be given this velocity and spin. */
bool world_motion_in_range(const struct body *b, const carom_v3_q40 *v, const carom_v3_q40 *spin);

/*
 * Give a state a velocity and a spin that the body may be given. Momenta are rounded, and a step
 * retires a body at the limit: so just below the limit the momentum is reduced by 2^-25 of itself.
 */
void world_set_motion(const struct body *b, struct body_state *s, const carom_v3_q40 *v,
                      const carom_v3_q40 *spin);

/* True if each component of a gravity is within +-1. */
bool world_gravity_in_range(const carom_v3_q40 *gravity);

/*
 * Set the acceleration of a body by scaled gravity and a force; 0 for a stationary body. Returns
 * false if it is out of range.
 */
bool world_acceleration(const struct body *b, int32_t gravity_scale_q16,
                        const carom_v3_q40 *gravity, const carom_v3_q40 *force, carom_v3_q40 *out);

/* Everything that acts on a body; true if that needs an extra. */
struct carom_forces world_forces(const struct body *b);
bool world_forces_need_extra(const struct carom_forces *f);
/* Set everything that acts on a body. Returns false if it needs an extra and there is none. */
bool world_set_forces(struct carom_world *w, uint32_t body, const struct carom_forces *f);
/* Check forces, damping and gravity for a body. Returns CAROM_OK or an error. */
int world_check_forces(const struct body *b, const carom_v3_q40 *gravity,
                       const struct carom_forces *f);
/* (a b - c d) / 2^32 to nearest; false if it has more than 61 bits. */
bool world_cross_q40(int64_t a_q32, int64_t b_q40, int64_t c_q32, int64_t d_q40, int64_t *out);
/* 64 m r, the largest angular momentum that can be given: at most 2^61. */
int64_t world_most_angular_q40(const struct body *b);
/* True if a moving body's momenta are those of a motion that could be given. */
bool world_momenta_in_range(const struct body *b, const struct body_state *s);

/*
 * Give a body a state, in both of the world's states, since a step need not copy bodies that stand
 * still; and set what follows from it.
 */
void world_put(struct carom_world *w, uint32_t body, const struct body_state *state);

/* Set the mass of a moving body, see carom_body_def. Returns CAROM_OK or an error. */
int world_set_mass(struct body *b, uint32_t mass_q20);

/* Forget the kept impulses of a body's contacts: they do not fit the next ones. */
void world_forget_impulses(struct carom_world *w, uint32_t body);

/* Set a body's acceleration after gravity or its force has changed. */
void world_accelerate(struct carom_world *w, uint32_t body);

/* True if a joint lets the bodies of a pair ignore each other. */
static inline bool world_ignores(const struct carom_world *w, uint32_t a, uint32_t b)
{
    uint32_t place;

    return w->ignored_count > 0 && broad_find(w->ignored, w->ignored_count, a, b, &place);
}

/* Wake every body. */
void world_wake_all(struct carom_world *world);

/* Wake a body with its island. */
void world_wake_island(struct carom_world *world, uint32_t body);

/* Wake a body, and the islands that touch it or are near it. */
void world_wake_around(struct carom_world *world, uint32_t body);

/* Wake the islands that have a contact in the list. Returns true if there was any. */
bool world_wake_touched(struct carom_world *world, struct body_state *states);

/*
 * Pairs that overlap and do not touch: a sensor and the bodies in it; a body and a surface that is
 * solid from the other side; bodies that a filter let touch, or that were set into each other,
 * until they are apart. They share the room of the touching pairs, which come first.
 */
static inline struct pair *world_through(const struct carom_world *w, const struct world_state *s)
{
    return s->touching + w->config.caps.pairs - s->through_count;
}
/* Two bodies in the order of a pair, as broad has it; one of them must move. */
struct pair world_name_pair(const struct carom_world *w, uint32_t i, uint32_t k);
/* True if a pair passes through; note that it does: CAROM_OK or CAROM_ERR_PAIRS_FULL. */
bool world_goes_through(const struct carom_world *w, const struct world_state *s,
                        const struct pair *p);
int world_note_through(const struct carom_world *w, struct world_state *s, const struct pair *p);
/* Remove the pairs of a body from that list. */
void world_drop_through(const struct carom_world *w, struct world_state *s, uint32_t body);

/* True if two bodies cross, or one is inside the other. Uses the scratch. */
bool world_overlap(struct carom_world *w, struct interfere_placed a, struct interfere_placed b);

/*
 * Before body `place` gets a state: if it would cross bodies that it may touch, by more than about
 * a skin, refuse with CAROM_ERR_OVERLAP, or push it out, or check that there is room for the pairs
 * that will pass.
 */
int world_settle(struct carom_world *w, const struct body *b, uint32_t place,
                 struct body_state *state, int overlap);
/* Let a body pass the bodies that it crosses: those for which world_settle found room. */
void world_let_pass(struct carom_world *w, uint32_t body);

/* Give a body a filter; all zero is the default. */
void world_filter(struct body *b, const struct carom_filter *filter);

/* True if the pool has an extra for a body without one. */
static inline bool world_may_have_extra(const struct carom_world *w)
{
    return w->pools[CAROM_POOL_extras].used < w->pools[CAROM_POOL_extras].size;
}

/* True if a body is kinematic. */
bool world_is_kinematic(const struct body *b);
/* The motion of a body; for a kinematic body, the motion by which it is led. */
void world_motion(const struct body *b, const struct body_state *s, carom_v3_q40 *velocity,
                  carom_v3_q40 *spin);
#define WORLD_ROUTE_SPIN_MAX_Q40 3454217652358LL /* pi */
bool world_drive_in_range(const struct body *b, const carom_v3_q40 *v, const carom_v3_q40 *spin);
bool world_pose_in_reach(const struct body *b, const struct body_state *s,
                         const carom_v3_q32 *position, const carom_quat_q30 *rotation);
/*
 * world_leads: true if a drive leads a body anywhere. world_drive_on: the drive of a velocity and a
 * spin. world_drive: lead a body from now on.
 */
bool world_leads(const struct body_drive *drive, const struct body_state *s);
struct body_drive world_drive_on(const carom_v3_q40 *v, const carom_v3_q40 *spin);
void world_drive(struct carom_world *w, uint32_t body, const struct body_drive *drive);
/* True if a drive that was read leads the body somewhere, and is in range. */
bool world_drive_plausible(const struct body *b, const struct body_state *s,
                           const struct body_drive *drive);
/* End the routes to poses: the bodies are there, or were stopped, and stand still. */
void world_halt_routes(struct carom_world *w);

/* True if the squared length of n numbers in q30 is 1 within 2^-bits. */
bool world_is_unit(const int32_t *v, int n, int bits);

/* End the motion of moved surfaces. */
void world_halt_surfaces(struct carom_world *world);

#endif
