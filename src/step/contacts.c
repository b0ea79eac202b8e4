/* SPDX-License-Identifier: MIT */
/* Contacts of a step: the static check, the list of touching pairs, and the solves. */
#include "parts.h"

static void visit_contacts(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    struct step_visitor *v = (struct step_visitor *)self;
    struct boyse_pair *pair = n > 0 ? step_set_pair(v->step->w, v->number) : NULL;

    for (uint32_t i = 0; i < n && !v->error; i++) {
        boyse_pair_for(pair, &c[i]);
        if (!contact_add(&v->step->w->rest.list, pair, &c[i], v->margin_q22, &v->clear_q22)) {
            v->error = CAROM_ERR_CONTACTS_FULL;
        }
    }
}

/*
 * True if a pair bounces for ever: such bodies must not be held by their margin. Bodies in contact,
 * or that touched in the last frame, may have come to rest.
 */
static bool is_bouncing(const struct step *s, const struct pair *p)
{
    const struct body *a = &s->w->bodies[p->a], *b = &s->w->bodies[p->b];
    int32_t e_q30 =
        s->w->rest.list.plain ? rest_plain_restitution(a, b) : rest_restitution(&s->w->rest, a, b);

    return rest_bounces_for_ever(e_q30) && a->clock.contact == BODY_FLIES &&
           b->clock.contact == BODY_FLIES && !step_is_touching(world_now(s->w), p);
}

/* Clearance in 16ths of a skin; four bits. */
static uint32_t clear_parts(int32_t clear_q22, int32_t skin_q22)
{
    int32_t parts = clear_q22 > 0 ? (int32_t)((int64_t)clear_q22 * 16 / skin_q22) : 0;

    return parts < 15 ? (uint32_t)parts : 15;
}

int step_check_pair(struct step *s, uint32_t number)
{
    struct pair_work *m = &s->w->meetings[number];
    const struct pair *p = &s->w->pairs[number];
    const struct body *a = &s->w->bodies[p->a], *b = &s->w->bodies[p->b];
    int32_t skin_q22 = a->def.skin_q22 > b->def.skin_q22 ? a->def.skin_q22 : b->def.skin_q22;
    struct step_visitor v;
    int result;

    m->clear = 0;
    if (!step_is_solid(m) || (m->kept && m->count == 0) || s->next->bodies[p->a].out ||
        s->next->bodies[p->b].out) {
        return CAROM_OK;
    }
    v.margin_q22 = skin_q22 * (is_bouncing(s, p) ? BODY_BOUNCE_MARGIN_SKINS : BODY_MARGIN_SKINS);
    if (!m->kept &&
        step_stay_apart(s, number,
                        (int64_t)v.margin_q22 + 2 * skin_q22 + mesh_drift_most(a->def.mesh) +
                            mesh_drift_most(b->def.mesh))) {
        return CAROM_OK;
    }
    v.from_q30 = v.to_q30 = s->now_q30;
    v.clear_q22 = skin_q22;
    v.parts = 1;
    result = step_visit(s, number, &v, visit_contacts);
    if (s->rare && (a->def.one_way | b->def.one_way) != CAROM_BOTH_WAYS) {
        step_drop_other_side(s, number);
    }
    if (s->now_q30 == 0 && m->kept &&
        mesh_drift_most(a->def.mesh) + mesh_drift_most(b->def.mesh) == 0) {
        m->clear = clear_parts(v.clear_q22, skin_q22) & 15;
    }
    return result;
}

/*
 * Thin the contacts of each pair. A pair that has hit in the frame keeps all of them, as one may be
 * at the place of the hit.
 */
static void thin_out(struct step *s)
{
    struct contact_list *list = &s->w->rest.list;
    uint32_t kept = 0, end;

    for (uint32_t i = 0; i < list->pool->used; i = end) {
        uint16_t pair = list->contacts[i].key.pair;
        uint32_t n;

        end = contact_pair_end(list, pair, i);
        n = s->w->meetings[pair].hits > 0 ? end - i : contact_thin(&list->contacts[i], end - i);
        if (kept < i) {
            memmove(&list->contacts[kept], &list->contacts[i], n * sizeof *list->contacts);
        }
        kept += n;
    }
    list->pool->used = kept;
}

