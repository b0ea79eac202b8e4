/* SPDX-License-Identifier: MIT */
/* Paint: light, ramps and lines that a program chooses; checks of them. */
#include "draw.h"

#define RAMPS_MAX 256
#define LINES_MAX 4096

#define USUAL_CREASE_Q30 690190709 /* cosine of 50 degrees */

/* The range of shades is this much less than DRAW_SHADES shades, 2^24 each. */
#define SLACK_Q24 512

static int check_lines(const struct carom_paint *paint)
{
    if (paint->line_count > LINES_MAX) {
        return CAROM_ERR_ARGUMENT;
    }
    if (paint->line_count > 0 && paint->lines == NULL) {
        return CAROM_ERR_NULL;
    }
    for (uint32_t i = 0; i < paint->line_count; i++) {
        const struct carom_paint_line *line = &paint->lines[i];

        if (line->colour >= draw_ramps(paint) * DRAW_SHADES) {
            return CAROM_ERR_ARGUMENT;
        }
        if (!draw_point_in_range(&line->from) || !draw_point_in_range(&line->to)) {
            return CAROM_ERR_RANGE;
        }
    }
    return CAROM_OK;
}

int draw_check_paint(const struct carom_picture *picture)
{
    const struct carom_paint *paint = picture->paint;
    uint32_t ramps = draw_ramps(paint);

    if (paint == NULL) {
        return CAROM_OK;
    }
    if (paint->body_count > 0 && paint->bodies == NULL) {
        return CAROM_ERR_NULL;
    }
    if (ramps < DRAW_RAMPS || ramps > RAMPS_MAX ||
        (picture->format == CAROM_PALETTE8 && ramps > DRAW_RAMPS) || paint->ambient_q30 < 0 ||
        paint->ambient_q30 > CAROM_ONE_Q30 || paint->crease_q30 < -CAROM_ONE_Q30 ||
        paint->crease_q30 > CAROM_ONE_Q30) {
        return CAROM_ERR_ARGUMENT;
    }
    return check_lines(paint);
}

/*
 * Shades go from `low`, away from the light, to 32, towards it, less the slack: one part in 2^20,
 * as for the usual light, for the rounding of unit vectors. All numbers stay below 2^29.
 */
void draw_paint_light(struct draw_view *view, const struct carom_paint *paint)
{
    const int64_t most = ((int64_t)DRAW_SHADES << 24) - SLACK_Q24;
    int64_t low, half, direction[3];
    carom_v3_q30 light;

    if (paint == NULL) {
        return;
    }
    for (int k = 0; k < 3; k++) {
        direction[k] = paint->light.c[k];
    }
    if (!fix_normalise(&light, direction)) {
        if (paint->ambient_q30 == 0) {
            return;
        }
        for (int k = 0; k < 3; k++) {
            direction[k] = view->light.c[k];
        }
        fix_normalise(&light, direction);
    }
    view->sun = light;
    low = carom_round(most * paint->ambient_q30, 30);
    half = (most - low) / 2;
    view->shade_q24 = (uint32_t)(low + half + SLACK_Q24 / 2);
    for (int k = 0; k < 3; k++) {
        view->light.c[k] = (int32_t)(light.c[k] * half >> 28);
    }
}

/* A ramp if the palette has it, else 0. */
static uint8_t known(const struct carom_paint *paint, uint8_t ramp)
{
    return ramp < draw_ramps(paint) ? ramp : 0;
}

uint8_t draw_paint_ramp(const struct carom_paint *paint, uint32_t number)
{
    return paint && number < paint->body_count ? known(paint, paint->bodies[number].ramp) : 0;
}

int32_t draw_crease(const struct carom_paint *paint)
{
    return paint->crease_q30 != 0 ? paint->crease_q30 : USUAL_CREASE_Q30;
}

void draw_paint_body(struct draw_coat *coat, const struct carom_paint *paint, uint32_t number)
{
    uint8_t ramp = draw_paint_ramp(paint, number);

    if (paint == NULL) {
        return;
    }
    if (ramp != 0) {
        coat->own = ramp;
    }
    if (number < paint->body_count) {
        coat->faces = paint->bodies[number].faces;
    }
    if (known(paint, paint->interfering_ramp) != 0) {
        coat->hot = paint->interfering_ramp;
    }
}

uint32_t draw_face_ramp(const struct draw_coat *coat, const struct carom_paint *paint,
                        uint32_t face)
{
    uint8_t ramp = coat->faces ? known(paint, coat->faces[face]) : 0;

    return ramp != 0 ? ramp : coat->own;
}
