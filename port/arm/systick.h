/* SPDX-License-Identifier: MIT */
/* systick.h - a Cortex-M's own timer as the counter of port.h, at the processor's clock. */
#ifndef CAROM_PORT_ARM_SYSTICK_H
#define CAROM_PORT_ARM_SYSTICK_H

/* Start the timer; port_ticks is in systick.c. */
void systick_start(void);

#endif
