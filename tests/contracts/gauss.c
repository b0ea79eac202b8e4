/* SPDX-License-Identifier: MIT */
/*
 * Eva follows each part of gauss for all numbers within its bounds and all n from 1 to 15, and finds nothing undefined.
 *
 * A part assumes bounds of what the part before it leaves: tests/proof/gauss_*.c prove these.
 *
 * assumed: carom_shl by shifts
 * eva: any_rows any_choice any_eliminations any_diagonal any_carry any_division any_residual any_digits any_going_on
 * mutant: any_eliminations in src/num/gauss.c: f = -row[k]; -> f = row[k] - FULL - FULL;
 * mutant: any_division in src/num/gauss.c: (most - g->inverse_shift[k]) -> (g->inverse_shift[k] - most)
 * mutant: any_digits in src/num/gauss.c: h - 40 > 62 ? 0 -> h - 40 > 64 ? 0
 * mutant: any_going_on in src/num/gauss.c: up < 64 ? -> up < 65 ?
 */
#include <__fc_builtin.h>
#include "contract.h"
#include "num/fix.c"
#define magnitude magnitude_of_32 /* fix.c has a function of this name, too */
#include "num/gauss.c"

/* `make proof` proves this of carom_shl. */
/*@ requires 0 <= s <= 63;
    assigns \result \from v, s;
    ensures INT64_MIN <= v * (1 << s) <= INT64_MAX ==> \result == v * (1 << s); */
int64_t carom_shl(int64_t v, int s);

#define HALF_WORD ((int64_t)1 << 61)

static struct gauss g;
static int n;

static int number(int low, int high)
{
    return Frama_C_interval(low, high);
}

static int64_t long_number(int64_t low, int64_t high)
{
    return Frama_C_long_long_interval(low, high);
}

/* Entries, right-hand sides and solutions within their bounds. */
static void any_numbers(void)
{
    n = number(1, GAUSS_MAX);
    for (int i = 0; i < GAUSS_MAX; i++) {
        for (int j = 0; j <= GAUSS_MAX; j++) {
            g.a[i][j] = number(-FULL, FULL);
        }
        g.x_q40[i] = long_number(-2 * HALF_WORD, 2 * HALF_WORD);
        g.residual[i] = long_number(-HALF_WORD, HALF_WORD);
        g.y[i] = long_number(-FULL, FULL);
        g.step[i] = (int8_t)number(-1, GAUSS_MAX - 1);
    }
}

/* The shifts, pivots and rows that an elimination leaves. */
static void any_steps(void)
{
    for (int k = 0; k < GAUSS_MAX; k++) {
        g.up[k] = (uint8_t)number(0, 29);
        g.pivot[k] = number(-FULL, FULL);
        g.row[k] = (uint8_t)number(0, GAUSS_MAX - 1);
        g.inverse_shift[k] = (uint8_t)number(0, 29);
        for (int i = 0; i < GAUSS_MAX; i++) {
            g.shift[i][k] = (uint8_t)number(1, 32);
        }
    }
}

void any_rows(void)
{
    any_numbers();
    normalise_rows(&g, n);
}

void any_choice(void)
{
    any_numbers();
    choose_pivot(&g, n, number(0, GAUSS_MAX - 1));
}

static void any_elimination(int low, int high)
{
    any_numbers();
    any_steps();
    for (int k = 0; k < GAUSS_MAX; k++) {
        g.pivot[k] = number(low, high);
    }
    eliminate(&g, n, number(0, GAUSS_MAX - 1), number(0, GAUSS_MAX - 1));
}

void any_eliminations(void)
{
    any_elimination(SMALLEST_PIVOT, FULL);
    any_elimination(-FULL, -SMALLEST_PIVOT);
}

static void any_diagonal_of(int low, int high)
{
    any_numbers();
    for (int i = 0; i < GAUSS_MAX; i++) {
        for (int j = 0; j < GAUSS_MAX; j++) {
            g.a[i][j] = number(low, high);
        }
    }
    invert_diagonal(&g, n);
}

/* Diagonals of one number of bits and one sign: the loop looks at each entry alone. */
void any_diagonal(void)
{
    for (int bits = 0; bits <= 30; bits++) {
        int low = 1 << bits, high = bits < 30 ? 2 * low - 1 : FULL;

        any_diagonal_of(low, high);
        any_diagonal_of(-high, -low);
    }
}

void any_carry(void)
{
    any_numbers();
    any_steps();
    carry(&g, n, number(0, GAUSS_MAX - 1));
}

/* One of the shifts is the most: each place of it with each number. */
void any_division(void)
{
    int most = number(0, 29), at = number(0, GAUSS_MAX - 1);

    any_numbers();
    any_steps();
    /*@ split most; */
    /*@ split at; */
    for (int k = 0; k < GAUSS_MAX; k++) {
        g.inverse_shift[k] = (uint8_t)number(0, most);
    }
    g.inverse_shift[at] = (uint8_t)most;
    divide_diagonal(&g, number(at + 1, GAUSS_MAX));
}

void any_residual(void)
{
    int32_t row[GAUSS_MAX];

    any_numbers();
    any_steps();
    for (int j = 0; j < GAUSS_MAX; j++) {
        row[j] = number(-FULL, FULL);
    }
    gauss_take_out(&g, n, number(0, GAUSS_MAX - 1), row);
}

void any_digits(void)
{
    any_numbers();
    add_digits(&g, n, number(DIGITS_BITS - 20, 1000));
}

/* Only the difference of h and of the last one is used. */
void any_going_on(void)
{
    any_numbers();
    g.last = 0;
    go_on(&g, n, number(4, 1000));
}
