/* SPDX-License-Identifier: MIT */
/*
 * Regions of bodies, and the pairs whose regions meet. A new region renews the search of its own
 * body's pairs only. This file changes what a frame costs, never what it computes.
 */
#include "parts.h"

/* ------------------------------------------------------------------ numbers */

/*
 * Change the pair indices of contacts from a place on. Candidates get their pair's index when they
 * are visited.
 */
FIX_APART static void renumber(struct carom_world *w, uint32_t place, int by)
{
    struct contact_list *list = &w->rest.list;

    for (uint32_t i = 0; i < list->pool->used; i++) {
        struct candidate *key = &list->contacts[i].key;

        key->pair = (uint16_t)(key->pair >= place ? key->pair + by : key->pair);
    }
}

uint32_t step_find_pair(const struct carom_world *w, const struct pair *p)
{
    uint32_t place;

    return broad_find(w->pairs, w->pools[CAROM_POOL_pairs].used, p->a, p->b, &place) ? place
                                                                                     : UINT32_MAX;
}

/* Record of a new pair. */
static struct pair_work new_meeting(const struct carom_world *w, const struct pair *p)
{
    return (struct pair_work){.hit_q30 = PAIRS_NEVER,
                              .passes = w->passing && world_goes_through(w, world_now(w), p),
                              .senses = w->bodies[p->a].def.sensor || w->bodies[p->b].def.sensor,
                              .answered_q30 = -1};
}

static int insert_pair(struct carom_world *w, uint32_t place, uint32_t a, uint32_t b)
{
    struct pool *pool = &w->pools[CAROM_POOL_pairs];
    uint32_t behind = pool->used - place;

    if (pool_take(pool) < 0) {
        return CAROM_ERR_PAIRS_FULL;
    }
    memmove(&w->pairs[place + 1], &w->pairs[place], behind * sizeof *w->pairs);
    memmove(&w->meetings[place + 1], &w->meetings[place], behind * sizeof *w->meetings);
    w->pairs[place] = (struct pair){(uint16_t)a, (uint16_t)b};
    w->meetings[place] = new_meeting(w, &w->pairs[place]);
    renumber(w, place, 1);
    return CAROM_OK;
}

static void remove_pair(struct carom_world *w, uint32_t place)
{
    struct pool *pool = &w->pools[CAROM_POOL_pairs];
    struct contact_list *list = &w->rest.list;

    contact_drop_pair(list, (uint16_t)place);
    w->meetings[place].kept = false;
    pool->used--;
    memmove(&w->pairs[place], &w->pairs[place + 1], (pool->used - place) * sizeof *w->pairs);
    memmove(&w->meetings[place], &w->meetings[place + 1],
            (pool->used - place) * sizeof *w->meetings);
    /* its candidates stay in the pool as garbage */
    renumber(w, place + 1, -1);
}

/* True if two bodies are near each other; at least one of them has a new region. */
static bool are_near(const struct step *s, uint32_t a, uint32_t b)
{
    struct body *bodies = s->w->bodies;

    return broad_is_pair(bodies, s->next->bodies, a, b) &&
           broad_boxes_meet(&bodies[a], &bodies[b]) && !world_ignores(s->w, a, b);
}

/*
 * Find the pairs of a body whose region is new. Their candidates are gathered when they are needed.
 * A pair that has hit in this frame stays, since its count of hits must not depend on regions; so
 * does one that passes.
 */
static int set_pairs(struct step *s, uint32_t i)
{
    struct carom_world *w = s->w;
    int result = CAROM_OK;

    s->pairs_changed = true;
    for (uint32_t n = w->pools[CAROM_POOL_pairs].used; n-- > 0;) {
        const struct pair *p = &w->pairs[n];

        if (p->a == i || p->b == i) {
            w->meetings[n].kept = false;
            if (w->meetings[n].hits == 0 && !w->meetings[n].passes && !are_near(s, p->a, p->b)) {
                remove_pair(w, n);
            }
        }
    }
    for (uint32_t k = 0; k < w->body_count && result == CAROM_OK; k++) {
        if (k != i && !broad_apart(&w->bodies[i], &w->bodies[k]) && w->bodies[k].def.mesh) {
            bool first = w->bodies[i].def.moving && (!w->bodies[k].def.moving || i > k);
            uint32_t a = first ? i : k, b = first ? k : i, place;

            if (!broad_find(w->pairs, w->pools[CAROM_POOL_pairs].used, a, b, &place) &&
                are_near(s, a, b)) {
                result = insert_pair(w, place, a, b);
            }
        }
    }
    return result;
}

/* True if a body has no candidates, as far as they were gathered. */
static bool is_free(const struct carom_world *w, uint32_t i)
{
    for (uint32_t n = 0; n < w->pools[CAROM_POOL_pairs].used; n++) {
        if ((w->pairs[n].a == i || w->pairs[n].b == i) && w->meetings[n].found) {
            return false;
        }
    }
    return true;
}

