/* SPDX-License-Identifier: MIT */
/* The energy rule: several contacts together never gain energy. */
#include "parts.h"

/* Momenta are rounded, so a rise below 2^-26 of the energy is none. */
#define ROUNDING_BITS 26
/* Lasting contact may take 2^-8 of it, for what paths bend by. */
#define LASTING_BITS 8

void rest_save_momenta(struct rest *r)
{
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        r->bodies[i].solve.saved_momentum = r->states[i].momentum;
        body_solve(&r->bodies[i])->saved_angular = r->states[i].angular;
    }
}

static void restore_momenta(struct rest *r)
{
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        r->states[i].momentum = r->bodies[i].solve.saved_momentum;
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

void rest_add_work2(struct fix_wide *sum, const struct contact *c, int times)
{
    for (int k = 0; c->drift && k < 3; k++) {
        fix_wide_add_product(sum, contact_impulse(c)->c[k], 2 * times * c->drift->c[k]);
    }
}

/*
 * Subtract twice the work of kinematic bodies by k of the difference between wanted and plastic
 * impulses.
 */
FIX_APART static void subtract_blend2(const struct rest *r, struct fix_wide *sum, int32_t k_q30)
{
    for (uint32_t i = 0; i < r->count; i++) {
        const struct contact *c = rest_contact(r, i);

        for (int k = 0; c->drift && rest_body(r, c, 1)->def.goes && k < 3; k++) {
            int64_t more = contact_wanted(c)->c[k] - contact_impulse(c)->c[k];

            fix_wide_add_product(sum, fix_mul_q30(more, k_q30), -2 * c->drift->c[k]);
        }
    }
}

/*
 * True if the energy exceeds `limit` plus the work of surfaces and kinematic bodies. exactly: with
 * all digits, else by a bound. k: for a blend of impulses, if not 0.
 */
static bool rises(const struct rest *r, const struct fix_wide *limit, bool exactly, int32_t k_q30)
{
    struct fix_wide sum = {0, 0};

    fix_wide_subtract(&sum, limit);
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        const struct body *b = &r->bodies[i];

        if (exactly) {
            body_add_kinetic2(&sum, b, &r->states[i], &b->path.start.r);
        } else {
            body_add_kinetic2_most(&sum, b, &r->states[i]);
        }
    }
    for (uint32_t i = 0; i < r->count; i++) {
        rest_add_work2(&sum, rest_contact(r, i), -1);
    }
    if (k_q30 > 0) {
        subtract_blend2(r, &sum, k_q30);
    }
    return fix_wide_sign(&sum) > 0;
}

/* Add the most that resting contacts may add to twice the energy of the island. */
static void add_lift2(const struct rest *r, struct fix_wide *sum)
{
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        body_add_lift2(sum, &r->bodies[i], 1);
    }
}

/* Twice the kinetic energy before the solve. */
static void add_before2(const struct rest *r, struct fix_wide *sum)
{
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        const struct body *b = &r->bodies[i];

        fix_wide_add_dot(sum, b->solve.saved_momentum.c, b->solve.velocity.c);
        fix_wide_add_dot(sum, body_solved(b)->saved_angular.c, b->solve.spin.c);
    }
}

void rest_energy_rule(struct rest *r, bool lifts, bool lasting)
{
    bool exact = rest_up_to_two(r);
    struct rest_sweep plastic = {.plastic = true,
                                 .frictionless = true,
                                 .calm = true,
                                 .exact = exact,
                                 .residual = exact ? REST_RESIDUAL_EXACT : REST_RESIDUAL_IMPACT};
    int bits = lasting ? LASTING_BITS : ROUNDING_BITS;
    int32_t low = 0, high = CAROM_ONE_Q30;
    struct fix_wide limit = {0, 0}, slack;

    if (lifts) {
        add_lift2(r, &limit);
    }
    if (!rises(r, &limit, false, 0)) {
        return; /* below the limit even if the energy before was 0 */
    }
    add_before2(r, &limit);
    slack = fix_wide_down(&limit, bits);
    fix_wide_add(&limit, &slack);
    if (!rises(r, &limit, true, 0)) {
        return;
    }
    r->energy_rules++;
    for (uint32_t i = 0; i < r->count; i++) {
        rest_want(rest_contact(r, i));
    }
    rest_solve_sweeps(r, &plastic, false);
    /* energy is a convex quadratic in k, below the limit at 0 and above it at 1: it crosses once */
    while (high - low > 1) {
        int32_t k_q30 = low + (high - low) / 2;

        apply_blend(r, k_q30, false);
        if (rises(r, &limit, true, k_q30)) {
            high = k_q30;
        } else {
            low = k_q30;
        }
    }
    apply_blend(r, low, true);
}
