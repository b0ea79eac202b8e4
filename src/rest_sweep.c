/* SPDX-License-Identifier: MIT */
/* Symmetric sweeps over accumulated, clamped impulses. */
#include "rest_parts.h"

/*
 * Sweeps follow a slip of 13 V* and velocities below 16 V*, of which a vector of components up to
 * 9 V* is one. So a velocity is below 2^31 in length, and so are its parts along N and across.
 */
#define SLIP_MAX  ((int64_t)13 << REST_BITS)
#define PART_MAX  ((int64_t)9 << REST_BITS)
#define SPEED_MAX (((int64_t)16 << REST_BITS) - 64)

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
static void begin_contact(struct contact *c, const struct rest_sweep *sw)
{
    int64_t wanted = wanted_q40(c, sw), slip[3];
    int32_t error = (int32_t)rest_to_units(c->speed_q40 - wanted, sw->unit); /* within V* */

    for (int k = 0; k < 3; k++) {
        int64_t along = fix_mul(c->speed_q40, c->normal.c[k], 30);

        slip[k] = rest_to_units(c->velocity.c[k] - along, sw->unit);
    }
    rest_cut(slip, SLIP_MAX);
    for (int k = 0; k < 3; k++) {
        c->before[k] = (int32_t)slip[k] + carom_mul_q30(error, c->normal.c[k]);
        c->tangent_impulse[k] = 0;
        c->gain[k] = c->way[k] = 0;
    }
    c->band = rest_clamp(rest_to_units(c->band_q40, sw->unit));
    c->normal_impulse = 0;
}

static void begin(struct rest *r, const struct rest_sweep *sw)
{
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);

        c->friction_q16 =
            sw->frictionless ? 0 : rest_friction(rest_body(r, c, 0), rest_body(r, c, 1));
        begin_contact(c, sw);
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
    const int64_t most = INT32_MAX;

    return (int32_t)(v > most ? most : v < -most ? -most : v);
}

/*
 * V - wanted N by now. A thin body's spin may fill 40 bits while the sum stays small, so products
 * wrap: modulo 2^64 the sum is right.
 */
static void present_velocity(const struct contact *c, int32_t v[3])
{
    int64_t sum[3] = {0, 0, 0};
    bool fast = false;

    for (int s = 0; s < 2; s++) {
        const struct contact_side *side = &c->side[s];
        const struct body *b = side->body;
        int64_t dw[3];

        for (int k = 0; b && k < 3; k++) {
            dw[k] = b->dw[k] >> (REST_FINER_BITS - 2);
        }
        for (int k = 0; b && k < 3; k++) {
            int i = (k + 1) % 3, j = (k + 2) % 3;
            uint64_t turned = (uint64_t)dw[i] * (uint64_t)side->arm_q30[j] -
                              (uint64_t)dw[j] * (uint64_t)side->arm_q30[i];
            int64_t d = b->dv[k] + ((int64_t)turned >> (32 - REST_FINER_BITS));

            sum[k] += s == 0 ? d : -d;
        }
    }
    for (int k = 0; k < 3; k++) {
        sum[k] = c->before[k] + carom_round(sum[k], REST_FINER_BITS);
        fast |= sum[k] > PART_MAX || sum[k] < -PART_MAX;
    }
    if (fast) {
        rest_cut(sum, SPEED_MAX);
    }
    for (int k = 0; k < 3; k++) {
        v[k] = (int32_t)sum[k];
    }
}

void rest_push(struct contact *c, const int32_t impulse[3])
{
    for (int s = 0; s < 2; s++) {
        const struct contact_side *side = &c->side[s];
        struct body *b = side->body;

        for (int k = 0; b && k < 3; k++) {
            int64_t dv = carom_round((int64_t)impulse[k] * side->share_q30, 30 - REST_FINER_BITS);
            int64_t dw = carom_dot(side->turn[k], impulse) >> (side->turn_bits - REST_FINER_BITS);

            b->dv[k] += s == 0 ? dv : -dv;
            b->dw[k] += s == 0 ? dw : -dw;
        }
    }
}

/* Bits of the longest of three components. */
static int bits3(const int64_t v[3])
{
    return fix_bits((uint64_t)((v[0] ^ (v[0] >> 63)) | (v[1] ^ (v[1] >> 63)) | (v[2] ^ (v[2] >> 63))));
}

