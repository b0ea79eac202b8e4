/* SPDX-License-Identifier: MIT */
/*
 * Printing on every board, straight to its console. A C library's printf needs a heap, and even its snprintf more memory than the smallest
 * board can spare.
 */
#include <stdarg.h>
#include <stdbool.h>

#include "port.h"

static void put_text(const char *text)
{
    while (*text) {
        port_putc(*text++);
    }
}

/* A number with at least `width` digits. */
static void put_number(unsigned long number, unsigned base, int width)
{
    char digits[20];
    int count = 0;

    do {
        digits[count++] = "0123456789abcdef"[number % base];
        number /= base;
    } while (number || count < width);
    while (count > 0) {
        port_putc(digits[--count]);
    }
}

void port_print(const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    for (; *format; format++) {
        bool is_long = false;
        int width = 0;

        if (*format != '%') {
            port_putc(*format);
            continue;
        }
        while (*++format == 'l' || (*format >= '0' && *format <= '9')) {
            is_long |= *format == 'l';
            width = *format == 'l' ? width : 10 * width + *format - '0';
        }
        if (*format == 's') {
            put_text(va_arg(arguments, const char *));
        } else if (*format == 'd') {
            long number = is_long ? va_arg(arguments, long) : va_arg(arguments, int);

            if (number < 0) {
                port_putc('-');
            }
            put_number(number < 0 ? 0 - (unsigned long)number : (unsigned long)number, 10, width);
        } else {
            put_number(is_long ? va_arg(arguments, unsigned long) : va_arg(arguments, unsigned),
                       *format == 'x' ? 16 : 10, width);
        }
    }
    va_end(arguments);
}
