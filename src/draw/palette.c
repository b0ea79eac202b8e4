/* SPDX-License-Identifier: MIT */
#include "draw.h"

/* Entry i of a ramp between two colours, one channel at a time. */
#define MIX(from, to, i, n)    ((uint32_t)((from) + ((to) - (from)) * (i) / (n)))
#define CHANNEL(colour, shift) ((colour) >> (shift)&0xff)
#define BLEND(from, to, i, n)                                                                      \
    (MIX(CHANNEL(from, 16), CHANNEL(to, 16), i, n) << 16 |                                         \
     MIX(CHANNEL(from, 8), CHANNEL(to, 8), i, n) << 8 |                                            \
     MIX(CHANNEL(from, 0), CHANNEL(to, 0), i, n))

#define BLEND_4(from, to, i, n)                                                                    \
    BLEND(from, to, i, n), BLEND(from, to, (i) + 1, n), BLEND(from, to, (i) + 2, n),               \
        BLEND(from, to, (i) + 3, n)
#define BLEND_16(from, to, n)                                                                      \
    BLEND_4(from, to, 0, n), BLEND_4(from, to, 4, n), BLEND_4(from, to, 8, n),                     \
        BLEND_4(from, to, 12, n)

/* DRAW_SHADES entries from `low` over `middle` to `high`. */
#define RAMP(low, middle, high) BLEND_16(low, middle, 16), BLEND_16(middle, high, 15)

/* In the order of enum draw_ramp; the rest is black, and white at the end, for the program. */
const uint32_t carom_draw_palette[256] = {
    RAMP(0x0e1522, 0x22344c, 0x56708c), /* background */
    RAMP(0x08161c, 0x1f5a5c, 0xcdeeb0), /* stationary */
    RAMP(0x20121a, 0x94583c, 0xfff3dc), /* moving */
    RAMP(0x4a0030, 0xd01858, 0xff86ac), /* stationary, interfering */
    RAMP(0x5a1800, 0xf06000, 0xffe040), /* moving, interfering */
    [255] = 0xffffff,
};

/* First grey of each ramp, and what it gains up to the last. */
static const uint8_t greys[DRAW_RAMPS][2] = {{0, 1}, {2, 4}, {6, 7}, {14, 1}, {15, 0}};

static uint32_t grey(uint32_t index)
{
    const uint8_t *ramp = greys[index / DRAW_SHADES];

    return ramp[0] +
           (ramp[1] * (index % DRAW_SHADES) * 2 + DRAW_SHADES - 1) / (2 * DRAW_SHADES - 2);
}

uint32_t draw_colour(uint8_t format, uint32_t index)
{
    uint32_t rgb = carom_draw_palette[index];

    switch (format) {
    case CAROM_PALETTE8:
        return index * 0x01010101u;
    case CAROM_RGB565:
        return ((rgb >> 8 & 0xf800) | (rgb >> 5 & 0x07e0) | (rgb >> 3 & 0x001f)) * 0x00010001u;
    case CAROM_BGR555:
        return ((rgb << 7 & 0x7c00) | (rgb >> 6 & 0x03e0) | (rgb >> 19 & 0x001f)) * 0x00010001u;
    case CAROM_GREY4:
        return grey(index) * 0x11111111u;
    default:
        return rgb;
    }
}
