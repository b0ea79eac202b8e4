/* SPDX-License-Identifier: MIT */
/*
 * arena - carve one caller-supplied block into named pools.
 *
 * A block is carved once and never given back; what is carved is zeroed. Pools count what they
 * hold.
 */
#ifndef CAROM_SRC_ARENA_H
#define CAROM_SRC_ARENA_H

#include "fix.h"

struct arena {
    uint8_t *base;
    size_t size;
    size_t used; /* grows past size when a carve does not fit, so that the need is known */
};

/* mem must be aligned to 8 bytes. */
void arena_init(struct arena *a, void *mem, size_t bytes);

/* bytes of zeroed memory aligned to 8, or NULL when the block is too small. */
void *arena_carve(struct arena *a, size_t bytes);

/* Carve room for `count` of what the pointer `to` points at; `to` then points at the first. */
#ifdef __cplusplus
#define ARENA_POINTER_(to) (decltype(to))
#else
#define ARENA_POINTER_(to)
#endif
#define ARENA_CARVE(arena, to, count)                                                              \
    ((to) = ARENA_POINTER_(to) arena_carve(arena, (count) * sizeof *(to)))

/* Counters of one pool: how many it can hold, holds, held at most, and how many it turned away. */
struct pool {
    uint32_t size;
    uint32_t used;
    uint32_t peak;
    uint32_t refused;
};

/* Takes the next place of the pool and returns its index, or -1 when it is full. */
int32_t pool_take(struct pool *p);
static inline void pool_clear(struct pool *p)
{
    p->used = 0;
}

#endif
