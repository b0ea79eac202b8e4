/* SPDX-License-Identifier: MIT */
/* From a pixel of a picture to the ray behind it, and to the face that the pixel shows. */
#include "carom_query.h"
#include "draw.h"

#define SIZE_MAX_PIXELS 2048
/* The longest component of a ray's way is below 2^15 units. */
#define WAY_BITS 47

/*
 * Set the direction through a place of the picture, and how far forward it goes, in pixels q46.
 * Bounds: the focal length is below 2^32 in q16 and half a picture below 2^27, so sums are below
 * 2^62.
 */
static void look_through(const struct draw_view *view, const int64_t at_q16[2], int64_t way[3],
                         int64_t *ahead)
{
    for (int k = 0; k < 3; k++) {
        way[k] = view->focal_q16 * view->axes.c[2][k] + at_q16[0] * view->axes.c[0][k] +
                 at_q16[1] * view->axes.c[1][k];
    }
    *ahead = view->focal_q16 * CAROM_ONE_Q30;
}

int carom_view_ray(const struct carom_camera *camera, int32_t width, int32_t height, int32_t x_q8,
                   int32_t y_q8, struct carom_ray *ray)
{
    struct draw_view view;
    int64_t at_q16[2], way[3], ahead;
    int result, bits;

    if (!camera || !ray) {
        return CAROM_ERR_NULL;
    }
    if (width < 1 || width > SIZE_MAX_PIXELS || height < 1 || height > SIZE_MAX_PIXELS ||
        x_q8 < 0 || x_q8 > width * 256 || y_q8 < 0 || y_q8 > height * 256) {
        return CAROM_ERR_ARGUMENT;
    }
    result = draw_view_init(&view, camera, width, height);
    if (result < 0) {
        return result;
    }
    at_q16[0] = (int64_t)x_q8 * 256 - (int64_t)width * (1 << 15);
    at_q16[1] = (int64_t)y_q8 * 256 - (int64_t)height * (1 << 15);
    look_through(&view, at_q16, way, &ahead);
    bits = fix_bits3(way);
    for (int k = 0; k < 3; k++) {
        ray->way.c[k] = fix_shift(way[k], WAY_BITS - bits);
        /* begin in the near plane, 1/32 units ahead; with 34 bits the dividend is below 2^62 */
        ray->from.c[k] = camera->eye.c[k] + fix_shift(way[k], 34 - bits) * ((int64_t)1 << 27) /
                                                fix_shift(ahead, 34 - bits);
    }
    return CAROM_OK;
}

int carom_draw_pick(const struct carom_world *world, const struct carom_camera *camera,
                    const struct carom_picture *picture, int32_t x, int32_t y,
                    const struct carom_query_filter *filter, struct carom_ray_hit *hit)
{
    struct carom_ray ray;
    int result;

    if (!world || !picture || !hit) {
        return CAROM_ERR_NULL;
    }
    if (x < 0 || x >= picture->width || y < 0 || y >= picture->height) {
        return CAROM_ERR_ARGUMENT;
    }
    result =
        carom_view_ray(camera, picture->width, picture->height, x * 256 + 128, y * 256 + 128, &ray);
    return result < 0 ? result : carom_cast_ray(world, &ray, filter, hit);
}
