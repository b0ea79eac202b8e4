/* SPDX-License-Identifier: MIT */
/*
 * Rotations of 64 bits round each of three products to nearest: the sum is within 1.5 units, and in place.
 *
 * bound: matrices up to 1 in q30, vectors up to 2^60 by component
 * mutant: src/num/fix.c: fix_mul_q30(v[2], m->c[2][k]) -> fix_mul_q30(v[2], m->c[k][2])
 * mutant: src/num/fix.c: r[k] = fix_dot_q30(v, m->c[k]) -> r[k] = fix_dot_q30(v, m->c[0])
 */
#include "proof.h"
#include "num/fix.c"

static wide part(int64_t v, int32_t d)
{
    return (wide)(v >> 32) * d * ((wide)1 << 32) + (wide)(uint32_t)v * d;
}

static bool near(int64_t found, wide exact)
{
    wide twice = 2 * (found * ((wide)1 << 30) - exact);

    return twice >= -((wide)3 << 30) && twice <= (wide)3 << 30;
}

void proof(void)
{
    carom_m3_q30 m;
    int64_t v[3], forth[3], back[3];

    for (int i = 0; i < 3; i++) {
        v[i] = forth[i] = back[i] = proof_range(-(1LL << 60), 1LL << 60);
        for (int k = 0; k < 3; k++) {
            m.c[i][k] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        }
    }
    fix_rotate(forth, &m, forth);
    fix_rotate_back(back, &m, back);
    for (int i = 0; i < 3; i++) {
        proof_check(
            near(forth[i], part(v[0], m.c[i][0]) + part(v[1], m.c[i][1]) + part(v[2], m.c[i][2])));
        proof_check(
            near(back[i], part(v[0], m.c[0][i]) + part(v[1], m.c[1][i]) + part(v[2], m.c[2][i])));
    }
}
