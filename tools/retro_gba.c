/* SPDX-License-Identifier: MIT */
/*
 * Game Boy Advance in mGBA. The program's lines come through mGBA's debug port in pieces: each
 * piece of a line except the last is a warning, and the exit status is an error.
 */
#include <stdlib.h>
#include <string.h>

#include "retro_run.h"

enum { LOG_WARN = 2, LOG_ERROR = 3 };

static void take_log(int level, const char *text)
{
    static const char source[] = "GBA Debug: ";
    const char *said = text + sizeof source - 1;

    if (strncmp(text, source, sizeof source - 1) != 0) {
        return;
    }
    if (level == LOG_ERROR) {
        retro_end(atoi(said));
        return;
    }
    while (*said) {
        retro_putc(*said++);
    }
    if (level != LOG_WARN) {
        retro_putc('\n');
    }
}

/* Waiting loops must take their real time. */
static const struct option options[] = {{"mgba_idle_optimization", "Don't Remove"}, {0}};

const struct machine retro_gba = {.suffix = ".gba",
                                  .core = "mgba_libretro.so",
                                  .arguments_at = 0xc0,
                                  .width = 240,
                                  .height = 160,
                                  .late = 1,
                                  .options = options,
                                  .log = take_log};
