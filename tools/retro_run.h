/* SPDX-License-Identifier: MIT */
/*
 * retro_run.h - a machine that an emulator plays as a libretro core: the description that
 * retro_run.c needs, and the functions for the machine's own file. Only the used parts of
 * libretro's interface are declared.
 */
#ifndef CAROM_TOOLS_RETRO_RUN_H
#define CAROM_TOOLS_RETRO_RUN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A frame as the core shows it: RGB565. */
struct frame {
    const void *pixels;
    unsigned width, height;
    size_t pitch; /* bytes a row */
};

struct option {
    const char *key, *value;
};

struct machine {
    const char *suffix; /* suffix of the image, which stands beside the program */
    const char *core;
    size_t arguments_at;          /* offset in the image of the 256 bytes that port/bare/arguments.c
                                   * reads */
    unsigned width, height;       /* size of the picture, at the top of a frame */
    unsigned late;                /* frames from the request until a picture is complete */
    const struct option *options; /* options of the core, ended by one without a key */
    /* Takes the core's log, or the console that a frame shows. NULL: that way is not used. */
    void (*log)(int level, const char *text);
    void (*look)(const struct frame *frame);
};

extern const struct machine retro_gba, retro_nds;

/* Take a character of the program's console. A line "picture" asks for a picture. */
void retro_putc(char c);
/* The program has ended. */
void retro_end(int status);
/* A fault that ends the run. */
_Noreturn void retro_die(const char *what, const char *why);

/* The pixel of a frame in column x of row y. */
uint16_t retro_pixel(const struct frame *frame, unsigned x, unsigned y);

#endif
