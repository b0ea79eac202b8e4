/* SPDX-License-Identifier: MIT */
/*
 * Contacts that hold nothing. Where two faces lie on each other the places of contact are the corners of a
 * polygon: eight for two boxes. A corner that hardly stands out between two others carries no more than these
 * do. A body that tips over it hits there, and then it is a contact again.
 */
#include "contact.h"

/* A corner hardly stands out when it does so by less than this part of the way between the two. */
#define STANDS_OUT_DIVISOR 32
/* So many contacts hold a face: none of them is dispensable. */
#define ENOUGH 4
/* Nor are any of more than so many. */
#define MOST 16
/* Lengths are compared with so many bits. */
#define LENGTH_BITS 14

static void way(const carom_v3_q22 *from, const carom_v3_q22 *to, int32_t way_q22[3])
{
    for (int k = 0; k < 3; k++) {
        way_q22[k] = to->c[k] - from->c[k];
    }
}

static int64_t dot(const int32_t a[3], const int32_t b[3])
{
    return (int64_t)a[0] * b[0] + (int64_t)a[1] * b[1] + (int64_t)a[2] * b[2];
}

/* Whether a place lies between two others, and hardly stands out. */
static bool is_between(const carom_v3_q22 *place, const carom_v3_q22 *one,
                       const carom_v3_q22 *other)
{
    int32_t d[3], e[3];
    int64_t along, square, off = 0;
    int down;

    way(one, other, d);
    way(one, place, e);
    down = fix_bits32((uint32_t)(fix_largest(d) | fix_largest(e))) - LENGTH_BITS;
    for (int k = 0; down > 0 && k < 3; k++) {
        d[k] >>= down;
        e[k] >>= down;
    }
    along = dot(d, e);
    square = dot(d, d);
    if (along <= 0 || along >= square) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        int64_t cross = (int64_t)d[k] * e[(k + 1) % 3] - (int64_t)d[(k + 1) % 3] * e[k];

        off += cross * cross;
    }
    square /= STANDS_OUT_DIVISOR;
    return off < square * square;
}

/* Whether two contacts are of the same two faces. */
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
static uint32_t nearest(const carom_v3_q22 *places, uint32_t n, uint32_t i)
{
    int64_t least_q22 = INT64_MAX;
    uint32_t best = i;

    for (uint32_t j = 0; j < n; j++) {
        int64_t off_q22 = 0;

        for (int k = 0; k < 3; k++) {
            off_q22 += carom_abs((int64_t)places[j].c[k] - places[i].c[k]);
        }
        if (j != i && off_q22 < least_q22) {
            least_q22 = off_q22;
            best = j;
        }
    }
    return best;
}

/* Whether the i-th hardly stands out between the one nearest to it and any other. */
static bool is_dispensable(const struct contact *contacts, const carom_v3_q22 *places, uint32_t n,
                           uint32_t i)
{
    const struct contact *c = &contacts[i];
    uint32_t j = nearest(places, n, i);

    if (c->key.kind != CANDIDATE_EDGE_EDGE || !on_one_plane(c, &contacts[j]) ||
        (c->drift.c[0] | c->drift.c[1] | c->drift.c[2]) != 0) {
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
    carom_v3_q22 places[MOST];

    if (n <= ENOUGH || n > MOST) {
        return n;
    }
    for (uint32_t i = 0; i < n; i++) {
        places[i] = contact_arm(&contacts[i]);
    }
    /* from the last on, for there the crossings of edges are, which come and go */
    for (uint32_t i = n; i > 0 && n > ENOUGH; i--) {
        if (is_dispensable(contacts, places, n, i - 1)) {
            n--;
            memmove(&contacts[i - 1], &contacts[i], (n - (i - 1)) * sizeof *contacts);
            memmove(&places[i - 1], &places[i], (n - (i - 1)) * sizeof *places);
        }
    }
    return n;
}
