/* SPDX-License-Identifier: MIT */
/*
 * Taking from a pool: its places in order, then refusals; the peak is the most that was ever in use.
 *
 * bound: all pools of up to 2^31 places with used <= size
 * mutant: src/num/arena.c: if (p->used >= p->size) -> if (p->used > p->size)
 */
#include "proof.h"
#include "num/arena.c"

void proof(void)
{
    struct pool p = {(uint32_t)proof_range(0, INT32_MAX), (uint32_t)proof_range(0, INT32_MAX),
                     (uint32_t)proof_range(0, INT32_MAX), (uint32_t)proof_range(0, INT32_MAX)};
    const struct pool was = p;
    int32_t place;

    proof_assume(p.used <= p.size && p.peak >= p.used && p.peak <= p.size);
    place = pool_take(&p);
    if (was.used == was.size) {
        proof_check(place == -1 && p.refused == was.refused + 1 && p.used == was.used &&
                    p.peak == was.peak);
    } else {
        proof_check(place == (int32_t)was.used && p.used == was.used + 1 &&
                    p.refused == was.refused);
        proof_check(p.peak == (was.peak > p.used ? was.peak : p.used) && p.peak <= p.size);
    }
    pool_clear(&p);
    proof_check(p.used == 0 && p.size == was.size);
}
