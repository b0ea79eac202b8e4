/* SPDX-License-Identifier: MIT */
/* Random solids and surfaces, the same on every machine. */
#include <string.h>

#include "lab.h"
#include "real.h"
#include "soak_shapes.h"

#define OUTLINE 128 /* corners of a prism */
#define QUANTA  16000

const char *const soak_kind_names[SOAK_KINDS] = {"hull",   "box",   "L",     "U",     "star",
                                                 "spikes", "plate", "torus", "needle"};

/* -------------------------------------------------------------------- numbers */

double soak_uniform(struct test_random *r, double low, double high)
{
    return low + (high - low) * real((int64_t)(test_random_next(r) >> 11), 53);
}

/* Between powers of two linearly, because exp2 differs between libraries. */
double soak_powers(struct test_random *r, double low, double high)
{
    int doublings = 0;
    double span = high / low, value;

    while (doublings < 80 && real_power2(doublings) < span) {
        doublings++;
    }
    do {
        value = real_power2(soak_pick(r, doublings));
        value *= soak_uniform(r, 1, 2);
    } while (value > span);
    return low * value;
}

int soak_pick(struct test_random *r, int count)
{
    return (int)test_random_range(r, 0, count - 1);
}

void soak_direction(struct test_random *r, double out[3])
{
    double length;

    do {
        for (int k = 0; k < 3; k++) {
            out[k] = soak_uniform(r, -1, 1);
        }
        length = real_length(out);
    } while (length > 1 || length < 0.1);
    for (int k = 0; k < 3; k++) {
        out[k] /= length;
    }
}

void soak_any_turn(struct test_random *r, double out[4])
{
    double sum;

    do {
        sum = 0;
        for (int k = 0; k < 4; k++) {
            out[k] = soak_uniform(r, -1, 1);
            sum += out[k] * out[k];
        }
    } while (sum > 1 || sum < 0.01);
    for (int k = 0; k < 4; k++) {
        out[k] /= real_sqrt(sum);
    }
}

/* ---------------------------------------------------------------------- parts */

/* A mesh that is being made: its points are turned and scaled. */
struct making {
    struct soak_shape *shape;
    double turn[3][3];
    double scale; /* quanta a unit */
};

static uint32_t vertex(struct making *m, double x, double y, double z)
{
    struct soak_shape *s = m->shape;
    const double p[3] = {x, y, z};

    for (int k = 0; k < 3; k++) {
        s->vertices[s->raw.vertex_count][k] =
            (int16_t)real_round(m->scale * real_dot(m->turn[k], p));
    }
    return s->raw.vertex_count++;
}

static void face(struct making *m, uint32_t a, uint32_t b, uint32_t c)
{
    uint16_t *f = m->shape->faces[m->shape->raw.face_count++];

    f[0] = (uint16_t)a;
    f[1] = (uint16_t)b;
    f[2] = (uint16_t)c;
}

static void square(struct making *m, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    face(m, a, b, c);
    face(m, a, c, d);
}

/* The finest quanta for points within a size; turned at random, or not at all. */
static struct making begin(struct soak_shape *shape, int kind, double size, struct test_random *r)
{
    struct making m = {.shape = shape};
    double turn[4] = {1, 0, 0, 0};
    int bits = 7;

    while (bits < 20 && size * real_power2(bits + 1) <= QUANTA) {
        bits++;
    }
    if (r && soak_pick(r, 3) == 0) {
        soak_any_turn(r, turn);
    }
    real_matrix(m.turn, turn);
    m.scale = real_power2(bits);
    shape->raw.vertices = (const int16_t(*)[3])shape->vertices;
    shape->raw.faces = (const uint16_t(*)[3])shape->faces;
    shape->raw.vertex_count = shape->raw.face_count = 0;
    shape->raw.quantum_bits = (uint8_t)bits;
    shape->raw.kind = (uint8_t)kind;
    return m;
}

/* --------------------------------------------------------------------- prisms */

static double turns(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]);
}

