/* SPDX-License-Identifier: MIT */
#include "body.h"

/*
 * (high 2^bits + low) / 2^s to nearest; |high|, |low| < 2^63. Either part alone may not fit where the
 * sum does, so they are added modulo 2^64.
 */
static int64_t shift_parts(int64_t high, int64_t low, int bits, int s)
{
    if (s > bits) {
        /* what low has below 2^bits cannot carry past the half */
        return s - bits > 62 ? 0 : carom_round(high + (low >> bits), s - bits);
    }
    if (s < 1) {
        return (int64_t)(((uint64_t)carom_shl(high, bits) + (uint64_t)low) << -s);
    }
    return (int64_t)((uint64_t)carom_shl(high, bits - s) + (uint64_t)carom_round(low, s));
}

/* out = m v in plain integers: three products of at most 30 and 31 bits stay below 2^63. */
static inline void sym3_dot(int64_t out[3], const int32_t m[6], const int32_t v[3])
{
    const int32_t x = v[0], y = v[1], z = v[2];

    out[0] = (int64_t)m[0] * x + (int64_t)m[3] * y + (int64_t)m[5] * z;
    out[1] = (int64_t)m[3] * x + (int64_t)m[1] * y + (int64_t)m[4] * z;
    out[2] = (int64_t)m[5] * x + (int64_t)m[4] * y + (int64_t)m[2] * z;
}

/* v = high 2^31 + low */
static inline void split(const int64_t v[3], int32_t high[3], int32_t low[3])
{
    for (int k = 0; k < 3; k++) {
        CAROM_ASSERT(carom_abs(v[k]) < (int64_t)1 << 62);
        high[k] = (int32_t)(v[k] >> 31);
        low[k] = (int32_t)(v[k] & INT32_MAX);
    }
}

static void add_parts(int64_t out[3], const int32_t m[6], const int32_t high[3],
                      const int32_t low[3], int s)
{
    int64_t sum[3], small[3];

    sym3_dot(sum, m, high);
    sym3_dot(small, m, low);
    for (int k = 0; k < 3; k++) {
        out[k] = (int64_t)((uint64_t)out[k] + (uint64_t)shift_parts(sum[k], small[k], 31, s));
    }
}

void body_sym3_mul(int64_t out[3], const struct carom_sym3 *m, const int64_t v[3])
{
    int32_t high[3], low[3];

    split(v, high, low);
    out[0] = out[1] = out[2] = 0;
    add_parts(out, m->m, high, low, m->e);
}

/* out = J^-1 v with all the digits of the inverse; out may be v. */
static void inverse_mul(const struct body *b, int64_t out[3], const int64_t v[3])
{
    const struct carom_mesh *mesh = b->mesh;
    int32_t high[3], low[3];

    split(v, high, low);
    out[0] = out[1] = out[2] = 0;
    add_parts(out, mesh->inverse.m, high, low, mesh->inverse.e);
    add_parts(out, mesh->inverse_rest.m, high, low, mesh->inverse_rest.e);
}

/*
 * |w| <= |L| n / m, n being the largest sum of a row of J^-1: an L below m / 2n turns by less than
 * half a radian. The sums have 32 bits at most, and 2^-20 is taken off for roundings.
 */
static uint64_t calm_angular_q40(const struct body *b)
{
    const struct carom_sym3 *inverse = &b->mesh->inverse;
    int64_t most = 1, quotient;
    int shift;

    for (int i = 0; i < 3; i++) {
        int64_t sum = 2;

        for (int k = 0; k < 3; k++) {
            sum += carom_abs(inverse->m[fix_sym3_at[i][k]]);
        }
        most = sum > most ? sum : most;
    }
    /* m / 2n = quotient 2^-32 2^(n.e - m.e - 1), in q40 */
    quotient = ((int64_t)b->mass.m << 32) / most;
    quotient -= quotient >> 20;
    shift = inverse->e - b->mass.e - 1 - 32 + 40;
    if (shift > 60 - fix_bits((uint64_t)quotient)) {
        return (uint64_t)1 << 60;
    }
    return shift > -62 ? (uint64_t)fix_shift(quotient, shift) : 0;
}

