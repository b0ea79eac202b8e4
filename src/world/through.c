/* SPDX-License-Identifier: MIT */
/* The list of pairs that overlap and do not touch. */
#include "world.h"

struct pair world_name_pair(const struct carom_world *w, uint32_t i, uint32_t k)
{
    bool first = w->bodies[i].def.moving && (!w->bodies[k].def.moving || i > k);

    return (struct pair){(uint16_t)(first ? i : k), (uint16_t)(first ? k : i)};
}

bool world_goes_through(const struct carom_world *w, const struct world_state *s,
                        const struct pair *p)
{
    uint32_t place;

    return broad_find(world_through(w, s), s->through_count, p->a, p->b, &place);
}

int world_note_through(const struct carom_world *w, struct world_state *s, const struct pair *p)
{
    struct pair *list = world_through(w, s);
    uint32_t place;

    if (broad_find(list, s->through_count, p->a, p->b, &place)) {
        return CAROM_OK;
    }
    if (s->touching_count + s->through_count == w->config.caps.pairs) {
        return CAROM_ERR_PAIRS_FULL;
    }
    memmove(list - 1, list, place * sizeof *list);
    list[(int32_t)place - 1] = *p;
    s->through_count++;
    return CAROM_OK;
}

void world_drop_through(const struct carom_world *w, struct world_state *s, uint32_t body)
{
    struct pair *list = world_through(w, s);
    uint32_t kept = s->through_count;

    for (uint32_t i = s->through_count; i-- > 0;) {
        if (list[i].a != body && list[i].b != body) {
            list[--kept] = list[i];
        }
    }
    s->through_count -= kept;
}
