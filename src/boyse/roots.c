/* SPDX-License-Identifier: MIT */
/* P(t) in 32 bits, and a walk over its roots that passes none. */
#include "roots.h"

#define CURVE_BITS 29  /* bits of the sum of all |a_k| */
#define ROUNDS     300 /* never reached: strides grow twofold */
#define NEVER_Q30  ((uint32_t)2 << 30)

/* Division by the upper 32 bits of n and the upper 16 of d. */
uint32_t curve_quotient_q30(uint32_t n, uint32_t d)
{
    int up = 32 - fix_bits32(n), down = 32 - fix_bits32(d), shift;
    uint32_t quotient;

    if (n == 0 || d == 0) {
        return n == 0 ? 0 : UINT32_MAX;
    }
    /* below 2^17; n / d = quotient 2^(down - up - 16) */
    quotient = (n << up) / (((d << down) >> 16) + 1);
    shift = 14 + down - up;
    if (shift >= 0) {
        return shift < 16 ? quotient << shift : UINT32_MAX;
    }
    return quotient >> -shift; /* by at most 17 */
}

bool curve_init(struct curve *q, const int64_t a[BOYSE_DEGREE + 1], int degree)
{
    uint64_t first = (uint64_t)carom_abs(a[0]), reach = 0, sum;

    for (int k = 1; k <= degree; k++) {
        reach += (uint64_t)carom_abs(a[k]);
    }
    if (first > reach + (reach >> 20) + ((uint64_t)1 << 16) || (first | reach) == 0) {
        return false;
    }
    sum = first + reach;
    q->degree = degree;
    q->shift = fix_bits(sum + (sum >> 20)) - CURVE_BITS; /* room for what rounding adds */
    if (q->shift > 0) {
        for (int k = 0; k <= degree; k++) {
            uint32_t low = (uint32_t)a[k] >> q->shift;

            q->a[k] = (int32_t)(low | (uint32_t)((uint64_t)a[k] >> 32) << (32 - q->shift));
        }
    } else {
        for (int k = 0; k <= degree; k++) {
            q->a[k] = (int32_t)carom_shl(a[k], -q->shift);
        }
    }
    q->bend8 = 1;
    for (int k = 2; k <= degree; k++) {
        q->bend8 += k * (k - 1) / 2 * ((fix_abs32(q->a[k]) >> 3) + 1);
    }
    return true;
}

static void curve_slope(const struct curve *q, int32_t t_q30, int32_t *p, int32_t *slope8)
{
    int32_t v = q->a[q->degree], d = 0;

    /* |d| < 6 2^26 */
    for (const int32_t *a = q->a + q->degree; a > q->a; a -= 2) {
        d = curve_times(d, t_q30) + (v >> 3);
        v = curve_times(v, t_q30) + a[-1];
        d = curve_times(d, t_q30) + (v >> 3);
        v = curve_times(v, t_q30) + a[-2];
    }
    *p = v;
    *slope8 = d;
}

/*
 * The longest step s (q30) that cannot pass a root if |P| >= size + 8 d s + 8 c s^2 from here on:
 * up to the first root of that bound. NEVER_Q30 if it has none up to 1. Bounds: size < 2^29, |d| <
 * 2^29, |c| < 2^31, so the discriminant is below 2^58 + 2^59.
 */
static uint32_t safe_step_q30(int32_t size, int32_t d, int32_t c)
{
    int64_t square = (int64_t)d * d, rest = (int64_t)c * (size >> 1);
    uint32_t root;

    if (c >= 0 && (d >= 0 || rest > square)) {
        return NEVER_Q30;
    }
    root = (uint32_t)fix_sqrt_above((uint64_t)(square - rest));
    /* 2 size / (root - d) does not cancel; a root taken too large makes the step short */
    if (d < 0 || root - (uint32_t)d > root / 2) {
        return curve_quotient_q30((uint32_t)size >> 2, root - (uint32_t)d);
    }
    return curve_quotient_q30((uint32_t)d + root - (root >> 13) - 1, 2 * (uint32_t)-c);
}

static void advance(struct walk *walk, uint32_t step_q30)
{
    walk->t_q30 = step_q30 < (uint32_t)(CAROM_ONE_Q30 - walk->t_q30)
                      ? walk->t_q30 + (int32_t)step_q30
                      : CAROM_ONE_Q30;
}

