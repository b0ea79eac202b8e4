/* SPDX-License-Identifier: MIT */
/* Symmetric sweeps over accumulated, clamped impulses. */
#include "rows.h"
#include "parts.h"

/*
 * Sweeps follow a slip of 13 V* and velocities below 16 V*, of which a vector of components up to
 * 9 V* is one. So a velocity is below 2^31 in length, and so are its parts along N and across.
 */
#define SLIP_MAX  ((int64_t)13 << REST_BITS)
#define PART_MAX  ((int64_t)9 << REST_BITS)
#define SPEED_MAX (((int64_t)16 << REST_BITS) - 64)

/*
 * Contacts of a body or two that slide or roll settle over the frames; a heap that is left unsettled
 * slips, and then takes more sweeps than it was spared.
 */
#define FEW 8

/*
 * Resting contacts that are slower than this part of the residual are left alone. With all of it they
 * would never get below it, and sweeps would run on.
 */
#define DEAD_DIVISOR 8

static int64_t wanted_q40(const struct contact *c, const struct rest_sweep *sw)
{
    return sw->plastic && (c->impact || c->work->target_q40 > 0) ? 0 : c->work->target_q40;
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
    int32_t error = (int32_t)fix_round_shift(c->speed_q40 - wanted, -sw->unit); /* within V* */

    for (int k = 0; k < 3; k++) {
        int64_t along = fix_mul(c->speed_q40, c->normal.c[k], 30);

        slip[k] = fix_round_shift(contact_velocity(c)->c[k] - along, -sw->unit);
    }
    rest_cut(slip, SLIP_MAX);
    PHASE_BEGIN(c->phase, CONTACT_GAIN);
    for (int k = 0; k < 3; k++) {
        c->work->before[k] = (int32_t)slip[k] + carom_mul_q30(error, c->normal.c[k]);
        c->work->tangent_impulse[k] = 0;
        c->gain[k] = c->way[k] = 0;
    }
    c->work->band = rest_clamp(fix_round_shift(carom_shl(c->work->band_q30, 10), -sw->unit));
    c->work->normal_impulse = 0;
}

static void begin(struct rest *r, const struct rest_sweep *sw)
{
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);

        c->work->friction_q16 =
            sw->frictionless ? 0 : rest_friction(rest_body(r, c, 0), rest_body(r, c, 1));
        begin_contact(c, sw);
        for (int s = 0; s < 2; s++) {
            struct body *b = c->side[s].body;

            if (b) {
                body_solve(b)->dv[0] = body_solve(b)->dv[1] = body_solve(b)->dv[2] = 0;
                body_solve(b)->dw[0] = body_solve(b)->dw[1] = body_solve(b)->dw[2] = 0;
            }
        }
    }
}

/* v s - w r modulo 2^64. */
static int64_t wrapping_minor(int32_t v, int32_t v_high, int32_t s, int32_t w, int32_t w_high,
                              int32_t r)
{
    uint32_t high = (uint32_t)v_high * (uint32_t)s - (uint32_t)w_high * (uint32_t)r;

    return (int64_t)((uint64_t)((int64_t)v * s) - (uint64_t)((int64_t)w * r) +
                     ((uint64_t)high << 32));
}

/*
 * out = v x r modulo 2^64, in two halves: the low one signed, and what that leaves.
 */
static void wrapping_cross(int64_t out[3], const int64_t v[3], const int32_t r[3])
{
    int32_t low[3], high[3];

    for (int k = 0; k < 3; k++) {
        low[k] = (int32_t)v[k];
        high[k] = (int32_t)((v[k] - low[k]) >> 32);
    }
    out[0] = wrapping_minor(low[1], high[1], r[2], low[2], high[2], r[1]);
    out[1] = wrapping_minor(low[2], high[2], r[0], low[0], high[0], r[2]);
    out[2] = wrapping_minor(low[0], high[0], r[1], low[1], high[1], r[0]);
}

/* What the solve so far changed the velocity of a body's place of contact by, in finer units. */
static void change_at(const struct contact_side *side, int64_t out[3])
{
    const struct body *b = side->body;
    int64_t dw[3];

    for (int k = 0; k < 3; k++) {
        dw[k] = body_solved(b)->dw[k] >> (REST_FINER_BITS - 2);
    }
    wrapping_cross(out, dw, side->arm_q30);
    for (int k = 0; k < 3; k++) {
        out[k] = body_solved(b)->dv[k] + (out[k] >> (32 - REST_FINER_BITS));
    }
}

