/* SPDX-License-Identifier: MIT */
/* The energy rule: a single impact never gains energy. */
#include "rows.h"

#define HALVINGS_MAX 30

/* a k^2 + b k + c with k in q30; |a|, |b|, |c| < 2^60. */
static int64_t quadratic(const int64_t abc[3], int32_t k_q30)
{
    return fix_mul_q30(fix_mul_q30(abc[0], k_q30) + abc[1], k_q30) + abc[2];
}

/* The largest k in [0, 1] whose quadratic is not positive, rounded down; c <= 0 <= a. */
static struct fix_scaled largest_feasible(int64_t abc[3])
{
    struct fix_scaled k = {.m = 0, .e = 30};

    /* halve until 1/2 is feasible, so that a small k has its 30 digits, too */
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

static void speeds(const struct impact_problem *p, const struct impact_answer *x, int64_t v[3])
{
    for (int k = 0; k < 3; k++) {
        v[k] = fix_round_shift(p->in->velocity.c[k], -x->unit);
    }
}

bool impact_gains(const struct impact_problem *p, const struct impact_answer *x)
{
    struct fix_wide gain = {0, 0}; /* twice the energy, in the solver's units: P.(2V + K P) */
    int64_t v[3];

    speeds(p, x, v);
    for (int k = 0; k < 3; k++) {
        fix_wide_add_product(&gain, x->p_q40[k], 2 * v[k] + x->dv_q40[k]);
    }
    return fix_wide_sign(&gain) > 0;
}

/*
 * With D = P* - P0, twice the energy change of P0 + k D is
 *
 *   P0.(2V + K P0) + 2k D.V + k^2 D.K D
 *
 * because N.K D = 0: both impulses give the same V'.N. The first term is (P0.N) (V.N + target),
 * formed from V itself, since at e = 1 it is a difference of nearly equal numbers. It is not
 * positive while e <= 1. The last term is not negative. So beyond the largest k with a value <= 0
 * all values are positive.
 */
void impact_energy_rule(const struct impact_problem *p, const struct impact_answer *free,
                        struct impact_answer *x)
{
    struct impact_answer d = impact_subtract(x, free);
    struct fix_wide square = {0, 0}, slope = {0, 0}, twice = p->wanted_q70;
    struct fix_scaled loss;
    int64_t v[3], abc[3];
    int down;

    speeds(p, x, v);
    for (int k = 0; k < 3; k++) {
        x->p_q40[k] -= d.p_q40[k];
        x->dv_q40[k] -= d.dv_q40[k];
    }
    fix_wide_add_dot(&square, d.p_q40, d.dv_q40);
    fix_wide_add_dot(&slope, d.p_q40, v);
    fix_wide_shift_up(&slope, 1);
    down = fix_larger(fix_wide_bits(&square), fix_wide_bits(&slope));
    down = down > 59 ? down - 59 : 0;
    abc[0] = fix_wide_shift(&square, down);
    abc[1] = fix_wide_shift(&slope, down);
    /* 2 V.N + wanted = V.N + target */
    impact_add_speed_q70(&twice, p->in, &p->frame.n, 2);
    loss = fix_wide_over(&twice, 1);
    loss.e += 30 + x->unit + down;
    abc[2] = loss.m < 0 ? fix_mul_scaled(impact_dot(x->p_q40, &p->frame.n), loss) : 0;
    impact_add_scaled(x, &d, largest_feasible(abc));
}
