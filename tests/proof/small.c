/* SPDX-License-Identifier: MIT */
/*
 * The small helpers of 32 bits: absolute values, the smaller, the larger, the largest of three, the next axis.
 *
 * bound: all numbers above INT32_MIN
 * mutant: src/num/fix.h: a < b ? a : b -> a < b ? b : a
 */
#include "proof.h"

void proof(void)
{
    int32_t v[3];
    int axis = (int)proof_range(0, 2);

    for (int k = 0; k < 3; k++) {
        v[k] = (int32_t)proof_range(-INT32_MAX, INT32_MAX);
    }
    proof_check(fix_abs32(v[0]) >= 0 && (fix_abs32(v[0]) == v[0] || fix_abs32(v[0]) == -v[0]));
    proof_check(fix_smaller(v[0], v[1]) <= v[0] && fix_smaller(v[0], v[1]) <= v[1]);
    proof_check(fix_larger(v[0], v[1]) >= v[0] && fix_larger(v[0], v[1]) >= v[1]);
    for (int k = 0; k < 3; k++) {
        proof_check(fix_largest(v) >= v[k] && fix_largest(v) >= -v[k]);
    }
    proof_check(fix_largest(v) == fix_abs32(v[0]) || fix_largest(v) == fix_abs32(v[1]) ||
                fix_largest(v) == fix_abs32(v[2]));
    proof_check(fix_next(axis) == (axis + 1) % 3);
}
