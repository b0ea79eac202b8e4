/* SPDX-License-Identifier: MIT */
/* Lines of the world: over a picture, and in a picture, where bodies hide them. */
#include "lib/draw_scene.h"

#ifdef TEST_LONG
enum { LINES = 4000 };
#else
enum { LINES = 150 };
#endif
enum { RED = CAROM_COLOUR_RED };

static uint8_t reference[SIZE][SIZE];
static uint32_t deep[SIZE][SIZE + 2];
static struct carom_paint_line lines[8];

static int64_t range(struct test_random *random, int64_t low, int64_t high)
{
    return test_random_range(random, low, high);
}

/* At z = 0 a pixel is 1/16 unit: the place of x, y in 1/256 unit, sixteenths of pixels, from the left and top. */
static carom_v3_q32 on_page(int64_t x_q4, int64_t y_q4)
{
    return at(Q32(x_q4 - 512, 256), Q32(512 - y_q4, 256), 0);
}

static bool is_red(int x, int y)
{
    return pixels[y][x] == RED;
}

/* ----------------------------------------------------------- over a picture */

/* The pixels of a line: one a step, at most half a pixel from the line. */
static void expect_line(const int64_t from[2], const int64_t to[2])
{
    int64_t size[2] = {to[0] - from[0], to[1] - from[1]};
    int major = carom_abs(size[1]) > carom_abs(size[0]), red = 0, found = 0;
    int64_t n = carom_abs(size[major]);

    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            red += is_red(x, y);
        }
    }
    for (int64_t i = 0; i <= n; i++) {
        int64_t place[2], least = INT64_MAX;

        place[major] = from[major] + (size[major] < 0 ? -i : i);
        /* n times as far from the line as the pixel at p is: from + i size / n - p */
        for (int p = -1; p <= SIZE; p++) {
            int64_t off = carom_abs((from[!major] - p) * n + i * size[!major]);
            bool in;

            place[!major] = p;
            in = place[0] >= 0 && place[0] < SIZE && place[1] >= 0 && place[1] < SIZE;
            least = off < least ? off : least;
            if (in && is_red((int)place[0], (int)place[1])) {
                found++;
                CHECK_AT_MOST(off * 32, n * 17); /* half a pixel, plus the rounding of steps */
            } else if (in) {
                CHECK_AT_LEAST(off * 32, n * 15);
            }
        }
    }
    CHECK_EQ(red, found);
}

/* Any ends, inside the picture and outside at every border. */
static void over_at_random(void)
{
    struct carom_world *world = new_world();
    struct test_random random = {5};

    draw_8(world, &above, CAROM_DRAW_WIRE);
    memcpy(reference, pixels, sizeof pixels);
    for (int i = 0; i < LINES; i++) {
        int64_t reach = range(&random, 0, 3) == 0 ? 900 : 40, from[2], to[2];
        struct carom_picture picture = picture_8();
        struct carom_rect touched = {0, 0, 0, 0};
        carom_v3_q32 a, b;

        for (int k = 0; k < 2; k++) {
            from[k] = range(&random, -reach, SIZE + reach);
            to[k] = i % 5 == 0 ? from[k] : range(&random, -reach, SIZE + reach);
        }
        if (i % 10 == 0) { /* along an axis */
            to[i / 10 % 2] = range(&random, -reach, SIZE + reach);
        }
        /* the middles of pixels */
        a = on_page(from[0] * 16 + 8, from[1] * 16 + 8);
        b = on_page(to[0] * 16 + 8, to[1] * 16 + 8);
        memcpy(pixels, reference, sizeof pixels);
        CHECK_EQ(carom_draw_line(&above, &picture, &a, &b, RED, &touched), CAROM_OK);
        expect_line(from, to);
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                bool inside =
                    x >= touched.x0 && x < touched.x1 && y >= touched.y0 && y < touched.y1;

                CHECK(inside ? is_red(x, y) || pixels[y][x] == reference[y][x]
                             : pixels[y][x] == reference[y][x]);
            }
        }
    }
}

