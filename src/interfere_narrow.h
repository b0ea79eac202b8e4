/* SPDX-License-Identifier: MIT */
#ifndef CAROM_SRC_INTERFERE_NARROW_H
#define CAROM_SRC_INTERFERE_NARROW_H

#include "interfere.h"

/* The upper word of a.b: q20 from a direction and a length of q22, q18 from one of q20. */
static inline int32_t interfere_dot(const int32_t a[3], const int32_t b[3])
{
    return (int32_t)(carom_dot(a, b) >> 32);
}

/*
 * The leaf at hand and a face of b that it may come near: emit the vertex/face and edge/edge pairs
 * that can touch; the faces of any interfere.
 */
void interfere_narrow(struct interfere *w, uint16_t face_b);

/* Whether the z-lists of a mesh are made within a step. */
static inline bool interfere_makes_lists(const struct carom_mesh *mesh)
{
    return mesh->surface && !mesh->surface->own_lists;
}

/* Where the making of z-lists goes on. */
struct interfere_place {
    uint32_t face, cells; /* the next face, and how many of its cells are done */
};

/*
 * Make the z-lists of b under the bodies of its pairs, from a place on, until all are made or the pool
 * of entries is full; `from` moves on. Returns whether that was all.
 */
bool interfere_make_lists(struct interfere *w, const struct body *bodies, const struct pair *pairs,
                          uint32_t pair_count, uint16_t b, struct interfere_place *from);

/* The faces of b in a cell of the lists that were made, from the highest z1 down to the leaf. */
void interfere_visit_made(struct interfere *w, uint32_t cell);
/* A face of b in a cell, with the z that it spans there. */
void interfere_visit_entry(struct interfere *w, int16_t z0, uint16_t face);

/* Note an interfering face; an error is left in w. */
void interfere_add_face(struct interfere *w, uint16_t body, uint16_t face);

#endif
