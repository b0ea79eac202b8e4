/* SPDX-License-Identifier: MIT */
#include "draw.h"

/* Depth over the picture: w_q26 = w + dx (x - x0) + dy (y - y0) at the middle of pixel (x, y). */
struct depth_plane {
    int32_t x0, y0;
    uint32_t w, dx, dy; /* modulo 2^32: sums are right whenever the depth itself is in range */
};

static uint8_t *pixel_row(const struct carom_picture *picture, int32_t y)
{
    return (uint8_t *)picture->pixels + (size_t)y * (size_t)picture->stride;
}

void draw_clear(const struct draw_canvas *canvas)
{
    const struct carom_picture *picture = canvas->picture;
    size_t width = (size_t)picture->width;

    for (int32_t y = canvas->rect.y0; y < canvas->rect.y1; y++) {
        uint32_t index = (uint32_t)(y * DRAW_SHADES / picture->height);
        uint32_t colour = draw_colour(picture->format, DRAW_BACKGROUND * DRAW_SHADES + index);
        uint8_t *row = pixel_row(picture, y);

        if (picture->format == CAROM_PALETTE8) {
            memset(row, (int)colour, width);
        } else if (picture->format == CAROM_RGB565) {
            for (size_t x = 0; x < width; x++) {
                ((uint16_t *)(void *)row)[x] = (uint16_t)colour;
            }
        } else {
            for (size_t x = 0; x < width; x++) {
                ((uint32_t *)(void *)row)[x] = colour;
            }
        }
    }
    if (canvas->depth) {
        size_t rows = (size_t)(canvas->rect.y1 - canvas->rect.y0);

        memset(canvas->depth, 0, CAROM_DRAW_BYTES(width, rows));
    }
}

static void run_8(uint8_t *pixel, uint32_t *depth, int32_t n, uint32_t w, uint32_t dw,
                  uint32_t colour)
{
    for (int32_t x = 0; x < n; x++) {
        if (w >= depth[x]) {
            depth[x] = w;
            pixel[x] = (uint8_t)colour;
        }
        w += dw;
    }
}

static void run_16(uint16_t *pixel, uint32_t *depth, int32_t n, uint32_t w, uint32_t dw,
                   uint32_t colour)
{
    for (int32_t x = 0; x < n; x++) {
        if (w >= depth[x]) {
            depth[x] = w;
            pixel[x] = (uint16_t)colour;
        }
        w += dw;
    }
}

static void run_32(uint32_t *pixel, uint32_t *depth, int32_t n, uint32_t w, uint32_t dw,
                   uint32_t colour)
{
    for (int32_t x = 0; x < n; x++) {
        if (w >= depth[x]) {
            depth[x] = w;
            pixel[x] = colour;
        }
        w += dw;
    }
}

static void fill_run(const struct draw_canvas *canvas, const struct scan_run *run,
                     const struct depth_plane *plane, uint32_t colour)
{
    const struct carom_picture *picture = canvas->picture;
    uint8_t *row = pixel_row(picture, run->y);
    uint32_t *depth = canvas->depth + (run->y - canvas->rect.y0) * picture->width + run->x0;
    int32_t n = run->x1 - run->x0;
    uint32_t w = plane->w + plane->dx * (uint32_t)(run->x0 - plane->x0) +
                 plane->dy * (uint32_t)(run->y - plane->y0);

    switch (picture->format) {
    case CAROM_PALETTE8:
        run_8(row + run->x0, depth, n, w, plane->dx, colour);
        break;
    case CAROM_RGB565:
        run_16((uint16_t *)(void *)row + run->x0, depth, n, w, plane->dx, colour);
        break;
    default:
        run_32((uint32_t *)(void *)row + run->x0, depth, n, w, plane->dx, colour);
        break;
    }
}

/* A 64-bit division is avoided where n is short, as it is for all but large faces. */
static int64_t divide(int64_t n, int32_t d)
{
    return n == (int32_t)n ? (int32_t)n / d : n / d;
}

