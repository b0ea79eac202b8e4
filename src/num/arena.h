/* SPDX-License-Identifier: MIT */
/*
 * arena - carve one block of the caller's into arrays, and pools that count.
 *
 * A block is carved once and nothing is given back. Carved memory is zeroed.
 */
#ifndef CAROM_SRC_ARENA_H
#define CAROM_SRC_ARENA_H

#include "fix.h"

struct arena {
    uint8_t *base;
    size_t size;
    size_t used; /* grows past size if a carve does not fit, so that the need is known */
};

/* mem must be aligned to 8 bytes. */
void arena_init(struct arena *a, void *mem, size_t bytes);

/* bytes of zeroed memory aligned to 8, or NULL when the block is too small. */
void *arena_carve(struct arena *a, size_t bytes);

/*
 * Carve `count` elements of the type that the pointer `to` points at, and point `to` at the first.
 */
#ifdef __cplusplus
#define ARENA_POINTER_(to) (decltype(to))
#else
#define ARENA_POINTER_(to)
#endif
#define ARENA_CARVE(arena, to, count)                                                              \
    ((to) = ARENA_POINTER_(to) arena_carve(arena, (count) * sizeof *(to)))

/* Counters of a pool: size, places in use, most ever in use, requests refused. */
struct pool {
    uint32_t size;
    uint32_t used;
    uint32_t peak;
    uint32_t refused;
};

/* Take the next place of a pool: returns its index, or -1 if the pool is full. */
int32_t pool_take(struct pool *p);
static inline void pool_clear(struct pool *p)
{
    p->used = 0;
}

#endif
