/* SPDX-License-Identifier: MIT */
/* Volume, centre of mass and inertia of meshes, and the inverse of inertia. */
#include <string.h>

#include "mesh/mass.h"
#include "lib/box.h"
#include "lib/test.h"

#ifdef TEST_LONG
#define CASES 2000
#else
#define CASES 60
#endif

static double power(double base, int n)
{
    double p = 1;

    for (int i = 0; i < (n < 0 ? -n : n); i++) {
        p *= base;
    }
    return n < 0 ? 1 / p : p;
}

static double magnitude(double v)
{
    return v < 0 ? -v : v;
}

/* A mesh with room for a few boxes. */
struct shape {
    int16_t vertices[24][3];
    uint16_t faces[36][3];
    struct carom_mesh_raw raw;
};

static void finish(struct shape *s, uint32_t vertices, uint32_t faces, int quantum_bits)
{
    s->raw.vertices = (const int16_t(*)[3])s->vertices;
    s->raw.faces = (const uint16_t(*)[3])s->faces;
    s->raw.vertex_count = vertices;
    s->raw.face_count = faces;
    s->raw.quantum_bits = (uint8_t)quantum_bits;
    s->raw.kind = CAROM_SOLID;
}

static void add_box(struct shape *s, const int16_t low[3], const int16_t high[3], int quantum_bits)
{
    const int from[3] = {low[0], low[1], low[2]}, to[3] = {high[0], high[1], high[2]};
    uint32_t v = s->raw.vertex_count, f = s->raw.face_count;

    box_corners(s->vertices + v, from, to);
    for (int i = 0; i < 12; i++) {
        for (int k = 0; k < 3; k++) {
            s->faces[f + (uint32_t)i][k] = (uint16_t)(v + box_faces[i][k]);
        }
    }
    finish(s, v + 8, f + 12, quantum_bits);
}

/* A tetrahedron by four corners, outward whichever way they turn; false if it is flat. */
static bool close_tetrahedron(struct shape *s, int quantum_bits)
{
    static const uint16_t sides[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    int64_t det = 0, e[3][3];

    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            e[i][k] = s->vertices[i + 1][k] - s->vertices[0][k];
        }
    }
    for (int i = 0; i < 3; i++) {
        det += e[0][i] *
               (e[1][(i + 1) % 3] * e[2][(i + 2) % 3] - e[1][(i + 2) % 3] * e[2][(i + 1) % 3]);
    }
    memcpy(s->faces, sides, sizeof sides);
    for (int i = 0; det < 0 && i < 4; i++) {
        s->faces[i][0] = sides[i][1];
        s->faces[i][1] = sides[i][0];
    }
    finish(s, 4, 4, quantum_bits);
    return det != 0;
}

static void make_tetrahedron(struct shape *s, struct test_random *r, int quantum_bits)
{
    do {
        for (int i = 0; i < 4; i++) {
            for (int k = 0; k < 3; k++) {
                s->vertices[i][k] = (int16_t)test_random_range(r, -32768, 32767);
            }
        }
    } while (!close_tetrahedron(s, quantum_bits));
}

/* A tetrahedron with its last corner, or its last two corners, within two quanta of those before. */
static void make_thin(struct shape *s, struct test_random *r, int near)
{
    do {
        make_tetrahedron(s, r, 8);
        for (int i = 4 - near; i < 4; i++) {
            const int64_t part = test_random_range(r, 0, 1024);

            for (int k = 0; k < 3; k++) {
                const int16_t *from = s->vertices[0], *to = s->vertices[1];
                int64_t at = from[k] + (to[k] - from[k]) * part / 1024;

                at += test_random_range(r, -2, 2);
                s->vertices[i][k] = (int16_t)(at < -32768 ? -32768 : at > 32767 ? 32767 : at);
            }
        }
    } while (!close_tetrahedron(s, 8));
}

static double entry(const struct carom_sym3 *s, int n)
{
    return (double)s->m[n] * power(0.5, s->e);
}

