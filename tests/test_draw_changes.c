/* SPDX-License-Identifier: MIT */
/*
 * carom_draw_changes: it makes the same pixels as carom_draw, and writes no pixels outside of the
 * area that it reports.
 */
#include <string.h>

#include "lib/draw_scene.h"
#include "scene.h"
#include "lib/shapes.h"

#ifdef TEST_LONG
enum { FRAMES = 240 };
#else
enum { FRAMES = 10 };
#endif
enum { EACH = 24, SOME = 5 }; /* so many frames are all drawn, and then every fifth */
enum { WIDTH = 109, HEIGHT = 80, BODIES = 33 };

static const uint8_t bits[] = {8, 16, 32, 4, 16}; /* bits of a pixel, by format */

static _Alignas(8) uint8_t scene_world[CAROM_WORLD_BYTES(SCENE_PILE_CAPS)];
static _Alignas(8) uint8_t scene_workspace[CAROM_DRAW_BYTES(
    SCENE_HEAD_VERTICES + SCENE_FIELD_VERTICES, SCENE_HEAD_FACES + SCENE_FIELD_FACES)];
static uint32_t full[WIDTH * HEIGHT], buffers[2][WIDTH * HEIGHT];
static struct carom_drawn_body drawn_bodies[2][BODIES];
static struct carom_drawn drawn[2];
static struct scene scene;

static void forget(void)
{
    for (int k = 0; k < 2; k++) {
        drawn[k] = (struct carom_drawn){.bodies = drawn_bodies[k], .room = BODIES};
    }
}

static struct carom_picture picture_of(void *to, uint8_t format, size_t bytes)
{
    struct carom_picture picture = {.pixels = to,
                                    .width = WIDTH,
                                    .height = HEIGHT,
                                    .stride = (WIDTH * bits[format] + 31) / 32 * 4,
                                    .format = format,
                                    .workspace = scene_workspace,
                                    .workspace_bytes = bytes};

    return picture;
}

/* ------------------------------------------------------------- whole scenes */

static const struct carom_paint shaded = {.shadows = &carom_shadows};
static const struct carom_paint smooth = {.smooth = &carom_smooth};
static const struct carom_paint both = {
    .shadows = &carom_shadows, .smooth = &carom_smooth, .horizon = true};

/* Frames of a scene in two alternating buffers; each buffer must hold a full picture. */
static void compare_scene(const char *name, uint8_t format, enum carom_draw_style style,
                          size_t bytes, const struct carom_paint *paint)
{
    struct carom_config config = scene_config();
    struct carom_world *world = NULL;
    uint32_t less = 0, changed = 0, shown = 0;

    CHECK_EQ(scene_load(&scene, name, NULL, shape_scene_block, sizeof shape_scene_block), CAROM_OK);
    config.caps = scene.caps;
    CHECK_EQ(scene_make(&scene, &config, scene_world, sizeof scene_world, &world), CAROM_OK);
    forget();
    memset(buffers, 0, sizeof buffers);
    for (int frame = 1; frame <= FRAMES; frame++) {
        struct carom_picture picture = picture_of(full, format, sizeof scene_workspace);
        int k = shown % 2;

        CHECK_AT_LEAST(scene_before(&scene, world, frame), 0);
        CHECK_AT_LEAST(carom_world_step(world), 0);
        if (frame > EACH && frame % SOME != 0) {
            continue;
        }
        shown++;
        picture.paint = paint;
        memset(full, 0, sizeof full);
        CHECK_EQ(carom_draw(world, scene.camera, &picture, style), CAROM_OK);
        picture = picture_of(buffers[k], format, bytes);
        picture.paint = paint;
        CHECK_EQ(carom_draw_changes(world, scene.camera, &picture, style, &drawn[k]), CAROM_OK);
        CHECK_EQ(memcmp(full, buffers[k], sizeof full), 0);
        changed += drawn[k].changed_count > 0;
        for (int i = 0; i < drawn[k].changed_count; i++) {
            const struct carom_rect *r = &drawn[k].changed[i];

            CHECK_AT_LEAST(r->x0, 0);
            CHECK_AT_LEAST(r->y0, 0);
            CHECK_AT_MOST(r->x1, WIDTH);
            CHECK_AT_MOST(r->y1, HEIGHT);
            less += drawn[k].changed_count == 1 &&
                    (r->x1 - r->x0) * (r->y1 - r->y0) < WIDTH * HEIGHT / 2;
        }
    }
    /* one head changes less than half of the picture, while it moves at all */
    CHECK(paint || strcmp(name, "head") != 0 || (changed >= shown / 4 && less >= changed / 2));
}

