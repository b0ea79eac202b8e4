/* SPDX-License-Identifier: MIT */
/* Symmetric sweeps over accumulated, clamped impulses. */
#include "rest_parts.h"

/* Changes of the relative velocity that are followed: 16 V*. */
#define CHANGE_MAX ((int64_t)1 << (REST_BITS + 3))

static int64_t wanted_q40(const struct contact *c, const struct rest_sweep *sw)
{
    return sw->plastic && (c->impact || c->target_q40 > 0) ? 0 : c->target_q40;
}

static void choose_unit(const struct rest *r, struct rest_sweep *sw)
{
    int64_t largest = 1;

    for (uint32_t i = 0; i < r->count; i++) {
        const struct contact *c = rest_contact(r, i);
        int64_t change = carom_abs(c->speed_q40 - wanted_q40(c, sw));

        largest = change > largest ? change : largest;
        for (int s = 0; s < 2; s++) {
            if (c->side[s].body && c->side[s].body->acceleration_q40 > largest) {
                largest = c->side[s].body->acceleration_q40;
            }
        }
    }
    sw->unit = fix_bits((uint64_t)largest) - REST_BITS;
    if (sw->unit < -4) {
        sw->unit = -4;
    }
}

/* Velocities to solver units; no impulses yet. */
static void begin(struct rest *r, const struct rest_sweep *sw)
{
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);
        int64_t wanted = wanted_q40(c, sw);

        c->friction_q16 =
            sw->frictionless ? 0 : rest_friction(rest_body(r, c, 0), rest_body(r, c, 1));
        c->error = rest_to_units(c->speed_q40 - wanted, sw->unit);
        c->band = rest_to_units(c->band_q40, sw->unit);
        c->normal_impulse = 0;
        for (int k = 0; k < 3; k++) {
            int64_t along = fix_mul(c->speed_q40, c->normal.c[k], 30);

            c->slip[k] = rest_to_units(c->velocity.c[k] - along, sw->unit);
            c->tangent_impulse[k] = 0;
            c->gain[k] = c->way[k] = 0;
        }
        for (int s = 0; s < 2; s++) {
            struct body *b = c->side[s].body;

            if (b) {
                memset(b->dv, 0, sizeof b->dv);
                memset(b->dw, 0, sizeof b->dw);
            }
        }
    }
}

int32_t rest_clamp(int64_t v)
{
    const int64_t most = CAROM_ONE_Q30 - 1;

    return (int32_t)(v > most ? most : v < -most ? -most : v);
}

/*
 * How much the relative velocity has changed so far. A thin body's spin may fill 40 bits while the
 * sum stays small, so products wrap: modulo 2^64 the sum is right.
 */
static void change_of_velocity(const struct contact *c, int64_t out[3])
{
    memset(out, 0, 3 * sizeof out[0]);
    for (int s = 0; s < 2; s++) {
        const struct contact_side *side = &c->side[s];
        const struct body *b = side->body;

        for (int k = 0; b && k < 3; k++) {
            int i = (k + 1) % 3, j = (k + 2) % 3;
            uint64_t turned = (uint64_t)b->dw[i] * (uint64_t)(int64_t)side->arm_q30[j] -
                              (uint64_t)b->dw[j] * (uint64_t)(int64_t)side->arm_q30[i];
            int64_t v = carom_round(b->dv[k], REST_DV_BITS) + carom_round((int64_t)turned, 30);

            out[k] += s == 0 ? v : -v;
        }
    }
    for (int k = 0; k < 3; k++) {
        out[k] = out[k] > CHANGE_MAX ? CHANGE_MAX : out[k] < -CHANGE_MAX ? -CHANGE_MAX : out[k];
    }
}

