/* SPDX-License-Identifier: MIT */
/* bytes - numbers in the bytes of a file, lowest byte first, and its check sum; written from SPEC.md, without the engine's stream. */
#ifndef CAROM_TESTS_BYTES_H
#define CAROM_TESTS_BYTES_H

#include <stddef.h>
#include <stdint.h>

/* The number in the next `n` bytes. */
static inline uint64_t bytes_number(const uint8_t *bytes, int n)
{
    uint64_t v = 0;

    while (n-- > 0) {
        v = v << 8 | bytes[n];
    }
    return v;
}

static inline void bytes_put(uint8_t *bytes, uint64_t v, int n)
{
    for (int i = 0; i < n; i++) {
        bytes[i] = (uint8_t)(v >> 8 * i);
    }
}

/* The FNV-1a of 64 bits. */
static inline uint64_t bytes_fnv64(const uint8_t *bytes, size_t n)
{
    uint64_t sum = 0xcbf29ce484222325u;

    for (size_t i = 0; i < n; i++) {
        sum = (sum ^ bytes[i]) * 0x100000001b3u;
    }
    return sum;
}

/* Make the check sum at the end of a snapshot or a blob that of all bytes before. */
static inline void bytes_mend(uint8_t *bytes, size_t size)
{
    if (size >= 8) {
        bytes_put(bytes + size - 8, bytes_fnv64(bytes, size - 8), 8);
    }
}

#endif
