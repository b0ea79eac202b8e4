/* SPDX-License-Identifier: MIT */
/* Effective masses of a contact: what a unit impulse changes. */
#include "rest_parts.h"

/* Change of spin by a unit impulse along direction d, and what it adds to the effective mass. */
static int64_t prepare_lever(struct contact_side *side, const carom_v3_q30 *direction, int d)
{
    const struct body *b = side->body;
    struct carom_sym3 inverse = b->inverse_inertia;
    int64_t turn_q30[3], added_q30 = 0;
    uint64_t all = 0;
    int shift;

    /* over the unit of length l: arm / l here and J / l^2 below */
    carom_cross(side->lever_q30[d], side->arm.c, direction->c, b->unit_bits);
    inverse.e -= 2 * (b->unit_bits - 22);
    for (int k = 0; k < 3; k++) {
        turn_q30[k] = side->lever_q30[d][k];
    }
    fix_rotate_back(turn_q30, &b->path.start.r, turn_q30);
    body_sym3_mul(turn_q30, &inverse, turn_q30);
    fix_rotate(turn_q30, &b->path.start.r, turn_q30);
    for (int k = 0; k < 3; k++) {
        turn_q30[k] = fix_mul(turn_q30[k], side->share_q30, 30);
        added_q30 += fix_mul(turn_q30[k], side->lever_q30[d][k], 30);
        all |= (uint64_t)carom_abs(turn_q30[k]);
    }
    /* a thin body turns fast about its axis: keep 30 bits whatever the size */
    shift = fix_bits(all) - 30;
    if (shift < -20) {
        shift = -20;
    }
    for (int k = 0; k < 3; k++) {
        side->turn[d][k] = shift > 0 ? (int32_t)carom_round(turn_q30[k], shift)
                                     : (int32_t)carom_shl(turn_q30[k], -shift);
    }
    side->turn_bits[d] = 30 - shift;
    return added_q30;
}

/* lever of direction 1 times the turn by direction 2: how the tangents are coupled. */
static int64_t tangent_coupling_q30(const struct contact *c)
{
    int64_t sum = 0;

    for (int s = 0; s < 2; s++) {
        const struct contact_side *side = &c->side[s];

        for (int k = 0; side->body && k < 3; k++) {
            sum +=
                carom_round((int64_t)side->turn[2][k] * side->lever_q30[1][k], side->turn_bits[2]);
        }
    }
    return sum;
}

void rest_prepare_masses(struct contact *c)
{
    struct contact_side *a = &c->side[0], *b = &c->side[1];
    struct fix_scaled unit;
    int64_t off[3], tangent;

    unit = a->body ? a->body->mass : b->body->mass;
    if (a->body && b->body &&
        fix_mul_scaled(CAROM_ONE_Q30, b->body->mass) < fix_mul_scaled(CAROM_ONE_Q30, unit)) {
        unit = b->body->mass;
    }
    c->mass_unit = unit;
    memset(c->mass_q30, 0, sizeof c->mass_q30);
    for (int s = 0; s < 2; s++) {
        struct contact_side *side = &c->side[s];

        if (!side->body) {
            continue;
        }
        if (side->body->mass.m == unit.m && side->body->mass.e == unit.e) {
            side->share_q30 = CAROM_ONE_Q30;
        } else {
            int64_t unit_q40 = fix_mul_scaled((int64_t)1 << 40, unit);

            side->share_q30 = (int32_t)(fix_mul_scaled(unit_q40, side->body->inverse_mass) >> 10);
        }
        for (int d = 0; d < 3; d++) {
            c->mass_q30[d] += side->share_q30 + prepare_lever(side, &c->direction[d], d);
        }
    }
    /* the larger eigenvalue of the tangents' 2x2: one scalar that never overshoots */
    off[0] = (c->mass_q30[1] - c->mass_q30[2]) / 2;
    off[1] = tangent_coupling_q30(c);
    off[2] = 0;
    tangent = (c->mass_q30[1] + c->mass_q30[2]) / 2 + fix_length(off);
    /* K is at least 1: the lighter body alone gives that */
    c->step_q30[0] = (int32_t)(((int64_t)1 << 60) / c->mass_q30[0]);
    c->step_q30[1] = (int32_t)(((int64_t)1 << 60) / tangent);
}
