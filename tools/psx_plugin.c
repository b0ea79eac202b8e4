/* SPDX-License-Identifier: MIT */
/*
 * Plugins of tools/psx_run.py for the PlayStation emulator pcsxr: a display without a window, and a pad that a script plays. Built as
 * build/tools/psx_plugin.so.
 *
 * The graphics processor is the one of pcsxr's own plugin DFXVideo. This file is linked to it, and
 * it defines the rest. Its memory holds exactly the data that the program sent. Two variables of
 * the environment ask for more:
 *
 *   PSX_PICTURES=DIRECTORY  write the shown part of that memory as DIRECTORY/frame-0001.ppm each time the program shows another part
 *   PSX_PRESS=N:KEYS,...    hold KEYS (a sum of port.h's bits) from the N-th such picture on
 *
 * Only the used parts of the plugins' interface, PSEmu Pro's, are declared.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WIDTH = 320, HEIGHT = 240, MEMORY_WIDTH = 1024, MEMORY_HEIGHT = 512 };
enum { SHOW_FROM = 5, COMMAND_AT = 24, ROW_AT = 10 };
enum { TYPE_STANDARD = 4, KEYS = 8 };

struct frozen {
    uint32_t version, status, control[256];
    uint16_t memory[MEMORY_HEIGHT][MEMORY_WIDTH];
};

struct pad_state {
    uint8_t type;
    uint16_t released; /* one bit for each key */
    uint8_t others[97];
};

static unsigned pictures;

long GPUopen(unsigned long *display, char *caption, char *config);
long GPUclose(void);
void GPUupdateLace(void);
void GPUwriteStatus(uint32_t command);
long GPUfreeze(uint32_t what, struct frozen *frozen);
long PADinit(long flags);
long PADshutdown(void);
long PADopen(unsigned long *display);
long PADclose(void);
long PADquery(void);
long PADreadPort1(struct pad_state *pad);
long PADreadPort2(struct pad_state *pad);

static void die(const char *what, const char *why)
{
    fprintf(stderr, "psx_plugin: %s: %s\n", what, why);
    _exit(1);
}

/* ------------------------------------------------------------------- display */

long GPUopen(unsigned long *display, char *caption, char *config)
{
    (void)caption;
    (void)config;
    *display = 0;
    return 0;
}

long GPUclose(void)
{
    return 0;
}

/* The end of a frame: there is no window, and no waiting for the real clock. */
void GPUupdateLace(void)
{
}

static uint8_t eight_bits(unsigned five)
{
    return (uint8_t)(five * 255 / 31);
}

static void write_picture(const char *directory, unsigned from)
{
    static struct frozen frozen;
    char name[512];
    FILE *file;

    frozen.version = 1;
    GPUfreeze(1, &frozen);
    snprintf(name, sizeof name, "%s/frame-%04u.ppm", directory, pictures);
    file = fopen(name, "wb");
    if (!file) {
        die(name, "cannot be written");
    }
    fprintf(file, "P6 %d %d 255\n", WIDTH, HEIGHT);
    for (unsigned y = 0; y < HEIGHT; y++) {
        for (unsigned x = 0; x < WIDTH; x++) {
            uint16_t pixel = frozen.memory[(from + y) % MEMORY_HEIGHT][x];

            fputc(eight_bits(pixel & 31), file);
            fputc(eight_bits(pixel >> 5 & 31), file);
            fputc(eight_bits(pixel >> 10 & 31), file);
        }
    }
    fclose(file);
}

void GPUwriteStatus(uint32_t command)
{
    static void (*of_emulator)(uint32_t);
    const char *directory = getenv("PSX_PICTURES");

    if (!of_emulator) {
        void *symbol = dlsym(RTLD_NEXT, "GPUwriteStatus");

        if (!symbol) {
            die("DFXVideo", "has no GPUwriteStatus");
        }
        memcpy(&of_emulator, &symbol, sizeof symbol);
    }
    of_emulator(command);
    if (command >> COMMAND_AT == SHOW_FROM) {
        pictures++;
        if (directory) {
            write_picture(directory, command >> ROW_AT & (MEMORY_HEIGHT - 1));
        }
    }
}

/* ----------------------------------------------------------------------- pad */

long PADinit(long flags)
{
    (void)flags;
    return 0;
}

long PADshutdown(void)
{
    return 0;
}

long PADopen(unsigned long *display)
{
    (void)display;
    return 0;
}

long PADclose(void)
{
    return 0;
}

/* The pad is in the first socket. */
long PADquery(void)
{
    return 1;
}

/* The held keys: those of the last entry of the script whose picture has arrived. */
static unsigned held(void)
{
    unsigned keys = 0, from;
    char *next;

    for (const char *entry = getenv("PSX_PRESS"); entry && *entry;
         entry = *next ? next + 1 : next) {
        from = (unsigned)strtoul(entry, &next, 10);
        unsigned value = *next == ':' ? (unsigned)strtoul(next + 1, &next, 10) : 0;

        keys = from <= pictures ? value : keys;
        if (*next && *next != ',') {
            die("press", "not N:KEYS,...");
        }
    }
    return keys;
}

long PADreadPort1(struct pad_state *pad)
{
    /* the pad's bits of A (its cross), B (its circle), select, start, right, left, up, down */
    static const uint8_t bit[KEYS] = {14, 13, 0, 3, 5, 7, 4, 6};
    unsigned keys = held();

    pad->type = TYPE_STANDARD;
    pad->released = 0xffff;
    for (int i = 0; i < KEYS; i++) {
        if (keys >> i & 1) {
            pad->released &= (uint16_t) ~(1u << bit[i]);
        }
    }
    return 0;
}

long PADreadPort2(struct pad_state *pad)
{
    return PADreadPort1(pad);
}
