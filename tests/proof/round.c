/* SPDX-License-Identifier: MIT */
/*
 * v / 2^s to nearest, ties upward: |2^s round(v, s) - v| is at most half of 2^s.
 *
 * bound: |v| < 2^62, 1 <= s <= 62, all of what carom_fix.h allows; a case is an s
 * cases: 1..62
 * mutant: include/carom_fix.h: (s - 1))) >> s -> s)) >> s
 */
#include "proof.h"

void proof(void)
{
    int64_t v = proof_range(-(1LL << 62) + 1, (1LL << 62) - 1);
    int s = CASE;
    int64_t found = carom_round(v, s);
    wide apart = found * ((wide)1 << s) - v, half = (wide)1 << (s - 1);

    proof_check(-half < apart && apart <= half);
}
