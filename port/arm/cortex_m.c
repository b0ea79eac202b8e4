/* SPDX-License-Identifier: MIT */
/*
 * The vector table of a Cortex-M: every exception is a fault, because no program here uses
 * interrupts.
 */
#include "start.h"

/* The first vector is the stack. It is declared as a function, so that the table has one type. */
extern void stack_top(void);

/* The processor has pushed eight words; the seventh is the address at which it stopped. */
__attribute__((naked)) static void exception(void)
{
    __asm__("mrs r0, msp\n"
            "ldr r0, [r0, #24]\n"
            "b fault\n");
}

__attribute__((section(".vectors"), used)) static void (*const vectors[16])(void) = {
    stack_top, reset,     exception, exception, exception, exception, exception, exception,
    exception, exception, exception, exception, exception, exception, exception, exception};
