/* SPDX-License-Identifier: MIT */
/*
 * contact - the paper's static interference check: where bodies touch in a fixed pose, with
 * positions and normals, each place once.
 */
#ifndef CAROM_SRC_CONTACT_H
#define CAROM_SRC_CONTACT_H

#include "../boyse/boyse.h"

/* One of a contact's two bodies. Index 0 is a, 1 is b. */
struct contact_side {
    struct body *body; /* NULL: stationary; the rest is then without meaning */
    /* from the centre of mass to the contact, over the body's unit of length */
    int32_t arm_q30[3];
};

/* What an impulse at a contact does to one of its bodies, in the solver's units (rest.h). */
struct contact_lever {
    int32_t share_q30;  /* the lighter body's mass over this one's, at most 1 */
    int32_t turn[3][3]; /* rows: the velocity of the place by du, below 2^30 */
};

/* What the shared memory of a contact, of its work and of a pair's rolling holds. */
enum contact_phase { CONTACT_IMPULSE, CONTACT_VELOCITY, CONTACT_GAIN };
enum contact_work_phase { CONTACT_INVERSE, CONTACT_WANTED };
enum contact_roll_phase { CONTACT_ROLLING, CONTACT_MOMENT };

/* Rolling friction of a pair, at its first contact in an island; by solve/roll.c. */
struct contact_roll {
    int8_t unit_bits; /* of length: the shorter of the two bodies' */
    PHASE_TAG(phase)
    int32_t arm_q30;  /* the patch over which contacts press, in that unit */
    int32_t mass_q24; /* change of spin by a unit moment, at most */
    int32_t step_q24; /* its inverse */
    union {           /* by PHASE_TAG phase; contact_rolling, contact_moment */
        struct {
            int32_t spin[3]; /* relative, before the solve, in solver units */
            int32_t gain[3], way[3];
            int32_t moment[3]; /* accumulated */
        };
        carom_v3_q40 moment_q40; /* the result, when the sweeps are over: on a, its opposite on b */
    };
};

/*
 * What the solver works out of a contact of the island at hand, and needs no longer than that. It
 * lies apart from the contact, where other stages have their own.
 */
struct contact_work {
    struct contact_lever lever[2];
    struct contact_roll *roll; /* of the pair, if this is the contact that has it; else NULL */
    bool rolls : 1;            /* and it takes part in the sweeps at hand */
    bool waits : 1;            /* K, in place of its inverse: until the contact pushes */
    bool inverted : 1;         /* false: K is too uneven for an inverse in 30 bits */
    bool slides : 1;           /* drag_q28 and step are there: from the first time that it slides */
    bool b_lighter : 1;        /* than a */
    int8_t fine_bits;          /* of impulses, below the solver's unit */
    int8_t k_shift;            /* K that waits has 30 - k_shift fractional bits */
    PHASE_TAG(phase)
    int32_t band_q30;       /* slip that friction does not resist: what closing the gap asks for */
    int32_t band;           /* it in solver units */
    int64_t target_q40;     /* wanted V'.N */
    int32_t mass_q24;       /* velocity by a unit impulse: the largest along an axis */
    int32_t drag_q28[3];    /* the part of K N across N, over the part along it */
    int32_t step[2];        /* of a sweep when it slides, so too: along N, and one scalar across */
    union {                 /* by PHASE_TAG phase; contact_inverse, contact_wanted */
        int32_t inverse[6]; /* K^-1 with 30 - fine_bits fractional bits: xx yy zz xy yz zx */
        carom_v3_q40 wanted_q40; /* while the energy rule looks for less: without friction */
    };

    /* the sweeps', in solver units */
    uint32_t friction_q16;
    int32_t before[3]; /* V - wanted N before, with a slip that sweeps can follow */
    int64_t normal_impulse, tangent_impulse[3]; /* accumulated, along N and across */
};

struct contact {
    /* found by the static check */
    struct candidate key;
    carom_v3_q30 normal; /* N, from b into a */
    int32_t gap_q22;
    int32_t skin_q22;    /* of the pair */
    carom_v3_q40 *drift; /* how a surface moves there beside its body; NULL: not at all */
    struct contact_side side[2];

    /* worked out by the solver */
    struct contact_work *work; /* NULL: not yet taken up */
    /* contacts[n].order is the n-th contact when islands come one after the other */
    uint16_t order;
    bool idle : 1;    /* nothing asks for its island to be solved now */
    bool resting : 1; /* solved without any impact in its island */
    bool impact : 1;
    bool lasting : 1; /* by the step: its pair has hit again and again in the frame */
    bool doubted : 1; /* it was there, and is not found again yet */
    PHASE_TAG(phase)
    int32_t
        chord_q28; /* how fast the gap opens on the path, from its start to its end, at most 8 */
    int64_t speed_q40; /* V.N before */
    union {            /* by PHASE_TAG phase; contact_velocity, contact_gain, contact_impulse */
        struct {
            /* change of the impulse in two sweeps, and the way it is going */
            int32_t gain[3], way[3];
        };
        carom_v3_q40 velocity_q40; /* V before, until the sweeps begin */
        carom_v3_q40 impulse_q40;  /* the result, when they are over: P on a, -P on b */
    };
};

