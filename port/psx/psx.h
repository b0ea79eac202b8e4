/* SPDX-License-Identifier: MIT */
/* psx.h - the parts of the PlayStation's port, and the registers of it that more than one uses. */
#ifndef CAROM_PORT_PSX_PSX_H
#define CAROM_PORT_PSX_PSX_H

#include <stdint.h>

#define REGISTER8(address)  (*(volatile uint8_t *)(address))
#define REGISTER16(address) (*(volatile uint16_t *)(address))
#define REGISTER32(address) (*(volatile uint32_t *)(address))
#define INTERRUPTS          REGISTER32(0x1f801070) /* that were asked for; a 0 takes one back */

/* Bring up the display; the counter; the pad. */
void gpu_start(void);
void ticks_start(void);
void pad_start(void);

#endif
