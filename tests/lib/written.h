/* SPDX-License-Identifier: MIT */
/* written - the file that a recorder of a test source writes, or that it makes byte by byte; playing it. */
#ifndef CAROM_TEST_WRITTEN_H
#define CAROM_TEST_WRITTEN_H

#include <string.h>

#include "carom_replay.h"
#include "test.h"

static uint8_t file[8192];
static size_t file_bytes;

/* For carom_record_begin: append to the file, which must have room. */
static inline void write_file(void *user, const void *bytes, size_t count)
{
    (void)user;
    CHECK_AT_MOST(file_bytes + count, sizeof file);
    if (file_bytes + count <= sizeof file) {
        memcpy(file + file_bytes, bytes, count);
        file_bytes += count;
    }
}

/* Append a number of so many bytes, the lowest first. */
static inline void put(uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        const uint8_t byte = (uint8_t)(value >> 8 * i);

        write_file(NULL, &byte, 1);
    }
}

/* Append an `n` of the format. */
static inline void put_n(int64_t v)
{
    uint64_t left = v < 0 ? ~((uint64_t)v * 2) : (uint64_t)v * 2;

    for (; left > 0x7f; left >>= 7) {
        put(left % 0x80 + 0x80, 1);
    }
    put(left, 1);
}

static inline void put_zeros(int count)
{
    for (int i = 0; i < count; i++) {
        put_n(0);
    }
}

/* Append a mesh that does not move. */
static inline void put_mesh(const struct carom_mesh_raw *raw)
{
    put(0x3d, 1);
    put(0, 1);
    put(raw->kind, 1);
    put(raw->quantum_bits, 1);
    put(raw->vertex_count, 4);
    put(raw->face_count, 4);
    for (uint32_t i = 0; i < 3 * raw->vertex_count; i++) {
        put((uint16_t)raw->vertices[i / 3][i % 3], 2);
    }
    for (uint32_t i = 0; i < 3 * raw->face_count; i++) {
        put(raw->faces[i / 3][i % 3], 2);
    }
}

/* Play so many bytes of the file in so much memory; returns the result it ends with. */
static inline int play_file(struct carom_replay *player, size_t bytes, void *room, size_t memory)
{
    int result = carom_replay_begin(player, file, bytes, room, memory);

    while (result == CAROM_OK || result == CAROM_REPLAY_FRAME) {
        result = carom_replay_frame(player);
        if (result == CAROM_REPLAY_END) {
            break;
        }
    }
    return result;
}

#endif
