/* SPDX-License-Identifier: MIT */
/* Pictures whose pixels are known by hand. */
#include "lib/draw_scene.h"

static uint8_t reference[SIZE][SIZE];

/* ---------------------------------------------------------------- hand cases */

static void background(void)
{
    struct carom_world *world = new_world();

    /* each shade has two rows, from the top */
    draw_8(world, &above, CAROM_DRAW_FLAT);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            CHECK_EQ(pixels[y][x], y / 2);
        }
    }
}

static void covered_pixels(void)
{
    struct carom_world *world = new_world();

    /*
     * 2 units are 32 pixels; the diagonal runs through pixel centres and is a right edge: outside
     */
    add(world, &half, at(0, 0, 0), upright, false);
    draw_8(world, &above, CAROM_DRAW_FLAT);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            bool inside = x >= 16 && y < 48 && x < y;

            CHECK_EQ(ramp_at(x, y), inside ? DRAW_STATIONARY : DRAW_BACKGROUND);
        }
    }
}

/* The middle of a picture of any sides is half of them from its corner. A side is 2 of the 4 units that a height spans. */
static void odd_sides(void)
{
    struct carom_world *world = new_world();
    struct carom_picture picture = picture_8();

    add(world, &square, at(0, 0, 0), upright, false);
    for (picture.height = 57; picture.height <= 63; picture.height += 2) {
        for (picture.width = 55; picture.width <= 64; picture.width++) {
            CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
            for (int y = 0; y < picture.height; y++) {
                for (int x = 0; x < picture.width; x++) {
                    /* half pixels from the middle; a side of an odd height meets no pixel's middle */
                    int right = 2 * x + 1 - picture.width, down = 2 * y + 1 - picture.height;
                    bool inside = 2 * carom_abs(right) < picture.height &&
                                  2 * carom_abs(down) < picture.height;

                    CHECK_EQ(ramp_at(x, y), inside ? DRAW_STATIONARY : DRAW_BACKGROUND);
                }
            }
        }
    }
}

static void shared_edge(void)
{
    struct carom_world *world = new_world();

    add(world, &square, at(Q32(1, 4), Q32(1, 2), 0), upright, false);
    draw_8(world, &above, CAROM_DRAW_FLAT);
    CHECK_EQ(count_ramp(DRAW_STATIONARY), 32 * 32);
    /* a quarter to the right is 4 pixels; half a unit up the page is 8 rows less */
    CHECK_EQ(ramp_at(16 + 4, 16 - 8), DRAW_STATIONARY);
    CHECK_EQ(ramp_at(15 + 4, 16 - 8), DRAW_BACKGROUND);
    CHECK_EQ(ramp_at(16 + 4, 15 - 8), DRAW_BACKGROUND);
    CHECK_EQ(ramp_at(47 + 4, 47 - 8), DRAW_STATIONARY);
}

/* A cube above or below a square, added first or second: the far body never shows through. */
static void nearer_hides(void)
{
    for (int k = 0; k < 4; k++) {
        struct carom_world *world = new_world();
        bool cube_first = k & 1, cube_near = k & 2;
        carom_v3_q32 place = at(0, 0, cube_near ? Q32(1, 1) : Q32(-1, 1));

        if (cube_first) {
            add(world, &cube, place, upright, true);
        }
        add(world, &square, at(0, 0, 0), upright, false);
        if (!cube_first) {
            add(world, &cube, place, upright, true);
        }
        draw_8(world, &above, CAROM_DRAW_FLAT);
        /* the cube's top is 2.5 units away: 25.6 pixels wide */
        CHECK_EQ(count_ramp(DRAW_MOVING), cube_near ? 26 * 26 : 0);
        CHECK_EQ(count_ramp(DRAW_STATIONARY), 32 * 32 - (cube_near ? 26 * 26 : 0));
    }
}

