/* SPDX-License-Identifier: MIT */
/* Solve all islands of a list of contacts: rest_solve; rest_project and rest_enter_contact. */
#include "parts.h"

void rest_load_contacts(struct rest *r)
{
    if (r->loaded) {
        return;
    }
    r->loaded = true;
    for (uint32_t i = 0; i < r->body_count; i++) {
        struct body *b = &r->bodies[i];

        b->solve.solving = false;
        if (b->clock.contact == BODY_ENTERS) {
            b->clock.contact = BODY_LIES;
        }
    }
    for (uint32_t i = 0; i < r->list.pool->used; i++) {
        struct contact *c = &r->list.contacts[i];

        for (int s = 0; s < 2; s++) {
            struct body *b = c->idle ? NULL : c->side[s].body;

            if (b && !b->solve.solving) {
                b->solve.solving = true;
                body_velocity(b, rest_state(r, c, s), &b->solve.velocity);
                body_spin(b, rest_state(r, c, s), &b->path.start.r, &b->solve.spin);
            }
        }
    }
}

/*
 * Load velocities of all bodies to be solved, by contacts and by joints. They are stale after the
 * solve.
 */
static void load_velocities(struct rest *r)
{
    rest_load_contacts(r);
    r->loaded = false;
    if (r->joints.calls) {
        r->joints.calls->load_velocities(r);
    }
}

void rest_apply(struct rest *r)
{
    for (uint32_t i = 0; i < r->count; i++) {
        const struct contact *c = rest_contact(r, i);

        rest_apply_at(r, c, contact_impulse(c)->c, rest_moment(c)->c);
    }
    if (rest_has_joints(r)) {
        r->joints.calls->apply(r);
    }
}

static void impact_side(const struct contact_side *from, struct impact_side *to)
{
    memset(to, 0, sizeof *to);
    if (from->body) {
        to->moving = true;
        to->inverse_mass = from->body->def.inverse_mass;
        memcpy(to->arm.c, from->arm_q30, sizeof to->arm.c);
        to->arm.e = contact_arm_bits(from->body);
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
    in.normal = c->normal;
    in.velocity = *contact_velocity(c);
    in.target_q40 = c->work->target_q40;
    in.friction_q16 = rest_friction_at(r, c);
    c->work = NULL; /* elimination uses its room */
    result = impact_solve(r->gauss, &in, &out);
    if (result == CAROM_OK) {
        PHASE_BEGIN(c->phase, CONTACT_IMPULSE);
        c->impulse_q40 = out.impulse;
        r->energy_rules += out.energy_rule;
    }
    return result;
}

/* Set what impulses change, until every body's turn_bits suffice. */
static void prepare_masses(struct rest *r)
{
    bool fit;

    do {
        fit = true;
        for (uint32_t i = 0; i < r->count; i++) {
            fit = rest_prepare_masses(rest_contact(r, i)) && fit;
        }
        fit = (!rest_has_joints(r) || r->joints.calls->prepare(r)) && fit;
    } while (!fit);
}

/* Set everything that solvers need of the contacts. Returns true if any contact is an impact. */
static bool prepare(struct rest *r, int32_t tau_q30)
{
    bool any = false;

    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        rest_prepare_body(&r->bodies[i]);
    }
    for (uint32_t i = 0; i < r->count; i++) {
        struct contact *c = rest_contact(r, i);

        c->work = &r->works[r->first + i];
        c->work->roll = NULL;
        PHASE_BEGIN(c->phase, CONTACT_VELOCITY);
        rest_relative_velocity(c, &c->velocity_q40);
        rest_share_normal(r, i);
        c->speed_q40 = rest_along_q40(contact_velocity(c), &c->normal);
        rest_prepare_target(r, c, tau_q30);
        any |= c->impact;
        r->impacts += c->impact;
    }
    prepare_masses(r);
    return any;
}

