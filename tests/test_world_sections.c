/* SPDX-License-Identifier: MIT */
/*
 * Sections of a snapshot that say what cannot be, with a corrected check sum: a list of pairs that ends early, forces of a body that
 * is not there. They are refused, and the world is as it was; the snapshot itself is taken.
 */
#include <string.h>

#include "carom_body.h"
#include "lib/boxes.h"
#include "lib/bytes.h"
#include "lib/one_world.h"

#define CAPS 6, 15, 64, 128, 0, 512, 0, 4

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static uint8_t saved[4096], changed[4096];
static size_t size;

/* Three cubes in one place, which pass through each other, of which the middle one is taken away; a torque on the last. */
static void make(bool with_middle)
{
    static const carom_v3_q40 weak = {{1 << 20, 0, 0}};
    const struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
    int result;

    boxes_begin();
    boxes_make(0, 512, 512, 512);
    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    for (int i = 0; i < 3; i++) {
        struct carom_body_def def = boxes_def(0, 300 * i, 0, 0);

        def.overlap = CAROM_OVERLAP_PASS;
        CHECK_EQ(carom_body_add(world, &def), i);
    }
    CHECK_EQ(carom_body_set_torque(world, 2, &weak), CAROM_OK);
    if (!with_middle) {
        CHECK_EQ(carom_body_remove(world, 1), CAROM_OK);
    }
    result = carom_snapshot_save(world, saved, sizeof saved);
    CHECK_MORE(result, 0);
    size = (size_t)result;
    memcpy(changed, saved, sizeof saved);
}

/* Where a section begins, after its tag of four bytes. */
static size_t section(const char *tag)
{
    for (size_t i = 0; i + 4 <= size; i++) {
        if (memcmp(saved + i, tag, 4) == 0) {
            return i + 4;
        }
    }
    CHECK(false);
    return 4;
}

/* Three pairs are announced, and the snapshot ends after each byte of them but the last. */
static void test_pairs(void)
{
    size_t at;

    make(true);
    at = section("THR1");
    CHECK_EQ(bytes_number(saved + at, 4), 3);
    for (size_t bytes = at + 4; bytes < at + 4 + 3 * 4; bytes++) {
        bytes_mend(changed, bytes + 8);
        REFUSE(carom_snapshot_load(world, changed, bytes + 8), CAROM_ERR_FORMAT);
        memcpy(changed, saved, sizeof saved);
        REFUSE(carom_snapshot_load(world, changed, bytes),
               CAROM_ERR_FORMAT); /* and there is no sum */
    }
    CHECK_EQ(carom_snapshot_load(world, saved, size), CAROM_OK);
}

/* Forces of a place without a body, and of one beyond the last. */
static void test_forces(void)
{
    size_t at;

    make(false);
    at = section("FOC1");
    CHECK_EQ(bytes_number(saved + at, 4), 1);
    CHECK_EQ(bytes_number(saved + at + 4, 2), 2);
    for (uint64_t body = 0; body < 5; body++) {
        bytes_put(changed + at + 4, body, 2);
        bytes_mend(changed, size);
        if (body == 1 || body > 2) {
            REFUSE(carom_snapshot_load(world, changed, size), CAROM_ERR_FORMAT);
        } else {
            CHECK_EQ(carom_snapshot_load(world, changed, size), CAROM_OK);
            CHECK_EQ(carom_snapshot_load(world, saved, size), CAROM_OK);
        }
    }
}

/* A section in which each filter is the usual one, and a filter of zeros, which a call takes for the usual one. */
static void test_filters(void)
{
    static const struct carom_filter own = {2, 3, -1};
    size_t at;

    make(true);
    CHECK_EQ(carom_body_set_filter(world, 1, &own), CAROM_OK);
    size = (size_t)carom_snapshot_save(world, saved, sizeof saved);
    at = section("FLT1");
    CHECK_EQ(bytes_number(saved + at + 6, 6), 0xffff00030002u);
    for (int body = 0; body < 3; body++) {
        for (int k = 0; k < 3; k++) {
            memcpy(changed, saved, size);
            bytes_put(changed + at + 6, k == 2 ? 0xffff00030002u : 0xffff0001u, 6);
            bytes_put(changed + at + 6 * (size_t)body, k == 0 ? 0xffff0001u : (uint64_t)(k - 1), 6);
            bytes_mend(changed, size);
            if (k == 2) { /* category 1, mask 0, group 0 */
                CHECK_EQ(carom_snapshot_load(world, changed, size), CAROM_OK);
                CHECK_EQ(carom_snapshot_load(world, saved, size), CAROM_OK);
            } else {
                REFUSE(carom_snapshot_load(world, changed, size), CAROM_ERR_FORMAT);
            }
        }
    }
}

/* The tag of a section ends the snapshot of a world without bodies, just before the sum: there is nothing that it could hold. */
static void test_empty(void)
{
    static const char tags[][5] = {"FLT1", "THR1", "FOC1"};

    make(true);
    for (int i = 0; i < 3; i++) {
        CHECK_EQ(carom_body_remove(world, i), CAROM_OK);
    }
    size = (size_t)carom_snapshot_save(world, saved, sizeof saved);
    for (int i = 0; i < 3; i++) {
        memcpy(changed, saved, size);
        memcpy(changed + size - 8, tags[i], 4);
        bytes_mend(changed, size + 4);
        REFUSE(carom_snapshot_load(world, changed, size + 4), CAROM_ERR_FORMAT);
    }
    CHECK_EQ(carom_snapshot_load(world, saved, size), CAROM_OK);
}

const struct test tests_world_sections[] = {
    {"world_sections/pairs", test_pairs},
    {"world_sections/forces", test_forces},
    {"world_sections/filters", test_filters},
    {"world_sections/empty", test_empty},
    {0},
};
