/* SPDX-License-Identifier: MIT */
/* Depth: which of several faces at a pixel is in front, and where along a row that changes. */
#include "draw.h"

void draw_depths(const struct draw_sweep *s, struct draw_span *span)
{
    const uint16_t *corner = draw_plane(span->face)->corner;
    uint32_t a = s->vertices[corner[0]].w_q26;
    uint32_t b = s->vertices[corner[1]].w_q26;
    uint32_t c = s->vertices[corner[2]].w_q26;
    uint32_t low = a < b ? a : b, high = a < b ? b : a;

    span->w_low = low < c ? low : c;
    span->w_high = high > c ? high : c;
}

/*
 * Set the plane of depth through a face's corners, at the middle of pixel 0 of the row.
 *
 * It goes through the corners as rounded to q4. So at any pixel of the face, however thin, the
 * depth lies between those of the corners. Bounds: corners are at most 2^15 apart, so area <= 2^30;
 * depths differ by less than 2^31, so numerators are below 2^51, and slopes below 2^43 as the area
 * is at least 2^8; times 2^15 sixteenths of a pixel that is below 2^58, either way.
 */
DRAW_OUT_OF_LINE void set_plane(const struct draw_sweep *s, struct draw_span *span)
{
    const struct draw_face *face = draw_plane(span->face);
    const struct draw_vertex *a = &s->vertices[face->corner[0]];
    const struct draw_vertex *b = &s->vertices[face->corner[1]];
    const struct draw_vertex *c = &s->vertices[face->corner[2]];
    int32_t xa = draw_x(a->yx_q4), ya = draw_y(a->yx_q4);
    int32_t x1 = draw_x(b->yx_q4) - xa, y1 = draw_y(b->yx_q4) - ya;
    int32_t x2 = draw_x(c->yx_q4) - xa, y2 = draw_y(c->yx_q4) - ya;
    int32_t area_q8 = x2 * y1 - x1 * y2; /* twice the area; y runs down */
    int64_t w1 = (int64_t)b->w_q26 - a->w_q26, w2 = (int64_t)c->w_q26 - a->w_q26;

    if (area_q8 < 256) {
        /* less than half a pixel: the mean depth will do */
        span->right_q26 = span->below_q26 = 0;
        span->w_q30 = (a->w_q26 + (w1 + w2) / 3) * 16;
        return;
    }
    span->right_q26 = (w2 * y1 - w1 * y2) * 16 / area_q8;
    span->below_q26 = (w1 * x2 - w2 * x1) * 16 / area_q8;
    span->w_q30 = (int64_t)a->w_q26 * 16 + span->right_q26 * (8 - xa) +
                  span->below_q26 * (s->y * 16 + 15 - ya);
}

/* Carry the plane of depth to the row. Quotients are taken once a face. */
DRAW_OUT_OF_LINE void set_row(const struct draw_sweep *s, struct draw_span *span)
{
    if (span->row == DRAW_NO_ROW) {
        set_plane(s, span);
    } else {
        span->w_q30 += span->below_q26 * (16 * (s->y - span->row));
    }
    span->row = s->y;
}

/* The depth of a span's face at pixel x of the row, q26. */
static inline int64_t depth_at(const struct draw_sweep *s, struct draw_span *span, int32_t x)
{
    if (span->row != s->y) {
        set_row(s, span);
    }
    return (span->w_q30 + span->right_q26 * (16 * x)) >> 4;
}

/* At equal depth the face listed later is in front. */
static bool later(struct draw_span *a, struct draw_span *b)
{
    return a->face < b->face;
}

static bool in_front(const struct draw_sweep *s, struct draw_span *a, struct draw_span *b,
                     int32_t x)
{
    int64_t ahead;

    if (a->w_low > b->w_high || a->w_high < b->w_low) {
        return a->w_low > b->w_high;
    }
    ahead = depth_at(s, a, x) - depth_at(s, b, x);
    return ahead > 0 || (ahead == 0 && later(a, b));
}

/*
 * Limit the top span to where a span under it does not show yet: to the first pixel, from x on, at
 * which the planes cross or the other span begins in front.
 */