void body_set_mass(struct body *b, struct fix_scaled mass)
{
    b->mass = mass;
    b->inverse_mass = fix_scaled_inverse(mass);
    /* |v| <= |p| / m, a 64th off for roundings */
    b->calm_momentum_q40 = (uint64_t)fix_mul_scaled((int64_t)(BODY_SPEED_LIMIT - 1) << 40, mass);
    b->calm_angular_q40 = calm_angular_q40(b);
}

void body_velocity(const struct body *b, const struct body_state *s, carom_v3_q40 *v)
{
    for (int k = 0; k < 3; k++) {
        v->c[k] = b->moving ? fix_mul_scaled(s->momentum.c[k], b->inverse_mass) : 0;
    }
}

/* R^T L / m: the angular momentum in the body's axes, divided by the mass. */
static void angular_in_body(const struct body *b, const struct body_state *s, const carom_m3_q30 *r,
                            int64_t out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = fix_mul_scaled(s->angular.c[k], b->inverse_mass);
    }
    fix_rotate_back(out, r, out);
}

void body_spin(const struct body *b, const struct body_state *s, const carom_m3_q30 *r,
               carom_v3_q40 *w)
{
    *w = (carom_v3_q40){{0, 0, 0}};
    if (!b->moving) {
        return;
    }
    if (!body_spin_fits(b, s, r)) {
        body_spin_most(s, w);
        return;
    }
    angular_in_body(b, s, r, w->c);
    inverse_mul(b, w->c, w->c);
    fix_rotate(w->c, r, w->c);
}

void body_set_motion(const struct body *b, struct body_state *s, const carom_v3_q40 *v,
                     const carom_v3_q40 *w)
{
    carom_m3_q30 r;
    int64_t l[3];

    body_matrix(&r, &s->rotation);
    fix_rotate_back(l, &r, w->c);
    body_sym3_mul(l, &b->mesh->mass.inertia, l);
    fix_rotate(l, &r, l);
    for (int k = 0; k < 3; k++) {
        s->momentum.c[k] = fix_mul_scaled(v->c[k], b->mass);
        s->angular.c[k] = fix_mul_scaled(l[k], b->mass);
    }
}

struct fix_wide body_kinetic2(const struct body *b, const struct body_state *s,
                              const carom_m3_q30 *r)
{
    carom_v3_q40 v, w;
    struct fix_wide sum = {0, 0};

    body_velocity(b, s, &v);
    body_spin(b, s, r, &w);
    for (int k = 0; k < 3; k++) {
        fix_wide_add_product(&sum, s->momentum.c[k], v.c[k]);
        fix_wide_add_product(&sum, s->angular.c[k], w.c[k]);
    }
    return sum;
}

/*
 * p.v + L.w is at most |p| |v| + |L| |w|. |v| is |p| / m, and an L of no more than 2^-n of the calm
 * one turns by less than 2^-n half radians: see calm_angular_q40, which also leaves room for roundings.
 */
struct fix_wide body_kinetic2_most(const struct body *b, const struct body_state *s)
{
    uint64_t p_q40 = fix_sum(s->momentum.c), l_q40 = fix_sum(s->angular.c);
    int64_t speed_q40;
    int n;

    if (!b->moving || (p_q40 | l_q40) == 0) {
        return (struct fix_wide){0, 0};
    }
    if (!body_calm(b, s)) {
        return (struct fix_wide){INT64_MAX >> 20, 0}; /* far more than any has */
    }
    speed_q40 = fix_mul_scaled((int64_t)p_q40, b->inverse_mass);
    speed_q40 += (speed_q40 >> 20) + 1;
    n = fix_bits(b->calm_angular_q40) - 1 - fix_bits(l_q40);
    return fix_wide_add(fix_wide_mul((int64_t)p_q40, speed_q40),
                        fix_wide_mul((int64_t)l_q40, n < 39 ? (int64_t)1 << (39 - n) : 1));
}

struct fix_wide body_lift2(const struct body *b)
{
    int64_t weight_q40 = fix_mul_scaled(b->acceleration_q40, b->mass);

    return fix_wide_mul(weight_q40 / 10 * 3, (int64_t)b->skin_q22 << 18);
}

