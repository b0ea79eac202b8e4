/* SPDX-License-Identifier: MIT */
/* Waking: a sleeping body wakes with its whole island. */
#include "world.h"

/* Find the islands of bodies that touched when they fell asleep, or in the last step. */
static void find_islands(struct carom_world *w)
{
    const struct world_state *now = world_now(w);

    w->idle = false;
    rest_find_islands(&w->rest, w->bodies, w->body_count, now->touching, now->touching_count);
}

static bool sleeps(const struct body *b, const struct body_state *s)
{
    return b->def.mesh && b->def.moving && s->asleep;
}

/* Wake a body if it sleeps, and the bodies connected with it; islands must be known. */
static void wake_island(struct carom_world *w, struct body_state *states, uint32_t body)
{
    if (!sleeps(&w->bodies[body], &states[body])) {
        return;
    }
    for (uint32_t i = w->bodies[body].island.lowest; i != ISLAND_END;
         i = w->bodies[i].island.next) {
        if (states[i].asleep) {
            states[i].asleep = states[i].quiet = 0;
            states[i].woken = 1;
            w->bodies[i].clock.woke = true;
        }
    }
}

void world_wake_all(struct carom_world *w)
{
    find_islands(w);
    for (uint32_t i = 0; i < w->body_count; i++) {
        wake_island(w, world_now(w)->bodies, i);
    }
}

void world_wake_island(struct carom_world *w, uint32_t body)
{
    find_islands(w);
    world_now(w)->bodies[body].quiet = 0;
    wake_island(w, world_now(w)->bodies, body);
}

void world_wake_around(struct carom_world *w, uint32_t body)
{
    struct world_state *now = w->now;
    const struct body *b = &w->bodies[body];

    w->regions_stale = true;
    w->sense_anew = w->sensors > 0;
    world_wake_island(w, body);
    for (uint32_t i = 0; i < now->touching_count; i++) {
        const struct pair *p = &now->touching[i];

        if (p->a == body || p->b == body) {
            wake_island(w, now->bodies, p->a == body ? p->b : p->a);
        }
    }
    for (uint32_t i = 0; i < w->body_count; i++) {
        const struct body *other = &w->bodies[i];
        int32_t skin_q22 =
            b->def.skin_q22 > other->def.skin_q22 ? b->def.skin_q22 : other->def.skin_q22;

        if (sleeps(other, &now->bodies[i]) && broad_may_touch(b, other) &&
            broad_near(b, &now->bodies[body], other, &now->bodies[i],
                       BODY_MARGIN_SKINS * skin_q22)) {
            wake_island(w, now->bodies, i);
        }
    }
}

bool world_wake_touched(struct carom_world *w, struct body_state *states)
{
    const struct contact_list *list = &w->rest.list;
    bool any = false;

    for (uint32_t i = 0; i < list->pool->used; i++) {
        const struct pair *p = &w->pairs[list->contacts[i].key.pair];
        const uint16_t sides[2] = {p->a, p->b};

        for (int k = 0; k < 2; k++) {
            if (sleeps(&w->bodies[sides[k]], &states[sides[k]])) {
                if (!any) {
                    find_islands(w);
                    any = true;
                }
                wake_island(w, states, sides[k]);
            }
        }
    }
    return any;
}