int step_settle_contacts(struct step *s, bool members)
{
    struct carom_world *w = s->w;
    struct contact_list *list = &w->rest.list;
    int result = CAROM_OK;

    contact_merge(list);
    thin_out(s);
    if (w->config.contact) {
        step_ask_contacts(s, members);
    }
    w->stats.contacts = list->pool->used;
    for (uint32_t i = 0; i < list->pool->used && result == CAROM_OK;) {
        uint16_t pair = list->contacts[i].key.pair;

        result = step_note_touching(s, &w->pairs[pair]);
        i = contact_pair_end(list, pair, i);
    }
    step_mark(w, CAROM_STAGE_CONTACT);
    return result;
}

/* Note where an impact was. The first impact of a pair takes an entry while there is one. */
static void note_details(struct carom_world *w, const struct contact *c, struct carom_event *e)
{
    const struct pair *p = &w->pairs[c->key.pair];
    struct carom_hit *hit;

    if (e->details == 0) {
        e->details = (uint16_t)(pool_take(&w->pools[CAROM_POOL_hits]) + 1);
    }
    if (e->details > 0) {
        hit = &w->hits[e->details - 1];
        hit->point = contact_point(c);
        hit->normal = c->normal;
        hit->face_a = (uint16_t)contact_face(&w->bodies[p->a], &c->key, 0, &c->normal);
        hit->face_b = (uint16_t)contact_face(&w->bodies[p->b], &c->key, 1, &c->normal);
    }
}

/* Make the hardest impact of each pair its hit event. */
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
            if (!step_may_note(w)) {
                continue;
            }
            step_add_event(w, CAROM_EVENT_HIT, p->a, p->b);
        }
        if (-c->speed_q40 > e->speed_q40) {
            e->speed_q40 = -c->speed_q40;
            e->impulse_q40 = rest_along_q40(contact_impulse(c), &c->normal);
            if (w->config.caps.hits > 0) {
                note_details(w, c, e);
            }
        }
    }
}

/* Change of a contact's gap on the present paths up to a time, q22. */
static int64_t gap_change(struct boyse_pair *pair, const struct candidate *c, int32_t t_q30)
{
    struct boyse_touch from, to;

    boyse_touch(pair, c, 0, &from);
    boyse_touch(pair, c, t_q30, &to);
    return (int64_t)(to.sign == from.sign ? to.gap_q22 : -to.gap_q22) - from.gap_q22;
}

/*
 * Opening of a gap, with an allowance for rounding. A lasting contact takes the slowest rate on the
 * way: the turn of a path is fastest at its ends, and a gap that opens at the end may close before.
 */
static int64_t opening(struct boyse_pair *pair, const struct contact *c)
{
    int64_t least_q22 = gap_change(pair, &c->key, CAROM_ONE_Q30);

    if (!c->lasting) {
        return least_q22 + 4;
    }
    for (int part = 2; part <= STEP_SOONEST; part *= 4) {
        int64_t way_q22 = part * gap_change(pair, &c->key, CAROM_ONE_Q30 / part);

        least_q22 = way_q22 < least_q22 ? way_q22 : least_q22;
    }
    return least_q22;
}

/* Bend of a path in the time left, r w^2 / 8, for a spin w. */
static int64_t bend_q22(const struct body *b, int64_t spin_q40, int32_t left_q30)
{
    int64_t turn_q30 = fix_mul(spin_q40, left_q30, 40);

    turn_q30 = turn_q30 < CAROM_ONE_Q30 ? turn_q30 : CAROM_ONE_Q30;
    return fix_mul((turn_q30 * turn_q30) >> 30, b->def.radius_q22, 33);
}

/* Bend of the path of a kinematic body that moves; 0 for others. */
static int64_t led_bend_q22(const struct body *b, int32_t left_q30)
{
    return body_travels(b) ? bend_q22(b, fix_length_bound(b->def.extra->route.spin.c), left_q30)
                           : 0;
}

/*
 * True if a contact's path may bend by more than a small part of the skin. Both bodies' bends add
 * up. A bound on the spins settles it for nearly all.
 */
static bool bends(const struct step *s, const struct contact *c, int32_t left_q30)
{
    int32_t most_q22 = c->skin_q22 / STEP_CHORD_BEND_DIVISOR;
    int64_t all_q22 =
        s->led ? led_bend_q22(&s->w->bodies[s->w->pairs[c->key.pair].b], left_q30) : 0;
    int64_t bound_q22 = all_q22;

    for (int k = 0; k < 2; k++) {
        const struct body *b = c->side[k].body;

        bound_q22 += b ? bend_q22(b, fix_length_bound(b->solve.spin.c), left_q30) : 0;
    }
    for (int k = 0; bound_q22 > most_q22 && k < 2; k++) {
        const struct body *b = c->side[k].body;

        all_q22 += b ? bend_q22(b, fix_length(b->solve.spin.c), left_q30) : 0;
    }
    return all_q22 > most_q22;
}