/* The velocity before, of a contact at which sweeps have not begun. */
static inline carom_v3_q40 *contact_velocity(struct contact *c)
{
    PHASE_ASSERT(c->phase, CONTACT_VELOCITY);
    return &c->velocity_q40;
}

/* A contact in the sweeps: for `gain` and `way`. */
static inline struct contact *contact_gain(struct contact *c)
{
    PHASE_ASSERT(c->phase, CONTACT_GAIN);
    return c;
}

/* The impulse, of a contact that was solved or not taken up. */
static inline const carom_v3_q40 *contact_impulse(const struct contact *c)
{
    PHASE_ASSERT(c->phase, CONTACT_IMPULSE);
    return &c->impulse_q40;
}

static inline void contact_set_impulse(struct contact *c, const carom_v3_q40 *impulse)
{
    PHASE_ASSERT(c->phase, CONTACT_IMPULSE);
    c->impulse_q40 = *impulse;
}

/* K^-1, until the energy rule takes its room for the impulse that was wanted. */
static inline int32_t *contact_inverse(const struct contact *c)
{
    PHASE_ASSERT(c->work->phase, CONTACT_INVERSE);
    return c->work->inverse;
}

static inline carom_v3_q40 *contact_wanted(const struct contact *c)
{
    PHASE_ASSERT(c->work->phase, CONTACT_WANTED);
    return &c->work->wanted_q40;
}

/* The lighter one of a contact's bodies that move; its unit of impulses is 2^-fine_bits of that one's mass. */
static inline const struct body *contact_lighter(const struct contact *c)
{
    return c->side[c->work->b_lighter ? 1 : 0].body;
}

static inline struct fix_scaled contact_mass_unit(const struct contact *c)
{
    struct fix_scaled unit = contact_lighter(c)->def.mass;

    unit.e += c->work->fine_bits;
    return unit;
}

/* Rolling in the sweeps; and the moment when they are over. */
static inline struct contact_roll *contact_rolling(const struct contact *c)
{
    PHASE_ASSERT(c->work->roll->phase, CONTACT_ROLLING);
    return c->work->roll;
}

static inline carom_v3_q40 *contact_moment(const struct contact *c)
{
    PHASE_ASSERT(c->work->roll->phase, CONTACT_MOMENT);
    return &c->work->roll->moment_q40;
}

/* e and mu of a contact of which a body's faces are of several materials. */
struct contact_mixed {
    int32_t restitution_q30; /* -1: there is only a drift, and both are the bodies' */
    uint32_t friction_q16;
};

/*
 * Materials of a contact's faces, where a body has an extra: the motion of b's surface along itself, past that of a,
 * is added to the drift. Returns whether e and mu are others than the bodies'.
 */
struct contact_list;
typedef bool contact_materials(const struct contact_list *list, const struct boyse_pair *pair,
                               const struct candidate *key, const carom_v3_q30 *normal,
                               carom_v3_q40 *drift, struct contact_mixed *mixed);
extern contact_materials contact_mix_materials;

/* The contacts of a world at the present poses, sorted by key, with their pool. */
struct contact_list {
    struct contact *contacts;
    struct pool *pool;
    carom_v3_q40 *drifts; /* as many as there is room for contacts; NULL where no surface moves */
    struct contact_mixed *mixed;  /* one for each of those; NULL where no body has an extra */
    contact_materials *materials; /* NULL: no body was given any, and nothing of them is linked */
    uint16_t next_drift;          /* where a free one is looked for first */
    uint8_t restitution_rule : 2; /* enum carom_combine */
    uint8_t friction_rule : 2;
    bool plain; /* a step: no body has an extra, and e and mu of a contact are the smaller ones */
};

/*
 * Where the features of a candidate meet in the placed poses, halfway between the surfaces, as arms
 * from both centres of mass: arm[0] - arm[1] is what lies between the centres.
 *
 *   normal  N, across both features; edges: not parallel
 * Error     of a vertex 2^-31 of its distance from the centre; of edges that over their sine
 */
void contact_place(const struct boyse_pair *pair, const struct candidate *c,
                   const carom_v3_q30 *normal, carom_v3_q40 arm[2]);

/* Contacts whose normals' cosine is above this share a normal: 1 - 1e-4. */
#define CONTACT_SAME_NORMAL_Q30 (CAROM_ONE_Q30 - 107374)

/* Faces lie on each other when no part of their normals differs by more. */
#define CONTACT_LEAN_MAX_Q30 (CAROM_ONE_Q30 >> 10)

/*
 * The normal of two edges that border faces which lie on each other, in the placed poses: that of
 * b's face, if it is nearly the same. Others stay as they are.
 */
void contact_flatten(const struct boyse_pair *pair, const struct candidate *c,
                     carom_v3_q30 *normal);

