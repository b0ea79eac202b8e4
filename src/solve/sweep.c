/* SPDX-License-Identifier: MIT */
/* Sweeps over accumulated, clamped impulses, with momentum. */
#include "rows.h"
#include "parts.h"

/* Sweeps follow a slip of 13 V*. */
#define SLIP_MAX ((int64_t)13 << REST_BITS)
/* A slip is not cut when each part of it is below this, a power of 2. */
#define SLIP_SURE ((int64_t)4 << REST_BITS)
/* Velocities or impulses that outgrow their bits begin again with a unit so many bits larger. */
#define LARGER_BITS 4

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
    int64_t largest = 1, loose;

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
    loose = sw->loose_q40 >> (sw->unit > 0 ? sw->unit : 0);
    if (loose > sw->residual) {
        sw->residual = rest_within(loose, 1 << REST_BITS);
    }
}

/* A velocity to solver units, of 2^-4 to 2^41 */
static inline int64_t in_units(int64_t v_q40, int unit)
{
    return unit > 0 ? carom_round(v_q40, unit) : carom_shl(v_q40, -unit);
}

/* Velocities to solver units; no impulses yet. */
static void begin_contact(struct contact *c, const struct rest_sweep *sw)
{
    int64_t wanted = wanted_q40(c, sw), slip[3];
    int32_t error = (int32_t)in_units(c->speed_q40 - wanted, sw->unit); /* within V* */

    for (int k = 0; k < 3; k++) {
        int64_t along = fix_mul(c->speed_q40, c->normal.c[k], 30);

        slip[k] = in_units(contact_velocity(c)->c[k] - along, sw->unit);
    }
    if ((carom_abs(slip[0]) | carom_abs(slip[1]) | carom_abs(slip[2])) >= SLIP_SURE) {
        rest_cut(slip, SLIP_MAX);
    }
    PHASE_BEGIN(c->phase, CONTACT_GAIN);
    for (int k = 0; k < 3; k++) {
        c->work->before[k] = (int32_t)slip[k] + carom_mul_q30(error, c->normal.c[k]);
        c->work->tangent_impulse[k] = 0;
        c->gain[k] = c->way[k] = 0;
    }
    c->work->band = rest_clamp(in_units(carom_shl(c->work->band_q30, 10), sw->unit));
    c->work->normal_impulse = 0;
}

static void begin(struct rest *r, const struct rest_sweep *sw)
{
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);

        c->work->friction_q16 =
            sw->frictionless ? 0 : rest_friction(rest_body(r, c, 0), rest_body(r, c, 1));
        begin_contact(c, sw);
    }
}

/* Take up a unit that is larger by LARGER_BITS. */
static void enlarge(struct rest *r, struct rest_sweep *sw)
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
}

/* What a body gets of the impulse of a contact that a solve begins with; 1 for a, -1 for b. */
static void add_wide(const struct contact *c, int s, const int64_t impulse[3])
{
    const struct contact_lever *lever = &c->work->lever[s];
    struct body *b = c->side[s].body;
    struct body_path *in = body_solve(b);
    const int shift = rest_turn_shift(b, c->work->fine_bits);
    int64_t own[3];

    for (int k = 0; k < 3; k++) {
        own[k] = s == 0 ? impulse[k] : -impulse[k];
        own[k] = lever->share_q30 == CAROM_ONE_Q30 ? own[k] : fix_mul_q30(own[k], lever->share_q30);
        in->wide_dv[k] += own[k] >> (c->work->fine_bits - REST_FINER_BITS);
    }
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

/* Sums of several bodies' weights on a light one may be long, though what is left of them is short. */
static bool narrow(struct body *b)
{
    struct body_path *in = body_solve(b);
    const int64_t most = (int64_t)1 << REST_USED_BITS;
    int64_t all[6];
    bool fits = true;

    memcpy(all, in->wide_dv, sizeof in->wide_dv);
    memcpy(all + 3, in->wide_du, sizeof in->wide_du);
    for (int k = 0; k < 3; k++) {
        fits = fits && carom_abs(all[k]) < most && carom_abs(all[3 + k]) < most;
        in->dv[k] = in->last_dv[k] = (int32_t)all[k];
        in->du[k] = in->last_du[k] = (int32_t)all[3 + k];
    }
    in->used = 0;
    return fits;
}

/* What the impulses so far change velocities by. Returns whether that fits. */
static bool sum_up(struct rest *r)
{
    bool fits = true;

    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].next_in_island) {
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
        for (int k = 0; k < 3; k++) {
            impulse[k] = fix_mul_q30(in->normal_impulse, c->normal.c[k]) + in->tangent_impulse[k];
        }
        for (int s = 0; s < 2; s++) {
            if (c->side[s].body) {
                add_wide(c, s, impulse);
            }
        }
    }
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].next_in_island) {
        fits = narrow(&r->bodies[i]) && fits;
    }
    return fits;
}

