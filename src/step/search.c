/* SPDX-License-Identifier: MIT */
/* The next hit of a pair, in the window that both paths have in common. */
#include "parts.h"

/* Gaps change by less than this through rounding. */
#define NOISE_Q22 4

struct boyse_pair *step_set_pair(struct carom_world *w, uint32_t number)
{
    const struct pair *p = &w->pairs[number];
    struct boyse_pair *pair;

    world_begin_gather(w);
    pair = world_pair(w);
    boyse_pair_begin(pair, &w->bodies[p->a], &w->bodies[p->b]);
    return pair;
}

/* Gap of the features along the normal of the root; *valid is true if they face each other. */
static int32_t gap_by(struct boyse_pair *pair, const struct candidate *c, int8_t sign,
                      int32_t t_q30, bool *valid)
{
    struct boyse_touch touch;

    boyse_touch(pair, c, t_q30, &touch);
    *valid = touch.valid && touch.sign == sign;
    return touch.sign == sign ? touch.gap_q22 : -touch.gap_q22;
}

/*
 * When a hit that takes no time can be solved. It is solved at once if the features face each other
 * and the present motion closes them. The test: an eighth of the way to the root takes at least a
 * sixteenth of the gap. A linear approach takes an eighth, a quadratic one a 64th. Otherwise
 * nothing can be solved yet, and the bodies continue until the features face each other, or until
 * half of the gap is left. Returns that time, or 0.
 */
static int32_t later(struct boyse_pair *pair, const struct candidate *c, int32_t root_q30)
{
    struct boyse_touch root;
    int32_t low = 0, high = root_q30, gap;
    bool valid, there;

    if (high <= 1) {
        return 0;
    }
    boyse_touch(pair, c, high, &root);
    CAROM_ASSERT(root.valid); /* the test that found the root, of the same pair at the same time */
    gap = gap_by(pair, c, root.sign, 0, &valid);
    if (valid && (gap <= pair->skin_q22 / STEP_NEAR_DIVISOR ||
                  gap - gap_by(pair, c, root.sign, high >> 3, &there) > gap / 16 + NOISE_Q22)) {
        return 0;
    }
    for (int round = 0; round < STEP_HALVINGS && high - low > 1; round++) {
        int32_t middle = low + (high - low) / 2;
        int32_t left = gap_by(pair, c, root.sign, middle, &there);

        *((valid ? left >= gap / 2 : !there) ? &low : &high) = middle;
    }
    return valid ? low : high;
}

bool step_put_off(struct boyse_pair *pair, struct boyse_hit *hit)
{
    int32_t t_q30 = hit->t_q30 < STEP_NO_TIME_Q30 ? later(pair, &hit->candidate, hit->root_q30) : 0;
    bool late = t_q30 > hit->t_q30;

    hit->t_q30 = late ? t_q30 : hit->t_q30;
    return late;
}

/*
 * True if a hit comes before the best one so far: in an earlier part of the window, or earlier. If
 * the times are equal, the order of candidates decides.
 */
static bool is_before(const struct step_visitor *v, const struct boyse_hit *hit)
{
    int32_t part = step_part_of(v, hit), best = step_part_of(v, &v->hit);

    if (part != best) {
        return part < best;
    }
    return hit->t_q30 < v->hit.t_q30 || (hit->t_q30 == v->hit.t_q30 &&
                                         candidate_compare(&hit->candidate, &v->hit.candidate) < 0);
}

/* Find the first hit. A sensor is met where the surfaces meet, as its hits have no answer. */
static void visit_first(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    struct step_visitor *v = (struct step_visitor *)self;
    struct boyse_pair *pair = n > 0 ? step_set_pair(v->step->w, v->number) : NULL;
    bool senses = v->step->w->meetings[v->number].senses;

    for (uint32_t i = 0; i < n; i++) {
        struct boyse_hit hit;

        boyse_pair_for(pair, &c[i]);
        if (!boyse_first(pair, &c[i], &hit, &v->step->w->stats.roots)) {
            continue;
        }
        hit.candidate = c[i];
        if (senses) {
            hit.t_q30 = hit.root_q30;
        }
        hit.touch.valid = !senses && step_put_off(pair, &hit);
        if (!v->found || is_before(v, &hit)) {
            v->hit = hit;
            v->found = true;
        }
    }
}

