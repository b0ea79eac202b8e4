/* SPDX-License-Identifier: MIT */
/*
 * Lists of faces and vertices that are full by their 16-bit numbers though the workspace has room, and by the workspace: with fine
 * surfaces that fill the picture, lines over them, and shadows on them. Each picture is the one that a small workspace makes.
 */
#include "lib/draw_scene.h"
#include "lib/shapes.h"

#ifdef TEST_LONG

#define CELLS_MOST  180
#define VERTICES(n) (((n) + 1) * ((n) + 1))
#define FACES(n)    (2 * (n) * (n))
#define LINES       4096
enum { WIDE = 400 };

static int16_t corner[VERTICES(CELLS_MOST)][3];
static uint16_t side[FACES(CELLS_MOST)][3];
static _Alignas(8) uint8_t mesh_block[CAROM_MESH_BYTES(VERTICES(CELLS_MOST), FACES(CELLS_MOST))];
static _Alignas(8) uint8_t much[8 << 20];
static uint8_t first[WIDE][WIDE], second[WIDE][WIDE];
static struct carom_paint_line lines[LINES];

/* A surface of n x n squares over +-1.99 units, with heights that differ by up to `rough` of a cell. */
static void make_surface(struct carom_mesh *mesh, int n, int rough)
{
    const struct carom_mesh_raw raw = {(const int16_t(*)[3])corner,
                                       (const uint16_t(*)[3])side,
                                       (uint32_t)VERTICES(n),
                                       (uint32_t)FACES(n),
                                       12,
                                       CAROM_SURFACE};
    struct test_random random = {3};
    uint16_t(*face)[3] = side;

    for (int i = 0; i < VERTICES(n); i++) {
        corner[i][0] = (int16_t)((i % (n + 1) * 2 - n) * 8150 / n);
        corner[i][1] = (int16_t)((i / (n + 1) * 2 - n) * 8150 / n);
        corner[i][2] = (int16_t)test_random_range(&random, 0, rough);
    }
    for (int i = 0; i < n * n; i++) {
        const int a = i / n * (n + 1) + i % n, b = a + n + 1;
        const uint16_t two[2][3] = {{(uint16_t)a, (uint16_t)(a + 1), (uint16_t)b},
                                    {(uint16_t)(a + 1), (uint16_t)(b + 1), (uint16_t)b}};

        memcpy(face, two, sizeof two);
        face += 2;
    }
    CHECK_EQ(carom_mesh_build(mesh, &raw, mesh_block, sizeof mesh_block), CAROM_OK);
}

/* Draw with much room and with little; both pictures must be the same. */
static void compare(struct carom_world *world, const struct carom_paint *paint)
{
    struct carom_picture picture = picture_of_size(first, WIDE, WIDE, much, sizeof much);

    picture.paint = paint;
    memset(first, 1, sizeof first);
    memset(second, 2, sizeof second);
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
    picture.pixels = second;
    picture.workspace_bytes = 300000;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
    CHECK_EQ(memcmp(first, second, sizeof first), 0);
}

/* Lines from side to side above the surface, in many directions. */
static void make_lines(void)
{
    for (int i = 0; i < LINES; i++) {
        const int64_t x = Q32(1, 1500) * (i % 64 * 94 - 3000),
                      y = Q32(1, 1500) * (i / 64 * 94 - 3000);

        lines[i] =
            (struct carom_paint_line){.from = at(x, y, Q32(1, 2)),
                                      .to = at(x + Q32(i % 7 - 3, 50), y + Q32(1, 40), Q32(1, 2)),
                                      .colour = 40};
    }
}

static void vertices(void)
{
    struct carom_world *world = new_world();
    struct carom_mesh mesh;

    make_surface(&mesh, CELLS_MOST, 20); /* 32,761 of 32,768 vertices */
    add(world, &mesh, at(0, 0, 0), upright, false);
    compare(world, NULL);
}

static void faces(void)
{
    const struct carom_paint paint = {.smooth = &carom_smooth, .crease_q30 = -CAROM_ONE_Q30};
    struct carom_world *world = new_world();
    struct carom_mesh mesh;

    make_surface(&mesh, 131, 40); /* 34,322 faces, each with a tint, of 65,535 */
    add(world, &mesh, at(0, 0, 0), upright, false);
    compare(world, &paint);
}

static void lines_over(void)
{
    struct carom_paint paint = {.lines = lines, .line_count = LINES};
    struct carom_world *world = new_world();
    struct carom_mesh mesh;

    make_lines();
    make_surface(&mesh, 140, 20); /* 19,881 vertices; the lines have 16,384 */
    add(world, &mesh, at(0, 0, 0), upright, false);
    compare(world, &paint);
    world = new_world();
    paint.smooth = &carom_smooth;
    paint.crease_q30 = -CAROM_ONE_Q30;
    make_surface(&mesh, 125, 40); /* 62,500 faces and tints; the lines have 8,192 */
    add(world, &mesh, at(0, 0, 0), upright, false);
    compare(world, &paint);
}

