/* SPDX-License-Identifier: MIT */
#include "contact.h"

/* Contacts whose normals' cosine is above this share a normal: 1 - 1e-4. */
#define SAME_NORMAL_Q30 (CAROM_ONE_Q30 - 107374)

/* Two unit vectors square to N and to each other. */
static void tangents(struct contact *c)
{
    const int32_t *n = c->direction[0].c;
    int64_t across[3] = {0, 0, 0};

    /* N x the axis that N is least along, of x and y */
    if (carom_abs(n[0]) < carom_abs(n[1])) {
        across[1] = n[2];
        across[2] = -n[1];
    } else {
        across[0] = -n[2];
        across[2] = n[0];
    }
    fix_normalise(&c->direction[1], across);
    carom_cross(c->direction[2].c, n, c->direction[1].c, 30);
}

/* The place in key order for a candidate; sets *same when it is there already. */
static uint32_t find_place(const struct contact_list *list, const struct candidate *key, bool *same)
{
    uint32_t low = 0, high = list->pool->used;

    *same = false;
    while (low < high) {
        uint32_t middle = (low + high) / 2;
        int order = candidate_compare(&list->contacts[middle].key, key);

        if (order == 0) {
            *same = true;
            return middle;
        }
        if (order < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* Insert a contact; NULL when the pool is full. The new place is cleared. */
static struct contact *insert(struct contact_list *list, uint32_t place)
{
    struct contact *c = &list->contacts[place];
    uint32_t behind = list->pool->used - place;

    if (pool_take(list->pool) < 0) {
        return NULL;
    }
    memmove(c + 1, c, behind * sizeof *c);
    memset(c, 0, sizeof *c);
    return c;
}

static bool add(struct contact_list *list, uint32_t place, const struct boyse_pair *pair,
                const struct candidate *key, const struct boyse_touch *touch,
                const carom_v3_q22 *centre_a, const carom_v3_q22 *centre_b)
{
    struct contact *c = insert(list, place);

    if (!c) {
        return false;
    }
    c->key = *key;
    c->gap_q22 = touch->gap_q22;
    c->skin_q22 = pair->skin_q22;
    c->direction[0] = touch->normal;
    tangents(c);
    c->side[0].body = pair->a->moving ? pair->a : NULL;
    c->side[1].body = pair->b->moving ? pair->b : NULL;
    for (int k = 0; k < 3; k++) {
        int32_t middle = (int32_t)(((int64_t)touch->on_a.c[k] + touch->on_b.c[k]) >> 1);

        c->side[0].arm.c[k] = middle - centre_a->c[k];
        c->side[1].arm.c[k] = middle - centre_b->c[k];
        c->point.c[k] = carom_shl(pair->a->path.origin_q22[k] + c->side[0].arm.c[k], 10) +
                        pair->a->path.start.x.c[k];
    }
    return true;
}

static void centres(const struct boyse_pair *pair, carom_v3_q22 *centre_a, carom_v3_q22 *centre_b)
{
    for (int k = 0; k < 3; k++) {
        centre_a->c[k] = (int32_t)carom_round(pair->a->path.start.x.c[k], 10);
        centre_b->c[k] = pair->offset_q22[k] + (int32_t)carom_round(pair->b->path.start.x.c[k], 10);
    }
}

bool contact_add(struct contact_list *list, const struct boyse_pair *pair,
                 const struct candidate *c, int32_t margin_q22)
{
    int32_t deepest = -(pair->skin_q22 * 5 / 2);
    struct boyse_touch touch;
    carom_v3_q22 centre_a, centre_b;
    uint32_t place;
    int64_t gap = boyse_gap(pair, c, 0, 1);
    bool same;

    if (c->kind == CANDIDATE_EDGE_EDGE) {
        gap = carom_abs(gap); /* the side is not known yet */
    }
    if (gap > margin_q22 || gap < deepest) {
        return true;
    }
    boyse_touch(pair, c, 0, &touch);
    if (!touch.valid || touch.gap_q22 > margin_q22 || touch.gap_q22 < deepest) {
        return true;
    }
    place = find_place(list, c, &same);
    if (same) {
        return true;
    }
    centres(pair, &centre_a, &centre_b);
    return add(list, place, pair, c, &touch, &centre_a, &centre_b);
}

static int64_t cosine_q30(const carom_v3_q30 *a, const carom_v3_q30 *b)
{
    return carom_dot(a->c, b->c) >> 30;
}

static int64_t distance_q22(const carom_v3_q22 *a, const carom_v3_q22 *b)
{
    int64_t sum = 0;

    for (int k = 0; k < 3; k++) {
        sum += carom_abs((int64_t)a->c[k] - b->c[k]);
    }
    return sum;
}

bool contact_force(struct contact_list *list, const struct boyse_pair *pair,
                   const struct boyse_hit *hit, const carom_v3_q22 *centre_a,
                   const carom_v3_q22 *centre_b)
{
    struct boyse_touch touch = hit->touch;
    carom_v3_q22 arm;
    uint32_t place;
    bool same;

    place = find_place(list, &hit->candidate, &same);
    if (same) {
        return true;
    }
    for (int k = 0; k < 3; k++) {
        arm.c[k] = (int32_t)(((int64_t)touch.on_a.c[k] + touch.on_b.c[k]) >> 1) - centre_a->c[k];
    }
    for (uint32_t i = 0; i < list->pool->used; i++) {
        const struct contact *c = &list->contacts[i];

        if (c->key.pair == hit->candidate.pair &&
            distance_q22(&c->side[0].arm, &arm) < 20 * (int64_t)pair->skin_q22 &&
            cosine_q30(&c->direction[0], &touch.normal) > SAME_NORMAL_Q30) {
            return true;
        }
    }
    touch.gap_q22 = pair->skin_q22 / 2;
    return add(list, place, pair, &hit->candidate, &touch, centre_a, centre_b);
}

void contact_merge(struct contact_list *list)
{
    uint32_t kept = 0;

    for (uint32_t i = 0; i < list->pool->used; i++) {
        struct contact *c = &list->contacts[i];
        uint32_t j;

        for (j = 0; j < kept; j++) {
            struct contact *k = &list->contacts[j];

            if (k->key.pair == c->key.pair &&
                distance_q22(&k->side[0].arm, &c->side[0].arm) < 2 * (int64_t)c->skin_q22 &&
                cosine_q30(&k->direction[0], &c->direction[0]) > SAME_NORMAL_Q30) {
                break;
            }
        }
        if (j < kept) {
            if (c->gap_q22 < list->contacts[j].gap_q22) {
                list->contacts[j].gap_q22 = c->gap_q22;
            }
        } else {
            list->contacts[kept++] = *c;
        }
    }
    list->pool->used = kept;
}