static void scenes(void)
{
    const size_t least = CAROM_DRAW_BYTES_LEAST(SCENE_FIELD_VERTICES, SCENE_FIELD_FACES);

    compare_scene("head", CAROM_PALETTE8, CAROM_DRAW_FLAT, sizeof scene_workspace, NULL);
    compare_scene("head", CAROM_GREY4, CAROM_DRAW_WIRE, least, NULL);
    compare_scene("pile", CAROM_BGR555, CAROM_DRAW_FLAT, 24000, NULL);
    compare_scene("pile", CAROM_XRGB8888, CAROM_DRAW_WIRE, sizeof scene_workspace, NULL);
    compare_scene("head", CAROM_PALETTE8, CAROM_DRAW_FLAT, sizeof scene_workspace, &shaded);
    compare_scene("pile", CAROM_XRGB8888, CAROM_DRAW_FLAT, sizeof scene_workspace, &shaded);
    compare_scene("pile", CAROM_GREY4, CAROM_DRAW_FLAT, 60000, &shaded);
    compare_scene("head", CAROM_PALETTE8, CAROM_DRAW_FLAT, sizeof scene_workspace, &smooth);
    compare_scene("head", CAROM_GREY4, CAROM_DRAW_FLAT, 24000, &smooth);
    compare_scene("pile", CAROM_BGR555, CAROM_DRAW_FLAT, 60000, &both);
#ifndef SCENE_ROM /* a board whose scenes are in ROM lacks these */
    compare_scene("head-spin2", CAROM_GREY4, CAROM_DRAW_FLAT, 24000, NULL);
    compare_scene("sheet", CAROM_RGB565, CAROM_DRAW_FLAT, sizeof scene_workspace, NULL);
    compare_scene("car", CAROM_RGB565, CAROM_DRAW_FLAT, sizeof scene_workspace, &shaded);
    compare_scene("sheet", CAROM_RGB565, CAROM_DRAW_FLAT, sizeof scene_workspace, &smooth);
    compare_scene("car", CAROM_XRGB8888, CAROM_DRAW_FLAT, sizeof scene_workspace, &both);
#endif
}

/* -------------------------------------------------------------- what changes */

static struct carom_world *world_now_drawn;

/*
 * Draw the changes and compare with a full picture; returns the largest number of changed pixels.
 */
static int32_t draw_again(const struct carom_camera *camera, struct carom_picture *picture,
                          enum carom_draw_style style)
{
    struct carom_picture whole = *picture;
    int32_t area = 0;

    whole.pixels = full;
    memset(full, 0, sizeof full);
    CHECK_EQ(carom_draw(world_now_drawn, camera, &whole, style), CAROM_OK);
    CHECK_EQ(carom_draw_changes(world_now_drawn, camera, picture, style, &drawn[0]), CAROM_OK);
    for (int32_t y = 0; y < picture->height; y++) {
        const uint8_t *a = (const uint8_t *)full + y * picture->stride;
        const uint8_t *b = (const uint8_t *)picture->pixels + y * picture->stride;

        CHECK_EQ(memcmp(a, b, (size_t)(picture->width * bits[picture->format] / 8)), 0);
    }
    for (int i = 0; i < drawn[0].changed_count; i++) {
        const struct carom_rect *r = &drawn[0].changed[i];

        area += (r->x1 - r->x0) * (r->y1 - r->y0);
    }
    return area;
}

