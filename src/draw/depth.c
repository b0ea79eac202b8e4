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

/* Depth along a row: w at the middle of a pixel, and its growth a pixel. */
struct slope {
    int64_t w, dx;
};

/*
 * The plane of depth through a face's corners, at pixel (x, y).
 *
 * It goes through the corners as rounded to q4. So at any pixel of the face, however thin, the
 * depth lies between those of the corners. Bounds: corners are at most 2^15 apart, so area <= 2^30;
 * depths differ by less than 2^31, so numerators are below 2^51, and slopes below 2^43 as the area
 * is at least 2^8; times 2^15 sixteenths of a pixel that is below 2^59.
 */
static struct slope slope_at(const struct draw_sweep *s, const struct draw_face *face, int32_t x,
                             int32_t y)
{
    const struct draw_vertex *a = &s->vertices[face->corner[0]];
    const struct draw_vertex *b = &s->vertices[face->corner[1]];
    const struct draw_vertex *c = &s->vertices[face->corner[2]];
    int32_t xa = draw_x(a->yx_q4), ya = draw_y(a->yx_q4);
    int32_t x1 = draw_x(b->yx_q4) - xa, y1 = draw_y(b->yx_q4) - ya;
    int32_t x2 = draw_x(c->yx_q4) - xa, y2 = draw_y(c->yx_q4) - ya;
    int32_t area_q8 = x2 * y1 - x1 * y2; /* twice the area; y runs down */
    int64_t w1 = (int64_t)b->w_q26 - a->w_q26, w2 = (int64_t)c->w_q26 - a->w_q26;
    struct slope slope;
    int64_t dy;

    if (area_q8 < 256) {
        /* less than half a pixel: the mean depth will do */
        return (struct slope){a->w_q26 + (w1 + w2) / 3, 0};
    }
    slope.dx = (w2 * y1 - w1 * y2) * 16 / area_q8;
    dy = (w1 * x2 - w2 * x1) * 16 / area_q8;
    slope.w = a->w_q26 + ((slope.dx * (x * 16 + 8 - xa) + dy * (y * 16 + 15 - ya)) >> 4);
    return slope;
}

/* The lead of a before b in depth at pixel x, and its growth a pixel. */
static struct slope ahead_at(const struct draw_sweep *s, struct draw_span *a, struct draw_span *b,
                             int32_t x)
{
    struct slope wa = slope_at(s, draw_plane(a->face), x, s->y);
    struct slope wb = slope_at(s, draw_plane(b->face), x, s->y);

    return (struct slope){wa.w - wb.w, wa.dx - wb.dx};
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
    ahead = ahead_at(s, a, b, x).w;
    return ahead > 0 || (ahead == 0 && later(a, b));
}

/* Remove spans that have ended. Out of line, since it is hardly ever needed. */
DRAW_OUT_OF_LINE void drop_ended_spans(struct draw_sweep *s)
{
    int n = 0;

    for (int i = 0; i < s->under_count; i++) {
        if (s->under[i]->x_q15[1] >> 15 > s->x) {
            s->under[n++] = s->under[i];
        }
    }
    s->under_count = n;
}

static void put_under(struct draw_sweep *s, struct draw_span *span)
{
    if (s->under_count == DRAW_UNDER_MAX) {
        drop_ended_spans(s);
    }
    if (s->under_count < DRAW_UNDER_MAX) {
        s->under[s->under_count++] = span;
        if (s->under_high < span->w_high) {
            s->under_high = span->w_high;
        }
    }
}

/* Make the nearest span at x the top one, if there is one; remove spans that have ended. */
static void find_top(struct draw_sweep *s)
{
    int n = 0, best = -1;

    for (int i = 0; i < s->under_count; i++) {
        struct draw_span *u = s->under[i];

        if (u->x_q15[1] >> 15 > s->x) {
            if (u->x_q15[0] >> 15 <= s->x && (best < 0 || in_front(s, u, s->under[best], s->x))) {
                best = n;
            }
            s->under[n++] = u;
        }
    }
    s->under_count = n;
    if (best >= 0) {
        s->top = s->under[best];
        s->end = s->top->x_q15[1] >> 15;
        s->under[best] = s->under[--s->under_count];
    }
    s->under_high = s->under_count == 0 ? 0 : s->under_high;
}

/*
 * The first pixel before `to` at which another span comes in front of the top one, which is in
 * front at x: where their planes cross, or where the other begins. Sets `which` to that span.
 * Returns `to` if there is none.
 */
static int32_t find_crossing(const struct draw_sweep *s, int32_t to, int *which)
{
    for (int i = 0; i < s->under_count; i++) {
        struct draw_span *u = s->under[i];
        int32_t from = u->x_q15[0] >> 15, end = u->x_q15[1] >> 15;
        int64_t pixels, wanted = !later(u, s->top); /* lead at which it is in front */
        struct slope ahead;

        from = from > s->x ? from : s->x + 1;
        end = end < to ? end : to;
        if (from >= end || u->w_high < s->top->w_low) {
            continue;
        }
        ahead = ahead_at(s, u, s->top, from);
        if (ahead.w < wanted) {
            if (ahead.dx <= 0) {
                continue;
            }
            pixels = (wanted - ahead.w + ahead.dx - 1) / ahead.dx;
            if (pixels >= end - from) {
                continue;
            }
            from += (int32_t)pixels;
        }
        to = from;
        *which = i;
    }
    return to;
}

void draw_advance(struct draw_sweep *s, int32_t to)
{
    while (s->x < to) {
        int32_t end;
        int which = -1;

        if (s->top == NULL) {
            find_top(s);
        }
        if (s->top == NULL) {
            draw_run(s->row, s->pixel_shift, s->x, to, s->ground);
            s->x = to;
            return;
        }
        end = find_crossing(s, s->end < to ? s->end : to, &which);
        if (s->top->face->colour & DRAW_TINT) {
            s->smooth->run(s, s->top, s->x, end);
        } else {
            draw_run(s->row, s->pixel_shift, s->x, end, s->top->pixel);
        }
        s->x = end;
        if (which >= 0) {
            struct draw_span *next = s->under[which];

            s->under[which] = s->top;
            s->top = next;
            s->end = next->x_q15[1] >> 15;
        } else if (end == s->end) {
            s->top = NULL;
        }
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
    if (s->top == NULL) {
        find_top(s);
    }
    if (s->top && !in_front(s, span, s->top, s->x)) {
        put_under(s, span);
        return;
    }
    if (s->top) {
        put_under(s, s->top);
    }
    s->top = span;
    s->end = span->x_q15[1] >> 15;
}
