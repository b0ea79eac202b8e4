/* SPDX-License-Identifier: MIT */
/* Write the framebuffer to a picture file, through semihosting. */
#include "picture.h"

#include <stdio.h>

#include "semihost.h"

/* A pixel's 8 bits of red, green and blue. */
static void split_565(uint16_t pixel, uint8_t rgb[3])
{
    rgb[0] = (uint8_t)((pixel >> 11) * 255 / 31);
    rgb[1] = (uint8_t)((pixel >> 5 & 63) * 255 / 63);
    rgb[2] = (uint8_t)((pixel & 31) * 255 / 31);
}

static void split_8888(uint32_t pixel, uint8_t rgb[3])
{
    rgb[0] = (uint8_t)(pixel >> 16);
    rgb[1] = (uint8_t)(pixel >> 8);
    rgb[2] = (uint8_t)pixel;
}

static void write_row(intptr_t file, const struct port_fb *fb, int32_t y)
{
    static uint8_t row[PICTURE_WIDTH_MAX][3];
    const void *pixels = (const uint8_t *)fb->pixels + y * fb->stride;

    for (int32_t x = 0; x < fb->width; x++) {
        if (fb->format == PORT_RGB565) {
            split_565(((const uint16_t *)pixels)[x], row[x]);
        } else {
            split_8888(((const uint32_t *)pixels)[x], row[x]);
        }
    }
    semihost_write(file, row, (size_t)fb->width * sizeof row[0]);
}

void picture_write(const struct port_fb *fb)
{
    static unsigned frame;
    char text[256];
    const char *directory = port_option("pictures");
    intptr_t file;
    int length;

    if (!directory) {
        return;
    }
    snprintf(text, sizeof text, "%s/frame-%04u.ppm", directory, ++frame);
    file = semihost_create(text);
    length = snprintf(text, sizeof text, "P6 %ld %ld 255\n", (long)fb->width, (long)fb->height);
    semihost_write(file, text, (size_t)length);
    for (int32_t y = 0; y < fb->height; y++) {
        write_row(file, fb, y);
    }
    semihost_close(file);
}
