/* SPDX-License-Identifier: MIT */
/* sort - sorting and binary search for every list that the engine keeps in order. */
#ifndef CAROM_SRC_SORT_H
#define CAROM_SRC_SORT_H

#include "fix.h"

/*
 * Define the static function `name(type *list, uint32_t n)`, a heap sort: rising order of
 * `key_of(record)`, in place, no recursion, and n log n at worst.
 */
#define SORT_DEFINE(name, type, key_of)                                                            \
    /* Let the record at `root` sink to its place in a heap of n. */                               \
    static void name##_sink(type *list, uint32_t root, uint32_t n)                                 \
    {                                                                                              \
        const type sinking = list[root];                                                           \
                                                                                                   \
        while (2 * root + 1 < n) {                                                                 \
            uint32_t child = 2 * root + 1;                                                         \
                                                                                                   \
            child += child + 1 < n && key_of(list[child + 1]) > key_of(list[child]);               \
            if (key_of(list[child]) <= key_of(sinking)) {                                          \
                break;                                                                             \
            }                                                                                      \
            list[root] = list[child];                                                              \
            root = child;                                                                          \
        }                                                                                          \
        list[root] = sinking;                                                                      \
    }                                                                                              \
                                                                                                   \
    static void name(type *list, uint32_t n)                                                       \
    {                                                                                              \
        for (uint32_t root = n / 2; root-- > 0;) {                                                 \
            name##_sink(list, root, n);                                                            \
        }                                                                                          \
        while (n > 1) {                                                                            \
            const type top = list[0];                                                              \
                                                                                                   \
            list[0] = list[--n];                                                                   \
            list[n] = top;                                                                         \
            name##_sink(list, 0, n);                                                               \
        }                                                                                          \
    }

/* Sort keys in rising order. */
void sort_keys(uint64_t *keys, uint32_t n);

/*
 * The place of the first of `count` sorted records, of `size` bytes each, that does not come before
 * the key; `count` if all do. Inline, so that `before` is not a call where speed counts.
 */
static inline uint32_t sort_lower_bound(const void *list, uint32_t count, size_t size,
                                        const void *key,
                                        bool (*before)(const void *record, const void *key))
{
    uint32_t low = 0, high = count;

    while (low < high) {
        uint32_t middle = (low + high) / 2;

        if (before((const uint8_t *)list + middle * size, key)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

#endif
