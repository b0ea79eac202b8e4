/* SPDX-License-Identifier: MIT */
/* memory.h - caches of the Raspberry Pi Zero. */
#ifndef CAROM_PORT_RASPI0_MEMORY_H
#define CAROM_PORT_RASPI0_MEMORY_H

#include <stddef.h>

/* What was written is in memory before what is written next. */
void memory_barrier(void);

/*
 * Turn the caches on, for memory but not for the framebuffer of so many bytes, nor for registers. Addresses stay as
 * they are; what is none of these is a fault.
 */
void memory_start(const void *framebuffer, size_t bytes);

#endif
