/* SPDX-License-Identifier: MIT */
/*
 * Rolling friction. Bodies that press on each other touch over a patch, and the middle of the
 * pressure can lie anywhere in it. So besides an impulse the contact carries a moment of up to the
 * patch's radius times the normal impulse, against the relative spin. Without it a body of many
 * small faces rolls to and fro in a hollow for a long time.
 */
#include "rows.h"
#include "parts.h"

/* Whether contact i is the first of its pair. */
static bool leads(const struct rest *r, uint32_t i)
{
    return i == 0 || !rest_same_pair(r, i, i - 1);
}

/*
 * True if rolling friction applies: a body rolls over one contact or two. Three or more resist
 * rolling by the width that they span, and a moment besides would only make the solution ambiguous.
 * The last frame's impulses tell which contacts carry.
 */
static bool may_roll(const struct rest *r, uint32_t i)
{
    uint32_t all = 0, pressed = 0;

    for (uint32_t n = i; rest_same_pair(r, i, n); n++) {
        all++;
        pressed += rest_contact(r, n)->work->normal_impulse > 0;
    }
    return all <= 2 || (pressed > 0 && pressed <= 2);
}

/* True if a body that turns about the contact rises: its centre moves by arm x spin. */
static bool rises(const struct contact_side *side)
{
    const struct body *b = side->body;
    struct fix_wide sum = {0, 0};

    for (int k = 0; b && k < 3; k++) {
        int m = fix_next(k), n = fix_next(m), bits = contact_arm_bits(b);

        fix_wide_add_product(&sum,
                             fix_mul(b->solve.spin.c[n], side->arm_q30[m], bits) -
                                 fix_mul(b->solve.spin.c[m], side->arm_q30[n], bits),
                             b->def.acceleration.c[k]);
    }
    return fix_wide_sign(&sum) < 0;
}

/* True if the pair of contact i rolls up on all contacts that pressed in the last frame. */
static bool rolls_up(const struct rest *r, uint32_t i)
{
    bool up = false;

    for (uint32_t n = i; rest_same_pair(r, i, n); n++) {
        const struct contact *c = rest_contact(r, n);

        if (c->work->normal_impulse > 0) {
            up = rises(&c->side[0]) || rises(&c->side[1]);
            if (!up) {
                return false;
            }
        }
    }
    return up;
}

/* Rolling friction of a pair: CAROM_ROLLING_Q16 stands for an arm of REST_ROLL_SKINS. */
static uint32_t rolling_q16(const struct rest *r, const struct contact *c)
{
    const struct body_extra *a, *b;
    uint64_t product;

    if (r->list.plain) {
        return CAROM_ROLLING_Q16;
    }
    a = rest_body(r, c, 0)->def.extra;
    b = rest_body(r, c, 1)->def.extra;
    /* each is at most 2^16 */
    product = (uint64_t)(a ? a->rolling_q16 : CAROM_ROLLING_Q16) *
              (b ? b->rolling_q16 : CAROM_ROLLING_Q16) / CAROM_ROLLING_Q16;
    return product < 1 << 16 ? (uint32_t)product : 1 << 16;
}

/* The arm of the pair of contact i at ordinary rolling friction. */
FIX_APART static int64_t arm_q22(const struct rest *r, uint32_t i)
{
    const struct contact *c = rest_contact(r, i);
    int64_t spin_q40[3] = {0, 0, 0}, speed_q40, whole_q40 = 1, grown;

    if (rolls_up(r, i)) {
        return REST_ROLL_SKINS * (int64_t)c->skin_q22;
    }
    for (int s = 0; s < 2; s++) {
        const struct body *b = c->side[s].body;

        for (int k = 0; b && k < 3; k++) {
            spin_q40[k] += s == 0 ? b->solve.spin.c[k] : -b->solve.spin.c[k];
        }
        if (b && REST_ROLL_FRAMES * b->def.acceleration_q40 > whole_q40) {
            whole_q40 = REST_ROLL_FRAMES * b->def.acceleration_q40;
        }
    }
    /* a radius has 2048 skins */
    speed_q40 = fix_mul(fix_length(spin_q40), c->skin_q22, 22 - 11);
    speed_q40 = speed_q40 < whole_q40 ? speed_q40 : whole_q40;
    /* gravity and force give at most 2 units a frame: below 2^43, and a skin is below 2^20 */
    grown = c->skin_q22 * (REST_ROLL_SKINS - REST_ROLL_SKINS_DOWN) * (speed_q40 >> 6) /
            ((whole_q40 >> 6) + 1);
    return REST_ROLL_SKINS_DOWN * (int64_t)c->skin_q22 + grown;
}

