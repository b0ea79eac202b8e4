/* SPDX-License-Identifier: MIT */
/* carom_draw: check the arguments, set up the view, draw by style. */
#include "draw.h"

/* Check that a picture's pixels can be written where it says. */
static int check_pixels(const struct carom_picture *picture, enum carom_draw_style style)
{
    int shift = draw_pixel_shift(picture->format);
    int32_t each = shift < 0 ? 1 : 1 << shift; /* bytes of a pixel */
    int32_t row = shift < 0 ? (picture->width + 1) / 2 : picture->width * each;

    if (picture->row) {
        return style == CAROM_DRAW_FLAT && shift >= 0 ? CAROM_OK : (int)CAROM_ERR_ARGUMENT;
    }
    if (picture->stride < row || picture->stride % each != 0) {
        return CAROM_ERR_ARGUMENT;
    }
    return (uintptr_t)picture->pixels % (uintptr_t)each != 0 ? (int)CAROM_ERR_MEMORY : CAROM_OK;
}

int draw_check_picture(const struct carom_picture *picture, enum carom_draw_style style)
{
    int result;

    if (picture == NULL || (picture->pixels == NULL && picture->row == NULL)) {
        return CAROM_ERR_NULL;
    }
    if (picture->width < 1 || picture->width > 2 * DRAW_GUARD || picture->height < 1 ||
        picture->height > 2 * DRAW_GUARD || picture->format > CAROM_BGR555) {
        return CAROM_ERR_ARGUMENT;
    }
    result = draw_check_paint(picture);
    return result == CAROM_OK ? check_pixels(picture, style) : result;
}

int draw_check(const struct carom_world *world, const struct carom_camera *camera,
               const struct carom_picture *picture, enum carom_draw_style style)
{
    if (world == NULL || camera == NULL || picture == NULL ||
        (style == CAROM_DRAW_FLAT && picture->workspace == NULL)) {
        return CAROM_ERR_NULL;
    }
    if (style != CAROM_DRAW_FLAT && style != CAROM_DRAW_WIRE) {
        return CAROM_ERR_ARGUMENT;
    }
    return draw_check_picture(picture, style);
}

int draw_part(const struct draw_source *source, struct draw_view *view,
              const struct carom_picture *picture, enum carom_draw_style style,
              const struct draw_rect *part)
{
    if (style == CAROM_DRAW_FLAT) {
        return draw_flat(source, view, picture, part);
    }
    draw_wire(source, view, picture, part);
    return CAROM_OK;
}

int carom_draw(const struct carom_world *world, const struct carom_camera *camera,
               const struct carom_picture *picture, enum carom_draw_style style)
{
    struct draw_source source;
    struct draw_view view;
    struct draw_rect all;
    int result = draw_check(world, camera, picture, style);

    if (result == CAROM_OK) {
        result = draw_view_init(&view, camera, picture->width, picture->height);
    }
    if (result != CAROM_OK) {
        return result;
    }
    draw_paint_light(&view, picture->paint);
    draw_source_init(&source, world, picture->paint);
    all = draw_whole(&view, picture);
    return draw_part(&source, &view, picture, style, &all);
}
