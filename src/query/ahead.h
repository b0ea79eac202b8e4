/* SPDX-License-Identifier: MIT */
/*
 * ahead - for a one-leaf mesh that moves straight: the faces ahead of it, and from when until when
 * it may touch each.
 */
#ifndef CAROM_SRC_QUERY_AHEAD_H
#define CAROM_SRC_QUERY_AHEAD_H

#include "../interfere/narrow.h"
#include "times.h"

#define AHEAD_AXES       6
#define AHEAD_FACES      48
#define AHEAD_CANDIDATES 32
/* A stretch is a part of the way; times in it are from 0 to 2^TIMES_BITS. */
#define AHEAD_WHOLE ((1 << TIMES_BITS) + 1)
#define AHEAD_NEVER INT32_MAX

/* A face of b, and the times of the stretch between which a may touch it. */
struct ahead_face {
    uint16_t face;
    int16_t enter, leave;
};

/*
 * An axis: the normal of some faces of a, or its opposite, in b's axes. goes, low, high: a's
 * displacement along it, and the interval of a's vertices about a's centre of mass. n_q14, low,
 * high, way: the same in b's quanta from b's origin, q14, at the start of a stretch.
 */
struct ahead_axis {
    int64_t goes_q32;
    int32_t n_q30[3], low_q18, high_q18;
    int32_t n_q14[3], low, high, way;
    int shift; /* bits of `way` that a division drops */
};

struct ahead {
    struct interfere work;
    struct candidate candidates[AHEAD_CANDIDATES];
    struct pool pool;
    struct ahead_face list[AHEAD_FACES];
    uint32_t count;
    int32_t end; /* faces touched from this time on are not in the list */

    /*
     * in b's axes: a's centre of mass from b's; a's way; a's vertices from a's centre, and the box
     * around them
     */
    int64_t start_q32[3], way_q32[3];
    struct interfere_vec p[CAROM_LEAF_VERTICES]; /* q20 */
    int32_t low_q20[3], high_q20[3];
    struct ahead_axis axis[AHEAD_AXES];
    uint32_t axes;
    int32_t near_q20, near_q14; /* tolerance; tolerance along an axis, b's quanta */

    /* the stretch: a's place at its start, a's displacement, the box swept in b's quanta */
    int32_t at_q20[3], moves_q20[3];
    int32_t low_quanta[3], high_quanta[3];
};

/*
 * Prepare two placed bodies and a's way in world axes. Returns false if `ahead` cannot serve: a has
 * more than one leaf, b's z-lists are made within a step, or b's quanta are too fine for a `part`
 * of the way.
 */
bool ahead_begin(struct ahead *h, const struct interfere *work, const struct body *a,
                 const struct body *b, const carom_v3_q32 *way, int32_t part_q30);

/* Set the stretch. Returns false if a cannot meet b on it, or stays above all of b under it. */
bool ahead_stretch(struct ahead *h, int32_t from_q30, int32_t to_q30);

/*
 * List the faces ahead on the stretch, up to h->end; AHEAD_WHOLE means all. Returns false if too
 * many faces are near its start.
 */
bool ahead_list(struct ahead *h);

/* The first time at or after `from` at which a listed face may be touched; AHEAD_NEVER if none. */
int32_t ahead_first(const struct ahead *h, int32_t from);

/* Visit the candidates of the listed faces in a window of the stretch. */
void ahead_visit(struct ahead *h, int32_t from, int32_t to, struct candidate_visitor *visitor);

#endif
