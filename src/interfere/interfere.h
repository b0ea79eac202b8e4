/* SPDX-License-Identifier: MIT */
/*
 * interfere - from pairs of bodies to interfering faces and candidates (paper, section 1 and figure
 * 1: interference detection by z-lists).
 *
 * In: a pair (a, b), the span of time for which it is gathered, both bodies' regions or paths, b's
 * z-lists. Out: candidates in the pool, each a pair of features that may touch; the list of
 * interfering faces, for statistics and pictures.
 *
 * Steps, all in b's mesh frame, and the files that hold them:
 *   gather.c     choose which body's leaves are swept, gather one pair or all
 *   motion.c     relative motion of a as seen from b over the span, and its tolerance
 *   interfere.c  cull leaves by their swept spheres; find faces of b by cells
 *   cells.c      cells under a box, highest z of b there
 *   leaf.c       carry a leaf's vertices, slab and faces into b's frame
 *   narrow.c     cull the leaf's vertices and faces against one face of b
 *   features.c   exact culls of a vertex/face or edge/edge pair: beside, normal cone
 *   keep.c       the pool: emit a candidate, make room, keep candidates of other pairs
 *   lists.c      z-lists made within a step, for surfaces that move
 *   faces.c      list of interfering faces, order of candidates
 *   overlap.c    queries without motion: face pairs that cross
 *   inside.c     is a body inside another one
 *
 * The result is conservative for every motion that stays within both regions: it lacks no pair of
 * features that can touch, and may hold some that cannot. So chunk sizes, duplicates and early
 * culls change the cost of a step, never its outcome.
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
static inline bool candidate_equal(const struct candidate *a, const struct candidate *b)
{
    return a->j == b->j && a->i == b->i && a->kind == b->kind && a->pair == b->pair;
}

/* Receives every candidate of a gather, in one or more chunks. */
struct candidate_visitor {
    void (*visit)(struct candidate_visitor *self, const struct candidate *c, uint32_t n);
};

/* A point or direction in b's mesh axes, from b's centre of mass. */
struct interfere_vec {
    int32_t c[3];
};

/*
 * Plane of one of the leaf's faces at mid-span: unit normal, and the offsets along it above and
 * below which no point of b can meet the face.
 */
struct interfere_plane {
    int32_t n_q30[3], above_q18, below_q18;
};

/*
 * A moving leaf of a in b's mesh axes. Over the span every point of the leaf moves by `shift`,
 * within the tolerance `near_q20`. Lengths are q20 unless the name says otherwise.
 */
struct interfere_leaf {
    /* set once a pair, by interfere_set_motion and gather_pair or query */
    carom_m3_q30 to_b;       /* from a's mesh axes to b's: mean of start and end of the span */
    struct interfere_vec at; /* a's centre of mass in b's mesh frame at mid-span */
    carom_m3_q30 change;     /* to_b at the end of the span less to_b at the start */
    struct interfere_vec moves;
    int64_t near_q22;  /* bound on a point's distance from its straight relative motion */
    int32_t angle_q30; /* bound on the turn of one body as seen from the other, radians */
    int32_t skew_q30;  /* bound on how much to_b, a mean, shortens vectors: 1 - cosine */
    int32_t cone_q30;  /* cosine tolerance of normal cones */
    int32_t top;       /* highest z of b in the cells under a, quanta */

    const struct carom_leaf *leaf;
    uint16_t seen[INTERFERE_SEEN];
    struct interfere_vec shift;
    int32_t near_q20;                            /* near_q22, and what turns add at this leaf */
    struct interfere_vec reach;                  /* near_q20 and half of |shift|, along each axis */
    struct interfere_vec p[CAROM_LEAF_VERTICES]; /* vertices at mid-span */
    int32_t quanta_low[3], quanta_high[3];       /* swept box, b's quanta from b's origin */
    int32_t axis_q15[3];                         /* axis of the leaf's slab, in b's axes */
    int32_t slab_low_q15, slab_high_q15;         /* interval swept along that axis, in b's quanta */
    bool listed;
    /* if listed: each face's corners as bits of the leaf's vertices, and the edges that it owns */
    uint32_t corners[CAROM_LEAF_FACES];
    uint8_t own_edges[CAROM_LEAF_FACES];
    uint16_t boxed; /* faces whose swept box is set, a bit each */
    struct interfere_vec face_low[CAROM_LEAF_FACES], face_high[CAROM_LEAF_FACES];
    uint16_t placed; /* faces whose plane is set, a bit each */
    /* faces that look up during the span, or that own an edge of one that does; set if `asked` */
    uint16_t up;
    bool asked;
    struct interfere_plane planes[CAROM_LEAF_FACES];
};

struct target;
struct interfere_query;
/* A rectangle in x and y, in quanta of a mesh. */
struct interfere_area {
    int32_t low[2], high[2];
};

