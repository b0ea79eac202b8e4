/* SPDX-License-Identifier: MIT */
/*
 * world_step - one frame, top to bottom: the paper's figures 4 and 5.
 *
 * The frame is built in the state that is not current and becomes current at the very end, so that
 * an error on the way leaves the world as it was.
 */
#include "world_step_parts.h"

static void begin(struct step *s, struct carom_world *w)
{
    const struct world_state *now = world_now(w);
    struct world_state *next = &w->states[1 - w->now];

    memset(s, 0, sizeof *s);
    s->w = w;
    s->next = next;
    s->gravity = &w->config.gravity;
    s->left_q30 = CAROM_ONE_Q30;
    memcpy(next->bodies, now->bodies, w->body_count * sizeof *next->bodies);
    memcpy(next->warm, now->warm, now->warm_count * sizeof *next->warm);
    next->warm_count = now->warm_count;
    next->touching_count = 0;

    w->rest.pairs = w->pairs;
    w->rest.bodies = w->bodies;
    w->rest.states = next->bodies;
    w->rest.body_count = w->body_count;
    w->rest.gravity = s->gravity;
    w->rest.slow_q40 = 4 * fix_length(s->gravity->c);
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
        w->bodies[i].in_contact = false;
    }
    if (w->config.ticks) {
        w->start_tick = w->mark_tick = w->config.ticks();
    }
}

static bool touched(const struct carom_world *w)
{
    for (uint32_t i = 0; i < w->body_count; i++) {
        if (w->bodies[i].in_contact) {
            return true;
        }
    }
    return false;
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
    int status = CAROM_OK, result;

    if (!w) {
        return CAROM_ERR_NULL;
    }
    begin(&s, w);
    result = step_gather(&s);
    if (result == CAROM_OK) {
        result = step_start_contacts(&s);
    }
    while (result == CAROM_OK && s.left_q30 > 0) {
        int32_t slice_q30;
        bool found = false;

        if (w->stats.substeps == w->config.substep_cap) {
            status |= CAROM_SUBSTEP_CAP;
            break;
        }
        w->stats.substeps++;
        step_retire(&s);
        result = step_predict(&s, &slice_q30);
        if (result == CAROM_OK) {
            result = step_first_hit(&s, &found);
        }
        if (result < 0) {
            break;
        }
        if (!found) {
            step_advance(&s, CAROM_ONE_Q30, slice_q30);
            continue;
        }
        result = step_go_to_hit(&s, slice_q30);
        if (result == CAROM_OK) {
            result = step_respond(&s);
        }
    }
    if (result < 0) {
        return fail(w, result);
    }
    interfere_finish(&w->interfere);
    if (status & CAROM_SUBSTEP_CAP || touched(w)) {
        step_limit_energy(&s);
    }
    step_retire(&s);
    if (w->config.sleep) {
        rest_sleep(w->bodies, s.next->bodies, w->body_count, s.next->touching,
                   s.next->touching_count, s.gravity);
    }
    step_drop_warm(&s);
    step_finish_events(&s);
    w->now = 1 - w->now;
    step_mark(w, CAROM_STAGE_COMMIT);
    step_finish_stats(w);
    if (w->config.budget_ticks && w->stats.total_ticks > w->config.budget_ticks) {
        status |= CAROM_OVER_BUDGET;
    }
    return status;
}
