/* SPDX-License-Identifier: MIT */
/* A Cortex-M board without a display: SysTick counts, and semihosting does the rest. */
#include "port.h"
#include "arm/systick.h"

void port_init(void)
{
    systick_start();
}

struct port_fb port_fb(void)
{
    return (struct port_fb){.pixels = NULL};
}

void port_present(void)
{
}

uint32_t port_input(void)
{
    return 0;
}
