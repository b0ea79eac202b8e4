/* SPDX-License-Identifier: MIT */
/*
 * v / 2^s to nearest where s may be 0, or v 2^s by fix_round_shift.
 *
 * bound: |v| < 2^62, shifts of -65 to 3 places, a case each, where the result fits
 * cases: -65..3
 * mutant: src/num/fix.c: s < -62 ? 0 : -> s < -61 ? 0 :
 * mutant: src/num/fix.h: ((int64_t)1 << s >> 1)) >> s -> ((int64_t)1 << s)) >> s
 */
#include "proof.h"
#include "num/fix.c"

static void nearest(int64_t found, int64_t v, int s)
{
    wide apart = found * ((wide)1 << s) - v, half = (wide)1 << s >> 1;

    proof_check(s == 0 ? apart == 0 : -half < apart && apart <= half);
}

void proof(void)
{
    int64_t v = proof_range(-(1LL << 62) + 1, (1LL << 62) - 1);
    wide up = v * ((wide)1 << (CASE > 0 ? CASE : 0));

    if (CASE <= 0 && CASE >= -61) {
        nearest(fix_round(v, -CASE), v, -CASE);
    }
    if (CASE < -62) {
        proof_check(fix_round_shift(v, CASE) == 0);
    } else if (CASE < 0) {
        nearest(fix_round_shift(v, CASE), v, -CASE);
    } else if (up >= INT64_MIN && up <= INT64_MAX) {
        proof_check(fix_round_shift(v, CASE) == up);
    }
}