static bool is_ear(const double (*p)[2], const int *left, int count, int i)
{
    const double *a = p[left[(i + count - 1) % count]], *b = p[left[i]],
                 *c = p[left[(i + 1) % count]];

    if (turns(a, b, c) <= 1e-9) {
        return false;
    }
    for (int k = 2; k < count - 1; k++) {
        const double *q = p[left[(i + k) % count]];

        if (turns(a, b, q) > -1e-9 && turns(b, c, q) > -1e-9 && turns(c, a, q) > -1e-9) {
            return false;
        }
    }
    return true;
}

/* Cut ears off the outline until nothing is left. */
static int triangulate(const double (*p)[2], int count, int out[][3])
{
    int left[OUTLINE], found = 0;

    for (int i = 0; i < count; i++) {
        left[i] = i;
    }
    while (count >= 3) {
        int i = 0;

        while (i < count - 1 && count > 3 && !is_ear(p, left, count, i)) {
            i++;
        }
        for (int k = 0; k < 3; k++) {
            out[found][k] = left[(i + count - 1 + k) % count];
        }
        found++;
        memmove(left + i, left + i + 1, (size_t)(count - i - 1) * sizeof *left);
        count--;
    }
    return found;
}

/* A prism over a counter-clockwise outline, from -half to half along z. */
static void prism(struct making *m, const double (*outline)[2], int count, double half)
{
    int caps[OUTLINE][3], found = triangulate(outline, count, caps);

    for (int i = 0; i < 2 * count; i++) {
        vertex(m, outline[i % count][0], outline[i % count][1], i < count ? -half : half);
    }
    for (int i = 0; i < found; i++) {
        uint32_t a = (uint32_t)caps[i][0], b = (uint32_t)caps[i][1], c = (uint32_t)caps[i][2];

        face(m, a, c, b);
        face(m, a + (uint32_t)count, b + (uint32_t)count, c + (uint32_t)count);
    }
    for (int i = 0; i < count; i++) {
        uint32_t a = (uint32_t)i, b = (uint32_t)((i + 1) % count), up = (uint32_t)count;

        square(m, a, b, b + up, a + up);
    }
}

static void circle(double out[2], double radius, int i, int count)
{
    double angle = 2 * REAL_PI * i / count, sine, cosine;

    real_sine_cosine(angle > REAL_PI ? angle - 2 * REAL_PI : angle, &sine, &cosine);
    out[0] = radius * cosine;
    out[1] = radius * sine;
}

static void polygon(struct making *m, int corners, double radius, double half)
{
    double outline[OUTLINE][2];

    for (int i = 0; i < corners; i++) {
        circle(outline[i], radius, i, corners);
    }
    prism(m, (const double(*)[2])outline, corners, half);
}

static void letter_l(struct making *m, double size, struct test_random *r)
{
    double a = size * soak_uniform(r, 0.4, 0.7), b = size * soak_uniform(r, 0.4, 0.7);
    double s = a * soak_uniform(r, 0.1, 1.5), t = b * soak_uniform(r, 0.1, 1.5);
    const double outline[][2] = {{-a, -b},       {a, -b},    {a, t - b},
                                 {s - a, t - b}, {s - a, b}, {-a, b}};

    prism(m, outline, 6, size * soak_uniform(r, 0.05, 0.5));
}

static void letter_u(struct making *m, double size, struct test_random *r)
{
    double a = size * soak_uniform(r, 0.4, 0.7), b = size * soak_uniform(r, 0.4, 0.7);
    double s = a * soak_uniform(r, 0.1, 0.9), t = b * soak_uniform(r, 0.1, 1.5);
    const double outline[][2] = {{-a, -b},       {a, -b},        {a, b},     {a - s, b},
                                 {a - s, t - b}, {s - a, t - b}, {s - a, b}, {-a, b}};

    prism(m, outline, 8, size * soak_uniform(r, 0.05, 0.5));
}

static void star(struct making *m, double size, struct test_random *r)
{
    int points = (int)soak_powers(r, 3, 60);
    double inner = soak_uniform(r, 0.3, 0.85), outline[OUTLINE][2];

    for (int i = 0; i < 2 * points; i++) {
        circle(outline[i], size * (i % 2 ? inner : 0.9), i, 2 * points);
    }
    prism(m, (const double(*)[2])outline, 2 * points, size * soak_uniform(r, 0.03, 0.4));
}

/* --------------------------------------------------------------------- others */

