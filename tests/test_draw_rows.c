/* SPDX-License-Identifier: MIT */
/* Pictures that are handed over row by row have the same pixels as a picture in memory. */
#include <string.h>

#include "lib/draw_scene.h"
#include "scene.h"
#include "lib/shapes.h"

#ifdef TEST_LONG
enum { FRAMES = 300 };
#else
enum { FRAMES = 12 };
#endif
enum { WIDTH = 109, HEIGHT = 80, BODIES = 33, MARK = 0x5a };

static const uint8_t bytes_each[] = {1, 2, 4, 0, 2}; /* bytes of a pixel, by format */

static _Alignas(8) uint8_t scene_world[CAROM_WORLD_BYTES(SCENE_CAPS)];
static _Alignas(8) uint8_t scene_workspace[CAROM_DRAW_BYTES(
    SCENE_HEAD_VERTICES + SCENE_FIELD_VERTICES, SCENE_HEAD_FACES + SCENE_FIELD_FACES)];
static uint32_t full[WIDTH * HEIGHT];

/*
 * A display that keeps what it receives. It has two rows, because its sender may be busy with the
 * last one.
 */
static struct panel {
    uint8_t pixels[WIDTH * HEIGHT * 4];
    uint32_t rows[2][WIDTH];
    uint8_t format;
    int now; /* the row that is drawn; -1 before the first */
    int32_t x0, x1, y;
    uint32_t area; /* pixels announced by the drawing */
} panel;

/* Take over the complete row. The memory beside its pixels must be as it was. */
static void take_row(void)
{
    const uint8_t *row = (const uint8_t *)panel.rows[panel.now];
    int32_t each = bytes_each[panel.format], from = panel.x0 * each, to = panel.x1 * each;
    int32_t beside = 0;

    for (int32_t i = 0; i < WIDTH * 4; i++) {
        beside += (i < from || i >= to) && row[i] != MARK;
    }
    CHECK_EQ(beside, 0);
    memcpy(panel.pixels + panel.y * WIDTH * each + from, row + from, (size_t)(to - from));
}

static void *next_row(void *context, int32_t x0, int32_t x1, int32_t y)
{
    CHECK_SAME(context, &panel);
    CHECK_AT_LEAST(x0, 0);
    CHECK_LESS(x0, x1);
    CHECK_AT_MOST(x1, WIDTH);
    CHECK_AT_LEAST(y, 0);
    CHECK_LESS(y, HEIGHT);
    if (panel.now >= 0) {
        take_row();
    }
    panel.now = panel.now == 0;
    panel.x0 = x0;
    panel.x1 = x1;
    panel.y = y;
    panel.area += (uint32_t)(x1 - x0);
    memset(panel.rows[panel.now], MARK, sizeof panel.rows[0]);
    return panel.rows[panel.now];
}

static struct carom_picture in_memory(uint8_t format)
{
    struct carom_picture picture = {.pixels = full,
                                    .width = WIDTH,
                                    .height = HEIGHT,
                                    .stride = WIDTH * bytes_each[format],
                                    .format = format,
                                    .workspace = scene_workspace,
                                    .workspace_bytes = sizeof scene_workspace};

    return picture;
}

static struct carom_picture by_rows(uint8_t format, size_t bytes)
{
    struct carom_picture picture = in_memory(format);

    picture.pixels = NULL;
    picture.stride = 0;
    picture.workspace_bytes = bytes;
    picture.row = next_row;
    picture.context = &panel;
    panel.format = format;
    panel.now = -1;
    panel.area = 0;
    return picture;
}

/* Check that the panel shows the picture. */
static void compare(const struct carom_picture *picture)
{
    take_row();
    CHECK_EQ(memcmp(panel.pixels, full, (size_t)(WIDTH * HEIGHT * bytes_each[picture->format])), 0);
}

static const struct carom_paint smooth = {.smooth = &carom_smooth};

