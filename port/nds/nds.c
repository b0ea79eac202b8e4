/* SPDX-License-Identifier: MIT */
/*
 * Nintendo DS: ARM946E-S at 67 MHz, two screens of 256 x 192 pixels of 15 bits, a pad.
 *
 * The upper screen shows a bank of memory, which holds the picture. The lower one is the console: a
 * page of text, or, for a program with arguments, the channel that a runner reads (channel.h).
 * Then, with the option pictures=..., port_present prints the line "picture" and lets a frame pass,
 * which the runner photographs.
 */
#include <stdbool.h>

#include "carom_draw.h"
#include "channel.h"
#include "port.h"

enum { WIDTH = 256, HEIGHT = 192 };

#define REGISTER8(address)  (*(volatile uint8_t *)(address))
#define REGISTER16(address) (*(volatile uint16_t *)(address))
#define REGISTER32(address) (*(volatile uint32_t *)(address))
#define DISPLAY_STATE       REGISTER16(0x04000004)
#define DISPLAY_LINE        REGISTER16(0x04000006)
#define UPPER_CONTROL       REGISTER32(0x04000000)
#define UPPER_BRIGHTNESS    REGISTER16(0x0400006c)
#define LOWER_CONTROL       REGISTER32(0x04001000)
#define LOWER_BACKGROUND    REGISTER16(0x0400100e)
#define LOWER_STEPS         ((volatile uint16_t *)0x04001030)
#define LOWER_ORIGIN        ((volatile uint32_t *)0x04001038)
#define LOWER_BRIGHTNESS    REGISTER16(0x0400106c)
#define TIMER_COUNT(n)      REGISTER16(0x04000100 + 4 * (n))
#define TIMER_CONTROL(n)    REGISTER16(0x04000102 + 4 * (n))
#define KEYS                REGISTER16(0x04000130)
#define BANK_A              REGISTER8(0x04000240)
#define BANK_C              REGISTER8(0x04000242)
#define POWER               REGISTER16(0x04000304)

#define SHOW_BANK_A    0x00020000
#define SHOW_BITMAP    0x00010805 /* background 3 as a bitmap that can be rotated */
#define BITMAP_15      0x4084     /* 256 x 256 pixels of 16 bits, from the start of the bank */
#define BANK_PLAIN     0x80
#define BANK_LOWER     0x84
#define POWER_2D       0x8203 /* both screens, and the engine that draws the upper one */
#define ONE            0x100
#define OPAQUE         0x8000
#define TIMER_RUNS     0x80
#define TIMER_CASCADES 0x04

#define UPPER ((volatile uint16_t *)0x06800000)
#define LOWER ((volatile uint16_t *)0x06200000)

/* Twice the rate of the timers, which count at the bus's half of the processor's rate. */
const uint32_t port_ticks_hz = 67027964;

static void fill(volatile uint16_t *pixels, int32_t rows)
{
    for (int32_t i = 0; i < rows * WIDTH; i++) {
        pixels[i] = OPAQUE;
    }
}

void port_init(void)
{
    POWER = POWER_2D;
    BANK_A = BANK_PLAIN;
    BANK_C = BANK_LOWER;
    fill(UPPER, HEIGHT);
    fill(LOWER, HEIGHT);
    UPPER_CONTROL = SHOW_BANK_A;
    LOWER_BACKGROUND = BITMAP_15;
    LOWER_STEPS[0] = LOWER_STEPS[3] = ONE;
    LOWER_STEPS[1] = LOWER_STEPS[2] = 0;
    LOWER_ORIGIN[0] = LOWER_ORIGIN[1] = 0;
    LOWER_CONTROL = SHOW_BITMAP;
    UPPER_BRIGHTNESS = LOWER_BRIGHTNESS = 0;
    TIMER_CONTROL(0) = TIMER_CONTROL(1) = 0;
    TIMER_COUNT(0) = TIMER_COUNT(1) = 0;
    TIMER_CONTROL(1) = TIMER_RUNS | TIMER_CASCADES;
    TIMER_CONTROL(0) = TIMER_RUNS;
}

