/* SPDX-License-Identifier: MIT */
/* The path of a body over a slice: a parabola and a Cayley rotation. */
#include "body.h"

void body_turn(carom_quat_q30 *out, const carom_quat_q30 *q, const int32_t u[3])
{
    const int32_t *v = &q->c[1];

    /*
     * A slice turns by half a radian at the spin of its start; the midpoint's may be more, but
     * |u| <= 0.25 + |u|^2 / sqrt 3 by the triangle inequality of inertias, so |u| <= 0.31 and the
     * length of the product is at most 1.05.
     */
    out->c[0] = q->c[0] + (int32_t)carom_round(-carom_dot(v, u), 30);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        int i = fix_next(k), j = fix_next(i);
        int64_t part = (int64_t)q->c[0] * u[k] + (int64_t)v[i] * u[j] - (int64_t)v[j] * u[i];

        out->c[1 + k] = v[k] + (int32_t)carom_round(part, 30);
    }
    body_normalise(out);
}

/* A vector of 60 bits in two parts, high 2^bits + low. */
struct parts {
    int32_t high[3], low[3];
};

static inline struct parts parts_of(const int64_t v[3], int bits)
{
    struct parts p;

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        p.high[k] = (int32_t)(v[k] >> bits);
        p.low[k] = (int32_t)(v[k] & (((int64_t)1 << bits) - 1));
    }
    return p;
}

/*
 * out = J^-1 m / 2^s, m = high 2^31 + low below 2^61, to within a unit or two. The inverse is
 * that of the mesh plus rest 2^-29; for the rest only the product with the upper parts counts. A
 * quarter of the low product is below 2^61, that of the rest below 2^62.
 */
static void inverse_mul_parts(const struct body *b, int64_t out[3], const struct parts *m, int s)
{
    const struct carom_sym3 *inverse = &b->def.mesh->inverse, *of_rest = &b->def.mesh->inverse_rest;
    int64_t high[3], low[3], rest[3];

    CAROM_ASSERT(of_rest->e == inverse->e + 29);
    const int more = s - 2 - 29;
    const int64_t half = more > 0 && more < 63 ? (int64_t)1 << (more - 1) : 0;

    fix_sym3_dot(high, inverse->m, m->high);
    fix_sym3_dot(low, inverse->m, m->low);
    fix_sym3_dot(rest, of_rest->m, m->high);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        rest[k] += low[k] >> 2;
        out[k] = half != 0 ? (high[k] + (rest[k] >> 29) + half) >> more
                           : fix_round_parts(high[k], rest[k], 29, s - 2);
    }
}

/* Component m_i u_j - m_j u_i of m x u in the format of m; m's low parts have 31 bits, u's 30. */
FIX_APART static int64_t cross_part(const struct parts *m, const struct parts *u, int i, int j)
{
    int64_t low = (int64_t)m->high[i] * u->low[j] - (int64_t)m->high[j] * u->low[i];

    low = 2 * low + (int64_t)m->low[i] * u->high[j] - (int64_t)m->low[j] * u->high[i];
    return 2 * ((int64_t)m->high[i] * u->high[j] - (int64_t)m->high[j] * u->high[i]) +
           carom_round(low, 30);
}

/*
 * The Cayley vector of a torque-free turn over tau, by the implicit midpoint rule: u = J^-1 m with
 * m = b + m x u, b being tau/2 times the angular momentum in the body's axes. It keeps kinetic
 * energy for any step. Each round gains two bits or more; done when q30 no longer changes.
 *
 * m is scaled up to 60 bits and u has q60: along the axis of a thin body J^-1 is up to 2^24 times
 * as large as across it, and so is the effect of an error of m that rounding u across the axis
 * makes.
 */
