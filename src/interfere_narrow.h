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
 * Along a direction n: how far apart a point of the leaf and one of b may seem that meet on the way.
 * 4: a unit for each cut.
 */
static inline int32_t interfere_reach_q18(const struct interfere_leaf *l, const int32_t n[3])
{
    return (l->near_q20 >> 2) + (int32_t)carom_abs(interfere_dot(n, l->shift.c)) / 2 + 4;
}

/*
 * The leaf at hand and a face of b that it may come near: emit the vertex/face and edge/edge pairs
 * that can touch; the faces of any interfere.
 */
void interfere_narrow(struct interfere *w, uint16_t face_b);

/* Note an interfering face; an error is left in w. */
void interfere_add_face(struct interfere *w, uint16_t body, uint16_t face);

#endif
