/* SPDX-License-Identifier: MIT */
/*
 * world_step - one frame, top to bottom: the paper's figures 4 and 5.
 *
 * The frame is built in the state that is not current and becomes current at the very end, so that
 * an error on the way leaves the world as it was.
 */
#include "world.h"

#define REFINEMENTS 4

/* What the whole step works on. */
struct step {
    struct carom_world *w;
    struct world_state *next;
    const carom_v3_q40 *gravity;
    int32_t left_q30; /* of the frame */
    struct boyse_hit hit;
};

/* ------------------------------------------------------------------ timing */

static void mark(struct carom_world *w, enum carom_stage stage)
{
    if (w->config.ticks) {
        uint32_t now = w->config.ticks();

        w->stats.ticks[stage] += now - w->mark_tick;
        w->mark_tick = now;
    }
}

/* ---------------------------------------------------------------- visitors */

/* A visitor that knows which pair a candidate belongs to. */
struct pair_visitor {
    struct candidate_visitor base;
    struct step *step;
    struct boyse_pair pair;
    int32_t pair_number; /* that `pair` is set up for; -1: none */
    bool found;
    int error;
};

static void select_pair(struct pair_visitor *v, uint16_t number)
{
    if (v->pair_number != number) {
        const struct pair *p = &v->step->w->pairs[number];

        boyse_pair_init(&v->pair, &v->step->w->bodies[p->a], &v->step->w->bodies[p->b]);
        v->pair_number = number;
    }
}

static void visit_nothing(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    (void)self;
    (void)c;
    (void)n;
}

/* The earliest hit; equal times go to the first in the order of candidates. */
static void visit_first_hit(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    struct pair_visitor *v = (struct pair_visitor *)self;
    struct boyse_hit *best = &v->step->hit;

    for (uint32_t i = 0; i < n; i++) {
        struct boyse_hit hit;

        select_pair(v, c[i].pair);
        if (!boyse_first(&v->pair, &c[i], &hit, &v->step->w->stats.roots)) {
            continue;
        }
        hit.candidate = c[i];
        if (!v->found || hit.t_q30 < best->t_q30 ||
            (hit.t_q30 == best->t_q30 && candidate_compare(&c[i], &best->candidate) < 0)) {
            *best = hit;
            v->found = true;
        }
    }
}

static void visit_contacts(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    struct pair_visitor *v = (struct pair_visitor *)self;
    struct carom_world *w = v->step->w;

    for (uint32_t i = 0; i < n && !v->error; i++) {
        int32_t margin;

        select_pair(v, c[i].pair);
        /* bodies that bounce for ever must not be held by their margin */
        margin = v->pair.skin_q22 *
                 (rest_restitution(v->pair.a, v->pair.b) == CAROM_ONE_Q30 ? 2 : 5);
        if (!contact_add(&w->rest.list, &v->pair, &c[i], margin)) {
            v->error = CAROM_ERR_CONTACTS_FULL;
        }
    }
}

static int visit(struct step *s, struct pair_visitor *v,
                 void (*f)(struct candidate_visitor *, const struct candidate *, uint32_t))
{
    struct carom_world *w = s->w;
    int result;

    memset(v, 0, sizeof *v);
    v->base.visit = f;
    v->step = s;
    v->pair_number = -1;
    result = interfere_visit(&w->interfere, w->bodies, w->pairs, w->pools[CAROM_POOL_pairs].used,
                             &v->base);
    return v->error ? v->error : result;
}

/* ---------------------------------------------------------------- predict */

static void place_all(struct step *s)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        if (s->w->bodies[i].mesh) {
            body_place(&s->w->bodies[i], &s->next->bodies[i]);
        }
    }
}

static void predict_all(struct step *s, int32_t tau_q30)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        struct body *b = &s->w->bodies[i];

        if (b->mesh) {
            body_predict(b, &s->next->bodies[i], tau_q30, b->in_contact ? NULL : s->gravity);
        }
    }
}

