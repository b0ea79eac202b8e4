/* SPDX-License-Identifier: MIT */
/* The last resort for islands that a solve has failed: they go on as one body. */
#include "../solve/rigid.h"
#include "parts.h"

void step_calm_island(struct step *s, uint32_t body, bool hard)
{
    uint32_t first = s->w->bodies[body].island.lowest;
    bool grounded = false;

    for (uint32_t i = 0; i < s->w->rest.list.pool->used; i++) {
        const struct contact *c = &s->w->rest.list.contacts[i];
        const struct pair *p = &s->w->pairs[c->key.pair];

        grounded |= s->w->bodies[p->a].island.lowest == first && !s->w->bodies[p->b].def.moving;
    }
    if (!grounded || !step_carry_island(s, first, hard)) {
        rest_unite(&s->w->rest, first, grounded);
    }
    s->w->stats.calmed++;
}

void step_keep_in_range(struct step *s)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        const struct body *b = &s->w->bodies[i];
        const struct body_state *state = &s->next->bodies[i];

        if (b->def.moving && step_active(s, i) && b->def.joined != BODY_ALONE &&
            !step_in_range(b, state) && world_position_in_range(&state->position)) {
            step_calm_island(s, i, true);
        }
    }
}
