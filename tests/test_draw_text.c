/* SPDX-License-Identifier: MIT */
/* Text over pictures: pixel by pixel from the font, and letters that are known by hand. */
#include <string.h>

#include "lib/draw_scene.h"

#ifdef TEST_LONG
enum { TEXTS = 3000 };
#else
enum { TEXTS = 120 };
#endif
enum { WHITE = CAROM_COLOUR_WHITE, BLUE = CAROM_COLOUR_BLUE, ROOM = SIZE + 4 };

static uint32_t deep[SIZE][ROOM];
static uint8_t sent[SIZE][SIZE], reference[SIZE][SIZE];

static const struct carom_text at_top = {.x = 1, .y = 0, .colour = WHITE};

static void expect_letters(const char *text, const char *const rows[9], int width)
{
    struct carom_picture picture = picture_8();

    memset(pixels, 0, sizeof pixels);
    CHECK_EQ(carom_draw_text(&picture, &at_top, text, NULL), (int)strlen(text));
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            bool ink = y < 9 && x >= 1 && x - 1 < width && rows[y][x - 1] == '#';

            CHECK_EQ(pixels[y][x], ink ? WHITE : 0);
        }
    }
}

static void by_hand(void)
{
    /* clang-format off */
    static const char *const letters[9] = {
        "#   # #####  ###         ##  ",
        "#   #   #   #   #         #  ",
        "#   #   #   #     ####    #  ",
        "#####   #   #     #   #   #  ",
        "#   #   #   #     #   #   #  ",
        "#   #   #   #   # ####    #  ",
        "#   #   #    ###  #       ## ",
        "                  #          ",
        "                             "};
    static const char *const signs[9] = {
        "  #    ### ",
        "  #    #   ",
        "  #    #   ",
        "  #    #   ",
        "  #    #   ",
        "       #   ",
        "  #    ### ",
        "           ",
        "           "};
    /* clang-format on */

    /* H, T, C, p, l: 5 cells minus the gap after the last */
    expect_letters("HTCpl", letters, 29);
    expect_letters("![", signs, 11);
}

/* Each character has a form of its own; unknown ones are a box; a space is empty. */
static void font(void)
{
    for (int i = 0; i < 96; i++) {
        int ink = 0;

        for (int k = 0; k < DRAW_GLYPH_WIDTH; k++) {
            ink += draw_font[i][k];
        }
        CHECK_EQ(ink == 0, i == 0);
        for (int j = 0; j < i; j++) {
            CHECK_DIFFER(memcmp(draw_font[i], draw_font[j], DRAW_GLYPH_WIDTH), 0);
        }
    }
}

/* -------------------------------------------------------- against the font */

/* The layer of a text at pixel (x, y): 2 ink, 1 paper, 0 none. */
static int expect_at(const struct carom_text *where, const char *text, int x, int y)
{
    int scale = where->scale ? where->scale : 1;
    int column = x - where->x, line = y - where->y, row, cell = 0;
    const char *c = text;
    unsigned code;

    if (column < 0 || line < 0) {
        return 0;
    }
    row = line / scale % CAROM_TEXT_HEIGHT;
    column /= scale;
    for (int skip = line / scale / CAROM_TEXT_HEIGHT; skip > 0; c++) {
        if (*c == '\0') {
            return 0;
        }
        skip -= *c == '\n';
    }
    for (; cell < column / CAROM_TEXT_WIDTH && *c && *c != '\n'; cell++) {
        c++;
    }
    if (*c == '\0' || *c == '\n') {
        return 0;
    }
    code = (unsigned char)*c;
    column %= CAROM_TEXT_WIDTH;
    code = code < 32 || code > 126 ? 127 : code;
    return column < 5 && row < 8 && draw_font[code - 32][column] >> row & 1 ? 2 : where->opaque;
}

/* The bits of pixel x of a row of pixels, in any format. */
static uint32_t pixel_at(uint8_t format, const uint8_t *row, int x)
{
    uint16_t half;
    uint32_t word;

    switch (format) {
    case CAROM_PALETTE8:
        return row[x];
    case CAROM_GREY4:
        return x & 1 ? row[x / 2] & 15 : row[x / 2] >> 4;
    case CAROM_XRGB8888:
        memcpy(&word, row + 4 * x, 4);
        return word;
    default:
        memcpy(&half, row + 2 * x, 2);
        return half;
    }
}

