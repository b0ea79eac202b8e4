/* SPDX-License-Identifier: MIT */
/* carom_draw_line: a line over a finished picture. */
#include "draw.h"

int carom_draw_line(const struct carom_camera *camera, const struct carom_picture *picture,
                    const carom_v3_q32 *from, const carom_v3_q32 *to, uint32_t colour,
                    struct carom_rect *touched)
{
    int result = camera == NULL || from == NULL || to == NULL
                     ? CAROM_ERR_NULL
                     : draw_check_picture(picture, CAROM_DRAW_WIRE);
    struct draw_vertex ends[2];
    struct draw_view view;

    if (result != CAROM_OK) {
        return result;
    }
    if (colour >= draw_ramps(picture->paint) * DRAW_SHADES) {
        return CAROM_ERR_ARGUMENT;
    }
    if (!draw_point_in_range(from) || !draw_point_in_range(to)) {
        return CAROM_ERR_RANGE;
    }
    result = draw_view_init(&view, camera, picture->width, picture->height);
    if (result != CAROM_OK) {
        return result;
    }
    view.rect = draw_whole(&view, picture);
    if (draw_segment(&view, from, to, ends)) {
        draw_line(&view, picture, &ends[0], &ends[1], draw_colour(picture, colour));
        draw_touch(touched, draw_on_picture(&view, draw_segment_rect(&view, ends)));
    }
    return CAROM_OK;
}
