/* SPDX-License-Identifier: MIT */
/*
 * A number times a mantissa over 2^e: no operation overflows, and fix_mul rounds it. fix_mul_scaled3 is the same three times.
 *
 * bound: |v| < 2^62, mantissas below 2^30, exponents of 1 to 90; results of exponents below 1 are products below 2^63
 * mutant: src/num/fix.c: plain = s.e >= 1 && s.e <= 62 -> plain = s.e >= 1 && s.e <= 63
 */
#include "proof.h"
#include "num/fix.c"

void proof(void)
{
    struct fix_scaled s = {(int32_t)proof_range(-(1 << 30) + 1, (1 << 30) - 1),
                           (int32_t)proof_range(1, 90)};
    struct fix_scaled up = {s.m, (int32_t)proof_range(-3, 0)};
    int64_t v[3], out[3], small = proof_range(-(1 << 29), 1 << 29);

    for (int k = 0; k < 3; k++) {
        v[k] = proof_range(-(1LL << 62) + 1, (1LL << 62) - 1);
    }
    fix_mul_scaled3(out, v, s);
    for (int k = 0; k < 3; k++) {
        proof_check(out[k] == fix_mul_scaled(v[k], s));
    }
    proof_check(fix_mul_scaled(small, up) == small * (wide)s.m * (1 << -up.e));
}
