/* SPDX-License-Identifier: MIT */
#include "impact_rows.h"

#define UNKNOWNS_MAX 57 /* bits of x in q40: sums over 15 unknowns stay below 2^61 */
#define SPEED_BITS   60 /* bits of V in q40 of the solver's unit, at most */

/* v 2^s to nearest. */
int64_t impact_shift(int64_t v, int s)
{
    if (s >= 0) {
        return carom_shl(v, s);
    }
    return s < -62 ? 0 : carom_round(v, -s);
}

static int bits3(const int64_t v[3])
{
    return fix_bits((uint64_t)(carom_abs(v[0]) | carom_abs(v[1]) | carom_abs(v[2])));
}

int64_t impact_dot(const int64_t v[3], const carom_v3_q30 *d)
{
    return fix_mul(v[0], d->c[0], 30) + fix_mul(v[1], d->c[1], 30) + fix_mul(v[2], d->c[2], 30);
}

/* a . b, exact. */
struct fix_wide impact_wide_dot(const int64_t a[3], const int64_t b[3])
{
    struct fix_wide sum = fix_wide_mul(a[0], b[0]);

    sum = fix_wide_add(sum, fix_wide_mul(a[1], b[1]));
    return fix_wide_add(sum, fix_wide_mul(a[2], b[2]));
}

/* V.d, exact. */
struct fix_wide impact_speed_q70(const struct impact *in, const carom_v3_q30 *d)
{
    int64_t d64[3] = {d->c[0], d->c[1], d->c[2]};

    return impact_wide_dot(in->velocity.c, d64);
}

/* ------------------------------------------------------------------- frame */

/*
 * u along t x N and v along the part of t across N. Returns false when t has no such part, or one
 * that is within its rounding; u and v are then any tangents.
 */
bool impact_set_frame(struct impact_frame *f, const int64_t t[3])
{
    struct fix_wide cross_q70[3];
    int64_t across[3];
    int bits = 0;
    bool slips;

    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3, b;

        cross_q70[k] = fix_wide_add(fix_wide_mul(t[i], f->n.c[j]), fix_wide_mul(-t[j], f->n.c[i]));
        b = fix_wide_bits(cross_q70[k]);
        bits = b > bits ? b : bits;
    }
    slips = bits > 34 && bits > bits3(t) + 30 - 28;
    if (slips) {
        for (int k = 0; k < 3; k++) {
            across[k] = fix_wide_shift(cross_q70[k], bits > 62 ? bits - 62 : 0);
        }
    } else {
        /* The axis farthest from N: its cross product with N is at least sqrt(2/3) long. */
        int far = 0;

        for (int k = 1; k < 3; k++) {
            far = carom_abs(f->n.c[k]) < carom_abs(f->n.c[far]) ? k : far;
        }
        across[far] = 0;
        across[(far + 1) % 3] = -f->n.c[(far + 2) % 3];
        across[(far + 2) % 3] = f->n.c[(far + 1) % 3];
    }
    fix_normalise(&f->u, across);
    carom_cross(f->v.c, f->n.c, f->u.c, 30);
    return slips;
}

/* -------------------------------------------------------------------- rows */

/* The power of two of I / m and of the arm; returns the c that this body needs. */
static int set_shape(struct impact_mover *m, const struct impact_side *side, int *g)
{
    uint32_t inertia = 0, arm = 0;
    int top, power;

    for (int k = 0; k < 6; k++) {
        inertia |= (uint32_t)carom_abs(side->inertia.m[k]);
    }
    for (int k = 0; k < 3; k++) {
        arm |= (uint32_t)carom_abs(side->arm.c[k]);
    }
    top = fix_bits(inertia);
    for (int k = 0; k < 6; k++) {
        m->inertia_q30[k] = (int32_t)impact_shift(side->inertia.m[k], 30 - top);
    }
    power = top - side->inertia.e; /* I / m = inertia_q30 2^power */
    m->inertia_odd = power & 1;
    *g = power >> 1;
    return fix_bits(arm) - 22 - *g + 1;
}

