/* SPDX-License-Identifier: MIT */
/* The gathering part of a step: regions, and the pairs and candidates for them. */
#include "parts.h"

/*
 * A region ends when a body has gone this part of its radius: one in contact, one in flight, which a hit may
 * lead aside long before, or any while nothing is near.
 */
#define REGION_PARTS        10
#define REGION_PARTS_FLIGHT 20
#define REGION_PARTS_FREE   4
/* More candidates than these are too many for a region that lasts because nothing was near. */
#define REGION_ENOUGH 8
/* A hit leads a body that goes farther than this in a slice aside by more than any room. */
#define ROOM_WAY_SKINS 10

struct boyse_pair *step_set_pair(const struct carom_world *w, const struct candidate *c)
{
    const struct pair *p = &w->pairs[c->pair];
    struct boyse_pair *pair;

    world_begin_gather(w);
    pair = world_pair(w);
    boyse_pair_begin(pair, &w->bodies[p->a], &w->bodies[p->b]);
    boyse_pair_for(pair, c);
    return pair;
}

void step_select_pair(struct step_visitor *v, const struct candidate *c)
{
    if (v->pair_number != c->pair) {
        v->pair = step_set_pair(v->step->w, c);
        v->pair_number = c->pair;
    } else {
        boyse_pair_for(v->pair, c);
    }
}

int step_visit(struct step *s, struct step_visitor *v,
               void (*f)(struct candidate_visitor *, const struct candidate *, uint32_t))
{
    struct carom_world *w = s->w;
    int result;

    v->base.visit = f;
    v->step = s;
    v->pair_number = -1;
    v->found = false;
    v->error = CAROM_OK;
    world_begin_gather(w);
    result = interfere_visit(&w->interfere, w->bodies, w->pairs, w->pools[CAROM_POOL_pairs].used,
                             &v->base);
    return v->error ? v->error : result;
}

static void visit_nothing(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    (void)self;
    (void)c;
    (void)n;
}

/* Whether more than one body is going to move. */
static bool is_crowd(const struct step *s)
{
    uint32_t active = 0;

    for (uint32_t i = 0; i < s->w->body_count && active < 2; i++) {
        active += broad_active(&s->w->bodies[i], &s->next->bodies[i]);
    }
    return active > 1;
}

/*
 * Candidates are gathered for the paths at hand, and for what differs from them by no more than some
 * skins and a part of the way. In flight only a hit leads a body aside, and by more than that:
 * it asks for others in any case. So it is with a fast body in contact when the region ends with its
 * path. In a crowd any of them that is led aside costs a search for all.
 */
static int64_t room_for(const struct body *b, bool crowd, bool lasts)
{
    int64_t way_q22, turn_q30, skin_q22 = b->skin_q22;

    body_path_length(b, CAROM_ONE_Q30, &way_q22, &turn_q30);
    if (crowd) {
        return b->in_contact ? 10 * skin_q22 + way_q22 / 16 : 3 * skin_q22 + way_q22 / 64;
    }
    if (!lasts && way_q22 > ROOM_WAY_SKINS * skin_q22) {
        return skin_q22 / 4;
    }
    return b->in_contact ? 10 * skin_q22 + way_q22 / 32 : skin_q22 + way_q22 / 256;
}

static void set_regions(struct step *s, int32_t slice_q30, int64_t time_q30)
{
    bool crowd = is_crowd(s), lasts = time_q30 != slice_q30;

    for (uint32_t i = 0; i < s->w->body_count; i++) {
        struct body *b = &s->w->bodies[i];
        int64_t room_q22;

        if (!b->mesh || b->standing) {
            continue;
        }
        b->active = broad_active(b, &s->next->bodies[i]);
        room_q22 = b->active ? room_for(b, crowd, lasts) : 0;
        room_q22 += mesh_drift_most(b->mesh); /* contacts are looked for so much farther away */
        body_region_begin(b, &s->next->bodies[i], slice_q30, time_q30, (int32_t)room_q22);
    }
}

/* Pairs, interfering faces and candidates for the paths at hand, which take slice_q30 of a frame. */
static int gather(struct step *s, int32_t slice_q30, int64_t time_q30, uint32_t enough)
{
    struct carom_world *w = s->w;
    struct step_visitor v;
    int result;

    set_regions(s, slice_q30, time_q30);
    step_mark(w, CAROM_STAGE_PREDICT);
    result = broad_pairs(w->pairs, &w->pools[CAROM_POOL_pairs], w->bodies, s->next->bodies,
                         w->body_count);
    for (uint32_t i = 0; i < w->body_count; i++) {
        struct body *b = &w->bodies[i];

        b->standing = !broad_active(b, &s->next->bodies[i]);
    }
    step_mark(w, CAROM_STAGE_BROAD);
    if (result < 0) {
        return result;
    }
    if (w->interfere.gathers == 0) {
        pool_clear(&w->pools[CAROM_POOL_faces]);
    }
    interfere_begin(&w->interfere);
    w->interfere.enough = enough;
    result = step_visit(s, &v, visit_nothing);
    step_mark(w, CAROM_STAGE_INTERFERE);
    return result;
}

