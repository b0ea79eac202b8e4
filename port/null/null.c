/* SPDX-License-Identifier: MIT */
/*
 * The port that does nothing. To bring up a board, copy this folder and fill in the functions that
 * the board has. A weak function gives way to a function of the board's family: remove WEAK from
 * each function that you fill in.
 */
#include "port.h"

#define WEAK __attribute__((weak))

WEAK const uint32_t port_ticks_hz = 1;

WEAK void port_init(void)
{
}

WEAK struct port_fb port_fb(void)
{
    struct port_fb none = {.pixels = NULL};

    return none;
}

WEAK void port_present(void)
{
}

WEAK uint32_t port_ticks(void)
{
    return 0;
}

WEAK uint32_t port_instructions(uint32_t ticks)
{
    (void)ticks;
    return 0;
}

WEAK void port_putc(char c)
{
    (void)c;
}

WEAK uint32_t port_input(void)
{
    return 0;
}

WEAK const char *port_arg(int n)
{
    (void)n;
    return NULL;
}

WEAK long port_read_file(const char *name, void *buffer, size_t max)
{
    (void)name;
    (void)buffer;
    (void)max;
    return -1;
}

WEAK uint32_t port_stack(void)
{
    return 0;
}

WEAK _Noreturn void port_exit(int status)
{
    (void)status;
    for (;;) {
        /* a board without a way out stays here */
    }
}
