/* SPDX-License-Identifier: MIT */
/* The touching part of a step: the static check, events of touching, and the solves. */
#include "parts.h"

static void visit_contacts(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    struct step_visitor *v = (struct step_visitor *)self;
    struct carom_world *w = v->step->w;

    for (uint32_t i = 0; i < n && !v->error; i++) {
        int32_t margin;

        step_select_pair(v, &c[i]);
        /* bodies that bounce for ever must not be held by their margin */
        margin =
            v->pair->skin_q22 *
            (rest_restitution(v->pair->a, v->pair->b) == CAROM_ONE_Q30 ? 2 : BODY_MARGIN_SKINS);
        if (!contact_add(&w->rest.list, v->pair, &c[i], margin)) {
            v->error = CAROM_ERR_CONTACTS_FULL;
        }
    }
}

/* The static check in the present poses. */
static int check(struct step *s)
{
    struct step_visitor v;

    step_place_all(s);
    pool_clear(s->w->rest.list.pool);
    return step_visit(s, &v, visit_contacts);
}

/*
 * The contacts at the present poses, among them the hit that led here, if one did. What sleeps and
 * is touched wakes: then there are more bodies to gather for, and maybe more contacts.
 */
static int gather_contacts(struct step *s, bool at_hit)
{
    struct carom_world *w = s->w;
    struct pair p = {0, 0};
    int result;

    for (uint32_t i = 0; i < w->body_count; i++) {
        w->bodies[i].woke = false;
    }
    if (at_hit) {
        p = w->pairs[s->hit.candidate.pair];
    }
    for (;;) {
        result = check(s);
        if (result == CAROM_OK && at_hit) {
            if (!contact_force(&w->rest.list, step_set_pair(w, &s->hit.candidate), &s->hit)) {
                result = CAROM_ERR_CONTACTS_FULL;
            }
        }
        if (result < 0 || !world_wake_touched(w, s->next->bodies)) {
            return result;
        }
        result = step_gather(s);
        if (result < 0) {
            return result;
        }
        if (at_hit) {
            s->hit.candidate.pair = step_pair_number(w, &p);
        }
    }
}

/* The static check: contacts, each place once, and which pairs touch. */
static int find_contacts(struct step *s, bool at_hit)
{
    struct carom_world *w = s->w;
    struct contact_list *list = &w->rest.list;
    int result = gather_contacts(s, at_hit);

    if (result == CAROM_OK) {
        contact_merge(list);
        w->stats.contacts = list->pool->used;
    }
    for (uint32_t i = 0; i < list->pool->used && result == CAROM_OK; i++) {
        uint16_t pair = list->contacts[i].key.pair;

        if (i == 0 || list->contacts[i - 1].key.pair != pair) {
            result = step_note_touching(s, &w->pairs[pair]);
        }
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
        if (-c->speed_q40 > e->speed_q40) {
            e->speed_q40 = -c->speed_q40;
            e->impulse_q40 = rest_along_q40(contact_impulse(c), &c->normal);
        }
    }
}

/* Of shorter slices nothing is asked: less than a thousandth of a frame. */
#define CHORD_SLICE_MIN_Q30 (1 << 20)
/* Nor of what bends by less than this part of a skin: the gap of the next frame makes up for it. */
#define CHORD_BEND_DIVISOR 16

/* By how much the gap of a contact changes on the present paths, q22. */
static int64_t gap_change(const struct boyse_pair *pair, const struct candidate *c)
{
    struct boyse_touch from, to;

    boyse_touch(pair, c, 0, &from);
    boyse_touch(pair, c, CAROM_ONE_Q30, &to);
    return (int64_t)(to.sign == from.sign ? to.gap_q22 : -to.gap_q22) - from.gap_q22;
}

/* Straight paths of a slice for all that move. */
static void predict_straight(struct step *s, int32_t slice_q30)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        if (broad_active(&s->w->bodies[i], &s->next->bodies[i])) {
            body_predict(&s->w->bodies[i], &s->next->bodies[i], slice_q30, NULL);
        }
    }
}

