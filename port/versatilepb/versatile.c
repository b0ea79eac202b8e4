/* SPDX-License-Identifier: MIT */
/* ARM Versatile/PB: ARM926EJ-S, PL110 LCD controller. */
#include "carom_draw.h"
#include "port.h"
#include "semihost.h"

enum { WIDTH = 512, HEIGHT = 512 };

/* The PL110 of the Versatile: control and interrupt mask are swapped. */
struct lcd {
    uint32_t timing[4];
    uint32_t upper_base, lower_base;
    uint32_t control, interrupts;
    uint32_t others[120];
    uint32_t palette[128]; /* two colours a word, 5 bits a component, red in the lowest */
};
#define LCD        ((volatile struct lcd *)0x10120000)
#define LCD_ENABLE 1u
#define LCD_8_BITS (3u << 1) /* 8 bits of palette: a frame takes the fewest instructions to draw */
#define LCD_TFT    (1u << 5)
#define LCD_POWER  (1u << 11)

/* System registers: a counter at 24 MHz that never stops. */
#define SYS_24MHZ (*(volatile uint32_t *)0x1000005c)

const uint32_t port_ticks_hz = 24000000;

static uint8_t pixels[HEIGHT][WIDTH];

static uint32_t colour(uint32_t rgb)
{
    return (rgb >> 19 & 0x1f) | (rgb >> 6 & 0x3e0) | (rgb << 7 & 0x7c00);
}

static void set_palette(const uint32_t rgb[256])
{
    for (int i = 0; i < 128; i++) {
        LCD->palette[i] = colour(rgb[2 * i]) | colour(rgb[2 * i + 1]) << 16;
    }
}

void port_init(void)
{
    LCD->timing[0] = (WIDTH / 16 - 1) << 2;
    LCD->timing[1] = HEIGHT - 1;
    LCD->timing[2] = 1u << 26 | (WIDTH - 1) << 16;
    LCD->upper_base = (uint32_t)(uintptr_t)pixels;
    set_palette(carom_draw_palette);
    LCD->control = LCD_ENABLE | LCD_8_BITS | LCD_TFT | LCD_POWER;
}

struct port_fb port_fb(void)
{
    struct port_fb fb = {.pixels = pixels,
                         .width = WIDTH,
                         .height = HEIGHT,
                         .stride = sizeof pixels[0],
                         .format = PORT_PALETTE8,
                         .palette = set_palette};

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
