/* SPDX-License-Identifier: MIT */
/* QEMU's virt board with an RV32IM processor, and its bochs-display, a framebuffer on the PCI bus. */
#include "port.h"
#include "semihost.h"

enum { WIDTH = 320, HEIGHT = 240 };

/* PCI: the configuration of a device of bus 0, and a window for its memory. */
#define PCI_CONFIG(device) ((volatile uint32_t *)(0x30000000 + ((uintptr_t)(device) << 15)))
#define PCI_DEVICES        32
#define PCI_WINDOW         0x40000000u
#define PCI_MEMORY_ENABLE  2u
enum { PCI_ID, PCI_COMMAND, PCI_BAR0 = 4, PCI_BAR2 = 6 };

#define BOCHS_DISPLAY 0x11111234u
#define PIXELS        PCI_WINDOW                 /* 16 MB */
#define REGISTERS     (PCI_WINDOW + 0x01000000u) /* 4 KB */
#define DISPI         ((volatile uint16_t *)(REGISTERS + 0x500u))
enum { DISPI_WIDTH = 1, DISPI_HEIGHT, DISPI_BITS, DISPI_ENABLE };
#define DISPI_ENABLED 0x41u /* with a linear framebuffer */

static void start_display(volatile uint32_t *config)
{
    config[PCI_BAR0] = PIXELS;
    config[PCI_BAR2] = REGISTERS;
    config[PCI_COMMAND] = PCI_MEMORY_ENABLE;
    DISPI[DISPI_WIDTH] = WIDTH;
    DISPI[DISPI_HEIGHT] = HEIGHT;
    DISPI[DISPI_BITS] = 16;
    DISPI[DISPI_ENABLE] = DISPI_ENABLED;
}

void port_init(void)
{
    for (int device = 0; device < PCI_DEVICES; device++) {
        if (PCI_CONFIG(device)[PCI_ID] == BOCHS_DISPLAY) {
            start_display(PCI_CONFIG(device));
        }
    }
}

struct port_fb port_fb(void)
{
    struct port_fb fb = {.pixels = (void *)PIXELS,
                         .width = WIDTH,
                         .height = HEIGHT,
                         .stride = 2 * WIDTH,
                         .format = PORT_RGB565};

    return fb;
}

void port_present(void)
{
    semihost_picture();
}

uint32_t port_input(void)
{
    return 0;
}