/* Fractional bits of a column of R H in the pair's unit of length. */
static int column_bits(const struct contact *c, const struct body *b, int j)
{
    return b->def.mesh->spread.e[j] + 22 - c->work->roll->unit_bits;
}

/*
 * Bound on the largest eigenvalue of R J^-1 R^T, its largest row sum, times the body's share of an
 * impulse.
 */
static int64_t turning_q30(const struct contact *c, int s)
{
    const struct body *b = c->side[s].body;
    int64_t largest = 0;

    for (int i = 0; i < 3; i++) {
        int64_t sum = 0;

        for (int k = 0; k < 3; k++) {
            int64_t entry = 0;

            for (int j = 0; j < 3; j++) {
                const int32_t *column = body_solved(b)->columns[j];

                entry +=
                    fix_round_shift((int64_t)column[i] * column[k], 30 - 2 * column_bits(c, b, j));
            }
            sum += carom_abs(entry);
        }
        largest = sum > largest ? sum : largest;
    }
    return fix_mul_q30(largest, c->work->lever[s].share_q30) >> c->work->fine_bits;
}

bool rest_roll_prepare(struct rest *r, uint32_t i, const struct rest_sweep *sw)
{
    struct contact *c = rest_contact(r, i);
    struct contact_roll *roll;
    const struct body *a = c->side[0].body, *b = c->side[1].body;
    int64_t spin[3] = {0, 0, 0}, mass_q30 = 0;

    c->work->roll = NULL;
    if (!leads(r, i) || !may_roll(r, i) || c->work->friction_q16 == 0 ||
        rest_bounces_for_ever(rest_restitution_at(r, c)) || rolling_q16(r, c) == 0) {
        return false;
    }
    c->work->roll = roll = &r->rolls[r->roll_count++];
    PHASE_BEGIN(roll->phase, CONTACT_ROLLING);
    roll->unit_bits =
        (b && b->def.unit_bits < a->def.unit_bits) ? b->def.unit_bits : a->def.unit_bits;
    /* an arm is below 2^21 and becomes at most 64 times as long */
    roll->arm_q30 = rest_clamp(
        carom_shl(arm_q22(r, i) * rolling_q16(r, c) / CAROM_ROLLING_Q16, 30 - roll->unit_bits));
    for (int s = 0; s < 2; s++) {
        const struct contact_side *side = &c->side[s];

        if (!side->body) {
            continue;
        }
        mass_q30 += turning_q30(c, s);
        for (int k = 0; k < 3; k++) {
            int64_t part =
                fix_round_shift(side->body->solve.spin.c[k], roll->unit_bits - 22 - sw->unit);

            spin[k] += s == 0 ? part : -part;
        }
    }
    rest_cut(spin, INT32_MAX);
    for (int k = 0; k < 3; k++) {
        roll->spin[k] = (int32_t)spin[k];
        roll->moment[k] = roll->gain[k] = roll->way[k] = 0;
    }
    roll->mass_q24 = rest_clamp(mass_q30 >> 6);
    roll->step_q24 = rest_clamp(((int64_t)1 << 54) / (mass_q30 | 1));
    return true;
}

/* Apply a moment to the bodies. */
static void twist(struct contact *c, const int32_t moment[3])
{
    for (int s = 0; s < 2; s++) {
        struct body *b = c->side[s].body;
        int32_t part[3];

        if (!b) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            int32_t own = carom_mul_q30(moment[k], c->work->lever[s].share_q30);

            part[k] = s == 0 ? own : -own;
        }
        for (int j = 0; j < 3; j++) {
            int64_t turn = carom_dot(body_solve(b)->columns[j], part);

            turn = fix_round_shift(turn, b->solve.turn_bits + 1 - c->work->fine_bits -
                                             column_bits(c, b, j));
            body_solve(b)->used |=
                rest_add(&body_solve(b)->du[j], rest_within(turn, CAROM_ONE_Q30));
        }
    }
}

