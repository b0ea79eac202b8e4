/* SPDX-License-Identifier: MIT */
/*
 * main - the runner: runs every suite of tests/suites.h that the image holds, in order. Argument 1
 * is a part of a test name; only matching tests run.
 */
#include <string.h>

#include "port.h"
#include "lib/test.h"

/* Weak: a board's image may hold some suites only; the others are NULL. */
#define SUITE(name) extern const struct test tests_##name[] __attribute__((weak));
#include "suites.h"
#undef SUITE

static const struct test *const suites[] = {
#define SUITE(name) tests_##name,
#include "suites.h"
#undef SUITE
};

static struct {
    uint32_t checks, failed;
} current;

void test_check(bool ok, const char *file, int line, const char *text)
{
    current.checks++;
    if (!ok && current.failed++ == 0) {
        port_print("# %s:%d: not true: %s\n", file, line, text);
    }
}

static void check_values(bool ok, int64_t a, int64_t b, const char *file, int line,
                         const char *text)
{
    current.checks++;
    if (!ok && current.failed++ == 0) {
        /* in two halves: the small printf of newlib has no 64-bit formats */
        port_print("# %s:%d: %s: 0x%08lx%08lx against 0x%08lx%08lx\n", file, line, text,
                   (unsigned long)((uint64_t)a >> 32), (unsigned long)(a & 0xffffffff),
                   (unsigned long)((uint64_t)b >> 32), (unsigned long)(b & 0xffffffff));
    }
}

void test_check_order(int64_t a, enum test_order order, int64_t b, const char *file, int line,
                      const char *text)
{
    check_values(TEST_IN_ORDER(a, order, b), a, b, file, line, text);
}

/* A number in billionths, clamped to what a long holds. */
static long billionths(double v)
{
    return v * 1e9 > INT32_MAX ? INT32_MAX : v * 1e9 < -INT32_MAX ? -INT32_MAX : (long)(v * 1e9);
}

void test_check_real_order(double a, enum test_order order, double b, const char *file, int line,
                           const char *text)
{
    bool ok = TEST_IN_ORDER(a, order, b);

    current.checks++;
    if (!ok && current.failed++ == 0) {
        port_print("# %s:%d: %s: %ld billionths against %ld\n", file, line, text, billionths(a),
                   billionths(b));
    }
}

void test_check_near(int64_t a, int64_t b, int64_t tolerance, const char *file, int line,
                     const char *text)
{
    uint64_t apart = a < b ? (uint64_t)b - (uint64_t)a : (uint64_t)a - (uint64_t)b;

    check_values(apart <= (uint64_t)tolerance, a, b, file, line, text);
}

int main(void)
{
    unsigned passed = 0, failed = 0;
    const char *select;

    port_init();
    select = port_arg(1);
    for (unsigned i = 0; i < sizeof suites / sizeof suites[0]; i++) {
        for (const struct test *t = suites[i]; t && t->name; t++) {
            if (select && !strstr(t->name, select)) {
                continue;
            }
            current.checks = current.failed = 0;
            t->run();
            if (current.checks == 0) {
                current.failed = 1;
                port_print("# no checks ran\n");
            }
            *(current.failed ? &failed : &passed) += 1;
            port_print("%s %u - %s (%lu checks)\n", current.failed ? "not ok" : "ok",
                       passed + failed, t->name, (unsigned long)current.checks);
            if (current.failed) {
                port_print("# again: make test TEST=%s\n", t->name);
            }
        }
    }
    port_print("1..%u\n# %u passed, %u failed\n", passed + failed, passed, failed);
    port_exit(failed != 0 || passed == 0);
}
