/* SPDX-License-Identifier: MIT */
/* The part of <string.h> that string.c defines. */
#ifndef CAROM_PORT_NOLIBC_STRING_H
#define CAROM_PORT_NOLIBC_STRING_H

#include <stddef.h>

void *memcpy(void *restrict to, const void *restrict from, size_t bytes);
void *memmove(void *to, const void *from, size_t bytes);
void *memset(void *to, int value, size_t bytes);
int memcmp(const void *a, const void *b, size_t bytes);
size_t strlen(const char *text);
int strcmp(const char *a, const char *b);
int strncmp(const char *a, const char *b, size_t most);
char *strcpy(char *restrict to, const char *restrict from);
char *strstr(const char *text, const char *part);

#endif