/* The region that the rest of the frame's motion stays in, before and after any impact. */
static void set_reach(struct step *s)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        struct body *b = &s->w->bodies[i];
        int32_t turn_q30;
        int64_t way_q22;

        b->moved_q22 = b->turned_q30 = 0;
        b->reach_q22 = b->turn_q30 = 0;
        if (!b->mesh) {
            continue;
        }
        way_q22 = body_travel_q22(b, &s->next->bodies[i], s->left_q30, s->gravity, &turn_q30);
        if (broad_active(b, &s->next->bodies[i])) {
            /* a third more than it is going to move, and room for four margins of five skins */
            b->reach_q22 = (int32_t)(way_q22 + way_q22 / 10 * 3 + 20 * (int64_t)b->skin_q22);
            b->turn_q30 = turn_q30 / 10 * 13 + CAROM_ONE_Q30 / 100;
        }
        b->gathered_at = s->next->bodies[i].position;
        body_matrix(&b->gathered_r, &s->next->bodies[i].rotation);
    }
}

/* Pairs, interfering faces and candidates for the rest of the frame. */
static int gather(struct step *s)
{
    struct carom_world *w = s->w;
    struct pair_visitor v;
    int result;

    place_all(s);
    set_reach(s);
    mark(w, CAROM_STAGE_PREDICT);
    result = broad_pairs(w->pairs, &w->pools[CAROM_POOL_pairs], w->bodies, s->next->bodies,
                         w->body_count);
    mark(w, CAROM_STAGE_BROAD);
    if (result < 0) {
        return result;
    }
    interfere_begin(&w->interfere);
    result = visit(s, &v, visit_nothing);
    mark(w, CAROM_STAGE_INTERFERE);
    return result;
}

/* Whether a body may leave the region on its path. */
static bool leaves_region(const struct step *s)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        const struct body *b = &s->w->bodies[i];
        int64_t way_q22, turn_q30;

        if (!broad_active(b, &s->next->bodies[i])) {
            continue;
        }
        body_path_length(b, CAROM_ONE_Q30, &way_q22, &turn_q30);
        if (b->moved_q22 + way_q22 + 10 * (int64_t)b->skin_q22 > b->reach_q22 ||
            b->turned_q30 + turn_q30 > b->turn_q30) {
            return true;
        }
    }
    return false;
}

/* The longest slice that every body's turn allows, with all paths set. */
static int predict(struct step *s, int32_t *slice_q30)
{
    int result = CAROM_OK;

    *slice_q30 = s->left_q30;
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        if (broad_active(&s->w->bodies[i], &s->next->bodies[i])) {
            *slice_q30 = body_slice(&s->w->bodies[i], &s->next->bodies[i], *slice_q30);
        }
    }
    predict_all(s, *slice_q30);
    if (leaves_region(s)) {
        result = gather(s);
        predict_all(s, *slice_q30);
    }
    mark(s->w, CAROM_STAGE_PREDICT);
    return result;
}

/* ----------------------------------------------------------------- advance */

static int first_hit(struct step *s, bool *found)
{
    struct pair_visitor v;
    int result = visit(s, &v, visit_first_hit);

    *found = v.found;
    mark(s->w, CAROM_STAGE_BOYSE);
    return result;
}

static void advance_all(struct step *s, int32_t t_q30, int32_t slice_q30)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        struct body *b = &s->w->bodies[i];
        int64_t way_q22, turn_q30;

        if (!broad_active(b, &s->next->bodies[i])) {
            continue;
        }
        body_path_length(b, t_q30, &way_q22, &turn_q30);
        b->moved_q22 += way_q22;
        b->turned_q30 += turn_q30;
        body_advance(b, &s->next->bodies[i], t_q30, slice_q30, b->in_contact ? NULL : s->gravity);
    }
    s->left_q30 -= (int32_t)(((int64_t)slice_q30 * t_q30) >> 30);
    mark(s->w, CAROM_STAGE_ADVANCE);
}

/*
 * Go to the hit. The turn of a shorter slice is not a part of the turn of the longer one, so the
 * path is set up again for the slice that ends at the hit until it no longer hits on the way: only
 * then does the rotation keep its energy. The last path may still stop short of its end.
 */
