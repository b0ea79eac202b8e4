/* SPDX-License-Identifier: MIT */
/*
 * carom_fix.h - the number types of Carom and their inline arithmetic.
 *
 * A fixed-point name ends in its fractional bits: vel_q40 counts units of 2^-40. A name without a
 * suffix is a count, an index or a pixel. Vectors of different formats are different types, so that
 * one cannot be assigned to the other; their components are in c[].
 *
 *   q22  lengths near a body, world units           +-512 units
 *   q24  displacements within one slice of a step   +-128 units
 *   q30  unit vectors, rotations, times in [0, 1], restitution
 *   q32  positions, world units                     +-4096 units
 *   q40  velocities (world units a frame, radians a frame), momenta, gravity
 *
 * All arithmetic is two's complement with an arithmetic right shift; the assertions below refuse a
 * compiler that does otherwise. Rounding is to nearest, ties upward, unless a name says _floor.
 */
#ifndef CAROM_FIX_H
#define CAROM_FIX_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define CAROM_STATIC_ASSERT(condition, text) static_assert(condition, text)
#else
#define CAROM_STATIC_ASSERT(condition, text) _Static_assert(condition, text)
#endif

CAROM_STATIC_ASSERT((-1 >> 1) == -1, "Carom needs an arithmetic right shift");
CAROM_STATIC_ASSERT((int32_t)(uint32_t)0x80000000u == INT32_MIN, "Carom needs two's complement");
CAROM_STATIC_ASSERT(CHAR_BIT == 8, "Carom needs 8-bit bytes");

#define CAROM_ONE_Q30 ((int32_t)1 << 30)

typedef struct {
    int32_t c[3];
} carom_v3_q22;
typedef struct {
    int32_t c[3];
} carom_v3_q24;
typedef struct {
    int32_t c[3];
} carom_v3_q30;
typedef struct {
    int64_t c[3];
} carom_v3_q32;
typedef struct {
    int64_t c[3];
} carom_v3_q40;
/* w, x, y, z; of length 1 */
typedef struct {
    int32_t c[4];
} carom_quat_q30;
/* rows; maps body coordinates to world coordinates */
typedef struct {
    int32_t c[3][3];
} carom_m3_q30;

/*
 * Constants from whole numbers, evaluated at compile time, exact to the last place:
 *
 *   CAROM_RATIO(n, d, bits)       n / d with `bits` fractional bits; |n| * 2^bits must be < 2^63
 *   CAROM_POSITION_MM(mm)         millimetres to a position, a world unit being a metre
 *   CAROM_VELOCITY_MM_S(mm, fps)  millimetres a second to units a frame
 *   CAROM_GRAVITY_MM_S2(mm, fps)  millimetres a second squared to units a frame squared
 *   CAROM_SPIN_MRAD_S(mrad, fps)  milliradians a second to radians a frame
 */
#define CAROM_RATIO(n, d, bits)         ((int64_t)(n) * ((int64_t)1 << (bits)) / (int64_t)(d))
#define CAROM_POSITION_MM(mm)           CAROM_RATIO(mm, 1000, 32)
#define CAROM_VELOCITY_MM_S(mm_s, fps)  CAROM_RATIO(mm_s, (int64_t)1000 * (fps), 40)
#define CAROM_GRAVITY_MM_S2(mm_s2, fps) CAROM_RATIO(mm_s2, (int64_t)1000 * (fps) * (fps), 40)
#define CAROM_SPIN_MRAD_S(mrad_s, fps)  CAROM_VELOCITY_MM_S(mrad_s, fps)

