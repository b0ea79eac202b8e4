/* SPDX-License-Identifier: MIT */
/*
 * FNV-1a: the hash times the prime, modulo 2^64 and 2^32.
 *
 * bound: all hashes and bytes
 * mutant: src/num/fnv.h: (hash ^ byte) * 0x01000193u -> (hash ^ byte) * 0x01000195u
 */
#include "proof.h"
#include "num/fnv.h"

void proof(void)
{
    uint64_t hash = (uint64_t)proof_word();
    uint32_t small = (uint32_t)hash;
    uint8_t byte = (uint8_t)proof_range(0, 255);
    uint64_t mixed = hash ^ byte;
    uint32_t mixed32 = small ^ byte;

    /* the primes are 2^40 + 2^8 + 0xb3 and 2^24 + 2^8 + 0x93 */
    proof_check(fnv_add(hash, byte) == (mixed << 40) + (mixed << 8) + mixed * 0xb3);
    proof_check(fnv32_add(small, byte) == (mixed32 << 24) + (mixed32 << 8) + mixed32 * 0x93);
}