/* ------------------------------------------------------------------------ mass */

/* A box has (b^2 + c^2) / 12, at any place and with any quantum. */
static void test_box(void)
{
    struct test_random r = {1};

    for (int n = 0; n < CASES; n++) {
        struct shape s = {.raw = {0}};
        struct carom_mass m;
        int16_t low[3], high[3];
        double side[3], quantum, volume, largest = 0;
        int bits = 7 + n % 14;

        quantum = power(0.5, bits);
        for (int k = 0; k < 3; k++) {
            low[k] = (int16_t)test_random_range(&r, -32768, n % 3 ? 32000 : 32766);
            high[k] = (int16_t)test_random_range(&r, low[k] + 1, n % 3 ? 32767 : low[k] + 1);
            side[k] = (high[k] - low[k]) * quantum;
        }
        add_box(&s, low, high, bits);
        CHECK_EQ(mass_of_mesh(&s.raw, &m), CAROM_OK);
        volume = side[0] * side[1] * side[2] * 4294967296.0;
        CHECK_AT_MOST(magnitude((double)m.volume_q32 - volume), 0.5 + volume * 1e-15);
        for (int k = 0; k < 3; k++) {
            double i =
                (side[(k + 1) % 3] * side[(k + 1) % 3] + side[(k + 2) % 3] * side[(k + 2) % 3]) /
                12;

            largest = i > largest ? i : largest;
        }
        for (int k = 0; k < 3; k++) {
            double i =
                (side[(k + 1) % 3] * side[(k + 1) % 3] + side[(k + 2) % 3] * side[(k + 2) % 3]) /
                12;

            /* a centre has one more bit than a quantum: it is exact in q22 */
            CHECK_EQ(m.centre.c[k], carom_shl(low[k] + high[k], 21 - bits));
            CHECK_AT_MOST(magnitude(entry(&m.inertia, k) - i), 1e-8 * largest);
            CHECK_AT_MOST(magnitude(entry(&m.inertia, 3 + k)), 1e-8 * largest);
        }
    }
}

/*
 * A tetrahedron's covariance is 1/20 of the sum of d d^T; d leads from the centre to each corner.
 */
static void test_tetrahedron(void)
{
    struct test_random r = {2};

    for (int n = 0; n < CASES; n++) {
        struct shape s;
        struct carom_mass m;
        int bits = 7 + n % 14;
        double quantum = power(0.5, bits), centre[3], cov[3][3], largest = 0, expected[6];

        make_tetrahedron(&s, &r, bits);
        CHECK_EQ(mass_of_mesh(&s.raw, &m), CAROM_OK);
        for (int k = 0; k < 3; k++) {
            int32_t sum = 0;

            for (int i = 0; i < 4; i++) {
                sum += s.vertices[i][k];
            }
            centre[k] = sum / 4.0;
            CHECK_EQ(m.centre.c[k], carom_shl(sum, 20 - bits));
        }
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) {
                cov[i][j] = 0;
                for (int v = 0; v < 4; v++) {
                    cov[i][j] += (s.vertices[v][i] - centre[i]) * (s.vertices[v][j] - centre[j]) *
                                 quantum * quantum / 20;
                }
            }
        }
        for (int k = 0; k < 3; k++) {
            expected[k] = cov[(k + 1) % 3][(k + 1) % 3] + cov[(k + 2) % 3][(k + 2) % 3];
            expected[3 + k] = -cov[k][(k + 1) % 3];
            largest = expected[k] > largest ? expected[k] : largest;
        }
        for (int k = 0; k < 6; k++) {
            CHECK_AT_MOST(magnitude(entry(&m.inertia, k) - expected[k]), 1e-8 * largest);
        }
    }
}

