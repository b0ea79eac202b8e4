/* SPDX-License-Identifier: MIT */
/*
 * scan - integer scan conversion: a polygon to spans of pixels, or to the cells it touches.
 *
 * Knows nothing of depth. Both walks go up in y, one row at a time, and give one run of x a row.
 *
 * Fill rule of the pixel walk: a pixel belongs to the polygon when its centre does; a centre on a
 * left or lower edge is inside, on a right or upper edge outside, so that polygons that share an
 * edge draw no pixel twice and leave none out.
 *
 * The cell walk is conservative: it gives every cell that the closed polygon, grown by `grow` on
 * all four sides, touches. It may give a few more, never fewer. Degenerate polygons (edge-on, a
 * point) give the cells of their edges.
 */
#ifndef CAROM_SRC_SCAN_H
#define CAROM_SRC_SCAN_H

#include "fix.h"

#define SCAN_MAX 8 /* corners of a polygon: a triangle clipped by five planes */

struct scan_rect {
    int32_t x0, y0, x1, y1; /* x1, y1 exclusive */
};

/* A run of pixels: x0 <= x < x1 in row y. */
struct scan_run {
    int32_t y, x0, x1;
};

/*
 * Walk over a convex polygon in pixels.
 *   xy_q4   corners in pixels with 4 fractional bits, below 2^20 in size, either orientation
 *   clip    only pixels inside are given
 * scan_next returns false after the last run; empty runs are not given.
 */
struct scan_edge {
    int32_t y, y_end;           /* rows whose centres it crosses */
    int32_t x_q4, rest;         /* the crossing at the next row: x + rest / dy */
    int32_t step_q4, step_rest; /* what a row adds */
    int32_t dy;
};
struct scan {
    struct scan_rect clip;
    int32_t n;        /* edges kept: those that cross a row's centre */
    int32_t y, y_end; /* the next row, the row after the last */
    struct scan_edge edge[SCAN_MAX];
};
void scan_begin(struct scan *s, const int32_t xy_q4[][2], int n, struct scan_rect clip);
bool scan_next(struct scan *s, struct scan_run *run);

/* A grid of square cells over x,y: 2^shift quanta a side, from (x0, y0). */
struct scan_grid {
    int32_t x0, y0; /* quanta */
    uint8_t shift;
    uint8_t nx, ny; /* cells, 1 .. 64 */
};

/*
 * Walk over the cells that a convex polygon touches.
 *   grid  shift <= 24; the corner below 2^25 in size
 *   xy    corners in quanta of the grid, |x|, |y| < 2^29
 *   grow  quanta, 0 <= grow < 2^29
 * Runs are clipped to the grid; a polygon outside the grid gives none.
 */
struct scan_cells {
    struct scan_grid grid;
    int32_t n, grow;
    int32_t row, row_end;
    int32_t xy[SCAN_MAX][2];
};
void scan_cells_begin(struct scan_cells *s, const struct scan_grid *grid, const int32_t xy[][2],
                      int n, int32_t grow);
bool scan_cells_next(struct scan_cells *s, struct scan_run *run);

#endif
