/* SPDX-License-Identifier: MIT */
/* carom_paint: the pixels of a picture that it changes, and those that stay. */
#include "lib/draw_scene.h"

enum { RAMPS = 12, ENTRIES = RAMPS * DRAW_SHADES };

static uint8_t reference[SIZE][SIZE];
static uint32_t deep[SIZE][SIZE], palette[ENTRIES];

static void draw_painted(const struct carom_world *world, const struct carom_paint *paint,
                         enum carom_draw_style style)
{
    struct carom_picture picture = picture_8();

    picture.paint = paint;
    memset(pixels, 0xee, sizeof pixels);
    CHECK_EQ(carom_draw(world, &above, &picture, style), CAROM_OK);
}

static void keep_usual(const struct carom_world *world, enum carom_draw_style style)
{
    draw_8(world, &above, style);
    memcpy(reference, pixels, sizeof pixels);
}

/* A cube that lies on a square, with interfering faces of both. */
static struct carom_world *touching(void)
{
    struct carom_world *world = new_world();

    add(world, &square, at(0, 0, 0), upright, false);
    add(world, &cube, at(Q32(1, 2), Q32(-1, 4), Q32(502, 1000)), upright, true);
    CHECK_AT_LEAST(carom_world_step(world), 0);
    return world;
}

static void nothing_is_usual(void)
{
    static const struct carom_paint paint;
    struct carom_world *world = touching();

    for (int k = 0; k < 2; k++) {
        keep_usual(world, styles[k]);
        CHECK_MORE(count_ramp(DRAW_STATIONARY_HOT), 0);
        draw_painted(world, &paint, styles[k]);
        CHECK_EQ(memcmp(reference, pixels, sizeof pixels), 0);
    }
}

/* Each pixel keeps its shade; pixels of ramp `from` get ramp `to`. */
static void expect_ramps(const uint8_t to[DRAW_RAMPS])
{
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            int usual = reference[y][x];

            CHECK_EQ(pixels[y][x], to[usual / DRAW_SHADES] * DRAW_SHADES + usual % DRAW_SHADES);
        }
    }
}

static void bodies(void)
{
    static const uint8_t none[12];
    static const struct carom_body_paint body_paints[] = {{NULL, 0}, {none, 6}};
    static const uint8_t only_second[DRAW_RAMPS] = {0, 1, 6, 3, 4},
                         beyond[DRAW_RAMPS] = {0, 1, 2, 3, 4};
    struct carom_paint paint = {.bodies = body_paints, .body_count = 2};
    struct carom_world *world = new_world();

    add_scene(world);
    for (int k = 0; k < 2; k++) {
        keep_usual(world, styles[k]);
        CHECK_MORE(count_ramp(DRAW_MOVING), 50);
        paint.body_count = 2;
        draw_painted(world, &paint, styles[k]);
        expect_ramps(only_second);
        paint.body_count = 1; /* the other bodies look as usual */
        draw_painted(world, &paint, styles[k]);
        expect_ramps(beyond);
    }
}

/* Seen from 3.5 units above, a cube shows the two triangles of its top: 18 x 18 pixels. */
static void faces(void)
{
    static const uint8_t ramps[12] = {5, 5, 6, 0, 5, 5, 5, 5, 5, 5, 5, 200};
    static const struct carom_body_paint body_paints[] = {{ramps, 5}};
    struct carom_paint paint = {.bodies = body_paints, .body_count = 1};
    struct carom_world *world = new_world();
    int six = 0, five = 0;

    add(world, &cube, at(0, 0, 0), upright, true);
    draw_painted(world, &paint, CAROM_DRAW_FLAT);
    six = count_ramp(6);
    five = count_ramp(5);
    CHECK_EQ(six + five, 18 * 18);
    CHECK_AT_LEAST(six, 9 * 17);
    CHECK_AT_MOST(six, 9 * 19); /* the diagonal's pixels belong to one of them */
    /* face 2 is 4, 5, 7: the lower right half, and face 3 the upper left one */
    CHECK_EQ(ramp_at(38, 39), 6);
    CHECK_EQ(ramp_at(25, 24), 5);
}

static void interfering(void)
{
    static const uint8_t hidden[DRAW_RAMPS] = {0, 1, 2, 1, 2}, violet[DRAW_RAMPS] = {0, 1, 2, 6, 6};
    struct carom_paint paint = {.hide_interfering = true};
    struct carom_world *world = touching();

    for (int k = 0; k < 2; k++) {
        keep_usual(world, styles[k]);
        CHECK_MORE(count_ramp(DRAW_MOVING_HOT) + count_ramp(DRAW_STATIONARY_HOT), 100);
        paint.hide_interfering = true;
        draw_painted(world, &paint, styles[k]);
        if (styles[k] == CAROM_DRAW_FLAT) {
            expect_ramps(hidden);
        } else { /* hot edges are drawn over those of other bodies */
            CHECK_EQ(count_ramp(DRAW_MOVING_HOT) + count_ramp(DRAW_STATIONARY_HOT), 0);
        }
        paint.hide_interfering = false;
        paint.interfering_ramp = 6;
        draw_painted(world, &paint, styles[k]);
        expect_ramps(violet);
    }
}

