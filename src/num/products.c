/* SPDX-License-Identifier: MIT */
/* Products that are inline have bodies here; where size counts these call what inline.c has. */
#define CAROM_FIX_PRODUCTS
#include "fix.h"

extern inline int32_t carom_mul_q30(int32_t a, int32_t b);
extern inline void carom_cross(int32_t out[3], const int32_t a[3], const int32_t b[3], int s);
extern inline void carom_rotate(int32_t out[3], const carom_m3_q30 *m, const int32_t a[3]);
extern inline void carom_rotate_back(int32_t out[3], const carom_m3_q30 *m, const int32_t a[3]);
extern inline int64_t fix_mul(int64_t a, int32_t b, int s);
extern inline int64_t fix_mul_q30(int64_t a, int32_t b);
extern inline int64_t fix_dot_q30(const int64_t v[3], const int32_t d_q30[3]);
extern inline void fix_cross(int64_t out[3], const int32_t a[3], const int32_t b[3]);
