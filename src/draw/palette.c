/* SPDX-License-Identifier: MIT */
/* The palette, and palette entries as pixels of each format. */
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

/* DRAW_SHADES entries from `low` through `middle` to `high`. */
#define RAMP(low, middle, high) BLEND_16(low, middle, 16), BLEND_16(middle, high, 15)

/* In the order of enum carom_colour. */
#define COLOURS 0x000000, 0xff3030, 0x30e030, 0x4080ff, 0xffe030, 0xff40ff, 0x30e8e8, 0xffffff

#define BLACK_8 0, 0, 0, 0, 0, 0, 0, 0

/* In the order of enum carom_ramp; then black, for the program to set, up to the named colours. */
_Static_assert(7 * DRAW_SHADES + 24 == CAROM_COLOUR_BLACK, "colours are where they are named");
const uint32_t carom_draw_palette[256] = {
    RAMP(0x0e1522, 0x22344c, 0x56708c), /* background */
    RAMP(0x08161c, 0x1f5a5c, 0xcdeeb0), /* stationary */
    RAMP(0x20121a, 0x94583c, 0xfff3dc), /* moving */
    RAMP(0x4a0030, 0xd01858, 0xff86ac), /* stationary, interfering */
    RAMP(0x5a1800, 0xf06000, 0xffe040), /* moving, interfering */
    RAMP(0x0a1030, 0x2a5cb0, 0xcfe6ff), /* blue */
    RAMP(0x1a0a30, 0x6c3aa8, 0xe8d0ff), /* violet */
    BLACK_8,
    BLACK_8,
    BLACK_8,
    COLOURS,
};

int carom_draw_ramp(uint32_t ramp[CAROM_RAMP_SHADES], uint32_t rgb)
{
    if (ramp == NULL) {
        return CAROM_ERR_NULL;
    }
    for (uint32_t i = 0; i < DRAW_SHADES; i++) {
        uint32_t shade = 0;

        for (int shift = 0; shift < 24; shift += 8) {
            uint32_t full = rgb >> shift & 0xff, half = DRAW_SHADES / 2;
            uint32_t low = full / 4, high = full + (255 - full) / 2;
            uint32_t value = i < half ? low + (full - low) * i / half
                                      : full + (high - full) * (i - half) / (half - 1);

            shade |= value << shift;
        }
        ramp[i] = shade;
    }
    return CAROM_OK;
}

/* First grey of each usual ramp, and the growth to its last. */
static const uint8_t greys[][2] = {{0, 1}, {2, 6}, {7, 6}, {14, 1}, {15, 0}};
#define GREY_RAMPS (sizeof greys / sizeof greys[0])

/* The luminance of a colour, to the nearest of 16. */
static uint32_t grey_of(uint32_t rgb)
{
    uint32_t light = (rgb >> 16 & 0xff) * 77 + (rgb >> 8 & 0xff) * 150 + (rgb & 0xff) * 29;

    return (light * 15 + 128 * 255) / (256 * 255);
}

static uint32_t grey(const uint32_t *palette, uint32_t index)
{
    const uint8_t *ramp;

    if (palette != carom_draw_palette || index >= GREY_RAMPS * DRAW_SHADES) {
        return grey_of(palette[index]);
    }
    ramp = greys[index / DRAW_SHADES];
    return ramp[0] +
           (ramp[1] * (index % DRAW_SHADES) * 2 + DRAW_SHADES - 1) / (2 * DRAW_SHADES - 2);
}

uint32_t draw_entry(uint8_t format, const uint32_t *palette, uint32_t index)
{
    uint32_t rgb = palette[index];

    switch (format) {
    case CAROM_PALETTE8:
        return index * 0x01010101u;
    case CAROM_RGB565:
        return ((rgb >> 8 & 0xf800) | (rgb >> 5 & 0x07e0) | (rgb >> 3 & 0x001f)) * 0x00010001u;
    case CAROM_BGR555:
        return ((rgb << 7 & 0x7c00) | (rgb >> 6 & 0x03e0) | (rgb >> 19 & 0x001f)) * 0x00010001u;
    case CAROM_GREY4:
        return grey(palette, index) * 0x11111111u;
    default:
        return rgb;
    }
}

uint32_t draw_colour(const struct carom_picture *picture, uint32_t index)
{
    return draw_entry(picture->format, draw_palette(picture), index);
}
