/* SPDX-License-Identifier: MIT */
/*
 * The place of the first record that does not come before a key.
 *
 * bound: up to five sorted records of 32 bits, a case for each number of them
 * cases: 0..5
 * mutant: src/num/sort.h: low = middle + 1; -> low = middle + 2;
 */
#include "proof.h"
#include "num/sort.h"

static bool comes_before(const void *record, const void *key)
{
    return *(const int32_t *)record < *(const int32_t *)key;
}

void proof(void)
{
    int32_t list[5], key = (int32_t)proof_range(INT32_MIN, INT32_MAX);
    uint32_t place;

    for (int k = 0; k < 5; k++) {
        list[k] = (int32_t)proof_range(INT32_MIN, INT32_MAX);
        proof_assume(k == 0 || list[k - 1] <= list[k]);
    }
    place = sort_lower_bound(list, CASE, sizeof list[0], &key, comes_before);
    proof_check(place <= CASE);
    for (uint32_t k = 0; k < CASE; k++) {
        proof_check((list[k] < key) == (k < place));
    }
}
