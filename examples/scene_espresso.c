/* SPDX-License-Identifier: MIT */
/*
 * Scene espresso: figure 8 of the paper. An espresso machine falls on a field whose heights are the escape counts of the
 * Mandelbrot set. The set is the floor of a basin, so all impacts take place within the field.
 */
#include "models.h"
#include "scene_games.h"

static int fill(const struct scene *scene, struct carom_world *world)
{
    static const struct carom_body_def machine = {
        .position = POSITION(-400, 300, 3200),
        .velocity = VELOCITY(500, -200, 0),
        .spin = SPIN(-600, -600, -300),
        .restitution_q30 = CAROM_ONE_Q30 / 2,
        .friction_q16 = 1u << 15,
    };
    struct scene_parts parts = {scene, world, CAROM_OK};

    scene_part(&parts, 0, &machine);
    return parts.result;
}

/* Ramps that tools/gen_figure8 gives to faces: field, its slopes, enamel, china, steel, handles, the set. */
static const uint32_t colours[SCENE_RAMPS] = {0,        0x3858a0, 0xe0b040, 0xc83030,
                                              0xf0ece0, 0x98a0a8, 0x30343c};
static const struct carom_body_paint paints[] = {{mandelbrot512_ramps, SCENE_GREEN},
                                                 {espresso_ramps, SCENE_RED}};
static const struct carom_body_paint fine_paints[] = {{mandelbrot3200_ramps, SCENE_GREEN},
                                                      {espresso_ramps, SCENE_RED}};

#define ESPRESSO(of_faces)                                                                         \
    {                                                                                              \
        .caps = CAROM_CAPS(SCENE_CAPS),                                                            \
        .camera = {POSITION(1300, -6600, 5000), POSITION(100, -300, 800), 1 << 16}, .fill = fill,  \
        .paints = of_faces, .paint_count = 2, .rgb = colours,                                      \
    }
const struct scene_game scene_espresso = ESPRESSO(paints);
const struct scene_game scene_espresso_fine = ESPRESSO(fine_paints);