/* True if the island has a lasting contact. */
static bool lasts(const struct rest *r)
{
    for (uint32_t i = 0; i < r->count; i++) {
        if (rest_contact(r, i)->lasting) {
            return true;
        }
    }
    return false;
}

static void note_unsettled(struct rest *r, bool unsettled)
{
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        r->bodies[i].solve.unsettled = unsettled;
    }
}

/*
 * The drift of a surface or kinematic body under the island, at one of its contacts; 0 if there is
 * none.
 */
static const carom_v3_q40 *island_drift(const struct rest *r)
{
    static const carom_v3_q40 none = {{0, 0, 0}};

    for (uint32_t i = 0; i < r->count; i++) {
        const struct contact *c = rest_contact(r, i);

        if (c->drift && rest_body(r, c, 1)->def.goes) {
            return c->drift;
        }
    }
    return &none;
}

/*
 * A change of velocity that counts as none if bodies move: many of them together move nothing by a
 * skin. 0 for an island that is all but still at the start of a frame, since it would creep by the
 * residual.
 */
static int64_t loose_q40(const struct rest *r, bool start)
{
    const carom_v3_q40 *drift = island_drift(r);
    int32_t skin_q22 = INT32_MAX;
    bool moves = !start;

    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        const struct body *b = &r->bodies[i];
        int64_t v[3];

        skin_q22 = b->def.skin_q22 < skin_q22 ? b->def.skin_q22 : skin_q22;
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            v[k] = b->solve.velocity.c[k] - drift->c[k] - (start ? b->def.acceleration.c[k] : 0);
        }
        moves |= fix_length_bound(v) +
                     fix_mul(fix_length_bound(b->solve.spin.c), b->def.radius_q22, 22) >
                 carom_shl(b->def.skin_q22, 18) * REST_MOVES_SKINS;
    }
    return moves ? carom_shl(skin_q22, 18) / REST_LOOSE_DIVISOR : 0;
}

/*
 * True if a lasting contact's gap is all but gone: an approach by the residual would close it in
 * some frames.
 */
static bool is_nearly_closed(const struct rest *r)
{
    for (uint32_t i = 0; i < r->count; i++) {
        const struct contact *c = rest_contact(r, i);

        if (c->lasting && c->gap_q22 < c->skin_q22 / STEP_CLOSED_DIVISOR) {
            return true;
        }
    }
    return false;
}

/* Solve the island at hand. */
static int solve_island(struct rest *r, int32_t tau_q30, bool warm)
{
    bool few = r->count <= REST_FEW || rest_up_to_two(r);
    struct rest_sweep sw = {.residual = few ? REST_RESIDUAL_REST_FEW : REST_RESIDUAL_REST,
                            .rolls = true};
    bool impacts = prepare(r, tau_q30), lasting = lasts(r);

    if (impacts && r->count == 1 && !lasting && !rest_has_joints(r)) {
        int result = solve_impact(r, rest_contact(r, 0));

        if (result == CAROM_OK) {
            rest_apply(r);
        }
        return result;
    }
    if (impacts) {
        sw.calm = sw.exact = rest_up_to_two(r);
        sw.residual = sw.exact ? REST_RESIDUAL_EXACT : REST_RESIDUAL_IMPACT;
        sw.rolls = false;
    }
    for (uint32_t i = 0; i < r->count; i++) {
        rest_contact(r, i)->resting = !impacts;
    }
    rest_save_momenta(r);
    sw.loose_q40 =
        few || impacts || rest_has_joints(r) || is_nearly_closed(r) ? 0 : loose_q40(r, warm);
    rest_solve_sweeps(r, &sw, warm);
    rest_apply(r);
    if (rest_has_joints(r)) { /* the end of the frame takes care of their energy */
        r->joints.calls->book(r);
        if (sw.ran_out && rest_approaches(r)) {
            r->joints.first = 0; /* nothing may cross, even if that pulls joints apart */
            rest_part(r);
        }
        note_unsettled(r, sw.ran_out && rest_approaches(r));
        return CAROM_OK;
    }
    if ((impacts || lasting) && sw.ran_out && rest_approaches(r)) {
        rest_part(r);
    }
    rest_energy_rule(r, !impacts || lasting, lasting);
    note_unsettled(r, sw.ran_out && rest_approaches(r));
    return CAROM_OK;
}

