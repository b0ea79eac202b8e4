/* SPDX-License-Identifier: MIT */
/*
 * The candidate pool. It keeps the candidates of as many pairs as fit. The other pairs are gathered
 * anew each time they are searched, so a small pool costs time, not results.
 */
#include "narrow.h"

void interfere_number(struct interfere *w, uint32_t number)
{
    const struct pair_work *m = &w->meetings[number];

    /* all candidates of a pair carry one number: look at the first */
    if (m->count > 0 && w->candidates[m->first].pair != number) {
        for (uint32_t i = m->first; i < m->first + m->count; i++) {
            w->candidates[i].pair = (uint16_t)number;
        }
    }
}

/*
 * Number of candidates of the kept pair that begins at a place of the pool; 0 if none begins there.
 */
static uint32_t kept_at(const struct interfere *w, uint32_t place)
{
    uint16_t number = w->candidates[place].pair;
    const struct pair_work *m;

    if (number >= w->pair_count) {
        return 0;
    }
    m = &w->meetings[number];
    return m->kept && m->first == place ? m->count : 0;
}

/*
 * Move the kept pairs' candidates down over the gaps that dropped pairs left. A candidate in a gap
 * may carry any number, so kept pairs are renumbered first. The candidates of the pair at hand stay
 * last.
 */
static void close_gaps(struct interfere *w)
{
    struct pool *pool = w->candidate_pool;
    uint32_t kept = 0, own = pool->used - w->own_first, i = 0;

    for (uint32_t n = 0; n < w->pair_count; n++) {
        if (w->meetings[n].kept) {
            interfere_number(w, n);
        }
    }
    while (i < w->own_first) {
        uint32_t count = kept_at(w, i);

        if (count == 0) {
            i++;
            continue;
        }
        w->meetings[w->candidates[i].pair].first = (uint16_t)kept;
        memmove(&w->candidates[kept], &w->candidates[i], count * sizeof *w->candidates);
        kept += count;
        i += count;
    }
    memmove(&w->candidates[kept], &w->candidates[w->own_first], own * sizeof *w->candidates);
    w->own_first = kept;
    pool->used = kept + own;
}

/*
 * Make room for one more candidate: close gaps, else drop other pairs, else hand the visitor a
 * chunk of the pair at hand.
 */
static void make_room(struct interfere *w)
{
    struct pool *pool = w->candidate_pool;

    if (w->meetings && w->own_first > 0) {
        close_gaps(w);
        if (pool->size - pool->used < pool->size / INTERFERE_FREE_DIVISOR + 1) {
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
    if (!w->swapped) {
        w->candidates[pool_take(pool)] = (struct candidate){w->pair, kind, i, j};
    } else if (kind == CANDIDATE_EDGE_EDGE) {
        w->candidates[pool_take(pool)] = (struct candidate){w->pair, kind, j, i};
    } else {
        kind = kind == CANDIDATE_VERTEX_FACE ? CANDIDATE_FACE_VERTEX : CANDIDATE_VERTEX_FACE;
        w->candidates[pool_take(pool)] = (struct candidate){w->pair, kind, i, j};
    }
    w->candidate_count++;
    if (pool->used - w->own_first > w->span.most) {
        w->error = INTERFERE_TOO_MANY;
    }
}