/* m* and each body's share of it. */
static void set_masses(struct impact_problem *p, const struct impact_side *side[2])
{
    for (int b = 0; b < p->movers; b++) {
        const struct fix_scaled *m = &side[b]->mass;

        if (b == 0 || m->e > p->mass.e || (m->e == p->mass.e && m->m < p->mass.m)) {
            p->mass = *m;
        }
    }
    for (int b = 0; b < p->movers; b++) {
        /* m* / m = ratio 2^-(30 + e), at most 1. */
        int64_t ratio = ((int64_t)p->mass.m * ((int64_t)1 << 30)) / side[b]->mass.m;
        int e = p->mass.e - side[b]->mass.e;

        p->mover[b].share_shift = e / 2;
        p->mover[b].share_q30 = (int32_t)impact_shift(ratio, e / 2 - e);
    }
}

void impact_prepare(struct impact_problem *p)
{
    const struct impact *in = p->in;
    const struct impact_side *side[2];
    int g[2];

    p->movers = 0;
    if (in->a.moving) {
        p->mover[p->movers].sign = 1;
        side[p->movers++] = &in->a;
    }
    if (in->b.moving) {
        p->mover[p->movers].sign = -1;
        side[p->movers++] = &in->b;
    }
    CAROM_ASSERT(p->movers > 0);
    p->n = 6 * p->movers + 3;
    p->arm_shift = 0;
    for (int b = 0; b < p->movers; b++) {
        int c = set_shape(&p->mover[b], side[b], &g[b]);

        p->arm_shift = c > p->arm_shift ? c : p->arm_shift;
    }
    for (int b = 0; b < p->movers; b++) {
        for (int k = 0; k < 3; k++) {
            /* |arm| < 2^(g + c - 1 + 22), so |arm_q30| <= 2^29. */
            p->mover[b].arm_q30[k] =
                (int32_t)impact_shift(side[b]->arm.c[k], 30 - 22 - g[b] - p->arm_shift);
        }
    }
    set_masses(p, side);
}

