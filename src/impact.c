/* SPDX-License-Identifier: MIT */
#include "impact_rows.h"

/* The one rounding of the impulse, to momentum's last place. */
static void finish(const struct impact_problem *p, const struct impact_answer *x,
                   struct impact_result *out)
{
    int power = p->mass_power + x->unit - 2 * p->arm_shift;

    for (int k = 0; k < 3; k++) {
        out->impulse.c[k] = impact_shift(x->p_q40[k], power);
    }
    out->normal_q40 = impact_dot(out->impulse.c, &p->frame.n);
    if (out->normal_q40 < 0) {
        out->normal_q40 = 0; /* less than the rounding of N */
    }
}

int impact_solve(struct gauss *w, const struct impact *in, struct impact_result *out)
{
    struct impact_problem p = {.w = w, .in = in, .frame.n = in->normal};
    struct impact_result result = {.slid = false, .energy_rule = false};
    struct impact_answer x, stick;
    int changed = 0;
    bool slips;

    CAROM_ASSERT(in->friction_q16 <= CAROM_MU_MAX_Q16);
    for (int k = 0; k < 3; k++) {
        CAROM_ASSERT(carom_abs(in->velocity.c[k]) < (int64_t)1 << 52);
    }
    p.wanted_q70 = fix_wide_add(fix_wide_mul(in->target_q40, CAROM_ONE_Q30),
                                fix_wide_neg(impact_speed_q70(in, &in->normal)));
    if (fix_wide_sign(p.wanted_q70) <= 0) {
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
        if (impact_stick(&p, &stick)) {
            return CAROM_ERR_RANGE;
        }
        x = stick;
        if (!impact_in_cone(&p, &x)) {
            result.slid = true;
            if (impact_friction(&p, slips, &stick, &x)) {
                return CAROM_ERR_RANGE;
            }
        }
        changed = impact_energy_rule(&p, &x);
        if (changed < 0) {
            return CAROM_ERR_RANGE;
        }
    }
    result.energy_rule = changed > 0;
    finish(&p, &x, &result);
    *out = result;
    return CAROM_OK;
}
