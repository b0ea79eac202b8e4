/* SPDX-License-Identifier: MIT */
#include "impact.h"

/*
 * Units. The rows hold numbers within 1 in q30, so everything is made dimensionless:
 *
 *   velocities  by V* = 2^(unit - c), masses by the lighter mass m*
 *   lengths     by 2^g for each body, with 4^g about its inertia / mass: J then fills its 30 bits
 * and goes into the rows without rounding, which the long thin bodies need P           by m* V* /
 * 2^c, with 2^c >= twice the longest arm: an arm / 2^(g + c) is within 1/2 dv, dw      of a heavy
 * body by another 2^-p, 4^p about m / m*, so that neither the rows that make them nor the rows that
 * use them lose digits
 *
 * With s = 1 for a and -1 for b, share = m* 2^p / m, and d the direction N, u or v:
 *
 *   1-3, 7-9      dv - s share 2^-c P = 0                       (1) (2)
 *   4-6, 10-12    J dw - s share arm x P = 0                    (3) (4)
 *   last three    sum of s 2^-p (2^-c d.dv + (arm x d).dw) = wanted change of V.d / 2^unit
 *
 * or, when sliding, u.P = 0 and (v + mu N).P = 0 for the last two.
 */

#define UNKNOWNS_MAX 57 /* bits of x in q40: sums over 15 unknowns stay below 2^61 */
#define SPEED_BITS   60 /* bits of V in q40 of the solver's unit, at most */
#define HALVINGS_MAX 30

/* A moving body in the solver's units. */
struct mover {
    int32_t sign;
    int32_t share_q30;
    int share_shift; /* p */
    int32_t inertia_q30[6];
    int inertia_odd; /* 1 where inertia / mass is an odd power of two: the arm's row is halved */
    int32_t arm_q30[3];
};

struct frame {
    carom_v3_q30 n, u, v;
};

struct problem {
    struct gauss *w;
    const struct impact *in;
    struct mover mover[2];
    int movers, n;
    int arm_shift;          /* c */
    struct fix_scaled mass; /* m* */
    struct frame frame;
    struct fix_wide wanted_q70; /* change of V.N */
};

/* A solution: P and the change of V that it makes, K P. */
struct answer {
    int unit;
    int64_t p_q40[3];  /* of m* 2^(unit - 2c) */
    int64_t dv_q40[3]; /* of 2^unit */
};

/* v 2^s to nearest. */
static int64_t shifted(int64_t v, int s)
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

static int64_t dot(const int64_t v[3], const carom_v3_q30 *d)
{
    return fix_mul(v[0], d->c[0], 30) + fix_mul(v[1], d->c[1], 30) + fix_mul(v[2], d->c[2], 30);
}

/* a . b, exact. */
static struct fix_wide wide_dot(const int64_t a[3], const int64_t b[3])
{
    struct fix_wide sum = fix_wide_mul(a[0], b[0]);

    sum = fix_wide_add(sum, fix_wide_mul(a[1], b[1]));
    return fix_wide_add(sum, fix_wide_mul(a[2], b[2]));
}

/* V.d, exact. */
static struct fix_wide speed_q70(const struct impact *in, const carom_v3_q30 *d)
{
    int64_t d64[3] = {d->c[0], d->c[1], d->c[2]};

    return wide_dot(in->velocity.c, d64);
}

/* ------------------------------------------------------------------- frame */

/*
 * u along t x N and v along the part of t across N. Returns false when t has no such part, or one
 * that is within its rounding; u and v are then any tangents.
 */
static bool set_frame(struct frame *f, const int64_t t[3])
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
static int set_shape(struct mover *m, const struct impact_side *side, int *g)
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
        m->inertia_q30[k] = (int32_t)shifted(side->inertia.m[k], 30 - top);
    }
    power = top - side->inertia.e; /* I / m = inertia_q30 2^power */
    m->inertia_odd = power & 1;
    *g = power >> 1;
    return fix_bits(arm) - 22 - *g + 1;
}

/* m* and each body's share of it. */
static void set_masses(struct problem *p, const struct impact_side *side[2])
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
        p->mover[b].share_q30 = (int32_t)shifted(ratio, e / 2 - e);
    }
}

static void prepare(struct problem *p)
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
                (int32_t)shifted(side[b]->arm.c[k], 30 - 22 - g[b] - p->arm_shift);
        }
    }
    set_masses(p, side);
}

