/* SPDX-License-Identifier: MIT */
/* Sweep over accumulated, clamped impulses until the residual is reached. */
#include "sweep.h"

/* 2^32 times a place's velocity by du, modulo 2^64: one that is too large begins anew. */
static inline uint64_t turned(const int32_t turn[3], const int32_t du[3])
{
    return (uint64_t)((int64_t)turn[0] * du[0]) + (uint64_t)((int64_t)turn[1] * du[1]) +
           (uint64_t)((int64_t)turn[2] * du[2]);
}

/* V - wanted N at present. */
static void present_velocity(const struct contact *c, int32_t v[3])
{
    const struct body *a = c->side[0].body, *b = c->side[1].body;

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        uint64_t turn = ((uint64_t)1 << 31) + turned(c->work->lever[0].turn[k], body_solved(a)->du);
        int32_t way = (1 << (REST_FINER_BITS - 1)) + body_solved(a)->dv[k];

        if (b) {
            turn -= turned(c->work->lever[1].turn[k], body_solved(b)->du);
            way -= body_solved(b)->dv[k];
        }
        v[k] = c->work->before[k] + (way >> REST_FINER_BITS) + (int32_t)((int64_t)turn >> 32);
    }
}

/*
 * Remove from v the slip that closing a gap asks for, up to the band: friction does not act against
 * it.
 */
static void leave_band(const struct contact *c, int32_t error, int32_t v[3])
{
    int32_t slip[3], ratio_q30 = CAROM_ONE_Q30;
    uint64_t square;

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        slip[k] = v[k] - carom_mul_q30(error, c->normal.c[k]);
    }
    square = rest_square32(slip);
    if (square > (uint64_t)((int64_t)c->work->band * c->work->band)) {
        ratio_q30 = (int32_t)(((uint64_t)(uint32_t)c->work->band << 30) / fix_sqrt(square));
    }
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        v[k] -= carom_mul_q30(slip[k], ratio_q30);
    }
}

static int64_t friction_limit(const struct contact *c, int64_t normal_impulse)
{
    return fix_mul(normal_impulse, (int32_t)c->work->friction_q16, 16);
}

/* True if an impulse is within the friction cone; mu is at most 4. */
static bool in_cone(const struct contact *c, int64_t normal, const int64_t tangent[3])
{
    int64_t all[4] = {tangent[0], tangent[1], tangent[2], normal}, limit;
    int32_t across[3];

    rest_shrink(all, 29);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        across[k] = (int32_t)all[k];
    }
    limit = (all[3] * (int32_t)c->work->friction_q16) >> 16;
    return rest_square32(across) <= (uint64_t)(limit * limit);
}

/*
 * Set the change that ends all motion of the contact. Returns false if that leaves the friction
 * cone. Large velocities are shifted down first, and the next visit finds the rest. K is at least
 * 1, so the change is then below 2^30.
 */
static bool stick(const struct contact *c, const int32_t v[3], struct rest_change *g)
{
    const int32_t *m = contact_inverse(c), *n = c->normal.c;
    const struct contact_work *in = c->work;
    int up = 30 - in->fine_bits;
    int down = fix_bits32((uint32_t)((v[0] ^ (v[0] >> 31)) | (v[1] ^ (v[1] >> 31)) |
                                     (v[2] ^ (v[2] >> 31)))) +
               in->fine_bits - 30;
    int32_t slow[3];
    int64_t normal, tangent[3], whole[3];

    down = down > 0 ? down : 0;
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        slow[k] = v[k] >> down;
    }
    fix_sym3_dot(whole, m, slow);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        g->whole[k] = -(int32_t)carom_round(whole[k], up);
    }
    g->along = (int32_t)carom_round(carom_dot(n, g->whole), 30);
    normal = in->normal_impulse + carom_shl(g->along, down);
    if (normal <= 0) {
        return false;
    }
    rest_split_change(g, n);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        tangent[k] = in->tangent_impulse[k] + carom_shl(g->across[k], down);
    }
    return in_cone(c, normal, tangent);
}

