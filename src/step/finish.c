/* SPDX-License-Identifier: MIT */
/* The end of a step: bodies that left the world, events, statistics. */
#include "parts.h"

bool step_may_note(const struct carom_world *w)
{
    return w->event_count < w->config.caps.pairs + w->config.caps.bodies;
}

void step_add_event(struct carom_world *w, uint8_t kind, uint16_t a, uint16_t b)
{
    struct carom_event *e = &w->events[w->event_count];

    if (w->event_count <
        3 * w->config.caps.pairs + 2 * w->config.caps.bodies + w->config.caps.joints) {
        w->event_count++;
        memset(e, 0, sizeof *e);
        e->kind = kind;
        e->a = a;
        e->b = b;
    }
}

bool step_in_range(const struct body *b, const struct body_state *s)
{
    return (body_calm(b, s) && world_each_within(s->position.c, (int64_t)BODY_WORLD_LIMIT << 32)) ||
           world_in_range(b, s);
}

/* Halve a body's momenta until it is in range, as it is where it is. False if its place is not. */
static bool slow_down(const struct body *b, struct body_state *state)
{
    int halvings = 0;

    while (!world_in_range(b, state) && halvings++ < 64) {
        for (int k = 0; k < 3; k++) {
            state->momentum.c[k] /= 2;
            state->angular.c[k] /= 2;
        }
    }
    return halvings <= 64;
}

bool step_retire(struct step *s, uint32_t i)
{
    struct carom_world *w = s->w;
    struct body_state *state = &s->next->bodies[i];

    if (!step_active(s, i) || step_in_range(&w->bodies[i], state)) {
        return false;
    }
    /* another body may be by now where it came from */
    if (!slow_down(&w->bodies[i], state)) {
        *state = world_now(w)->bodies[i];
    }
    state->out = 1;
    w->regions_stale = true;
    return true;
}

bool step_is_touching(const struct world_state *s, const struct pair *p)
{
    uint32_t place;

    return broad_find(s->touching, s->touching_count, p->a, p->b, &place);
}

int step_note_touching(struct step *s, const struct pair *p)
{
    struct world_state *next = s->next;
    uint32_t place;

    if (broad_find(next->touching, next->touching_count, p->a, p->b, &place)) {
        return CAROM_OK;
    }
    if (next->touching_count == s->w->config.caps.pairs) {
        return CAROM_ERR_PAIRS_FULL;
    }
    memmove(&next->touching[place + 1], &next->touching[place],
            (next->touching_count - place) * sizeof *p);
    next->touching[place] = *p;
    next->touching_count++;
    return CAROM_OK;
}

/*
 * Drop impulses of contacts that the next frame does not look at. An awake body must be one that
 * moves: a kinematic one may stop, and then nothing is awake.
 */
void step_drop_warm(struct step *s)
{
    const struct carom_world *w = s->w;
    uint32_t kept = 0;

    for (uint32_t i = 0; i < w->rest.warm_count; i++) {
        const struct rest_warm *warm = &s->next->warm[i];

        if (step_active(s, warm->a) || (w->bodies[warm->b].def.moving && step_active(s, warm->b))) {
            s->next->warm[kept++] = *warm;
        }
    }
    s->next->warm_count = kept;
}

bool step_left_alone(const struct step *s, const struct pair *p)
{
    const struct body *bodies = s->w->bodies;
    const struct body_state *before = world_now(s->w)->bodies, *next = s->next->bodies;

    return !broad_active(&bodies[p->a], &before[p->a]) &&
           !broad_active(&bodies[p->b], &before[p->b]) &&
           !broad_active(&bodies[p->a], &next[p->a]) && !broad_active(&bodies[p->b], &next[p->b]);
}

int step_finish_events(struct step *s)
{
    struct carom_world *w = s->w;
    const struct world_state *before = world_now(w);
    int result = CAROM_OK;

    for (uint32_t i = 0; i < before->touching_count && result == CAROM_OK; i++) {
        const struct pair *p = &before->touching[i];

        if (step_left_alone(s, p)) { /* it still touches though it was not checked */
            result = step_note_touching(s, p);
        } else if (!step_is_touching(s->next, p)) {
            step_add_event(w, CAROM_EVENT_END, p->a, p->b);
        }
    }
    for (uint32_t i = 0; i < s->next->touching_count; i++) {
        if (!step_is_touching(before, &s->next->touching[i])) {
            step_add_event(w, CAROM_EVENT_BEGIN, s->next->touching[i].a, s->next->touching[i].b);
        }
    }
    for (uint32_t i = 0; i < w->body_count; i++) {
        struct body_state *state = &s->next->bodies[i];

        if (state->woken) {
            step_add_event(w, CAROM_EVENT_WAKE, (uint16_t)i, 0);
            state->woken = 0;
        }
        if (state->out && !before->bodies[i].out) {
            step_add_event(w, CAROM_EVENT_OUT, (uint16_t)i, 0);
        }
        if (state->asleep && !before->bodies[i].asleep) {
            step_add_event(w, CAROM_EVENT_REST, (uint16_t)i, 0);
        }
    }
    return result;
}

void step_finish_stats(struct carom_world *w)
{
    struct carom_stats *st = &w->stats;

    st->gathers = w->interfere.gathers;
    st->candidates = w->interfere.candidate_count;
    st->sweeps = w->rest.sweeps;
    st->impacts = w->rest.impacts;
    st->energy_rule = w->rest.energy_rules;
    if (w->config.ticks) {
        st->total_ticks = w->config.ticks() - w->start_tick;
        for (uint32_t i = 1; i < CAROM_STAGE_COUNT; i++) {
            if (st->ticks[i] > st->ticks[st->over_stage]) {
                st->over_stage = i;
            }
        }
    }
}
