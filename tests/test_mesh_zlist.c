/* SPDX-License-Identifier: MIT */
/* Z-lists made within a step: order, full pools, intervals. */
#include <string.h>

#include "lib/test.h"
#include "mesh/zlist.h"

#ifdef TEST_LONG
#define CASES 3000
#define GRAIN 32
#else
#define CASES 40
#define GRAIN 16
#endif

/* --------------------------------------------------------------------- lists */

#define POOL 200
static uint16_t head[ZLIST_CELLS_MAX];
static struct zentry entry[POOL];

static void test_order(void)
{
    struct test_random r = {1};
    struct pool pool = {.size = POOL};
    struct zlist z = {head, entry, &pool};
    uint8_t cell_of[POOL];
    int listed = 0;

    zlist_clear(&z);
    for (int i = 0; i < POOL; i++) {
        int16_t z1 = (int16_t)test_random_range(&r, -5, 5);

        cell_of[i] = (uint8_t)test_random_range(&r, 0, 3);
        /* faces in a scattered order: 77 and 200 have no common divisor */
        CHECK(zlist_enter(&z, cell_of[i], (int16_t)(z1 - i), z1, (uint16_t)(i * 77 % POOL)));
    }
    for (uint32_t c = 0; c < ZLIST_CELLS_MAX; c++) {
        for (uint16_t e = head[c]; e != ZLIST_NONE; e = entry[e].next) {
            uint16_t next = entry[e].next;

            CHECK_LESS(c, 4);
            CHECK_LESS(e, POOL);
            CHECK_LESS(listed, POOL);
            CHECK(next == ZLIST_NONE || entry[next].z1 < entry[e].z1 ||
                  (entry[next].z1 == entry[e].z1 && entry[next].face > entry[e].face));
            for (int i = 0; i < POOL; i++) {
                if (i * 77 % POOL == entry[e].face) {
                    CHECK_EQ(cell_of[i], c);
                    CHECK_EQ(entry[e].z0, entry[e].z1 - i);
                }
            }
            listed++;
        }
    }
    CHECK_EQ(listed, POOL);
}

/* A full pool refuses and changes nothing; the next chunk starts afresh. */
static void test_full(void)
{
    struct pool pool = {.size = 3};
    struct zlist z = {head, entry, &pool};
    struct zentry before[3];

    zlist_clear(&z);
    CHECK(zlist_enter(&z, 1023, 0, 5, 0));
    CHECK(zlist_enter(&z, 1023, 0, 7, 1));
    CHECK(zlist_enter(&z, 5, 0, 6, 2));
    memcpy(before, entry, sizeof before);
    CHECK(!zlist_enter(&z, 1023, 0, 6, 3));
    CHECK(!zlist_enter(&z, 0, 0, 6, 3));
    CHECK_EQ(memcmp(before, entry, sizeof before), 0);
    CHECK_EQ(head[1023], 1);
    CHECK_EQ(head[5], 2);
    CHECK_EQ(head[0], ZLIST_NONE);
    CHECK_EQ(pool.used, 3);
    CHECK_EQ(pool.refused, 2);
    CHECK_EQ(pool.peak, 3);
    zlist_clear(&z);
    CHECK_EQ(head[1023], ZLIST_NONE);
    CHECK_EQ(head[5], ZLIST_NONE);
    CHECK_EQ(pool.used, 0);
    CHECK(zlist_enter(&z, 0, -1, 6, 3));
    CHECK_EQ(head[0], 0);
    CHECK_EQ(entry[0].next, ZLIST_NONE);
}

/* ----------------------------------------------------------------- intervals */

/*
 * Take points of the grown face, by whole weights that sum to GRAIN. The z of each point over the
 * cell must be in the interval. Returns how many are not.
 */
static int missed_points(const struct zface *f, const struct scan_grid *g, int32_t col, int32_t row,
                         int16_t z0, int16_t z1)
{
    int64_t side = (int64_t)1 << g->shift, grow = GRAIN * (int64_t)f->grow;
    int64_t x = GRAIN * (g->x0 + col * side), y = GRAIN * (g->y0 + row * side);
    int missed = 0;

    for (int a = 0; a <= GRAIN; a++) {
        for (int b = 0; a + b <= GRAIN; b++) {
            int64_t p[3];

            for (int k = 0; k < 3; k++) {
                p[k] = (int64_t)a * f->p[0][k] + (int64_t)b * f->p[1][k] +
                       (int64_t)(GRAIN - a - b) * f->p[2][k];
            }
            if (p[0] >= x - grow && p[0] <= x + GRAIN * side + grow && p[1] >= y - grow &&
                p[1] <= y + GRAIN * side + grow) {
                missed += p[2] - grow < GRAIN * (int64_t)z0 || p[2] + grow > GRAIN * (int64_t)z1;
            }
        }
    }
    return missed;
}

