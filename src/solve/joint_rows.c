/* SPDX-License-Identifier: MIT */
/*
 * A joint's rows before the sweeps: levers, K and its inverse, velocities in the unit; and impulses
 * after them.
 */
#include "joint_parts.h"

/* A pivot below this part of the largest one: the row repeats others. */
#define PIVOT_MIN_Q30 (1 << 8)

/* ------------------------------------------------------------------------ levers */

/*
 * V of a row by du, with 31 - turn_bits fractional bits. For a linear row d.(column x arm); for an
 * angular row d.column at the arm of 2^length_bits.
 */
static int64_t turn_of(const struct joint_work *work, const struct joint_lever *lever, int row,
                       int j)
{
    const struct body *b = lever->body;
    const int32_t *column = body_solved(b)->columns[j], *d = work->direction[row];
    int down = b->solve.turn_bits - 31 + b->def.mesh->spread.e[j];

    if (joint_is_angular(work, row)) {
        /* q30 over 2^e, times 2^(length_bits - 22) */
        return fix_round_shift(carom_dot(d, column), -(down + 30 + 22 - work->length_bits));
    }
    {
        int64_t cross[3], sum = 0;

        fix_cross(cross, column, lever->arm);
        for (int k = 0; k < 3; k++) {
            sum += fix_mul(cross[k], d[k], 30);
        }
        return fix_round_shift(sum, -(down + lever->arm_bits + work->down));
    }
}

/*
 * Set a lever's turns. Returns false if turn_bits had to be raised: then everything must be
 * prepared anew.
 */
static bool prepare_turns(const struct joint_work *work, struct joint_lever *lever)
{
    for (int row = 0; row < work->rows; row++) {
        for (int j = 0; j < 3; j++) {
            int64_t turn = turn_of(work, lever, row, j);

            if (turn >= CAROM_ONE_Q30 || turn <= -CAROM_ONE_Q30) {
                if (lever->body->solve.turn_bits < REST_TURN_BITS_MAX) {
                    lever->body->solve.turn_bits++;
                    return false;
                }
                turn = rest_within(turn, CAROM_ONE_Q30 - 1);
            }
            lever->turn[row][j] = (int32_t)turn;
        }
    }
    return true;
}

/* Set each body's share of the lightest one's mass. */
static void prepare_joint_shares(struct joint_work *work, const struct body *lightest)
{
    int64_t unit_q40 = fix_mul_scaled((int64_t)1 << 40, lightest->def.mass);

    work->lightest = lightest;
    for (int s = 0; s < 2; s++) {
        const struct body *own = work->lever[s].body;

        if (own) {
            work->lever[s].share_q30 =
                own->def.mass.m == lightest->def.mass.m && own->def.mass.e == lightest->def.mass.e
                    ? CAROM_ONE_Q30
                    : (int32_t)(fix_mul_scaled(unit_q40, own->def.inverse_mass) >> 10);
        }
    }
}

/* ----------------------------------------------------------------------------- K */

int64_t joint_entry(const struct joint_work *a, int i, const struct joint_work *b, int k, int q)
{
    int64_t sum = 0;

    for (int s = 0; s < 2; s++) {
        const struct joint_lever *own = &a->lever[s];

        for (int t = 0; t < 2 && own->body; t++) {
            const struct joint_lever *other = &b->lever[t];
            int64_t part;

            if (other->body != own->body) {
                continue;
            }
            /* turns have 31 - turn_bits fractional bits each, the share has 30 */
            part = fix_mul(carom_dot(own->turn[i], other->turn[k]), own->share_q30,
                           92 - q - 2 * own->body->solve.turn_bits);
            if (!joint_is_angular(a, i) && !joint_is_angular(b, k)) {
                int64_t d_q60 = carom_dot(a->direction[i], b->direction[k]);

                part +=
                    fix_round_shift(fix_mul_q30(d_q60, own->share_q30), q - 60 - a->down - b->down);
            }
            sum += s == t ? part : -part;
        }
    }
    return sum;
}

