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
    /* pairs that go through each other, in order, at the end of that room: world_through */
    uint32_t through_count;
    struct joint_state *joints;
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

/* 720 bytes where a pointer has 32 bits. Fields that are used most come first: code for them is shorter. */
struct carom_world {
    /* world: what the caller gave, and the arrays in the block; 108 bytes */
    struct carom_config config; /* gravity: the present one */
    uint32_t body_count;        /* places in use, free ones in between included */
    bool idle;       /* the last step found nothing awake, and nothing has changed since */
    bool passing;    /* pairs may go through each other: there is or was a reason for it */
    bool sense_anew; /* bodies were added or set: what sleeps may overlap another sensor now */
    PHASE_TAG(scratch_phase)
    struct body *bodies;
    union world_scratch *scratch;
    struct carom_event *events; /* finish */

    /* regions: in order; and what search, answer and interfere keep of each; 8 bytes */
    struct pair *pairs;
    struct pair_work *meetings;

    /* commit: the dynamic state, 60 bytes */
    struct world_state *now; /* which of the two is current */
    struct world_state states[2];

    /* interfere, 144 bytes */
    struct interfere interfere;

    /* contact and solve, 124 bytes */
    struct rest rest;

    /* commit: what happened in the step, and its cost; 104 bytes */
    struct carom_stats stats;
    uint32_t start_tick, mark_tick; /* of the step, and of its last stage mark */
    uint32_t event_count;

    /* all stages: how much of each capacity is used; 144 bytes */
    struct pool pools[CAROM_POOL_COUNT];

    /* world: by the optional capacities; 28 bytes */
    struct body_extra *extras;
    struct carom_hit *hits; /* contacts: those of the events, in their order */
    uint16_t sensors;       /* so many bodies are */
    uint16_t ignored_count;
    struct pair *ignored; /* pairs whose joints let them ignore each other, in order */
    const struct step_joint_calls *joint_steps; /* NULL while there was no joint yet */
    body_route_maker *route_to; /* NULL while no body was led to a pose; nor is it linked then */
};

/*
 * The functions that a step calls for joints. carom_joint_add sets the table, so that who has no joints links none of
 * them.
 */