/* Fractional bits of arm_q30 taken as a length. */
inline int contact_arm_bits(const struct body *b)
{
    return 30 + 22 - b->def.unit_bits;
}

/* From the centre of mass of a, which moves, to the contact; and the place in the world. */
inline int32_t contact_arm_along(const struct contact *c, int k)
{
    int down = contact_arm_bits(c->side[0].body) - 22;

    return (int32_t)fix_round(c->side[0].arm_q30[k], down);
}

inline carom_v3_q22 contact_arm(const struct contact *c)
{
    return (carom_v3_q22){
        {contact_arm_along(c, 0), contact_arm_along(c, 1), contact_arm_along(c, 2)}};
}

carom_v3_q32 contact_point(const struct contact *c);

/*
 * Take in a contact of a pair at a place. One of that key stays as it was. A full list is merged
 * first; returns false when that leaves no room.
 */
bool contact_insert(struct contact_list *list, const struct boyse_pair *pair,
                    const struct candidate *key, const carom_v3_q30 *normal, int32_t gap_q22,
                    const carom_v3_q40 arm[2]);

/*
 * Take in a candidate if its features touch within `margin` in the placed poses: as the visitor of
 * all candidates does. Returns false when the list is full. clear_q22: see boyse_static.
 */
bool contact_add(struct contact_list *list, const struct boyse_pair *pair,
                 const struct candidate *c, int32_t margin_q22, int32_t *clear_q22);

/*
 * Make sure that the pair of a hit is among the contacts, with the normal found at the root and the
 * place of its features in the placed poses; the surfaces may be farther apart than the margin along
 * another normal by now. It takes the place of contacts of the same vertex with nearly the same
 * normal, and the least gap of them.
 */
bool contact_force(struct contact_list *list, const struct boyse_pair *pair,
                   const struct boyse_hit *hit);

/*
 * How the surface of b moves at a contact, in world axes: what it moved by since the last step, a
 * frame; of a kinematic body, how it goes on its route; 0 for all else.
 *   arm  from b's centre to the contact
 */
void contact_drift(const struct boyse_pair *pair, const struct candidate *key,
                   const carom_v3_q40 *arm, carom_v3_q40 *drift);

/* Remember it with the contact, when it is not 0 or when there is `mixed`. */
void contact_keep_drift(struct contact_list *list, struct contact *c, const carom_v3_q40 *drift,
                        const struct contact_mixed *mixed);

/* e and mu of a pair from those of both. */
int32_t contact_mix_restitution(const struct contact_list *list, int32_t a_q30, int32_t b_q30);
uint32_t contact_mix_friction(const struct contact_list *list, uint32_t a_q16, uint32_t b_q16);
/* The e and mu that a contact remembers; NULL: it has those of the bodies. */
static inline const struct contact_mixed *contact_mixed(const struct contact_list *list,
                                                        const struct contact *c)
{
    const struct contact_mixed *mixed =
        list->mixed && c->drift ? &list->mixed[c->drift - list->drifts] : NULL;

    return mixed && mixed->restitution_q30 >= 0 ? mixed : NULL;
}

/*
 * The face of a side of a contact that looks most along N, or against it for a: the face itself, one at the
 * edge, one around the vertex. The lower number of two that do so alike.
 */
uint32_t contact_face(const struct body *b, const struct candidate *key, int side,
                      const carom_v3_q30 *normal);

/* The part of the drift along the normal. */
static inline int64_t contact_rise_q40(const carom_v3_q40 *drift, const carom_v3_q30 *n)
{
    return fix_dot_q30(drift->c, n->c);
}

/*
 * Merge contacts of a pair that share place and normal; the smallest gap stays.
 * Indeterminate cases are settled here and by the normal cones: a vertex on a vertex or an edge
 * answers to every face normal in its cone, and what coincides becomes one.
 */
void contact_merge(struct contact_list *list);

/*
 * Drop contacts among the n of a pair that carry nothing: those on one plane that hardly stand out between two
 * others. Returns how many are left, at the beginning.
 */
uint32_t contact_thin(struct contact *contacts, uint32_t n);

/* The contacts of a pair follow each other: they are at first .. end - 1. */
struct contact_range {
    uint32_t first, end;
};
struct contact_range contact_of_pair(const struct contact_list *list, uint16_t pair);
/* The end of the contacts of a pair that begin at `first`. */
static inline uint32_t contact_pair_end(const struct contact_list *list, uint16_t pair,
                                        uint32_t first)
{
    while (first < list->pool->used && list->contacts[first].key.pair == pair) {
        first++;
    }
    return first;
}

/* Take out the contacts of a pair. */
void contact_drop_pair(struct contact_list *list, uint16_t pair);

/*
 * Take out the contacts of many pairs that are looked for again: they are put in doubt pair by pair, those that
 * are found take their room, and in the end all others are dropped. Whether a pair has any not in doubt.
 */
void contact_doubt_pair(struct contact_list *list, uint16_t pair);
bool contact_has_pair(const struct contact_list *list, uint16_t pair);
void contact_drop_doubted(struct contact_list *list);

#endif
