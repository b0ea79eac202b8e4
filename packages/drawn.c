/* SPDX-License-Identifier: MIT */
/* A program that links the renderer, and the engine through it. It draws a world without bodies: only sky. */
#include <stdio.h>
#include "carom_draw.h"

#define CAPS 1, 1, 1, 1, 0, 1
static _Alignas(8) uint8_t block[CAROM_WORLD_BYTES(CAPS)], room[CAROM_DRAW_BYTES(4, 4)];

int main(void)
{
    static uint8_t pixels[64 * 64];
    const struct carom_config config = {.caps = CAROM_CAPS(CAPS)};
    const struct carom_camera camera = {{{0, 0, 0}}, {{0, CAROM_POSITION_M(1), 0}}, 1 << 16};
    struct carom_picture picture = {.pixels = pixels,
                                    .width = 64,
                                    .height = 64,
                                    .stride = 64,
                                    .format = CAROM_PALETTE8,
                                    .workspace = room,
                                    .workspace_bytes = sizeof room};
    struct carom_world *world;

    if (carom_version() != CAROM_VERSION ||
        carom_world_init(block, sizeof block, &config, &world) < 0 ||
        carom_draw(world, &camera, &picture, CAROM_DRAW_FLAT) < 0) {
        return 1;
    }
    /* from the top of the picture to the bottom, the background has all of its 32 shades */
    return pixels[0] == pixels[63 * 64] || pixels[0] != pixels[63];
}