static struct carom_text any_place(struct test_random *random, char text[24])
{
    struct carom_text where = {.scale = (uint8_t)test_random_range(random, 0, 4),
                               .opaque = test_random_range(random, 0, 1),
                               .colour = WHITE,
                               .paper = BLUE};
    int n = (int)test_random_range(random, 0, 23);

    for (int i = 0; i < n; i++) {
        text[i] = (char)test_random_range(random, 0, 5) == 0
                      ? '\n'
                      : (char)test_random_range(random, 1, 127);
        text[i] = i == 20 ? (char)0xe4 : text[i];
    }
    text[n] = '\0';
    where.x = (int32_t)test_random_range(random, -90, SIZE + 20);
    where.y = (int32_t)test_random_range(random, -90, SIZE + 20);
    return where;
}

/* Texts at any place, over all borders, in all formats; nothing else is written. */
static void at_random(void)
{
    static const uint32_t ink[] = {WHITE, 0xffff, 0xffffff, 15, 0x7fff};
    static const uint32_t paper[] = {BLUE, 0x441f, 0x4080ff, 7, 0x7e08}; /* 4080ff in each format */
    static const uint32_t was[] = {0x99, 0x9999, 0x99999999, 9, 0x9999};
    struct test_random random = {41};

    for (int i = 0; i < TEXTS; i++) {
        uint8_t format = (uint8_t)(i % 5);
        struct carom_picture picture = picture_8();
        struct carom_rect touched = {0, 0, 0, 0};
        char text[24];
        struct carom_text where = any_place(&random, text);
        int low[2] = {SIZE, SIZE}, high[2] = {0, 0};

        picture.format = format;
        picture.pixels = &deep[1][1];
        picture.stride = sizeof deep[0];
        picture.width = SIZE - i % 3;
        picture.height = SIZE - 2;
        memset(deep, 0x99, sizeof deep);
        CHECK_AT_LEAST(carom_draw_text(&picture, &where, text, &touched), 0);
        for (int y = -1; y < SIZE - 1; y++) {
            const uint8_t *row = (const uint8_t *)&deep[y + 1][1];

            for (int x = 0; x < SIZE; x++) {
                bool on = y >= 0 && y < SIZE - 2 && x < picture.width;
                int kind = on ? expect_at(&where, text, x, y) : 0;
                uint32_t is = pixel_at(format, row, x);

                CHECK_EQ(is, kind == 2 ? ink[format] : kind == 1 ? paper[format] : was[format]);
                if (kind) {
                    low[0] = x < low[0] ? x : low[0], low[1] = y < low[1] ? y : low[1];
                    high[0] = x > high[0] ? x : high[0], high[1] = y > high[1] ? y : high[1];
                }
            }
            CHECK_EQ(deep[y + 1][0], was[2]); /* before the picture's rows */
        }
        CHECK(high[0] < low[0] || (touched.x0 <= low[0] && touched.y0 <= low[1] &&
                                   touched.x1 > high[0] && touched.y1 > high[1]));
        CHECK(!where.opaque || high[0] < low[0] ||
              (touched.x0 == low[0] && touched.y1 == high[1] + 1));
    }
}

static int32_t next_row, rows_sent;

static void *row_of(void *context, int32_t x0, int32_t x1, int32_t y)
{
    CHECK_SAME(context, sent);
    CHECK_AT_LEAST(x0, 0);
    CHECK_LESS(x0, x1);
    CHECK_AT_MOST(x1, SIZE);
    CHECK_AT_LEAST(y, next_row);
    CHECK_LESS(y, SIZE);
    next_row = y + 1;
    rows_sent++;
    return sent[y];
}

/* Drawn by rows, from the top down, each row once, a text is the same. */
static void by_rows(void)
{
    struct test_random random = {43};
    int drawn = 0;

    for (int i = 0; i < TEXTS / 4; i++) {
        struct carom_picture picture = picture_8();
        char text[24];
        struct carom_text where = any_place(&random, text);

        where.opaque = true;
        memset(pixels, 0x99, sizeof pixels);
        memset(sent, 0x99, sizeof sent);
        CHECK_AT_LEAST(carom_draw_text(&picture, &where, text, NULL), 0);
        picture.row = row_of;
        picture.context = sent;
        picture.pixels = NULL;
        next_row = 0;
        CHECK_AT_LEAST(carom_draw_text(&picture, &where, text, NULL), 0);
        CHECK_EQ(memcmp(sent, pixels, sizeof pixels), 0);
        drawn += rows_sent > 0;
    }
    CHECK_MORE(drawn, 10);
}

