/* SPDX-License-Identifier: MIT */
/* The moving part of a step: candidates for the rest of the frame, paths, first hit, advance. */
#include "world_step_parts.h"

#define REFINEMENTS 8
/* Less than a thousandth of a frame is no time to go on for. */
#define SLICE_MIN_Q30 (1 << 20)
#ifndef REGION_WAY
#define REGION_WAY      10
#define REGION_TURN_Q30 (CAROM_ONE_Q30 / 10)
#endif
/* What the gap of features changes by at most through rounding. */
#define CHANGES_Q22 4

void step_mark(struct carom_world *w, enum carom_stage stage)
{
    if (w->config.ticks) {
        uint32_t now = w->config.ticks();

        w->stats.ticks[stage] += now - w->mark_tick;
        w->mark_tick = now;
    }
}

void step_select_pair(struct step_visitor *v, uint16_t number)
{
    if (v->pair_number != number) {
        const struct pair *p = &v->step->w->pairs[number];

        boyse_pair_init(&v->pair, &v->step->w->bodies[p->a], &v->step->w->bodies[p->b]);
        v->pair_number = number;
    }
}

int step_visit(struct step *s, struct step_visitor *v,
               void (*f)(struct candidate_visitor *, const struct candidate *, uint32_t))
{
    struct carom_world *w = s->w;
    int result;

    v->base.visit = f;
    v->step = s;
    v->pair_number = -1;
    v->found = false;
    v->error = CAROM_OK;
    result = interfere_visit(&w->interfere, w->bodies, w->pairs, w->pools[CAROM_POOL_pairs].used,
                             &v->base);
    return v->error ? v->error : result;
}

static void visit_nothing(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    (void)self;
    (void)c;
    (void)n;
}

void step_place_all(struct step *s)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        struct body *b = &s->w->bodies[i];

        if (b->mesh && !b->standing) {
            body_place(b, &s->next->bodies[i]);
        }
    }
    s->path_q30 = 0;
}

static void predict_all(struct step *s, int32_t tau_q30)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        struct body *b = &s->w->bodies[i];

        b->standing = b->standing && !broad_active(b, &s->next->bodies[i]);
        if (b->mesh && !b->standing) {
            body_predict(b, &s->next->bodies[i], tau_q30, b->in_contact ? NULL : &b->acceleration);
        }
    }
    s->path_q30 = tau_q30;
}

/*
 * Candidates are gathered for the paths at hand, and for what differs from them by no more than some
 * skins, the fall of a frame (whether contacts will take it up is not known yet) and a part of the
 * way. A hit that turns a body aside by more asks for others.
 */
static void set_regions(struct step *s, int32_t slice_q30, int64_t time_q30)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        struct body *b = &s->w->bodies[i];
        int64_t way_q22, turn_q30, room_q22 = 0;

        if (!b->mesh || b->standing) {
            continue;
        }
        if (broad_active(b, &s->next->bodies[i])) {
            body_path_length(b, CAROM_ONE_Q30, &way_q22, &turn_q30);
            room_q22 = 10 * (int64_t)b->skin_q22 + (b->acceleration_q40 >> 18) + way_q22 / 16;
        }
        room_q22 += mesh_drift_most(b->mesh); /* contacts are looked for so much farther away */
        body_region_begin(b, &s->next->bodies[i], slice_q30, time_q30, (int32_t)room_q22);
        b->region.active = broad_active(b, &s->next->bodies[i]);
    }
}

/* Pairs, interfering faces and candidates for the paths at hand, which take slice_q30 of a frame. */
static int gather(struct step *s, int32_t slice_q30, int64_t time_q30)
{
    struct carom_world *w = s->w;
    struct step_visitor v;
    int result;

    set_regions(s, slice_q30, time_q30);
    step_mark(w, CAROM_STAGE_PREDICT);
    result = broad_pairs(w->pairs, &w->pools[CAROM_POOL_pairs], w->bodies, s->next->bodies,
                         w->body_count);
    for (uint32_t i = 0; i < w->body_count; i++) {
        struct body *b = &w->bodies[i];

        b->standing = !broad_active(b, &s->next->bodies[i]);
        if (!b->standing && w->pools[CAROM_POOL_pairs].used > 0) {
            body_region_end(b);
        }
    }
    step_mark(w, CAROM_STAGE_BROAD);
    if (result < 0) {
        return result;
    }
    if (w->interfere.gathers == 0) {
        pool_clear(&w->pools[CAROM_POOL_faces]);
    }
    interfere_begin(&w->interfere);
    result = step_visit(s, &v, visit_nothing);
    step_mark(w, CAROM_STAGE_INTERFERE);
    return result;
}

