/* SPDX-License-Identifier: MIT */
/*
 * world_step - one frame, top to bottom: the paper's figures 4 and 5.
 *
 * The frame is built in the state that is not current and becomes current at the very end, so that
 * an error on the way leaves the world as it was.
 */
#include "parts.h"

/* The bodies that are awake. */
static uint32_t count_active(const struct carom_world *w)
{
    uint32_t active = 0;

    for (uint32_t i = 0; i < w->body_count; i++) {
        active += broad_active(&w->bodies[i], &world_now(w)->bodies[i]);
    }
    return active;
}

/* What the last step found is gone. */
static void forget(struct carom_world *w)
{
    w->event_count = 0;
    w->interfere.stale = true;
    pool_clear(&w->pools[CAROM_POOL_pairs]);
    pool_clear(&w->pools[CAROM_POOL_faces]);
    pool_clear(&w->pools[CAROM_POOL_contacts]);
}

/*
 * What stands still is the same in both states. So is what sleeps in both: it did so in the step
 * before, and whatever changes it wakes it.
 */
static void copy_bodies(struct carom_world *w, struct world_state *next)
{
    const struct world_state *now = world_now(w);

    for (uint32_t i = 0; i < w->body_count; i++) {
        const struct body_state *from = &now->bodies[i];
        struct body_state *to = &next->bodies[i];

        if (w->bodies[i].moving && !(from->asleep && to->asleep && !to->woken)) {
            *to = *from;
        }
        w->bodies[i].in_contact = false;
        PHASE_BEGIN(w->bodies[i].work_phase, BODY_WORK);
        w->bodies[i].work2 = (struct fix_wide){0, 0};
    }
}

void step_begin(struct step *s, struct carom_world *w)
{
    const struct world_state *now = world_now(w);
    struct world_state *next = &w->states[1 - w->now];
    uint32_t active = count_active(w);

    s->w = w;
    s->next = next;
    s->left_q30 = CAROM_ONE_Q30;
    s->path_q30 = 0;
    /* 8 sub-steps a frame and 2 for each body that is awake, unless the caller says otherwise */
    s->substep_cap = w->config.substep_cap > 0 ? w->config.substep_cap : 8 + 2 * active;
    copy_bodies(w, next);
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
    pool_clear(&w->pools[CAROM_POOL_contacts]);
}

/* To the first hit and through it, or to the end of a slice without one. */
static int substep(struct step *s)
{
    int32_t slice_q30;
    bool found = false;
    int result = CAROM_OK;

    s->w->stats.substeps++;
    /* what nothing has changed since it was gathered for is in range */
    if (s->path_q30 == 0 && step_retire(s)) {
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

/* Whether a step would find nothing, and leave the state as it is. */
static bool is_idle(const struct carom_world *w)
{
    const struct world_state *now = world_now(w);

    for (uint32_t i = 0; i < w->body_count; i++) {
        if (broad_active(&w->bodies[i], &now->bodies[i]) || now->bodies[i].woken) {
            return false;
        }
    }
    return now->warm_count == 0;
}

/* A frame in which nothing is awake: what the first one finds stays true of those that follow. */
static void step_idle(struct carom_world *w)
{
    if (!w->idle) {
        forget(w);
        world_halt_surfaces(w);
        memset(&w->stats, 0, sizeof w->stats);
        w->stats.substeps = w->stats.gathers = 1;
        w->idle = true;
    }
    if (w->config.ticks) {
        w->stats.ticks[CAROM_STAGE_COMMIT] = 0;
        w->stats.over_stage = CAROM_STAGE_COMMIT;
        step_mark(w, CAROM_STAGE_COMMIT);
        w->stats.total_ticks = w->stats.ticks[CAROM_STAGE_COMMIT];
    }
}

/* A frame; whether the sub-steps did not suffice for the whole of it. */
static int step_frame(struct carom_world *w, bool *cut_short)
{
    struct step s;
    int result;

    step_begin(&s, w);
    result = step_gather_first(&s);
    if (result == CAROM_OK) {
        result = step_start_contacts(&s);
    }
    while (result == CAROM_OK && s.left_q30 > 0 && !*cut_short) {
        *cut_short = w->stats.substeps == s.substep_cap;
        if (!*cut_short) {
            result = substep(&s);
        }
    }
    if (result == CAROM_OK) {
        result = finish(&s, *cut_short);
    }
    if (result < 0) {
        forget(w);
        return result;
    }
    w->now = 1 - w->now;
    world_halt_surfaces(w);
    step_mark(w, CAROM_STAGE_COMMIT);
    step_finish_stats(w);
    return result;
}

int carom_world_step(struct carom_world *w)
{
    bool cut_short = false;
    int status = CAROM_OK;

    if (!w) {
        return CAROM_ERR_NULL;
    }
    if (w->config.ticks) {
        w->start_tick = w->mark_tick = w->config.ticks();
    }
    if (w->idle || is_idle(w)) {
        step_idle(w);
    } else {
        status = step_frame(w, &cut_short);
        if (status == CAROM_ERR_FACES_FULL) {
            /* what was gathered for several frames may have more faces than this one: gather anew */
            cut_short = false;
            status = step_frame(w, &cut_short);
        }
    }
    if (cut_short && status == CAROM_OK) {
        status = CAROM_SUBSTEP_CAP;
    }
    if (status >= 0 && w->config.budget_ticks && w->stats.total_ticks > w->config.budget_ticks) {
        status |= CAROM_OVER_BUDGET;
    }
    return status;
}
