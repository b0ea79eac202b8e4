/* SPDX-License-Identifier: MIT */
/*
 * Cross products and rotations of 32 bits are to nearest.
 *
 * bound: matrices and directions up to 1 in q30, vectors below 2^29 by component, as then every result fits
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
    int32_t a[3], forth[3], back[3], cross[3];

    for (int i = 0; i < 3; i++) {
        a[i] = (int32_t)proof_range(-(1 << 29) + 1, (1 << 29) - 1);
        for (int k = 0; k < 3; k++) {
            m.c[i][k] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        }
    }
    carom_rotate(forth, &m, a);
    carom_rotate_back(back, &m, a);
    carom_cross(cross, m.c[0], a, 30);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;

        proof_check(nearest(forth[i], (wide)m.c[i][0] * a[0] + (wide)m.c[i][1] * a[1] +
                                          (wide)m.c[i][2] * a[2]));
        proof_check(nearest(back[i], (wide)m.c[0][i] * a[0] + (wide)m.c[1][i] * a[1] +
                                         (wide)m.c[2][i] * a[2]));
        proof_check(nearest(cross[i], (wide)m.c[0][j] * a[k] - (wide)m.c[0][k] * a[j]));
    }
}