/* A plain, a stationary cube on the left, a moving one on the right. */
static struct carom_picture new_picture(void)
{
    world_now_drawn = new_world();
    add(world_now_drawn, &plain, at(0, 0, Q32(-1, 1)), upright, false);
    add(world_now_drawn, &cube, at(Q32(-1, 1), 0, 0), oblique, false);
    add(world_now_drawn, &cube, at(Q32(1, 1), Q32(1, 2), 0), oblique, true);
    forget();
    memset(buffers, 0, sizeof buffers);
    return picture_of(buffers[0], CAROM_PALETTE8, sizeof scene_workspace);
}

static void move(int body, int64_t x, int64_t z)
{
    struct carom_body_state state;

    CHECK_EQ(carom_body_get(world_now_drawn, body, &state), CAROM_OK);
    state.position.c[0] += x;
    state.position.c[2] += z;
    CHECK_EQ(carom_body_set(world_now_drawn, body, &state), CAROM_OK);
}

/* Draw an area between low and high, then a picture without changes. */
#define EXPECT_AREA(low, high)                                                                     \
    do {                                                                                           \
        int32_t area = draw_again(&camera, &picture, style);                                       \
        CHECK(area >= (low) && area <= (high));                                                    \
        CHECK_EQ(draw_again(&camera, &picture, style), 0);                                         \
    } while (0)

/* At z = 0 a unit is HEIGHT / 4 = 20 pixels: a cube with its corners is less than 42 x 42. */
static void noticed(void)
{
    enum { ALL = WIDTH * HEIGHT, ONE = 42 * 42 };

    for (int k = 0; k < 2; k++) {
        enum carom_draw_style style = styles[k];
        struct carom_picture picture = new_picture();
        struct carom_camera camera = above;
        struct carom_body_def def = {.mesh = &cube, .position = at(0, 0, 0), .rotation = upright};

        EXPECT_AREA(ALL, ALL);
        /* a moving body: a little, then out of the picture */
        move(2, Q32(1, 16), 0);
        EXPECT_AREA(20 * 20, 2 * ONE);
        move(2, Q32(100, 1), 0);
        EXPECT_AREA(20 * 20, ONE);
        move(2, Q32(1, 1), 0);
        EXPECT_AREA(0, 0);
        move(2, Q32(-101, 1), 0);
        EXPECT_AREA(20 * 20, ONE);
        /* a stationary body: its earlier extent is not known at first */
        move(1, Q32(1, 16), 0);
        EXPECT_AREA(20 * 20, ALL);
        move(1, Q32(1, 16), 0);
        EXPECT_AREA(20 * 20, 2 * ONE);
        /* so near that the near plane cuts it, and away again */
        move(1, 0, Q32(4, 1));
        EXPECT_AREA(ALL, 2 * ALL);
        move(1, 0, Q32(-4, 1));
        EXPECT_AREA(ALL, 2 * ALL);
        /* one body goes, one comes, another takes the place of that one */
        def.overlap = CAROM_OVERLAP_PASS;
        CHECK_EQ(carom_body_remove(world_now_drawn, 1), CAROM_OK);
        EXPECT_AREA(20 * 20, ONE);
        CHECK_EQ(carom_body_add(world_now_drawn, &def), 1);
        EXPECT_AREA(20 * 20, ONE);
        CHECK_EQ(carom_body_remove(world_now_drawn, 1), CAROM_OK);
        def.stationary = true;
        CHECK_EQ(carom_body_add(world_now_drawn, &def), 1);
        EXPECT_AREA(20 * 20, 2 * ONE);
        CHECK_EQ(carom_body_remove(world_now_drawn, 2), CAROM_OK);
        EXPECT_AREA(20 * 20, ONE);
        /* everything else that a picture depends on */
        camera.eye.c[0]++;
        EXPECT_AREA(ALL, ALL);
        camera.target.c[1]++;
        EXPECT_AREA(ALL, ALL);
        camera.focal_q16++;
        EXPECT_AREA(ALL, ALL);
        style = styles[1 - k];
        EXPECT_AREA(ALL, ALL);
        picture.height--;
        EXPECT_AREA(ALL - WIDTH, ALL - WIDTH);
        picture.pixels = buffers[1];
        EXPECT_AREA(ALL - WIDTH, ALL - WIDTH);
        picture.format = CAROM_RGB565;
        picture.stride *= 2;
        EXPECT_AREA(ALL - WIDTH, ALL - WIDTH);
        drawn[0].shows = false;
        EXPECT_AREA(ALL - WIDTH, ALL - WIDTH);
    }
}

