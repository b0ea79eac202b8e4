/* SPDX-License-Identifier: MIT */
/*
 * contract - what the contracts of this folder have in common: tools/contracts.py gives them to Frama-C's WP.
 *
 * An assertion of the engine must hold, so its failure may never be called. What WP's theory of bits lacks is assumed
 * here: a shift to the right rounds down, 2^32 2^s is 2^(32 + s), and a mask takes the rest of a division by 8 off.
 */
#ifndef CAROM_TESTS_CONTRACT_H
#define CAROM_TESTS_CONTRACT_H

#include "num/inline.c"

/*@ axiomatic Bits {
    axiom shift_down: \forall integer v, s; 0 <= s ==> (v >> s) * (1 << s) <= v < ((v >> s) + 1) * (1 << s);
    axiom whole_eights: \forall size_t v; (v & (size_t)(SIZE_MAX - 7)) == v - v % 8;
    axiom powers: \forall integer s; 0 <= s ==> (1 << (32 + s)) == (1 << 32) * (1 << s);
    } */

/*@ requires \false; assigns \nothing; ensures \false; */
_Noreturn void carom_assert_failed(const char *text, const char *file, int line);

/*@ predicate zeroed(uint8_t *place, integer bytes) = \forall integer i; 0 <= i < bytes ==> place[i] == 0; */

/*@ requires \valid((uint8_t *)to + (0 .. bytes - 1));
    assigns ((uint8_t *)to)[0 .. bytes - 1];
    ensures \result == to;
    ensures value == 0 ==> zeroed((uint8_t *)to, bytes); */
void *memset(void *to, int value, size_t bytes);

#endif
