/* SPDX-License-Identifier: MIT */
/* The moving part of a step: paths, first hit, advance. */
#include "parts.h"

#define REFINEMENTS 8
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

void step_predict_all(struct step *s, int32_t tau_q30)
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

/* Set shorter paths than those of the region, which the hit at hand led to. */
static int predict_hit(struct step *s, int32_t slice_q30)
{
    const struct pair p = s->w->pairs[s->hit.candidate.pair];
    int result = CAROM_OK;

    step_predict_all(s, slice_q30);
    if (step_leaves_region(s, slice_q30)) {
        result = step_gather_slice(s, slice_q30);
        if (result == CAROM_OK) {
            s->hit.candidate.pair = step_pair_number(s->w, &p);
        }
    }
    return result;
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
        step_predict_all(s, *slice_q30);
        if (step_leaves_region(s, *slice_q30)) {
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

        step_select_pair(v, &c[i]);
        if (!boyse_first(v->pair, &c[i], &hit, &v->step->w->stats.roots)) {
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
        step_select_pair(&v, &s->hit.candidate);
        boyse_touch(v.pair, &s->hit.candidate, s->hit.root_q30, &s->hit.touch);
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
        if (s->left_q30 > 0 || s->w->pools[CAROM_POOL_pairs].used > 0) {
            body_region_advance(b, t_q30, slice_q30); /* a later frame may ask */
        }
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
    const struct boyse_pair *pair = step_set_pair(w, c);
    int32_t low = 0, high = CAROM_ONE_Q30, least = gap_at(pair, c, 0);

    least = least < pair->skin_q22 / 4 ? least : pair->skin_q22 / 4;
    if (gap_at(pair, c, high) >= least) {
        return high;
    }
    for (int round = 0; round < 12; round++) {
        int32_t middle = low + (high - low) / 2;

        *(gap_at(pair, c, middle) >= least ? &low : &high) = middle;
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
    const struct boyse_pair *pair = step_set_pair(w, c);
    int64_t wanted = pair->skin_q22 / 2, end = gap_at(pair, c, CAROM_ONE_Q30), longer_q30;
    int64_t before = gap_at(pair, c, CAROM_ONE_Q30 - CAROM_ONE_Q30 / 64);

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
    const struct boyse_pair *pair = step_set_pair(w, c);
    int64_t start = gap_at(pair, c, 0);

    return gap_at(pair, c, CAROM_ONE_Q30 >> bits) - start;
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
    return ((int64_t)slice_q30 * t_q30) >> 30 >= STEP_SLICE_MIN_Q30;
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

    for (*gone = false; shorter_q30 > STEP_SLICE_MIN_Q30 && result == CAROM_OK; shorter_q30 >>= 2) {
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
        bool found = false;
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
            step_predict_all(s, end_q30);
        }
    }
    if (result == CAROM_OK) {
        step_advance(s, t_q30, end_q30);
    }
    return result;
}
