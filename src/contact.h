/* SPDX-License-Identifier: MIT */
/*
 * contact - the paper's static interference check: where bodies touch in a fixed pose, with
 * positions and normals, each place once.
 */
#ifndef CAROM_SRC_CONTACT_H
#define CAROM_SRC_CONTACT_H

#include "boyse.h"

/* One of a contact's two bodies, in the solver's units (rest.h). Index 0 is a, 1 is b. */
struct contact_side {
    struct body *body; /* NULL: stationary */
    carom_v3_q22 arm;  /* from the centre of mass to the contact */
    /* filled in by the solver; directions 0..2 are N and the two tangents */
    int32_t share_q30;       /* the contact's mass unit over the body's mass, at most 1 */
    int32_t lever_q30[3][3]; /* arm x direction, over the body's unit of length */
    int32_t turn[3][3];      /* change of spin by a unit impulse, times 2^-turn_bits */
    int32_t turn_bits[3];
};

struct contact {
    /* found by the static check */
    struct candidate key;
    carom_v3_q30 direction[3]; /* N from b into a, and two tangents */
    int32_t gap_q22;
    carom_v3_q32 point; /* in the world, for carom_contacts */
    int32_t skin_q22;   /* of the pair */
    struct contact_side side[2];

    /* worked out by the solver */
    int64_t velocity_q40[3]; /* V along the directions, before */
    int64_t target_q40;      /* wanted V'.N */
    bool impact;
    struct fix_scaled mass_unit;
    int64_t mass_q30[3];      /* velocity along a direction by a unit impulse along it */
    int32_t step_q30[2];      /* inverse of the above: normal, and one scalar for both tangents */
    int32_t impulse[3];       /* accumulated along the directions, in solver units */
    carom_v3_q40 impulse_q40; /* the result: P on a, -P on b */
    carom_v3_q40 wanted_q40, plastic_q40; /* between which the energy rule chooses */
};

/* The contacts of a world at the present poses, sorted by key, with their pool. */
struct contact_list {
    struct contact *contacts;
    struct pool *pool;
};

/*
 * Take in a candidate if its features touch within `margin` in the placed poses: as the visitor of
 * all candidates does. Returns false when the list is full.
 */
bool contact_add(struct contact_list *list, const struct boyse_pair *pair,
                 const struct candidate *c, int32_t margin_q22);

/*
 * Make sure that the pair of a hit is among the contacts, with the normal found at the root; the
 * surfaces may be farther apart than the margin along another normal by now.
 *   centre_a, centre_b  of the bodies now, relative to the origin of the hit
 */
bool contact_force(struct contact_list *list, const struct boyse_pair *pair,
                   const struct boyse_hit *hit, const carom_v3_q22 *centre_a,
                   const carom_v3_q22 *centre_b);

/*
 * Merge contacts of a pair that share place and normal; the smallest gap stays.
 * Indeterminate cases are settled here and by the normal cones: a vertex on a vertex or an edge
 * answers to every face normal in its cone, and what coincides becomes one.
 */
void contact_merge(struct contact_list *list);

#endif
