/* SPDX-License-Identifier: MIT */
/* The list of cases that are known to fail. */
#include "open_cases.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char *program; /* the program, and its arguments before the number */
    long number;
    const char *why;
} cases[] = {
    {0}, /* the end */
};
enum { CASES = sizeof cases / sizeof *cases - 1 };

static bool left_out[CASES + 1];

bool open_case(const char *program, long number)
{
    for (int i = 0; i < CASES; i++) {
        if (cases[i].number == number && strcmp(cases[i].program, program) == 0) {
            left_out[i] = true;
            return true;
        }
    }
    return false;
}

void open_cases_print(void)
{
    const char *between = ":";
    int count = 0;

    for (int i = 0; i < CASES; i++) {
        count += left_out[i];
    }
    if (count > 0) {
        printf("# %d known to fail, left out", count);
        for (int i = 0; i < CASES; i++) {
            if (left_out[i]) {
                printf("%s %s %ld (%s)", between, cases[i].program, cases[i].number, cases[i].why);
                between = ",";
            }
        }
        puts("");
    }
}
