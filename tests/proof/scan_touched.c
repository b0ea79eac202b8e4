/* SPDX-License-Identifier: MIT */
/*
 * The cells that an interval touches: nothing overflows, and cell i is in it exactly where [i 2^shift, (i + 1) 2^shift] meets it.
 *
 * bound: |low|, |high| below 2^30 + 2^26, up to 64 cells, shifts of 0 to 24, a case each
 * cases: 0..24
 * mutant: src/mesh/scan.c: ((low + above) >> shift) - 1 -> ((low + above) >> shift)
 */
#include "proof.h"
#include "mesh/scan.c"

void proof(void)
{
    int32_t low = (int32_t)proof_range(-(1 << 30) - (1 << 26), (1 << 30) + (1 << 26));
    int32_t high = (int32_t)proof_range(-(1 << 30) - (1 << 26), (1 << 30) + (1 << 26));
    int32_t count = (int32_t)proof_range(1, 64), i = (int32_t)proof_range(0, 63), first, end;

    proof_assume(low <= high && i < count);
    touched(low, high, CASE, count, &first, &end);
    proof_check(first >= 0 && end <= count);
    proof_check((i >= first && i < end) ==
                (i * ((int64_t)1 << CASE) <= high && (i + 1) * ((int64_t)1 << CASE) >= low));
}