void rest_push(struct contact *c, const int32_t impulse[3])
{
    for (int s = 0; s < 2; s++) {
        const struct contact_side *side = &c->side[s];
        struct body *b = side->body;

        for (int k = 0; b && k < 3; k++) {
            int64_t dv = carom_round((int64_t)impulse[k] * side->share_q30, 30 - REST_DV_BITS);
            int64_t dw = carom_round(carom_dot(side->turn[k], impulse), side->turn_bits);

            b->dv[k] += s == 0 ? dv : -dv;
            b->dw[k] += s == 0 ? dw : -dw;
        }
    }
}

/* Length of a vector whose components may have more than 31 bits; down: what it is shifted by. */
static int64_t long_length(const int64_t v[3], int *down)
{
    uint64_t sum = 0;

    *down = fix_bits((uint64_t)(carom_abs(v[0]) | carom_abs(v[1]) | carom_abs(v[2]))) - 31;
    *down = *down > 0 ? *down : 0;
    for (int k = 0; k < 3; k++) {
        int64_t part = v[k] >> *down;

        sum += (uint64_t)(part * part);
    }
    return fix_sqrt(sum);
}

bool rest_cut(int64_t v[3], int64_t limit)
{
    int down;
    int64_t whole = long_length(v, &down);

    if (whole <= limit >> down) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        v[k] = fix_mul(limit, (int32_t)((v[k] >> down) * CAROM_ONE_Q30 / whole), 30);
    }
    return true;
}

/* Friction is not against slip that closing a gap asks for. */
static void leave_band(const struct contact *c, int64_t slip[3])
{
    int64_t within[3];

    if (c->band > 0) {
        memcpy(within, slip, sizeof within);
        rest_cut(within, c->band);
        for (int k = 0; k < 3; k++) {
            slip[k] -= within[k];
        }
    }
}

static int64_t friction_limit(const struct contact *c, int64_t normal_impulse)
{
    return fix_mul(normal_impulse, (int32_t)c->friction_q16, 16);
}

/* A change of impulse: along N, and across it. */
struct gain {
    int32_t along, across[3];
};

/*
 * What one push takes of a change: all, or 2^-n of it, so that both its ways shrink alike. As it
 * leads from one impulse in the friction cone to another, so does any part of it.
 */
static void take(struct gain *g, int64_t along, const int64_t across[3])
{
    uint64_t all = (uint64_t)(carom_abs(along) | carom_abs(across[0]) | carom_abs(across[1]) |
                              carom_abs(across[2]));
    int down = fix_bits(all) - 30;

    down = down > 0 ? down : 0;
    g->along = (int32_t)(along >> down);
    for (int k = 0; k < 3; k++) {
        g->across[k] = (int32_t)(across[k] >> down);
    }
}

/* What ends all motion of the contact; false when that lies outside of the friction cone. */
static bool stick(const struct contact *c, int64_t error, const int64_t slip[3], struct gain *g)
{
    int64_t whole[3], tangent[3], along, limit, length;
    int32_t v[3];
    int down;

    for (int k = 0; k < 3; k++) {
        whole[k] = slip[k] + fix_mul(error, c->normal.c[k], 30);
    }
    /* fast slip fills more than 30 bits: the next visit finds what is left over */
    down = fix_bits((uint64_t)(carom_abs(whole[0]) | carom_abs(whole[1]) | carom_abs(whole[2])));
    down = down > 30 ? down - 30 : 0;
    for (int k = 0; k < 3; k++) {
        v[k] = (int32_t)(whole[k] >> down);
    }
    for (int k = 0; k < 3; k++) {
        int64_t part = carom_round(rest_row(c->inverse, k, v), 30 - c->fine_bits);

        whole[k] = carom_shl(-part, down);
    }
    along = fix_mul(whole[0], c->normal.c[0], 30) + fix_mul(whole[1], c->normal.c[1], 30) +
            fix_mul(whole[2], c->normal.c[2], 30);
    limit = friction_limit(c, c->normal_impulse + along);
    if (limit < 0) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        whole[k] -= fix_mul(along, c->normal.c[k], 30);
        tangent[k] = c->tangent_impulse[k] + whole[k];
    }
    length = long_length(tangent, &down);
    take(g, along, whole);
    return length <= limit >> down;
}

