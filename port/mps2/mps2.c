/* SPDX-License-Identifier: MIT */
/*
 * ARM's MPS2 boards with a Cortex-M (application notes 385, 386, 500): no display that QEMU models.
 *
 * With the option pictures=DIRECTORY there is a framebuffer, and port_present writes it by
 * semihosting as DIRECTORY/frame-0001.ppm and so on.
 */
#include <stdio.h>

#include "port.h"
#include "semihost.h"

enum { WIDTH = 512, HEIGHT = 512 };

/* CMSDK timer 0 counts down at 25 MHz. */
struct timer {
    uint32_t control, value, reload;
};
#define TIMER0       ((volatile struct timer *)0x40000000)
#define TIMER_ENABLE 1u

const uint32_t port_ticks_hz = 25000000;

static uint32_t pixels[HEIGHT][WIDTH];

void port_init(void)
{
    TIMER0->reload = UINT32_MAX;
    TIMER0->value = UINT32_MAX;
    TIMER0->control = TIMER_ENABLE;
}

struct port_fb port_fb(void)
{
    struct port_fb fb = {.pixels = port_option("pictures") ? pixels : NULL,
                         .width = WIDTH,
                         .height = HEIGHT,
                         .stride = sizeof pixels[0],
                         .format = PORT_XRGB8888};

    return fb;
}

void port_present(void)
{
    static unsigned frame;
    static uint8_t row[WIDTH][3];
    static char text[256];
    const char *directory = port_option("pictures");
    intptr_t file;
    int length;

    if (!directory) {
        return;
    }
    snprintf(text, sizeof text, "%s/frame-%04u.ppm", directory, ++frame);
    file = semihost_create(text);
    length = snprintf(text, sizeof text, "P6 %d %d 255\n", WIDTH, HEIGHT);
    semihost_write(file, text, (size_t)length);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            row[x][0] = (uint8_t)(pixels[y][x] >> 16);
            row[x][1] = (uint8_t)(pixels[y][x] >> 8);
            row[x][2] = (uint8_t)pixels[y][x];
        }
        semihost_write(file, row, sizeof row);
    }
    semihost_close(file);
}

uint32_t port_ticks(void)
{
    return ~TIMER0->value;
}

uint32_t port_input(void)
{
    return 0;
}