/* 2^32 times what du makes of a place's velocity, modulo 2^64: what is too large begins anew. */
static inline uint64_t turned(const int32_t turn[3], const int32_t du[3])
{
    return (uint64_t)((int64_t)turn[0] * du[0]) + (uint64_t)((int64_t)turn[1] * du[1]) +
           (uint64_t)((int64_t)turn[2] * du[2]);
}

/* V - wanted N by now. */
static void present_velocity(const struct contact *c, int32_t v[3])
{
    const struct body *a = c->side[0].body, *b = c->side[1].body;
    const int32_t *before = c->work->before;
    uint64_t turn[3] = {(uint64_t)1 << 31, (uint64_t)1 << 31, (uint64_t)1 << 31};
    int32_t way[3] = {1 << (REST_FINER_BITS - 1), 1 << (REST_FINER_BITS - 1),
                      1 << (REST_FINER_BITS - 1)};

    if (a) {
        const struct body_path *in = body_solved(a);
        const struct contact_lever *lever = &c->work->lever[0];

        turn[0] += turned(lever->turn[0], in->du);
        turn[1] += turned(lever->turn[1], in->du);
        turn[2] += turned(lever->turn[2], in->du);
        way[0] += in->dv[0];
        way[1] += in->dv[1];
        way[2] += in->dv[2];
    }
    if (b) {
        const struct body_path *in = body_solved(b);
        const struct contact_lever *lever = &c->work->lever[1];

        turn[0] -= turned(lever->turn[0], in->du);
        turn[1] -= turned(lever->turn[1], in->du);
        turn[2] -= turned(lever->turn[2], in->du);
        way[0] -= in->dv[0];
        way[1] -= in->dv[1];
        way[2] -= in->dv[2];
    }
    v[0] = before[0] + (way[0] >> REST_FINER_BITS) + (int32_t)((int64_t)turn[0] >> 32);
    v[1] = before[1] + (way[1] >> REST_FINER_BITS) + (int32_t)((int64_t)turn[1] >> 32);
    v[2] = before[2] + (way[2] >> REST_FINER_BITS) + (int32_t)((int64_t)turn[2] >> 32);
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

/* A change of impulse, each part below 2^30: along N, across it, and both. */
struct gain {
    int32_t along, across[3], whole[3];
};

static inline void across(struct gain *g, const int32_t n[3])
{
    g->across[0] = g->whole[0] - carom_mul_q30(g->along, n[0]);
    g->across[1] = g->whole[1] - carom_mul_q30(g->along, n[1]);
    g->across[2] = g->whole[2] - carom_mul_q30(g->along, n[2]);
}

/* Whether an impulse is within the friction cone; mu is at most 4. */
static bool in_cone(const struct contact *c, int64_t normal, const int64_t tangent[3])
{
    int64_t all[4] = {tangent[0], tangent[1], tangent[2], normal}, limit;
    int32_t across[3];

    if (rest_used(all) >> 29) {
        rest_shrink(all, 29);
    }
    across[0] = (int32_t)all[0];
    across[1] = (int32_t)all[1];
    across[2] = (int32_t)all[2];
    limit = (all[3] * (int32_t)c->work->friction_q16) >> 16;
    return rest_square32(across) <= (uint64_t)(limit * limit);
}

/*
 * What ends all motion of the contact; false when that lies outside of the friction cone. Large
 * velocities are shifted down: the next visit finds what is left over. As K is at least 1 the change
 * is then below 2^30.
 */
static bool stick(const struct contact *c, const int32_t v[3], struct gain *g)
{
    const int32_t *m = contact_inverse(c), *n = c->normal.c;
    const struct contact_work *in = c->work;
    int up = 30 - in->fine_bits;
    int down = fix_bits32((uint32_t)((v[0] ^ (v[0] >> 31)) | (v[1] ^ (v[1] >> 31)) |
                                     (v[2] ^ (v[2] >> 31)))) +
               in->fine_bits - 30;
    int32_t x, y, z;
    int64_t normal, tangent[3];

    down = down > 0 ? down : 0;
    x = v[0] >> down;
    y = v[1] >> down;
    z = v[2] >> down;
    g->whole[0] =
        -(int32_t)carom_round((int64_t)m[0] * x + (int64_t)m[3] * y + (int64_t)m[5] * z, up);
    g->whole[1] =
        -(int32_t)carom_round((int64_t)m[3] * x + (int64_t)m[1] * y + (int64_t)m[4] * z, up);
    g->whole[2] =
        -(int32_t)carom_round((int64_t)m[5] * x + (int64_t)m[4] * y + (int64_t)m[2] * z, up);
    g->along = (int32_t)carom_round(carom_dot(n, g->whole), 30);
    normal = in->normal_impulse + carom_shl(g->along, down);
    if (normal <= 0) {
        return false;
    }
    across(g, n);
    tangent[0] = in->tangent_impulse[0] + carom_shl(g->across[0], down);
    tangent[1] = in->tangent_impulse[1] + carom_shl(g->across[1], down);
    tangent[2] = in->tangent_impulse[2] + carom_shl(g->across[2], down);
    return in_cone(c, normal, tangent);
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
    const struct contact_work *in = c->work;
    const int down = 30 - in->fine_bits;
    int64_t change[4] = {0, 0, 0, carom_round((int64_t)dvn * in->step[0], down)};
    bool limited = true;

    if (change[3] <= -in->normal_impulse) {
        change[3] = -in->normal_impulse;
    } else {
        for (int k = 0; k < 3; k++) {
            int32_t after = rest_clamp(slip[k] + (((int64_t)in->drag_q28[k] * dvn) >> 28));

            change[k] = in->tangent_impulse[k] - (((int64_t)after * in->step[1]) >> down);
        }
        limited = rest_cut(change, friction_limit(c, in->normal_impulse + change[3]));
    }
    for (int k = 0; k < 3; k++) {
        change[k] -= in->tangent_impulse[k];
    }
    /* if that is too large for one push a part of all of it: from one place in the cone to another */
    if (rest_used(change) >> 29) {
        rest_shrink(change, 29);
    }
    g->along = (int32_t)change[3];
    for (int k = 0; k < 3; k++) {
        g->across[k] = (int32_t)change[k];
        g->whole[k] = (int32_t)change[k] + carom_mul_q30(g->along, c->normal.c[k]);
    }
    return limited;
}

/* Along N first; then across towards no slip, within the friction cone. */
static void slide(struct contact *c, int32_t error, const int32_t v[3], struct gain *g)
{
    int64_t pushed[3];
    int32_t slip[3];

    if (!c->work->slides) {
        rest_prepare_slide(c);
    }
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

/* Take up a change; returns its largest component, the last place apart. */
static int32_t add(struct contact *c, const struct gain *g)
{
    struct contact_work *in = c->work;
    int32_t *gain = contact_gain(c)->gain, most;

    in->normal_impulse += g->along;
    in->tangent_impulse[0] += g->across[0];
    in->tangent_impulse[1] += g->across[1];
    in->tangent_impulse[2] += g->across[2];
    /* a contact by itself, of which nobody asks, may wrap */
    gain[0] = (int32_t)((uint32_t)gain[0] + (uint32_t)g->whole[0]);
    gain[1] = (int32_t)((uint32_t)gain[1] + (uint32_t)g->whole[1]);
    gain[2] = (int32_t)((uint32_t)gain[2] + (uint32_t)g->whole[2]);
    rest_push(c, g->whole);
    most = fix_largest(g->whole);
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

/* The last sweep and the step beyond the one before it, together, stay below this. */
#define WAY_MAX (CAROM_ONE_Q30 / 2)

/* Whether the last sweep went on in the way that the last step beyond a sweep had gone. */
static bool agrees(const struct rest *r)
{
    int64_t sum = 0;

    for (uint32_t i = 0; i < r->count; i++) {
        const struct contact *c = contact_gain(rest_contact(r, i));
        int64_t x = (int64_t)c->gain[0] + c->way[0], y = (int64_t)c->gain[1] + c->way[1],
                z = (int64_t)c->gain[2] + c->way[2];

        if (x > WAY_MAX || x < -WAY_MAX || y > WAY_MAX || y < -WAY_MAX || z > WAY_MAX ||
            z < -WAY_MAX) {
            return false;
        }
        /* up to 2^48, of at most 4096 contacts */
        sum += (c->gain[0] * x >> 13) + (c->gain[1] * y >> 13) + (c->gain[2] * z >> 13);
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

/* Bodies go beyond as their contacts do: velocities are linear in impulses. */
static void bodies_beyond(struct rest *r, int32_t part_q30)
{
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].next_in_island) {
        struct body_path *in = body_solve(&r->bodies[i]);

        for (int k = 0; k < 3; k++) {
            in->used |= go_on(&in->dv[k], &in->last_dv[k], part_q30) |
                        go_on(&in->du[k], &in->last_du[k], part_q30);
        }
    }
}

/* Where a contact would pull it has no impulse. */
static void let_go(struct contact *c)
{
    struct gain g;

    g.along = rest_within(-c->work->normal_impulse, WAY_MAX);
    for (int k = 0; k < 3; k++) {
        g.across[k] = rest_within(-c->work->tangent_impulse[k], WAY_MAX);
        g.whole[k] = g.across[k] + carom_mul_q30(g.along, c->normal.c[k]);
        c->way[k] += g.whole[k];
    }
    add(c, &g);
    c->gain[0] = c->gain[1] = c->gain[2] = 0;
}

/* Go beyond the last sweep by a part of the way it came. */
static void go_beyond(struct contact *c, int32_t part_q30)
{
    struct contact_work *in = c->work;
    struct gain g;

    for (int k = 0; k < 3; k++) {
        g.whole[k] = carom_mul_q30(c->way[k] + c->gain[k], part_q30);
        c->way[k] = g.whole[k];
        c->gain[k] = 0;
    }
    g.along = (int32_t)carom_round(carom_dot(c->normal.c, g.whole), 30);
    across(&g, c->normal.c);
    in->normal_impulse += g.along;
    in->tangent_impulse[0] += g.across[0];
    in->tangent_impulse[1] += g.across[1];
    in->tangent_impulse[2] += g.across[2];
    if (in->normal_impulse < 0) {
        let_go(c);
    }
}

/* Begin the steps beyond sweeps anew. */
static void stay(struct contact *c)
{
    for (int k = 0; k < 3; k++) {
        c->way[k] = c->gain[k] = 0;
    }
}

/*
 * Nesterov's momentum: after each sweep go on beyond it, the farther the longer the sweeps agree. That takes
 * the root of the number of sweeps. When they turn back it begins anew. `age` counts the sweeps that agree.
 */
static void accelerate(struct rest *r, int *age)
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
}

/* The last visit of a contact may not have gone all its way, or found it as good as at rest out there. */
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

static int most_rounds(const struct rest *r, const struct rest_sweep *sw)
{
    int rounds = sw->plastic || r->count <= REST_UNHURRIED ? REST_SWEEPS_PLASTIC
                 : !sw->rolls                              ? REST_SWEEPS_MAX
                 : r->count <= REST_FEW                    ? REST_SWEEPS_FEW
                                                           : REST_SWEEPS_MANY;

    return r->sweep_cap > 0 && r->sweep_cap < rounds ? r->sweep_cap : rounds;
}

/* Whether a body's velocities have outgrown their bits. */
static bool outgrown(const struct rest *r)
{
    uint32_t used = 0;

    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].next_in_island) {
        used |= body_solved(&r->bodies[i])->used;
    }
    return used >> REST_USED_BITS;
}

