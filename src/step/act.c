/* SPDX-License-Identifier: MIT */
/*
 * Damping and then torque act where a frame begins. The energy that they change is work: contact
 * may neither take it back nor be charged for it.
 */
#include "parts.h"

static struct fix_wide kinetic2(const struct body *b, const struct body_state *s,
                                const carom_m3_q30 *r)
{
    struct fix_wide sum = {0, 0};

    body_add_kinetic2(&sum, b, s, r);
    return sum;
}

/* v less its part: no component grows or changes its sign. */
static void damp(carom_v3_q40 *v, int32_t part_q30)
{
    for (int k = 0; part_q30 > 0 && k < 3; k++) {
        v->c[k] -= fix_mul_q30(v->c[k], part_q30);
    }
}

/*
 * Damp a body. Rounding turns an angular momentum of a few units of its last place, and might turn
 * it to more energy: then it stays as it was. A linear momentum has less energy with each smaller
 * component.
 */
static void damp_both(const struct body *b, struct body_state *s, const carom_m3_q30 *r)
{
    const carom_v3_q40 before = s->angular;
    struct fix_wide excess, was;

    damp(&s->momentum, b->def.extra->linear_damping_q30);
    was = kinetic2(b, s, r);
    damp(&s->angular, b->def.extra->angular_damping_q30);
    excess = kinetic2(b, s, r);
    fix_wide_subtract(&excess, &was);
    if (fix_wide_sign(&excess) > 0) {
        s->angular = before;
    }
}

static void act_on(struct step *s, uint32_t i)
{
    struct body *b = &s->w->bodies[i];
    struct body_state *state = &s->next->bodies[i];
    struct fix_wide before, after;
    carom_m3_q30 r;

    fix_matrix(&r, &state->rotation);
    before = kinetic2(b, state, &r);
    damp_both(b, state, &r);
    /* at most 2^62 and 2^61 */
    for (int k = 0; k < 3; k++) {
        state->angular.c[k] += b->def.extra->torque.c[k];
    }
    (void)step_retire(s, i);
    after = kinetic2(b, state, &r);
    fix_wide_add(body_work2(b), &after);
    fix_wide_subtract(body_work2(b), &before);
}

void step_act(struct step *s)
{
    struct carom_world *w = s->w;

    for (uint32_t n = 0; n < w->config.caps.extras; n++) {
        const struct body_extra *extra = &w->extras[n];

        if (extra->used && step_active(s, extra->body) &&
            (extra->torque.c[0] | extra->torque.c[1] | extra->torque.c[2] |
             extra->linear_damping_q30 | extra->angular_damping_q30) != 0) {
            act_on(s, extra->body);
        }
    }
}
