/* SPDX-License-Identifier: MIT */
/*
 * Square roots, by trying what there is: fix_sqrt is the floor of the root, fix_sqrt_above is above by less than 2^-14 of it and 1.
 *
 * bound: all numbers; sqrt32 is run for each of its 3 2^30; fix_sqrt at both ends of each interval that has one root, from 2^62 on
 * every: sqrt_newton sqrt32 fix_sqrt fix_sqrt_above
 * mutant: src/num/fix.c: << 32)) >> 17) / high -> << 32)) >> 18) / high
 *
 * With h = sqrt32(v >> 32) the guess h 2^16 + ((v - h^2 2^32) >> 17) / h rises with v as long as h is the same, and the
 * loop only lowers it, to the floor if it is not below. So it is enough to ask at the least v of each root that the guess is not
 * below it, and at the greatest that it is not above by more than the loop's few turns. Smaller numbers are shifted up
 * by an even count first, and floor(root / 2^k) is the floor of the root; 1 more is above it, and by 1 at most. fix_sqrt_above
 * does not fall while v rises.
 *
 * PROGRAM FROM TO asks the roots with this upper half, from 2^15 to 2^16.
 */
#include <stdio.h>
#include <stdlib.h>

#include "num/inline.c"
#include "num/fix.c"

void carom_assert_failed(const char *text, const char *file, int line)
{
    printf("%s:%d: %s fails\n", file, line, text);
    exit(1);
}

/* The guess of fix_sqrt, as its first lines make it. */
static uint64_t guess(uint64_t v)
{
    uint32_t high = sqrt32((uint32_t)(v >> 32));

    return ((uint32_t)((v - ((uint64_t)(high * high) << 32)) >> 17) / high) +
           ((uint64_t)high << 16);
}

static bool right(uint64_t root)
{
    const uint64_t least = root * root, most = least + 2 * root;

    return fix_sqrt(least) == root && fix_sqrt(most) == root && guess(least) >= root &&
           guess(most) <= root + 2 && fix_sqrt_above(least) > (int64_t)root &&
           fix_sqrt_above(most) <= (int64_t)(root + (root >> 14) + 1);
}

int main(int count, char **words)
{
    const uint32_t from = (uint32_t)(count > 2 ? atoi(words[1]) : 1 << 15),
                   to = (uint32_t)(count > 2 ? atoi(words[2]) : 1 << 16);

    for (uint32_t high = from; high < to; high++) {
        for (uint32_t v = high * high; v - high * high <= 2 * high; v++) {
            if (sqrt32(v) != high) {
                return 1;
            }
        }
        for (uint32_t low = 0; low < 1 << 16; low++) {
            if (!right((uint64_t)high << 16 | low)) {
                return 1;
            }
        }
    }
    return 0;
}
