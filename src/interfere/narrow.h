/* SPDX-License-Identifier: MIT */
/*
 * narrow - what the sources of interfere share: culls of a leaf against faces of b, made z-lists,
 * the pool.
 */
#ifndef CAROM_SRC_INTERFERE_NARROW_H
#define CAROM_SRC_INTERFERE_NARROW_H

#include "interfere.h"

/*
 * Tolerance for normals that the collision test carries over with other roundings than the gather.
 */
#define INTERFERE_CONE_NOISE_Q30 (1 << 12)

/*
 * Upper word of a.b: q20 from a direction and a q22 length, q18 from a direction and a q20 length.
 */
static inline int32_t interfere_dot(const int32_t a[3], const int32_t b[3])
{
    return (int32_t)(carom_dot(a, b) >> 32);
}

/*
 * Bound on |n.(x - y)| for a leaf's point x and a point y of b that meet during the span. The 4
 * allows a unit for each truncation.
 */
static inline int32_t interfere_reach_q18(const struct interfere_leaf *l, const int32_t n[3])
{
    return (l->near_q20 >> 2) + (int32_t)carom_abs(interfere_dot(n, l->shift.c)) / 2 + 4;
}

/* A face of b in b's mesh axes, and how it lies to the leaf and to one of the leaf's faces. */
struct target {
    uint16_t number;
    const struct carom_face *face;
    struct interfere_vec p[3], low, high;
    /* the leaf's vertices that stay above or below its plane all span, a bit each */
    uint32_t over, under;
    /* in a query: its own corners above or below the plane of the leaf's face, a bit each */
    uint32_t corners_over, corners_under;
};

/* out = b^T a: from a's axes to b's. */
void interfere_relate(carom_m3_q30 *out, const carom_m3_q30 *b, const carom_m3_q30 *a);

/* Set the relative motion of a as seen from b. Returns false if they are too far apart to meet. */
bool interfere_set_motion(struct interfere *in);

/* Visit each leaf of a that comes near faces of b; call in->meet for the leaf and each such face. */
void interfere_leaves(struct interfere *in);

/* 1 if a < b, else 0; |a - b| < 2^31. */
static inline uint32_t interfere_is_less(int32_t a, int32_t b)
{
    return (uint32_t)(a - b) >> 31;
}

/* A coordinate of b's mesh frame (q20, from the centre of mass) in b's quanta (from its origin). */
static inline int32_t interfere_quanta(const struct carom_mesh *mb, int32_t x_q20, int k)
{
    return (x_q20 + (mb->mass.centre.c[k] >> 2)) >> (20 - mb->raw.quantum_bits);
}

/* The cells of b's grid under a box in b's quanta, clamped to the grid. */
struct interfere_cells {
    int32_t col[2], row[2];
};
struct interfere_cells interfere_cells_under(const struct carom_mesh *mb, const int32_t low[3],
                                             const int32_t high[3]);

/* Highest z of b in the cells under a box, in quanta; stops early, at any z >= `enough`. */
int32_t interfere_highest(const struct interfere *in, const int32_t low[3], const int32_t high[3],
                          int32_t enough);

/* True if b is as high as the bottom of the leaf's box in some cell under the box. */
bool interfere_reaches_leaf(const struct interfere *in);

/*
 * Carry the leaf into b's frame after sweep_sphere: vertices, swept box, slab. Returns false if the
 * leaf stays above all of b under it.
 */
bool interfere_place_leaf(struct interfere *in);

/*
 * Set parts of the leaf when a face of b first needs them: its faces' corners and owned edges; the
 * swept box of face i; the plane of face i.
 */
void interfere_list_faces(struct interfere *in);
void interfere_box_face(struct interfere *in, uint32_t i);
void interfere_place_plane(struct interfere *in, uint32_t i);

/*
 * Those of the leaf's faces, a bit each, that can touch b's other side: they, or faces across edges
 * that they own, look up along b's z during the span. The leaf's faces are listed; a is a SOLID.
 */
uint32_t interfere_faces_up(struct interfere *in);

static inline void interfere_bound(const struct interfere_vec *p, const struct interfere_vec *q,
                                   const struct interfere_vec *r, struct interfere_vec *low,
                                   struct interfere_vec *high)
{
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        int32_t x = p->c[k], y = q->c[k], z = r->c[k];
        int32_t less = x < y ? x : y, more = x < y ? y : x;

        low->c[k] = z < less ? z : less;
        high->c[k] = z > more ? z : more;
    }
}

/* Vertex number in a of the leaf's vertex `at`. */
static inline uint32_t interfere_vertex(const struct interfere *in, uint32_t at)
{
    return in->a->def.mesh->leaf_vertices[in->leaf->leaf->first_vertex + at];
}

/*
 * Face number in a of the leaf's face i; the corners of that face as numbers of the leaf's
 * vertices.
 */
static inline uint32_t interfere_face(const struct interfere *in, uint32_t i)
{
    return in->a->def.mesh->leaf_faces[in->leaf->leaf->first_face + i];
}

static inline const uint8_t *interfere_corners(const struct interfere *in, uint32_t i)
{
    return in->a->def.mesh->leaf_corners[in->leaf->leaf->first_face + i];
}

/*
 * Cull the leaf against a face of b by that face's plane; if the leaf reaches the plane call
 * in->meet.
 */
void interfere_narrow(struct interfere *in, uint16_t face_b);

/*
 * The leaf's faces, a bit each, that reach the plane of b's face and whose swept boxes meet its
 * box.
 */
uint32_t interfere_faces_near(struct interfere *in, const struct target *t);

/*
 * True if two features can touch: the leaf's vertex `at` and b's face; corner k of b's face and the
 * leaf's face i; edge k of the leaf's face i and edge j of b's face. Precondition: each feature
 * reaches the plane and the box of the other one.
 */
bool interfere_vertex_face(const struct interfere *in, const struct target *t, uint32_t at);
bool interfere_face_vertex(const struct interfere *in, const struct target *t, uint32_t i, int k);
bool interfere_edge_edge(const struct interfere *in, const struct target *t, uint32_t i, int k,
                         int j);

/* Cull the leaf's features against b's face, then emit the vertex/face and edge/edge candidates. */
void interfere_features(struct interfere *in, struct target *t);

/* The rectangle that the bodies paired with b can reach, in b's quanta. */
struct interfere_area interfere_area_under(const struct body *bodies, const struct pair *pairs,
                                           uint32_t pair_count, uint16_t b);

/* Where making z-lists was interrupted. */
struct interfere_place {
    uint32_t face, cells; /* next face to enter; number of its cells already done */
};

/*
 * Make a mesh's z-lists within an area, starting at `from`, until all are made or the pool of
 * entries is full. Advances `from`. Returns true if all are made.
 */
bool interfere_make_lists(struct interfere *in, const struct carom_mesh *mesh,
                          const struct interfere_area *area, struct interfere_place *from);

/* Renumber the candidates that the pool keeps of a pair: the pair's number has changed. */
void interfere_number(struct interfere *in, uint32_t number);

/*
 * Add a candidate of the pair at hand to the pool. If the pool stays full, hand a chunk to the
 * visitor first.
 */
void interfere_emit(struct interfere *in, uint8_t kind, uint32_t i, uint32_t j);

#endif