/*
 * For how long regions may last, for what is swept grows with the time: while no part of a body goes
 * farther than a part of its radius. Bodies that nothing is near to may go farther.
 */
static int64_t frames_allowed(const struct step *s, int32_t slice_q30)
{
    bool free = s->w->interfere.candidate_pool->used == 0;
    int64_t frames = BODY_REGION_FRAMES;

    for (uint32_t i = 0; i < s->w->body_count; i++) {
        const struct body *b = &s->w->bodies[i];
        int64_t way_q22, turn_q30, way_frame_q22, most_q22;

        if (!broad_active(b, &s->next->bodies[i])) {
            continue;
        }
        body_path_length(b, CAROM_ONE_Q30, &way_q22, &turn_q30);
        way_frame_q22 = (way_q22 << 30) / slice_q30 + 1;
        most_q22 = b->radius_q22 / (free            ? REGION_PARTS_FREE
                                    : b->in_contact ? REGION_PARTS
                                                    : REGION_PARTS_FLIGHT);
        frames = frames * way_frame_q22 > most_q22 ? most_q22 / way_frame_q22 : frames;
    }
    return frames > 1 ? frames : 1;
}

/* As long as the last regions held and no longer than allowed, twice that when they held to their end. */
static int64_t region_time(const struct step *s, int32_t slice_q30)
{
    int64_t frames = 1, allowed;

    if (slice_q30 < s->left_q30 || slice_q30 < STEP_SLICE_MIN_Q30 ||
        s->w->pools[CAROM_POOL_pairs].used == 0) {
        return slice_q30;
    }
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        const struct body_region *region = &s->w->bodies[i].region;

        if (s->w->bodies[i].active) {
            int64_t held = region->elapsed_q30 >> 30;
            bool to_end = region->time_q30 - region->elapsed_q30 < CAROM_ONE_Q30;

            frames = held << to_end > frames ? held << to_end : frames;
        }
    }
    allowed = frames_allowed(s, slice_q30);
    frames = frames < allowed ? frames : allowed;
    return s->left_q30 + ((frames - 1) << 30);
}

int step_gather(struct step *s)
{
    struct interfere *in = &s->w->interfere;
    uint32_t faces = in->gathers > 0 ? in->face_pool->used : 0;
    bool free = in->candidate_pool->used == 0;
    int32_t slice_q30 = step_slice(s);
    int64_t time_q30;
    int result;

    if (s->path_q30 != slice_q30) {
        step_predict_all(s, slice_q30);
    }
    time_q30 = region_time(s, slice_q30);
    if (time_q30 == slice_q30) {
        return gather(s, slice_q30, slice_q30, UINT32_MAX);
    }
    result = gather(s, slice_q30, time_q30, free ? REGION_ENOUGH : UINT32_MAX);
    if (result != CAROM_OK) {
        /* a single frame will have less, and an error is one only if it has it too */
        in->face_pool->used = faces;
        result = gather(s, slice_q30, slice_q30, UINT32_MAX);
    }
    return result;
}

int step_gather_slice(struct step *s, int32_t slice_q30)
{
    return gather(s, slice_q30, slice_q30, UINT32_MAX);
}

uint16_t step_pair_number(const struct carom_world *w, const struct pair *p)
{
    uint16_t n = 0;

    while (w->pairs[n].a != p->a || w->pairs[n].b != p->b) {
        n++;
        CAROM_ASSERT(n < w->pools[CAROM_POOL_pairs].used);
    }
    return n;
}

/* Whether a body may leave the region on its path. */
bool step_leaves_region(const struct step *s, int32_t slice_q30)
{
    for (uint32_t i = 0; i < s->w->body_count; i++) {
        const struct body *b = &s->w->bodies[i];

        if (b->active != broad_active(b, &s->next->bodies[i]) ||
            (b->active && !body_region_holds(b, slice_q30))) {
            return true;
        }
    }
    return false;
}

int step_gather_first(struct step *s)
{
    struct interfere *in = &s->w->interfere;

    /* where nothing is near, to gather anew costs less than to ask whether regions hold */
    if (!in->stale && in->whole && s->w->pools[CAROM_POOL_pairs].used > 0) {
        step_place_all(s);
        if (!step_leaves_region(s, 0)) {
            in->candidate_count = in->candidate_pool->used;
            return CAROM_OK;
        }
    }
    return step_gather(s);
}