/* ------------------------------------------------------------------ regions */

/*
 * The distance by which a body may leave the path of its region: some skins and a part of the way.
 * In flight only a hit changes the path, and after a hit we gather anyway. The same holds for a
 * fast body in contact if its region ends with its path.
 */
static int64_t room_for(const struct step *s, const struct body *b, bool lasts)
{
    int64_t way_q22, turn_q30, skin_q22 = b->def.skin_q22;
    bool contact = b->clock.contact != BODY_FLIES || b->clock.touched;

    body_path_length(b, CAROM_ONE_Q30, &way_q22, &turn_q30);
    if (s->active > 1) {
        return contact ? 10 * skin_q22 + way_q22 / 16 : 3 * skin_q22 + way_q22 / 64;
    }
    if (!lasts && way_q22 > STEP_ROOM_WAY_SKINS * skin_q22) {
        return skin_q22 / 4;
    }
    return contact ? 10 * skin_q22 + way_q22 / 32 : skin_q22 + way_q22 / 256;
}

/*
 * The longest time of a region, which is limited because the swept volume grows with the time. No
 * part of the body goes farther than a part of its radius. The region lasts as long as the last one
 * held, or twice as long if that one held to its end.
 */
static int64_t region_time(const struct step *s, const struct body *b, int32_t slice_q30, bool free)
{
    /* a path that is cut again may begin before the last event */
    int32_t left_q30 = CAROM_ONE_Q30 - b->clock.from_q30;
    const int64_t *g = b->path.g.c;
    int64_t way_q22, turn_q30, most_q22, held = 1;
    int64_t frames = (g[0] | g[1] | g[2]) == 0 ? BODY_REGION_FRAMES : STEP_BENT_FRAMES;

    /* with nothing near, a new region costs less than to test the old one */
    if (!b->def.moving || slice_q30 < left_q30 || slice_q30 < STEP_GONE_ON_MIN_Q30 || s->single ||
        s->w->pools[CAROM_POOL_pairs].used == 0) {
        return slice_q30;
    }
    if (body_region_moves(b)) {
        bool to_end = b->search.region.until_q30 - b->search.region.elapsed_q30 < CAROM_ONE_Q30;

        held = (b->search.region.elapsed_q30 >> 30) << to_end;
    }
    body_path_length(b, CAROM_ONE_Q30, &way_q22, &turn_q30);
    way_q22 = (way_q22 << 30) / slice_q30 + 1;
    most_q22 = b->def.radius_q22 / (free ? STEP_REGION_PARTS_FREE
                                    : b->clock.contact != BODY_FLIES || b->clock.touched
                                        ? STEP_REGION_PARTS
                                        : STEP_REGION_PARTS_FLIGHT);
    frames = frames * way_q22 > most_q22 ? most_q22 / way_q22 : frames;
    frames = frames > held ? held : frames;
    return left_q30 + ((frames > 1 ? frames - 1 : 0) << 30);
}

static void begin_region(struct step *s, uint32_t i, int32_t slice_q30, bool free)
{
    struct body *b = &s->w->bodies[i];
    int64_t time_q30 = region_time(s, b, slice_q30, free);
    int64_t room_q22 = room_for(s, b, time_q30 != slice_q30);

    CAROM_ASSERT(time_q30 >= slice_q30); /* or candidates of the path's end would be missed */
    b->search.state = free ? BODY_REGION_FREE : BODY_REGION_MOVING;
    room_q22 = room_q22 < b->def.radius_q22 / STEP_ROOM_PARTS ? room_q22
                                                              : b->def.radius_q22 / STEP_ROOM_PARTS;
    room_q22 += mesh_drift_most(b->def.mesh); /* contacts are searched that much farther away */
    body_region_begin(b, &s->next->bodies[i], slice_q30, time_q30, (int32_t)room_q22);
    broad_set_box(b);
}

/* A standing body: its path, region and box are those of where it is. */
static void begin_standing(struct step *s, uint32_t i)
{
    struct body *b = &s->w->bodies[i];

    b->search.state = BODY_REGION_STANDING;
    body_place(b, &s->next->bodies[i]);
    body_region_begin(b, &s->next->bodies[i], CAROM_ONE_Q30, CAROM_ONE_Q30,
                      mesh_drift_most(b->def.mesh));
    broad_set_box(b);
}

int step_set_region(struct step *s, uint32_t i, int32_t slice_q30)
{
    begin_region(s, i, slice_q30, is_free(s->w, i));
    return set_pairs(s, i);
}