/* Two boxes that do not touch: volumes add, and the parallel axis theorem gives the rest. */
static void check_two_boxes(const int16_t a0[3], const int16_t a1[3], const int16_t b0[3],
                            const int16_t b1[3], int bits)
{
    struct shape s = {.raw = {0}};
    struct carom_mass m;
    double quantum = power(0.5, bits);
    double mass[2], centre[2][3], mean[3], own[2][3], expected[6], total;

    add_box(&s, a0, a1, bits);
    add_box(&s, b0, b1, bits);
    CHECK_EQ(mass_of_mesh(&s.raw, &m), CAROM_OK);
    mass[0] = mass[1] = 1;
    for (int k = 0; k < 3; k++) {
        double side_a = (a1[k] - a0[k]) * quantum, side_b = (b1[k] - b0[k]) * quantum;

        mass[0] *= side_a;
        mass[1] *= side_b;
        centre[0][k] = (a0[k] + a1[k]) * quantum / 2;
        centre[1][k] = (b0[k] + b1[k]) * quantum / 2;
        own[0][k] = side_a * side_a / 12; /* its own variance along the axis */
        own[1][k] = side_b * side_b / 12;
    }
    total = mass[0] + mass[1];
    for (int k = 0; k < 3; k++) {
        mean[k] = (mass[0] * centre[0][k] + mass[1] * centre[1][k]) / total;
    }
    for (int k = 0; k < 3; k++) {
        int j = (k + 1) % 3, l = (k + 2) % 3;

        expected[k] = expected[3 + k] = 0;
        for (int i = 0; i < 2; i++) {
            double dj = centre[i][j] - mean[j], dl = centre[i][l] - mean[l];
            double dk = centre[i][k] - mean[k];

            expected[k] += mass[i] / total * (own[i][j] + own[i][l] + dj * dj + dl * dl);
            expected[3 + k] -= mass[i] / total * dk * dj;
        }
    }
    CHECK_AT_MOST(magnitude((double)m.volume_q32 - total * 4294967296.0), 1 + total * 1e-5);
    for (int k = 0; k < 3; k++) {
        CHECK_AT_MOST(magnitude(m.centre.c[k] - mean[k] * 4194304), 0.5 + 1e-6);
        CHECK_AT_MOST(magnitude(entry(&m.inertia, k) - expected[k]), 1e-8 * expected[1]);
        CHECK_AT_MOST(magnitude(entry(&m.inertia, 3 + k) - expected[3 + k]), 1e-8 * expected[1]);
    }
}

static void test_two_boxes(void)
{
    const int16_t a0[3] = {-3000, 100, 7}, a1[3] = {-1000, 900, 507};
    const int16_t b0[3] = {2000, -500, -900}, b1[3] = {2300, 400, -100};
    const int16_t far0[3] = {32001, -32767, 31000}, far1[3] = {32010, -32757, 31007};
    const int16_t beside0[3] = {32400, -32767, 31000}, beside1[3] = {32403, -32766, 31001};

    check_two_boxes(a0, a1, b0, b1, 10);
    /* far out and in large quanta, where a centre has more than 30 bits */
    check_two_boxes(far0, far1, beside0, beside1, 7);
}

/*
 * A mesh moved by whole quanta keeps its volume, its inertia and its shifted centre, bit for bit.
 */
static void test_moved(void)
{
    struct shape s = {.raw = {0}};
    struct carom_mass m, moved;
    const int16_t low[3] = {-31, 2, 5}, high[3] = {12, 33, 100}, by[3] = {32000, -32001, -300};

    add_box(&s, low, high, 12);
    s.vertices[7][0] = 29; /* not quite a box */
    CHECK_EQ(mass_of_mesh(&s.raw, &m), CAROM_OK);
    for (int v = 0; v < 8; v++) {
        for (int k = 0; k < 3; k++) {
            s.vertices[v][k] = (int16_t)(s.vertices[v][k] + by[k]);
        }
    }
    CHECK_EQ(mass_of_mesh(&s.raw, &moved), CAROM_OK);
    CHECK_EQ(moved.volume_q32, m.volume_q32);
    CHECK_EQ(memcmp(&moved.inertia, &m.inertia, sizeof m.inertia), 0);
    for (int k = 0; k < 3; k++) {
        CHECK_EQ(moved.centre.c[k], m.centre.c[k] + by[k] * 1024);
    }
}

