/* SPDX-License-Identifier: MIT */
/*
 * Shifts and absolute values are what their comments say, where the result fits.
 *
 * bound: v > INT64_MIN; shifts of -61 to 62, a case each
 * cases: 0..62
 * mutant: src/num/fix.h: return s < 0 ? v >> -s -> return s < 0 ? v >> (1 - s)
 */
#include "proof.h"

void proof(void)
{
    int64_t v = proof_range(-INT64_MAX, INT64_MAX);
    int down = CASE < 62 ? CASE : 61;
    wide up = v * ((wide)1 << CASE);

    proof_check(fix_shift(v, -down) == v >> down);
    proof_check(carom_abs(v) >= 0 && (carom_abs(v) == v || carom_abs(v) == -v));
    if (up >= INT64_MIN && up <= INT64_MAX) {
        proof_check(carom_shl(v, CASE) == up && fix_shift(v, CASE) == up);
    }
}
