/* SPDX-License-Identifier: MIT */
/* Clocks and paths: each body has a path over a part of the frame. */
#include "parts.h"

/*
 * Gravity that acts on the path of a body that goes on; a body in contact has taken the frame's
 * gravity already.
 */
static const carom_v3_q40 *pull_on(const struct body *b)
{
    return b->clock.contact != BODY_FLIES ? NULL : &b->def.acceleration;
}

/* Convert a time of the frame to one of a body's path. */
static int32_t path_time(const struct body *b, int32_t t_q30)
{
    int32_t slice_q30 = b->clock.to_q30 - b->clock.from_q30;

    if (t_q30 <= b->clock.from_q30) {
        return 0;
    }
    return t_q30 >= b->clock.to_q30 - STEP_END_Q30
               ? CAROM_ONE_Q30
               : (int32_t)(((int64_t)(t_q30 - b->clock.from_q30) << 30) / slice_q30);
}

/* Set the path of a body over its own clock. */
static void set_own_path(const struct step *s, uint32_t i)
{
    struct body *b = &s->w->bodies[i];

    if (b->clock.stands || b->clock.to_q30 == b->clock.from_q30) {
        body_place(b, &s->next->bodies[i]);
    } else if (!b->def.moving) {
        body_follow(b, &s->next->bodies[i]);
    } else {
        body_predict(b, &s->next->bodies[i], b->clock.to_q30 - b->clock.from_q30, pull_on(b));
    }
}

struct body_state step_state_at(const struct step *s, uint32_t i, int32_t t_q30)
{
    const struct body *b = &s->w->bodies[i];
    struct body_state state = s->next->bodies[i];

    if (step_active(s, i) && !b->clock.stands && t_q30 > b->clock.from_q30) {
        body_advance(b, &state, path_time(b, t_q30), b->clock.to_q30 - b->clock.from_q30,
                     pull_on(b));
    }
    return state;
}

void step_leave_path(struct step *s, uint32_t i, int32_t t_q30)
{
    struct body *b = &s->w->bodies[i];
    struct body_state *state = &s->next->bodies[i];

    CAROM_ASSERT(step_active(s, i));
    if (b->clock.placed) {
        step_look_away(s, i);
    }
    if (t_q30 > b->clock.from_q30) {
        if (b->path.turns && b->clock.contact == BODY_FLIES &&
            path_time(b, t_q30) < CAROM_ONE_Q30) {
            b->clock.strained = s->strained = true;
        }
        body_region_advance(b, t_q30 - b->clock.from_q30, b->clock.to_q30 - b->clock.from_q30);
        if (!b->clock.stands) {
            body_advance(b, state, path_time(b, t_q30), b->clock.to_q30 - b->clock.from_q30,
                         pull_on(b));
        }
    }
    b->clock.from_q30 = b->clock.to_q30 = t_q30;
}

void step_look_at(struct step *s, uint32_t i, int32_t t_q30)
{
    struct body *b = &s->w->bodies[i];

    if (step_active(s, i) && !b->clock.placed) {
        struct body_state state = step_state_at(s, i, t_q30);

        body_place(b, &state);
        b->clock.placed = true;
    }
}

void step_look_away(struct step *s, uint32_t i)
{
    s->w->bodies[i].clock.placed = false;
    set_own_path(s, i);
}

void step_look_ahead(struct step *s, uint32_t i, int32_t slice_q30)
{
    struct body *b = &s->w->bodies[i];
    int32_t from_q30 = path_time(b, s->now_q30), to_q30 = path_time(b, s->now_q30 + slice_q30);

    step_look_away(s, i);
    if (!b->clock.stands) {
        body_cut_path(b, &s->next->bodies[i], from_q30, to_q30);
    }
}

void step_look_back(struct step *s, uint32_t i)
{
    step_look_away(s, i);
    step_look_at(s, i, s->now_q30);
}

/* Cut a slice at the longest way that the path may take. */
static int32_t cut_by_way(const struct body *b, int32_t slice_q30)
{
    int64_t most_q22 = (int64_t)b->def.radius_q22 * BODY_SLICE_RADII, way_q22;
    const int64_t *v = b->path.v.c;

    if ((int64_t)fix_sum(v) >> 18 <= most_q22) {
        return slice_q30;
    }
    way_q22 = fix_length_bound(v) >> 18;
    return way_q22 <= most_q22 ? slice_q30 : (int32_t)(slice_q30 * most_q22 / (way_q22 + 1)) + 1;
}

/* Shorten a slice that would leave less than STEP_SLICE_MIN_Q30 of the frame. */
FIX_APART static int32_t avoid_sliver(int32_t slice_q30, int32_t left_q30)
{
    return left_q30 > slice_q30 && left_q30 - slice_q30 < STEP_SLICE_MIN_Q30 &&
                   slice_q30 > 2 * STEP_SLICE_MIN_Q30
               ? slice_q30 - STEP_SLICE_MIN_Q30
               : slice_q30;
}

