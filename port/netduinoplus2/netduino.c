/* SPDX-License-Identifier: MIT */
/*
 * Netduino Plus 2 (STM32F405): it has no display, so there is a framebuffer only when pictures are written (picture.h), of a size
 * that leaves more than half of the RAM to the engine.
 */
#include "picture.h"

enum { WIDTH = 160, HEIGHT = 120 };

/* Timer 2 has 32 bits; QEMU runs it at 1 GHz. */
struct timer {
    uint32_t control[2], slave, interrupts, status, event, mode[2], enable, count, prescale, reload;
};
#define TIM2         ((volatile struct timer *)0x40000000)
#define TIMER_ENABLE 1u

const uint32_t port_ticks_hz = 1000000000;

static uint16_t pixels[HEIGHT][WIDTH];

void port_init(void)
{
    TIM2->reload = UINT32_MAX;
    TIM2->control[0] = TIMER_ENABLE;
}

struct port_fb port_fb(void)
{
    struct port_fb fb = {.pixels = port_option("pictures") ? pixels : NULL,
                         .width = WIDTH,
                         .height = HEIGHT,
                         .stride = sizeof pixels[0],
                         .format = PORT_RGB565};

    return fb;
}

void port_present(void)
{
    struct port_fb fb = port_fb();

    picture_write(&fb);
}

uint32_t port_ticks(void)
{
    return TIM2->count;
}

uint32_t port_input(void)
{
    return 0;
}