/*
 * For how long to gather: frames at a time while nothing moves fast, for what is swept grows with
 * the time. As long as the last regions held, and twice that when they held all their time.
 */
static int64_t gather_time(const struct step *s, int32_t slice_q30)
{
    int64_t frames = 1, held_q30 = 0;

    if (slice_q30 < s->left_q30 || slice_q30 < SLICE_MIN_Q30) {
        return slice_q30;
    }
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        const struct body_region *region = &s->w->bodies[i].region;

        if (region->active && region->elapsed_q30 > held_q30) {
            held_q30 = region->elapsed_q30;
            frames = (held_q30 >> 30) +
                     (region->time_q30 - held_q30 < CAROM_ONE_Q30 ? (held_q30 >> 30) + 1 : 0);
        }
    }
    if (frames < 1)
        frames = 1;
    if (frames > BODY_REGION_FRAMES)
        frames = BODY_REGION_FRAMES;
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        const struct body *b = &s->w->bodies[i];
        int64_t way_q22, turn_q30;

        if (!broad_active(b, &s->next->bodies[i])) {
            continue;
        }
        body_path_length(b, CAROM_ONE_Q30, &way_q22, &turn_q30);
        way_q22 = (way_q22 << 30) / slice_q30;
        turn_q30 = (turn_q30 << 30) / slice_q30;
        while (frames > 1 && (frames * turn_q30 > REGION_TURN_Q30 ||
                              frames * way_q22 > b->radius_q22 / REGION_WAY)) {
            frames--;
        }
    }
    return s->left_q30 + ((frames - 1) << 30);
}

int step_gather(struct step *s)
{
    int32_t slice_q30 = step_slice(s);

    predict_all(s, slice_q30);
    return gather(s, slice_q30, gather_time(s, slice_q30));
}

uint16_t step_pair_number(const struct carom_world *w, const struct pair *p)
{
    uint16_t n = 0;

    while (w->pairs[n].a != p->a || w->pairs[n].b != p->b) {
        n++;
        CAROM_ASSERT(n < w->pools[CAROM_POOL_pairs].used);
    }
    return n;
}

/* Whether a body may leave the region on its path. */
static bool leaves_region(const struct step *s, int32_t slice_q30)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        const struct body *b = &s->w->bodies[i];

        if (b->region.active != broad_active(b, &s->next->bodies[i]) ||
            (b->region.active && !body_region_holds(b, slice_q30))) {
            return true;
        }
    }
    return false;
}

/* Set shorter paths than those of the region, which the hit at hand led to. */
static int predict_hit(struct step *s, int32_t slice_q30)
{
    const struct pair p = s->w->pairs[s->hit.candidate.pair];
    int result = CAROM_OK;

    predict_all(s, slice_q30);
    if (leaves_region(s, slice_q30)) {
        result = gather(s, slice_q30, slice_q30);
        if (result == CAROM_OK) {
            s->hit.candidate.pair = step_pair_number(s->w, &p);
        }
    }
    return result;
}

int step_gather_first(struct step *s)
{
    struct interfere *in = &s->w->interfere;

    if (!in->stale && in->whole) {
        step_place_all(s);
        if (!leaves_region(s, 0)) {
            in->candidate_count = in->candidate_pool->used;
            return CAROM_OK;
        }
    }
    return step_gather(s);
}

int32_t step_slice(const struct step *s)
{
    int32_t slice_q30 = s->left_q30;

    for (uint32_t i = 0; i < s->w->body_count; i++) {
        if (broad_active(&s->w->bodies[i], &s->next->bodies[i])) {
            slice_q30 = body_slice(&s->w->bodies[i], &s->next->bodies[i], slice_q30);
        }
    }
    return slice_q30;
}

int step_predict(struct step *s, int32_t *slice_q30)
{
    int result = CAROM_OK;

    *slice_q30 = s->path_q30 > 0 ? s->path_q30 : step_slice(s);
    if (s->path_q30 == 0) {
        predict_all(s, *slice_q30);
        if (leaves_region(s, *slice_q30)) {
            result = step_gather(s);
        }
    }
    step_mark(s->w, CAROM_STAGE_PREDICT);
    return result;
}

