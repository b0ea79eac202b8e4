/* SPDX-License-Identifier: MIT */
/*
 * Raspberry Pi Zero: BCM2835, an ARM1176 with a VideoCore that has the display. Text, arguments and exit status go through
 * semihosting; on a board without an emulator they are lost, and the scene plays without end.
 *
 * Peripherals as in "BCM2835 ARM Peripherals", the mailbox as in the firmware's wiki.
 */
#include "memory.h"
#include "port.h"
#include "semihost.h"

enum { WIDTH = 512, HEIGHT = 512 };

#define REGISTER(address) (*(volatile uint32_t *)(address))
#define TIMER_LOW         REGISTER(0x20003004) /* microseconds */
#define TIMER_HIGH        REGISTER(0x20003008)
#define MAIL_READ         REGISTER(0x2000b880)
#define MAIL_STATUS       REGISTER(0x2000b898)
#define MAIL_WRITE        REGISTER(0x2000b8a0)
#define MAIL_FULL         (1u << 31)
#define MAIL_EMPTY        (1u << 30)
#define PROPERTIES        8u          /* the channel, in the lowest bits */
#define ANSWERED          0x80000000u /* all of it */
#define ARM_ADDRESS       0x3fffffffu /* the VideoCore adds two more bits */

/* A request to the VideoCore: a tag, bytes of its values, bytes that it gets, values. */
static _Alignas(16) volatile struct {
    uint32_t bytes, state;
    uint32_t size[5], virtual_size[5], depth[4], order[4];
    uint32_t framebuffer[3], address, address_bytes;
    uint32_t pitch[3], stride;
    uint32_t end;
} mail = {
    .bytes = sizeof mail,
    .size = {0x48003, 8, 8, WIDTH, HEIGHT},
    .virtual_size = {0x48004, 8, 8, WIDTH, HEIGHT},
    .depth = {0x48005, 4, 4, 32},
    .order = {0x48006, 4, 4, 0}, /* blue in the lowest byte */
    .framebuffer = {0x40001, 8, 4},
    .address = 4096, /* asks for an address that is a multiple of it */
    .pitch = {0x40008, 4, 0},
};

static struct port_fb fb;

/* The VideoCore reads and writes the mail in memory: no cache is on yet. */
static void send_mail(void)
{
    memory_barrier();
    while (MAIL_STATUS & MAIL_FULL) {
    }
    MAIL_WRITE = (uint32_t)(uintptr_t)&mail | PROPERTIES;
    do {
        while (MAIL_STATUS & MAIL_EMPTY) {
        }
    } while ((MAIL_READ & 15) != PROPERTIES);
    memory_barrier();
}

void port_init(void)
{
    send_mail();
    if (mail.state == ANSWERED && mail.address_bytes > 0) {
        fb = (struct port_fb){.pixels = (void *)(uintptr_t)(mail.address & ARM_ADDRESS),
                              .width = WIDTH,
                              .height = HEIGHT,
                              .stride = (int32_t)mail.stride,
                              .format = PORT_XRGB8888};
        memory_start(fb.pixels, mail.address_bytes);
    }
}

struct port_fb port_fb(void)
{
    return fb;
}

void port_present(void)
{
    memory_barrier();
    semihost_picture();
}

/*
 * Under QEMU's -icount shift=10 the n-th instruction is at 1024 n ns, and the timer shows whole
 * microseconds of that. No two instructions share a microsecond, so the timer yields n. A tick is
 * half an instruction, because the rate of instructions is no whole number of hertz.
 */
const uint32_t port_ticks_hz = 1953125;

uint32_t port_ticks(void)
{
    uint32_t high, low;

    do {
        high = TIMER_HIGH;
        low = TIMER_LOW;
    } while (high != TIMER_HIGH);
    return (uint32_t)((((uint64_t)high << 32 | low) * 125 + 127) / 128 * 2);
}

uint32_t port_input(void)
{
    return 0;
}
