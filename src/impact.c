/* SPDX-License-Identifier: MIT */
#include "impact_rows.h"

#define HALVINGS_MAX 30

/* ---------------------------------------------------------------- friction */

/* to + s difference, in both parts of an answer. */
static void add_scaled(struct impact_answer *to, const struct impact_answer *difference,
                       struct fix_scaled s)
{
    for (int k = 0; k < 3; k++) {
        to->p_q40[k] += fix_mul_scaled(difference->p_q40[k], s);
        to->dv_q40[k] += fix_mul_scaled(difference->dv_q40[k], s);
    }
}

/* a - b in the unit of a, which is not the finer one. */
static struct impact_answer subtract(const struct impact_answer *a, const struct impact_answer *b)
{
    struct impact_answer d = *a;

    for (int k = 0; k < 3; k++) {
        d.p_q40[k] -= impact_shift(b->p_q40[k], b->unit - a->unit);
        d.dv_q40[k] -= impact_shift(b->dv_q40[k], b->unit - a->unit);
    }
    return d;
}

/* |P_t| <= mu P.N, in exact squares. */
static bool in_cone(const struct impact_problem *p, const struct impact_answer *x)
{
    int64_t limit = fix_mul(impact_dot(x->p_q40, &p->frame.n), (int32_t)p->in->friction_q16, 16);
    int64_t pu = impact_dot(x->p_q40, &p->frame.u), pv = impact_dot(x->p_q40, &p->frame.v);
    struct fix_wide excess = fix_wide_neg(fix_wide_mul(limit, limit));

    excess = fix_wide_add(excess, fix_wide_mul(pu, pu));
    excess = fix_wide_add(excess, fix_wide_mul(pv, pv));
    return limit >= 0 && fix_wide_sign(excess) <= 0;
}

/*
 * From the frictionless impulse towards the sticking one, as far as the friction cone goes. It
 * stands in where a sliding contact would wedge: (9), (10) then ask for an impulse that pulls.
 */
static void cone_limit(const struct impact_problem *p, const struct impact_answer *stick,
                       struct impact_answer *out)
{
    struct impact_answer d = subtract(stick, out);
    int64_t tangential[3] = {impact_dot(d.p_q40, &p->frame.u), impact_dot(d.p_q40, &p->frame.v), 0};
    int32_t mu_q16 = (int32_t)p->in->friction_q16;
    int64_t length = fix_length(tangential), reach, growth;
    struct fix_wide excess = fix_wide_add(fix_wide_dot(tangential, tangential),
                                          fix_wide_neg(fix_wide_mul(length, length)));

    /* One Newton step for the digits that fix_length leaves out: growth is a difference. */
    if (length > 0) {
        length += fix_mul_scaled(1, fix_wide_ratio(excess, fix_wide_mul(length, 2)));
    }
    /* Where P0 + s D meets the cone: |D_t| s = mu (P0.N + s D.N). */
    reach = fix_mul(impact_dot(out->p_q40, &p->frame.n), mu_q16, 16);
    growth = length - fix_mul(impact_dot(d.p_q40, &p->frame.n), mu_q16, 16);
    if (reach > 0 && growth > 0) {
        add_scaled(out, &d, fix_wide_ratio(fix_wide_mul(reach, 1), fix_wide_mul(growth, 1)));
    }
}

/*
 * Coulomb's limit is passed: the impulse along the slip, or where there is none to begin with,
 * along the slip that a frictionless impact leaves.
 */
static int slide(struct impact_problem *p, bool slips, const struct impact_answer *stick,
                 struct impact_answer *out)
{
    struct impact_answer free;
    int64_t after[3];

    if (!slips) {
        if (impact_slide(p, 0, out)) {
            return -1;
        }
        for (int k = 0; k < 3; k++) {
            after[k] = impact_shift(p->in->velocity.c[k], -out->unit) + out->dv_q40[k];
        }
        if (!impact_set_frame(&p->frame, after)) {
            return 0; /* nothing for friction to act along */
        }
    }
    if (impact_slide(p, p->in->friction_q16, out) == 0 && impact_dot(out->p_q40, &p->frame.n) > 0) {
        return 0;
    }
    if (impact_slide(p, 0, &free)) {
        return -1;
    }
    *out = free;
    cone_limit(p, stick, out);
    return 0;
}

/* ------------------------------------------------------------------ energy */

