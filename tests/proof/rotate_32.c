/* SPDX-License-Identifier: MIT */
/*
 * Cross products and rotations of 32 bits are to nearest; a case is one component of one of the three.
 *
 * bound: matrices and directions up to 1 in q30, vectors below 2^29 by component, as then every result fits
 * cases: 0..8
 * mutant: include/carom_fix.h: carom_dot(m->c[1], a), 30) -> carom_dot(m->c[1], a), 29)
 * mutant: include/carom_fix.h: (int64_t)m->c[2][1] * a[2] -> (int64_t)m->c[1][2] * a[2]
 */
#include "proof.h"

static bool nearest(int32_t found, wide exact)
{
    wide apart = found * ((wide)1 << 30) - exact;

    return apart > -(1 << 29) && apart <= 1 << 29;
}

void proof(void)
{
    carom_m3_q30 m;
    int32_t a[3], found[3];

    for (int i = 0; i < 3; i++) {
        a[i] = (int32_t)proof_range(-(1 << 29) + 1, (1 << 29) - 1);
        for (int k = 0; k < 3; k++) {
            m.c[i][k] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        }
    }
    const int i = CASE % 3, j = (i + 1) % 3, k = (i + 2) % 3;

    switch (CASE / 3) {
    case 0:
        carom_rotate(found, &m, a);
        proof_check(nearest(found[i], (wide)m.c[i][0] * a[0] + (wide)m.c[i][1] * a[1] +
                                          (wide)m.c[i][2] * a[2]));
        break;
    case 1:
        carom_rotate_back(found, &m, a);
        proof_check(nearest(found[i], (wide)m.c[0][i] * a[0] + (wide)m.c[1][i] * a[1] +
                                          (wide)m.c[2][i] * a[2]));
        break;
    default:
        carom_cross(found, m.c[0], a, 30);
        proof_check(nearest(found[i], (wide)m.c[0][j] * a[k] - (wide)m.c[0][k] * a[j]));
    }
}
