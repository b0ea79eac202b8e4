/* SPDX-License-Identifier: MIT */
/*
 * row - draw a row's pixels from its spans; included by each file that has its own pixel size or
 * shading.
 */
#ifndef CAROM_SRC_DRAW_ROW_H
#define CAROM_SRC_DRAW_ROW_H

#include "draw.h"

/*
 * Draw pixels from <= x < to, and perhaps 3 pixels more. Most runs here are short, and writing four
 * pixels at a time costs less than finding where a run ends.
 */
static inline void fill_run(uint8_t *row, int pixel_shift, int32_t from, int32_t to, uint32_t pixel)
{
    uint8_t *p, *end;

    if (pixel_shift == 2) {
        draw_pixel4 *to4 = (draw_pixel4 *)(void *)row + to;

        for (draw_pixel4 *p4 = to4 + (from - to); p4 < to4; p4 += 4) {
            p4[0] = p4[1] = p4[2] = p4[3] = pixel;
        }
        return;
    }
    if (pixel_shift < 0) {
        draw_run(row, pixel_shift, from, to, pixel);
        return;
    }
    p = row + from * (1 << pixel_shift);
    end = row + to * (1 << pixel_shift);
    if (!DRAW_ANYWHERE && (uintptr_t)p & 1) {
        *p++ = (uint8_t)pixel;
    }
    if (!DRAW_ANYWHERE && (uintptr_t)p & 2) {
        *(draw_half *)(void *)p = (uint16_t)pixel;
        p += 2;
    }
    for (; p < end; p += 4) {
        *(draw_word *)(void *)p = pixel;
    }
}

/* Take in a span that begins before the gate. */
static inline void row_overlap(struct draw_sweep *s, struct draw_span *span)
{
    if (s->end <= s->x) {
        s->top = NULL;
    }
    if (s->under_count == 0) {
        s->clear = s->end;
    }
    draw_overlap(s, span);
    s->gate = INT32_MAX;
    if (s->top == NULL) {
        s->end = s->x;
    }
    if (s->under_count == 0) {
        s->gate = s->end;
    }
}

/* Draw a run of the top span, or of the background. */
DRAW_INLINE void fill_top(const struct draw_sweep *s, const struct draw_span *top, bool tints,
                          int pixel_shift, int32_t from, int32_t to, uint32_t pixel)
{
    if (tints && top && top->face->colour & DRAW_TINT) {
        s->smooth->run(s, top, from, to);
    } else {
        fill_run(s->row, pixel_shift, from, to, pixel);
    }
}

/* Draw a row's pixels up to x1. tints: some faces have a shade at each pixel. */
DRAW_INLINE void fill_row(struct draw_sweep *s, struct draw_span *const *spans, int32_t x1,
                          int pixel_shift, bool tints)
{
    int32_t x = s->x, end = x, gate = x, safe = s->safe;
    uint32_t pixel = s->ground, ground = s->ground;
    struct draw_span *top = NULL;
    uint8_t *row = s->row;

    for (;;) {
        struct draw_span *span = *spans++;
        int32_t a = span->x_q15[0] >> 15, b = span->x_q15[1] >> 15;

        if (a >= b) {
            continue;
        }
        if (a >= safe) {
            if (a >= x1) {
                break;
            }
            gate = INT32_MAX;
        }
        if (a < gate) {
            if (top && span->w_high == 0) {
                draw_depths(s, span);
            }
            if (top && a < end && draw_hides(s, top, span)) {
                s->clear = s->under_count == 1 ? end : s->clear;
                gate = INT32_MAX;
                continue;
            }
            if (top && a == end && a < safe && s->clear == end && draw_shows(s, span)) {
                fill_top(s, top, tints, pixel_shift, x, end, pixel);
                top = span;
                pixel = span->pixel;
                x = a;
                end = s->clear = b;
                continue;
            }
            s->x = x;
            s->top = top;
            s->end = end;
            row_overlap(s, span);
            top = s->top;
            x = s->x;
            end = s->end;
            gate = s->gate;
            pixel = top ? top->pixel : ground;
            continue;
        }
        fill_top(s, top, tints, pixel_shift, x, end, pixel);
        if (a > end) {
            draw_run(row, pixel_shift, end, a, ground);
        }
        top = span;
        pixel = span->pixel;
        x = a;
        end = gate = b;
    }
    s->x = x;
    s->top = end > x ? top : NULL;
    s->end = end;
    s->clear = s->under_count == 0 ? end : s->clear;
    draw_advance(s, x1);
}

#endif
