/* SPDX-License-Identifier: MIT */
/*
 * scan - integer scan conversion: the cells of a grid that a polygon touches.
 *
 * The walk goes up in y, one row at a time, and gives one run of x a row. It is conservative: it
 * gives every cell that the closed polygon, grown by `grow` on all four sides, touches, and perhaps
 * a few more. Degenerate polygons (edge-on, a point) give the cells of their edges.
 */
#ifndef CAROM_SRC_SCAN_H
#define CAROM_SRC_SCAN_H

#include "../num/fix.h"

#define SCAN_MAX 8 /* corners of a polygon */

/* A run of cells: x0 <= x < x1 in row y. */
struct scan_run {
    int32_t y, x0, x1;
};

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