#ifdef __cplusplus
extern "C" {
#endif

/*
 * a . b exactly; the formats add up (q30 . q22 gives q52).
 * Range: |a| |b| < 2^62 as vectors, which holds for a direction and any int32 vector shorter than
 * 2^31.
 */
inline int64_t carom_dot(const int32_t a[3], const int32_t b[3])
{
    return (int64_t)a[0] * b[0] + (int64_t)a[1] * b[1] + (int64_t)a[2] * b[2];
}

/* Where size counts more than speed these are called; the library has a body of each. */
#if defined __OPTIMIZE_SIZE__ && !defined CAROM_FIX_BODIES
int64_t carom_round(int64_t v, int s);
int64_t carom_shl(int64_t v, int s);
int64_t carom_abs(int64_t v);
#else

/*
 * v / 2^s to nearest; 1 <= s <= 62, |v| < 2^62. The shift floors, the added half makes it nearest.
 */
inline int64_t carom_round(int64_t v, int s)
{
    return (v + ((int64_t)1 << (s - 1))) >> s;
}

/* v * 2^s without the undefined left shift of a negative number; the result must fit. */
inline int64_t carom_shl(int64_t v, int s)
{
    return (int64_t)((uint64_t)v << s);
}

/* |v|; v > INT64_MIN. */
inline int64_t carom_abs(int64_t v)
{
    return v < 0 ? -v : v;
}

#endif

#if defined __OPTIMIZE_SIZE__ && !defined CAROM_FIX_PRODUCTS
int32_t carom_mul_q30(int32_t a, int32_t b);
void carom_cross(int32_t out[3], const int32_t a[3], const int32_t b[3], int s);
void carom_rotate(int32_t out[3], const carom_m3_q30 *m, const int32_t a[3]);
void carom_rotate_back(int32_t out[3], const carom_m3_q30 *m, const int32_t a[3]);
#else

/* a * b / 2^30 to nearest: the product of a number in any format with one in q30. */
inline int32_t carom_mul_q30(int32_t a, int32_t b)
{
    return (int32_t)carom_round((int64_t)a * b, 30);
}

/* out = a x b / 2^s to nearest. Range: each component of the result must fit int32. */
inline void carom_cross(int32_t out[3], const int32_t a[3], const int32_t b[3], int s)
{
    int32_t x = (int32_t)carom_round((int64_t)a[1] * b[2] - (int64_t)a[2] * b[1], s);
    int32_t y = (int32_t)carom_round((int64_t)a[2] * b[0] - (int64_t)a[0] * b[2], s);
    int32_t z = (int32_t)carom_round((int64_t)a[0] * b[1] - (int64_t)a[1] * b[0], s);

    out[0] = x;
    out[1] = y;
    out[2] = z;
}

/* out = m a / 2^30 to nearest; the format of a is kept. out may be a. */
inline void carom_rotate(int32_t out[3], const carom_m3_q30 *m, const int32_t a[3])
{
    int32_t x = (int32_t)carom_round(carom_dot(m->c[0], a), 30);
    int32_t y = (int32_t)carom_round(carom_dot(m->c[1], a), 30);
    int32_t z = (int32_t)carom_round(carom_dot(m->c[2], a), 30);

    out[0] = x;
    out[1] = y;
    out[2] = z;
}

/* out = (m transposed) a / 2^30 to nearest. out may be a. */
inline void carom_rotate_back(int32_t out[3], const carom_m3_q30 *m, const int32_t a[3])
{
    int64_t x =
        (int64_t)m->c[0][0] * a[0] + (int64_t)m->c[1][0] * a[1] + (int64_t)m->c[2][0] * a[2];
    int64_t y =
        (int64_t)m->c[0][1] * a[0] + (int64_t)m->c[1][1] * a[1] + (int64_t)m->c[2][1] * a[2];
    int64_t z =
        (int64_t)m->c[0][2] * a[0] + (int64_t)m->c[1][2] * a[1] + (int64_t)m->c[2][2] * a[2];

    out[0] = (int32_t)carom_round(x, 30);
    out[1] = (int32_t)carom_round(y, 30);
    out[2] = (int32_t)carom_round(z, 30);
}

#endif

#ifdef __cplusplus
}
#endif

#endif
