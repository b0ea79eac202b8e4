/* SPDX-License-Identifier: MIT */
/*
 * floor(n / d) and the remainder, by trying what there is: n = floor d + rest, 0 <= rest < d.
 *
 * bound: d of 1 to 2^10, n of -2^20 to 2^20; a solver does not answer for products of two unknown numbers
 * every: divide
 * mutant: src/mesh/scan.c: q.rest += d; -> q.rest += 0;
 *
 * PROGRAM FROM TO asks the n of these parts of the range, from 2^15 to 2^16.
 */
#include <stdio.h>
#include <stdlib.h>

#include "mesh/scan.c"

void carom_assert_failed(const char *text, const char *file, int line)
{
    printf("%s:%d: %s fails\n", file, line, text);
    exit(1);
}

int main(int count, char **words)
{
    const int32_t from = count > 2 ? atoi(words[1]) : 1 << 15,
                  to = count > 2 ? atoi(words[2]) : 1 << 16;

    for (int32_t n = (from - 49152) * 64; n < (to - 49152) * 64; n++) {
        for (int32_t d = 1; d <= 1 << 10; d++) {
            struct quotient q = divide(n, d);

            if (q.rest < 0 || q.rest >= d || q.floor * d + q.rest != n) {
                printf("wrong at %d over %d\n", (int)n, (int)d);
                return 1;
            }
        }
    }
    return 0;
}
