/* SPDX-License-Identifier: MIT */
/* fnv - FNV-1a, a hash of bytes, of 64 and of 32 bits. */
#ifndef CAROM_SRC_FNV_H
#define CAROM_SRC_FNV_H

#include <stdint.h>

#define FNV_START 0xcbf29ce484222325u

static inline uint64_t fnv_add(uint64_t hash, uint8_t byte)
{
    return (hash ^ byte) * 0x100000001b3u;
}

#define FNV32_START 0x811c9dc5u

static inline uint32_t fnv32_add(uint32_t hash, uint8_t byte)
{
    return (hash ^ byte) * 0x01000193u;
}

#endif
