/* SPDX-License-Identifier: MIT */
/* event - the time to stop at before features meet. */
#ifndef CAROM_SRC_BOYSE_EVENT_H
#define CAROM_SRC_BOYSE_EVENT_H

#include "roots.h"
#include "place.h"

/*
 * How far features are open: P, with the sign that it has while they are, in the units of the
 * curve. Wanted is what the event gap comes to in it, at one time or, by_time, at each.
 */
struct opening {
    const struct boyse_pair *pair;
    const struct boyse_places *edges; /* where they start; NULL: a vertex and a face */
    const struct curve *curve;
    int sign;
    bool by_time;
    int32_t wanted, slack;
    int64_t shift; /* by how much P is less than it should be */
};

/*
 * The last time before the root at which the gap equals the event gap (half the skin), searched
 * back no further than `from`, the root before. A pair that never opens that far in between gets
 * half of its largest opening; one that is never open gets 0.
 *
 *   o      in  all but wanted, slack and by_time
 *   scale  in  |w| of edges at the root, 1 of a vertex and a face
 */
int32_t boyse_event_q30(struct opening *o, int32_t from, const struct walk *root,
                        int32_t scale_q30);

#endif
