/* SPDX-License-Identifier: MIT */
/*
 * Part bodies that still approach after sweeps ran out. With friction sweeps need not settle,
 * however many there are, and places that still approach would hit again at once, without end.
 */
#include "parts.h"

/* Load velocities of the island's bodies: the present ones, or those before the solve. */
static void load(struct rest *r, bool before)
{
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        struct body *b = &r->bodies[i];
        struct body_state state = r->states[i];

        if (before) {
            state.momentum = b->solve.saved_momentum;
            state.angular = body_solve(b)->saved_angular;
        }
        body_velocity(b, &state, &b->solve.velocity);
        body_spin(b, &state, &b->path.start.r, &b->solve.spin);
    }
}

bool rest_approaches(struct rest *r)
{
    bool any = false;

    load(r, false);
    for (uint32_t i = 0; i < r->count && !any; i++) {
        const struct contact *c = rest_contact(r, i);
        int64_t least_q40 = c->work->target_q40 < 0 ? c->work->target_q40 : 0;

        any = rest_speed_q40(c) < least_q40 - carom_shl(c->skin_q22 / REST_SLOW_DIVISOR, 18);
    }
    load(r, true);
    return any;
}

void rest_part(struct rest *r)
{
    struct rest_sweep sw = {.plastic = true,
                            .parts = true,
                            .frictionless = true,
                            .calm = rest_up_to_two(r),
                            .residual = REST_RESIDUAL_IMPACT};

    load(r, false);
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);

        rest_want(c);
        c->speed_q40 = rest_along_q40(contact_velocity(c), &c->normal);
    }
    rest_solve_sweeps(r, &sw, false);
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);
        carom_v3_q40 impulse = *contact_impulse(c);
        const int64_t none[3] = {0, 0, 0};

        rest_apply_at(r, c, impulse.c, none);
        for (int k = 0; k < 3; k++) {
            impulse.c[k] += contact_wanted(c)->c[k];
        }
        contact_set_impulse(c, &impulse);
    }
    load(r, true);
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);

        c->speed_q40 = rest_speed_q40(c);
    }
}
