/* SPDX-License-Identifier: MIT */
/* times - from when until when an interval that moves steadily touches another one. */
#ifndef CAROM_SRC_QUERY_TIMES_H
#define CAROM_SRC_QUERY_TIMES_H

#include "carom_fix.h"
#include "../num/fix.h"

#define TIMES_BITS 12

/* The times at which an interval may touch another one, from 0 to 2^TIMES_BITS of a stretch. */
struct times {
    int32_t enter, leave;
};

/* Bits of a divisor, such that the dividend fits 31 bits. */
#define DIVISOR_BITS (30 - TIMES_BITS)

static inline int times_shift(int32_t d)
{
    int shift = fix_bits32((uint32_t)d) - DIVISOR_BITS;

    return shift > 0 ? shift : 0;
}

/*
 * Narrow the times to those at which [low, high] is within `near` of [to_low, to_high]; low and
 * high are places at the start, and both grow by `way` over the stretch. Returns false if no time
 * is left. Both dividends are 0 .. way, way > 0; `shift` bits of both sides are dropped, rounding
 * outwards.
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
