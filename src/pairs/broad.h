/* SPDX-License-Identifier: MIT */
/*
 * broad - which pairs of bodies can touch: the paper's simple test, with boxes grown by the motion
 * (paper, section 1).
 *
 * In: bodies with regions, filters. Out: the list of pairs, in order. broad.c has boxes and pairs;
 * island.c the islands of bodies that pairs connect.
 */
#ifndef CAROM_SRC_BROAD_H
#define CAROM_SRC_BROAD_H

#include "../num/arena.h"
#include "../body/body.h"

/*
 * Bodies a and b. b's z-lists are searched. N of the pair's contacts points from b into a. a moves;
 * of two bodies that move, a has the higher number, awake or not, so that a pair keeps its name.
 */
struct pair {
    uint16_t a, b;
};

/* True if a list of pairs, which is in order, has a pair; its place, or the one where it belongs. */
bool broad_find(const struct pair *list, uint32_t count, uint32_t a, uint32_t b, uint32_t *place);

/* A step's knowledge of a pair while its bodies are near each other. */
struct pair_work {
    /* by interfere: place of the pair's candidates in the pool, if kept */
    uint16_t first, count;
    /* by the search for hits: the next hit, in the time of the frame, or PAIRS_NEVER */
    int32_t hit_q30;
    int32_t root_q30; /* where the surfaces meet, in the time of the window searched */
    uint32_t i, j;    /* the hit's features */
    uint8_t kind : 2;
    /*
     * by the search: candidates cover the frame up to this many 64ths; 0: to the end of both
     * regions
     */
    uint8_t until : 6;
    uint8_t late : 1;  /* nothing could be solved at the start of the window: the hit is put off */
    uint8_t kept : 1;  /* first and count are valid */
    uint8_t found : 1; /* the last gather found candidates */
    /*
     * by the static check at the start of a frame: candidates are clear by this many 16ths of the
     * skin
     */
    uint8_t clear : 4;
    /* by the answer to hits */
    uint8_t checked : 1; /* its contacts are those of the hit at hand */
    uint8_t repeats : 7; /* hits in a row without any time between */
    /* by stages that let bodies pass: the pair is ignored in this frame */
    uint8_t passes : 1;
    uint8_t hits : 7; /* in this frame; of a sensor: it met the other body */
    /* by regions: one of both is a sensor */
    uint8_t senses : 1;
    int32_t answered_q30; /* time of the last answer */
};
#define PAIRS_NEVER INT32_MAX

/* True if a body moves or is led, and is neither asleep nor frozen. */
inline bool broad_active(const struct body *b, const struct body_state *s)
{
    return b->def.mesh && b->def.goes && !s->asleep && !s->out;
}

/*
 * True if two bodies may meet: their filters allow it, by Box2D's rule, and not both are sensors.
 */
bool broad_may_meet(const struct body *a, const struct body *b);
/* True if they may meet and neither is a sensor. */
static inline bool broad_may_touch(const struct body *a, const struct body *b)
{
    return !a->def.sensor && !b->def.sensor && broad_may_meet(a, b);
}

/* True if the boxes of two bodies, each grown by `margin`, overlap. */
bool broad_near(const struct body *a, const struct body_state *state_a, const struct body *b,
                const struct body_state *state_b, int32_t margin_q22);

/*
 * Set the box of a body that has a region. A moving body's box is around the sphere of its reach,
 * since most bodies are far from all others; a standing body's is around the mesh.
 */
void broad_set_box(struct body *b);

/* True if the present boxes of two bodies are apart: most are. */
static inline bool broad_apart(const struct body *a, const struct body *b)
{
    for (int k = 0; k < 3; k++) {
        if (a->search.box_q18[1][k] < b->search.box_q18[0][k] ||
            b->search.box_q18[1][k] < a->search.box_q18[0][k]) {
            return true;
        }
    }
    return false;
}

/*
 * True if the boxes of two bodies overlap. Boxes of spheres that overlap are first replaced by
 * boxes of the meshes.
 */
bool broad_boxes_meet(struct body *a, struct body *b);

/*
 * True if bodies a and b may be a pair, in that order: a moves; of two that move, a has the higher
 * number; one of them is active and none is frozen; and they may meet.
 */
bool broad_is_pair(const struct body *bodies, const struct body_state *states, uint32_t a,
                   uint32_t b);

/*
 * Fill pairs with every pair whose boxes meet, in order of (a, b). Returns CAROM_OK or
 * CAROM_ERR_PAIRS_FULL.
 */
int broad_pairs(struct pair *pairs, struct pool *pool, struct body *bodies,
                const struct body_state *states, uint32_t body_count);

#endif
