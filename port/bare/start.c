/* SPDX-License-Identifier: MIT */
/* From reset to main; the symbols of memory come from linker/sections.ld. */
#include <string.h>

#include "port.h"
#include "start.h"

#define PAINT       0xa5
#define PAINT_CLEAR 64 /* bytes below start() that memset itself may use */

extern char data_load[], data_start[], data_end[], bss_start[], bss_end[];
extern char stack_bottom[], stack_top[];
int main(void);

/* Paint the stack: bytes that keep the paint were never in use. */
uint32_t port_stack(void)
{
    const volatile char *low = stack_bottom;

    while (low < stack_top && *low == (char)PAINT) {
        low++;
    }
    return (uint32_t)(stack_top - low);
}

_Noreturn void start(void)
{
    const char *here = __builtin_frame_address(0);

    memset(stack_bottom, PAINT, (size_t)(here - PAINT_CLEAR - stack_bottom));
    memcpy(data_start, data_load, (size_t)(data_end - data_start));
    memset(bss_start, 0, (size_t)(bss_end - bss_start));
    port_exit(main());
}

_Noreturn void fault(uint32_t address)
{
    port_print("\nfault at 0x%08lx\n", (unsigned long)address);
    port_exit(125);
}
