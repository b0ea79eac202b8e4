/* SPDX-License-Identifier: MIT */
/* ahead - the faces ahead of a mesh that goes straight, and when it comes there. */
#ifndef CAROM_SRC_QUERY_AHEAD_H
#define CAROM_SRC_QUERY_AHEAD_H

#include "../interfere/narrow.h"
#include "times.h"

#define AHEAD_AXES       6
#define AHEAD_FACES      48
#define AHEAD_CANDIDATES 32
/* Times in a stretch of the way are from 0 to 2^TIMES_BITS. */
#define AHEAD_WHOLE ((1 << TIMES_BITS) + 1)
#define AHEAD_NEVER INT32_MAX

/* A face of b, and when a may touch it in the stretch. */
struct ahead_face {
    uint16_t face;
    int16_t enter, leave;
};

/*
 * An axis, the normal of some faces of a or its opposite, in b's axes: how far a goes and reaches along it from its centre of mass;
 * and where it is in quanta of b from its origin, q14, at the start of a stretch, and how far it goes.
 */
struct ahead_axis {
    int64_t goes_q32;
    int32_t n_q30[3], low_q18, high_q18;
    int32_t n_q14[3], low, high, way;
    int shift; /* bits of the way that a division leaves out */
};

struct ahead {
    struct interfere work;
    struct candidate candidates[AHEAD_CANDIDATES];
    struct pool pool;
    struct ahead_face list[AHEAD_FACES];
    uint32_t count;
    int32_t end; /* what is touched from then on is not in the list */

    /* in b's axes: a's centre of mass from b's, its way, its vertices from there, the box around these */
    int64_t start_q32[3], way_q32[3];
    struct interfere_vec p[CAROM_LEAF_VERTICES]; /* q20 */
    int32_t low_q20[3], high_q20[3];
    struct ahead_axis axis[AHEAD_AXES];
    uint32_t axes;
    int32_t near_q20, near_q14; /* how near counts; along an axis */

    /* the stretch: where a is and how far it goes; the box around it, quanta of b */
    int32_t at_q20[3], moves_q20[3];
    int32_t low_quanta[3], high_quanta[3];
};

/*
 * Two bodies that are placed, and a's way in the world. False when this is of no use: a has more than one leaf, b
 * makes its z-lists in a step, or its quanta are too fine for a `part` of the way.
 */
bool ahead_begin(struct ahead *h, const struct interfere *work, const struct body *a,
                 const struct body *b, const carom_v3_q32 *way, int32_t part_q30);

/* Look at a stretch, a part of the way or less. False when all of b is elsewhere or under it. */
bool ahead_stretch(struct ahead *h, int32_t from_q30, int32_t to_q30);

/* List the faces ahead on the stretch, up to h->end; AHEAD_WHOLE: all. False when too many are at its start. */
bool ahead_list(struct ahead *h);

/* When the first face of the list may be touched, not before `from`; AHEAD_NEVER. */
int32_t ahead_first(const struct ahead *h, int32_t from);

/* The candidates of the listed faces in a window of the stretch. */
void ahead_visit(struct ahead *h, int32_t from, int32_t to, struct candidate_visitor *visitor);

#endif
