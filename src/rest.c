/* SPDX-License-Identifier: MIT */
#include "rest_parts.h"

/* Overlap of the skins is closed by a fifth a frame. */
#define RECOVERY_DIVISOR 5
/* The shortest time in which a gap may be closed, 1/170 of a frame: bounds the wanted velocity. */
#define CLOSING_TIME_MIN_Q30 (CAROM_ONE_Q30 / 170)

int32_t rest_restitution(const struct body *a, const struct body *b)
{
    return a->restitution_q30 < b->restitution_q30 ? a->restitution_q30 : b->restitution_q30;
}

uint32_t rest_friction(const struct body *a, const struct body *b)
{
    return a->friction_q16 < b->friction_q16 ? a->friction_q16 : b->friction_q16;
}

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

/* Velocities of the bodies that have contacts, each once. */
static void load_velocities(struct rest *r)
{
    for (uint32_t i = 0; i < r->body_count; i++) {
        r->bodies[i].solving = false;
    }
    for (uint32_t i = 0; i < r->list.pool->used; i++) {
        struct contact *c = &r->list.contacts[i];

        for (int s = 0; s < 2; s++) {
            struct body *b = c->side[s].body;

            if (b && !b->solving) {
                b->solving = true;
                body_velocity(b, rest_state(r, c, s), &b->velocity);
                body_spin(b, rest_state(r, c, s), &b->path.start.r, &b->spin);
            }
        }
    }
}

/* The wanted normal velocity after the solve. */
static void prepare_target(const struct rest *r, struct contact *c, int32_t tau_q30)
{
    const struct body *a = rest_body(r, c, 0), *b = rest_body(r, c, 1);
    int32_t e_q30 = rest_restitution(a, b);
    int64_t open_q22 = (int64_t)c->gap_q22 - c->skin_q22;
    int64_t slow_q40 = e_q30 == CAROM_ONE_Q30 ? 0 : r->slow_q40;

    c->impact = c->velocity_q40[0] < -slow_q40;
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

void rest_apply(struct rest *r)
{
    for (uint32_t i = 0; i < r->list.pool->used; i++) {
        const struct contact *c = &r->list.contacts[i];
        const int64_t *p = c->impulse_q40.c;

        for (int s = 0; s < 2; s++) {
            struct body_state *state = rest_state(r, c, s);
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
    in.friction_q16 = rest_friction(rest_body(r, c, 0), rest_body(r, c, 1));
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
            c->velocity_q40[d] = rest_along_q40(&v, &c->direction[d]);
        }
        rest_prepare_masses(c);
        prepare_target(r, c, tau_q30);
        any |= c->impact;
        r->impacts += c->impact;
    }
    return any;
}

/* What resting contacts may add to twice the energy of the bodies at hand. */
static struct fix_wide lift2(const struct rest *r)
{
    struct fix_wide sum = {0, 0};

    for (uint32_t i = 0; i < r->body_count; i++) {
        if (r->bodies[i].solving) {
            sum = fix_wide_add(sum, body_lift2(&r->bodies[i], r->gravity));
        }
    }
    return sum;
}

int rest_solve(struct rest *r, int32_t tau_q30, bool warm)
{
    struct rest_sweep sw = {0, false, false, REST_RESIDUAL_REST};
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
            rest_apply(r);
        }
        return result;
    }
    if (impacts) {
        sw.residual = REST_RESIDUAL_IMPACT;
    }
    before = rest_energy_before(r);
    rest_solve_sweeps(r, &sw, warm);
    rest_apply(r);
    rest_energy_rule(r, impacts ? before : fix_wide_add(before, lift2(r)));
    if (warm) {
        rest_store_warm(r);
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
        if (rest_restitution(rest_body(r, c, 0), rest_body(r, c, 1)) == CAROM_ONE_Q30 ||
            carom_abs(rest_along_q40(&v, &c->direction[0])) >= r->slow_q40) {
            continue;
        }
        for (int s = 0; s < 2; s++) {
            struct body *b = c->side[s].body;
            struct body_state *state = rest_state(r, c, s);

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