static void torus(struct making *m, double size, struct test_random *r)
{
    int around = 3 + soak_pick(r, 18), across = 3 + soak_pick(r, 10);
    double minor = soak_uniform(r, 0.08, 0.45) * size, major = size - minor;

    for (int i = 0; i < around; i++) {
        for (int j = 0; j < across; j++) {
            double at[2], c[2];

            circle(c, minor, j, across);
            circle(at, major + c[0], i, around);
            vertex(m, at[0], at[1], c[1]);
        }
    }
    for (int i = 0; i < around; i++) {
        for (int j = 0; j < across; j++) {
            int next = (i + 1) % around, up = (j + 1) % across;

            square(m, (uint32_t)(i * across + j), (uint32_t)(next * across + j),
                   (uint32_t)(next * across + up), (uint32_t)(i * across + up));
        }
    }
}

/* Two points and a ring between them. */
static void spindle(struct making *m, int sides, double half, double radius)
{
    uint32_t low = vertex(m, 0, 0, -half), high = vertex(m, 0, 0, half);

    for (int i = 0; i < sides; i++) {
        double at[2];

        circle(at, radius, i, sides);
        vertex(m, at[0], at[1], 0);
    }
    for (int i = 0; i < sides; i++) {
        uint32_t a = 2 + (uint32_t)i, b = 2 + (uint32_t)((i + 1) % sides);

        face(m, a, b, high);
        face(m, b, a, low);
    }
}

static void needle(struct making *m, double size, struct test_random *r)
{
    double thin = size / soak_powers(r, 8, 200);
    int sides = 3 + soak_pick(r, 10);

    if (soak_pick(r, 4) == 0) {
        const double x[4][3] = {
            {thin, 0, -size}, {-thin, 0, -size}, {0, thin, size}, {0, -thin, size}};

        for (int i = 0; i < 4; i++) {
            vertex(m, x[i][0], x[i][1], x[i][2]);
        }
        face(m, 0, 1, 2);
        face(m, 1, 0, 3);
        face(m, 2, 3, 0);
        face(m, 3, 2, 1);
    } else if (soak_pick(r, 2) == 0) {
        spindle(m, sides, size, thin);
    } else {
        polygon(m, sides, thin, size);
    }
}

/* ---------------------------------------------------------------------- hulls */

static void hull(struct making *m, int count, const double axes[3], struct test_random *r)
{
    for (int i = 0; i < count; i++) {
        double p[3];

        soak_direction(r, p);
        vertex(m, axes[0] * p[0], axes[1] * p[1], axes[2] * p[2]);
    }
    soak_wrap(m->shape);
}

/* Whether all faces look away from the origin: then no two meet except at their edges. */
static bool is_around_origin(const struct soak_shape *s)
{
    for (uint32_t f = 0; f < s->raw.face_count; f++) {
        double p[3][3], across[3];

        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 3; k++) {
                p[i][k] = s->vertices[s->faces[f][i]][k];
            }
        }
        real_cross(across, p[1], p[2]);
        if (real_dot(p[0], across) <= 0) {
            return false;
        }
    }
    return true;
}

/* A spike on every face of a small hull; no faces when the hull is not around the origin. */
static void spikes(struct making *m, double size, struct test_random *r)
{
    const double length = size * soak_uniform(r, 0.2, 0.8);
    const double axes[3] = {length, length, length};
    struct soak_shape *s = m->shape;
    uint32_t faces;

    hull(m, (int)soak_powers(r, 4, 80), axes, r);
    faces = is_around_origin(s) ? s->raw.face_count : 0;
    for (uint32_t f = 0; f < faces; f++) {
        const uint16_t a = s->faces[f][0], b = s->faces[f][1], c = s->faces[f][2];
        double p[3], high = m->scale * size * soak_uniform(r, 0.7, 1);
        uint32_t tip = s->raw.vertex_count++;

        for (int k = 0; k < 3; k++) {
            p[k] = s->vertices[a][k] + s->vertices[b][k] + s->vertices[c][k];
        }
        for (int k = 0; k < 3; k++) {
            s->vertices[tip][k] = (int16_t)real_round(high * p[k] / real_length(p));
        }
        s->faces[f][2] = (uint16_t)tip;
        face(m, b, c, tip);
        face(m, c, a, tip);
    }
    s->raw.face_count = faces > 0 && is_around_origin(s) ? s->raw.face_count : 0;
}

