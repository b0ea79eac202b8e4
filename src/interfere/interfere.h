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

#include "../pairs/broad.h"

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

/* The plane of a face of the leaf in the middle of its way, by the reach along its normal over and under. */
struct interfere_plane {
    int32_t n_q30[3], above_q18, below_q18;
};

/* A leaf of a as it moves, in b's mesh axes: all points by `shift`, but for a tolerance. Lengths are
 * q20. */
struct interfere_leaf {
    /* of its pair */
    carom_m3_q30 to_b;       /* from a's mesh axes to b's: the mean of start and end */
    struct interfere_vec at; /* a's centre of mass in b's mesh frame, likewise */
    carom_m3_q30 change;     /* from start to end */
    struct interfere_vec moves;
    int64_t near_q22;  /* how far points may be off the straight way between both */
    int32_t angle_q30; /* how far one body turns as seen from the other */
    int32_t skew_q30;  /* how far to_b is from a rotation, which it shortens to its cosine */
    int32_t cone_q30;  /* cosine tolerance of normal cones */
    int32_t top;       /* the highest z of b under a, quanta */

    const struct carom_leaf *leaf;
    uint16_t seen[INTERFERE_SEEN];
    struct interfere_vec shift;
    int32_t near_q20;                            /* the tolerance */
    struct interfere_vec reach;                  /* it and half of the shift, along each axis */
    struct interfere_vec p[CAROM_LEAF_VERTICES]; /* vertices in the middle of their ways */
    int32_t quanta_low[3], quanta_high[3]; /* around the ways, in b's quanta from its origin */
    int32_t axis_q15[3];                   /* of its slab */
    int32_t slab_low_q15, slab_high_q15;   /* along that, around the ways, in b's quanta */
    bool listed;
    uint32_t corners[CAROM_LEAF_FACES];  /* of each face, once listed, a bit each */
    uint8_t own_edges[CAROM_LEAF_FACES]; /* that each face owns, once listed, a bit each */
    uint32_t boxed;                      /* faces with boxes around their ways, a bit each */
    struct interfere_vec face_low[CAROM_LEAF_FACES], face_high[CAROM_LEAF_FACES];
    uint32_t placed; /* faces whose planes are known, a bit each */
    struct interfere_plane planes[CAROM_LEAF_FACES];
};

struct target;
struct interfere_query;
/* A rectangle seen from above, quanta. */
struct interfere_area {
    int32_t low[2], high[2];
};

/* The part of both regions' time that a pair is gathered for, frames. */
struct interfere_span {
    int64_t from_a_q30, from_b_q30, time_q30;
    uint32_t most; /* a gather that finds more candidates gives up */
    /* what the pair has kept, the last in the pool, stays: only what is added is visited */
    bool more;
};

/* What a gather returns that gave up. */
#define INTERFERE_TOO_MANY 1

/* All pairs of a world, and their bodies. */
struct interfere_pairs {
    const struct body *bodies;
    const struct pair *pairs;
    uint32_t count;
};

struct interfere {
    struct candidate *candidates;
    struct pool *candidate_pool;
    struct pair_work *meetings; /* of all pairs; NULL: none is kept */
    uint32_t pair_count;        /* so many */
    uint32_t own_first;         /* where the candidates of the pair at hand begin */
    struct carom_face_ref *faces;
    struct pool *face_pool;
    struct zlist lists;
    uint32_t gathers, candidate_count; /* for the statistics */

    bool whole; /* the pool holds every candidate of the pair at hand */
    bool stale; /* the bodies are not those that regions and pairs were set for */
    int error;
    struct candidate_visitor *visitor;

    /* what becomes of the leaf and a face of b whose plane it reaches: candidates, or pairs of faces */
    void (*meet)(struct interfere *w, struct target *t);
    struct interfere_query *query; /* of a query */

    /* the pair being worked on */
    const struct body *a, *b;
    struct interfere_span span;
    uint16_t pair;
    struct interfere_leaf *leaf; /* room for one and for its pair, the caller's */

    bool by_paths;                   /* it is gathered for the paths at hand alone */
    bool swapped;                    /* a is b of the pair, and b a */
    bool pooled;                     /* b's z-lists are in `lists` */
    const struct carom_mesh *listed; /* the mesh that `lists` are of; NULL: none */
    struct interfere_area area;      /* where they hold all of it */
};

/* Hand every candidate of a pair to the visitor that the pool keeps. */
void interfere_visit_kept(struct interfere *w, uint32_t number, struct candidate_visitor *visitor);

/*
 * The same of a pair whose candidates are gathered anew, to be kept for a span of both regions, or for the
 * paths at hand alone; in chunks when the pool has not room for all of them.
 * Returns CAROM_OK, INTERFERE_TOO_MANY, or CAROM_ERR_RANGE for a pair too large and fast for q22.
 */
int interfere_visit_pair(struct interfere *w, const struct interfere_pairs *all, uint32_t number,
                         const struct interfere_span *span, bool keep,
                         struct candidate_visitor *visitor);

/* The same of all pairs, for the whole of the regions, and none is kept. */
int interfere_visit(struct interfere *w, const struct body *bodies, const struct pair *pairs,
                    uint32_t pair_count, struct candidate_visitor *visitor);

/* Note the faces that own the features of candidates as interfering ones. */
void interfere_note_faces(struct interfere *w, const struct interfere_pairs *all,
                          const struct candidate *c, uint32_t n);

/* Forget z-lists that were made; the surface has moved or gone. */
void interfere_forget_lists(struct interfere *w);

/* Sort the interfering faces and drop repeated ones. */
void interfere_finish(struct interfere *w);

/* A body where it is. */
struct interfere_placed {
    const struct body *body;
    const struct body_state *state;
};

/*
 * The face pairs of a and b that interfere at their poses, each once: every pair that has a point in
 * common, and hardly any other. Candidates and interfering faces in w stay as they are.
 * Returns how many, or CAROM_ERR_FACES_FULL; some pairs are in `out` then all the same.
 */
int interfere_query(struct interfere *w, struct interfere_placed a, struct interfere_placed b,
                    struct carom_face_pair *out, uint32_t room);

/* Asked of a face of a and one of b that may cross: whether they do. */
struct interfere_sure {
    bool (*cross)(struct interfere_sure *self, uint16_t face_a, uint16_t face_b);
};

/* Whether any pair of faces of a, a SOLID, and b is sure to cross. */
bool interfere_query_sure(struct interfere *w, struct interfere_placed a, struct interfere_placed b,
                          struct interfere_sure *sure);

/* Whether a's first vertex is inside b, or under a SURFACE. No faces of both may interfere. */
bool interfere_inside(struct interfere_placed a, struct interfere_placed b);

#endif