/*
 * V - wanted N by now. A thin body's spin may fill 40 bits while the sum stays small, so products
 * wrap: modulo 2^64 the sum is right.
 */
static void present_velocity(const struct contact *c, int32_t v[3])
{
    int64_t sum[3] = {0, 0, 0}, other[3] = {0, 0, 0};
    bool fast = false;

    if (c->side[0].body) {
        change_at(&c->side[0], sum);
    }
    if (c->side[1].body) {
        change_at(&c->side[1], other);
    }
    for (int k = 0; k < 3; k++) {
        sum[k] = c->work->before[k] + carom_round(sum[k] - other[k], REST_FINER_BITS);
        v[k] = (int32_t)sum[k];
        fast |= sum[k] > PART_MAX || sum[k] < -PART_MAX;
    }
    if (fast) {
        rest_cut(sum, SPEED_MAX);
        for (int k = 0; k < 3; k++) {
            v[k] = (int32_t)sum[k];
        }
    }
}

/* Friction is not against slip that closing a gap asks for. */
static void leave_band(const struct contact *c, int32_t error, int32_t v[3])
{
    int32_t slip[3], ratio_q30 = CAROM_ONE_Q30;
    uint64_t square;

    for (int k = 0; k < 3; k++) {
        slip[k] = v[k] - carom_mul_q30(error, c->normal.c[k]);
    }
    square = rest_square32(slip);
    if (square > (uint64_t)((int64_t)c->work->band * c->work->band)) {
        ratio_q30 = (int32_t)(((uint64_t)(uint32_t)c->work->band << 30) / fix_sqrt(square));
    }
    for (int k = 0; k < 3; k++) {
        v[k] -= carom_mul_q30(slip[k], ratio_q30);
    }
}

static int64_t friction_limit(const struct contact *c, int64_t normal_impulse)
{
    return fix_mul(normal_impulse, (int32_t)c->work->friction_q16, 16);
}

/* A change of impulse, each part below 2^30: along N, and with what is across it. */
struct gain {
    int32_t along, whole[3];
};

/*
 * What ends all motion of the contact; false when that lies outside of the friction cone. Large
 * velocities are shifted down: the next visit finds what is left over. As K is at least 1 the change
 * is then below 2^30.
 */
static bool stick(const struct contact *c, const int32_t v[3], struct gain *g)
{
    int down = fix_bits32((uint32_t)((v[0] ^ (v[0] >> 31)) | (v[1] ^ (v[1] >> 31)) |
                                     (v[2] ^ (v[2] >> 31)))) +
               c->work->fine_bits - 29;
    int64_t after[4], limit;
    int32_t part[3], across[3];

    down = down > 0 ? down : 0;
    for (int k = 0; k < 3; k++) {
        part[k] = v[k] >> down;
    }
    for (int k = 0; k < 3; k++) {
        g->whole[k] =
            -(int32_t)carom_round(rest_row(contact_inverse(c), k, part), 30 - c->work->fine_bits);
    }
    g->along = (int32_t)carom_round(carom_dot(c->normal.c, g->whole), 30);
    after[3] = c->work->normal_impulse + carom_shl(g->along, down);
    if (after[3] <= 0) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        after[k] = c->work->tangent_impulse[k] +
                   carom_shl(g->whole[k] - carom_mul_q30(g->along, c->normal.c[k]), down);
    }
    /* mu is at most 4: the limit has 31 bits */
    rest_shrink(after, 29);
    for (int k = 0; k < 3; k++) {
        across[k] = (int32_t)after[k];
    }
    limit = (after[3] * (int32_t)c->work->friction_q16) >> 16;
    return rest_square32(across) <= (uint64_t)(limit * limit);
}

/*
 * How much longer a step along N is when friction at its limit follows it: N.K N over N.K (N + mu t),
 * t being the unit vector along v. Where a contact nearly wedges, 8.
 */
static int32_t following_q15(const struct contact *c, const int64_t v[3])
{
    int64_t t[4] = {v[0], v[1], v[2], 0};
    uint32_t square = 1;
    int64_t drag = 0;
    int32_t mass_q11;

    /* 15 bits will do: this only sets the pace. |t| |drag| is below 2^16 2^31.8 */
    rest_shrink(t, 15);
    for (int k = 0; k < 3; k++) {
        int32_t part = (int32_t)t[k];

        square += (uint32_t)(part * part);
        drag += (int64_t)part * c->work->drag_q28[k];
    }
    mass_q11 = (int32_t)(drag >> 17) / (int32_t)fix_sqrt(square);
    mass_q11 = 2048 + (int32_t)(((int64_t)mass_q11 * c->work->friction_q16) >> 16);
    return (1 << 26) / (mass_q11 > 256 ? mass_q11 : 256);
}

