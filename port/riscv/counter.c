/* SPDX-License-Identifier: MIT */
/*
 * Ticks are instructions: a RISC-V counts the instructions that it has retired.
 *
 * QEMU's counter is its virtual time in ns under -icount, hence the shift of 0: one instruction a
 * ns.
 */
#include "port.h"

#if PORT_ICOUNT_SHIFT != 0
#error "minstret of QEMU counts instructions at a shift of 0 alone"
#endif

const uint32_t port_ticks_hz = 1000000000;

uint32_t port_ticks(void)
{
    uint32_t count;

    __asm__ volatile("csrr %0, minstret" : "=r"(count));
    return count;
}

uint32_t port_instructions(uint32_t ticks)
{
    return ticks;
}
