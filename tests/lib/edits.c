/* SPDX-License-Identifier: MIT */
/* Changes that reach what a format checks: whole numbers as well as bytes and bits, and pieces from elsewhere. */
#include "edits.h"

#include <string.h>

#include "bytes.h"
#include "num/fnv.h"

/* Another number: any, one near to it, one of other bits, a multiple. */
static uint64_t other_number(struct chance *c, uint64_t v, int bytes)
{
    const int bits = 8 * bytes;
    const int64_t given = (int64_t)(v << (64 - bits)) >> (64 - bits);

    switch (chance_pick(c, 5)) {
    case 0:
        return (uint64_t)chance_number(c, bits - 2);
    case 1:
        return v + (uint64_t)chance_range(c, -3, 3);
    case 2:
        return v ^ (uint64_t)1 << chance_pick(c, bits);
    case 3:
        return v + (uint64_t)(given / 8) * (uint64_t)chance_range(c, -16, 64);
    default:
        return 0 - v;
    }
}

/* A piece from elsewhere. */
static void copy_piece(struct chance *c, uint8_t *bytes, size_t size)
{
    const size_t to = (size_t)chance_range(c, 0, (int64_t)size - 1);
    const size_t from = (size_t)chance_range(c, 0, (int64_t)size - 1);
    const size_t room = size - (to > from ? to : from), length = (size_t)chance_pick(c, 64) + 1;

    memmove(bytes + to, bytes + from, length < room ? length : room);
}

static void edit(struct chance *c, uint8_t *bytes, size_t size)
{
    static const int lengths[] = {1, 2, 4, 8, 8};
    const int n = lengths[chance_pick(c, 5)];
    const size_t at = (size_t)chance_range(c, 0, (int64_t)size - 1);

    if (at + (size_t)n > size) {
        bytes[at] = (uint8_t)chance_pick(c, 256);
    } else {
        bytes_put(bytes + at, other_number(c, bytes_number(bytes + at, n), n), n);
    }
}

void edit_bytes(struct chance *c, uint8_t *bytes, size_t size)
{
    for (int n = chance_pick(c, 4); n >= 0 && size > 0; n--) {
        if (chance_pick(c, 8) == 0) {
            copy_piece(c, bytes, size);
        } else {
            edit(c, bytes, size);
        }
    }
}

void edit_mend32(uint8_t *bytes, size_t size)
{
    uint32_t sum = FNV32_START;

    for (size_t i = 0; i + 4 < size; i++) {
        sum = fnv32_add(sum, bytes[i]);
    }
    if (size >= 4) {
        bytes_put(bytes + size - 4, sum, 4);
    }
}

static uint8_t *put(uint8_t *at, uint32_t v, int n)
{
    bytes_put(at, v, n);
    return at + n;
}

size_t edit_write_blob(const struct carom_mesh_raw *raw, uint8_t *blob)
{
    uint8_t *at = blob + 8;

    memcpy(blob, "CRM1\1", 5);
    put(put(put(blob + 5, raw->kind, 1), raw->quantum_bits, 1), 0, 1);
    at = put(put(at, raw->vertex_count, 4), raw->face_count, 4);
    for (uint32_t i = 0; i < 3 * raw->vertex_count; i++) {
        at = put(at, (uint16_t)raw->vertices[i / 3][i % 3], 2);
    }
    for (uint32_t i = 0; i < 3 * raw->face_count; i++) {
        at = put(at, raw->faces[i / 3][i % 3], 2);
    }
    bytes_mend(blob, (size_t)(at - blob) + 8);
    return (size_t)(at - blob) + 8;
}
