/* SPDX-License-Identifier: MIT */
/* A clock of an Arm Cortex-M: SysTick, extended from 24 to 32 bits. */
#include "arm/systick.h"

#include "port.h"

/* The timer counts down and has 24 bits. */
struct systick {
    uint32_t control, reload, value;
};
#define SYSTICK         ((volatile struct systick *)0xe000e010)
#define SYSTICK_ENABLE  1u
#define SYSTICK_CLOCK   (1u << 2) /* the processor's */
#define SYSTICK_HIGHEST 0xffffffu

const uint32_t port_ticks_hz = PORT_CLOCK_MHZ * UINT32_C(1000000);

void systick_start(void)
{
    SYSTICK->control = SYSTICK_CLOCK;
    SYSTICK->reload = SYSTICK_HIGHEST;
    SYSTICK->value = 0;
    SYSTICK->control = SYSTICK_ENABLE | SYSTICK_CLOCK;
}

/*
 * Add the ticks since the last call, modulo 2^24: right if fewer than 2^24 ticks pass between two
 * calls. Every stage of a step calls this function.
 */
uint32_t port_ticks(void)
{
    static uint32_t ticks;

    ticks += (~SYSTICK->value - ticks) & SYSTICK_HIGHEST;
    return ticks;
}
