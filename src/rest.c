/* SPDX-License-Identifier: MIT */
#include "rest.h"

/* Sweeps end when no velocity changes by more than this, in solver units of 2^-29 V*. */
#define RESIDUAL_IMPACT (1 << (REST_BITS - 26))
#define RESIDUAL_REST (1 << (REST_BITS - 16))
/* Overlap of the skins is closed by a fifth a frame. */
#define RECOVERY_DIVISOR 5
/* The shortest time in which a gap may be closed, 1/170 of a frame: bounds the wanted velocity. */
#define CLOSING_TIME_MIN_Q30 (CAROM_ONE_Q30 / 170)
#define QUIET_FRAMES 20

int32_t rest_restitution(const struct body *a, const struct body *b)
{
    return a->restitution_q30 < b->restitution_q30 ? a->restitution_q30 : b->restitution_q30;
}

uint32_t rest_friction(const struct body *a, const struct body *b)
{
    return a->friction_q16 < b->friction_q16 ? a->friction_q16 : b->friction_q16;
}

static struct body *pair_body(const struct rest *r, const struct contact *c, int side)
{
    const struct pair *p = &r->pairs[c->key.pair];

    return &r->bodies[side == 0 ? p->a : p->b];
}

static struct body_state *pair_state(const struct rest *r, const struct contact *c, int side)
{
    const struct pair *p = &r->pairs[c->key.pair];

    return &r->states[side == 0 ? p->a : p->b];
}

/* ----------------------------------------------------------------- prepare */

/* V = (v_a + w_a x r_a) - (v_b + w_b x r_b) */
static void relative_velocity(const struct contact *c, carom_v3_q40 *v)
{
    memset(v, 0, sizeof *v);
    for (int s = 0; s < 2; s++) {
        const struct body *b = c->side[s].body;
        const int32_t *arm = c->side[s].arm.c;

        for (int k = 0; b && k < 3; k++) {
            int i = (k + 1) % 3, j = (k + 2) % 3;
            int64_t at = b->velocity.c[k] + fix_mul(b->spin.c[i], arm[j], 22) -
                         fix_mul(b->spin.c[j], arm[i], 22);

            v->c[k] += s == 0 ? at : -at;
        }
    }
}

static int64_t along_q40(const carom_v3_q40 *v, const carom_v3_q30 *n)
{
    return fix_mul(v->c[0], n->c[0], 30) + fix_mul(v->c[1], n->c[1], 30) +
           fix_mul(v->c[2], n->c[2], 30);
}

static void load_velocities(struct rest *r)
{
    for (uint32_t i = 0; i < r->list.pool->used; i++) {
        struct contact *c = &r->list.contacts[i];

        for (int s = 0; s < 2; s++) {
            struct body *b = c->side[s].body;

            if (b) {
                body_velocity(b, pair_state(r, c, s), &b->velocity);
                body_spin(b, pair_state(r, c, s), &b->path.start.r, &b->spin);
            }
        }
    }
}

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
            sum += carom_round((int64_t)side->turn[2][k] * side->lever_q30[1][k],
                               side->turn_bits[2]);
        }
    }
    return sum;
}

/* Masses that the contact's impulses move: K along each direction, and the steps of a sweep. */
static void prepare_masses(struct contact *c)
{
    struct contact_side *a = &c->side[0], *b = &c->side[1];
    struct fix_scaled unit;
    int64_t half_difference, coupling, tangent;

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
    half_difference = (c->mass_q30[1] - c->mass_q30[2]) / 2;
    coupling = tangent_coupling_q30(c);
    half_difference >>= 4; /* 30 + 10 bits at most: squares fit */
    coupling >>= 4;
    tangent = (c->mass_q30[1] + c->mass_q30[2]) / 2 +
              ((int64_t)fix_sqrt((uint64_t)(half_difference * half_difference) +
                                 (uint64_t)(coupling * coupling)) << 4);
    /* K is at least 1: the lighter body alone gives that */
    c->step_q30[0] = (int32_t)(((int64_t)1 << 60) / c->mass_q30[0]);
    c->step_q30[1] = (int32_t)(((int64_t)1 << 60) / tangent);
}

