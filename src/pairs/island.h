/* SPDX-License-Identifier: MIT */
/*
 * island - moving bodies that pairs connect: begin, join each pair, end. Then body.island.lowest
 * is the lowest number in a body's island, and the others follow by body.island.next.
 */
#ifndef CAROM_SRC_ISLAND_H
#define CAROM_SRC_ISLAND_H

#include "broad.h"

#define ISLAND_END 0xffffu

void island_begin(struct body *bodies, uint32_t body_count);
void island_join(struct body *bodies, const struct pair *p);
void island_end(struct body *bodies, uint32_t body_count);

/* All three for a list of pairs. */
void island_find(struct body *bodies, uint32_t body_count, const struct pair *pairs,
                 uint32_t pair_count);

#endif