static int go_to_hit(struct step *s, int32_t slice_q30)
{
    int32_t t_q30 = CAROM_ONE_Q30;

    slice_q30 = (int32_t)(((int64_t)slice_q30 * s->hit.t_q30) >> 30);
    for (int round = 0; round < REFINEMENTS; round++) {
        bool found;
        int result;

        predict_all(s, slice_q30);
        result = first_hit(s, &found);
        if (result < 0) {
            return result;
        }
        s->w->stats.refinements++;
        t_q30 = CAROM_ONE_Q30;
        if (!found || s->hit.t_q30 >= CAROM_ONE_Q30 - 1) {
            break;
        }
        t_q30 = s->hit.t_q30;
        if (t_q30 <= 1) {
            t_q30 = 0;
            break;
        }
        if (round < REFINEMENTS - 1) {
            slice_q30 = (int32_t)(((int64_t)slice_q30 * t_q30) >> 30);
        }
    }
    advance_all(s, t_q30, slice_q30);
    return CAROM_OK;
}

/* ---------------------------------------------------------------- contacts */

static void note_touching(struct step *s, const struct pair *p)
{
    struct world_state *next = s->next;

    for (uint32_t i = 0; i < next->touching_count; i++) {
        if (next->touching[i].a == p->a && next->touching[i].b == p->b) {
            return;
        }
    }
    if (next->touching_count < s->w->config.caps.pairs) {
        next->touching[next->touching_count++] = *p;
    }
}

/* The static check in the present poses; `forced`: the hit that led here, or NULL. */
static int find_contacts(struct step *s, const struct boyse_hit *forced)
{
    struct carom_world *w = s->w;
    struct contact_list *list = &w->rest.list;
    carom_v3_q22 centre_a, centre_b;
    struct pair_visitor v;
    int result;

    if (forced) {
        /* where the bodies are now, relative to the origin that the hit refers to */
        const struct pair *p = &w->pairs[forced->candidate.pair];
        const struct body *a = &w->bodies[p->a];

        for (int k = 0; k < 3; k++) {
            int64_t origin = a->path.origin_q22[k];

            centre_a.c[k] = (int32_t)(carom_round(s->next->bodies[p->a].position.c[k], 10) - origin);
            centre_b.c[k] = (int32_t)(carom_round(s->next->bodies[p->b].position.c[k], 10) - origin);
        }
    }
    place_all(s);
    pool_clear(list->pool);
    result = visit(s, &v, visit_contacts);
    if (result == CAROM_OK && forced) {
        select_pair(&v, forced->candidate.pair);
        if (!contact_force(list, &v.pair, forced, &centre_a, &centre_b)) {
            result = CAROM_ERR_CONTACTS_FULL;
        }
    }
    if (result == CAROM_OK) {
        contact_merge(list);
        for (uint32_t i = 0; i < list->pool->used; i++) {
            note_touching(s, &w->pairs[list->contacts[i].key.pair]);
        }
        w->stats.contacts = list->pool->used;
    }
    mark(w, CAROM_STAGE_CONTACT);
    return result;
}

/* The hardest impact of each pair becomes its hit event. */
static void note_hits(struct step *s)
{
    struct carom_world *w = s->w;
    const struct contact_list *list = &w->rest.list;

    for (uint32_t i = 0; i < list->pool->used; i++) {
        const struct contact *c = &list->contacts[i];
        const struct pair *p = &w->pairs[c->key.pair];
        struct carom_event *e = w->events, *end = w->events + w->event_count;

        if (!c->impact) {
            continue;
        }
        while (e < end && (e->a != p->a || e->b != p->b)) {
            e++;
        }
        if (e == end) {
            if (w->event_count == w->config.caps.pairs) {
                continue;
            }
            w->event_count++;
            memset(e, 0, sizeof *e);
            e->kind = CAROM_EVENT_HIT;
            e->a = p->a;
            e->b = p->b;
        }
        if (-c->velocity_q40[0] > e->speed_q40) {
            e->speed_q40 = -c->velocity_q40[0];
            e->impulse_q40 = 0;
            for (int k = 0; k < 3; k++) {
                e->impulse_q40 += fix_mul(c->impulse_q40.c[k], c->direction[0].c[k], 30);
            }
        }
    }
}

static int solve(struct step *s, bool warm)
{
    struct carom_world *w = s->w;
    uint32_t impacts = w->rest.impacts;
    int result = rest_solve(&w->rest, s->left_q30, warm);

    note_hits(s);
    mark(w, w->rest.impacts > impacts ? CAROM_STAGE_IMPACT : CAROM_STAGE_REST);
    return result;
}

