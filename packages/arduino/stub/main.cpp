/* SPDX-License-Identifier: MIT */
/*
 * Runs a sketch for some frames, where a core would run it for ever. Prints the bytes sent to a
 * display as a PBM picture.
 */
#include "Arduino.h"
#include "Wire.h"

extern "C" void _start();
/* The vectors of a Cortex-M3: the stack and the entry point; the linker sets its bit 0. */
extern void *const vectors[];
__attribute__((section(".vectors"), used)) void *const vectors[] = {(void *)0x20400000,
                                                                    (void *)_start};

uint8_t stub_display[1024];
size_t stub_sent;

int main()
{
    setup();
    for (int i = 0; i < FRAMES; i++) {
        loop();
    }
    if (stub_sent > 0) {
        puts("P1 128 64");
        for (int y = 0; y < 64; y++) {
            for (int x = 0; x < 128; x++) {
                putchar(stub_display[y / 8 * 128 + x] >> y % 8 & 1 ? '0' : '1');
            }
            putchar('\n');
        }
    }
    return 0;
}
