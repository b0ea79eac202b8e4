/* SPDX-License-Identifier: MIT */
/*
 * test.h - a small test runner that prints TAP, the same on the host and on every board.
 *
 * A test file test_x.c defines `const struct test tests_x[]`, ended by {0}. Every check counts; the
 * first one that fails in a test prints its place and both values, and the test goes on.
 */
#ifndef CAROM_TEST_H
#define CAROM_TEST_H

#include <stdbool.h>
#include <stdint.h>

struct test {
    const char *name; /* file/what, lower case: "num_gauss/singular" */
    void (*run)(void);
};

void test_check(bool ok, const char *file, int line, const char *text);
enum test_order { TEST_LESS, TEST_AT_MOST, TEST_MORE, TEST_AT_LEAST, TEST_EQUAL, TEST_DIFFER };
/* True if two numbers are in an order. */
#define TEST_IN_ORDER(a, order, b)                                                                 \
    ((order) == TEST_LESS      ? (a) < (b)                                                         \
     : (order) == TEST_AT_MOST ? (a) <= (b)                                                        \
     : (order) == TEST_MORE    ? (a) > (b)                                                         \
     : (order) == TEST_EQUAL   ? (a) == (b)                                                        \
     : (order) == TEST_DIFFER  ? (a) != (b)                                                        \
                               : (a) >= (b))
void test_check_order(int64_t a, enum test_order order, int64_t b, const char *file, int line,
                      const char *text);
void test_check_real_order(double a, enum test_order order, double b, const char *file, int line,
                           const char *text);
void test_check_near(int64_t a, int64_t b, int64_t tolerance, const char *file, int line,
                     const char *text);

#define CHECK(condition) test_check((condition), __FILE__, __LINE__, #condition)
/*
 * Comparisons print both values, so use them in place of CHECK. Numbers of tests' own oracles may
 * be double.
 */
#define CHECK_REAL_ORDER_(a, order, b, text)                                                       \
    test_check_real_order((double)(a), order, (double)(b), __FILE__, __LINE__, text)
#define CHECK_ORDER_(a, order, b, text)                                                            \
    _Generic((a) + (b), double                                                                     \
             : CHECK_REAL_ORDER_(a, order, b, text), long double                                   \
             : CHECK_REAL_ORDER_(a, order, b, text), default                                       \
             : test_check_order((int64_t)(a), order, (int64_t)(b), __FILE__, __LINE__, text))
#define CHECK_EQ(a, b)       CHECK_ORDER_(a, TEST_EQUAL, b, #a " == " #b)
#define CHECK_DIFFER(a, b)   CHECK_ORDER_(a, TEST_DIFFER, b, #a " != " #b)
#define CHECK_LESS(a, b)     CHECK_ORDER_(a, TEST_LESS, b, #a " < " #b)
#define CHECK_AT_MOST(a, b)  CHECK_ORDER_(a, TEST_AT_MOST, b, #a " <= " #b)
#define CHECK_MORE(a, b)     CHECK_ORDER_(a, TEST_MORE, b, #a " > " #b)
#define CHECK_AT_LEAST(a, b) CHECK_ORDER_(a, TEST_AT_LEAST, b, #a " >= " #b)
/* Compare two pointers. */
#define CHECK_SAME(a, b)                                                                           \
    test_check_near((int64_t)(intptr_t)(const void *)(a), (int64_t)(intptr_t)(const void *)(b), 0, \
                    __FILE__, __LINE__, #a " == " #b)
#define CHECK_NEAR(a, b, tolerance)                                                                \
    test_check_near((int64_t)(a), (int64_t)(b), (int64_t)(tolerance), __FILE__, __LINE__,          \
                    #a " ~ " #b)

/*
 * Bars in instructions hold for a Cortex-M3 at the usual optimisation. Elsewhere a test only prints
 * its count.
 */
#if defined __ARM_ARCH_7M__ && defined __OPTIMIZE__ && !defined __OPTIMIZE_SIZE__ &&               \
    !defined CAROM_DEBUG
#define TEST_BARS 1
#else
#define TEST_BARS 0
#endif
#define CHECK_BAR(count, bar) CHECK_AT_MOST(TEST_BARS ? (count) : 0, bar)

/* A stream of random numbers that is the same everywhere. */
struct test_random {
    uint64_t state;
};
uint64_t test_random_next(struct test_random *r);
/* Uniform in [low, high]. */
int64_t test_random_range(struct test_random *r, int64_t low, int64_t high);

#endif
