/* SPDX-License-Identifier: MIT */
/* Which side of a one-way body is solid. */
#include "parts.h"

/* Least cosine between a normal and the axis at which a one-way body is solid. */
#define SOLID_COSINE_Q30 (CAROM_ONE_Q30 / 4)

/* True if a body is solid along a normal that points away from it. */
static bool is_solid_to(const struct body *b, const carom_quat_q30 *rotation,
                        const carom_v3_q30 *normal, int sign)
{
    int axis = (b->def.one_way - 1) % 3;
    int64_t cosine_q30 = 0;
    carom_m3_q30 r;

    if (b->def.one_way == CAROM_BOTH_WAYS) {
        return true;
    }
    sign = b->def.one_way < CAROM_ONE_WAY_MINUS_X ? sign : -sign;
    fix_matrix(&r, rotation);
    for (int k = 0; k < 3; k++) {
        cosine_q30 += carom_mul_q30(r.c[k][axis], normal->c[k]);
    }
    return sign * cosine_q30 >= SOLID_COSINE_Q30;
}

bool step_solid_along(const struct step *s, const struct pair *p, const carom_v3_q30 *normal,
                      int32_t t_q30)
{
    const struct body *a = &s->w->bodies[p->a], *b = &s->w->bodies[p->b];
    struct body_state at_a = step_state_at(s, p->a, t_q30);
    struct body_state at_b = step_state_at(s, p->b, t_q30);

    return is_solid_to(a, &at_a.rotation, normal, -1) && is_solid_to(b, &at_b.rotation, normal, 1);
}

void step_drop_other_side(struct step *s, uint32_t number)
{
    struct contact_list *list = &s->w->rest.list;
    const struct pair *p = &s->w->pairs[number];
    struct contact_range own = contact_of_pair(list, (uint16_t)number);
    uint32_t kept = own.first;

    for (uint32_t i = own.first; i < own.end; i++) {
        struct contact *c = &list->contacts[i];

        if (c->doubted || step_solid_along(s, p, &c->normal, s->now_q30)) {
            list->contacts[kept++] = *c;
        }
    }
    memmove(&list->contacts[kept], &list->contacts[own.end],
            (list->pool->used - own.end) * sizeof *list->contacts);
    list->pool->used -= own.end - kept;
}
