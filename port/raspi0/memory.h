/* SPDX-License-Identifier: MIT */
/* memory.h - caches of the Raspberry Pi Zero. */
#ifndef CAROM_PORT_RASPI0_MEMORY_H
#define CAROM_PORT_RASPI0_MEMORY_H

#include <stddef.h>

/* Order writes: earlier ones reach memory before later ones. */
void memory_barrier(void);

/*
 * Turn the caches on for memory, except for a framebuffer of so many bytes and for registers.
 * Addresses do not change; an access to any other address is a fault.
 */
void memory_start(const void *framebuffer, size_t bytes);

#endif