/*
 * Twice a coordinate in 1/64 unit, and the ray of a point of the picture, in half pixels from its
 * middle.
 */
static int64_t off_plane(const int64_t normal[3], int x2, int y2)
{
    /* x right, y up, z down by the focal length of 64 pixels */
    return normal[0] * x2 - normal[1] * y2 - normal[2] * 2 * SIZE;
}

/*
 * Ends anywhere, also behind the eye, up to the limit of 2^14 units. Pixels lie on the plane through the eye and the line, and
 * there are some where the line's middle is visible. `style`: a style of carom_draw with the line
 * in its paint; -1: carom_draw_line.
 */
static void expect_anywhere(int style, int count)
{
    struct carom_world *world = new_world();
    struct test_random random = {11};
    int shown = 0;

    for (int i = 0; i < count; i++) {
        struct carom_paint paint = {.lines = lines, .line_count = 1};
        struct carom_picture picture = picture_8();
        int64_t p[2][3], normal[3], middle[3];
        int reds = 0;

        for (int e = 0; e < 2; e++) {
            static const int64_t reaches[] = {400, 400, 20000, 1048000};
            int64_t reach = reaches[range(&random, 0, 3)];

            for (int k = 0; k < 3; k++) { /* in 1/64 unit from the eye */
                p[e][k] = range(&random, -reach, reach);
            }
        }
        lines[0].from = at(Q32(p[0][0], 64), Q32(p[0][1], 64), Q32(p[0][2] + 256, 64));
        lines[0].to = at(Q32(p[1][0], 64), Q32(p[1][1], 64), Q32(p[1][2] + 256, 64));
        lines[0].colour = RED;
        for (int k = 0; k < 3; k++) {
            int j = (k + 1) % 3, m = (k + 2) % 3;

            normal[k] = p[0][j] * p[1][m] - p[0][m] * p[1][j];
            middle[k] = p[0][k] + p[1][k];
        }
        memset(pixels, 0, sizeof pixels);
        if (style < 0) {
            CHECK_EQ(carom_draw_line(&above, &picture, &lines[0].from, &lines[0].to, RED, NULL),
                     CAROM_OK);
        } else {
            picture.paint = &paint;
            CHECK_EQ(carom_draw(world, &above, &picture, (enum carom_draw_style)style), CAROM_OK);
        }
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                int low = 0, high = 0;

                for (int corner = 0; corner < 4 && is_red(x, y); corner++) {
                    int64_t off = off_plane(normal, 2 * x + 1 - SIZE + (corner & 1 ? 3 : -3),
                                            2 * y + 1 - SIZE + (corner & 2 ? 3 : -3));

                    low += off <= 0;
                    high += off >= 0;
                }
                CHECK(!is_red(x, y) || (low > 0 && high > 0));
                reds += is_red(x, y);
            }
        }
        /* well inside of the picture, and beyond the near plane: z runs from the eye down */
        if (middle[2] < -16 && 5 * carom_abs(middle[0]) < -2 * middle[2] &&
            5 * carom_abs(middle[1]) < -2 * middle[2]) {
            CHECK_MORE(reds, 0);
            shown++;
        }
    }
    CHECK_MORE(shown, count / 40);
}

static void over_anywhere(void)
{
    expect_anywhere(-1, LINES);
}

static void in_anywhere(void)
{
    expect_anywhere(CAROM_DRAW_FLAT, LINES / 4);
    expect_anywhere(CAROM_DRAW_WIRE, LINES / 4);
}

/*
 * In any format nothing beside a picture's rows is written, and the pixels have the line's colour.
 */
