/* SPDX-License-Identifier: MIT */
/*
 * The answer to a hit: the island of both bodies at that time, its contacts, the solve, and new
 * paths. No other body changes.
 */
#include "../solve/rigid.h"
#include "parts.h"

/* Largest count of hits, seven bits. */
#define COUNT_MAX 127u

struct boyse_hit step_hit_of(struct step *s, uint32_t number)
{
    const struct pair_work *m = &s->w->meetings[number];
    struct boyse_hit hit = {.candidate = {(uint16_t)number, m->kind, m->i, m->j}};
    int32_t from_q30, to_q30, t_q30;
    struct boyse_pair *pair;

    (void)step_window(s, number, &from_q30, &to_q30);
    t_q30 = (int32_t)(((int64_t)(m->hit_q30 - from_q30) << 30) / (to_q30 - from_q30));
    step_open_window(s, number, from_q30, to_q30);
    pair = step_set_pair(s->w, number);
    boyse_pair_for(pair, &hit.candidate);
    hit.touch.valid = false;
    if (m->late) {
        boyse_touch(pair, &hit.candidate, t_q30, &hit.touch);
    }
    /* features that face each other for a moment only may do so just before the root */
    for (int k = STEP_ROOT_TRIES; k >= 0 && !hit.touch.valid; k--) {
        int32_t part_q30 = (int32_t)((int64_t)(m->root_q30 - t_q30) * k / STEP_ROOT_TRIES);

        boyse_touch(pair, &hit.candidate, t_q30 + part_q30, &hit.touch);
    }
    step_close_window(s, number, from_q30, to_q30);
    return hit;
}

/* Make a body a member of the island; it leaves its path. */
static void join(struct step *s, uint32_t i)
{
    struct body *b = &s->w->bodies[i];

    if (b->def.moving && step_active(s, i) && !b->clock.member) {
        step_leave_path(s, i, s->now_q30);
        body_place(b, &s->next->bodies[i]);
        b->clock.member = true;
        b->solve.unsettled = false;
    }
}

/*
 * Check a pair of which one body is a member. If they touch, the other becomes a member, too.
 * Returns an error, 1 for a new member, else CAROM_OK.
 */
static int check_with(struct step *s, uint32_t number)
{
    const struct carom_world *w = s->w;
    const struct pair *p = &w->pairs[number];
    uint32_t other = w->bodies[p->a].clock.member ? p->b : p->a;
    int result;

    step_look_at(s, other, s->now_q30);
    contact_doubt_pair(&s->w->rest.list, (uint16_t)number);
    result = step_check_pair(s, number);
    if (result == CAROM_OK && w->bodies[other].def.moving && step_active(s, other) &&
        !w->bodies[other].clock.member && contact_has_pair(&w->rest.list, (uint16_t)number)) {
        join(s, other);
        return 1;
    }
    return result;
}

/* Make bodies that joints connect with a member members, too. Returns CAROM_OK. */
static int join_connected(struct step *s)
{
    uint32_t other;

    while (s->w->joint_steps && (other = s->w->joint_steps->connected(s)) != ISLAND_END) {
        join(s, other);
    }
    return CAROM_OK;
}

/* Grow the island from the present members and collect all of its contacts. */
static int grow(struct step *s)
{
    struct carom_world *w = s->w;
    int result = 1;

    for (uint32_t n = 0; n < w->pools[CAROM_POOL_pairs].used; n++) {
        w->meetings[n].checked = false;
    }
    while (result == 1) {
        result = join_connected(s);
        for (uint32_t n = 0; n < w->pools[CAROM_POOL_pairs].used && result >= 0; n++) {
            const struct pair *p = &w->pairs[n];

            if (!w->meetings[n].checked && step_is_solid(&w->meetings[n]) &&
                (w->bodies[p->a].clock.member || w->bodies[p->b].clock.member)) {
                int grown = check_with(s, n);

                w->meetings[n].checked = true;
                result = grown != CAROM_OK ? grown : result;
            }
        }
    }
    contact_drop_doubted(&w->rest.list);
    return result;
}

