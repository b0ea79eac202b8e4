/* SPDX-License-Identifier: MIT */
/*
 * ARM's MPS2 boards with a Cortex-M (application notes 385, 386, 500). QEMU models no display of theirs, so there is a
 * framebuffer only when pictures are written (picture.h).
 */
#include "picture.h"

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
    struct port_fb fb = port_fb();

    picture_write(&fb);
}

uint32_t port_ticks(void)
{
    return ~TIMER0->value;
}

uint32_t port_input(void)
{
    return 0;
}
