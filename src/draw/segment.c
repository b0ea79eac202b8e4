/* SPDX-License-Identifier: MIT */
/* Lines of the world: clipped, projected, and as ribbons of two faces. */
#include "draw.h"

#define POINT_LIMIT_Q32 ((int64_t)1 << (14 + 32))
#define HALF_Q4         8 /* half a pixel */

bool draw_point_in_range(const carom_v3_q32 *point)
{
    for (int k = 0; k < 3; k++) {
        if (point->c[k] < -POINT_LIMIT_Q32 || point->c[k] > POINT_LIMIT_Q32) {
            return false;
        }
    }
    return true;
}

/*
 * Set both ends relative to the eye, q22, and return the shift that makes them shorter than 2^29,
 * as for bodies. At most 2^15 units in each direction are a length below 2^38, so the shift is at
 * most 9.
 */
static int place_ends(const struct draw_view *view, const carom_v3_q32 *const point[2],
                      int64_t at[2][3])
{
    uint64_t reach = 0;
    int shift = 0;

    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            at[i][k] = carom_round(point[i]->c[k] - view->eye.c[k], 32 - 22);
        }
        reach |= (uint64_t)fix_length(at[i]);
    }
    while (reach >> shift >> 29) {
        shift++;
    }
    return shift;
}

bool draw_segment(const struct draw_view *view, const carom_v3_q32 *from, const carom_v3_q32 *to,
                  struct draw_vertex ends[2])
{
    const carom_v3_q32 *const point[2] = {from, to};
    struct draw_vertex clipped[DRAW_CLIP_MAX];
    int32_t polygon[DRAW_CLIP_MAX][3];
    struct draw_body body;
    int64_t at[2][3];

    draw_body_of_points(&body, view, place_ends(view, point, at));
    for (int i = 0; i < 2; i++) {
        int32_t away[3];

        for (int k = 0; k < 3; k++) {
            away[k] = (int32_t)(at[i][k] >> body.shift);
        }
        for (int k = 0; k < 3; k++) {
            polygon[i][k] = (int32_t)carom_round(carom_dot(body.to_view.c[k], away), 30);
        }
    }
    if (draw_clip_placed(&body, polygon, 2, clipped) < 2) {
        return false;
    }
    memcpy(ends, clipped, 2 * sizeof ends[0]);
    return true;
}

static struct draw_vertex moved(const struct draw_vertex *from, int32_t x_q4, int32_t y_q4)
{
    uint32_t x = (uint32_t)(draw_x(from->yx_q4) + x_q4), w = from->w_q26;
    uint32_t y = (uint32_t)(draw_y(from->yx_q4) + y_q4);

    /* nearer by 2^-8, so that the line shows where it lies on a face; w_q26 is at most 2^31 */
    return (struct draw_vertex){(int32_t)(y << 16 | (x & 0xffff)),
                                w < 0x7f000000u ? w + (w >> 8) : 0x7fffffffu};
}

/*
 * The ribbon reaches half a pixel to either side, across the axis that the line is nearer to: so
 * each column, or row, between the ends has one pixel whose middle is inside. It also goes half a
 * pixel beyond either end, which includes the ends' pixels. Corners are at most a pixel outside the
 * guard band: 2^14 and 32 sixteenths fit an int16.
 */
void draw_ribbon(const struct draw_vertex ends[2], struct draw_vertex corner[4])
{
    const struct draw_vertex *a = &ends[0], *b = &ends[1];
    int32_t dx = draw_x(b->yx_q4) - draw_x(a->yx_q4), dy = draw_y(b->yx_q4) - draw_y(a->yx_q4);
    bool steep = carom_abs(dy) > carom_abs(dx);
    int32_t n = steep ? dy : dx, aside = n ? (steep ? dx : dy) * HALF_Q4 / n : 0;

    if (n < 0) {
        a = &ends[1];
        b = &ends[0];
    }
    if (steep) { /* down the left side, up the right one */
        corner[0] = moved(a, -aside - HALF_Q4, -HALF_Q4);
        corner[1] = moved(b, aside - HALF_Q4, HALF_Q4);
        corner[2] = moved(b, aside + HALF_Q4, HALF_Q4);
        corner[3] = moved(a, -aside + HALF_Q4, -HALF_Q4);
    } else { /* down at the left end, up at the right one */
        corner[0] = moved(a, -HALF_Q4, -aside - HALF_Q4);
        corner[1] = moved(a, -HALF_Q4, -aside + HALF_Q4);
        corner[2] = moved(b, HALF_Q4, aside + HALF_Q4);
        corner[3] = moved(b, HALF_Q4, aside - HALF_Q4);
    }
}

/*
 * The interval from the lower to the higher pixel, with two more on either side, within low ..
 * high.
 */
static void span_pixels(int32_t a, int32_t b, int32_t low, int32_t high, int32_t out[2])
{
    int32_t first = fix_smaller(a, b) - 2, end = fix_larger(a, b) + 3;

    out[0] = first > low ? first : low;
    out[1] = end < high ? end : high;
}

struct draw_rect draw_segment_rect(const struct draw_view *view, const struct draw_vertex ends[2])
{
    const struct draw_rect *rect = &view->rect;
    int32_t x[2], y[2];

    span_pixels(draw_x(ends[0].yx_q4) >> 4, draw_x(ends[1].yx_q4) >> 4, rect->x0, rect->x1, x);
    span_pixels(draw_row(ends[0].yx_q4), draw_row(ends[1].yx_q4), rect->y0, rect->y1, y);
    if (x[0] >= x[1] || y[0] >= y[1]) {
        return (struct draw_rect){0, 0, 0, 0};
    }
    return (struct draw_rect){x[0], y[0], x[1], y[1]};
}
