/* SPDX-License-Identifier: MIT */
/* carom_draw_text: text over a finished picture. */
#include "draw.h"

#define PLACE_MAX 16384
#define SCALE_MAX 64
#define GLYPH_BOX 95 /* glyph for all characters that the font lacks, in the place of 127 */

/* A line of text on the picture. */
struct writing {
    const struct carom_picture *picture;
    const char *text, *end; /* the characters */
    int32_t x, scale;       /* left end of the first cell; pixels for each of a glyph's */
    struct draw_rect rect;  /* its cells, clipped to the picture */
    int pixel_shift;
    bool opaque;
    uint32_t colour, paper; /* pixels */
};

static const uint8_t *glyph_of(char character)
{
    int number = character;

    return draw_font[number >= 32 && number <= 126 ? number - 32 : GLYPH_BOX];
}

static int32_t clamp(int64_t v, int32_t low, int32_t high)
{
    return v < low ? low : v > high ? high : (int32_t)v;
}

/* Draw pixels from <= x < to of a row, clipped to the picture. */
static void run(const struct writing *writing, uint8_t *row, int64_t from, int64_t to,
                uint32_t pixel)
{
    draw_run(row, writing->pixel_shift, clamp(from, writing->rect.x0, writing->rect.x1),
             clamp(to, writing->rect.x0, writing->rect.x1), pixel);
}

/* Draw, in row y of the picture, row `line` of the glyphs. */
static void write_row(const struct writing *writing, int32_t y, int32_t line)
{
    const struct carom_picture *picture = writing->picture;
    int64_t x = writing->x;
    uint8_t *row = (uint8_t *)picture->pixels;

    if (picture->row) {
        row = (uint8_t *)picture->row(picture->context, writing->rect.x0, writing->rect.x1, y);
    } else {
        row += (size_t)y * (size_t)picture->stride;
    }
    if (writing->opaque) {
        run(writing, row, writing->rect.x0, writing->rect.x1, writing->paper);
    }
    for (const char *c = writing->text; c < writing->end && x < writing->rect.x1 && line < 8; c++) {
        const uint8_t *glyph = glyph_of(*c);

        for (int column = 0; column < DRAW_GLYPH_WIDTH; column++) {
            if (glyph[column] >> line & 1) {
                int64_t from = x + column * writing->scale;

                run(writing, row, from, from + writing->scale, writing->colour);
            }
        }
        x += CAROM_TEXT_WIDTH * writing->scale;
    }
}

/* Draw a line of text whose top is at y. */
static void write_line(struct writing *writing, int64_t y, struct carom_rect *touched)
{
    const struct carom_picture *picture = writing->picture;
    int64_t cells = writing->end - writing->text;
    struct draw_rect *r = &writing->rect;

    r->x0 = clamp(writing->x, 0, picture->width);
    r->x1 = clamp(writing->x + cells * CAROM_TEXT_WIDTH * writing->scale, 0, picture->width);
    r->y0 = clamp(y, 0, picture->height);
    r->y1 = clamp(y + CAROM_TEXT_HEIGHT * writing->scale, 0, picture->height);
    if (r->x0 >= r->x1) {
        return;
    }
    for (int32_t at = r->y0; at < r->y1; at++) {
        write_row(writing, at, (int32_t)((at - y) / writing->scale));
    }
    draw_touch(touched,
               (struct carom_rect){(int16_t)r->x0, (int16_t)r->y0, (int16_t)r->x1, (int16_t)r->y1});
}

static int check_text(const struct carom_picture *picture, const struct carom_text *where,
                      const char *text)
{
    uint32_t colours;
    int result;

    if (where == NULL || text == NULL) {
        return CAROM_ERR_NULL;
    }
    /* rows as for FLAT, pixels of either style */
    result = draw_check_picture(picture, CAROM_DRAW_FLAT);
    if (result != CAROM_OK) {
        return result;
    }
    colours = draw_ramps(picture->paint) * DRAW_SHADES;
    if (where->x < -PLACE_MAX || where->x > PLACE_MAX || where->y < -PLACE_MAX ||
        where->y > PLACE_MAX || where->scale > SCALE_MAX || where->colour >= colours ||
        (where->opaque ? where->paper >= colours : picture->row != NULL)) {
        return CAROM_ERR_ARGUMENT;
    }
    return CAROM_OK;
}

int carom_draw_text(const struct carom_picture *picture, const struct carom_text *where,
                    const char *text, struct carom_rect *touched)
{
    int result = check_text(picture, where, text);
    struct writing writing;
    ptrdiff_t longest = 0;
    int64_t y;

    if (result != CAROM_OK) {
        return result;
    }
    writing = (struct writing){.picture = picture,
                               .x = where->x,
                               .scale = where->scale ? where->scale : 1,
                               .pixel_shift = draw_pixel_shift(picture->format),
                               .opaque = where->opaque,
                               .colour = draw_colour(picture, where->colour),
                               .paper = where->opaque ? draw_colour(picture, where->paper) : 0};
    y = where->y;
    for (;;) {
        writing.text = writing.end = text;
        while (*writing.end != '\0' && *writing.end != '\n') {
            writing.end++;
        }
        longest = writing.end - text > longest ? writing.end - text : longest;
        write_line(&writing, y, touched);
        if (*writing.end == '\0') {
            return longest < INT_MAX ? (int)longest : INT_MAX;
        }
        text = writing.end + 1;
        y += CAROM_TEXT_HEIGHT * writing.scale;
    }
}
