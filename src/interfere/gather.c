/* SPDX-License-Identifier: MIT */
/*
 * Gathering by pair, and the pool of candidates. The pool keeps the candidates of as many pairs as fit;
 * those of the others are gathered anew whenever somebody asks for them. So a short pool costs time.
 */
#include "narrow.h"

/* Give up other pairs' candidates when less than this part of the pool would be free. */
#define LEAST_FREE_PART 8

/* ---------------------------------------------------------------- the pool */

/*
 * Close the gaps that pairs left which were gathered anew, or which are kept no longer. What the pair
 * at hand has so far stays behind all others.
 */
static void close_gaps(struct interfere *w)
{
    struct pool *pool = w->candidate_pool;
    uint32_t kept = 0, own = pool->used - w->own_first, i = 0;

    while (i < w->own_first) {
        struct pair_work *m = &w->meetings[w->candidates[i].pair];
        uint32_t count = m->kept && m->first == i ? m->count : 0;

        if (count == 0) {
            i++;
            continue;
        }
        memmove(&w->candidates[kept], &w->candidates[i], count * sizeof *w->candidates);
        m->first = kept;
        kept += count;
        i += count;
    }
    memmove(&w->candidates[kept], &w->candidates[w->own_first], own * sizeof *w->candidates);
    w->own_first = kept;
    pool->used = kept + own;
}

/* Make room for one candidate more: by the gaps, by giving up other pairs, by handing over a chunk. */
static void make_room(struct interfere *w)
{
    struct pool *pool = w->candidate_pool;

    if (w->meetings && w->own_first > 0) {
        close_gaps(w);
        if (pool->size - pool->used < pool->size / LEAST_FREE_PART + 1) {
            for (uint32_t i = 0; i < w->pair_count; i++) {
                w->meetings[i].kept = false;
            }
            close_gaps(w);
        }
    }
    if (pool->used == pool->size) {
        w->visitor->visit(w->visitor, &w->candidates[w->own_first], pool->used - w->own_first);
        pool->refused++;
        w->whole = false;
        pool->used = w->own_first;
    }
}

void interfere_emit(struct interfere *w, uint8_t kind, uint32_t i, uint32_t j)
{
    struct pool *pool = w->candidate_pool;

    if (pool->used == pool->size) {
        make_room(w);
    }
    w->candidates[pool_take(pool)] = (struct candidate){w->pair, kind, i, j};
    w->candidate_count++;
}

/* ------------------------------------------------------------------- a pair */

/*
 * Whether all of b, seen from any point that a may reach, fits q22: only the largest meshes with
 * the fastest bodies do not.
 */
static bool in_range(const struct body *a, const struct body *b)
{
    return 2 * ((int64_t)a->radius_q22 + b->radius_q22 + a->reach_q22 + b->reach_q22) < INT32_MAX;
}

static void gather_pair(struct interfere *w, const struct interfere_pairs *all, uint32_t number)
{
    const struct pair *p = &all->pairs[number];
    const struct body *bodies = all->bodies;
    int64_t cone_q30 = (int64_t)INTERFERE_CONE_Q30 + bodies[p->a].turn_q30 + bodies[p->b].turn_q30;

    w->pair = (uint16_t)number;
    w->a = &bodies[p->a];
    w->b = &bodies[p->b];
    w->pooled = interfere_makes_lists(w->b->mesh);
    if (!interfere_set_motion(w)) {
        return;
    }
    if (!in_range(w->a, w->b)) {
        w->error = CAROM_ERR_RANGE;
        return;
    }
    w->leaf->cone_q30 = cone_q30 > CAROM_ONE_Q30 ? CAROM_ONE_Q30 : (int32_t)cone_q30;
    w->meet = interfere_features;
    interfere_leaves(w);
}

/* The same against each chunk of b's lists, which cover what any pair with b reaches. */
static void gather_over(struct interfere *w, const struct interfere_pairs *all, uint32_t number)
{
    const uint16_t b = all->pairs[number].b;
    const struct interfere_area area = interfere_area_under(all->bodies, all->pairs, all->count, b);
    struct interfere_place place = {0, 0};
    bool last = false;

    while (!last && !w->error) {
        last = interfere_make_lists(w, all->bodies[b].mesh, &area, &place);
        gather_pair(w, all, number);
    }
}

static void gather(struct interfere *w, const struct interfere_pairs *all, uint32_t number,
                   struct candidate_visitor *visitor)
{
    w->visitor = visitor;
    w->whole = true;
    w->error = CAROM_OK;
    w->pair_count = all->count;
    w->gathers++;
    if (interfere_makes_lists(all->bodies[all->pairs[number].b].mesh)) {
        gather_over(w, all, number);
    } else {
        gather_pair(w, all, number);
    }
}

int interfere_visit_pair(struct interfere *w, const struct interfere_pairs *all, uint32_t number,
                         const struct interfere_span *span, bool keep,
                         struct candidate_visitor *visitor)
{
    struct pair_work *m = &w->meetings[number];
    struct pool *pool = w->candidate_pool;

    if (!m->kept) {
        w->own_first = pool->used;
        w->span = *span;
        gather(w, all, number, visitor);
        m->first = w->own_first;
        m->count = pool->used - w->own_first;
        m->kept = keep && w->whole && !w->error;
        if (!m->kept) {
            pool->used = w->own_first;
        }
        if (w->error) {
            return w->error;
        }
    }
    visitor->visit(visitor, &w->candidates[m->first], m->count);
    return CAROM_OK;
}

int interfere_visit(struct interfere *w, const struct body *bodies, const struct pair *pairs,
                    uint32_t pair_count, struct candidate_visitor *visitor)
{
    const struct interfere_pairs all = {bodies, pairs, pair_count};
    struct pair_work *meetings = w->meetings;

    w->meetings = NULL;
    w->span = (struct interfere_span){0, 0, INT64_MAX};
    w->error = CAROM_OK;
    for (uint32_t i = 0; i < pair_count && !w->error; i++) {
        pool_clear(w->candidate_pool);
        w->own_first = 0;
        gather(w, &all, i, visitor);
        if (!w->error) {
            visitor->visit(visitor, w->candidates, w->candidate_pool->used);
        }
    }
    w->meetings = meetings;
    return w->error;
}
