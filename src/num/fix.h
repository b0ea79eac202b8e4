/* SPDX-License-Identifier: MIT */
/*
 * fix - division, square root, normalisation, and products wider than 64 bits.
 *
 * Functions short enough to be inline everywhere are in carom_fix.h; the rest is here.
 */
#ifndef CAROM_SRC_FIX_H
#define CAROM_SRC_FIX_H

#include "carom_fix.h"

/*
 * Before a loop of three. At -O2 GCC counts such loops, which takes as long as their work. Empty on
 * boards that are short of room for code.
 */
#ifndef FIX_UNROLL
#if defined(__GNUC__) && !defined(__clang__) && !defined(__OPTIMIZE_SIZE__)
#define FIX_UNROLL _Pragma("GCC unroll 3")
#else
#define FIX_UNROLL
#endif
#endif

/*
 * Before a function that GCC would copy into its callers where that takes more room than calling
 * it.
 */
#if defined __GNUC__ && defined __OPTIMIZE_SIZE__
#define FIX_APART __attribute__((noinline))
#else
#define FIX_APART
#endif

/*
 * A function that keeps its locals out of its caller's frame, because a deep chain of calls does
 * not go through it.
 */
#if defined __GNUC__
#define FIX_OWN_FRAME __attribute__((noinline))
#else
#define FIX_OWN_FRAME
#endif

/* The four library functions that the engine may call; <string.h> is not freestanding. */
void *memcpy(void *restrict to, const void *restrict from, size_t bytes);
void *memmove(void *to, const void *from, size_t bytes);
void *memset(void *to, int value, size_t bytes);
int memcmp(const void *a, const void *b, size_t bytes);

