/* SPDX-License-Identifier: MIT */
/* WebAssembly without a library: the console, files and arguments are those of run.mjs. */
#include <string.h>

#include "port.h"

#define IMPORT(name) __attribute__((import_module("port"), import_name(#name)))
enum { ARGUMENTS_MAX = 16, ARGUMENT_BYTES = 256 };

IMPORT(putc) void wasm_putc(int c);
IMPORT(exit) _Noreturn void wasm_exit(int status);
/* The n-th argument with a zero after it; its length, or -1 when it is not there or too long. */
IMPORT(arg) int wasm_arg(int n, char *text, int max);
IMPORT(read) int wasm_read(const char *name, void *buffer, size_t max);

void port_init(void)
{
}

void port_putc(char c)
{
    wasm_putc((unsigned char)c);
}

const char *port_arg(int n)
{
    static char text[ARGUMENTS_MAX][ARGUMENT_BYTES];

    return n >= 0 && n < ARGUMENTS_MAX && wasm_arg(n, text[n], ARGUMENT_BYTES) >= 0 ? text[n]
                                                                                    : NULL;
}

long port_read_file(const char *name, void *buffer, size_t max)
{
    return wasm_read(name, buffer, max);
}

_Noreturn void port_exit(int status)
{
    wasm_exit(status);
}

/* ------------------------------------------------------- what a library would bring */

/* Byte by byte through volatile, or the compiler would make calls of them to themselves. */
void *memmove(void *to, const void *from, size_t bytes)
{
    volatile uint8_t *out = to;
    const uint8_t *in = from;

    if ((uintptr_t)to < (uintptr_t)from) {
        for (size_t i = 0; i < bytes; i++) {
            out[i] = in[i];
        }
    } else {
        while (bytes-- > 0) {
            out[bytes] = in[bytes];
        }
    }
    return to;
}

void *memcpy(void *restrict to, const void *restrict from, size_t bytes)
{
    return memmove(to, from, bytes);
}

void *memset(void *to, int value, size_t bytes)
{
    volatile uint8_t *out = to;

    for (size_t i = 0; i < bytes; i++) {
        out[i] = (uint8_t)value;
    }
    return to;
}

int memcmp(const void *a, const void *b, size_t bytes)
{
    const uint8_t *x = a, *y = b;

    for (size_t i = 0; i < bytes; i++) {
        if (x[i] != y[i]) {
            return x[i] - y[i];
        }
    }
    return 0;
}

size_t strlen(const char *text)
{
    size_t length = 0;

    while (((const volatile char *)text)[length]) {
        length++;
    }
    return length;
}

int strncmp(const char *a, const char *b, size_t most)
{
    for (size_t i = 0; i < most; i++) {
        if (a[i] != b[i] || !a[i]) {
            return (unsigned char)a[i] - (unsigned char)b[i];
        }
    }
    return 0;
}

int strcmp(const char *a, const char *b)
{
    return strncmp(a, b, SIZE_MAX);
}
