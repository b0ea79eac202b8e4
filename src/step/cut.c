/* SPDX-License-Identifier: MIT */
/*
 * Paths that are set again for the hit they lead to. The turn over a part of a slice is not a part of
 * the turn over the whole, and only at the end of a path has a body the energy that it had before.
 */
#include "parts.h"

/* A path is set again so often at most, */
#define CUTS_MAX 8
/* and not for so little of its end. */
#define END_Q30 2
/* Nor is so short a one: its turn is below the last place of a rotation. */
#define SLICE_MIN_Q30 (1 << 10)
/*
 * Nor one that hardly turns, by less than 2^-10: its energy is right to 2^-20, and rotations to so few
 * digits that slice after slice would lose the turn that features face each other by.
 */
#define TURN2_MIN_Q30 (1 << 8)

/* Whether a body's path turns and goes on behind a hit; a route stays as it is. */
static bool turns_on(const struct step *s, uint32_t i, int32_t t_q30)
{
    const struct body *b = &s->w->bodies[i];

    return b->def.moving && step_active(s, i) && !b->clock.stands && !b->clock.in_contact &&
           b->path.turns && b->def.joined == BODY_ALONE && b->clock.cuts < CUTS_MAX &&
           body_norm2_q30(&b->path) >= TURN2_MIN_Q30 && b->clock.to_q30 - t_q30 > END_Q30 &&
           t_q30 - b->clock.from_q30 >= SLICE_MIN_Q30;
}

/*
 * Whether nobody near the body has had a path since its own began: with one that has gone by now it could
 * not be asked again. Near is what the spheres around both may reach, whatever the regions.
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

/* Set the path of a body again to end at a time. */
static int set_end(struct step *s, uint32_t i, int32_t to_q30)
{
    struct body *b = &s->w->bodies[i];
    int32_t slice_q30 = to_q30 - b->clock.from_q30;

    b->clock.to_q30 = to_q30;
    body_predict(b, &s->next->bodies[i], slice_q30, &b->def.acceleration);
    return body_region_holds(b, slice_q30) ? CAROM_OK : step_set_region(s, i, slice_q30);
}

/* Set the paths of those bodies of a pair that are to be cut, and search for all that these meet. */
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

/* Whether any pair of the members hits before the last event. */
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

static int32_t gap_at(const struct boyse_pair *pair, const struct candidate *c, int32_t t_q30)
{
    struct boyse_touch touch;

    boyse_touch(pair, c, t_q30, &touch);
    return touch.valid ? touch.gap_q22 : INT32_MAX;
}

/*
 * Paths that end at a hit have no root before their end as a rule, and the features are at the event
 * gap there, or as near as makes no difference: then that is the hit. A path that ends nearer is left
 * where a quarter of the skin, or what there was at its start, is left of the gap. A gap that has opened
 * is no hit, however near it was.
 */
static void meet_at_end(struct step *s, uint32_t number, int32_t from_q30, int32_t to_q30)
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

/* The hit that a pair had. */
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
    if ((!cut[0] && !cut[1]) || (cut[0] && !may_cut(s, p.a)) || (cut[1] && !may_cut(s, p.b))) {
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
        result = set_ends(s, &p, cut, old_q30); /* those that were asked */
    }
    a->clock.cuts = cut[0] ? (uint8_t)(good ? a->clock.cuts + 1 : CUTS_MAX) : a->clock.cuts;
    b->clock.cuts = cut[1] ? (uint8_t)(good ? b->clock.cuts + 1 : CUTS_MAX) : b->clock.cuts;
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