/* --------------------------------------------------------------------- shapes */

/* Each number is drawn in a statement of its own: a compiler may evaluate arguments in any order. */
static void draw(struct making *m, enum soak_kind kind, double size, struct test_random *r)
{
    double second = size * soak_powers(r, 0.15, 1), third = size * soak_powers(r, 0.15, 1);
    const double axes[3] = {size, second, third};
    const double half[3] = {0.57 * axes[0], 0.57 * axes[1], 0.57 * axes[2]};
    const double base[4][2] = {
        {-half[0], -half[1]}, {half[0], -half[1]}, {half[0], half[1]}, {-half[0], half[1]}};

    switch (kind) {
    case SOAK_HULL:
        hull(m, (int)soak_powers(r, 4, SOAK_POINTS - 1), axes, r);
        break;
    case SOAK_L:
        letter_l(m, size, r);
        break;
    case SOAK_U:
        letter_u(m, size, r);
        break;
    case SOAK_STAR:
        star(m, size, r);
        break;
    case SOAK_SPIKES:
        spikes(m, size, r);
        break;
    case SOAK_PLATE:
        third = size / soak_powers(r, 10, 150);
        polygon(m, 3 + soak_pick(r, 30), size, third);
        break;
    case SOAK_TORUS:
        torus(m, size, r);
        break;
    case SOAK_NEEDLE:
        needle(m, size, r);
        break;
    default:
        prism(m, base, 4, half[2]);
        break;
    }
}

/* Whether the mesh can be built and moved: the inertia of a very thin one has no inverse. */
static bool builds(const struct soak_shape *shape)
{
    static _Alignas(8) uint8_t block[CAROM_MESH_BYTES(SOAK_VERTICES, SOAK_FACES)];
    struct carom_mesh mesh;

    return shape->raw.face_count > 0 &&
           carom_mesh_build(&mesh, &shape->raw, block, sizeof block) == CAROM_OK &&
           (mesh.inverse.m[0] | mesh.inverse.m[1] | mesh.inverse.m[2]) != 0;
}

int soak_solid(struct soak_shape *shape, enum soak_kind kind, double size, struct test_random *r)
{
    for (int refused = 0; refused < 100; refused++) {
        struct making m = begin(shape, CAROM_SOLID, size, r);

        draw(&m, kind, size, r);
        if (builds(shape)) {
            return refused;
        }
    }
    return lab_expect(CAROM_ERR_MESH_EMPTY, soak_kind_names[kind]);
}

int soak_hull_of(struct soak_shape *shape, int count, double size, struct test_random *r)
{
    const double axes[3] = {size, size, size};

    for (int refused = 0; refused < 100; refused++) {
        struct making m = begin(shape, CAROM_SOLID, size, r);

        hull(&m, count, axes, r);
        if (builds(shape)) {
            return refused;
        }
    }
    return lab_expect(CAROM_ERR_MESH_EMPTY, "hull");
}

void soak_box(struct soak_shape *shape, double x, double y, double z)
{
    double largest = x > y ? x : y;
    struct making m = begin(shape, CAROM_SOLID, (largest > z ? largest : z) / 2, NULL);
    const double base[4][2] = {{-x / 2, -y / 2}, {x / 2, -y / 2}, {x / 2, y / 2}, {-x / 2, y / 2}};

    prism(&m, base, 4, z / 2);
}

void soak_surface(struct soak_shape *shape, int n, double side, double rough, struct test_random *r)
{
    double half = n * side / 2;
    struct making m = begin(shape, CAROM_SURFACE, half > rough ? half : rough, NULL);

    for (int y = 0; y <= n; y++) {
        for (int x = 0; x <= n; x++) {
            vertex(&m, x * side - half, y * side - half, soak_uniform(r, 0, rough));
        }
    }
    for (int y = 0; y < n; y++) {
        for (int x = 0; x < n; x++) {
            uint32_t v = (uint32_t)(y * (n + 1) + x), above = v + (uint32_t)n + 1;

            square(&m, v, v + 1, above + 1, above);
        }
    }
}