/* Two cubes in one place: where depths are equal, the last body shows. */
static void equal_depths(void)
{
    for (int k = 0; k < 2; k++) {
        struct carom_world *world = new_world();

        add(world, &cube, at(0, 0, 0), upright, k == 1);
        add(world, &cube, at(0, 0, 0), upright, k == 0);
        draw_8(world, &above, CAROM_DRAW_FLAT);
        /* the top is 3.5 units away: 18.3 pixels wide */
        CHECK_EQ(count_ramp(k == 0 ? DRAW_MOVING : DRAW_STATIONARY), 18 * 18);
        CHECK_EQ(count_ramp(k == 0 ? DRAW_STATIONARY : DRAW_MOVING), 0);
    }
}

/*
 * A level square and one that is tilted about the y axis cross between the two columns in the
 * middle. Seen from two heights, the faces have some hundred and some ten pixels.
 */
static void crossing_faces(void)
{
    /* cos and sin of half the angle are 0.96 and 0.28 */
    static const carom_quat_q30 tilted = {{1030792151, 0, 300647711, 0}};
    static const struct {
        int64_t height;
        int half; /* pixels of the level square without the outermost */
    } views[] = {{4, 15}, {16, 3}};

    for (int k = 0; k < 2; k++) {
        struct carom_world *world = new_world();
        struct carom_camera camera = above;
        uint8_t level;

        camera.eye.c[2] = Q32(views[k].height, 1);
        add(world, &square, at(0, 0, 0), upright, false);
        draw_8(world, &camera, CAROM_DRAW_FLAT);
        level = pixels[32][32];
        add(world, &square, at(0, 0, 0), tilted, false);
        draw_8(world, &camera, CAROM_DRAW_FLAT);
        for (int y = 32 - views[k].half; y < 32 + views[k].half; y++) {
            for (int x = 32 - views[k].half; x < 32 + views[k].half; x++) {
                if (x < 32) { /* the square is turned about +y, so the side of -x comes up */
                    CHECK_DIFFER(pixels[y][x], level);
                    CHECK_EQ(ramp_at(x, y), DRAW_STATIONARY);
                } else {
                    CHECK_EQ(pixels[y][x], level);
                }
            }
        }
    }
}

static void nothing_to_see(void)
{
    static const carom_quat_q30 upside_down = {{0, CAROM_ONE_Q30, 0, 0}};
    static const int8_t places[][3] = {{0, 0, 6},  {9, 0, 0}, {-9, 0, 0}, {0, 9, 0},
                                       {0, -9, 0}, {0, 0, 9}, {9, 9, 9},  {-50, 0, 3}};

    for (int k = 0; k < 2; k++) {
        enum carom_draw_style style = styles[k];

        draw_8(new_world(), &above, style);
        memcpy(reference, pixels, sizeof pixels);
        for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
            struct carom_world *world = new_world();

            add(world, &cube, at(Q32(places[i][0], 1), Q32(places[i][1], 1), Q32(places[i][2], 1)),
                upright, true);
            draw_8(world, &above, style);
            CHECK_EQ(memcmp(reference, pixels, sizeof pixels), 0);
        }
        {
            struct carom_world *world = new_world();

            add(world, &square, at(0, 0, 0), upside_down, false);
            draw_8(world, &above, style);
            CHECK_EQ(memcmp(reference, pixels, sizeof pixels), 0);
        }
    }
}

/* A plain one unit below the eye reaches behind the eye: it fills the rows below the horizon. */
static void near_plane(void)
{
    static const struct carom_camera level = {
        .eye = {{0, 0, Q32(1, 1)}}, .target = {{0, Q32(1, 1), Q32(1, 1)}}, .focal_q16 = 1 << 16};
    struct carom_world *world = new_world();

    add(world, &plain, at(0, 0, 0), upright, false);
    draw_8(world, &level, CAROM_DRAW_FLAT);
    for (int y = 0; y < SIZE; y++) {
        /*
         * its far edge, 32 units away, is 2 rows below the horizon; the plain is as wide as the
         * view there
         */
        for (int x = 1; x < SIZE - 1; x++) {
            CHECK_EQ(ramp_at(x, y), y >= 34 ? DRAW_STATIONARY : DRAW_BACKGROUND);
        }
    }
}