/* Add the contact of a hit to those of its island. */
static int force_contact(struct step *s, const struct boyse_hit *hit)
{
    struct boyse_pair *pair = step_set_pair(s->w, hit->candidate.pair);

    boyse_pair_for(pair, &hit->candidate);
    if (hit->touch.valid && !contact_force(&s->w->rest.list, pair, hit)) {
        return CAROM_ERR_CONTACTS_FULL;
    }
    return CAROM_OK;
}

/*
 * Find the island of two bodies and its contacts, the one of their hit included, if there is one.
 * Sleeping bodies that it touches wake.
 */
static int gather_island(struct step *s, const struct pair *p, struct boyse_hit *hit)
{
    struct carom_world *w = s->w;
    int result;

    for (uint32_t i = 0; i < w->body_count; i++) {
        w->bodies[i].clock.member = w->bodies[i].clock.woke = false;
    }
    for (;;) {
        join(s, p->a);
        join(s, p->b);
        for (uint32_t i = 0; i < w->body_count; i++) {
            if (w->bodies[i].clock.woke) {
                join(s, i);
            }
        }
        result = grow(s);
        if (result == CAROM_OK && hit) {
            result = force_contact(s, hit);
        }
        if (result < 0 || !world_wake_touched(w, s->next->bodies)) {
            return result;
        }
        result = step_adopt_woken(s);
        if (result < 0) {
            return result;
        }
        if (hit) {
            hit->candidate.pair = (uint16_t)step_find_pair(w, p);
        }
    }
}

/* Solve only contacts of the island. Body a always moves: where b is a member, it is one, too. */
static void leave_others_idle(struct step *s)
{
    const struct carom_world *w = s->w;

    for (uint32_t i = 0; i < w->rest.list.pool->used; i++) {
        struct contact *c = &w->rest.list.contacts[i];
        const struct pair *p = &w->pairs[c->key.pair];

        c->idle = !w->bodies[p->a].clock.member;
    }
    if (w->joint_steps) {
        w->joint_steps->choose_members(s);
    }
}

static int solve_island(struct step *s)
{
    int result = step_settle_contacts(s, true);

    leave_others_idle(s);
    if (result == CAROM_OK) {
        result = step_solve(s, false);
    }
    if (result == CAROM_OK && step_enter_contact(s)) {
        result = step_solve(s, false);
    }
    return result;
}

/*
 * The last resort for an island that a solve did not part. It stops if it touches a stationary
 * body, else it moves as one rigid body. `hard`: see step_carry_island.
 */
static void calm_island(struct step *s, uint32_t body, bool hard)
{
    uint32_t first = s->w->bodies[body].island.lowest;
    bool grounded = false;

    for (uint32_t i = 0; i < s->w->rest.list.pool->used; i++) {
        const struct contact *c = &s->w->rest.list.contacts[i];
        const struct pair *p = &s->w->pairs[c->key.pair];

        grounded |= s->w->bodies[p->a].island.lowest == first && !s->w->bodies[p->b].def.moving;
    }
    if (!grounded || !step_carry_island(s, first, hard)) {
        rest_unite(&s->w->rest, first, grounded);
    }
    s->w->stats.calmed++;
}

/*
 * Handle a pair that hits again where it was answered. The turn of a path is that of its middle, so
 * a long path may close a gap that opens by the present motion. Shorter paths do not, and they grow
 * again slice by slice. If these hit as well, the solve could not part the bodies.
 */
