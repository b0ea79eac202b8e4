/* SPDX-License-Identifier: MIT */
/*
 * broad - which pairs of bodies can touch within the frame: the paper's simple test, boxes grown by
 * the motion.
 */
#ifndef CAROM_SRC_BROAD_H
#define CAROM_SRC_BROAD_H

#include "../num/arena.h"
#include "../body/body.h"

/*
 * Bodies a and b; b's z-lists are asked. N of their contacts points from b into a. a moves; of two
 * that move it is the one with the higher number, whichever is awake, so that a pair keeps its name.
 */
struct pair {
    uint16_t a, b;
};

/* A moving body that is neither asleep nor frozen. */
static inline bool broad_active(const struct body *b, const struct body_state *s)
{
    return b->mesh && b->moving && !s->asleep && !s->out;
}

/* Whether the boxes of two bodies, each grown by `margin`, overlap. */
bool broad_near(const struct body *a, const struct body_state *state_a, const struct body *b,
                const struct body_state *state_b, int32_t margin_q22);

/*
 * Fill pairs with every pair of an active body and another whose boxes, grown by the bodies' reach,
 * overlap; in order of (a, b). Returns CAROM_OK or CAROM_ERR_PAIRS_FULL.
 */
int broad_pairs(struct pair *pairs, struct pool *pool, struct body *bodies,
                const struct body_state *states, uint32_t body_count);

#endif
