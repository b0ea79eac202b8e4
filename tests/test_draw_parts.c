/* SPDX-License-Identifier: MIT */
/*
 * Parts of drawing that a picture seldom takes to their ends: the cover far aside or very large, shades beyond the ends of their
 * ramp, outlines that cross themselves again and again, specks that cast no shadow, greys of a ramp without greys.
 */
#include "draw/outline.h"
#include "lib/draw_scene.h"
#include "lib/shapes.h"

#ifdef TEST_LONG
enum { SPECKS = 400 };
#else
enum { SPECKS = 8 };
#endif

static uint8_t whole[SIZE][SIZE];

/* ------------------------------------------------------------------- the cover */

/* A pixel's sixteenth as many as a picture of `height` rows has for a slope. */
static double sixteenths(double slope, double heights, int height)
{
    return slope * heights * height * 16;
}

/* The cube covers a disc of half its side, two pixels less; none beside the guard band, and none larger than it. */
static void cover(void)
{
    static const struct {
        double aside,
            heights; /* of the way to the cube: right and down of it, by the distance; focal length */
        int height;
        bool is;
    } cases[] = {{0, 2, 64, true},    {0.5, 16, 64, true},  {2, 16, 64, false},
                 {-2, 16, 64, false}, {0.9, 16, 64, true},  {0, 1, 32, false},
                 {0, 16, 2048, true}, {1.1, 16, 64, false}, {-0.9, 16, 64, true},
                 {0, 8, 2048, true}};

    for (size_t i = 0; i < 2 * sizeof cases / sizeof *cases; i++) {
        const int axis = i & 1, height = cases[i / 2].height;
        const double aside = cases[i / 2].aside, heights = cases[i / 2].heights;
        struct carom_camera camera = {.focal_q16 = (int32_t)(heights * 65536)};
        struct carom_world *world = new_world();
        struct draw_source source;
        struct draw_view view;
        double radius, away[3] = {0, 0, 4}, distance;

        /* straight down: right is x, down is -y */
        away[axis] = axis ? -4 * aside : 4 * aside;
        camera.eye = at(0, 0, Q32(4, 1));
        add(world, &cube,
            at((int64_t)(away[0] * 4294967296.0), (int64_t)(away[1] * 4294967296.0), 0), upright,
            false);
        CHECK_EQ(draw_view_init(&view, &camera, 64, height), CAROM_OK);
        draw_source_init(&source, world, NULL);
        draw_cover_init(&view, &source, 0);
        CHECK_EQ(view.cover.radius2_q8 > 0, cases[i / 2].is);
        if (!cases[i / 2].is) {
            continue;
        }
        distance = 4;
        for (int k = 0; k < 60; k++) { /* the root of 16 (1 + aside^2) */
            distance = (distance + 16 * (1 + aside * aside) / distance) / 2;
        }
        radius = sixteenths(0.5 / distance, heights, height) - 32;
        radius = radius < 16 * 1024 ? radius : 16 * 1024;
        CHECK_NEAR(view.cover.radius2_q8, radius * radius, 4 * radius + 4);
        CHECK_NEAR(axis ? view.cover.y_q4 : view.cover.x_q4, sixteenths(aside, heights, height),
                   24);
    }
}

/* A smooth cube hides a smaller one behind it, of which no pixel may show; beside it, it shows. */
static void smooth_cover(void)
{
    static const int16_t small_vertices[8][3] = BOX_CORNERS(256, 256, 256);
    static _Alignas(8) uint8_t small_block[CAROM_MESH_BYTES(8, 12)];
    const struct carom_mesh_raw raw = {small_vertices, box_faces, 8, 12, 12, CAROM_SOLID};
    const struct carom_body_paint looks[] = {{NULL, 3}, {NULL, 5}, {NULL, 6}};
    const struct carom_paint paint = {.bodies = looks, .body_count = 3, .smooth = &carom_smooth};
    struct carom_mesh small;

    CHECK_EQ(carom_mesh_build(&small, &raw, small_block, sizeof small_block), CAROM_OK);
    for (int x = 0; x <= 3; x++) {
        struct carom_world *world = new_world();
        struct carom_picture picture = picture_8();

        picture.paint = &paint;
        add(world, &plain, at(0, 0, -Q32(2, 1)), upright, false);
        add(world, &cube, at(0, 0, Q32(2, 1)), upright, false);
        CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        memcpy(whole, pixels, sizeof whole);
        add(world, &small, at(Q32(x, 2), 0, 0), oblique, false);
        CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        /* the cube's top is 2.5 high: as seen from 4, it hides what is within 4/3 of the middle at 0 */
        CHECK_EQ(memcmp(whole, pixels, sizeof whole) == 0, x <= 2);
        CHECK_EQ(count_ramp(6) > 0, x == 3);
    }
}

