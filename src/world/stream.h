/* SPDX-License-Identifier: MIT */
/* stream - numbers that are written into a snapshot, read from one, or hashed: little-endian on every machine. */
#ifndef CAROM_SRC_STREAM_H
#define CAROM_SRC_STREAM_H

#include "../num/fnv.h"
#include "world.h"

/* Bytes going out or coming in; `bytes` may be NULL when only their number or hash is wanted. */
struct stream {
    uint8_t *out;
    const uint8_t *in;
    size_t size, at;
    uint64_t fnv;
    carom_v3_q40 gravity; /* that was read */
    size_t drives;        /* where those of kinematic bodies begin */
    bool loading, failed;
};

/* One number of `bytes` bytes; returns what the stream holds there. */
uint64_t stream_word(struct stream *s, uint64_t v, int bytes);
/* Numbers change only when they are read: a world that is saved stays as it is. */
void stream_64(struct stream *s, int64_t *v);
void stream_32(struct stream *s, int32_t *v);
void stream_16(struct stream *s, uint16_t *v);
void stream_8(struct stream *s, uint8_t *v);
/* A count or a constant that must be what it is here. */
void stream_expect(struct stream *s, uint32_t v, int bytes);
void stream_vector64(struct stream *s, int64_t v[3]);
void stream_vector32(struct stream *s, int32_t *v, int n);
/* A byte that is 0 or 1. */
void stream_flag(struct stream *s, bool *v);
/* A count of at most so many. */
uint32_t stream_count(struct stream *s, uint32_t count, uint32_t most);
/*
 * Whether there is a section of what few worlds have: one that is written when it is `wanted`, or comes
 * next of what is read.
 */
bool stream_section(struct stream *s, uint32_t tag, bool wanted);

#endif
