/* SPDX-License-Identifier: MIT */
/* printf for every board: newlib's own needs a heap. */
#include <stdarg.h>
#include <stdio.h>

#include "port.h"

void port_print(const char *format, ...)
{
    char line[320];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    for (const char *c = line; *c; c++) {
        port_putc(*c);
    }
}