/* Each thing that a paint says is noticed, and each thing of the picture itself. */
static void paints(void)
{
    enum { ALL = WIDTH * HEIGHT };
    static uint32_t palette[2][16 * DRAW_SHADES];
    const enum carom_draw_style style = CAROM_DRAW_FLAT;
    const struct carom_camera camera = above;
    struct carom_picture picture = new_picture();
    struct carom_paint paint = {.ambient_q30 = CAROM_ONE_Q30 / 4};

    picture = picture_of(buffers[0], CAROM_XRGB8888, sizeof scene_workspace);
    for (int i = 0; i < 2; i++) {
        for (uint32_t k = 0; k < 16 * DRAW_SHADES; k++) {
            palette[i][k] = 0x10101 * (k / 2 + (uint32_t)i);
        }
    }
    EXPECT_AREA(ALL, ALL);
    picture.paint = &paint;
    EXPECT_AREA(ALL, ALL);
    paint.ambient_q30 = CAROM_ONE_Q30 / 8;
    EXPECT_AREA(ALL, ALL);
    paint.light = (carom_v3_q30){{1, 2, 3}};
    EXPECT_AREA(ALL, ALL);
    paint.palette = palette[0];
    paint.ramps = 16;
    EXPECT_AREA(ALL, ALL);
    paint.ramps = 12;
    EXPECT_AREA(ALL, ALL);
    paint.palette = palette[1];
    EXPECT_AREA(ALL, ALL);
    paint.interfering_ramp = 9;
    EXPECT_AREA(ALL, ALL);
    paint.hide_interfering = true;
    EXPECT_AREA(ALL, ALL);
    paint.horizon = true;
    EXPECT_AREA(ALL, ALL);
    paint.shadows = &carom_shadows;
    EXPECT_AREA(ALL, ALL);
    paint.smooth = &carom_smooth;
    EXPECT_AREA(ALL, ALL);
    paint.crease_q30 = CAROM_ONE_Q30 / 2;
    EXPECT_AREA(ALL, ALL);
    picture.paint = NULL;
    EXPECT_AREA(ALL, ALL);
    picture.width -= 2;
    EXPECT_AREA(ALL - 2 * HEIGHT, ALL - 2 * HEIGHT);
    picture.format = CAROM_RGB565; /* in rows of the same length */
    EXPECT_AREA(ALL - 2 * HEIGHT, ALL - 2 * HEIGHT);
}

