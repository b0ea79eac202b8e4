/* SPDX-License-Identifier: MIT */
/*
 * The helpers of src/num and the public header: roundings, shifts, counts of bits, products, the axis of a normal.
 *
 * assumed: carom_shl by shifts
 * by hand: __builtin_clz
 * mutant: carom_round in include/carom_fix.h: (v + ((int64_t)1 << (s - 1))) >> s -> (v + ((int64_t)1 << s)) >> s
 * mutant: carom_abs in include/carom_fix.h: return v < 0 ? -v : v; -> return v < 1 ? v : -v;
 * mutant: fix_bits in src/num/fix.h: return high ? 32 + -> return high ? 31 +
 * mutant: fix_shift in src/num/fix.h: return s < 0 ? v >> -s -> return s < 0 ? v >> (1 - s)
 * mutant: fix_round_shift in src/num/fix.c: return s < -62 ? 0 -> return s < -63 ? 0
 * mutant: fix_cross in src/num/fix.h: out[1] = (int64_t)a[2] * b[0] - -> out[1] = (int64_t)a[2] * b[0] +
 * mutant: plane_axis in src/num/plane.h: (x > z ? 0 : 2) -> (x > y ? 0 : 2)
 */
#include "contract.h"
#include "num/plane.h"
#include "num/fix.c"

/* q is x / 2^s, cut off downward, or to nearest, ties upward. Macros: a predicate would hide 2^s from the prover. */
#define FLOOR(q, x, s)   ((q) * (1 << (s)) <= (x) && (x) < ((q) + 1) * (1 << (s)))
#define NEAREST(q, x, s) FLOOR(q, (x) + (1 << ((s)-1)), s)

/*@ requires above: v > INT64_MIN;
    assigns \nothing;
    ensures \result == \abs(v); */
int64_t carom_abs(int64_t v);

/*@ requires 1 <= s <= 62 && \abs(v) <= 1 << 62;
    assigns \nothing;
    ensures NEAREST(\result, v, s); */
int64_t carom_round(int64_t v, int s);

/*@ requires 0 <= s <= 63 && INT64_MIN <= v * (1 << s) <= INT64_MAX;
    assigns \nothing;
    ensures \result == v * (1 << s); */
int64_t carom_shl(int64_t v, int s);

/*@ requires \abs(a * b) <= (1 << 61) - (1 << 30);
    assigns \nothing;
    ensures NEAREST(\result, a * b, 30); */
int32_t carom_mul_q30(int32_t a, int32_t b);

/*@ requires \valid_read(a + (0 .. 2)) && \valid_read(b + (0 .. 2));
    requires \abs(a[0] * b[0]) + \abs(a[1] * b[1]) + \abs(a[2] * b[2]) <= INT64_MAX;
    assigns \nothing;
    ensures \result == a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; */
int64_t carom_dot(const int32_t a[3], const int32_t b[3]);

/*@ predicate above(int32_t *v) = \forall integer k; 0 <= k < 3 ==> v[k] > INT32_MIN;
    predicate three(int32_t *v) = \valid_read(v + (0 .. 2)); */

/* The compiler's own: its manual says so. */
/*@ requires v != 0;
    assigns \nothing;
    ensures 0 <= \result <= 31 && 1 << (31 - \result) <= v < 1 << (32 - \result); */
int __builtin_clz(unsigned v);

/*@ assigns \nothing;
    ensures 0 <= \result <= 32 && v < 1 << \result && (v == 0 ? \result == 0 : 1 << (\result - 1) <= v); */
int fix_bits32(uint32_t v);

/*@ assigns \nothing;
    ensures 0 <= \result <= 64 && v < 1 << \result && (v == 0 ? \result == 0 : 1 << (\result - 1) <= v); */
int fix_bits(uint64_t v);

/*@ requires -62 <= s <= 62 && (s > 0 ==> INT64_MIN <= v * (1 << s) <= INT64_MAX);
    assigns \nothing;
    ensures s >= 0 ==> \result == v * (1 << s);
    ensures s < 0 ==> FLOOR(\result, v, -s); */
int64_t fix_shift(int64_t v, int s);

/*@ requires 0 <= s <= 62 && \abs(v) <= 1 << 62;
    assigns \nothing;
    ensures s == 0 ? \result == v : NEAREST(\result, v, s); */
int64_t fix_round(int64_t v, int s);

/*@ requires s <= 62 && (s > 0 ==> INT64_MIN <= v * (1 << s) <= INT64_MAX) && (s < 0 ==> \abs(v) <= 1 << 62);
    assigns \nothing;
    ensures s >= 0 ==> \result == v * (1 << s);
    ensures -62 <= s < 0 ==> NEAREST(\result, v, -s);
    ensures s < -62 ==> \result == 0; */
int64_t fix_round_shift(int64_t v, int s);

/*@ requires v > INT32_MIN;
    assigns \nothing;
    ensures \result == \abs(v); */
static inline int32_t fix_abs32(int32_t v);

/*@ assigns \nothing;
    ensures \result == \min(a, b); */
static inline int32_t fix_smaller(int32_t a, int32_t b);

/*@ assigns \nothing;
    ensures \result == \max(a, b); */
static inline int32_t fix_larger(int32_t a, int32_t b);

/*@ requires 0 <= axis <= 2;
    assigns \nothing;
    ensures \result == (axis + 1) % 3; */
static inline int fix_next(int axis);

/*@ requires three(v) && above(v);
    assigns \nothing;
    ensures \result == \max(\max(\abs(v[0]), \abs(v[1])), \abs(v[2])); */
static inline int32_t fix_largest(const int32_t v[3]);

/*@ requires three(a) && above(a) && three(b) && above(b) && \valid(out + (0 .. 2));
    requires \separated(out + (0 .. 2), a + (0 .. 2)) && \separated(out + (0 .. 2), b + (0 .. 2));
    assigns out[0 .. 2];
    ensures out[0] == a[1] * b[2] - a[2] * b[1];
    ensures out[1] == a[2] * b[0] - a[0] * b[2];
    ensures out[2] == a[0] * b[1] - a[1] * b[0]; */
void fix_cross(int64_t out[3], const int32_t a[3], const int32_t b[3]);

/*@ requires \valid_read(v + (0 .. 2)) && \abs(v[0]) < 1 << 62 && \abs(v[1]) < 1 << 62 && \abs(v[2]) < 1 << 62;
    assigns \nothing;
    ensures \result == \abs(v[0]) + \abs(v[1]) + \abs(v[2]); */
uint64_t fix_sum(const int64_t v[3]);

/*@ requires \valid_read(a);
    assigns \nothing;
    ensures \result == (a->hi < 0 ? -1 : a->hi * (1 << 64) + a->lo > 0 ? 1 : 0); */
int fix_wide_sign(const struct fix_wide *a);

/*@ requires three(n) && above(n);
    assigns \nothing;
    ensures 0 <= \result <= 2 && \forall integer k; 0 <= k <= 2 ==> \abs(n[k]) <= \abs(n[\result]);
    ensures \forall integer k; \result < k <= 2 ==> \abs(n[k]) < \abs(n[\result]); */
static inline int plane_axis(const int32_t n[3]);
