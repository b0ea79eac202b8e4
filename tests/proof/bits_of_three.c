/* SPDX-License-Identifier: MIT */
/*
 * The bits of a vector are those of its largest component.
 *
 * bound: all components above INT64_MIN; all of 128 bits
 * mutant: src/num/fix.c: most = bits > most ? bits : most -> most = bits
 * mutant: src/num/fix.c: carom_abs(v[0]) | carom_abs(v[1]) -> carom_abs(v[0]) | carom_abs(v[0])
 */
#include "proof.h"
#include "num/fix.c"

void proof(void)
{
    int64_t v[3];
    struct fix_wide a[3];
    int bits, wide_bits;
    bool reached = false, wide_reached = false;

    for (int k = 0; k < 3; k++) {
        v[k] = proof_range(-INT64_MAX, INT64_MAX);
        a[k].hi = proof_word();
        a[k].lo = (uint64_t)proof_word();
    }
    bits = fix_bits3(v);
    wide_bits = fix_wide_bits3(a);
    for (int k = 0; k < 3; k++) {
        proof_check(fix_bits((uint64_t)carom_abs(v[k])) <= bits &&
                    fix_wide_bits(&a[k]) <= wide_bits);
        reached = reached || fix_bits((uint64_t)carom_abs(v[k])) == bits;
        wide_reached = wide_reached || fix_wide_bits(&a[k]) == wide_bits;
    }
    proof_check(reached && wide_reached);
}
