/* SPDX-License-Identifier: MIT */
/*
 * accuracy - what the programs of `make accuracy` share: errors of many cases, their quantiles as
 * a row of out/accuracy.csv, and the bar that they must keep. Host only.
 *
 *   int main(int argc, char **argv)
 *   {
 *       struct accuracy a = accuracy_begin("solve9", accuracy_cases(argc, argv, 200000));
 *       for (size_t i = 0; i < a.wanted; i++) {
 *           accuracy_add(&a, error of case i);      or accuracy_fail(&a)
 *       }
 *       accuracy_end(&a, &(struct accuracy_bar){.p9999 = 1e-9});
 *       return accuracy_finish();
 *   }
 *
 * A program takes one argument, `share=N`: do an Nth of the cases. Rows go to standard output.
 * Missed bars go to standard error and into the exit status.
 */
#ifndef CAROM_TESTS_ACCURACY_H
#define CAROM_TESTS_ACCURACY_H

#include <stdbool.h>
#include <stddef.h>

struct accuracy {
    const char *kernel;
    size_t wanted; /* number of cases */
    size_t count, failures;
    double *errors;
};

/* Upper bounds of the quantiles; 0: no bound. Failures must be 0. */
struct accuracy_bar {
    double p999, p9999, max;
    bool max_is_zero; /* max must be 0 */
};

/* The number of cases that the command line asks for, of `all`; at least 1. */
size_t accuracy_cases(int argc, char **argv, size_t all);

struct accuracy accuracy_begin(const char *kernel, size_t wanted);
/* The error of one case, >= 0; a NaN counts as a failure. */
void accuracy_add(struct accuracy *a, double error);
/* A case that gave no answer, or an impossible one. */
void accuracy_fail(struct accuracy *a);
/* Print the row and compare it with the bar. */
void accuracy_end(struct accuracy *a, const struct accuracy_bar *bar);

/* The exit status: 1 when any bar was missed. */
int accuracy_finish(void);

#endif