bool rest_cut(int64_t v[3], int64_t limit)
{
    int down = bits3(v) - 31;
    uint64_t square = 0, most;
    int32_t part[3], ratio_q30;

    down = down > 0 ? down : 0;
    for (int k = 0; k < 3; k++) {
        part[k] = (int32_t)(v[k] >> down);
        square += (uint64_t)((int64_t)part[k] * part[k]);
    }
    most = (uint64_t)(limit >> down);
    if (most >> 32 || square <= most * most) {
        return false;
    }
    ratio_q30 = (int32_t)((most << 30) / fix_sqrt(square));
    for (int k = 0; k < 3; k++) {
        v[k] = carom_shl(((int64_t)part[k] * ratio_q30) >> 30, down);
    }
    return true;
}

/* Friction is not against slip that closing a gap asks for. */
static void leave_band(const struct contact *c, int32_t error, int32_t v[3])
{
    int64_t within[3];

    for (int k = 0; k < 3; k++) {
        within[k] = v[k] - carom_mul_q30(error, c->normal.c[k]);
    }
    rest_cut(within, c->band);
    for (int k = 0; k < 3; k++) {
        v[k] -= (int32_t)within[k];
    }
}

static int64_t friction_limit(const struct contact *c, int64_t normal_impulse)
{
    return fix_mul(normal_impulse, (int32_t)c->friction_q16, 16);
}

/* A change of impulse, each part of at most 30 bits: along N, across it, and both. */
struct gain {
    int32_t along, whole[3];
};

/*
 * What one push takes of a change: all, or 2^-n of it, so that both its ways shrink alike. As it
 * leads from one impulse in the friction cone to another, so does any part of it.
 */
static void take(const struct contact *c, struct gain *g, int64_t along, const int64_t across[3])
{
    int down = bits3(across), more = fix_bits((uint64_t)carom_abs(along));

    down = (more > down ? more : down) - 29;
    down = down > 0 ? down : 0;
    g->along = (int32_t)(along >> down);
    for (int k = 0; k < 3; k++) {
        g->whole[k] = (int32_t)(across[k] >> down) + carom_mul_q30(g->along, c->normal.c[k]);
    }
}

/* Whether the impulse lies in the friction cone. */
static bool in_cone(const struct contact *c, int64_t along, const int64_t across[3])
{
    int down = bits3(across), more = fix_bits((uint64_t)along);
    uint64_t square = 0, limit;

    down = (more > down ? more : down) - 29;
    down = down > 0 ? down : 0;
    limit = ((uint64_t)(uint32_t)(along >> down) * c->friction_q16) >> 16; /* mu <= 4: 31 bits */
    for (int k = 0; k < 3; k++) {
        int32_t part = (int32_t)(across[k] >> down);

        square += (uint64_t)((int64_t)part * part);
    }
    return square <= limit * limit;
}

/*
 * What ends all motion of the contact; false when that lies outside of the friction cone. Large
 * velocities are shifted down: the next visit finds what is left over. As K is at least 1 the change
 * is then below 2^30.
 */
static bool stick(const struct contact *c, const int32_t v[3], struct gain *g)
{
    int down = fix_bits32((uint32_t)(carom_abs(v[0]) | carom_abs(v[1]) | carom_abs(v[2]))) +
               c->fine_bits - 29;
    int32_t part[3];
    int64_t along, across[3];

    down = down > 0 ? down : 0;
    for (int k = 0; k < 3; k++) {
        part[k] = v[k] >> down;
    }
    for (int k = 0; k < 3; k++) {
        g->whole[k] = -(int32_t)carom_round(rest_row(c->inverse, k, part), 30 - c->fine_bits);
    }
    g->along = (int32_t)carom_round(carom_dot(c->normal.c, g->whole), 30);
    along = c->normal_impulse + carom_shl(g->along, down);
    if (along <= 0) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        int32_t w = g->whole[k] - carom_mul_q30(g->along, c->normal.c[k]);

        across[k] = c->tangent_impulse[k] + carom_shl(w, down);
    }
    return in_cone(c, along, across);
}

/*
 * How much longer a step along N is when friction at its limit follows it: N.K N over N.K (N + mu t),
 * t being the unit vector along v. Where a contact nearly wedges, 8.
 */
