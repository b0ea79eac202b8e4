/* SPDX-License-Identifier: MIT */
/* chance - where a test takes what is left to chance: random numbers, or the bytes of a fuzzer. */
#ifndef CAROM_TESTS_CHANCE_H
#define CAROM_TESTS_CHANCE_H

#include "test.h"

#include <stdbool.h>
#include <stddef.h>

struct chance {
    struct test_random r;
    const uint8_t *bytes; /* NULL: random numbers; else the next byte */
    size_t left;
};

/* Any number from `low` to `high`; when there are no bytes left, `low`. */
int64_t chance_range(struct chance *c, int64_t low, int64_t high);
/* Any of 0 .. count - 1. */
int chance_pick(struct chance *c, int count);
/* Any number: now and then an extreme one, else within +- 2^bits. */
int64_t chance_number(struct chance *c, int bits);
/* True if all bytes have been used; random numbers never are. */
bool chance_over(const struct chance *c);

#endif
