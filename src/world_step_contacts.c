/* SPDX-License-Identifier: MIT */
/* The touching part of a step: the static check, events of touching, and the solves. */
#include "world_step_parts.h"

static void visit_contacts(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    struct step_visitor *v = (struct step_visitor *)self;
    struct carom_world *w = v->step->w;

    for (uint32_t i = 0; i < n && !v->error; i++) {
        int32_t margin;

        step_select_pair(v, c[i].pair);
        /* bodies that bounce for ever must not be held by their margin */
        margin =
            v->pair.skin_q22 * (rest_restitution(v->pair.a, v->pair.b) == CAROM_ONE_Q30 ? 2 : 5);
        if (!contact_add(&w->rest.list, &v->pair, &c[i], margin)) {
            v->error = CAROM_ERR_CONTACTS_FULL;
        }
    }
}

void step_note_touching(struct step *s, const struct pair *p)
{
    struct world_state *next = s->next;

    if (!step_is_touching(next, p) && next->touching_count < s->w->config.caps.pairs) {
        next->touching[next->touching_count++] = *p;
    }
}

/* The static check in the present poses; `forced`: the hit that led here, or NULL. */
static int find_contacts(struct step *s, const struct boyse_hit *forced)
{
    struct carom_world *w = s->w;
    struct contact_list *list = &w->rest.list;
    carom_v3_q22 centre_a, centre_b;
    struct step_visitor v;
    int result;

    if (forced) {
        /* where the bodies are now, relative to the origin that the hit refers to */
        const struct pair *p = &w->pairs[forced->candidate.pair];
        const struct body *a = &w->bodies[p->a];

        for (int k = 0; k < 3; k++) {
            int64_t origin = a->path.origin_q22[k];

            centre_a.c[k] =
                (int32_t)(carom_round(s->next->bodies[p->a].position.c[k], 10) - origin);
            centre_b.c[k] =
                (int32_t)(carom_round(s->next->bodies[p->b].position.c[k], 10) - origin);
        }
    }
    step_place_all(s);
    pool_clear(list->pool);
    result = step_visit(s, &v, visit_contacts);
    if (result == CAROM_OK && forced) {
        step_select_pair(&v, forced->candidate.pair);
        if (!contact_force(list, &v.pair, forced, &centre_a, &centre_b)) {
            result = CAROM_ERR_CONTACTS_FULL;
        }
    }
    if (result == CAROM_OK) {
        contact_merge(list);
        for (uint32_t i = 0; i < list->pool->used; i++) {
            step_note_touching(s, &w->pairs[list->contacts[i].key.pair]);
        }
        w->stats.contacts = list->pool->used;
    }
    step_mark(w, CAROM_STAGE_CONTACT);
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
        while (e < end && (e->kind != CAROM_EVENT_HIT || e->a != p->a || e->b != p->b)) {
            e++;
        }
        if (e == end) {
            if (w->event_count >= w->config.caps.pairs + w->config.caps.bodies) {
                continue; /* the rest of the room is for what the end of the step finds */
            }
            step_add_event(w, CAROM_EVENT_HIT, p->a, p->b);
        }
        if (-c->velocity_q40[0] > e->speed_q40) {
            e->speed_q40 = -c->velocity_q40[0];
            e->impulse_q40 = rest_along_q40(&c->impulse_q40, &c->direction[0]);
        }
    }
}

static int solve(struct step *s, bool warm)
{
    struct carom_world *w = s->w;
    uint32_t impacts = w->rest.impacts;
    int result = rest_solve(&w->rest, s->left_q30, warm);

    note_hits(s);
    step_mark(w, w->rest.impacts > impacts ? CAROM_STAGE_IMPACT : CAROM_STAGE_REST);
    return result;
}

/* Bodies that lie on others: gravity at once, held up by last frame's impulses. */
int step_start_contacts(struct step *s)
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
int step_respond(struct step *s)
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
