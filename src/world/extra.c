/* SPDX-License-Identifier: MIT */
/* The pool of extras: properties that few bodies have. */
#include "world.h"

struct body_extra *world_extra(struct carom_world *w, uint32_t body)
{
    struct pool *pool = &w->pools[CAROM_POOL_extras];
    struct body_extra *extra = w->bodies[body].def.extra;
    uint32_t place = 0;

    if (extra || pool_take(pool) < 0) {
        return extra;
    }
    while (w->extras[place].used) {
        place++;
    }
    extra = &w->extras[place];
    *extra = (struct body_extra){.body = (uint16_t)body,
                                 .used = true,
                                 .rolling_q16 = BODY_ROLLING_Q16,
                                 .gravity_scale_q16 = BODY_GRAVITY_SCALE_Q16};
    w->bodies[body].def.extra = extra;
    return extra;
}

void world_drop_extra(struct carom_world *w, uint32_t body)
{
    struct body_extra *extra = w->bodies[body].def.extra;

    if (extra) {
        memset(extra, 0, sizeof *extra);
        w->pools[CAROM_POOL_extras].used--;
    }
}
