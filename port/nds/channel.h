/* SPDX-License-Identifier: MIT */
/*
 * channel.h - the console of a Nintendo DS under tools/retro_nds.c, in the pixels of its lower
 * screen.
 *
 * A pixel holds 15 bits, red in the lowest. The rows from 1 on are a ring of characters, one a
 * pixel. The screen shows row 0 first. Row 0 holds a mark, the count of characters written, and at
 * last the exit status; the counted characters are below it in the same frame.
 */
#ifndef CAROM_PORT_NDS_CHANNEL_H
#define CAROM_PORT_NDS_CHANNEL_H

enum {
    CHANNEL_WIDTH = 256,
    CHANNEL_ROOM = 128 * CHANNEL_WIDTH, /* characters; the count is modulo this, and fits a pixel */
    CHANNEL_MARK_AT = 0,
    CHANNEL_COUNT_AT = 1,
    CHANNEL_STATUS_AT = 2,
    CHANNEL_MARK = 0x2ca5,
    CHANNEL_ENDED = 0x4000 /* added to the status */
};

#endif