static void turn_inside_out(struct shape *s, uint32_t first, uint32_t count)
{
    for (uint32_t f = first; f < first + count; f++) {
        uint16_t v = s->faces[f][0];

        s->faces[f][0] = s->faces[f][1];
        s->faces[f][1] = v;
    }
}

static void test_refused(void)
{
    struct carom_mass m, before;
    const int16_t a0[3] = {0, 0, 0}, a1[3] = {100, 100, 100};
    const int16_t b0[3] = {200, 0, 0}, b1[3] = {300, 100, 99}, whole0[3] = {-32768, -32768, -32768};
    const int16_t whole1[3] = {32767, 32767, 32767};
    static struct shape s, pair, twice; /* too large for the stack of a small board */

    memset(&m, 0x5a, sizeof m);
    before = m;
    add_box(&s, a0, a1, 8);
    turn_inside_out(&s, 0, 12);
    CHECK_EQ(mass_of_mesh(&s.raw, &m), CAROM_ERR_MESH_INSIDE_OUT);

    for (int v = 0; v < 8; v++) {
        s.vertices[v][2] = 7;
    }
    CHECK_EQ(mass_of_mesh(&s.raw, &m), CAROM_ERR_MESH_EMPTY);

    /* 1 % more outside than inside: the centre is a hundred boxes away */
    add_box(&pair, a0, a1, 8);
    add_box(&pair, b0, b1, 8);
    turn_inside_out(&pair, 12, 12);
    CHECK_EQ(mass_of_mesh(&pair.raw, &m), CAROM_ERR_MESH_INSIDE_OUT);
    for (int v = 0; v < 16; v++) {
        pair.vertices[v][0] = (int16_t)-pair.vertices[v][0];
    }
    turn_inside_out(&pair, 0, 24);
    CHECK_EQ(mass_of_mesh(&pair.raw, &m), CAROM_ERR_MESH_INSIDE_OUT);

    /* twice the largest volume */
    add_box(&twice, whole0, whole1, 8);
    add_box(&twice, whole0, whole1, 8);
    CHECK_EQ(mass_of_mesh(&twice.raw, &m), CAROM_ERR_RANGE);
    CHECK_EQ(memcmp(&m, &before, sizeof m), 0);
}

/*
 * A cube with a rod of 14 x 14 x 100 that is inside out, 200 to 300 from its middle: volume, centre and moments are those of a solid, but
 * along the way to the rod the second moment of the cube, 8.3e8, is less than that of the rod, 1.2e9. The rod lies along an axis, or
 * in the diagonal of two, where no moment about an axis shows it.
 */
static void test_no_solid(void)
{
    static struct shape s;
    struct carom_mass m;

    for (int way = 0; way < 6; way++) {
        const int axis = way % 3;
        int16_t low[3] = {-50, -50, -50}, high[3] = {50, 50, 50};

        memset(&s, 0, sizeof s);
        add_box(&s, low, high, 8);
        CHECK_EQ(mass_of_mesh(&s.raw, &m), CAROM_OK);
        for (int k = 0; k < 3; k++) {
            low[k] = -7;
            high[k] = 7;
        }
        low[axis] = 200;
        high[axis] = 300;
        if (way > 2) {
            low[axis] = low[(axis + 1) % 3] = 150;
            high[axis] = high[(axis + 1) % 3] = 177; /* 27 x 27 x 27 has the volume of the rod */
            low[(axis + 2) % 3] = -13;
            high[(axis + 2) % 3] = 14;
        }
        add_box(&s, low, high, 8);
        turn_inside_out(&s, 12, 12);
        CHECK_EQ(mass_of_mesh(&s.raw, &m), CAROM_ERR_MESH_INSIDE_OUT);
    }
}