/* Bits by which the largest diagonal entry of the linear, or of the angular, rows is above 1. */
static int bits_above(const struct joint_work *work, bool angular)
{
    int64_t most = 0;

    for (int i = 0; i < work->rows; i++) {
        if (joint_is_angular(work, i) == angular) {
            int64_t own = joint_entry(work, i, work, i, 30);

            most = own > most ? own : most;
        }
    }
    return most > 0 ? fix_bits((uint64_t)most) - 30 : 0;
}

/* Half of n bits, rounded up. */
static int half_up(int n)
{
    return n >= 0 ? (n + 1) / 2 : -(-n / 2);
}

/*
 * Scale the rows so that no diagonal entry of K is above 1, then none of A is. Returns true if the
 * turns must be set anew. Turns that were cut to their range hide how long they are, so this goes
 * on until the entries are short; only the first time they may also be lengthened.
 */
static bool scale_rows(struct joint_work *work, bool first)
{
    int linear = half_up(bits_above(work, false)), angular = half_up(bits_above(work, true));

    if (!first) {
        linear = linear > 0 ? linear : 0;
        angular = angular > 0 ? angular : 0;
    }
    work->down = (int8_t)(work->down + linear);
    work->length_bits = (int8_t)(work->length_bits - angular);
    return linear != 0 || angular != 0;
}

/*
 * Invert a positive definite matrix in place, pivot by pivot: d = 1 / m_kk, m_ij -= m_ik m_kj d.
 * Entries of the inverse are below 2^30 over the least eigenvalue, which PIVOT_MIN_Q30 bounds. A
 * row whose pivot is too small becomes 0.
 */
static void invert(int64_t m[JOINT_ROWS][JOINT_ROWS], int n)
{
    bool without[JOINT_ROWS] = {false};

    for (int k = 0; k < n; k++) {
        struct fix_scaled d;

        if (m[k][k] < PIVOT_MIN_Q30) {
            without[k] = true;
            for (int i = 0; i < n; i++) {
                m[i][k] = m[k][i] = 0;
            }
            continue;
        }
        d = fix_scaled_inverse(fix_scale(m[k][k], 30));
        for (int i = 0; i < n; i++) {
            struct fix_scaled part;

            if (i == k) {
                continue;
            }
            part = fix_scale(fix_mul_scaled(m[i][k], d), 30);
            for (int j = 0; j < n; j++) {
                if (j != k) {
                    m[i][j] -= fix_mul_scaled(m[k][j], part);
                }
            }
        }
        for (int i = 0; i < n; i++) {
            if (i != k) {
                m[i][k] = -fix_mul_scaled(m[i][k], d);
                m[k][i] = fix_mul_scaled(m[k][i], d);
            }
        }
        m[k][k] = fix_mul_scaled(CAROM_ONE_Q30, d);
    }
    for (int k = 0; k < n; k++) {
        m[k][k] = without[k] ? 0 : m[k][k];
    }
}

/* Set K^-1, to 30 bits of its largest entry. */
static void invert_k(struct joint_work *work)
{
    int64_t k_q30[JOINT_ROWS][JOINT_ROWS];
    uint64_t all = 0;
    int n = work->rows, over, last = n - 1;

    for (int i = 0; i < n; i++) {
        for (int k = 0; k <= i; k++) {
            k_q30[i][k] = k_q30[k][i] = carom_round(joint_entry(work, i, work, k, 60), 30);
        }
    }
    invert(k_q30, n);
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < n; k++) {
            all |= (uint64_t)carom_abs(k_q30[i][k]);
        }
    }
    over = fix_bits(all) - 30;
    CAROM_ASSERT(over >= 0); /* each linear row's own entry of K is at most 1, but for rounding */
    work->inverse_bits = (int8_t)(30 - over);
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < n; k++) {
            work->inverse[i][k] = (int32_t)(k_q30[i][k] >> over);
        }
    }
    for (int i = 0; i < n && work->held < n; i++) {
        /*
         * if K is near 1 a row of K^-1 is at most some 2^3 times as long as the last row's own
         * entry
         */
        work->ratio_q28[i] =
            work->inverse[last][last] > 0
                ? rest_clamp(carom_shl(work->inverse[i][last], 28) / work->inverse[last][last])
                : 0;
    }
}

