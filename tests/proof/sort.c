/* SPDX-License-Identifier: MIT */
/*
 * Sorting: keys come out in rising order, and each that went in is there.
 *
 * bound: four keys, all values
 * mutant: src/num/sort.h: while (n > 1) { -> while (n > 2) {
 */
#include "proof.h"
#include "num/sort.c"

void proof(void)
{
    uint64_t key[4], in[4];

    for (int k = 0; k < 4; k++) {
        in[k] = key[k] = (uint64_t)proof_word();
    }
    sort_keys(key, 4);
    for (int k = 0; k < 3; k++) {
        proof_check(key[k] <= key[k + 1]);
    }
    for (int k = 0; k < 4; k++) {
        proof_check(in[k] == key[0] || in[k] == key[1] || in[k] == key[2] || in[k] == key[3]);
    }
    proof_check((in[0] ^ in[1] ^ in[2] ^ in[3]) == (key[0] ^ key[1] ^ key[2] ^ key[3]));
}
