/* SPDX-License-Identifier: MIT */
/*
 * Code in the 32 KB of the processor's RAM runs five times as fast as in the cartridge. Stepping a
 * world and drawing it take turns there (port/gba/fast.ld). The linker (--wrap) calls the functions
 * __wrap_... below in place of the drawing functions, and these exchange the two sets of code.
 */
#include "memory.h"

#include <stddef.h>
#include <stdint.h>

#include "carom_draw.h"

/* Direct memory access: copies words at once, the processor waits. */
#define DMA3_SOURCE  (*(volatile uint32_t *)0x040000d4)
#define DMA3_TARGET  (*(volatile uint32_t *)0x040000d8)
#define DMA3_CONTROL (*(volatile uint32_t *)0x040000dc)
#define DMA_COPY     0x84000000
#define DMA_FILL     0x85000000 /* the source stays */

extern char fast_load[], fast_start[], fast_end[], wide_start[], wide_end[];
extern char step_load[], step_start[], step_end[], draw_load[], draw_start[], draw_end[];

int __real_carom_draw_changes(const struct carom_world *world, const struct carom_camera *camera,
                              const struct carom_picture *picture, enum carom_draw_style style,
                              struct carom_drawn *drawn);
int __wrap_carom_draw_changes(const struct carom_world *world, const struct carom_camera *camera,
                              const struct carom_picture *picture, enum carom_draw_style style,
                              struct carom_drawn *drawn);

/* Whole words; a count of 0 would mean 65536. */
static void transfer(const volatile void *from, void *to, size_t bytes, uint32_t how)
{
    if (bytes > 0) {
        DMA3_SOURCE = (uint32_t)(uintptr_t)from;
        DMA3_TARGET = (uint32_t)(uintptr_t)to;
        DMA3_CONTROL = how | (uint32_t)(bytes / 4);
    }
}

static void load_step(void)
{
    transfer(step_load, step_start, (size_t)(step_end - step_start), DMA_COPY);
}

static void load_draw(void)
{
    transfer(draw_load, draw_start, (size_t)(draw_end - draw_start), DMA_COPY);
}

void memory_start(void)
{
    volatile uint32_t zero = 0; /* on the stack, because a source in the cartridge would not stay
                                 * fixed */

    transfer(fast_load, fast_start, (size_t)(fast_end - fast_start), DMA_COPY);
    transfer(&zero, wide_start, (size_t)(wide_end - wide_start), DMA_FILL);
    load_step();
}

int __wrap_carom_draw_changes(const struct carom_world *world, const struct carom_camera *camera,
                              const struct carom_picture *picture, enum carom_draw_style style,
                              struct carom_drawn *drawn)
{
    int result;

    load_draw();
    result = __real_carom_draw_changes(world, camera, picture, style, drawn);
    load_step();
    return result;
}
