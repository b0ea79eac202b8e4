/* SPDX-License-Identifier: MIT */
/* lcd.h - a display of 240 x 240 pixels that is sent rows and keeps them. */
#ifndef CAROM_PORT_PICO_LCD_H
#define CAROM_PORT_PICO_LCD_H

#include <stdint.h>

#define LCD_SIDE 240

/* Begin to wake the display, which takes 120 ms. */
void lcd_wake(void);

/* Wait until it is awake and turn the display on, unless it is on. */
void lcd_turn_on(void);

/* The row function of port_fb: sends the previous row while this one is drawn. */
void *lcd_row(void *context, int32_t x0, int32_t x1, int32_t y);

/* Send the last row and return when the display has it. */
void lcd_finish(void);

#endif
