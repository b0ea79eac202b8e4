/* SPDX-License-Identifier: MIT */
/* From reset to main; the symbols of memory come from linker/sections.ld. */
#include <string.h>

#include "port.h"
#include "start.h"

extern char data_load[], data_start[], data_end[], bss_start[], bss_end[];
extern char stack_bottom[], stack_top[];
int main(void);

/* What the stack holds before it is used: no address and no small number. */
#define UNUSED 0xa5

_Noreturn void start(void)
{
    /* below what this function and memset itself use */
    memset(stack_bottom, UNUSED, (size_t)((char *)__builtin_frame_address(0) - 64 - stack_bottom));
    memcpy(data_start, data_load, (size_t)(data_end - data_start));
    memset(bss_start, 0, (size_t)(bss_end - bss_start));
    port_exit(main());
}

struct port_stack port_stack(void)
{
    const char *used = stack_bottom;

    while (used < stack_top && *used == (char)UNUSED) {
        used++;
    }
    return (struct port_stack){(uint32_t)(stack_top - used), (uint32_t)(stack_top - stack_bottom)};
}

static void put_text(const char *text)
{
    while (*text) {
        port_putc(*text++);
    }
}

_Noreturn void fault(uint32_t address)
{
    put_text("\nfault at 0x");
    for (int shift = 28; shift >= 0; shift -= 4) {
        port_putc("0123456789abcdef"[(address >> shift) & 15]);
    }
    put_text("\n");
    port_exit(125);
}
