/* SPDX-License-Identifier: MIT */
/*
 * SuperH-4 under Linux without a C library, by system calls: console, files, arguments. Debian's C library for it hangs in QEMU
 * 7.2: see tools/matrix.py.
 */
#include <stddef.h>

#include "port.h"

enum { CALL_EXIT = 1, CALL_READ = 3, CALL_WRITE = 4, CALL_OPEN = 5, CALL_CLOSE = 6 };
enum { CONSOLE = 1, LINE_BYTES = 1024 };

int main(void);

/* The stack at the start: the number of arguments, then their addresses. */
static const uintptr_t *start_stack;
static struct {
    char text[LINE_BYTES];
    size_t used;
} line;

/* A system call of three arguments; a negative result is an error. */
static long call(long number, long a, long b, long c)
{
    register long r3 __asm__("r3") = number;
    register long r4 __asm__("r4") = a;
    register long r5 __asm__("r5") = b;
    register long r6 __asm__("r6") = c;
    register long r0 __asm__("r0");

    __asm__ volatile("trapa #0x13" : "=r"(r0) : "r"(r3), "r"(r4), "r"(r5), "r"(r6) : "memory");
    return r0;
}

__asm__(".globl _start\n"
        "_start: mov.l 1f, r0\n"
        "jmp @r0\n"
        "mov r15, r4\n"
        ".balign 4\n"
        "1: .long sh4_start\n");

_Noreturn void sh4_start(const uintptr_t *stack);
_Noreturn void sh4_start(const uintptr_t *stack)
{
    start_stack = stack;
    port_exit(main());
}

void port_init(void)
{
}

static void flush(void)
{
    call(CALL_WRITE, CONSOLE, (long)line.text, (long)line.used);
    line.used = 0;
}

void port_putc(char c)
{
    line.text[line.used++] = c;
    if (c == '\n' || line.used == LINE_BYTES) {
        flush();
    }
}

const char *port_arg(int n)
{
    return n >= 0 && (uintptr_t)n < start_stack[0] ? (const char *)start_stack[1 + n] : NULL;
}

long port_read_file(const char *name, void *buffer, size_t max)
{
    long file = call(CALL_OPEN, (long)name, 0, 0), bytes = 0, more = 1;

    if (file < 0) {
        return -1;
    }
    while (more > 0 && (size_t)bytes < max) {
        more = call(CALL_READ, file, (long)buffer + bytes, (long)max - bytes);
        bytes += more > 0 ? more : 0;
    }
    call(CALL_CLOSE, file, 0, 0);
    return bytes;
}

_Noreturn void port_exit(int status)
{
    flush();
    for (;;) {
        call(CALL_EXIT, status, 0, 0);
    }
}