/*
 * Change V.N by dvn, never pulling, and end what that leaves of the slip, as far as friction does.
 * Returns whether it does not.
 */
static bool slide_by(const struct contact *c, int32_t dvn, const int32_t slip[3], struct gain *g)
{
    int64_t change[4] = {0, 0, 0,
                         carom_round((int64_t)dvn * c->work->step[0], 30 - c->work->fine_bits)};
    bool limited = true;

    if (change[3] <= -c->work->normal_impulse) {
        change[3] = -c->work->normal_impulse;
    } else {
        for (int k = 0; k < 3; k++) {
            int32_t after = rest_clamp(slip[k] + (((int64_t)c->work->drag_q28[k] * dvn) >> 28));

            change[k] = c->work->tangent_impulse[k] -
                        (((int64_t)after * c->work->step[1]) >> (30 - c->work->fine_bits));
        }
        limited = rest_cut(change, friction_limit(c, c->work->normal_impulse + change[3]));
    }
    for (int k = 0; k < 3; k++) {
        change[k] -= c->work->tangent_impulse[k];
    }
    /* if that is too large for one push a part of all of it: from one place in the cone to another */
    rest_shrink(change, 29);
    g->along = (int32_t)change[3];
    for (int k = 0; k < 3; k++) {
        g->whole[k] = (int32_t)change[k] + carom_mul_q30(g->along, c->normal.c[k]);
    }
    return limited;
}

/* Along N first; then across towards no slip, within the friction cone. */
static void slide(const struct contact *c, int32_t error, const int32_t v[3], struct gain *g)
{
    int64_t across[3];
    int32_t slip[3];

    for (int k = 0; k < 3; k++) {
        slip[k] = v[k] - carom_mul_q30(error, c->normal.c[k]);
        across[k] = c->work->tangent_impulse[k] -
                    (((int64_t)slip[k] * c->work->step[1]) >> (30 - c->work->fine_bits));
    }
    if (c->work->friction_q16 == 0 ||
        !slide_by(c, rest_clamp((-(int64_t)error * following_q15(c, across)) >> 15), slip, g)) {
        slide_by(c, -error, slip, g);
    }
}

/* Take up a change; returns its largest component, the last place apart. */
static int32_t add(struct contact *c, const struct gain *g)
{
    int32_t most = 0;

    c->work->normal_impulse += g->along;
    for (int k = 0; k < 3; k++) {
        int32_t size = g->whole[k] < 0 ? -g->whole[k] : g->whole[k];

        c->work->tangent_impulse[k] += g->whole[k] - carom_mul_q30(g->along, c->normal.c[k]);
        /* of two sweeps: below 2^31; a contact by itself, of which nobody asks, may wrap */
        contact_gain(c)->gain[k] = (int32_t)((uint32_t)c->gain[k] + (uint32_t)g->whole[k]);
        most = size > most ? size : most;
    }
    rest_push(c, g->whole);
    return most > 1 ? most : 0;
}

/*
 * One contact; returns how much a velocity moved. One that is slower than `quiet`, a
 * power of 2, is at rest.
 */
static int64_t visit(struct contact *c, int32_t quiet)
{
    int32_t v[3], error;
    struct gain g;

    present_velocity(c, v);
    error = (int32_t)carom_round(carom_dot(c->normal.c, v), 30);
    if (error >= 0 && c->work->normal_impulse == 0 &&
        (c->work->tangent_impulse[0] | c->work->tangent_impulse[1] | c->work->tangent_impulse[2]) ==
            0) {
        return 0; /* it opens */
    }
    if (c->work->band > 0) {
        leave_band(c, error, v);
    }
    if (((v[0] ^ (v[0] >> 31)) | (v[1] ^ (v[1] >> 31)) | (v[2] ^ (v[2] >> 31))) < quiet) {
        return 0;
    }
    if (c->work->friction_q16 == 0 || !c->work->inverted || !stick(c, v, &g)) {
        slide(c, error, v, &g);
    }
    return ((int64_t)c->work->mass_q24 * add(c, &g)) >> 24;
}

