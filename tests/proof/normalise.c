/* SPDX-License-Identifier: MIT */
/*
 * A unit vector: no operation overflows or divides by 0. That is within 2 units is left to tests.
 *
 * bound: components above INT64_MIN; the root by its contract
 * contract: fix_sqrt by root
 * mutant: src/num/fix.c: if (sum == 0) -> if (sum == 1)
 */
#include "proof.h"
#include "num/fix.c"

uint32_t root(uint64_t v)
{
    uint32_t r = (uint32_t)proof_range(0, UINT32_MAX);

    proof_assume(r > 0 || v == 0);
    return r;
}

void proof(void)
{
    int64_t v[3];
    carom_v3_q30 out = {{0, 0, 0}};

    for (int k = 0; k < 3; k++) {
        v[k] = proof_range(-INT64_MAX, INT64_MAX);
    }
    proof_check(fix_normalise(&out, v) || (out.c[0] == 0 && out.c[1] == 0 && out.c[2] == 0));
}
