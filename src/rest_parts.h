/* SPDX-License-Identifier: MIT */
/*
 * rest_parts - what the files of the stage rest share: velocities and masses of contacts, sweeps,
 * and the energy rule.
 */
#ifndef CAROM_SRC_REST_PARTS_H
#define CAROM_SRC_REST_PARTS_H

#include "rest.h"

/* Sweeps end when no velocity changes by more than this, in solver units of 2^-29 V*. */
#define REST_RESIDUAL_IMPACT (1 << (REST_BITS - 26))
#define REST_RESIDUAL_REST   (1 << (REST_BITS - 16))

struct rest_sweep {
    int unit;     /* a solver unit of velocity is 2^unit of q40 */
    bool plastic; /* impacts end at 0: the frictionless solution of the energy rule */
    bool frictionless;
    int32_t residual;
};

/* The body and state on a side of a contact: 0 is a, 1 is b. */
static inline struct body *rest_body(const struct rest *r, const struct contact *c, int side)
{
    const struct pair *p = &r->pairs[c->key.pair];

    return &r->bodies[side == 0 ? p->a : p->b];
}

static inline struct body_state *rest_state(const struct rest *r, const struct contact *c, int side)
{
    const struct pair *p = &r->pairs[c->key.pair];

    return &r->states[side == 0 ? p->a : p->b];
}

/* Masses that the contact's impulses move: K along each direction, and the steps of a sweep. */
void rest_prepare_masses(struct contact *c);

/* Sweep until the residual is reached; impulses go to impulse_q40 of the contacts, not to the
 * bodies. */
void rest_solve_sweeps(struct rest *r, struct rest_sweep *sw, bool warm);

/* Keep the impulses of the contacts for the next frame. */
void rest_store_warm(struct rest *r);

/* p += P, L += r x P on a, the same P against b. */
void rest_apply(struct rest *r);

/* Set the momenta of the contacts' bodies aside, and their kinetic energy, before a solve. */
struct fix_wide rest_energy_before(struct rest *r);

/*
 * The energy rule for several contacts, after the impulses were applied: if energy rose above what
 * it was before, go back towards the frictionless plastic solution as far as needed.
 */
void rest_energy_rule(struct rest *r, struct fix_wide before);

#endif
