/* SPDX-License-Identifier: MIT */
/*
 * cross - do two bodies have a common point at their poses? Exact, once a's vertices are rounded
 * into b's axes.
 */
#ifndef CAROM_SRC_QUERY_CROSS_H
#define CAROM_SRC_QUERY_CROSS_H

#include "../interfere/narrow.h"

struct cross {
    struct interfere_sure base; /* passed to interfere_query_sure(a, b) */
    struct interfere_placed a, b;
    carom_m3_q30 to_b;
    int64_t at_q52[3]; /* a's centre of mass from b's origin, in b's axes */
    int bits;          /* fractional bits of places, in units */
};

void cross_begin(struct cross *c, struct interfere_placed a, struct interfere_placed b);

/* True if two triangles have a common point. Coordinates are below 2^29. */
bool cross_triangles(const struct interfere_vec p[3], const struct interfere_vec q[3]);

/*
 * cross_inside: true if a is inside b, or under b if that is a SURFACE. cross_around: true if b is
 * inside a. Precondition: their faces have no common point.
 */
bool cross_inside(const struct cross *c);
bool cross_around(const struct cross *c);

#endif
