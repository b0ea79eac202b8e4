/* SPDX-License-Identifier: MIT */
/* Are a body's numbers within what the formats hold? And the acceleration by gravity and force. */
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

bool world_is_unit(const int32_t *v, int n, int bits)
{
    int64_t square_q60 = 0;

    for (int k = 0; k < n; k++) {
        int32_t most = CAROM_ONE_Q30 + (CAROM_ONE_Q30 >> bits);

        if (v[k] > most || v[k] < -most) {
            return false;
        }
        square_q60 += (int64_t)v[k] * v[k];
    }
    return carom_abs(square_q60 - ((int64_t)1 << 60)) < (int64_t)1 << (60 - bits);
}

bool world_rotation_valid(carom_quat_q30 *q)
{
    int64_t square_q60 = 0;

    if ((q->c[0] | q->c[1] | q->c[2] | q->c[3]) == 0) {
        q->c[0] = CAROM_ONE_Q30;
        return true;
    }
    for (int k = 0; k < 4; k++) {
        if (carom_abs(q->c[k]) > CAROM_ONE_Q30 + (CAROM_ONE_Q30 >> 10)) {
            return false;
        }
        square_q60 += (int64_t)q->c[k] * q->c[k];
    }
    if (carom_abs(square_q60 - ((int64_t)1 << 60)) > (int64_t)1 << 51) {
        return false;
    }
    body_normalise(q);
    return true;
}

bool world_gravity_in_range(const carom_v3_q40 *gravity)
{
    return world_each_within(gravity->c, (int64_t)1 << 40);
}

bool world_acceleration(const struct body *b, int32_t gravity_scale_q16,
                        const carom_v3_q40 *gravity, const carom_v3_q40 *force, carom_v3_q40 *out)
{
    carom_v3_q40 sum = {{0, 0, 0}};

    /* the largest mass is 2^10, so the limit is below 2^52 and a force within it can be divided */
    if (b->def.moving &&
        !world_each_within(force->c, fix_mul_scaled((int64_t)2 << 40, b->def.mass))) {
        return false;
    }
    for (int k = 0; b->def.moving && k < 3; k++) {
        sum.c[k] = gravity_scale_q16 == 1 << 16 ? gravity->c[k]
                                                : fix_mul(gravity->c[k], gravity_scale_q16, 16);
        sum.c[k] += fix_mul_scaled(force->c[k], b->def.inverse_mass);
    }
    *out = sum;
    return world_gravity_in_range(&sum);
}

void world_accelerate(struct carom_world *w, uint32_t body)
{
    struct body *b = &w->bodies[body];

    if (b->def.mesh) {
        int32_t scale_q16 = b->def.extra ? b->def.extra->gravity_scale_q16 : 1 << 16;

        world_acceleration(b, scale_q16, &w->config.gravity, &b->def.force, &b->def.acceleration);
        b->def.acceleration_q40 = fix_length(b->def.acceleration.c);
    }
}

int64_t world_most_angular_q40(const struct body *b)
{
    return fix_mul_scaled(fix_mul((int64_t)BODY_SPEED_LIMIT << 40, b->def.radius_q22, 22),
                          b->def.mass);
}

bool world_position_in_range(const carom_v3_q32 *p)
{
    return world_each_within(p->c, (int64_t)BODY_WORLD_LIMIT << 32);
}

/*
 * The length of a vector below 2^48, to nearest: fix_length and a Newton step for the digits that
 * it drops.
 */
static int64_t exact_length(const int64_t v[3])
{
    int64_t length = fix_length(v);
    struct fix_wide excess = fix_wide_mul(-length, length);

    if (length > 0) {
        fix_wide_add_dot(&excess, v, v);
        length += fix_mul_scaled(1, fix_wide_over(&excess, 2 * length));
    }
    return length;
}

/*
 * True if every point of a body of radius r is slower than the limit: |v| + r |w| < 64, and |w| <
 * 64. Then no impact can make the centre faster than that within a frame, because energy does not
 * rise and I <= m r^2; so reach, angular momentum and everything that follows are bounded.
 */
bool world_motion_in_range(const struct body *b, const carom_v3_q40 *v, const carom_v3_q40 *spin)
{
    const int64_t limit_q40 = (int64_t)BODY_SPEED_LIMIT << 40;
    int64_t turn_q40;

    if (!world_each_within(v->c, limit_q40) || !world_each_within(spin->c, limit_q40)) {
        return false;
    }
    turn_q40 = exact_length(spin->c);
    return turn_q40 < limit_q40 &&
           exact_length(v->c) + fix_mul(turn_q40, b->def.radius_q22, 22) < limit_q40;
}

void world_set_motion(const struct body *b, struct body_state *s, const carom_v3_q40 *v,
                      const carom_v3_q40 *spin)
{
    body_set_motion(b, s, v, spin);
    if (!world_in_range(b, s)) {
        for (int k = 0; k < 3; k++) {
            s->momentum.c[k] -= s->momentum.c[k] / (1 << 25);
        }
    }
}

/*
 * Bits of the largest mean square of the speeds by which a body's points turn; the speeds are below
 * 2^10.
 */
#define SQUARE_BITS 20

bool world_in_range(const struct body *b, const struct body_state *s)
{
    const int64_t angular_limit_q40 = (int64_t)1 << 62;
    int64_t momentum_limit_q40 =
        b->def.moving ? fix_mul_scaled((int64_t)BODY_SPEED_LIMIT << 40, b->def.mass) : 0;
    carom_v3_q40 v, spin;
    int64_t by_mass[3] = {0, 0, 0};
    struct fix_wide sum = {0, 0};
    carom_m3_q30 r;

    if (!world_position_in_range(&s->position) ||
        !world_each_within(s->momentum.c, momentum_limit_q40) ||
        !world_each_within(s->angular.c, b->def.moving ? angular_limit_q40 - 1 : 0)) {
        return false;
    }
    /* a thin body may spin faster about its axis than any that can be given */
    fix_matrix(&r, &s->rotation);
    body_velocity(b, s, &v);
    if (!world_each_within(v.c, (int64_t)BODY_SPEED_LIMIT << 40) ||
        fix_length(v.c) >= (int64_t)BODY_SPEED_LIMIT << 40 ||
        fix_length(s->angular.c) >= angular_limit_q40 ||
        (b->def.moving && !body_spin_fits(b, s, &r))) {
        return false;
    }
    body_spin(b, s, &r, &spin);
    for (int k = 0; b->def.moving && k < 3; k++) {
        by_mass[k] = fix_mul_scaled(s->angular.c[k], b->def.inverse_mass);
    }
    fix_wide_add_dot(&sum, by_mass, spin.c);
    return fix_wide_bits(&sum) <= 80 + SQUARE_BITS;
}

bool world_momenta_in_range(const struct body *b, const struct body_state *s)
{
    carom_v3_q40 v, spin;
    carom_m3_q30 r;

    fix_matrix(&r, &s->rotation);
    /* |L| <= m r^2 |w| and r |w| < 64 */
    if (!world_in_range(b, s) || fix_length(s->angular.c) > world_most_angular_q40(b)) {
        return false;
    }
    body_velocity(b, s, &v);
    body_spin(b, s, &r, &spin);
    return world_motion_in_range(b, &v, &spin);
}
