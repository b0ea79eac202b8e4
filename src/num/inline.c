/* SPDX-License-Identifier: MIT */
/* What is inline has a body here for whoever calls it: all do where size counts. */
#define CAROM_FIX_BODIES
#include "fix.h"

extern inline void fix_sym3_dot(int64_t out[3], const int32_t m[6], const int32_t v[3]);

extern inline int64_t carom_round(int64_t v, int s);
extern inline int64_t carom_shl(int64_t v, int s);
extern inline int64_t carom_abs(int64_t v);
extern inline int64_t carom_dot(const int32_t a[3], const int32_t b[3]);
extern inline int fix_bits32(uint32_t v);
extern inline int fix_bits(uint64_t v);
extern inline int64_t fix_shift(int64_t v, int s);
extern inline uint64_t fix_sum(const int64_t v[3]);
