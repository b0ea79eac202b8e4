/* SPDX-License-Identifier: MIT */
/* Symmetric sweeps over accumulated, clamped impulses, and their warm start. */
#include "rest_parts.h"

static int64_t to_units(int64_t v_q40, int unit)
{
    return unit > 0 ? carom_round(v_q40, unit) : carom_shl(v_q40, -unit);
}

static int64_t wanted_q40(const struct contact *c, const struct rest_sweep *sw)
{
    return sw->plastic && c->impact ? 0 : c->target_q40;
}

static void choose_unit(const struct rest *r, struct rest_sweep *sw)
{
    int64_t largest = fix_length(r->gravity->c) | 1;

    for (uint32_t i = 0; i < r->list.pool->used; i++) {
        const struct contact *c = &r->list.contacts[i];
        int64_t change = carom_abs(c->velocity_q40[0] - wanted_q40(c, sw));

        if (change > largest) {
            largest = change;
        }
    }
    sw->unit = fix_bits((uint64_t)largest) - REST_BITS;
    if (sw->unit < -4) {
        sw->unit = -4;
    }
}

/*
 * Change of the relative velocity along direction d so far. A thin body's spin may fill 40 bits
 * while the sum stays small, so products wrap: modulo 2^64 the sum is right.
 */
static int64_t change_along(const struct contact *c, int d)
{
    uint64_t sum = 0;

    for (int s = 0; s < 2; s++) {
        const struct contact_side *side = &c->side[s];
        const struct body *b = side->body;
        uint64_t part = 0;

        if (!b) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            part += (uint64_t)(int64_t)c->direction[d].c[k] * (uint64_t)b->dv[k];
            part += (uint64_t)(int64_t)side->lever_q30[d][k] * (uint64_t)b->dw[k];
        }
        sum += s == 0 ? part : 0 - part;
    }
    return carom_round((int64_t)sum, 30);
}

/* Give the bodies an impulse along direction d. */
static void push(struct contact *c, int d, int64_t impulse)
{
    for (int s = 0; s < 2; s++) {
        struct contact_side *side = &c->side[s];
        int64_t j = s == 0 ? impulse : -impulse;
        int64_t share;

        if (!side->body) {
            continue;
        }
        share = carom_round(j * side->share_q30, 30);
        for (int k = 0; k < 3; k++) {
            side->body->dv[k] += carom_round(share * c->direction[d].c[k], 30);
            side->body->dw[k] += carom_round(j * side->turn[d][k], side->turn_bits[d]);
        }
    }
}

static int64_t clamp_impulse(int64_t j)
{
    const int64_t most = (int64_t)1 << 31;

    return j > most - 1 ? most - 1 : j < -most + 1 ? -most + 1 : j;
}

/* How much a velocity moved: impulse times effective mass. */
static int64_t effect(int64_t impulse, int64_t mass_q30)
{
    return carom_abs(fix_mul(mass_q30, (int32_t)impulse, 30));
}

/* One contact, along the normal: the accumulated impulse never pulls. */
static int64_t sweep_normal(struct contact *c, const struct rest_sweep *sw)
{
    int64_t error = to_units(c->velocity_q40[0] - wanted_q40(c, sw), sw->unit) + change_along(c, 0);
    int64_t next = clamp_impulse(c->impulse[0] - fix_mul(error, c->step_q30[0], 30));
    int64_t change;

    if (next < 0) {
        next = 0;
    }
    change = next - c->impulse[0];
    c->impulse[0] = (int32_t)next;
    push(c, 0, change);
    return effect(clamp_impulse(change), c->mass_q30[0]);
}

/* One contact, across: towards no slip, within the disc of radius mu times the normal impulse. */
static int64_t sweep_tangents(struct contact *c, const struct rest_sweep *sw, uint32_t mu_q16)
{
    int64_t limit = clamp_impulse(((int64_t)mu_q16 * c->impulse[0]) >> 16);
    int64_t next[2], length, moved = 0;
    int shift;

    for (int d = 0; d < 2; d++) {
        int64_t slip = to_units(c->velocity_q40[1 + d], sw->unit) + change_along(c, 1 + d);

        next[d] = c->impulse[1 + d] - fix_mul(slip, c->step_q30[1], 30);
    }
    /* fast slip fills more than 32 bits: take the length of what fits */
    shift = fix_bits((uint64_t)(carom_abs(next[0]) | carom_abs(next[1]))) - 31;
    if (shift < 0) {
        shift = 0;
    }
    length = (int64_t)fix_sqrt((uint64_t)((next[0] >> shift) * (next[0] >> shift)) +
                               (uint64_t)((next[1] >> shift) * (next[1] >> shift)));
    for (int d = 0; d < 2; d++) {
        int64_t change;

        if (length > (limit >> shift)) {
            next[d] = (next[d] >> shift) * limit / length;
        }
        next[d] = clamp_impulse(next[d]);
        change = next[d] - c->impulse[1 + d];
        c->impulse[1 + d] = (int32_t)next[d];
        push(c, 1 + d, change);
        moved += effect(clamp_impulse(change), c->mass_q30[1 + d]);
    }
    return moved;
}