/* Equations (1) to (4). */
static void set_body_rows(const struct problem *p)
{
    static const uint8_t entry[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    int32_t(*a)[GAUSS_MAX + 1] = p->w->a;
    int impulse = p->n - 3;

    memset(a, 0, sizeof p->w->a);
    for (int b = 0; b < p->movers; b++) {
        const struct mover *m = &p->mover[b];
        int32_t share = m->sign * m->share_q30;
        int first = 6 * b;

        for (int k = 0; k < 3; k++) {
            int32_t turn =
                (int32_t)carom_round((int64_t)share * m->arm_q30[k], 30 + m->inertia_odd);
            int i = (k + 1) % 3, j = (k + 2) % 3;

            a[first + k][first + k] = CAROM_ONE_Q30;
            a[first + k][impulse + k] = (int32_t)shifted(-share, -p->arm_shift);
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
static void velocity_row(const struct problem *p, const int32_t d_q30[3], int32_t *row)
{
    for (int b = 0; b < p->movers; b++) {
        const struct mover *m = &p->mover[b];
        int32_t turn[3];

        carom_cross(turn, m->arm_q30, d_q30, 30 + m->share_shift);
        for (int k = 0; k < 3; k++) {
            row[6 * b + k] = m->sign * (int32_t)shifted(d_q30[k], -(p->arm_shift + m->share_shift));
            row[6 * b + 3 + k] = m->sign * turn[k];
        }
    }
}

/* u.P = 0, and (v + mu N).P = 0 as (9), (10); mu = 0 gives the frictionless impulse. */
static void set_slide_rows(const struct problem *p, uint32_t friction_q16)
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
        along[p->n - 3 + k] = (int32_t)shifted(row[k], 30 - bits);
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
static void set_normal_row(const struct problem *p, int bits)
{
    int32_t *row = p->w->a[p->n - 3];

    velocity_row(p, p->frame.n.c, row);
    row[p->n] = right_side(p->wanted_q70, bits);
}

/* Paper (7) and (8): the slip is to vanish. */
static void set_stick_rows(const struct problem *p, const struct fix_wide slip_q70[2], int bits)
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
static int solve(const struct problem *p, int bits, struct answer *out)
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
static int unit_bits(const struct problem *p, int bits)
{
    int lowest = bits3(p->in->velocity.c) + 30 + 40 - SPEED_BITS;

    return bits > lowest ? bits : lowest > 30 ? lowest : 30;
}

static int solve_stick(const struct problem *p, struct answer *out)
{
    struct fix_wide slip_q70[2] = {speed_q70(p->in, &p->frame.u), speed_q70(p->in, &p->frame.v)};
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

static int solve_slide(const struct problem *p, uint32_t friction_q16, struct answer *out)
{
    int bits = unit_bits(p, fix_wide_bits(p->wanted_q70));

    set_body_rows(p);
    set_normal_row(p, bits);
    set_slide_rows(p, friction_q16);
    return solve(p, bits, out);
}

/* ---------------------------------------------------------------- friction */

/* a + s (b - a) in both parts of an answer; the difference was made by subtract(). */
static void add_scaled(struct answer *to, const struct answer *difference, struct fix_scaled s)
{
    for (int k = 0; k < 3; k++) {
        to->p_q40[k] += fix_mul_scaled(difference->p_q40[k], s);
        to->dv_q40[k] += fix_mul_scaled(difference->dv_q40[k], s);
    }
}

/* a - b in the unit of a, which is not the finer one. */
static struct answer subtract(const struct answer *a, const struct answer *b)
{
    struct answer d = *a;

    for (int k = 0; k < 3; k++) {
        d.p_q40[k] -= shifted(b->p_q40[k], b->unit - a->unit);
        d.dv_q40[k] -= shifted(b->dv_q40[k], b->unit - a->unit);
    }
    return d;
}

/* |P_t| <= mu P.N, in exact squares. */
static bool in_cone(const struct problem *p, const struct answer *x)
{
    int64_t limit = fix_mul(dot(x->p_q40, &p->frame.n), (int32_t)p->in->friction_q16, 16);
    int64_t pu = dot(x->p_q40, &p->frame.u), pv = dot(x->p_q40, &p->frame.v);
    struct fix_wide excess = fix_wide_neg(fix_wide_mul(limit, limit));

    excess = fix_wide_add(excess, fix_wide_mul(pu, pu));
    excess = fix_wide_add(excess, fix_wide_mul(pv, pv));
    return limit >= 0 && fix_wide_sign(excess) <= 0;
}

/*
 * From the frictionless impulse towards the sticking one, as far as the friction cone goes. It
 * stands in where a sliding contact would wedge: (9), (10) then ask for an impulse that pulls.
 */
static void cone_limit(const struct problem *p, const struct answer *stick, struct answer *out)
{
    struct answer d = subtract(stick, out);
    int64_t tangential[3] = {dot(d.p_q40, &p->frame.u), dot(d.p_q40, &p->frame.v), 0};
    int32_t mu_q16 = (int32_t)p->in->friction_q16;
    int64_t length = fix_length(tangential), reach, growth;
    struct fix_wide excess =
        fix_wide_add(wide_dot(tangential, tangential), fix_wide_neg(fix_wide_mul(length, length)));

    /* One Newton step for the digits that fix_length leaves out: the difference below needs them.
     */
    if (length > 0) {
        length += fix_mul_scaled(1, fix_wide_ratio(excess, fix_wide_mul(length, 2)));
    }
    /* Where P0 + s D meets the cone: |D_t| s = mu (P0.N + s D.N). */
    reach = fix_mul(dot(out->p_q40, &p->frame.n), mu_q16, 16);
    growth = length - fix_mul(dot(d.p_q40, &p->frame.n), mu_q16, 16);
    if (reach > 0 && growth > 0) {
        add_scaled(out, &d, fix_wide_ratio(fix_wide_mul(reach, 1), fix_wide_mul(growth, 1)));
    }
}

/*
 * Coulomb's limit is passed: the impulse along the slip, or where there is none to begin with,
 * along the slip that a frictionless impact leaves.
 */
static int slide(struct problem *p, bool slips, const struct answer *stick, struct answer *out)
{
    struct answer free;
    int64_t after[3];

    if (!slips) {
        if (solve_slide(p, 0, out)) {
            return -1;
        }
        for (int k = 0; k < 3; k++) {
            after[k] = shifted(p->in->velocity.c[k], -out->unit) + out->dv_q40[k];
        }
        if (!set_frame(&p->frame, after)) {
            return 0; /* nothing for friction to act along */
        }
    }
    if (solve_slide(p, p->in->friction_q16, out) == 0 && dot(out->p_q40, &p->frame.n) > 0) {
        return 0;
    }
    if (solve_slide(p, 0, &free)) {
        return -1;
    }
    *out = free;
    cone_limit(p, stick, out);
    return 0;
}

/* ------------------------------------------------------------------ energy */

/* a k^2 + b k + c with k in q30; |a|, |b|, |c| < 2^60. */
static int64_t quadratic(const int64_t abc[3], int32_t k_q30)
{
    return fix_mul(fix_mul(abc[0], k_q30, 30) + abc[1], k_q30, 30) + abc[2];
}

/* The largest k in [0, 1] whose quadratic is not positive, rounded down; c <= 0 <= a. */
static struct fix_scaled largest_feasible(int64_t abc[3])
{
    struct fix_scaled k = {.m = 0, .e = 30};

    /* Halve until 1/2 is feasible, so that a small k has its 30 digits too. */
    while (k.e < 30 + HALVINGS_MAX && quadratic(abc, CAROM_ONE_Q30 / 2) > 0) {
        abc[0] = (abc[0] + 3) >> 2; /* upwards: on the safe side */
        abc[1] = (abc[1] + 1) >> 1;
        k.e++;
    }
    for (int32_t digit = CAROM_ONE_Q30 / 2; digit > 0; digit >>= 1) {
        if (quadratic(abc, k.m + digit) <= 0) {
            k.m += digit;
        }
    }
    return k;
}

/* Twice the energy that an answer adds, in the solver's units: P.(2V + K P). */
static struct fix_wide gain(const int64_t v_q40[3], const struct answer *x)
{
    int64_t sum[3];

    for (int k = 0; k < 3; k++) {
        sum[k] = 2 * v_q40[k] + x->dv_q40[k];
    }
    return wide_dot(x->p_q40, sum);
}

/*
 * The energy rule. With D = P* - P0, twice the energy change of P0 + k D is
 *
 *   P0.(2V + K P0) + 2k D.V + k^2 D.K D
 *
 * because N.K D = 0: both impulses give the same V'.N. The first term is (P0.N) (V.N + target),
 * formed from V itself because at e = 1 it is a difference of nearly equal numbers; it is not
 * positive while e <= 1. The last is not negative. So from the largest k with a value <= 0 on, all
 * are positive. Returns 1 when P* had to be moved, 0 when not, -1 when there is no solution.
 */
static int energy_rule(const struct problem *p, struct answer *x)
{
    struct answer free, d;
    struct fix_wide square, slope;
    struct fix_scaled loss;
    int64_t v[3], abc[3];
    int down;

    for (int k = 0; k < 3; k++) {
        v[k] = shifted(p->in->velocity.c[k], -x->unit);
    }
    if (fix_wide_sign(gain(v, x)) <= 0) {
        return 0;
    }
    if (solve_slide(p, 0, &free)) {
        return -1;
    }
    d = subtract(x, &free);
    for (int k = 0; k < 3; k++) {
        x->p_q40[k] -= d.p_q40[k];
        x->dv_q40[k] -= d.dv_q40[k];
    }
    square = wide_dot(d.p_q40, d.dv_q40);
    slope = wide_dot(d.p_q40, v);
    slope = fix_wide_add(slope, slope);
    down =
        fix_wide_bits(square) > fix_wide_bits(slope) ? fix_wide_bits(square) : fix_wide_bits(slope);
    down = down > 59 ? down - 59 : 0;
    abc[0] = fix_wide_shift(square, down);
    abc[1] = fix_wide_shift(slope, down);
    /* 2 V.N + wanted = V.N + target */
    loss = fix_wide_ratio(fix_wide_add(fix_wide_add(p->wanted_q70, speed_q70(p->in, &p->frame.n)),
                                       speed_q70(p->in, &p->frame.n)),
                          fix_wide_mul(1, 1));
    loss.e += 30 + x->unit + down;
    abc[2] = loss.m < 0 ? fix_mul_scaled(dot(x->p_q40, &p->frame.n), loss) : 0;
    add_scaled(x, &d, largest_feasible(abc));
    return 1;
}

/* ------------------------------------------------------------------ impact */

/* The one rounding of the impulse, to momentum's last place. */
static void finish(const struct problem *p, const struct answer *x, struct impact_result *out)
{
    struct fix_scaled unit = {.m = p->mass.m, .e = p->mass.e - (x->unit - 2 * p->arm_shift)};

    for (int k = 0; k < 3; k++) {
        out->impulse.c[k] = fix_mul_scaled(x->p_q40[k], unit);
    }
    out->normal_q40 = dot(out->impulse.c, &p->frame.n);
    if (out->normal_q40 < 0) {
        out->normal_q40 = 0; /* less than the rounding of N */
    }
}

int impact_solve(struct gauss *w, const struct impact *in, struct impact_result *out)
{
    struct problem p = {.w = w, .in = in, .frame.n = in->normal};
    struct impact_result result = {.slid = false, .energy_rule = false};
    struct answer x, stick;
    int changed = 0;
    bool slips;

    p.wanted_q70 = fix_wide_add(fix_wide_mul(in->target_q40, CAROM_ONE_Q30),
                                fix_wide_neg(speed_q70(in, &in->normal)));
    if (fix_wide_sign(p.wanted_q70) <= 0) {
        *out = (struct impact_result){.slid = false};
        return CAROM_OK;
    }
    prepare(&p);
    slips = set_frame(&p.frame, in->velocity.c);
    if (in->friction_q16 == 0) {
        if (solve_slide(&p, 0, &x)) {
            return CAROM_ERR_RANGE;
        }
    } else {
        if (solve_stick(&p, &stick)) {
            return CAROM_ERR_RANGE;
        }
        x = stick;
        if (!in_cone(&p, &x)) {
            result.slid = true;
            if (slide(&p, slips, &stick, &x)) {
                return CAROM_ERR_RANGE;
            }
        }
        if (!in->may_gain) {
            changed = energy_rule(&p, &x);
            if (changed < 0) {
                return CAROM_ERR_RANGE;
            }
        }
    }
    result.energy_rule = changed > 0;
    finish(&p, &x, &result);
    *out = result;
    return CAROM_OK;
}
