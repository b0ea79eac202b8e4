/* SPDX-License-Identifier: MIT */
/*
 * port.h - the functions that a board gives a program: a display, a timer, a character, a way out.
 *
 * Plain functions, one definition each, found at link time: a missing one is a link error that
 * names it. The engine calls none of them; programs do. To bring up a board, copy port/null.
 */
#ifndef CAROM_PORT_H
#define CAROM_PORT_H

#include <stddef.h>
#include <stdint.h>

enum port_pixels { PORT_PALETTE8, PORT_RGB565, PORT_XRGB8888, PORT_GREY4, PORT_BGR555 };

struct port_fb {
    void *pixels; /* NULL: no display, or one that is sent rows */
    int32_t width, height;
    int32_t stride; /* bytes a row */
    uint8_t format; /* enum port_pixels, the same numbers as enum carom_pixel_format */
    /* The row function of struct carom_picture, for a display that is sent rows and keeps them; otherwise NULL. */
    void *(*row)(void *context, int32_t x0, int32_t x1, int32_t y);
    void (*palette)(
        const uint32_t rgb[256]); /* sets the palette of PORT_PALETTE8; NULL: it is fixed */
};

/* Bring up clock, timer and display. Called once, first. */
void port_init(void);

/* The framebuffer to draw into. */
struct port_fb port_fb(void);

/*
 * Show the framebuffer, or the rows that were drawn. Returns when the program may draw into it
 * again.
 */
void port_present(void);

/* A free-running counter that wraps at 2^32, and its rate. */
uint32_t port_ticks(void);
extern const uint32_t port_ticks_hz;

/*
 * Instructions executed in `ticks` ticks: exact if an emulator counts instructions and its timer is fast enough; 0 if unknown. On the
 * host ticks are nanoseconds, and this is 0.
 */
uint32_t port_instructions(uint32_t ticks);

/* One character to the console. */
void port_putc(char c);

/*
 * printf over port_putc, the same in every port, with the conversions %s %d %u %x %ld %lu %lx and, before them, a least number of digits:
 * %08lx.
 */
void port_print(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Keys of the pad that are held; 0 without a pad. */
enum port_pad {
    PORT_PAD_A = 1,
    PORT_PAD_B = 2,
    PORT_PAD_SELECT = 4,
    PORT_PAD_START = 8,
    PORT_PAD_RIGHT = 16,
    PORT_PAD_LEFT = 32,
    PORT_PAD_UP = 64,
    PORT_PAD_DOWN = 128
};
uint32_t port_input(void);

/*
 * The n-th argument of the program; n = 0 is its name. NULL past the last one, and for all n of a
 * program that is switched on without a runner.
 */
const char *port_arg(int n);

/*
 * The value of the first argument of the form name=value, or NULL. It uses port_arg, so it is the
 * same on every board. A port itself knows one option, `pictures`: port_present then outputs
 * pictures, in a way that the board's folder describes.
 */
const char *port_option(const char *name);
/* The same as a decimal number; `otherwise` if there is no such argument. */
uint32_t port_number(const char *name, uint32_t otherwise);

/*
 * Read a whole file (semihosting, host): up to `max` bytes into `buffer`. Returns the bytes read; -1 if there is no such file, or
 * there are no files.
 */
long port_read_file(const char *name, void *buffer, size_t max);

/* The largest number of bytes of stack in use so far; 0 if unknown. */
uint32_t port_stack(void);

/* Leave with an exit status. */
_Noreturn void port_exit(int status);

#endif