bool step_stay_apart(const struct step *s, uint32_t number, int64_t more_q22)
{
    const struct pair *p = &s->w->pairs[number];
    const struct body *a = &s->w->bodies[p->a], *b = &s->w->bodies[p->b];
    int64_t reach_q22 = (int64_t)a->def.radius_q22 + b->def.radius_q22 + more_q22, apart[3];
    const struct body_path *path_a = body_path(a), *path_b = body_path(b);

    /* the way is rounded up; a sphere's turn does not matter */
    for (int k = 0; k < 3; k++) {
        int64_t way_q40 = carom_abs(path_a->v.c[k] - path_b->v.c[k]) + carom_abs(path_a->g.c[k]) +
                          carom_abs(path_b->g.c[k]);

        apart[k] = carom_abs(path_a->origin_q22[k] - path_b->origin_q22[k]) - (way_q40 >> 18) - 2;
        if (apart[k] > reach_q22) {
            return true;
        }
        apart[k] = apart[k] > 0 ? apart[k] : 0;
    }
    /* each is below 2^35: centres are at most 2^13 units apart, but here below the reach */
    return apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2] > reach_q22 * reach_q22;
}

int step_first_hit(struct step *s, uint32_t number, struct step_visitor *v)
{
    return step_visit(s, number, v, visit_first);
}

/* Number of parts such that both paths together turn by at most 1 / `fine` radians in each. */
static int64_t parts_of_turn(const struct body *a, const struct body *b, int64_t fine)
{
    const struct body_path *path_a = body_path(a), *path_b = body_path(b);
    int64_t u2_q30 = (path_a->turns ? path_a->u2_q30 : 0) + (path_b->turns ? path_b->u2_q30 : 0);
    int64_t turn_q30;

    /* a turn is 2 |u|, and the square of a sum of two is at most twice the sum of the squares */
    if (u2_q30 * 8 * fine * fine <= CAROM_ONE_Q30 || !step_many_faces(a, b)) {
        return 1;
    }
    turn_q30 = path_a->turns ? 2 * (int64_t)fix_sqrt((uint64_t)path_a->u2_q30 << 30) : 0;
    turn_q30 += path_b->turns ? 2 * (int64_t)fix_sqrt((uint64_t)path_b->u2_q30 << 30) : 0;
    return ((turn_q30 * fine) >> 30) + 1;
}

/*
 * Number of parts of a window. In each, the bodies pass by at most half of the smaller one's
 * radius, and turn so little that there are few candidates.
 */
static FIX_OWN_FRAME int32_t parts_of(const struct step *s, const struct pair *p, int32_t time_q30)
{
    const struct body *a = &s->w->bodies[p->a], *b = &s->w->bodies[p->b];
    int32_t radius_q22 =
        (b->def.goes && b->def.radius_q22 < a->def.radius_q22 ? b : a)->def.radius_q22;
    const struct body_path *path_a = body_path(a), *path_b = body_path(b);
    int64_t way_q40 = 0, parts, parts_turn = parts_of_turn(a, b, STEP_TURN_PARTS);

    for (int k = 0; k < 3; k++) {
        way_q40 += carom_abs(path_a->v.c[k] - path_b->v.c[k]);
    }
    parts = (way_q40 >> 17) / radius_q22 + 1;
    parts = parts > parts_turn ? parts : parts_turn;
    parts = parts < STEP_PARTS_MAX ? parts : STEP_PARTS_MAX;
    return parts < time_q30 >> 12 ? (int32_t)parts : 1;
}

int32_t step_parts(const struct step *s, uint32_t number)
{
    const struct pair *p = &s->w->pairs[number];
    const struct body *a = &s->w->bodies[p->a], *b = &s->w->bodies[p->b];

    return a->clock.contact != BODY_FLIES || b->clock.contact != BODY_FLIES
               ? 1
               : (int32_t)parts_of_turn(a, b, STEP_KEPT_TURN_PARTS);
}

/*
 * Find the first hit in a part of the window; its times become those of the whole window. If there
 * is only one part, its window is open already.
 */
static int search_part(struct step *s, uint32_t number, struct step_visitor *v, int32_t part,
                       int32_t parts)
{
    int32_t from_q30 = v->from_q30, to_q30 = v->to_q30, time_q30 = to_q30 - from_q30;
    int result = CAROM_OK;

    v->from_q30 = from_q30 + (int32_t)((int64_t)time_q30 * part / parts);
    v->to_q30 = from_q30 + (int32_t)((int64_t)time_q30 * (part + 1) / parts);
    v->parts = parts > 1 ? 1 : step_parts(s, number);
    if (parts > 1) {
        step_open_window(s, number, v->from_q30, v->to_q30);
    }
    v->found = false;
    if (!step_stay_apart(s, number, 0)) {
        result = step_first_hit(s, number, v);
    }
    if (v->found) {
        v->hit_q30 =
            v->from_q30 + (int32_t)(((int64_t)(v->to_q30 - v->from_q30) * v->hit.t_q30) >> 30);
        v->hit.root_q30 = (int32_t)((((int64_t)part << 30) + v->hit.root_q30) / parts);
    }
    if (parts > 1) {
        step_close_window(s, number, v->from_q30, v->to_q30);
    }
    v->from_q30 = from_q30;
    v->to_q30 = to_q30;
    return result;
}

