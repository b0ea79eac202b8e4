/* SPDX-License-Identifier: MIT */
/* The list of contacts: test candidates, insert, merge, and find those of a pair. */
#include "../num/sort.h"
#include "contact.h"

extern inline int contact_arm_bits(const struct body *b);
extern inline carom_v3_q22 contact_arm(const struct contact *c);
extern inline int32_t contact_arm_along(const struct contact *c, int k);

static bool before(const void *contact, const void *key)
{
    return candidate_compare(&((const struct contact *)contact)->key,
                             (const struct candidate *)key) < 0;
}

/* The place in key order for a candidate; sets *same if it is in the list already. */
static uint32_t find_place(const struct contact_list *list, const struct candidate *key, bool *same)
{
    uint32_t used = list->pool->used, place = used;

    /* at the start of a frame pairs come in order: most belong at the end */
    if (used == 0 || !before(&list->contacts[used - 1], key)) {
        place = sort_lower_bound(list->contacts, used, sizeof *list->contacts, key, before);
    }
    *same = place < used && candidate_equal(&list->contacts[place].key, key);
    return place;
}

/*
 * Make room at a place, in a list that is not full: up to the next contact in doubt, whose room it
 * takes. Clears what the solver does not set.
 */
static struct contact *insert(struct contact_list *list, uint32_t place)
{
    struct contact *c = &list->contacts[place], *to = c;
    struct contact *end = &list->contacts[list->pool->used];

    while (to < end && !to->doubted) {
        to++;
    }
    list->pool->used += to == end;
    /* one by one, because a memmove that overlaps upwards may go byte by byte */
    for (; to > c; to--) {
        *to = to[-1];
    }
    c->work = NULL;
    c->idle = c->resting = c->impact = c->lasting = c->doubted = false;
    PHASE_BEGIN(c->phase, CONTACT_IMPULSE);
    c->impulse_q40 = (carom_v3_q40){{0, 0, 0}};
    return c;
}

static void set_arm(struct contact_side *side, const carom_v3_q40 *arm)
{
    int down = 40 - contact_arm_bits(side->body);

    for (int k = 0; down > 0 && k < 3; k++) {
        side->arm_q30[k] = (int32_t)carom_round(arm->c[k], down);
    }
    /* for radii below 2^-10 units */
    for (int k = 0; down <= 0 && k < 3; k++) {
        side->arm_q30[k] = (int32_t)carom_shl(arm->c[k], -down);
    }
}

static void set_arms(struct contact *c, const carom_v3_q40 arm[2])
{
    for (int s = 0; s < 2; s++) {
        if (c->side[s].body) {
            set_arm(&c->side[s], &arm[s]);
        }
    }
}

carom_v3_q32 contact_point(const struct contact *c)
{
    const struct body *a = c->side[0].body;
    carom_v3_q32 point;

    for (int k = 0; k < 3; k++) {
        point.c[k] = carom_shl(body_origin_q22(a)[k], 10) + a->path.start_x_q32[k] +
                     fix_round_shift(c->side[0].arm_q30[k], 32 - contact_arm_bits(a));
    }
    return point;
}

/* Set a contact's drift by moving surfaces and materials, and its own e and mu. */
FIX_APART static void set_drift(struct contact_list *list, const struct boyse_pair *pair,
                                struct contact *c, const carom_v3_q40 *arm)
{
    struct contact_mixed mixed;
    carom_v3_q40 drift;
    bool mixes = false;

    contact_drift(pair, &c->key, arm, &drift);
    if (list->materials && (pair->a->def.extra || pair->b->def.extra)) {
        mixes = list->materials(list, pair, &c->key, &c->normal, &drift, &mixed);
    }
    contact_keep_drift(list, c, &drift, mixes ? &mixed : NULL);
}

