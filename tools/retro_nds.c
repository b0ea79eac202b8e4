/* SPDX-License-Identifier: MIT */
/*
 * Nintendo DS in DeSmuME, which logs no output of a program and exposes no memory. The console is
 * in the pixels of the lower screen; port/nds/channel.h has its format. The screen showed its first
 * row before the others, so all characters that the row counts are there.
 */
#include "../port/nds/channel.h"
#include "retro_run.h"

enum { UPPER_ROWS = 192 };

/* The 15 bits of a pixel of the lower screen, red in the lowest, from RGB565. */
static unsigned shown(const struct frame *frame, unsigned x, unsigned y)
{
    unsigned pixel = retro_pixel(frame, x, UPPER_ROWS + y);

    return pixel >> 11 | (pixel >> 6 & 0x1f) << 5 | (pixel & 0x1f) << 10;
}

static void look(const struct frame *frame)
{
    static unsigned taken;
    unsigned status;

    if (frame->height != 2 * UPPER_ROWS || shown(frame, CHANNEL_MARK_AT, 0) != CHANNEL_MARK) {
        return;
    }
    for (unsigned count = shown(frame, CHANNEL_COUNT_AT, 0); taken != count;
         taken = (taken + 1) % CHANNEL_ROOM) {
        retro_putc((char)shown(frame, taken % CHANNEL_WIDTH, 1 + taken / CHANNEL_WIDTH));
    }
    status = shown(frame, CHANNEL_STATUS_AT, 0);
    if (status & CHANNEL_ENDED) {
        retro_end((int)(status & 0xff));
    }
}

/* Options that differ from the defaults. */
static const struct option options[] = {
    {"desmume_cpu_mode", "interpreter"}, {"desmume_load_to_memory", "enable"}, {0}};

const struct machine retro_nds = {.suffix = ".nds",
                                  .core = "desmume_libretro.so",
                                  .arguments_at = 0x240,
                                  .width = 256,
                                  .height = 192,
                                  .options = options,
                                  .look = look};
