/* SPDX-License-Identifier: MIT */
/*
 * Drawing against a ray caster in double precision: two cubes that may cross, seen from anywhere.
 */
#include "draw_scene.h"

#ifdef TEST_LONG
#define ORACLE_SCENES 2000
#else
#define ORACLE_SCENES 12
#endif

struct solid {
    double r[3][3], x[3];
};

struct ray {
    double from[3], along[3];
};

static double root(double v)
{
    double r = v > 1 ? v : 1;

    for (int i = 0; i < 40; i++) {
        r = (r + v / r) / 2;
    }
    return r;
}

/* Quaternions of whole numbers and whole length: w, x, y, z, length. */
static const int8_t turns[][5] = {{1, 0, 0, 0, 1}, {1, 2, 2, 4, 5},   {1, 1, 1, 1, 2},
                                  {2, 4, 5, 6, 9}, {9, -1, 3, 3, 10}, {4, 2, -2, 1, 5},
                                  {6, -5, 2, 4, 9}};

static void turn_matrix(double r[3][3], const int8_t q[5])
{
    double n = (double)q[4] * q[4], w = q[0], x = q[1], y = q[2], z = q[3];
    double m[3][3] = {{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
                      {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
                      {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};

    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            r[i][k] = m[i][k] / n;
        }
    }
}

/*
 * How far ahead a ray enters a cube of +-1/2, by its three slabs; a large number when it does not.
 * In front of the near plane, 1/32 unit ahead, the faces are cut, and the far ones look away.
 */
static double meet(const struct ray *ray, const struct solid *s)
{
    double enter = 0, leave = 1e30;

    for (int k = 0; k < 3; k++) {
        double o = 0, d = 0, t0, t1;

        for (int i = 0; i < 3; i++) {
            o += s->r[i][k] * (ray->from[i] - s->x[i]);
            d += s->r[i][k] * ray->along[i];
        }
        d = d == 0 ? 1e-12 : d;
        t0 = (-0.5 - o) / d;
        t1 = (0.5 - o) / d;
        enter = t0 < t1 ? (t0 > enter ? t0 : enter) : (t1 > enter ? t1 : enter);
        leave = t0 < t1 ? (t1 < leave ? t1 : leave) : (t0 < leave ? t0 : leave);
    }
    return enter < leave && enter > 1.0 / 32 ? enter : 1e30;
}

/* The ramp that a point of the picture shows; solids[1] moves. */
static int see(const double eye[3], double axes[3][3], double x, double y,
               const struct solid solids[2])
{
    struct ray ray;
    double t0, t1;

    for (int k = 0; k < 3; k++) {
        ray.from[k] = eye[k];
        ray.along[k] =
            axes[2][k] + (x - SIZE / 2) / SIZE * axes[0][k] + (y - SIZE / 2) / SIZE * axes[1][k];
    }
    t0 = meet(&ray, &solids[0]);
    t1 = meet(&ray, &solids[1]);
    if (t0 > 1e29 && t1 > 1e29) {
        return DRAW_BACKGROUND;
    }
    return t0 < t1 ? DRAW_STATIONARY : DRAW_MOVING;
}

static void camera_axes(double axes[3][3], const double eye[3], const double target[3])
{
    double f[3], length, level;

    for (int k = 0; k < 3; k++) {
        f[k] = target[k] - eye[k];
    }
    length = root(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    level = root(f[0] * f[0] + f[1] * f[1]);
    for (int k = 0; k < 3; k++) {
        axes[2][k] = f[k] / length;
    }
    axes[0][0] = f[1] / level;
    axes[0][1] = -f[0] / level;
    axes[0][2] = 0;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;

        axes[1][k] = axes[2][i] * axes[0][j] - axes[2][j] * axes[0][i];
    }
}

/* Random pixels of two crossing cubes; skipped where the ray's neighbours see something else. */
static void compare_rays(struct test_random *random, const double eye[3], double axes[3][3],
                         const struct solid solids[2])
{
    for (int i = 0; i < 24; i++) {
        int x = (int)test_random_range(random, 0, SIZE - 1);
        int y = (int)test_random_range(random, 0, SIZE - 1);
        int seen = see(eye, axes, x + 0.5, y + 0.5, solids);
        bool same = true;

        for (int k = 0; k < 4 && same; k++) {
            same = see(eye, axes, x + (k & 1 ? 0.3 : 0.7), y + (k & 2 ? 0.3 : 0.7), solids) == seen;
        }
        if (same) {
            CHECK_EQ(ramp_at(x, y), seen);
        }
    }
}

static void cubes(void)
{
    struct test_random random = {20};

    for (int scene = 0; scene < ORACLE_SCENES; scene++) {
        struct carom_world *world = new_world();
        struct carom_camera camera = {.focal_q16 = 1 << 16};
        struct solid solids[2];
        double eye[3], target[3], axes[3][3];

        for (int b = 0; b < 2; b++) {
            const int8_t *q =
                turns[test_random_range(&random, 0, sizeof turns / sizeof turns[0] - 1)];
            carom_quat_q30 rotation;
            carom_v3_q32 x;

            for (int k = 0; k < 4; k++) {
                rotation.c[k] = (int32_t)(q[k] * (int64_t)CAROM_ONE_Q30 / q[4]);
            }
            for (int k = 0; k < 3; k++) {
                x.c[k] = test_random_range(&random, Q32(-1, 2), Q32(1, 2));
                solids[b].x[k] = (double)x.c[k] / 4294967296.0;
            }
            turn_matrix(solids[b].r, q);
            add(world, &cube, x, rotation, b == 1);
        }
        /* sometimes close enough for the near plane to cut a cube, or with the eye inside one */
        for (int k = 0; k < 3; k++) {
            int64_t far = scene % 3 == 0 ? Q32(1, 1) : Q32(3, 1);

            camera.eye.c[k] = test_random_range(&random, -far, far);
            camera.target.c[k] = test_random_range(&random, Q32(-1, 4), Q32(1, 4));
            eye[k] = (double)camera.eye.c[k] / 4294967296.0;
            target[k] = (double)camera.target.c[k] / 4294967296.0;
        }
        camera_axes(axes, eye, target);
        draw_8(world, &camera, CAROM_DRAW_FLAT);
        compare_rays(&random, eye, axes, solids);
    }
}

const struct test tests_draw_rays[] = {
    {"draw_rays/cubes", cubes},
    {0},
};
