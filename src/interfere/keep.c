/* SPDX-License-Identifier: MIT */
/*
 * The candidate pool. It keeps the candidates of as many pairs as fit. The other pairs are gathered
 * anew each time they are searched, so a small pool costs time, not results.
 */
#include "narrow.h"

void interfere_number(struct interfere *in, uint32_t number)
{
    const struct pair_work *m = &in->meetings[number];

    /* all candidates of a pair carry one number: look at the first */
    if (m->count > 0 && in->candidates[m->first].pair != number) {
        for (uint32_t i = m->first; i < m->first + m->count; i++) {
            in->candidates[i].pair = (uint16_t)number;
        }
    }
}

/*
 * Number of candidates of the kept pair that begins at a place of the pool; 0 if none begins there.
 */
static uint32_t kept_at(const struct interfere *in, uint32_t place)
{
    uint16_t number = in->candidates[place].pair;
    const struct pair_work *m;

    if (number >= in->pair_count) {
        return 0;
    }
    m = &in->meetings[number];
    return m->kept && m->first == place ? m->count : 0;
}

/*
 * Move the kept pairs' candidates down over the gaps that dropped pairs left. A candidate in a gap
 * may carry any number, so kept pairs are renumbered first. The candidates of the pair at hand stay
 * last.
 */
static void close_gaps(struct interfere *in)
{
    struct pool *pool = in->candidate_pool;
    uint32_t kept = 0, own = pool->used - in->own_first, i = 0;

    for (uint32_t n = 0; n < in->pair_count; n++) {
        if (in->meetings[n].kept) {
            interfere_number(in, n);
        }
    }
    while (i < in->own_first) {
        uint32_t count = kept_at(in, i);

        if (count == 0) {
            i++;
            continue;
        }
        in->meetings[in->candidates[i].pair].first = (uint16_t)kept;
        memmove(&in->candidates[kept], &in->candidates[i], count * sizeof *in->candidates);
        kept += count;
        i += count;
    }
    memmove(&in->candidates[kept], &in->candidates[in->own_first], own * sizeof *in->candidates);
    in->own_first = kept;
    pool->used = kept + own;
}

/*
 * Make room for one more candidate: close gaps, else drop other pairs, else hand the visitor a
 * chunk of the pair at hand.
 */
static void make_room(struct interfere *in)
{
    struct pool *pool = in->candidate_pool;

    if (in->meetings && in->own_first > 0) {
        close_gaps(in);
        if (pool->size - pool->used < pool->size / INTERFERE_FREE_DIVISOR + 1) {
            for (uint32_t i = 0; i < in->pair_count; i++) {
                in->meetings[i].kept = false;
            }
            close_gaps(in);
        }
    }
    if (pool->used == pool->size) {
        in->visitor->visit(in->visitor, &in->candidates[in->own_first], pool->used - in->own_first);
        pool->refused++;
        in->whole = false;
        pool->used = in->own_first;
    }
}

void interfere_emit(struct interfere *in, uint8_t kind, uint32_t i, uint32_t j)
{
    struct pool *pool = in->candidate_pool;

    if (pool->used == pool->size) {
        make_room(in);
    }
    if (!in->swapped) {
        in->candidates[pool_take(pool)] = (struct candidate){in->pair, kind, i, j};
    } else if (kind == CANDIDATE_EDGE_EDGE) {
        in->candidates[pool_take(pool)] = (struct candidate){in->pair, kind, j, i};
    } else {
        kind = kind == CANDIDATE_VERTEX_FACE ? CANDIDATE_FACE_VERTEX : CANDIDATE_VERTEX_FACE;
        in->candidates[pool_take(pool)] = (struct candidate){in->pair, kind, i, j};
    }
    in->candidate_count++;
    if (pool->used - in->own_first > in->span.most) {
        in->error = INTERFERE_TOO_MANY;
    }
}
