/* SPDX-License-Identifier: MIT */
/*
 * The candidates of a pair: those that are kept, or those gathered for the present paths, for a
 * part of the window or for both regions. The number of gathered candidates changes the cost of a
 * step, never its outcome.
 */
#include "parts.h"

/* Shift from Q30 to the unit of a pair's `until`. */
#define UNTIL_SHIFT 24
/* Later than the end of every region. */
#define FOREVER_Q30 ((int64_t)(BODY_REGION_FRAMES + 1) << 30)

/* Time of a body's region that is spent at t_q30; *left_q30 becomes at most the rest of it. */
static int64_t used_q30(const struct step *s, uint32_t i, int32_t t_q30, int64_t *left_q30)
{
    const struct body *b = &s->w->bodies[i];
    int64_t used = 0;

    if (step_active(s, i)) {
        used = b->search.region.elapsed_q30 + (t_q30 - b->clock.from_q30);
        *left_q30 = b->search.region.until_q30 - used < *left_q30
                        ? b->search.region.until_q30 - used
                        : *left_q30;
    }
    return used;
}

/* Part of both regions' time that begins at from_q30 of the frame and takes time_q30. */
static FIX_OWN_FRAME struct interfere_span span_of(const struct step *s, const struct pair *p,
                                                   int32_t from_q30, int64_t time_q30)
{
    struct interfere_span span = {0, 0, time_q30, UINT32_MAX, false};

    span.from_a_q30 = used_q30(s, p->a, from_q30, &span.time_q30);
    span.from_b_q30 = used_q30(s, p->b, from_q30, &span.time_q30);
    return span;
}

static uint32_t face_pairs(const struct body *a, const struct body *b)
{
    return (uint32_t)a->def.mesh->raw.face_count * b->def.mesh->raw.face_count;
}

bool step_many_faces(const struct body *a, const struct body *b)
{
    return face_pairs(a, b) >= STEP_FACE_PAIRS_MANY;
}

bool step_goes_far(const struct step *s, const struct pair *p)
{
    const struct body *a = &s->w->bodies[p->a], *b = &s->w->bodies[p->b];
    int64_t way_q22 = (step_active(s, p->a) ? a->search.region.length_q22 : 0) +
                      (step_active(s, p->b) ? b->search.region.length_q22 : 0);

    if ((step_active(s, p->a) ? a->search.region.u_q30 : 0) +
                (step_active(s, p->b) ? b->search.region.u_q30 : 0) >
            STEP_TURN_KEPT_Q30 / 2 &&
        step_many_faces(a, b)) {
        return true;
    }
    return way_q22 > (b->def.goes && b->def.radius_q22 < a->def.radius_q22 ? b : a)->def.radius_q22;
}

/* True if a body's region lasts beyond the frame because nothing was near. */
static bool lasts(const struct step *s, uint32_t i)
{
    const struct body *b = &s->w->bodies[i];
    int64_t left_q30 = b->search.region.until_q30;

    if (!step_active(s, i) || b->search.state != BODY_REGION_FREE) {
        return false;
    }
    (void)used_q30(s, i, CAROM_ONE_Q30, &left_q30);
    return left_q30 > 0;
}

/* End such a region with the frame. */
static void shorten(struct step *s, uint32_t i)
{
    if (lasts(s, i)) {
        int64_t left_q30 = 0;

        s->w->bodies[i].search.region.until_q30 = used_q30(s, i, CAROM_ONE_Q30, &left_q30);
    }
}

int32_t step_part_of(const struct step_visitor *v, const struct boyse_hit *hit)
{
    int32_t part = (int32_t)(((int64_t)hit->root_q30 * v->parts) >> 30);

    return part < v->parts ? part : v->parts - 1;
}

/* Gather the candidates of a time of the frame; keep them with the pair's others if `keep`. */
static FIX_OWN_FRAME int gather_time(struct step *s, uint32_t number, struct step_visitor *v,
                                     int32_t from_q30, int64_t to_q30, uint32_t most, bool keep)
{
    struct carom_world *w = s->w;
    const struct interfere_pairs all = {w->bodies, w->pairs, w->pools[CAROM_POOL_pairs].used};
    struct interfere_span span = span_of(s, &w->pairs[number], from_q30, to_q30 - from_q30);

    span.most = most;
    span.more = w->meetings[number].kept;
    return interfere_visit_pair(&w->interfere, &all, number, &span, keep, &v->base);
}

static int gather_on(struct step *s, uint32_t number, struct step_visitor *v, int32_t from_q30,
                     int64_t to_q30, uint32_t most)
{
    return gather_time(s, number, v, from_q30, to_q30, most, true);
}

/*
 * Gather all parts of the window but the last, up to the first part that has a hit. Then *enough is
 * true: later parts do not matter before the hit is answered. *from_q30 becomes the time up to
 * which all candidates are kept; if the pool is too small, it stays.
 */