static void cayley(const struct body *b, const int64_t l_q40[3], int32_t tau_q30, carom_v3_q30 *u)
{
    int64_t start[3], m[3], u_q60[3] = {0, 0, 0};
    int up;

    up = 60 - fix_bits3(l_q40);
    up = up < 0 ? 0 : up;
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        m[k] = start[k] = fix_mul(carom_shl(l_q40[k], up), tau_q30, 31);
    }
    for (int round = 0; round < 20; round++) {
        int64_t next[3], change = 0;
        struct parts of_m = parts_of(m, 31), of_u;

        inverse_mul_parts(b, next, &of_m, b->def.mesh->inverse.e + 40 + up - 60);
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            int64_t d = next[k] - u_q60[k];

            change |= d ^ (d >> 63); /* |d|, or |d| - 1 */
            u_q60[k] = next[k];
        }
        if (change < (int64_t)1 << 27) {
            break;
        }
        of_u = parts_of(u_q60, 30);
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            m[k] = start[k] + cross_part(&of_m, &of_u, fix_next(k), fix_next(fix_next(k)));
        }
    }
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        u->c[k] = (int32_t)carom_round(u_q60[k], 30);
    }
}

void body_place_origin(struct body *b, const struct body_state *s)
{
    struct body_path *path = &b->path;

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        path->origin_q22[k] = carom_round(s->position.c[k], 10);
        path->start_x_q32[k] = (int16_t)(s->position.c[k] - carom_shl(path->origin_q22[k], 10));
    }
    PHASE_BEGIN(path->phase, BODY_ORIGIN);
}

void body_place(struct body *b, const struct body_state *s)
{
    struct body_path *path = &b->path;

    body_place_origin(b, s);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        path->v.c[k] = path->g.c[k] = 0;
        path->u.c[k] = 0;
    }
    PHASE_BEGIN(path->phase, BODY_PATH);
    path->u2_q30 = path->c_q30 = 0;
    path->turns = false;
    path->q = s->rotation;
    fix_matrix(&path->start.r, &s->rotation);
}

void body_predict(struct body *b, const struct body_state *s, int32_t tau_q30,
                  const carom_v3_q40 *gravity)
{
    struct body_path *path = &b->path;
    carom_v3_q40 v;
    int64_t l[3];

    body_place(b, s);
    if (!b->def.moving || s->asleep || s->out) {
        return;
    }
    body_velocity(b, s, &v);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        path->v.c[k] = fix_mul_q30(v.c[k], tau_q30);
        if (gravity && gravity->c[k] != 0) {
            path->g.c[k] = fix_mul(fix_mul_q30(gravity->c[k], tau_q30), tau_q30, 31);
        }
    }
    if ((s->angular.c[0] | s->angular.c[1] | s->angular.c[2]) != 0) {
        body_angular(b, s, &path->start.r, l);
        cayley(b, l, tau_q30, &path->u);
        path->u2_q30 = (int32_t)carom_round(carom_dot(path->u.c, path->u.c), 30);
        path->turns = (path->u.c[0] | path->u.c[1] | path->u.c[2]) != 0;
    }
}

/*
 * (1, (p + w t) u) is (1, p u) times (1 + p w s^2 t / d, w t u / d), d = 1 + p^2 s^2, since all
 * turns are about one axis.
 */
void body_cut_path(struct body *b, const struct body_state *s, int32_t from_q30, int32_t to_q30)
{
    struct body_path *path = &b->path;
    struct body_state start = *s;
    carom_v3_q32 way = body_way_at(b, from_q30);
    int32_t part_q30 = to_q30 - from_q30, cut_q30;

    start.rotation = body_rotation_at(b, from_q30);
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        int64_t v = path->v.c[k] + 2 * fix_mul_q30(path->g.c[k], from_q30);

        start.position.c[k] += way.c[k];
        path->v.c[k] = fix_mul_q30(v, part_q30);
        path->g.c[k] = fix_mul_q30(fix_mul_q30(path->g.c[k], part_q30), part_q30);
    }
    body_place_origin(b, &start);
    PHASE_BEGIN(path->phase, BODY_PATH);
    path->q = start.rotation;
    fix_matrix(&path->start.r, &path->q);
    if (path->turns) {
        int32_t u2_q30 = path->u2_q30;

        /* w / d, d < 1.1 */
        cut_q30 = carom_mul_q30(u2_q30, carom_mul_q30(from_q30, from_q30));
        cut_q30 = (int32_t)(((int64_t)part_q30 << 30) / (CAROM_ONE_Q30 + cut_q30));
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            path->u.c[k] = carom_mul_q30(path->u.c[k], cut_q30);
        }
        path->u2_q30 = (int32_t)carom_round(carom_dot(path->u.c, path->u.c), 30);
        path->c_q30 = carom_mul_q30(u2_q30, carom_mul_q30(from_q30, cut_q30));
    }
}

