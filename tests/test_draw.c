/* SPDX-License-Identifier: MIT */
/*
 * Pictures whose pixels are known by hand, and a ray caster in double precision as an oracle.
 *
 * Most scenes look straight down from 4 units above the origin at a focal length of one picture
 * height, 64 pixels: at z = 0 a unit is 16 pixels, x to the right and y up the page.
 */
#include "carom.h"
#include "draw.h"
#include "test.h"

#define SIZE      64
#define CAPS      6, 8, 64, 256, 256, 512
#define Q32(n, d) CAROM_RATIO(n, d, 32)

#ifdef TEST_LONG
#define ORACLE_SCENES 2000
#else
#define ORACLE_SCENES 12
#endif

static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)];
static _Alignas(8) uint8_t depth[CAROM_DRAW_BYTES(SIZE, SIZE)];
static uint8_t pixels[SIZE][SIZE], reference[SIZE][SIZE];

static const struct carom_camera above = {
    .eye = {{0, 0, Q32(4, 1)}}, .target = {{0, 0, 0}}, .focal_q16 = 1 << 16};
static const enum carom_draw_style styles[] = {CAROM_DRAW_FLAT, CAROM_DRAW_WIRE};
static const carom_quat_q30 upright = {{CAROM_ONE_Q30, 0, 0, 0}};

/* ------------------------------------------------------------------- meshes */

/* A square of +-1 unit in z = 0 that looks up, and its lower left half. */
static const int16_t square_vertices[][3] = {
    {-4096, -4096, 0}, {4096, -4096, 0}, {4096, 4096, 0}, {-4096, 4096, 0}};
static const uint16_t square_faces[][3] = {{0, 1, 2}, {0, 2, 3}};
static const uint16_t half_faces[][3] = {{0, 1, 3}};
static const int16_t half_vertices[][3] = {
    {-4096, -4096, 0}, {4096, -4096, 0}, {0, 0, 0}, {-4096, 4096, 0}};

/* A cube of +-1/2 unit. */
static const int16_t cube_vertices[][3] = {
    {-2048, -2048, -2048}, {2048, -2048, -2048}, {-2048, 2048, -2048}, {2048, 2048, -2048},
    {-2048, -2048, 2048},  {2048, -2048, 2048},  {-2048, 2048, 2048},  {2048, 2048, 2048}};
static const uint16_t cube_faces[][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                         {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                         {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};

static struct carom_mesh square, half, cube, plain;

static void build(struct carom_mesh *mesh, struct carom_mesh_raw raw, void *mem, size_t bytes)
{
    CHECK_EQ(carom_mesh_build(mesh, &raw, mem, bytes), CAROM_OK);
}

#define MESH_MEMORY(name, v, f) static _Alignas(8) uint8_t name[CAROM_MESH_BYTES(v, f)]

static void build_meshes(void)
{
    MESH_MEMORY(square_mem, 4, 2);
    MESH_MEMORY(plain_mem, 4, 2);
    MESH_MEMORY(half_mem, 4, 1);
    MESH_MEMORY(cube_mem, 8, 12);
    struct carom_mesh_raw raw = {square_vertices, square_faces, 4, 2, 12, CAROM_SURFACE};

    build(&square, raw, square_mem, sizeof square_mem);
    raw.quantum_bits = 7; /* the same square, +-32 units wide */
    build(&plain, raw, plain_mem, sizeof plain_mem);
    raw = (struct carom_mesh_raw){half_vertices, half_faces, 4, 1, 12, CAROM_SURFACE};
    build(&half, raw, half_mem, sizeof half_mem);
    raw = (struct carom_mesh_raw){cube_vertices, cube_faces, 8, 12, 12, CAROM_SOLID};
    build(&cube, raw, cube_mem, sizeof cube_mem);
}

/* ------------------------------------------------------------------- scenes */

static struct carom_world *new_world(void)
{
    struct carom_config config = {.caps = {CAPS}};
    struct carom_world *world = NULL;

    CHECK_EQ(carom_world_init(block, sizeof block, &config, &world), CAROM_OK);
    build_meshes();
    return world;
}

static void add(struct carom_world *world, const struct carom_mesh *mesh, carom_v3_q32 position,
                carom_quat_q30 rotation, bool moving)
{
    struct carom_body_def def = {.mesh = mesh,
                                 .stationary = !moving,
                                 .position = position,
                                 .rotation = rotation,
                                 .restitution_q30 = CAROM_ONE_Q30 / 2};

    CHECK(carom_body_add(world, &def) >= 0);
}

static carom_v3_q32 at(int64_t x, int64_t y, int64_t z)
{
    carom_v3_q32 p = {{x, y, z}};

    return p;
}

static struct carom_picture picture_8(void)
{
    struct carom_picture picture = {.pixels = pixels,
                                    .width = SIZE,
                                    .height = SIZE,
                                    .stride = SIZE,
                                    .format = CAROM_PALETTE8,
                                    .workspace = depth,
                                    .workspace_bytes = sizeof depth};

    return picture;
}

static void draw_8(const struct carom_world *world, const struct carom_camera *camera,
                   enum carom_draw_style style)
{
    struct carom_picture picture = picture_8();

    memset(pixels, 0xee, sizeof pixels);
    CHECK_EQ(carom_draw(world, camera, &picture, style), CAROM_OK);
}

static int ramp_at(int x, int y)
{
    return pixels[y][x] / DRAW_SHADES;
}

static int count_ramp(int ramp)
{
    int n = 0;

    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            n += ramp_at(x, y) == ramp;
        }
    }
    return n;
}

