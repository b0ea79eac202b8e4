/* SPDX-License-Identifier: MIT */
/* What a failed assertion of a debug build of the engine (CAROM_DEBUG) does: say so and leave. */
#include "port.h"

_Noreturn void carom_assert_failed(const char *text, const char *file, int line);

static void put_text(const char *text)
{
    while (*text) {
        port_putc(*text++);
    }
}

_Noreturn void carom_assert_failed(const char *text, const char *file, int line)
{
    char digits[12];
    int n = sizeof digits - 1;

    digits[n] = '\0';
    do {
        digits[--n] = (char)('0' + line % 10);
        line /= 10;
    } while (line && n);
    put_text(file);
    port_putc(':');
    put_text(&digits[n]);
    put_text(": assertion failed: ");
    put_text(text);
    port_putc('\n');
    port_exit(126);
}
