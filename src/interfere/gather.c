/* SPDX-License-Identifier: MIT */
/*
 * Gather the candidates of one pair, whole or in chunks, or of all pairs in turn; keep them for
 * later steps of the pair.
 */
#include "narrow.h"

/*
 * True if all of b, seen from any point that a can reach, fits q22. Only the largest meshes with
 * the fastest bodies do not.
 */
static bool in_range(const struct body *a, const struct body *b)
{
    return 2 * ((int64_t)a->def.radius_q22 + b->def.radius_q22 + a->search.reach_q22 +
                b->search.reach_q22) <
           INT32_MAX;
}

/*
 * Measure of how far `by`'s turn carries `other` around it: |u|^2 radius^2, radius in q12. The
 * factors are below 2^27 and 2^34.
 */
FIX_APART static int64_t carried_around(const struct interfere *w, const struct body *other,
                                        const struct body *by)
{
    int64_t radius = other->def.radius_q22 >> 10;
    int32_t u2_q30 = by->path.turns ? by->path.u2_q30 : 0;

    if (!w->by_paths) {
        u2_q30 = carom_mul_q30(by->search.region.u_q30, by->search.region.u_q30);
    }
    return u2_q30 * radius * radius;
}

/*
 * Choose which body's leaves are swept (a) and which body's cells are searched (b). In the axes of
 * a small spinning body a large one sweeps through everything, so then the small body's leaves are
 * swept. Between bodies of about one size the pair's order stays. interfere_emit swaps kinds and
 * features back.
 */
static void choose_asker(struct interfere *w)
{
    const struct body *a = w->a;
    int64_t from_a_q30 = w->span.from_a_q30;

    w->swapped = w->b->def.moving && a->def.radius_q22 / 5 > w->b->def.radius_q22 / 4 &&
                 carried_around(w, a, w->b) > carried_around(w, w->b, a);
    if (w->swapped) {
        w->a = w->b;
        w->b = a;
        w->span.from_a_q30 = w->span.from_b_q30;
        w->span.from_b_q30 = from_a_q30;
    }
}

/*
 * Bound on the angle between a direction as the mid-span mean carries it over and the true one at
 * any time of the span: half of what both bodies turn in the span, whatever the axes, plus the room
 * that their regions leave for turns.
 */
static int64_t off_the_middle_q30(const struct interfere *w)
{
    int64_t turn_q30 = w->leaf->angle_q30 / 2 + INTERFERE_CONE_NOISE_Q30;

    if (!w->by_paths) {
        turn_q30 += body_region_turn_off_q30(w->a);
        turn_q30 += body_region_turn_off_q30(w->b);
    }
    return turn_q30;
}

static void gather_pair(struct interfere *w, const struct interfere_pairs *all, uint32_t number)
{
    const struct pair *p = &all->pairs[number];
    const struct body *bodies = all->bodies;
    int64_t cone_q30;

    w->pair = (uint16_t)number;
    w->a = &bodies[p->a];
    w->b = &bodies[p->b];
    choose_asker(w);
    w->pooled = mesh_lists_in_step(w->b->def.mesh);
    if (!interfere_set_motion(w)) {
        return;
    }
    if (!in_range(w->a, w->b)) {
        w->error = CAROM_ERR_RANGE;
        return;
    }
    cone_q30 = INTERFERE_CONE_Q30 + off_the_middle_q30(w);
    w->leaf->cone_q30 = cone_q30 > CAROM_ONE_Q30 ? CAROM_ONE_Q30 : (int32_t)cone_q30;
    w->meet = interfere_features;
    interfere_leaves(w);
}

/*
 * gather_pair against each chunk of b's z-lists. The lists cover what any pair with b reaches, so
 * later pairs of the same step can use them.
 */
static void gather_over(struct interfere *w, const struct interfere_pairs *all, uint32_t number)
{
    const uint16_t b = all->pairs[number].b;
    const struct carom_mesh *mesh = all->bodies[b].def.mesh;
    const struct mesh_moving *does = mesh->surface->does;
    const struct interfere_area area = does->area_under(all->bodies, all->pairs, all->count, b);
    struct interfere_place place = {0, 0};
    bool last = false;

    while (!last && !w->error) {
        last = does->make_lists(w, mesh, &area, &place);
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
    if (mesh_lists_in_step(all->bodies[all->pairs[number].b].def.mesh)) {
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
    uint16_t old = span->more ? m->count : 0;

    CAROM_ASSERT(!span->more || (m->kept && m->first + old == pool->used));
    w->own_first = pool->used - old;
    m->kept = false;
    w->span = *span;
    w->by_paths = !keep;
    gather(w, all, number, visitor);
    m->first = (uint16_t)w->own_first;
    m->count = (uint16_t)(pool->used - w->own_first);
    m->kept = keep && w->whole && !w->error;
    m->found = m->count > 0 || !w->whole;
    if (w->error == INTERFERE_TOO_MANY && span->more && w->whole) {
        m->count = old;
        m->kept = true;
    }
    pool->used = w->own_first + (m->kept ? m->count : 0);
    if (w->error) {
        return w->error;
    }
    old = w->whole ? old : 0;
    visitor->visit(visitor, &w->candidates[m->first + old], (uint32_t)m->count - old);
    return CAROM_OK;
}

void interfere_visit_kept(struct interfere *w, uint32_t number, struct candidate_visitor *visitor)
{
    const struct pair_work *m = &w->meetings[number];

    interfere_number(w, number);
    visitor->visit(visitor, &w->candidates[m->first], m->count);
}

int interfere_visit(struct interfere *w, const struct body *bodies, const struct pair *pairs,
                    uint32_t pair_count, struct candidate_visitor *visitor)
{
    const struct interfere_pairs all = {bodies, pairs, pair_count};
    struct pair_work *meetings = w->meetings;

    w->meetings = NULL;
    w->span = (struct interfere_span){0, 0, INT64_MAX, UINT32_MAX, false};
    w->by_paths = false;
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
