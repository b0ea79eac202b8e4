/* SPDX-License-Identifier: MIT */
/*
 * broad - which pairs of bodies can touch within the frame: the paper's simple test, boxes grown by
 * the motion.
 */
#ifndef CAROM_SRC_BROAD_H
#define CAROM_SRC_BROAD_H

#include "arena.h"
#include "body.h"

/* Bodies a and b; b's z-lists are asked. N of their contacts points from b into a. */
struct pair {
    uint16_t a, b;
};

/* A moving body that is neither asleep nor frozen. */
static inline bool broad_active(const struct body *b, const struct body_state *s)
{
    return b->mesh && b->moving && !s->asleep && !s->out;
}

/*
 * Fill pairs with every pair whose boxes, grown by the bodies' reach, overlap; in order of (a, b).
 * Returns CAROM_OK or CAROM_ERR_PAIRS_FULL.
 */
int broad_pairs(struct pair *pairs, struct pool *pool, const struct body *bodies,
                const struct body_state *states, uint32_t body_count);

#endif