/*
 * Every cell of random faces of every kind: no point is missing, and no interval goes beyond the
 * face's own z.
 */
static void test_interval_holds(void)
{
    struct test_random r = {2};

    for (int n = 0; n < CASES; n++) {
        struct scan_grid g = {-200, -200, (uint8_t)(4 + n % 4), 16, 16};
        struct zface f = {.grow = n % 2 ? 0 : (int32_t)test_random_range(&r, 0, 40)};
        struct scan_cells s;
        struct scan_run run;
        int32_t xy[3][2], low = INT32_MAX, high = INT32_MIN;
        int cells = 0;

        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 3; k++) {
                f.p[i][k] = (int32_t)test_random_range(&r, -300, 300);
            }
            if (n % 5 == 4 && i == 2) { /* upright */
                f.p[2][0] = f.p[1][0];
                f.p[2][1] = f.p[1][1];
            }
            memcpy(xy[i], f.p[i], sizeof xy[i]);
            low = f.p[i][2] < low ? f.p[i][2] : low;
            high = f.p[i][2] > high ? f.p[i][2] : high;
        }
        scan_cells_begin(&s, &g, (const int32_t(*)[2])xy, 3, f.grow);
        while (scan_cells_next(&s, &run)) {
            for (int32_t col = run.x0; col < run.x1 && ++cells < 24; col++) {
                int16_t z0, z1;

                zface_interval(&f, &g, col, run.y, &z0, &z1);
                CHECK_AT_MOST(z0, z1);
                CHECK_AT_LEAST(z0, low - f.grow);
                CHECK_AT_MOST(z1, high + f.grow);
                CHECK_EQ(missed_points(&f, &g, col, run.y, z0, z1), 0);
            }
        }
    }
}

/*
 * The plane z = (x - 2y) / 4 over large triangles of both orientations: the interval over a cell.
 */
static void test_interval_by_hand(void)
{
    struct scan_grid g = {0, 0, 5, 16, 16};
    struct zface up = {{{0, 0, 0}, {1000, 0, 250}, {0, 1000, -500}}, 0};
    struct zface down = {{{1000, 0, 250}, {0, 0, 0}, {0, 1000, -500}}, 0};
    int16_t z0, z1;

    /* x 96 .. 128, y 32 .. 64: from (96 - 128) / 4 to (128 - 64) / 4 */
    zface_interval(&up, &g, 3, 1, &z0, &z1);
    CHECK_EQ(z0, -8);
    CHECK_EQ(z1, 16);
    zface_interval(&down, &g, 3, 1, &z0, &z1);
    CHECK_EQ(z0, -8);
    CHECK_EQ(z1, 16);
    /* grown by 3: x 93 .. 131, y 29 .. 67 give -10.25 and 18.25, and 3 more in both directions */
    up.grow = 3;
    zface_interval(&up, &g, 3, 1, &z0, &z1);
    CHECK_EQ(z0, -14);
    CHECK_EQ(z1, 22);
}

/* Faces beyond the exact range and z beyond int16 still give a safe interval. */
static void test_interval_far(void)
{
    struct scan_grid g = {0, 0, 5, 16, 16};
    struct zface wide = {{{-8000000, 0, -3}, {8000000, 8, 5}, {0, 8000000, 4}}, 2};
    struct zface high = {{{0, 0, 40000}, {10, 0, 40010}, {0, 10, -40000}}, 0};
    struct zface above = {{{0, 0, 40000}, {10, 0, 40010}, {0, 10, 50000}}, 0};
    struct zface huge = {{{-16000000, -15000000, -16000000},
                          {16000000, -14000000, 16000000},
                          {0, 16000000, 15000000}},
                         2};
    int16_t z0, z1;

    zface_interval(&wide, &g, 0, 0, &z0, &z1);
    CHECK_EQ(z0, -5);
    CHECK_EQ(z1, 7);
    zface_interval(&huge, &g, 7, 0, &z0, &z1);
    CHECK_EQ(z0, INT16_MIN);
    CHECK_EQ(z1, INT16_MAX);
    zface_interval(&high, &g, 0, 0, &z0, &z1);
    CHECK_EQ(z0, INT16_MIN);
    CHECK_EQ(z1, INT16_MAX);
    zface_interval(&above, &g, 0, 0, &z0, &z1);
    CHECK_EQ(z0, INT16_MAX);
    CHECK_EQ(z1, INT16_MAX);
}

const struct test tests_mesh_zlist[] = {
    {"mesh_zlist/order", test_order},
    {"mesh_zlist/full", test_full},
    {"mesh_zlist/interval_holds", test_interval_holds},
    {"mesh_zlist/interval_by_hand", test_interval_by_hand},
    {"mesh_zlist/interval_far", test_interval_far},
    {0},
};
