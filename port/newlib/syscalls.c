/* SPDX-License-Identifier: MIT */
/*
 * The system calls that newlib needs, over the port's functions.
 *
 * There is no heap: _sbrk always refuses. snprintf of newlib nano works without a heap. Its printf
 * does not: it allocates the standard streams and writes through the NULL pointer that it gets. So
 * there is no _write or _read here: a program that uses printf fails to link, and cannot overwrite
 * memory. Programs use snprintf and port_putc.
 */
#include <errno.h>
#include <stdint.h>

#include "port.h"

/* picolibc, a relative of newlib, needs these without the first character. */
#ifdef __PICOLIBC__
#define _sbrk   sbrk
#define _getpid getpid
#define _kill   kill
#endif

void *_sbrk(ptrdiff_t bytes);
int _getpid(void);
int _kill(int process, int signal);
_Noreturn void _exit(int status);

void *_sbrk(ptrdiff_t bytes)
{
    (void)bytes;
    errno = ENOMEM;
    return (void *)(intptr_t)-1;
}

/* abort() raises a signal for a process; there is only one. */
int _getpid(void)
{
    return 1;
}

int _kill(int process, int signal)
{
    (void)process;
    _exit(128 + signal);
}

_Noreturn void _exit(int status)
{
    port_exit(status);
}