static void compare_scene(const char *name, uint8_t format, size_t bytes,
                          const struct carom_paint *paint)
{
    static struct carom_drawn_body bodies[BODIES];
    struct carom_drawn drawn = {.bodies = bodies, .room = BODIES};
    struct carom_config config = scene_config();
    struct carom_world *world = NULL;
    struct scene scene;
    uint32_t less = 0;

    CHECK_EQ(scene_load(&scene, name, NULL, shape_scene_block, sizeof shape_scene_block), CAROM_OK);
    CHECK_EQ(scene_make(&scene, &config, scene_world, sizeof scene_world, &world), CAROM_OK);
    memset(panel.pixels, 0, sizeof panel.pixels);
    for (int frame = 1; frame <= FRAMES; frame++) {
        struct carom_picture whole = in_memory(format), rows = by_rows(format, bytes);

        whole.paint = rows.paint = paint;
        CHECK_AT_LEAST(carom_world_step(world), 0);
        CHECK_EQ(carom_draw(world, scene.camera, &whole, CAROM_DRAW_FLAT), CAROM_OK);
        if (frame % 2) {
            CHECK_EQ(carom_draw(world, scene.camera, &rows, CAROM_DRAW_FLAT), CAROM_OK);
            CHECK_AT_LEAST(panel.area, WIDTH * HEIGHT);
            compare(&whole);
            rows = by_rows(format, bytes);
            rows.paint = paint;
        }
        CHECK_EQ(carom_draw_changes(world, scene.camera, &rows, CAROM_DRAW_FLAT, &drawn), CAROM_OK);
        if (drawn.changed_count > 0) {
            compare(&whole);
        }
        less += panel.area < WIDTH * HEIGHT / 2;
    }
    /* the panel keeps its picture: few pixels are sent in most frames */
    CHECK(bytes < sizeof scene_workspace || less >= FRAMES / 2);
}

static void scenes(void)
{
    const size_t least = CAROM_DRAW_BYTES_LEAST(SCENE_FIELD_VERTICES, SCENE_FIELD_FACES);

    compare_scene("head", CAROM_RGB565, sizeof scene_workspace, NULL);
    compare_scene("head", CAROM_PALETTE8, 24000, NULL);
    compare_scene("head", CAROM_XRGB8888, least, NULL);
    compare_scene("head-spin2", CAROM_BGR555, 24000, NULL);
    compare_scene("head", CAROM_RGB565, sizeof scene_workspace, &smooth);
    compare_scene("head", CAROM_PALETTE8, 24000, &smooth);
}

static void asked_for(void)
{
    struct carom_picture picture;
    struct carom_world *world = new_world();

    add_scene(world);
    picture = by_rows(CAROM_RGB565, sizeof scene_workspace);
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_WIRE), CAROM_ERR_ARGUMENT);
    picture.format = CAROM_GREY4;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_ERR_ARGUMENT);
    CHECK_EQ(panel.now, -1);
    picture.format = CAROM_RGB565;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
    CHECK_EQ(panel.area, WIDTH * HEIGHT);
    picture.row = NULL;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_ERR_NULL);
}

/* Another display, or memory in place of a display, shows nothing yet. */
static void another_display(void)
{
    static struct carom_drawn_body bodies[BODIES];
    struct carom_drawn drawn = {.bodies = bodies, .room = BODIES};
    struct carom_world *world = new_world();
    struct carom_picture picture = by_rows(CAROM_PALETTE8, sizeof scene_workspace);

    add_scene(world);
    for (int i = 0; i < 2; i++) {
        CHECK_EQ(carom_draw_changes(world, &above, &picture, CAROM_DRAW_FLAT, &drawn), CAROM_OK);
        CHECK_EQ(panel.area, WIDTH * HEIGHT);
    }
    picture = in_memory(CAROM_PALETTE8);
    CHECK_EQ(carom_draw_changes(world, &above, &picture, CAROM_DRAW_FLAT, &drawn), CAROM_OK);
    CHECK_EQ(drawn.changed_count, 1);
    compare(&picture);
}

const struct test tests_draw_rows[] = {{"draw_rows/scenes", scenes},
                                       {"draw_rows/asked_for", asked_for},
                                       {"draw_rows/another_display", another_display},
                                       {0}};
