/* SPDX-License-Identifier: MIT */
/*
 * rest - several contacts at once: continuous contact, and impacts at more than one place (paper,
 * section 3: equations (1)-(10), and "continuous contact").
 *
 * In: a list of contacts with places and normals, bodies' momenta, the kept impulses of the last
 * frame, joints. Out: momenta, impulses at contacts, the impulses to keep, quiet frames and sleep.
 *
 * Steps of rest_solve, island by island, and the files that hold them:
 *   order.c        contacts in the order of islands
 *   basics.c       velocities at contacts
 *   share.c        normals that differ by a hair become one
 *   target.c       wanted normal velocity of each contact
 *   masses.c       K and its inverse; steps of the sweeps
 *   impact.c       an island of a single impact: the paper's 9x9 or 15x15
 *   units.c        unit of velocity, begin and end of sweeps; warm.c: kept impulses
 *   sweep.c        sweeps over accumulated, clamped impulses
 *   momentum.c     steps beyond sweeps; roll.c: rolling friction
 *   part.c         what sweeps leave when they run out
 *   rest_energy.c  the energy rule for several contacts
 *
 * Beside it: rest.c (the order above, rest_enter_contact), sleep.c, rigid.c (islands as one rigid
 * body), joint*.c (joints). parts.h is what these files share.
 *
 * Solver units. A solve picks a power of two V* above every wanted change of normal velocity, and
 * counts velocities in units of V* / 2^REST_BITS. An impulse is counted in that unit of velocity
 * times the lighter body's mass, spin in that unit over the body's unit of length. So every number
 * has about the same size whatever the masses, sizes and speeds.
 */
#ifndef CAROM_SRC_REST_H
#define CAROM_SRC_REST_H

#include "../contact/contact.h"
#include "../pairs/island.h"
#include "impact.h"
#include "joint.h"

#define REST_BITS 23

/* An impulse kept for the next frame; part of the state. */
struct rest_warm {
    uint16_t a, b;
    carom_v3_q22 arm; /* from a's centre of mass, in a's mesh axes */
    carom_v3_q30 normal;
    carom_v3_q40 impulse;
};

/* The same impulse as its parts along the normal and across it, for snapshots. */
struct rest_warm_parts {
    int64_t normal_q40;
    carom_v3_q40 tangent;
};
struct rest_warm_parts rest_warm_parts(const struct rest_warm *warm);
/* Set the impulse that has these parts. Returns false if there is none. */
bool rest_warm_join(struct rest_warm *warm, const struct rest_warm_parts *parts);

struct rest {
    /* scratch: one impact (gauss), or contacts and rolling pairs; one use at a time */
    struct gauss *gauss;
    struct contact_work *works;
    struct contact_roll *rolls;
    struct contact_list list;
    const struct pair *pairs;
    struct body *bodies;
    struct body_state *states;
    uint32_t body_count;

    struct rest_warm *warm; /* read, then written; NULL: no warm start */
    uint32_t warm_count;

    /*
     * the island being solved: its first body; its contacts are `count` from `first` on, in the
     * order of islands
     */
    uint16_t island;
    uint16_t roll_count; /* number of `rolls` in use by the island */
    uint8_t sweep_cap;   /* limit of sweeps; 0: those above */
    bool loaded;         /* the bodies' velocities are those of the states */
    uint32_t first, count;

    uint32_t sweeps, impacts, energy_rules; /* for statistics */

    struct joint_list joints;
};

/*
 * Find momenta after the contacts of the list, island by island; islands do not affect each other.
 * An island is skipped if all of its contacts are idle.
 *
 *   tau_q30   rest of the frame: resting contacts may close their gap in that time
 *   warm      start from the impulses of the last frame and keep these for the next
 *
 * An island of a single impact is solved by the paper's 9x9 or 15x15, any other by sweeps. Returns
 * CAROM_OK or CAROM_ERR_RANGE Source   paper eq. (1)-(10), and "continuous contact"
 */
int rest_solve(struct rest *r, int32_t tau_q30, bool warm);

/*
 * At the end of a frame, give held rows of joints that are not idle the velocities that they lack:
 * paths keep places, but bend velocities. Contacts and kept impulses are untouched.
 */
int rest_project(struct rest *r);

/*
 * Load velocity and spin of each body that has a contact, once, for the next solve; nothing if
 * r->loaded.
 */
void rest_load_contacts(struct rest *r);

/*
 * Mark bodies that have a contact slower than 4 g h and not idle as BODY_ENTERS. Returns true if any
 * body newly is; then only contacts of such bodies are not idle. The caller gives these bodies the
 * rest of the frame's gravity and calls rest_load_entered before the next solve.
 */
bool rest_enter_contact(struct rest *r);
/* Load the velocities of the bodies that entered contact. */
void rest_load_entered(struct rest *r);

/* v clamped to +-most; v clamped to +-(2^31 - 1). */
int32_t rest_within(int64_t v, int32_t most);
int32_t rest_clamp(int64_t v);

/* The moment of rolling friction on a that goes with a contact's impulse. */
const carom_v3_q40 *rest_moment(const struct contact *c);

/* The part of a velocity or an impulse along a direction. */
static inline int64_t rest_along_q40(const carom_v3_q40 *v, const carom_v3_q30 *n)
{
    return fix_dot_q30(v->c, n->c);
}

/*
 * True if bodies of this restitution keep all energy at a hit and so bounce for ever. Such bodies
 * rest only where they already lie, their margin is narrower, and they have no rolling friction.
 */
static inline bool rest_bounces_for_ever(int32_t e_q30)
{
    return e_q30 >= CAROM_ONE_Q30;
}

/* e of a pair of bodies; the largest possible one if their faces are of several materials. */
int32_t rest_restitution(const struct rest *r, const struct body *a, const struct body *b);
/* The smaller e and mu of both bodies, which a `plain` list uses. */
inline int32_t rest_plain_restitution(const struct body *a, const struct body *b)
{
    return a->def.restitution_q30 < b->def.restitution_q30 ? a->def.restitution_q30
                                                           : b->def.restitution_q30;
}
inline uint32_t rest_plain_friction(const struct body *a, const struct body *b)
{
    return a->def.friction_q16 < b->def.friction_q16 ? a->def.friction_q16 : b->def.friction_q16;
}

/* Find the islands of bodies that touch or that joints connect. */
void rest_find_islands(struct rest *r, struct body *bodies, uint32_t body_count,
                       const struct pair *touching, uint32_t touching_count);

/*
 * Count quiet frames, and put whole islands of bodies that touch or that joints connect to sleep.
 */
void rest_sleep(struct rest *r, const struct pair *touching, uint32_t touching_count);

#endif