/* A square comes towards the eye on the left: from the middle on it is nearer than 1/32 unit. */
static void near_plane_cuts(void)
{
    static const carom_quat_q30 tilted = {{992008094, 0, 410903207, 0}}; /* by 45 degrees about y */
    struct carom_world *world = new_world();

    add(world, &square, at(0, 0, Q32(4, 1) - Q32(1, 32)), tilted, false);
    draw_8(world, &above, CAROM_DRAW_FLAT);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            if (x < 31 || x > 32) {
                CHECK_EQ(ramp_at(x, y), x > 32 ? DRAW_STATIONARY : DRAW_BACKGROUND);
            }
        }
    }
}

/* The longest focal length in a tall picture: 2048 pixels, so a unit at 512 units is 4 pixels. */
static void telephoto(void)
{
    enum { WIDTH = 16, HEIGHT = 128 };
    static uint8_t tall[HEIGHT][WIDTH];
    struct carom_world *world = new_world();
    struct carom_picture picture = picture_8();
    struct carom_camera camera = above;

    camera.eye.c[2] = Q32(512, 1);
    camera.focal_q16 = 16 << 16;
    picture.pixels = tall;
    picture.width = picture.stride = WIDTH;
    picture.height = HEIGHT;
    add(world, &square, at(0, 0, 0), upright, false);
    add(world, &cube, at(0, 0, Q32(1, 1)), upright, true);
    CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            bool in_square = x >= 4 && x < 12 && y >= 60 && y < 68;
            bool in_cube = x >= 6 && x < 10 && y >= 62 && y < 66;

            CHECK_EQ(tall[y][x] / DRAW_SHADES, in_cube     ? DRAW_MOVING
                                               : in_square ? DRAW_STATIONARY
                                                           : DRAW_BACKGROUND);
        }
    }
}

static void far_away(void)
{
    /* 16384 units away and 8192 aside, a cube of one unit is 1/256 of a pixel; nothing overflows */
    struct carom_camera camera = {.eye = {{Q32(-16384, 1), Q32(16384, 1), Q32(16384, 1)}},
                                  .target = {{Q32(4000, 1), Q32(-4000, 1), Q32(-4000, 1)}},
                                  .focal_q16 = 1 << 20};
    struct carom_world *world = new_world();

    add(world, &cube, at(Q32(4000, 1), Q32(-4000, 1), Q32(-4000, 1)), upright, true);
    draw_8(world, &camera, CAROM_DRAW_FLAT);
    CHECK_AT_MOST(count_ramp(DRAW_MOVING), 1);
    /* in wire style the cube is the pixel of its middle, at most with the neighbours */
    draw_8(world, &camera, CAROM_DRAW_WIRE);
    CHECK_AT_LEAST(count_ramp(DRAW_MOVING), 1);
    CHECK_AT_MOST(count_ramp(DRAW_MOVING), 4);
}

/* ---------------------------------------------------------------------- wire */

static void wire_edges(void)
{
    struct carom_world *world = new_world();

    /* 1/32 unit right and up: corners at the centres of pixels (16, 47), (48, 47) and (16, 15) */
    add(world, &half, at(Q32(1, 32), Q32(1, 32), 0), upright, false);
    draw_8(world, &above, CAROM_DRAW_WIRE);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            bool edge = (y == 47 && x >= 16 && x <= 48) || (x == 16 && y >= 15 && y <= 47) ||
                        (x == y + 1 && x >= 16 && x <= 48);

            CHECK_EQ(ramp_at(x, y), edge ? DRAW_STATIONARY : DRAW_BACKGROUND);
        }
    }
}

