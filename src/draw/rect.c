/* SPDX-License-Identifier: MIT */
/* Rectangles of a picture. */
#include "draw.h"

static int16_t pixel(int32_t at, int32_t middle)
{
    return (int16_t)(at + middle);
}

struct carom_rect draw_on_picture(const struct draw_view *view, struct draw_rect r)
{
    const int32_t *m = view->middle;

    return (struct carom_rect){pixel(r.x0, m[0]), pixel(r.y0, m[1]), pixel(r.x1, m[0]),
                               pixel(r.y1, m[1])};
}

struct carom_rect draw_around(const struct carom_rect *a, const struct carom_rect *b)
{
    return (struct carom_rect){a->x0 < b->x0 ? a->x0 : b->x0, a->y0 < b->y0 ? a->y0 : b->y0,
                               a->x1 > b->x1 ? a->x1 : b->x1, a->y1 > b->y1 ? a->y1 : b->y1};
}

bool draw_is_empty(const struct carom_rect *r)
{
    return r->x0 >= r->x1 || r->y0 >= r->y1;
}

void draw_touch(struct carom_rect *touched, struct carom_rect r)
{
    if (touched && !draw_is_empty(&r)) {
        *touched = draw_is_empty(touched) ? r : draw_around(touched, &r);
    }
}
