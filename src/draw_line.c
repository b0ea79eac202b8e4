/* SPDX-License-Identifier: MIT */
#include "draw.h"

static void put_pixel(const struct carom_picture *picture, int32_t x, int32_t y, uint32_t colour)
{
    if (x >= 0 && x < picture->width && y >= 0 && y < picture->height) {
        uint8_t *row = (uint8_t *)picture->pixels + (size_t)y * (size_t)picture->stride;

        memcpy(row + ((size_t)x << picture->format), &colour, (size_t)1 << picture->format);
    }
}

void draw_ground(const struct carom_picture *picture, int32_t y, int32_t x0, int32_t x1)
{
    uint32_t index = (uint32_t)(y * DRAW_SHADES / picture->height);
    uint32_t colour = draw_colour(picture->format, DRAW_BACKGROUND * DRAW_SHADES + index);

    for (int32_t x = x0; x < x1; x++) {
        put_pixel(picture, x, y, colour);
    }
}

/*
 * One pixel a column, or a row for a steep line, from the pixel that holds one end to the one that
 * holds the other. Starting at the lower end makes the pixels the same in either direction.
 */
void draw_line(const struct carom_picture *picture, const struct draw_vertex *a,
               const struct draw_vertex *b, uint32_t colour)
{
    int32_t x = picture->width / 2, y = picture->height / 2;
    int32_t from[2] = {(draw_x(a->yx_q4) >> 4) + x, ((draw_y(a->yx_q4) - 7) >> 4) + y};
    int32_t to[2] = {(draw_x(b->yx_q4) >> 4) + x, ((draw_y(b->yx_q4) - 7) >> 4) + y};
    int32_t size[2] = {to[0] - from[0], to[1] - from[1]};
    int major = carom_abs(size[1]) > carom_abs(size[0]);
    int32_t minor_q16, step_q16 = 0, n;

    if (size[major] < 0) {
        memcpy(from, to, sizeof from);
        size[0] = -size[0];
        size[1] = -size[1];
    }
    n = size[major];
    /*
     * |size| <= 2^11 pixels; the error of a step, 2^-16, grows to 2^-5 of a pixel at the far end.
     */
    if (n > 0) {
        step_q16 = size[!major] * (1 << 16) / n;
    }
    minor_q16 = from[!major] * (1 << 16) + (1 << 15);
    for (int32_t i = 0; i <= n; i++) {
        int32_t at[2];

        at[major] = from[major] + i;
        at[!major] = minor_q16 >> 16;
        put_pixel(picture, at[0], at[1], colour);
        minor_q16 += step_q16;
    }
}
