/* SPDX-License-Identifier: MIT */
/* event - the time at which to stop before the features meet. */
#ifndef CAROM_SRC_BOYSE_EVENT_H
#define CAROM_SRC_BOYSE_EVENT_H

#include "roots.h"
#include "place.h"

/*
 * The opening of two features: P, with its sign chosen so that it is positive while they are open,
 * in the curve's units. `wanted` is the event gap in these units: constant, or recomputed at each
 * time if by_time.
 */
struct opening {
    const struct boyse_pair *pair;
    bool edges; /* two edges, not a vertex and a face */
    const struct curve *curve;
    int sign;
    bool by_time;
    int32_t wanted, slack;
    int64_t shift; /* offset subtracted from P */
};

/*
 * The last time before the root at which the gap equals the event gap (half the skin), no earlier
 * than `from`, the root before. A pair that opens less than that gets the time of half its largest
 * opening; a pair that never opens gets 0.
 *
 *   o      in  all but wanted, slack and by_time
 *   scale  in  |w| of edges at the root; 1 for a vertex and a face
 */
int32_t boyse_event_q30(struct opening *o, int32_t from, const struct walk *root,
                        int32_t scale_q30);

#endif
