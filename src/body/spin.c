/* SPDX-License-Identifier: MIT */
/* Which spins fit their format. */
#include "body.h"

/* Bits of |L| / m in units: at most 2^10 times that of the fastest body that a caller can make. */
#define ANGULAR_BITS 20

/*
 * True if the sum of |L|'s components over the mass, an upper bound, has at most ANGULAR_BITS. 1 /
 * m is below 2^30 2^-e, so |L| / m is below 2^(bits + 30 - e).
 */
static bool angular_fits(const struct body *b, const struct body_state *s)
{
    return fix_bits(fix_sum(s->angular.c)) + 30 - b->def.inverse_mass.e <= 40 + ANGULAR_BITS;
}

/*
 * True if J^-1 L / m fits, in 128 bits, by the 30 bits of the inverse: their error is below 2^-28
 * of the largest entry, and so of the largest spin that such an L can have.
 */
static bool spin_fits(const struct body *b, const struct body_state *s, const carom_m3_q30 *r)
{
    int64_t l[3];

    fix_mul_scaled3(l, s->angular.c, b->def.inverse_mass);
    fix_rotate_back(l, r, l);
    FIX_UNROLL
    for (int i = 0; i < 3; i++) {
        struct fix_wide sum = {0, 0};

        for (int k = 0; k < 3; k++) {
            fix_wide_add_product(&sum, b->def.mesh->inverse.m[fix_sym3_at[i][k]], l[k]);
        }
        if (fix_wide_bits(&sum) - b->def.mesh->inverse.e > 40 + BODY_SPIN_BITS) {
            return false;
        }
    }
    return true;
}

bool body_spin_fits(const struct body *b, const struct body_state *s, const carom_m3_q30 *r)
{
    /* a calm body turns by less than half a radian, and most bodies are hardly faster */
    return fix_sum(s->angular.c) >> (BODY_SPIN_BITS + 1) < b->def.calm_angular_q40 ||
           (angular_fits(b, s) && spin_fits(b, s, r));
}

void body_spin_most(const struct body_state *s, carom_v3_q40 *spin)
{
    carom_v3_q30 along = {{0, 0, 0}};

    fix_normalise(&along, s->angular.c);
    for (int k = 0; k < 3; k++) {
        spin->c[k] = carom_shl(along.c[k], 10 + BODY_SPIN_BITS);
    }
}
