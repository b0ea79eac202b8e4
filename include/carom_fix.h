/* SPDX-License-Identifier: MIT */
/**
 * @file
 * The number types of Carom, conversions from and to SI units, and inline arithmetic.
 */
#ifndef CAROM_FIX_H
#define CAROM_FIX_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** @cond */
#ifdef __cplusplus
#define CAROM_STATIC_ASSERT(condition, text) static_assert(condition, text)
#else
#define CAROM_STATIC_ASSERT(condition, text) _Static_assert(condition, text)
#endif

CAROM_STATIC_ASSERT((-1 >> 1) == -1, "Carom needs an arithmetic right shift");
CAROM_STATIC_ASSERT((int32_t)(uint32_t)0x80000000u == INT32_MIN, "Carom needs two's complement");
CAROM_STATIC_ASSERT(CHAR_BIT == 8, "Carom needs 8-bit bytes");
/** @endcond */

/**
 * @defgroup numbers Numbers
 * Fixed-point numbers, and conversions from and to SI units.
 *
 * The name of a fixed-point number ends in its fractional bits: vel_q40 counts units of 2^-40. A name without a suffix
 * is a count, an index or a pixel. Vectors of different formats are different types, so one cannot be assigned to the
 * other; their components are in c[].
 *
 * | format | used for                                                              | range       |
 * |--------|-----------------------------------------------------------------------|-------------|
 * | q16    | friction, factors on gravity, focal lengths                           |             |
 * | q20    | masses                                                                | 2^-10 to 2^10 |
 * | q22    | lengths near a body, world units                                      | +-512       |
 * | q24    | displacements within one slice of a step, world units                 | +-128       |
 * | q30    | unit vectors, rotations, times in 0 to 1, restitution                 | below +-2   |
 * | q32    | positions, world units                                                | +-4096      |
 * | q40    | velocities (units or radians / frame), momenta, gravity, forces       |             |
 *
 * The macros convert constants from whole numbers at compile time. A world unit is then a metre, a unit of mass a
 * kilogram, and `fps` is the number of frames in a second. Results are cut off towards zero. A number that is not
 * whole, as in CAROM_POSITION_M(1.5), is a compile error; write CAROM_POSITION_MM(1500). A plain number with a point in
 * place of a fixed-point one is an error in C++, a warning of clang, and one of gcc under -Wfloat-conversion, which is
 * worth having.
 * @{
 */

/** The number 1 in q30. */
#define CAROM_ONE_Q30 ((int32_t)1 << 30)

/** A vector of lengths near a body, world units, 22 fractional bits: within +-512. */
typedef struct {
    int32_t c[3]; /**< components */
} carom_v3_q22;
/** A vector of displacements within a slice, world units, 24 fractional bits: within +-128. */
typedef struct {
    int32_t c[3]; /**< components */
} carom_v3_q24;
/** A unit vector, 30 fractional bits. */
typedef struct {
    int32_t c[3]; /**< components */
} carom_v3_q30;
/** A place in the world, units, 32 fractional bits. */
typedef struct {
    int64_t c[3]; /**< components */
} carom_v3_q32;
/** A velocity, momentum, force or the like, 40 fractional bits. */
typedef struct {
    int64_t c[3]; /**< components */
} carom_v3_q40;
/** A rotation: a quaternion w, x, y, z of length 1, 30 fractional bits. */
typedef struct {
    int32_t c[4]; /**< w, x, y, z */
} carom_quat_q30;
/** A rotation matrix, 30 fractional bits: from body axes to world axes. */
typedef struct {
    int32_t c[3][3]; /**< rows */
} carom_m3_q30;

