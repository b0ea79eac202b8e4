/* SPDX-License-Identifier: MIT */
/* start.h - from reset to main, and from a fault to an exit status, on every bare board. */
#ifndef CAROM_PORT_BARE_START_H
#define CAROM_PORT_BARE_START_H

#include <stdint.h>

/* Fill memory, run main, leave with its status. The stack must be set already. */
_Noreturn void start(void);

/* The reset vector of a Cortex-M: a board's own function that ends in start(), or start() itself. */
_Noreturn void reset(void);

/* Print where the processor stopped and leave with status 125. */
_Noreturn void fault(uint32_t address);

#endif