static int gather_parts(struct step *s, uint32_t number, struct step_visitor *v, int32_t *from_q30,
                        bool *enough)
{
    struct pair_work *m = &s->w->meetings[number];
    const int32_t start_q30 = *from_q30, time_q30 = v->to_q30 - start_q30;

    *enough = false;
    for (int32_t part = 1; part < v->parts; part++) {
        int32_t end_q30 = start_q30 + (int32_t)((int64_t)time_q30 * part / v->parts), result;
        uint32_t until = ((uint32_t)end_q30 >> UNTIL_SHIFT) + 1;

        end_q30 = (int32_t)(until << UNTIL_SHIFT);
        if (end_q30 <= *from_q30 || end_q30 >= v->to_q30) {
            continue;
        }
        result = gather_on(s, number, v, *from_q30, end_q30, UINT32_MAX);
        *enough = v->found && step_part_of(v, &v->hit) < part;
        if (result != CAROM_OK || *enough) {
            m->until = until & 63;
            return result;
        }
        *from_q30 = m->kept ? end_q30 : start_q30;
    }
    return CAROM_OK;
}

/* True if a body moves, and far in its region. */
static bool goes_on_far(const struct step *s, uint32_t i)
{
    const struct body *b = &s->w->bodies[i];

    return step_active(s, i) && b->search.region.length_q22 > b->def.radius_q22 / STEP_FAR_PARTS;
}

/*
 * True if a part of the window is likely to be enough. A pair that has hit or touched usually
 * separates, or hits slowly.
 */
static bool goes_by_parts(const struct step *s, uint32_t number)
{
    const struct pair *p = &s->w->pairs[number];

    return s->w->meetings[number].hits == 0 && !s->w->bodies[p->a].clock.touched &&
           !s->w->bodies[p->b].clock.touched;
}

/*
 * Gather for a pair of which one region lasts. That region ends with the frame if something is
 * near.
 */
static int gather_lasting(struct step *s, uint32_t number, struct step_visitor *v, int32_t from_q30)
{
    const struct pair *p = &s->w->pairs[number];
    struct pair_work *m = &s->w->meetings[number];
    int result = CAROM_OK;

    /*
     * Bodies that go far, in regions that last because nothing was near, are likely to have come
     * near. A gather costs much here: gather for the frame only.
     */
    if (face_pairs(&s->w->bodies[p->a], &s->w->bodies[p->b]) >= STEP_FACE_PAIRS_COSTLY &&
        (goes_on_far(s, p->a) || goes_on_far(s, p->b))) {
        result = gather_on(s, number, v, from_q30, CAROM_ONE_Q30, UINT32_MAX);
        from_q30 = CAROM_ONE_Q30;
    }
    if (result == CAROM_OK) {
        result = m->count > STEP_ENOUGH || v->found || (from_q30 == CAROM_ONE_Q30 && !m->kept)
                     ? INTERFERE_TOO_MANY
                     : gather_on(s, number, v, from_q30, FOREVER_Q30, STEP_ENOUGH);
    }
    if (result == INTERFERE_TOO_MANY) {
        shorten(s, p->a);
        shorten(s, p->b);
        result = from_q30 < CAROM_ONE_Q30
                     ? gather_on(s, number, v, from_q30, FOREVER_Q30, UINT32_MAX)
                     : CAROM_OK;
    }
    return result;
}

/* Gather for a pair whose candidates are kept, from a time to the end of both regions. */
static int gather_regions(struct step *s, uint32_t number, struct step_visitor *v, int32_t from_q30)
{
    const struct pair *p = &s->w->pairs[number];
    struct pair_work *m = &s->w->meetings[number];
    int result = CAROM_OK;
    bool enough = false;

    m->kept = false;
    m->count = m->until = 0;
    if (goes_by_parts(s, number)) {
        result = gather_parts(s, number, v, &from_q30, &enough);
    }
    if (result != CAROM_OK || enough) {
        return result;
    }
    return lasts(s, p->a) || lasts(s, p->b)
               ? gather_lasting(s, number, v, from_q30)
               : gather_on(s, number, v, from_q30, FOREVER_Q30, UINT32_MAX);
}

/* Visit a pair whose candidates are not kept. */
static int visit_anew(struct step *s, uint32_t number, struct step_visitor *v)
{
    const struct carom_world *w = s->w;
    const struct pair *p = &w->pairs[number];
    int32_t from_q30 = 0;

    s->w->meetings[number].clear = 0; /* the static check measured other candidates */
    if (step_goes_far(s, p)) {
        return gather_time(s, number, v, v->from_q30, v->to_q30, UINT32_MAX, false);
    }
    /* gather from the later start of both paths; the time before has been searched */
    for (int k = 0; k < 2; k++) {
        uint32_t i = k == 0 ? p->a : p->b;

        if (step_active(s, i) && w->bodies[i].clock.from_q30 > from_q30) {
            from_q30 = w->bodies[i].clock.from_q30;
        }
    }
    return gather_regions(s, number, v, from_q30);
}

void step_drop_part(struct pair_work *m, int32_t to_q30)
{
    if (m->until > 0 && to_q30 > (int32_t)m->until << UNTIL_SHIFT) {
        m->kept = false;
    }
}

int step_visit(struct step *s, uint32_t number, struct step_visitor *v,
               void (*f)(struct candidate_visitor *, const struct candidate *, uint32_t))
{
    int result;

    world_begin_gather(s->w);
    v->base.visit = f;
    v->step = s;
    v->number = number;
    v->found = false;
    v->error = CAROM_OK;
    step_drop_part(&s->w->meetings[number], v->to_q30);
    if (s->w->meetings[number].kept) {
        interfere_visit_kept(&s->w->interfere, number, &v->base);
        result = CAROM_OK;
    } else {
        result = visit_anew(s, number, v);
    }
    return v->error ? v->error : result;
}
