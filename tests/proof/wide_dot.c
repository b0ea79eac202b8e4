/* SPDX-License-Identifier: MIT */
/*
 * A sum of products of 64 bits is exact modulo 2^128; wide_mul proves the product.
 *
 * bound: all numbers
 * contract: fix_wide_mul by product
 * mutant: src/num/fix.c: fix_wide_add_product(sum, a[k], b[k]) -> fix_wide_add_product(sum, a[k], b[0])
 */
#include "proof.h"
#include "num/fix.c"

struct fix_wide product(int64_t a, int64_t b)
{
    wide p = (wide)a * b;

    return (struct fix_wide){(int64_t)(p >> 64), (uint64_t)p};
}

static unsigned __int128 whole(const struct fix_wide *a)
{
    return (unsigned __int128)(uint64_t)a->hi << 64 | a->lo;
}

void proof(void)
{
    struct fix_wide sum = {proof_word(), (uint64_t)proof_word()};
    unsigned __int128 expected = whole(&sum);
    int64_t a[3], b[3];

    for (int k = 0; k < 3; k++) {
        a[k] = proof_word();
        b[k] = proof_word();
        expected += (unsigned __int128)((wide)a[k] * b[k]);
    }
    fix_wide_add_dot(&sum, a, b);
    proof_check(whole(&sum) == expected);
}
