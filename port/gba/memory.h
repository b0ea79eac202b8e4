/* SPDX-License-Identifier: MIT */
/* memory.h - what lies in which memory of the Game Boy Advance, while it runs. */
#ifndef CAROM_PORT_GBA_MEMORY_H
#define CAROM_PORT_GBA_MEMORY_H

/* Bring the code that runs from RAM there and clear the wide RAM. Calls nothing that is there. */
void memory_start(void);

#endif
