/* SPDX-License-Identifier: MIT */
/*
 * proof - what the programs of this folder have in common: tools/proof.py runs proof() of each for all inputs at once.
 *
 * clang's sanitizers of integers are on and so are the assertions of the engine, so every operation that these catch is asked
 * about, beside the checks that a program makes. Programs include the source that they ask about.
 */
#ifndef CAROM_TESTS_PROOF_H
#define CAROM_TESTS_PROOF_H

#include "num/inline.c"

/* Any number from low to high. */
int64_t proof_range(int64_t low, int64_t high);
/* Go on only if this holds: before the engine is called. */
void proof_assume(bool holds);
/* This always holds. */
void proof_check(bool holds);

#define proof_word() proof_range(INT64_MIN, INT64_MAX)

/* The formulas of expected values are exact in so many bits. */
typedef __int128 wide;

void proof(void);

#endif
