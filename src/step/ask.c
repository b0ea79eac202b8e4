/* SPDX-License-Identifier: MIT */
/* Ask the caller about the contacts of a solve: it may drop one, or change its e and mu. */
#include "../solve/parts.h"
#include "parts.h"

/* Add sign times the velocity of a body at a place of the world. */
static void add_velocity(const struct step *s, uint32_t i, const carom_v3_q32 *point, int sign,
                         carom_v3_q40 *sum)
{
    const struct body *b = &s->w->bodies[i];
    struct body_state state = step_state_at(s, i, s->now_q30);
    int32_t arm_q22[3];
    carom_v3_q40 v, spin;
    carom_m3_q30 r;

    if (!b->def.moving) {
        return;
    }
    fix_matrix(&r, &state.rotation);
    body_velocity(b, &state, &v);
    body_spin(b, &state, &r, &spin);
    for (int k = 0; k < 3; k++) { /* below 2^28: a place of the body, except for its margin */
        arm_q22[k] = (int32_t)((point->c[k] - state.position.c[k]) >> 10);
    }
    for (int k = 0; k < 3; k++) {
        int m = fix_next(k), n = fix_next(m);

        sum->c[k] += sign * (v.c[k] + fix_mul(spin.c[m], arm_q22[n], 22) -
                             fix_mul(spin.c[n], arm_q22[m], 22));
    }
}

/* A contact as the caller sees it. */
static struct carom_touch describe(const struct step *s, const struct contact *c)
{
    const struct carom_world *w = s->w;
    const struct pair *p = &w->pairs[c->key.pair];
    struct carom_touch touch = {.a = p->a,
                                .b = p->b,
                                .point = contact_point(c),
                                .normal = c->normal,
                                .restitution_q30 = rest_restitution_at(&w->rest, c),
                                .friction_q16 = rest_friction_at(&w->rest, c)};
    carom_v3_q40 v = {{0, 0, 0}};

    touch.face_a = (uint16_t)contact_face(&w->bodies[p->a], &c->key, 0, &c->normal);
    touch.face_b = (uint16_t)contact_face(&w->bodies[p->b], &c->key, 1, &c->normal);
    for (int k = 0; c->drift && k < 3; k++) {
        v.c[k] = -c->drift->c[k];
    }
    add_velocity(s, p->a, &touch.point, 1, &v);
    add_velocity(s, p->b, &touch.point, -1, &v);
    touch.speed_q40 = -rest_along_q40(&v, &c->normal);
    return touch;
}

/* Ask about a contact. True if it stays. */
static bool ask(struct step *s, struct contact *c)
{
    struct carom_world *w = s->w;
    struct carom_touch touch = describe(s, c), was = touch;
    struct contact_mixed mixed;
    carom_v3_q40 drift = {{0, 0, 0}};

    if (!w->config.contact(w->config.contact_user, &touch)) {
        return false;
    }
    if (touch.restitution_q30 != was.restitution_q30 || touch.friction_q16 != was.friction_q16) {
        mixed.restitution_q30 = fix_smaller(fix_larger(touch.restitution_q30, 0), CAROM_ONE_Q30);
        mixed.friction_q16 =
            touch.friction_q16 < CAROM_MU_MAX_Q16 ? touch.friction_q16 : CAROM_MU_MAX_Q16;
        if (c->drift) {
            drift = *c->drift;
        }
        contact_keep_drift(&w->rest.list, c, &drift, &mixed);
    }
    return true;
}

void step_ask_contacts(struct step *s, bool members)
{
    struct carom_world *w = s->w;
    const struct contact_list *list = &w->rest.list;
    uint32_t first = 0; /* first contact of the present pair */

    while (first < list->pool->used) {
        uint16_t number = list->contacts[first].key.pair;
        const struct pair *p = &w->pairs[number];
        uint32_t i = first, end = contact_pair_end(list, number, first);

        if (members && !w->bodies[p->a].clock.member) { /* then b is none either */
            first = end;
            continue;
        }
        while (i < end && ask(s, &list->contacts[i])) {
            i++;
        }
        if (i == end) {
            first = end;
        } else {
            w->meetings[number].passes = true;
            w->meetings[number].hit_q30 = PAIRS_NEVER;
            contact_drop_pair(&w->rest.list, number);
        }
    }
}
