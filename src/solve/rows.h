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
    /* 30 bits for the rows, and the remainder for refinement */
    int32_t share_q30, share_rest_q60;
    int32_t inertia_q30[6];
    int inertia_odd; /* rows 4-6 are halved if I / m is an odd power of two */
    int32_t arm_q30[3], arm_rest_q60[3];
};

/*
 * N and two tangents: u across the slip, v along it. They are rounded, so u.N and v.N are not quite
 * 0; if that were ignored 1e-9 of the impulse would point across N.
 */
struct impact_frame {
    carom_v3_q30 n, u, v;
    int32_t un_q52, vn_q52;
};

struct impact_problem {
    struct gauss *gauss;
    const struct impact *in;
    struct impact_mover mover[2];
    int movers, n;
    int arm_shift;  /* c */
    int mass_power; /* m* = 2^mass_power */
    struct impact_frame frame;
    struct fix_wide wanted_q70; /* wanted change of V.N */
};

/* A solution: P, and K P, the change of V that it makes. */
struct impact_answer {
    int unit;
    int64_t p_q40[3];  /* in m* 2^(unit - 2c); below 2^57 */
    int64_t dv_q40[3]; /* in 2^unit; below 2^61 */
};

/* v.d for a unit vector d. */
int64_t impact_dot(const int64_t v[3], const carom_v3_q30 *d);

/* Add `times` V.d, exact; times is -1 to 2. */
void impact_add_speed_q70(struct fix_wide *sum, const struct impact *in, const carom_v3_q30 *d,
                          int times);

/*
 * Set the frame with u along t x N and v along the part of t across N. Returns false if t has no
 * such part, or one within its rounding; u and v are then any tangents.
 */
bool impact_set_frame(struct impact_frame *f, const int64_t t[3]);

/* Set everything of a problem but gauss, in, frame and wanted_q70. */
void impact_prepare(struct impact_problem *p);

/*
 * to += s difference, in both parts of an answer. a - b in the unit of a, which must not be the
 * finer one.
 */
void impact_add_scaled(struct impact_answer *to, const struct impact_answer *difference,
                       struct fix_scaled s);
struct impact_answer impact_subtract(const struct impact_answer *a, const struct impact_answer *b);

/* Set row i of the system, n + 1 numbers, with right-hand side 0: sticking, or sliding along -v. */
void impact_row(const struct impact_problem *p, bool sticks, uint32_t friction_q16, int i,
                int32_t *row);

/*
 * Solve for the sticking impulse; for the impulse that slides along -v. Return 0, or -1 if there is
 * no solution.
 */
int impact_stick(const struct impact_problem *p, struct impact_answer *out);
int impact_slide(const struct impact_problem *p, uint32_t friction_q16, struct impact_answer *out);

/* True if Coulomb's limit allows an impulse: |P_t| <= mu P.N, in exact squares. */
bool impact_in_cone(const struct impact_problem *p, const struct impact_answer *x);
/*
 * From the frictionless impulse, in `out`, towards the sticking one, as far as the friction cone
 * allows. Used when a sliding contact would wedge: (9), (10) then ask for an impulse that pulls.
 */
void impact_cone_limit(const struct impact_problem *p, const struct impact_answer *stick,
                       struct impact_answer *out);
/*
 * The energy rule. impact_gains: true if an impulse adds energy. impact_energy_rule then moves it
 * towards the frictionless impulse until it does not.
 */
bool impact_gains(const struct impact_problem *p, const struct impact_answer *x);
void impact_energy_rule(const struct impact_problem *p, const struct impact_answer *free,
                        struct impact_answer *x);

#endif