/* ---------------------------------------------------------------- hand cases */

static void background(void)
{
    struct carom_world *world = new_world();

    /* two rows a shade, from the top */
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

    /* 2 units are 32 pixels; the diagonal runs through pixel centres and is a right edge: outside
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

/* A cube above or below a square, added first or second: the far one never shows through. */
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

/* A level square cut by one that is tilted about the y axis: they cross in the middle column. */
static void crossing_faces(void)
{
    /* cos and sin of half the angle are 0.96 and 0.28 */
    static const carom_quat_q30 tilted = {{1030792151, 0, 300647711, 0}};
    struct carom_world *world = new_world();
    uint8_t level;

    add(world, &square, at(0, 0, 0), upright, false);
    draw_8(world, &above, CAROM_DRAW_FLAT);
    level = pixels[32][32];
    add(world, &square, at(0, 0, 0), tilted, false);
    draw_8(world, &above, CAROM_DRAW_FLAT);
    for (int y = 17; y < 47; y++) {
        for (int x = 17; x < 47; x++) {
            if (x < 31) { /* turned about +y, the side of -x comes up */
                CHECK(pixels[y][x] != level && ramp_at(x, y) == DRAW_STATIONARY);
            } else if (x > 32) {
                CHECK_EQ(pixels[y][x], level);
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
            CHECK(memcmp(reference, pixels, sizeof pixels) == 0);
        }
        {
            struct carom_world *world = new_world();

            add(world, &square, at(0, 0, 0), upside_down, false);
            draw_8(world, &above, style);
            CHECK(memcmp(reference, pixels, sizeof pixels) == 0);
        }
    }
}

/* A plain that reaches behind the eye, one unit below it: it fills the rows below the horizon. */
static void near_plane(void)
{
    static const struct carom_camera level = {
        .eye = {{0, 0, Q32(1, 1)}}, .target = {{0, Q32(1, 1), Q32(1, 1)}}, .focal_q16 = 1 << 16};
    struct carom_world *world = new_world();

    add(world, &plain, at(0, 0, 0), upright, false);
    draw_8(world, &level, CAROM_DRAW_FLAT);
    for (int y = 0; y < SIZE; y++) {
        /* its far edge, 32 units away, is 2 rows below the horizon; it is as wide as the view there
         */
        for (int x = 1; x < SIZE - 1; x++) {
            CHECK_EQ(ramp_at(x, y), y >= 34 ? DRAW_STATIONARY : DRAW_BACKGROUND);
        }
    }
}

static void far_away(void)
{
    /* 16384 units away and 8192 aside a cube of one unit is 1/256 of a pixel; nothing overflows */
    struct carom_camera camera = {.eye = {{Q32(-16384, 1), Q32(16384, 1), Q32(16384, 1)}},
                                  .target = {{Q32(4000, 1), Q32(-4000, 1), Q32(-4000, 1)}},
                                  .focal_q16 = 1 << 20};
    struct carom_world *world = new_world();

    add(world, &cube, at(Q32(4000, 1), Q32(-4000, 1), Q32(-4000, 1)), upright, true);
    draw_8(world, &camera, CAROM_DRAW_FLAT);
    CHECK(count_ramp(DRAW_MOVING) <= 1);
    /* in wire style it is the pixel that holds the middle, at most with its neighbours */
    draw_8(world, &camera, CAROM_DRAW_WIRE);
    CHECK(count_ramp(DRAW_MOVING) >= 1 && count_ramp(DRAW_MOVING) <= 4);
}

/* ------------------------------------------------------------ picture formats */

static void add_scene(struct carom_world *world)
{
    static const carom_quat_q30 turned = {{214748365, 429496730, 429496730, 858993459}};

    add(world, &plain, at(0, 0, Q32(-1, 1)), upright, false);
    add(world, &cube, at(0, 0, 0), turned, true);
}

static void formats_agree(void)
{
    static uint16_t pixels_16[SIZE][SIZE];
    static uint32_t pixels_32[SIZE][SIZE];
    struct carom_world *world = new_world();

    add_scene(world);
    for (int k = 0; k < 2; k++) {
        enum carom_draw_style style = styles[k];

        struct carom_picture picture = picture_8();

        draw_8(world, &above, style);
        picture.pixels = pixels_16;
        picture.stride = sizeof pixels_16[0];
        picture.format = CAROM_RGB565;
        CHECK_EQ(carom_draw(world, &above, &picture, style), CAROM_OK);
        picture.pixels = pixels_32;
        picture.stride = sizeof pixels_32[0];
        picture.format = CAROM_XRGB8888;
        CHECK_EQ(carom_draw(world, &above, &picture, style), CAROM_OK);
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                uint32_t rgb = carom_draw_palette[pixels[y][x]];
                uint32_t r = rgb >> 16, g = rgb >> 8 & 0xff, b = rgb & 0xff;

                CHECK_EQ(pixels_32[y][x], rgb);
                CHECK_EQ(pixels_16[y][x], (r / 8) * 2048 + (g / 4) * 32 + b / 8);
            }
        }
    }
}

