/* SPDX-License-Identifier: MIT */
/*
 * The host: a framebuffer in memory; ticks are nanoseconds.
 *
 * With the option pictures=DIRECTORY, port_present writes the framebuffer as DIRECTORY/frame-0001.png and so on.
 *
 * With press=N:KEYS,... the pad holds KEYS, a sum of enum port_pad, from the N-th query on; a program queries the pad once a
 * frame.
 */
#define _POSIX_C_SOURCE 200809L
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "port.h"

enum { WIDTH = 512, HEIGHT = 512 };

const uint32_t port_ticks_hz = 1000000000;

static uint32_t pixels[HEIGHT][WIDTH];

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

uint32_t port_input(void)
{
    static unsigned long times;
    const char *entry = port_option("press");
    uint32_t keys = 0;

    times++;
    while (entry && *entry) {
        char *end;
        unsigned long from = strtoul(entry, &end, 10);
        unsigned long held = *end == ':' ? strtoul(end + 1, &end, 10) : 0;

        keys = times >= from ? (uint32_t)held : keys;
        entry = *end == ',' ? end + 1 : NULL;
    }
    return keys;
}