/* Set the path that a body would take from the start of a frame; return its slice. */
static int32_t foresee(struct step *s, uint32_t i)
{
    struct body *b = &s->w->bodies[i];
    int32_t slice_q30;

    if (!b->def.moving) {
        body_follow(b, &s->next->bodies[i]);
        return b->clock.to_q30;
    }
    slice_q30 = step_slice(s, i, CAROM_ONE_Q30 - s->now_q30);

    body_predict(b, &s->next->bodies[i], slice_q30, b->clock.touched ? NULL : &b->def.acceleration);
    return slice_q30;
}

/* Give a body that was woken a region where it is. */
static int adopt(struct step *s, uint32_t i)
{
    struct body *b = &s->w->bodies[i];
    int result;

    if (b->def.moving) {
        b->clock.from_q30 = b->clock.to_q30 = s->now_q30;
    }
    result = step_set_region(s, i, foresee(s, i));
    body_place(b, &s->next->bodies[i]);
    return result;
}

int step_adopt_woken(struct step *s)
{
    int result = CAROM_OK;

    for (uint32_t i = 0; i < s->w->body_count && result == CAROM_OK; i++) {
        if (s->w->bodies[i].clock.woke && s->w->bodies[i].search.state == BODY_REGION_STANDING) {
            result = adopt(s, i);
        }
    }
    return result;
}

/* Drop the pairs whose joints let them ignore each other. */
static void drop_ignored(struct carom_world *w)
{
    struct pool *pool = &w->pools[CAROM_POOL_pairs];
    uint32_t kept = 0;

    for (uint32_t n = 0; n < pool->used; n++) {
        if (!world_ignores(w, w->pairs[n].a, w->pairs[n].b)) {
            w->pairs[kept++] = w->pairs[n];
        }
    }
    pool->used = kept;
}

/* Set all regions and find all pairs. */
static int begin_all(struct step *s)
{
    struct carom_world *w = s->w;
    int result;

    for (uint32_t i = 0; i < w->body_count; i++) {
        if (step_active(s, i)) {
            begin_region(s, i, foresee(s, i), false);
            body_place(&w->bodies[i], &s->next->bodies[i]);
        } else if (w->bodies[i].def.mesh && w->bodies[i].search.state != BODY_REGION_STANDING) {
            begin_standing(s, i);
        }
    }
    pool_clear(&w->pools[CAROM_POOL_candidates]);
    result = broad_pairs(w->pairs, &w->pools[CAROM_POOL_pairs], w->bodies, s->next->bodies,
                         w->body_count);
    drop_ignored(w);
    for (uint32_t n = 0; n < w->pools[CAROM_POOL_pairs].used; n++) {
        w->meetings[n] = new_meeting(w, &w->pairs[n]);
    }
    w->regions_stale = false;
    s->pairs_changed = true;
    return result;
}

/* Set the region of a body that woke, fell asleep or stopped. */
static int begin_one(struct step *s, uint32_t i)
{
    struct body *b = &s->w->bodies[i];

    if (!step_active(s, i)) {
        if (b->search.state == BODY_REGION_STANDING) {
            return CAROM_OK;
        }
        begin_standing(s, i);
        return set_pairs(s, i);
    }
    if (body_region_moves(b) && b->def.moving) { /* its path stayed within its region */
        if (s->w->pools[CAROM_POOL_pairs].used > 0) {
            body_place(b, &s->next->bodies[i]);
            CAROM_ASSERT(body_region_holds(b, 0));
        }
        return CAROM_OK;
    }
    return adopt(s, i);
}

/* Mark the pairs that pass through each other since an earlier frame. */
static void mark_passes(struct carom_world *w)
{
    const struct world_state *now = world_now(w);

    for (uint32_t i = 0; i < now->through_count; i++) {
        uint32_t number = step_find_pair(w, &world_through(w, now)[i]);

        if (number != UINT32_MAX) {
            w->meetings[number].passes = true;
        }
    }
}

int step_begin_regions(struct step *s)
{
    struct carom_world *w = s->w;
    int result = CAROM_OK;

    if (w->regions_stale) { /* always at the second try, after an error */
        result = begin_all(s);
    } else {
        for (uint32_t n = 0; n < w->pools[CAROM_POOL_pairs].used; n++) {
            w->meetings[n].hit_q30 = PAIRS_NEVER;
            w->meetings[n].answered_q30 = -1;
            w->meetings[n].hits = w->meetings[n].clear = 0;
            w->meetings[n].passes = false;
            w->meetings[n].kept = w->meetings[n].kept && w->meetings[n].until == 0;
        }
        if (w->passing) {
            mark_passes(w);
        }
        for (uint32_t i = 0; i < w->body_count && result == CAROM_OK; i++) {
            result = w->bodies[i].def.mesh ? begin_one(s, i) : CAROM_OK;
        }
    }
    step_mark(w, CAROM_STAGE_BROAD);
    return result;
}
