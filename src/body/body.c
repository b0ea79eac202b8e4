/* SPDX-License-Identifier: MIT */
/* Mass, velocities, momenta and kinetic energy of a body. */
#include "body.h"

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

    fix_sym3_dot(sum, m, high);
    fix_sym3_dot(small, m, low);
    for (int k = 0; k < 3; k++) {
        out[k] = (int64_t)((uint64_t)out[k] + (uint64_t)fix_round_parts(sum[k], small[k], 31, s));
    }
}

void body_sym3_mul(int64_t out[3], const struct carom_sym3 *m, const int64_t v[3])
{
    int32_t high[3], low[3];

    split(v, high, low);
    out[0] = out[1] = out[2] = 0;
    add_parts(out, m->m, high, low, m->e);
}

/* out = J^-1 v with all digits of the inverse; out may be v. */
static void inverse_mul(const struct body *b, int64_t out[3], const int64_t v[3])
{
    const struct carom_mesh *mesh = b->def.mesh;
    int32_t high[3], low[3];

    split(v, high, low);
    out[0] = out[1] = out[2] = 0;
    add_parts(out, mesh->inverse.m, high, low, mesh->inverse.e);
    add_parts(out, mesh->inverse_rest.m, high, low, mesh->inverse_rest.e);
}

/*
 * The angular momentum below which a body is calm. |w| <= |L| n / m, n being the largest row sum of
 * J^-1, so an L below m / 2n turns by less than half a radian. Sums have at most 32 bits, and 2^-20
 * is subtracted for roundings.
 */
static uint64_t calm_angular_q40(const struct body *b)
{
    const struct carom_sym3 *inverse = &b->def.mesh->inverse;
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
    quotient = ((int64_t)b->def.mass.m << 32) / most;
    quotient -= quotient >> 20;
    shift = inverse->e - b->def.mass.e - 1 - 32 + 40;
    if (shift > 60 - fix_bits((uint64_t)quotient)) {
        return (uint64_t)1 << 60;
    }
    return shift > -62 ? (uint64_t)fix_shift(quotient, shift) : 0;
}

void body_set_mass(struct body *b, struct fix_scaled mass)
{
    b->def.mass = mass;
    b->def.inverse_mass = fix_scaled_inverse(mass);
    /* |v| <= |p| / m, with 1/64 to spare for roundings */
    b->def.calm_momentum_q40 =
        (uint64_t)fix_mul_scaled((int64_t)(BODY_SPEED_LIMIT - 1) << 40, mass);
    b->def.calm_angular_q40 = calm_angular_q40(b);
}

void body_velocity(const struct body *b, const struct body_state *s, carom_v3_q40 *v)
{
    *v = (carom_v3_q40){{0, 0, 0}};
    if (b->def.moving) {
        fix_mul_scaled3(v->c, s->momentum.c, b->def.inverse_mass);
    }
}

void body_angular(const struct body *b, const struct body_state *s, const carom_m3_q30 *r,
                  int64_t out[3])
{
    fix_mul_scaled3(out, s->angular.c, b->def.inverse_mass);
    fix_rotate_back(out, r, out);
}

void body_spin(const struct body *b, const struct body_state *s, const carom_m3_q30 *r,
               carom_v3_q40 *spin)
{
    *spin = (carom_v3_q40){{0, 0, 0}};
    if (!b->def.moving) {
        return;
    }
    if (!body_spin_fits(b, s, r)) {
        body_spin_most(s, spin);
        return;
    }
    body_angular(b, s, r, spin->c);
    inverse_mul(b, spin->c, spin->c);
    fix_rotate(spin->c, r, spin->c);
}

void body_set_motion(const struct body *b, struct body_state *s, const carom_v3_q40 *v,
                     const carom_v3_q40 *spin)
{
    carom_m3_q30 r;
    int64_t l[3];

    fix_matrix(&r, &s->rotation);
    fix_rotate_back(l, &r, spin->c);
    body_sym3_mul(l, &b->def.mesh->mass.inertia, l);
    fix_rotate(l, &r, l);
    for (int k = 0; k < 3; k++) {
        s->momentum.c[k] = fix_mul_scaled(v->c[k], b->def.mass);
        s->angular.c[k] = fix_mul_scaled(l[k], b->def.mass);
    }
}

void body_add_kinetic2(struct fix_wide *sum, const struct body *b, const struct body_state *s,
                       const carom_m3_q30 *r)
{
    carom_v3_q40 v, spin;

    body_velocity(b, s, &v);
    body_spin(b, s, r, &spin);
    fix_wide_add_dot(sum, s->momentum.c, v.c);
    fix_wide_add_dot(sum, s->angular.c, spin.c);
}

void body_add_kinetic2_of(struct fix_wide *sum, const struct body *b, const struct body_state *s)
{
    carom_m3_q30 r;

    fix_matrix(&r, &s->rotation);
    body_add_kinetic2(sum, b, s, &r);
}

/*
 * p.v + L.w <= |p| |v| + |L| |w|. |v| is |p| / m. An L of at most 2^-n of the calm one turns by
 * less than 2^-n half radians, see calm_angular_q40, which leaves room for roundings.
 */
void body_add_kinetic2_most(struct fix_wide *sum, const struct body *b, const struct body_state *s)
{
    uint64_t p_q40 = fix_sum(s->momentum.c), l_q40 = fix_sum(s->angular.c);
    int64_t speed_q40;
    int n;

    CAROM_ASSERT(b->def.moving);
    if ((p_q40 | l_q40) == 0) {
        return;
    }
    if (!body_calm(b, s)) {
        sum->hi += INT64_MAX >> 20; /* far more than any body has */
        return;
    }
    speed_q40 = fix_mul_scaled((int64_t)p_q40, b->def.inverse_mass);
    speed_q40 += (speed_q40 >> 20) + 1;
    n = fix_bits(b->def.calm_angular_q40) - 1 - fix_bits(l_q40);
    fix_wide_add_product(sum, (int64_t)p_q40, speed_q40);
    fix_wide_add_product(sum, (int64_t)l_q40, n < 39 ? (int64_t)1 << (39 - n) : 1);
}

void body_add_lift2(struct fix_wide *sum, const struct body *b, int sign)
{
    int64_t weight_q40 = fix_mul_scaled(b->def.acceleration_q40, b->def.mass);

    fix_wide_add_product(sum, weight_q40 / 10 * 3, sign * ((int64_t)b->def.skin_q22 << 18));
}

void body_world_inertia(const struct body *b, const carom_m3_q30 *r, struct carom_sym3 *out)
{
    static const uint8_t row[6] = {0, 1, 2, 0, 1, 2}, col[6] = {0, 1, 2, 1, 2, 0};
    struct carom_sym3 whole = b->def.mesh->mass.inertia;

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
    out->e = b->def.mesh->mass.inertia.e;
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