static void workspace_size(void)
{
    static const uint8_t rows[] = {1, 2, 7, 33, 63};
    struct carom_world *world = new_world();

    add_scene(world);
    draw_8(world, &above, CAROM_DRAW_FLAT);
    memcpy(reference, pixels, sizeof pixels);
    CHECK(count_ramp(DRAW_MOVING) > 200); /* the cube covers about 16 x 16 pixels or more */
    for (size_t i = 0; i < sizeof rows; i++) {
        struct carom_picture picture = picture_8();

        picture.workspace_bytes = CAROM_DRAW_BYTES(SIZE, rows[i]) + 3;
        memset(depth, 0x5a, sizeof depth);
        memset(pixels, 0xee, sizeof pixels);
        CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        CHECK(memcmp(reference, pixels, sizeof pixels) == 0);
        CHECK_EQ(depth[CAROM_DRAW_BYTES(SIZE, rows[i])], 0x5a);
    }
}

/* Nothing outside of the rows' pixels is written. */
static void canaries(void)
{
    enum { WIDTH = 37, HEIGHT = 21, STRIDE = 45, BEFORE = 64 };
    static uint8_t memory[BEFORE + STRIDE * HEIGHT + BEFORE];
    struct carom_world *world = new_world();
    struct carom_picture picture = picture_8();

    add_scene(world);
    picture.pixels = &memory[BEFORE];
    picture.width = WIDTH;
    picture.height = HEIGHT;
    picture.stride = STRIDE;
    for (int k = 0; k < 2; k++) {
        enum carom_draw_style style = styles[k];

        memset(memory, 0xa5, sizeof memory); /* the palette entry 0xa5 is never drawn */
        CHECK_EQ(carom_draw(world, &above, &picture, style), CAROM_OK);
        for (size_t i = 0; i < sizeof memory; i++) {
            size_t offset = i - BEFORE;
            bool pixel = i >= BEFORE && offset < STRIDE * HEIGHT && offset % STRIDE < WIDTH;

            CHECK_EQ(memory[i] == 0xa5, !pixel);
        }
    }
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

/* From above a cube shows the four edges of its top and the diagonal between its two triangles. */
static void wire_back_edges(void)
{
    struct carom_world *world = new_world();
    struct carom_camera camera = above;

    camera.eye.c[2] = Q32(5, 2); /* the top is 2 units away: 32 pixels wide, from 16 to 48 */
    add(world, &cube, at(Q32(1, 64), Q32(-1, 64), 0), upright, true);
    draw_8(world, &camera, CAROM_DRAW_WIRE);
    CHECK_EQ(count_ramp(DRAW_MOVING), 4 * 32 + 31);
    /* the bottom's corners, 3 units away, lie within and do not show */
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
            /* the far edge, just on row 34; the sides leave the picture near it; the diagonal runs
             * from the eye's foot, straight below and out of sight, to the far corner on the right
             */
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
    CHECK(carom_world_step(world) >= 0);
    count = carom_interfering_faces(world, &refs);
    CHECK(count > 0);
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
    CHECK(listed[0] && cube_hot > 0);
    draw_8(world, &above, CAROM_DRAW_WIRE);
    CHECK(count_ramp(DRAW_MOVING_HOT) > 0 && count_ramp(DRAW_STATIONARY_HOT) > 0);
}

/* -------------------------------------------------------------------- oracle */

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

static void ray_oracle(void)
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

/* -------------------------------------------------------------------- errors */

static void expect(int error, const struct carom_camera *camera,
                   const struct carom_picture *picture, int style)
{
    struct carom_world *world = new_world();

    memset(pixels, 0xee, sizeof pixels);
    CHECK_EQ(carom_draw(world, camera, picture, (enum carom_draw_style)style), error);
    CHECK_EQ(pixels[0][0], error == CAROM_OK ? 0 : 0xee);
}

static void picture_errors(void)
{
    struct carom_picture p;

#define EXPECT_PICTURE(error, change)                                                              \
    p = picture_8();                                                                               \
    change;                                                                                        \
    expect(error, &above, &p, CAROM_DRAW_FLAT)
    EXPECT_PICTURE(CAROM_OK, p.width = SIZE);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, p.width = 0);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, p.width = 2049);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, p.height = 0);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, p.height = -1);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, p.height = 2049);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, p.format = 3);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, p.stride = SIZE - 1);
    EXPECT_PICTURE(CAROM_ERR_ARGUMENT, (p.format = CAROM_RGB565, p.width = 8, p.stride = 17));
    EXPECT_PICTURE(CAROM_ERR_NULL, p.pixels = NULL);
    EXPECT_PICTURE(CAROM_ERR_NULL, p.workspace = NULL);
    EXPECT_PICTURE(CAROM_ERR_MEMORY, p.workspace_bytes = CAROM_DRAW_BYTES(SIZE, 1) - 1);
    EXPECT_PICTURE(CAROM_ERR_MEMORY, p.workspace = depth + 4);
    EXPECT_PICTURE(CAROM_ERR_MEMORY,
                   (p.format = CAROM_XRGB8888, p.width = 8, p.pixels = depth + 2));
