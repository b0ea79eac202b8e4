/* SPDX-License-Identifier: MIT */
/* Console, arguments, files and exit status by semihosting, for every processor that has it. */
#include <string.h>

#include "port.h"
#include "semihost.h"

/* Operations, by ARM's "Semihosting for AArch32 and AArch64"; RISC-V has taken them over. */
enum {
    SYS_OPEN = 0x01,
    SYS_CLOSE = 0x02,
    SYS_WRITE0 = 0x04,
    SYS_WRITE = 0x05,
    SYS_READ = 0x06,
    SYS_READC = 0x07,
    SYS_GET_CMDLINE = 0x15,
    SYS_EXIT_EXTENDED = 0x20
};
enum { OPEN_READ_BINARY = 1, OPEN_WRITE_BINARY = 5 };
#define APPLICATION_EXIT 0x20026 /* ADP_Stopped_ApplicationExit */

/* Room for the arguments; a small board has less (board.mk). */
#ifndef BOARD_LINE_BYTES
#define BOARD_LINE_BYTES 512
#endif

static struct {
    char line[64]; /* one call for many characters is much faster than one call for each */
    size_t length;
} console;

static void flush(void)
{
    console.line[console.length] = '\0';
    semihost_call(SYS_WRITE0, console.line);
    console.length = 0;
}

void port_putc(char c)
{
    console.line[console.length++] = c;
    if (c == '\n' || console.length == sizeof console.line - 1) {
        flush();
    }
}

void semihost_picture(void)
{
    if (port_option("pictures")) {
        for (const char *text = "picture\n"; *text; text++) {
            port_putc(*text);
        }
        semihost_call(SYS_READC, NULL);
    }
}

static intptr_t open_file(const char *name, intptr_t mode)
{
    intptr_t block[3] = {(intptr_t)name, mode, (intptr_t)strlen(name)};

    return semihost_call(SYS_OPEN, block);
}

intptr_t semihost_create(const char *name)
{
    return open_file(name, OPEN_WRITE_BINARY);
}

void semihost_write(intptr_t file, const void *bytes, size_t count)
{
    intptr_t block[3] = {file, (intptr_t)bytes, (intptr_t)count};

    semihost_call(SYS_WRITE, block);
}

void semihost_close(intptr_t file)
{
    semihost_call(SYS_CLOSE, &file);
}

long port_read_file(const char *name, void *buffer, size_t max)
{
    intptr_t file = open_file(name, OPEN_READ_BINARY);
    intptr_t block[3] = {file, (intptr_t)buffer, (intptr_t)max};
    intptr_t left;

    if (file == -1) {
        return -1;
    }
    left = semihost_call(SYS_READ, block); /* number of bytes that were not read */
    semihost_close(file);
    return (long)((intptr_t)max - left);
}

/*
 * Put the arguments of a command line one after the other, each ended by a zero. Returns their
 * number.
 */
static int split(char *line)
{
    char *end = line;
    int count = 0;

    while (*line) {
        if (*line == ' ') {
            line++;
            continue;
        }
        while (*line && *line != ' ') {
            *end++ = *line++;
        }
        line += *line == ' ';
        *end++ = '\0';
        count++;
    }
    return count;
}

const char *port_arg(int n)
{
    static char line[BOARD_LINE_BYTES];
    static int count = -1;
    const char *argument = line;

    if (count < 0) {
        intptr_t block[2] = {(intptr_t)line, (intptr_t)sizeof line};

        if (semihost_call(SYS_GET_CMDLINE, block) != 0) {
            port_print("the command line is longer than %u characters\n",
                       (unsigned)sizeof line - 1);
            port_exit(1);
        }
        count = split(line);
    }
    if (n < 0 || n >= count) {
        return NULL;
    }
    while (n-- > 0) {
        argument += strlen(argument) + 1;
    }
    return argument;
}

_Noreturn void port_exit(int status)
{
    intptr_t block[2] = {APPLICATION_EXIT, status};

    flush();
    for (;;) {
        semihost_call(SYS_EXIT_EXTENDED, block);
    }
}
