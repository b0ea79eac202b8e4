/* SPDX-License-Identifier: MIT */
/*
 * Share normals that differ by a hair. Faces on each other are as parallel as the gaps at their
 * corners are even: to a few parts in 10^5. A body pressed between two such faces would be pushed
 * out by that part of the pressure, which is its own weight or more if the body on top is as many
 * times as heavy. Within their skins such faces count as parallel.
 */
#include "parts.h"

/* True if the contact's pair rests on a face: it has three contacts in the island. */
static bool on_face(const struct rest *r, uint32_t i)
{
    uint32_t first = i;

    while (first > 0 && first + 2 > i && rest_same_pair(r, i, first - 1)) {
        first--;
    }
    return rest_same_pair(r, i, first + 2);
}

/* True if `sign` other is as good a normal of the contact. */
static bool as_good(const struct contact *c, const carom_v3_q30 *other, int32_t sign)
{
    int64_t change_q40 = 0;

    for (int k = 0; k < 3; k++) {
        int64_t off = (int64_t)sign * other->c[k] - c->normal.c[k];

        if (off > CONTACT_LEAN_MAX_Q30 || off < -CONTACT_LEAN_MAX_Q30) {
            return false;
        }
        change_q40 += fix_mul_q30(c->velocity_q40.c[k], (int32_t)off);
    }
    return carom_abs(change_q40) < carom_shl(c->skin_q22 / REST_SHARE_DIVISOR, 18);
}

void rest_share_normal(struct rest *r, uint32_t i)
{
    struct contact *c = rest_contact(r, i);

    if (i == 0 || !on_face(r, i)) {
        return;
    }
    for (uint32_t j = 0; j < i; j++) {
        const carom_v3_q30 *other = &rest_contact(r, j)->normal;

        for (int32_t sign = 1; sign >= -1; sign -= 2) {
            if (as_good(c, other, sign) && on_face(r, j)) {
                for (int k = 0; k < 3; k++) {
                    c->normal.c[k] = sign * other->c[k];
                }
                return;
            }
        }
    }
}