/* -------------------------------------------------------------------- shades */

/* Pixels whose shade lies below the first or above the last of the ramp take that one. */
static void beyond(void)
{
    static const struct {
        int at, right; /* the shade at pixel 8, and its growth a pixel */
    } cases[] = {{0, 4}, {0, 1}, {31, 4}, {31, -4}, {0, -4}, {16, 4}, {16, -4}, {15, 1}, {31, -1}};
    static const uint8_t formats[] = {CAROM_PALETTE8, CAROM_XRGB8888, CAROM_RGB565};
    static const struct draw_vertex vertices[2] = {{0}, {.yx_q4 = 8 * 16}};
    enum { WIDE = 17, BASE = 2 * DRAW_SHADES };
    static uint32_t palette[8 * DRAW_SHADES], row[WIDE];

    for (int i = 0; i < DRAW_SHADES; i++) {
        palette[BASE + i] = (uint32_t)i * 8;
    }
    for (size_t i = 0; i < 3 * sizeof cases / sizeof *cases; i++) {
        const int shade = cases[i / 3].at, right = cases[i / 3].right;
        const uint32_t right_q16 = (uint32_t)right * 65536;
        const struct draw_tint tint = {.at_q8 =
                                           (uint16_t)(shade == 31 ? 31 * 256 - 1 : shade * 256),
                                       .right_q16 = {(uint16_t)(right_q16 >> 16), 0}};
        struct draw_face faces[2] = {{.next = 0}, {.corner = {1}, .colour = BASE | DRAW_TINT}};
        const uint8_t format = formats[i % 3];
        const struct draw_sweep sweep = {.vertices = vertices,
                                         .row = (uint8_t *)row,
                                         .palette = palette,
                                         .format = format,
                                         .pixel_shift = draw_pixel_shift(format)};
        const struct draw_span span = {.face = &faces[1]};

        memcpy(&faces[0], &tint, sizeof tint);
        carom_smooth.run(&sweep, &span, 0, WIDE);
        for (int x = 0; x < WIDE; x++) {
            double want = shade + right * (x + 0.5 - 8), found;

            want = want < 0 ? 0 : want > 31 ? 31 : want;
            found = format == CAROM_PALETTE8 ? ((uint8_t *)row)[x] - (double)BASE
                    : format == CAROM_RGB565 ? ((uint16_t *)row)[x]
                                             : row[x] / 8.0;
            CHECK_LESS(found, want + 1.01); /* formats of few colours mix two shades */
            CHECK_MORE(found, want - 1.01);
            if (format == CAROM_XRGB8888) {
                CHECK_AT_MOST(found, want + 0.25);
                CHECK_AT_LEAST(found, want - 0.25);
            }
        }
    }
}

static void draw_greys(struct carom_world *world, const uint32_t *palette,
                       uint8_t out[SIZE][SIZE / 2])
{
    const struct carom_paint paint = {
        .palette = palette, .ramps = 16, .smooth = &carom_smooth, .crease_q30 = -CAROM_ONE_Q30};
    struct carom_picture picture = picture_8();

    picture.pixels = out;
    picture.format = CAROM_GREY4;
    picture.stride = SIZE / 2;
    picture.paint = &paint;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
}

/* With a palette whose greys fall a picture is the negative of that with rising ones; with one grey it has one. */
static void greys(void)
{
    static uint32_t palettes[3][16 * DRAW_SHADES];
    static uint8_t out[3][SIZE][SIZE / 2];
    struct carom_world *world = new_world();
    int other = 0;

    for (uint32_t i = 0; i < 16 * DRAW_SHADES; i++) {
        const uint32_t grey = i % DRAW_SHADES * 15 / (DRAW_SHADES - 1);

        palettes[0][i] = grey * 0x111111;
        palettes[1][i] = (15 - grey) * 0x111111;
        palettes[2][i] = 6 * 0x111111;
    }
    add(world, &cube, at(0, 0, Q32(2, 1)), oblique, false);
    for (int k = 0; k < 3; k++) {
        draw_greys(world, palettes[k], out[k]);
    }
    for (int i = 0; i < SIZE * SIZE / 2; i++) {
        CHECK_EQ(((uint8_t *)out[0])[i] + ((uint8_t *)out[1])[i], 0xff);
        CHECK_EQ(((uint8_t *)out[2])[i], 0x66);
        other += ((uint8_t *)out[0])[i] != ((uint8_t *)out[0])[0];
    }
    CHECK_MORE(other, 50);
}

/* ------------------------------------------------------------------- outlines */

enum { STICKS = 60, STICK_BYTES = 400 };

