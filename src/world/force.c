/* SPDX-License-Identifier: MIT */
/* Gravity, lasting forces, and pushes. */
#include "world.h"

int carom_world_set_gravity(struct carom_world *w, const carom_v3_q40 *gravity)
{
    if (!w || !gravity) {
        return CAROM_ERR_NULL;
    }
    if (!world_gravity_in_range(gravity)) {
        return CAROM_ERR_RANGE;
    }
    for (uint32_t i = 0; i < w->body_count; i++) {
        const struct carom_forces f = world_forces(&w->bodies[i]);

        if (world_check_forces(&w->bodies[i], gravity, &f) < 0) {
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

struct carom_forces world_forces(const struct body *b)
{
    struct carom_forces f;

    memset(&f, 0, sizeof f);
    f.force = b->def.force;
    f.gravity_scale_q16 = BODY_GRAVITY_SCALE_Q16;
    if (b->def.extra) {
        f.torque = b->def.extra->torque;
        f.gravity_scale_q16 = b->def.extra->gravity_scale_q16;
        f.linear_damping_q30 = b->def.extra->linear_damping_q30;
        f.angular_damping_q30 = b->def.extra->angular_damping_q30;
    }
    return f;
}

bool world_forces_need_extra(const struct carom_forces *f)
{
    return (f->torque.c[0] | f->torque.c[1] | f->torque.c[2]) != 0 ||
           f->gravity_scale_q16 != BODY_GRAVITY_SCALE_Q16 ||
           (f->linear_damping_q30 | f->angular_damping_q30) != 0;
}

bool world_set_forces(struct carom_world *w, uint32_t body, const struct carom_forces *f)
{
    struct body_extra *extra = w->bodies[body].def.extra;

    if (!extra && world_forces_need_extra(f)) {
        extra = world_extra(w, body);
        if (!extra) {
            return false;
        }
    }
    w->bodies[body].def.force = f->force;
    if (extra) {
        extra->torque = f->torque;
        extra->gravity_scale_q16 = f->gravity_scale_q16;
        extra->linear_damping_q30 = f->linear_damping_q30;
        extra->angular_damping_q30 = f->angular_damping_q30;
    }
    world_accelerate(w, body);
    return true;
}

#define SCALE_MAX_Q16 ((int32_t)16 << 16)

static bool is_part(int32_t v_q30)
{
    return v_q30 >= 0 && v_q30 <= CAROM_ONE_Q30;
}

int world_check_forces(const struct body *b, const carom_v3_q40 *gravity,
                       const struct carom_forces *f)
{
    carom_v3_q40 sum;

    if (f->gravity_scale_q16 > SCALE_MAX_Q16 || f->gravity_scale_q16 < -SCALE_MAX_Q16 ||
        !is_part(f->linear_damping_q30) || !is_part(f->angular_damping_q30)) {
        return CAROM_ERR_ARGUMENT;
    }
    return world_each_within(f->torque.c, b->def.moving ? world_most_angular_q40(b) : 0) &&
                   world_acceleration(b, f->gravity_scale_q16, gravity, &f->force, &sum)
               ? CAROM_OK
               : (int)CAROM_ERR_RANGE;
}

int carom_body_forces(const struct carom_world *w, int body, struct carom_forces *forces)
{
    if (!w || !forces) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    *forces = world_forces(&w->bodies[body]);
    return CAROM_OK;
}

/* The present forces of a moving body, of which the caller changes one. */
static int find_forces(const struct carom_world *w, int *body, struct carom_forces *out)
{
    if (!world_find_body(w, body)) {
        return CAROM_ERR_BODY;
    }
    *out = world_forces(&w->bodies[*body]);
    return w->bodies[*body].def.moving ? CAROM_OK : (int)CAROM_ERR_ARGUMENT;
}

/* Set a body's forces, if `result` says that they were found. */
static int set_forces(struct carom_world *w, int result, int body, const struct carom_forces *to)
{
    struct carom_forces now;

    if (result < 0) {
        return result;
    }
    result = world_check_forces(&w->bodies[body], &w->config.gravity, to);
    now = world_forces(&w->bodies[body]);
    if (result < 0 || memcmp(&now, to, sizeof now) == 0) {
        return result;
    }
    if (!world_set_forces(w, (uint32_t)body, to)) {
        return CAROM_ERR_EXTRAS_FULL;
    }
    world_wake_island(w, (uint32_t)body);
    return CAROM_OK;
}

int carom_body_set_force(struct carom_world *w, int body, const carom_v3_q40 *force)
{
    struct carom_forces f;
    int result;

    if (!w || !force) {
        return CAROM_ERR_NULL;
    }
    result = find_forces(w, &body, &f);
    f.force = *force;
    return set_forces(w, result, body, &f);
}

int carom_body_set_torque(struct carom_world *w, int body, const carom_v3_q40 *torque)
{
    struct carom_forces f;
    int result;

    if (!w || !torque) {
        return CAROM_ERR_NULL;
    }
    result = find_forces(w, &body, &f);
    f.torque = *torque;
    return set_forces(w, result, body, &f);
}

int carom_body_set_gravity_scale(struct carom_world *w, int body, int32_t scale_q16)
{
    struct carom_forces f;
    int result;

    if (!w) {
        return CAROM_ERR_NULL;
    }
    result = find_forces(w, &body, &f);
    f.gravity_scale_q16 = scale_q16;
    return set_forces(w, result, body, &f);
}

int carom_body_set_damping(struct carom_world *w, int body, int32_t linear_q30, int32_t angular_q30)
{
    struct carom_forces f;
    int result;

    if (!w) {
        return CAROM_ERR_NULL;
    }
    result = find_forces(w, &body, &f);
    f.linear_damping_q30 = linear_q30;
    f.angular_damping_q30 = angular_q30;
    return set_forces(w, result, body, &f);
}

bool world_cross_q40(int64_t a_q32, int64_t b_q40, int64_t c_q32, int64_t d_q40, int64_t *out)
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

/* point x v about a body's centre. Returns false if the point or the product is out of range. */
static bool moment_about(const struct body_state *s, const carom_v3_q32 *point,
                         const carom_v3_q40 *v, carom_v3_q40 *out)
{
    int64_t arm_q32[3];

    if (!world_position_in_range(point)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        arm_q32[k] = point->c[k] - s->position.c[k];
    }
    for (int k = 0; k < 3; k++) {
        int i = fix_next(k), j = fix_next(i);

        if (!world_cross_q40(arm_q32[i], v->c[j], arm_q32[j], v->c[i], &out->c[k])) {
            return false;
        }
    }
    return true;
}

int carom_body_set_force_at(struct carom_world *w, int body, const carom_v3_q40 *force,
                            const carom_v3_q32 *point)
{
    struct carom_forces f;
    int result;

    if (!w || !force || !point) {
        return CAROM_ERR_NULL;
    }
    result = find_forces(w, &body, &f);
    if (result == CAROM_OK) {
        const struct body *b = &w->bodies[body];

        /* no more than what, with gravity, makes an acceleration of 1 */
        if (!world_each_within(force->c, fix_mul_scaled((int64_t)2 << 40, b->def.mass)) ||
            !moment_about(&world_now(w)->bodies[body], point, force, &f.torque)) {
            return CAROM_ERR_RANGE;
        }
        f.force = *force;
    }
    return set_forces(w, result, body, &f);
}

/* Check a push. Returns CAROM_OK or the error. */
static int check_push(const struct carom_world *w, int *body)
{
    if (!world_find_body(w, body)) {
        return CAROM_ERR_BODY;
    }
    return w->bodies[*body].def.moving && !world_now(w)->bodies[*body].out
               ? CAROM_OK
               : (int)CAROM_ERR_ARGUMENT;
}

/* Add an impulse and a moment to the momenta of a body; NULL: none. */
static int push(struct carom_world *w, int body, const carom_v3_q40 *impulse,
                const carom_v3_q40 *moment)
{
    const struct body *b = &w->bodies[body];
    struct body_state pushed = world_now(w)->bodies[body];
    static const carom_v3_q40 none = {{0, 0, 0}};

    impulse = impulse ? impulse : &none;
    moment = moment ? moment : &none;
    /* at most what reverses a body's fastest motion: below 2^57, and 2^62 */
    if (!world_each_within(impulse->c,
                           fix_mul_scaled((int64_t)BODY_SPEED_LIMIT << 41, b->def.mass)) ||
        !world_each_within(moment->c, 2 * world_most_angular_q40(b))) {
        return CAROM_ERR_RANGE;
    }
    for (int k = 0; k < 3; k++) {
        pushed.momentum.c[k] += impulse->c[k];
        pushed.angular.c[k] += moment->c[k];
    }
    if (!world_momenta_in_range(b, &pushed)) {
        return CAROM_ERR_RANGE;
    }
    world_now(w)->bodies[body] = pushed;
    world_wake_island(w, (uint32_t)body);
    return CAROM_OK;
}

int carom_body_push(struct carom_world *w, int body, const carom_v3_q40 *impulse,
                    const carom_v3_q32 *point)
{
    carom_v3_q40 moment;
    int result;

    if (!w || !impulse || !point) {
        return CAROM_ERR_NULL;
    }
    result = check_push(w, &body);
    if (result < 0) {
        return result;
    }
    if (!world_each_within(impulse->c, fix_mul_scaled((int64_t)BODY_SPEED_LIMIT << 41,
                                                      w->bodies[body].def.mass)) ||
        !moment_about(&world_now(w)->bodies[body], point, impulse, &moment)) {
        return CAROM_ERR_RANGE;
    }
    return push(w, body, impulse, &moment);
}

int carom_body_push_centre(struct carom_world *w, int body, const carom_v3_q40 *impulse)
{
    int result = w && impulse ? check_push(w, &body) : CAROM_ERR_NULL;

    return result < 0 ? result : push(w, body, impulse, NULL);
}

int carom_body_twist(struct carom_world *w, int body, const carom_v3_q40 *angular)
{
    int result = w && angular ? check_push(w, &body) : CAROM_ERR_NULL;

    return result < 0 ? result : push(w, body, NULL, angular);
}
