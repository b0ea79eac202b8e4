/* SPDX-License-Identifier: MIT */
/*
 * The host: a framebuffer in memory; ticks are nanoseconds.
 *
 * With the option pictures=DIRECTORY, port_present writes the framebuffer as
 * DIRECTORY/frame-0001.png and so on.
 */
#define _POSIX_C_SOURCE 200809L
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "port.h"

enum { WIDTH = 512, HEIGHT = 512, ARGUMENTS_MAX = 64 };

const uint32_t port_ticks_hz = 1000000000;

static uint32_t pixels[HEIGHT][WIDTH];

void port_init(void)
{
    setvbuf(stdout, NULL, _IOLBF, 0); /* a runner follows what is printed */
}

struct port_fb port_fb(void)
{
    struct port_fb fb = {.pixels = pixels,
                         .width = WIDTH,
                         .height = HEIGHT,
                         .stride = sizeof pixels[0],
                         .format = PORT_XRGB8888};

    return fb;
}

void port_present(void)
{
    static unsigned frame;
    static uint8_t rgb[HEIGHT][WIDTH][3];
    const char *directory = port_option("pictures");
    png_image image = {.version = PNG_IMAGE_VERSION,
                       .width = WIDTH,
                       .height = HEIGHT,
                       .format = PNG_FORMAT_RGB,
                       .flags = PNG_IMAGE_FLAG_FAST};
    char name[256];

    if (!directory) {
        return;
    }
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            rgb[y][x][0] = (uint8_t)(pixels[y][x] >> 16);
            rgb[y][x][1] = (uint8_t)(pixels[y][x] >> 8);
            rgb[y][x][2] = (uint8_t)pixels[y][x];
        }
    }
    snprintf(name, sizeof name, "%s/frame-%04u.png", directory, ++frame);
    if (!png_image_write_to_file(&image, name, 0, rgb, 0, NULL)) {
        fprintf(stderr, "%s: %s\n", name, image.message);
        port_exit(1);
    }
}

uint32_t port_ticks(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint32_t)((uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec);
}

uint32_t port_instructions(uint32_t ticks)
{
    (void)ticks;
    return 0;
}

void port_putc(char c)
{
    putchar(c);
}

uint32_t port_input(void)
{
    return 0;
}

/* main takes no arguments on any board; Linux keeps them, each ended by a zero, in a file. */
const char *port_arg(int n)
{
    static char text[4096];
    static const char *argument[ARGUMENTS_MAX];
    static int count = -1;

    if (count < 0) {
        long bytes = port_read_file("/proc/self/cmdline", text, sizeof text - 1);

        count = 0;
        for (long k = 0; k < bytes && count < ARGUMENTS_MAX; k++) {
            if (k == 0 || text[k - 1] == '\0') {
                argument[count++] = &text[k];
            }
        }
    }
    return n >= 0 && n < count ? argument[n] : NULL;
}

long port_read_file(const char *name, void *buffer, size_t max)
{
    FILE *file = fopen(name, "rb");
    long bytes;

    if (!file) {
        return -1;
    }
    bytes = (long)fread(buffer, 1, max, file);
    fclose(file);
    return bytes;
}

struct port_stack port_stack(void)
{
    return (struct port_stack){0, 0};
}

_Noreturn void port_exit(int status)
{
    exit(status);
}
