/* SPDX-License-Identifier: MIT */
/*
 * Hits that get no answer. A sensor notes that it was met. A one-way body lets bodies pass that
 * meet it from another side. Pairs that overlapped when they were made pass as well. A pair passes
 * until the frame ends, and in the next frame if it still overlaps.
 */
#include "parts.h"

bool step_let_pass(struct step *s, uint32_t number)
{
    struct pair_work *m = &s->w->meetings[number];
    const struct pair *p = &s->w->pairs[number];
    struct boyse_hit hit;

    if (m->senses) {
        m->hits = 1;
    } else {
        if ((s->w->bodies[p->a].def.one_way | s->w->bodies[p->b].def.one_way) == CAROM_BOTH_WAYS) {
            return false;
        }
        hit = step_hit_of(s, number);
        if (!hit.touch.valid || step_solid_along(s, p, &hit.touch.normal, m->hit_q30)) {
            return false;
        }
        contact_drop_pair(&s->w->rest.list, (uint16_t)number);
    }
    m->passes = true;
    m->hit_q30 = PAIRS_NEVER;
    return true;
}

static bool overlap(struct step *s, uint32_t i, uint32_t k)
{
    const struct interfere_placed a = {&s->w->bodies[i], &s->next->bodies[i]};
    const struct interfere_placed b = {&s->w->bodies[k], &s->next->bodies[k]};

    return !a.state->out && !b.state->out && world_overlap(s->w, a, b);
}

void step_sense_start(struct step *s)
{
    struct carom_world *w = s->w;

    for (uint32_t n = 0; n < w->pools[CAROM_POOL_pairs].used; n++) {
        struct pair_work *m = &w->meetings[n];

        if (m->senses && !m->passes && overlap(s, w->pairs[n].a, w->pairs[n].b)) {
            m->hits = 1;
            m->passes = true;
        }
    }
}

/* True if nothing has moved two bodies in this step, or set them before it. */
static bool left_alone(const struct step *s, const struct pair *p)
{
    return !s->w->sense_anew && step_left_alone(s, p);
}

/* Note the pairs that pass and still overlap. */
static int note_passing(struct step *s)
{
    struct carom_world *w = s->w;
    const struct world_state *now = world_now(w);
    int result = CAROM_OK;

    for (uint32_t i = 0; i < now->through_count && result == CAROM_OK; i++) {
        const struct pair *p = &world_through(w, now)[i];

        if (broad_may_touch(&w->bodies[p->a], &w->bodies[p->b]) &&
            (left_alone(s, p) || overlap(s, p->a, p->b))) {
            result = world_note_through(w, s->next, p);
        }
    }
    for (uint32_t n = 0; n < w->pools[CAROM_POOL_pairs].used && result == CAROM_OK; n++) {
        const struct pair *p = &w->pairs[n];

        if (w->meetings[n].passes && !w->meetings[n].senses &&
            (w->bodies[p->a].def.one_way | w->bodies[p->b].def.one_way) != CAROM_BOTH_WAYS &&
            !world_goes_through(w, now, p) && overlap(s, p->a, p->b)) {
            result = world_note_through(w, s->next, p);
        }
    }
    return result;
}

static void add_sensor_event(struct step *s, uint8_t kind, const struct pair *p)
{
    bool first = s->w->bodies[p->a].def.sensor;

    step_add_event(s->w, kind, first ? p->a : p->b, first ? p->b : p->a);
}

/* Report whether a sensor and another body began or ceased to overlap. */
static int sense(struct step *s, uint32_t sensor, uint32_t other)
{
    struct carom_world *w = s->w;
    const struct pair p = world_name_pair(w, sensor, other);
    bool was = world_goes_through(w, world_now(w), &p), is = was;
    uint32_t number = step_find_pair(w, &p);
    int result = CAROM_OK;

    if (!left_alone(s, &p)) {
        is = overlap(s, p.a, p.b);
    }
    if (is) {
        result = world_note_through(w, s->next, &p);
    }
    if (!was && (is || (number != UINT32_MAX && w->meetings[number].hits > 0))) {
        add_sensor_event(s, CAROM_EVENT_SENSOR_BEGIN, &p);
        was = true;
    }
    if (was && !is) {
        add_sensor_event(s, CAROM_EVENT_SENSOR_END, &p);
    }
    return result;
}

static int sense_all(struct step *s)
{
    const struct carom_world *w = s->w;
    int result = CAROM_OK;

    for (uint32_t i = 0; i < w->body_count; i++) {
        for (uint32_t k = 0; k < w->body_count && w->bodies[i].def.sensor && result == CAROM_OK;
             k++) {
            if (w->bodies[k].def.mesh && (w->bodies[i].def.moving || w->bodies[k].def.moving) &&
                broad_may_meet(&w->bodies[i], &w->bodies[k])) {
                result = sense(s, i, k);
            }
        }
    }
    return result;
}

int step_finish_through(struct step *s)
{
    int result = note_passing(s);

    return result == CAROM_OK && s->w->sensors > 0 ? sense_all(s) : result;
}
