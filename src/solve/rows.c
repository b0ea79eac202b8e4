/* SPDX-License-Identifier: MIT */
/* The equations of one impact as rows; their solution by Gauss-Jordan elimination, refined. */
#include "rows.h"

#define UNKNOWNS_MAX 57 /* bits of x in q40: sums over 15 unknowns stay below 2^61 */
#define SPEED_BITS   60 /* bits of V in q40 of the solver's unit, at most */

int64_t impact_dot(const int64_t v[3], const carom_v3_q30 *d)
{
    return fix_dot_q30(v, d->c);
}

void impact_add_speed_q70(struct fix_wide *sum, const struct impact *in, const carom_v3_q30 *d,
                          int times)
{
    for (int k = 0; k < 3; k++) {
        fix_wide_add_product(sum, in->velocity.c[k], times * (int64_t)d->c[k]);
    }
}

/* ------------------------------------------------------------------- frame */

bool impact_set_frame(struct impact_frame *f, const int64_t t[3])
{
    struct fix_wide cross_q70[3];
    int64_t across[3];
    int bits;
    bool slips;

    for (int k = 0; k < 3; k++) {
        int i = fix_next(k), j = fix_next(i);

        cross_q70[k] = fix_wide_mul(t[i], f->n.c[j]);
        fix_wide_add_product(&cross_q70[k], -t[j], f->n.c[i]);
    }
    bits = fix_wide_bits3(cross_q70);
    /* below 2^-36, or 2^-28 of t: N is rounded to 2^-31, which turns t x N as much */
    slips = bits > 34 && bits > fix_bits3(t) + 30 - 28;
    if (slips) {
        for (int k = 0; k < 3; k++) {
            across[k] = fix_wide_shift(&cross_q70[k], bits > 62 ? bits - 62 : 0);
        }
    } else {
        /* the axis farthest from N: its cross product with N is at least sqrt(2/3) long */
        int far = 0;

        for (int k = 1; k < 3; k++) {
            far = carom_abs(f->n.c[k]) < carom_abs(f->n.c[far]) ? k : far;
        }
        across[far] = 0;
        across[fix_next(far)] = -f->n.c[fix_next(fix_next(far))];
        across[fix_next(fix_next(far))] = f->n.c[fix_next(far)];
    }
    fix_normalise(&f->u, across);
    carom_cross(f->v.c, f->n.c, f->u.c, 30);
    /* some units of 2^-30 */
    f->un_q52 = (int32_t)carom_round(carom_dot(f->u.c, f->n.c), 8);
    f->vn_q52 = (int32_t)carom_round(carom_dot(f->v.c, f->n.c), 8);
    return slips;
}

/* -------------------------------------------------------------------- rows */

/* Set the powers of two of I / m (g) and of the arm; returns the c that this body needs. */
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
        m->inertia_q30[k] = (int32_t)fix_round_shift(side->inertia.m[k], 30 - top);
    }
    power = top - side->inertia.e; /* I / m = inertia_q30 2^power */
    m->inertia_odd = power & 1;
    *g = power >> 1;
    return fix_bits(arm) - side->arm.e - *g + 1;
}

/* Split a number up to 1 into two parts. */
static void split_q60(int64_t v_q60, int32_t *v_q30, int32_t *rest_q60)
{
    *v_q30 = (int32_t)carom_round(v_q60, 30);
    *rest_q60 = (int32_t)(v_q60 - *v_q30 * ((int64_t)1 << 30));
}

/* Set m* and the shares, exact to 60 bits: m* / m is 1/2 to 1 for the lighter body. */
static void set_masses(struct impact_problem *p, const struct impact_side *side[2])
{
    int power[2], top = 0;

    for (int b = 0; b < p->movers; b++) {
        power[b] = 30 - side[b]->inverse_mass.e; /* 1 / m < 2^power */
        top = b == 0 || power[b] > top ? power[b] : top;
    }
    p->mass_power = -top;
    for (int b = 0; b < p->movers; b++) {
        split_q60(fix_round_shift(side[b]->inverse_mass.m, 30 + power[b] - top),
                  &p->mover[b].share_q30, &p->mover[b].share_rest_q60);
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
            /* |arm| < 2^(g + c - 1 + e), so |arm_q30| <= 2^29 and |arm x d| < 2^30 */
            int shift = 60 - side[b]->arm.e - g[b] - p->arm_shift;

            split_q60(fix_round_shift(side[b]->arm.c[k], shift), &p->mover[b].arm_q30[k],
                      &p->mover[b].arm_rest_q60[k]);
        }
    }
    set_masses(p, side);
}

/* Entry of -s share arm x P: how an impulse along one axis turns the body about another. */
static int32_t turn_by(const struct impact_mover *m, int k)
{
    return (int32_t)carom_round((int64_t)(m->sign * m->share_q30) * m->arm_q30[k],
                                30 + m->inertia_odd);
}

