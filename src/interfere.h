/* SPDX-License-Identifier: MIT */
/*
 * interfere - from pairs of bodies to interfering faces and candidates for the collision test.
 *
 * For a pair (a, b) the question is asked in b's mesh frame, where b's sorted z-lists lie ready:
 * the faces of a that survive a sphere test are carried into that frame, grown by the motion of
 * both bodies, scan-converted onto b's cells, and the two lists of a cell are merged by z. Face
 * pairs whose intervals overlap are narrowed to the vertex/face and edge/edge pairs that can touch.
 *
 * The result is conservative for every motion that stays within the bodies' reach: it may hold
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

/*
 * Which of the leaf's faces a face of b has come up with lately, a bit each: a pair shares many
 * cells. A slot that is taken by another face of b forgets, which is only work done twice.
 */
#define INTERFERE_SEEN 256
struct interfere_seen {
    uint16_t face_b, leaf_faces;
};

/* Cosine tolerance of the normal cones in the collision test, 0.02. */
#define INTERFERE_CONE_Q30 21474836

/* A face in b's mesh frame, about b's centre of mass. */
struct interfere_face {
    uint16_t number;
    const struct carom_face *face;
    carom_v3_q22 p[3];
    carom_v3_q30 normal;
    carom_v3_q22 low, high; /* of its corners */
};

struct interfere {
    struct zlist lists;
    struct candidate *candidates;
    struct pool *candidate_pool;
    struct carom_face_ref *faces;
    struct pool *face_pool;
    uint32_t gathers, candidate_count; /* for the statistics */

    bool whole; /* the pool holds every candidate of the pairs: no need to gather again */
    int error;
    struct candidate_visitor *visitor;

    /* the pair and leaf being worked on */
    const struct body *a, *b;
    uint16_t pair, body_a, body_b;
    carom_m3_q30 to_b;     /* rotation from a's mesh axes to b's */
    int32_t offset_q22[3]; /* a's centre of mass in b's mesh frame, about b's centre of mass */
    int32_t reach_q22, turn_q30;
    const struct carom_leaf *leaf;
    int32_t leaf_top;    /* highest z of b in the cells under the leaf, quanta */
    int32_t cells[2][2]; /* columns and rows that hold entries: first and last */
    struct interfere_face leaf_faces[CAROM_LEAF_FACES]; /* grown by the reach: low and high too */
    struct interfere_seen seen[INTERFERE_SEEN];
};

/*
 * Forget the candidates. Called at the start of a frame and whenever a body has used up its reach,
 * after reach, turn and the pose to gather for have been set in every body.
 */
void interfere_begin(struct interfere *w);

/*
 * Hand every candidate of the pairs to the visitor.
 * Returns CAROM_OK, CAROM_ERR_FACES_FULL, or CAROM_ERR_RANGE for a pair too large and fast for q22.
 */
int interfere_visit(struct interfere *w, const struct body *bodies, const struct pair *pairs,
                    uint32_t pair_count, struct candidate_visitor *visitor);

/* Sort the interfering faces and drop repeated ones. */
void interfere_finish(struct interfere *w);

#endif
