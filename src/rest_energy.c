/* SPDX-License-Identifier: MIT */
/* The rule that several contacts together never gain energy. */
#include "rest_parts.h"

static struct fix_wide kinetic2(const struct rest *r)
{
    struct fix_wide sum = {0, 0};

    for (uint32_t i = 0; i < r->body_count; i++) {
        if (r->bodies[i].solving) {
            sum = fix_wide_add(
                sum, body_kinetic2(&r->bodies[i], &r->states[i], &r->bodies[i].path.start.r));
        }
    }
    return sum;
}

static void save(struct rest *r, int slot)
{
    for (uint32_t i = 0; i < r->body_count; i++) {
        r->bodies[i].saved[slot][0] = r->states[i].momentum;
        r->bodies[i].saved[slot][1] = r->states[i].angular;
    }
}

/* Momenta at slot 0 + k (slot 1 - slot 0). */
static void blend(struct rest *r, int32_t k_q30)
{
    for (uint32_t i = 0; i < r->body_count; i++) {
        const struct body *b = &r->bodies[i];
        const carom_v3_q40 *from = b->saved[0], *to = b->saved[1];

        for (int k = 0; b->solving && k < 3; k++) {
            r->states[i].momentum.c[k] =
                from[0].c[k] + fix_mul(to[0].c[k] - from[0].c[k], k_q30, 30);
            r->states[i].angular.c[k] =
                from[1].c[k] + fix_mul(to[1].c[k] - from[1].c[k], k_q30, 30);
        }
    }
}

/* Whether the energy is above `before`. Momenta are rounded: a rise below 2^-26 is not one. */
static bool rises(const struct rest *r, struct fix_wide before)
{
    struct fix_wide slack = {before.hi >> 26, (uint64_t)fix_wide_shift(before, 26)};
    struct fix_wide limit = fix_wide_add(before, slack);

    return fix_wide_sign(fix_wide_add(kinetic2(r), fix_wide_neg(limit))) > 0;
}

struct fix_wide rest_energy_before(struct rest *r)
{
    save(r, 0);
    return kinetic2(r);
}

void rest_energy_rule(struct rest *r, struct fix_wide before)
{
    struct rest_sweep plastic = {0, true, true, REST_RESIDUAL_IMPACT};
    int32_t low = 0, high = CAROM_ONE_Q30;

    if (!rises(r, before)) {
        return;
    }
    r->energy_rules++;
    /* slot 0 holds the momenta before, the states hold the wanted ones: those go to slot 1 */
    save(r, 1);
    blend(r, 0);
    rest_solve_sweeps(r, &plastic, false);
    rest_apply(r);
    save(r, 0);
    /* energy is a convex quadratic in k, below the limit at 0 and above it at 1: one crossing */
    while (high - low > 1) {
        int32_t k_q30 = low + (high - low) / 2;

        blend(r, k_q30);
        if (rises(r, before)) {
            high = k_q30;
        } else {
            low = k_q30;
        }
    }
    blend(r, low);
}
