/* SPDX-License-Identifier: MIT */
/*
 * retro_run.h - a machine that an emulator plays as a libretro core: what retro_run.c needs to know of it, and what
 * it gives to the machine's own file. Of libretro's interface only what is used is declared.
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
    const char *suffix; /* of its image, which stands beside the program */
    const char *core;
    size_t arguments_at;          /* in the image: 256 bytes that port/bare/arguments.c reads */
    unsigned width, height;       /* of the picture, at the top of a frame */
    unsigned late;                /* frames after its request until a picture is drawn to its end */
    const struct option *options; /* of the core; ended by one without a key */
    /* Take what the core logs, or what the program shows of its console in a frame. NULL: nothing comes that way. */
    void (*log)(int level, const char *text);
    void (*look)(const struct frame *frame);
};

extern const struct machine retro_gba, retro_nds;

/* A character of the program's console; a line "picture" asks for a picture. */
void retro_putc(char c);
/* The program has ended. */
void retro_end(int status);
/* A fault that ends the run. */
_Noreturn void retro_die(const char *what, const char *why);

/* The pixel of a frame in column x of row y. */
uint16_t retro_pixel(const struct frame *frame, unsigned x, unsigned y);

#endif
