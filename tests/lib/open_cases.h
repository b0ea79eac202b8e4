/* SPDX-License-Identifier: MIT */
/*
 * open_cases - cases of the programs here that are known to fail. The short forms leave them out and
 * say so, the long ones count them. Who cures a case takes it from the list.
 */
#ifndef CAROM_TESTS_OPEN_CASES_H
#define CAROM_TESTS_OPEN_CASES_H

#include <stdbool.h>

/* Whether a case is to be left out; it is then one of those that open_cases_print names. */
bool open_case(const char *program, long number);

/* A line with how many were left out, when there are any, and why. */
void open_cases_print(void);

#endif
