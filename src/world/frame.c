/* SPDX-License-Identifier: MIT */
/*
 * Points and vectors of a body: between its mesh's coordinates and the world's; velocities of
 * points.
 */
#include "world.h"

#define LOCAL_LIMIT  ((int64_t)2 * BODY_WORLD_LIMIT << 32)
#define VECTOR_LIMIT (((int64_t)1 << 60) - 1)

static void axes_of(const struct carom_world *w, int body, carom_m3_q30 *r)
{
    fix_matrix(r, &world_now(w)->bodies[body].rotation);
}

/* Check a question about a body, and turn it into its number. Returns CAROM_OK or the error. */
static int ask(const struct carom_world *w, int *body, const void *in, const void *out)
{
    if (!w || !in || !out) {
        return CAROM_ERR_NULL;
    }
    return world_find_body(w, body) ? CAROM_OK : (int)CAROM_ERR_BODY;
}

int carom_body_matrix(const struct carom_world *w, int body, struct carom_matrix *matrix)
{
    int result = ask(w, &body, matrix, matrix);

    if (result == CAROM_OK) {
        const carom_v3_q22 *centre = &w->bodies[body].def.mesh->mass.centre;

        axes_of(w, body, &matrix->r);
        for (int k = 0; k < 3; k++) {
            matrix->origin.c[k] = world_now(w)->bodies[body].position.c[k] -
                                  carom_round(carom_dot(matrix->r.c[k], centre->c), 20);
        }
    }
    return result;
}

int carom_body_world_point(const struct carom_world *w, int body, const carom_v3_q32 *local,
                           carom_v3_q32 *point)
{
    int64_t arm_q32[3];
    carom_m3_q30 r;
    int result = ask(w, &body, local, point);

    if (result < 0) {
        return result;
    }
    if (!world_each_within(local->c, LOCAL_LIMIT)) {
        return CAROM_ERR_RANGE;
    }
    axes_of(w, body, &r);
    for (int k = 0; k < 3; k++) {
        arm_q32[k] = local->c[k] - carom_shl(w->bodies[body].def.mesh->mass.centre.c[k], 10);
    }
    fix_rotate(arm_q32, &r, arm_q32);
    for (int k = 0; k < 3; k++) {
        point->c[k] = world_now(w)->bodies[body].position.c[k] + arm_q32[k];
    }
    return CAROM_OK;
}

int carom_body_local_point(const struct carom_world *w, int body, const carom_v3_q32 *point,
                           carom_v3_q32 *local)
{
    int64_t arm_q32[3];
    carom_m3_q30 r;
    int result = ask(w, &body, point, local);

    if (result < 0) {
        return result;
    }
    if (!world_each_within(point->c, LOCAL_LIMIT)) {
        return CAROM_ERR_RANGE;
    }
    axes_of(w, body, &r);
    for (int k = 0; k < 3; k++) {
        arm_q32[k] = point->c[k] - world_now(w)->bodies[body].position.c[k];
    }
    fix_rotate_back(arm_q32, &r, arm_q32);
    for (int k = 0; k < 3; k++) {
        local->c[k] = arm_q32[k] + carom_shl(w->bodies[body].def.mesh->mass.centre.c[k], 10);
    }
    return CAROM_OK;
}

/* Rotate a vector, or rotate it back. */
static int turn(const struct carom_world *w, int body, const int64_t in[3], int64_t out[3],
                void (*by)(int64_t[3], const carom_m3_q30 *, const int64_t[3]))
{
    carom_m3_q30 r;
    int result = ask(w, &body, in, out);

    if (result == CAROM_OK && !world_each_within(in, VECTOR_LIMIT)) {
        result = CAROM_ERR_RANGE;
    }
    if (result == CAROM_OK) {
        axes_of(w, body, &r);
        by(out, &r, in);
    }
    return result;
}

int carom_body_world_vector(const struct carom_world *w, int body, const int64_t vector[3],
                            int64_t out[3])
{
    return turn(w, body, vector, out, fix_rotate);
}

int carom_body_local_vector(const struct carom_world *w, int body, const int64_t vector[3],
                            int64_t out[3])
{
    return turn(w, body, vector, out, fix_rotate_back);
}

int carom_body_velocity_at(const struct carom_world *w, int body, const carom_v3_q32 *point,
                           carom_v3_q40 *velocity)
{
    const struct body_state *s;
    carom_v3_q40 v, spin;
    int64_t arm_q32[3], turn_q40[3];
    int result = ask(w, &body, point, velocity);

    if (result < 0) {
        return result;
    }
    if (!world_position_in_range(point)) {
        return CAROM_ERR_RANGE;
    }
    s = &world_now(w)->bodies[body];
    world_motion(&w->bodies[body], s, &v, &spin);
    for (int k = 0; k < 3; k++) {
        arm_q32[k] = point->c[k] - s->position.c[k];
    }
    for (int k = 0; k < 3; k++) {
        int i = fix_next(k), j = fix_next(i);

        if (!world_cross_q40(arm_q32[j], spin.c[i], arm_q32[i], spin.c[j], &turn_q40[k])) {
            return CAROM_ERR_RANGE; /* far from a body that spins faster than any can be made to */
        }
    }
    for (int k = 0; k < 3; k++) {
        velocity->c[k] = v.c[k] + turn_q40[k];
    }
    return CAROM_OK;
}