/* -------------------------------------------------------------------- light */

/*
 * A square that looks up, in the light from (x, y, z) of length n. The shade is 32 (a + (1 - a) (1
 * + z / n) / 2).
 */
static void light(void)
{
    static const int16_t from[][4] = {
        {0, 0, 1, 1},  {0, 0, -1, 1}, {1, 0, 0, 1},   {1, 2, 2, 3},    {-6, -2, 3, 7},
        {4, -4, 7, 9}, {2, 3, -6, 7}, {-1, 2, -2, 3}, {9, 12, 20, 25}, {12, 15, -16, 25}};
    struct carom_world *world = new_world();

    add(world, &square, at(0, 0, 0), upright, false);
    for (size_t i = 0; i < sizeof from / sizeof from[0]; i++) {
        for (int quarter = 0; quarter <= 4; quarter++) {
            for (int shift = 0; shift < 26; shift += 5) {
                int32_t one = (int32_t)1 << shift, n = from[i][3];
                /* times 8 n: 32 (q / 4 + (4 - q) / 4 (n + z) / 2 n) = (8 q n + 4 (4 - q) (n + z)) / n */
                int32_t times_n = 8 * quarter * n + 4 * (4 - quarter) * (n + from[i][2]);
                struct carom_paint paint = {
                    .light = {{from[i][0] * one, from[i][1] * one, from[i][2] * one}},
                    .ambient_q30 = quarter * (CAROM_ONE_Q30 / 4)};
                int shade;

                draw_painted(world, &paint, CAROM_DRAW_FLAT);
                CHECK_EQ(ramp_at(40, 40), DRAW_STATIONARY);
                shade = pixels[40][40] % DRAW_SHADES;
                /* rounded down, and always below 32 */
                CHECK_AT_MOST(shade * n, times_n);
                CHECK_AT_LEAST((shade + 1) * n, times_n);
            }
        }
    }
}

/* The usual light, given by its direction: no shade differs by more than rounding. */
static void usual_light(void)
{
    struct carom_paint paint = {.light = {{-6, -2, 3}}};
    struct carom_world *world = new_world();

    add_scene(world);
    keep_usual(world, CAROM_DRAW_FLAT);
    draw_painted(world, &paint, CAROM_DRAW_FLAT);
    for (int i = 0; i < SIZE * SIZE; i++) {
        CHECK_NEAR(pixels[i / SIZE][i % SIZE], reference[i / SIZE][i % SIZE], 1);
    }
    /* ambient light alone replaces the direction and makes everything lighter, except the
     * background */
    paint = (struct carom_paint){.ambient_q30 = CAROM_ONE_Q30 / 2};
    draw_painted(world, &paint, CAROM_DRAW_FLAT);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            int usual = reference[y][x] % DRAW_SHADES, now = pixels[y][x] % DRAW_SHADES;

            CHECK_EQ(ramp_at(x, y), reference[y][x] / DRAW_SHADES);
            CHECK(ramp_at(x, y) == 0 ? now == usual
                                     : now >= 16 + usual / 2 && now <= 17 + usual / 2);
        }
    }
}

/* ------------------------------------------------------------------ palettes */

/*
 * A palette in which each entry is its own number. A picture of 4 bytes a pixel then holds the
 * entries.
 */
static void number_palette(void)
{
    for (uint32_t i = 0; i < ENTRIES; i++) {
        palette[i] = i;
    }
}

static uint32_t grey_of(uint32_t rgb)
{
    uint32_t light = (rgb >> 16) * 77 + (rgb >> 8 & 255) * 150 + (rgb & 255) * 29;

    return (2 * light * 15 + 255 * 256) / (2 * 255 * 256);
}

