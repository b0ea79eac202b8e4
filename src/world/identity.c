/* SPDX-License-Identifier: MIT */
/* Numbers and ids of bodies, and the caller's pointer of a body. */
#include "world.h"

#define NUMBER_MASK ((1u << WORLD_NUMBER_BITS) - 1)
/* Numbers are below 4095, the largest capacity, and ids fit 28 bits. */
_Static_assert(NUMBER_MASK >= 4095, "a number has room in an id");

bool world_find_body(const struct carom_world *w, int *body)
{
    uint32_t id = (uint32_t)*body, number = id & NUMBER_MASK;
    uint32_t generation = id >> WORLD_NUMBER_BITS;

    /* a negative id has a generation above all */
    if (number >= w->body_count || !w->bodies[number].def.mesh ||
        (generation != 0 && generation != w->bodies[number].def.generation)) {
        return false;
    }
    *body = (int)number;
    return true;
}

int carom_body_id(const struct carom_world *w, int body)
{
    if (!w) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    return body | w->bodies[body].def.generation << WORLD_NUMBER_BITS;
}

int carom_body_number(int id)
{
    return id < 0 ? id : (int)((uint32_t)id & NUMBER_MASK);
}

int carom_body_set_user(struct carom_world *w, int body, void *user)
{
    if (!w) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    w->bodies[body].def.user = user;
    return CAROM_OK;
}

void *carom_body_user(const struct carom_world *w, int body)
{
    return w && world_find_body(w, &body) ? w->bodies[body].def.user : NULL;
}
