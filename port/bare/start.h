/* SPDX-License-Identifier: MIT */
/* start.h - from reset to main, and from a fault to an exit status, on every bare board. */
#ifndef CAROM_PORT_BARE_START_H
#define CAROM_PORT_BARE_START_H

#include <stdint.h>

/* Fill memory, run main, leave with its status. The stack is set before. */
_Noreturn void start(void);

/* Where a Cortex-M's vectors lead: a board's own function that ends in start(), else start() itself. */
_Noreturn void reset(void);

/* Say where the processor stopped and leave with status 125. */
_Noreturn void fault(uint32_t address);

#endif
