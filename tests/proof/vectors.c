/* SPDX-License-Identifier: MIT */
/*
 * Dot and cross products, and a symmetric matrix times a vector, are exact.
 *
 * bound: |a| up to 1 in q30 by component, |b| < 2^30; for fix_cross all above INT32_MIN; the matrix below 2^30, its vector below 2^31
 * mutant: include/carom_fix.h: (int64_t)a[2] * b[2] -> (int64_t)a[2] * b[1]
 * mutant: src/num/fix.h: (int64_t)m[4] * z -> (int64_t)m[3] * z
 */
#include "proof.h"
#include "num/fix.c"

static void any(int32_t *out, int count, int64_t limit)
{
    for (int k = 0; k < count; k++) {
        out[k] = (int32_t)proof_range(-limit, limit);
    }
}

void proof(void)
{
    int32_t a[3], b[3], c[3], d[3], m[6], full[3][3];
    int64_t out[3], moved[3];

    any(a, 3, 1 << 30);
    any(b, 3, (1 << 30) - 1);
    any(c, 3, INT32_MAX);
    any(d, 3, INT32_MAX);
    any(m, 6, (1 << 30) - 1);
    proof_check(carom_dot(a, b) == (wide)a[0] * b[0] + (wide)a[1] * b[1] + (wide)a[2] * b[2]);
    fix_cross(out, c, d);
    fix_sym3_dot(moved, m, c);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;

        proof_check(out[i] == (wide)c[j] * d[k] - (wide)c[k] * d[j]);
        for (j = 0; j < 3; j++) {
            full[i][j] = m[fix_sym3_at[i][j]];
        }
        proof_check(moved[i] ==
                    (wide)full[i][0] * c[0] + (wide)full[i][1] * c[1] + (wide)full[i][2] * c[2]);
    }
}
