/* SPDX-License-Identifier: MIT */
/* Filters: which bodies may touch. */
#include "world.h"

void world_filter(struct body *b, const struct carom_filter *filter)
{
    bool none = (filter->category | filter->mask | filter->group) == 0;

    b->def.category = none ? 1 : filter->category;
    b->def.mask = none ? 0xffff : filter->mask;
    b->def.group = filter->group;
}

int carom_body_set_filter(struct carom_world *w, int body, const struct carom_filter *filter)
{
    struct carom_filter old;
    struct body_state state;
    struct body *b;
    int result;

    if (!w || !filter) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    b = &w->bodies[body];
    old = (struct carom_filter){b->def.category, b->def.mask, b->def.group};
    world_filter(b, filter);
    if (b->def.category == old.category && b->def.mask == old.mask && b->def.group == old.group) {
        return CAROM_OK; /* nothing changed: nothing wakes */
    }
    state = world_now(w)->bodies[body];
    result = world_settle(w, b, (uint32_t)body, &state, CAROM_OVERLAP_PASS);
    world_filter(b, &old); /* wake also those that only the old filter lets it touch */
    if (result < 0) {
        return result;
    }
    world_wake_around(w, (uint32_t)body);
    world_filter(b, filter);
    world_let_pass(w, (uint32_t)body);
    world_wake_around(w, (uint32_t)body);
    return CAROM_OK;
}

int carom_body_get_filter(const struct carom_world *w, int body, struct carom_filter *filter)
{
    if (!w || !filter) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    filter->category = w->bodies[body].def.category;
    filter->mask = w->bodies[body].def.mask;
    filter->group = w->bodies[body].def.group;
    return CAROM_OK;
}
