/* SPDX-License-Identifier: MIT */
/* The look of scenes: a light sky, calm ground, bodies in warm colours that alternate. */
#include <string.h>

#include "scene_games.h"

/* Smooth shades and shadows double the cost of a picture. A board names the scenes for which it has the time. */
#if defined BOARD_SHADOWS
#define SHADOWS &carom_shadows
#else
#define SHADOWS NULL
#endif
#if defined BOARD_SMOOTH
#define SMOOTH &carom_smooth
#else
#define SMOOTH NULL
#endif

/* Light from the left and in front, not high, so that shadows lie beside the bodies. */
#define LIGHT                                                                                      \
    {                                                                                              \
        {                                                                                          \
            -7, -4, 6                                                                              \
        }                                                                                          \
    }

/* Colours of scenes without paints of their own: the ground, four colours for moving bodies, interfering faces. */
enum { GROUND = CAROM_RAMP_STATIONARY, HOT = CAROM_RAMP_STATIONARY_HOT };
static const uint32_t plain_rgb[] = {[GROUND] = 0x44803c,
                                     [CAROM_RAMP_MOVING] = 0xb8683f,
                                     [HOT] = 0xff0070,
                                     [CAROM_RAMP_MOVING_HOT] = 0xd49a22,
                                     [CAROM_RAMP_BLUE] = 0x3f74ac,
                                     [CAROM_RAMP_VIOLET] = 0xe8dcc0};
static const uint32_t game_rgb[] = {
    [SCENE_GREEN] = 0x6f9f50,  [SCENE_WOOD] = 0xa87848,   [SCENE_RED] = 0xc82828,
    [SCENE_YELLOW] = 0xf0c020, [SCENE_MEADOW] = 0x548448, [SCENE_DARK] = 0x30343c};

#define FOUR                                                                                       \
    {NULL, CAROM_RAMP_MOVING}, {NULL, CAROM_RAMP_MOVING_HOT}, {NULL, CAROM_RAMP_BLUE},             \
    {                                                                                              \
        NULL, CAROM_RAMP_VIOLET                                                                    \
    }
static const struct carom_body_paint plain_paints[] = {{NULL, GROUND}, FOUR, FOUR, FOUR, FOUR,
                                                       FOUR,           FOUR, FOUR, FOUR};

/*
 * The sky pales towards the horizon, and so does the far ground. Steps are by 4 and 8, so that a display of 5 bits a colour
 * shows no stripes of other hues.
 */
static void fill_palette(uint32_t palette[256], const uint32_t rgb[])
{
    memcpy(palette, carom_draw_palette, 256 * sizeof palette[0]);
    for (uint32_t i = 1; i < sizeof plain_rgb / sizeof plain_rgb[0]; i++) {
        carom_draw_ramp(&palette[i * CAROM_RAMP_SHADES], rgb[i]);
    }
    for (uint32_t i = 0; i < CAROM_RAMP_SHADES / 2; i++) {
        palette[i] = 0x58a4e0 + i * 0x080400;
        palette[CAROM_RAMP_SHADES / 2 + i] = 0xd0e0d8 - i * 0x040404;
    }
}

const struct carom_paint *scene_paint(const struct scene_game *game)
{
    static uint32_t palette[256];
    static struct carom_paint paint = {.palette = palette,
                                       .ramps = 8,
                                       .light = LIGHT,
                                       .horizon = true,
                                       .shadows = SHADOWS,
                                       .smooth = SMOOTH,
                                       .ambient_q30 = CAROM_ONE_Q30 / 8};
    static const uint32_t *filled;
    bool own = game && game->paints;
    const uint32_t *rgb = !own ? plain_rgb : game->rgb ? game->rgb : game_rgb;

    if (filled != rgb) {
        fill_palette(palette, rgb);
        filled = rgb;
    }
    paint.hide_interfering = own;
    paint.interfering_ramp = HOT;
    paint.bodies = own ? game->paints : plain_paints;
    paint.body_count =
        own ? game->paint_count : (uint32_t)(sizeof plain_paints / sizeof plain_paints[0]);
    return &paint;
}
