/* SPDX-License-Identifier: MIT */
/* fnv - 64-bit FNV-1a, a hash of bytes. */
#ifndef CAROM_SRC_FNV_H
#define CAROM_SRC_FNV_H

#include <stdint.h>

#define FNV_START 0xcbf29ce484222325u

static inline uint64_t fnv_add(uint64_t hash, uint8_t byte)
{
    return (hash ^ byte) * 0x100000001b3u;
}

#endif
