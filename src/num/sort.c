/* SPDX-License-Identifier: MIT */
#include "sort.h"

/* Let the key at `root` sink to its place in a heap of n keys. */
static void sink(uint64_t *keys, uint32_t root, uint32_t n)
{
    uint64_t key = keys[root];

    while (2 * root + 1 < n) {
        uint32_t child = 2 * root + 1;

        child += child + 1 < n && keys[child + 1] > keys[child];
        if (keys[child] <= key) {
            break;
        }
        keys[root] = keys[child];
        root = child;
    }
    keys[root] = key;
}

void sort_keys(uint64_t *keys, uint32_t n)
{
    for (uint32_t root = n / 2; root-- > 0;) {
        sink(keys, root, n);
    }
    while (n > 1) {
        uint64_t top = keys[0];

        keys[0] = keys[--n];
        keys[n] = top;
        sink(keys, 0, n);
    }
}
