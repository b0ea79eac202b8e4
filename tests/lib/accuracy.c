/* SPDX-License-Identifier: MIT */
/* Accuracy of a kernel: errors of many cases, their quantiles as a row, and the bar. */
#include "accuracy.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "test.h"

static bool missed;

/*
 * Shared files of tests call CHECK. A program without a runner ends at the first check that fails.
 */
void test_check(bool ok, const char *file, int line, const char *text)
{
    if (!ok) {
        fprintf(stderr, "%s:%d: not true: %s\n", file, line, text);
        exit(2);
    }
}

void test_check_order(int64_t a, enum test_order order, int64_t b, const char *file, int line,
                      const char *text)
{
    test_check(TEST_IN_ORDER(a, order, b), file, line, text);
}

void test_check_real_order(double a, enum test_order order, double b, const char *file, int line,
                           const char *text)
{
    test_check(TEST_IN_ORDER(a, order, b), file, line, text);
}

void test_check_near(int64_t a, int64_t b, int64_t tolerance, const char *file, int line,
                     const char *text)
{
    test_check(a - b <= tolerance && b - a <= tolerance, file, line, text);
}

size_t accuracy_cases(int argc, char **argv, size_t all)
{
    size_t share = 1;

    if (argc > 1 && strncmp(argv[1], "share=", 6) == 0) {
        share = strtoul(argv[1] + 6, NULL, 10);
    }
    if (share == 0 || all < share) {
        return 1;
    }
    return all / share;
}

struct accuracy accuracy_begin(const char *kernel, size_t wanted)
{
    struct accuracy a = {.kernel = kernel, .wanted = wanted};

    a.errors = malloc((wanted > 0 ? wanted : 1) * sizeof *a.errors);
    if (!a.errors) {
        fprintf(stderr, "%s: out of memory\n", kernel);
        exit(2);
    }
    return a;
}

void accuracy_add(struct accuracy *a, double error)
{
    if (!(error >= 0)) {
        accuracy_fail(a);
        return;
    }
    if (a->count == a->wanted) {
        a->wanted = 2 * a->wanted + 1;
        a->errors = realloc(a->errors, a->wanted * sizeof *a->errors);
        if (!a->errors) {
            fprintf(stderr, "%s: out of memory\n", a->kernel);
            exit(2);
        }
    }
    a->errors[a->count++] = error;
}

void accuracy_fail(struct accuracy *a)
{
    a->failures++;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;

    return x < y ? -1 : x > y;
}

/* The smallest error bound that `share` of the cases keep. */
static double quantile(const struct accuracy *a, double share)
{
    size_t place = (size_t)(share * (double)a->count);

    return a->count == 0 ? 0 : a->errors[place < a->count ? place : a->count - 1];
}

static void hold(const struct accuracy *a, const char *name, double value, double bar, bool held)
{
    if (held && !(value <= bar)) {
        fprintf(stderr, "%s: %s %.3g is above %.3g\n", a->kernel, name, value, bar);
        missed = true;
    }
}

/* The bars of a kernel, for the last column of its row. */
static void print_bars(const struct accuracy_bar *bar)
{
    const struct {
        const char *name;
        double bar;
        bool held;
    } bars[] = {{"p999", bar->p999, bar->p999 > 0},
                {"p9999", bar->p9999, bar->p9999 > 0},
                {"max", bar->max, bar->max > 0 || bar->max_is_zero}};
    const char *between = "";

    for (size_t i = 0; i < sizeof bars / sizeof *bars; i++) {
        if (bars[i].held) {
            printf("%s%s %.3g", between, bars[i].name, bars[i].bar);
            between = "; ";
        }
    }
    putchar('\n');
}

void accuracy_end(struct accuracy *a, const struct accuracy_bar *bar)
{
    double p999, p9999, max;

    qsort(a->errors, a->count, sizeof *a->errors, by_size);
    p999 = quantile(a, 0.999);
    p9999 = quantile(a, 0.9999);
    max = a->count > 0 ? a->errors[a->count - 1] : 0;
    printf("%s,%zu,%.3g,%.3g,%.3g,%.3g,%zu,", a->kernel, a->count + a->failures, quantile(a, 0.5),
           p999, p9999, max, a->failures);
    print_bars(bar);
    fflush(stdout);
    hold(a, "p999", p999, bar->p999, bar->p999 > 0);
    hold(a, "p9999", p9999, bar->p9999, bar->p9999 > 0);
    hold(a, "max", max, bar->max, bar->max > 0 || bar->max_is_zero);
    hold(a, "failures", (double)a->failures, 0, true);
    hold(a, "cases", a->count + a->failures == 0, 0, true);
    free(a->errors);
    a->errors = NULL;
}

int accuracy_finish(void)
{
    return missed;
}