/*
 * The factor for a step along N that friction at its limit follows: N.K N over N.K (N + mu t), t
 * the unit vector along v. At most 8, for a contact that nearly wedges.
 */
static int32_t following_q15(const struct contact *c, const int64_t v[3])
{
    int64_t t[4] = {v[0], v[1], v[2], 0};
    uint32_t square = 1;
    int64_t drag = 0;
    int32_t mass_q11;

    /* 15 bits suffice, since this only sets the pace. |t| |drag| is below 2^16 2^31.8 */
    rest_shrink(t, 15);
    FIX_UNROLL
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
 * Set the change that changes V.N by dvn, never pulling, and ends the remaining slip as far as
 * friction can. Returns true if friction is at its limit.
 */
static bool slide_by(const struct contact *c, int32_t dvn, const int32_t slip[3],
                     struct rest_change *g)
{
    const struct contact_work *in = c->work;
    const int down = 30 - in->fine_bits;
    int64_t change[4] = {0, 0, 0, carom_round((int64_t)dvn * in->step[0], down)};
    bool limited = true;

    if (change[3] <= -in->normal_impulse) {
        change[3] = -in->normal_impulse;
    } else {
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            int32_t after = rest_clamp(slip[k] + (((int64_t)in->drag_q28[k] * dvn) >> 28));

            change[k] = in->tangent_impulse[k] - (((int64_t)after * in->step[1]) >> down);
        }
        limited = rest_cut(change, friction_limit(c, in->normal_impulse + change[3]));
    }
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        change[k] -= in->tangent_impulse[k];
    }
    /*
     * if it is too large for one push, push a part of all of it: from one place in the cone to
     * another
     */
    rest_shrink(change, 29);
    g->along = (int32_t)change[3];
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        g->across[k] = (int32_t)change[k];
        g->whole[k] = (int32_t)change[k] + carom_mul_q30(g->along, c->normal.c[k]);
    }
    return limited;
}

/* Slide: along N first, then across towards no slip, within the friction cone. */
static void slide(struct contact *c, int32_t error, const int32_t v[3], struct rest_change *g)
{
    int64_t pushed[3];
    int32_t slip[3];

    if (!c->work->slides) {
        rest_prepare_slide(c);
    }
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        slip[k] = v[k] - carom_mul_q30(error, c->normal.c[k]);
        pushed[k] = c->work->tangent_impulse[k] -
                    (((int64_t)slip[k] * c->work->step[1]) >> (30 - c->work->fine_bits));
    }
    if (c->work->friction_q16 == 0 ||
        !slide_by(c, rest_clamp((-(int64_t)error * following_q15(c, pushed)) >> 15), slip, g)) {
        slide_by(c, -error, slip, g);
    }
}

/*
 * Visit a contact; returns how much a velocity moved. A contact slower than `quiet`, a power of 2,
 * counts as at rest.
 */
static int64_t visit(struct contact *c, int32_t quiet)
{
    int32_t v[3], error;
    struct rest_change g;

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
    if (c->work->friction_q16 > 0 && c->work->waits) {
        rest_invert(c);
    }
    if (c->work->friction_q16 == 0 || !c->work->inverted || !stick(c, v, &g)) {
        slide(c, error, v, &g);
    }
    return ((int64_t)c->work->mass_q24 * rest_gain(c, &g)) >> 24;
}

/*
 * Put impulses into their cones: the last visit may not have gone all its way, or may have skipped
 * a contact outside.
 */
static void into_cones(struct rest *r)
{
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);

        c->work->normal_impulse = c->work->normal_impulse > 0 ? c->work->normal_impulse : 0;
        if (!in_cone(c, c->work->normal_impulse, c->work->tangent_impulse)) {
            rest_cut(c->work->tangent_impulse, friction_limit(c, c->work->normal_impulse));
        }
    }
}

