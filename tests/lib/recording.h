/* SPDX-License-Identifier: MIT */
/*
 * recording - calls of fuzz.h recorded, and files played that may be anything. A program that records links fuzz*.c compiled
 * with recorded.h.
 */
#ifndef CAROM_TESTS_RECORDING_H
#define CAROM_TESTS_RECORDING_H

#include "carom_replay.h"
#include "fuzz.h"

#define RECORDING_BYTES (1 << 20)

struct recording {
    uint8_t file[RECORDING_BYTES];
    size_t bytes; /* of the file; more than there is room for: it was cut */
};

/*
 * A world of some bodies and random calls, recorded from call `from` on: 0 is from its beginning, beyond all is not at all.
 * Returns the hash of its last state.
 */
uint64_t recording_make(struct recording *r, struct fuzz *f, uint64_t seed, int bodies, int from,
                        int calls);

/* Play a file to its end; the result of the last frame. */
int recording_play(struct carom_replay *player, const uint8_t *bytes, size_t count);
/* The same, and the fault found: it does not end, or leaves a world that is none. NULL: there is none. */
const char *recording_try(struct carom_replay *player, const uint8_t *bytes, size_t count,
                          int *result);

#endif
