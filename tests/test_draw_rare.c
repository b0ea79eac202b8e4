/* SPDX-License-Identifier: MIT */
/*
 * What a picture rarely meets: views from anywhere, within bodies and along faces; more faces behind a pixel than the smallest
 * workspace holds; numbers at the ends of their ranges. A workspace may cost time, it never changes a pixel.
 */
#include "lib/draw_scene.h"

#ifdef TEST_LONG
enum { VIEWS = 400 };
#else
enum { VIEWS = 4 };
#endif
enum { LAYERS = 100 };

static uint8_t whole[SIZE][SIZE];
static _Alignas(8) uint8_t least_space[CAROM_DRAW_BYTES_LEAST(8, 12) + CAROM_SMOOTH_BYTES(8, 0)];

static int64_t anywhere(struct test_random *random, int64_t most)
{
    return test_random_range(random, -Q32(most, 1), Q32(most, 1));
}

/* Cubes and a plain, among which the camera stands anywhere; in parts or at once the picture is one. */
static void views(void)
{
    struct test_random random = {11};
    struct carom_paint paint = {.smooth = &carom_smooth, .horizon = true};

    for (int n = 0; n < VIEWS; n++) {
        struct carom_world *world = new_world();
        struct carom_camera camera = {.focal_q16 =
                                          (int32_t)test_random_range(&random, 1 << 12, 1 << 18)};
        struct carom_picture picture = picture_8();

        add(world, &plain, at(0, 0, -Q32(1, 1)), upright, false);
        for (int i = 0; i < 4; i++) {
            add(world, &cube, at(anywhere(&random, 2), anywhere(&random, 2), anywhere(&random, 1)),
                i % 2 ? oblique : upright, false);
        }
        for (int k = 0; k < 3; k++) {
            camera.eye.c[k] = anywhere(&random, 2);
            camera.target.c[k] = anywhere(&random, 2);
        }
        paint.crease_q30 = n % 2 ? 0 : -CAROM_ONE_Q30;
        picture.paint = n % 3 ? &paint : NULL;
        CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        memcpy(whole, pixels, sizeof whole);
        picture.workspace = least_space;
        picture.workspace_bytes = sizeof least_space;
        CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        CHECK_EQ(memcmp(whole, pixels, sizeof whole), 0);
    }
}

/* Flat pyramids one above the other, above one pixel of a plain: that one shows one of them, the others what lies there. */
static void stack(void)
{
    static int16_t corner[4 * LAYERS][3];
    static uint16_t face[4 * LAYERS][3];
    static _Alignas(8) uint8_t mesh_block[CAROM_MESH_BYTES(4 * LAYERS, 4 * LAYERS)];
    static _Alignas(8) uint8_t space[CAROM_DRAW_BYTES_LEAST(4 * LAYERS, 4 * LAYERS)];
    const struct carom_mesh_raw raw = {(const int16_t(*)[3])corner,
                                       (const uint16_t(*)[3])face,
                                       4 * LAYERS,
                                       4 * LAYERS,
                                       14,
                                       CAROM_SOLID};
    const struct carom_body_paint looks[] = {{NULL, 3}, {NULL, 5}};
    const struct carom_paint paint = {.bodies = looks, .body_count = 2};
    struct carom_world *world = new_world();
    struct carom_picture picture = picture_8();
    struct carom_mesh mesh;
    int here = 0;

    for (int i = 0; i < LAYERS; i++) {
        static const int16_t about[4][3] = {
            {-400, -300, 0}, {400, -300, 0}, {0, 500, 0}, {0, 0, 6}};
        static const uint16_t side[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

        for (int v = 0; v < 4; v++) {
            for (int k = 0; k < 3; k++) {
                corner[4 * i + v][k] = (int16_t)(about[v][k] + (k == 2 ? 8 * i : 0));
                face[4 * i + v][k] = (uint16_t)(4 * i + side[v][k]);
            }
        }
    }
    CHECK_EQ(carom_mesh_build(&mesh, &raw, mesh_block, sizeof mesh_block), CAROM_OK);
    add(world, &plain, at(0, 0, -Q32(1, 1)), upright, false);
    add(world, &mesh, at(Q32(1, 32), Q32(1, 32), 0), upright, false);
    picture.paint = &paint;
    picture.workspace = space;
    picture.workspace_bytes = sizeof space;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            CHECK(ramp_at(x, y) == 3 || ramp_at(x, y) == 5);
            here += ramp_at(x, y) == 5;
        }
    }
    /* a pyramid of 0.05 x 0.05 units, at 16 pixels a unit, a pixel right and up of the middle */
    CHECK_AT_LEAST(here, 1);
    CHECK_AT_MOST(here, 4);
    CHECK_EQ(ramp_at(SIZE / 2, SIZE / 2 - 1), 5);
}