/* Thin tetrahedra, one behind the other as the light sees them, each across many others. */
static void make_sticks(struct carom_mesh *mesh)
{
    static int16_t corner[4 * STICKS][3];
    static uint16_t face[4 * STICKS][3];
    static _Alignas(8) uint8_t mesh_block[CAROM_MESH_BYTES(4 * STICKS, 4 * STICKS)];
    static const uint16_t side[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const struct carom_mesh_raw raw = {(const int16_t(*)[3])corner,
                                       (const uint16_t(*)[3])face,
                                       4 * STICKS,
                                       4 * STICKS,
                                       12,
                                       CAROM_SOLID};
    struct test_random random = {5};

    for (int i = 0; i < STICKS; i++) {
        const int x = (int)test_random_range(&random, -4000, 4000),
                  y = (int)test_random_range(&random, -4000, -1000);
        const int to_x = (int)test_random_range(&random, -4000, 4000),
                  to_y = (int)test_random_range(&random, 1000, 4000);
        const int about[4][3] = {{x, y, 0},
                                 {x + 90, y - 3, 0},
                                 {to_x, to_y, 0},
                                 {(2 * x + 90 + to_x) / 3, (2 * y - 3 + to_y) / 3, 30}};

        for (int v = 0; v < 4; v++) {
            for (int k = 0; k < 3; k++) {
                corner[4 * i + v][k] =
                    (int16_t)(about[v][k] + (k == 2 ? 64 * (i - STICKS / 2) : 0));
                face[4 * i + v][k] = (uint16_t)(4 * i + side[v][k]);
            }
        }
    }
    CHECK_EQ(carom_mesh_build(mesh, &raw, mesh_block, sizeof mesh_block), CAROM_OK);
}

/*
 * An outline has room for three trapezoids an edge. Where edges cross each other often there may be more: then the outline says
 * that it has no room, until its memory holds as many edges as it needs for its trapezoids.
 */
static void crossing(void)
{
#ifdef TEST_LONG
    enum { BYTES = 21846 * STICK_BYTES };
#else
    enum { BYTES = 20 * STICKS * STICK_BYTES };
#endif
    static _Alignas(8) uint8_t scratch[BYTES];
    static const int32_t sun[3] = {0, 0, -CAROM_ONE_Q30}; /* towards the camera */
    const struct carom_paint paint = {.light = {{0, 0, CAROM_ONE_Q30}}};
    struct carom_world *world = new_world();
    struct carom_body_look look;
    struct draw_outline o;
    struct draw_view view;
    struct draw_body body;
    struct carom_mesh mesh;
    uint32_t edges, trapezoids;
    int full = 0;

    make_sticks(&mesh);
    add(world, &mesh, at(0, 0, 0), upright, false);
    CHECK_EQ(carom_body_look(world, 0, &look), CAROM_OK);
    CHECK_EQ(draw_view_init(&view, &above, SIZE, SIZE), CAROM_OK);
    draw_paint_light(&view, &paint);
    draw_body_place(&body, &view, &look);
    CHECK(draw_outline_find(&o, &body, sun, scratch, sizeof scratch));
    edges = o.edge_count;
    trapezoids = o.trapezoid_count;
    CHECK_EQ(edges, 3 * STICKS); /* of each stick the light sees a triangle */
    CHECK_MORE(trapezoids, 3 * edges);
    for (size_t bytes = 0; bytes < STICK_BYTES * trapezoids / 3; bytes += 1000) {
        const bool is = draw_outline_find(&o, &body, sun, scratch, bytes);
        const uint32_t most = (uint32_t)(o.place - (int64_t *)(void *)o.keys) / 2;

        CHECK_EQ(is, most >= edges && 3 * most >= trapezoids);
        CHECK_EQ(!is || o.trapezoid_count == trapezoids, true);
        full += !is && most >= edges;
    }
    CHECK_MORE(full, 0);
    CHECK(draw_outline_find(&o, &body, sun, scratch, sizeof scratch));
    /* their numbers have 16 bits */
    CHECK_AT_MOST(3 * (uint32_t)(o.place - (int64_t *)(void *)o.keys) / 2, 0xffff);
    CHECK_EQ(o.trapezoid_count, trapezoids);
}

/* A cube that is less than a thousandth of a pixel wide casts no shadow, and takes none, wherever it is. */
static void specks(void)
{
    static const int16_t speck_vertices[8][3] = BOX_CORNERS(350, 350, 350);
    static const int16_t plate_vertices[8][3] = BOX_CORNERS(4000, 4000, 40);
    static _Alignas(8) uint8_t speck_block[CAROM_MESH_BYTES(8, 12)],
        plate_block[CAROM_MESH_BYTES(8, 12)];
    const struct carom_mesh_raw raw = {speck_vertices, box_faces, 8, 12, 20, CAROM_SOLID};
    const struct carom_mesh_raw plate_raw = {plate_vertices, box_faces, 8, 12, 9, CAROM_SOLID};
    struct test_random random = {9};
    struct carom_mesh speck, plate;

    CHECK_EQ(carom_mesh_build(&speck, &raw, speck_block, sizeof speck_block), CAROM_OK);
    CHECK_EQ(carom_mesh_build(&plate, &plate_raw, plate_block, sizeof plate_block), CAROM_OK);
    for (int n = 0; n < SPECKS; n++) {
        const struct carom_paint paint = {.shadows = &carom_shadows,
                                          .smooth = n % 2 ? &carom_smooth : NULL};
        const int64_t behind = test_random_range(&random, Q32(5, 1), Q32(18, 1));
        const int64_t aside = test_random_range(&random, -Q32(9, 1), Q32(9, 1));
        const bool far = n % 4 < 2; /* across the whole world: the coarsest coordinates */
        const int64_t middle = far ? -Q32(4000, 1) : 0, eye = Q32(16384, 1);
        const struct carom_camera camera = {
            .eye = {{far ? eye : 0, far ? eye : 0, far ? eye : Q32(600, 1)}},
            .target = {{middle, middle, middle}},
            .focal_q16 = n % 8 < 4 ? 16 << 16 : 4 << 16};
        struct carom_world *world = new_world();
        struct carom_picture picture = picture_8();

        picture.paint = &paint;
        add(world, &plain, at(middle, middle, middle - Q32(20, 1)), upright, false);
        add(world, &plate, at(middle, middle, middle), upright, false);
        CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        memcpy(whole, pixels, sizeof whole);
        /* behind the plate, as the usual light sees it; and above the plain, beside the plate */
        add(world, &speck,
            at(middle + Q32(4, 1) + behind * 6 / 7, middle + behind * 2 / 7,
               middle - behind * 3 / 7),
            shape_random_turn(&random), false);
        add(world, &speck, at(middle - Q32(12, 1), middle + aside, middle - behind),
            shape_random_turn(&random), false);
        CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        CHECK_EQ(memcmp(whole, pixels, sizeof whole), 0);
    }
}

/* A scene and all its distances 32 times as large make the same picture with shadows, but for rounding at their edges. */
static void large_shadows(void)
{
    static _Alignas(8) uint8_t large_block[2][CAROM_MESH_BYTES(8, 12)];
    const struct carom_paint paint = {.shadows = &carom_shadows};
    static const int16_t wide_vertices[4][3] = {
        {-16384, -16384, 0}, {16384, -16384, 0}, {16384, 16384, 0}, {-16384, 16384, 0}};
    int dark[2] = {0}, differ = 0;

    for (int k = 0; k < 2; k++) {
        const int bits = k ? 5 : 0;
        const int64_t by = (int64_t)1 << bits;
        struct carom_mesh_raw raw = {cube_vertices,        box_faces,  8, 12,
                                     (uint8_t)(12 - bits), CAROM_SOLID};
        struct carom_world *world = new_world();
        struct carom_picture picture = picture_8();
        struct carom_camera camera = above;
        struct carom_mesh large, ground;

        CHECK_EQ(carom_mesh_build(&large, &raw, large_block[0], sizeof large_block[0]), CAROM_OK);
        raw = (struct carom_mesh_raw){wide_vertices,        square_faces, 4, 2,
                                      (uint8_t)(12 - bits), CAROM_SURFACE};
        CHECK_EQ(carom_mesh_build(&ground, &raw, large_block[1], sizeof large_block[1]), CAROM_OK);
        add(world, &ground, at(0, 0, -Q32(1, 1) * by), upright, false);
        add(world, &large, at(Q32(1, 8) * by, 0, Q32(1, 2) * by), oblique, false);
        camera.eye.c[2] *= by;
        picture.paint = &paint;
        CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        for (int i = 0; i < SIZE * SIZE; i++) {
            dark[k] += ((uint8_t *)pixels)[i] < pixels[0][0] &&
                       ramp_at(i % SIZE, i / SIZE) == DRAW_STATIONARY;
            differ += k == 1 && ((uint8_t *)pixels)[i] != ((uint8_t *)whole)[i];
        }
        memcpy(whole, pixels, sizeof whole);
    }
    CHECK_MORE(dark[0], 100); /* a cube's shadow is more than 10 x 10 pixels */
    CHECK_NEAR(dark[1], dark[0], 8);
    CHECK_AT_MOST(differ, 20);
}

const struct test tests_draw_parts[] = {
    {"draw_parts/cover", cover},
    {"draw_parts/smooth_cover", smooth_cover},
    {"draw_parts/beyond", beyond},
    {"draw_parts/greys", greys},
    {"draw_parts/crossing", crossing},
    {"draw_parts/specks", specks},
    {"draw_parts/large_shadows", large_shadows},
    {0},
};