static void over_formats(void)
{
    static const uint8_t bytes_each[] = {1, 2, 4, 0, 2};
    static const uint32_t red[] = {RED, 0xf986, 0xff3030, 6, 0x18df}; /* ff3030 in each format */
    struct test_random random = {17};

    for (int i = 0; i < LINES; i++) {
        uint8_t format = (uint8_t)(i % 5);
        struct carom_picture picture = picture_8();
        carom_v3_q32 a = on_page(range(&random, -500, 1500), range(&random, -500, 1500));
        carom_v3_q32 b = on_page(range(&random, -500, 1500), range(&random, -500, 1500));

        picture.format = format;
        picture.pixels = &deep[1][0];
        picture.stride = sizeof deep[0];
        picture.width = SIZE - i % 3;
        picture.height = SIZE - 2;
        memset(deep, 0x99, sizeof deep);
        CHECK_EQ(carom_draw_line(&above, &picture, &a, &b, RED, NULL), CAROM_OK);
        for (int y = 0; y < SIZE; y++) {
            const uint8_t *row = (const uint8_t *)deep[y];

            for (int x = 0; x < (int)sizeof deep[0] * (format == CAROM_GREY4 ? 2 : 1); x++) {
                int at_pixel = format == CAROM_GREY4 ? x : x / bytes_each[format];
                int part = format == CAROM_GREY4 ? 0 : x % bytes_each[format] * 8;
                uint32_t is =
                    format == CAROM_GREY4 ? (x & 1 ? row[x / 2] & 15 : row[x / 2] >> 4) : row[x];
                uint32_t was = format == CAROM_GREY4 ? 9 : 0x99;
                uint32_t drawn = format == CAROM_GREY4 ? red[format] : red[format] >> part & 255;
                bool on = y > 0 && y < SIZE - 1 && at_pixel < picture.width;

                CHECK(is == was || (on && is == drawn));
            }
        }
    }
}

/* ------------------------------------------------------------- in a picture */

/*
 * A line at z = 0 above nothing. In each column, or row, it has the pixel whose middle is within
 * half a pixel, up to half a pixel beyond its ends.
 */
static void in_at_random(void)
{
    struct carom_world *world = new_world();
    struct test_random random = {23};

    for (int i = 0; i < LINES; i++) {
        struct carom_paint paint = {.lines = lines, .line_count = 1};
        struct carom_picture picture = picture_8();
        int64_t a[2], b[2], size[2], n;
        int major;

        for (int k = 0; k < 2; k++) {
            a[k] = range(&random, -600, 1600);
            b[k] = range(&random, -600, 1600);
            size[k] = b[k] - a[k];
        }
        lines[0] = (struct carom_paint_line){on_page(a[0], a[1]), on_page(b[0], b[1]), RED};
        picture.paint = &paint;
        picture.workspace_bytes = i % 2 ? sizeof workspace : CAROM_DRAW_BYTES_LEAST(0, 0);
        memset(pixels, 0xee, sizeof pixels);
        CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        major = carom_abs(size[1]) > carom_abs(size[0]);
        n = carom_abs(size[major]);
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                int64_t middle[2] = {16 * x + 8, 16 * y + 8};
                int64_t along = (middle[major] - a[major]) * (size[major] < 0 ? -1 : 1);
                /* n times its distance from the line in sixteenths */
                int64_t off = carom_abs((a[!major] - middle[!major]) * n + along * size[!major]);

                if (is_red(x, y)) {
                    CHECK_AT_MOST(off, 9 * n + 16);
                    CHECK_AT_LEAST(along, -10);
                    CHECK_AT_MOST(along, n + 10);
                } else if (n > 32 && along > -6 && along < n + 6) {
                    CHECK_AT_LEAST(off, 7 * n - 16);
                }
            }
        }
    }
}

static void draw_line_in(struct carom_world *world, struct carom_paint *paint)
{
    struct carom_picture picture = picture_8();

    paint->lines = lines;
    picture.paint = paint;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
}

static int count_red(void)
{
    int n = 0;

    for (int i = 0; i < SIZE * SIZE; i++) {
        n += is_red(i % SIZE, i / SIZE);
    }
    return n;
}

