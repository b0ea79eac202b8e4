/* SPDX-License-Identifier: MIT */
/*
 * A program of this folder on this machine: with the numbers given, or with random ones, many times.
 *
 *   PROGRAM N1 N2 ...      the inputs in their order; ends with 1 if a check fails
 *   PROGRAM random TIMES   the same as often as TIMES
 */
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "carom_fix.h"

int64_t proof_range(int64_t low, int64_t high);
void proof_assume(bool holds);
void proof_check(bool holds);
void proof(void);
_Noreturn void carom_assert_failed(const char *text, const char *file, int line);

static jmp_buf next;
static char **given;
static uint64_t stream = 1;

static uint64_t draw(void)
{
    stream ^= stream << 13;
    stream ^= stream >> 7;
    stream ^= stream << 17;
    return stream * 0x2545f4914f6cdd1du;
}

/* One in four is an end or near 0; the others are as often short as long. */
int64_t proof_range(int64_t low, int64_t high)
{
    const uint64_t span = (uint64_t)high - (uint64_t)low;
    uint64_t any = draw() >> (draw() % 64);

    if (given) {
        if (!*given) {
            longjmp(next, 1);
        }
        return strtoll(*given++, NULL, 10);
    }
    switch (draw() % 16) {
    case 0:
        return low;
    case 1:
        return high;
    case 2:
        return low <= 0 && high >= 0 ? 0 : low;
    case 3:
        return (int64_t)((uint64_t)high - (span < any ? 0 : any));
    default:
        any = low < 0 && draw() % 2 ? 0 - any : any;
        if ((int64_t)any < low || (int64_t)any > high) {
            any = (uint64_t)low + (span == UINT64_MAX ? any : any % (span + 1));
        }
        return (int64_t)any;
    }
}

void proof_assume(bool holds)
{
    if (!holds) {
        longjmp(next, 1);
    }
}

void proof_check(bool holds)
{
    if (!holds) {
        puts("a check fails");
        exit(1);
    }
}

void carom_assert_failed(const char *text, const char *file, int line)
{
    printf("%s:%d: %s fails\n", file, line, text);
    exit(1);
}

int main(int count, char **words)
{
    const bool random = count > 2 && !strcmp(words[1], "random");
    const long times = random ? atol(words[2]) : 1;

    given = random ? NULL : words + 1;
    for (long turn = 0; turn < times; turn++) {
        if (!setjmp(next)) {
            proof();
        }
    }
    return 0;
}
