/* SPDX-License-Identifier: MIT */
/*
 * semihost.h - ARM semihosting: the debugger or emulator does input and output for the program.
 *
 * semihost.c gives every ARM board the console, arguments, files and exit status of port.h; what is
 * below is for the boards' own use.
 */
#ifndef CAROM_PORT_ARM_SEMIHOST_H
#define CAROM_PORT_ARM_SEMIHOST_H

#include <stddef.h>
#include <stdint.h>

/* Write out what port_putc has kept back. */
void semihost_flush(void);

/* Wait for one character of the console and return it. */
int semihost_getc(void);

/*
 * What port_present does on a board whose display the runner can photograph: with the option
 * pictures=..., print the line "picture" and wait for a character from the console.
 */
void semihost_picture(void);

/* Files to write on the host: a handle, or -1. */
intptr_t semihost_create(const char *name);
void semihost_write(intptr_t file, const void *bytes, size_t count);
void semihost_close(intptr_t file);

#endif
