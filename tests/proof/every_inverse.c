/* SPDX-License-Identifier: MIT */
/*
 * Inverses of mantissas, by trying what there is: of the diagonal within 1 of 2^59 / d and at most 2^30; of a scaled number within 1.
 *
 * bound: all mantissas of 2^29 to 2^30, of both signs on the diagonal; smaller entries are shifted up to these first
 * every: invert_diagonal fix_scaled_inverse
 * mutant: src/num/gauss.c: ((int64_t)1 << 59) / carom_shl -> ((int64_t)1 << 60) / carom_shl
 *
 * PROGRAM FROM TO asks the mantissas with this upper half, from 2^15 to 2^16.
 */
#include <stdio.h>
#include <stdlib.h>

#define magnitude magnitude_wide
#include "num/fix.c"
#undef magnitude
#include "num/gauss.c"
#include "num/inline.c"

void carom_assert_failed(const char *text, const char *file, int line)
{
    printf("%s:%d: %s fails\n", file, line, text);
    exit(1);
}

static bool right_on_diagonal(int32_t d)
{
    static struct gauss g;
    int64_t off;

    g.a[0][0] = d;
    if (invert_diagonal(&g, 1) != 0 || fix_abs32(g.a[0][0]) > CAROM_ONE_Q30 ||
        g.inverse_shift[0] != 0) {
        return false;
    }
    off = (int64_t)g.a[0][0] * d - ((int64_t)1 << 59);
    return carom_abs(off) < fix_abs32(d);
}

/* m 2^-30 times its inverse is 1 within a unit of the inverse's mantissa. */
static bool right_when_scaled(int32_t m)
{
    struct fix_scaled in = {m, 30}, out = fix_scaled_inverse(in);
    int64_t one = (int64_t)1 << (out.e + 30), off = (int64_t)m * out.m - one;

    return out.m >= 1 << 29 && out.m < 1 << 30 && carom_abs(off) <= m;
}

int main(int count, char **words)
{
    const int32_t from = count > 2 ? atoi(words[1]) : 1 << 15,
                  to = count > 2 ? atoi(words[2]) : 1 << 16;

    for (int64_t m = (int64_t)from << 14; m < (int64_t)to << 14; m++) {
        if (!right_on_diagonal((int32_t)m) || !right_on_diagonal((int32_t)-m) ||
            !right_when_scaled((int32_t)m)) {
            printf("wrong at %d\n", (int)m);
            return 1;
        }
    }
    return 0;
}
