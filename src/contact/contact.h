/* SPDX-License-Identifier: MIT */
/*
 * contact - the paper's static interference check: where bodies touch in a fixed pose, with places
 * and normals, each place once (paper, section 2).
 *
 * In: candidates of a pair in placed poses, or a hit. Out: the list of contacts, sorted by key.
 *
 * Files:
 *   contact.c  the list: test a candidate and add it, add a hit, merge
 *   place.c    the place of a contact, to more digits than the collision test needs
 *   lean.c     edges of faces that lie on each other: one normal
 *   thin.c     drop contacts that carry nothing
 *   drift.c    how a surface or a led body moves at a contact; mix.c: materials
 */
#ifndef CAROM_SRC_CONTACT_H
#define CAROM_SRC_CONTACT_H

#include "../boyse/boyse.h"

/* One of a contact's two bodies. Index 0 is a, 1 is b. */
struct contact_side {
    struct body *body; /* a always moves; NULL: b does not, and the rest is meaningless */
    /* from the centre of mass to the contact, in the body's unit of length */
    int32_t arm_q30[3];
};

/* The effect of an impulse at a contact on one of its bodies, in solver units (rest.h). */
struct contact_lever {
    int32_t share_q30;  /* the lighter body's mass over this one's, at most 1 */
    int32_t turn[3][3]; /* rows: velocity of the place by du, below 2^30 */
};

/* Holders of the shared memory of a contact, of its work, and of a pair's rolling. */
enum contact_phase { CONTACT_IMPULSE, CONTACT_VELOCITY, CONTACT_GAIN };
enum contact_work_phase { CONTACT_INVERSE, CONTACT_WANTED };
enum contact_roll_phase { CONTACT_ROLLING, CONTACT_MOMENT };

/* Rolling friction of a pair, kept at the pair's first contact in an island; by solve/roll.c. */
struct contact_roll {
    int8_t unit_bits; /* unit of length: the shorter of both bodies' */
    PHASE_TAG(phase)
    int32_t arm_q30;  /* radius of the patch over which contacts press, in that unit */
    int32_t mass_q24; /* bound on the change of spin by a unit moment */
    int32_t step_q24; /* its inverse */
    union {           /* by PHASE_TAG phase; contact_rolling, contact_moment */
        struct {
            int32_t spin[3]; /* relative spin before the solve, solver units */
            int32_t gain[3], way[3];
            int32_t moment[3]; /* accumulated */
        };
        carom_v3_q40 moment_q40; /* the result, after the sweeps: on a, its opposite on b */
    };
};

/*
 * The solver's numbers of a contact of the island at hand, needed only while it is solved. They lie
 * apart from the contact, in room that other stages use for their own.
 */
struct contact_work {
    struct contact_lever lever[2];
    struct contact_roll *roll; /* rolling of the pair, if this contact holds it; else NULL */
    bool rolls : 1;            /* and it takes part in the present sweeps */
    bool waits : 1;            /* `inverse` holds K: it is inverted when the contact pushes */
    bool inverted : 1;         /* false: K is too uneven for an inverse of 30 bits */
    bool slides : 1;    /* drag_q28 and step are set: since the contact slid for the first time */
    bool b_lighter : 1; /* than a */
    int8_t fine_bits;   /* fractional bits of impulses, below the solver's unit */
    int8_t k_shift;     /* K has 30 - k_shift fractional bits while it waits */
    PHASE_TAG(phase)
    int32_t band_q30;    /* slip that friction does not resist, since closing the gap asks for it */
    int32_t band;        /* the same in solver units */
    int64_t target_q40;  /* wanted V'.N */
    int32_t mass_q24;    /* largest velocity along an axis by a unit impulse */
    int32_t drag_q28[3]; /* the part of K N across N, over the part along it */
    int32_t step[2];     /* of a sweep if the contact slides: along N, and a scalar across */
    union {              /* by PHASE_TAG phase; contact_inverse, contact_wanted */
        int32_t inverse[6];      /* K^-1 with 30 - fine_bits fractional bits: xx yy zz xy yz zx */
        carom_v3_q40 wanted_q40; /* while the energy rule solves without friction */
    };

    /* of the sweeps, in solver units */
    uint32_t friction_q16;
    int32_t before[3]; /* V - wanted N before, with a slip that sweeps can follow */
    int64_t normal_impulse, tangent_impulse[3]; /* accumulated, along N and across */
};

