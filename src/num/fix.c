/* SPDX-License-Identifier: MIT */
/* Division, square roots, normalisation and 128-bit arithmetic: what is too long to be inline. */
#include "fix.h"

/*
 * The root of v, 2^30 <= v, within half a unit and a hundredth. Newton's steps end above the root but
 * for rounding; three are enough from (c + v / c) / 2 with c = 2^16, at most a quarter too large.
 */
static uint32_t sqrt_newton(uint32_t v)
{
    uint32_t root = (v >> 17) + ((uint32_t)1 << 15);

    root = (root + v / root + 1) >> 1;
    root = (root + v / root + 1) >> 1;
    return (root + v / root + 1) >> 1;
}

/* floor(sqrt(v)), 2^30 <= v */
static uint32_t sqrt32(uint32_t v)
{
    uint32_t root = sqrt_newton(v);

    while (root > UINT16_MAX || root * root > v) {
        root--;
    }
    return root;
}

uint32_t fix_sqrt(uint64_t v)
{
    int shift = (64 - fix_bits(v)) & ~1;
    uint64_t root;
    uint32_t high;

    if (v == 0) {
        return 0;
    }
    /* 16 bits of the root from the upper half, the others by a step of Newton's from below it */
    v <<= shift;
    high = sqrt32((uint32_t)(v >> 32));
    /* (v - high^2 2^32) / (2 high 2^16), of which 17 bits are shifted out before: less than 2^32 */
    root = (uint32_t)((v - ((uint64_t)(high * high) << 32)) >> 17) / high;
    root += (uint64_t)high << 16;
    /* which ends at most 2 above: half the square of the step over the root is at most 1 */
    while (root > UINT32_MAX || root * root > v) {
        root--;
    }
    return (uint32_t)(root >> (shift / 2));
}

int64_t fix_sqrt_above(uint64_t v)
{
    int shift = (64 - fix_bits(v)) & ~1;

    if (v == 0) {
        return 1;
    }
    /* the upper half of v, rounded down, is less than 1 short */
    return (int64_t)(((uint64_t)sqrt_newton((uint32_t)(v << shift >> 32)) + 1) << 16 >>
                     (shift / 2)) +
           1;
}

int64_t fix_round_parts(int64_t high, int64_t low, int bits, int s)
{
    if (s > bits) {
        /* what low has below 2^bits cannot carry past the half */
        return fix_round_shift(high + (low >> bits), bits - s);
    }
    if (s < 1) {
        return (int64_t)(((uint64_t)carom_shl(high, bits) + (uint64_t)low) << -s);
    }
    return (int64_t)((uint64_t)carom_shl(high, bits - s) + (uint64_t)carom_round(low, s));
}

int64_t fix_round_shift(int64_t v, int s)
{
    if (s >= 0) {
        return carom_shl(v, s);
    }
    return s < -62 ? 0 : carom_round(v, -s);
}

void fix_wide_add(struct fix_wide *sum, const struct fix_wide *v)
{
    uint64_t lo = v->lo;

    sum->lo += lo;
    sum->hi = (int64_t)((uint64_t)sum->hi + (uint64_t)v->hi + (sum->lo < lo));
}

void fix_wide_subtract(struct fix_wide *sum, const struct fix_wide *v)
{
    uint64_t borrow = sum->lo < v->lo;

    sum->lo -= v->lo;
    sum->hi = (int64_t)((uint64_t)sum->hi - (uint64_t)v->hi - borrow);
}

struct fix_wide fix_wide_mul(int64_t a, int64_t b)
{
    /* the high halves are signed: |a1|, |b1| <= 2^31, and so no sum below carries out */
    int32_t a1 = (int32_t)(a >> 32), b1 = (int32_t)(b >> 32);
    uint32_t a0 = (uint32_t)a, b0 = (uint32_t)b;
    uint64_t low = (uint64_t)a0 * b0;
    int64_t mid = (int64_t)a1 * b0 + (int64_t)(low >> 32);
    int64_t mid2 = (int64_t)b1 * a0 + (int64_t)(uint32_t)mid;
    struct fix_wide p;

    p.lo = (uint64_t)mid2 << 32 | (uint32_t)low;
    p.hi = (int64_t)a1 * b1 + (mid >> 32) + (mid2 >> 32);
    return p;
}

void fix_wide_add_product(struct fix_wide *sum, int64_t a, int64_t b)
{
    const struct fix_wide product = fix_wide_mul(a, b);

    fix_wide_add(sum, &product);
}

void fix_wide_add_dot(struct fix_wide *sum, const int64_t a[3], const int64_t b[3])
{
    for (int k = 0; k < 3; k++) {
        fix_wide_add_product(sum, a[k], b[k]);
    }
}

