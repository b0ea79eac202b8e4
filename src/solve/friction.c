/* SPDX-License-Identifier: MIT */
/* Coulomb's limit of a single contact, and arithmetic of answers. */
#include "rows.h"

void impact_add_scaled(struct impact_answer *to, const struct impact_answer *difference,
                       struct fix_scaled s)
{
    for (int k = 0; k < 3; k++) {
        to->p_q40[k] += fix_mul_scaled(difference->p_q40[k], s);
        to->dv_q40[k] += fix_mul_scaled(difference->dv_q40[k], s);
    }
}

struct impact_answer impact_subtract(const struct impact_answer *a, const struct impact_answer *b)
{
    struct impact_answer d = *a;

    for (int k = 0; k < 3; k++) {
        d.p_q40[k] -= fix_round_shift(b->p_q40[k], b->unit - a->unit);
        d.dv_q40[k] -= fix_round_shift(b->dv_q40[k], b->unit - a->unit);
    }
    return d;
}

bool impact_in_cone(const struct impact_problem *p, const struct impact_answer *x)
{
    int64_t limit = fix_mul(impact_dot(x->p_q40, &p->frame.n), (int32_t)p->in->friction_q16, 16);
    int64_t pu = impact_dot(x->p_q40, &p->frame.u), pv = impact_dot(x->p_q40, &p->frame.v);
    struct fix_wide excess = fix_wide_mul(-limit, limit);

    fix_wide_add_product(&excess, pu, pu);
    fix_wide_add_product(&excess, pv, pv);
    return limit >= 0 && fix_wide_sign(&excess) <= 0;
}

void impact_cone_limit(const struct impact_problem *p, const struct impact_answer *stick,
                       struct impact_answer *out)
{
    struct impact_answer d = impact_subtract(stick, out);
    int64_t tangential[3] = {impact_dot(d.p_q40, &p->frame.u), impact_dot(d.p_q40, &p->frame.v), 0};
    int32_t mu_q16 = (int32_t)p->in->friction_q16;
    int64_t length = fix_length(tangential), reach, growth;
    struct fix_wide excess = fix_wide_mul(-length, length);

    /* one Newton step for the digits that fix_length drops, since growth is a difference */
    if (length > 0) {
        fix_wide_add_dot(&excess, tangential, tangential);
        length += fix_mul_scaled(1, fix_wide_over(&excess, 2 * length));
    }
    /* where P0 + s D meets the cone: |D_t| s = mu (P0.N + s D.N) */
    reach = fix_mul(impact_dot(out->p_q40, &p->frame.n), mu_q16, 16);
    growth = length - fix_mul(impact_dot(d.p_q40, &p->frame.n), mu_q16, 16);
    if (reach > 0 && growth > 0) {
        impact_add_scaled(out, &d, fix_ratio(reach, growth));
    }
}
