/* SPDX-License-Identifier: MIT */
/* Pixels in memory: where a row is, its background, and runs of one colour. */
#include "draw.h"

int draw_pixel_shift(uint8_t format)
{
    static const int8_t shifts[] = {0, 1, 2, -1, 1}; /* by enum carom_pixel_format */

    return shifts[format];
}

uint8_t *draw_pixels(const struct draw_view *view, const struct carom_picture *picture, int32_t y)
{
    const int32_t *middle = view->middle;
    uint8_t *row = (uint8_t *)picture->pixels;

    if (picture->row) {
        row = (uint8_t *)picture->row(picture->context, view->rect.x0 + middle[0],
                                      view->rect.x1 + middle[0], y + middle[1]);
    } else {
        row += (size_t)(y + middle[1]) * (size_t)picture->stride;
    }
    return draw_pixel(row, draw_pixel_shift(picture->format), middle[0]);
}

/*
 * The shade of a row by its distance from the horizon, in steps of 2^-bits shades. Half of the
 * shades are for each side; they meet at the horizon, and reach their ends a picture's height away.
 */
static int32_t shade_by_horizon(int32_t below, int32_t height, int bits)
{
    const int32_t half = DRAW_SHADES / 2 << bits;
    int32_t away = (below < 0 ? -below - 1 : below) * half / height;

    away = away < half ? away : half - 1;
    return below < 0 ? half - 1 - away : half + away;
}

static int32_t shade_of_row(const struct draw_view *view, const struct carom_picture *picture,
                            int32_t y, int bits)
{
    return picture->paint && picture->paint->horizon
               ? shade_by_horizon(y - view->horizon, picture->height, bits)
               : (y + view->middle[1]) * (DRAW_SHADES << bits) / picture->height;
}

uint32_t draw_ground(const struct draw_view *view, const struct carom_picture *picture, int32_t y)
{
    const struct carom_smooth *smooth = draw_smooth(picture->paint);

    return smooth ? smooth->ground(picture, y, shade_of_row(view, picture, y, 8))
                  : draw_colour(picture, DRAW_BACKGROUND * DRAW_SHADES +
                                             (uint32_t)shade_of_row(view, picture, y, 0));
}

/* Write a repeated word to the bytes from p to end. */
static void run_bytes(uint8_t *p, uint8_t *end, uint32_t word)
{
    if (!DRAW_ANYWHERE && (uintptr_t)p & 1 && p < end) {
        *p++ = (uint8_t)word;
    }
    if (!DRAW_ANYWHERE && (uintptr_t)p & 2 && end - p >= 2) {
        *(draw_half *)(void *)p = (uint16_t)word;
        p += 2;
    }
    /* some processors write several aligned words at once */
    if (((uintptr_t)p & 3) == 0) {
        const draw_four four = {{word, word, word, word}};

        for (; end - p >= 64; p += 64) {
            draw_four *to = (draw_four *)(void *)p;

            to[0] = to[1] = to[2] = to[3] = four;
        }
    }
    for (; end - p >= 32; p += 32) {
        draw_word *to = (draw_word *)(void *)p;

        to[0] = to[1] = to[2] = to[3] = to[4] = to[5] = to[6] = to[7] = word;
    }
    for (; end - p >= 4; p += 4) {
        *(draw_word *)(void *)p = word;
    }
    if (end - p >= 2) {
        *(draw_half *)(void *)p = (uint16_t)word;
        p += 2;
    }
    if (p < end) {
        *p = (uint8_t)word;
    }
}

void draw_run(uint8_t *row, int pixel_shift, int32_t from, int32_t to, uint32_t pixel)
{
    if (from >= to) {
        return;
    }
    if (pixel_shift < 0) {
        uint8_t *first = row + (from >> 1), *last = row + (to >> 1);

        /* half bytes shared with a neighbour */
        if (from & 1) {
            *first = (uint8_t)((*first & 0xf0) | (pixel & 0x0f));
            from++;
        }
        if (to & 1) {
            *last = (uint8_t)((*last & 0x0f) | (pixel & 0xf0));
        }
    }
    run_bytes(draw_pixel(row, pixel_shift, from), draw_pixel(row, pixel_shift, to), pixel);
}