/* Lines over, on, under and through a square of 32 x 32 pixels. */
static void hidden(void)
{
    struct carom_world *world = new_world();
    struct carom_paint paint = {.line_count = 1};

    add(world, &square, at(0, 0, 0), upright, false);
    /* at z = 0 from column 8 to 56, row 24: on the square it shows */
    lines[0] =
        (struct carom_paint_line){on_page(8 * 16, 24 * 16 + 8), on_page(56 * 16, 24 * 16 + 8), RED};
    draw_line_in(world, &paint);
    CHECK_NEAR(count_red(), 49, 1);
    CHECK(is_red(8, 24));
    CHECK(is_red(16, 24));
    CHECK(is_red(47, 24));
    CHECK(is_red(55, 24));
    /* a unit higher: 64 / 3 pixels a unit */
    lines[0].from.c[2] = lines[0].to.c[2] = Q32(1, 1);
    draw_line_in(world, &paint);
    CHECK_NEAR(count_red(), 64, 1);
    /* a quarter of a unit lower, 64 / 4.25 pixels a unit: from 9.4 to 54.6 without 16 .. 48 */
    lines[0].from.c[2] = lines[0].to.c[2] = Q32(-1, 4);
    draw_line_in(world, &paint);
    CHECK_NEAR(count_red(), 14, 1);
    CHECK(!is_red(16, 24));
    CHECK(!is_red(47, 24));
    /* rising from left to right through the square: hidden up to the middle */
    lines[0].from = at(Q32(-1, 2), Q32(1, 32), Q32(-1, 2));
    lines[0].to = at(Q32(1, 2), Q32(1, 32), Q32(1, 2));
    draw_line_in(world, &paint);
    for (int x = 0; x < SIZE; x++) {
        bool red = is_red(x, 31);

        /* its end is 64 / 2 / 3.5 pixels from the middle: 41.1 */
        CHECK(x < 31 || x > 42 ? !red : x == 31 || x > 40 || red);
    }
    /* in the line styles nothing hides it */
    {
        struct carom_picture picture = picture_8();

        picture.paint = &paint;
        CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_WIRE), CAROM_OK);
        CHECK(is_red(26, 31));
        CHECK(is_red(38, 31));
    }
}

/*
 * More lines behind each other than a row remembers, each in front of those that began before it by less than it rises on its way:
 * where all have begun the last one shows.
 */
static void stacked(void)
{
    static struct carom_paint_line stack[100];
    struct carom_world *world = new_world();
    struct carom_paint paint = {.lines = stack, .line_count = 100};
    struct carom_picture picture = picture_8();

    for (int i = 0; i < 100; i++) {
        const int64_t z = Q32(1, 1000) * i, x = Q32(-3, 2) + Q32(1, 40) * i;

        stack[i] = (struct carom_paint_line){at(x, Q32(1, 32), z + x / 16),
                                             at(Q32(7, 4), Q32(1, 32), z + Q32(7, 64)),
                                             (uint16_t)(100 + i)};
    }
    picture.paint = &paint;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
    /* the last one begins at column 47 or 48, and all end after 59 */
    for (int x = 50; x < 58; x++) {
        CHECK_EQ(pixels[31][x], 199);
    }
}

/* The rows of the picture that the sender received; the last one sent counts. */
static uint8_t sent[SIZE][SIZE];

static void *row_of(void *context, int32_t x0, int32_t x1, int32_t y)
{
    CHECK_SAME(context, sent);
    CHECK_AT_LEAST(x0, 0);
    CHECK_AT_MOST(x1, SIZE);
    CHECK_AT_LEAST(y, 0);
    CHECK_LESS(y, SIZE);
    return sent[y];
}

static void add_lines(struct carom_paint *paint, struct test_random *random)
{
    for (int i = 0; i < 8; i++) {
        for (int k = 0; k < 3; k++) {
            lines[i].from.c[k] = range(random, Q32(-3, 1), Q32(3, 1));
            lines[i].to.c[k] = range(random, Q32(-3, 1), Q32(3, 1));
        }
        lines[i].colour = (uint16_t)(CAROM_COLOUR_RED + i % 7);
    }
    paint->lines = lines;
    paint->line_count = 8;
}

