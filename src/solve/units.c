/* SPDX-License-Identifier: MIT */
/*
 * Begin and end of sweeps: the unit of velocity, velocities and kept impulses in it, and back to
 * momentum.
 */
#include "rows.h"
#include "parts.h"

/* Sweeps follow a slip of up to 13 V*. */
#define SLIP_MAX ((int64_t)13 << REST_BITS)
/* A slip is not cut if none of its components has more bits. */
#define SLIP_SURE_BITS (REST_BITS + 2)
/* If velocities or impulses outgrow their bits the unit becomes this many bits larger. */
#define LARGER_BITS 4

/*
 * The V.N that sweeps lead to. Sweeps that part bodies open a resting contact whose gap is all but
 * gone: at V.N = 0, found again in many frames, roundings would close the rest of it.
 */
FIX_APART static int64_t wanted_q40(const struct contact *c, const struct rest_sweep *sw)
{
    bool opens = sw->parts && !c->impact && c->gap_q22 < c->skin_q22 / REST_TOO_NEAR_DIVISOR;

    return sw->plastic && !opens && (c->impact || c->work->target_q40 > 0) ? 0
                                                                           : c->work->target_q40;
}

void rest_choose_unit(const struct rest *r, struct rest_sweep *sw)
{
    int64_t largest = 1, loose;

    for (uint32_t i = 0; i < r->count; i++) {
        const struct contact *c = rest_contact(r, i);
        int64_t change = carom_abs(c->speed_q40 - wanted_q40(c, sw));

        largest = change > largest ? change : largest;
        for (int s = 0; s < 2; s++) {
            if (c->side[s].body && c->side[s].body->def.acceleration_q40 > largest) {
                largest = c->side[s].body->def.acceleration_q40;
            }
        }
    }
    if (rest_has_joints(r)) {
        int64_t change = r->joints.calls->largest_q40(r);

        largest = change > largest ? change : largest;
    }
    sw->unit = fix_bits((uint64_t)largest) - REST_BITS;
    if (sw->unit < -4) {
        sw->unit = -4;
    }
    loose = sw->loose_q40 >> (sw->unit > 0 ? sw->unit : 0);
    if (loose > sw->residual) {
        sw->residual = rest_within(loose, 1 << REST_BITS);
    }
}

/* A velocity in solver units of 2^-4 to 2^41. */
static inline int64_t in_units(int64_t v_q40, int unit)
{
    return unit > 0 ? carom_round(v_q40, unit) : carom_shl(v_q40, -unit);
}

/* Set a contact's velocities in solver units, and no impulses. */
static void begin_contact(struct contact *c, const struct rest_sweep *sw)
{
    int64_t wanted = wanted_q40(c, sw), slip[3];
    int32_t error = (int32_t)in_units(c->speed_q40 - wanted, sw->unit); /* within V* */

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        int64_t along = fix_mul(c->speed_q40, c->normal.c[k], 30);

        slip[k] = in_units(contact_velocity(c)->c[k] - along, sw->unit);
    }
    if (fix_bits3(slip) > SLIP_SURE_BITS) {
        rest_cut(slip, SLIP_MAX);
    }
    PHASE_BEGIN(c->phase, CONTACT_GAIN);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        c->work->before[k] = (int32_t)slip[k] + carom_mul_q30(error, c->normal.c[k]);
        c->work->tangent_impulse[k] = 0;
        c->gain[k] = c->way[k] = 0;
    }
    c->work->band = rest_clamp(in_units(carom_shl(c->work->band_q30, 10), sw->unit));
    c->work->normal_impulse = 0;
}

void rest_begin_sweeps(struct rest *r, const struct rest_sweep *sw)
{
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);

        c->work->friction_q16 = sw->frictionless ? 0 : rest_friction_at(r, c);
        begin_contact(c, sw);
    }
    if (rest_has_joints(r)) {
        r->joints.calls->begin(r, sw);
    }
}

/* Enlarge the unit by LARGER_BITS. */
void rest_enlarge_unit(struct rest *r, struct rest_sweep *sw)
{
    sw->unit += LARGER_BITS;
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = contact_gain(rest_contact(r, i));

        for (int k = 0; k < 3; k++) {
            c->work->before[k] >>= LARGER_BITS;
            c->work->tangent_impulse[k] /= 1 << LARGER_BITS;
            c->gain[k] = c->way[k] = 0;
        }
        c->work->band >>= LARGER_BITS;
        c->work->normal_impulse /= 1 << LARGER_BITS;
    }
    if (rest_has_joints(r)) {
        r->joints.calls->enlarge(r, sw, LARGER_BITS);
    }
}

