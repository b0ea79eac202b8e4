/* SPDX-License-Identifier: MIT */
/*
 * Raspberry Pi Pico with Waveshare's Pico-LCD-1.3: an RP2040 at 125 MHz, which uses one of its two Cortex-M0+; a display of
 * 240 x 240 pixels (lcd.c), a stick and four keys.
 *
 * The console is UART 0 at 115200 baud, on pins 0 and 1. It ends with the character EOT and then
 * the exit status as a character. Arguments stand in the image (bare/arguments.c). With the option
 * pictures=..., port_present prints the line "picture" when the display has a whole picture.
 */
#include "port.h"

#include "arm/systick.h"
#include "lcd.h"
#include "rp2040.h"

#define UART_PIN       0
#define BAUD_64THS     ((PORT_CLOCK_MHZ * 4000000u + 115200 / 2) / 115200)
#define END_OF_CONSOLE 4

/* Pins of the keys, in the order of the pad's bits. */
static const uint8_t key_pins[] = {15, 17, 19, 21, 20, 16, 2, 18};
enum { KEYS = sizeof key_pins };

static void start_console(void)
{
    PIN_FUNCTION(UART_PIN) = FUNCTION_UART;
    UART_DIVIDER = BAUD_64THS / 64;
    UART_DIVIDER_64THS = BAUD_64THS % 64;
    UART_LINE = UART_8_BITS_QUEUED;
    UART_CONTROL = UART_SENDS_RECEIVES;
}

void port_init(void)
{
    for (int i = 0; i < KEYS; i++) {
        PIN_PAD(key_pins[i]) = PAD_KEY;
        PIN_FUNCTION(key_pins[i]) = FUNCTION_SOFTWARE;
    }
    start_console();
    lcd_wake();
    systick_start();
}

struct port_fb port_fb(void)
{
    lcd_turn_on();
    return (struct port_fb){
        .row = lcd_row, .width = LCD_SIDE, .height = LCD_SIDE, .format = PORT_RGB565};
}

void port_present(void)
{
    lcd_finish();
    if (port_option("pictures")) {
        port_print("picture\n");
    }
}

/* Cycles, not instructions. */
uint32_t port_instructions(uint32_t ticks)
{
    (void)ticks;
    return 0;
}

void port_putc(char c)
{
    while (UART_FLAGS & UART_FULL) {
    }
    UART_DATA = (uint8_t)c;
}

/* A held key connects its pin to ground. */
uint32_t port_input(void)
{
    uint32_t pins = PINS_IN, keys = 0;

    for (int i = 0; i < KEYS; i++) {
        keys |= (~pins >> key_pins[i] & 1) << i;
    }
    return keys;
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
    port_putc(END_OF_CONSOLE);
    port_putc((char)status);
    while (UART_FLAGS & UART_BUSY) {
    }
    for (;;) {
        __asm__ volatile("wfi");
    }
}