/* Every format, compared with the entries of a picture of numbers. */
static void formats(void)
{
    static const struct carom_body_paint body_paints[] = {{NULL, 9}, {NULL, 11}};
    static uint32_t numbers[SIZE][SIZE];
    struct carom_paint paint = {
        .palette = palette, .ramps = RAMPS, .bodies = body_paints, .body_count = 2};
    struct carom_picture picture = picture_8();
    struct carom_world *world = new_world();
    struct test_random random = {3};
    int high = 0;

    add_scene(world);
    picture.paint = &paint;
    for (int k = 0; k < 2; k++) {
        number_palette();
        picture.pixels = numbers;
        picture.stride = sizeof numbers[0];
        picture.format = CAROM_XRGB8888;
        CHECK_EQ(carom_draw(world, &above, &picture, styles[k]), CAROM_OK);
        for (int i = 0; i < ENTRIES; i++) {
            palette[i] = (uint32_t)test_random_range(&random, 0, 0xffffff);
        }
        picture.pixels = deep;
        for (uint8_t format = CAROM_RGB565; format <= CAROM_BGR555; format++) {
            picture.format = format;
            CHECK_EQ(carom_draw(world, &above, &picture, styles[k]), CAROM_OK);
            for (int y = 0; y < SIZE; y++) {
                const uint8_t *row = (const uint8_t *)deep[y];

                for (int x = 0; x < SIZE; x++) {
                    uint32_t rgb = palette[numbers[y][x]];
                    uint32_t r = rgb >> 16, g = rgb >> 8 & 255, b = rgb & 255;
                    uint16_t half;

                    high += numbers[y][x] >= 256;
                    memcpy(&half, row + 2 * x, sizeof half);
                    switch (format) {
                    case CAROM_RGB565:
                        CHECK_EQ(half, r / 8 * 2048 + g / 4 * 32 + b / 8);
                        break;
                    case CAROM_BGR555:
                        CHECK_EQ(half, b / 8 * 1024 + g / 8 * 32 + r / 8);
                        break;
                    case CAROM_GREY4:
                        CHECK_EQ(x & 1 ? row[x / 2] & 15 : row[x / 2] >> 4, grey_of(rgb));
                        break;
                    default:
                        CHECK_EQ(deep[y][x], rgb);
                    }
                }
            }
        }
    }
    CHECK_MORE(high, 1000);
}

static void ramps(void)
{
    uint32_t ramp[DRAW_SHADES];

    CHECK_EQ(carom_draw_ramp(NULL, 0), CAROM_ERR_NULL);
    CHECK_EQ(carom_draw_ramp(ramp, 0x4080ff), CAROM_OK);
    CHECK_EQ(ramp[0], 0x10203f);  /* a quarter of each component */
    CHECK_EQ(ramp[16], 0x4080ff); /* the colour itself */
    CHECK_EQ(ramp[31], 0x9fbfff); /* 0x40 + (255 - 0x40) / 2 = 0x9f */
    for (int i = 1; i < DRAW_SHADES; i++) {
        for (int shift = 0; shift < 24; shift += 8) {
            CHECK_AT_LEAST((ramp[i] >> shift & 255), (ramp[i - 1] >> shift & 255));
        }
    }
    CHECK_EQ(carom_draw_palette[CAROM_COLOUR_WHITE], 0xffffff);
    CHECK_EQ(carom_draw_palette[CAROM_COLOUR_BLACK], 0);
}

/* ------------------------------------------------------------------ changes */

/* Other paint is a change: of one body alone, if the paint changes that body's ramp. */
static void changes(void)
{
    static struct carom_drawn_body drawn_bodies[6];
    struct carom_drawn drawn = {.bodies = drawn_bodies, .room = 6};
    struct carom_body_paint body_paints[2] = {{NULL, 0}, {NULL, 0}};
    struct carom_paint paint = {.bodies = body_paints, .body_count = 2};
    struct carom_picture picture = picture_8();
    struct carom_world *world = new_world();

    add_scene(world);
    for (int step = 0; step < 12; step++) {
        int32_t area = 0;

        picture.pixels = reference;
        picture.paint = step < 1 ? NULL : &paint;
        body_paints[1].ramp = step < 2 ? 0 : step < 6 ? 6 : 5;
        paint.light.c[0] = step < 4 ? 0 : CAROM_ONE_Q30;
        paint.ambient_q30 = step < 8 ? 0 : CAROM_ONE_Q30 / 3;
        paint.interfering_ramp = step < 10 ? 0 : 6;
        CHECK_EQ(carom_draw_changes(world, &above, &picture, CAROM_DRAW_FLAT, &drawn), CAROM_OK);
        for (int i = 0; i < drawn.changed_count; i++) {
            area += (drawn.changed[i].x1 - drawn.changed[i].x0) *
                    (drawn.changed[i].y1 - drawn.changed[i].y0);
        }
        /* everything changes in steps 0, 4, 8 and 10; the cube in 2 and 6: less than 40 x 40;
         * nothing in others */
        CHECK(step == 2 || step == 6                              ? area > 200 && area < 1600
              : step == 0 || step == 4 || step == 8 || step == 10 ? area == SIZE * SIZE
                                                                  : area == 0);
        draw_painted(world, picture.paint, CAROM_DRAW_FLAT);
        CHECK_EQ(memcmp(reference, pixels, sizeof pixels), 0);
    }
}

