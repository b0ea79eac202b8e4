/* SPDX-License-Identifier: MIT */
/* Scan conversion of polygons into cells, compared with all cells. */
#include <string.h>

#include "mesh/scan.h"
#include "lib/test.h"

#ifdef TEST_LONG
#define CASES 20000
#else
#define CASES 80
#endif

static int64_t cross(const int32_t a[2], const int32_t b[2], const int32_t p[2])
{
    return (int64_t)(b[0] - a[0]) * (p[1] - a[1]) - (int64_t)(b[1] - a[1]) * (p[0] - a[0]);
}

/* ------------------------------------------------------------------ polygons */

struct polygon {
    int32_t xy[SCAN_MAX][2];
    int n;
};

static const int32_t (*corners(const struct polygon *p))[2]
{
    return (const int32_t(*)[2])p->xy;
}

static void random_points(struct test_random *r, struct polygon *p, int n, int32_t size)
{
    p->n = n;
    for (int i = 0; i < n; i++) {
        p->xy[i][0] = (int32_t)test_random_range(r, -size, size);
        p->xy[i][1] = (int32_t)test_random_range(r, -size, size);
    }
}

/*
 * Gift wrapping: the counter-clockwise hull of up to 8 points, fewer than 3 when they are in line.
 */
static void random_hull(struct test_random *r, struct polygon *hull, int32_t size)
{
    struct polygon p;
    int start = 0, at;

    random_points(r, &p, SCAN_MAX, size);
    for (int i = 1; i < p.n; i++) {
        if (p.xy[i][0] < p.xy[start][0] ||
            (p.xy[i][0] == p.xy[start][0] && p.xy[i][1] < p.xy[start][1])) {
            start = i;
        }
    }
    hull->n = 0;
    at = start;
    do {
        int next = (at + 1) % p.n;

        memcpy(hull->xy[hull->n++], p.xy[at], sizeof p.xy[at]);
        for (int i = 0; i < p.n; i++) {
            int64_t c = cross(p.xy[at], p.xy[next], p.xy[i]);
            int64_t near =
                carom_abs(p.xy[next][0] - p.xy[at][0]) + carom_abs(p.xy[next][1] - p.xy[at][1]);
            int64_t far = carom_abs(p.xy[i][0] - p.xy[at][0]) + carom_abs(p.xy[i][1] - p.xy[at][1]);

            if (c < 0 || (c == 0 && far > near)) {
                next = i;
            }
        }
        at = next;
    } while (at != start && hull->n < SCAN_MAX);
}

static void reverse(struct polygon *p)
{
    for (int i = 0, j = p->n - 1; i < j; i++, j--) {
        for (int k = 0; k < 2; k++) {
            int32_t v = p->xy[i][k];

            p->xy[i][k] = p->xy[j][k];
            p->xy[j][k] = v;
        }
    }
}

/* --------------------------------------------------------------------- cells */

/*
 * Whether a closed rectangle and a closed convex polygon have a common point. They have none if an
 * axis of the rectangle, or one perpendicular to a side of the polygon, separates them.
 */
static bool touches(const struct polygon *p, const int64_t low[2], const int64_t high[2])
{
    for (int axis = 0; axis < 2 + p->n; axis++) {
        int64_t n[2] = {axis == 0, axis == 1};
        int64_t p0 = INT64_MAX, p1 = INT64_MIN, r0, r1;

        if (axis >= 2) {
            const int32_t *a = p->xy[axis - 2], *b = p->xy[(axis - 1) % p->n];

            n[0] = -(int64_t)(b[1] - a[1]);
            n[1] = b[0] - a[0];
        }
        for (int i = 0; i < p->n; i++) {
            int64_t d = n[0] * p->xy[i][0] + n[1] * p->xy[i][1];

            p0 = d < p0 ? d : p0;
            p1 = d > p1 ? d : p1;
        }
        r0 = n[0] * (n[0] > 0 ? low : high)[0] + n[1] * (n[1] > 0 ? low : high)[1];
        r1 = n[0] * (n[0] > 0 ? high : low)[0] + n[1] * (n[1] > 0 ? high : low)[1];
        if (p1 < r0 || r1 < p0) {
            return false;
        }
    }
    return true;
}

static uint8_t cell[64][64];

/*
 * Walk the cells, and compare every cell of the grid with `touches`. Returns the number of wrong
 * cells.
 */
static int wrong_cells(const struct polygon *p, const struct scan_grid *g, int32_t grow)
{
    struct scan_cells s;
    struct scan_run run;
    int wrong = 0;

    memset(cell, 0, sizeof cell);
    scan_cells_begin(&s, g, corners(p), p->n, grow);
    while (scan_cells_next(&s, &run)) {
        wrong += run.y < 0 || run.y >= g->ny || run.x0 < 0 || run.x1 > g->nx || run.x0 >= run.x1;
        for (int32_t x = run.x0; wrong == 0 && x < run.x1; x++) {
            cell[run.y][x]++;
        }
    }
    for (int32_t y = 0; y < g->ny; y++) {
        for (int32_t x = 0; x < g->nx; x++) {
            int64_t side = (int64_t)1 << g->shift;
            int64_t low[2] = {g->x0 + x * side - grow, g->y0 + y * side - grow};
            int64_t high[2] = {low[0] + side + 2 * grow, low[1] + side + 2 * grow};

            wrong += cell[y][x] != touches(p, low, high);
        }
    }
    return wrong;
}

