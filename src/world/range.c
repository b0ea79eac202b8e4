/* SPDX-License-Identifier: MIT */
/* Whether numbers of a body are within what the formats hold, and what gravity and a force give it. */
#include "world.h"

bool world_each_within(const int64_t v[3], int64_t limit)
{
    for (int k = 0; k < 3; k++) {
        if (v[k] > limit || v[k] < -limit) {
            return false;
        }
    }
    return true;
}

bool world_gravity_in_range(const carom_v3_q40 *gravity)
{
    return world_each_within(gravity->c, (int64_t)1 << 40);
}

bool world_acceleration(const struct body *b, const carom_v3_q40 *gravity,
                        const carom_v3_q40 *force, carom_v3_q40 *out)
{
    carom_v3_q40 sum = {{0, 0, 0}};

    /* the largest mass is 2^10, so the limit is below 2^52 and what passes it can be divided */
    if (b->moving && !world_each_within(force->c, fix_mul_scaled((int64_t)2 << 40, b->mass))) {
        return false;
    }
    for (int k = 0; b->moving && k < 3; k++) {
        sum.c[k] = gravity->c[k] + fix_mul_scaled(force->c[k], b->inverse_mass);
    }
    *out = sum;
    return world_gravity_in_range(&sum);
}

void world_accelerate(struct carom_world *w, uint32_t body)
{
    struct body *b = &w->bodies[body];

    if (b->mesh) {
        world_acceleration(b, &w->config.gravity, &b->force, &b->acceleration);
        b->acceleration_q40 = fix_length(b->acceleration.c);
    }
}

bool world_position_in_range(const carom_v3_q32 *p)
{
    return world_each_within(p->c, (int64_t)BODY_WORLD_LIMIT << 32);
}

/*
 * Whether every point of a body, of radius r, is slower than the limit: |v| + r |w| < 64, and |w| <
 * 64 when it is given. No impact can then make the centre faster than that within a frame, because
 * energy does not rise and I <= m r^2; so reach, angular momentum and all that follows are bounded.
 */
static bool points_in_range(const struct body *b, const carom_v3_q40 *v, const carom_v3_q40 *w)
{
    const int64_t limit_q40 = (int64_t)BODY_SPEED_LIMIT << 40;

    return world_each_within(v->c, limit_q40) &&
           fix_length(v->c) + fix_mul(fix_length(w->c), b->radius_q22, 22) < limit_q40;
}

bool world_motion_in_range(const struct body *b, const carom_v3_q40 *v, const carom_v3_q40 *w)
{
    const int64_t limit_q40 = (int64_t)BODY_SPEED_LIMIT << 40;

    return world_each_within(w->c, limit_q40) && fix_length(w->c) < limit_q40 &&
           points_in_range(b, v, w);
}

/* Of the mean square of the speeds that points turn with, at most: they are below 2^10. */
#define SQUARE_BITS 20

bool world_in_range(const struct body *b, const struct body_state *s)
{
    const int64_t angular_limit_q40 = (int64_t)1 << 62;
    int64_t momentum_limit_q40 =
        b->moving ? fix_mul_scaled((int64_t)BODY_SPEED_LIMIT << 40, b->mass) : 0;
    carom_v3_q40 v, w, still = {{0, 0, 0}};
    int64_t by_mass[3] = {0, 0, 0};
    struct fix_wide sum = {0, 0};
    carom_m3_q30 r;

    if (!world_position_in_range(&s->position) ||
        !world_each_within(s->momentum.c, momentum_limit_q40) ||
        !world_each_within(s->angular.c, b->moving ? angular_limit_q40 - 1 : 0)) {
        return false;
    }
    /* a thin body may spin faster about its axis than any that is made */
    fix_matrix(&r, &s->rotation);
    body_velocity(b, s, &v);
    if (!points_in_range(b, &v, &still) || fix_length(s->angular.c) >= angular_limit_q40 ||
        (b->moving && !body_spin_fits(b, s, &r))) {
        return false;
    }
    body_spin(b, s, &r, &w);
    for (int k = 0; b->moving && k < 3; k++) {
        by_mass[k] = fix_mul_scaled(s->angular.c[k], b->inverse_mass);
    }
    fix_wide_add_dot(&sum, by_mass, w.c);
    return fix_wide_bits(&sum) <= 80 + SQUARE_BITS;
}
