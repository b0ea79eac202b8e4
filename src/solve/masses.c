/* SPDX-License-Identifier: MIT */
/* What an impulse at a contact changes: K, and steps of the sweeps. */
#include "rows.h"
#include "parts.h"

/*
 * R J^-1 R^T over the unit of length squared. Its largest entry is on the diagonal and at most the
 * trace, three times as large as before: two bits are given away.
 */
void rest_prepare_body(struct body *b)
{
    const carom_m3_q30 *r = &b->path.start.r;
    int32_t half[3][3];

    PHASE_BEGIN(b->path.phase, BODY_SOLVE);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            int32_t column[3];

            for (int j = 0; j < 3; j++) {
                column[j] = b->mesh->inverse.m[fix_sym3_at[j][k]];
            }
            half[i][k] = (int32_t)carom_round(carom_dot(r->c[i], column), 30);
        }
    }
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k <= i; k++) {
            body_solve(b)->turning.m[fix_sym3_at[i][k]] =
                (int32_t)carom_round(carom_dot(half[i], r->c[k]), 32);
        }
    }
    body_solve(b)->turning.e = b->mesh->inverse.e - 2 - 2 * (b->unit_bits - 22);
}

/* The turn by an impulse on one side, and what it adds to K. */
static void prepare_side(const struct contact_side *side, struct contact_lever *lever,
                         int64_t k_q30[6])
{
    const struct carom_sym3 *turning = &body_solve(side->body)->turning;
    int64_t turn[3][3], part[3];
    const bool whole = lever->share_q30 == CAROM_ONE_Q30;
    uint64_t all = 0;
    int down;

    /* row i of T (arm x P) is P.(T_i x arm) */
    for (int i = 0; i < 3; i++) {
        const uint8_t *at = fix_sym3_at[i];
        const int32_t row[3] = {turning->m[at[0]], turning->m[at[1]], turning->m[at[2]]};

        fix_cross(turn[i], row, side->arm_q30);
        for (int k = 0; k < 3; k++) {
            all |= (uint64_t)(turn[i][k] ^ (turn[i][k] >> 63));
        }
    }
    /* a thin body turns fast about its axis: 30 bits whatever the size, but no more than 50 below */
    down = fix_bits(all) - 30;
    down = down > turning->e - 20 ? down : turning->e - 20;
    lever->turn_bits = 30 + turning->e - down;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            int64_t t = turn[i][k];
            int32_t entry = (int32_t)fix_round_shift(t, -down);

            lever->turn[i][k] = whole ? entry : carom_mul_q30(entry, lever->share_q30);
        }
    }
    /* what an impulse along axis i changes the velocity by */
    for (int i = 0; i < 3; i++) {
        const int32_t spin[3] = {lever->turn[0][i], lever->turn[1][i], lever->turn[2][i]};

        fix_cross(part, spin, side->arm_q30);
        for (int k = 0; k <= i; k++) {
            k_q30[fix_sym3_at[i][k]] += carom_round(part[k], lever->turn_bits);
        }
        k_q30[fix_sym3_at[i][i]] += lever->share_q30;
    }
}

/* The lighter body's mass, and each body's share of it. */
static void prepare_shares(struct contact *c)
{
    const struct body *a = c->side[0].body, *b = c->side[1].body;

    c->work->mass_unit = a ? a->mass : b->mass;
    if (a && b && fix_mul_scaled(CAROM_ONE_Q30, b->mass) < fix_mul_scaled(CAROM_ONE_Q30, a->mass)) {
        c->work->mass_unit = b->mass;
    }
    for (int s = 0; s < 2; s++) {
        const struct contact_side *side = &c->side[s];
        struct contact_lever *lever = &c->work->lever[s];

        if (!side->body) {
            continue;
        }
        if (side->body->mass.m == c->work->mass_unit.m &&
            side->body->mass.e == c->work->mass_unit.e) {
            lever->share_q30 = CAROM_ONE_Q30;
        } else {
            int64_t unit_q40 = fix_mul_scaled((int64_t)1 << 40, c->work->mass_unit);

            lever->share_q30 = (int32_t)(fix_mul_scaled(unit_q40, side->body->inverse_mass) >> 10);
        }
    }
}

/* The adjugate of K in 30 bits, and its determinant. */
static int32_t adjugate(int32_t out_q30[6], const int32_t k[6])
{
    static const uint8_t minor[6][4] = {{1, 2, 4, 4}, {2, 0, 5, 5}, {0, 1, 3, 3},
                                        {5, 4, 3, 2}, {3, 5, 4, 0}, {3, 4, 5, 1}};

    for (int i = 0; i < 6; i++) {
        const uint8_t *m = minor[i];

        out_q30[i] =
            (int32_t)carom_round((int64_t)k[m[0]] * k[m[1]] - (int64_t)k[m[2]] * k[m[3]], 30);
    }
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

/*
 * Where K is large impulses are small: their unit is made smaller in turn. Matrices and steps that
 * are inverse to K keep their numbers and lose fractional bits.
 */
static void refine_unit(struct contact *c, int64_t along_q30)
{
    int bits = fix_bits((uint64_t)along_q30) - 30;

    c->work->fine_bits = (int8_t)(bits > 0 ? bits : 0);
    c->work->mass_unit.e += c->work->fine_bits;
    for (int s = 0; s < 2; s++) {
        c->work->lever[s].share_q30 >>= c->work->fine_bits;
        c->work->lever[s].turn_bits += c->work->fine_bits;
    }
}

/*
 * K^-1 for a contact that sticks; for one that slides, steps along N and across. The larger
 * eigenvalue of K across N never overshoots: with T = trace and D = N.adj(K) N that is
 * T/2 + sqrt(T^2/4 - D).
 */
static void prepare_steps(struct contact *c, const int64_t k_q30[6])
{
    /* 29 bits, so that minors fit; K is at least 1, the lighter body alone gives that */
    int shift = fix_bits((uint64_t)(k_q30[0] | k_q30[1] | k_q30[2])) - 29;
    int32_t k[6], adjoint[6], n[3], det, half, product, root;
    int64_t along_q30, across_q30, most;

    for (int i = 0; i < 6; i++) {
        k[i] = (int32_t)(k_q30[i] >> shift);
    }
    det = adjugate(adjoint, k);
    PHASE_BEGIN(c->work->phase, CONTACT_INVERSE);
    c->work->inverted = det >= 1 << 9;
    if (c->work->inverted) {
        int up = 30 - fix_bits32((uint32_t)det);
        int32_t inverse = (int32_t)(((int64_t)1 << 59) / carom_shl(det, up)); /* 30 bits */

        for (int i = 0; i < 6; i++) {
            contact_inverse(c)[i] =
                (int32_t)fix_round_shift((int64_t)adjoint[i] * inverse, up - 29 - shift);
        }
    }
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
    refine_unit(c, along_q30);
    most = across_q30 > along_q30 ? across_q30 : along_q30;
    c->work->mass_q24 = rest_clamp(most >> (6 + c->work->fine_bits));
}

void rest_prepare_masses(struct contact *c)
{
    int64_t k_q30[6] = {0};

    prepare_shares(c);
    for (int s = 0; s < 2; s++) {
        if (c->side[s].body) {
            prepare_side(&c->side[s], &c->work->lever[s], k_q30);
        }
    }
    prepare_steps(c, k_q30);
}
