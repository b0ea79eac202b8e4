/* SPDX-License-Identifier: MIT */
/*
 * stream - numbers written into a snapshot, read from one, or hashed: little-endian on every
 * machine.
 */
#ifndef CAROM_SRC_STREAM_H
#define CAROM_SRC_STREAM_H

#include "../num/fnv.h"
#include "world.h"

/* Bytes going out or coming in. `out` may be NULL if only their number or hash is wanted. */
struct stream {
    uint8_t *out;
    const uint8_t *in;
    size_t size, at;
    uint64_t fnv;
    carom_v3_q40 gravity; /* as read */
    size_t drives;        /* where the drives of kinematic bodies begin */
    struct body *into;    /* bodies of the world to load into; NULL while saving */
    bool loading, failed;
};

/* Pass a number of `bytes` bytes; returns the number that the stream holds there. */
uint64_t stream_word(struct stream *s, uint64_t v, int bytes);
/* Pass a number; *v changes only when reading, so a world that is saved stays as it is. */
void stream_64(struct stream *s, int64_t *v);
void stream_32(struct stream *s, int32_t *v);
void stream_16(struct stream *s, uint16_t *v);
void stream_8(struct stream *s, uint8_t *v);
/* Pass a count or constant that must be equal when read. */
void stream_expect(struct stream *s, uint32_t v, int bytes);
void stream_vector64(struct stream *s, int64_t v[3]);
void stream_vector32(struct stream *s, int32_t *v, int n);
/* Pass a byte that is 0 or 1. */
void stream_flag(struct stream *s, bool *v);
/* Pass a count of at most `most`. */
uint32_t stream_count(struct stream *s, uint32_t count, uint32_t most);
/*
 * True if a section of what few worlds have is there: when writing if it is `wanted`, when reading
 * if its tag comes next.
 */
bool stream_section(struct stream *s, uint32_t tag, bool wanted);

#endif
