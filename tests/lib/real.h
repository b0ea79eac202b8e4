/* SPDX-License-Identifier: MIT */
/*
 * real - some double precision for the oracles of tests, without a mathematics library: the same
 * source runs on boards that have none.
 */
#ifndef CAROM_TEST_REAL_H
#define CAROM_TEST_REAL_H

#include <stdint.h>
#include <string.h>

#define REAL_PI 3.14159265358979323846

/* 2^e for -1022 <= e <= 1023, from its bits. */
static inline double real_power2(int e)
{
    uint64_t bits = (uint64_t)(1023 + e) << 52;
    double power;

    memcpy(&power, &bits, sizeof power);
    return power;
}

/* A fixed-point number with so many fractional bits. */
static inline double real(int64_t fixed, int bits)
{
    return (double)fixed * real_power2(-bits);
}

static inline double real_abs(double v)
{
    return v < 0 ? -v : v;
}

/* To the nearest whole number; |v| < 2^62. */
static inline int64_t real_round(double v)
{
    return (int64_t)(v < 0 ? v - 0.5 : v + 0.5);
}

/* Newton's iteration from a guess that halves the exponent. */
static inline double real_sqrt(double v)
{
    uint64_t bits;
    double root;

    if (v <= 0) {
        return 0;
    }
    memcpy(&bits, &v, sizeof bits);
    bits = (bits >> 1) + ((uint64_t)1023 << 51);
    memcpy(&root, &bits, sizeof root);
    for (int k = 0; k < 5; k++) {
        root = (root + v / root) / 2;
    }
    return root;
}

/* Sine and cosine of |a| <= 4: the series for a / 8, doubled three times. */
static inline void real_sine_cosine(double a, double *sine, double *cosine)
{
    double x = a / 8, term = 1, s = 0, c = 0;

    for (int k = 0; k < 18; k += 4) {
        c += term;
        term *= x / (k + 1);
        s += term;
        term *= x / (k + 2);
        c -= term;
        term *= x / (k + 3);
        s -= term;
        term *= x / (k + 4);
    }
    for (int k = 0; k < 3; k++) {
        double double_s = 2 * s * c;

        c = 1 - 2 * s * s;
        s = double_s;
    }
    *sine = s;
    *cosine = c;
}

static inline double real_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double real_length(const double a[3])
{
    return real_sqrt(real_dot(a, a));
}

/* out must not be a or b. */
static inline void real_cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* The matrix of a quaternion of any length but 0: w, x, y, z. */
static inline void real_matrix(double m[3][3], const double q[4])
{
    double w = q[0], x = q[1], y = q[2], z = q[3];
    double s = 2 / (w * w + x * x + y * y + z * z);

    m[0][0] = 1 - s * (y * y + z * z);
    m[1][1] = 1 - s * (x * x + z * z);
    m[2][2] = 1 - s * (x * x + y * y);
    m[0][1] = s * (x * y - w * z);
    m[1][0] = s * (x * y + w * z);
    m[0][2] = s * (x * z + w * y);
    m[2][0] = s * (x * z - w * y);
    m[1][2] = s * (y * z - w * x);
    m[2][1] = s * (y * z + w * x);
}

/* out = m v; out must not be v. */
static inline void real_rotate(double out[3], double m[3][3], const double v[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = real_dot(m[i], v);
    }
}

/* out = m transposed v; out must not be v. */
static inline void real_rotate_back(double out[3], double m[3][3], const double v[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = m[0][i] * v[0] + m[1][i] * v[1] + m[2][i] * v[2];
    }
}

#endif
