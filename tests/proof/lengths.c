/* SPDX-License-Identifier: MIT */
/*
 * Lengths of vectors: no operation overflows, no bound is below a component, and sums are what they say. every_root proves the root.
 *
 * bound: components below 2^29, which are not shifted
 * contract: fix_sqrt by root
 * mutant: src/num/fix.c: most = most > z ? most : z; -> most = most > y ? most : y;
 */
#include "proof.h"
#include "num/fix.c"

uint32_t root(uint64_t v)
{
    (void)v;
    return (uint32_t)proof_range(0, 0x6ed9eba2); /* the root of 3 2^60 */
}

void proof(void)
{
    int64_t v[3], bound;

    for (int k = 0; k < 3; k++) {
        v[k] = proof_range(-(1LL << 29) + 1, (1LL << 29) - 1);
    }
    fix_length(v);
    bound = fix_length_bound(v);
    for (int k = 0; k < 3; k++) {
        proof_check(bound >= carom_abs(v[k]));
    }
    proof_check(fix_sum(v) == (uint64_t)(carom_abs(v[0]) + carom_abs(v[1]) + carom_abs(v[2])));
}
