/* SPDX-License-Identifier: MIT */
/* psx.h - the parts of the PlayStation's port, and registers that several of them use. */
#ifndef CAROM_PORT_PSX_PSX_H
#define CAROM_PORT_PSX_PSX_H

#include <stdint.h>

#define REGISTER8(address)  (*(volatile uint8_t *)(address))
#define REGISTER16(address) (*(volatile uint16_t *)(address))
#define REGISTER32(address) (*(volatile uint32_t *)(address))
#define INTERRUPTS          REGISTER32(0x1f801070) /* pending interrupts; writing a 0 clears one */

/* Start the display, the counter, the pad. */
void gpu_start(void);
void ticks_start(void);
void pad_start(void);

#endif
