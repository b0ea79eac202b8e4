/* SPDX-License-Identifier: MIT */
/* ARM Versatile/PB: ARM926EJ-S, PL110 LCD controller. */
#include "port.h"
#include "semihost.h"

enum { WIDTH = 512, HEIGHT = 512 };

/* PL110 as the Versatile has it: control and interrupt mask are the other way round. */
struct lcd {
    uint32_t timing[4];
    uint32_t upper_base, lower_base;
    uint32_t control, interrupts;
};
#define LCD         ((volatile struct lcd *)0x10120000)
#define LCD_ENABLE  1u
#define LCD_24_BITS (5u << 1) /* in 32-bit words */
#define LCD_TFT     (1u << 5)
#define LCD_BGR     (1u << 8)
#define LCD_POWER   (1u << 11)

/* System registers: a counter at 24 MHz that never stops. */
#define SYS_24MHZ (*(volatile uint32_t *)0x1000005c)

const uint32_t port_ticks_hz = 24000000;

static uint32_t pixels[HEIGHT][WIDTH];

void port_init(void)
{
    LCD->timing[0] = (WIDTH / 16 - 1) << 2;
    LCD->timing[1] = HEIGHT - 1;
    LCD->timing[2] = 1u << 26 | (WIDTH - 1) << 16;
    LCD->upper_base = (uint32_t)(uintptr_t)pixels;
    LCD->control = LCD_ENABLE | LCD_24_BITS | LCD_TFT | LCD_BGR | LCD_POWER;
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
    semihost_picture();
}

uint32_t port_ticks(void)
{
    return SYS_24MHZ;
}

uint32_t port_input(void)
{
    return 0;
}
