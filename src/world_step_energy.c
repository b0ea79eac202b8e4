/* SPDX-License-Identifier: MIT */
/* The energy of contact over a frame, island by island. */
#include "world_step_parts.h"

/* Rounding may have added this part of the kinetic energy: an excess below 2^-24 of it is none. */
#define SLACK_BITS 24

/* Twice the energies of an island, 80 fractional bits. */
struct account {
    struct fix_wide kinetic; /* now */
    struct fix_wide excess; /* of energy over what it was, and what contact may have lifted it by */
};

static struct fix_wide kinetic2(const struct body *b, const struct body_state *s)
{
    carom_m3_q30 r;

    body_matrix(&r, &s->rotation);
    return body_kinetic2(b, s, &r);
}

/* -2 m a.(way from one place to another): q40 times q32 brought to q40. */
static struct fix_wide climbed2(const struct body *b, const struct body_state *from,
                                const struct body_state *to)
{
    struct fix_wide sum = {0, 0};

    for (int k = 0; k < 3; k++) {
        int64_t weight_q40 = fix_mul_scaled(b->acceleration.c[k], b->mass);
        int64_t way_q32 = to->position.c[k] - from->position.c[k];

        sum = fix_wide_add(sum, fix_wide_mul(-2 * weight_q40, carom_shl(way_q32, 8)));
    }
    return sum;
}

/* What an island has gained. A body that left the world in this frame took its own along. */
static struct account audit(const struct step *s, uint32_t first)
{
    struct account sum = {{0, 0}, {0, 0}};

    for (uint32_t i = first; i != REST_ISLAND_END; i = s->w->bodies[i].next_in_island) {
        const struct body *b = &s->w->bodies[i];
        const struct body_state *from = &world_now(s->w)->bodies[i], *to = &s->next->bodies[i];

        if (!b->mesh || from->out) {
            continue;
        }
        sum.excess = fix_wide_add(sum.excess, fix_wide_neg(kinetic2(b, from)));
        if (to->out) {
            continue;
        }
        sum.kinetic = fix_wide_add(sum.kinetic, kinetic2(b, to));
        sum.excess = fix_wide_add(sum.excess, climbed2(b, from, to));
        if (b->in_contact) {
            sum.excess = fix_wide_add(sum.excess, fix_wide_neg(body_lift2(b)));
        }
    }
    sum.excess = fix_wide_add(sum.excess, sum.kinetic);
    return sum;
}

/*
 * The velocity that an island has as a whole: it stays when energy is taken out, as nothing outside
 * acts on it. One that touches what stands still has none to keep.
 */
static carom_v3_q40 common_velocity(const struct step *s, uint32_t first)
{
    const struct body *bodies = s->w->bodies;
    carom_v3_q40 v = {{0, 0, 0}};

    for (int k = 0; !bodies[first].grounded && k < 3; k++) {
        struct fix_wide momentum_q40 = {0, 0}, mass_q32 = {0, 0};

        for (uint32_t i = first; i != REST_ISLAND_END; i = bodies[i].next_in_island) {
            const struct body_state *state = &s->next->bodies[i];

            if (broad_active(&bodies[i], state)) {
                int64_t m_q32 = fix_mul_scaled((int64_t)1 << 32, bodies[i].mass);

                momentum_q40 = fix_wide_add(momentum_q40, fix_wide_mul(state->momentum.c[k], 1));
                mass_q32 = fix_wide_add(mass_q32, fix_wide_mul(m_q32, 1));
            }
        }
        if (fix_wide_sign(mass_q32) > 0) {
            v.c[k] = fix_mul_scaled((int64_t)1 << 32, fix_wide_ratio(momentum_q40, mass_q32));
        }
    }
    return v;
}

/* Twice the kinetic energy of an island's bodies, if each moved with this velocity. */
static struct fix_wide common_kinetic2(const struct step *s, uint32_t first, const carom_v3_q40 *v)
{
    struct fix_wide sum = {0, 0};

    for (uint32_t i = first; i != REST_ISLAND_END; i = s->w->bodies[i].next_in_island) {
        const struct body *b = &s->w->bodies[i];

        for (int k = 0; broad_active(b, &s->next->bodies[i]) && k < 3; k++) {
            sum = fix_wide_add(sum, fix_wide_mul(fix_mul_scaled(v->c[k], b->mass), v->c[k]));
        }
    }
    return sum;
}

/* Scale an island's motion about a velocity that all share; what rounding takes, one body gets. */
static void scale_momenta(struct step *s, uint32_t first, const carom_v3_q40 *v, int32_t factor_q30)
{
    struct body_state *any = NULL;
    uint64_t taken[3] = {0, 0, 0}; /* differences cancel: modulo 2^64 is enough */

    for (uint32_t i = first; i != REST_ISLAND_END; i = s->w->bodies[i].next_in_island) {
        struct body_state *state = &s->next->bodies[i];

        if (!broad_active(&s->w->bodies[i], state)) {
            continue;
        }
        any = state;
        for (int k = 0; k < 3; k++) {
            int64_t was = state->momentum.c[k];
            int64_t common = fix_mul_scaled(v->c[k], s->w->bodies[i].mass);

            state->momentum.c[k] = common + fix_mul(was - common, factor_q30, 30);
            state->angular.c[k] = fix_mul(state->angular.c[k], factor_q30, 30);
            taken[k] += (uint64_t)was - (uint64_t)state->momentum.c[k];
        }
    }
    for (int k = 0; any && !s->w->bodies[first].grounded && k < 3; k++) {
        any->momentum.c[k] += (int64_t)taken[k];
    }
}