/* Returns whether they ran out before the residual was reached, or a body has outgrown its bits. */
static bool sweeps(struct rest *r, const struct rest_sweep *sw)
{
    uint32_t n = r->count;
    /*
     * Up to three contacts settle as soon without momentum. From no impulses on, sweeps without it take
     * energy away one by one, wherever they end: so the rule about energy has its plastic solution.
     */
    bool hurries = !sw->plastic && n > REST_UNHURRIED;
    int rounds = most_rounds(r, sw);
    bool ran_out = true;
    int age = 0;

    for (int round = 0; round < rounds; round++) {
        int64_t moved = 0;

        r->sweeps++;
        for (uint32_t i = 0; i < n; i++) {
            int64_t m = visit(rest_contact(r, i), sw->rolls ? sw->residual / DEAD_DIVISOR : 0);

            moved = m > moved ? m : moved;
            if (rest_contact(r, i)->work->rolls) {
                m = rest_roll_sweep(r, i, sw->residual);
                moved = m > moved ? m : moved;
            }
        }
        ran_out = moved > sw->residual;
        if (!ran_out || outgrown(r)) {
            break;
        }
        if (hurries && round < rounds - 1) {
            accelerate(r, &age);
        }
    }
    into_cones(r);
    return ran_out;
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
            c->impulse_q40.c[k] = fix_mul(c->work->normal_impulse, c->normal.c[k], 22) +
                                  carom_shl(c->work->tangent_impulse[k], 8);
        }
        fix_mul_scaled3(c->impulse_q40.c, c->impulse_q40.c, unit);
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
    for (;;) {
        while (!sum_up(r)) {
            enlarge(r, sw);
        }
        for (uint32_t i = 0; i < r->count; i++) {
            rest_contact(r, i)->work->rolls = sw->rolls && rest_roll_prepare(r, i, sw);
        }
        sw->ran_out = sweeps(r, sw);
        if (!outgrown(r)) {
            break;
        }
        enlarge(r, sw);
    }
    finish(r, sw);
}
