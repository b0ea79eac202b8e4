/* SPDX-License-Identifier: MIT */
/* Text over the picture, and bars: the part of a frame's time that each stage takes. */
#include <string.h>

#include "scene_games.h"
#include "view_parts.h"

#define ROWS      (CAROM_STAGE_COUNT + 2) /* the stages, their sum, the picture */
#define MEAN_BITS 4                       /* mean over about 16 steps */
#define TICK_BITS 8
#define MARGIN    4
#define NAME_LINE 12 /* characters before a bar */
#define BAR_CELLS 22
#define LINE_TEXT 64

static uint64_t took[ROWS]; /* ticks, with TICK_BITS more bits */
static bool stepped, drew;
static const char *note;

/* Stages in the order of a step. */
static const uint32_t bar_rgb[CAROM_STAGE_COUNT + 1] = {0x6fa8dc, 0x76c7c0, 0xf06ea9, 0xf6b26b,
                                                        0xffd966, 0xe06666, 0x93c47d, 0xb4a7d6,
                                                        0xa2a9b4, 0xffffff};

void view_panel_reset(void)
{
    memset(took, 0, sizeof took);
    stepped = drew = false;
}

static void mean(uint64_t *of, uint32_t ticks, bool first)
{
    const int64_t now = (int64_t)ticks << TICK_BITS;

    *of = first ? (uint64_t)now : (uint64_t)((int64_t)*of + ((now - (int64_t)*of) >> MEAN_BITS));
}

void view_panel_step(const struct carom_stats *stats)
{
    for (int i = 0; i < CAROM_STAGE_COUNT; i++) {
        mean(&took[i], stats->ticks[i], !stepped);
    }
    mean(&took[CAROM_STAGE_COUNT], stats->total_ticks, !stepped);
    stepped = true;
}

void view_panel_drew(uint32_t ticks)
{
    mean(&took[CAROM_STAGE_COUNT + 1], ticks, !drew);
    drew = true;
}

/* -------------------------------------------------------------------- pixels */

struct pen {
    const struct carom_picture *picture;
    struct carom_rect *touched;
    int32_t scale;
};

static void touch(struct carom_rect *all, int32_t x0, int32_t y0, int32_t x1, int32_t y1)
{
    if (all->x0 >= all->x1 || all->y0 >= all->y1) {
        *all = (struct carom_rect){(int16_t)x0, (int16_t)y0, (int16_t)x1, (int16_t)y1};
        return;
    }
    all->x0 = (int16_t)(x0 < all->x0 ? x0 : all->x0);
    all->y0 = (int16_t)(y0 < all->y0 ? y0 : all->y0);
    all->x1 = (int16_t)(x1 > all->x1 ? x1 : all->x1);
    all->y1 = (int16_t)(y1 > all->y1 ? y1 : all->y1);
}

/* Fill a rectangle; colour 0 darkens it to a third. */
static void fill(const struct pen *pen, int32_t x, int32_t y, int32_t width, int32_t height,
                 uint32_t rgb)
{
    const struct carom_picture *p = pen->picture;
    const int32_t x1 = x + width < p->width ? x + width : p->width;
    const int32_t y1 = y + height < p->height ? y + height : p->height;

    if (x >= x1 || y >= y1) {
        return;
    }
    for (int32_t row = y; row < y1; row++) {
        uint32_t *pixels = (uint32_t *)(void *)((char *)p->pixels + (ptrdiff_t)row * p->stride);

        for (int32_t i = x; i < x1; i++) {
            pixels[i] = rgb ? rgb : (pixels[i] >> 2 & 0x3f3f3f) + (pixels[i] >> 4 & 0x0f0f0f);
        }
    }
    touch(pen->touched, x, y, x1, y1);
}

static void write(const struct pen *pen, int32_t x, int32_t y, const char *text)
{
    const struct carom_text where = {
        .x = x, .y = y, .scale = (uint8_t)pen->scale, .colour = CAROM_COLOUR_WHITE};

    carom_draw_text(pen->picture, &where, text, pen->touched);
}

static int32_t lines(const struct pen *pen, int32_t count)
{
    return count * CAROM_TEXT_HEIGHT * pen->scale;
}

static int32_t cells(const struct pen *pen, int32_t count)
{
    return count * CAROM_TEXT_WIDTH * pen->scale;
}

/* ---------------------------------------------------------------------- bars */

/* A frame's time, or the smallest part of it that holds the longest bar. */
static uint64_t scale_of(uint64_t most, int *part_bits)
{
    uint64_t full = ((uint64_t)port_ticks_hz << TICK_BITS) / FPS;

    for (*part_bits = 0; full / 2 > most && *part_bits < 8; full /= 2) {
        ++*part_bits;
    }
    return full;
}

/* Hundredths of a millisecond: "1.23 ms". */
static char *say_ms(char *text, uint64_t ticks)
{
    const int hundredths = (int)((ticks * 1000 / (port_ticks_hz / 100)) >> TICK_BITS);

    text = scene_say_number(text, hundredths / 100, hundredths % 100 < 10 ? ".0" : ".");
    return scene_say_number(text, hundredths % 100, " ms");
}

