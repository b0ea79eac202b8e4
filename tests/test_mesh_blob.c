/* SPDX-License-Identifier: MIT */
/* Reading meshes from blobs: whole and altered ones. */
#include <string.h>

#include "lib/mesh_shapes.h"

#define BLOB_MAX 1024
static uint8_t blob[BLOB_MAX];

static size_t put(size_t at, uint64_t v, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        blob[at++] = (uint8_t)(v >> 8 * i);
    }
    return at;
}

/* The 64-bit FNV-1a prime is 2^40 + 0x1b3. */
static size_t seal(size_t bytes)
{
    uint64_t h = 14695981039346656037u;

    for (size_t i = 0; i < bytes; i++) {
        h ^= blob[i];
        h = (h << 40) + h * 0x1b3;
    }
    return put(bytes, h, 8);
}

static size_t write_blob(void)
{
    size_t at = put(0, 0x314d5243, 4); /* CRM1 */

    at = put(at, 1, 1);
    at = put(at, raw.kind, 1);
    at = put(at, raw.quantum_bits, 1);
    at = put(at, 0, 1);
    at = put(at, raw.vertex_count, 4);
    at = put(at, raw.face_count, 4);
    for (uint32_t i = 0; i < 3 * raw.vertex_count; i++) {
        at = put(at, (uint16_t)raw.vertices[i / 3][i % 3], 2);
    }
    for (uint32_t i = 0; i < 3 * raw.face_count; i++) {
        at = put(at, raw.faces[i / 3][i % 3], 2);
    }
    return seal(at);
}

static void test_read(void)
{
    static _Alignas(8) uint8_t mem[CAROM_BLOB_BYTES(8, 12)];
    struct carom_mesh_raw read, before;
    size_t bytes;

    make_box(100, 200, 300);
    vertices[0][0] = -32768;
    vertices[7][2] = 32767;
    vertices[3][1] = -1;
    bytes = write_blob();
    CHECK_EQ(carom_mesh_read(&read, blob, bytes, mem, sizeof mem), CAROM_OK);
    CHECK_EQ(read.vertex_count, 8);
    CHECK_EQ(read.face_count, 12);
    CHECK_EQ(read.quantum_bits, 10);
    CHECK_EQ(read.kind, CAROM_SOLID);
    CHECK_EQ(memcmp(read.vertices, vertices, 8 * sizeof vertices[0]), 0);
    CHECK_EQ(memcmp(read.faces, faces, 12 * sizeof faces[0]), 0);

    memset(&read, 0x5a, sizeof read);
    before = read;
    CHECK_EQ(carom_mesh_read(NULL, blob, bytes, mem, sizeof mem), CAROM_ERR_NULL);
    CHECK_EQ(carom_mesh_read(&read, NULL, bytes, mem, sizeof mem), CAROM_ERR_NULL);
    CHECK_EQ(carom_mesh_read(&read, blob, bytes, NULL, sizeof mem), CAROM_ERR_NULL);
    CHECK_EQ(carom_mesh_read(&read, blob, bytes, mem, sizeof mem - 1), CAROM_ERR_MEMORY);
    CHECK_EQ(carom_mesh_read(&read, blob, bytes, mem + 2, sizeof mem - 2), CAROM_ERR_MEMORY);
    CHECK_EQ(memcmp(&read, &before, sizeof read), 0);
}

/*
 * Every truncation and every altered byte is refused, and so are wrong headers with a correct check
 * sum.
 */
static void test_read_altered(void)
{
    static _Alignas(8) uint8_t mem[CAROM_BLOB_BYTES(8, 12)];
    static const struct {
        size_t at;
        int bytes;
        uint32_t value;
    } lies[] = {{0, 1, 'X'}, {4, 1, 2},      {5, 1, 2}, {6, 1, 6},
                {6, 1, 21},  {7, 1, 1},      {8, 4, 2}, {8, 4, 65536},
                {12, 4, 0},  {12, 4, 65536}, {8, 4, 9}, {12, 4, 1u << 31}};
    struct carom_mesh_raw read;
    size_t bytes;

    make_box(100, 200, 300);
    bytes = write_blob();
    for (size_t n = 0; n < bytes; n++) {
        CHECK_EQ(carom_mesh_read(&read, blob, n, mem, sizeof mem), CAROM_ERR_FORMAT);
        blob[n] ^= (uint8_t)(1 << n % 8);
        CHECK_EQ(carom_mesh_read(&read, blob, bytes, mem, sizeof mem), CAROM_ERR_FORMAT);
        blob[n] ^= (uint8_t)(1 << n % 8);
    }
    CHECK_EQ(carom_mesh_read(&read, blob, bytes + 1, mem, sizeof mem), CAROM_ERR_FORMAT);
    for (unsigned i = 0; i < sizeof lies / sizeof lies[0]; i++) {
        write_blob();
        put(lies[i].at, lies[i].value, lies[i].bytes);
        seal(bytes - 8);
        CHECK_EQ(carom_mesh_read(&read, blob, bytes, mem, sizeof mem), CAROM_ERR_FORMAT);
    }
    write_blob();
    CHECK_EQ(carom_mesh_read(&read, blob, bytes, mem, sizeof mem), CAROM_OK);
    raw.vertex_count = 2;
    CHECK_EQ(carom_mesh_read(&read, blob, write_blob(), mem, sizeof mem), CAROM_ERR_FORMAT);
    raw.vertex_count = 8;
    raw.face_count = 0;
    CHECK_EQ(carom_mesh_read(&read, blob, write_blob(), mem, sizeof mem), CAROM_ERR_FORMAT);
}

const struct test tests_mesh_blob[] = {
    {"mesh_blob/read", test_read},
    {"mesh_blob/read_altered", test_read_altered},
    {0},
};