/* Bodies turn without going anywhere, more of them than rectangles are kept; then a world of fewer bodies takes their place. */
static void many(void)
{
    enum { ALL = WIDTH * HEIGHT };
    static _Alignas(8) uint8_t mesh_block[CAROM_MESH_BYTES(8, 12)];
    static int16_t corner[8][3] = BOX_CORNERS(2048, 2048, 2048);
    const struct carom_mesh_raw raw = {
        (const int16_t(*)[3])corner, box_faces, 8, 12, 15, CAROM_SOLID}; /* of 1/8: some 4 pixels */
    const struct carom_config config = {.caps = CAROM_CAPS(SCENE_PILE_CAPS)};
    const enum carom_draw_style style = CAROM_DRAW_FLAT;
    const struct carom_camera camera = above;
    struct carom_picture picture = picture_of(buffers[0], CAROM_PALETTE8, sizeof scene_workspace);
    struct carom_body_state state;
    struct carom_mesh tiny;

    CHECK_EQ(carom_mesh_build(&tiny, &raw, mesh_block, sizeof mesh_block), CAROM_OK);
    CHECK_EQ(carom_world_init(scene_world, sizeof scene_world, &config, &world_now_drawn),
             CAROM_OK);
    for (int i = 0; i < 12; i++) { /* 3 rows of 4, further apart than rectangles merge */
        add(world_now_drawn, &tiny, at(Q32(3 * (i % 4) - 4, 3), Q32(i / 4 * 5 - 5, 4), 0), oblique,
            true);
    }
    forget();
    memset(buffers, 0, sizeof buffers);
    EXPECT_AREA(ALL, ALL);
    for (int i = 0; i < 12; i++) {
        CHECK_EQ(carom_body_get(world_now_drawn, i, &state), CAROM_OK);
        state.rotation = upright;
        CHECK_EQ(carom_body_set(world_now_drawn, i, &state), CAROM_OK);
    }
    EXPECT_AREA(12 * 4, ALL);
    world_now_drawn = new_world();
    add(world_now_drawn, &cube, at(0, 0, 0), oblique, true);
    EXPECT_AREA(20 * 20, 2 * ALL);
    CHECK_EQ(drawn[0].count, 1);
}

/* A surface takes another shape; interfering faces come and go. */
static void shapes_and_faces(void)
{
    static _Alignas(8) uint8_t memory[CAROM_SURFACE_BYTES(4, 2)];
    static const int16_t lower[][3] = {
        {-4096, -4096, -409}, {4096, -4096, -409}, {4096, 4096, -409}, {-4096, 4096, -409}};
    const struct carom_mesh_raw raw = {square_vertices, square_faces, 4, 2, 12, CAROM_SURFACE};
    struct carom_picture picture = new_picture();
    const struct carom_face_ref *refs;
    struct carom_mesh sheet;
    struct carom_body_state state;

    CHECK_EQ(carom_surface_build(&sheet, &raw, memory, sizeof memory), CAROM_OK);
    world_now_drawn = new_world();
    add(world_now_drawn, &sheet, at(0, 0, 0), upright, false);
    add(world_now_drawn, &cube, at(Q32(1, 2), Q32(-1, 4), Q32(502, 1000)), upright, true);
    draw_again(&above, &picture, CAROM_DRAW_FLAT);
    CHECK_AT_LEAST(carom_world_step(world_now_drawn), 0);
    CHECK_MORE(carom_interfering_faces(world_now_drawn, &refs), 0);
    CHECK_MORE(draw_again(&above, &picture, CAROM_DRAW_FLAT), 0);
    /* nothing moves, but faces interfere: they are drawn again, and once more when they no longer
     * do */
    CHECK_MORE(draw_again(&above, &picture, CAROM_DRAW_FLAT), 0);
    CHECK_EQ(carom_body_get(world_now_drawn, 1, &state), CAROM_OK);
    state.position.c[2] = Q32(2, 1);
    CHECK_EQ(carom_body_set(world_now_drawn, 1, &state), CAROM_OK);
    CHECK_AT_LEAST(carom_world_step(world_now_drawn), 0);
    CHECK_MORE(draw_again(&above, &picture, CAROM_DRAW_FLAT), 0);
    CHECK_EQ(carom_interfering_faces(world_now_drawn, &refs), 0);
    draw_again(&above, &picture, CAROM_DRAW_FLAT);
    CHECK_EQ(draw_again(&above, &picture, CAROM_DRAW_FLAT), 0);
    CHECK_EQ(carom_surface_move(world_now_drawn, 0, lower), CAROM_OK);
    CHECK_MORE(draw_again(&above, &picture, CAROM_DRAW_FLAT), 0);
    CHECK_EQ(draw_again(&above, &picture, CAROM_DRAW_FLAT), 0);
}

