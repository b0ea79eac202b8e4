/* SPDX-License-Identifier: MIT */
/*
 * The ray of a pixel: in the middle and at the corners by hand. A picked body is the one that was
 * drawn there, by the colours of random pictures.
 */
#include "lib/draw_scene.h"

#ifdef TEST_LONG
#define PICTURES 400
#else
#define PICTURES 6
#endif

/* Straight down from 4 units: a pixel is 1/16 unit at z = 0, x to the right and y up the page. */
static void test_by_hand(void)
{
    struct carom_world *world;
    struct carom_picture picture = picture_8();
    struct carom_ray_hit hit;
    struct carom_ray ray;

    world = new_world();
    CHECK_EQ(carom_view_ray(&above, SIZE, SIZE, 32 * 256, 32 * 256, &ray), CAROM_OK);
    CHECK_EQ(ray.from.c[2], Q32(4, 1) - Q32(1, 32));
    CHECK_EQ(ray.from.c[0], 0);
    CHECK_EQ(ray.way.c[0], 0);
    CHECK_LESS(ray.way.c[2], -Q32(16384, 1) + 65536);
    CHECK_EQ(carom_view_ray(&above, SIZE, SIZE, 64 * 256, 0, &ray), CAROM_OK);
    CHECK_NEAR(ray.way.c[0], -ray.way.c[2] / 2, 1 << 17); /* 53 degrees high */
    CHECK_NEAR(ray.way.c[1], -ray.way.c[2] / 2, 1 << 17);
    add(world, &square, at(0, 0, 0), upright, false);
    CHECK_EQ(carom_draw_pick(world, &above, &picture, 16, 47, NULL, &hit), 1);
    CHECK_NEAR(hit.point.c[0], Q32(-31, 32), 1 << 16);
    CHECK_NEAR(hit.point.c[1], Q32(-31, 32), 1 << 16);
    CHECK_EQ(carom_draw_pick(world, &above, &picture, 15, 47, NULL, &hit), 0);
    CHECK_EQ(carom_draw_pick(world, &above, &picture, 16, 48, NULL, &hit), 0);
    CHECK_EQ(carom_draw_pick(world, &above, &picture, 47, 16, NULL, &hit), 1);
    CHECK_EQ(carom_draw_pick(world, &above, &picture, 48, 16, NULL, &hit), 0);
}

