/* SPDX-License-Identifier: MIT */
/*
 * The ticks of the stages and the longest slice, in a file of their own since every file of a step
 * may use them.
 */
#include "parts.h"

extern inline bool step_active(const struct step *s, uint32_t i);

void step_mark(struct carom_world *w, enum carom_stage stage)
{
    if (w->config.ticks) {
        uint32_t now = w->config.ticks();

        w->stats.ticks[stage] += now - w->mark_tick;
        w->mark_tick = now;
    }
}

int32_t step_slice(const struct step *s, uint32_t i, int32_t left_q30)
{
    return s->w->bodies[i].def.joined == BODY_ALONE
               ? body_slice(&s->w->bodies[i], &s->next->bodies[i], left_q30)
               : s->w->joint_steps->slice(s, i, left_q30);
}