/* Debug builds (-DCAROM_DEBUG) carry the bounds arguments of the comments as assertions. */
#ifdef CAROM_DEBUG
_Noreturn void carom_assert_failed(const char *text, const char *file, int line);
#define CAROM_ASSERT(condition)                                                                    \
    ((condition) ? (void)0 : carom_assert_failed(#condition, __FILE__, __LINE__))
#else
#define CAROM_ASSERT(condition) ((void)0)
#endif

/* A number m * 2^-e whose mantissa is kept in 30 bits: 2^29 <= |m| < 2^30, or m = 0. */
struct fix_scaled {
    int32_t m;
    int32_t e;
};

/* A 128-bit two's complement integer, for sums of 64 x 64 bit products. Arithmetic wraps. */
struct fix_wide {
    int64_t hi;
    uint64_t lo;
};

/* Number of bits of v: 0 for 0, 32 for 2^31; 64 for 2^63. */
inline int fix_bits32(uint32_t v)
{
#if defined __GNUC__ && UINT_MAX == 0xffffffff
    return v ? 32 - __builtin_clz(v) : 0;
#else
    int bits = 0;

    for (int step = 16; step > 0; step >>= 1) {
        if (v >> step) {
            v >>= step;
            bits += step;
        }
    }
    return bits + (v != 0);
#endif
}

inline int fix_bits(uint64_t v)
{
    uint32_t high = (uint32_t)(v >> 32);

    return high ? 32 + fix_bits32(high) : fix_bits32((uint32_t)v);
}

/* Bits of the largest of |x|, |y| and |z|. */
int fix_bits3(const int64_t v[3]);

/* floor(sqrt(v)), exact for every v. */
uint32_t fix_sqrt(uint64_t v);

/* At least sqrt(v), by less than one part in 2^14 and one; half the cost. */
int64_t fix_sqrt_above(uint64_t v);

/*
 * a * b / 2^s to nearest; 1 <= s <= 62, b > INT32_MIN; the result must fit. The product may take 95
 * bits: a = high 2^32 + low with low unsigned. Quick where s is a constant.
 */
#if defined __OPTIMIZE_SIZE__ && !defined CAROM_FIX_BODIES
int64_t fix_mul(int64_t a, int32_t b, int s);
int64_t fix_mul_q30(int64_t a, int32_t b);
int64_t fix_dot_q30(const int64_t v[3], const int32_t d_q30[3]);
#else
inline int64_t fix_mul(int64_t a, int32_t b, int s)
{
    const int64_t high = (a >> 32) * b, low = (int64_t)(uint32_t)a * b;

    CAROM_ASSERT(s >= 1 && s <= 62 && b != INT32_MIN);
    if (s > 32) {
        /*
         * |high| <= 2^62 and |low| < 2^63 - 2^32, which leaves room for the half that is added. The
         * low 32 bits cannot carry past the half, a multiple of 2^32.
         */
        return carom_round(high + (low >> 32), s - 32);
    }
    /*
     * high 2^32 is a whole multiple of 2^s: only the low part is rounded. The high part alone may not
     * fit where the sum does, so they are added modulo 2^64.
     */
    return (int64_t)((uint64_t)carom_shl(high, 32 - s) + (uint64_t)carom_round(low, s));
}

/* A number in any format times one in q30. */
inline int64_t fix_mul_q30(int64_t a, int32_t b)
{
    return fix_mul(a, b, 30);
}

/* The part of a vector along a direction: each product is rounded. */
inline int64_t fix_dot_q30(const int64_t v[3], const int32_t d_q30[3])
{
    return fix_mul_q30(v[0], d_q30[0]) + fix_mul_q30(v[1], d_q30[1]) + fix_mul_q30(v[2], d_q30[2]);
}
#endif

/* v 2^s, cut off when s is negative; -62 < s, and the result must fit. */
inline int64_t fix_shift(int64_t v, int s)
{
    return s < 0 ? v >> -s : carom_shl(v, s);
}

/* carom_round that takes s = 0, too. */
inline int64_t fix_round(int64_t v, int s)
{
    return (v + ((int64_t)1 << s >> 1)) >> s;
}

/* v 2^s, to nearest when s is negative, whatever s; the result must fit. */
int64_t fix_round_shift(int64_t v, int s);

/*
 * (high 2^bits + low) / 2^s to nearest; |high|, |low| < 2^63. Either part alone may not fit where the
 * sum does, so they are added modulo 2^64.
 */
int64_t fix_round_parts(int64_t high, int64_t low, int bits, int s);

/* |v|, v > INT32_MIN; the smaller and the larger of two. */
static inline int32_t fix_abs32(int32_t v)
{
    return v < 0 ? -v : v;
}

static inline int32_t fix_smaller(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static inline int32_t fix_larger(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

/* The axis after another: 1, 2, 0. Less code than a remainder. */
static inline int fix_next(int axis)
{
    return axis < 2 ? axis + 1 : 0;
}

/* The largest of |x|, |y| and |z|, each above INT32_MIN. */
static inline int32_t fix_largest(const int32_t v[3])
{
    return fix_larger(fix_larger(fix_abs32(v[0]), fix_abs32(v[1])), fix_abs32(v[2]));
}

/* a x b, exact; each component of both above INT32_MIN: two products are below 2^63. */
inline void fix_cross(int64_t out[3], const int32_t a[3], const int32_t b[3])
{
    out[0] = (int64_t)a[1] * b[2] - (int64_t)a[2] * b[1];
    out[1] = (int64_t)a[2] * b[0] - (int64_t)a[0] * b[2];
    out[2] = (int64_t)a[0] * b[1] - (int64_t)a[1] * b[0];
}

/* |x| + |y| + |z|; each below 2^62 */
inline uint64_t fix_sum(const int64_t v[3])
{
    return (uint64_t)carom_abs(v[0]) + (uint64_t)carom_abs(v[1]) + (uint64_t)carom_abs(v[2]);
}

/* a * b as a 128-bit number, exact. */
struct fix_wide fix_wide_mul(int64_t a, int64_t b);
/* Sums are formed in place: sum += v, sum -= v, sum += a b, sum += a . b; sum 2^s, 0 <= s < 64. */
void fix_wide_add(struct fix_wide *sum, const struct fix_wide *v);
void fix_wide_subtract(struct fix_wide *sum, const struct fix_wide *v);
void fix_wide_add_product(struct fix_wide *sum, int64_t a, int64_t b);
void fix_wide_add_dot(struct fix_wide *sum, const int64_t a[3], const int64_t b[3]);
void fix_wide_shift_up(struct fix_wide *sum, int s);
/* -1, 0 or 1. */
int fix_wide_sign(const struct fix_wide *a);
/* Bits of |a|. */
int fix_wide_bits(const struct fix_wide *a);
/* floor(a / 2^s) truncated to 64 bits; 0 <= s <= 127. */
int64_t fix_wide_shift(const struct fix_wide *a, int s);
/* floor(a / 2^s); 0 <= s < 64. */
struct fix_wide fix_wide_down(const struct fix_wide *a, int s);
/* The bits of the largest of three. */
int fix_wide_bits3(const struct fix_wide a[3]);

/*
 * a / b as mantissa and exponent, accurate to 2^-29 of the quotient. b != 0 (0 gives 0).
 * Used once a mesh or an impact, never in an inner loop.
 */
struct fix_scaled fix_wide_ratio(const struct fix_wide *a, const struct fix_wide *b);
/* The same over a number of 64 bits, and of two of them. */
struct fix_scaled fix_wide_over(const struct fix_wide *a, int64_t b);
struct fix_scaled fix_ratio(int64_t a, int64_t b);

/* v as mantissa and exponent: value = v * 2^-q. Truncates below 30 bits, to nearest. */
struct fix_scaled fix_scale(int64_t v, int q);

/* 1 / s, s > 0; accurate to one unit of the mantissa. */
struct fix_scaled fix_scaled_inverse(struct fix_scaled s);

/* v * s in the format of v, to nearest; the result must fit. */
int64_t fix_mul_scaled(int64_t v, struct fix_scaled s);
/* And those of a vector; out may be v. */
void fix_mul_scaled3(int64_t out[3], const int64_t v[3], struct fix_scaled s);

/* Length of a vector of int64 components, rounded up by at most one part in 2^26; exact for 0. */
int64_t fix_length(const int64_t v[3]);

/* At least |v|, at most 1.23 of it. */
int64_t fix_length_bound(const int64_t v[3]);

/*
 * Unit vector along v; returns false, and leaves out alone, when v is 0.
 * Error: each component within 2 units of the last place of q30.
 */
bool fix_normalise(carom_v3_q30 *out, const int64_t v[3]);

/* The matrix of a rotation. Range: components below 2^31, so that two products are below 2^63. */
void fix_matrix(carom_m3_q30 *m, const carom_quat_q30 *q);

/*
 * The rotation that leads from one to the other, in the axes of `from`: from^-1 to, within 2 units of the last place.
 * Range: lengths up to 1.001.
 */
void fix_turn_between(carom_quat_q30 *out, const carom_quat_q30 *from, const carom_quat_q30 *to);

/* out = m v / 2^30 and its transpose, for int64 vectors of any format; out may be v. */
void fix_rotate(int64_t out[3], const carom_m3_q30 *m, const int64_t v[3]);
void fix_rotate_back(int64_t out[3], const carom_m3_q30 *m, const int64_t v[3]);

/* out = m v in plain integers: three products of at most 30 and 31 bits stay below 2^63. */
inline void fix_sym3_dot(int64_t out[3], const int32_t m[6], const int32_t v[3])
{
    const int32_t x = v[0], y = v[1], z = v[2];

    out[0] = (int64_t)m[0] * x + (int64_t)m[3] * y + (int64_t)m[5] * z;
    out[1] = (int64_t)m[3] * x + (int64_t)m[1] * y + (int64_t)m[4] * z;
    out[2] = (int64_t)m[5] * x + (int64_t)m[4] * y + (int64_t)m[2] * z;
}

/* Where entry (i, k) of a symmetric matrix is among xx yy zz xy yz zx. */
extern const uint8_t fix_sym3_at[3][3];

#endif
