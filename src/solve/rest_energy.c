/* SPDX-License-Identifier: MIT */
/* The rule that several contacts together never gain energy. */
#include "parts.h"

/* Momenta are rounded: a rise below 2^-26 is not one. */
#define ROUNDING_BITS 26
/* Lasting contact may take that for what paths bend by. */
#define LASTING_BITS 8

static struct fix_wide kinetic2(const struct rest *r)
{
    struct fix_wide sum = {0, 0};

    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].next_in_island) {
        const struct body *b = &r->bodies[i];

        sum = fix_wide_add(sum, body_kinetic2(b, &r->states[i], &b->path.start.r));
    }
    return sum;
}

void rest_save_momenta(struct rest *r)
{
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].next_in_island) {
        r->bodies[i].saved_momentum = r->states[i].momentum;
        body_solve(&r->bodies[i])->saved_angular = r->states[i].angular;
    }
}

static void restore_momenta(struct rest *r)
{
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].next_in_island) {
        r->states[i].momentum = r->bodies[i].saved_momentum;
        r->states[i].angular = body_solve(&r->bodies[i])->saved_angular;
    }
}

/*
 * From the saved momenta, apply impulses that are k of the way from the plastic to the wanted ones.
 * Impulses are blended, not momenta, so that they stay equal and opposite to the last bit.
 */
static void apply_blend(struct rest *r, int32_t k_q30, bool keep)
{
    restore_momenta(r);
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);
        carom_v3_q40 impulse, moment;

        for (int k = 0; k < 3; k++) {
            int64_t from = contact_impulse(c)->c[k];

            impulse.c[k] = from + fix_mul_q30(contact_wanted(c)->c[k] - from, k_q30);
            moment.c[k] = fix_mul_q30(rest_moment(c)->c[k], k_q30);
        }
        rest_apply_at(r, c, impulse.c, moment.c);
        if (keep) {
            contact_set_impulse(c, &impulse);
            if (c->work->roll) {
                *contact_moment(c) = moment;
            }
        }
    }
}

/* Whether the energy is above `before`, by more than 2^-bits of it, and what surfaces that move have added. */
static bool rises(const struct rest *r, struct fix_wide before, int bits)
{
    struct fix_wide slack = {before.hi >> bits, (uint64_t)fix_wide_shift(before, bits)};
    struct fix_wide limit = fix_wide_add(before, slack);

    for (uint32_t i = 0; i < r->count; i++) {
        limit = fix_wide_add(limit, rest_work2(rest_contact(r, i)));
    }

    return fix_wide_sign(fix_wide_add(kinetic2(r), fix_wide_neg(limit))) > 0;
}

/* Twice the kinetic energy before the solve. */
static struct fix_wide before2(const struct rest *r)
{
    struct fix_wide sum = {0, 0};

    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].next_in_island) {
        const struct body *b = &r->bodies[i];

        sum = fix_wide_add(sum, fix_wide_dot(b->saved_momentum.c, b->velocity.c));
        sum = fix_wide_add(sum, fix_wide_dot(body_solved(b)->saved_angular.c, b->spin.c));
    }
    return sum;
}

/* Whether the energy may be above `allowed` and what surfaces that move have added. */
static bool may_rise(const struct rest *r, struct fix_wide allowed)
{
    struct fix_wide sum = fix_wide_neg(allowed);

    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].next_in_island) {
        sum = fix_wide_add(sum, body_kinetic2_most(&r->bodies[i], &r->states[i]));
    }
    for (uint32_t i = 0; i < r->count; i++) {
        sum = fix_wide_add(sum, fix_wide_neg(rest_work2(rest_contact(r, i))));
    }
    return fix_wide_sign(sum) > 0;
}

void rest_energy_rule(struct rest *r, struct fix_wide lift, bool lasting)
{
    bool exact = rest_up_to_two(r);
    struct rest_sweep plastic = {.plastic = true,
                                 .frictionless = true,
                                 .calm = true,
                                 .exact = exact,
                                 .residual = exact ? REST_RESIDUAL_EXACT : REST_RESIDUAL_IMPACT};
    int bits = lasting ? LASTING_BITS : ROUNDING_BITS;
    int32_t low = 0, high = CAROM_ONE_Q30;
    struct fix_wide before;

    if (!may_rise(r, lift)) {
        return; /* whatever it was before: not below 0 */
    }
    before = fix_wide_add(before2(r), lift);
    if (!rises(r, before, bits)) {
        return;
    }
    r->energy_rules++;
    for (uint32_t i = 0; i < r->count; i++) {
        rest_want(rest_contact(r, i));
    }
    rest_solve_sweeps(r, &plastic, false);
    /* energy is a convex quadratic in k, below the limit at 0 and above it at 1: one crossing */
    while (high - low > 1) {
        int32_t k_q30 = low + (high - low) / 2;

        apply_blend(r, k_q30, false);
        if (rises(r, before, bits)) {
            high = k_q30;
        } else {
            low = k_q30;
        }
    }
    apply_blend(r, low, true);
}