void fix_wide_shift_up(struct fix_wide *sum, int s)
{
    if (s > 0) {
        sum->hi = carom_shl(sum->hi, s) | (int64_t)(sum->lo >> (64 - s));
        sum->lo <<= s;
    }
}

int fix_wide_sign(const struct fix_wide *a)
{
    return a->hi < 0 ? -1 : (a->hi != 0 || a->lo != 0);
}

/* |a|, modulo 2^128 */
static struct fix_wide magnitude(const struct fix_wide *a)
{
    struct fix_wide size = {0, 0};

    if (a->hi >= 0) {
        return *a;
    }
    fix_wide_subtract(&size, a);
    return size;
}

int fix_wide_bits(const struct fix_wide *a)
{
    const struct fix_wide size = magnitude(a);

    return size.hi ? 64 + fix_bits((uint64_t)size.hi) : fix_bits(size.lo);
}

int fix_wide_bits3(const struct fix_wide a[3])
{
    int most = 0;

    for (int k = 0; k < 3; k++) {
        int bits = fix_wide_bits(&a[k]);

        most = bits > most ? bits : most;
    }
    return most;
}

int64_t fix_wide_shift(const struct fix_wide *a, int s)
{
    CAROM_ASSERT(s >= 0 && s <= 127);
    if (s == 0) {
        return (int64_t)a->lo;
    }
    if (s >= 64) {
        return a->hi >> (s - 64);
    }
    return (int64_t)(((uint64_t)a->hi << (64 - s)) | (a->lo >> s));
}

struct fix_wide fix_wide_down(const struct fix_wide *a, int s)
{
    return (struct fix_wide){a->hi >> s, (uint64_t)fix_wide_shift(a, s)};
}

/* |a| as a number of exactly `bits` bits (63 at most) and the exponent that was taken out. */
static uint64_t wide_magnitude(const struct fix_wide *a, int bits, int *e)
{
    const struct fix_wide size = magnitude(a);

    *e = fix_wide_bits(a) - bits;
    return *e >= 0 ? (uint64_t)fix_wide_shift(&size, *e) : size.lo << -*e;
}

struct fix_scaled fix_wide_ratio(const struct fix_wide *a, const struct fix_wide *b)
{
    struct fix_scaled q = {0, 0};
    int ea, eb;

    CAROM_ASSERT(fix_wide_sign(b) != 0);
    if (fix_wide_sign(a) != 0) {
        /* 2^61 / 2^32 < quotient < 2^62 / 2^31: never fewer than 30 bits. */
        uint64_t n = wide_magnitude(a, 62, &ea);
        uint64_t d = wide_magnitude(b, 32, &eb);

        q = fix_scale((int64_t)(n / d), eb - ea);
        if ((a->hi ^ b->hi) < 0) {
            q.m = -q.m;
        }
    }
    return q;
}

struct fix_scaled fix_wide_over(const struct fix_wide *a, int64_t b)
{
    const struct fix_wide wide = fix_wide_mul(b, 1);

    return fix_wide_ratio(a, &wide);
}

struct fix_scaled fix_ratio(int64_t a, int64_t b)
{
    const struct fix_wide wide = fix_wide_mul(a, 1);

    return fix_wide_over(&wide, b);
}

struct fix_scaled fix_scale(int64_t v, int q)
{
    struct fix_scaled s = {0, 0};
    uint64_t magnitude = v < 0 ? 0 - (uint64_t)v : (uint64_t)v;
    int shift = fix_bits(magnitude) - 30;

    if (v == 0) {
        return s;
    }
    if (shift > 0) {
        magnitude = (magnitude + ((uint64_t)1 << (shift - 1))) >> shift;
        if (magnitude >> 30) { /* rounded up to the next power of two */
            magnitude >>= 1;
            shift++;
        }
    } else {
        magnitude <<= -shift;
    }
    s.m = v < 0 ? -(int32_t)magnitude : (int32_t)magnitude;
    s.e = q - shift;
    return s;
}

struct fix_scaled fix_scaled_inverse(struct fix_scaled s)
{
    /* 2^59 / m with 2^29 <= m < 2^30 has 30 or 31 bits. */
    CAROM_ASSERT(s.m > 0);
    return fix_scale((((int64_t)1 << 60) / s.m + 1) >> 1, 59 - s.e);
}

int64_t fix_mul_scaled(int64_t v, struct fix_scaled s)
{
    if (s.e > 62) {
        return fix_round_shift(fix_mul(v, s.m, 62), 62 - s.e);
    }
    if (s.e < 1) {
        return carom_shl(v * s.m, -s.e);
    }
    return fix_mul(v, s.m, s.e);
}

void fix_mul_scaled3(int64_t out[3], const int64_t v[3], struct fix_scaled s)
{
    const bool plain = s.e >= 1 && s.e <= 62;

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        out[k] = plain ? fix_mul(v[k], s.m, s.e) : fix_mul_scaled(v[k], s);
    }
}

