/* SPDX-License-Identifier: MIT */
/* Everything that drawing asks of a world, through the public interface. */
#include "draw.h"

void draw_source_init(struct draw_source *source, const struct carom_world *world,
                      const struct carom_paint *paint)
{
    source->world = world;
    source->paint = paint;
    source->count = (uint32_t)carom_body_count(world);
    source->hot_count = carom_interfering_faces(world, &source->hot);
    if (paint && paint->hide_interfering) {
        source->hot_count = 0;
    }
}