static void say_head(char text[LINE_TEXT], uint64_t full, int part_bits)
{
    text = say_ms(text, full);
    memcpy(text, " = 1/", 6);
    text = scene_say_number(text + 5, 1 << part_bits, " of a frame");
}

/* The picture has no bar, because it is no part of a step. */
static void draw_bar(const struct pen *pen, int row, int32_t y, uint64_t full)
{
    const int32_t width = cells(pen, BAR_CELLS), x = MARGIN * 2 + cells(pen, NAME_LINE);
    const uint64_t part = took[row] * (uint64_t)width / full;
    const char *name = row < CAROM_STAGE_COUNT    ? carom_stage_name(row)
                       : row == CAROM_STAGE_COUNT ? "step"
                                                  : "picture";
    char text[LINE_TEXT];

    write(pen, MARGIN * 2, y, name);
    if (row <= CAROM_STAGE_COUNT) {
        fill(pen, x, y + pen->scale, part > (uint64_t)width ? width : (int32_t)part + 1,
             5 * pen->scale, bar_rgb[row]);
    }
    say_ms(text, took[row]);
    write(pen, x + width + MARGIN, y, text);
}

/* Draw at the bottom left. */
static void draw_bars(const struct pen *pen)
{
    const int32_t top = pen->picture->height - lines(pen, ROWS + 1) - 3 * MARGIN;
    const int32_t width = cells(pen, NAME_LINE + BAR_CELLS + 10) + 2 * MARGIN;
    char text[LINE_TEXT];
    int part_bits;
    const uint64_t full = scale_of(took[CAROM_STAGE_COUNT], &part_bits);

    if (top < 0) {
        return;
    }
    fill(pen, MARGIN, top, width, lines(pen, ROWS + 1) + 2 * MARGIN, 0);
    say_head(text, full, part_bits);
    write(pen, MARGIN * 2 + cells(pen, NAME_LINE), top + MARGIN, text);
    for (int row = 0; row < ROWS; row++) {
        draw_bar(pen, row, top + MARGIN + lines(pen, row + 1), full);
    }
}

/* ---------------------------------------------------------------------- text */

static char *say_hash(char *text, uint64_t hash)
{
    for (int digit = 15; digit >= 0; digit--) {
        *text++ = "0123456789abcdef"[hash >> 4 * digit & 15];
    }
    *text = 0;
    return text;
}

static void draw_text(const struct pen *pen)
{
    char text[3 * LINE_TEXT], *end;
    int32_t longest = 22, rows = 2;

    end = text;
    for (const char *name = view_scene(); *name; name++) {
        *end++ = *name;
    }
    memcpy(end, "  frame ", 9);
    end = scene_say_number(end + 8, view_step_count(), "\nhash ");
    end = say_hash(end, view_hash());
    if (view_says()[0]) {
        const int32_t length = (int32_t)strlen(view_says());

        *end++ = '\n';
        memcpy(end, view_says(), (size_t)length + 1);
        longest = length > longest ? length : longest;
        rows++;
    }
    longest =
        (int32_t)strlen(view_scene()) + 16 > longest ? (int32_t)strlen(view_scene()) + 16 : longest;
    fill(pen, MARGIN, MARGIN, cells(pen, longest) + 2 * MARGIN, lines(pen, rows) + 2 * MARGIN, 0);
    write(pen, 2 * MARGIN, 2 * MARGIN, text);
}

/* Draw a game's line alone. */
static void draw_says(const struct pen *pen)
{
    if (view_says()[0]) {
        fill(pen, MARGIN, MARGIN, cells(pen, (int32_t)strlen(view_says())) + 2 * MARGIN,
             lines(pen, 1) + 2 * MARGIN, 0);
        write(pen, 2 * MARGIN, 2 * MARGIN, view_says());
    }
}

void view_note(const char *text)
{
    note = text;
}

static void draw_note(const struct pen *pen)
{
    int32_t longest = 0, length = 0, rows = 1, x, y;

    for (const char *c = note; *c; c++) {
        rows += *c == '\n';
        length = *c == '\n' ? 0 : length + 1;
        longest = length > longest ? length : longest;
    }
    x = (pen->picture->width - cells(pen, longest)) / 2;
    y = (pen->picture->height - lines(pen, rows)) / 2;
    x = x < MARGIN * 2 ? MARGIN * 2 : x;
    y = y < MARGIN * 2 ? MARGIN * 2 : y;
    fill(pen, x - 2 * MARGIN, y - 2 * MARGIN, cells(pen, longest) + 4 * MARGIN,
         lines(pen, rows) + 4 * MARGIN, 0);
    write(pen, x, y, note);
}

void view_panel(const struct carom_picture *picture, uint32_t toggles, struct carom_rect *touched)
{
    const struct pen pen = {picture, touched, 1 + picture->width / 700};

    if (toggles & VIEW_TEXT) {
        draw_text(&pen);
    } else {
        draw_says(&pen);
    }
    if (toggles & VIEW_BARS) {
        const struct pen small = {picture, touched, 1 + picture->width / 1400};

        draw_bars(&small);
    }
    if (note) {
        draw_note(&pen);
    }
}