struct contact {
    /* from the static check */
    struct candidate key;
    carom_v3_q30 normal; /* N, from b into a */
    int32_t gap_q22;
    int32_t skin_q22;    /* the pair's */
    carom_v3_q40 *drift; /* velocity of a surface there beside its body's; NULL: none */
    struct contact_side side[2];

    /* from the solver */
    struct contact_work *work; /* NULL: not yet prepared */
    /* contacts[n].order is the n-th contact in the order of islands */
    uint16_t order;
    bool idle : 1;    /* its island need not be solved now */
    bool resting : 1; /* solved without any impact in its island */
    bool impact : 1;
    bool lasting : 1; /* by step: its pair has hit again and again in the frame */
    bool doubted : 1; /* it was there before, and has not been found again yet */
    PHASE_TAG(phase)
    int32_t chord_q28; /* mean speed at which the gap opens on the path; INT32_MAX: not set */
    int64_t speed_q40; /* V.N before */
    union {            /* by PHASE_TAG phase; contact_velocity, contact_gain, contact_impulse */
        struct {
            /* change of the impulse by a sweep; the step beyond the sweep before */
            int32_t gain[3], way[3];
        };
        carom_v3_q40 velocity_q40; /* V before, until the sweeps begin */
        carom_v3_q40 impulse_q40;  /* the result, after the sweeps: P on a, -P on b */
    };
};

/* V before, of a contact whose sweeps have not begun. */
static inline carom_v3_q40 *contact_velocity(struct contact *c)
{
    PHASE_ASSERT(c->phase, CONTACT_VELOCITY);
    return &c->velocity_q40;
}

/* A contact in the sweeps, for `gain` and `way`. */
static inline struct contact *contact_gain(struct contact *c)
{
    PHASE_ASSERT(c->phase, CONTACT_GAIN);
    return c;
}

/* The impulse of a contact that was solved or never prepared. */
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

/* K^-1, until the energy rule uses its room for the wanted impulse. */
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

/*
 * The lighter one of a contact's moving bodies. The unit of impulses is 2^-fine_bits of its mass.
 */
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

/* Rolling during the sweeps; the moment after them. */
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

/* e and mu of a contact if a body's faces are of several materials. */
struct contact_mixed {
    int32_t restitution_q30; /* -1: there is only a drift; e and mu are the bodies' */
    uint32_t friction_q16;
};

/*
 * Mix the materials of a contact's faces, if a body has an extra. Adds to the drift the motion of
 * b's surface along itself relative to a's. Returns true if e and mu differ from the bodies'.
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
    carom_v3_q40 *drifts;         /* room for one a contact; NULL if no surface moves */
    struct contact_mixed *mixed;  /* one for each of those; NULL if no body has an extra */
    contact_materials *materials; /* NULL, and not linked: no body was given materials */
    uint16_t next_drift;          /* where the search for a free drift starts */
    uint8_t restitution_rule : 2; /* enum carom_combine */
    uint8_t friction_rule : 2;
    bool plain; /* in a step: no body has an extra, and e and mu are the smaller ones */
};

/*
 * Where the features of a candidate meet in the placed poses, halfway between the surfaces, as arms
 * from both centres of mass: arm[0] - arm[1] is the way between the centres.
 *
 *   normal  N, across both features; edges must not be parallel
 *
 * Error     of a vertex 2^-31 of its distance from the centre; of edges that over their sine
 */
void contact_place(const struct boyse_pair *pair, const struct candidate *c,
                   const carom_v3_q30 *normal, carom_v3_q40 arm[2]);

/*
 * If both edges of a candidate border faces that lie on each other in the placed poses, and b's
 * face has nearly this normal, make it b's face's normal. Otherwise the normal stays.
 */
void contact_flatten(const struct boyse_pair *pair, const struct candidate *c,
                     carom_v3_q30 *normal);

/* Fractional bits of arm_q30 as a length. */
inline int contact_arm_bits(const struct body *b)
{
    return 30 + 22 - b->def.unit_bits;
}

/* The arm from a's centre of mass; a moves. contact_point: the contact's place in the world. */
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
 * Insert a contact of a pair at a place. A contact of that key stays as it was. A full list is
 * merged first; returns false if that leaves no room.
 */