bool joint_prepare(struct joint *j, const struct carom_joint_drive *drive,
                   const struct body *lightest)
{
    struct joint_work *work = &j->work;

    prepare_joint_shares(work, lightest);
    work->down = 0;
    work->length_bits =
        (work->lever[0].body ? work->lever[0].body : work->lever[1].body)->def.unit_bits;
    for (bool first = true, scaled = true; scaled; first = false) {
        for (int s = 0; s < 2; s++) {
            if (work->lever[s].body && !prepare_turns(work, &work->lever[s])) {
                return false;
            }
        }
        scaled = scale_rows(work, first);
    }
    invert_k(work);
    for (int i = 0; i < work->rows; i++) {
        work->speed_q40[i] = joint_speed_q40(work, i);
        work->change_q40[i] = work->wanted_q40[i] - (work->by_speed ? work->speed_q40[i] : 0);
    }
    if (work->held < work->rows && work->law.spring) {
        joint_prepare_spring(work, drive);
    }
    return true;
}

/* -------------------------------------------------------------------- velocities */

/* spin x r at a lever. */
static void turn_velocity(const struct joint_lever *lever, const int64_t spin_q40[3],
                          int64_t out[3])
{
    for (int k = 0; k < 3; k++) {
        int m = fix_next(k), n = fix_next(m);

        out[k] = fix_mul(spin_q40[m], lever->arm[n], lever->arm_bits) -
                 fix_mul(spin_q40[n], lever->arm[m], lever->arm_bits);
    }
}

/* The velocity at a lever of a body that answers, or its spin. */
static void own_velocity(const struct joint_lever *lever, bool angular, int64_t out[3])
{
    const struct body *b = lever->body;

    if (angular) {
        memcpy(out, b->solve.spin.c, sizeof b->solve.spin.c);
        return;
    }
    turn_velocity(lever, b->solve.spin.c, out);
    for (int k = 0; k < 3; k++) {
        out[k] += b->solve.velocity.c[k];
    }
}

int64_t joint_led_speed_q40(const struct joint_work *work, int row)
{
    const struct joint_lever *lever = &work->lever[1];
    carom_v3_q40 arm, v;

    if (!work->led) {
        return 0;
    }
    v = work->led->def.extra->route.spin;
    if (!joint_is_angular(work, row)) {
        for (int k = 0; k < 3; k++) {
            arm.c[k] = fix_round_shift(lever->arm[k], 40 - lever->arm_bits);
        }
        body_route_velocity(work->led, &arm, &v);
    }
    return -fix_dot_q30(v.c, work->direction[row]);
}

int64_t joint_speed_q40(const struct joint_work *work, int row)
{
    int64_t sum = joint_led_speed_q40(work, row), at[3];

    for (int s = 0; s < 2; s++) {
        if (work->lever[s].body) {
            own_velocity(&work->lever[s], joint_is_angular(work, row), at);
            sum += s == 0 ? fix_dot_q30(at, work->direction[row])
                          : -fix_dot_q30(at, work->direction[row]);
        }
    }
    return sum;
}

/* --------------------------------------------------------------------------- units */

int64_t joint_largest_q40(const struct joint *j)
{
    const struct joint_work *work = &j->work;
    int64_t most = 0;

    for (int i = 0; i < work->rows; i++) {
        int64_t v = work->change_q40[i];

        if (i >= work->held) {
            v = carom_abs(work->speed_q40[i]) + carom_abs(work->least_q40) +
                (work->law.spring ? carom_abs(work->spring_q40) : 0);
        }
        v = carom_abs(fix_round_shift(v, joint_row_shift(work, i)));
        most = v > most ? v : most;
    }
    return most;
}

static int32_t in_units(const struct joint_work *work, int row, int64_t v_q40, int unit)
{
    const int64_t most = (int64_t)1 << 60;
    int shift = joint_row_shift(work, row) - unit;

    v_q40 = v_q40 > most ? most : v_q40 < -most ? -most : v_q40;
    return rest_within(fix_round_shift(v_q40, shift < 2 ? shift : 2), 1 << 27);
}

/* An impulse of a row in solver units. */
static int64_t impulse_in_units(const struct joint_work *work, int row, int64_t p_q40, int unit)
{
    struct fix_scaled by = work->lightest->def.inverse_mass;
    const int64_t most = (int64_t)1 << 58;

    by.e += unit + joint_row_shift(work, row) - JOINT_FINE_BITS;
    if (fix_bits((uint64_t)carom_abs(p_q40)) + 30 - by.e > 58) {
        return p_q40 < 0 ? -most : most;
    }
    return fix_mul_scaled(p_q40, by);
}