bool contact_insert(struct contact_list *list, const struct boyse_pair *pair,
                    const struct candidate *key, const carom_v3_q30 *normal, int32_t gap_q22,
                    const carom_v3_q40 arm[2])
{
    bool same, full = list->pool->used == list->pool->size;
    uint32_t place = find_place(list, key, &same);
    struct contact *c;

    if (same && !list->contacts[place].doubted) {
        return true;
    }
    if (full) {
        contact_drop_doubted(list);
        if (list->pool->used == list->pool->size) {
            contact_merge(list); /* a full list is mostly repeated places */
        }
        if (list->pool->used == list->pool->size) {
            list->pool->refused++;
            return false;
        }
        place = find_place(list, key, &same);
    }
    CAROM_ASSERT(pair->a->def.moving);
    c = insert(list, place);
    c->key = *key;
    c->gap_q22 = gap_q22;
    c->skin_q22 = pair->skin_q22;
    c->normal = *normal;
    c->side[0].body = pair->a;
    c->side[1].body = pair->b->def.moving ? pair->b : NULL;
    set_arms(c, arm);
    c->drift = NULL;
    if (!list->plain || mesh_drift_most(pair->b->def.mesh) > 0) {
        set_drift(list, pair, c, &arm[1]);
    }
    return true;
}

/*
 * The part of a gap that a moving surface made: a body that lay on it and will follow it down is
 * still where it was, and a body thrown up is ahead of it.
 */
static int64_t drifted_q22(const struct boyse_pair *pair, const struct candidate *c,
                           const carom_v3_q30 *normal, const carom_v3_q40 *arm)
{
    carom_v3_q40 drift;

    contact_drift(pair, c, arm, &drift);
    return carom_abs(contact_rise_q40(&drift, normal)) >> 18;
}

bool contact_add(struct contact_list *list, struct boyse_pair *pair, const struct candidate *c,
                 int32_t margin_q22, int32_t *clear_q22)
{
    int32_t deepest = -(pair->skin_q22 * 5 / 2);
    int32_t most = mesh_drift_most(pair->b->def.mesh);
    struct boyse_touch touch;
    carom_v3_q40 arm[2];

    if (!boyse_static(pair, c, deepest, margin_q22 + most, &touch, clear_q22) || !touch.valid ||
        touch.gap_q22 > margin_q22 + most || touch.gap_q22 < deepest) {
        return true;
    }
    contact_flatten(pair, c, &touch.normal);
    contact_place(pair, c, &touch.normal, arm);
    if (most > 0 && touch.gap_q22 - drifted_q22(pair, c, &touch.normal, &arm[1]) > margin_q22) {
        return true;
    }
    return contact_insert(list, pair, c, &touch.normal, touch.gap_q22, arm);
}

static int64_t cosine_q30(const carom_v3_q30 *a, const carom_v3_q30 *b)
{
    return carom_dot(a->c, b->c) >> 30;
}

/* True if a contact is nearer to a place than a distance, in the L1 norm of world axes. */
static bool is_within(const struct contact *c, const carom_v3_q22 *place, int64_t distance_q22)
{
    for (int k = 0; k < 3 && distance_q22 > 0; k++) {
        distance_q22 -= carom_abs((int64_t)contact_arm_along(c, k) - place->c[k]);
    }
    return distance_q22 > 0;
}

/*
 * True if candidates count as the same feature. A vertex may be on nearly coplanar faces: wherever
 * its path would have had it, it is here. Edges count singly: they have the normal of the faces
 * that they border here, along which they may not approach.
 */
static bool same_feature(const struct candidate *p, const struct candidate *q)
{
    return p->kind == q->kind && p->i == q->i && (p->kind != CANDIDATE_EDGE_EDGE || p->j == q->j);
}

static void take_out(struct contact_list *list, uint32_t place)
{
    struct contact *c = &list->contacts[place];

    list->pool->used--;
    memmove(c, c + 1, (list->pool->used - place) * sizeof *c);
}

/*
 * A hit replaces contacts of its vertex: the faces of a field may differ by less than what makes
 * normals equal, and a body that slides from one onto the other runs into the other alone.
 */