int fix_bits3(const int64_t v[3])
{
    return fix_bits((uint64_t)(carom_abs(v[0]) | carom_abs(v[1]) | carom_abs(v[2])));
}

int64_t fix_length(const int64_t v[3])
{
    int shift = fix_bits3(v) - 30;
    uint64_t sum = 0;
    int64_t root;

    if (shift < 0) {
        shift = 0;
    }
    for (int k = 0; k < 3; k++) {
        int64_t c = v[k] >> shift;

        CAROM_ASSERT(c >= -((int64_t)1 << 30) && c <= (int64_t)1 << 30);
        sum += (uint64_t)(c * c); /* |c| <= 2^30: the sum is at most 3 * 2^60 */
    }
    root = fix_sqrt(sum);
    if (shift == 0) {
        return root + ((uint64_t)(root * root) < sum);
    }
    return (root + 3) << shift; /* 1 for the root, sqrt(3) for the bits shifted out */
}

bool fix_normalise(carom_v3_q30 *out, const int64_t v[3])
{
    int shift = fix_bits3(v) - 31;
    int64_t c[3];
    uint64_t sum = 0;
    int64_t length;

    for (int k = 0; k < 3; k++) {
        c[k] = fix_shift(v[k], -shift);
        CAROM_ASSERT(c[k] >= -((int64_t)1 << 31) && c[k] <= (int64_t)1 << 31);
        sum += (uint64_t)(c[k] * c[k]); /* |c| <= 2^31: the sum is at most 3 * 2^62 < 2^64 */
    }
    if (sum == 0) {
        return false;
    }
    length = fix_sqrt(sum);
    for (int k = 0; k < 3; k++) {
        int64_t half = c[k] < 0 ? -(length / 2) : length / 2;

        /* |c| <= length, so the quotient is at most 2^30. */
        out->c[k] = (int32_t)((c[k] * ((int64_t)1 << 30) + half) / length);
    }
    return true;
}

int64_t fix_length_bound(const int64_t v[3])
{
    int64_t x = carom_abs(v[0]), y = carom_abs(v[1]), z = carom_abs(v[2]);
    int64_t most = x > y ? x : y;

    most = most > z ? most : z;
    /* with m the largest: (m + (a + b) / 2)^2 >= m^2 + m (a + b) >= m^2 + a^2 + b^2 */
    return most + (x + y + z - most + 1) / 2;
}

void fix_matrix(carom_m3_q30 *m, const carom_quat_q30 *q)
{
    /* twice each product: a shift of 29 in place of 30 */
    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        int i = fix_next(k), j = fix_next(i);
        int64_t x = q->c[1 + i], y = q->c[1 + j], wz = (int64_t)q->c[0] * q->c[1 + k];

        m->c[k][k] = (int32_t)(CAROM_ONE_Q30 - carom_round(x * x + y * y, 29));
        m->c[i][j] = (int32_t)carom_round(x * y - wz, 29);
        m->c[j][i] = (int32_t)carom_round(x * y + wz, 29);
    }
}

void fix_turn_between(carom_quat_q30 *out, const carom_quat_q30 *from, const carom_quat_q30 *to)
{
    const int32_t *p = from->c, *q = to->c;

    /* products are below 2^60.01, four of them below 2^63 */
    for (int k = 0; k < 3; k++) {
        int i = fix_next(k), j = fix_next(i);

        out->c[1 + k] =
            (int32_t)carom_round((int64_t)p[0] * q[1 + k] - (int64_t)q[0] * p[1 + k] -
                                     (int64_t)p[1 + i] * q[1 + j] + (int64_t)p[1 + j] * q[1 + i],
                                 30);
    }
    out->c[0] = (int32_t)carom_round((int64_t)p[0] * q[0] + carom_dot(p + 1, q + 1), 30);
}

void fix_rotate(int64_t out[3], const carom_m3_q30 *m, const int64_t v[3])
{
    int64_t r[3];

    for (int k = 0; k < 3; k++) {
        r[k] = fix_dot_q30(v, m->c[k]);
    }
    out[0] = r[0];
    out[1] = r[1];
    out[2] = r[2];
}

void fix_rotate_back(int64_t out[3], const carom_m3_q30 *m, const int64_t v[3])
{
    int64_t r[3];

    FIX_UNROLL
    for (int k = 0; k < 3; k++) {
        r[k] = fix_mul_q30(v[0], m->c[0][k]) + fix_mul_q30(v[1], m->c[1][k]) +
               fix_mul_q30(v[2], m->c[2][k]);
    }
    out[0] = r[0];
    out[1] = r[1];
    out[2] = r[2];
}

const uint8_t fix_sym3_at[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
