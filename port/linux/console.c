/* SPDX-License-Identifier: MIT */
/* Linux programs on any processor, over the C library alone: a console, files, a way out. */
#include <stdio.h>
#include <stdlib.h>

#include "port.h"

enum { ARGUMENTS_MAX = 64, PAINT = 0xa5, PAINT_BYTES = 65536 };

static uintptr_t paint_start;

/* The array is gone when this function returns; later calls have their stack in the same memory. */
__attribute__((noinline)) static void paint_stack(void)
{
    volatile uint8_t area[PAINT_BYTES];

    for (uint32_t i = 0; i < PAINT_BYTES; i++) {
        area[i] = PAINT;
    }
    paint_start = (uintptr_t)area;
}

/* Bytes that keep the paint were never in use. */
uint32_t port_stack(void)
{
    const volatile uint8_t *low = (const volatile uint8_t *)paint_start;
    uint32_t untouched = 0;

    while (untouched < PAINT_BYTES && low[untouched] == PAINT) {
        untouched++;
    }
    return PAINT_BYTES - untouched;
}

void port_init(void)
{
    paint_stack();
    setvbuf(stdout, NULL, _IOLBF, 0); /* a runner reads the lines while the program runs */
}

void port_putc(char c)
{
    putchar(c);
}

/* main takes no arguments on any board; Linux keeps them in a file, each ended by a zero. */
const char *port_arg(int n)
{
    static char text[4096];
    static const char *argument[ARGUMENTS_MAX];
    static int count = -1;

    if (count < 0) {
        long bytes = port_read_file("/proc/self/cmdline", text, sizeof text - 1);

        count = 0;
        for (long k = 0; k < bytes && count < ARGUMENTS_MAX; k++) {
            if (k == 0 || text[k - 1] == '\0') {
                argument[count++] = &text[k];
            }
        }
    }
    return n >= 0 && n < count ? argument[n] : NULL;
}

long port_read_file(const char *name, void *buffer, size_t max)
{
    FILE *file = fopen(name, "rb");
    long bytes;

    if (!file) {
        return -1;
    }
    bytes = (long)fread(buffer, 1, max, file);
    fclose(file);
    return bytes;
}

_Noreturn void port_exit(int status)
{
    exit(status);
}
