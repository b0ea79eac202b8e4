/* SPDX-License-Identifier: MIT */
/*
 * Drawing against a ray caster in double precision: two cubes that may cross, seen from anywhere,
 * and their shadows on each other and on the ground, with light from anywhere.
 */
#include "lib/draw_scene.h"

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

/* Quaternions whose components and length are whole numbers: w, x, y, z, length. */
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
 * The part of a ray inside a cube of +-1/2, by its three slabs; none when the ray enters after it
 * leaves.
 */
static void slabs(double part[2], const struct ray *ray, const struct solid *s)
{
    part[0] = -1e30;
    part[1] = 1e30;
    for (int k = 0; k < 3; k++) {
        double o = 0, d = 0, t0, t1;

        for (int i = 0; i < 3; i++) {
            o += s->r[i][k] * (ray->from[i] - s->x[i]);
            d += s->r[i][k] * ray->along[i];
        }
        d = d == 0 ? 1e-12 : d;
        t0 = (-0.5 - o) / d;
        t1 = (0.5 - o) / d;
        part[0] = t0 < t1 ? (t0 > part[0] ? t0 : part[0]) : (t1 > part[0] ? t1 : part[0]);
        part[1] = t0 < t1 ? (t1 < part[1] ? t1 : part[1]) : (t0 < part[1] ? t0 : part[1]);
    }
}

/*
 * The distance at which a ray enters a cube; a large number when it does not. Closer than the near
 * plane, 1/32 unit ahead, the faces are cut, and the far faces look away.
 */
static double meet(const struct ray *ray, const struct solid *s)
{
    double part[2];

    slabs(part, ray, s);
    return part[0] < part[1] && part[0] > 1.0 / 32 ? part[0] : 1e30;
}

/* Distance along a ray to the ground at z = -1, which is +-32 wide and visible from above. */
static double meet_ground(const struct ray *ray)
{
    double t = ray->along[2] < 0 ? (-1 - ray->from[2]) / ray->along[2] : 1e30;
    double x = ray->from[0] + t * ray->along[0], y = ray->from[1] + t * ray->along[1];

    return t > 1.0 / 32 && x > -32 && x < 32 && y > -32 && y < 32 ? t : 1e30;
}

/* Whether the face of a cube that a point lies on looks towards the light. */
static bool faces_light(const double point[3], const double light[3], const struct solid *s)
{
    double most = 0, towards = 0;

    for (int k = 0; k < 3; k++) {
        double at = 0, along = 0;

        for (int i = 0; i < 3; i++) {
            at += s->r[i][k] * (point[i] - s->x[i]);
            along += s->r[i][k] * light[i];
        }
        if (at * at > most) {
            most = at * at;
            towards = at > 0 ? along : -along;
        }
    }
    return towards > 0;
}

/*
 * A world for the ray caster. Without `ground` it has only the cubes, and without `light` it has no
 * shadows.
 */
struct view {
    double eye[3], axes[3][3], light[3];
    struct solid solids[2];
    bool ground;
};

/*
 * Whether another cube keeps the light from a point of body 0, 1 or 2 (the ground): 1. For a point
 * inside of that cube, visible only to an eye in there: 2.
 */
static int is_dark(const struct view *v, const double point[3], int body)
{
    struct ray ray;
    int dark = 0;

    memcpy(ray.from, point, sizeof ray.from);
    memcpy(ray.along, v->light, sizeof ray.along);
    for (int i = 0; i < 2; i++) {
        double part[2];

        slabs(part, &ray, &v->solids[i]);
        if (i != body && part[0] < part[1] && part[1] > 0) {
            dark = part[0] < 0 ? 2 : 1;
        }
    }
    return body == 2 ? dark * (v->light[2] > 0)
                     : dark * faces_light(point, v->light, &v->solids[body]);
}

/*
 * The ramp that a point of the picture shows; solids[1] moves. 8 more in shadow, 16 more where that
 * is unknown.
 */
