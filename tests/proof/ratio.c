/* SPDX-License-Identifier: MIT */
/*
 * Quotients of 128 and 64 bits: no operation overflows, no division is by 0; 0 over anything is 0.
 *
 * bound: all numerators, all denominators but 0
 * mutant: src/num/fix.c: CAROM_ASSERT(fix_wide_sign(b) != 0) -> CAROM_ASSERT(fix_wide_sign(b) > 0)
 */
#include "proof.h"
#include "num/fix.c"

void proof(void)
{
    struct fix_wide a = {proof_word(), (uint64_t)proof_word()},
                    b = {proof_word(), (uint64_t)proof_word()}, none = {0, 0};
    int64_t small = proof_word();

    proof_assume(fix_wide_sign(&b) != 0 && small != 0);
    fix_wide_ratio(&a, &b);
    fix_ratio(a.hi, small);
    proof_check(fix_wide_ratio(&none, &b).m == 0 && fix_wide_over(&none, small).m == 0);
}
