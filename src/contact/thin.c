/* SPDX-License-Identifier: MIT */
/*
 * Drop contacts that carry nothing. Where two faces lie on each other contacts are the corners of a
 * polygon: eight for two boxes. A corner that hardly stands out between two others carries no more
 * than these do. A body that tips over it hits there, and then it is a contact again.
 */
#include "contact.h"

/* Pairs with more contacts than this are left alone. */
#define MOST 16
/* Lengths are compared with this many bits. */
#define LENGTH_BITS 13

/* The place of a contact relative to the first, in units in which no component is above 2^13. */
struct offset {
    int32_t c[3];
};

static inline void subtract(const int32_t a[3], const int32_t b[3], int32_t d[3])
{
    d[0] = a[0] - b[0];
    d[1] = a[1] - b[1];
    d[2] = a[2] - b[2];
}

static void find_places(const struct contact *contacts, uint32_t n, struct offset *places)
{
    carom_v3_q22 first = contact_arm(&contacts[0]);
    uint32_t used = 0;
    int down;

    for (uint32_t i = 0; i < n; i++) {
        carom_v3_q22 arm = contact_arm(&contacts[i]);

        subtract(arm.c, first.c, places[i].c);
        used |= (uint32_t)fix_largest(places[i].c);
    }
    down = fix_bits32(used) - LENGTH_BITS;
    for (uint32_t i = 0; down > 0 && i < n; i++) {
        for (int k = 0; k < 3; k++) {
            places[i].c[k] >>= down;
        }
    }
}

/* True if a place lies between two others and hardly stands out. */
static bool is_between(const struct offset *at, const struct offset *one,
                       const struct offset *other)
{
    int32_t d[3], e[3];
    int64_t along, square, off2;

    subtract(at->c, one->c, e);
    subtract(other->c, one->c, d);
    along = carom_dot(d, e);
    if (along <= 0) {
        return false;
    }
    square = carom_dot(d, d);
    /* at most 2^14 along an axis, so all of this is below 2^60 */
    off2 = carom_dot(e, e) * square - along * along;
    square /= CONTACT_STANDS_OUT_DIVISOR;
    return along < square * CONTACT_STANDS_OUT_DIVISOR && off2 < square * square;
}

/* True if two contacts are of the same two faces. */
static bool on_one_plane(const struct contact *a, const struct contact *b)
{
    for (int k = 0; k < 3; k++) {
        if (carom_abs((int64_t)a->normal.c[k] - b->normal.c[k]) > CONTACT_LEAN_MAX_Q30) {
            return false;
        }
    }
    return true;
}

/* The nearest of n places to the i-th. */
static uint32_t nearest(const struct offset *places, uint32_t n, uint32_t i)
{
    int64_t least = INT64_MAX;
    uint32_t best = i;

    for (uint32_t j = 0; j < n; j++) {
        int32_t d[3];

        subtract(places[j].c, places[i].c, d);
        if (j != i && carom_dot(d, d) < least) {
            least = carom_dot(d, d);
            best = j;
        }
    }
    return best;
}

/* True if the i-th contact hardly stands out between the one nearest to it and any other. */
static bool is_dispensable(const struct contact *contacts, const struct offset *places, uint32_t n,
                           uint32_t i)
{
    const struct contact *c = &contacts[i];
    uint32_t j = nearest(places, n, i);

    if (c->drift || !on_one_plane(c, &contacts[j])) {
        return false;
    }
    for (uint32_t k = 0; k < n; k++) {
        const struct contact *other = &contacts[k];

        if (k != i && k != j && is_between(&places[i], &places[j], &places[k]) &&
            on_one_plane(c, other) &&
            (c->gap_q22 >= contacts[j].gap_q22 || c->gap_q22 >= other->gap_q22)) {
            return true;
        }
    }
    return false;
}

uint32_t contact_thin(struct contact *contacts, uint32_t n)
{
    struct offset places[MOST];

    if (n <= CONTACT_ENOUGH || n > MOST) {
        return n;
    }
    find_places(contacts, n, places);
    /* crossings of edges, which come and go; they are last in key order */
    for (uint32_t i = n;
         i > 0 && n > CONTACT_ENOUGH && contacts[i - 1].key.kind == CANDIDATE_EDGE_EDGE; i--) {
        if (is_dispensable(contacts, places, n, i - 1)) {
            n--;
            memmove(&contacts[i - 1], &contacts[i], (n - (i - 1)) * sizeof *contacts);
            memmove(&places[i - 1], &places[i], (n - (i - 1)) * sizeof *places);
        }
    }
    return n;
}
