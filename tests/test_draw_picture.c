/* SPDX-License-Identifier: MIT */
/* The picture that a caller gives to carom_draw: its format, its memory, its errors. */
#include "lib/draw_scene.h"

static uint8_t reference[SIZE][SIZE];

static void formats_agree(void)
{
    static uint16_t pixels_16[SIZE][SIZE];
    static uint16_t pixels_bgr[SIZE][SIZE];
    static uint32_t pixels_32[SIZE][SIZE];
    struct carom_world *world = new_world();

    add_scene(world);
    for (int k = 0; k < 2; k++) {
        enum carom_draw_style style = styles[k];

        struct carom_picture picture = picture_8();

        draw_8(world, &above, style);
        picture.pixels = pixels_16;
        picture.stride = sizeof pixels_16[0];
        picture.format = CAROM_RGB565;
        CHECK_EQ(carom_draw(world, &above, &picture, style), CAROM_OK);
        picture.pixels = pixels_32;
        picture.stride = sizeof pixels_32[0];
        picture.format = CAROM_XRGB8888;
        CHECK_EQ(carom_draw(world, &above, &picture, style), CAROM_OK);
        picture.pixels = pixels_bgr;
        picture.stride = sizeof pixels_bgr[0];
        picture.format = CAROM_BGR555;
        CHECK_EQ(carom_draw(world, &above, &picture, style), CAROM_OK);
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                uint32_t rgb = carom_draw_palette[pixels[y][x]];
                uint32_t r = rgb >> 16, g = rgb >> 8 & 0xff, b = rgb & 0xff;

                CHECK_EQ(pixels_32[y][x], rgb);
                CHECK_EQ(pixels_bgr[y][x], (b / 8) * 1024 + (g / 8) * 32 + r / 8);
                CHECK_EQ(pixels_16[y][x], (r / 8) * 2048 + (g / 4) * 32 + b / 8);
            }
        }
    }
}

/*
 * Half bytes are the greys of the palette's entries at any width; the half after the last pixel
 * stays as it was.
 */
static void greys_agree(void)
{
    static uint8_t half[SIZE][SIZE / 2];
    static const uint8_t low[] = {0, 2, 7, 14, 15}, gain[] = {1, 6, 6, 1, 0};
    struct carom_world *world = new_world();

    add_scene(world);
    for (int32_t width = 1; width <= SIZE; width += width < 9 ? 1 : 11) {
        struct carom_picture picture = picture_8();

        picture.width = width;
        CHECK_EQ(carom_draw(world, &above, &picture, styles[width & 1]), CAROM_OK);
        memset(half, 0xee, sizeof half);
        picture.pixels = half;
        picture.stride = sizeof half[0];
        picture.format = CAROM_GREY4;
        CHECK_EQ(carom_draw(world, &above, &picture, styles[width & 1]), CAROM_OK);
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                int grey = x & 1 ? half[y][x / 2] & 15 : half[y][x / 2] >> 4;
                int shade = pixels[y][x] % DRAW_SHADES, ramp = pixels[y][x] / DRAW_SHADES;

                /* rounded to nearest: twice the difference is at most one grey */
                if (x >= width) {
                    CHECK_EQ(grey, 14);
                } else {
                    int off = (grey - low[ramp]) * 31 - gain[ramp] * shade;

                    CHECK_AT_MOST(2 * off, 31);
                    CHECK_AT_MOST(-2 * off, 31);
                }
            }
        }
    }
}

/* Quotients without division. */
static void quotients(void)
{
    struct test_random random = {7};

    for (uint32_t d = 1; d < 65536; d += d < 300 ? 1 : 97) {
        uint32_t most = 0x7fffffff / d * d;

        for (int shift = 0; shift < 31; shift += 5) {
            uint32_t n = (uint32_t)test_random_range(&random, 0, 0x7fffffff) >> shift;

            CHECK_EQ(draw_quotient(n, d), n / d);
        }
        CHECK_EQ(draw_quotient(0x7fffffff, d), 0x7fffffff / d);
        CHECK_EQ(draw_quotient(most, d), most / d);
        CHECK_EQ(draw_quotient(most - 1, d), (most - 1) / d);
        CHECK_EQ(draw_quotient(0, d), 0);
    }
}

/* The smallest workspace gives the same picture, and nothing beyond a workspace is touched. */
static void workspace_size(void)
{
    static const size_t sizes[] = {CAROM_DRAW_BYTES_LEAST(8, 12), CAROM_DRAW_BYTES(8, 12) + 3};
    struct carom_world *world = new_world();

    add_scene(world);
    draw_8(world, &above, CAROM_DRAW_FLAT);
    memcpy(reference, pixels, sizeof pixels);
    CHECK_MORE(count_ramp(DRAW_MOVING), 200); /* the cube covers about 16 x 16 pixels or more */
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        struct carom_picture picture = picture_8();

        picture.workspace_bytes = sizes[i];
        memset(workspace, 0x5a, sizeof workspace);
        memset(pixels, 0xee, sizeof pixels);
        CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        CHECK_EQ(memcmp(reference, pixels, sizeof pixels), 0);
        CHECK_EQ(workspace[sizes[i]], 0x5a);
    }
}

