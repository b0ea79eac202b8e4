/* SPDX-License-Identifier: MIT */
/*
 * Assertions of a debug build call this function, where there is a console. A program that has a carom_assert_failed of its
 * own is linked with that one.
 */
#include <stdio.h>
#include <stdlib.h>

_Noreturn void carom_assert_failed(const char *text, const char *file, int line);

_Noreturn void carom_assert_failed(const char *text, const char *file, int line)
{
    fprintf(stderr, "%s:%d: not true: %s\n", file, line, text);
    abort();
}