/* Solids of almost no thickness in one direction or two have an inertia, though rounding takes a second moment below 0. */
static void test_thin(void)
{
    struct test_random r = {11};
    static struct shape s;
    struct carom_mass m;

    for (int i = 0; i < CASES; i++) {
        make_thin(&s, &r, 1 + i % 2);
        CHECK_EQ(mass_of_mesh(&s.raw, &m), CAROM_OK);
    }
}

/* ---------------------------------------------------------------------- invert */

static const uint8_t place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

/* The largest entry of in (out + rest) - 1. */
static double inverse_error(const struct carom_sym3 *in, const struct carom_sym3 *out,
                            const struct carom_sym3 *rest)
{
    double worst = 0;

    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            double sum = i == j ? -1 : 0;

            for (int k = 0; k < 3; k++) {
                sum += entry(in, place[i][k]) * entry(out, place[k][j]);
            }
            /* the second word is small: added last, it loses no digits */
            for (int k = 0; k < 3; k++) {
                sum += entry(in, place[i][k]) * entry(rest, place[k][j]);
            }
            worst = magnitude(sum) > worst ? magnitude(sum) : worst;
        }
    }
    return worst;
}

/* The inertia of a box with given sides, turned by a reflection: H = 1 - 2 u u^T / |u|^2. */
static void turned_inertia(struct test_random *r, const double side[3], struct carom_sym3 *a)
{
    double u[3], square = 0, m[6], largest = 0;

    for (int k = 0; k < 3; k++) {
        u[k] = (double)test_random_range(r, -100, 100) / 100 + 0.001;
        square += u[k] * u[k];
    }
    for (int n = 0; n < 9; n++) {
        int i = n / 3, j = n % 3;
        double sum = 0;

        for (int k = 0; k < 3; k++) {
            double hi = (i == k) - 2 * u[i] * u[k] / square;
            double hj = (j == k) - 2 * u[j] * u[k] / square;

            sum += hi * hj *
                   (side[(k + 1) % 3] * side[(k + 1) % 3] + side[(k + 2) % 3] * side[(k + 2) % 3]);
        }
        m[place[i][j]] = sum;
        largest = magnitude(sum) > largest ? magnitude(sum) : largest;
    }
    a->e = 0;
    while (largest * power(2, a->e) < power(2, 29)) {
        a->e++;
    }
    for (int k = 0; k < 6; k++) {
        a->m[k] = (int32_t)(m[k] * power(2, a->e));
    }
}

/* The inertia of the n-th box, turned: from cubes to needles of 500:1, with any exponent. */
static void some_inertia(struct test_random *r, int n, struct carom_sym3 *a)
{
    double side[3];

    for (int k = 0; k < 3; k++) {
        side[k] = power(2, (int)test_random_range(r, 0, n % 2 ? 5 : 1)) +
                  (double)test_random_range(r, 0, 100) / 200;
    }
    if (n % 4 == 0) {
        side[n % 3] = 500 * side[(n + 1) % 3];
    }
    turned_inertia(r, side, a);
    a->e += (int32_t)test_random_range(r, -20, 60);
}

/*
 * The digits below both words, 2^-59 of the largest entry, count as often as the moments of inertia
 * differ, up to 2^18 times.
 */
static void test_invert(void)
{
    struct test_random r = {3};

    for (int n = 0; n < CASES; n++) {
        struct carom_sym3 a, b, rest;

        some_inertia(&r, n, &a);
        CHECK_EQ(mass_invert(&a, &b, &rest), 0);
        CHECK_LESS(inverse_error(&a, &b, &rest), 1e-10);
    }
}

/* h . a h' of two columns, in the units in which it is 1 or 0. */
static double in_inertia(const struct carom_sym3 *a, const struct carom_spread *s, int i, int j)
{
    double sum = 0;

    for (int k = 0; k < 3; k++) {
        for (int m = 0; m < 3; m++) {
            sum += s->column[i][k] * power(2, -s->e[i]) * entry(a, place[k][m]) * s->column[j][m] *
                   power(2, -s->e[j]);
        }
    }
    return sum;
}