/* Contacts may be asked for after the step; their places are measured from the origins set here. */
static void place_origins(struct rest *r)
{
    for (uint32_t i = r->island; i != ISLAND_END; i = r->bodies[i].island.next) {
        body_place_origin(&r->bodies[i], &r->states[i]);
    }
}

/* Book the work of moving surfaces on the island at hand: 2 P.drift. */
static void book_work(struct rest *r)
{
    for (uint32_t i = 0; i < r->count; i++) {
        const struct contact *c = rest_contact(r, i);

        rest_add_work2(body_work2(c->side[0].body), c, 1);
    }
}

int rest_solve(struct rest *r, int32_t tau_q30, bool warm)
{
    load_velocities(r);
    rest_list_islands(r);
    for (r->first = 0; r->first < r->list.pool->used; r->first += r->count) {
        if (rest_take_island(r)) {
            int result = solve_island(r, tau_q30, warm);

            if (result < 0) {
                return result; /* it has no impulses, and the step fails */
            }
            book_work(r);
            place_origins(r);
        }
    }
    r->count = 0;
    while (r->joints.calls && r->joints.calls->take_next(r)) {
        (void)solve_island(r, tau_q30, warm); /* only a lone impact can fail */
        place_origins(r);
    }
    if (warm) {
        rest_store_warm(r);
    }
    return CAROM_OK;
}

int rest_project(struct rest *r)
{
    uint32_t used = r->list.pool->used;

    r->list.pool->used = 0;
    load_velocities(r);
    rest_list_islands(r);
    r->first = r->count = 0;
    while (r->joints.calls->take_next(r)) {
        solve_island(r, CAROM_ONE_Q30, false);
        place_origins(r);
    }
    r->list.pool->used = used;
    return CAROM_OK;
}

/* True if a contact has a moving body that has not taken gravity. */
static bool may_enter(const struct contact *c)
{
    return c->side[0].body->clock.contact == BODY_FLIES ||
           (c->side[1].body && c->side[1].body->clock.contact == BODY_FLIES);
}

/* True if a body of the contact newly took gravity. */
static bool enters(const struct contact *c)
{
    return c->side[0].body->clock.contact == BODY_ENTERS ||
           (c->side[1].body && c->side[1].body->clock.contact == BODY_ENTERS);
}

bool rest_enter_contact(struct rest *r)
{
    bool any = false;

    r->loaded = false;
    rest_load_contacts(r);
    for (uint32_t i = 0; i < r->list.pool->used; i++) {
        struct contact *c = &r->list.contacts[i];

        if (c->idle || !may_enter(c) || !rest_lies(r, c)) {
            continue;
        }
        for (int s = 0; s < 2; s++) {
            struct body *b = c->side[s].body;

            if (b && b->clock.contact == BODY_FLIES) {
                b->clock.contact = BODY_ENTERS;
                any = true;
            }
        }
    }
    if (any && r->joints.calls) {
        r->joints.calls->enter(r);
    }
    for (uint32_t i = 0; any && i < r->list.pool->used; i++) {
        r->list.contacts[i].idle = !enters(&r->list.contacts[i]);
    }
    r->loaded = false;
    return any;
}

void rest_load_entered(struct rest *r)
{
    for (uint32_t i = 0; i < r->body_count; i++) {
        struct body *b = &r->bodies[i];

        if (b->clock.contact == BODY_ENTERS) {
            body_velocity(b, &r->states[i], &b->solve.velocity);
        }
    }
    r->loaded = true;
}
