/* SPDX-License-Identifier: MIT */
/*
 * PlayStation: R3000A at 33.87 MHz, 2 MB. Registers as in "Nocash PSX Specifications".
 *
 * The console is the BIOS's: a byte a call, which goes to the emulator's output, to a serial line,
 * or nowhere. The first byte of a line lets tools/psx_run.py tell the line from the emulator's own
 * output; the exit status is a line of its own. Arguments stand in the image (bare/arguments.c).
 */
#include "psx.h"

#include "port.h"

enum { LINE_BEGINS = 2, STATUS_BEGINS = 3 };

void port_init(void)
{
    ticks_start();
    gpu_start();
    pad_start();
}

/* ------------------------------------------------------------------- counter */

#define LINES       REGISTER16(0x1f801110) /* counter 1 */
#define LINES_MODE  REGISTER16(0x1f801114)
#define CYCLES      REGISTER16(0x1f801120) /* counter 2 */
#define CYCLES_MODE REGISTER16(0x1f801124)
#define COUNT_LINES 0x100 /* counts the lines of the display */
#define COUNT_ALL   0
#define SHARE_BITS  4

const uint32_t port_ticks_hz = 33868800;

static uint32_t line_cycles; /* cycles of one line of the display, in 1/16 */

static uint16_t next_line(void)
{
    uint16_t line = LINES;

    while (LINES == line) {
    }
    return CYCLES;
}

void ticks_start(void)
{
    enum { LINES_MEASURED = 28 }; /* nearly a wrap of the other counter */
    uint16_t start;

    LINES_MODE = COUNT_LINES;
    CYCLES_MODE = COUNT_ALL;
    start = next_line();
    for (int i = 0; i < LINES_MEASURED - 1; i++) {
        next_line();
    }
    line_cycles = ((uint32_t)(uint16_t)(next_line() - start) << SHARE_BITS) / LINES_MEASURED;
}

/*
 * Cycles. The counter of cycles has 16 bits and wraps in 2 milliseconds; the number of display
 * lines since the last call tells how often. Call this function at least once a second.
 */
uint32_t port_ticks(void)
{
    static uint32_t ticks, line_before, cycles_before;
    uint32_t line = LINES, cycles = CYCLES;
    uint32_t about = (line - line_before) % 65536 * line_cycles >> SHARE_BITS;
    /* the nearest of all numbers whose lower bits are those of the counter */
    uint32_t more = (cycles - cycles_before - about) % 65536;

    ticks += about + more - (more >= 32768 ? 65536 : 0);
    line_before = line;
    cycles_before = cycles;
    return ticks;
}

/* pcsxr lets every instruction take two cycles, and counts nothing else. */
uint32_t port_instructions(uint32_t ticks)
{
    (void)ticks;
    return 0;
}

/* ------------------------------------------------------------------- console */

/* Function 0x3c of the BIOS's table A. */
static void put_byte(uint32_t byte)
{
    register uint32_t a0 __asm__("$4") = byte;
    register uint32_t t1 __asm__("$9") = 0x3c;
    register uint32_t t2 __asm__("$10") = 0xa0;

    __asm__ volatile("jalr %2\n\tnop"
                     : "+r"(a0), "+r"(t1), "+r"(t2)
                     :
                     : "$2", "$3", "$5", "$6", "$7", "$8", "$11", "$12", "$13", "$14", "$15", "$24",
                       "$25", "$31", "hi", "lo", "memory");
}

void port_putc(char c)
{
    static uint8_t inside;

    if (!inside) {
        put_byte(LINE_BEGINS);
    }
    inside = c != '\n';
    put_byte((uint8_t)c);
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
    put_byte('\n');
    put_byte(STATUS_BEGINS);
    put_byte('0' + (uint32_t)status / 100 % 10);
    put_byte('0' + (uint32_t)status / 10 % 10);
    put_byte('0' + (uint32_t)status % 10);
    put_byte('\n');
    for (;;) {
    }
}