/*
 * H H^T = J^-1 means that H^T J H = 1. The test checks that for matrices from cubes to needles of
 * 500:1; a needle's moments enlarge the 2^-27 of a column 2^9 times.
 */
static void test_spread(void)
{
    struct test_random r = {4};

    for (int n = 0; n < CASES; n++) {
        struct carom_sym3 a;
        struct carom_spread s;

        some_inertia(&r, n, &a);
        mass_spread(&a, &s);
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j <= i; j++) {
                CHECK_LESS(magnitude(in_inertia(&a, &s, i, j) - (i == j)), 1e-5);
            }
        }
    }
}

static void test_invert_exact(void)
{
    /* 2, 4, 8 on the diagonal; 1/2, 1/4, 1/8 */
    struct carom_sym3 a = {{2, 4, 8, 0, 0, 0}, 0}, b, rest;
    /* 1/3 has infinitely many digits: the second word continues them */
    struct carom_sym3 three = {{3, 3, 3, 0, 0, 0}, 0};
    struct carom_sym3 flat = {{1 << 29, 1 << 29, 1 << 29, 1 << 29, 1 << 29, 1 << 29}, 30};
    struct carom_sym3 line = {{1 << 29, 1 << 29, 31, 0, 0, 0}, 30}, zero = {{0}, 0};

    CHECK_EQ(mass_invert(&a, &b, &rest), 0);
    CHECK_EQ(b.m[0], (int64_t)1 << (b.e - 1));
    CHECK_EQ(b.m[1], (int64_t)1 << (b.e - 2));
    CHECK_EQ(b.m[2], (int64_t)1 << (b.e - 3));
    CHECK_EQ(b.m[3], 0);
    CHECK_EQ(b.m[4], 0);
    CHECK_EQ(b.m[5], 0);
    for (int n = 0; n < 6; n++) {
        CHECK_EQ(rest.m[n], 0);
    }
    CHECK_EQ(mass_invert(&three, &b, &rest), 0);
    CHECK_EQ(rest.e - b.e, 29);
    CHECK_NEAR(3 * (((int64_t)b.m[1] << 29) + rest.m[1]), (int64_t)1 << rest.e, 3);
    CHECK_EQ(mass_invert(&flat, &b, &rest), -1);
    CHECK_EQ(mass_invert(&zero, &b, &rest), -1);
    /* the smallest moment allowed is 2^-24 of the largest */
    CHECK_EQ(mass_invert(&line, &b, &rest), -1);
    line.m[2] = 64;
    CHECK_EQ(mass_invert(&line, &b, &rest), 0);
    /* positive determinants of no inertia: two of their moments are below 0 */
    for (int k = 0; k < 3; k++) {
        struct carom_sym3 two = {{-(1 << 29), -(1 << 29), -(1 << 29), 0, 0, 0}, 30};
        struct carom_sym3 turned = {{-(1 << 27), -(1 << 27), -(1 << 27), 0, 0, 0}, 30};

        two.m[k] = 1 << 29;
        CHECK_EQ(mass_invert(&two, &b, &rest), -1);
        /* moments 1, -3 and -3 in 2^27: only the cofactor of axis k is below 0 */
        turned.m[k] *= 3;
        turned.m[3 + (k + 1) % 3] = 1 << 28;
        CHECK_EQ(mass_invert(&turned, &b, &rest), -1);
    }
}

const struct test tests_mesh_mass[] = {
    {"mesh_mass/box", test_box},
    {"mesh_mass/tetrahedron", test_tetrahedron},
    {"mesh_mass/two_boxes", test_two_boxes},
    {"mesh_mass/moved", test_moved},
    {"mesh_mass/refused", test_refused},
    {"mesh_mass/no_solid", test_no_solid},
    {"mesh_mass/thin", test_thin},
    {"mesh_mass/invert", test_invert},
    {"mesh_mass/spread", test_spread},
    {"mesh_mass/invert_exact", test_invert_exact},
    {0},
};