#define CAROM_WHOLE_(n) ((int64_t)((n) | 0)) /* no operand of | has a point */
/** n / d with `bits` fractional bits. Range: |n| * 2^bits < 2^63. */
#define CAROM_RATIO(n, d, bits) (CAROM_WHOLE_(n) * ((int64_t)1 << (bits)) / CAROM_WHOLE_(d))
#define CAROM_FPS_(fps, times)  ((int64_t)(times)*CAROM_WHOLE_(fps))
#define CAROM_FPS2_(fps, times) (CAROM_FPS_(fps, times) * CAROM_WHOLE_(fps))
/** A position from millimetres. */
#define CAROM_POSITION_MM(mm) CAROM_RATIO(mm, 1000, 32)
/** A position from metres. */
#define CAROM_POSITION_M(m) CAROM_RATIO(m, 1, 32)
/** A velocity, units / frame, from mm/s. */
#define CAROM_VELOCITY_MM_S(mm_s, fps) CAROM_RATIO(mm_s, CAROM_FPS_(fps, 1000), 40)
/** A velocity, units / frame, from m/s. */
#define CAROM_VELOCITY_M_S(m_s, fps) CAROM_RATIO(m_s, CAROM_FPS_(fps, 1), 40)
/** An acceleration, units / frame^2, from mm/s^2. */
#define CAROM_GRAVITY_MM_S2(mm_s2, fps) CAROM_RATIO(mm_s2, CAROM_FPS2_(fps, 1000), 40)
/** An angular velocity, radians / frame, from mrad/s. */
#define CAROM_SPIN_MRAD_S(mrad_s, fps) CAROM_VELOCITY_MM_S(mrad_s, fps)
/** An angular velocity, radians / frame, from degrees/s. */
#define CAROM_SPIN_DEG_S(deg_s, fps) (CAROM_DEG_Q40_(deg_s) / CAROM_FPS_(fps, 1))
/** An angle in q30, below 2 radians, from milliradians. */
#define CAROM_ANGLE_MRAD(mrad) ((int32_t)CAROM_RATIO(mrad, 1000, 30))
/** An angle in q30, below 2 radians, from degrees. */
#define CAROM_ANGLE_DEG(deg) ((int32_t)(CAROM_DEG_Q40_(deg) / 1024))
/** A mass in q20 from grams. */
#define CAROM_MASS_G(g) ((uint32_t)CAROM_RATIO(g, 1000, 20))
/** A mass in q20 from kilograms. */
#define CAROM_MASS_KG(kg) ((uint32_t)CAROM_RATIO(kg, 1, 20))
/** A force, mass x units / frame^2, from millinewtons. */
#define CAROM_FORCE_MN(mn, fps) CAROM_RATIO(mn, CAROM_FPS2_(fps, 1000), 40)
/** A force, mass x units / frame^2, from newtons. */
#define CAROM_FORCE_N(n, fps) CAROM_RATIO(n, CAROM_FPS2_(fps, 1), 40)
/** An impulse, mass x units / frame, from millinewton seconds. */
#define CAROM_IMPULSE_MN_S(mn_s, fps) CAROM_RATIO(mn_s, CAROM_FPS_(fps, 1000), 40)
/** An impulse, mass x units / frame, from newton seconds. */
#define CAROM_IMPULSE_N_S(n_s, fps) CAROM_RATIO(n_s, CAROM_FPS_(fps, 1), 40)
/** A torque, mass x units^2 / frame^2, from millinewton metres. */
#define CAROM_TORQUE_MN_M(mn_m, fps) CAROM_FORCE_MN(mn_m, fps)
/** A torque, mass x units^2 / frame^2, from newton metres. */
#define CAROM_TORQUE_N_M(n_m, fps) CAROM_FORCE_N(n_m, fps)
/** An angular impulse, mass x units^2 / frame, from millinewton metre seconds. */
#define CAROM_TWIST_MN_M_S(mn_m_s, fps) CAROM_IMPULSE_MN_S(mn_m_s, fps)
/** An angular impulse, mass x units^2 / frame, from newton metre seconds. */
#define CAROM_TWIST_N_M_S(n_m_s, fps) CAROM_IMPULSE_N_S(n_m_s, fps)
/* pi / 180 is 0x477D1A894.A74E4570 2^-40; of |n| below 2^27 */
#define CAROM_DEG_Q40_(n)                                                                          \
    (CAROM_WHOLE_(n) * 0x477D1A894 + CAROM_WHOLE_(n) * 0xA74E4570 / ((int64_t)1 << 32))

/** @} */
/**
 * @defgroup si Numbers for a printout
 * From fixed-point numbers back to whole numbers of SI units, to nearest. They are not constant expressions.
 * @{
 */

/** A position in millimetres. */
#define CAROM_TO_MM(position_q32) carom_scaled((position_q32), 1000, 32)
/** A velocity in mm/s. */
#define CAROM_TO_MM_S(velocity_q40, fps) carom_scaled((velocity_q40), CAROM_FPS_(fps, 1000), 40)
/** An acceleration in mm/s^2. */
#define CAROM_TO_MM_S2(gravity_q40, fps)                                                           \
    carom_scaled(carom_scaled((gravity_q40), CAROM_FPS_(fps, 1), 10), CAROM_FPS_(fps, 1000), 30)
/** An angular velocity in mrad/s. */
#define CAROM_TO_MRAD_S(spin_q40, fps) CAROM_TO_MM_S(spin_q40, fps)
/** An angular velocity in thousandths of a degree a second. */
#define CAROM_TO_MDEG_S(spin_q40, fps)                                                             \
    carom_scaled(carom_scaled((spin_q40), 7333860, 17), CAROM_FPS_(fps, 1), 30)
