/* SPDX-License-Identifier: MIT */
/* Changes by an impulse at a contact: K, shares and steps of the sweeps. */
#include "rows.h"
#include "parts.h"

void rest_prepare_body(struct body *b)
{
    const carom_m3_q30 *r = &b->path.start.r;

    PHASE_BEGIN(b->path.phase, BODY_SOLVE);
    b->solve.turn_bits = (int8_t)(b->def.mesh->spread.reach_bits + 1);
    /* a column is below sqrt(3) 2^30 */
    FIX_UNROLL
    for (int j = 0; j < 3; j++) {
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            body_solve(b)->columns[j][k] =
                (int32_t)carom_round(carom_dot(r->c[k], b->def.mesh->spread.column[j]), 30);
        }
    }
}

static inline bool too_long(int64_t turn)
{
    return turn >= CAROM_ONE_Q30 || turn <= -CAROM_ONE_Q30;
}

/*
 * Set how du moves the place of a contact on one side. Returns false if that takes more turn_bits.
 */
static bool prepare_turn(const struct contact_side *side, struct contact_lever *lever)
{
    struct body *b = side->body;
    int more = b->solve.turn_bits + contact_arm_bits(b) - 31;

    FIX_UNROLL
    for (int j = 0; j < 3; j++) {
        int down = more + b->def.mesh->spread.e[j];
        int64_t turn[3];

        fix_cross(turn, body_solved(b)->columns[j], side->arm_q30);
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            turn[k] = down > 0 ? carom_round(turn[k], down) : carom_shl(turn[k], -down);
        }
        if (too_long(turn[0]) || too_long(turn[1]) || too_long(turn[2])) {
            if (b->solve.turn_bits < REST_TURN_BITS_MAX) {
                b->solve.turn_bits++;
                return false;
            }
            for (int i = 0; i < 3; i++) {
                turn[i] = rest_within(turn[i], CAROM_ONE_Q30 - 1);
            }
        }
        FIX_UNROLL
        for (int k = 0; k < 3; k++) {
            lever->turn[k][j] = (int32_t)turn[k];
        }
    }
    return true;
}

/* 1 + turn turn^T */
static void find_own_k(int64_t k_q30[6], const int32_t turn[3][3], int turn_bits)
{
    int down = 32 - 2 * turn_bits;

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        k_q30[k] = CAROM_ONE_Q30 + carom_round(carom_dot(turn[k], turn[k]), down);
        k_q30[3 + k] = carom_round(carom_dot(turn[k], turn[fix_next(k)]), down);
    }
}

/* K: the sum over the sides of share (1 + turn turn^T). */
static void find_k(const struct contact *c, int64_t k_q30[6])
{
    memset(k_q30, 0, 6 * sizeof k_q30[0]);
    for (int s = 0; s < 2; s++) {
        const struct contact_lever *lever = &c->work->lever[s];
        int64_t own_q30[6];

        if (!c->side[s].body) {
            continue;
        }
        find_own_k(own_q30, lever->turn, c->side[s].body->solve.turn_bits);
        for (int n = 0; n < 6; n++) {
            k_q30[n] += lever->share_q30 == CAROM_ONE_Q30
                            ? own_q30[n]
                            : fix_mul_q30(own_q30[n], lever->share_q30);
        }
    }
}

/* Set the lighter body, and each body's share of its mass. */
static void prepare_shares(struct contact *c)
{
    const struct body *a = c->side[0].body, *b = c->side[1].body;
    struct fix_scaled unit;

    c->work->b_lighter =
        b && (a->def.mass.m != b->def.mass.m || a->def.mass.e != b->def.mass.e) &&
        fix_mul_scaled(CAROM_ONE_Q30, b->def.mass) < fix_mul_scaled(CAROM_ONE_Q30, a->def.mass);
    unit = contact_lighter(c)->def.mass;
    for (int s = 0; s < 2; s++) {
        const struct contact_side *side = &c->side[s];
        struct contact_lever *lever = &c->work->lever[s];

        if (!side->body) {
            continue;
        }
        if (side->body->def.mass.m == unit.m && side->body->def.mass.e == unit.e) {
            lever->share_q30 = CAROM_ONE_Q30;
        } else {
            int64_t unit_q40 = fix_mul_scaled((int64_t)1 << 40, unit);

            lever->share_q30 =
                (int32_t)(fix_mul_scaled(unit_q40, side->body->def.inverse_mass) >> 10);
        }
    }
}

/*
 * Impulses have a finer unit than velocities, by 5 bits and those that K has above 1: a place that
 * gives way easily needs small impulses.
 */
static void refine_unit(struct contact *c, const int64_t k_q30[6])
{
    c->work->fine_bits = (int8_t)(fix_bits((uint64_t)(k_q30[0] | k_q30[1] | k_q30[2])) - 31 + 5);
}