/*
 * Begin at 0, and take the first safe step. At the start all of P is known: |P| >= |a0| + d t + (a2
 * - rest) t^2, rest being the sum of the higher coefficients.
 */
void walk_begin(struct walk *walk, const struct curve *q)
{
    int32_t size = fix_abs32(q->a[0]), d = q->a[1] >> 3, c = q->a[2] >> 3;

    walk->t_q30 = walk->side = walk->rounds = 0;
    walk->stride = BOYSE_STRIDE_Q30;
    if (size > CURVE_NOISE) {
        walk->side = q->a[0] < 0 ? -1 : 1;
        if (walk->side < 0) {
            d = -d - 1;
            c = -c - 1;
        }
        for (int k = 3; k <= q->degree; k++) {
            c -= (fix_abs32(q->a[k]) >> 3) + 1;
        }
        advance(walk, safe_step_q30(size - CURVE_NOISE / 2, d, c));
    }
}

/* A safe step from the present place. 16: slope8 may be too low by as much. */
static uint32_t walk_step_q30(const struct walk *walk, const struct curve *q)
{
    return safe_step_q30(fix_abs32(walk->p), walk->p < 0 ? -walk->slope8 - 16 : walk->slope8,
                         -q->bend8);
}

/*
 * The last step to a root, q30: P's slope alone leads to it, and its bend changes nothing above the
 * noise. 0 if that is not yet so.
 */
static uint32_t last_step_q30(const struct walk *walk, const struct curve *q)
{
    int32_t size = fix_abs32(walk->p), fall8 = walk->p < 0 ? walk->slope8 : -walk->slope8;
    uint32_t step;

    if (fall8 <= 0 || size >> 3 > fall8 >> 8) {
        return 0;
    }
    /* at most 2^30 / 256 */
    step = curve_quotient_q30((uint32_t)size, (uint32_t)fall8) >> 3;
    return (((uint64_t)(uint32_t)q->bend8 * step >> 30) * step) >> 27 < CURVE_NOISE / 2 ? step : 0;
}

bool walk_next(struct walk *walk, const struct curve *q)
{
    while (walk->t_q30 < CAROM_ONE_Q30 && walk->rounds++ < ROUNDS) {
        int32_t side;
        uint32_t step;
        bool crossed;

        curve_slope(q, walk->t_q30, &walk->p, &walk->slope8);
        side = fix_abs32(walk->p) <= CURVE_NOISE ? 0 : walk->p > 0 ? 1 : -1;
        /* rounding may carry t across a root: a change of sign is a root, too */
        crossed = side != 0 && side == -walk->side;
        if (side != 0) {
            walk->side = side;
        }
        if (side == 0 || crossed) {
            return true;
        }
        step = last_step_q30(walk, q);
        if (step > 0) {
            advance(walk, step);
            walk->p = 0;
            return walk->t_q30 < CAROM_ONE_Q30;
        }
        step = walk_step_q30(walk, q);
        CAROM_ASSERT(step > 1); /* |P| is above the noise, and a slope below 2^29 */
        advance(walk, step);
        walk->stride = BOYSE_STRIDE_Q30;
    }
    return false;
}

/*
 * Where P is steep, |P| >= |slope| s - bend s^2 less the noise holds beyond the root; at s = slope
 * / (2 bend) that is above the noise, and has been since the root. Elsewhere step by growing
 * strides while P stays in the noise. The sign found beyond starts anew: it is no root passed by.
 */
void walk_over(struct walk *walk, const struct curve *q)
{
    int64_t steep = fix_abs32(walk->slope8);
    uint32_t step;

    walk->side = 0;
    if (steep * steep > (int64_t)(2 * CURVE_NOISE) * q->bend8) {
        step = curve_quotient_q30((uint32_t)steep, (uint32_t)q->bend8) / 2;
    } else {
        step = walk_step_q30(walk, q);
    }
    if (step < (uint32_t)walk->stride) {
        advance(walk, (uint32_t)walk->stride);
        walk->stride *= 2;
    } else {
        advance(walk, step);
        walk->stride = BOYSE_STRIDE_Q30;
    }
}
