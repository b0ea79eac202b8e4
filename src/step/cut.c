/* SPDX-License-Identifier: MIT */
/*
 * Paths set again so that they end at a hit. The turn over a part of a slice is not that part of
 * the whole turn, and a body has its energy back only at the end of a path.
 */
#include "parts.h"

/* True if a body's path turns and continues after the hit. Routes are not cut. */
static bool turns_on(const struct step *s, uint32_t i, int32_t t_q30)
{
    const struct body *b = &s->w->bodies[i];

    return b->def.moving && step_active(s, i) && !b->clock.stands &&
           b->clock.contact == BODY_FLIES && b->path.turns && b->def.joined == BODY_ALONE &&
           b->clock.cuts < STEP_CUTS_MAX && body_norm2_q30(&b->path) >= STEP_CUT_TURN2_MIN_Q30 &&
           b->clock.to_q30 - t_q30 > STEP_END_Q30 && t_q30 - b->clock.from_q30 >= STEP_CUT_MIN_Q30;
}

/*
 * True if no body near it has begun a path since its own path began: pairs with an earlier path of
 * that body could not be searched again. Near means that the spheres around both may meet, whatever
 * the regions are.
 */
static bool may_cut(const struct step *s, uint32_t i)
{
    const struct carom_world *w = s->w;
    const struct body *b = &w->bodies[i];
    int64_t way_q22, other_q22, turn_q30;

    body_path_length(b, CAROM_ONE_Q30, &way_q22, &turn_q30);
    for (uint32_t k = 0; k < w->body_count; k++) {
        const struct body *c = &w->bodies[k];
        bool near = true;

        if (k == i || !step_active(s, k) || c->clock.from_q30 <= b->clock.from_q30 ||
            !broad_may_touch(b, c)) {
            continue;
        }
        body_path_length(c, CAROM_ONE_Q30, &other_q22, &turn_q30);
        for (int axis = 0; axis < 3; axis++) {
            near = near && carom_abs(b->path.origin_q22[axis] - c->path.origin_q22[axis]) <=
                               b->def.radius_q22 + c->def.radius_q22 + way_q22 + other_q22;
        }
        if (near) {
            return false;
        }
    }
    return true;
}

/* Set the path of a body again so that it ends at a time. */
static int set_end(struct step *s, uint32_t i, int32_t to_q30)
{
    struct body *b = &s->w->bodies[i];
    int32_t slice_q30 = to_q30 - b->clock.from_q30;

    b->clock.to_q30 = to_q30;
    body_predict(b, &s->next->bodies[i], slice_q30, &b->def.acceleration);
    return body_region_holds(b, slice_q30) ? CAROM_OK : step_set_region(s, i, slice_q30);
}

/* Set the paths of the bodies that are cut, and search their pairs. */
static int set_ends(struct step *s, const struct pair *p, const bool cut[2],
                    const int32_t to_q30[2])
{
    const uint32_t both[2] = {p->a, p->b};
    int result = CAROM_OK;

    for (uint32_t i = 0; i < s->w->body_count; i++) {
        s->w->bodies[i].clock.member = (cut[0] && i == p->a) || (cut[1] && i == p->b);
    }
    for (int k = 0; k < 2 && result == CAROM_OK; k++) {
        if (cut[k]) {
            result = set_end(s, both[k], to_q30[k]);
        }
    }
    return result == CAROM_OK ? step_search_members(s) : result;
}

/* True if a pair of a member hits before the last event. */
static bool hits_in_the_past(const struct step *s)
{
    const struct carom_world *w = s->w;

    for (uint32_t n = 0; n < w->pools[CAROM_POOL_pairs].used; n++) {
        if ((w->bodies[w->pairs[n].a].clock.member || w->bodies[w->pairs[n].b].clock.member) &&
            w->meetings[n].hit_q30 < s->now_q30 && !w->meetings[n].senses) {
            return true;
        }
    }
    return false;
}

static int32_t gap_at(struct boyse_pair *pair, const struct candidate *c, int32_t t_q30)
{
    struct boyse_touch touch;

    boyse_touch(pair, c, t_q30, &touch);
    return touch.valid ? touch.gap_q22 : INT32_MAX;
}

