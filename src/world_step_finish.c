/* SPDX-License-Identifier: MIT */
/* The end of a step: the energy of contact, bodies that left, events, statistics. */
#include "world_step_parts.h"

/* Twice the kinetic energy of the active bodies, and what contact may have lifted them by. */
static struct fix_wide kinetic2(const struct step *s, struct fix_wide *lift2)
{
    struct fix_wide sum = {0, 0};

    memset(lift2, 0, sizeof *lift2);
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        const struct body *b = &s->w->bodies[i];
        carom_m3_q30 r;

        if (!broad_active(b, &s->next->bodies[i])) {
            continue;
        }
        body_matrix(&r, &s->next->bodies[i].rotation);
        sum = fix_wide_add(sum, body_kinetic2(b, &s->next->bodies[i], &r));
        if (b->in_contact) {
            *lift2 = fix_wide_add(*lift2, body_lift2(b, s->gravity));
        }
    }
    return sum;
}

/* Every active body stays where the frame found it, at rest. */
static void hold_still(struct step *s)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        struct body_state *state = &s->next->bodies[i];

        if (broad_active(&s->w->bodies[i], state)) {
            state->position = world_now(s->w)->bodies[i].position;
            state->rotation = world_now(s->w)->bodies[i].rotation;
            memset(&state->momentum, 0, sizeof state->momentum);
            memset(&state->angular, 0, sizeof state->angular);
        }
    }
}

static void scale_momenta(struct step *s, int32_t factor_q30)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        struct body_state *state = &s->next->bodies[i];

        for (int k = 0; k < 3; k++) {
            state->momentum.c[k] = fix_mul(state->momentum.c[k], factor_q30, 30);
            state->angular.c[k] = fix_mul(state->angular.c[k], factor_q30, 30);
        }
    }
}

void step_limit_energy(struct step *s)
{
    struct fix_wide lift2, kept;
    struct fix_wide kinetic = kinetic2(s, &lift2);
    struct fix_wide allowed = fix_wide_add(world_energy2(s->w, world_now(s->w)), lift2);
    struct fix_wide excess = fix_wide_add(world_energy2(s->w, s->next), fix_wide_neg(allowed));

    if (fix_wide_sign(excess) <= 0) {
        return;
    }
    kept = fix_wide_add(kinetic, fix_wide_neg(excess));
    if (fix_wide_sign(kept) > 0) {
        struct fix_scaled ratio = fix_wide_ratio(kept, kinetic); /* below 1 */

        scale_momenta(s, (int32_t)fix_sqrt((uint64_t)fix_mul_scaled((int64_t)1 << 60, ratio)));
    } else {
        hold_still(s); /* it climbed by more than it has to give */
    }
}

void step_add_event(struct carom_world *w, uint8_t kind, uint16_t a, uint16_t b)
{
    struct carom_event *e = &w->events[w->event_count];

    if (w->event_count < 3 * w->config.caps.pairs + 2 * w->config.caps.bodies) {
        w->event_count++;
        memset(e, 0, sizeof *e);
        e->kind = kind;
        e->a = a;
        e->b = b;
    }
}

void step_retire(struct step *s)
{
    struct carom_world *w = s->w;

    for (uint32_t i = 0; i < w->body_count; i++) {
        struct body_state *state = &s->next->bodies[i];

        if (broad_active(&w->bodies[i], state) && !world_in_range(&w->bodies[i], state)) {
            *state = world_now(w)->bodies[i];
            state->out = 1;
            step_add_event(w, CAROM_EVENT_OUT, (uint16_t)i, 0);
        }
    }
}

bool step_is_touching(const struct world_state *s, const struct pair *p)
{
    for (uint32_t i = 0; i < s->touching_count; i++) {
        if (s->touching[i].a == p->a && s->touching[i].b == p->b) {
            return true;
        }
    }
    return false;
}

/* Impulses of contacts that nobody will look at in the next frame. */
void step_drop_warm(struct step *s)
{
    const struct carom_world *w = s->w;
    uint32_t kept = 0;

    for (uint32_t i = 0; i < w->rest.warm_count; i++) {
        const struct rest_warm *warm = &s->next->warm[i];

        if (broad_active(&w->bodies[warm->a], &s->next->bodies[warm->a]) ||
            broad_active(&w->bodies[warm->b], &s->next->bodies[warm->b])) {
            s->next->warm[kept++] = *warm;
        }
    }
    s->next->warm_count = kept;
}

void step_finish_events(struct step *s)
{
    struct carom_world *w = s->w;
    const struct world_state *before = world_now(w);

    for (uint32_t i = 0; i < before->touching_count; i++) {
        const struct pair *p = &before->touching[i];

        /* nothing moved: they still touch, though nobody looked */
        if (!broad_active(&w->bodies[p->a], &before->bodies[p->a]) &&
            !broad_active(&w->bodies[p->b], &before->bodies[p->b])) {
            step_note_touching(s, p);
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

        if (state->asleep && !before->bodies[i].asleep) {
            step_add_event(w, CAROM_EVENT_REST, (uint16_t)i, 0);
        }
    }
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