/* a k^2 + b k + c with k in q30; |a|, |b|, |c| < 2^60. */
static int64_t quadratic(const int64_t abc[3], int32_t k_q30)
{
    return fix_mul(fix_mul(abc[0], k_q30, 30) + abc[1], k_q30, 30) + abc[2];
}

/* The largest k in [0, 1] whose quadratic is not positive, rounded down; c <= 0 <= a. */
static struct fix_scaled largest_feasible(int64_t abc[3])
{
    struct fix_scaled k = {.m = 0, .e = 30};

    /* Halve until 1/2 is feasible, so that a small k has its 30 digits too. */
    while (k.e < 30 + HALVINGS_MAX && quadratic(abc, CAROM_ONE_Q30 / 2) > 0) {
        abc[0] = (abc[0] + 3) >> 2; /* upwards: on the safe side */
        abc[1] = (abc[1] + 1) >> 1;
        k.e++;
    }
    for (int32_t digit = CAROM_ONE_Q30 / 2; digit > 0; digit >>= 1) {
        if (quadratic(abc, k.m + digit) <= 0) {
            k.m += digit;
        }
    }
    return k;
}

/* Twice the energy that an answer adds, in the solver's units: P.(2V + K P). */
static struct fix_wide gain(const int64_t v_q40[3], const struct impact_answer *x)
{
    int64_t sum[3];

    for (int k = 0; k < 3; k++) {
        sum[k] = 2 * v_q40[k] + x->dv_q40[k];
    }
    return fix_wide_dot(x->p_q40, sum);
}

/*
 * The energy rule. With D = P* - P0, twice the energy change of P0 + k D is
 *
 *   P0.(2V + K P0) + 2k D.V + k^2 D.K D
 *
 * because N.K D = 0: both impulses give the same V'.N. The first term is (P0.N) (V.N + target),
 * formed from V itself because at e = 1 it is a difference of nearly equal numbers; it is not
 * positive while e <= 1. The last is not negative. So from the largest k with a value <= 0 on, all
 * are positive. Returns 1 when P* had to be moved, 0 when not, -1 when there is no solution.
 */
static int energy_rule(const struct impact_problem *p, struct impact_answer *x)
{
    struct impact_answer free, d;
    struct fix_wide square, slope;
    struct fix_scaled loss;
    int64_t v[3], abc[3];
    int down;

    for (int k = 0; k < 3; k++) {
        v[k] = impact_shift(p->in->velocity.c[k], -x->unit);
    }
    if (fix_wide_sign(gain(v, x)) <= 0) {
        return 0;
    }
    if (impact_slide(p, 0, &free)) {
        return -1;
    }
    d = subtract(x, &free);
    for (int k = 0; k < 3; k++) {
        x->p_q40[k] -= d.p_q40[k];
        x->dv_q40[k] -= d.dv_q40[k];
    }
    square = fix_wide_dot(d.p_q40, d.dv_q40);
    slope = fix_wide_dot(d.p_q40, v);
    slope = fix_wide_add(slope, slope);
    down =
        fix_wide_bits(square) > fix_wide_bits(slope) ? fix_wide_bits(square) : fix_wide_bits(slope);
    down = down > 59 ? down - 59 : 0;
    abc[0] = fix_wide_shift(square, down);
    abc[1] = fix_wide_shift(slope, down);
    /* 2 V.N + wanted = V.N + target */
    loss = fix_wide_ratio(
        fix_wide_add(fix_wide_add(p->wanted_q70, impact_speed_q70(p->in, &p->frame.n)),
                     impact_speed_q70(p->in, &p->frame.n)),
        fix_wide_mul(1, 1));
    loss.e += 30 + x->unit + down;
    abc[2] = loss.m < 0 ? fix_mul_scaled(impact_dot(x->p_q40, &p->frame.n), loss) : 0;
    add_scaled(x, &d, largest_feasible(abc));
    return 1;
}

/* ------------------------------------------------------------------ impact */

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
        if (!in_cone(&p, &x)) {
            result.slid = true;
            if (slide(&p, slips, &stick, &x)) {
                return CAROM_ERR_RANGE;
            }
        }
        changed = energy_rule(&p, &x);
        if (changed < 0) {
            return CAROM_ERR_RANGE;
        }
    }
    result.energy_rule = changed > 0;
    finish(&p, &x, &result);
    *out = result;
    return CAROM_OK;
}
