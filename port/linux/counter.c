/* SPDX-License-Identifier: MIT */
/*
 * The number of executed instructions of a Linux program under tools/count.c, which leaves its
 * count in shared memory. Reading the count is exact, because it makes no call and reads no clock.
 */
#define _DEFAULT_SOURCE
#include <sys/mman.h>

#include "count.h"
#include "port.h"

const uint32_t port_ticks_hz = 1000000000; /* unused: a tick is an instruction */

struct port_fb port_fb(void)
{
    struct port_fb none = {.pixels = NULL};

    return none;
}

void port_present(void)
{
}

/* The low half of the count. The emulating machine keeps it little-endian. */
uint32_t port_ticks(void)
{
    static const volatile uint8_t *count;

    if (!count) {
        void *page = mmap(NULL, COUNT_BYTES, PROT_READ, MAP_SHARED, COUNT_FILE, 0);

        if (page == MAP_FAILED) {
            port_print("nobody counts: run me by tools/run_board.py\n");
            port_exit(1);
        }
        count = page;
    }
    return (uint32_t)count[0] | (uint32_t)count[1] << 8 | (uint32_t)count[2] << 16 |
           (uint32_t)count[3] << 24;
}

uint32_t port_instructions(uint32_t ticks)
{
    return ticks;
}

uint32_t port_input(void)
{
    return 0;
}
