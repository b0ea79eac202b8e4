/* SPDX-License-Identifier: MIT */
/*
 * interfere - from pairs of bodies to interfering faces and candidates for the collision test.
 *
 * For a pair (a, b) the question is asked in b's mesh frame, where b's sorted z-lists lie ready. The
 * leaves of a that survive a sphere test are carried into that frame and swept along their way; the
 * z-lists of the cells under a swept leaf name the faces of b near it. What lies apart by planes is
 * dropped, a bit for each vertex; the rest is narrowed to the vertex/face and edge/edge pairs that
 * can touch.
 *
 * The result is conservative for every motion that stays within the bodies' regions: it may hold
 * pairs that do not touch and lacks none that do. So how it is cut into chunks, which duplicates
 * survive and what is culled early change the cost of a step, never its outcome.
 */
#ifndef CAROM_SRC_INTERFERE_H
#define CAROM_SRC_INTERFERE_H

#include "broad.h"

enum candidate_kind {
    CANDIDATE_VERTEX_FACE, /* vertex i of a, face j of b */
    CANDIDATE_FACE_VERTEX, /* vertex i of b, face j of a */
    CANDIDATE_EDGE_EDGE    /* edge i of a, edge j of b */
};

struct candidate {
    uint16_t pair;
    uint8_t kind;
    uint32_t i, j;
};

/* Order of candidates, hits and contacts: by pair, kind, i, j. Negative when a comes first. */
int candidate_compare(const struct candidate *a, const struct candidate *b);

/* Told of every candidate, some at a time. */
struct candidate_visitor {
    void (*visit)(struct candidate_visitor *self, const struct candidate *c, uint32_t n);
};

/* Cosine tolerance of the normal cones in the collision test, 0.02. */
#define INTERFERE_CONE_Q30 21474836

/*
 * Faces of b that a leaf has come up with lately: a face lies in several cells. One that takes the
 * slot of another makes it forgotten, which is only work done twice.
 */
#define INTERFERE_SEEN 64

/* A point or direction in b's mesh axes, from b's centre of mass. */
struct interfere_vec {
    int32_t c[3];
};

/* A leaf of a as it moves, in b's mesh axes: all points by `shift`, but for a tolerance. Lengths are
 * q20. */
struct interfere_leaf {
    const struct carom_leaf *leaf;
    struct interfere_vec shift;
    int32_t near_q20;                            /* the tolerance */
    struct interfere_vec p[CAROM_LEAF_VERTICES]; /* vertices at the start */
    struct interfere_vec low, high;              /* of the vertices */
    struct interfere_vec swept_low, swept_high;  /* of their ways, grown by the tolerance */
    int32_t quanta_low[3], quanta_high[3];       /* the same in b's quanta, from its origin */
    int32_t axis_q30[3];                         /* of its slab */
    int32_t slab_low_q18, slab_high_q18;         /* along that, swept and grown, q18 */
    bool listed;
    uint32_t corners[CAROM_LEAF_FACES]; /* of each face, a bit each; once listed */
    uint32_t busy;                      /* faces with candidates */
    int32_t top;                        /* highest z of b in the cells under it */
};

/* A rectangle seen from above, quanta. */
struct interfere_area {
    int32_t low[2], high[2];
};

struct interfere {
    struct candidate *candidates;
    struct pool *candidate_pool;
    struct carom_face_ref *faces;
    struct pool *face_pool;
    struct zlist lists;
    uint32_t gathers, candidate_count; /* for the statistics */

    bool pooled;                     /* b's z-lists are in `lists` */
    const struct carom_mesh *listed; /* the mesh that `lists` are of; NULL: none */
    struct interfere_area area;      /* where they hold all of it */

    bool whole; /* the pool holds every candidate of the pairs: no need to gather again */
    int error;
    struct candidate_visitor *visitor;

    /* the pair being worked on */
    const struct body *a, *b;
    uint16_t pair, body_a, body_b;
    carom_m3_q30 to_b;       /* rotation from a's mesh axes to b's at the start */
    struct interfere_vec at; /* a's centre of mass in b's mesh frame then */
    carom_m3_q30 change;     /* what is added to them until the end */
    struct interfere_vec moves;
    int64_t near_q22;  /* how far points may be off the straight way between both */
    int32_t angle_q30; /* how far one body turns as seen from the other */
    int32_t cone_q30;  /* cosine tolerance of normal cones */
    struct interfere_leaf leaf;
    uint16_t seen[INTERFERE_SEEN];
};

/*
 * Forget the candidates. Called at the start of a frame and whenever a body may leave its region,
 * after the region has been set in every body.
 */
void interfere_begin(struct interfere *w);

/*
 * Hand every candidate of the pairs to the visitor.
 * Returns CAROM_OK, CAROM_ERR_FACES_FULL, or CAROM_ERR_RANGE for a pair too large and fast for q22.
 */
int interfere_visit(struct interfere *w, const struct body *bodies, const struct pair *pairs,
                    uint32_t pair_count, struct candidate_visitor *visitor);

/* Forget z-lists that were made; the surface has moved or gone. */
void interfere_forget_lists(struct interfere *w);

/* Sort the interfering faces and drop repeated ones. */
void interfere_finish(struct interfere *w);

#endif
