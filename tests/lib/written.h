/* SPDX-License-Identifier: MIT */
/* written - the file that a recorder of a test source writes. */
#ifndef CAROM_TEST_WRITTEN_H
#define CAROM_TEST_WRITTEN_H

#include <string.h>

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

#endif