void body_world_inertia(const struct body *b, const carom_m3_q30 *r, struct carom_sym3 *out)
{
    static const uint8_t row[6] = {0, 1, 2, 0, 1, 2}, col[6] = {0, 1, 2, 1, 2, 0};
    struct carom_sym3 whole = b->mesh->mass.inertia;

    whole.e = 1; /* as plain integers, doubled below */
    for (int n = 0; n < 6; n++) {
        int64_t axis[3];

        /* entry (i, k) is row i of R times J times row k of R */
        for (int k = 0; k < 3; k++) {
            axis[k] = r->c[col[n]][k];
        }
        body_sym3_mul(axis, &whole, axis);
        out->m[n] = 0;
        for (int k = 0; k < 3; k++) {
            out->m[n] += (int32_t)fix_mul(axis[k], r->c[row[n]][k], 59);
        }
    }
    out->e = b->mesh->mass.inertia.e;
}

void body_matrix(carom_m3_q30 *m, const carom_quat_q30 *q)
{
    int64_t w = q->c[0], x = q->c[1], y = q->c[2], z = q->c[3];

    /* twice each product: a shift of 29 in place of 30 */
    m->c[0][0] = (int32_t)(CAROM_ONE_Q30 - carom_round(y * y + z * z, 29));
    m->c[1][1] = (int32_t)(CAROM_ONE_Q30 - carom_round(x * x + z * z, 29));
    m->c[2][2] = (int32_t)(CAROM_ONE_Q30 - carom_round(x * x + y * y, 29));
    m->c[0][1] = (int32_t)carom_round(x * y - w * z, 29);
    m->c[1][0] = (int32_t)carom_round(x * y + w * z, 29);
    m->c[0][2] = (int32_t)carom_round(x * z + w * y, 29);
    m->c[2][0] = (int32_t)carom_round(x * z - w * y, 29);
    m->c[1][2] = (int32_t)carom_round(y * z - w * x, 29);
    m->c[2][1] = (int32_t)carom_round(y * z + w * x, 29);
}

void body_normalise(carom_quat_q30 *q)
{
    for (int step = 0; step < 3; step++) {
        int64_t n_q60 = 0;
        int32_t half_q30;

        for (int k = 0; k < 4; k++) {
            n_q60 += (int64_t)q->c[k] * q->c[k];
        }
        /* q (3 - |q|^2) / 2 as q + q (1 - |q|^2) / 2: the correction is small and rounds well */
        half_q30 = (int32_t)carom_round(((int64_t)1 << 60) - n_q60, 31);
        for (int k = 0; k < 4; k++) {
            q->c[k] += carom_mul_q30(q->c[k], half_q30);
        }
    }
}

/* out = q (1, u), normalised: q turned by Cayley(u) in the body's axes. */
static void turn(carom_quat_q30 *out, const carom_quat_q30 *q, const int32_t u[3])
{
    int64_t w = q->c[0], x = q->c[1], y = q->c[2], z = q->c[3];

    /*
     * A slice turns by half a radian at the spin of its start; the midpoint's may be more, but
     * |u| <= 0.25 + |u|^2 / sqrt 3 by the triangle inequality of inertias, so |u| <= 0.31 and the
     * length of the product is at most 1.05.
     */
    out->c[0] = q->c[0] + (int32_t)carom_round(-x * u[0] - y * u[1] - z * u[2], 30);
    out->c[1] = q->c[1] + (int32_t)carom_round(w * u[0] + y * u[2] - z * u[1], 30);
    out->c[2] = q->c[2] + (int32_t)carom_round(w * u[1] + z * u[0] - x * u[2], 30);
    out->c[3] = q->c[3] + (int32_t)carom_round(w * u[2] + x * u[1] - y * u[0], 30);
    body_normalise(out);
}

/* A vector of 60 bits in parts, high 2^bits + low. */
struct parts {
    int32_t high[3], low[3];
};

static inline struct parts parts_of(const int64_t v[3], int bits)
{
    struct parts p;

    for (int k = 0; k < 3; k++) {
        p.high[k] = (int32_t)(v[k] >> bits);
        p.low[k] = (int32_t)(v[k] & (((int64_t)1 << bits) - 1));
    }
    return p;
}

/*
 * out = J^-1 m / 2^s, m = high 2^31 + low below 2^61, to within a unit or two. The inverse is
 * inertia + rest 2^-29: of the rest only the product with the upper parts counts. A quarter of the low
 * product is below 2^61, that of the rest below 2^62.
 */
