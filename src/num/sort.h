/* SPDX-License-Identifier: MIT */
/* sort - a heap sort: in place, without recursion, and as fast at its worst. */
#ifndef CAROM_SRC_SORT_H
#define CAROM_SRC_SORT_H

#include <stdint.h>

/* Sort keys in rising order. */
void sort_keys(uint64_t *keys, uint32_t n);

#endif
