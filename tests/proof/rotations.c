/* SPDX-License-Identifier: MIT */
/*
 * Matrices and products of rotations: no operation overflows, and each entry is its formula to nearest; a case is an entry.
 *
 * bound: quaternions no longer than 1 + 2^-10, components up to 1
 * cases: 0..8
 * mutant: src/num/fix.c: carom_round(x * y - wz, 29) -> carom_round(x * y - wz, 30)
 */
#include "proof.h"
#include "num/fix.c"

enum { ROW = CASE / 3, COLUMN = CASE % 3, OTHER = 3 - ROW - COLUMN };

static bool nearest(int32_t found, wide exact, int bits)
{
    wide apart = found * ((wide)1 << bits) - exact, half = (wide)1 << (bits - 1);

    return -half <= apart && apart <= half;
}

static carom_quat_q30 quaternion(void)
{
    carom_quat_q30 q;
    int64_t squares = 0;

    for (int k = 0; k < 4; k++) {
        q.c[k] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        squares += (int64_t)q.c[k] * q.c[k];
    }
    proof_assume(squares <= (1LL << 60) + (1LL << 51));
    return q;
}

void proof(void)
{
    carom_quat_q30 q = quaternion(), p = quaternion(), out;
    carom_m3_q30 m;

    fix_matrix(&m, &q);
    fix_turn_between(&out, &q, &p);
    if (ROW == COLUMN) {
        proof_check(m.c[ROW][ROW] >= -CAROM_ONE_Q30 - (1 << 22) && m.c[ROW][ROW] <= CAROM_ONE_Q30);
    } else {
        wide w = (wide)q.c[0] * q.c[1 + OTHER], xy = (wide)q.c[1 + ROW] * q.c[1 + COLUMN];
        wide half = (ROW + 1) % 3 == COLUMN ? xy - w : xy + w;

        if (half <= (wide)1 << 59 && half >= -((wide)1 << 59)) {
            proof_check(nearest(m.c[ROW][COLUMN], half, 29));
        }
    }
}
