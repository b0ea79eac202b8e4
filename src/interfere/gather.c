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
FIX_APART static int64_t carried_around(const struct interfere *in, const struct body *other,
                                        const struct body *by)
{
    int64_t radius = other->def.radius_q22 >> 10;
    int32_t u2_q30 = by->path.turns ? by->path.u2_q30 : 0;

    if (!in->by_paths) {
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
static void choose_asker(struct interfere *in)
{
    const struct body *a = in->a;
    int64_t from_a_q30 = in->span.from_a_q30;

    in->swapped = in->b->def.moving && a->def.radius_q22 / 5 > in->b->def.radius_q22 / 4 &&
                  carried_around(in, a, in->b) > carried_around(in, in->b, a);
    if (in->swapped) {
        in->a = in->b;
        in->b = a;
        in->span.from_a_q30 = in->span.from_b_q30;
        in->span.from_b_q30 = from_a_q30;
    }
}

/*
 * Bound on the angle between a direction as the mid-span mean carries it over and the true one at
 * any time of the span: half of what both bodies turn in the span, whatever the axes, plus the room
 * that their regions leave for turns.
 */
static int64_t off_the_middle_q30(const struct interfere *in)
{
    int64_t turn_q30 = in->leaf->angle_q30 / 2 + INTERFERE_CONE_NOISE_Q30;

    if (!in->by_paths) {
        turn_q30 += body_region_turn_off_q30(in->a);
        turn_q30 += body_region_turn_off_q30(in->b);
    }
    return turn_q30;
}

static void gather_pair(struct interfere *in, const struct interfere_pairs *all, uint32_t number)
{
    const struct pair *p = &all->pairs[number];
    const struct body *bodies = all->bodies;
    int64_t cone_q30;

    in->pair = (uint16_t)number;
    in->a = &bodies[p->a];
    in->b = &bodies[p->b];
    choose_asker(in);
    in->pooled = mesh_lists_in_step(in->b->def.mesh);
    if (!interfere_set_motion(in)) {
        return;
    }
    if (!in_range(in->a, in->b)) {
        in->error = CAROM_ERR_RANGE;
        return;
    }
    cone_q30 = INTERFERE_CONE_Q30 + off_the_middle_q30(in);
    in->leaf->cone_q30 = cone_q30 > CAROM_ONE_Q30 ? CAROM_ONE_Q30 : (int32_t)cone_q30;
    in->meet = interfere_features;
    interfere_leaves(in);
}

/*
 * gather_pair against each chunk of b's z-lists. The lists cover what any pair with b reaches, so
 * later pairs of the same step can use them.
 */
static void gather_over(struct interfere *in, const struct interfere_pairs *all, uint32_t number)
{
    const uint16_t b = all->pairs[number].b;
    const struct carom_mesh *mesh = all->bodies[b].def.mesh;
    const struct mesh_moving *does = mesh->surface->does;
    const struct interfere_area area = does->area_under(all->bodies, all->pairs, all->count, b);
    struct interfere_place place = {0, 0};
    bool last = false;

    while (!last && !in->error) {
        last = does->make_lists(in, mesh, &area, &place);
        gather_pair(in, all, number);
    }
}

static void gather(struct interfere *in, const struct interfere_pairs *all, uint32_t number,
                   struct candidate_visitor *visitor)
{
    in->visitor = visitor;
    in->whole = true;
    in->error = CAROM_OK;
    in->pair_count = all->count;
    in->gathers++;
    if (mesh_lists_in_step(all->bodies[all->pairs[number].b].def.mesh)) {
        gather_over(in, all, number);
    } else {
        gather_pair(in, all, number);
    }
}

int interfere_visit_pair(struct interfere *in, const struct interfere_pairs *all, uint32_t number,
                         const struct interfere_span *span, bool keep,
                         struct candidate_visitor *visitor)
{
    struct pair_work *m = &in->meetings[number];
    struct pool *pool = in->candidate_pool;
    uint16_t old = span->more ? m->count : 0;

    CAROM_ASSERT(!span->more || (m->kept && m->first + old == pool->used));
    in->own_first = pool->used - old;
    m->kept = false;
    in->span = *span;
    in->by_paths = !keep;
    gather(in, all, number, visitor);
    m->first = (uint16_t)in->own_first;
    m->count = (uint16_t)(pool->used - in->own_first);
    m->kept = keep && in->whole && !in->error;
    m->found = m->count > 0; /* who hands over a chunk has a candidate more */
    if (in->error == INTERFERE_TOO_MANY && span->more && in->whole) {
        m->count = old;
        m->kept = true;
    }
    pool->used = in->own_first + (m->kept ? m->count : 0);
    if (in->error) {
        return in->error;
    }
    old = in->whole ? old : 0;
    visitor->visit(visitor, &in->candidates[m->first + old], (uint32_t)m->count - old);
    return CAROM_OK;
}

void interfere_visit_kept(struct interfere *in, uint32_t number, struct candidate_visitor *visitor)
{
    const struct pair_work *m = &in->meetings[number];

    interfere_number(in, number);
    visitor->visit(visitor, &in->candidates[m->first], m->count);
}

int interfere_visit(struct interfere *in, const struct body *bodies, const struct pair *pairs,
                    uint32_t pair_count, struct candidate_visitor *visitor)
{
    const struct interfere_pairs all = {bodies, pairs, pair_count};
    struct pair_work *meetings = in->meetings;

    in->meetings = NULL;
    in->span = (struct interfere_span){0, 0, INT64_MAX, UINT32_MAX, false};
    in->by_paths = false;
    in->error = CAROM_OK;
    for (uint32_t i = 0; i < pair_count && !in->error; i++) {
        pool_clear(in->candidate_pool);
        in->own_first = 0;
        gather(in, &all, i, visitor);
        if (!in->error) {
            visitor->visit(visitor, in->candidates, in->candidate_pool->used);
        }
    }
    in->meetings = meetings;
    return in->error;
}
