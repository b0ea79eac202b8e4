/* SPDX-License-Identifier: MIT */
/*
 * semihost.h - semihosting: the debugger or emulator does input and output for the program.
 *
 * semihost.c gives a bare board the console, arguments, files and exit status of port.h. The functions below are for the boards
 * themselves.
 */
#ifndef CAROM_PORT_BARE_SEMIHOST_H
#define CAROM_PORT_BARE_SEMIHOST_H

#include <stddef.h>
#include <stdint.h>

/* The trap, which a family of processors defines: an operation on a block or a string. Returns its result. */
intptr_t semihost_call(intptr_t operation, const void *block);

/*
 * port_present of a board whose display the runner can photograph: with the option pictures=..., print the line "picture" and wait
 * for a character from the console.
 */
void semihost_picture(void);

/* Open a file to write on the host: a handle, or -1. */
intptr_t semihost_create(const char *name);
void semihost_write(intptr_t file, const void *bytes, size_t count);
void semihost_close(intptr_t file);

#endif