static void inverse_mul_parts(const struct body *b, int64_t out[3], const struct parts *m, int s)
{
    const struct carom_sym3 *inverse = &b->mesh->inverse, *of_rest = &b->mesh->inverse_rest;
    int64_t high[3], low[3], rest[3];

    CAROM_ASSERT(of_rest->e == inverse->e + 29);
    const int more = s - 2 - 29;
    const int64_t half = more > 0 && more < 63 ? (int64_t)1 << (more - 1) : 0;

    sym3_dot(high, inverse->m, m->high);
    sym3_dot(low, inverse->m, m->low);
    sym3_dot(rest, of_rest->m, m->high);
    for (int k = 0; k < 3; k++) {
        rest[k] += low[k] >> 2;
        out[k] = half != 0 ? (high[k] + (rest[k] >> 29) + half) >> more
                           : shift_parts(high[k], rest[k], 29, s - 2);
    }
}

/* Component m_i u_j - m_j u_i of m x u in the format of m; m has 31 bits in its low parts, u 30. */
static inline int64_t cross_part(const struct parts *m, const struct parts *u, int i, int j)
{
    int64_t low = (int64_t)m->high[i] * u->low[j] - (int64_t)m->high[j] * u->low[i];

    low = 2 * low + (int64_t)m->low[i] * u->high[j] - (int64_t)m->low[j] * u->high[i];
    return 2 * ((int64_t)m->high[i] * u->high[j] - (int64_t)m->high[j] * u->high[i]) +
           carom_round(low, 30);
}

/*
 * The Cayley vector of a torque-free turn over tau: the implicit midpoint rule u = J^-1 m with
 * m = b + m x u, b being tau/2 times the angular momentum in the body's axes. It keeps kinetic energy
 * for any step. Each round gains two bits or more; done when q30 no longer changes.
 *
 * m is scaled up to 60 bits and u has q60: along the axis of a thin body J^-1 is up to 2^24 times as
 * large as across it, and so is the error of m there that rounding u across it makes.
 */
static void cayley(const struct body *b, const int64_t l_q40[3], int32_t tau_q30, carom_v3_q30 *u)
{
    int64_t start[3], m[3], u_q60[3] = {0, 0, 0};
    uint64_t all = 0;
    int up;

    for (int k = 0; k < 3; k++) {
        all |= (uint64_t)carom_abs(l_q40[k]);
    }
    up = 60 - fix_bits(all);
    up = up < 0 ? 0 : up;
    for (int k = 0; k < 3; k++) {
        m[k] = start[k] = fix_mul(carom_shl(l_q40[k], up), tau_q30, 31);
    }
    for (int round = 0; round < 20; round++) {
        int64_t next[3], change = 0;
        struct parts of_m = parts_of(m, 31), of_u;

        inverse_mul_parts(b, next, &of_m, b->mesh->inverse.e + 40 + up - 60);
        for (int k = 0; k < 3; k++) {
            int64_t d = next[k] - u_q60[k];

            change |= d ^ (d >> 63); /* |d|, or one less */
            u_q60[k] = next[k];
        }
        if (change < (int64_t)1 << 27) {
            break;
        }
        of_u = parts_of(u_q60, 30);
        m[0] = start[0] + cross_part(&of_m, &of_u, 1, 2);
        m[1] = start[1] + cross_part(&of_m, &of_u, 2, 0);
        m[2] = start[2] + cross_part(&of_m, &of_u, 0, 1);
    }
    for (int k = 0; k < 3; k++) {
        u->c[k] = (int32_t)carom_round(u_q60[k], 30);
    }
}

void body_place_origin(struct body *b, const struct body_state *s)
{
    struct body_path *path = &b->path;

    for (int k = 0; k < 3; k++) {
        path->origin_q22[k] = carom_round(s->position.c[k], 10);
        path->start.x.c[k] = (int16_t)(s->position.c[k] - carom_shl(path->origin_q22[k], 10));
    }
}

void body_place(struct body *b, const struct body_state *s)
{
    struct body_path *path = &b->path;

    body_place_origin(b, s);
    for (int k = 0; k < 3; k++) {
        path->v.c[k] = path->g.c[k] = 0;
        path->u.c[k] = 0;
    }
    path->u2_q30 = 0;
    path->turns = false;
    path->q = s->rotation;
    body_matrix(&path->start.r, &s->rotation);
}