/** A mass in grams. */
#define CAROM_TO_G(mass_q20) carom_scaled((mass_q20), 1000, 20)
/** A force in millinewtons; a torque in millinewton metres. */
#define CAROM_TO_MN(force_q40, fps) CAROM_TO_MM_S2(force_q40, fps)
/** An impulse in millinewton seconds; an angular impulse in millinewton metre seconds. */
#define CAROM_TO_MN_S(impulse_q40, fps) CAROM_TO_MM_S(impulse_q40, fps)

/** A fixed-point number as a number of the caller's type: CAROM_AS(float, velocity_q40, 40). */
#define CAROM_AS(type, v, bits) ((type)(v) / (type)((uint64_t)1 << (bits)))

/** @} */

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup arithmetic Arithmetic
 * Inline operations on fixed-point numbers. They round to nearest, ties upward.
 *
 * All arithmetic is two's complement with an arithmetic right shift; assertions refuse a compiler that does otherwise.
 * @{
 */

/**
 * Returns the dot product of a and b exactly; the formats add up (q30 and q22 give q52).
 *
 * @range |a| |b| < 2^62 as vectors. This holds for a direction and any int32 vector shorter than 2^31.
 */
inline int64_t carom_dot(const int32_t a[3], const int32_t b[3])
{
    return (int64_t)a[0] * b[0] + (int64_t)a[1] * b[1] + (int64_t)a[2] * b[2];
}

/**
 * Returns v scale / 2^bits to nearest. The whole part of v / 2^bits and the rest are multiplied separately.
 *
 * @range 1 <= bits <= 40, |scale| < 2^23, |v| scale < 2^(62 + bits)
 */
inline int64_t carom_scaled(int64_t v, int64_t scale, int bits)
{
    const int64_t whole = v >> bits, rest = v & (((int64_t)1 << bits) - 1);

    return whole * scale + ((rest * scale + ((int64_t)1 << (bits - 1))) >> bits);
}

/* Where size counts more than speed, these are calls; the library has a body of each. */
#if defined __OPTIMIZE_SIZE__ && !defined CAROM_FIX_BODIES
int64_t carom_round(int64_t v, int s);
int64_t carom_shl(int64_t v, int s);
int64_t carom_abs(int64_t v);
int32_t carom_mul_q30(int32_t a, int32_t b);
void carom_cross(int32_t out[3], const int32_t a[3], const int32_t b[3], int s);
void carom_rotate(int32_t out[3], const carom_m3_q30 *m, const int32_t a[3]);
void carom_rotate_back(int32_t out[3], const carom_m3_q30 *m, const int32_t a[3]);
#else

/**
 * Returns v / 2^s to nearest. The shift floors; the added half makes it nearest.
 *
 * @range 1 <= s <= 62, |v| < 2^62
 */
inline int64_t carom_round(int64_t v, int s)
{
    return (v + ((int64_t)1 << (s - 1))) >> s;
}

/** Returns v * 2^s, without the undefined left shift of a negative number. The result must fit. */
inline int64_t carom_shl(int64_t v, int s)
{
    return (int64_t)((uint64_t)v << s);
}

/** Returns |v|. Range: v > INT64_MIN. */
inline int64_t carom_abs(int64_t v)
{
    return v < 0 ? -v : v;
}

/** Returns a * b / 2^30 to nearest: the product of a number in any format with one in q30. The result must fit. */
inline int32_t carom_mul_q30(int32_t a, int32_t b)
{
    return (int32_t)carom_round((int64_t)a * b, 30);
}

/** Computes out = a x b / 2^s to nearest. Each component of the result must fit. out may be a or b. */
inline void carom_cross(int32_t out[3], const int32_t a[3], const int32_t b[3], int s)
{
    int32_t x = (int32_t)carom_round((int64_t)a[1] * b[2] - (int64_t)a[2] * b[1], s);
    int32_t y = (int32_t)carom_round((int64_t)a[2] * b[0] - (int64_t)a[0] * b[2], s);
    int32_t z = (int32_t)carom_round((int64_t)a[0] * b[1] - (int64_t)a[1] * b[0], s);

    out[0] = x;
    out[1] = y;
    out[2] = z;
}

/** Computes out = m a / 2^30 to nearest, in the format of a. Each component must fit. out may be a. */
inline void carom_rotate(int32_t out[3], const carom_m3_q30 *m, const int32_t a[3])
{
    int32_t x = (int32_t)carom_round(carom_dot(m->c[0], a), 30);
    int32_t y = (int32_t)carom_round(carom_dot(m->c[1], a), 30);
    int32_t z = (int32_t)carom_round(carom_dot(m->c[2], a), 30);

    out[0] = x;
    out[1] = y;
    out[2] = z;
}

/** Computes out = (m transposed) a / 2^30 to nearest, in the format of a. Each component must fit. out may be a. */
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

/** @} */

#ifdef __cplusplus
}
#endif

#endif
