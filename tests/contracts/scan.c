/* SPDX-License-Identifier: MIT */
/*
 * Two parts of scan conversion: quotients are floors, for every dividend and divisor; cells stay within the grid.
 *
 * mutant: divide in src/mesh/scan.c: q.floor--; -> q.floor++;
 * mutant: touched in src/mesh/scan.c: fix_smaller((high >> shift) + 1, count) -> fix_smaller((high >> shift) + 1, count + 1)
 */
#include "fix.c"
#include "mesh/scan.c"

/*@ requires d > 0 && INT32_MIN * d <= n <= INT32_MAX * d;
    assigns \nothing;
    ensures rest: 0 <= \result.rest < d;
    ensures floor: n == \result.floor * d + \result.rest; */
static struct quotient divide(int64_t n, int32_t d);

/*@ requires 0 <= shift <= 24 && 0 <= count <= 64 && \abs(low) <= (1 << 30) + (1 << 26) && \abs(high) <= (1 << 30) + (1 << 26);
    requires \valid(first) && \valid(end) && \separated(first, end);
    assigns *first, *end;
    ensures 0 <= *first && *end <= count; */
static void touched(int32_t low, int32_t high, int shift, int32_t count, int32_t *first,
                    int32_t *end);
