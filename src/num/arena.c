/* SPDX-License-Identifier: MIT */
/* Carve a block into arrays; take places of a pool. */
#include "arena.h"

void arena_init(struct arena *a, void *mem, size_t bytes)
{
    a->base = (uint8_t *)mem;
    a->size = bytes;
    a->used = 0;
}

void *arena_carve(struct arena *a, size_t bytes)
{
    size_t start = a->used;
    size_t rounded = (bytes + 7) & ~(size_t)7;

    /* sticky: once a carve fails used stays past size, so no later carve succeeds */
    if (rounded < bytes || start > SIZE_MAX - rounded) {
        a->used = SIZE_MAX;
        return NULL;
    }
    a->used = start + rounded;
    if (a->used > a->size) {
        return NULL;
    }
    memset(a->base + start, 0, rounded);
    return a->base + start;
}

int32_t pool_take(struct pool *p)
{
    if (p->used >= p->size) {
        p->refused++;
        return -1;
    }
    if (++p->used > p->peak) {
        p->peak = p->used;
    }
    return (int32_t)(p->used - 1);
}
