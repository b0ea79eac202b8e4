/* SPDX-License-Identifier: MIT */
/*
 * Luminary's LM3S6965 evaluation board: Cortex-M3 at 50 MHz; an OLED of 128 x 64 pixels in 16 greys, whose controller, an SSD0323,
 * is on a serial bus.
 *
 * With the option pictures=..., the runner photographs the OLED at every frame (semihost.h).
 */
#include "port.h"
#include "semihost.h"
#include "arm/systick.h"

enum { WIDTH = 128, HEIGHT = 64 };

#define REGISTER(address) (*(volatile uint32_t *)(address))

/* System control. The clock is the PLL's 200 MHz, from a crystal of 8 MHz, divided by 4. */
#define PLL_STATUS    REGISTER(0x400fe050)
#define PLL_LOCKED    (1u << 6)
#define CLOCK         REGISTER(0x400fe060)
#define CLOCK_CRYSTAL (14u << 6)
#define CLOCK_BYPASS  (1u << 11) /* flag of the PLL */
#define CLOCK_DIVIDED (1u << 22)
#define CLOCK_BY_4    (3u << 23)
#define SERIAL_CLOCKS REGISTER(0x400fe104)
#define SERIAL_0      (1u << 4)
#define PIN_CLOCKS    REGISTER(0x400fe108)
#define PINS_A_C_D    13u

/* A port has eight pins; each pin has its own data address. */
#define PORT_A           0x40004000u
#define PORT_C           0x40006000u
#define PORT_D           0x40007000u
#define PIN(port, n)     REGISTER((port) + (4u << (n)))
#define PIN_OUT(port)    REGISTER((port) + 0x400u)
#define PIN_SERIAL(port) REGISTER((port) + 0x420u)
#define PIN_ON(port)     REGISTER((port) + 0x51cu)
#define IS_DATA          7 /* pin of port C: the bytes are pixels, not commands */
#define CARD_OFF         0 /* pin of port D: the memory card, on the same bus, does not listen */

struct serial {
    uint32_t frame, control, data, status, prescale;
};
#define SERIAL        ((volatile struct serial *)0x40008000)
#define SERIAL_8_BITS 7u
#define SERIAL_ENABLE 2u
#define SERIAL_BUSY   (1u << 4)

/* Commands of the SSD0323; rows are of 64 bytes. */
enum { COLUMNS = 0x15, ROWS = 0x75, REMAP = 0xa0, DISPLAY_ON = 0xaf };

static uint8_t pixels[HEIGHT][WIDTH / 2];

static void start_clock(void)
{
    CLOCK = CLOCK_CRYSTAL | CLOCK_BYPASS;
    while (!(PLL_STATUS & PLL_LOCKED)) {
        /* This takes half a millisecond at most. */
    }
    CLOCK = CLOCK_CRYSTAL | CLOCK_DIVIDED | CLOCK_BY_4 | CLOCK_BYPASS;
    CLOCK = CLOCK_CRYSTAL | CLOCK_DIVIDED | CLOCK_BY_4;
}

static void send(uint8_t byte)
{
    SERIAL->data = byte;
    while (SERIAL->status & SERIAL_BUSY) {
        /* A byte takes two microseconds. */
    }
    (void)SERIAL->data; /* read the answer, because the bus stops when its buffer is full */
}

static void command(uint8_t byte)
{
    PIN(PORT_C, IS_DATA) = 0;
    send(byte);
}

static void start_display(void)
{
    SERIAL_CLOCKS = SERIAL_0;
    PIN_CLOCKS = PINS_A_C_D;
    PIN_SERIAL(PORT_A) = PIN_ON(PORT_A) = 1u << 2 | 1u << 3 | 1u << 5;
    PIN_OUT(PORT_C) = PIN_ON(PORT_C) = 1u << IS_DATA;
    PIN_OUT(PORT_D) = PIN_ON(PORT_D) = 1u << CARD_OFF;
    PIN(PORT_D, CARD_OFF) = 1u << CARD_OFF;
    SERIAL->prescale = 12;
    SERIAL->frame = SERIAL_8_BITS;
    SERIAL->control = SERIAL_ENABLE;
    command(REMAP);
    command(0);
    command(DISPLAY_ON);
}

void port_init(void)
{
    start_clock();
    systick_start();
    start_display();
}

struct port_fb port_fb(void)
{
    struct port_fb fb = {.pixels = pixels,
                         .width = WIDTH,
                         .height = HEIGHT,
                         .stride = sizeof pixels[0],
                         .format = PORT_GREY4};

    return fb;
}

void port_present(void)
{
    static const uint8_t everything[] = {COLUMNS, 0, WIDTH / 2 - 1, ROWS, 0, HEIGHT - 1};

    for (size_t i = 0; i < sizeof everything; i++) {
        command(everything[i]);
    }
    PIN(PORT_C, IS_DATA) = 1u << IS_DATA;
    for (size_t y = 0; y < HEIGHT; y++) {
        for (size_t x = 0; x < WIDTH / 2; x++) {
            send(pixels[y][x]);
        }
    }
    semihost_picture();
}

uint32_t port_input(void)
{
    return 0;
}
