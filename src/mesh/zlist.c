/* SPDX-License-Identifier: MIT */
/* Z-lists: enter intervals, and the interval of z that a face spans over a cell. */
#include "zlist.h"

void zlist_clear(struct zlist *z)
{
    memset(z->head, 0xff, ZLIST_CELLS_MAX * sizeof z->head[0]); /* ZLIST_NONE everywhere */
    pool_clear(z->pool);
}

bool zlist_enter(struct zlist *z, uint32_t cell, int16_t z0, int16_t z1, uint16_t face)
{
    int32_t place = pool_take(z->pool);
    uint16_t *link = &z->head[cell];

    CAROM_ASSERT(cell < ZLIST_CELLS_MAX && z0 <= z1);
    if (place < 0) {
        return false;
    }
    while (*link != ZLIST_NONE) {
        const struct zentry *other = &z->entry[*link];

        if (other->z1 < z1 || (other->z1 == z1 && other->face > face)) {
            break;
        }
        link = &z->entry[*link].next;
    }
    z->entry[place] = (struct zentry){z0, z1, face, *link};
    *link = (uint16_t)place;
    return true;
}

/* A closed rectangle of x and y. */
struct area {
    int32_t low[2], high[2];
};

/* Lowest and highest coordinate k of the corners. */
static void extent(const struct zface *f, int k, int32_t *low, int32_t *high)
{
    *low = *high = f->p[0][k];
    for (int i = 1; i < 3; i++) {
        *low = f->p[i][k] < *low ? f->p[i][k] : *low;
        *high = f->p[i][k] > *high ? f->p[i][k] : *high;
    }
}

/*
 * The part of the face's rectangle over the cell, which is grown by f->grow. Returns true if the
 * cell cuts anything away.
 */
static bool cut_area(const struct zface *f, const struct scan_grid *grid, int32_t col, int32_t row,
                     struct area *area)
{
    int32_t side = (int32_t)1 << grid->shift;
    int32_t corner[2] = {grid->x0 + col * side, grid->y0 + row * side};
    bool cut = false;

    for (int k = 0; k < 2; k++) {
        int32_t low = corner[k] - f->grow, high = corner[k] + side + f->grow;

        extent(f, k, &area->low[k], &area->high[k]);
        if (low > area->low[k]) {
            area->low[k] = low;
            cut = true;
        }
        if (high < area->high[k]) {
            area->high[k] = high;
            cut = true;
        }
    }
    return cut;
}

static int64_t floor_div(int64_t n, int64_t d)
{
    return n / d - (n % d < 0);
}

/*
 * Narrow [*z0, *z1] to the z of the face's plane over an area. With n the sides' cross product and s = sign(n.z),
 * the height over corner 0 is -(n.x dx + n.y dy) / n.z, lowest where s n.x dx and s n.y dy are
 * largest. Nothing is narrowed for a plane that stands on edge or for a face beyond the bounds.
 *
 * Bounds: |sides| < 2^18, so |n| < 2^37; |dx|, |dy| < 2^18, being within the face's own rectangle;
 * so each product is < 2^55 and their sum < 2^56.
 */
static void narrow(const struct zface *f, const struct area *area, int32_t *z0, int32_t *z1)
{
    int64_t n[3], least = 0, most = 0, low, high;
    int32_t side[2][3];

    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            int64_t d = (int64_t)f->p[1 + i][k] - f->p[0][k];

            if (carom_abs(d) >= 1 << 18) {
                return;
            }
            side[i][k] = (int32_t)d;
        }
    }
    fix_cross(n, side[0], side[1]);
    if (n[2] == 0) {
        return;
    }
    for (int k = 0; k < 2; k++) {
        int64_t slope = n[2] < 0 ? -n[k] : n[k];
        int64_t a = slope * (area->low[k] - f->p[0][k]);
        int64_t b = slope * (area->high[k] - f->p[0][k]);

        least += a < b ? a : b;
        most += a < b ? b : a;
    }
    low = f->p[0][2] + floor_div(-most, carom_abs(n[2]));
    high = f->p[0][2] - floor_div(least, carom_abs(n[2]));
    *z0 = low > *z0 ? (int32_t)low : *z0;
    *z1 = high < *z1 ? (int32_t)high : *z1;
}

static int16_t clamp_int16(int32_t v)
{
    return (int16_t)(v < INT16_MIN ? INT16_MIN : v > INT16_MAX ? INT16_MAX : v);
}

void zface_interval(const struct zface *f, const struct scan_grid *grid, int32_t col, int32_t row,
                    int16_t *z0, int16_t *z1)
{
    struct area area;
    int32_t low, high;

    extent(f, 2, &low, &high);
    if (cut_area(f, grid, col, row, &area)) {
        narrow(f, &area, &low, &high);
    }
    CAROM_ASSERT(low <= high);
    *z0 = clamp_int16(low - f->grow);
    *z1 = clamp_int16(high + f->grow);
}
