/* SPDX-License-Identifier: MIT */
/* The port that does nothing: copy this folder to bring up a board, and fill in what it has. */
#include "port.h"

const uint32_t port_ticks_hz = 1;

void port_init(void)
{
}

struct port_fb port_fb(void)
{
    struct port_fb none = {.pixels = NULL};

    return none;
}

void port_present(void)
{
}

uint32_t port_ticks(void)
{
    return 0;
}

uint32_t port_instructions(uint32_t ticks)
{
    (void)ticks;
    return 0;
}

void port_putc(char c)
{
    (void)c;
}

uint32_t port_input(void)
{
    return 0;
}

const char *port_arg(int n)
{
    (void)n;
    return NULL;
}

long port_read_file(const char *name, void *buffer, size_t max)
{
    (void)name;
    (void)buffer;
    (void)max;
    return -1;
}

uint32_t port_stack(void)
{
    return 0;
}

_Noreturn void port_exit(int status)
{
    (void)status;
    for (;;) {
        /* A board without a way out stays here. */
    }
}
