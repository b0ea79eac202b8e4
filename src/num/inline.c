/* SPDX-License-Identifier: MIT */
/* Bodies of inline functions for callers that do not inline them: all of them where size counts. */
#define CAROM_FIX_BODIES
#include "fix.h"

extern inline int64_t carom_round(int64_t v, int s);
extern inline int64_t carom_shl(int64_t v, int s);
extern inline int64_t carom_abs(int64_t v);
extern inline int32_t carom_mul_q30(int32_t a, int32_t b);
extern inline int64_t carom_scaled(int64_t v, int64_t scale, int bits);
extern inline int64_t carom_dot(const int32_t a[3], const int32_t b[3]);
extern inline void carom_cross(int32_t out[3], const int32_t a[3], const int32_t b[3], int s);
extern inline void carom_rotate(int32_t out[3], const carom_m3_q30 *m, const int32_t a[3]);
extern inline void carom_rotate_back(int32_t out[3], const carom_m3_q30 *m, const int32_t a[3]);
extern inline int fix_bits32(uint32_t v);
extern inline int fix_bits(uint64_t v);
extern inline int64_t fix_mul(int64_t a, int32_t b, int s);
extern inline int64_t fix_mul_q30(int64_t a, int32_t b);
extern inline int64_t fix_dot_q30(const int64_t v[3], const int32_t d_q30[3]);
extern inline int64_t fix_shift(int64_t v, int s);
extern inline int64_t fix_round(int64_t v, int s);
extern inline uint64_t fix_sum(const int64_t v[3]);
extern inline void fix_cross(int64_t out[3], const int32_t a[3], const int32_t b[3]);
extern inline void fix_sym3_dot(int64_t out[3], const int32_t m[6], const int32_t v[3]);
