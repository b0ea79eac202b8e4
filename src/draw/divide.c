/* SPDX-License-Identifier: MIT */
/* Division by a table of inverses, for processors that cannot divide. */
#include "draw.h"

/* 2^32 / d, rounded down. */
#define INVERSE(d)    (uint32_t)(((uint64_t)1 << 32) / (d))
#define INVERSE_4(d)  INVERSE(d), INVERSE((d) + 1), INVERSE((d) + 2), INVERSE((d) + 3)
#define INVERSE_16(d) INVERSE_4(d), INVERSE_4((d) + 4), INVERSE_4((d) + 8), INVERSE_4((d) + 12)
#define INVERSE_64(d)                                                                              \
    INVERSE_16(d), INVERSE_16((d) + 16), INVERSE_16((d) + 32), INVERSE_16((d) + 48)

/* The inverse of 1 does not fit 32 bits: a little less. */
static const uint32_t inverses[257] = {
    0,
    UINT32_MAX,
    INVERSE(2),
    INVERSE(3),
    INVERSE_4(4),
    INVERSE_4(8),
    INVERSE_4(12),
    INVERSE_16(16),
    INVERSE_16(32),
    INVERSE_16(48),
    INVERSE_64(64),
    INVERSE_64(128),
    INVERSE_64(192),
    INVERSE(256),
};

/*
 * For d < 256 the inverse is exact to 1 in 2^32, so the quotient lacks at most 1. Above, the
 * divisor is rounded up to 8 bits: each step leaves less than a 64th of the rest, until at most two
 * divisors are left.
 */
uint32_t draw_quotient(uint32_t n, uint32_t d)
{
    uint32_t quotient, part, inverse;
    int shift;

    CAROM_ASSERT(n >> 31 == 0 && d > 0 && d >> 16 == 0);
    if (d < 256) {
        quotient = (uint32_t)((uint64_t)n * inverses[d] >> 32);
        return quotient + (n - quotient * d >= d);
    }
    shift = fix_bits32(d) - 8;
    inverse = inverses[(d >> shift) + 1];
    quotient = 0;
    do {
        part = (uint32_t)((uint64_t)(n >> shift) * inverse >> 32);
        quotient += part;
        n -= part * d;
    } while (part > 0);
    for (; n >= d; n -= d) {
        quotient++;
    }
    return quotient;
}
