/* SPDX-License-Identifier: MIT */
/*
 * Rotations of 64 bits are sums of three products in q30, each to nearest, so within 1.5 units; and in place.
 *
 * bound: matrices up to 1 in q30, vectors up to 2^60 by component; a case is a component of a rotation or of its inverse
 * cases: 0..5
 * mutant: src/num/fix.c: fix_mul_q30(v[2], m->c[2][k]) -> fix_mul_q30(v[2], m->c[k][2])
 * mutant: src/num/fix.c: r[k] = fix_dot_q30(v, m->c[k]) -> r[k] = fix_dot_q30(v, m->c[0])
 */
#include "proof.h"
#include "num/fix.c"

enum { BACK = CASE / 3, COMPONENT = CASE % 3 };

static wide part(int64_t v, int32_t d)
{
    return ((wide)(v >> 32) * d * ((wide)1 << 32) + (wide)(uint32_t)v * d + (1 << 29)) >> 30;
}

void proof(void)
{
    carom_m3_q30 m;
    int64_t v[3], turned[3];
    wide sum = 0;

    for (int i = 0; i < 3; i++) {
        v[i] = turned[i] = proof_range(-(1LL << 60), 1LL << 60);
        for (int k = 0; k < 3; k++) {
            m.c[i][k] = (int32_t)proof_range(-CAROM_ONE_Q30, CAROM_ONE_Q30);
        }
    }
    if (BACK) {
        fix_rotate_back(turned, &m, turned);
    } else {
        fix_rotate(turned, &m, turned);
    }
    for (int k = 0; k < 3; k++) {
        sum += part(v[k], BACK ? m.c[k][COMPONENT] : m.c[COMPONENT][k]);
    }
    proof_check(turned[COMPONENT] == sum);
}
