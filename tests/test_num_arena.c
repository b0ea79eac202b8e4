/* SPDX-License-Identifier: MIT */
/* Arenas and pools: alignment, exact fit, errors that stay. */
#include "num/arena.h"
#include "lib/test.h"

static _Alignas(8) uint8_t block[64];

static void fill(uint8_t with)
{
    memset(block, with, sizeof block);
}

/* Carved blocks lie end to end, aligned to 8 and zeroed, and touch nothing else. */
static void test_carve(void)
{
    struct arena a;
    uint8_t *p;

    fill(0xa5);
    arena_init(&a, block, sizeof block);
    CHECK_SAME(arena_carve(&a, 1), block);
    CHECK_SAME(arena_carve(&a, 8), block + 8);
    CHECK_SAME(arena_carve(&a, 0), block + 16);
    p = arena_carve(&a, 9);
    CHECK_SAME(p, block + 16);
    CHECK_EQ(a.used, 32);
    for (int i = 0; i < 64; i++) {
        CHECK_EQ(block[i], i < 32 ? 0 : 0xa5);
    }
}

static void test_exact_fit(void)
{
    struct arena a;

    fill(0xa5);
    arena_init(&a, block, 24);
    CHECK_SAME(arena_carve(&a, 16), block);
    CHECK_SAME(arena_carve(&a, 8), block + 16);
    CHECK_EQ(a.used, 24);
    CHECK_SAME(arena_carve(&a, 1), NULL);

    /* one byte short */
    fill(0xa5);
    arena_init(&a, block, 23);
    CHECK_SAME(arena_carve(&a, 16), block);
    CHECK_SAME(arena_carve(&a, 8), NULL);
    CHECK_EQ(block[16], 0xa5);
    CHECK_EQ(a.used, 24); /* the bytes that would have been needed */
}

/* After one block did not fit, no other one does, and the sum of bytes goes on. */
static void test_sticky(void)
{
    struct arena a;

    arena_init(&a, block, 16);
    CHECK_SAME(arena_carve(&a, 24), NULL);
    CHECK_SAME(arena_carve(&a, 8), NULL);
    CHECK_EQ(a.used, 32);

    /* sizes whose sum or rounding overflows */
    for (size_t less = 0; less < 40; less += 13) {
        arena_init(&a, block, sizeof block);
        CHECK_SAME(arena_carve(&a, 8), block);
        CHECK_SAME(arena_carve(&a, SIZE_MAX - less), NULL);
        CHECK_SAME(arena_carve(&a, 8), NULL);
        CHECK_SAME(arena_carve(&a, 1), NULL);
    }
}

static void test_pool(void)
{
    struct pool p = {3, 0, 0, 0};

    for (int round = 0; round < 2; round++) {
        for (int i = 0; i < 3; i++) {
            CHECK_EQ(p.used, i);
            CHECK_EQ(pool_take(&p), i);
        }
        CHECK_EQ(pool_take(&p), -1);
        CHECK_EQ(pool_take(&p), -1);
        CHECK_EQ(p.used, 3);
        CHECK_EQ(p.peak, 3);
        CHECK_EQ(p.size, 3);
        CHECK_EQ(p.refused, 2 * (round + 1));
        pool_clear(&p);
    }
    CHECK_EQ(p.used, 0);
    CHECK_EQ(pool_take(&p), 0);
    CHECK_EQ(p.peak, 3); /* the peak does not fall */

    p = (struct pool){0, 0, 0, 0};
    CHECK_EQ(pool_take(&p), -1);
    CHECK_EQ(p.used, 0);
    CHECK_EQ(p.peak, 0);
    CHECK_EQ(p.refused, 1);
}

const struct test tests_num_arena[] = {
    {"num_arena/carve", test_carve},
    {"num_arena/exact_fit", test_exact_fit},
    {"num_arena/sticky", test_sticky},
    {"num_arena/pool", test_pool},
    {0},
};
