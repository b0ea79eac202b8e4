/* SPDX-License-Identifier: MIT */
/* WebAssembly without a library: the console, files and arguments are those of run.mjs. */
#include <stddef.h>

#include "port.h"

#define IMPORT(name) __attribute__((import_module("port"), import_name(#name)))
enum { ARGUMENTS_MAX = 16, ARGUMENT_BYTES = 256 };

IMPORT(putc) void wasm_putc(int c);
IMPORT(exit) _Noreturn void wasm_exit(int status);
/* The n-th argument with a zero after it. Returns its length, or -1 if there is none or it is too long. */
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