struct step;
struct step_joint_calls {
    void (*begin)(struct step *s); /* the next state of joints, before anything is solved */
    /* the longest slice of a body, which is that of all it is connected with */
    int32_t (*slice)(const struct step *s, uint32_t i, int32_t left_q30);
    /* the joints to be solved: of all that is awake, whether there are any; of the members */
    bool (*choose_all)(struct step *s);
    void (*choose_members)(struct step *s);
    uint32_t (*connected)(const struct step *s); /* a body that is to be a member, or ISLAND_END */
    bool (*measure)(struct step *s,
                    enum joint_solve solve); /* before a solve; whether it is needed */
    void (*project)(struct step *s);
    int (*break_joints)(struct step *s); /* CAROM_OK or CAROM_ERR_PAIRS_FULL */
    /* energy of an island: what springs took up; what is owed; whether it hangs on what stands still */
    void (*add_springs2)(const struct step *s, uint32_t first, struct fix_wide *sum);
    struct fix_wide *(*owed2)(const struct step *s, uint32_t first);
    void (*ground)(struct step *s);
    /* a body of an island that a kinematic body leads, or any of them does (ISLAND_END); ISLAND_END: there is none */
    uint32_t (*led_by)(const struct step *s, uint32_t first, uint32_t led);
    void (*block_leaders)(struct step *s); /* of members */
    bool (*yield)(struct step *s);         /* whether what leads had to stop after a solve */
    void (*keep_awake)(struct step *s);    /* what kinematic bodies lead */
    void (*wake_led)(struct carom_world *w, uint16_t body);
    /* between steps: a body goes; joints came back from a snapshot */
    void (*forget_body)(struct carom_world *w, uint16_t body);
    void (*regroup)(struct carom_world *w);
    bool (*plausible)(const struct joint *j, const struct joint_state *state); /* what was read */
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

/* Whether a rotation has length 1 within 2^-10, which it is given exactly; all zero becomes no rotation. */
bool world_rotation_valid(carom_quat_q30 *q);

/* Whether each coordinate is within BODY_WORLD_LIMIT. */
bool world_position_in_range(const carom_v3_q32 *p);
/*
 * Forces that are read for a body wait until all of a snapshot is read: in its velocity, its spin and the momentum
 * that a solve saves, which are a step's.
 */
struct carom_forces world_forces_read(const struct carom_world *w, uint32_t body);
void world_keep_forces(const struct carom_world *w, uint32_t body, const struct carom_forces *f);
/* Whether a state that was read, with those forces and this gravity, could be what a step has left. */
bool world_plausible(const struct carom_world *w, const struct world_state *s,
                     const carom_v3_q40 *gravity);

/* An id is a body's number with its generation above. */
#define WORLD_NUMBER_BITS 12

/*
 * Whether there is a body of this number or id; makes it the number. Every public function that takes a
 * body asks this first.
 */
bool world_find_body(const struct carom_world *w, int *body);

/*
 * The extra of a body: one is taken from the pool if it has none, NULL when the pool is full. A new one
 * changes nothing: each field is set to what a body without an extra has.
 */
struct body_extra *world_extra(struct carom_world *w, uint32_t body);
/* Give it back, if there is any. */
void world_drop_extra(struct carom_world *w, uint32_t body);

/* Whether each component is at most `limit` in size. */
bool world_each_within(const int64_t v[3], int64_t limit);

/* Whether a body may be given this velocity and spin. */
bool world_motion_in_range(const struct body *b, const carom_v3_q40 *v, const carom_v3_q40 *w);

/*
 * Give a body's state a velocity and a spin that it may be given. Momenta are rounded, and what a step finds at
 * the limit leaves the world: just below it the momentum is 2^-25 of itself less.
 */
void world_set_motion(const struct body *b, struct body_state *s, const carom_v3_q40 *v,
                      const carom_v3_q40 *w);

/* Whether each component of a gravity is within +-1. */
bool world_gravity_in_range(const carom_v3_q40 *gravity);

/*
 * The acceleration of a body by gravity, so many times, and by a force; 0 for one that stands still. False when it is
 * out of range.
 */
bool world_acceleration(const struct body *b, int32_t gravity_scale_q16,
                        const carom_v3_q40 *gravity, const carom_v3_q40 *force, carom_v3_q40 *out);

/* Everything that acts on a body. */
struct carom_forces world_forces(const struct body *b);
bool world_forces_need_extra(const struct carom_forces *f);
/* Give it that; false when it needs an extra and there is none. */
bool world_set_forces(struct carom_world *w, uint32_t body, const struct carom_forces *f);
/* Whether they are within their ranges, for a body that moves; with gravity, for any: an error or CAROM_OK. */
int world_check_forces(const struct body *b, const carom_v3_q40 *gravity,
                       const struct carom_forces *f);
/* (a b - c d) / 2^32 to nearest; false when that has more than 61 bits. */
bool world_cross_q40(int64_t a_q32, int64_t b_q40, int64_t c_q32, int64_t d_q40, int64_t *out);
/* 64 m r, the most angular momentum that can be given: at most 2^61. */
int64_t world_most_angular_q40(const struct body *b);
/* Whether a moving body's momenta are those of a motion that could be given. */
bool world_momenta_in_range(const struct body *b, const struct body_state *s);

/*
 * Give a body a state, in both of the world's: a step need not copy what stands still. What follows
 * from it is worked out again.
 */
void world_put(struct carom_world *w, uint32_t body, const struct body_state *state);

/* Set the mass of a body that moves, see carom_body_def; CAROM_OK or an error. */
int world_set_mass(struct body *b, uint32_t mass_q20);

/* Forget the impulses that a body's contacts kept for the next step: they are none of those to come. */
void world_forget_impulses(struct carom_world *w, uint32_t body);

/* Set what gravity and force give a body in a frame, after one of them has changed. */
void world_accelerate(struct carom_world *w, uint32_t body);

/* Whether a joint lets the bodies of a pair ignore each other. */
static inline bool world_ignores(const struct carom_world *w, uint32_t a, uint32_t b)
{
    uint32_t place;

    if (w->ignored_count == 0) {
        return false;
    }
    place = broad_place_of(w->ignored, w->ignored_count, a, b);
    return place < w->ignored_count && w->ignored[place].a == a && w->ignored[place].b == b;
}

/* Wake every body. */
void world_wake_all(struct carom_world *world);

/* Wake a body with its island. */
void world_wake_island(struct carom_world *world, uint32_t body);

/* Wake a body, and the islands that touch it or are near to where it is. */
void world_wake_around(struct carom_world *world, uint32_t body);

/* Wake the islands that have a contact in the list; returns whether there was any. */
bool world_wake_touched(struct carom_world *world, struct body_state *states);

/*
 * Pairs that overlap and do not touch: a sensor and who is in it, a body and the surface that is solid from its
 * other side, and bodies that a filter let touch, or that were set into each other, until they are apart. They share
 * the room of the pairs that touch: these come first.
 */
static inline struct pair *world_through(const struct carom_world *w, const struct world_state *s)
{
    return s->touching + w->config.caps.pairs - s->through_count;
}
/* Two bodies as the pair that broad makes of them; a pair needs one that moves. */
struct pair world_name_pair(const struct carom_world *w, uint32_t i, uint32_t k);
/* Whether a pair goes through; note that it does: CAROM_OK or CAROM_ERR_PAIRS_FULL. */
bool world_goes_through(const struct carom_world *w, const struct world_state *s,
                        const struct pair *p);
int world_note_through(const struct carom_world *w, struct world_state *s, const struct pair *p);
/* Take out the pairs of a body. */
void world_drop_through(const struct carom_world *w, struct world_state *s, uint32_t body);

/* Whether two bodies cross, or one is inside the other. Takes the scratch. */
bool world_overlap(struct carom_world *w, struct interfere_placed a, struct interfere_placed b);

/*
 * Before a body gets a state (`place` is its number, or UINT32_MAX): where it crosses others that it may touch, by more
 * than about a skin, there is CAROM_ERR_OVERLAP, or it is pushed out, or they are going to pass and there is room for
 * these pairs.
 */
int world_settle(struct carom_world *w, const struct body *b, uint32_t place,
                 struct body_state *state, int overlap);
/* Let a body and those that it crosses pass each other: those for which world_settle found room. */
void world_let_pass(struct carom_world *w, uint32_t body);

/* Give a body a filter: all zero is the default. */
void world_filter(struct body *b, const struct carom_filter *filter);

/* Whether a body that has none could have one. */
static inline bool world_may_have_extra(const struct carom_world *w)
{
    return w->pools[CAROM_POOL_extras].used < w->pools[CAROM_POOL_extras].size;
}

/* Whether a body is kinematic; whether one may be given this velocity and spin, or led to a pose in a frame. */
bool world_is_kinematic(const struct body *b);
/* How a body moves; one that is led on, as it is led. */
void world_motion(const struct body *b, const struct body_state *s, carom_v3_q40 *velocity,
                  carom_v3_q40 *spin);
#define WORLD_ROUTE_SPIN_MAX_Q40 3454217652358LL /* pi */
bool world_drive_in_range(const struct body *b, const carom_v3_q40 *v, const carom_v3_q40 *w);
bool world_pose_in_reach(const struct body *b, const struct body_state *s,
                         const carom_v3_q32 *position, const carom_quat_q30 *rotation);
/* Whether a drive leads a body anywhere; the one of a velocity and a spin; and lead a body from now on. */
bool world_leads(const struct body_drive *drive, const struct body_state *s);
struct body_drive world_drive_on(const carom_v3_q40 *v, const carom_v3_q40 *w);
void world_drive(struct carom_world *w, uint32_t body, const struct body_drive *drive);
/* Whether a drive that was read is one that leads the body somewhere, and in range. */
bool world_drive_plausible(const struct body *b, const struct body_state *s,
                           const struct body_drive *drive);
/* Bodies that were led to a pose are there, or were stopped, and stand still. */
void world_halt_routes(struct carom_world *w);

/* Whether the squared length of n numbers in q30 is 1 within 2^-bits. */
bool world_is_unit(const int32_t *v, int n, int bits);

/* Surfaces that were moved stand still again. */
void world_halt_surfaces(struct carom_world *world);

#endif