static int32_t following_q15(const struct contact *c, const int64_t v[3])
{
    int down = bits3(v) - 15;
    uint32_t square = 1;
    int64_t drag = 0;
    int32_t mass_q11;

    /* 15 bits will do: this only sets the pace. |t| |drag| is below 2^16 2^31.8 */
    for (int k = 0; k < 3; k++) {
        int32_t part = (int32_t)(down > 0 ? v[k] >> down : v[k]);

        square += (uint32_t)(part * part);
        drag += (int64_t)part * c->drag_q28[k];
    }
    mass_q11 = (int32_t)(drag >> 17) / (int32_t)fix_sqrt(square);
    mass_q11 = 2048 + (int32_t)(((int64_t)mass_q11 * c->friction_q16) >> 16);
    return (1 << 26) / (mass_q11 > 256 ? mass_q11 : 256);
}

/*
 * Change V.N by dvn, never pulling, and end what that leaves of the slip, as far as friction does.
 * Returns whether it does not.
 */
static bool slide_by(const struct contact *c, int32_t dvn, const int32_t slip[3], struct gain *g)
{
    int64_t along = carom_round((int64_t)dvn * c->step[0], 30 - c->fine_bits), tangent[3];
    bool limited = true;

    if (along <= -c->normal_impulse) {
        along = -c->normal_impulse;
        memset(tangent, 0, sizeof tangent);
    } else {
        for (int k = 0; k < 3; k++) {
            int32_t after = rest_clamp(slip[k] + (((int64_t)c->drag_q28[k] * dvn) >> 28));

            tangent[k] = c->tangent_impulse[k] - (((int64_t)after * c->step[1]) >> (30 - c->fine_bits));
        }
        limited = rest_cut(tangent, friction_limit(c, c->normal_impulse + along));
    }
    for (int k = 0; k < 3; k++) {
        tangent[k] -= c->tangent_impulse[k];
    }
    take(c, g, along, tangent);
    return limited;
}

/* Along N first; then across towards no slip, within the friction cone. */
static void slide(const struct contact *c, int32_t error, const int32_t v[3], struct gain *g)
{
    int64_t across[3];
    int32_t slip[3];

    for (int k = 0; k < 3; k++) {
        slip[k] = v[k] - carom_mul_q30(error, c->normal.c[k]);
        across[k] = c->tangent_impulse[k] - (((int64_t)slip[k] * c->step[1]) >> (30 - c->fine_bits));
    }
    if (c->friction_q16 == 0 ||
        !slide_by(c, rest_clamp((-(int64_t)error * following_q15(c, across)) >> 15), slip, g)) {
        slide_by(c, -error, slip, g);
    }
}

/* Take up a change; returns its largest component, the last place apart. */
static int32_t add(struct contact *c, const struct gain *g)
{
    int32_t most = 0;

    c->normal_impulse += g->along;
    for (int k = 0; k < 3; k++) {
        int32_t size = g->whole[k] < 0 ? -g->whole[k] : g->whole[k];

        c->tangent_impulse[k] += g->whole[k] - carom_mul_q30(g->along, c->normal.c[k]);
        /* of two sweeps: below 2^31; a contact by itself, of which nobody asks, may wrap */
        c->gain[k] = (int32_t)((uint32_t)c->gain[k] + (uint32_t)g->whole[k]);
        most = size > most ? size : most;
    }
    rest_push(c, g->whole);
    return most > 1 ? most : 0;
}

/* One contact; returns how much a velocity moved. */
static int64_t visit(struct contact *c)
{
    int32_t v[3], error;
    struct gain g;

    present_velocity(c, v);
    error = (int32_t)carom_round(carom_dot(c->normal.c, v), 30);
    if (error >= 0 && c->normal_impulse == 0 &&
        (c->tangent_impulse[0] | c->tangent_impulse[1] | c->tangent_impulse[2]) == 0) {
        return 0; /* it opens */
    }
    if (c->band > 0) {
        leave_band(c, error, v);
    }
    if (c->friction_q16 == 0 || !c->inverted || !stick(c, v, &g)) {
        slide(c, error, v, &g);
    }
    return ((int64_t)c->mass_q24 * add(c, &g)) >> 24;
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
        take(c, &g, along, across);
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
