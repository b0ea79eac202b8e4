/* SPDX-License-Identifier: MIT */
/* sweep - what a sweep and the step beyond it share: changes of impulses. */
#ifndef CAROM_SRC_SWEEP_H
#define CAROM_SRC_SWEEP_H

#include "parts.h"

/* A change of impulse, each part below 2^30: along N, across it, and both. */
struct rest_change {
    int32_t along, across[3], whole[3];
};

static inline void rest_split_change(struct rest_change *g, const int32_t n[3])
{
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        g->across[k] = g->whole[k] - carom_mul_q30(g->along, n[k]);
    }
}

/* Add a change to the accumulated impulses. */
static inline void rest_accumulate(struct contact_work *in, const struct rest_change *g)
{
    in->normal_impulse += g->along;
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        in->tangent_impulse[k] += g->across[k];
    }
}

/* Add a change to the bodies' velocities; returns its largest component, to the last place. */
int32_t rest_gain(struct contact *c, const struct rest_change *g);

/*
 * Nesterov's momentum: after each sweep go on beyond it, farther the longer the sweeps agree. About
 * the root of the number of sweeps is then enough. When sweeps turn back momentum begins anew.
 * `age` counts the sweeps that agree.
 */
void rest_accelerate(struct rest *r, int *age);

#endif
