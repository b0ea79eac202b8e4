/* SPDX-License-Identifier: MIT */
/*
 * A block of any size is carved in order, zeroed, and refuses once it is full; a pool counts what it gives and refuses.
 *
 * machine: gcc_x86_32 gcc_x86_64
 * mutant: arena_carve in src/num/arena.c: if (a->used > a->size) -> if (start > a->size)
 * mutant: pool_take in src/num/arena.c: p->used >= p->size -> p->used > p->size
 */
#include "contract.h"
#include "num/arena.c"

/*@ logic integer eights(integer bytes) = (bytes + 7) - (bytes + 7) % 8; */

/*@ requires \valid(a);
    assigns *a;
    ensures a->base == (uint8_t *)mem && a->size == bytes && a->used == 0; */
void arena_init(struct arena *a, void *mem, size_t bytes);

/*@ requires \valid(a) && \valid(a->base + (0 .. a->size - 1)) && \separated(a, a->base + (0 .. a->size - 1));
    requires a->size < SIZE_MAX;
    requires a->used % 8 == 0 || a->used == SIZE_MAX;
    assigns a->used, a->base[a->used .. a->size - 1];
    ensures a->used % 8 == 0 || a->used == SIZE_MAX;
    ensures fits: \old(a->used) + eights(bytes) <= a->size ==>
        \result == a->base + \old(a->used) && a->used == \old(a->used) + eights(bytes);
    ensures zeroed: a->used <= a->size ==> zeroed(a->base + \old(a->used), a->used - \old(a->used));
    ensures does_not_fit: \old(a->used) + eights(bytes) > a->size ==> \result == \null && a->used > a->size; */
void *arena_carve(struct arena *a, size_t bytes);

/*@ requires \valid(p) && p->size <= INT32_MAX && p->used <= p->size;
    assigns *p;
    ensures p->size == \old(p->size) && p->used <= p->size;
    ensures full: \old(p->used) == p->size ==>
        \result == -1 && p->used == p->size && p->peak == \old(p->peak) && p->refused == (uint32_t)(\old(p->refused) + 1);
    ensures taken: \old(p->used) < p->size ==>
        \result == \old(p->used) && p->used == \result + 1 && p->refused == \old(p->refused) &&
        p->peak == \max(\old(p->peak), p->used); */
int32_t pool_take(struct pool *p);

/*@ requires \valid(p);
    assigns p->used;
    ensures p->used == 0; */
static inline void pool_clear(struct pool *p);