/* Set a joint's velocities in solver units, and no impulses. */
void joint_begin(struct joint *j, const struct joint_state *state, const struct rest_sweep *sw)
{
    struct joint_work *work = &j->work;
    struct joint_law *law = &work->law;
    int last = work->rows - 1;

    for (int i = 0; i < work->rows; i++) {
        work->before[i] =
            in_units(work, i, i < work->held ? -work->change_q40[i] : work->speed_q40[i], sw->unit);
        work->gain[i] = work->way[i] = 0;
    }
    if (work->held == work->rows) {
        return;
    }
    if (work->stops) {
        law->low_v = law->high_v = 0;
    } else {
        law->low_v = in_units(work, last, work->speed_q40[last] + work->low_q40, sw->unit);
        law->high_v = in_units(work, last, work->speed_q40[last] + work->high_q40, sw->unit);
    }
    law->motor_v = work->stops ? 0 : in_units(work, last, state->drive.motor_speed_q40, sw->unit);
    law->most = impulse_in_units(work, last, work->most_q40, sw->unit);
    law->spring_v = in_units(work, last, work->speed_q40[last] + work->spring_q40, sw->unit);
    if (law->spring) {
        int64_t push_q40 = work->push_q40;

        if (law->soft_q30 == 0) {
            push_q40 -= work->elastic_q40 + joint_product_q40(work->stiff_q40, work->rate_q40);
        }
        law->push = fix_mul_q30(impulse_in_units(work, last, push_q40, sw->unit),
                                CAROM_ONE_Q30 - law->soft_q30);
    }
}

void joint_load(struct joint *j, const struct joint_state *state, const struct rest_sweep *sw)
{
    for (int i = 0; i < j->work.rows; i++) {
        j->work.impulse[i] = impulse_in_units(&j->work, i, state->impulse_q40[i], sw->unit);
    }
}

/* An impulse of a row as momentum, at most 2^57. */
static int64_t impulse_q40(const struct joint_work *work, int row, int unit)
{
    const int64_t most = (int64_t)1 << 57;
    struct fix_scaled by = work->lightest->def.mass;

    by.e += JOINT_FINE_BITS - unit - joint_row_shift(work, row);
    if (fix_bits((uint64_t)carom_abs(work->impulse[row])) + 30 - by.e > 57) {
        return work->impulse[row] < 0 ? -most : most;
    }
    return fix_mul_scaled(work->impulse[row], by);
}

void joint_end(struct joint *j, const struct rest_sweep *sw)
{
    struct joint_work *work = &j->work;

    memset(&work->push, 0, sizeof work->push);
    memset(&work->moment, 0, sizeof work->moment);
    for (int i = 0; i < work->rows; i++) {
        int64_t p = impulse_q40(work, i, sw->unit);
        int64_t *to = joint_is_angular(work, i) ? work->moment.c : work->push.c;

        for (int k = 0; k < 3; k++) {
            to[k] += fix_mul_q30(p, work->direction[i][k]);
        }
        work->row_q40[i] = p;
    }
}

void joint_apply(struct rest *r, const struct joint *j)
{
    const struct joint_work *work = &j->work;

    for (int s = 0; s < 2; s++) {
        const struct joint_lever *lever = &work->lever[s];
        struct body_state *state;
        const int64_t *p = work->push.c;
        int64_t limited[3], back[3];

        if (!lever->body) {
            continue;
        }
        state = &r->states[s == 0 ? j->a : j->b];
        for (int k = 0; k < 3; k++) {
            limited[k] = lever->arm_bits < 30 ? joint_limited(p[k], 30 + lever->arm_bits) : p[k];
        }
        turn_velocity(lever, limited, back); /* P x r */
        for (int k = 0; k < 3; k++) {
            int64_t moment = work->moment.c[k] - back[k];

            state->momentum.c[k] += s == 0 ? p[k] : -p[k];
            state->angular.c[k] += s == 0 ? moment : -moment;
        }
    }
}
