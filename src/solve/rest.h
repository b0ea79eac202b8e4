/* SPDX-License-Identifier: MIT */
/*
 * rest - several contacts at once: continuous contact, and impacts at more than one place.
 * Sweeps of the impact equations over accumulated, clamped impulses, warm-started; and
 * sleep.
 *
 * Solver units. A solve picks a power of two V* above every wanted change of normal velocity and
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

#define REST_BITS         23
#define REST_SWEEPS_MAX   16  /* of an impact */
#define REST_SWEEPS_CALM  60  /* without momentum */
#define REST_SWEEPS_EXACT 120 /* of an impact of a body or two, without momentum */
#define REST_SWEEPS_FEW   40 /* of resting contact at a few places, which goes on in the next frame */
#define REST_SWEEPS_MANY  48 /* and at many */

#define REST_SWEEPS_JOINTS 150

#define REST_QUIET_FRAMES 20 /* before a body may fall asleep */

/* An impulse kept for the next frame; part of the state. */
struct rest_warm {
    uint16_t a, b;
    carom_v3_q22 arm; /* on a, in its mesh's axes */
    carom_v3_q30 normal;
    carom_v3_q40 impulse;
};

/* Its parts along the normal and across it, as a snapshot has them. */
struct rest_warm_parts {
    int64_t normal_q40;
    carom_v3_q40 tangent;
};
struct rest_warm_parts rest_warm_parts(const struct rest_warm *w);
/* The impulse that has these parts. Returns false when there is none. */
bool rest_warm_join(struct rest_warm *w, const struct rest_warm_parts *parts);

struct rest {
    /* room to solve in: a single impact, or many contacts and rolling by pairs; one at a time */
    struct gauss *gauss;
    struct contact_work *works;
    struct contact_roll *rolls;
    struct contact_list list;
    const struct pair *pairs;
    struct body *bodies;
    struct body_state *states;
    uint32_t body_count;

    struct rest_warm *warm; /* read and written; NULL: no warm start */
    uint32_t warm_count;

    /* the island being solved: its first body, and its contacts in the order of islands */
    uint16_t island;
    uint16_t roll_count; /* that roll in it, of `rolls` */
    uint8_t sweep_cap;   /* 0: none but those above */
    bool
        loaded; /* the bodies' velocities are those of the states: only their paths changed since */
    uint32_t first, count;

    uint32_t sweeps, impacts, energy_rules; /* for the statistics */

    struct joint_list joints;
};

/*
 * Find momenta after the contacts of the list, island by island: what happens in one does not show
 * in another. An island is left alone when all of its contacts are idle.
 *
 *   tau_q30   what is left of the frame: resting contacts may close their gap in that time
 *   warm      start from the impulses of the last frame and keep these for the next
 *
 * An island of a single impact is solved by the paper's 9x9 or 15x15, every other by sweeps.
 * Returns  CAROM_OK or CAROM_ERR_RANGE
 * Source   paper eq. (1)-(10), and "continuous contact"
 */
int rest_solve(struct rest *r, int32_t tau_q30, bool warm);

/*
 * The velocities that held rows lack at the end of a frame, of joints that are not idle: paths keep places, and bend
 * velocities. Contacts are left alone, and the impulses kept for the next frame.
 */
int rest_project(struct rest *r);

/* Velocities and spins of the bodies that have contacts, each once, for the next solve; nothing where they are loaded. */
void rest_load_contacts(struct rest *r);

/*
 * Bodies with a contact that is slower than 4 g h, and not idle, take the rest of the frame's
 * gravity at once and move straight. Returns whether any body newly did; only the contacts of such
 * bodies are not idle then.
 */
bool rest_enter_contact(struct rest *r, int32_t tau_q30);

/* v, or +-most; v, or +-(2^31 - 1). */
int32_t rest_within(int64_t v, int32_t most);
int32_t rest_clamp(int64_t v);

/* The moment of rolling friction that a contact was given with its impulse; on a. */
const carom_v3_q40 *rest_moment(const struct contact *c);

/* Part of a velocity or an impulse along a direction. */
static inline int64_t rest_along_q40(const carom_v3_q40 *v, const carom_v3_q30 *n)
{
    return fix_dot_q30(v->c, n->c);
}

/* e and mu of a pair of bodies; at most, where their faces are of several materials. */
int32_t rest_restitution(const struct rest *r, const struct body *a, const struct body *b);
uint32_t rest_friction(const struct rest *r, const struct body *a, const struct body *b);
/* The smaller ones: those of a list that is `plain`. */
inline int32_t rest_plain_restitution(const struct body *a, const struct body *b)
{
    return a->def.restitution_q30 < b->def.restitution_q30 ? a->def.restitution_q30
                                                           : b->def.restitution_q30;
}
inline uint32_t rest_plain_friction(const struct body *a, const struct body *b)
{
    return a->def.friction_q16 < b->def.friction_q16 ? a->def.friction_q16 : b->def.friction_q16;
}

/* The islands of bodies that touch or that joints connect. */
void rest_find_islands(struct rest *r, struct body *bodies, uint32_t body_count,
                       const struct pair *touching, uint32_t touching_count);

/* Count quiet frames and put whole islands, bodies that touch or that joints connect, to sleep. */
void rest_sleep(struct rest *r, const struct pair *touching, uint32_t touching_count);

#endif
