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

/* Where a pair is in a list, which is in order, or belongs. */
uint32_t broad_place_of(const struct pair *list, uint32_t count, uint32_t a, uint32_t b);

/* What a step keeps of a pair while its bodies are near each other. */
struct pair_work {
    /* by interfere: where the pool has all of its candidates, when it has */
    uint16_t first, count;
    /* by the search for hits: the next one, in the time of the frame, or PAIRS_NEVER */
    int32_t hit_q30;
    int32_t root_q30; /* where the surfaces meet, a time of the window that was searched */
    uint32_t i, j;    /* its features */
    uint8_t kind : 2;
    /* by the search: candidates are those up to so many 64ths of the frame; 0: to the end of both regions */
    uint8_t until : 6;
    uint8_t late : 1;  /* nothing can be solved where the window begins: the hit comes later */
    uint8_t kept : 1;  /* first and count are set */
    uint8_t found : 1; /* the last gather found some */
    /* by the static check that a frame begins with: candidates are clear by so many 16ths of the skin */
    uint8_t clear : 4;
    /* by the answer to hits */
    uint8_t checked : 1; /* its contacts are those of the hit at hand */
    uint8_t repeats : 7; /* how often, without any time between */
    /* by whoever lets bodies pass: nothing of the pair is looked for in this frame */
    uint8_t passes : 1;
    uint8_t hits : 7; /* in this frame; of a sensor: that it met the other body */
    /* by regions: one of the two is a sensor */
    uint8_t senses : 1;
    int32_t answered_q30; /* when last */
};
#define PAIRS_NEVER INT32_MAX

/* A body that moves, or is led, and is neither asleep nor frozen. */
inline bool broad_active(const struct body *b, const struct body_state *s)
{
    return b->def.mesh && b->def.goes && !s->asleep && !s->out;
}

/* Whether two bodies may meet: their filters, by Box2D's rule, and that two sensors do not see each other. */
bool broad_may_meet(const struct body *a, const struct body *b);
/* The same, and that neither is a sensor. */
static inline bool broad_may_touch(const struct body *a, const struct body *b)
{
    return !a->def.sensor && !b->def.sensor && broad_may_meet(a, b);
}

/* Whether the boxes of two bodies, each grown by `margin`, overlap. */
bool broad_near(const struct body *a, const struct body_state *state_a, const struct body *b,
                const struct body_state *state_b, int32_t margin_q22);

/*
 * Set the box of a body that has a region: around the sphere of the region's reach when it moves, for
 * most bodies are far from all others; around the mesh when it stands still.
 */
void broad_set_box(struct body *b);

/* Whether the boxes at hand of two bodies are apart: most are. */
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

/* Whether the boxes of two bodies overlap; spheres' boxes that do give way to those of the meshes. */
bool broad_boxes_meet(struct body *a, struct body *b);

/*
 * Whether bodies a and b may be a pair, in that order: a moves, and of two that do it is the higher
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
