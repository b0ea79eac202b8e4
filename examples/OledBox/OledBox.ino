/* SPDX-License-Identifier: MIT */
/*
 * A box falls on an OLED of 128 x 64 pixels: an SSD1306 at address 0x3c of the I2C bus. The picture
 * is drawn row by row, so that no memory holds all of its shades; only show_page() knows the
 * display.
 */
#include <Wire.h>
#include <carom_draw.h>

#define WIDTH   128
#define HEIGHT  64
#define ADDRESS 0x3c
#define FPS     30

/* ---------------------------------------------------------------- the display */

static void command(uint8_t byte)
{
    Wire.beginTransmission(ADDRESS);
    Wire.write((uint8_t)0x00);
    Wire.write(byte);
    Wire.endTransmission();
}

static void begin_display()
{
    static const uint8_t commands[] = {0xae, 0x20, 0x02, 0xa1, 0xc8, 0x8d, 0x14, 0xaf};

    Wire.begin();
    for (uint8_t byte : commands) {
        command(byte);
    }
}

/* Send eight rows of the display: a byte a column, with the upper row in its lowest bit. */
static void show_page(int page, const uint8_t columns[WIDTH])
{
    command(0xb0 | page);
    command(0x00);
    command(0x10);
    for (int x = 0; x < WIDTH; x += 16) {
        Wire.beginTransmission(ADDRESS);
        Wire.write((uint8_t)0x40);
        Wire.write(columns + x, 16);
        Wire.endTransmission();
    }
}

/* ---------------------------------------------------------------- the picture */

static uint8_t row[WIDTH], pages[HEIGHT / 8][WIDTH];
static int32_t drawn = -1; /* the row that is being drawn */

/* The light comes from above, so that the box's sides differ: its top is white, and the side that looks away from the light black. */
static carom_paint paint()
{
    carom_paint paint = {};

    paint.light.c[0] = -3;
    paint.light.c[1] = -4;
    paint.light.c[2] = 8;
    return paint;
}

/* The brightness of a pixel, 0 .. 32: the sky is black, and the ground is darker than the box. */
static int brightness(int pixel)
{
    const int ramp = pixel / 32, shade = pixel % 32;

    return ramp == 0 ? 0 : ramp % 2 == 1 ? 3 : 2 * (shade - 12);
}

/* Keep the complete row, in black and white. */
static void keep_row()
{
    static const uint8_t order[4][4] = {{0, 16, 4, 20}, {24, 8, 28, 12}, {6, 22, 2, 18}, {30, 14, 26, 10}};

    for (int x = 0; drawn >= 0 && x < WIDTH; x++) {
        bitWrite(pages[drawn / 8][x], drawn % 8, brightness(row[x]) > order[drawn & 3][x & 3]);
    }
}

static void *next_row(void *, int32_t, int32_t, int32_t y)
{
    keep_row();
    drawn = y;
    return row;
}

/* ------------------------------------------------------------------ the world */

static const int16_t corners[8][3] = {{-64, -51, -38}, {64, -51, -38}, {64, 51, -38}, {-64, 51, -38},
                                      {-64, -51, 38},  {64, -51, 38},  {64, 51, 38},  {-64, 51, 38}};
static const uint16_t sides[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                      {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
static const int16_t far_corners[4][3] = {{-256, -256, 0}, {256, -256, 0}, {256, 256, 0}, {-256, 256, 0}};
static const uint16_t far_sides[2][3] = {{0, 1, 2}, {0, 2, 3}};
static const carom_mesh_raw box = {corners, sides, 8, 12, 8, CAROM_SOLID};
static const carom_mesh_raw flat = {far_corners, far_sides, 4, 2, 8, CAROM_SURFACE};

#define CAPS 2, 1, 8, 8, 0, 32 /* bodies, pairs, contacts, faces, entries, candidates */
alignas(8) static uint8_t block[CAROM_WORLD_BYTES(CAPS)], room[CAROM_DRAW_BYTES(12, 14)];
alignas(8) static uint8_t box_block[CAROM_MESH_BYTES(8, 12)], flat_block[CAROM_MESH_BYTES(4, 2)];
static carom_mesh meshes[2];
static carom_world *world;

static void begin_again()
{
    carom_config config = {};
    carom_body_def ground = {}, body = {};

    config.caps = CAROM_CAPS(CAPS);
    config.gravity.c[2] = CAROM_GRAVITY_MM_S2(-9810, FPS);
    config.sleep = true;
    carom_world_init(block, sizeof block, &config, &world);
    ground.mesh = &meshes[0];
    ground.stationary = true;
    carom_body_add(world, &ground);
    body.mesh = &meshes[1];
    body.position.c[2] = CAROM_POSITION_MM(1000);
    body.spin.c[0] = CAROM_SPIN_DEG_S(70, FPS);
    body.spin.c[1] = CAROM_SPIN_DEG_S(40, FPS);
    body.restitution_q30 = CAROM_ONE_Q30 / 2;
    body.friction_q16 = 1 << 15;
    carom_body_add(world, &body);
}

void setup()
{
    begin_display();
    carom_mesh_build(&meshes[0], &flat, flat_block, sizeof flat_block);
    carom_mesh_build(&meshes[1], &box, box_block, sizeof box_block);
    begin_again();
}

void loop()
{
    static const carom_camera camera = {{{CAROM_POSITION_MM(400), CAROM_POSITION_MM(-1300), CAROM_POSITION_MM(900)}},
                                        {{0, 0, CAROM_POSITION_MM(400)}}, 1 << 16};
    static const carom_paint light = paint();
    carom_picture picture = {};
    carom_body_state state;

    carom_world_step(world);
    picture.width = WIDTH;
    picture.height = HEIGHT;
    picture.format = CAROM_PALETTE8;
    picture.workspace = room;
    picture.workspace_bytes = sizeof room;
    picture.row = next_row;
    picture.paint = &light;
    drawn = -1;
    carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT);
    keep_row();
    for (int page = 0; page < HEIGHT / 8; page++) {
        show_page(page, pages[page]);
    }
    carom_body_get(world, 1, &state);
    if (state.asleep) {
        delay(1000);
        begin_again();
    }
}