bool contact_insert(struct contact_list *list, const struct boyse_pair *pair,
                    const struct candidate *key, const carom_v3_q30 *normal, int32_t gap_q22,
                    const carom_v3_q40 arm[2]);

/*
 * Insert a candidate if its features touch within `margin` in the placed poses. Returns false if
 * the list is full. clear_q22: see boyse_static.
 */
bool contact_add(struct contact_list *list, struct boyse_pair *pair, const struct candidate *c,
                 int32_t margin_q22, int32_t *clear_q22);

/*
 * Make sure that a hit is among the contacts, with the normal found at the root and the place of
 * its features in the placed poses; along another normal the surfaces may be farther apart than the
 * margin by now. It replaces contacts of the same vertex with nearly the same normal, and takes the
 * least gap of them.
 */
bool contact_force(struct contact_list *list, const struct boyse_pair *pair,
                   const struct boyse_hit *hit);

/*
 * The velocity of b's surface at a contact, in world axes: its displacement since the last step, a
 * frame; for a kinematic body, its motion on the route; else 0.
 *   arm  from b's centre to the contact
 */
void contact_drift(const struct boyse_pair *pair, const struct candidate *key,
                   const carom_v3_q40 *arm, carom_v3_q40 *drift);

/* Store a drift with the contact, if it is not 0 or if there is `mixed`. */
void contact_keep_drift(struct contact_list *list, struct contact *c, const carom_v3_q40 *drift,
                        const struct contact_mixed *mixed);

/* e and mu of a pair from those of both bodies. */
int32_t contact_mix_restitution(const struct contact_list *list, int32_t a_q30, int32_t b_q30);
uint32_t contact_mix_friction(const struct contact_list *list, uint32_t a_q16, uint32_t b_q16);
/* The e and mu that a contact stores; NULL: the bodies'. */
static inline const struct contact_mixed *contact_mixed(const struct contact_list *list,
                                                        const struct contact *c)
{
    const struct contact_mixed *mixed =
        list->mixed && c->drift ? &list->mixed[c->drift - list->drifts] : NULL;

    return mixed && mixed->restitution_q30 >= 0 ? mixed : NULL;
}

/*
 * The face of a contact's side that looks most along N, or for a against it: the face itself, a
 * face at the edge, or a face at the vertex. If two are equal, the one with the lower number.
 */
uint32_t contact_face(const struct body *b, const struct candidate *key, int side,
                      const carom_v3_q30 *normal);

/* Count the surface as standing still along the normal: its drift and V, of a contact before sweeps, lose that part. */
void contact_hold_drift(struct contact *c, int64_t rise_q40);
/* The part of the drift along the normal. */
static inline int64_t contact_rise_q40(const carom_v3_q40 *drift, const carom_v3_q30 *n)
{
    return fix_dot_q30(drift->c, n->c);
}

/*
 * Merge contacts of a pair that share place and normal; the smallest gap stays. This and the normal
 * cones settle indeterminate cases: a vertex on a vertex or an edge answers to every face normal in
 * its cone, and coinciding contacts become one.
 */
void contact_merge(struct contact_list *list);

/*
 * Drop contacts, among the n of a pair, that carry nothing: those on one plane that hardly stand
 * out between two others. Returns how many are left, at the beginning.
 */
uint32_t contact_thin(struct contact *contacts, uint32_t n);

/* The contacts of a pair are neighbours in the list: first .. end - 1. */
struct contact_range {
    uint32_t first, end;
};
struct contact_range contact_of_pair(const struct contact_list *list, uint16_t pair);
/* The end of a pair's contacts, which begin at `first`. */
static inline uint32_t contact_pair_end(const struct contact_list *list, uint16_t pair,
                                        uint32_t first)
{
    while (first < list->pool->used && list->contacts[first].key.pair == pair) {
        first++;
    }
    return first;
}

/* Remove the contacts of a pair. */
void contact_drop_pair(struct contact_list *list, uint16_t pair);

/*
 * Look again for the contacts of many pairs. contact_doubt_pair puts a pair's contacts in doubt;
 * those that are found again take their room; contact_drop_doubted drops the others at the end.
 * contact_has_pair: true if a pair has a contact that is not in doubt.
 */
void contact_doubt_pair(struct contact_list *list, uint16_t pair);
bool contact_has_pair(const struct contact_list *list, uint16_t pair);
void contact_drop_doubted(struct contact_list *list);

#endif