/* Nothing outside of the rows' pixels is written. */
static void canaries(void)
{
    enum { WIDTH = 37, HEIGHT = 21, STRIDE = 45, BEFORE = 64 };
    static uint8_t memory[BEFORE + STRIDE * HEIGHT + BEFORE];
    struct carom_world *world = new_world();
    struct carom_picture picture = picture_8();

    add_scene(world);
    for (int k = 0; k < 4; k++) { /* across all four sides: 5.25 pixels a unit */
        add(world, &cube, at(Q32(k & 2 ? 7 : -7, 2), Q32(k & 1 ? 2 : -2, 1), 0), oblique, false);
    }
    picture.pixels = &memory[BEFORE];
    picture.width = WIDTH;
    picture.height = HEIGHT;
    picture.stride = STRIDE;
    for (int k = 0; k < 2; k++) {
        enum carom_draw_style style = styles[k];

        memset(memory, 0xa5, sizeof memory); /* the palette entry 0xa5 is never drawn */
        CHECK_EQ(carom_draw(world, &above, &picture, style), CAROM_OK);
        for (size_t i = 0; i < sizeof memory; i++) {
            size_t offset = i - BEFORE;
            bool pixel = i >= BEFORE && offset < STRIDE * HEIGHT && offset % STRIDE < WIDTH;

            CHECK_EQ(memory[i] == 0xa5, !pixel);
        }
    }
}

/* -------------------------------------------------------------------- errors */

static void expect(int error, const struct carom_camera *camera,
                   const struct carom_picture *picture, int style)
{
    struct carom_world *world = new_world();

    memset(pixels, 0xee, sizeof pixels);
    CHECK_EQ(carom_draw(world, camera, picture, (enum carom_draw_style)style), error);
    CHECK_EQ(pixels[0][0], error == CAROM_OK ? 0 : 0xee);
}

static void picture_errors(void)
{
    struct carom_picture p;

#define EXPECT_PICTURE(error, change)                                                              \
    p = picture_8();                                                                               \
    change;                                                                                        \
    expect(error, &above, &p, CAROM_DRAW_FLAT)
    EXPECT_PICTURE(CAROM_OK, p.width = SIZE);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, p.width = 0);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, p.width = 2049);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, p.height = 0);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, p.height = -1);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, p.height = 2049);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, p.format = 5);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, p.stride = SIZE - 1);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, (p.format = CAROM_RGB565, p.width = 8, p.stride = 17));
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, (p.format = CAROM_BGR555, p.width = 8, p.stride = 17));
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, (p.format = CAROM_GREY4, p.width = 9, p.stride = 4));
    EXPECT_PICTURE(CAROM_ERR_NULL, p.pixels = NULL);
    EXPECT_PICTURE(CAROM_ERR_NULL, p.workspace = NULL);
    EXPECT_PICTURE(CAROM_ERR_MEMORY, p.workspace_bytes = CAROM_DRAW_BYTES_LEAST(0, 0) / 2);
    EXPECT_PICTURE(CAROM_ERR_MEMORY, p.workspace = workspace + 4);
    EXPECT_PICTURE(CAROM_ERR_MEMORY,
                   (p.format = CAROM_XRGB8888, p.width = 8, p.pixels = workspace + 2));
#undef EXPECT_PICTURE
    p = picture_8();
    expect(CAROM_ERR_ARGUMENT, &above, &p, 2);
    p.workspace = NULL;
    p.workspace_bytes = 0;
    expect(CAROM_OK, &above, &p, CAROM_DRAW_WIRE);
}

static void camera_errors(void)
{
    struct carom_picture picture = picture_8();
    struct carom_camera c;

#define EXPECT_CAMERA(error, change)                                                               \
    c = above;                                                                                     \
    change;                                                                                        \
    expect(error, &c, &picture, CAROM_DRAW_FLAT)
    EXPECT_CAMERA(CAROM_ERR_ARGUMENT, c.target = c.eye);
    EXPECT_CAMERA(CAROM_ERR_ARGUMENT, c.focal_q16 = (1 << 12) - 1);
    EXPECT_CAMERA(CAROM_ERR_ARGUMENT, c.focal_q16 = (1 << 20) + 1);
    EXPECT_CAMERA(CAROM_ERR_RANGE, c.eye.c[1] = Q32(16384, 1) + 1);
    EXPECT_CAMERA(CAROM_ERR_RANGE, c.target.c[2] = INT64_MIN);
    EXPECT_CAMERA(CAROM_OK, c.eye.c[1] = Q32(-16384, 1));
#undef EXPECT_CAMERA
    CHECK_EQ(carom_draw(NULL, &above, &picture, CAROM_DRAW_FLAT), CAROM_ERR_NULL);
    expect(CAROM_ERR_NULL, NULL, &picture, CAROM_DRAW_FLAT);
    expect(CAROM_ERR_NULL, &above, NULL, CAROM_DRAW_FLAT);
}

const struct test tests_draw_picture[] = {
    {"draw_picture/greys_agree", greys_agree},     {"draw_picture/quotients", quotients},
    {"draw_picture/formats_agree", formats_agree}, {"draw_picture/workspace_size", workspace_size},
    {"draw_picture/canaries", canaries},           {"draw_picture/picture_errors", picture_errors},
    {"draw_picture/camera_errors", camera_errors}, {0},
};