/* Equations (1) to (4). */
static void set_body_rows(const struct impact_problem *p)
{
    static const uint8_t entry[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    int32_t(*a)[GAUSS_MAX + 1] = p->w->a;
    int impulse = p->n - 3;

    memset(a, 0, sizeof p->w->a);
    for (int b = 0; b < p->movers; b++) {
        const struct impact_mover *m = &p->mover[b];
        int32_t share = m->sign * m->share_q30;
        int first = 6 * b;

        for (int k = 0; k < 3; k++) {
            int32_t turn =
                (int32_t)carom_round((int64_t)share * m->arm_q30[k], 30 + m->inertia_odd);
            int i = (k + 1) % 3, j = (k + 2) % 3;

            a[first + k][first + k] = CAROM_ONE_Q30;
            a[first + k][impulse + k] = (int32_t)impact_shift(-share, -p->arm_shift);
            for (int l = 0; l < 3; l++) {
                a[first + 3 + k][first + 3 + l] = m->inertia_q30[entry[k][l]];
            }
            /* (arm x P)_j has arm_k P_i with a plus sign, (arm x P)_i has arm_k P_j with a minus.
             */
            a[first + 3 + j][impulse + i] = -turn;
            a[first + 3 + i][impulse + j] = turn;
        }
    }
}

/* The coefficients that give the change of V.d from dv and dw. */
static void velocity_row(const struct impact_problem *p, const int32_t d_q30[3], int32_t *row)
{
    for (int b = 0; b < p->movers; b++) {
        const struct impact_mover *m = &p->mover[b];
        int32_t turn[3];

        carom_cross(turn, m->arm_q30, d_q30, 30 + m->share_shift);
        for (int k = 0; k < 3; k++) {
            row[6 * b + k] =
                m->sign * (int32_t)impact_shift(d_q30[k], -(p->arm_shift + m->share_shift));
            row[6 * b + 3 + k] = m->sign * turn[k];
        }
    }
}

/* u.P = 0, and (v + mu N).P = 0 as (9), (10); mu = 0 gives the frictionless impulse. */
static void set_slide_rows(const struct impact_problem *p, uint32_t friction_q16)
{
    int32_t *across = p->w->a[p->n - 2], *along = p->w->a[p->n - 1];
    int64_t row[3];
    int bits;

    for (int k = 0; k < 3; k++) {
        row[k] = ((int64_t)p->frame.v.c[k] * ((int64_t)1 << 16)) +
                 (int64_t)friction_q16 * p->frame.n.c[k];
    }
    bits = bits3(row);
    for (int k = 0; k < 3; k++) {
        across[p->n - 3 + k] = p->frame.u.c[k];
        along[p->n - 3 + k] = (int32_t)impact_shift(row[k], 30 - bits);
    }
}

/* v / 2^(bits - 30) to nearest, for a v of at most `bits` bits: a right-hand side in the solver's
 * unit. */
static int32_t right_side(struct fix_wide v_q70, int bits)
{
    return bits > 30 ? (int32_t)carom_round(fix_wide_shift(v_q70, bits - 31), 1)
                     : (int32_t)fix_wide_shift(v_q70, 0);
}

/* Paper (5): the wanted V'.N. */
static void set_normal_row(const struct impact_problem *p, int bits)
{
    int32_t *row = p->w->a[p->n - 3];

    velocity_row(p, p->frame.n.c, row);
    row[p->n] = right_side(p->wanted_q70, bits);
}

/* Paper (7) and (8): the slip is to vanish. */
static void set_stick_rows(const struct impact_problem *p, const struct fix_wide slip_q70[2],
                           int bits)
{
    const carom_v3_q30 *tangent[2] = {&p->frame.u, &p->frame.v};

    for (int k = 0; k < 2; k++) {
        int32_t *row = p->w->a[p->n - 2 + k];

        velocity_row(p, tangent[k]->c, row);
        row[p->n] = -right_side(slip_q70[k], bits);
    }
}

/* ------------------------------------------------------------------- solve */

/* Solve the rows and take P and K P out of the unknowns. */
static int solve(const struct impact_problem *p, int bits, struct impact_answer *out)
{
    const int64_t *x = p->w->x_q40;
    uint64_t used = 0;

    if (gauss_solve(p->w, p->n)) {
        return -1;
    }
    for (int j = 0; j < p->n; j++) {
        used |= (uint64_t)carom_abs(x[j]);
    }
    if (used >> UNKNOWNS_MAX) {
        return -1;
    }
    out->unit = bits - 70;
    for (int k = 0; k < 3; k++) {
        int32_t axis[3] = {0, 0, 0}, row[GAUSS_MAX];

        axis[k] = CAROM_ONE_Q30;
        velocity_row(p, axis, row);
        out->p_q40[k] = x[p->n - 3 + k];
        out->dv_q40[k] = 0;
        for (int j = 0; j < p->n - 3; j++) {
            out->dv_q40[k] += fix_mul(x[j], row[j], 30);
        }
    }
    return 0;
}

/* The unit must not be so small that V does not fit, nor finer than the velocities are. */
static int unit_bits(const struct impact_problem *p, int bits)
{
    int lowest = bits3(p->in->velocity.c) + 30 + 40 - SPEED_BITS;

    return bits > lowest ? bits : lowest > 30 ? lowest : 30;
}

int impact_stick(const struct impact_problem *p, struct impact_answer *out)
{
    struct fix_wide slip_q70[2] = {impact_speed_q70(p->in, &p->frame.u),
                                   impact_speed_q70(p->in, &p->frame.v)};
    int bits = fix_wide_bits(p->wanted_q70);

    for (int k = 0; k < 2; k++) {
        int b = fix_wide_bits(slip_q70[k]);

        bits = b > bits ? b : bits;
    }
    bits = unit_bits(p, bits);
    set_body_rows(p);
    set_normal_row(p, bits);
    set_stick_rows(p, slip_q70, bits);
    return solve(p, bits, out);
}

int impact_slide(const struct impact_problem *p, uint32_t friction_q16, struct impact_answer *out)
{
    int bits = unit_bits(p, fix_wide_bits(p->wanted_q70));

    set_body_rows(p);
    set_normal_row(p, bits);
    set_slide_rows(p, friction_q16);
    return solve(p, bits, out);
}