static void insist(struct step *s, uint32_t number, uint32_t repeats)
{
    const struct pair *p = &s->w->pairs[number];
    struct body *a = &s->w->bodies[p->a], *b = &s->w->bodies[p->b];
    bool turn = (s->next->bodies[p->a].angular.c[0] | s->next->bodies[p->a].angular.c[1] |
                 s->next->bodies[p->a].angular.c[2] | s->next->bodies[p->b].angular.c[0] |
                 s->next->bodies[p->b].angular.c[1] | s->next->bodies[p->b].angular.c[2]) != 0;

    if (repeats > STEP_CALM_AFTER + (turn ? STEP_SHORTER_MAX : 0) ||
        (s->w->meetings[number].hits > STEP_UNSETTLED_HITS &&
         (a->solve.unsettled || b->solve.unsettled))) {
        calm_island(s, step_active(s, p->a) ? p->a : p->b, repeats > STEP_HARD_AFTER);
    }
    if (turn && repeats > 0) {
        a->clock.shorter = (uint8_t)(a->clock.shorter + (a->clock.shorter < STEP_SHORTER_MAX));
        b->clock.shorter = (uint8_t)(b->clock.shorter + (b->clock.shorter < STEP_SHORTER_MAX));
    }
}

/* Count a hit of a body. True if it was the last one allowed. */
static bool spend(struct step *s, uint32_t i)
{
    struct body *b = &s->w->bodies[i];

    return b->def.moving && step_active(s, i) && ++b->clock.events >= s->event_cap;
}

/* Stop the island for the rest of the frame. A kinematic member has been stopped already. */
static void stop_island(struct step *s, const struct pair *p)
{
    struct carom_world *w = s->w;

    for (uint32_t i = 0; i < w->body_count; i++) {
        w->bodies[i].clock.stands |= w->bodies[i].clock.member;
    }
    step_block_pushers(s, p);
    s->cut_short = true;
    if (step_may_note(w)) {
        step_add_event(w, CAROM_EVENT_CUT, p->a, p->b);
    }
    w->stats.cut_islands++;
}

/* Set new paths for members. Bodies that were only looked at continue on their own paths. */
static int go_on(struct step *s)
{
    struct carom_world *w = s->w;
    int result = CAROM_OK;

    for (uint32_t i = 0; i < w->body_count && result == CAROM_OK; i++) {
        if (w->bodies[i].clock.member) {
            result = step_set_path(s, i);
        } else if (w->bodies[i].clock.placed) {
            step_look_away(s, i);
        }
    }
    step_mark(w, CAROM_STAGE_PREDICT);
    return result == CAROM_OK ? step_search_members(s) : result;
}

int step_answer(struct step *s, uint32_t number)
{
    struct carom_world *w = s->w;
    struct pair_work *m = &w->meetings[number];
    const struct pair p = w->pairs[number];
    struct boyse_hit hit = step_hit_of(s, number);
    uint32_t repeats;
    bool last_a, last_b;
    int result;

    s->now_q30 = m->hit_q30;
    repeats = m->answered_q30 == s->now_q30 ? m->repeats + 1u : 0;
    m->repeats = (repeats < COUNT_MAX ? repeats : COUNT_MAX) & COUNT_MAX;
    m->answered_q30 = s->now_q30;
    m->hits = (m->hits < COUNT_MAX ? m->hits + 1u : COUNT_MAX) & COUNT_MAX;
    w->stats.hits++;
    w->stats.substeps++;
    result = gather_island(s, &p, &hit);
    if (result == CAROM_OK) {
        result = solve_island(s);
    }
    if (result < 0) {
        return result;
    }
    insist(s, hit.candidate.pair, repeats);
    last_a = spend(s, p.a);
    last_b = spend(s, p.b);
    if (last_a || last_b) {
        stop_island(s, &p);
    }
    return go_on(s);
}

int step_rejoin(struct step *s, uint32_t body)
{
    struct carom_world *w = s->w;
    const struct pair alone = {.a = (uint16_t)body, .b = (uint16_t)body};
    int result;

    w->stats.substeps++;
    s->now_q30 = w->bodies[body].clock.to_q30;
    for (uint32_t i = 0; i < w->body_count; i++) {
        struct body *b = &w->bodies[i];

        if (b->def.mesh && b->def.joined == w->bodies[body].def.joined && b->clock.shorter > 0) {
            b->clock.shorter--;
        }
    }
    result = gather_island(s, &alone, NULL);
    if (result == CAROM_OK) {
        result = solve_island(s);
    }
    return result == CAROM_OK ? go_on(s) : result;
}
