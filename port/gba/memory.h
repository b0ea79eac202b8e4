/* SPDX-License-Identifier: MIT */
/* memory.h - the contents of the memories of the Game Boy Advance at run time. */
#ifndef CAROM_PORT_GBA_MEMORY_H
#define CAROM_PORT_GBA_MEMORY_H

/* Copy the code that runs from RAM, and clear the wide RAM. Calls no function that is copied. */
void memory_start(void);

#endif
