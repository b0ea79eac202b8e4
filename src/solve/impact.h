/* SPDX-License-Identifier: MIT */
/*
 * impact - one contact between two bodies: the paper's equations (1)-(10) by Gauss-Jordan
 * elimination, with Newton's restitution, Coulomb friction, and a rule that never gains energy
 * (paper, section 3).
 *
 * In: both bodies' masses, inertias and arms, N, V, the target of V'.N. Out: the impulse P.
 *
 * Steps, and the files that hold them:
 *   impact.c         impact_solve: stick; if that leaves the friction cone, slide; energy rule
 *   rows.c           the equations as rows in units near 1; solve and refine them
 *   friction.c       Coulomb's limit
 *   impact_energy.c  the energy rule of a single impact
 */
#ifndef CAROM_SRC_IMPACT_H
#define CAROM_SRC_IMPACT_H

#include "carom.h"
#include "../num/gauss.h"

/* A length c 2^-e: as many digits as 32 bits hold, whatever the size of the body. */
struct impact_arm {
    int32_t c[3];
    int32_t e;
};

/* One of both bodies, as the equations see it. */
struct impact_side {
    bool moving;                    /* a stationary body has no unknowns */
    struct fix_scaled inverse_mass; /* velocity = inverse_mass momentum */
    struct carom_sym3 inertia; /* divided by the mass, about the centre of mass, in world axes */
    struct impact_arm arm;     /* from the centre of mass to the contact */
};

struct impact {
    struct impact_side a, b;
    carom_v3_q30 normal;   /* N, from b into a */
    carom_v3_q40 velocity; /* V = (v_a + w_a x r_a) - (v_b + w_b x r_b) */
    int64_t target_q40;    /* the wanted V'.N: -e V.N for an impact */
    uint32_t friction_q16;
};

struct impact_result {
    carom_v3_q40 impulse; /* P on a, -P on b; mass x units / frame */
    int64_t normal_q40;   /* P.N */
    bool slid;            /* Coulomb's limit was reached */
    bool energy_rule;     /* P was moved towards the frictionless impulse */
};

/*
 * Solve one impact.
 *
 *   g    workspace
 *   in   at least one side moves; |V| < 2^12, |arm| <= 2^6, masses 2^-10 .. 2^10, mu <= 4
 *   out  the impulse; zero if V.N >= target already (a contact does not pull)
 *
 * Returns  CAROM_OK, or CAROM_ERR_RANGE if the system cannot be solved; out is written only for
 * CAROM_OK Source   paper eq. (1)-(8) stick, (9), (10) slip; rows scaled as SPEC.md says. 9
 * unknowns if one
 *          side moves, 15 if both do.
 */
int impact_solve(struct gauss *g, const struct impact *in, struct impact_result *out);

#endif
