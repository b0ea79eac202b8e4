/* SPDX-License-Identifier: MIT */
/*
 * v scale / 2^bits is to nearest. v scale = (v >> bits) scale 2^bits + (v mod 2^bits) scale by the distributive law.
 * A case is a number of bits.
 *
 * bound: |scale| < 2^23, |v| < 2^(39 + bits) up to 2^62, so that the product is within the range of carom_fix.h; all its bits
 * cases: 1..40
 * mutant: include/carom_fix.h: ((int64_t)1 << (bits - 1))) >> bits) -> 0) >> bits)
 */
#include "proof.h"

void proof(void)
{
    int64_t limit = CASE < 23 ? 1LL << (39 + CASE) : 1LL << 62;
    int64_t v = proof_range(-limit + 1, limit - 1),
            scale = proof_range(-(1 << 23) + 1, (1 << 23) - 1);
    int64_t whole = v >> CASE, rest = v & ((1LL << CASE) - 1);
    wide product = (wide)whole * scale * ((wide)1 << CASE) + (wide)rest * scale;

    proof_check(carom_scaled(v, scale, CASE) == (product + ((wide)1 << (CASE - 1))) >> CASE);
}
