/* SPDX-License-Identifier: MIT */
/*
 * From the loader to start(): the clocks, then the code that runs from RAM. The loader leaves the processor on its ring oscillator,
 * at about 6 MHz.
 */
#include "start.h"

#include "rp2040.h"

#define USED                                                                                       \
    (RESET_DMA | RESET_IO_BANK0 | RESET_PADS_BANK0 | RESET_SPI1 | RESET_TIMER | RESET_UART0)

extern uint32_t fast_load[], fast_start[], fast_end[];

static void release(uint32_t peripherals)
{
    CLEAR(RESETS) = peripherals;
    while (~RESETS_DONE & peripherals) {
    }
}

/*
 * The crystal's 12 MHz are the reference. The loop multiplies them to 1500 MHz, which are divided
 * to 125 MHz.
 */
static void start_clocks(void)
{
    /* after a reset of the processor alone the clocks may run from the loop */
    CLEAR(CLK_SYS_CTRL) = CLK_SYS_AUX;
    while (CLK_SYS_SELECTED != 1) {
    }
    XOSC_STARTUP = XOSC_WAIT;
    REGISTER(XOSC_CTRL) = XOSC_ENABLE | XOSC_1_TO_15_MHZ;
    while (!(XOSC_STATUS & XOSC_STABLE)) {
    }
    REGISTER(CLK_REF_CTRL) = CLK_REF_XOSC;
    while (CLK_REF_SELECTED != 1u << CLK_REF_XOSC) {
    }
    SET(RESETS) = RESET_PLL_SYS;
    release(RESET_PLL_SYS);
    PLL_CS = 1;
    PLL_FEEDBACK = 125;
    CLEAR(PLL_PWR) = PLL_OFF;
    while (!(PLL_CS & PLL_LOCKED)) {
    }
    PLL_DIVIDERS = 6u << 16 | 2u << 12;
    CLEAR(PLL_PWR) = PLL_DIVIDERS_OFF;
    REGISTER(CLK_SYS_CTRL) = 0; /* select the loop while this source is not in use */
    REGISTER(CLK_SYS_CTRL) = CLK_SYS_AUX;
    while (CLK_SYS_SELECTED != 1u << CLK_SYS_AUX) {
    }
    CLK_PERI_CTRL = CLK_PERI_ENABLE;
    WATCHDOG_TICK = WATCHDOG_TICK_ENABLE | 12;
}

/* Takes the place of start() in the vectors. It copies memcpy to RAM, among other functions. */
_Noreturn void reset(void)
{
    volatile uint32_t *to = fast_start;

    start_clocks();
    release(USED);
    for (const uint32_t *from = fast_load; to < fast_end;) {
        *to++ = *from++;
    }
    start();
}