int32_t body_slice(const struct body *b, const struct body_state *s, int32_t tau_q30)
{
    carom_m3_q30 r;
    carom_v3_q40 spin;
    int64_t rate_q40, turn_q40;

    if (body_calm(b, s)) {
        return tau_q30;
    }
    fix_matrix(&r, &s->rotation);
    body_spin(b, s, &r, &spin);
    rate_q40 = fix_length(spin.c);
    turn_q40 = fix_mul_q30(rate_q40, tau_q30);
    if (turn_q40 <= (int64_t)BODY_TURN_MAX_Q30 << 10) {
        return tau_q30;
    }
    /* the rate is above 1/2 rad a frame here, so the quotient is below 2^30 */
    return (int32_t)((((int64_t)BODY_TURN_MAX_Q30 << 30)) / (rate_q40 >> 10));
}

void body_turned(const carom_quat_q30 *q, const carom_v3_q30 *u, carom_m3_q30 *r)
{
    carom_quat_q30 turned;

    body_turn(&turned, q, u->c);
    fix_matrix(r, &turned);
}

carom_v3_q32 body_way_at(const struct body *b, int32_t t_q30)
{
    const struct body_path *path = body_path(b);
    carom_v3_q32 way;

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        int64_t way_q40 = path->v.c[k] + path->g.c[k];

        if (t_q30 < CAROM_ONE_Q30) {
            way_q40 = fix_mul_q30(path->v.c[k] + fix_mul_q30(path->g.c[k], t_q30), t_q30);
        }
        way.c[k] = carom_round(way_q40, 8);
    }
    return way;
}

carom_quat_q30 body_rotation_at(const struct body *b, int32_t t_q30)
{
    const struct body_path *path = body_path(b);
    carom_quat_q30 q = path->q;
    int32_t u[3];

    if (path->turns && t_q30 > 0) {
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            u[k] = carom_mul_q30(path->u.c[k], t_q30);
        }
        body_turn(&q, &path->q, u);
    }
    return q;
}

void body_advance(const struct body *b, struct body_state *s, int32_t t_q30, int32_t tau_q30,
                  const carom_v3_q40 *gravity)
{
    carom_v3_q32 way = body_way_at(b, t_q30);

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        s->position.c[k] += way.c[k];
        if (gravity && gravity->c[k] != 0) {
            int64_t dv_q40 = fix_mul_q30(fix_mul_q30(gravity->c[k], tau_q30), t_q30);

            s->momentum.c[k] += fix_mul_scaled(dv_q40, b->def.mass);
        }
    }
    s->rotation = body_rotation_at(b, t_q30);
}

void body_accelerate(const struct body *b, struct body_state *s, int32_t tau_q30)
{
    for (int k = 0; k < 3; k++) {
        s->momentum.c[k] +=
            fix_mul_scaled(fix_mul(b->def.acceleration.c[k], tau_q30, 30), b->def.mass);
    }
}

void body_path_length(const struct body *b, int32_t t_q30, int64_t *way_q22, int64_t *turn_q30)
{
    const struct body_path *path = body_path(b);
    int64_t way_q40 = fix_length_bound(path->v.c) + fix_length_bound(path->g.c);
    int64_t u_q30 = path->turns ? fix_sqrt_above((uint64_t)(path->u2_q30 + 1) << 30) : 0;

    /* the turn is 2 atan |u| <= 2 |u| */
    *turn_q30 = fix_mul_q30(2 * u_q30, t_q30) + 1;
    *way_q22 = (fix_mul_q30(way_q40, t_q30) >> 18) + fix_mul_q30(*turn_q30, b->def.radius_q22) + 2;
}