/* The wanted normal velocity after the solve. */
static void prepare_target(const struct rest *r, struct contact *c, int32_t tau_q30)
{
    const struct body *a = pair_body(r, c, 0), *b = pair_body(r, c, 1);
    int32_t e_q30 = rest_restitution(a, b);
    int64_t open_q22 = (int64_t)c->gap_q22 - c->skin_q22;
    int64_t slow_q40 = e_q30 == CAROM_ONE_Q30 ? 0 : r->slow_q40;

    c->impact = c->velocity_q40[0] < -slow_q40 && e_q30 > 0;
    if (c->impact) {
        c->target_q40 = -fix_mul(c->velocity_q40[0], e_q30, 30);
    } else if (e_q30 == CAROM_ONE_Q30) {
        c->target_q40 = 0;
    } else if (open_q22 > 0) {
        /* may come nearer until the skins touch; q22 to q40 over the time */
        int32_t time_q30 = tau_q30 > CLOSING_TIME_MIN_Q30 ? tau_q30 : CLOSING_TIME_MIN_Q30;

        c->target_q40 = tau_q30 > 0 ? -(open_q22 << 40) / (time_q30 >> 8) : 0;
    } else {
        c->target_q40 = (-open_q22 << 18) / RECOVERY_DIVISOR;
    }
}

/* ------------------------------------------------------------------ sweeps */

struct sweep {
    int unit;            /* a solver unit of velocity is 2^unit of q40 */
    bool plastic;        /* impacts end at 0: the frictionless solution of the energy rule */
    bool frictionless;
    int32_t residual;
};

static int64_t to_units(int64_t v_q40, int unit)
{
    return unit > 0 ? carom_round(v_q40, unit) : carom_shl(v_q40, -unit);
}

static int64_t wanted_q40(const struct contact *c, const struct sweep *sw)
{
    return sw->plastic && c->impact ? 0 : c->target_q40;
}

static void choose_unit(const struct rest *r, struct sweep *sw)
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
 * Change of the relative velocity along direction d so far. A thin body's spin may fill 40 bits while
 * the sum stays small, so products wrap: modulo 2^64 the sum is right.
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
static int64_t sweep_normal(struct contact *c, const struct sweep *sw)
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
static int64_t sweep_tangents(struct contact *c, const struct sweep *sw, uint32_t mu_q16)
{
    int64_t limit = ((int64_t)mu_q16 * c->impulse[0]) >> 16;
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
        change = clamp_impulse(next[d]) - c->impulse[1 + d];
        c->impulse[1 + d] += (int32_t)change;
        push(c, 1 + d, change);
        moved += effect(clamp_impulse(change), c->mass_q30[1 + d]);
    }
    return moved;
}