DRAW_OUT_OF_LINE void limit_top(struct draw_sweep *s, struct draw_span *top, int number)
{
    struct draw_span *u = s->under[number];
    int32_t from = u->x_q15[0] >> 15, end = u->x_q15[1] >> 15;
    int64_t ahead, growth, wanted = !later(u, top); /* lead at which it is in front */

    from = from > s->x ? from : s->x;
    end = end < s->clear ? end : s->clear;
    if (from >= end || u->w_high < top->w_low) {
        return;
    }
    ahead = depth_at(s, u, from) - depth_at(s, top, from);
    if (ahead < wanted) {
        growth = u->right_q26 - top->right_q26;
        if (growth <= 0 || ahead + growth * (end - 1 - from) < wanted) {
            return;
        }
        from += (int32_t)((wanted - ahead + growth - 1) / growth);
    }
    s->clear = from;
    s->next = number;
}

/* Make a span the top one, up to where another one comes in front; remove spans that have ended. */
static void set_top(struct draw_sweep *s, struct draw_span *top)
{
    int n = 0;

    s->top = top;
    s->end = s->clear = top->x_q15[1] >> 15;
    for (int i = 0; i < s->under_count; i++) {
        if (s->under[i]->x_q15[1] >> 15 > s->x) {
            s->under[n] = s->under[i];
            limit_top(s, top, n++);
        }
    }
    s->under_count = n;
    s->under_high = n == 0 ? 0 : s->under_high;
}

/* Put a span under the top one. A span that finds no room shows nowhere. */
static void put_under(struct draw_sweep *s, struct draw_span *span)
{
    if (s->under_count == DRAW_UNDER_MAX) {
        set_top(s, s->top); /* removes spans that have ended */
    }
    if (s->under_count < DRAW_UNDER_MAX) {
        s->under[s->under_count++] = span;
        s->under_high = s->under_high > span->w_high ? s->under_high : span->w_high;
        limit_top(s, s->top, s->under_count - 1);
    }
}

/* Choose a top span at x, where the last one ended or another one comes in front. */
static void turn(struct draw_sweep *s)
{
    struct draw_span *top = s->top;

    if (top && s->clear < s->end) {
        struct draw_span *next = s->under[s->next];

        s->under[s->next] = top;
        set_top(s, next);
        return;
    }
    s->top = NULL;
    for (int i = 0; i < s->under_count; i++) {
        struct draw_span *u = s->under[i];

        if (u->x_q15[0] >> 15 <= s->x && u->x_q15[1] >> 15 > s->x) {
            s->under[i] = s->under[--s->under_count];
            set_top(s, u);
            return;
        }
    }
}

void draw_advance(struct draw_sweep *s, int32_t to)
{
    while (s->x < to) {
        int32_t end;

        if (s->top == NULL || s->clear == s->x) {
            turn(s);
        }
        if (s->top == NULL) {
            draw_run(s->row, s->pixel_shift, s->x, to, s->ground);
            s->x = to;
            return;
        }
        end = s->clear < to ? s->clear : to;
        if (s->top->face->colour & DRAW_TINT) {
            s->smooth->run(s, s->top, s->x, end);
        } else {
            draw_run(s->row, s->pixel_shift, s->x, end, s->top->pixel);
        }
        s->x = end;
    }
    if (s->top && s->end == s->x) {
        s->top = NULL;
    }
}

void draw_overlap(struct draw_sweep *s, struct draw_span *span)
{
    int32_t from = span->x_q15[0] >> 15;

    if (span->x_q15[1] >> 15 <= s->x) {
        return;
    }
    if (span->w_high == 0) {
        draw_depths(s, span);
    }
    if (s->top && s->top->w_high == 0) {
        draw_depths(s, s->top);
    }
    draw_advance(s, from);
    if (s->top && in_front(s, span, s->top, s->x)) {
        struct draw_span *top = s->top;

        set_top(s, span);
        span = top;
    }
    if (s->top) {
        put_under(s, span);
    } else {
        set_top(s, span);
    }
}
