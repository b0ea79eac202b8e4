/* SPDX-License-Identifier: MIT */
/*
 * rows - equations (1) to (10) as rows for gauss, in units in which they stay near 1.
 *
 *   velocities  by V* = 2^(unit - c), masses by m*, the power of two below the lighter one
 *   dw          by V* / 2^g of each body, 4^g being about its inertia / mass: then J = I / (m 4^g)
 *               fills its 30 bits and goes into the rows without rounding
 *   P           by m* V* / 2^c, with 2^(g + c) at least twice the longest component of an arm
 *
 * With s = 1 for a and -1 for b, share = m* / m, arm = r / 2^(g + c) and d = N, u or v:
 *
 *   1-3, 7-9      dv - s share 2^-c P = 0                  (1) (2)
 *   4-6, 10-12    J dw - s share arm x P = 0               (3) (4)
 *   last three    sum of s (2^-c d.dv + (arm x d).dw) = wanted change of V.d / 2^unit
 *
 * or, when sliding, u.P = 0 and (v + mu N).P = 0 for the last two.
 */
#ifndef CAROM_SRC_IMPACT_ROWS_H
#define CAROM_SRC_IMPACT_ROWS_H

#include "impact.h"

/* A moving body in the solver's units. */
struct impact_mover {
    int32_t sign;
    /* 30 bits for the rows, and what these leave for refinement */
    int32_t share_q30, share_rest_q60;
    int32_t inertia_q30[6];
    int inertia_odd; /* rows 4-6 are halved where I / m is an odd power of two */
    int32_t arm_q30[3], arm_rest_q60[3];
};

/*
 * N and two tangents: u across the slip, v along it. They are rounded, so u.N and v.N are not quite
 * 0; without allowing for that, 1e-9 of the impulse would point across N.
 */
struct impact_frame {
    carom_v3_q30 n, u, v;
    int32_t un_q52, vn_q52;
};

struct impact_problem {
    struct gauss *w;
    const struct impact *in;
    struct impact_mover mover[2];
    int movers, n;
    int arm_shift;  /* c */
    int mass_power; /* m* = 2^mass_power */
    struct impact_frame frame;
    struct fix_wide wanted_q70; /* change of V.N */
};

/* A solution: P and the change of V that it makes, K P. */
struct impact_answer {
    int unit;
    int64_t p_q40[3];  /* of m* 2^(unit - 2c); below 2^57 */
    int64_t dv_q40[3]; /* of 2^unit; below 2^61 */
};

/* v.d for a unit vector d. */
int64_t impact_dot(const int64_t v[3], const carom_v3_q30 *d);

/* Add `times` V.d, exact; -1 to 2 times. */
void impact_add_speed_q70(struct fix_wide *sum, const struct impact *in, const carom_v3_q30 *d,
                          int times);

/*
 * Turn the frame so that u lies along t x N and v along the part of t across N. Returns false when
 * t has no such part, or one that is within its rounding; u and v are then any tangents.
 */
bool impact_set_frame(struct impact_frame *f, const int64_t t[3]);

/* Everything of a problem but w, in, frame and wanted_q70. */
void impact_prepare(struct impact_problem *p);

/* to + s difference, in both parts of an answer; a - b in the unit of a, which is not the finer one. */
void impact_add_scaled(struct impact_answer *to, const struct impact_answer *difference,
                       struct fix_scaled s);
struct impact_answer impact_subtract(const struct impact_answer *a, const struct impact_answer *b);

/* Row i of the system, n + 1 numbers, its right-hand side 0: without slip, or sliding along -v. */
void impact_row(const struct impact_problem *p, bool sticks, uint32_t friction_q16, int i,
                int32_t *row);

/* The impulse without slip, and the one that slides along -v. Return 0, or -1: no solution. */
int impact_stick(const struct impact_problem *p, struct impact_answer *out);
int impact_slide(const struct impact_problem *p, uint32_t friction_q16, struct impact_answer *out);

/* Whether Coulomb's limit allows an impulse: |P_t| <= mu P.N, in exact squares. */
bool impact_in_cone(const struct impact_problem *p, const struct impact_answer *x);
/*
 * From the frictionless impulse, in `out`, towards the sticking one, as far as the friction cone goes.
 * It stands in where a sliding contact would wedge: (9), (10) then ask for an impulse that pulls.
 */
void impact_cone_limit(const struct impact_problem *p, const struct impact_answer *stick,
                       struct impact_answer *out);
/*
 * The energy rule: whether an impulse gives more energy than there was; then it goes towards the
 * frictionless one until it does not.
 */
bool impact_gains(const struct impact_problem *p, const struct impact_answer *x);
void impact_energy_rule(const struct impact_problem *p, const struct impact_answer *free,
                        struct impact_answer *x);

#endif
