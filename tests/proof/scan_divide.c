/* SPDX-License-Identifier: MIT */
/*
 * floor(n / d) and the remainder: n = floor d + rest, 0 <= rest < d.
 *
 * bound: d of 1 to 2^10, |n| below 2^20
 * mutant: src/mesh/scan.c: q.rest += d; -> q.rest += 0;
 */
#include "proof.h"
#include "mesh/scan.c"

void proof(void)
{
    int32_t d = (int32_t)proof_range(1, 1 << 10);
    int64_t n = proof_range(-(1 << 20), 1 << 20);
    struct quotient q = divide(n, d);

    proof_check(q.rest >= 0 && q.rest < d && (int64_t)q.floor * d + q.rest == n);
}
