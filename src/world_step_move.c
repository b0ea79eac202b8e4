/* SPDX-License-Identifier: MIT */
/* The moving part of a step: candidates for the rest of the frame, paths, first hit, advance. */
#include "world_step_parts.h"

#define REFINEMENTS 4

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

    memset(v, 0, sizeof *v);
    v->base.visit = f;
    v->step = s;
    v->pair_number = -1;
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
int step_gather(struct step *s)
{
    struct carom_world *w = s->w;
    struct step_visitor v;
    int result;

    step_place_all(s);
    set_reach(s);
    step_mark(w, CAROM_STAGE_PREDICT);
    result = broad_pairs(w->pairs, &w->pools[CAROM_POOL_pairs], w->bodies, s->next->bodies,
                         w->body_count);
    step_mark(w, CAROM_STAGE_BROAD);
    if (result < 0) {
        return result;
    }
    interfere_begin(&w->interfere);
    result = step_visit(s, &v, visit_nothing);
    step_mark(w, CAROM_STAGE_INTERFERE);
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
int step_predict(struct step *s, int32_t *slice_q30)
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
        result = step_gather(s);
        predict_all(s, *slice_q30);
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
    step_mark(s->w, CAROM_STAGE_BOYSE);
    return result;
}

void step_advance(struct step *s, int32_t t_q30, int32_t slice_q30)
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
    step_mark(s->w, CAROM_STAGE_ADVANCE);
}

/*
 * Go to the hit. The turn of a shorter slice is not a part of the turn of the longer one, so the
 * path is set up again for the slice that ends at the hit until it no longer hits on the way: only
 * then does the rotation keep its energy. The last path may still stop short of its end.
 */
int step_go_to_hit(struct step *s, int32_t slice_q30)
{
    int32_t t_q30 = CAROM_ONE_Q30;

    slice_q30 = (int32_t)(((int64_t)slice_q30 * s->hit.t_q30) >> 30);
    for (int round = 0; round < REFINEMENTS; round++) {
        bool found;
        int result;

        predict_all(s, slice_q30);
        result = step_first_hit(s, &found);
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
    step_advance(s, t_q30, slice_q30);
    return CAROM_OK;
}