/* A text that was noted is gone from the next picture of changes. */
static void goes_away(void)
{
    static struct carom_drawn_body drawn_bodies[6];
    struct carom_drawn drawn = {.bodies = drawn_bodies, .room = 6};
    struct carom_picture picture = picture_8();
    struct carom_text where = {.x = 40, .y = 50, .scale = 2, .colour = WHITE};
    struct carom_world *world = new_world();
    int32_t area;

    add_scene(world);
    CHECK_EQ(carom_draw_changes(world, &above, &picture, CAROM_DRAW_FLAT, &drawn), CAROM_OK);
    memcpy(reference, pixels, sizeof pixels);
    CHECK_EQ(carom_draw_text(&picture, &where, "A\nlong", &drawn.touched), 4);
    CHECK_DIFFER(memcmp(reference, pixels, sizeof pixels), 0);
    CHECK_EQ(carom_draw_changes(world, &above, &picture, CAROM_DRAW_FLAT, &drawn), CAROM_OK);
    CHECK_EQ(memcmp(reference, pixels, sizeof pixels), 0);
    CHECK_EQ(drawn.changed_count, 1);
    area =
        (drawn.changed[0].x1 - drawn.changed[0].x0) * (drawn.changed[0].y1 - drawn.changed[0].y0);
    CHECK_EQ(area, 12 * 14); /* pixels of a cell of 12 x 18; the line under it is below the
                              * picture */
    CHECK_EQ(carom_draw_changes(world, &above, &picture, CAROM_DRAW_FLAT, &drawn), CAROM_OK);
    CHECK_EQ(drawn.changed_count, 0);
}

static void errors(void)
{
    struct carom_picture picture = picture_8();
    struct carom_text where = at_top;

    memset(pixels, 0x99, sizeof pixels);
    CHECK_EQ(carom_draw_text(NULL, &where, "a", NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_draw_text(&picture, NULL, "a", NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_draw_text(&picture, &where, NULL, NULL), CAROM_ERR_NULL);
#define EXPECT_TEXT(error, change)                                                                 \
    where = at_top;                                                                                \
    change;                                                                                        \
    CHECK_EQ(carom_draw_text(&picture, &where, "III", NULL), error)
    EXPECT_TEXT(CAROM_ERR_ARGUMENT, where.scale = 65);
    EXPECT_TEXT(CAROM_ERR_ARGUMENT, where.x = 16385);
    EXPECT_TEXT(CAROM_ERR_ARGUMENT, where.x = -16385);
    EXPECT_TEXT(CAROM_ERR_ARGUMENT, where.y = -16385);
    EXPECT_TEXT(CAROM_ERR_ARGUMENT, where.y = 16385);
    EXPECT_TEXT(CAROM_ERR_ARGUMENT, where.colour = 256);
    EXPECT_TEXT(CAROM_ERR_ARGUMENT, (where.opaque = true, where.paper = 256));
    picture.row = row_of;
    EXPECT_TEXT(CAROM_ERR_ARGUMENT, where.opaque = false);
    picture.row = NULL;
    picture.width = 2049;
    EXPECT_TEXT(CAROM_ERR_ARGUMENT, where.scale = 1);
    picture = picture_8();
    for (int i = 0; i < SIZE * SIZE; i++) {
        CHECK_EQ(pixels[i / SIZE][i % SIZE], 0x99);
    }
    EXPECT_TEXT(3, where.paper = 256);
    EXPECT_TEXT(3, (where.x = 16384, where.y = -16384, where.scale = 64));
#undef EXPECT_TEXT
}

const struct test tests_draw_text[] = {
    {"draw_text/by_hand", by_hand},
    {"draw_text/font", font},
    {"draw_text/at_random", at_random},
    {"draw_text/by_rows", by_rows},
    {"draw_text/goes_away", goes_away},
    {"draw_text/errors", errors},
    {0},
};