/* A component of the way: three of them make up a vector below 2^30. */
static int32_t way_of(int64_t v)
{
    const int64_t most = CAROM_ONE_Q30 / 2;

    return (int32_t)(v > most ? most : v < -most ? -most : v);
}

/*
 * Two sweeps, forwards and backwards, are one step of a symmetric iteration; its steps are
 * conjugated (Fletcher-Reeves), which takes the root of the number of sweeps. When they grow, it
 * begins anew.
 */
static void accelerate(struct rest *r, int64_t moved, int64_t before)
{
    int32_t part_q30 = moved < before ? (int32_t)(moved * CAROM_ONE_Q30 / before) : 0;

    part_q30 = carom_mul_q30(part_q30, part_q30);
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);
        int32_t all = 0;
        struct gain g;

        for (int k = 0; k < 3; k++) {
            g.whole[k] = carom_mul_q30(contact_gain(c)->way[k], part_q30);
            all |= c->gain[k] | g.whole[k];
            c->way[k] = way_of((int64_t)g.whole[k] + c->gain[k]);
            c->gain[k] = 0;
        }
        if (all != 0) {
            g.along = (int32_t)carom_round(carom_dot(c->normal.c, g.whole), 30);
            for (int k = 0; c->work->friction_q16 == 0 && k < 3; k++) {
                g.whole[k] = carom_mul_q30(g.along, c->normal.c[k]);
            }
            add(c, &g);
            c->gain[0] = c->gain[1] = c->gain[2] = 0;
        }
        if (c->work->rolls) {
            rest_roll_accelerate(c, part_q30);
        }
    }
}

/* When sweeps run out, a contact's last visit may not have gone all its way. */
static void into_cones(struct rest *r)
{
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);

        c->work->normal_impulse = c->work->normal_impulse > 0 ? c->work->normal_impulse : 0;
        rest_cut(c->work->tangent_impulse, friction_limit(c, c->work->normal_impulse));
    }
}

static int most_rounds(const struct rest *r, const struct rest_sweep *sw)
{
    int rounds = !sw->rolls        ? REST_SWEEPS_MAX
                 : r->count <= FEW ? REST_SWEEPS_FEW
                                   : REST_SWEEPS_MANY;

    return r->sweep_cap > 0 && r->sweep_cap < rounds ? r->sweep_cap : rounds;
}

/* Returns whether they ran out before the residual was reached. */
static bool sweeps(struct rest *r, const struct rest_sweep *sw)
{
    uint32_t n = r->count;
    /* a contact by itself is solved in a visit or a few */
    bool coupled = n > 1 || rest_contact(r, 0)->work->rolls;
    int rounds = most_rounds(r, sw);
    int64_t before = 0;

    for (int round = 0; round < rounds; round++) {
        int64_t moved = 0;

        r->sweeps++;
        for (uint32_t i = 0; i < n; i++) {
            /* forwards and backwards in turn, so that no end of a stack is favoured */
            uint32_t at = round & 1 ? n - 1 - i : i;
            int64_t m = visit(rest_contact(r, at), sw->rolls ? sw->residual / DEAD_DIVISOR : 0);

            moved = m > moved ? m : moved;
            if (rest_contact(r, at)->work->rolls) {
                m = rest_roll_sweep(r, at, sw->residual);
                moved = m > moved ? m : moved;
            }
        }
        if (moved <= sw->residual) {
            return false;
        }
        if (coupled && round & 1 && round < rounds - 1) {
            moved = moved < (int64_t)1 << 32 ? moved : (int64_t)1 << 32;
            accelerate(r, moved, before);
            before = moved;
        }
    }
    into_cones(r);
    return true;
}

/* Impulses in solver units to momentum, one rounding a component. */
static void finish(struct rest *r, const struct rest_sweep *sw)
{
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);
        struct fix_scaled unit = c->work->mass_unit;

        PHASE_BEGIN(c->phase, CONTACT_IMPULSE);
        unit.e += 8 - sw->unit; /* 8 more bits survive the sum */
        for (int k = 0; k < 3; k++) {
            int64_t j = fix_mul(c->work->normal_impulse, c->normal.c[k], 22) +
                        carom_shl(c->work->tangent_impulse[k], 8);

            c->impulse_q40.c[k] = fix_mul_scaled(j, unit);
        }
        if (sw->rolls) {
            rest_roll_finish(c, sw);
        }
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
        rest_contact(r, i)->work->rolls = sw->rolls && rest_roll_prepare(r, i, sw);
    }
    sw->ran_out = sweeps(r, sw);
    finish(r, sw);
}