static void sweeps(struct rest *r, const struct sweep *sw)
{
    uint32_t n = r->list.pool->used;

    for (int round = 0; round < REST_SWEEPS_MAX; round++) {
        int64_t moved = 0;

        r->sweeps++;
        for (uint32_t i = 0; i < n; i++) {
            /* forwards and backwards in turn, so that no end of a stack is favoured */
            struct contact *c = &r->list.contacts[round & 1 ? n - 1 - i : i];
            uint32_t mu_q16 = rest_friction(pair_body(r, c, 0), pair_body(r, c, 1));
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
    const struct body *a = pair_body(r, c, 0);
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
static void load_warm(struct rest *r, const struct sweep *sw)
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
        j_q40[1] = along_q40(&w->tangent_q40, &c->direction[1]);
        j_q40[2] = along_q40(&w->tangent_q40, &c->direction[2]);
        for (int d = 0; d < 3; d++) {
            int64_t j = fix_mul_scaled(j_q40[d] / 32 * 29, inverse);

            c->impulse[d] = (int32_t)clamp_impulse(j);
            push(c, d, c->impulse[d]);
        }
        w->normal_q40 = 0; /* used */
    }
}

static void store_warm(struct rest *r)
{
    r->warm_count = r->list.pool->used;
    for (uint32_t i = 0; i < r->warm_count; i++) {
        const struct contact *c = &r->list.contacts[i];
        struct rest_warm *w = &r->warm[i];

        memset(w, 0, sizeof *w);
        w->a = r->pairs[c->key.pair].a;
        w->b = r->pairs[c->key.pair].b;
        w->normal = c->direction[0];
        carom_rotate_back(w->arm.c, &pair_body(r, c, 0)->path.start.r, c->side[0].arm.c);
        w->normal_q40 = along_q40(&c->impulse_q40, &c->direction[0]);
        for (int k = 0; k < 3; k++) {
            w->tangent_q40.c[k] = c->impulse_q40.c[k] - fix_mul(w->normal_q40, w->normal.c[k], 30);
        }
    }
}

/* ------------------------------------------------------------------- apply */

/* Impulses in solver units to momentum, one rounding a component. */
static void impulses_from_units(struct rest *r, const struct sweep *sw)
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

/* p += P, L += r x P on a, the same P against b. */
static void apply(struct rest *r)
{
    for (uint32_t i = 0; i < r->list.pool->used; i++) {
        const struct contact *c = &r->list.contacts[i];
        const int64_t *p = c->impulse_q40.c;

        for (int s = 0; s < 2; s++) {
            struct body_state *state = pair_state(r, c, s);
            const int32_t *arm = c->side[s].arm.c;

            for (int k = 0; c->side[s].body && k < 3; k++) {
                int m = (k + 1) % 3, n = (k + 2) % 3;
                int64_t moment = fix_mul(p[n], arm[m], 22) - fix_mul(p[m], arm[n], 22);

                state->momentum.c[k] += s == 0 ? p[k] : -p[k];
                state->angular.c[k] += s == 0 ? moment : -moment;
            }
        }
    }
}

/* ------------------------------------------------------------- energy rule */

/* Do something once for each moving body of the contacts. */
static struct fix_wide each_body(struct rest *r, struct fix_wide (*f)(struct body *,
                                                                      struct body_state *, int32_t),
                                 int32_t argument)
{
    struct fix_wide sum = {0, 0};

    for (uint32_t i = 0; i < r->list.pool->used; i++) {
        for (int s = 0; s < 2; s++) {
            struct body *b = r->list.contacts[i].side[s].body;
            bool seen = false;

            for (uint32_t j = 0; j <= i && b; j++) {
                const struct contact *earlier = &r->list.contacts[j];

                seen |= (j < i && (earlier->side[0].body == b || earlier->side[1].body == b)) ||
                        (j == i && s == 1 && earlier->side[0].body == b);
            }
            if (b && !seen) {
                sum = fix_wide_add(sum, f(b, pair_state(r, &r->list.contacts[i], s), argument));
            }
        }
    }
    return sum;
}

static struct fix_wide kinetic(struct body *b, struct body_state *s, int32_t unused)
{
    (void)unused;
    return body_kinetic2(b, s, &b->path.start.r);
}

static struct fix_wide save(struct body *b, struct body_state *s, int32_t slot)
{
    struct fix_wide none = {0, 0};

    b->saved[slot][0] = s->momentum;
    b->saved[slot][1] = s->angular;
    return none;
}

static struct fix_wide restore(struct body *b, struct body_state *s, int32_t slot)
{
    struct fix_wide none = {0, 0};

    s->momentum = b->saved[slot][0];
    s->angular = b->saved[slot][1];
    return none;
}

/* Momenta at slot 0 + k (slot 1 - slot 0). */
static struct fix_wide blend(struct body *b, struct body_state *s, int32_t k_q30)
{
    struct fix_wide none = {0, 0};

    for (int k = 0; k < 3; k++) {
        const carom_v3_q40 *p0 = b->saved[0], *p1 = b->saved[1];

        s->momentum.c[k] = p0[0].c[k] + fix_mul(p1[0].c[k] - p0[0].c[k], k_q30, 30);
        s->angular.c[k] = p0[1].c[k] + fix_mul(p1[1].c[k] - p0[1].c[k], k_q30, 30);
    }
    return none;
}

static bool rises(struct fix_wide from, struct fix_wide to)
{
    /* momenta are rounded: a rise below 2^-26 of the energy is not one */
    struct fix_wide slack = {from.hi >> 26, (uint64_t)fix_wide_shift(from, 26)};

    return fix_wide_sign(fix_wide_add(to, fix_wide_neg(fix_wide_add(from, slack)))) > 0;
}

static void solve_sweeps(struct rest *r, struct sweep *sw, bool warm)
{
    choose_unit(r, sw);
    clear_changes(r);
    if (warm) {
        load_warm(r, sw);
    }
    sweeps(r, sw);
    impulses_from_units(r, sw);
}

/*
 * Several contacts with an impact among them raised the energy: go from the frictionless plastic
 * solution, which cannot, as far towards the wanted one as the energy before allows.
 */
static void limit_energy(struct rest *r, struct fix_wide before)
{
    struct sweep sw = {0, true, true, RESIDUAL_IMPACT};
    int32_t low = 0, high = CAROM_ONE_Q30;

    r->energy_rules++;
    /* slot 0 holds the momenta before, the states the wanted ones */
    each_body(r, save, 1);
    each_body(r, restore, 0);
    solve_sweeps(r, &sw, false);
    apply(r);
    each_body(r, save, 0);
    while (high - low > 1) {
        int32_t k = low + (high - low) / 2;

        each_body(r, blend, k);
        if (rises(before, each_body(r, kinetic, 0))) {
            high = k;
        } else {
            low = k;
        }
    }
    each_body(r, blend, low);
}

/* ------------------------------------------------------------------- solve */

static void impact_side(const struct contact_side *from, struct impact_side *to)
{
    memset(to, 0, sizeof *to);
    if (from->body) {
        to->moving = true;
        to->mass = from->body->mass;
        to->arm = from->arm;
        body_world_inertia(from->body, &from->body->path.start.r, &to->inertia);
    }
}

/* The paper's case: one impact between two bodies. */
static int solve_impact(struct rest *r, struct contact *c)
{
    struct impact in;
    struct impact_result out;
    int result;

    memset(&in, 0, sizeof in);
    impact_side(&c->side[0], &in.a);
    impact_side(&c->side[1], &in.b);
    in.normal = c->direction[0];
    relative_velocity(c, &in.velocity);
    in.target_q40 = c->target_q40;
    in.friction_q16 = rest_friction(pair_body(r, c, 0), pair_body(r, c, 1));
    result = impact_solve(&r->gauss, &in, &out);
    if (result == CAROM_OK) {
        c->impulse_q40 = out.impulse;
        r->energy_rules += out.energy_rule;
    }
    return result;
}

/* Whether any contact is an impact; also fills in what the solvers need of each. */
static bool prepare(struct rest *r, int32_t tau_q30)
{
    bool any = false;

    load_velocities(r);
    for (uint32_t i = 0; i < r->list.pool->used; i++) {
        struct contact *c = &r->list.contacts[i];
        carom_v3_q40 v;

        relative_velocity(c, &v);
        for (int d = 0; d < 3; d++) {
            c->velocity_q40[d] = along_q40(&v, &c->direction[d]);
        }
        prepare_masses(c);
        prepare_target(r, c, tau_q30);
        any |= c->impact;
        r->impacts += c->impact;
    }
    return any;
}

int rest_solve(struct rest *r, int32_t tau_q30, bool warm)
{
    struct sweep sw = {0, false, false, RESIDUAL_REST};
    struct fix_wide before;
    bool impacts;

    if (r->list.pool->used == 0) {
        if (warm) {
            r->warm_count = 0;
        }
        return CAROM_OK;
    }
    impacts = prepare(r, tau_q30);
    if (impacts && r->list.pool->used == 1) {
        int result = solve_impact(r, &r->list.contacts[0]);

        if (result == CAROM_OK) {
            apply(r);
        }
        return result;
    }
    if (impacts) {
        sw.residual = RESIDUAL_IMPACT;
    }
    before = each_body(r, kinetic, 0);
    each_body(r, save, 0);
    solve_sweeps(r, &sw, warm);
    apply(r);
    if (warm) {
        store_warm(r);
    }
    if (impacts && rises(before, each_body(r, kinetic, 0))) {
        limit_energy(r, before);
    }
    return CAROM_OK;
}

bool rest_enter_contact(struct rest *r, int32_t tau_q30)
{
    bool any = false;

    load_velocities(r);
    for (uint32_t i = 0; i < r->list.pool->used; i++) {
        struct contact *c = &r->list.contacts[i];
        carom_v3_q40 v;

        relative_velocity(c, &v);
        if (rest_restitution(pair_body(r, c, 0), pair_body(r, c, 1)) == CAROM_ONE_Q30 ||
            carom_abs(along_q40(&v, &c->direction[0])) >= r->slow_q40) {
            continue;
        }
        for (int s = 0; s < 2; s++) {
            struct body *b = c->side[s].body;
            struct body_state *state = pair_state(r, c, s);

            if (!b || b->in_contact) {
                continue;
            }
            b->in_contact = any = true;
            for (int k = 0; k < 3; k++) {
                state->momentum.c[k] +=
                    fix_mul_scaled(fix_mul(r->gravity->c[k], tau_q30, 30), b->mass);
            }
            body_velocity(b, state, &b->velocity);
        }
    }
    return any;
}

/* ------------------------------------------------------------------- sleep */

static bool is_quiet(const struct body *b, const struct body_state *s, int64_t limit_q40)
{
    carom_m3_q30 m;
    carom_v3_q40 v, w;

    body_matrix(&m, &s->rotation);
    body_velocity(b, s, &v);
    body_spin(b, s, &m, &w);
    return b->in_contact &&
           fix_length(v.c) + fix_mul(fix_length(w.c), b->radius_q22, 22) < limit_q40;
}

void rest_sleep(const struct body *bodies, struct body_state *states, uint32_t body_count,
                const struct pair *touching, uint32_t touching_count, const carom_v3_q40 *gravity)
{
    /* an eighth of what gravity gives in a frame: a body that falls is never that slow for long */
    int64_t limit_q40 = fix_length(gravity->c) / 8;
    bool again = true;

    for (uint32_t i = 0; i < body_count; i++) {
        if (!broad_active(&bodies[i], &states[i])) {
            continue;
        }
        if (!is_quiet(&bodies[i], &states[i], limit_q40)) {
            states[i].quiet = 0;
        } else if (states[i].quiet < QUIET_FRAMES) {
            states[i].quiet++;
        }
    }
    /* an island sleeps as a whole: one restless body keeps its neighbours awake */
    while (again) {
        again = false;
        for (uint32_t i = 0; i < touching_count; i++) {
            struct body_state *a = &states[touching[i].a], *b = &states[touching[i].b];

            if (bodies[touching[i].a].moving && bodies[touching[i].b].moving &&
                (a->quiet == QUIET_FRAMES) != (b->quiet == QUIET_FRAMES)) {
                a->quiet = b->quiet = QUIET_FRAMES - 1;
                again = true;
            }
        }
    }
    for (uint32_t i = 0; i < body_count; i++) {
        if (broad_active(&bodies[i], &states[i]) && states[i].quiet == QUIET_FRAMES) {
            states[i].asleep = 1;
            memset(&states[i].momentum, 0, sizeof states[i].momentum);
            memset(&states[i].angular, 0, sizeof states[i].angular);
        }
    }
}