/* Add to a body's sums the effect of a contact's first impulse; s is 0 for a, 1 for b. */
static void add_wide(const struct contact *c, int s, const int64_t impulse[3])
{
    const struct contact_lever *lever = &c->work->lever[s];
    struct body *b = c->side[s].body;
    struct body_path *in = body_solve(b);
    const int shift = rest_turn_shift(b, c->work->fine_bits);
    int64_t own[3];

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        own[k] = s == 0 ? impulse[k] : -impulse[k];
        own[k] = lever->share_q30 == CAROM_ONE_Q30 ? own[k] : fix_mul_q30(own[k], lever->share_q30);
        in->wide_dv[k] += own[k] >> (c->work->fine_bits - REST_FINER_BITS);
    }
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        const int32_t turn[3] = {lever->turn[0][k], lever->turn[1][k], lever->turn[2][k]};

        /* products of 30 and 31 bits */
        in->wide_du[k] +=
            (fix_sum(own) >> 31) == 0
                ? carom_round(own[0] * turn[0] + own[1] * turn[1] + own[2] * turn[2], shift)
                : fix_mul(own[0], turn[0], shift) + fix_mul(own[1], turn[1], shift) +
                      fix_mul(own[2], turn[2], shift);
    }
}

/*
 * Narrow a body's sums to 32 bits; false if they do not fit. Weights of several bodies on a light
 * one may be long though their sum is short.
 */
static bool narrow(struct body *b)
{
    struct body_path *in = body_solve(b);
    const int64_t most = (int64_t)1 << REST_USED_BITS;
    int64_t all[6];
    bool fits = true;

    memcpy(all, in->wide_dv, sizeof in->wide_dv);
    memcpy(all + 3, in->wide_du, sizeof in->wide_du);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        fits = fits && carom_abs(all[k]) < most && carom_abs(all[3 + k]) < most;
        in->dv[k] = in->last_dv[k] = (int32_t)all[k];
        in->du[k] = in->last_du[k] = (int32_t)all[3 + k];
    }
    in->used = 0;
    return fits;
}

/* Set dv and du from the impulses so far. Returns false if they do not fit. */
bool rest_sum_up(struct rest *r)
{
    bool fits = true;

    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        memset(body_solve(&r->bodies[i])->wide_dv, 0, sizeof body_solve(&r->bodies[i])->wide_dv);
        memset(body_solve(&r->bodies[i])->wide_du, 0, sizeof body_solve(&r->bodies[i])->wide_du);
    }
    for (uint32_t i = 0; i < r->count; i++) {
        const struct contact *c = rest_contact(r, i);
        const struct contact_work *in = c->work;
        int64_t impulse[3];

        if ((in->normal_impulse | in->tangent_impulse[0] | in->tangent_impulse[1] |
             in->tangent_impulse[2]) == 0) {
            continue;
        }
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            impulse[k] = fix_mul_q30(in->normal_impulse, c->normal.c[k]) + in->tangent_impulse[k];
        }
        for (int s = 0; s < 2; s++) {
            if (c->side[s].body) {
                add_wide(c, s, impulse);
            }
        }
    }
    if (rest_has_joints(r)) {
        r->joints.calls->sum_up(r);
    }
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        fits = narrow(&r->bodies[i]) && fits;
    }
    return fits;
}

/* Turn impulses from solver units into momentum, one rounding a component. */
void rest_end_sweeps(struct rest *r, const struct rest_sweep *sw)
{
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);
        struct fix_scaled unit = contact_mass_unit(c);

        PHASE_BEGIN(c->phase, CONTACT_IMPULSE);
        unit.e += 8 - sw->unit; /* 8 more bits survive the sum */
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            c->impulse_q40.c[k] = fix_mul(c->work->normal_impulse, c->normal.c[k], 22) +
                                  carom_shl(c->work->tangent_impulse[k], 8);
        }
        fix_mul_scaled3(c->impulse_q40.c, c->impulse_q40.c, unit);
        if (sw->rolls) {
            rest_roll_finish(c, sw);
        }
    }
    if (rest_has_joints(r)) {
        r->joints.calls->end(r, sw);
    }
}
