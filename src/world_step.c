/* SPDX-License-Identifier: MIT */
/*
 * world_step - one frame, top to bottom: the paper's figures 4 and 5.
 *
 * The frame is built in the state that is not current and becomes current at the very end, so that
 * an error on the way leaves the world as it was.
 */
#include "world_step_parts.h"

/* 8 sub-steps a frame and 2 for each body that is awake, unless the caller says otherwise. */
static uint32_t substep_cap(const struct carom_world *w)
{
    uint32_t cap = 8;

    for (uint32_t i = 0; i < w->body_count; i++) {
        cap += broad_active(&w->bodies[i], &world_now(w)->bodies[i]) ? 2 : 0;
    }
    return w->config.substep_cap > 0 ? w->config.substep_cap : cap;
}

void step_begin(struct step *s, struct carom_world *w)
{
    const struct world_state *now = world_now(w);
    struct world_state *next = &w->states[1 - w->now];

    memset(s, 0, sizeof *s);
    s->w = w;
    s->next = next;
    s->left_q30 = CAROM_ONE_Q30;
    s->substep_cap = substep_cap(w);
    next->gravity = now->gravity;
    memcpy(next->bodies, now->bodies, w->body_count * sizeof *next->bodies);
    memcpy(next->warm, now->warm, now->warm_count * sizeof *next->warm);
    next->warm_count = now->warm_count;
    next->touching_count = 0;

    w->rest.pairs = w->pairs;
    w->rest.bodies = w->bodies;
    w->rest.states = next->bodies;
    w->rest.body_count = w->body_count;
    w->rest.warm = next->warm;
    w->rest.warm_count = next->warm_count;
    w->rest.sweeps = w->rest.impacts = w->rest.energy_rules = 0;
    w->interfere.gathers = w->interfere.candidate_count = 0;
    memset(&w->stats, 0, sizeof w->stats);
    w->event_count = 0;
    pool_clear(&w->pools[CAROM_POOL_pairs]);
    pool_clear(&w->pools[CAROM_POOL_faces]);
    pool_clear(&w->pools[CAROM_POOL_contacts]);
    for (uint32_t i = 0; i < w->body_count; i++) {
        struct body *b = &w->bodies[i];

        b->in_contact = false;
        b->work2 = (struct fix_wide){0, 0};
        world_acceleration(b, &now->gravity, &now->bodies[i].force, &b->acceleration);
        b->acceleration_q40 = fix_length(b->acceleration.c);
    }
    if (w->config.ticks) {
        w->start_tick = w->mark_tick = w->config.ticks();
    }
}

/* To the first hit and through it, or to the end of a slice without one. */
static int substep(struct step *s)
{
    int32_t slice_q30;
    bool found = false;
    int result = CAROM_OK;

    s->w->stats.substeps++;
    if (step_retire(s)) {
        result = step_gather(s);
    }
    if (result == CAROM_OK) {
        result = step_predict(s, &slice_q30);
    }
    if (result == CAROM_OK) {
        result = step_first_hit(s, &found);
    }
    if (result == CAROM_OK && !found) {
        step_advance(s, CAROM_ONE_Q30, slice_q30);
        return CAROM_OK;
    }
    if (result == CAROM_OK) {
        result = step_go_to_hit(s, slice_q30, &found);
    }
    return result == CAROM_OK && found ? step_respond(s) : result;
}

/* What a whole frame ends with. */
static int finish(struct step *s, bool cut_short)
{
    struct carom_world *w = s->w;

    interfere_finish(&w->interfere);
    step_limit_energy(s, cut_short);
    step_retire(s);
    if (w->config.sleep) {
        rest_sleep(w->bodies, s->next->bodies, w->body_count, s->next->touching,
                   s->next->touching_count);
    }
    step_drop_warm(s);
    return step_finish_events(s);
}

static int fail(struct carom_world *w, int error)
{
    w->event_count = 0;
    pool_clear(&w->pools[CAROM_POOL_pairs]);
    pool_clear(&w->pools[CAROM_POOL_faces]);
    pool_clear(&w->pools[CAROM_POOL_contacts]);
    return error;
}

int carom_world_step(struct carom_world *w)
{
    struct step s;
    bool cut_short = false;
    int status, result;

    if (!w) {
        return CAROM_ERR_NULL;
    }
    step_begin(&s, w);
    result = step_gather(&s);
    if (result == CAROM_OK) {
        result = step_start_contacts(&s);
    }
    while (result == CAROM_OK && s.left_q30 > 0 && !cut_short) {
        cut_short = w->stats.substeps == s.substep_cap;
        if (!cut_short) {
            result = substep(&s);
        }
    }
    if (result == CAROM_OK) {
        result = finish(&s, cut_short);
    }
    if (result < 0) {
        return fail(w, result);
    }
    w->now = 1 - w->now;
    world_halt_surfaces(w);
    step_mark(w, CAROM_STAGE_COMMIT);
    step_finish_stats(w);
    status = cut_short ? CAROM_SUBSTEP_CAP : CAROM_OK;
    if (w->config.budget_ticks && w->stats.total_ticks > w->config.budget_ticks) {
        status |= CAROM_OVER_BUDGET;
    }
    return status;
}
