/* SPDX-License-Identifier: MIT */
/* Momentum: a step beyond each sweep, longer while sweeps agree. */
#include "sweep.h"

/* The last sweep and the step beyond the one before must sum to less than this. */
#define WAY_MAX (CAROM_ONE_Q30 / 2)

/* True if the last sweep went on in the direction of the last step beyond a sweep. */
static bool agrees(const struct rest *r)
{
    int64_t sum = 0;

    for (uint32_t i = 0; i < r->count; i++) {
        const struct contact *c = contact_gain(rest_contact(r, i));

        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            int64_t x = (int64_t)c->gain[k] + c->way[k];

            if (x > WAY_MAX || x < -WAY_MAX) {
                return false;
            }
            sum += c->gain[k] * x >> 13; /* up to 2^47, from at most 4096 contacts */
        }
    }
    if (rest_has_joints(r)) {
        sum += r->joints.calls->agrees(r, WAY_MAX);
    }
    return sum >= 0;
}

/* v += part (v - last), and last = v. */
static uint32_t go_on(int32_t *v, int32_t *last, int32_t part_q30)
{
    int32_t now = *v, change = (int32_t)((uint32_t)now - (uint32_t)*last);

    *last = now;
    return rest_add(v, carom_mul_q30(change, part_q30));
}

/* Step the bodies beyond, too: velocities are linear in impulses. */
static void bodies_beyond(struct rest *r, int32_t part_q30)
{
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        struct body_path *in = body_solve(&r->bodies[i]);

        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            in->used |= go_on(&in->dv[k], &in->last_dv[k], part_q30) |
                        go_on(&in->du[k], &in->last_du[k], part_q30);
        }
    }
}

/* Take a contact's impulse away: it would pull. */
static void let_go(struct contact *c)
{
    struct rest_change g;

    g.along = rest_within(-c->work->normal_impulse, WAY_MAX);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        g.across[k] = rest_within(-c->work->tangent_impulse[k], WAY_MAX);
        g.whole[k] = g.across[k] + carom_mul_q30(g.along, c->normal.c[k]);
        c->way[k] += g.whole[k];
    }
    rest_gain(c, &g);
    c->gain[0] = c->gain[1] = c->gain[2] = 0;
}

/* Step a contact's impulse beyond the last sweep, by a part of the way that it came. */
static void go_beyond(struct contact *c, int32_t part_q30)
{
    struct contact_work *in = c->work;
    struct rest_change g;

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        g.whole[k] = carom_mul_q30(c->way[k] + c->gain[k], part_q30);
        c->way[k] = g.whole[k];
        c->gain[k] = 0;
    }
    g.along = (int32_t)carom_round(carom_dot(c->normal.c, g.whole), 30);
    rest_split_change(&g, c->normal.c);
    rest_accumulate(in, &g);
    if (in->normal_impulse < 0) {
        let_go(c);
    }
}

/* Start the steps beyond sweeps anew. */
static void stay(struct contact *c)
{
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        c->way[k] = c->gain[k] = 0;
    }
}

void rest_accelerate(struct rest *r, int *age)
{
    int32_t part_q30;

    *age = agrees(r) ? *age + 1 : 0;
    part_q30 = (int32_t)(((int64_t)*age << 30) / (*age + 3));
    bodies_beyond(r, part_q30);
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);

        if (part_q30 == 0) {
            stay(c);
        } else {
            go_beyond(c, part_q30);
        }
        if (c->work->rolls) {
            rest_roll_accelerate(c, part_q30);
        }
    }
    if (rest_has_joints(r)) {
        r->joints.calls->accelerate(r, part_q30);
    }
}
