/* SPDX-License-Identifier: MIT */
/*
 * Carving: a place that fits lies in the block, aligned to 8, is zeroed, and follows the last one; once one does not fit none does.
 *
 * bound: a block of 64 bytes at most, three sizes of all size_t
 * mutant: src/num/arena.c: if (a->used > a->size) -> if (start > a->size)
 */
#include "proof.h"
#include "num/arena.c"

void proof(void)
{
    uint64_t block[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    struct arena a;
    size_t size = (size_t)proof_range(0, 64), before = 0;
    bool failed = false;

    arena_init(&a, block, size);
    for (int k = 0; k < 3; k++) {
        size_t bytes = (size_t)proof_range(0, UINT32_MAX);
        uint8_t *place = arena_carve(&a, bytes);

        proof_check(!(failed && place));
        failed = failed || !place;
        if (!place) {
            proof_check(a.used > size);
            continue;
        }
        proof_check(place == (uint8_t *)block + before && before % 8 == 0 &&
                    a.used >= before + bytes && a.used <= size);
        before = a.used;
    }
}