/* Upper bound on how far points of two bodies approach each other on their paths. */
static int64_t way_together_q22(const struct body *a, const struct body *b)
{
    const struct body_path *path_a = body_path(a), *path_b = body_path(b);
    int64_t way_q40 = 0, turn_a_q30 = 0, turn_b_q30 = 0;

    for (int k = 0; k < 3; k++) {
        way_q40 += carom_abs(path_a->v.c[k] - path_b->v.c[k]) + carom_abs(path_a->g.c[k]) +
                   carom_abs(path_b->g.c[k]);
        turn_a_q30 += carom_abs(path_a->u.c[k]);
        turn_b_q30 += carom_abs(path_b->u.c[k]);
    }
    return (way_q40 >> 18) + (turn_a_q30 * a->def.radius_q22 >> 29) +
           (turn_b_q30 * b->def.radius_q22 >> 29) + 3;
}

/*
 * True if the bodies of a pair cannot meet on paths that begin with the frame: they go less far
 * than the clearance that the static check measured.
 */
static FIX_OWN_FRAME bool stays_clear(const struct step *s, uint32_t number)
{
    const struct pair_work *m = &s->w->meetings[number];
    const struct body *a = &s->w->bodies[s->w->pairs[number].a];
    const struct body *b = &s->w->bodies[s->w->pairs[number].b];

    return m->kept && m->clear > 0 &&
           way_together_q22(a, b) * 16 <
               (int64_t)m->clear * fix_larger(a->def.skin_q22, b->def.skin_q22);
}

int step_search(struct step *s, uint32_t number)
{
    struct pair_work *m = &s->w->meetings[number];
    struct step_visitor v = {.found = false};
    int32_t parts;
    int result = CAROM_OK;

    m->hit_q30 = PAIRS_NEVER;
    if (m->passes || !step_window(s, number, &v.from_q30, &v.to_q30)) {
        return CAROM_OK;
    }
    step_drop_part(m, v.to_q30);
    if ((m->kept && m->count == 0) || (v.from_q30 == 0 && stays_clear(s, number))) {
        return CAROM_OK;
    }
    step_open_window(s, number, v.from_q30, v.to_q30);
    parts = step_stay_apart(s, number, 0)
                ? 0
                : parts_of(s, &s->w->pairs[number], v.to_q30 - v.from_q30);
    if (parts != 1) {
        step_close_window(s, number, v.from_q30, v.to_q30);
    }
    for (int32_t part = 0; part < parts && !v.found && result == CAROM_OK; part++) {
        result = search_part(s, number, &v, part, parts);
    }
    if (parts == 1) {
        step_close_window(s, number, v.from_q30, v.to_q30);
    }
    if (result == CAROM_OK && v.found) {
        m->hit_q30 = v.hit_q30;
        m->root_q30 = v.hit.root_q30;
        m->late = v.hit.touch.valid ? 1 : 0;
        m->kind = (uint32_t)v.hit.candidate.kind & 3;
        m->i = v.hit.candidate.i;
        m->j = v.hit.candidate.j;
    }
    return result;
}

int step_search_members(struct step *s)
{
    const struct carom_world *w = s->w;
    int result = CAROM_OK;

    for (uint32_t n = 0; n < w->pools[CAROM_POOL_pairs].used && result == CAROM_OK; n++) {
        if (w->bodies[w->pairs[n].a].clock.member || w->bodies[w->pairs[n].b].clock.member) {
            result = step_search(s, n);
        }
    }
    step_mark(s->w, CAROM_STAGE_BOYSE);
    return result;
}

enum step_event step_next(const struct step *s, uint32_t *number)
{
    const struct carom_world *w = s->w;
    enum step_event event = STEP_END;
    int32_t first_q30 = CAROM_ONE_Q30;

    for (uint32_t n = 0; n < w->pools[CAROM_POOL_pairs].used; n++) {
        if (w->meetings[n].hit_q30 < first_q30) {
            first_q30 = w->meetings[n].hit_q30;
            *number = n;
            event = STEP_HIT;
        }
    }
    for (uint32_t i = 0; i < w->body_count; i++) {
        if (step_active(s, i) && w->bodies[i].clock.to_q30 < first_q30) {
            first_q30 = w->bodies[i].clock.to_q30;
            *number = i;
            event = STEP_SLICE;
        }
    }
    return event;
}
