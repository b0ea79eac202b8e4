/* SPDX-License-Identifier: MIT */
/* The heap sort of 64-bit keys. */
#include "sort.h"

static uint64_t key_of(uint64_t key)
{
    return key;
}

SORT_DEFINE(heap_sort, uint64_t, key_of)

void sort_keys(uint64_t *keys, uint32_t n)
{
    heap_sort(keys, n);
}
