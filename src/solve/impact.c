/* SPDX-License-Identifier: MIT */
/* Solve one impact: impact_solve. */
#include "rows.h"

/* Round the impulse, once, to the last place of momentum. */
static void finish(const struct impact_problem *p, const struct impact_answer *x,
                   struct impact_result *out)
{
    int power = p->mass_power + x->unit - 2 * p->arm_shift;

    for (int k = 0; k < 3; k++) {
        out->impulse.c[k] = fix_round_shift(x->p_q40[k], power);
    }
    out->normal_q40 = impact_dot(out->impulse.c, &p->frame.n);
    if (out->normal_q40 < 0) {
        out->normal_q40 = 0; /* less than the rounding of N */
    }
}

/*
 * Solve for a sliding contact. Friction acts along the slip; if there is none to begin with, along
 * the slip that a frictionless impact leaves. Returns 0, or -1 if there is no solution.
 */
static int slide(struct impact_problem *p, bool slips, const struct impact_answer *stick,
                 struct impact_answer *out)
{
    int64_t after[3];

    if (!slips) {
        if (impact_slide(p, 0, out)) {
            return -1;
        }
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            after[k] = fix_round_shift(p->in->velocity.c[k], -out->unit) + out->dv_q40[k];
        }
        if (!impact_set_frame(&p->frame, after)) {
            return 0; /* no direction for friction */
        }
    }
    if (impact_slide(p, p->in->friction_q16, out) == 0 && impact_dot(out->p_q40, &p->frame.n) > 0) {
        return 0;
    }
    if (impact_slide(p, 0, out)) {
        return -1;
    }
    impact_cone_limit(p, stick, out);
    return 0;
}

int impact_solve(struct gauss *g, const struct impact *in, struct impact_result *out)
{
    struct impact_problem p = {.gauss = g, .in = in, .frame = {.n = in->normal}};
    struct impact_result result = {.slid = false, .energy_rule = false};
    struct impact_answer x, other; /* the sticking answer, later the frictionless one */
    bool slips;

    CAROM_ASSERT(in->friction_q16 <= CAROM_MU_MAX_Q16);
    for (int k = 0; k < 3; k++) {
        CAROM_ASSERT(carom_abs(in->velocity.c[k]) < (int64_t)1 << 52);
    }
    p.wanted_q70 = fix_wide_mul(in->target_q40, CAROM_ONE_Q30);
    impact_add_speed_q70(&p.wanted_q70, in, &in->normal, -1);
    if (fix_wide_sign(&p.wanted_q70) <= 0) {
        *out = (struct impact_result){.slid = false};
        return CAROM_OK;
    }
    impact_prepare(&p);
    slips = impact_set_frame(&p.frame, in->velocity.c);
    if (in->friction_q16 == 0) {
        if (impact_slide(&p, 0, &x)) {
            return CAROM_ERR_RANGE;
        }
    } else {
        if (impact_stick(&p, &other)) {
            return CAROM_ERR_RANGE;
        }
        x = other;
        if (!impact_in_cone(&p, &x)) {
            result.slid = true;
            if (slide(&p, slips, &other, &x)) {
                return CAROM_ERR_RANGE;
            }
        }
        if (impact_gains(&p, &x)) {
            if (impact_slide(&p, 0, &other)) {
                return CAROM_ERR_RANGE;
            }
            impact_energy_rule(&p, &other, &x);
            result.energy_rule = true;
        }
    }
    finish(&p, &x, &result);
    *out = result;
    return CAROM_OK;
}