/* -------------------------------------------------------------------- errors */

static void errors(void)
{
    static const struct carom_paint_line line = {{{0, 0, 0}}, {{0, 0, Q32(16384, 1)}}, 255};
    struct carom_paint_line bad = line;
    struct carom_world *world = new_world();
    struct carom_picture picture = picture_8();
    struct carom_paint paint;

    number_palette();
    picture.paint = &paint;
#define EXPECT(error, ...)                                                                         \
    paint = (struct carom_paint){__VA_ARGS__};                                                     \
    pixels[0][0] = 0xee;                                                                           \
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), error);                         \
    CHECK_EQ(pixels[0][0], (int)(error) == 0 ? 0 : 0xee)
    EXPECT(CAROM_OK, .lines = &line, .line_count = 1);
    EXPECT(CAROM_ERR_NULL, .body_count = 1);
    EXPECT(CAROM_ERR_NULL, .line_count = 1);
    EXPECT(CAROM_ERR_ARGUMENT, .lines = &line, .line_count = 4097);
    EXPECT(CAROM_ERR_ARGUMENT, .ambient_q30 = -1);
    EXPECT(CAROM_ERR_ARGUMENT, .ambient_q30 = CAROM_ONE_Q30 + 1);
    EXPECT(CAROM_ERR_ARGUMENT, .palette = palette, .ramps = 7);
    EXPECT(CAROM_ERR_ARGUMENT, .palette = palette, .ramps = 9); /* more than PALETTE8 has */
    EXPECT(CAROM_OK, .palette = palette, .ramps = 8);
    EXPECT(CAROM_OK, .ramps = 7);
    bad.colour = 256;
    EXPECT(CAROM_ERR_ARGUMENT, .lines = &bad, .line_count = 1);
    bad = line;
    bad.to.c[2]++;
    EXPECT(CAROM_ERR_RANGE, .lines = &bad, .line_count = 1);
    bad = line;
    bad.from.c[1] = INT64_MIN;
    EXPECT(CAROM_ERR_RANGE, .lines = &bad, .line_count = 1);
    picture.format = CAROM_GREY4;
    EXPECT(CAROM_ERR_ARGUMENT, .palette = palette, .ramps = 257);
#undef EXPECT
}

/*
 * Sky above the horizon and ground below it, for any camera; the ray through the middle of each row
 * decides.
 */
static void horizon(void)
{
    const struct carom_paint paint = {.horizon = true};
    struct test_random random = {31};
    struct carom_world *world = new_world();
    int seen = 0;

    for (int i = 0; i < 200; i++) {
        struct carom_picture picture = picture_8();
        struct carom_camera camera = {.focal_q16 =
                                          (int32_t)test_random_range(&random, 1 << 14, 1 << 17)};

        picture.paint = &paint;
        picture.height = (int32_t)test_random_range(&random, 1, SIZE);
        for (int k = 0; k < 3; k++) {
            camera.target.c[k] =
                i < 3 && k < 2 ? 0 : test_random_range(&random, -Q32(3, 1), Q32(3, 1));
        }
        CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        for (int y = 0; y < picture.height; y++) {
            struct carom_ray ray;
            int before = y > 0 ? pixels[y - 1][0] : 0;

            CHECK_EQ(carom_view_ray(&camera, SIZE, picture.height, 128, 256 * y + 128, &ray),
                     CAROM_OK);
            CHECK_EQ(ramp_at(0, y), CAROM_RAMP_BACKGROUND);
            CHECK(pixels[y][0] >= before && pixels[y][SIZE - 1] == pixels[y][0]);
            /* the ray is thousands of units long: if it is nearly level, it may end on either
             * side */
            if (carom_abs(ray.way.c[2]) > (int64_t)1 << 27) {
                CHECK_EQ(pixels[y][0] >= 16, ray.way.c[2] < 0);
            }
            seen += y > 0 && (before < 16) != (pixels[y][0] < 16);
        }
    }
    CHECK_MORE(seen, 20); /* the horizon is in some of the pictures */
}

const struct test tests_draw_paint[] = {
    {"draw_paint/horizon", horizon},
    {"draw_paint/nothing_is_usual", nothing_is_usual},
    {"draw_paint/bodies", bodies},
    {"draw_paint/faces", faces},
    {"draw_paint/interfering", interfering},
    {"draw_paint/light", light},
    {"draw_paint/usual_light", usual_light},
    {"draw_paint/formats", formats},
    {"draw_paint/ramps", ramps},
    {"draw_paint/changes", changes},
    {"draw_paint/errors", errors},
    {0},
};