/* The slice that both bodies of a pair will take, with straight paths over it. */
static int32_t straight_paths(struct step *s, const struct pair *p)
{
    const uint32_t both[2] = {p->a, p->b};
    int32_t slice_q30 = CAROM_ONE_Q30 - s->now_q30;

    for (int k = 0; k < 2; k++) {
        const struct body *b = &s->w->bodies[both[k]];

        if (b->def.moving) { /* a contact that is solved keeps it awake */
            slice_q30 = step_slice(s, both[k], slice_q30);
        } else if (body_travels(b) && b->clock.to_q30 - s->now_q30 < slice_q30) {
            slice_q30 = b->clock.to_q30 - s->now_q30;
        }
    }
    for (int k = 0; k < 2; k++) {
        struct body *b = &s->w->bodies[both[k]];

        if (body_travels(b)) {
            step_look_ahead(s, both[k], slice_q30);
        } else if (step_active(s, both[k]) && b->clock.to_q30 != s->now_q30 + slice_q30) {
            b->clock.to_q30 = s->now_q30 + slice_q30;
            /* what is out of range goes nowhere, and its group took no slice for it */
            if (b->clock.stands || !step_in_range(b, &s->next->bodies[both[k]])) {
                body_place(b, &s->next->bodies[both[k]]);
            } else {
                body_predict(b, &s->next->bodies[both[k]], slice_q30, NULL);
            }
        }
    }
    return slice_q30;
}

/* Drop the paths of the chords: a solve works at their start. */
static void forget_paths(struct step *s)
{
    for (uint32_t i = 0; i < s->w->rest.list.pool->used; i++) {
        const struct contact *c = &s->w->rest.list.contacts[i];

        for (int k = 0; !c->idle && k < 2; k++) {
            if (c->side[k].body) {
                c->side[k].body->clock.to_q30 = s->now_q30;
            }
        }
    }
    for (uint32_t i = 0; s->led && i < s->w->rest.list.pool->used; i++) {
        uint32_t b = s->w->pairs[s->w->rest.list.contacts[i].key.pair].b;

        if (body_travels(&s->w->bodies[b])) {
            step_look_back(s, b);
        }
    }
}

/*
 * Mark a lasting contact. Work on it may cost energy, which the frame gives back in the end
 * (energy.c).
 */
static void note_lasting(struct step *s, struct contact *c)
{
    uint32_t hits = s->w->meetings[c->key.pair].hits;

    c->lasting = hits > (c->gap_q22 <= c->skin_q22 / STEP_CLOSED_DIVISOR ? STEP_CLOSED_HITS
                                                                         : STEP_LASTING_HITS);
    for (int k = 0; c->lasting && k < 2; k++) {
        if (c->side[k].body) {
            c->side[k].body->clock.strained = true;
        }
    }
}

/*
 * Find by how much each gap changes in the next slice. A body that rolls or tips does not keep the
 * V.N that it starts with, as its arm turns and so does its spin. Without this it meets the surface
 * again within the frame, at once if it rolls fast, and uses up its hits.
 */
static void find_chords(struct step *s)
{
    struct carom_world *w = s->w;
    struct contact_list *list = &w->rest.list;
    struct boyse_pair *pair = NULL;
    uint32_t pair_number = UINT32_MAX, asked = UINT32_MAX;
    int32_t slice_q30 = 0;
    bool bent = false;

    rest_load_contacts(&w->rest);
    for (uint32_t i = 0; i < list->pool->used; i++) {
        struct contact *c = &list->contacts[i];
        int64_t way_q22;

        c->chord_q28 = INT32_MAX;
        note_lasting(s, c);
        if (c->idle) {
            continue;
        }
        if (asked != c->key.pair) { /* the answer holds for all contacts of the pair */
            asked = c->key.pair;
            bent = bends(s, c, CAROM_ONE_Q30 - s->now_q30);
        }
        if (!bent) {
            continue;
        }
        if (pair_number != c->key.pair) {
            pair_number = c->key.pair;
            slice_q30 = straight_paths(s, &w->pairs[pair_number]);
            pair = step_set_pair(w, pair_number);
        }
        if (slice_q30 <= (c->lasting ? STEP_LASTING_MIN_Q30 : STEP_CHORD_MIN_Q30)) {
            continue;
        }
        boyse_pair_for(pair, &c->key);
        way_q22 = opening(pair, c);
        if (carom_abs(way_q22) < 1 << 24) {
            c->chord_q28 = rest_clamp(way_q22 * ((int64_t)1 << 26) / (slice_q30 >> 10));
        }
    }
    forget_paths(s);
}

