/* SPDX-License-Identifier: MIT */
/*
 * paper - interference detection as the paper does it, for comparison with Carom's (make PAPER=1).
 *
 * Both meshes, clipped to the box of the moving one, are scan-converted along z onto 512 x 512
 * pixels. Each pixel keeps its entries sorted by z. Where the insides of both meshes overlap, the
 * faces at the ends of the overlap interfere. A crossing between the centres of pixels is missed.
 *
 * It is not a part of the engine: its z-list buffer is a static block of some megabytes.
 */
#ifndef CAROM_SRC_PAPER_H
#define CAROM_SRC_PAPER_H

#include "carom.h"

#define PAPER_SIDE    512 /* pixels */
#define PAPER_ENTRIES (3 << 18)

/* A mesh at a pose. */
struct paper_placed {
    const struct carom_mesh *mesh;
    const carom_m3_q30 *r; /* its axes */
    int32_t at_q20[3];     /* its centre of mass, relative to a place that both meshes share */
};

struct paper_visitor {
    void (*visit)(struct paper_visitor *self, uint16_t face_a, uint16_t face_b);
};

/*
 * Hand over the pairs of faces that interfere, most of them once.
 *   a  the moving mesh
 * Range: all vertices within 1024 units of that place
 */
void paper_pairs(const struct paper_placed *a, const struct paper_placed *b,
                 struct paper_visitor *visitor);

/* Entries that found no room so far. */
uint32_t paper_refused(void);

#endif