/* The part of both regions' time that a pair is gathered for, in frames. */
struct interfere_span {
    int64_t from_a_q30, from_b_q30, time_q30;
    uint32_t most; /* limit: a gather that finds more candidates returns INTERFERE_TOO_MANY */
    /* add to the pair's kept candidates, the last in the pool, and visit only new ones */
    bool more;
};

/* Returned by a gather that exceeded interfere_span.most. */
#define INTERFERE_TOO_MANY 1

/* All pairs of a world, with the bodies that they number. */
struct interfere_pairs {
    const struct body *bodies;
    const struct pair *pairs;
    uint32_t count;
};

struct interfere {
    struct candidate *candidates;
    struct pool *candidate_pool;
    struct pair_work *meetings; /* one for each pair; NULL: no pair keeps candidates */
    uint32_t pair_count;        /* entries of meetings */
    uint32_t own_first;         /* index of the first candidate of the pair being gathered */
    struct carom_face_ref *faces;
    struct pool *face_pool;
    struct zlist lists;
    uint32_t gathers, candidate_count; /* for statistics */

    bool whole; /* the pool holds every candidate of the pair: no chunk was handed out */
    int error;
    struct candidate_visitor *visitor;

    /*
     * Called for the leaf and each face of b whose plane the leaf reaches: emits candidates in a
     * step, lists face pairs in a query.
     */
    void (*meet)(struct interfere *in, struct target *t);
    struct interfere_query *query; /* the query that runs; NULL in a step */

    /* the pair being gathered */
    const struct body *a, *b;
    struct interfere_span span;
    uint16_t pair;
    struct interfere_leaf *leaf; /* scratch: the leaf at hand and the motion of its pair */

    bool by_paths; /* span is that of the paths, not of the regions */
    bool swapped;  /* a is b of the pair and b is a, see choose_asker */
    bool pooled;   /* b's z-lists are those in `lists` */
    const struct carom_mesh
        *listed;                /* `lists` are this mesh's and complete within `area`; NULL: none */
    struct interfere_area area; /* in quanta of `listed` */
};

/* Hand the candidates that the pool keeps of a pair to the visitor. */
void interfere_visit_kept(struct interfere *in, uint32_t number, struct candidate_visitor *visitor);

/*
 * Gather the candidates of a pair anew and hand them to the visitor; in chunks if the pool is too
 * small for all of them.
 *
 *   span  part of both regions' time that the candidates are to cover (its times count if keep)
 *   keep  keep the candidates if the pool has room; else gather for the present paths alone
 *
 * Returns CAROM_OK, INTERFERE_TOO_MANY, or CAROM_ERR_RANGE for a pair too large and fast for q22.
 */
int interfere_visit_pair(struct interfere *in, const struct interfere_pairs *all, uint32_t number,
                         const struct interfere_span *span, bool keep,
                         struct candidate_visitor *visitor);

/*
 * Gather all pairs in turn, for the whole of their regions, and keep none. Returns as
 * interfere_visit_pair.
 */
int interfere_visit(struct interfere *in, const struct body *bodies, const struct pair *pairs,
                    uint32_t pair_count, struct candidate_visitor *visitor);

/* Add the faces that own the candidates' features to the list of interfering faces. */
void interfere_note_faces(struct interfere *in, const struct interfere_pairs *all,
                          const struct candidate *c, uint32_t n);

/* Nothing is gathered in this frame yet. */
static inline void interfere_begin_frame(struct interfere *w)
{
    w->gathers = w->candidate_count = 0;
}

/* The z-lists are those that a copy of w has made. */
static inline void interfere_take_lists(struct interfere *w, const struct interfere *copy)
{
    w->listed = copy->listed;
    w->area = copy->area;
}

/* Forget z-lists made within a step: the surface has moved or is gone. */
void interfere_forget_lists(struct interfere *in);

/* Sort the list of interfering faces and drop repetitions. */
void interfere_finish(struct interfere *in);

/* A body and its pose. */
struct interfere_placed {
    const struct body *body;
    const struct body_state *state;
};

/*
 * List the face pairs of a and b that interfere at their poses, each pair once: every pair with a
 * common point, and hardly any other. Candidates and interfering faces in `in` stay as they are.
 * Returns the number of pairs, or CAROM_ERR_FACES_FULL after `room` pairs were written.
 */
int interfere_query(struct interfere *in, struct interfere_placed a, struct interfere_placed b,
                    struct carom_face_pair *out, uint32_t room);

/* Exact test of a face of a and a face of b that may cross: true if they do. */
struct interfere_sure {
    bool (*cross)(struct interfere_sure *self, uint16_t face_a, uint16_t face_b);
};

/* True if `sure` confirms any pair of faces. a must be a SOLID. */
bool interfere_query_sure(struct interfere *in, struct interfere_placed a,
                          struct interfere_placed b, struct interfere_sure *sure);

/*
 * True if a's first vertex is inside b, or under b if that is a SURFACE. Precondition: no faces of
 * a and b cross.
 */
bool interfere_inside(struct interfere_placed a, struct interfere_placed b);

#endif