bool step_enter_contact(struct step *s)
{
    struct carom_world *w = s->w;

    if (!rest_enter_contact(&w->rest)) {
        return false;
    }
    for (uint32_t i = 0; i < w->body_count; i++) {
        if (w->bodies[i].clock.contact == BODY_ENTERS) {
            body_accelerate(&w->bodies[i], &s->next->bodies[i], CAROM_ONE_Q30 - s->now_q30);
        }
    }
    rest_load_entered(&w->rest);
    return true;
}

/* True if all bodies are in range after a solve. Those that are not retire. */
static bool all_in_range(const struct step *s)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        if (s->w->bodies[i].def.moving && step_active(s, i) &&
            !step_in_range(&s->w->bodies[i], &s->next->bodies[i])) {
            return false;
        }
    }
    return true;
}

/*
 * Solve until joints hold at the end of the slice as well. *held is false if they do not after
 * STEP_JOINT_ROUNDS.
 */
static int solve_rounds(struct step *s, bool warm, bool first, bool *held)
{
    struct carom_world *w = s->w;

    *held = true;
    for (int round = 0; round < STEP_JOINT_ROUNDS; round++) {
        enum joint_solve solve = s->now_q30 > 0 ? (first ? JOINT_HIT : JOINT_HIT_MORE)
                                                : (first ? JOINT_FRAME : JOINT_MORE);
        int result;

        if (w->joint_steps && !w->joint_steps->measure(s, solve) && round > 0) {
            return CAROM_OK;
        }
        find_chords(s);
        PHASE_BEGIN(w->scratch_phase, WORLD_SOLVE);
        result = rest_solve(&w->rest, CAROM_ONE_Q30 - s->now_q30, warm && first);
        if (result < 0) {
            return result;
        }
        note_hits(s);
        if (!w->joint_steps || !all_in_range(s)) {
            return CAROM_OK;
        }
        first = false;
    }
    *held = false;
    return CAROM_OK;
}

int step_solve(struct step *s, bool warm)
{
    struct carom_world *w = s->w;
    uint32_t impacts = w->rest.impacts;
    bool held;
    int result = solve_rounds(s, warm, true, &held);

    if (!held) { /* a failure ends the rounds before that */
        (void)w->joint_steps->measure(s, s->now_q30 > 0 ? JOINT_HIT_MORE : JOINT_MORE);
        if (w->joint_steps->yield(s)) {
            if (warm) {
                s->anew = true; /* see start */
                return CAROM_OK;
            }
            result = solve_rounds(s, false, false, &held);
        }
    }
    step_mark(w, w->rest.impacts > impacts ? CAROM_STAGE_IMPACT : CAROM_STAGE_REST);
    return result;
}

/*
 * Find the contacts of all pairs at the start of the frame. Sleeping bodies that are touched wake.
 */
static int find_contacts(struct step *s)
{
    struct carom_world *w = s->w;
    int result = CAROM_OK;

    for (uint32_t i = 0; i < w->body_count; i++) {
        w->bodies[i].clock.woke = false;
    }
    for (;;) {
        pool_clear(w->rest.list.pool);
        for (uint32_t n = 0; n < w->pools[CAROM_POOL_pairs].used && result == CAROM_OK; n++) {
            if (step_active(s, w->pairs[n].a) || step_active(s, w->pairs[n].b)) {
                result = step_check_pair(s, n);
            }
        }
        if (result < 0 || !world_wake_touched(w, s->next->bodies)) {
            break;
        }
        result = step_adopt_woken(s);
    }
    return result == CAROM_OK ? step_settle_contacts(s, false) : result;
}

int step_start_contacts(struct step *s)
{
    int result = s->w->pools[CAROM_POOL_pairs].used > 0 ? find_contacts(s) : CAROM_OK;
    struct carom_world *w = s->w;
    bool joints = result == CAROM_OK && w->joint_steps && w->joint_steps->choose_all(s);

    if (result < 0) {
        return result;
    }
    if (w->rest.list.pool->used == 0 || !step_enter_contact(s)) {
        w->rest.warm_count = 0;
        if (!joints) {
            return CAROM_OK;
        }
        for (uint32_t i = 0; i < w->rest.list.pool->used; i++) {
            w->rest.list.contacts[i].idle = true;
        }
    }
    if (joints) {
        (void)w->joint_steps->choose_all(s);
    }
    return step_solve(s, true);
}
