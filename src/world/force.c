/* SPDX-License-Identifier: MIT */
/* Gravity, lasting forces and pushes. */
#include "world.h"

int carom_world_set_gravity(struct carom_world *w, const carom_v3_q40 *gravity)
{
    carom_v3_q40 sum;

    if (!w || !gravity) {
        return CAROM_ERR_NULL;
    }
    if (!world_gravity_in_range(gravity)) {
        return CAROM_ERR_RANGE;
    }
    for (uint32_t i = 0; i < w->body_count; i++) {
        if (!world_acceleration(&w->bodies[i], gravity, &w->bodies[i].force, &sum)) {
            return CAROM_ERR_RANGE;
        }
    }
    if (memcmp(&w->config.gravity, gravity, sizeof *gravity) != 0) {
        w->config.gravity = *gravity;
        for (uint32_t i = 0; i < w->body_count; i++) {
            world_accelerate(w, i);
        }
        world_wake_all(w);
    }
    return CAROM_OK;
}

int carom_body_set_force(struct carom_world *w, int body, const carom_v3_q40 *force)
{
    carom_v3_q40 sum;
    struct body *b;

    if (!w || !force) {
        return CAROM_ERR_NULL;
    }
    if (!world_has_body(w, body)) {
        return CAROM_ERR_BODY;
    }
    if (!w->bodies[body].moving) {
        return CAROM_ERR_ARGUMENT;
    }
    if (!world_acceleration(&w->bodies[body], &w->config.gravity, force, &sum)) {
        return CAROM_ERR_RANGE;
    }
    b = &w->bodies[body];
    if (memcmp(&b->force, force, sizeof *force) != 0) {
        b->force = *force;
        world_accelerate(w, (uint32_t)body);
        world_wake_island(w, (uint32_t)body);
    }
    return CAROM_OK;
}

/* (a b - c d) / 2^32 to nearest; false when that has more than 61 bits. */
static bool moment_q40(int64_t a_q32, int64_t b_q40, int64_t c_q32, int64_t d_q40, int64_t *out)
{
    struct fix_wide sum = fix_wide_mul(a_q32, b_q40);

    fix_wide_add_product(&sum, -c_q32, d_q40);
    if (fix_wide_bits(&sum) > 32 + 61) {
        return false;
    }
    fix_wide_add_product(&sum, (int64_t)1 << 31, 1);
    *out = fix_wide_shift(&sum, 32);
    return true;
}

/* Whether a moving body's momenta are those of a motion that could be given. */
static bool momenta_in_range(const struct body *b, const struct body_state *s)
{
    /* |L| <= m r^2 |w| and r |w| < 64 */
    int64_t most_q40 =
        fix_mul_scaled(fix_mul((int64_t)BODY_SPEED_LIMIT << 40, b->radius_q22, 22), b->mass);
    carom_v3_q40 v, w;
    carom_m3_q30 r;

    fix_matrix(&r, &s->rotation);
    if (!world_in_range(b, s) || fix_length(s->angular.c) > most_q40) {
        return false;
    }
    body_velocity(b, s, &v);
    body_spin(b, s, &r, &w);
    return world_motion_in_range(b, &v, &w);
}

int carom_body_push(struct carom_world *w, int body, const carom_v3_q40 *impulse,
                    const carom_v3_q32 *point)
{
    const struct body *b;
    struct body_state pushed;
    int64_t arm_q32[3];

    if (!w || !impulse || !point) {
        return CAROM_ERR_NULL;
    }
    if (!world_has_body(w, body)) {
        return CAROM_ERR_BODY;
    }
    b = &w->bodies[body];
    pushed = world_now(w)->bodies[body];
    if (!b->moving || pushed.out) {
        return CAROM_ERR_ARGUMENT;
    }
    /* no more than turns a body's fastest motion around */
    if (!world_each_within(point->c, (int64_t)BODY_WORLD_LIMIT << 32) ||
        !world_each_within(impulse->c, fix_mul_scaled((int64_t)BODY_SPEED_LIMIT << 41, b->mass))) {
        return CAROM_ERR_RANGE;
    }
    for (int k = 0; k < 3; k++) {
        arm_q32[k] = point->c[k] - pushed.position.c[k];
    }
    for (int k = 0; k < 3; k++) {
        int i = fix_next(k), j = fix_next(i);
        int64_t moment;

        if (!moment_q40(arm_q32[i], impulse->c[j], arm_q32[j], impulse->c[i], &moment)) {
            return CAROM_ERR_RANGE;
        }
        pushed.momentum.c[k] += impulse->c[k];
        pushed.angular.c[k] += moment;
    }
    if (!momenta_in_range(b, &pushed)) {
        return CAROM_ERR_RANGE;
    }
    world_now(w)->bodies[body] = pushed;
    world_wake_island(w, (uint32_t)body);
    return CAROM_OK;
}