struct port_fb port_fb(void)
{
    struct port_fb fb = {.pixels = (void *)UPPER,
                         .width = WIDTH,
                         .height = HEIGHT,
                         .stride = 2 * WIDTH,
                         .format = PORT_BGR555};

    return fb;
}

/* Wait until the last line is out; the next frame begins four milliseconds later. */
static void wait_for_blank(void)
{
    while (DISPLAY_LINE >= HEIGHT) {
    }
    while (DISPLAY_LINE < HEIGHT) {
    }
}

/* Wait until the screen has shown the present memory as a whole. */
static void show_frame(void)
{
    wait_for_blank();
    wait_for_blank();
}

void port_present(void)
{
    if (port_option("pictures")) {
        port_print("picture\n");
        show_frame();
    }
}

/* Two timers of 16 bits; the second counts the wraps of the first. */
uint32_t port_ticks(void)
{
    uint32_t high = TIMER_COUNT(1), low = TIMER_COUNT(0), again = TIMER_COUNT(1);

    /* the first timer may have wrapped in between: a small count belongs to the later reading */
    return ((low < 0x8000 ? again : high) << 16 | low) << 1;
}

uint32_t port_instructions(uint32_t ticks)
{
    (void)ticks;
    return 0;
}

/* ---------------------------------------------------------------- console */

static bool has_runner(void)
{
    return port_arg(0) != NULL;
}

/* Write to the channel. Wait, so that the ring is shown before it is overwritten. */
static void send(char c)
{
    static uint32_t count, seen;

    if ((count + 1) % CHANNEL_ROOM == seen) {
        show_frame();
        seen = count;
    }
    LOWER[CHANNEL_WIDTH + count] = (uint16_t)(OPAQUE | (uint8_t)c);
    count = (count + 1) % CHANNEL_ROOM;
    LOWER[CHANNEL_COUNT_AT] = (uint16_t)(OPAQUE | count);
    LOWER[CHANNEL_MARK_AT] = OPAQUE | CHANNEL_MARK;
}

/* Write a line below the last one; a full page begins again. */
static void write_line(const char *line)
{
    static int32_t y;
    const struct carom_picture page = {.pixels = (void *)LOWER,
                                       .width = WIDTH,
                                       .height = HEIGHT,
                                       .stride = 2 * WIDTH,
                                       .format = CAROM_BGR555};
    struct carom_text where = {.colour = CAROM_COLOUR_WHITE};

    if (y + CAROM_TEXT_HEIGHT > HEIGHT) {
        y = 0;
        fill(LOWER, HEIGHT);
    }
    where.y = y;
    carom_draw_text(&page, &where, line, NULL);
    for (int32_t i = y * WIDTH; i < (y + CAROM_TEXT_HEIGHT) * WIDTH; i++) {
        LOWER[i] |= OPAQUE;
    }
    y += CAROM_TEXT_HEIGHT;
}

void port_putc(char c)
{
    static char line[WIDTH / CAROM_TEXT_WIDTH + 1];
    static size_t length;

    if (has_runner()) {
        send(c);
        return;
    }
    if (c != '\n') {
        line[length++] = c;
    }
    if (c == '\n' || length == sizeof line - 1) {
        line[length] = '\0';
        write_line(line);
        length = 0;
    }
}

/* The keys as the hardware numbers them; a set bit is a held key. */
uint32_t port_input(void)
{
    return ~KEYS & 0x3ff;
}

long port_read_file(const char *name, void *buffer, size_t max)
{
    (void)name;
    (void)buffer;
    (void)max;
    return -1;
}

_Noreturn void port_exit(int status)
{
    if (has_runner()) {
        if (LOWER_CONTROL != SHOW_BITMAP) { /* a program may end, or fault, before port_init */
            port_init();
        }
        LOWER[CHANNEL_STATUS_AT] = (uint16_t)(OPAQUE | CHANNEL_ENDED | (status & 0xff));
        LOWER[CHANNEL_MARK_AT] = OPAQUE | CHANNEL_MARK;
    }
    for (;;) {
    }
}