/* Bodies that lie on others: gravity at once, held up by last frame's impulses. */
static int start_contacts(struct step *s)
{
    int result = find_contacts(s, NULL);

    if (result < 0) {
        return result;
    }
    if (!rest_enter_contact(&s->w->rest, CAROM_ONE_Q30)) {
        s->w->rest.warm_count = 0;
        return CAROM_OK;
    }
    return solve(s, true);
}

/* Resolve a hit: the impact, then what it left slow goes into continuous contact. */
static int respond(struct step *s)
{
    struct boyse_hit hit = s->hit;
    int result;

    s->w->stats.hits++;
    result = find_contacts(s, &hit);
    if (result == CAROM_OK) {
        result = solve(s, false);
    }
    if (result == CAROM_OK && rest_enter_contact(&s->w->rest, s->left_q30)) {
        result = solve(s, false);
    }
    return result;
}

/* ------------------------------------------------------------------ finish */

/* A frame that was cut short must not have gained energy by it: scale the momenta down. */
static void limit_energy(struct step *s)
{
    struct fix_wide excess = fix_wide_add(world_energy2(s->w, s->next),
                                          fix_wide_neg(world_energy2(s->w, world_now(s->w))));
    struct fix_wide kinetic = {0, 0}, kept;
    int32_t factor_q30 = 0;

    if (fix_wide_sign(excess) <= 0) {
        return;
    }
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        if (broad_active(&s->w->bodies[i], &s->next->bodies[i])) {
            carom_m3_q30 r;

            body_matrix(&r, &s->next->bodies[i].rotation);
            kinetic =
                fix_wide_add(kinetic, body_kinetic2(&s->w->bodies[i], &s->next->bodies[i], &r));
        }
    }
    kept = fix_wide_add(kinetic, fix_wide_neg(excess));
    if (fix_wide_sign(kept) > 0) {
        struct fix_scaled ratio = fix_wide_ratio(kept, kinetic); /* below 1 */

        factor_q30 = (int32_t)fix_sqrt((uint64_t)fix_mul_scaled((int64_t)1 << 60, ratio));
    }
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        for (int k = 0; k < 3; k++) {
            int64_t *p = &s->next->bodies[i].momentum.c[k], *l = &s->next->bodies[i].angular.c[k];

            *p = fix_mul(*p, factor_q30, 30);
            *l = fix_mul(*l, factor_q30, 30);
        }
    }
}

static void add_event(struct carom_world *w, uint8_t kind, uint16_t a, uint16_t b)
{
    struct carom_event *e = &w->events[w->event_count];

    if (w->event_count < 3 * w->config.caps.pairs + 2 * w->config.caps.bodies) {
        w->event_count++;
        memset(e, 0, sizeof *e);
        e->kind = kind;
        e->a = a;
        e->b = b;
    }
}

static bool is_touching(const struct world_state *s, const struct pair *p)
{
    for (uint32_t i = 0; i < s->touching_count; i++) {
        if (s->touching[i].a == p->a && s->touching[i].b == p->b) {
            return true;
        }
    }
    return false;
}

/* Begin and end of touching, rest, and bodies that left the world. */
static void finish_events(struct step *s)
{
    struct carom_world *w = s->w;
    const struct world_state *before = world_now(w);

    for (uint32_t i = 0; i < before->touching_count; i++) {
        const struct pair *p = &before->touching[i];

        /* nothing moved: they still touch, though nobody looked */
        if (!broad_active(&w->bodies[p->a], &before->bodies[p->a]) &&
            !broad_active(&w->bodies[p->b], &before->bodies[p->b])) {
            note_touching(s, p);
        } else if (!is_touching(s->next, p)) {
            add_event(w, CAROM_EVENT_END, p->a, p->b);
        }
    }
    for (uint32_t i = 0; i < s->next->touching_count; i++) {
        if (!is_touching(before, &s->next->touching[i])) {
            add_event(w, CAROM_EVENT_BEGIN, s->next->touching[i].a, s->next->touching[i].b);
        }
    }
    for (uint32_t i = 0; i < w->body_count; i++) {
        struct body_state *state = &s->next->bodies[i];

        if (state->asleep && !before->bodies[i].asleep) {
            add_event(w, CAROM_EVENT_REST, (uint16_t)i, 0);
        }
        if (w->bodies[i].moving && !state->out && !world_in_range(&w->bodies[i], state)) {
            *state = before->bodies[i];
            state->out = 1;
            add_event(w, CAROM_EVENT_OUT, (uint16_t)i, 0);
        }
    }
}

