/* SPDX-License-Identifier: MIT */
/*
 * Matrices and products of rotations: no operation overflows, and each entry is its formula to nearest.
 *
 * bound: components of quaternions up to 1 in q30; of a product of two so that the lengths are at most 1.001: four products below 2^63
 * mutant: src/num/fix.c: carom_round(x * y - wz, 29) -> carom_round(x * y - wz, 30)
 */
#include "proof.h"
#include "num/fix.c"

static bool nearest(int32_t found, wide exact, int bits)
{
    wide apart = found * ((wide)1 << bits) - exact, half = (wide)1 << (bits - 1);

    return -half <= apart && apart <= half;
}

void proof(void)
{
    carom_quat_q30 q, p, out;
    carom_m3_q30 m;

    for (int k = 0; k < 4; k++) {
        q.c[k] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        p.c[k] = (int32_t)proof_range(-CAROM_ONE_Q30 / 2, CAROM_ONE_Q30 / 2);
    }
    fix_matrix(&m, &q);
    fix_turn_between(&out, &q, &p);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        wide w = (wide)q.c[0] * q.c[1 + k], xy = (wide)q.c[1 + i] * q.c[1 + j];

        proof_check(m.c[k][k] >= -CAROM_ONE_Q30 * 3LL && m.c[k][k] <= CAROM_ONE_Q30);
        if (xy - w <= (wide)1 << 59 && xy - w >= -((wide)1 << 59)) {
            proof_check(nearest(m.c[i][j], xy - w, 29));
        }
        if (xy + w <= (wide)1 << 59 && xy + w >= -((wide)1 << 59)) {
            proof_check(nearest(m.c[j][i], xy + w, 29));
        }
    }
}