/* a b - c d in q30 */
static inline int32_t minor_q30(int32_t a, int32_t b, int32_t c, int32_t d)
{
    return (int32_t)carom_round((int64_t)a * b - (int64_t)c * d, 30);
}

/* The adjugate of K, 30 bits; returns the determinant. */
static int32_t adjugate(int32_t out_q30[6], const int32_t k[6])
{
    out_q30[0] = minor_q30(k[1], k[2], k[4], k[4]);
    out_q30[1] = minor_q30(k[2], k[0], k[5], k[5]);
    out_q30[2] = minor_q30(k[0], k[1], k[3], k[3]);
    out_q30[3] = minor_q30(k[5], k[4], k[3], k[2]);
    out_q30[4] = minor_q30(k[3], k[5], k[4], k[0]);
    out_q30[5] = minor_q30(k[3], k[4], k[5], k[1]);
    return (int32_t)carom_round(
        (int64_t)k[0] * out_q30[0] + (int64_t)k[3] * out_q30[3] + (int64_t)k[5] * out_q30[5], 30);
}

/* m v for a symmetric m of six q30 numbers */
static void multiply(int32_t out[3], const int32_t m[6], const int32_t v[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = (int32_t)carom_round(rest_row(m, i, v), 30);
    }
}

/* Shorten K to 29 bits, so that minors fit; returns the shift. */
static int shorten(const int64_t k_q30[6], int32_t k[6])
{
    /* K is at least 1, by the lighter body alone */
    int shift = fix_bits((uint64_t)(k_q30[0] | k_q30[1] | k_q30[2])) - 29;

    for (int i = 0; i < 6; i++) {
        k[i] = (int32_t)(k_q30[i] >> shift);
    }
    return shift;
}

bool rest_prepare_masses(struct contact *c)
{
    int64_t k_q30[6];
    int32_t *k;

    prepare_shares(c);
    for (int s = 0; s < 2; s++) {
        if (c->side[s].body && !prepare_turn(&c->side[s], &c->work->lever[s])) {
            return false;
        }
    }
    find_k(c, k_q30);
    refine_unit(c, k_q30);
    PHASE_BEGIN(c->work->phase, CONTACT_INVERSE);
    k = contact_inverse(c);
    c->work->k_shift = (int8_t)shorten(k_q30, k);
    c->work->waits = true;
    c->work->slides = false;
    c->work->mass_q24 =
        rest_clamp(carom_shl(fix_largest(k), c->work->k_shift) >> (6 + c->work->fine_bits));
    return true;
}

void rest_invert(struct contact *c)
{
    int32_t *k = contact_inverse(c), adjoint[6], det = adjugate(adjoint, k);

    c->work->waits = false;
    c->work->inverted = det >= 1 << 9;
    if (c->work->inverted) {
        int up = 30 - fix_bits32((uint32_t)det);
        int32_t inverse = (int32_t)(((int64_t)1 << 59) / carom_shl(det, up)); /* 30 bits */

        /* up is at most 20 for a determinant of 10 bits; k_shift is at least 2 */
        for (int i = 0; i < 6; i++) {
            k[i] = (int32_t)carom_round((int64_t)adjoint[i] * inverse, 29 + c->work->k_shift - up);
        }
    }
}

/*
 * Set step and drag for sliding. A step of one over the larger eigenvalue of K across N never
 * overshoots; with T = trace and D = N.adj(K) N the eigenvalue is T/2 + sqrt(T^2/4 - D).
 */
void rest_prepare_slide(struct contact *c)
{
    int64_t k_q30[6], along_q30, across_q30;
    int32_t k[6], adjoint[6], n[3], half, product, root;
    int shift;

    find_k(c, k_q30);
    shift = shorten(k_q30, k);
    adjugate(adjoint, k);
    multiply(n, k, c->normal.c);
    product = (int32_t)carom_round(carom_dot(n, c->normal.c), 30);
    along_q30 = carom_shl(product, shift);
    c->work->step[0] = (int32_t)(((int64_t)1 << 60) / along_q30);
    for (int i = 0; i < 3; i++) {
        int64_t drag = n[i] - carom_mul_q30(product, c->normal.c[i]);

        c->work->drag_q28[i] = rest_clamp(fix_round_shift(drag * c->work->step[0], shift - 32));
    }
    half = (int32_t)(((int64_t)k[0] + k[1] + k[2] - product) / 2);
    multiply(n, adjoint, c->normal.c);
    product = (int32_t)carom_round(carom_dot(n, c->normal.c), 30);
    root = carom_mul_q30(half, half) - product;
    root = root > 0 ? (int32_t)fix_sqrt((uint64_t)root << 30) : 0;
    across_q30 = carom_shl((int64_t)half + root, shift);
    c->work->step[1] = (int32_t)(((int64_t)1 << 60) / across_q30);
    c->work->slides = true;
}
