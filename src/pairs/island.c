/* SPDX-License-Identifier: MIT */
/* Islands: moving bodies connected by touching. */
#include "island.h"

void island_begin(struct body *bodies, uint32_t body_count)
{
    for (uint32_t i = 0; i < body_count; i++) {
        bodies[i].island.lowest = (uint16_t)i;
    }
}

/* The lowest body known to be connected with this one; shortens the way for the next call. */
static uint16_t lowest(struct body *bodies, uint16_t i)
{
    while (bodies[i].island.lowest != i) {
        bodies[i].island.lowest = bodies[bodies[i].island.lowest].island.lowest;
        i = bodies[i].island.lowest;
    }
    return i;
}

void island_join(struct body *bodies, const struct pair *p)
{
    if (bodies[p->a].def.moving && bodies[p->b].def.moving) {
        uint16_t a = lowest(bodies, p->a), b = lowest(bodies, p->b);

        bodies[a > b ? a : b].island.lowest = a < b ? a : b;
    }
}

void island_end(struct body *bodies, uint32_t body_count)
{
    /* a body is connected through lower ones, which know their island already */
    for (uint32_t i = 0; i < body_count; i++) {
        bodies[i].island.lowest = bodies[bodies[i].island.lowest].island.lowest;
        bodies[i].island.next = ISLAND_END;
    }
    for (uint32_t i = body_count; i-- > 0;) {
        struct body *first = &bodies[bodies[i].island.lowest];

        if (first != &bodies[i]) {
            bodies[i].island.next = first->island.next;
            first->island.next = (uint16_t)i;
        }
    }
}

void island_find(struct body *bodies, uint32_t body_count, const struct pair *pairs,
                 uint32_t pair_count)
{
    island_begin(bodies, body_count);
    for (uint32_t i = 0; i < pair_count; i++) {
        island_join(bodies, &pairs[i]);
    }
    island_end(bodies, body_count);
}
