/* SPDX-License-Identifier: MIT */
/* saved - small worlds, each with a snapshot that tests change; see host_bytes.c. */
#ifndef CAROM_TESTS_SAVED_H
#define CAROM_TESTS_SAVED_H

#include "fuzz.h"

#define SAVED_BYTES CAROM_SNAPSHOT_BYTES(FUZZ_CAPS)
#define SAVED_WORLDS                                                                               \
    8 /* 0: a pile; 1: joints and a kinematic body; the others: after random calls */

struct saved {
    struct fuzz fuzz;
    struct carom_world *world; /* that of fuzz */
    uint8_t good[SAVED_BYTES];
    size_t size;
    uint64_t hash;
};

/* Make a world and its snapshot, the same every time. */
void saved_make(struct saved *s, int number);
/* One of few bodies, of any number: its steps are cheap. */
void saved_make_small(struct saved *s, int number);
/* Load bytes, and the fault in that: NULL if they are taken, or refused with nothing changed. */
const char *saved_try_load(struct saved *s, const uint8_t *bytes, size_t size, int *result);
/* Go back to the snapshot: the fault in that. */
const char *saved_back(struct saved *s);

#endif