static void test_errors(void)
{
    struct carom_world *world = new_world();
    struct carom_picture picture = picture_8();
    struct carom_camera camera = above;
    struct carom_ray_hit hit;
    struct carom_ray ray;

    CHECK_EQ(carom_view_ray(NULL, SIZE, SIZE, 0, 0, &ray), CAROM_ERR_NULL);
    CHECK_EQ(carom_view_ray(&above, SIZE, SIZE, 0, 0, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_view_ray(&above, SIZE, SIZE, -1, 0, &ray), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_view_ray(&above, SIZE, SIZE, 0, SIZE * 256 + 1, &ray), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_view_ray(&above, 0, SIZE, 0, 0, &ray), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_view_ray(&above, 2049, SIZE, 0, 0, &ray), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_draw_pick(NULL, &above, &picture, 0, 0, NULL, &hit), CAROM_ERR_NULL);
    CHECK_EQ(carom_draw_pick(world, NULL, &picture, 0, 0, NULL, &hit), CAROM_ERR_NULL);
    CHECK_EQ(carom_draw_pick(world, &above, NULL, 0, 0, NULL, &hit), CAROM_ERR_NULL);
    CHECK_EQ(carom_draw_pick(world, &above, &picture, 0, 0, NULL, NULL), CAROM_ERR_NULL);
    CHECK_EQ(carom_draw_pick(world, &above, &picture, SIZE, 0, NULL, &hit), CAROM_ERR_ARGUMENT);
    CHECK_EQ(carom_draw_pick(world, &above, &picture, 0, -1, NULL, &hit), CAROM_ERR_ARGUMENT);
    camera.target = camera.eye;
    CHECK_EQ(carom_draw_pick(world, &camera, &picture, 0, 0, NULL, &hit), CAROM_ERR_ARGUMENT);
    camera.eye.c[1] = Q32(16385, 1);
    CHECK_EQ(carom_draw_pick(world, &camera, &picture, 0, 0, NULL, &hit), CAROM_ERR_RANGE);
    camera = above;
    for (int k = 0; k < 3; k++) { /* the ray of the farthest camera is in range */
        camera.eye.c[k] = Q32(16384, 1);
        camera.target.c[k] = Q32(16384, 1) - 1;
    }
    CHECK_EQ(carom_draw_pick(world, &camera, &picture, 0, 0, NULL, &hit), 0);
}

/* The ramp of the body that a ray through a part of a pixel meets. */
static int ramp_of(const struct carom_world *world, const struct carom_camera *camera, int x_q8,
                   int y_q8)
{
    struct carom_ray_hit hit;
    struct carom_ray ray;

    CHECK_EQ(carom_view_ray(camera, SIZE, SIZE, x_q8, y_q8, &ray), CAROM_OK);
    if (carom_cast_ray(world, &ray, NULL, &hit) == 0) {
        return DRAW_BACKGROUND;
    }
    return hit.body == 0 ? DRAW_STATIONARY : DRAW_MOVING;
}

/*
 * Two cubes that may cross, seen from anywhere. Where the four corners of a pixel show the same
 * body, the pixel is drawn so and picked so.
 */
static void test_drawn(void)
{
    struct test_random r = {31};
    struct carom_picture picture = picture_8();
    int shown[8] = {0};

    for (int n = 0; n < PICTURES; n++) {
        struct carom_world *world = new_world();
        struct carom_camera camera = {.focal_q16 =
                                          (int32_t)test_random_range(&r, 1 << 15, 1 << 17)};

        for (int b = 0; b < 2; b++) {
            carom_v3_q32 x;
            carom_quat_q30 q = n % 2 ? oblique : upright;

            for (int k = 0; k < 3; k++) {
                x.c[k] = test_random_range(&r, Q32(-1, 1), Q32(1, 1));
            }
            add(world, &cube, x, b ? oblique : q, b == 1);
        }
        for (int k = 0; k < 3; k++) {
            camera.eye.c[k] = test_random_range(&r, Q32(-4, 1), Q32(4, 1));
            camera.target.c[k] = test_random_range(&r, Q32(-1, 2), Q32(1, 2));
        }
        draw_8(world, &camera, CAROM_DRAW_FLAT);
        for (int i = 0; i < 60; i++) {
            int x = (int)test_random_range(&r, 0, SIZE - 1);
            int y = (int)test_random_range(&r, 0, SIZE - 1);
            int seen = ramp_of(world, &camera, x * 256 + 128, y * 256 + 128);
            struct carom_ray_hit hit;
            bool same = true;

            for (int k = 0; k < 4 && same; k++) {
                same = ramp_of(world, &camera, x * 256 + (k & 1 ? 64 : 192),
                               y * 256 + (k & 2 ? 64 : 192)) == seen;
            }
            if (same) {
                CHECK_EQ(ramp_at(x, y), seen);
                CHECK_EQ(carom_draw_pick(world, &camera, &picture, x, y, NULL, &hit),
                         seen != DRAW_BACKGROUND);
                shown[seen]++;
            }
        }
    }
    CHECK_MORE(shown[DRAW_BACKGROUND], 0);
    CHECK_MORE(shown[DRAW_STATIONARY], 0);
    CHECK_MORE(shown[DRAW_MOVING], 0);
}

const struct test tests_draw_pick[] = {{"draw_pick/by_hand", test_by_hand},
                                       {"draw_pick/errors", test_errors},
                                       {"draw_pick/drawn", test_drawn},
                                       {0}};