/*
 * Whether the path of a contact may be off the straight one by more than a small part of the skin:
 * r w^2 / 8 of both bodies. The spins are those of the last look at the contacts.
 */
static bool bends(const struct contact *c, int32_t left_q30)
{
    int64_t bend_q22 = 0;

    for (int k = 0; k < 2; k++) {
        const struct body *b = c->side[k].body;

        if (b) {
            int64_t turn_q30 = fix_mul(fix_length(b->spin.c), left_q30, 40);

            turn_q30 = turn_q30 < CAROM_ONE_Q30 ? turn_q30 : CAROM_ONE_Q30;
            bend_q22 += fix_mul((turn_q30 * turn_q30) >> 30, b->radius_q22, 33);
        }
    }
    return bend_q22 > c->skin_q22 / CHORD_BEND_DIVISOR;
}

/*
 * How the gap of each contact is going to change in the next slice. A body that rolls or tips does
 * not keep the V.N that it starts with: its arm turns, and so does its spin. Without this it comes
 * back to the surface within the frame, at once if it rolls fast, and uses up the sub-steps.
 */
static void find_chords(struct step *s)
{
    struct carom_world *w = s->w;
    struct contact_list *list = &w->rest.list;
    struct step_visitor v = {.step = s, .pair_number = -1};
    int32_t slice_q30 = 0; /* not yet known */

    for (uint32_t i = 0; i < list->pool->used; i++) {
        struct contact *c = &list->contacts[i];
        int64_t way_q22;

        c->chord_q28 = INT32_MAX;
        if (!bends(c, s->left_q30)) {
            continue;
        }
        if (slice_q30 == 0) {
            slice_q30 = step_slice(s);
            predict_straight(s, slice_q30);
        }
        if (slice_q30 <= CHORD_SLICE_MIN_Q30) {
            continue;
        }
        step_select_pair(&v, &c->key);
        way_q22 = gap_change(v.pair, &c->key) + 4;
        if (carom_abs(way_q22) < 1 << 24) {
            c->chord_q28 = rest_clamp(way_q22 * ((int64_t)1 << 26) / (slice_q30 >> 10));
        }
    }
}

static int solve(struct step *s, bool warm)
{
    struct carom_world *w = s->w;
    uint32_t impacts = w->rest.impacts;
    int result;

    find_chords(s);
    PHASE_BEGIN(w->scratch_phase, WORLD_SOLVE);
    result = rest_solve(&w->rest, s->left_q30, warm);
    note_hits(s);
    step_mark(w, w->rest.impacts > impacts ? CAROM_STAGE_IMPACT : CAROM_STAGE_REST);
    return result;
}

/* Bodies that lie on others: gravity at once, held up by last frame's impulses. */
int step_start_contacts(struct step *s)
{
    int result = CAROM_OK;

    /* most bodies are far from all others: the paths at hand stay as they are */
    if (s->w->pools[CAROM_POOL_pairs].used > 0) {
        result = find_contacts(s, false);
        if (result < 0) {
            return result;
        }
    }
    if (s->w->rest.list.pool->used == 0 || !rest_enter_contact(&s->w->rest, CAROM_ONE_Q30)) {
        s->w->rest.warm_count = 0;
        return CAROM_OK;
    }
    return solve(s, true);
}

/* Resolve a hit: the impact, then what it left slow goes into continuous contact. */
int step_respond(struct step *s)
{
    int result;

    s->w->stats.hits++;
    result = find_contacts(s, true);
    if (result == CAROM_OK) {
        rest_keep_hits(&s->w->rest, s->hit.candidate.pair);
        result = solve(s, false);
    }
    if (result == CAROM_OK && rest_enter_contact(&s->w->rest, s->left_q30)) {
        result = solve(s, false);
    }
    return result;
}
