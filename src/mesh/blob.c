/* SPDX-License-Identifier: MIT */
/*
 * The binary form of a mesh, version 1. Numbers are little-endian, signed ones two's complement,
 * and nothing is padded. V and F are the numbers of vertices and faces.
 *
 *   offset        bytes
 *   0             4      the characters CRM1
 *   4             1      version, 1
 *   5             1      kind, enum carom_mesh_kind
 *   6             1      quantum_bits, 7 .. 20
 *   7             1      zero
 *   8             4      V, 3 .. 65535
 *   12            4      F, 1 .. 65535
 *   16            6 V    vertices: int16 x, y, z
 *   16 + 6V       6 F    faces: uint16 vertex numbers
 *   16 + 6V + 6F  8      64-bit FNV-1a of every byte before it
 */
#include "../num/fnv.h"
#include "mesh.h"

#define BLOB_HEADER  16
#define BLOB_HASH    8
#define BLOB_VERSION 1

/* A number of `bytes` bytes. */
static uint64_t read_number(const uint8_t *at, int bytes)
{
    uint64_t v = 0;

    while (bytes-- > 0) {
        v = v << 8 | at[bytes];
    }
    return v;
}

static uint64_t hash_bytes(const uint8_t *at, size_t bytes)
{
    uint64_t hash = FNV_START;

    for (size_t i = 0; i < bytes; i++) {
        hash = fnv_add(hash, at[i]);
    }
    return hash;
}

/* Read the header into raw. Returns false if the blob is not whole. */
static bool read_header(struct carom_mesh_raw *raw, const uint8_t *at, size_t bytes)
{
    static const uint8_t start[5] = {'C', 'R', 'M', '1', BLOB_VERSION};
    uint64_t content;

    if (bytes < BLOB_HEADER + BLOB_HASH || memcmp(at, start, sizeof start) != 0 || at[7] != 0) {
        return false;
    }
    raw->kind = at[5];
    raw->quantum_bits = at[6];
    raw->vertex_count = (uint32_t)read_number(at + 8, 4);
    raw->face_count = (uint32_t)read_number(at + 12, 4);
    if (raw->kind > CAROM_SURFACE || raw->quantum_bits < 7 || raw->quantum_bits > 20 ||
        raw->vertex_count < 3 || raw->vertex_count > 65535 || raw->face_count < 1 ||
        raw->face_count > 65535) {
        return false;
    }
    content = BLOB_HEADER + (uint64_t)6 * raw->vertex_count + (uint64_t)6 * raw->face_count;
    return bytes == content + BLOB_HASH &&
           read_number(at + content, BLOB_HASH) == hash_bytes(at, (size_t)content);
}

int carom_mesh_read(struct carom_mesh_raw *raw, const void *blob, size_t blob_bytes, void *mem,
                    size_t bytes)
{
    const uint8_t *at = (const uint8_t *)blob;
    struct carom_mesh_raw read;
    int16_t(*vertices)[3] = (int16_t(*)[3])mem;
    uint16_t(*faces)[3];

    if (!raw || !blob || !mem) {
        return CAROM_ERR_NULL;
    }
    if (!read_header(&read, at, blob_bytes)) {
        return CAROM_ERR_FORMAT;
    }
    if ((uintptr_t)mem % 8 || bytes < CAROM_BLOB_BYTES(read.vertex_count, read.face_count)) {
        return CAROM_ERR_MEMORY;
    }
    faces = (uint16_t(*)[3])(vertices + read.vertex_count);
    at += BLOB_HEADER;
    for (uint32_t i = 0; i < 3 * read.vertex_count; i++, at += 2) {
        /* by value, not by representation: 0x8000 and above are negative */
        int32_t c = (int32_t)read_number(at, 2);

        vertices[i / 3][i % 3] = (int16_t)(c < 0x8000 ? c : c - 0x10000);
    }
    for (uint32_t i = 0; i < 3 * read.face_count; i++, at += 2) {
        faces[i / 3][i % 3] = (uint16_t)read_number(at, 2);
    }
    read.vertices = (const int16_t(*)[3])vertices;
    read.faces = (const uint16_t(*)[3])faces;
    *raw = read;
    return CAROM_OK;
}
