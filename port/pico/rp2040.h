/* SPDX-License-Identifier: MIT */
/* rp2040.h - the registers of Raspberry Pi's RP2040 that this board uses, as its datasheet names them. */
#ifndef CAROM_PORT_PICO_RP2040_H
#define CAROM_PORT_PICO_RP2040_H

#include <stdint.h>

#define REGISTER(address) (*(volatile uint32_t *)(address))
/* Aliases of a peripheral's registers, where a write sets or clears bits. */
#define SET(address)   REGISTER((address) + 0x2000u)
#define CLEAR(address) REGISTER((address) + 0x3000u)

/* Section 2.14: a set bit holds a peripheral in reset. */
#define RESETS           0x4000c000u
#define RESETS_DONE      REGISTER(0x4000c008)
#define RESET_DMA        (1u << 2)
#define RESET_IO_BANK0   (1u << 5)
#define RESET_PADS_BANK0 (1u << 8)
#define RESET_PLL_SYS    (1u << 12)
#define RESET_SPI1       (1u << 17)
#define RESET_TIMER      (1u << 21)
#define RESET_UART0      (1u << 22)

/* Section 2.15, clocks. SELECTED has a bit for the choice of a glitchless multiplexer. */
#define CLK_REF_CTRL     0x40008030u
#define CLK_REF_SELECTED REGISTER(0x40008038)
#define CLK_REF_XOSC     2u
#define CLK_SYS_CTRL     0x4000803cu
#define CLK_SYS_SELECTED REGISTER(0x40008044)
#define CLK_SYS_AUX      1u /* PLL_SYS */
#define CLK_PERI_CTRL    REGISTER(0x40008048)
#define CLK_PERI_ENABLE  (1u << 11) /* from the system's clock */

/* Section 2.16, the crystal's oscillator. */
#define XOSC_CTRL        0x40024000u
#define XOSC_1_TO_15_MHZ 0xaa0u
#define XOSC_ENABLE      (0xfabu << 12)
#define XOSC_STATUS      REGISTER(0x40024004)
#define XOSC_STABLE      (1u << 31)
#define XOSC_STARTUP     REGISTER(0x4002400c)
#define XOSC_WAIT        282u /* times 256 periods of 12 MHz: 6 ms */

/* Section 2.18, the system's phase-locked loop. */
#define PLL_CS           REGISTER(0x40028000)
#define PLL_LOCKED       (1u << 31)
#define PLL_PWR          0x40028004u
#define PLL_OFF          (1u << 0 | 1u << 5) /* the loop and its oscillator */
#define PLL_DIVIDERS_OFF (1u << 3)
#define PLL_FEEDBACK     REGISTER(0x40028008)
#define PLL_DIVIDERS     REGISTER(0x4002800c)

/* Sections 4.6 and 4.7: microseconds, which the watchdog divides from the reference clock. */
#define WATCHDOG_TICK        REGISTER(0x4005802c)
#define WATCHDOG_TICK_ENABLE (1u << 9)
#define TIMER_MICROSECONDS   REGISTER(0x40054028)

/* Section 2.19: the function of a pin, and its pad; section 2.3.1: pins by software. */
#define PIN_FUNCTION(pin) REGISTER(0x40014004u + 8u * (pin))
#define PIN_PAD(pin)      REGISTER(0x4001c004u + 4u * (pin))
#define PAD_KEY           0x4au /* input, pulled up, with a Schmitt trigger */
#define PINS_IN           REGISTER(0xd0000004)
#define PINS_HIGH         REGISTER(0xd0000014)
#define PINS_LOW          REGISTER(0xd0000018)
#define PINS_OUTPUT       REGISTER(0xd0000024)
enum { FUNCTION_SPI = 1, FUNCTION_UART = 2, FUNCTION_SOFTWARE = 5 };

/* Section 4.2, an ARM PL011. */
#define UART_DATA           REGISTER(0x40034000)
#define UART_FLAGS          REGISTER(0x40034018)
#define UART_BUSY           (1u << 3)
#define UART_FULL           (1u << 5)
#define UART_DIVIDER        REGISTER(0x40034024)
#define UART_DIVIDER_64THS  REGISTER(0x40034028)
#define UART_LINE           REGISTER(0x4003402c)
#define UART_8_BITS_QUEUED  0x70u
#define UART_CONTROL        REGISTER(0x40034030)
#define UART_SENDS_RECEIVES 0x301u

/* Section 4.4, an ARM PL022. */
#define SPI_FRAME        REGISTER(0x40040000)
#define SPI_BITS(n)      ((n)-1u)
#define SPI_MODE_3       (3u << 6)
#define SPI_CONTROL      REGISTER(0x40040004)
#define SPI_ENABLE       (1u << 1)
#define SPI_DATA_ADDRESS 0x40040008u
#define SPI_STATUS       REGISTER(0x4004000c)
#define SPI_ROOM         (1u << 1)
#define SPI_BUSY         (1u << 4)
#define SPI_PRESCALE     REGISTER(0x40040010)
#define SPI_DMA          REGISTER(0x40040024)
#define SPI_DMA_SENDS    (1u << 1)

/* Section 2.5: channel 0 of direct memory access. */
#define DMA_SOURCE        REGISTER(0x50000000)
#define DMA_TARGET        REGISTER(0x50000004)
#define DMA_COUNT         REGISTER(0x50000008)
#define DMA_START         REGISTER(0x5000000c)
#define DMA_ENABLE        (1u << 0)
#define DMA_HALF_WORDS    (1u << 2)
#define DMA_SOURCE_MOVES  (1u << 4)
#define DMA_PACED_BY_SPI1 (18u << 15)
#define DMA_BUSY          (1u << 24)

#endif