/* Nearly straight up the horizon is far below the picture: all is sky, as it is straight up. */
static void zenith(void)
{
    const struct carom_paint paint = {.horizon = true};
    struct carom_world *world = new_world();
    struct carom_picture picture = picture_8();
    struct carom_camera camera = {.target = {{0, Q32(1, 2048), Q32(1, 1)}}, .focal_q16 = 16 << 16};

    picture.paint = &paint;
    for (int side = 0; side < 2; side++) {
        camera.target.c[1] = Q32(1, 2048);
        CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        memcpy(whole, pixels, sizeof whole);
        camera.target.c[1] = 0;
        CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        for (int y = 0; y < SIZE; y++) {
            CHECK_EQ(whole[y][0] / (DRAW_SHADES / 2), pixels[y][0] / (DRAW_SHADES / 2));
        }
        camera.target.c[2] = -camera.target.c[2]; /* all is ground */
    }
}

/* A mesh of the finest quantum, seen from the other end of the world, is not to be seen, and costs nothing else. */
static void far_away(void)
{
    static const int16_t corner[8][3] = BOX_CORNERS(1000, 1000, 1000);
    static _Alignas(8) uint8_t mesh_block[CAROM_MESH_BYTES(8, 12)];
    const struct carom_mesh_raw raw = {corner, box_faces, 8, 12, 20, CAROM_SOLID};
    struct carom_world *world = new_world();
    struct carom_camera camera = {.eye = {{Q32(16384, 1), Q32(16384, 1), Q32(16384, 1)}},
                                  .focal_q16 = 1 << 20};
    struct carom_mesh mesh;

    CHECK_EQ(carom_mesh_build(&mesh, &raw, mesh_block, sizeof mesh_block), CAROM_OK);
    draw_8(world, &camera, CAROM_DRAW_FLAT);
    memcpy(whole, pixels, sizeof whole);
    add(world, &mesh, at(-Q32(4096, 1), -Q32(4096, 1), -Q32(4096, 1)), upright, false);
    draw_8(world, &camera, CAROM_DRAW_FLAT);
    CHECK_EQ(memcmp(whole, pixels, sizeof whole), 0);
}

static void ranges(void)
{
    const carom_v3_q32 here = at(0, 0, 0), out = at(0, Q32(16384, 1) + 1, 0);
    struct carom_world *world = new_world();
    struct carom_picture picture = picture_8();
    struct carom_camera camera = above;

    CHECK_EQ(carom_draw_line(&camera, &picture, &out, &here, 1, NULL), CAROM_ERR_RANGE);
    CHECK_EQ(carom_draw_line(&camera, &picture, &here, &out, 1, NULL), CAROM_ERR_RANGE);
    camera.eye.c[1] = -Q32(16384, 1) - 1;
    CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_ERR_RANGE);
    camera = above;
    camera.target.c[1] = Q32(16384, 1) + 1;
    CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_ERR_RANGE);
}

/* Faces that interfered belong to a mesh that is gone; the one in its place has fewer. */
static void stale(void)
{
    struct carom_world *world = new_world();
    const struct carom_face_ref *refs;
    int high = 0;

    add(world, &cube, at(0, 0, 0), upright, false);
    add(world, &cube, at(Q32(1, 4), Q32(1, 8), Q32(1001, 1000)), upright, true);
    CHECK_AT_LEAST(carom_world_step(world), 0);
    CHECK_MORE(carom_interfering_faces(world, &refs), 0);
    for (int i = 0; i < carom_interfering_faces(world, &refs); i++) {
        high += refs[i].body == 0 && refs[i].face >= 2;
    }
    CHECK_MORE(high, 0);
    CHECK_EQ(carom_body_remove(world, 0), CAROM_OK);
    add(world, &square, at(0, 0, 0), upright, false);
    for (int k = 0; k < 2; k++) {
        draw_8(world, &above, styles[k]);
        CHECK_MORE(count_ramp(DRAW_MOVING) + count_ramp(DRAW_MOVING_HOT), 0);
        CHECK_EQ(carom_interfering_faces(world, &refs) >= high, true);
    }
}

const struct test tests_draw_rare[] = {
    {"draw_rare/views", views},
    {"draw_rare/stack", stack},
    {"draw_rare/zenith", zenith},
    {"draw_rare/far_away", far_away},
    {"draw_rare/ranges", ranges},
    {"draw_rare/stale", stale},
    {0},
};
