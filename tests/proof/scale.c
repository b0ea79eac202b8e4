/* SPDX-License-Identifier: MIT */
/*
 * A number becomes a mantissa of 30 bits, 2^29 <= |m| < 2^30, and an exponent: m 2^-e is within half of the last place.
 *
 * bound: all numbers; a case has those of as many bits
 * cases: 0..64
 * mutant: src/num/fix.c: if (magnitude >> 30) -> if (magnitude >> 31)
 */
#include "proof.h"
#include "num/fix.c"

void proof(void)
{
    const int64_t most = CASE < 63 ? ((int64_t)1 << CASE % 63) - 1 : INT64_MAX;
    int64_t v = CASE < 64 ? proof_range(-most, most) : INT64_MIN;
    struct fix_scaled s;
    int up;

    proof_assume(CASE == 64 || carom_abs(v) > most / 2 || CASE == 0);
    s = fix_scale(v, 40);
    up = 40 - s.e;
    if (v == 0) {
        proof_check(s.m == 0);
        return;
    }
    proof_check(fix_bits32((uint32_t)(s.m < 0 ? -s.m : s.m)) == 30 && (s.m < 0) == (v < 0));
    proof_check(up >= -29 && up <= 34);
    if (up <= 0) {
        proof_check(v == (s.m >> -up) && (wide)(s.m >> -up) * ((wide)1 << -up) == s.m);
    } else {
        wide apart = s.m * ((wide)1 << up) - v, half = (wide)1 << (up - 1);

        proof_check(-half <= apart && apart <= half);
    }
}
