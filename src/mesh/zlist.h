/* SPDX-License-Identifier: MIT */
/*
 * zlist - z-lists from a pool, sorted by z, on a grid of cells (paper, section 1, figure 1).
 *
 * The paper's z-list buffer with conservative cells in place of pixels: a face is entered in every
 * cell that its projection touches, with the interval of z that it spans over that cell. Entries
 * come from one fixed pool. A full pool refuses, and the caller goes on in chunks.
 */
#ifndef CAROM_SRC_ZLIST_H
#define CAROM_SRC_ZLIST_H

#include "scan.h"
#include "../num/arena.h"

#define ZLIST_NONE      0xffffu
#define ZLIST_CELLS_MAX 1024 /* nx * ny of any grid */

struct zentry {
    int16_t z0, z1; /* quanta, z0 <= z1 */
    uint16_t face;
    uint16_t next; /* next entry of the cell, of lower or equal z1, or ZLIST_NONE */
};

/* A z-list buffer that is being filled. */
struct zlist {
    uint16_t *head;       /* a cell's entry of highest z1, or ZLIST_NONE; ZLIST_CELLS_MAX of them */
    struct zentry *entry; /* pool->size of them, at most 65535 */
    struct pool *pool;
};

/* Empty every cell. */
void zlist_clear(struct zlist *z);

/*
 * Enter an interval in a cell, in order of z1 (highest first; ties by face, lowest first). Returns
 * false, and changes nothing, if the pool is full.
 */
bool zlist_enter(struct zlist *z, uint32_t cell, int16_t z0, int16_t z1, uint16_t face);

/* A triangle for z-lists: corners in quanta of the grid. */
struct zface {
    int32_t p[3][3];
    int32_t grow; /* quanta on all sides, z included */
};

/*
 * The interval of z that a face spans over one cell, grown, clamped to int16. Conservative: holds
 * the z of every point of the grown face over the closed cell.
 */
void zface_interval(const struct zface *f, const struct scan_grid *grid, int32_t col, int32_t row,
                    int16_t *z0, int16_t *z1);

#endif
