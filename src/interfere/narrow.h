/* SPDX-License-Identifier: MIT */
#ifndef CAROM_SRC_INTERFERE_NARROW_H
#define CAROM_SRC_INTERFERE_NARROW_H

#include "interfere.h"

/* Normals are carried over by other roundings where they are asked. */
#define INTERFERE_CONE_NOISE_Q30 (1 << 12)

/* The upper word of a.b: q20 from a direction and a length of q22, q18 from one of q20. */
static inline int32_t interfere_dot(const int32_t a[3], const int32_t b[3])
{
    return (int32_t)(carom_dot(a, b) >> 32);
}

/*
 * Along a direction n: how far apart a point of the leaf and one of b may seem that meet on the way.
 * 4: a unit for each cut.
 */
static inline int32_t interfere_reach_q18(const struct interfere_leaf *l, const int32_t n[3])
{
    return (l->near_q20 >> 2) + (int32_t)carom_abs(interfere_dot(n, l->shift.c)) / 2 + 4;
}

/* A face of b, in b's mesh axes, and how it stands to the leaf and to one of its faces. */
struct target {
    uint16_t number;
    const struct carom_face *face;
    struct interfere_vec p[3], low, high;
    /* vertices of the leaf that stay on one side of its plane; of those of faces that are near */
    uint32_t over, under;
    /* of a query: its own corners that stay on one side of the plane of the leaf's face, a bit each */
    uint32_t corners_over, corners_under;
};

/* R_b^T R_a */
void interfere_relate(carom_m3_q30 *out, const carom_m3_q30 *b, const carom_m3_q30 *a);

/* Where a is as seen from b, and how it moves; false when they are too far apart to matter. */
bool interfere_set_motion(struct interfere *w);

/* Every leaf of a that comes near faces of b, with w->meet for each pair of faces. */
void interfere_leaves(struct interfere *w);

/* 1 when a is less than b; they differ by less than 2^31. */
static inline uint32_t interfere_is_less(int32_t a, int32_t b)
{
    return (uint32_t)(a - b) >> 31;
}

/* From b's frame to b's quanta along an axis. */
static inline int32_t interfere_quanta(const struct carom_mesh *mb, int32_t x_q20, int k)
{
    return (x_q20 + (mb->mass.centre.c[k] >> 2)) >> (20 - mb->raw.quantum_bits);
}

/* The cells under a box of quanta. */
struct interfere_cells {
    int32_t col[2], row[2];
};
struct interfere_cells interfere_cells_under(const struct carom_mesh *mb, const int32_t low[3],
                                             const int32_t high[3]);

/* The highest z of b in the cells under a box, in quanta; `enough` or above when it is as high as that. */
int32_t interfere_highest(const struct interfere *w, const int32_t low[3], const int32_t high[3],
                          int32_t enough);

/* Whether b is as high as the leaf's box somewhere in the cells under it. */
bool interfere_reaches_leaf(const struct interfere *w);

/*
 * Place the leaf at hand, whose sphere was swept: its vertices, the box and the slab around their ways.
 * False when it is above all of b under it.
 */
bool interfere_place_leaf(struct interfere *w);

/* When there is a face of b near to it: the corners of its faces; of one, the box around its way, and its plane. */
void interfere_list_faces(struct interfere *w);
void interfere_box_face(struct interfere *w, uint32_t i);
void interfere_place_plane(struct interfere *w, uint32_t i);

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

/* The vertex of a that is number `at` of the leaf. */
static inline uint32_t interfere_vertex(const struct interfere *w, uint32_t at)
{
    return w->a->mesh->leaf_vertices[w->leaf->leaf->first_vertex + at];
}

/* The face of a that is number i of the leaf, and which vertices of the leaf are its corners. */
static inline uint32_t interfere_face(const struct interfere *w, uint32_t i)
{
    return w->a->mesh->leaf_faces[w->leaf->leaf->first_face + i];
}

static inline const uint8_t *interfere_corners(const struct interfere *w, uint32_t i)
{
    return w->a->mesh->leaf_corners[w->leaf->leaf->first_face + i];
}

/*
 * The leaf at hand and a face of b that it may come near: w->meet when the leaf reaches the plane of the
 * face.
 */
void interfere_narrow(struct interfere *w, uint16_t face_b);

/* The faces of the leaf, a bit each, that reach the plane of b's face and whose boxes meet its own. */
uint32_t interfere_faces_near(struct interfere *w, const struct target *t);

/*
 * Whether a pair of features can touch: a vertex of the leaf and b's face, corner k of that and face i
 * of the leaf, edge k of this and edge j of that. Each reaches the plane and the box of the other.
 */
bool interfere_vertex_face(const struct interfere *w, const struct target *t, uint32_t at);
bool interfere_face_vertex(const struct interfere *w, const struct target *t, uint32_t i, int k);
bool interfere_edge_edge(const struct interfere *w, const struct target *t, uint32_t i, int k,
                         int j);

/* Emit the vertex/face and edge/edge pairs of the leaf and b's face that can touch. */
void interfere_features(struct interfere *w, struct target *t);

/* Whether the z-lists of a mesh are made within a step. */
static inline bool interfere_makes_lists(const struct carom_mesh *mesh)
{
    return mesh->surface && !mesh->surface->own_lists;
}

/* What bodies of pairs with b reach, seen from above in b's quanta. */
struct interfere_area interfere_area_under(const struct body *bodies, const struct pair *pairs,
                                           uint32_t pair_count, uint16_t b);

/* Where the making of z-lists goes on. */
struct interfere_place {
    uint32_t face, cells; /* the next face, and how many of its cells are done */
};

/*
 * Make the z-lists of a mesh in an area, from a place on, until all are made or the pool of entries is
 * full; `from` moves on. Returns whether that was all.
 */
bool interfere_make_lists(struct interfere *w, const struct carom_mesh *mesh,
                          const struct interfere_area *area, struct interfere_place *from);

/* Give the candidates that the pool keeps of a pair the number that it has now. */
void interfere_number(struct interfere *w, uint32_t number);

/* Take a candidate of the pair at hand into the pool; what has no room there goes to the visitor. */
void interfere_emit(struct interfere *w, uint8_t kind, uint32_t i, uint32_t j);

#endif