/* A polygon of the n-th kind: triangles, needles, lines, points, hulls. */
static void random_kind(struct test_random *r, struct polygon *p, int n, int32_t size)
{
    random_points(r, p, 3, size);
    switch (n % 5) {
    case 1: /* a needle: the third corner is beside the second */
        p->xy[2][0] = p->xy[1][0] + (int32_t)test_random_range(r, -1, 1);
        p->xy[2][1] = p->xy[1][1] + (int32_t)test_random_range(r, -1, 1);
        break;
    case 2: /* on edge: collinear, with the third corner between the others or on one of them */
        for (int k = 0; k < 2; k++) {
            p->xy[1][k] = p->xy[0][k] + (p->xy[1][k] - p->xy[0][k]) / 4 * 4;
            p->xy[2][k] = p->xy[0][k] + (p->xy[1][k] - p->xy[0][k]) / 4 * (n / 5 % 5);
        }
        break;
    case 3: /* a point, or a triangle smaller than a cell */
        for (int i = 1; i < 3; i++) {
            p->xy[i][0] = p->xy[0][0] + (int32_t)test_random_range(r, 0, n % 2);
            p->xy[i][1] = p->xy[0][1] + (int32_t)test_random_range(r, 0, n % 2);
        }
        break;
    case 4:
        random_hull(r, p, size);
        break;
    default:
        break;
    }
    if (n % 2) {
        reverse(p);
    }
}

static void test_cells(void)
{
    struct test_random r = {4};
    int touched = 0;

    for (int n = 0; n < CASES; n++) {
        struct scan_grid g = {
            (int32_t)test_random_range(&r, -100, 20), (int32_t)test_random_range(&r, -100, 20),
            (uint8_t)test_random_range(&r, 0, 6), (uint8_t)test_random_range(&r, 1, 16),
            (uint8_t)test_random_range(&r, 1, 16)};
        struct polygon p;

        random_kind(&r, &p, n, n % 3 ? 80 : 12);
        CHECK_EQ(wrong_cells(&p, &g, n % 2 ? 0 : (int32_t)test_random_range(&r, 0, 20)), 0);
        for (int i = 0; i < 64 * 64; i++) {
            touched += cell[i / 64][i % 64];
        }
    }
    CHECK_MORE(touched, 2 * CASES);
}

/*
 * The largest grid under polygons of its own size, and under the largest polygons, cut by its
 * sides.
 */
static void test_cells_large(void)
{
    struct test_random r = {5};
    int32_t side = 1 << 24, most = (1 << 29) - 1;
    int crossed = 0;

    for (int n = 0; n < CASES / 4; n++) {
        struct scan_grid g = {-side, -side, (uint8_t)(20 + n % 5), 32, 32};
        struct polygon p;

        g.nx = g.ny = (uint8_t)(1 << (25 - g.shift));
        random_kind(&r, &p, n, side - 4);
        CHECK_EQ(wrong_cells(&p, &g, n % 2 ? 0 : (int32_t)test_random_range(&r, 0, side)), 0);

        random_kind(&r, &p, n, most - 4);
        CHECK_EQ(wrong_cells(&p, &g, 0), 0);
        CHECK_EQ(wrong_cells(&p, &g, (int32_t)test_random_range(&r, 0, most)), 0);

        /* moved until the middle of its first side is in the grid, and grown by a little */
        random_points(&r, &p, 3, most / 3);
        for (int k = 0; k < 2; k++) {
            int32_t middle = (p.xy[0][k] + p.xy[1][k]) / 2;

            for (int i = 0; i < 3; i++) {
                p.xy[i][k] -= middle;
            }
        }
        CHECK_EQ(wrong_cells(&p, &g, (int32_t)test_random_range(&r, 0, 1 << 20)), 0);
        crossed += cell[0][0] != cell[g.ny - 1][g.nx - 1] || cell[0][g.nx - 1] != cell[g.ny - 1][0];
    }
    CHECK_MORE(crossed, CASES / 16);
}

/* The next run of cells lies in a row, from x0 up to x1. */
static void expect_run(struct scan_cells *s, int32_t y, int32_t x0, int32_t x1)
{
    struct scan_run run;

    CHECK(scan_cells_next(s, &run));
    CHECK_EQ(run.y, y);
    CHECK_EQ(run.x0, x0);
    CHECK_EQ(run.x1, x1);
}

/* Drawn on squared paper: cells of 4 quanta, a triangle from (1, 1) to (11, 1) and (1, 7). */
static void test_cells_by_hand(void)
{
    struct scan_grid g = {0, 0, 2, 4, 4};
    struct polygon p = {{{1, 1}, {11, 1}, {1, 7}}, 3};
    struct scan_cells s;
    struct scan_run run;

    scan_cells_begin(&s, &g, corners(&p), p.n, 0);
    expect_run(&s, 0, 0, 3);
    /* the long side passes (6, 4), so the second row reaches the second cell */
    expect_run(&s, 1, 0, 2);
    CHECK(!scan_cells_next(&s, &run));

    /* grown by 1 the triangle touches the sides at x = 12 and y = 8, and so the cells behind
     * them */
    scan_cells_begin(&s, &g, corners(&p), p.n, 1);
    expect_run(&s, 0, 0, 4);
    expect_run(&s, 1, 0, 3);
    expect_run(&s, 2, 0, 1);
    CHECK(!scan_cells_next(&s, &run));

    /* outside */
    g.x0 = 20;
    scan_cells_begin(&s, &g, corners(&p), p.n, 8);
    CHECK(!scan_cells_next(&s, &run));
}

const struct test tests_mesh_scan[] = {
    {"mesh_scan/cells", test_cells},
    {"mesh_scan/cells_large", test_cells_large},
    {"mesh_scan/cells_by_hand", test_cells_by_hand},
    {0},
};
