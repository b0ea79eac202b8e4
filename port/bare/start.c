/* SPDX-License-Identifier: MIT */
/* From reset to main; the symbols of memory come from linker/sections.ld. */
#include <string.h>

#include "port.h"
#include "start.h"

extern char data_load[], data_start[], data_end[], bss_start[], bss_end[];
int main(void);

_Noreturn void start(void)
{
    memcpy(data_start, data_load, (size_t)(data_end - data_start));
    memset(bss_start, 0, (size_t)(bss_end - bss_start));
    port_exit(main());
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
