/* SPDX-License-Identifier: MIT */
/*
 * Instructions from ticks under QEMU's -icount shift=N: one instruction is 2^N ns of virtual time.
 *
 * A difference of two readings is off by less than one tick, so it rounds to the exact number when
 * a tick is shorter than half an instruction. The larger the shift, the more differences may be
 * summed before they are converted: ten at 25 MHz and N = 10.
 */
#include "port.h"

uint32_t port_instructions(uint32_t ticks)
{
    uint64_t per_instruction = (uint64_t)port_ticks_hz << PORT_ICOUNT_SHIFT; /* ticks, times 10^9 */

    return (uint32_t)((ticks * (uint64_t)1000000000 + per_instruction / 2) / per_instruction);
}