/* The earliest hit; equal times go to the first in the order of candidates. */
static void visit_first_hit(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    struct step_visitor *v = (struct step_visitor *)self;
    struct boyse_hit *best = &v->step->hit;

    for (uint32_t i = 0; i < n; i++) {
        struct boyse_hit hit;

        step_select_pair(v, c[i].pair);
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

int step_first_hit(struct step *s, bool *found)
{
    struct step_visitor v;
    int result = step_visit(s, &v, visit_first_hit);

    *found = v.found;
    if (v.found) {
        step_select_pair(&v, s->hit.candidate.pair);
        boyse_touch(&v.pair, &s->hit.candidate, s->hit.root_q30, &s->hit.touch);
    }
    step_mark(s->w, CAROM_STAGE_BOYSE);
    return result;
}

void step_advance(struct step *s, int32_t t_q30, int32_t slice_q30)
{
    s->left_q30 -= (int32_t)(((int64_t)slice_q30 * t_q30) >> 30);
    s->path_q30 = 0;
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        struct body *b = &s->w->bodies[i];

        if (!broad_active(b, &s->next->bodies[i])) {
            continue;
        }
        body_region_advance(b, t_q30, slice_q30);
        body_advance(b, &s->next->bodies[i], t_q30, slice_q30,
                     b->in_contact ? NULL : &b->acceleration);
    }
    step_mark(s->w, CAROM_STAGE_ADVANCE);
}

/* The gap of the hit's features at a time of the paths; INT32_MAX when they do not face there. */
static int32_t gap_at(const struct boyse_pair *pair, const struct candidate *c, int32_t t_q30)
{
    struct boyse_touch touch;

    boyse_touch(pair, c, t_q30, &touch);
    return touch.valid ? touch.gap_q22 : INT32_MAX;
}

/*
 * A path that was set up again may end nearer than the hit was to stop. The time at which to leave
 * it: its end, unless less than half of the event gap is left there and less than at its start.
 */
static int32_t leave_at(const struct step *s)
{
    const struct carom_world *w = s->w;
    const struct candidate *c = &s->hit.candidate;
    const struct pair *p = &w->pairs[c->pair];
    int32_t low = 0, high = CAROM_ONE_Q30, least;
    struct boyse_pair pair;

    boyse_pair_init(&pair, &w->bodies[p->a], &w->bodies[p->b]);
    least = gap_at(&pair, c, 0);
    least = least < pair.skin_q22 / 4 ? least : pair.skin_q22 / 4;
    if (gap_at(&pair, c, high) >= least) {
        return high;
    }
    for (int round = 0; round < 12; round++) {
        int32_t middle = low + (high - low) / 2;

        *(gap_at(&pair, c, middle) >= least ? &low : &high) = middle;
    }
    return low;
}

/*
 * A path that was set up again may end before the hit, as the turn of a body with three different
 * sides bends. The slice at whose end the gap is the event gap, by the rate at which it closes
 * there; the same slice when that is not worth a round, and never more than `most`.
 */
static int32_t lengthen(const struct step *s, int32_t slice_q30, int32_t most_q30)
{
    const struct carom_world *w = s->w;
    const struct candidate *c = &s->hit.candidate;
    const struct pair *p = &w->pairs[c->pair];
    struct boyse_pair pair;
    int64_t wanted, end, before, longer_q30;

    boyse_pair_init(&pair, &w->bodies[p->a], &w->bodies[p->b]);
    wanted = pair.skin_q22 / 2;
    end = gap_at(&pair, c, CAROM_ONE_Q30);
    before = gap_at(&pair, c, CAROM_ONE_Q30 - CAROM_ONE_Q30 / 64);
    if (end == INT32_MAX || before == INT32_MAX || before <= end || end <= wanted + wanted / 16) {
        return slice_q30;
    }
    longer_q30 = slice_q30 + slice_q30 / 64 * (end - wanted) / (before - end);
    return longer_q30 < most_q30 ? (int32_t)longer_q30 : most_q30;
}

/* How much the gap of a candidate's features changes on the first 1/2^bits of the paths. */
static int64_t gap_change(const struct step *s, const struct candidate *c, int bits)
{
    const struct carom_world *w = s->w;
    const struct pair *p = &w->pairs[c->pair];
    struct boyse_pair pair;
    int64_t start;

    boyse_pair_init(&pair, &w->bodies[p->a], &w->bodies[p->b]);
    start = gap_at(&pair, c, 0);
    return gap_at(&pair, c, CAROM_ONE_Q30 >> bits) - start;
}

/*
 * Whether the start of the paths closes the gap of the hit's features by more than twice as much as
 * a path of its own does in that time, a 64th of the slice. Sets the paths of the slice.
 */
static int only_path_closes(struct step *s, int32_t slice_q30, bool *only)
{
    int result = predict_hit(s, slice_q30);
    int64_t part = gap_change(s, &s->hit.candidate, 6);

    *only = false;
    if (result == CAROM_OK && part < -CHANGES_Q22) {
        result = predict_hit(s, slice_q30 >> 6);
        *only = 2 * gap_change(s, &s->hit.candidate, 0) > part;
    }
    return result;
}

/* Whether some time passes on the way to the hit. */
static bool takes_time(int32_t slice_q30, int32_t t_q30)
{
    return ((int64_t)slice_q30 * t_q30) >> 30 >= SLICE_MIN_Q30;
}

/*
 * A hit at the start of the paths. The turn of a path is that of its middle: features that open as
 * the bodies move now may close at the start of a long path, and there is nothing to be solved then.
 * Sets the paths of the longest of some shorter slices on which it is gone, if it is the path that
 * closes, or they open there, and they do not come too near on the way. Then s->hit is the first hit on those paths, if there is one: found.
 */
static int shorten(struct step *s, int32_t *slice_q30, bool *gone, bool *found)
{
    int32_t shorter_q30 = *slice_q30 >> 2;
    bool only;
    int result = only_path_closes(s, *slice_q30, &only);
    struct boyse_hit hit = s->hit;

    for (*gone = false; shorter_q30 > SLICE_MIN_Q30 && result == CAROM_OK; shorter_q30 >>= 2) {
        s->hit = hit;
        result = predict_hit(s, shorter_q30);
        hit = s->hit; /* its pair may have a new number */
        if (result < 0 || leave_at(s) < CAROM_ONE_Q30 ||
            !(only || gap_change(s, &hit.candidate, 0) > CHANGES_Q22)) {
            continue;
        }
        result = step_first_hit(s, found);
        s->w->stats.refinements++;
        if (result == CAROM_OK && (!*found || takes_time(shorter_q30, s->hit.t_q30))) {
            *slice_q30 = shorter_q30;
            *gone = true;
            return result;
        }
    }
    s->hit = hit;
    return result;
}

/*
 * The paths that end at the hit, and the time to leave them. The turn of a shorter slice is not a
 * part of the turn of the longer one, so the path is set up again for the slice that ends at the hit
 * until it no longer hits on the way: only then does the rotation keep its energy. The last path may
 * still have to be left short of its end.
 */
static int refine(struct step *s, int32_t *slice, int32_t *t)
{
    int32_t t_q30 = CAROM_ONE_Q30, most_q30 = *slice;
    int32_t slice_q30 = (int32_t)(((int64_t)most_q30 * s->hit.t_q30) >> 30);

    for (int round = 0; round < REFINEMENTS; round++) {
        bool found;
        int result = predict_hit(s, slice_q30);

        if (result == CAROM_OK) {
            result = step_first_hit(s, &found);
        }
        if (result < 0) {
            return result;
        }
        s->w->stats.refinements++;
        t_q30 = CAROM_ONE_Q30;
        if (!found) {
            int32_t longer_q30 = lengthen(s, slice_q30, most_q30);

            if (longer_q30 > slice_q30 && round < REFINEMENTS - 5) {
                slice_q30 = longer_q30;
                continue;
            }
            t_q30 = leave_at(s);
        } else if (s->hit.t_q30 < CAROM_ONE_Q30 - 1) {
            t_q30 = s->hit.t_q30;
        }
        if (t_q30 == CAROM_ONE_Q30) {
            break;
        }
        if (t_q30 <= 1) {
            t_q30 = 0;
            break;
        }
        if (round < REFINEMENTS - 1) {
            slice_q30 = (int32_t)(((int64_t)slice_q30 * t_q30) >> 30);
        }
    }
    *slice = slice_q30;
    *t = t_q30;
    return CAROM_OK;
}

int step_go_to_hit(struct step *s, int32_t slice_q30, bool *met)
{
    int32_t t_q30, end_q30 = slice_q30;
    int result = refine(s, &end_q30, &t_q30);

    *met = true;
    if (result == CAROM_OK && !takes_time(end_q30, t_q30)) {
        bool gone, found = false;

        result = shorten(s, &slice_q30, &gone, &found);
        *met = !gone || found;
        if (result == CAROM_OK && gone) {
            end_q30 = slice_q30;
            t_q30 = CAROM_ONE_Q30;
            result = found ? refine(s, &end_q30, &t_q30) : CAROM_OK;
        } else {
            predict_all(s, end_q30);
        }
    }
    if (result == CAROM_OK) {
        step_advance(s, t_q30, end_q30);
    }
    return result;
}