/* Row k of a body's six, equations (1) to (4). */
static void body_row(const struct impact_problem *p, int b, int k, int32_t *row)
{
    const struct impact_mover *m = &p->mover[b];
    int32_t *impulse = row + p->n - 3, *own = row + 6 * b;

    if (k < 3) {
        own[k] = CAROM_ONE_Q30;
        impulse[k] = (int32_t)fix_round_shift(-(m->sign * m->share_q30), -p->arm_shift);
    } else {
        int i = fix_next(k - 3), j = fix_next(i);

        for (int l = 0; l < 3; l++) {
            own[3 + l] = m->inertia_q30[fix_sym3_at[k - 3][l]];
        }
        impulse[i] = turn_by(m, j);
        impulse[j] = -turn_by(m, i);
    }
}

/* Set the coefficients by which dv and dw change V.d. */
static void velocity_row(const struct impact_problem *p, const carom_v3_q30 *d, int32_t *row)
{
    for (int b = 0; b < p->movers; b++) {
        const struct impact_mover *m = &p->mover[b];
        int32_t turn[3];

        carom_cross(turn, m->arm_q30, d->c, 30);
        for (int k = 0; k < 3; k++) {
            row[6 * b + k] = m->sign * (int32_t)fix_round_shift(d->c[k], -p->arm_shift);
            row[6 * b + 3 + k] = m->sign * turn[k];
        }
    }
}

/* v 2^16 + mu N of (10); returns its bits. (v + mu N) 2^(46 - bits), in 30 bits, is the row. */
static int slide_direction(const struct impact_problem *p, uint32_t friction_q16, int64_t out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = ((int64_t)p->frame.v.c[k] * ((int64_t)1 << 16)) +
                 (int64_t)friction_q16 * p->frame.n.c[k];
    }
    return fix_bits3(out);
}

/* Paper (9) and (10); mu = 0 gives the frictionless impulse. */
static void slide_row(const struct impact_problem *p, uint32_t friction_q16, bool along,
                      int32_t *row)
{
    int64_t direction[3];
    int bits = slide_direction(p, friction_q16, direction);

    for (int k = 0; k < 3; k++) {
        row[p->n - 3 + k] =
            along ? (int32_t)fix_round_shift(direction[k], 30 - bits) : p->frame.u.c[k];
    }
}

/* ------------------------------------------------------------------- solve */

/* The goal of a solution: to stick or to slide, and the change of V. */
struct goal {
    bool sticks;
    uint32_t friction_q16; /* if it does not stick */
    int bits;              /* of the unit, with 70 fractional bits */
    int64_t change_q40[3]; /* change of V along N, u, v, in the unit */
};

/* v in units of 2^bits. */
static int64_t in_unit_q40(const struct fix_wide *v_q70, int bits)
{
    return bits > 40 ? carom_round(fix_wide_shift(v_q70, bits - 41), 1)
                     : carom_shl(fix_wide_shift(v_q70, 0), 40 - bits);
}

/* The unit's bits: V must fit, and the unit need not be finer than velocities are. */
static int unit_bits(const struct impact_problem *p, int bits)
{
    int lowest = fix_bits3(p->in->velocity.c) + 30 + 40 - SPEED_BITS;

    return bits > lowest ? bits : lowest > 30 ? lowest : 30;
}

void impact_row(const struct impact_problem *p, bool sticks, uint32_t friction_q16, int i,
                int32_t *row)
{
    const carom_v3_q30 *direction[3] = {&p->frame.n, &p->frame.u, &p->frame.v};
    int last = i - (p->n - 3);

    memset(row, 0, (size_t)(p->n + 1) * sizeof *row);
    if (last < 0) {
        body_row(p, i / 6, i % 6, row);
    } else if (sticks || last == 0) {
        velocity_row(p, direction[last], row);
    } else {
        slide_row(p, friction_q16, last == 2, row);
    }
}

/* Gauss-Jordan on the rows; the solution is in p->gauss. */
static int eliminate(const struct impact_problem *p, const struct goal *goal)
{
    int32_t row[GAUSS_MAX + 1];
    int more;

    for (int i = 0; i < p->n; i++) {
        int last = i - (p->n - 3);

        impact_row(p, goal->sticks, goal->friction_q16, i, p->gauss->a[i]);
        if (last == 0 || (last > 0 && goal->sticks)) {
            p->gauss->a[i][p->n] = (int32_t)carom_round(goal->change_q40[last], 10);
        }
    }
    more = gauss_begin(p->gauss, p->n);
    while (more > 0) {
        more = gauss_correct(p->gauss, p->n);
        for (int i = 0; i < p->n && more > 0; i++) {
            impact_row(p, goal->sticks, goal->friction_q16, i, row);
            gauss_take_out(p->gauss, p->n, i, row);
        }
    }
    return more;
}

/* v times a number in two parts */
static int64_t times(int64_t v, int32_t by_q30, int32_t rest_q60)
{
    return fix_mul_q30(v, by_q30) + fix_mul(v, rest_q60, 60);
}

/* Component k of v x arm */
static int64_t cross_arm(const struct impact_mover *m, const int64_t v[3], int k)
{
    int i = fix_next(k), j = fix_next(i);

    return times(v[i], m->arm_q30[j], m->arm_rest_q60[j]) -
           times(v[j], m->arm_q30[i], m->arm_rest_q60[i]);
}