/* The change of a body's spin since the start of the solve. */
static void spin_by_now(const struct contact *c, const struct body *b, int64_t out[3])
{
    out[0] = out[1] = out[2] = 0;
    for (int j = 0; j < 3; j++) {
        const int32_t *column = body_solved(b)->columns[j];
        int down = b->solve.turn_bits + 1 + column_bits(c, b, j);

        for (int k = 0; k < 3; k++) {
            out[k] += fix_round_shift((int64_t)column[k] * body_solved(b)->du[j], -down);
        }
    }
}

int64_t rest_roll_sweep(struct rest *r, uint32_t i, int32_t quiet)
{
    struct contact *c = rest_contact(r, i);
    struct contact_roll *roll = contact_rolling(c);
    int64_t pressure = 0, next[3], spin[3] = {roll->spin[0], roll->spin[1], roll->spin[2]};
    int32_t change[3], limit, moved;

    for (uint32_t n = i; rest_same_pair(r, i, n); n++) {
        pressure += rest_contact(r, n)->work->normal_impulse;
    }
    for (int s = 0; s < 2; s++) {
        int64_t dw[3];

        if (c->side[s].body) {
            spin_by_now(c, c->side[s].body, dw);
            FIX_UNROLL
            for (int k = 0; k < 3; k++) {
                spin[k] += s == 0 ? dw[k] : -dw[k];
            }
        }
    }
    /* so that a moment's components stay within 2^30 */
    limit = rest_clamp(fix_mul_q30(pressure, roll->arm_q30));
    limit = limit < CAROM_ONE_Q30 ? limit : CAROM_ONE_Q30;
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        next[k] = roll->moment[k] - (((int64_t)rest_clamp(spin[k]) * roll->step_q24) >> 24);
    }
    rest_cut(next, limit > 0 ? limit : 0);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        change[k] = (int32_t)next[k] - roll->moment[k];
    }
    moved = rest_clamp(((int64_t)roll->mass_q24 * fix_largest(change)) >> 24);
    if (moved < quiet) {
        return 0;
    }
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        roll->moment[k] += change[k];
        roll->gain[k] = rest_clamp((int64_t)roll->gain[k] + change[k]);
    }
    twist(c, change);
    return moved;
}

const carom_v3_q40 *rest_moment(const struct contact *c)
{
    static const carom_v3_q40 none = {{0, 0, 0}};

    return c->work && c->work->roll ? contact_moment(c) : &none;
}

void rest_roll_finish(struct contact *c, const struct rest_sweep *sw)
{
    struct fix_scaled unit = contact_mass_unit(c);
    struct contact_roll *roll = c->work->roll;

    if (!c->work->rolls) {
        return;
    }
    unit.e -= sw->unit + roll->unit_bits - 22;
    PHASE_BEGIN(roll->phase, CONTACT_MOMENT);
    for (int k = 0; k < 3; k++) {
        roll->moment_q40.c[k] = fix_mul_scaled(roll->moment[k], unit);
    }
}

void rest_roll_accelerate(struct contact *c, int32_t part_q30)
{
    struct contact_roll *roll = contact_rolling(c);
    int32_t gain[3], any = 0;

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        int32_t way = carom_mul_q30(rest_clamp((int64_t)roll->way[k] + roll->gain[k]), part_q30);

        /* a moment's component is at most 2^30; the bodies have gone all the way already */
        roll->way[k] = rest_within((int64_t)roll->moment[k] + way, CAROM_ONE_Q30) - roll->moment[k];
        gain[k] = roll->way[k] - way;
        roll->moment[k] += roll->way[k];
        roll->gain[k] = 0;
        any |= gain[k];
    }
    if (any) {
        twist(c, gain);
    }
}