static void sweeps(struct rest *r, const struct rest_sweep *sw)
{
    uint32_t n = r->list.pool->used;

    for (int round = 0; round < REST_SWEEPS_MAX; round++) {
        int64_t moved = 0;

        r->sweeps++;
        for (uint32_t i = 0; i < n; i++) {
            /* forwards and backwards in turn, so that no end of a stack is favoured */
            struct contact *c = &r->list.contacts[round & 1 ? n - 1 - i : i];
            uint32_t mu_q16 = rest_friction(rest_body(r, c, 0), rest_body(r, c, 1));
            int64_t m = sweep_normal(c, sw);

            moved = m > moved ? m : moved;
            if (mu_q16 > 0 && !sw->frictionless) {
                m = sweep_tangents(c, sw, mu_q16);
                moved = m > moved ? m : moved;
            }
        }
        if (moved <= sw->residual) {
            return;
        }
    }
}

/* -------------------------------------------------------------- warm start */

static void clear_changes(struct rest *r)
{
    for (uint32_t i = 0; i < r->list.pool->used; i++) {
        struct contact *c = &r->list.contacts[i];

        memset(c->impulse, 0, sizeof c->impulse);
        for (int s = 0; s < 2; s++) {
            if (c->side[s].body) {
                memset(c->side[s].body->dv, 0, sizeof c->side[s].body->dv);
                memset(c->side[s].body->dw, 0, sizeof c->side[s].body->dw);
            }
        }
    }
}

/* The last frame's contact that this one continues: same bodies, nearest place, similar normal. */
static struct rest_warm *find_warm(struct rest *r, const struct contact *c)
{
    const struct pair *p = &r->pairs[c->key.pair];
    const struct body *a = rest_body(r, c, 0);
    int32_t nearest = a->radius_q22 / 20;
    struct rest_warm *best = NULL;
    carom_v3_q22 arm = c->side[0].arm;

    carom_rotate_back(arm.c, &a->path.start.r, arm.c);
    for (uint32_t i = 0; i < r->warm_count; i++) {
        struct rest_warm *w = &r->warm[i];
        int32_t distance = 0;

        if (w->a != p->a || w->b != p->b || w->normal_q40 == 0 ||
            carom_dot(w->normal.c, c->direction[0].c) >> 30 < CAROM_ONE_Q30 / 10 * 9) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            int32_t d = (int32_t)carom_abs(w->arm.c[k] - arm.c[k]);

            distance = d > distance ? d : distance;
        }
        if (distance < nearest) {
            nearest = distance;
            best = w;
        }
    }
    return best;
}

/* Start from 0.9 of the last frame's impulses: a stack sways when it starts from all of them. */
static void load_warm(struct rest *r, const struct rest_sweep *sw)
{
    for (uint32_t i = 0; i < r->list.pool->used; i++) {
        struct contact *c = &r->list.contacts[i];
        struct rest_warm *w = find_warm(r, c);
        struct fix_scaled inverse = fix_scaled_inverse(c->mass_unit);
        int64_t j_q40[3];

        if (!w) {
            continue;
        }
        inverse.e += sw->unit;
        j_q40[0] = w->normal_q40;
        j_q40[1] = rest_along_q40(&w->tangent_q40, &c->direction[1]);
        j_q40[2] = rest_along_q40(&w->tangent_q40, &c->direction[2]);
        for (int d = 0; d < 3; d++) {
            int64_t j = fix_mul_scaled(j_q40[d] / 32 * 29, inverse);

            c->impulse[d] = (int32_t)clamp_impulse(j);
            push(c, d, c->impulse[d]);
        }
        w->normal_q40 = 0; /* used */
    }
}

void rest_store_warm(struct rest *r)
{
    r->warm_count = r->list.pool->used;
    for (uint32_t i = 0; i < r->warm_count; i++) {
        const struct contact *c = &r->list.contacts[i];
        struct rest_warm *w = &r->warm[i];

        memset(w, 0, sizeof *w);
        w->a = r->pairs[c->key.pair].a;
        w->b = r->pairs[c->key.pair].b;
        w->normal = c->direction[0];
        carom_rotate_back(w->arm.c, &rest_body(r, c, 0)->path.start.r, c->side[0].arm.c);
        w->normal_q40 = rest_along_q40(&c->impulse_q40, &c->direction[0]);
        for (int k = 0; k < 3; k++) {
            w->tangent_q40.c[k] = c->impulse_q40.c[k] - fix_mul(w->normal_q40, w->normal.c[k], 30);
        }
    }
}

/* Impulses in solver units to momentum, one rounding a component. */
static void impulses_from_units(struct rest *r, const struct rest_sweep *sw)
{
    for (uint32_t i = 0; i < r->list.pool->used; i++) {
        struct contact *c = &r->list.contacts[i];
        struct fix_scaled unit = c->mass_unit;

        unit.e += 8 - sw->unit; /* 8 more bits survive the sum over the directions */
        for (int k = 0; k < 3; k++) {
            int64_t j = 0;

            for (int d = 0; d < 3; d++) {
                j += (int64_t)c->direction[d].c[k] * c->impulse[d];
            }
            c->impulse_q40.c[k] = fix_mul_scaled(carom_round(j, 22), unit);
        }
    }
}

void rest_solve_sweeps(struct rest *r, struct rest_sweep *sw, bool warm)
{
    choose_unit(r, sw);
    clear_changes(r);
    if (warm) {
        load_warm(r, sw);
    }
    sweeps(r, sw);
    impulses_from_units(r, sw);
}