/* Seen from above, a cube shows the four edges of its top and the diagonal between its two triangles. */
static void wire_back_edges(void)
{
    struct carom_world *world = new_world();
    struct carom_camera camera = above;

    camera.eye.c[2] = Q32(5, 2); /* the top is 2 units away: 32 pixels wide, from 16 to 48 */
    add(world, &cube, at(Q32(1, 64), Q32(-1, 64), 0), upright, true);
    draw_8(world, &camera, CAROM_DRAW_WIRE);
    CHECK_EQ(count_ramp(DRAW_MOVING), 4 * 32 + 31);
    /* the bottom's corners, 3 units away, are within the top and do not show */
    CHECK_EQ(ramp_at(22, 22), DRAW_BACKGROUND);
    CHECK_EQ(ramp_at(42, 21), DRAW_BACKGROUND);
}

/* The edges of a plain that passes the near plane are cut, not wrapped around. */
static void wire_clip(void)
{
    static const struct carom_camera level = {
        .eye = {{0, 0, Q32(1, 1)}}, .target = {{0, Q32(1, 1), Q32(1, 1)}}, .focal_q16 = 1 << 16};
    struct carom_world *world = new_world();

    add(world, &plain, at(0, 0, 0), upright, false);
    draw_8(world, &level, CAROM_DRAW_WIRE);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            /* the far edge is just on row 34, and the sides leave the picture near it; the diagonal
             * runs from the eye's foot, straight below and out of sight, to the far corner on the
             * right */
            bool far_edge = y == 34 || y == 33;
            bool may = far_edge || (y > 33 && (x <= 1 || x >= SIZE - 2));

            if (ramp_at(x, y) != DRAW_BACKGROUND) {
                CHECK(may || x - 32 == y - 32 || x - 32 == y - 33 || x - 31 == y - 32);
            }
        }
    }
    CHECK_EQ(ramp_at(32, 34) + ramp_at(32, 33), DRAW_STATIONARY);
}

/* -------------------------------------------------------- interfering faces */

/* Each face of the square shows hot exactly when the step listed it. */
static void interfering(void)
{
    struct carom_world *world = new_world();
    const struct carom_face_ref *refs;
    bool listed[2] = {false, false};
    int count, cube_hot = 0;

    add(world, &square, at(0, 0, 0), upright, false);
    add(world, &cube, at(Q32(1, 2), Q32(-1, 4), Q32(502, 1000)), upright, true);
    CHECK_AT_LEAST(carom_world_step(world), 0);
    count = carom_interfering_faces(world, &refs);
    CHECK_MORE(count, 0);
    for (int i = 0; i < count; i++) {
        if (refs[i].body == 0) {
            listed[refs[i].face] = true;
        } else {
            cube_hot++;
        }
    }
    draw_8(world, &above, CAROM_DRAW_FLAT);
    /* face 0 is the lower right half of the page; the cube leaves the lower left corner free */
    CHECK_EQ(ramp_at(18, 46), listed[0] ? DRAW_STATIONARY_HOT : DRAW_STATIONARY);
    CHECK_EQ(ramp_at(17, 18), listed[1] ? DRAW_STATIONARY_HOT : DRAW_STATIONARY);
    CHECK(listed[0]);
    CHECK_MORE(cube_hot, 0);
    draw_8(world, &above, CAROM_DRAW_WIRE);
    CHECK_MORE(count_ramp(DRAW_MOVING_HOT), 0);
    CHECK_MORE(count_ramp(DRAW_STATIONARY_HOT), 0);
}

const struct test tests_draw[] = {
    {"draw/background", background},
    {"draw/covered_pixels", covered_pixels},
    {"draw/odd_sides", odd_sides},
    {"draw/shared_edge", shared_edge},
    {"draw/nearer_hides", nearer_hides},
    {"draw/equal_depths", equal_depths},
    {"draw/crossing_faces", crossing_faces},
    {"draw/nothing_to_see", nothing_to_see},
    {"draw/near_plane", near_plane},
    {"draw/near_plane_cuts", near_plane_cuts},
    {"draw/telephoto", telephoto},
    {"draw/far_away", far_away},
    {"draw/wire_edges", wire_edges},
    {"draw/wire_back_edges", wire_back_edges},
    {"draw/wire_clip", wire_clip},
    {"draw/interfering", interfering},
    {0},
};