bool contact_force(struct contact_list *list, const struct boyse_pair *pair,
                   const struct boyse_hit *hit)
{
    const carom_v3_q30 *normal = &hit->touch.normal;
    int32_t gap_q22 = pair->skin_q22 / 2;
    carom_v3_q40 arm[2];
    carom_v3_q22 near;
    bool taken = false, there = false;
    uint32_t i = 0;

    contact_place(pair, &hit->candidate, normal, arm);
    for (int k = 0; k < 3; k++) {
        near.c[k] = (int32_t)carom_round(arm[0].c[k], 18);
    }
    while (i < list->pool->used) {
        const struct contact *c = &list->contacts[i];
        bool same = c->key.pair == hit->candidate.pair &&
                    cosine_q30(&c->normal, normal) > CONTACT_SAME_NORMAL_Q30;

        if (same && same_feature(&c->key, &hit->candidate)) {
            gap_q22 = c->gap_q22 < gap_q22 ? c->gap_q22 : gap_q22;
            take_out(list, i);
            taken = true;
            continue;
        }
        there = there || (same && is_within(c, &near, 20 * (int64_t)pair->skin_q22));
        i++;
    }
    if (there && !taken) {
        return true;
    }
    return contact_insert(list, pair, &hit->candidate, normal, gap_q22, arm);
}

void contact_merge(struct contact_list *list)
{
    uint32_t kept = 0, first = 0; /* kept contacts; the first kept one of the present pair */

    for (uint32_t i = 0; i < list->pool->used; i++) {
        struct contact *c = &list->contacts[i];
        carom_v3_q22 arm = contact_arm(c);
        uint32_t j;

        if (kept > 0 && list->contacts[kept - 1].key.pair != c->key.pair) {
            first = kept;
        }
        for (j = first; j < kept; j++) {
            struct contact *k = &list->contacts[j];

            if (is_within(k, &arm, 2 * (int64_t)c->skin_q22) &&
                cosine_q30(&k->normal, &c->normal) > CONTACT_SAME_NORMAL_Q30) {
                break;
            }
        }
        if (j < kept) {
            if (c->gap_q22 < list->contacts[j].gap_q22) {
                list->contacts[j].gap_q22 = c->gap_q22;
            }
        } else {
            if (kept < i) {
                list->contacts[kept] = *c;
            }
            kept++;
        }
    }
    list->pool->used = kept;
    if (kept > list->pool->peak) {
        list->pool->peak = kept;
    }
}

struct contact_range contact_of_pair(const struct contact_list *list, uint16_t pair)
{
    const struct candidate least = {pair, 0, 0, 0};
    bool same;
    uint32_t first = find_place(list, &least, &same);

    return (struct contact_range){first, contact_pair_end(list, pair, first)};
}

void contact_drop_pair(struct contact_list *list, uint16_t pair)
{
    struct contact_range own = contact_of_pair(list, pair);

    memmove(&list->contacts[own.first], &list->contacts[own.end],
            (list->pool->used - own.end) * sizeof *list->contacts);
    list->pool->used -= own.end - own.first;
}

void contact_doubt_pair(struct contact_list *list, uint16_t pair)
{
    struct contact_range own = contact_of_pair(list, pair);

    for (uint32_t i = own.first; i < own.end; i++) {
        list->contacts[i].doubted = true;
    }
}

bool contact_has_pair(const struct contact_list *list, uint16_t pair)
{
    struct contact_range own = contact_of_pair(list, pair);

    while (own.first < own.end && list->contacts[own.first].doubted) {
        own.first++;
    }
    return own.first < own.end;
}

void contact_drop_doubted(struct contact_list *list)
{
    uint32_t kept = 0;

    for (uint32_t i = 0; i < list->pool->used; i++) {
        if (!list->contacts[i].doubted) {
            if (kept < i) {
                list->contacts[kept] = list->contacts[i];
            }
            kept++;
        }
    }
    list->pool->used = kept;
}
