/* SPDX-License-Identifier: MIT */
/* List the contacts in the order of their islands. */
#include "parts.h"

/* The island of a contact: a of a pair moves. */
static uint16_t island_of(const struct rest *r, const struct contact *c)
{
    return rest_body(r, c, 0)->island.lowest;
}

void rest_list_islands(struct rest *r)
{
    const uint32_t n = r->list.pool->used;
    uint16_t place = 0;

    island_begin(r->bodies, r->body_count);
    for (uint32_t i = 0; i < n; i++) {
        island_join(r->bodies, &r->pairs[r->list.contacts[i].key.pair]);
    }
    if (r->joints.calls) {
        r->joints.calls->join_solved(r);
    }
    island_end(r->bodies, r->body_count);
    for (uint32_t i = 0; i < r->body_count; i++) {
        r->bodies[i].solve.contacts = 0;
    }
    for (uint32_t i = 0; i < n; i++) {
        r->bodies[island_of(r, &r->list.contacts[i])].solve.contacts++;
    }
    for (uint32_t i = 0; i < r->body_count; i++) {
        uint16_t count = r->bodies[i].solve.contacts;

        r->bodies[i].solve.contacts = place;
        place = (uint16_t)(place + count);
    }
    for (uint32_t i = 0; i < n; i++) {
        struct body *first = &r->bodies[island_of(r, &r->list.contacts[i])];

        r->list.contacts[first->solve.contacts++].order = (uint16_t)i;
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
    r->joints.first = 0;
    idle = (!r->joints.calls || r->joints.calls->take(r)) && idle;
    for (uint32_t i = 0; i < r->count; i++) {
        rest_contact(r, i)->idle = idle;
    }
    return !idle;
}
