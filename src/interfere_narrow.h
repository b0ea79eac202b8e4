/* SPDX-License-Identifier: MIT */
#ifndef CAROM_SRC_INTERFERE_NARROW_H
#define CAROM_SRC_INTERFERE_NARROW_H

#include "interfere.h"

/* The upper word of a.b: q20 from a direction and a length of q22, q18 from one of q20. */
static inline int32_t interfere_dot(const int32_t a[3], const int32_t b[3])
{
    return (int32_t)(carom_dot(a, b) >> 32);
}

/* A face of b, in b's mesh axes. */
struct target {
    uint16_t number;
    const struct carom_face *face;
    struct interfere_vec p[3], low, high;
    uint32_t over, under; /* vertices of the leaf that stay on one side of its plane */
};

/* R_b^T R_a */
void interfere_relate(carom_m3_q30 *out, const carom_m3_q30 *b, const carom_m3_q30 *a);

/* Every leaf of a that comes near faces of b, with w->meet for each of these. */
void interfere_leaves(struct interfere *w);

/* The leaf at hand and a face of b that it may come near: part them by planes, or let them meet. */
void interfere_narrow(struct interfere *w, uint16_t face_b);

/* Emit the vertex/face and edge/edge pairs that can touch; the faces of any interfere. */
void interfere_features(struct interfere *w, const struct target *t);

/* Note an interfering face; an error is left in w. */
void interfere_add_face(struct interfere *w, uint16_t body, uint16_t face);

#endif