FIX_APART static int most_rounds(const struct rest *r, const struct rest_sweep *sw)
{
    int rounds = sw->exact              ? REST_SWEEPS_EXACT
                 : sw->calm             ? REST_SWEEPS_CALM
                 : !sw->rolls           ? REST_SWEEPS_MAX
                 : r->count <= REST_FEW ? REST_SWEEPS_FEW
                                        : REST_SWEEPS_MANY;

    if (rest_has_joints(r) && !sw->exact) {
        rounds = REST_SWEEPS_JOINTS;
    }

    return r->sweep_cap > 0 && r->sweep_cap < rounds ? r->sweep_cap : rounds;
}

/* True if a body's velocities have outgrown their bits. */
static bool outgrown(const struct rest *r)
{
    uint32_t used = 0;

    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        used |= body_solved(&r->bodies[i])->used;
    }
    return used >> REST_USED_BITS;
}

/* Returns true if sweeps ran out before the residual was reached, or a body outgrew its bits. */
static bool sweeps(struct rest *r, const struct rest_sweep *sw, bool may_hurry)
{
    uint32_t n = r->count;
    bool joints = rest_has_joints(r);
    /*
     * A few contacts settle as fast without momentum. From no impulses on, each sweep without it
     * takes energy away, wherever the sweeps end: so the energy rule has its plastic solution.
     */
    bool hurries = may_hurry && !sw->calm && (n > REST_UNHURRIED || joints);
    const int32_t quiet = sw->calm ? 0 : sw->residual / REST_DEAD_DIVISOR;
    int rounds = most_rounds(r, sw), sums = sw->exact ? REST_EXACT_SUMS : 0;
    bool ran_out = true;
    int age = 0;

    for (int round = 0; round < rounds; round++) {
        int64_t moved = 0;

        r->sweeps++;
        for (uint32_t i = 0; i < n; i++) {
            struct contact *c = rest_contact(r, i);
            int64_t m = visit(c, quiet);

            moved = m > moved ? m : moved;
            if (c->work->rolls) {
                m = rest_roll_sweep(r, i, sw->residual);
                moved = m > moved ? m : moved;
            }
        }
        if (joints) {
            int64_t m = r->joints.calls->sweep(r, quiet);

            moved = m > moved ? m : moved;
        }
        ran_out = moved > sw->residual;
        if (outgrown(r) || (!ran_out && (sums == 0 || !rest_sum_up(r)))) {
            break;
        }
        sums -= !ran_out;
        if (hurries && round < rounds - 1) {
            rest_accelerate(r, &age);
        }
    }
    into_cones(r);
    return ran_out;
}

/* Forget impulses that led nowhere. */
static void drop(struct rest *r)
{
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);

        c->work->normal_impulse = 0;
        for (int k = 0; k < 3; k++) {
            c->work->tangent_impulse[k] = 0;
            if (c->work->rolls) {
                contact_rolling(c)->moment[k] = 0;
            }
        }
    }
    if (rest_has_joints(r)) {
        r->joints.calls->drop(r);
    }
}

/*
 * If velocities outgrow their unit sweep on in a larger one. With friction and momentum they may
 * grow without end: so after REST_OUTGREW_HURRIED times sweep without momentum and from no impulses, and
 * at last give up.
 */
void rest_solve_sweeps(struct rest *r, struct rest_sweep *sw, bool warm)
{
    rest_choose_unit(r, sw);
    rest_begin_sweeps(r, sw);
    if (warm) {
        rest_load_warm(r, sw);
        if (rest_has_joints(r)) {
            r->joints.calls->load_warm(r, sw);
        }
    }
    for (int outgrew = 0; outgrew < REST_OUTGREW_MAX; outgrew++) {
        while (!rest_sum_up(r)) {
            rest_enlarge_unit(r, sw);
        }
        r->roll_count = 0;
        for (uint32_t i = 0; i < r->count; i++) {
            rest_contact(r, i)->work->rolls = sw->rolls && rest_roll_prepare(r, i, sw);
        }
        sw->ran_out = sweeps(r, sw, outgrew < REST_OUTGREW_HURRIED);
        if (!outgrown(r)) {
            break;
        }
        rest_enlarge_unit(r, sw);
        if (outgrew + 1 >= REST_OUTGREW_HURRIED) {
            drop(r);
        }
    }
    rest_end_sweeps(r, sw);
}
