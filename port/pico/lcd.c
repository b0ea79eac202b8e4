/* SPDX-License-Identifier: MIT */
/*
 * The display's controller, Sitronix' ST7789, on SPI 1 at 62.5 MHz, its fastest rate. There are two rows: one is drawn while direct
 * memory access sends the other.
 */
#include "lcd.h"

#include <stdbool.h>
#include <stddef.h>

#include "rp2040.h"

enum {
    PIN_DATA = 8,
    PIN_SELECT = 9,
    PIN_CLOCK = 10,
    PIN_SEND = 11,
    PIN_RESET = 12,
    PIN_LIGHT = 13
};
#define PIN(n) (1u << (n))

#define RESET_US    10
#define WAKE_US     120000
#define SLEEP_US    5000
#define NOTHING     (-1)
#define ORIENTATION 0x70 /* rows run along the side of the stick and the keys */
#define PIXELS_565  0x55

/* Commands; those of a window are followed by its first and last column, or row. */
enum {
    SLEEP_OUT = 0x11,
    NORMAL = 0x13,
    INVERT = 0x21, /* this kind of panel needs it */
    DISPLAY_ON = 0x29,
    COLUMNS = 0x2a,
    ROWS = 0x2b,
    PIXELS = 0x2c,
    ORIENT = 0x36,
    FORMAT = 0x3a
};

static struct {
    uint16_t rows[2][LCD_SIDE];
    uint32_t woken_us;
    bool is_on;
    int drawn;              /* the row that is being drawn, or NOTHING; its place follows */
    int32_t x0, x1, y;      /* its pixels */
    int32_t from, to, next; /* columns of the window, and its next row */
} lcd;

static void wait_us(uint32_t since_us, uint32_t us)
{
    while (TIMER_MICROSECONDS - since_us <= us) { /* the first microsecond may be nearly over */
    }
}

/* Wait until the last bit is out. */
static void drain(void)
{
    while (DMA_START & DMA_BUSY || SPI_STATUS & SPI_BUSY) {
    }
}

/* Set the word size, once all earlier bits are out. One wire tells commands from data. */
static void prepare(uint32_t bits, bool is_data)
{
    drain();
    if (is_data) {
        PINS_HIGH = PIN(PIN_DATA);
    } else {
        PINS_LOW = PIN(PIN_DATA);
    }
    SPI_CONTROL = 0;
    SPI_FRAME = SPI_BITS(bits) | SPI_MODE_3;
    SPI_CONTROL = SPI_ENABLE;
}

static void send(uint32_t word)
{
    while (!(SPI_STATUS & SPI_ROOM)) {
    }
    REGISTER(SPI_DATA_ADDRESS) = word;
}

static void command(uint32_t byte)
{
    prepare(8, false);
    send(byte);
}

static void parameter(uint32_t byte)
{
    prepare(8, true);
    send(byte);
}

void lcd_wake(void)
{
    static const uint8_t outputs[] = {PIN_DATA, PIN_SELECT, PIN_RESET, PIN_LIGHT};

    PIN_FUNCTION(PIN_CLOCK) = PIN_FUNCTION(PIN_SEND) = FUNCTION_SPI;
    PINS_LOW = PIN(PIN_SELECT) | PIN(PIN_RESET) | PIN(PIN_LIGHT);
    for (size_t i = 0; i < sizeof outputs; i++) {
        PINS_OUTPUT = PIN(outputs[i]);
        PIN_FUNCTION(outputs[i]) = FUNCTION_SOFTWARE;
    }
    SPI_PRESCALE = 2;
    SPI_DMA = SPI_DMA_SENDS;
    wait_us(TIMER_MICROSECONDS, RESET_US);
    PINS_HIGH = PIN(PIN_RESET);
    lcd.woken_us = TIMER_MICROSECONDS;
    lcd.drawn = NOTHING;
}

void lcd_turn_on(void)
{
    if (lcd.is_on) {
        return;
    }
    wait_us(lcd.woken_us, WAKE_US);
    command(SLEEP_OUT);
    drain();
    wait_us(TIMER_MICROSECONDS, SLEEP_US);
    command(FORMAT);
    parameter(PIXELS_565);
    command(ORIENT);
    parameter(ORIENTATION);
    command(INVERT);
    command(NORMAL);
    command(DISPLAY_ON);
    PINS_HIGH = PIN(PIN_LIGHT);
    lcd.next = NOTHING;
    lcd.is_on = true;
}

static void set_range(uint32_t which, int32_t first, int32_t last)
{
    command(which);
    prepare(16, true);
    send((uint32_t)first);
    send((uint32_t)last);
}

/* Open a window from this row down; the rows below go on without another. */
static void set_window(void)
{
    set_range(COLUMNS, lcd.x0, lcd.x1 - 1);
    set_range(ROWS, lcd.y, LCD_SIDE - 1);
    command(PIXELS);
    prepare(16, true);
    lcd.from = lcd.x0;
    lcd.to = lcd.x1;
}

static void send_row(void)
{
    if (lcd.x0 != lcd.from || lcd.x1 != lcd.to || lcd.y != lcd.next) {
        set_window();
    }
    while (DMA_START & DMA_BUSY) {
    }
    DMA_SOURCE = (uint32_t)(uintptr_t)&lcd.rows[lcd.drawn][lcd.x0];
    DMA_TARGET = SPI_DATA_ADDRESS;
    DMA_COUNT = (uint32_t)(lcd.x1 - lcd.x0);
    DMA_START = DMA_ENABLE | DMA_HALF_WORDS | DMA_SOURCE_MOVES | DMA_PACED_BY_SPI1;
    lcd.next = lcd.y + 1;
}

void *lcd_row(void *context, int32_t x0, int32_t x1, int32_t y)
{
    (void)context;
    if (lcd.drawn != NOTHING) {
        send_row(); /* the other row is out by now */
    }
    lcd.drawn = lcd.drawn == 0;
    lcd.x0 = x0;
    lcd.x1 = x1;
    lcd.y = y;
    return lcd.rows[lcd.drawn];
}

void lcd_finish(void)
{
    if (lcd.drawn != NOTHING) {
        send_row();
        drain();
        lcd.drawn = NOTHING;
    }
}
