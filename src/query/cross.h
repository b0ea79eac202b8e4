/* SPDX-License-Identifier: MIT */
/* cross - whether two bodies have a point in common where they are: exact for places that are rounded once. */
#ifndef CAROM_SRC_QUERY_CROSS_H
#define CAROM_SRC_QUERY_CROSS_H

#include "../interfere/narrow.h"

struct cross {
    struct interfere_sure base; /* for interfere_query_sure of a and b */
    struct interfere_placed a, b;
    carom_m3_q30 to_b;
    int64_t at_q52[3]; /* a's centre of mass from b's origin in b's axes */
    int bits;          /* of a unit in places */
};

void cross_begin(struct cross *c, struct interfere_placed a, struct interfere_placed b);

/* Whether two triangles have a point in common. Coordinates below 2^29. */
bool cross_triangles(const struct interfere_vec p[3], const struct interfere_vec q[3]);

/* Whether a is inside b, or under a SURFACE; whether b is inside a. Their faces must have no point in common. */
bool cross_inside(const struct cross *c);
bool cross_around(const struct cross *c);

#endif