#undef EXPECT_PICTURE
    p = picture_8();
    expect(CAROM_ERR_ARGUMENT, &above, &p, 2);
    p.workspace = NULL;
    p.workspace_bytes = 0;
    expect(CAROM_OK, &above, &p, CAROM_DRAW_WIRE);
}

static void camera_errors(void)
{
    struct carom_picture picture = picture_8();
    struct carom_camera c;

#define EXPECT_CAMERA(error, change)                                                               \
    c = above;                                                                                     \
    change;                                                                                        \
    expect(error, &c, &picture, CAROM_DRAW_FLAT)
    EXPECT_CAMERA(CAROM_ERR_ARGUMENT, c.target = c.eye);
    EXPECT_CAMERA(CAROM_ERR_ARGUMENT, c.focal_q16 = (1 << 12) - 1);
    EXPECT_CAMERA(CAROM_ERR_ARGUMENT, c.focal_q16 = (1 << 20) + 1);
    EXPECT_CAMERA(CAROM_ERR_RANGE, c.eye.c[1] = Q32(16384, 1) + 1);
    EXPECT_CAMERA(CAROM_ERR_RANGE, c.target.c[2] = INT64_MIN);
    EXPECT_CAMERA(CAROM_OK, c.eye.c[1] = Q32(-16384, 1));
#undef EXPECT_CAMERA
    CHECK_EQ(carom_draw(NULL, &above, &picture, CAROM_DRAW_FLAT), CAROM_ERR_NULL);
    expect(CAROM_ERR_NULL, NULL, &picture, CAROM_DRAW_FLAT);
    expect(CAROM_ERR_NULL, &above, NULL, CAROM_DRAW_FLAT);
}

const struct test tests_draw[] = {{"draw/background", background},
                                  {"draw/covered_pixels", covered_pixels},
                                  {"draw/shared_edge", shared_edge},
                                  {"draw/nearer_hides", nearer_hides},
                                  {"draw/crossing_faces", crossing_faces},
                                  {"draw/nothing_to_see", nothing_to_see},
                                  {"draw/near_plane", near_plane},
                                  {"draw/far_away", far_away},
                                  {"draw/formats_agree", formats_agree},
                                  {"draw/workspace_size", workspace_size},
                                  {"draw/canaries", canaries},
                                  {"draw/wire_edges", wire_edges},
                                  {"draw/wire_back_edges", wire_back_edges},
                                  {"draw/wire_clip", wire_clip},
                                  {"draw/interfering", interfering},
                                  {"draw/ray_oracle", ray_oracle},
                                  {"draw/picture_errors", picture_errors},
                                  {"draw/camera_errors", camera_errors},
                                  {0}};