/* Set the change of V by dv and dw: sum of s (2^-c dv + dw x arm). */
static void velocity_change(const struct impact_problem *p, int64_t out_q40[3])
{
    memset(out_q40, 0, 3 * sizeof out_q40[0]);
    for (int b = 0; b < p->movers; b++) {
        const struct impact_mover *m = &p->mover[b];
        const int64_t *dv = p->gauss->x_q40 + 6 * b, *dw = dv + 3;

        for (int k = 0; k < 3; k++) {
            out_q40[k] += m->sign * (fix_round_shift(dv[k], -p->arm_shift) + cross_arm(m, dw, k));
        }
    }
}

/* Residual of (1) to (4), rounded only to the last place of q40. */
static void body_residual(const struct impact_problem *p, int b, int64_t *out_q40)
{
    const struct impact_mover *m = &p->mover[b];
    const int64_t *dv = p->gauss->x_q40 + 6 * b, *dw = dv + 3,
                  *impulse = p->gauss->x_q40 + p->n - 3;
    int64_t share[3];

    for (int k = 0; k < 3; k++) {
        share[k] = m->sign * times(impulse[k], m->share_q30, m->share_rest_q60);
        out_q40[k] = fix_round_shift(share[k], -p->arm_shift) - dv[k];
    }
    for (int k = 0; k < 3; k++) {
        out_q40[3 + k] = fix_round_shift(-cross_arm(m, share, k), -m->inertia_odd);
        for (int l = 0; l < 3; l++) {
            out_q40[3 + k] -= fix_mul_q30(dw[l], m->inertia_q30[fix_sym3_at[k][l]]);
        }
    }
}

/*
 * Refine the solution against the equations before their coefficients were rounded to rows. This
 * matters if P is large beside the approach speed, as in a grazing contact that wedges.
 */
static int refine(const struct impact_problem *p, const struct goal *goal)
{
    const int64_t *impulse = p->gauss->x_q40 + p->n - 3;
    const struct impact_frame *f = &p->frame;
    int64_t residual_q40[GAUSS_MAX], *last = residual_q40 + p->n - 3, change[3], row[3];

    for (int b = 0; b < p->movers; b++) {
        body_residual(p, b, residual_q40 + 6 * b);
    }
    velocity_change(p, change);
    last[0] = goal->change_q40[0] - impact_dot(change, &f->n);
    if (goal->sticks) {
        /* V' is along N: V'.u is not 0 but the target times u.N */
        int64_t after = fix_round_shift(p->in->target_q40, 70 - goal->bits);

        last[1] = goal->change_q40[1] - impact_dot(change, &f->u) + fix_mul(after, f->un_q52, 52);
        last[2] = goal->change_q40[2] - impact_dot(change, &f->v) + fix_mul(after, f->vn_q52, 52);
    } else {
        int64_t normal = impact_dot(impulse, &f->n);
        int64_t excess = impact_dot(impulse, &f->v) - fix_mul(normal, f->vn_q52, 52) +
                         fix_mul(normal, (int32_t)goal->friction_q16, 16);

        last[1] = fix_mul(normal, f->un_q52, 52) - impact_dot(impulse, &f->u);
        last[2] = -fix_round_shift(excess, 46 - slide_direction(p, goal->friction_q16, row));
    }
    return gauss_add(p->gauss, p->n, residual_q40);
}

static int solve(const struct impact_problem *p, const struct goal *goal, struct impact_answer *out)
{
    const int64_t *x = p->gauss->x_q40;
    uint64_t used = 0;

    if (eliminate(p, goal)) {
        return -1;
    }
    /* a contact about to wedge: too large for the sums that follow, and useless */
    for (int j = 0; j < p->n; j++) {
        used |= (uint64_t)carom_abs(x[j]);
    }
    if (used >> UNKNOWNS_MAX || refine(p, goal)) {
        return -1;
    }
    out->unit = goal->bits - 70;
    memcpy(out->p_q40, x + p->n - 3, sizeof out->p_q40);
    velocity_change(p, out->dv_q40);
    return 0;
}

int impact_stick(const struct impact_problem *p, struct impact_answer *out)
{
    struct fix_wide change_q70[3] = {p->wanted_q70};
    struct goal goal = {.sticks = true};

    impact_add_speed_q70(&change_q70[1], p->in, &p->frame.u, -1);
    impact_add_speed_q70(&change_q70[2], p->in, &p->frame.v, -1);
    goal.bits = unit_bits(p, fix_wide_bits3(change_q70));
    for (int k = 0; k < 3; k++) {
        goal.change_q40[k] = in_unit_q40(&change_q70[k], goal.bits);
    }
    return solve(p, &goal, out);
}

int impact_slide(const struct impact_problem *p, uint32_t friction_q16, struct impact_answer *out)
{
    struct goal goal = {.friction_q16 = friction_q16,
                        .bits = unit_bits(p, fix_wide_bits(&p->wanted_q70))};

    goal.change_q40[0] = in_unit_q40(&p->wanted_q70, goal.bits);
    return solve(p, &goal, out);
}