/*
 * How much longer a step along N is when friction at its limit follows it: N.K N over N.K (N + mu t),
 * t being the unit vector along v. Where a contact nearly wedges, 8.
 */
static int32_t following_q27(const struct contact *c, const int64_t v[3])
{
    int down = fix_bits((uint64_t)(carom_abs(v[0]) | carom_abs(v[1]) | carom_abs(v[2]))) - 15;
    int64_t square = 1, drag_q30 = 0, mass_q30;

    /* 15 bits will do: this only sets the pace. |drag| is below 2^34, the sum below 2^51 */
    for (int k = 0; k < 3; k++) {
        int64_t part = down > 0 ? v[k] >> down : v[k];

        square += part * part;
        drag_q30 += part * c->drag_q30[k];
    }
    drag_q30 /= fix_sqrt((uint64_t)square);
    mass_q30 = fix_mul(drag_q30, (int32_t)c->friction_q16, 16);
    mass_q30 = CAROM_ONE_Q30 + fix_mul(mass_q30, c->step[0], 30 - c->fine_bits);
    return (int32_t)(((int64_t)1 << 57) /
                     (mass_q30 > CAROM_ONE_Q30 / 8 ? mass_q30 : CAROM_ONE_Q30 / 8));
}

/*
 * A step along N, never pulling, and what it leaves of the slip across; `across` is what the slip so
 * far asks for. Returns whether that is more than friction gives.
 */
static bool slide_by(const struct contact *c, int64_t step, const int64_t across[3], struct gain *g)
{
    int64_t along = step < c->normal_impulse ? -step : -c->normal_impulse, tangent[3];
    bool limited;

    for (int k = 0; k < 3; k++) {
        int64_t drag = fix_mul(c->drag_q30[k], rest_clamp(along), 30);

        tangent[k] = across[k] - fix_mul(drag, c->step[1], 30 - c->fine_bits);
    }
    limited = rest_cut(tangent, friction_limit(c, c->normal_impulse + along));
    for (int k = 0; k < 3; k++) {
        tangent[k] -= c->tangent_impulse[k];
    }
    take(g, along, tangent);
    return limited;
}

/* Along N first; then across towards no slip, within the friction cone. */
static void slide(const struct contact *c, int64_t error, const int64_t slip[3], struct gain *g)
{
    int64_t step = fix_mul(error, c->step[0], 30 - c->fine_bits), across[3];

    for (int k = 0; k < 3; k++) {
        across[k] = c->tangent_impulse[k] - fix_mul(slip[k], c->step[1], 30 - c->fine_bits);
    }
    if (c->friction_q16 == 0 ||
        !slide_by(c, fix_mul(step, following_q27(c, across), 27), across, g)) {
        slide_by(c, step, across, g);
    }
}

/* Take up a change; returns its largest component, the last place apart. */
static int32_t add(struct contact *c, const struct gain *g)
{
    int32_t whole[3], most = 0;

    c->normal_impulse += g->along;
    for (int k = 0; k < 3; k++) {
        c->tangent_impulse[k] += g->across[k];
        whole[k] = carom_mul_q30(g->along, c->normal.c[k]) + g->across[k];
        c->gain[k] = rest_clamp((int64_t)c->gain[k] + whole[k]);
        most = carom_abs(whole[k]) > most ? (int32_t)carom_abs(whole[k]) : most;
    }
    rest_push(c, whole);
    return most > 4 ? most : 0;
}

/* One contact; returns how much a velocity moved. */
static int64_t visit(struct contact *c)
{
    int64_t change[3], slip[3], error;
    struct gain g;

    change_of_velocity(c, change);
    error = carom_round((int64_t)c->normal.c[0] * change[0] + (int64_t)c->normal.c[1] * change[1] +
                            (int64_t)c->normal.c[2] * change[2],
                        30);
    for (int k = 0; k < 3; k++) {
        slip[k] = c->slip[k] + change[k] - fix_mul(error, c->normal.c[k], 30);
    }
    error += c->error;
    leave_band(c, slip);
    if (c->friction_q16 == 0 || !c->inverted || !stick(c, error, slip, &g)) {
        slide(c, error, slip, &g);
    }
    return fix_mul(c->mass_q30, add(c, &g), 30);
}