static bool moved(const struct body_state *from, const struct body_state *to)
{
    return memcmp(&from->position, &to->position, sizeof from->position) != 0 ||
           memcmp(&from->rotation, &to->rotation, sizeof from->rotation) != 0;
}

/* Whether a body of another island may have come to where a body was when the frame began. */
static bool place_taken(const struct step *s, uint32_t body)
{
    const struct world_state *before = world_now(s->w);
    const struct body *b = &s->w->bodies[body];

    for (uint32_t i = 0; i < s->w->body_count; i++) {
        const struct body *other = &s->w->bodies[i];

        if (broad_active(other, &s->next->bodies[i]) && other->island != b->island &&
            moved(&before->bodies[i], &s->next->bodies[i]) &&
            broad_near(b, &before->bodies[body], other, &s->next->bodies[i], b->skin_q22)) {
            return true;
        }
    }
    return false;
}

/* The island comes to a halt: where the frame found it, unless that place is taken by now. */
static void hold_still(struct step *s, uint32_t first)
{
    const struct body *bodies = s->w->bodies;
    bool back = true;

    for (uint32_t i = first; i != REST_ISLAND_END; i = bodies[i].next_in_island) {
        back = back && !place_taken(s, i);
    }
    for (uint32_t i = first; i != REST_ISLAND_END; i = bodies[i].next_in_island) {
        struct body_state *state = &s->next->bodies[i];

        if (!broad_active(&bodies[i], state)) {
            continue;
        }
        if (back) {
            state->position = world_now(s->w)->bodies[i].position;
            state->rotation = world_now(s->w)->bodies[i].rotation;
        }
        memset(&state->momentum, 0, sizeof state->momentum);
        memset(&state->angular, 0, sizeof state->angular);
    }
}

static void limit_island(struct step *s, uint32_t first)
{
    struct account sum = audit(s, first);
    struct fix_wide slack = {sum.kinetic.hi >> SLACK_BITS,
                             (uint64_t)fix_wide_shift(sum.kinetic, SLACK_BITS)};
    struct fix_wide relative, kept;
    int32_t factor_q30 = 0;
    carom_v3_q40 v;

    if (fix_wide_sign(fix_wide_add(sum.excess, fix_wide_neg(slack))) <= 0) {
        return;
    }
    v = common_velocity(s, first);
    relative = fix_wide_add(sum.kinetic, fix_wide_neg(common_kinetic2(s, first, &v)));
    kept = fix_wide_add(relative, fix_wide_neg(sum.excess));
    if (fix_wide_sign(kept) > 0) {
        struct fix_scaled ratio = fix_wide_ratio(kept, relative); /* below 1 */

        factor_q30 = (int32_t)fix_sqrt((uint64_t)fix_mul_scaled((int64_t)1 << 60, ratio));
    } else if (s->w->bodies[first].grounded) {
        hold_still(s, first); /* it climbed by more than it has to give */
        return;
    }
    scale_momenta(s, first, &v, factor_q30);
}

/*
 * Bodies in contact took the gravity of the whole frame before they moved. When the frame is cut
 * short, those of an island in the air give back what belongs to the time that was dropped: the
 * island then has the momentum that gravity gave it on its way, and to scale its motion about its
 * common velocity takes out whatever it gained. On the ground the weight is answered by impulses
 * that belong to it; there the audit alone decides.
 */
static void give_back_gravity(struct step *s, uint32_t first)
{
    for (uint32_t i = first; i != REST_ISLAND_END; i = s->w->bodies[i].next_in_island) {
        const struct body *b = &s->w->bodies[i];

        for (int k = 0; broad_active(b, &s->next->bodies[i]) && b->in_contact && k < 3; k++) {
            s->next->bodies[i].momentum.c[k] -=
                fix_mul_scaled(fix_mul(b->acceleration.c[k], s->left_q30, 30), b->mass);
        }
    }
}

void step_limit_energy(struct step *s, bool cut_short)
{
    struct carom_world *w = s->w;

    rest_islands_begin(w->bodies, w->body_count);
    for (uint32_t i = 0; i < w->body_count; i++) {
        w->bodies[i].touched = w->bodies[i].in_contact;
        w->bodies[i].grounded = false;
    }
    for (uint32_t i = 0; i < s->next->touching_count; i++) {
        const struct pair *p = &s->next->touching[i];

        rest_islands_join(w->bodies, p);
        w->bodies[p->a].touched |= cut_short;
        w->bodies[p->a].grounded |= !w->bodies[p->b].moving;
    }
    rest_islands_end(w->bodies, w->body_count);
    for (uint32_t i = 0; i < w->body_count; i++) {
        w->bodies[w->bodies[i].island].touched |= w->bodies[i].touched;
        w->bodies[w->bodies[i].island].grounded |= w->bodies[i].grounded;
    }
    for (uint32_t i = 0; i < w->body_count; i++) {
        if (w->bodies[i].island == i && w->bodies[i].touched) {
            if (cut_short && !w->bodies[i].grounded) {
                give_back_gravity(s, i);
            }
            limit_island(s, i);
        }
    }
}
