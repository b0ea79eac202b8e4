/* SPDX-License-Identifier: MIT */
/* Walk over the cells of a grid that a convex polygon touches. */
#include "scan.h"

/* floor(n / d) and the remainder, 0 <= rest < d. */
struct quotient {
    int32_t floor, rest;
};

/* Range: d > 0, the quotient fits. Avoids a 64-bit division if n is short. */
static struct quotient divide(int64_t n, int32_t d)
{
    struct quotient q;

    CAROM_ASSERT(d > 0);
    if (n >= INT32_MIN && n <= INT32_MAX) {
        q.floor = (int32_t)n / d;
        q.rest = (int32_t)n % d;
    } else {
        q.floor = (int32_t)(n / d);
        q.rest = (int32_t)(n % d);
    }
    if (q.rest < 0) {
        q.rest += d;
        q.floor--;
    }
    return q;
}

/*
 * The closed cells, 2^shift wide from 0 on, that the interval [low, high] touches: [*first, *end).
 * A cell touches low unless its upper side, (i + 1) 2^shift, is below low.
 */
static void touched(int32_t low, int32_t high, int shift, int32_t count, int32_t *first,
                    int32_t *end)
{
    int32_t above = ((int32_t)1 << shift) - 1;

    *first = fix_larger(((low + above) >> shift) - 1, 0);
    *end = fix_smaller((high >> shift) + 1, count);
}

void scan_cells_begin(struct scan_cells *s, const struct scan_grid *grid, const int32_t xy[][2],
                      int n, int32_t grow)
{
    int32_t low = INT32_MAX, high = INT32_MIN;

    CAROM_ASSERT(n >= 1 && n <= SCAN_MAX && grow >= 0 && grow < 1 << 29 && grid->shift <= 24);
    CAROM_ASSERT(carom_abs(grid->x0) < 1 << 25 && carom_abs(grid->y0) < 1 << 25);
    s->grid = *grid;
    s->n = n;
    s->grow = grow;
    for (int i = 0; i < n; i++) {
        CAROM_ASSERT(carom_abs(xy[i][0]) < 1 << 29 && carom_abs(xy[i][1]) < 1 << 29);
        s->xy[i][0] = xy[i][0];
        s->xy[i][1] = xy[i][1];
        low = fix_smaller(low, xy[i][1]);
        high = fix_larger(high, xy[i][1]);
    }
    touched(low - grow - grid->y0, high + grow - grid->y0, grid->shift, grid->ny, &s->row,
            &s->row_end);
}

/*
 * Widen the integers [*low, *high] by the x at which the edge from a up to b crosses height y. The
 * lower limit is rounded up, the upper one down: cells begin and end at integers, so no cell is
 * lost, and none is added that the exact crossing does not touch.
 *
 * Bounds: y - a[1] and b[0] - a[0] are < 2^31 in size, their product < 2^62.
 */
static void add_crossing(const int32_t a[2], const int32_t b[2], int32_t y, int32_t *low,
                         int32_t *high)
{
    if (a[1] < y && y < b[1]) {
        struct quotient q = divide((int64_t)(y - a[1]) * (b[0] - a[0]), b[1] - a[1]);

        *low = fix_smaller(*low, a[0] + q.floor + (q.rest > 0));
        *high = fix_larger(*high, a[0] + q.floor);
    }
}

/*
 * Growing the polygon by a square is the same as growing the strip of cells in y and the interval
 * found in x. The extent of a convex polygon within a strip is that of its corners inside and of
 * its edges' crossings with both sides.
 */
bool scan_cells_next(struct scan_cells *s, struct scan_run *run)
{
    while (s->row < s->row_end) {
        int32_t y0 = s->grid.y0 + s->row * ((int32_t)1 << s->grid.shift) - s->grow;
        int32_t y1 = y0 + ((int32_t)1 << s->grid.shift) + 2 * s->grow;
        int32_t low = INT32_MAX, high = INT32_MIN;

        run->y = s->row++;
        for (int i = 0; i < s->n; i++) {
            const int32_t *a = s->xy[i], *b = s->xy[i + 1 < s->n ? i + 1 : 0];
            bool up = a[1] < b[1];

            if (a[1] >= y0 && a[1] <= y1) {
                low = fix_smaller(low, a[0]);
                high = fix_larger(high, a[0]);
            }
            add_crossing(up ? a : b, up ? b : a, y0, &low, &high);
            add_crossing(up ? a : b, up ? b : a, y1, &low, &high);
        }
        touched(low - s->grow - s->grid.x0, high + s->grow - s->grid.x0, s->grid.shift, s->grid.nx,
                &run->x0, &run->x1);
        if (run->x0 < run->x1) {
            return true;
        }
    }
    return false;
}