static int see(const struct view *v, double x, double y)
{
    struct ray ray;
    double t[3], point[3];
    int body = 0;

    for (int k = 0; k < 3; k++) {
        ray.from[k] = v->eye[k];
        ray.along[k] = v->axes[2][k] + (x - SIZE / 2) / SIZE * v->axes[0][k] +
                       (y - SIZE / 2) / SIZE * v->axes[1][k];
    }
    t[0] = meet(&ray, &v->solids[0]);
    t[1] = meet(&ray, &v->solids[1]);
    t[2] = v->ground ? meet_ground(&ray) : 1e30;
    for (int i = 1; i < 3; i++) {
        body = t[i] < t[body] ? i : body;
    }
    if (t[body] > 1e29) {
        return DRAW_BACKGROUND;
    }
    for (int k = 0; k < 3; k++) {
        point[k] = ray.from[k] + t[body] * ray.along[k];
    }
    return (body == 1 ? DRAW_MOVING : DRAW_STATIONARY) + 8 * is_dark(v, point, body);
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

/* The world without shadows: the pixels that differ from it are darker because of a shadow. */
static uint8_t bright[SIZE][SIZE];

/* Pixels compared, those in shadow, and those that are wrong. */
struct counts {
    int all, dark, wrong;
};

/* Compare so many random pixels, except where a ray `beside` it, in pixels, sees something else. */
static void compare_rays(struct counts *counts, struct test_random *random, const struct view *v,
                         int pixel_count, double beside)
{
    for (int i = 0; i < pixel_count; i++) {
        int x = (int)test_random_range(random, 0, SIZE - 1);
        int y = (int)test_random_range(random, 0, SIZE - 1);
        int seen = see(v, x + 0.5, y + 0.5);
        bool same = seen < 16;

        for (int k = 0; k < 4 && same; k++) {
            same = see(v, x + 0.5 + (k & 1 ? -beside : beside),
                       y + 0.5 + (k & 2 ? -beside : beside)) == seen;
        }
        if (same) {
            counts->all++;
            counts->dark += seen >= 8;
            counts->wrong += ramp_at(x, y) + 8 * (pixels[y][x] < bright[y][x]) != seen;
        }
    }
}

/*
 * Two cubes that may cross, and a camera. Sometimes the near plane cuts a cube, or the eye is
 * inside one.
 */
static struct carom_camera place(struct carom_world *world, struct view *v,
                                 struct test_random *random, bool close)
{
    struct carom_camera camera = {.focal_q16 = 1 << 16};
    const int64_t far = close ? Q32(1, 1) : Q32(3, 1);
    double target[3];

    for (int b = 0; b < 2; b++) {
        const int8_t *q = turns[test_random_range(random, 0, sizeof turns / sizeof turns[0] - 1)];
        carom_quat_q30 rotation;
        carom_v3_q32 x;

        for (int k = 0; k < 4; k++) {
            rotation.c[k] = (int32_t)(q[k] * (int64_t)CAROM_ONE_Q30 / q[4]);
        }
        for (int k = 0; k < 3; k++) {
            x.c[k] = test_random_range(random, Q32(-1, 2), Q32(1, 2));
            v->solids[b].x[k] = (double)x.c[k] / 4294967296.0;
        }
        turn_matrix(v->solids[b].r, q);
        add(world, &cube, x, rotation, b == 1);
    }
    for (int k = 0; k < 3; k++) {
        camera.eye.c[k] = test_random_range(random, -far, far);
        camera.target.c[k] = test_random_range(random, Q32(-1, 4), Q32(1, 4));
        v->eye[k] = (double)camera.eye.c[k] / 4294967296.0;
        target[k] = (double)camera.target.c[k] / 4294967296.0;
    }
    camera_axes(v->axes, v->eye, target);
    return camera;
}

static void cubes(void)
{
    struct test_random random = {20};
    struct counts counts = {0, 0, 0};

    for (int scene = 0; scene < ORACLE_SCENES; scene++) {
        struct carom_world *world = new_world();
        struct view v = {.ground = false, .light = {0, 0, 0}};
        struct carom_camera camera = place(world, &v, &random, scene % 3 == 0);

        draw_8(world, &camera, CAROM_DRAW_FLAT);
        memcpy(bright, pixels, sizeof bright);
        compare_rays(&counts, &random, &v, 24, 0.2);
    }
    CHECK_MORE(counts.all, 10 * ORACLE_SCENES);
    CHECK_EQ(counts.wrong, 0);
}

static void shadows(void)
{
    struct test_random random = {21};
    struct counts counts = {0, 0, 0};

    for (int scene = 0; scene < 2 * ORACLE_SCENES; scene++) {
        struct carom_world *world = new_world();
        struct view v = {.ground = true};
        struct carom_camera camera = place(world, &v, &random, scene % 3 == 0);
        struct carom_paint paint = {.ambient_q30 = 0};
        struct carom_picture picture = picture_8();

        add(world, &plain, at(0, 0, Q32(-1, 1)), upright, false);
        for (int k = 0; k < 3; k++) {
            paint.light.c[k] = (int32_t)test_random_range(&random, -1000, 1000);
            v.light[k] = paint.light.c[k];
        }
        picture.paint = &paint;
        CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        memcpy(bright, pixels, sizeof bright);
        paint.shadows = &carom_shadows;
        CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        compare_rays(&counts, &random, &v, 240, 1);
    }
    /* corners are rounded to a 16th of a pixel, which now and then shows where light or eye graze a
     * face */
    CHECK_MORE(counts.dark, ORACLE_SCENES);
    CHECK_AT_MOST(counts.wrong, counts.all / 10000);
}

#ifdef TEST_LONG
#define BARS 18

static struct carom_mesh bars_mesh;
static struct solid bars_at[BARS]; /* for the ray caster; the axes of `r` are as long as 1 / size */

/* Bars side by side; their centre of mass is at (3/2, -1, 1/2). */
static void build_bars(void)
{
    static int16_t vertices[8 * BARS][3];
    static uint16_t faces[12 * BARS][3];
    MESH_MEMORY(memory, 8 * BARS, 12 * BARS);
    struct carom_mesh_raw raw = {(const int16_t(*)[3])vertices,
                                 (const uint16_t(*)[3])faces,
                                 8 * BARS,
                                 12 * BARS,
                                 12,
                                 CAROM_SOLID};

    for (unsigned b = 0; b < BARS; b++) {
        const int x = (2 * (int)b - BARS) * 480;
        const int low[3] = {x, -2048, -64}, high[3] = {x + 480, 2048, 64};

        box_corners(&vertices[8 * b], low, high);
        for (unsigned f = 0; f < 12; f++) {
            for (int k = 0; k < 3; k++) {
                faces[12 * b + f][k] = (uint16_t)(8 * b + box_faces[f][k]);
            }
        }
        bars_at[b] = (struct solid){
            {{4096.0 / 480, 0, 0}, {0, 1, 0}, {0, 0, 32}},
            {1.5 + (2 * (int)b - BARS + 1) * 480 / 4096.0, -1, 0.5},
        };
    }
    build(&bars_mesh, raw, memory, sizeof memory);
}

/* The bars over a ground that is turned about its middle, with shadows. */
static uint8_t shaded[SIZE][SIZE];

/* Draw that picture, and the one without shadows. */
static void draw_bars(const carom_v3_q30 *light, carom_v3_q32 ground, carom_quat_q30 turn)
{
    static _Alignas(8) uint8_t room[CAROM_DRAW_BYTES(200, 300) + 400000];
    struct carom_paint paint = {.light = *light, .shadows = &carom_shadows};
    struct carom_picture picture = picture_8();
    struct carom_world *world = new_world();

    build_bars();
    add(world, &plain, ground, turn, false);
    add(world, &bars_mesh, at(Q32(3, 2), -Q32(1, 1), Q32(1, 2)), upright, false);
    picture.paint = &paint;
    picture.workspace = room;
    picture.workspace_bytes = sizeof room;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
    memcpy(shaded, pixels, sizeof shaded);
    paint.shadows = NULL;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
    memcpy(bright, pixels, sizeof bright);
}

/*
 * Bars 3 pixels from one to the next on the ground: each throws a shadow of its own, wherever the
 * seam of the ground's two triangles is: across the shadows, or far from them.
 */
static void bars(void)
{
    static const int64_t grounds[] = {0, Q32(1, 1), Q32(20, 1)};
    /* more along x than along y, so that a sweep across the light meets all bars at once */
    const carom_v3_q30 light = {{1000, -900, 1000}};

    for (int i = 0; i < 3; i++) {
        draw_bars(&light, at(grounds[i], -grounds[i], Q32(-1, 1)), upright);
        /* the shadow lies 1.35 units up the page from the bars */
        for (int y = 23; y < 33; y++) {
            int count = 0;

            for (int x = 1; x < SIZE; x++) {
                count += shaded[y][x] < shaded[y][x - 1];
            }
            CHECK_EQ(count, BARS);
        }
    }
}

/* True if a bar is within a part of a ray, which begins at its start. */
static bool meets_bar(const struct ray *ray, double end)
{
    bool meets = false;

    for (int b = 0; b < BARS && !meets; b++) {
        double part[2];

        slabs(part, ray, &bars_at[b]);
        meets = part[0] < part[1] && part[1] > 0 && part[0] < end;
    }
    return meets;
}

/* What a place of the picture shows: a bar, 2; the ground, 0, or in shadow, 1. */
static int see_bars(const carom_v3_q30 *light, double x, double y)
{
    const double right = (x - SIZE / 2) / SIZE, down = (y - SIZE / 2) / SIZE;
    const struct ray eye = {{0, 0, 4}, {right, -down, -1}};
    const struct ray up = {{5 * right, -5 * down, -1}, {light->c[0], light->c[1], light->c[2]}};

    return meets_bar(&eye, 5) ? 2 : meets_bar(&up, 1e30);
}

/*
 * Shadows of bars against rays, under light from anywhere above, over a ground whose seam is
 * anywhere. Edges may be off by what rounds their corners and what grows them: 1.5 sixteenths of a
 * pixel along x and along y.
 */
static void seams(void)
{
    static const int8_t yaws[][3] = {{1, 0, 1}, {4, 3, 5}, {3, 4, 5}, {4, -3, 5}, {3, -4, 5}};
    const double beside = 1.6 / 16;
    struct test_random random = {22};
    struct counts counts = {0, 0, 0};

    for (int scene = 0; scene < 100; scene++) {
        const int8_t *yaw = yaws[test_random_range(&random, 0, 4)];
        carom_quat_q30 turn = {{(int32_t)(yaw[0] * (int64_t)CAROM_ONE_Q30 / yaw[2]), 0, 0,
                                (int32_t)(yaw[1] * (int64_t)CAROM_ONE_Q30 / yaw[2])}};
        carom_v3_q32 ground = {{0, 0, Q32(-1, 1)}};
        carom_v3_q30 light = {{0, 0, 1000}};

        for (int k = 0; k < 2; k++) {
            ground.c[k] = test_random_range(&random, Q32(-2, 1), Q32(2, 1));
            light.c[k] = (int32_t)test_random_range(&random, -1500, 1500);
        }
        draw_bars(&light, ground, turn);
        for (int i = 0; i < SIZE * SIZE; i++) {
            const int x = i % SIZE, y = i / SIZE, seen = see_bars(&light, x + 0.5, y + 0.5);
            bool same = seen < 2;

            for (int k = 0; k < 4 && same; k++) {
                same = see_bars(&light, x + 0.5 + (k & 1 ? -beside : beside),
                                y + 0.5 + (k & 2 ? -beside : beside)) == seen;
            }
            if (same) {
                counts.all++;
                counts.dark += seen;
                counts.wrong += (shaded[y][x] < bright[y][x]) != seen;
            }
        }
    }
    CHECK_MORE(counts.dark, 10000);
    CHECK_EQ(counts.wrong, 0);
}
#endif

const struct test tests_draw_rays[] = {
    {"draw_rays/cubes", cubes},
    {"draw_rays/shadows", shadows},
#ifdef TEST_LONG
    {"draw_rays/bars", bars},
    {"draw_rays/seams", seams},
#endif
    {0},
};
