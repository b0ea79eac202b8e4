/* SPDX-License-Identifier: MIT */
/*
 * The function that assertions of a debug build call, where there is a console. A program may define its own carom_assert_failed instead.
 */
#include <stdio.h>
#include <stdlib.h>

_Noreturn void carom_assert_failed(const char *text, const char *file, int line);

_Noreturn void carom_assert_failed(const char *text, const char *file, int line)
{
    fprintf(stderr, "%s:%d: not true: %s\n", file, line, text);
    abort();
}
