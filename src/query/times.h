/* SPDX-License-Identifier: MIT */
/* times - from when until when an interval that moves steadily touches another one. */
#ifndef CAROM_SRC_QUERY_TIMES_H
#define CAROM_SRC_QUERY_TIMES_H

#include "carom_fix.h"
#include "../num/fix.h"

#define TIMES_BITS 12

/* When an interval may touch another one: from 0 to 2^TIMES_BITS, in a stretch of a way. */
struct times {
    int32_t enter, leave;
};

/* Bits of a divisor, so that what is divided fits 31. */
#define DIVISOR_BITS (30 - TIMES_BITS)

static inline int times_shift(int32_t d)
{
    int shift = fix_bits32((uint32_t)d) - DIVISOR_BITS;

    return shift > 0 ? shift : 0;
}

/*
 * Narrow the times to those at which [low, high], which is so at the start and moves up by `way`, is within
 * `near` of [to_low, to_high]. False when that is never. Divided are 0 <= n <= way, way > 0, less `shift` bits.
 */
static inline bool times_narrow(struct times *t, int32_t low, int32_t high, int32_t way, int shift,
                                int32_t to_low, int32_t to_high, int32_t near)
{
    int32_t enter = to_low - high - near, leave = to_high - low + near;

    if (enter > way || leave < 0) {
        return false;
    }
    if (enter > 0) {
        int32_t at = ((enter >> shift) << TIMES_BITS) / ((way >> shift) + 1);

        t->enter = at > t->enter ? at : t->enter;
    }
    if (leave < way) {
        int32_t at = (((leave >> shift) + 1) << TIMES_BITS) / (way >> shift) + 1;

        t->leave = at < t->leave ? at : t->leave;
    }
    return t->enter <= t->leave;
}

#endif