static void finish_stats(struct carom_world *w)
{
    struct carom_stats *st = &w->stats;

    st->gathers = w->interfere.gathers;
    st->candidates = w->interfere.candidate_count;
    st->sweeps = w->rest.sweeps;
    st->impacts = w->rest.impacts;
    st->energy_rule = w->rest.energy_rules;
    if (w->config.ticks) {
        st->total_ticks = w->config.ticks() - w->start_tick;
        for (uint32_t i = 1; i < CAROM_STAGE_COUNT; i++) {
            if (st->ticks[i] > st->ticks[st->over_stage]) {
                st->over_stage = i;
            }
        }
    }
}

static void begin(struct step *s, struct carom_world *w)
{
    const struct world_state *now = world_now(w);
    struct world_state *next = &w->states[1 - w->now];

    memset(s, 0, sizeof *s);
    s->w = w;
    s->next = next;
    s->gravity = &w->config.gravity;
    s->left_q30 = CAROM_ONE_Q30;
    memcpy(next->bodies, now->bodies, w->body_count * sizeof *next->bodies);
    memcpy(next->warm, now->warm, now->warm_count * sizeof *next->warm);
    next->warm_count = now->warm_count;
    next->touching_count = 0;

    w->rest.pairs = w->pairs;
    w->rest.bodies = w->bodies;
    w->rest.states = next->bodies;
    w->rest.body_count = w->body_count;
    w->rest.gravity = s->gravity;
    w->rest.slow_q40 = 4 * fix_length(s->gravity->c);
    w->rest.warm = next->warm;
    w->rest.warm_count = next->warm_count;
    w->rest.sweeps = w->rest.impacts = w->rest.energy_rules = 0;
    w->interfere.gathers = w->interfere.candidate_count = 0;
    memset(&w->stats, 0, sizeof w->stats);
    w->event_count = 0;
    pool_clear(&w->pools[CAROM_POOL_pairs]);
    pool_clear(&w->pools[CAROM_POOL_faces]);
    pool_clear(&w->pools[CAROM_POOL_contacts]);
    for (uint32_t i = 0; i < w->body_count; i++) {
        w->bodies[i].in_contact = false;
    }
    if (w->config.ticks) {
        w->start_tick = w->mark_tick = w->config.ticks();
    }
}

static int fail(struct carom_world *w, int error)
{
    w->event_count = 0;
    pool_clear(&w->pools[CAROM_POOL_pairs]);
    pool_clear(&w->pools[CAROM_POOL_faces]);
    pool_clear(&w->pools[CAROM_POOL_contacts]);
    return error;
}

/* -------------------------------------------------------------------- step */

int carom_world_step(struct carom_world *w)
{
    struct step s;
    int status = CAROM_OK, result;

    if (!w) {
        return CAROM_ERR_NULL;
    }
    begin(&s, w);
    result = gather(&s);
    if (result == CAROM_OK) {
        result = start_contacts(&s);
    }
    while (result == CAROM_OK && s.left_q30 > 0) {
        int32_t slice_q30;
        bool found = false;

        if (w->stats.substeps == w->config.substep_cap) {
            status |= CAROM_SUBSTEP_CAP;
            limit_energy(&s);
            break;
        }
        w->stats.substeps++;
        result = predict(&s, &slice_q30);
        if (result == CAROM_OK) {
            result = first_hit(&s, &found);
        }
        if (result < 0) {
            break;
        }
        if (!found) {
            advance_all(&s, CAROM_ONE_Q30, slice_q30);
            continue;
        }
        result = go_to_hit(&s, slice_q30);
        if (result == CAROM_OK) {
            result = respond(&s);
        }
    }
    if (result < 0) {
        return fail(w, result);
    }
    interfere_finish(&w->interfere);
    if (w->config.sleep) {
        rest_sleep(w->bodies, s.next->bodies, w->body_count, s.next->touching,
                   s.next->touching_count, s.gravity);
    }
    finish_events(&s);
    s.next->warm_count = w->rest.warm_count;
    w->now = 1 - w->now;
    mark(w, CAROM_STAGE_COMMIT);
    finish_stats(w);
    if (w->config.budget_ticks && w->stats.total_ticks > w->config.budget_ticks) {
        status |= CAROM_OVER_BUDGET;
    }
    return status;
}