void body_predict(struct body *b, const struct body_state *s, int32_t tau_q30,
                  const carom_v3_q40 *gravity)
{
    struct body_path *path = &b->path;
    carom_v3_q40 v;
    int64_t l[3];

    body_place(b, s);
    if (!b->moving || s->asleep || s->out) {
        return;
    }
    body_velocity(b, s, &v);
    for (int k = 0; k < 3; k++) {
        path->v.c[k] = fix_mul_q30(v.c[k], tau_q30);
        if (gravity && gravity->c[k] != 0) {
            path->g.c[k] = fix_mul(fix_mul_q30(gravity->c[k], tau_q30), tau_q30, 31);
        }
    }
    if ((s->angular.c[0] | s->angular.c[1] | s->angular.c[2]) != 0) {
        angular_in_body(b, s, &path->start.r, l);
        cayley(b, l, tau_q30, &path->u);
        path->u2_q30 = (int32_t)carom_round(carom_dot(path->u.c, path->u.c), 30);
        path->turns = (path->u.c[0] | path->u.c[1] | path->u.c[2]) != 0;
    }
}

int32_t body_slice(const struct body *b, const struct body_state *s, int32_t tau_q30)
{
    carom_m3_q30 r;
    carom_v3_q40 w;
    int64_t rate_q40, turn_q40;

    if (body_calm(b, s)) {
        return tau_q30;
    }
    body_matrix(&r, &s->rotation);
    body_spin(b, s, &r, &w);
    rate_q40 = fix_length(w.c);
    turn_q40 = fix_mul_q30(rate_q40, tau_q30);
    if (turn_q40 <= (int64_t)BODY_TURN_MAX_Q30 << 10) {
        return tau_q30;
    }
    /* rate > 1/2 rad a frame here, so the quotient is below 2^30 */
    return (int32_t)((((int64_t)BODY_TURN_MAX_Q30 << 30)) / (rate_q40 >> 10));
}

void body_turned(const carom_quat_q30 *q, const carom_v3_q30 *u, carom_m3_q30 *r)
{
    carom_quat_q30 turned;

    turn(&turned, q, u->c);
    body_matrix(r, &turned);
}

carom_v3_q32 body_way_at(const struct body *b, int32_t t_q30)
{
    const struct body_path *path = &b->path;
    carom_v3_q32 way;

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
    const struct body_path *path = &b->path;
    carom_quat_q30 q = path->q;
    int32_t u[3];

    if (path->turns && t_q30 > 0) {
        for (int k = 0; k < 3; k++) {
            u[k] = carom_mul_q30(path->u.c[k], t_q30);
        }
        turn(&q, &path->q, u);
    }
    return q;
}

void body_advance(const struct body *b, struct body_state *s, int32_t t_q30, int32_t tau_q30,
                  const carom_v3_q40 *gravity)
{
    carom_v3_q32 way = body_way_at(b, t_q30);

    for (int k = 0; k < 3; k++) {
        s->position.c[k] += way.c[k];
        if (gravity && gravity->c[k] != 0) {
            int64_t dv_q40 = fix_mul_q30(fix_mul_q30(gravity->c[k], tau_q30), t_q30);

            s->momentum.c[k] += fix_mul_scaled(dv_q40, b->mass);
        }
    }
    s->rotation = body_rotation_at(b, t_q30);
}

void body_path_length(const struct body *b, int32_t t_q30, int64_t *way_q22, int64_t *turn_q30)
{
    const struct body_path *path = &b->path;
    int64_t way_q40 = fix_length_bound(path->v.c) + fix_length_bound(path->g.c);
    int64_t u_q30 = path->turns ? fix_sqrt_above((uint64_t)(path->u2_q30 + 1) << 30) : 0;

    /* turned: 2 atan |u| <= 2 |u| */
    *turn_q30 = fix_mul_q30(2 * u_q30, t_q30) + 1;
    *way_q22 = (fix_mul_q30(way_q40, t_q30) >> 18) + fix_mul_q30(*turn_q30, b->radius_q22) + 2;
}
