/* SPDX-License-Identifier: MIT */
/*
 * The velocity that a solve asks for at a contact: rest with its gap kept, or an impact's rebound.
 */
#include "parts.h"

/*
 * True if bodies may rest. If they bounce for ever (e = 1) they may once they lie, or hit again and
 * again.
 */
static bool may_rest(const struct contact *c, int32_t e_q30)
{
    return !rest_bounces_for_ever(e_q30) || c->lasting ||
           c->side[0].body->clock.contact != BODY_FLIES ||
           (c->side[1].body && c->side[1].body->clock.contact != BODY_FLIES);
}

/* The larger velocity that gravity and force give either body in a frame. */
FIX_APART static int64_t pull_q40(const struct contact *c)
{
    int64_t largest_q40 = 0;

    for (int s = 0; s < 2; s++) {
        const struct body *b = c->side[s].body;

        if (b && b->def.acceleration_q40 > largest_q40) {
            largest_q40 = b->def.acceleration_q40;
        }
    }
    return largest_q40;
}

/*
 * An approach slower than this is no impact: 4 g h, or 0 if bodies bounce for ever. In lasting
 * contact also a part of the skin, because without gravity nothing else tells impacts from rest.
 */
static int64_t slow_q40(const struct contact *c, bool rests)
{
    int64_t slow_q40 = rests ? 4 * pull_q40(c) : 0;
    int64_t least_q40 = c->lasting ? carom_shl(c->skin_q22 / REST_LASTING_DIVISOR, 18) : 0;

    return slow_q40 > least_q40 ? slow_q40 : least_q40;
}

/*
 * Newton's e. Without gravity to tell impact from rest a body may come back again and again, nearer
 * each time. So V.N must at least make up for what the path will bend back, plus what the gap lacks
 * to the event gap; if the path does not bend it opens a gap that is all but closed. Neither
 * exceeds the approach, so no energy is added.
 */
static int64_t impact_target_q40(const struct contact *c, int32_t e_q30)
{
    int64_t target_q40 = -fix_mul(c->speed_q40, e_q30, 30);
    int64_t back_q40 = 0;
    int32_t wanted_q22 = c->skin_q22 / REST_TOO_NEAR_DIVISOR;

    if (c->chord_q28 < INT32_MAX && c->speed_q40 > carom_shl(c->chord_q28, 12)) {
        back_q40 = c->speed_q40 - carom_shl(c->chord_q28, 12);
        wanted_q22 = c->skin_q22 / 2;
    }
    back_q40 += wanted_q22 > c->gap_q22 ? carom_shl(wanted_q22 - c->gap_q22, 18) : 0;
    back_q40 = back_q40 < -c->speed_q40 ? back_q40 : -c->speed_q40;
    return target_q40 > back_q40 ? target_q40 : back_q40;
}

/* A way, at least 0, over a time. A moving surface may leave a gap of some units. */
FIX_APART static int64_t speed_q40(int64_t way_q22, int32_t time_q30)
{
    int more = way_q22 < 1 << 22 ? 10 : 0;

    return ((way_q22 << (30 + more)) / (time_q30 >> 8)) << (10 - more);
}

/*
 * Within a step the surface stands where it will be at the step's end, and no body can follow it
 * farther down. A body that would have to counts the surface as standing still along the normal.
 */
static void hold_above(struct contact *c, int32_t tau_q30, int64_t rise_q40)
{
    int64_t room_q22 = c->gap_q22 > c->skin_q22 / 2 ? c->gap_q22 - c->skin_q22 / 2 : 0;
    int64_t least_q40 = tau_q30 > REST_CLOSING_MIN_Q30 ? -speed_q40(room_q22, tau_q30) : 0;

    if (c->work->target_q40 + rise_q40 >= least_q40) {
        return;
    }
    contact_hold_drift(c, rise_q40);
    c->speed_q40 += rise_q40;
    c->work->target_q40 = least_q40;
}

