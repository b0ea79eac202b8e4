/* SPDX-License-Identifier: MIT */
/* Islands: moving bodies that are connected by touching. */
#include "parts.h"

void rest_islands_begin(struct body *bodies, uint32_t body_count)
{
    for (uint32_t i = 0; i < body_count; i++) {
        bodies[i].island = (uint16_t)i;
    }
}

/* The lowest body that is known to be connected with this one; halves the way for the next. */
static uint16_t lowest(struct body *bodies, uint16_t i)
{
    while (bodies[i].island != i) {
        bodies[i].island = bodies[bodies[i].island].island;
        i = bodies[i].island;
    }
    return i;
}

void rest_islands_join(struct body *bodies, const struct pair *p)
{
    if (bodies[p->a].moving && bodies[p->b].moving) {
        uint16_t a = lowest(bodies, p->a), b = lowest(bodies, p->b);

        bodies[a > b ? a : b].island = a < b ? a : b;
    }
}

void rest_islands_end(struct body *bodies, uint32_t body_count)
{
    /* a body is connected through lower ones, which know their island by then */
    for (uint32_t i = 0; i < body_count; i++) {
        bodies[i].island = bodies[bodies[i].island].island;
        bodies[i].next_in_island = REST_ISLAND_END;
    }
    for (uint32_t i = body_count; i-- > 0;) {
        struct body *first = &bodies[bodies[i].island];

        if (first != &bodies[i]) {
            bodies[i].next_in_island = first->next_in_island;
            first->next_in_island = (uint16_t)i;
        }
    }
}

/* The first body of the island that a contact belongs to: a of a pair moves. */
static uint16_t island_of(const struct rest *r, const struct contact *c)
{
    return rest_body(r, c, 0)->island;
}

void rest_list_islands(struct rest *r)
{
    const uint32_t n = r->list.pool->used;
    uint16_t place = 0;

    rest_islands_begin(r->bodies, r->body_count);
    for (uint32_t i = 0; i < n; i++) {
        rest_islands_join(r->bodies, &r->pairs[r->list.contacts[i].key.pair]);
    }
    rest_islands_end(r->bodies, r->body_count);
    for (uint32_t i = 0; i < r->body_count; i++) {
        r->bodies[i].contacts = 0;
    }
    for (uint32_t i = 0; i < n; i++) {
        r->bodies[island_of(r, &r->list.contacts[i])].contacts++;
    }
    for (uint32_t i = 0; i < r->body_count; i++) {
        uint16_t count = r->bodies[i].contacts;

        r->bodies[i].contacts = place;
        place = (uint16_t)(place + count);
    }
    for (uint32_t i = 0; i < n; i++) {
        struct body *first = &r->bodies[island_of(r, &r->list.contacts[i])];

        r->list.contacts[first->contacts++].order = (uint16_t)i;
    }
}

bool rest_take_island(struct rest *r)
{
    bool idle = true;

    r->island = island_of(r, rest_contact(r, 0));
    for (r->count = 0; r->first + r->count < r->list.pool->used; r->count++) {
        const struct contact *c = rest_contact(r, r->count);

        if (island_of(r, c) != r->island) {
            break;
        }
        idle = idle && c->idle;
    }
    for (uint32_t i = 0; i < r->count; i++) {
        rest_contact(r, i)->idle = idle;
    }
    return !idle;
}