static void by_rows(void)
{
    struct carom_paint paint = {.line_count = 8};
    struct carom_world *world = new_world();
    struct test_random random = {29};

    add_scene(world);
    for (int i = 0; i < 20; i++) {
        struct carom_picture picture = picture_8();

        add_lines(&paint, &random);
        picture.paint = &paint;
        CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        picture.row = row_of;
        picture.context = sent;
        memset(sent, 0xee, sizeof sent);
        picture.workspace_bytes = i % 2 ? sizeof workspace : CAROM_DRAW_BYTES_LEAST(8, 12);
        CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        CHECK_EQ(memcmp(sent, pixels, sizeof pixels), 0);
    }
}

/* Lines that move, come and go, and some that were drawn over the picture. */
static void changes(void)
{
    static struct carom_drawn_body drawn_bodies[6];
    struct carom_drawn drawn = {.bodies = drawn_bodies, .room = 6};
    struct carom_paint paint = {.lines = lines};
    struct carom_world *world = new_world();
    struct test_random random = {31};

    add_scene(world);
    for (int i = 0; i < 60; i++) {
        struct carom_picture picture = picture_8();

        if (i % 3) {
            add_lines(&paint, &random);
        }
        paint.line_count = (uint32_t)range(&random, 0, 8) / 3;
        picture.paint = i % 7 == 6 ? NULL : &paint;
        picture.pixels = reference;
        for (int again = 0; again < 2; again++) {
            enum carom_draw_style style = styles[i / 30];

            CHECK_EQ(carom_draw_changes(world, &above, &picture, style, &drawn), CAROM_OK);
            CHECK(again == 0 || drawn.changed_count == 0);
            picture.pixels = pixels;
            CHECK_EQ(carom_draw(world, &above, &picture, style), CAROM_OK);
            CHECK_EQ(memcmp(reference, pixels, sizeof pixels), 0);
            picture.pixels = reference;
        }
        if (i % 4 == 0) {
            CHECK_EQ(carom_draw_line(&above, &picture, &lines[7].from, &lines[7].to, RED,
                                     &drawn.touched),
                     CAROM_OK);
        }
    }
}

/* -------------------------------------------------------------------- errors */

static void errors(void)
{
    struct carom_picture picture = picture_8();
    struct carom_camera camera = above;
    carom_v3_q32 a = at(0, 0, 0), b = at(1, 0, 0), far = at(Q32(-16384, 1) - 1, 0, 0);

    memset(pixels, 0xee, sizeof pixels);
    CHECK_EQ(carom_draw_line(NULL, &picture, &a, &b, RED, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_draw_line(&above, NULL, &a, &b, RED, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_draw_line(&above, &picture, NULL, &b, RED, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_draw_line(&above, &picture, &a, NULL, RED, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_draw_line(&above, &picture, &a, &b, 256, NULL), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_draw_line(&above, &picture, &a, &far, RED, NULL), CAROM_ERR_RANGE);
    camera.target = camera.eye;
    CHECK_EQ(carom_draw_line(&camera, &picture, &a, &b, RED, NULL), CAROM_ERR_ARGUMENT);
    picture.row = row_of;
    CHECK_EQ(carom_draw_line(&above, &picture, &a, &b, RED, NULL), CAROM_ERR_ARGUMENT);
    CHECK_EQ(pixels[32][32], 0xee);
    picture.row = NULL;
    CHECK_EQ(carom_draw_line(&above, &picture, &a, &b, RED, NULL), CAROM_OK);
    CHECK_EQ(pixels[32][32], RED);
}

const struct test tests_draw_lines[] = {
    {"draw_lines/over_at_random", over_at_random},
    {"draw_lines/over_anywhere", over_anywhere},
    {"draw_lines/over_formats", over_formats},
    {"draw_lines/in_at_random", in_at_random},
    {"draw_lines/in_anywhere", in_anywhere},
    {"draw_lines/hidden", hidden},
    {"draw_lines/stacked", stacked},
    {"draw_lines/by_rows", by_rows},
    {"draw_lines/changes", changes},
    {"draw_lines/errors", errors},
    {0},
};