/* Set the next slice of a route, or the place of a kinematic body that stopped. */
FIX_APART static int set_route(struct step *s, uint32_t i, int32_t left_q30)
{
    struct body *b = &s->w->bodies[i];
    int32_t slice_q30 = left_q30;

    if (!b->clock.stands && slice_q30 > CAROM_ONE_Q30 >> b->def.extra->route.slice_bits) {
        slice_q30 = CAROM_ONE_Q30 >> b->def.extra->route.slice_bits;
    }
    b->clock.to_q30 = s->now_q30 + slice_q30;
    set_own_path(s, i);
    return body_region_holds(b, slice_q30) ? CAROM_OK : step_set_region(s, i, slice_q30);
}

int step_set_path(struct step *s, uint32_t i)
{
    struct body *b = &s->w->bodies[i];
    int32_t left_q30 = CAROM_ONE_Q30 - s->now_q30, slice_q30 = left_q30, shorter_q30;

    CAROM_ASSERT(left_q30 > 0); /* no event comes at the end of the frame */
    b->clock.placed = false;
    b->clock.cuts = 0;
    b->clock.from_q30 = s->now_q30;
    b->clock.to_q30 = CAROM_ONE_Q30;
    if (!b->def.moving) {
        return set_route(s, i, left_q30);
    }
    /* at the start of a frame, bodies that nothing has changed yet are in range */
    if ((s->now_q30 > 0 || b->clock.contact != BODY_FLIES || b->def.joined != BODY_ALONE) &&
        step_retire(s, i)) {
        body_place(b, &s->next->bodies[i]);
        return CAROM_OK;
    }
    if (!b->clock.stands) {
        if (b->def.joined == BODY_ALONE) {
            slice_q30 = body_slice(b, &s->next->bodies[i], left_q30);
            shorter_q30 = slice_q30 >> (2 * b->clock.shorter);
        } else { /* bodies of a group have been shortened together */
            slice_q30 = shorter_q30 = step_slice(s, i, left_q30);
        }
        slice_q30 = shorter_q30 > STEP_SHORTEST_Q30 ? shorter_q30 : slice_q30;
        slice_q30 = avoid_sliver(slice_q30, left_q30);
        b->clock.to_q30 = s->now_q30 + slice_q30;
    }
    set_own_path(s, i);
    shorter_q30 = cut_by_way(b, slice_q30);
    if (shorter_q30 < slice_q30) {
        slice_q30 = avoid_sliver(shorter_q30, left_q30);
        b->clock.to_q30 = s->now_q30 + slice_q30;
        set_own_path(s, i);
    }
    return body_region_holds(b, slice_q30) ? CAROM_OK : step_set_region(s, i, slice_q30);
}

/* ------------------------------------------------------------------ windows */

bool step_window(const struct step *s, uint32_t number, int32_t *from_q30, int32_t *to_q30)
{
    const struct pair *p = &s->w->pairs[number];
    const uint32_t both[2] = {p->a, p->b};

    *from_q30 = 0;
    *to_q30 = CAROM_ONE_Q30;
    for (int k = 0; k < 2; k++) {
        const struct body *b = &s->w->bodies[both[k]];

        if (s->next->bodies[both[k]].out) {
            return false;
        }
        if (step_active(s, both[k])) {
            *from_q30 = b->clock.from_q30 > *from_q30 ? b->clock.from_q30 : *from_q30;
            *to_q30 = b->clock.to_q30 < *to_q30 ? b->clock.to_q30 : *to_q30;
        }
    }
    CAROM_ASSERT(step_active(s, p->a) || step_active(s, p->b));
    return *to_q30 > *from_q30;
}

/* True if the path of a body does not match the window. */
static bool has_own_window(const struct step *s, uint32_t i, int32_t from_q30, int32_t to_q30)
{
    const struct body *b = &s->w->bodies[i];

    return step_active(s, i) && !b->clock.stands &&
           (b->clock.from_q30 != from_q30 || b->clock.to_q30 != to_q30);
}

void step_open_window(struct step *s, uint32_t number, int32_t from_q30, int32_t to_q30)
{
    const uint32_t both[2] = {s->w->pairs[number].a, s->w->pairs[number].b};

    for (int k = 0; k < 2; k++) {
        struct body *b = &s->w->bodies[both[k]];

        if (has_own_window(s, both[k], from_q30, to_q30)) {
            body_cut_path(b, &s->next->bodies[both[k]], path_time(b, from_q30),
                          path_time(b, to_q30));
        }
    }
}

void step_close_window(struct step *s, uint32_t number, int32_t from_q30, int32_t to_q30)
{
    const uint32_t both[2] = {s->w->pairs[number].a, s->w->pairs[number].b};

    for (int k = 0; k < 2; k++) {
        if (has_own_window(s, both[k], from_q30, to_q30)) {
            set_own_path(s, both[k]);
        }
    }
}