/*
 * The speed at which a lasting contact that is near opens: a part of its skin in each slice, which
 * turns half a radian.
 */
static int64_t lift_q40(const struct contact *c)
{
    int64_t spin_q40 = 0;

    for (int s = 0; s < 2 && c->gap_q22 < c->skin_q22 / 4; s++) {
        int64_t own_q40 = c->side[s].body ? fix_length(c->side[s].body->solve.spin.c) : 0;

        spin_q40 = own_q40 > spin_q40 ? own_q40 : spin_q40;
    }
    return fix_mul(spin_q40, 2 * (c->skin_q22 / REST_LIFT_DIVISOR), 22);
}

/* The part of V.N that the path takes back; the target must include it. */
static int64_t taken_back_q40(const struct contact *c, int64_t rise_q40)
{
    int64_t more_q40 =
        c->chord_q28 < INT32_MAX ? c->speed_q40 + rise_q40 - carom_shl(c->chord_q28, 12) : 0;

    return (more_q40 > 0 ? more_q40 : 0) + (c->lasting ? lift_q40(c) : 0);
}

void rest_prepare_target(const struct rest *r, struct contact *c, int32_t tau_q30)
{
    int32_t e_q30 = rest_restitution_at(r, c);
    bool rests = may_rest(c, e_q30);
    /* a surface stands still within the step; a kinematic body goes on */
    int64_t rise_q40 =
        c->drift && !rest_body(r, c, 1)->def.goes ? contact_rise_q40(c->drift, &c->normal) : 0;
    /* a sinking surface has left behind a body that will follow it */
    int64_t left_behind_q22 = rise_q40 < 0 ? fix_mul(rise_q40, tau_q30, 48) : 0;
    int64_t open_q22 = (int64_t)c->gap_q22 + left_behind_q22 - c->skin_q22;

    c->impact = c->speed_q40 < -slow_q40(c, rests);
    if (c->impact) {
        c->work->target_q40 = impact_target_q40(c, e_q30);
    } else if (!rests) {
        c->work->target_q40 = 0;
    } else if (open_q22 <= c->skin_q22 / REST_NEAR_DIVISOR && open_q22 >= -(c->skin_q22 / 2)) {
        c->work->target_q40 = 0;
    } else if (open_q22 > 0) {
        /* may close until the skins touch; q22 to q40 over the time */
        int32_t time_q30 = tau_q30 > REST_CLOSING_MIN_Q30 ? tau_q30 : REST_CLOSING_MIN_Q30;

        c->work->target_q40 = -speed_q40(open_q22, time_q30);
    } else {
        c->work->target_q40 = ((int64_t)c->skin_q22 << 18) / REST_LIFT_DIVISOR;
        c->work->target_q40 += ((-open_q22 - c->skin_q22 / 2) << 18) / REST_RECOVERY_DIVISOR;
    }
    c->work->band_q30 = c->impact ? 0 : rest_clamp(carom_abs(c->work->target_q40) >> 10);
    if (rests && (!c->impact || c->lasting)) {
        int64_t more_q40 = taken_back_q40(c, rise_q40);
        int64_t *target_q40 = &c->work->target_q40;

        *target_q40 = !c->impact               ? *target_q40 + more_q40
                      : more_q40 > *target_q40 ? more_q40
                                               : *target_q40;
    }
    if (rise_q40 < 0) {
        hold_above(c, tau_q30, rise_q40);
    }
}

bool rest_lies(const struct rest *r, const struct contact *c)
{
    int64_t pull = pull_q40(c);
    carom_v3_q40 v;

    rest_relative_velocity(c, &v);
    return may_rest(c, rest_restitution_at(r, c))
               ? carom_abs(rest_along_q40(&v, &c->normal)) < 4 * pull
               : fix_length(v.c) < pull / REST_CALM_DIVISOR;
}