static void shadows(void)
{
    struct carom_paint paint = {.shadows = &carom_shadows};
    struct carom_world *world = new_world();
    struct carom_mesh mesh;

    make_surface(&mesh, 160, 20); /* 25,921 vertices, and six more for each face in shadow */
    add(world, &mesh, at(0, 0, 0), upright, false);
    add(world, &cube, at(-Q32(1, 1), 0, Q32(3, 2)), oblique, false);
    compare(world, &paint);
    world = new_world();
    paint.smooth = &carom_smooth;
    paint.crease_q30 = -CAROM_ONE_Q30;
    make_surface(&mesh, 125,
                 40); /* 62,500 faces and tints, and three more for each face in shadow */
    add(world, &mesh, at(0, 0, 0), upright, false);
    add(world, &cube, at(-Q32(1, 1), 0, Q32(3, 2)), oblique, false);
    compare(world, &paint);
}

enum { MORE_LINES = 30, MORE_BYTES = 152 };
#else
enum { MORE_LINES = 120, MORE_BYTES = 5000 };
#endif

static uint8_t whole[SIZE][SIZE];

/*
 * Lines through one point, more than a small workspace holds, even for a pixel: each pixel shows a line, the square under them, or the
 * background.
 */
static void knot(void)
{
    enum { MOST = 400 };
    static struct carom_paint_line many[MOST];
    static _Alignas(8) uint8_t least[CAROM_DRAW_BYTES_LEAST(4, 2)], large[12288 + 100 * MOST];
    static uint8_t bare[SIZE][SIZE], ground[SIZE][SIZE];
    struct carom_paint paint = {.lines = many};
    struct carom_world *world = new_world();
    struct carom_picture picture = picture_8();

    for (int i = 0; i < MOST; i++) { /* from side to side of a square */
        const int64_t along = Q32(i / 2 - 100, 100);
        const carom_v3_q32 end = i % 2 ? at(Q32(1, 1), along, 0) : at(along, Q32(1, 1), 0);

        many[i] =
            (struct carom_paint_line){.from = end, .to = at(-end.c[0], -end.c[1], 0), .colour = 40};
    }
    draw_8(world, &above, CAROM_DRAW_FLAT);
    memcpy(ground, pixels, sizeof ground);
    add(world, &square, at(0, 0, -Q32(1, 2)), upright, false);
    draw_8(world, &above, CAROM_DRAW_FLAT);
    memcpy(bare, pixels, sizeof bare);
    picture.paint = &paint;
    for (paint.line_count = 10; paint.line_count <= MOST; paint.line_count += MORE_LINES) {
        int shown = 0, hidden = 0;

        picture.workspace = large;
        picture.workspace_bytes = sizeof large;
        CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        memcpy(whole, pixels, sizeof whole);
        picture.workspace = least;
        picture.workspace_bytes = sizeof least;
        CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                CHECK(pixels[y][x] == 40 || pixels[y][x] == bare[y][x] ||
                      pixels[y][x] == ground[y][x]);
                shown += pixels[y][x] == 40;
                hidden += pixels[y][x] != whole[y][x];
            }
        }
        CHECK_MORE(shown, 40);
        CHECK(paint.line_count > 20 || hidden == 0);
    }
}

/* Shadows of balls on a plain that the guard band cuts, in workspaces that hold an outline: their size never changes a pixel. */
static void little(void)
{
    static struct shape ball;
    static _Alignas(8) uint8_t space[60000];
    const struct carom_paint paint = {.shadows = &carom_shadows};
    const struct carom_camera low = {
        .eye = {{-Q32(2, 1), 0, -Q32(1, 2)}}, .target = {{0, 0, -Q32(1, 2)}}, .focal_q16 = 1 << 15};
    struct carom_world *world = new_world();
    struct carom_picture picture = picture_8();

    shape_ball(&ball, 12, 2000);
    add(world, &plain, at(0, 0, -Q32(1, 1)), upright, false);
    for (int i = 0; i < 5; i++) {
        add(world, &ball.mesh, at(Q32(i - 3, 2), Q32(i % 2 * 2 - 1, 1), Q32(i, 8)), oblique, false);
    }
    picture.paint = &paint;
    picture.workspace = space;
    picture.workspace_bytes = sizeof space;
    CHECK_EQ(carom_draw(world, &low, &picture, CAROM_DRAW_FLAT), CAROM_OK);
    memcpy(whole, pixels, sizeof whole);
    for (size_t bytes = 36000; bytes < sizeof space; bytes += MORE_BYTES) {
        picture.workspace_bytes = bytes;
        CHECK_EQ(carom_draw(world, &low, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        CHECK_EQ(memcmp(whole, pixels, sizeof whole), 0);
    }
}

const struct test tests_draw_full[] = {
#ifdef TEST_LONG
    {"draw_full/vertices", vertices}, {"draw_full/faces", faces},   {"draw_full/lines", lines_over},
    {"draw_full/shadows", shadows},
#endif
    {"draw_full/knot", knot},         {"draw_full/little", little}, {0},
};