/*
 * Find the hit of a pair at the end of paths that were cut there. Such paths have no root before
 * their end as a rule, and at the end the features are at the event gap or very near it: then that
 * is the hit. A path that ends nearer is left where the gap is a quarter of the skin, or as large
 * as at its start if that is less. A gap that opened is no hit, however small it was.
 */
static FIX_OWN_FRAME void meet_at_end(struct step *s, uint32_t number, int32_t from_q30,
                                      int32_t to_q30)
{
    struct pair_work *m = &s->w->meetings[number];
    const struct candidate c = {(uint16_t)number, m->kind, m->i, m->j};
    int32_t low = 0, high = CAROM_ONE_Q30, start, least, end;
    struct boyse_pair *pair;

    step_open_window(s, number, from_q30, to_q30);
    pair = step_set_pair(s->w, number);
    boyse_pair_for(pair, &c);
    end = gap_at(pair, &c, high);
    start = gap_at(pair, &c, 0);
    least = start < pair->skin_q22 / 4 ? start : pair->skin_q22 / 4;
    for (int round = 0; round < 12 && end < least; round++) {
        int32_t middle = low + (high - low) / 2;

        *(gap_at(pair, &c, middle) >= least ? &low : &high) = middle;
    }
    if (end <= pair->skin_q22 / 2 + pair->skin_q22 / 32 && end <= start) {
        low = end < least ? low : CAROM_ONE_Q30;
        m->hit_q30 = from_q30 + (int32_t)(((int64_t)(to_q30 - from_q30) * low) >> 30);
        m->root_q30 = CAROM_ONE_Q30;
        m->late = false;
    }
    step_close_window(s, number, from_q30, to_q30);
}

/* Give a pair the hit that it had. */
static void restore_hit(struct pair_work *m, const struct pair_work *was)
{
    m->hit_q30 = was->hit_q30;
    m->root_q30 = was->root_q30;
    m->kind = was->kind;
    m->i = was->i;
    m->j = was->j;
    m->late = was->late;
}

int step_cut(struct step *s, uint32_t number, bool *tried)
{
    const struct pair p = s->w->pairs[number];
    const struct pair_work was = s->w->meetings[number];
    struct body *a = &s->w->bodies[p.a], *b = &s->w->bodies[p.b];
    const bool cut[2] = {turns_on(s, p.a, was.hit_q30), turns_on(s, p.b, was.hit_q30)};
    const int32_t ends_q30[2] = {was.hit_q30, was.hit_q30},
                  old_q30[2] = {a->clock.to_q30, b->clock.to_q30};
    int32_t from_q30, to_q30;
    bool good;
    int result;

    *tried = false;
    if (!(cut[0] | cut[1])) {
        return CAROM_OK;
    }
    if ((cut[0] && !may_cut(s, p.a)) || (cut[1] && !may_cut(s, p.b))) {
        return CAROM_OK;
    }
    *tried = true;
    s->w->stats.refinements++;
    result = set_ends(s, &p, cut, ends_q30);
    if (result < 0) {
        return result;
    }
    good = !hits_in_the_past(s);
    if (!good) {
        result = set_ends(s, &p, cut, old_q30); /* paths that have been searched before */
    }
    a->clock.cuts = cut[0] ? (uint8_t)(good ? a->clock.cuts + 1 : STEP_CUTS_MAX) : a->clock.cuts;
    b->clock.cuts = cut[1] ? (uint8_t)(good ? b->clock.cuts + 1 : STEP_CUTS_MAX) : b->clock.cuts;
    number = step_find_pair(s->w, &p);
    if (number == UINT32_MAX) {
        return result;
    }
    if (!good) {
        restore_hit(&s->w->meetings[number], &was);
    } else if (s->w->meetings[number].hit_q30 == PAIRS_NEVER &&
               step_window(s, number, &from_q30, &to_q30)) {
        restore_hit(&s->w->meetings[number], &was);
        s->w->meetings[number].hit_q30 = PAIRS_NEVER;
        meet_at_end(s, number, from_q30, to_q30);
    }
    return result;
}