/*
 * Two sweeps, forwards and backwards, are one step of a symmetric iteration; its steps are
 * conjugated (Fletcher-Reeves), which takes the root of the number of sweeps. When they grow, it
 * begins anew.
 */
static void accelerate(struct rest *r, int64_t moved, int64_t before)
{
    int64_t part_q30 = moved < before ? moved * CAROM_ONE_Q30 / before : 0;

    part_q30 = (part_q30 * part_q30) >> 30;
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);
        int64_t along, across[3];
        int32_t gain[3];
        struct gain g;

        for (int k = 0; k < 3; k++) {
            gain[k] = carom_mul_q30(c->way[k], (int32_t)part_q30);
            c->way[k] = rest_clamp((int64_t)gain[k] + c->gain[k]);
        }
        along = carom_round(carom_dot(c->normal.c, gain), 30);
        for (int k = 0; k < 3; k++) {
            across[k] = c->friction_q16 > 0 ? gain[k] - fix_mul(along, c->normal.c[k], 30) : 0;
        }
        take(&g, along, across);
        add(c, &g);
        memset(c->gain, 0, sizeof c->gain);
        rest_roll_accelerate(c, (int32_t)part_q30);
    }
}

/* When sweeps run out, a contact's last visit may not have gone all its way. */
static void into_cones(struct rest *r)
{
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);

        c->normal_impulse = c->normal_impulse > 0 ? c->normal_impulse : 0;
        rest_cut(c->tangent_impulse, friction_limit(c, c->normal_impulse));
    }
}

static void sweeps(struct rest *r, const struct rest_sweep *sw)
{
    uint32_t n = r->count;
    /* a contact by itself is solved in a visit or a few */
    bool coupled = n > 1 || rest_contact(r, 0)->roll.acts;
    int64_t before = 0;

    for (int round = 0; round < REST_SWEEPS_MAX; round++) {
        int64_t moved = 0;

        r->sweeps++;
        for (uint32_t i = 0; i < n; i++) {
            /* forwards and backwards in turn, so that no end of a stack is favoured */
            uint32_t at = round & 1 ? n - 1 - i : i;
            int64_t m = visit(rest_contact(r, at));

            moved = m > moved ? m : moved;
            m = rest_roll_sweep(r, at);
            moved = m > moved ? m : moved;
        }
        if (moved <= sw->residual) {
            return;
        }
        if (coupled && round & 1 && round < REST_SWEEPS_MAX - 1) {
            moved = moved < (int64_t)1 << 32 ? moved : (int64_t)1 << 32;
            accelerate(r, moved, before);
            before = moved;
        }
    }
    into_cones(r);
}

/* Impulses in solver units to momentum, one rounding a component. */
static void finish(struct rest *r, const struct rest_sweep *sw)
{
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);
        struct fix_scaled unit = c->mass_unit;

        unit.e += 8 - sw->unit; /* 8 more bits survive the sum */
        for (int k = 0; k < 3; k++) {
            int64_t j = fix_mul(c->normal_impulse, c->normal.c[k], 22) +
                        carom_shl(c->tangent_impulse[k], 8);

            c->impulse_q40.c[k] = fix_mul_scaled(j, unit);
        }
        rest_roll_finish(c, sw);
    }
}

void rest_solve_sweeps(struct rest *r, struct rest_sweep *sw, bool warm)
{
    choose_unit(r, sw);
    begin(r, sw);
    if (warm) {
        rest_load_warm(r, sw);
    }
    for (uint32_t i = 0; i < r->count; i++) {
        rest_roll_prepare(r, i, sw);
    }
    sweeps(r, sw);
    finish(r, sw);
}