/*
 * The plane of depth through the three projected corners; false when they enclose no area or run
 * the wrong way round.
 *
 * It goes through the corners as they were rounded to q4, so that at any pixel that the scan gives
 * the depth lies between those of the corners, however thin the triangle is. Corners are at most
 * 2^15 apart, hence area <= 2^30; depths differ by less than 2^31, hence numerators < 2^48.
 */
static bool plane_of(struct depth_plane *plane, const struct draw_corner *a,
                     const struct draw_corner *b, const struct draw_corner *c)
{
    int32_t x1 = b->xy_q4[0] - a->xy_q4[0], y1 = b->xy_q4[1] - a->xy_q4[1];
    int32_t x2 = c->xy_q4[0] - a->xy_q4[0], y2 = c->xy_q4[1] - a->xy_q4[1];
    int32_t area_q8 = x2 * y1 - x1 * y2; /* twice the area; y runs down the page */
    int64_t w1 = (int64_t)b->w_q26 - a->w_q26, w2 = (int64_t)c->w_q26 - a->w_q26;
    int64_t dx, dy;

    if (area_q8 <= 0) {
        return false;
    }
    plane->x0 = a->xy_q4[0] >> 4;
    plane->y0 = a->xy_q4[1] >> 4;
    if (area_q8 < 256) {
        /* Less than half a pixel lights hardly one: its mean depth will do. */
        plane->w = a->w_q26 + (uint32_t)((w1 + w2) / 3);
        plane->dx = plane->dy = 0;
        return true;
    }
    /* Per pixel: 16 q4 steps. */
    dx = divide((w2 * y1 - w1 * y2) * 16, area_q8);
    dy = divide((w1 * x2 - w2 * x1) * 16, area_q8);
    plane->dx = (uint32_t)dx;
    plane->dy = (uint32_t)dy;
    /* |dx|, |dy| < 2^44: eight sixteenths of a pixel to the middle of the pixel that holds a. */
    plane->w = a->w_q26 + (uint32_t)((dx * (plane->x0 * 16 + 8 - a->xy_q4[0]) +
                                      dy * (plane->y0 * 16 + 8 - a->xy_q4[1])) >>
                                     4);
    return true;
}

void draw_triangle(const struct draw_canvas *canvas, const struct draw_corner *a,
                   const struct draw_corner *b, const struct draw_corner *c, uint32_t colour)
{
    const int32_t xy_q4[3][2] = {
        {a->xy_q4[0], a->xy_q4[1]}, {b->xy_q4[0], b->xy_q4[1]}, {c->xy_q4[0], c->xy_q4[1]}};
    struct depth_plane plane;
    struct scan scan;
    struct scan_run run;

    if (!plane_of(&plane, a, b, c)) {
        return;
    }
    scan_begin(&scan, xy_q4, 3, canvas->rect);
    while (scan_next(&scan, &run)) {
        fill_run(canvas, &run, &plane, colour);
    }
}

static void put_pixel(const struct draw_canvas *canvas, int32_t x, int32_t y, uint32_t colour)
{
    const struct scan_rect *rect = &canvas->rect;
    uint8_t *row;

    if (x < rect->x0 || x >= rect->x1 || y < rect->y0 || y >= rect->y1) {
        return;
    }
    row = pixel_row(canvas->picture, y);
    switch (canvas->picture->format) {
    case CAROM_PALETTE8:
        row[x] = (uint8_t)colour;
        break;
    case CAROM_RGB565:
        ((uint16_t *)(void *)row)[x] = (uint16_t)colour;
        break;
    default:
        ((uint32_t *)(void *)row)[x] = colour;
        break;
    }
}

/*
 * One pixel a column, or a row for a steep line, from the pixel that holds one end to the one that
 * holds the other. Starting at the lower end makes the pixels the same in either direction.
 */
void draw_line(const struct draw_canvas *canvas, const struct draw_corner *a,
               const struct draw_corner *b, uint32_t colour)
{
    int32_t from[2] = {a->xy_q4[0] >> 4, a->xy_q4[1] >> 4};
    int32_t to[2] = {b->xy_q4[0] >> 4, b->xy_q4[1] >> 4};
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
        put_pixel(canvas, at[0], at[1], colour);
        minor_q16 += step_q16;
    }
}
