/* SPDX-License-Identifier: MIT */
/*
 * Shades from corner to corner against the same in double precision, for random lumps seen from
 * anywhere. The oracle finds the faces that share a shade by joining all faces that meet in an
 * edge, and finds the face of a pixel by looking at all.
 */
#include "lib/draw_scene.h"

#ifdef TEST_LONG
#define LUMPS 300
#else
#define LUMPS 1
#endif

enum { ROUND = 7, RINGS = 4, VERTICES = ROUND * RINGS + 2, FACES = 2 * ROUND * RINGS, WIDE = 96 };

static int16_t vertices[VERTICES][3];
static uint16_t faces[FACES][3];
static struct carom_mesh lump;
static _Alignas(8) uint8_t lump_block[CAROM_MESH_BYTES(VERTICES, FACES)];
static _Alignas(8) uint8_t
    lump_space[CAROM_DRAW_BYTES(VERTICES, FACES) + CAROM_SMOOTH_BYTES(VERTICES, FACES)];
static uint32_t wide[WIDE * WIDE];

static double root(double v)
{
    double r = v > 1 ? v : 1;

    for (int i = 0; i < 60; i++) {
        r = (r + v / r) / 2;
    }
    return r;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(double out[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;

        out[k] = a[i] * b[j] - a[j] * b[i];
    }
}

static void unit(double v[3])
{
    double length = root(dot(v, v));

    for (int k = 0; k < 3; k++) {
        v[k] /= length;
    }
}

/* A ball of rings with vertices moved outwards and inwards. */
static void make_lump(struct test_random *random)
{
    static const int16_t ring[RINGS][2] = {{588, 809}, {951, 309}, {951, -309}, {588, -809}};
    static const int16_t turn[ROUND][2] = {{1000, 0},    {623, 782},   {-223, 975}, {-901, 434},
                                           {-901, -434}, {-223, -975}, {623, -782}};
    const struct carom_mesh_raw raw = {(const int16_t(*)[3])vertices,
                                       (const uint16_t(*)[3])faces,
                                       VERTICES,
                                       FACES,
                                       12,
                                       CAROM_SOLID};
    int f = 0;

    for (int i = 0; i < VERTICES; i++) {
        int64_t size = test_random_range(random, 2600, 4096);
        int r = i / ROUND, t = i % ROUND;
        int64_t at[3] = {0, 0, i == VERTICES - 1 ? -1000 : 1000};

        if (i < ROUND * RINGS) {
            at[0] = ring[r][0] * turn[t][0] / 1000;
            at[1] = ring[r][0] * turn[t][1] / 1000;
            at[2] = ring[r][1];
        }
        for (int k = 0; k < 3; k++) {
            vertices[i][k] = (int16_t)(at[k] * size / 1000);
        }
    }
    for (int r = -1; r < RINGS; r++) {
        for (int t = 0; t < ROUND; t++) {
            int next = (t + 1) % ROUND;
            int a = r < 0 ? VERTICES - 2 : r * ROUND + t, b = r < 0 ? a : r * ROUND + next;
            int c = r + 1 < RINGS ? (r + 1) * ROUND + t : VERTICES - 1;
            int d = r + 1 < RINGS ? (r + 1) * ROUND + next : c;

            if (c != d) {
                faces[f][0] = (uint16_t)a, faces[f][1] = (uint16_t)c, faces[f++][2] = (uint16_t)d;
            }
            if (a != b) {
                faces[f][0] = (uint16_t)a, faces[f][1] = (uint16_t)d, faces[f++][2] = (uint16_t)b;
            }
        }
    }
    CHECK_EQ(f, FACES);
    build(&lump, raw, lump_block, sizeof lump_block);
}

/* ------------------------------------------------------------------- oracle */

struct oracle {
    double normal[FACES][3], shade[FACES], corner[FACES][3];
    double on[VERTICES][3]; /* on the picture, and 1 / depth */
};

static bool has_vertex(int face, int vertex)
{
    return faces[face][0] == vertex || faces[face][1] == vertex || faces[face][2] == vertex;
}

/* Whether two faces meet in an edge that ends at a vertex of both. */
static bool meet(int a, int b, int vertex)
{
    int shared = 0;

    for (int k = 0; k < 3; k++) {
        shared += has_vertex(b, faces[a][k]);
    }
    return shared == 2 && has_vertex(a, vertex) && has_vertex(b, vertex);
}

/* The mean over all faces around a vertex that are connected with one face without a crease. */
static double corner_shade(const struct oracle *o, int face, int vertex, double crease)
{
    bool in[FACES] = {false};
    double sum = 0;
    int count = 0;

    in[face] = true;
    for (int pass = 0; pass < FACES; pass++) {
        for (int a = 0; a < FACES; a++) {
            for (int b = 0; in[a] && b < FACES; b++) {
                in[b] = in[b] || (meet(a, b, vertex) && dot(o->normal[a], o->normal[b]) >= crease);
            }
        }
        pass = pass < 12 ? pass : FACES; /* at most that many faces meet at a vertex */
    }
    for (int f = 0; f < FACES; f++) {
        bool counts = in[f];

        /* two faces in one plane count as one */
        for (int g = 0; g < f; g++) {
            counts = counts &&
                     !(in[g] && meet(f, g, vertex) && dot(o->normal[f], o->normal[g]) > 0.99984770);
        }
        sum += counts ? o->shade[f] : 0;
        count += counts;
    }
    return sum / count;
}

static void find_shades(struct oracle *o, const double light[3], double crease)
{
    for (int f = 0; f < FACES; f++) {
        double to[2][3];

        for (int k = 0; k < 3; k++) {
            to[0][k] = vertices[faces[f][1]][k] - vertices[faces[f][0]][k];
            to[1][k] = vertices[faces[f][2]][k] - vertices[faces[f][0]][k];
        }
        cross(o->normal[f], to[0], to[1]);
        unit(o->normal[f]);
        o->shade[f] = 16 + 16 * dot(o->normal[f], light);
    }
    for (int f = 0; f < FACES; f++) {
        for (int k = 0; k < 3; k++) {
            double shade = corner_shade(o, f, faces[f][k], crease);

            /* drawn shades end in the middle of the darkest and of the lightest one */
            o->corner[f][k] = shade < 0.5 ? 0.5 : shade > 31.5 ? 31.5 : shade;
        }
    }
}

/* Project the vertices to a picture of WIDE x WIDE; the body's axes are the world's. */
static void project(struct oracle *o, const double centre[3], const double eye[3],
                    const double target[3])
{
    double axes[3][3] = {{0}};

    for (int k = 0; k < 3; k++) {
        axes[2][k] = target[k] - eye[k];
    }
    unit(axes[2]);
    axes[0][0] = axes[2][1];
    axes[0][1] = -axes[2][0];
    unit(axes[0]);
    cross(axes[1], axes[2], axes[0]);
    for (int v = 0; v < VERTICES; v++) {
        double from[3], depth;

        for (int k = 0; k < 3; k++) {
            from[k] = vertices[v][k] / 4096.0 - centre[k] - eye[k];
        }
        depth = dot(axes[2], from);
        o->on[v][0] = WIDE / 2 + WIDE * dot(axes[0], from) / depth;
        o->on[v][1] = WIDE / 2 + WIDE * dot(axes[1], from) / depth;
        o->on[v][2] = 1 / depth;
    }
}

/* The shade that a place of the picture shows; -1 near an edge and beside the lump. */
static double see(const struct oracle *o, double x, double y)
{
    double nearest = 0, shade = -1;

    for (int f = 0; f < FACES; f++) {
        const double *a = o->on[faces[f][0]], *b = o->on[faces[f][1]], *c = o->on[faces[f][2]];
        double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        double second = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area;
        double third = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area;
        double first = 1 - second - third, w = first * a[2] + second * b[2] + third * c[2];
        double least = first < second ? first : second;

        least = least < third ? least : third;
        if (area >= 0 || least < -0.2 || w < nearest) {
            continue; /* y runs down, so a face that looks at the eye has the opposite sign */
        }
        if (least >= 0) {
            nearest = w;
        }
        shade = least < 0.15 || -area < 8
                    ? -1
                    : first * o->corner[f][0] + second * o->corner[f][1] + third * o->corner[f][2];
    }
    return shade;
}

/* Corners are rounded to a 16th of a pixel. Returns how much the shade varies over that square; -1 near an edge. */
static double slack(const struct oracle *o, double x, double y)
{
    double low = see(o, x, y), high = low;

    for (int k = 0; k < 4; k++) {
        double aside = see(o, x + (k & 1 ? 1 : -1) / 16.0, y + (k & 2 ? 1 : -1) / 16.0);

        low = aside < low ? aside : low;
        high = aside > high ? aside : high;
    }
    return low < 0 ? -1 : high - low;
}

/* -------------------------------------------------------------------- tests */

/* A palette in which a colour tells its entry's number, also between two entries. */
static void number_palette(uint32_t palette[256])
{
    for (uint32_t i = 0; i < 256; i++) {
        palette[i] = (i / 32) << 16 | i % 32 * 8;
    }
}

static struct carom_world *new_lump(struct test_random *random)
{
    struct carom_world *world = new_world();

    make_lump(random);
    add(world, &lump, at(0, 0, 0), upright, true);
    return world;
}

static void oracle(void)
{
    static struct oracle o;
    static uint32_t palette[256];
    struct test_random random = {77};
    int seen = 0, wrong[2] = {0, 0};

    number_palette(palette);
    for (int i = 0; i < LUMPS; i++) {
        struct carom_world *world = new_lump(&random);
        struct carom_paint paint = {.palette = palette, .ramps = 8, .smooth = &carom_smooth};
        struct carom_picture picture = {.pixels = wide,
                                        .width = WIDE,
                                        .height = WIDE,
                                        .stride = WIDE * 4,
                                        .format = CAROM_XRGB8888,
                                        .workspace = lump_space,
                                        .workspace_bytes = sizeof lump_space,
                                        .paint = &paint};
        struct carom_camera camera = {.focal_q16 = 1 << 16};
        double light[3], eye[3], target[3], centre[3];
        static uint8_t bytes[WIDE * WIDE];

        for (int k = 0; k < 3; k++) {
            camera.eye.c[k] = test_random_range(&random, Q32(-3, 1), Q32(3, 1));
            camera.target.c[k] = test_random_range(&random, Q32(-1, 8), Q32(1, 8));
            paint.light.c[k] = (int32_t)test_random_range(&random, -1000, 1000);
            light[k] = paint.light.c[k];
            centre[k] = lump.mass.centre.c[k] / 4194304.0;
        }
        camera.eye.c[i % 3] = i % 2 ? Q32(3, 1) : Q32(-3, 1);
        for (int k = 0; k < 3; k++) {
            eye[k] = (double)camera.eye.c[k] / 4294967296.0;
            target[k] = (double)camera.target.c[k] / 4294967296.0;
        }
        paint.crease_q30 =
            i % 4 ? (int32_t)test_random_range(&random, -CAROM_ONE_Q30, CAROM_ONE_Q30 - 1000000)
                  : 0;
        unit(light);
        find_shades(&o, light, paint.crease_q30 ? paint.crease_q30 / 1073741824.0 : 0.6427876);
        project(&o, centre, eye, target);
        CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        picture.pixels = bytes;
        picture.format = CAROM_PALETTE8;
        picture.stride = WIDE;
        CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        for (int p = 0; p < WIDE * WIDE; p++) {
            double want = see(&o, p % WIDE + 0.5, p / WIDE + 0.5) - 0.5;
            double more = slack(&o, p % WIDE + 0.5, p / WIDE + 0.5);
            double apart = (wide[p] & 0xffff) / 8.0 - (want < 0 ? 0 : want > 31 ? 31 : want);
            double beside = bytes[p] % DRAW_SHADES - want;

            /* a face with one shade shows a single shade of the palette */
            more = more >= 0 && more < 0.01 ? 0.3 : more;
            if (more >= 0) {
                seen++;
                CHECK_EQ(wide[p] >> 16, DRAW_MOVING);
                wrong[0] += apart > 0.3 + more || apart < -0.3 - more;
                wrong[1] += beside > 1.3 + more || beside < -1.3 - more;
            }
        }
    }
    CHECK_MORE(seen, 200 * LUMPS);
    /* thin faces are tilted by more */
    CHECK_NEAR(wrong[0], 0, seen / 1000);
    CHECK_NEAR(wrong[1], 0, seen / 1000);
}

/*
 * Entries are red and green in turn. What lies between two entries is rounded down in each colour, so red and green, whose exact
 * sum is 255, are 254 together where both are parts of 255, and never a number that one of the entries does not reach.
 */
static void between(void)
{
    static uint32_t palette[256];
    struct test_random random = {79};
    struct carom_world *world = new_lump(&random);
    struct carom_paint paint = {
        .palette = palette, .ramps = 8, .smooth = &carom_smooth, .crease_q30 = -CAROM_ONE_Q30};
    struct carom_picture picture = picture_of_size(wide, WIDE, WIDE, lump_space, sizeof lump_space);
    struct carom_camera camera = {
        .eye = {{0, Q32(-1, 64), Q32(5, 4)}}, .target = {{0, 0, 0}}, .focal_q16 = 4 << 16};
    int parts = 0;

    for (int i = 0; i < 256; i++) {
        palette[i] = i % 2 ? 0xff00c8 : 0x00ffc8;
    }
    picture.stride = WIDE * 4;
    picture.format = CAROM_XRGB8888;
    picture.paint = &paint;
    CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
    for (int p = 0; p < WIDE * WIDE; p++) {
        const uint32_t red = wide[p] >> 16, green = wide[p] >> 8 & 255;
        const bool whole = red == 255 || green == 255;

        CHECK_EQ(wide[p] & 255, 0xc8);
        CHECK_EQ(red + green, whole ? 255 : 254);
        parts += !whole;
    }
    CHECK_MORE(parts, WIDE * WIDE / 2);
}

/*
 * Along an edge that is no crease, both sides have the same shades; at a crease they have the
 * shades of their faces.
 */
static void edges(void)
{
    static uint32_t palette[256];
    struct test_random random = {78};
    int steps = 0;

    number_palette(palette);
    for (int i = 0; i < LUMPS; i++) {
        struct carom_world *world = new_lump(&random);
        struct carom_paint paint = {
            .palette = palette, .ramps = 8, .smooth = &carom_smooth, .crease_q30 = -CAROM_ONE_Q30};
        struct carom_picture picture = {.pixels = wide,
                                        .width = WIDE,
                                        .height = WIDE,
                                        .stride = WIDE * 4,
                                        .format = CAROM_XRGB8888,
                                        .workspace = lump_space,
                                        .workspace_bytes = sizeof lump_space,
                                        .paint = &paint};
        /* so near that a few faces fill the picture */
        struct carom_camera camera = {
            .eye = {{0, Q32(-1, 64), Q32(5, 4)}}, .target = {{0, 0, 0}}, .focal_q16 = 4 << 16};

        CHECK_EQ(carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        for (int p = WIDE; p < WIDE * WIDE; p++) {
            int left = (int)(wide[p] & 0xffff) - (int)(wide[p % WIDE ? p - 1 : p] & 0xffff);
            int up = (int)(wide[p] & 0xffff) - (int)(wide[p - WIDE] & 0xffff);

            CHECK_EQ(wide[p] >> 16, DRAW_MOVING);
            steps += left > 12 || left < -12 || up > 12 || up < -12;
        }
    }
    CHECK_EQ(steps, 0);
}

/*
 * Boxes keep their faces: in every format the picture is the same as without smooth shades, except
 * for the background, which none shows. Cameras are near, and most cut faces off.
 */
static void boxes(void)
{
    static uint32_t plain_pixels[SIZE * SIZE], smooth_pixels[SIZE * SIZE];
    static const struct carom_paint paint = {.smooth = &carom_smooth};
    static const uint8_t bits[] = {8, 16, 32, 4, 16};
    struct test_random random = {82};
    struct carom_world *world = new_world();
    struct carom_camera near = above;

    near.eye.c[2] = Q32(1, 1);
    add_scene(world);
    for (int i = 0; i < 50; i++) {
        const uint8_t format = (uint8_t)(i % 5);
        struct carom_picture picture = picture_8();

        picture.format = format;
        picture.stride = SIZE * bits[format] / 8;
        picture.pixels = plain_pixels;
        memset(plain_pixels, 0, sizeof plain_pixels);
        memset(smooth_pixels, 0, sizeof smooth_pixels);
        CHECK_EQ(carom_draw(world, &near, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        picture.paint = &paint;
        picture.pixels = smooth_pixels;
        CHECK_EQ(carom_draw(world, &near, &picture, CAROM_DRAW_FLAT), CAROM_OK);
        CHECK_EQ(memcmp(plain_pixels, smooth_pixels, sizeof plain_pixels), 0);
        for (int k = 0; k < 2; k++) {
            near.eye.c[k] = test_random_range(&random, Q32(-2, 1), Q32(2, 1));
            near.target.c[k] = near.eye.c[k] + test_random_range(&random, Q32(-1, 4), Q32(1, 4));
        }
        near.eye.c[2] = test_random_range(&random, Q32(-3, 4), Q32(1, 1));
        near.target.c[2] = near.eye.c[2] - Q32(1, 1);
        near.focal_q16 = (int32_t)test_random_range(&random, 1, 16) << 16;
    }
}

/*
 * Too little workspace is refused with its own error; the workspace that the engine asks for is
 * enough.
 */
static void room(void)
{
    struct test_random random = {79};
    struct carom_world *world = new_lump(&random);
    struct carom_paint paint = {.smooth = &carom_smooth};
    struct carom_picture picture = picture_8();
    size_t least = CAROM_DRAW_BYTES_LEAST(VERTICES, FACES) + CAROM_SMOOTH_BYTES(VERTICES, 0);
    static uint8_t parts[SIZE][SIZE];

    picture.paint = &paint;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
    picture.pixels = parts;
    picture.workspace_bytes = least;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
    CHECK_EQ(memcmp(parts, pixels, sizeof pixels), 0);
    picture.workspace_bytes = 8000;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_ERR_MEMORY);
    picture = picture_8();
    picture.paint = &paint;
    paint.crease_q30 = CAROM_ONE_Q30 + 1;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_ERR_ARGUMENT);
    paint.crease_q30 = -CAROM_ONE_Q30 - 1;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_ERR_ARGUMENT);
    paint.crease_q30 = -CAROM_ONE_Q30;
    CHECK_EQ(carom_draw(world, &above, &picture, CAROM_DRAW_FLAT), CAROM_OK);
}

/* All faces of a vertex give it one shade, the mean, whichever asks first. */
static void shared(void)
{
    static struct oracle o;
    static uint16_t shade_room[VERTICES];
    static const double light[3] = {0.6, 0, 0.8};
    struct test_random random = {80};
    struct draw_body body = {.mesh = &lump};
    const struct draw_shades shades = {&body, shade_room, -CAROM_ONE_Q30, 1u << 28};

    make_lump(&random);
    find_shades(&o, light, -2);
    for (int k = 0; k < 3; k++) {
        body.light.c[k] = (int32_t)(light[k] * CAROM_ONE_Q30);
    }
    for (int first = 0; first < FACES; first += 9) {
        int32_t of[VERTICES], corner[3];

        memset(shade_room, 0, sizeof shade_room);
        memset(of, -1, sizeof of);
        for (int f = first; f < first + FACES; f++) {
            carom_smooth.corners(&shades, (uint32_t)f % FACES, corner);
            for (int k = 0; k < 3; k++) {
                const int v = faces[f % FACES][k];

                of[v] = of[v] < 0 ? corner[k] : of[v];
                CHECK_EQ(corner[k], of[v]);
                /* faces within a degree count as one of them: 16 sin(1 degree) shades, over 3 faces or more */
                CHECK_NEAR(corner[k], (int32_t)(o.corner[f % FACES][k] * 256), 24);
            }
        }
    }
}

/* List a triangle whose corners are at these places, q4, with the top one first; the colour that its shades give it. */
static uint32_t tinted(const int32_t (*corner_q4)[2], const int32_t shade_q8[3],
                       struct draw_list *list)
{
    static struct draw_vertex corners[4];
    static struct draw_face listed[3];

    *list = (struct draw_list){
        .vertices = corners, .faces = &listed[2], .vertex_count = 4, .face_count = 2};
    for (int k = 0; k < 3; k++) {
        corners[k + 1].yx_q4 = corner_q4[k][1] * 65536 + (corner_q4[k][0] & 0xffff);
    }
    listed[1] = (struct draw_face){.corner = {1, 2, 3}, .colour = 2 * DRAW_SHADES};
    carom_smooth.tint(list, &listed[1], shade_q8);
    return listed[1].colour;
}

/* Faces in which more than 32 shades pass within a pixel, across or down, have one shade, the mean; others have a shade at each pixel. */
static void thin(void)
{
    static const int32_t shade_q8[2][3] = {{31 * 256, 31 * 256, 256}, {31 * 256, 256, 31 * 256}};
    struct draw_list list;

    for (int32_t wide_q4 = 2; wide_q4 <= 32; wide_q4++) {
        const int32_t across[3][2] = {{0, 0}, {0, 800}, {wide_q4, 0}};
        const int32_t down[3][2] = {{0, 0}, {0, wide_q4}, {800, 0}};
        const bool steep = 30 * 16 > 32 * wide_q4; /* 30 shades over that width */

        if (30 * 16 != 32 * wide_q4) {
            for (int turned = 0; turned < 2; turned++) {
                CHECK_EQ(tinted(turned ? down : across, shade_q8[turned], &list),
                         2 * DRAW_SHADES + (steep ? (31 + 31 + 1) / 3 : DRAW_TINT));
                CHECK_EQ(list.face_count, steep ? 2 : 3);
            }
        }
    }
}

const struct test tests_draw_smooth[] = {
    {"draw_smooth/oracle", oracle}, {"draw_smooth/between", between},
    {"draw_smooth/edges", edges},   {"draw_smooth/boxes", boxes},
    {"draw_smooth/room", room},     {"draw_smooth/shared", shared},
    {"draw_smooth/thin", thin},     {0}};
