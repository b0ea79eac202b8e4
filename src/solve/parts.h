/* SPDX-License-Identifier: MIT */
/*
 * parts - what the files that solve several contacts share: velocities and masses of contacts, sweeps,
 * and the energy rule.
 */
#ifndef CAROM_SRC_REST_PARTS_H
#define CAROM_SRC_REST_PARTS_H

#include "rest.h"

/*
 * dv and dw have this many bits below the solver's unit: a share of 1/2 makes every other change of it a
 * tie, and ties go upward.
 */
#define REST_FINER_BITS 8

/* Sweeps end when no velocity changes by more than this, in solver units of 2^-27 V*. */
#define REST_RESIDUAL_IMPACT (1 << (REST_BITS - 26))
#define REST_RESIDUAL_REST   (1 << (REST_BITS - 16))

struct rest_sweep {
    int unit;     /* a solver unit of velocity is 2^unit of q40 */
    bool plastic; /* impacts end at 0: the frictionless solution of the energy rule */
    bool frictionless;
    int32_t residual;
    bool rolls;   /* resting contact, with rolling friction: no contact is an impact */
    bool ran_out; /* out: they ended before the residual was reached */
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

/* Find the islands that the contacts make, and list the contacts by island, then by key. */
void rest_list_islands(struct rest *r);
/* Take up the island whose contacts begin at r->first; false when they are all idle. */
bool rest_take_island(struct rest *r);

/* Contact i, below r->count, of the island at hand. */
static inline struct contact *rest_contact(const struct rest *r, uint32_t i)
{
    return &r->list.contacts[r->list.contacts[r->first + i].order];
}

/* Twice what a surface that moves does by a contact's impulse, q80. */
static inline struct fix_wide rest_work2(const struct contact *c)
{
    const int64_t *drift = c->drift.c, twice[3] = {2 * drift[0], 2 * drift[1], 2 * drift[2]};

    return (drift[0] | drift[1] | drift[2]) != 0 ? fix_wide_dot(contact_impulse(c)->c, twice)
                                                 : (struct fix_wide){0, 0};
}

/* Row i of a symmetric matrix, xx yy zz xy yz zx, times v. */
static inline int64_t rest_row(const int32_t m[6], int i, const int32_t v[3])
{
    const int32_t row[3] = {m[fix_sym3_at[i][0]], m[fix_sym3_at[i][1]], m[fix_sym3_at[i][2]]};

    return carom_dot(row, v);
}

/* A body's turning; then K of its contacts and the steps of a sweep. */
void rest_prepare_body(struct body *b);
void rest_prepare_masses(struct contact *c);

/* Give the bodies an impulse on a, and its opposite on b; the components are below 2^31. */
void rest_push(struct contact *c, const int32_t impulse[3]);
/* |v|^2 of a vector of at most 31 bits. */
static inline uint64_t rest_square32(const int32_t v[3])
{
    return (uint64_t)((int64_t)v[0] * v[0]) + (uint64_t)((int64_t)v[1] * v[1]) +
           (uint64_t)((int64_t)v[2] * v[2]);
}

/* Shift four numbers down until each has at most so many bits; returns how far. */
int rest_shrink(int64_t v[4], int bits);
/* v cut to a length of `limit`, which is at most 2^45; returns whether it was longer. */
bool rest_cut(int64_t v[3], int64_t limit);

/* Start from the impulses of the last frame. */
void rest_load_warm(struct rest *r, const struct rest_sweep *sw);

/*
 * Rolling friction of the pair whose first contact in the island is the i-th. Before the sweeps,
 * when it returns whether there is any; a step of a sweep, which returns how much a velocity moved;
 * a step of the acceleration; the result, with none a result of 0.
 */
bool rest_roll_prepare(struct rest *r, uint32_t i, const struct rest_sweep *sw);
int64_t rest_roll_sweep(struct rest *r, uint32_t i, int32_t quiet);
void rest_roll_accelerate(struct contact *c, int32_t part_q30);
void rest_roll_finish(struct contact *c, const struct rest_sweep *sw);

/*
 * What follows works on the island at hand.
 *
 * Sweep until the residual is reached; impulses go to impulse_q40 of the contacts, not to the
 * bodies. Takes velocity_q40 of the contacts, whose place they need.
 */
void rest_solve_sweeps(struct rest *r, struct rest_sweep *sw, bool warm);

/* p += P, L += r x P and a moment on a, the same against b; of one contact, and of all. */
void rest_apply_at(struct rest *r, const struct contact *c, const int64_t impulse_q40[3],
                   const int64_t moment_q40[3]);
void rest_apply(struct rest *r);

/* V = (v_a + w_a x r_a) - (v_b + w_b x r_b) by the velocities that the bodies were given last. */
void rest_relative_velocity(const struct contact *c, carom_v3_q40 *v);
/* V.N */
int64_t rest_speed_q40(const struct contact *c);
/* Before another solve of a contact: its impulse is the one that was wanted, V is that before. */
void rest_want(struct contact *c);

/*
 * Give contact i of a face on a face the normal of one before it that differs by a hair, or its
 * opposite. Takes velocity_q40 of the contact.
 */
void rest_share_normal(struct rest *r, uint32_t i);

/* Set the momenta of the island's bodies aside before a solve. */
void rest_save_momenta(struct rest *r);

/*
 * The energy rule for several contacts, after the impulses were applied: if energy rose above what
 * it was before by more than `lift` (twice that), go back towards the frictionless plastic solution as
 * far as needed. In lasting contact it may rise by a 256th: the frame gives that back in the end.
 */
void rest_energy_rule(struct rest *r, struct fix_wide lift, bool lasting);

/*
 * After sweeps that ran out: take out without friction what places still approach by, where they do.
 */
void rest_part(struct rest *r);
/* Whether a contact approaches by more than it was asked to and a small part of its skin a frame. */
bool rest_approaches(struct rest *r);

/* Keep the impulses of all resting contacts for the next frame. */
void rest_store_warm(struct rest *r);

#endif
