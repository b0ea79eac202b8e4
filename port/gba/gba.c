/* SPDX-License-Identifier: MIT */
/*
 * Game Boy Advance: ARM7TDMI at 16.78 MHz, 240 x 160 pixels of 15 bits, ten keys.
 *
 * The console is the debug port of the emulator mGBA; on anything else its output is lost. A line goes out in pieces, because mGBA
 * cuts long ones. port_exit logs the status as an error and stops. Arguments stand in the image (bare/arguments.c). With the
 * option pictures=..., port_present prints the line "picture" and lets two frames pass, in which the runner takes the picture.
 */
#include <string.h>

#include "memory.h"
#include "port.h"
#include "start.h"

enum { WIDTH = 240, HEIGHT = 160 };

#define REGISTER16(address) (*(volatile uint16_t *)(address))
#define DISPLAY_CONTROL     REGISTER16(0x04000000)
#define DISPLAY_LINE        REGISTER16(0x04000006)
#define TIMER_COUNT(n)      REGISTER16(0x04000100 + 4 * (n))
#define TIMER_CONTROL(n)    REGISTER16(0x04000102 + 4 * (n))
#define KEYS                REGISTER16(0x04000130)
#define WAIT_CONTROL        REGISTER16(0x04000204)

#define BITMAP_16         0x0403 /* mode 3: a bitmap, in background 2 */
#define TIMER_RUNS        0x80
#define TIMER_CASCADES    0x04
#define CARTRIDGE_FASTEST 0x4317 /* 3 cycles, 1 when in sequence; read ahead */

/* mGBA's debug port: unlocked by a number, a text, a level that sends it. */
#define DEBUG_ENABLE REGISTER16(0x04fff780)
#define DEBUG_SEND   REGISTER16(0x04fff700)
#define DEBUG_TEXT   ((volatile char *)0x04fff600)
#define DEBUG_UNLOCK 0xc0de
enum { SEND_STATUS = 0x101, SEND_PIECE = 0x102, SEND_LINE = 0x103 };
#define PIECE_MAX 80

const uint32_t port_ticks_hz = 16777216;

_Noreturn void gba_start(void);

/*
 * Fill the memory that start() does not know: the code that runs from RAM, memcpy among it, and the
 * wide RAM.
 */
_Noreturn void gba_start(void)
{
    WAIT_CONTROL = CARTRIDGE_FASTEST;
    memory_start();
    start();
}

void port_init(void)
{
    DISPLAY_CONTROL = BITMAP_16;
    TIMER_CONTROL(1) = TIMER_RUNS | TIMER_CASCADES;
    TIMER_CONTROL(0) = TIMER_RUNS;
}

struct port_fb port_fb(void)
{
    struct port_fb fb = {.pixels = (void *)0x06000000,
                         .width = WIDTH,
                         .height = HEIGHT,
                         .stride = 2 * WIDTH,
                         .format = PORT_BGR555};

    return fb;
}

/* Wait until the last line is out; the next one begins a millisecond later. */
static void wait_for_blank(void)
{
    while (DISPLAY_LINE >= HEIGHT) {
    }
    while (DISPLAY_LINE < HEIGHT) {
    }
}

void port_present(void)
{
    if (port_option("pictures")) {
        port_print("picture\n");
        wait_for_blank();
        wait_for_blank();
    }
}

/* Cycles: two timers of 16 bits; the second counts the wraps of the first. */
uint32_t port_ticks(void)
{
    uint32_t high = TIMER_COUNT(1), low = TIMER_COUNT(0), again = TIMER_COUNT(1);

    /* the first timer may have wrapped in between: a small count belongs to the later reading */
    return (low < 0x8000 ? again : high) << 16 | low;
}

uint32_t port_instructions(uint32_t ticks)
{
    (void)ticks;
    return 0;
}

static void send(const char *text, uint16_t level)
{
    volatile char *to = DEBUG_TEXT;

    DEBUG_ENABLE = DEBUG_UNLOCK; /* set each time, because a fault may come before port_init */
    while (*text) {
        *to++ = *text++;
    }
    *to = '\0';
    DEBUG_SEND = level;
}

void port_putc(char c)
{
    static char piece[PIECE_MAX + 1];
    static size_t length;

    if (c != '\n') {
        piece[length++] = c;
    }
    if (c == '\n' || length == PIECE_MAX) {
        piece[length] = '\0';
        send(piece, c == '\n' ? SEND_LINE : SEND_PIECE);
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
    char text[] = {(char)('0' + status / 100 % 10), (char)('0' + status / 10 % 10),
                   (char)('0' + status % 10), '\0'};

    send(text, SEND_STATUS);
    for (;;) {
    }
}