/* No pixel outside of the reported changes is written. */
static void only_that(void)
{
    for (uint8_t format = 0; format < sizeof bits; format++) {
        struct carom_picture picture = new_picture();
        const struct carom_rect *r = drawn[0].changed;
        uint8_t *bytes = (uint8_t *)buffers[0];

        picture = picture_of(buffers[0], format, sizeof scene_workspace);
        draw_again(&above, &picture, CAROM_DRAW_FLAT);
        for (int shift = 0; shift < 8; shift++) { /* odd and even edges */
            move(2, Q32(shift % 2 ? 3 : -2, 64), 0);
            memset(buffers[0], 0xee, sizeof buffers[0]);
            CHECK_EQ(
                carom_draw_changes(world_now_drawn, &above, &picture, CAROM_DRAW_FLAT, &drawn[0]),
                CAROM_OK);
            CHECK_EQ(drawn[0].changed_count, 1);
            for (int32_t y = 0; y < HEIGHT; y++) {
                for (int32_t x = 0; x < picture.stride * 8 / bits[format]; x++) {
                    const uint8_t *p = &bytes[y * picture.stride + x * bits[format] / 8];
                    bool inside = x >= r->x0 && x < r->x1 && y >= r->y0 && y < r->y1;
                    bool kept = bits[format] == 4 ? (x & 1 ? *p & 15 : *p >> 4) == 14 : *p == 0xee;

                    CHECK(inside || kept);
                }
            }
        }
    }
}

static void errors(void)
{
    struct carom_picture picture = new_picture();
    struct carom_camera camera = above;
    enum carom_draw_style style = CAROM_DRAW_FLAT;

#define EXPECT_ERROR(error, d)                                                                     \
    CHECK_EQ(carom_draw_changes(world_now_drawn, &camera, &picture, style, d), error)
    EXPECT_ERROR(CAROM_ERR_NULL, NULL);
    drawn[0].bodies = NULL;
    EXPECT_ERROR(CAROM_ERR_NULL, &drawn[0]);
    drawn[0].bodies = drawn_bodies[0];
    drawn[0].room = 2;
    EXPECT_ERROR(CAROM_ERR_MEMORY, &drawn[0]);
    drawn[0].room = 3;
    picture.width = 0;
    EXPECT_ERROR(CAROM_ERR_ARGUMENT, &drawn[0]);
    picture.width = WIDTH;
    camera.target = camera.eye;
    EXPECT_ERROR(CAROM_ERR_ARGUMENT, &drawn[0]);
    camera = above;
    CHECK_MORE(draw_again(&camera, &picture, style), 0);
    /* after a picture that could not be drawn, the next one is drawn whole */
    move(2, Q32(1, 16), 0);
    picture.workspace_bytes = 100;
    EXPECT_ERROR(CAROM_ERR_MEMORY, &drawn[0]);
    picture.workspace_bytes = sizeof scene_workspace;
    EXPECT_AREA(WIDTH * HEIGHT, WIDTH * HEIGHT);
#undef EXPECT_ERROR
}

const struct test tests_draw_changes[] = {
    {"draw_changes/scenes", scenes},
    {"draw_changes/noticed", noticed},
    {"draw_changes/paints", paints},
    {"draw_changes/many", many},
    {"draw_changes/shapes_and_faces", shapes_and_faces},
    {"draw_changes/only_that", only_that},
    {"draw_changes/errors", errors},
    {0},
};
