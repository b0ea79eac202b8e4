/* SPDX-License-Identifier: MIT */
/*
 * Bodies start apart. A body that is added or set where it crosses another one is refused, pushed
 * out, or passes. The question is exact: do faces cross, or is one body inside the other?
 */
#include "world.h"

/* Against gravity, and from the middle of a cube to its faces, edges and corners. */
#define WAYS 27

bool world_overlap(struct carom_world *w, struct interfere_placed a, struct interfere_placed b)
{
    struct interfere *in = &w->interfere;

    /* nearly all are far from each other */
    for (int k = 0; k < 3; k++) {
        if (carom_abs(a.state->position.c[k] - b.state->position.c[k]) >
            ((int64_t)a.body->def.radius_q22 + b.body->def.radius_q22) << 10) {
            return false;
        }
    }
    if (!broad_near(a.body, a.state, b.body, b.state, 0)) {
        return false;
    }
    world_begin_gather(w);
    return interfere_query(in, a, b, NULL, 0) != 0 || interfere_inside(a, b) ||
           interfere_inside(b, a);
}

/* Set the direction of a way out. Returns false if there is none of this number. */
static bool direction(const struct carom_world *w, int way, carom_v3_q30 *out)
{
    int64_t v[3];

    for (int k = 0, rest = way - 1; k < 3; k++, rest /= 3) {
        v[k] = way == 0 ? -w->config.gravity.c[k] : (rest % 3 - 1) * (int64_t)CAROM_ONE_Q30;
    }
    return fix_normalise(out, v);
}

/* Move a state by a length along a direction. Returns false if it leaves the range. */
static bool moved(const struct body_state *from, const carom_v3_q30 *way, int64_t length_q32,
                  struct body_state *to)
{
    *to = *from;
    for (int k = 0; k < 3; k++) {
        to->position.c[k] += fix_mul_q30(length_q32, way->c[k]);
    }
    return world_position_in_range(&to->position);
}

/* True if two bodies pass each other already, or their joint lets them ignore each other. */
static bool already_pass(const struct carom_world *w, uint32_t place, uint32_t other)
{
    const struct pair p = world_name_pair(w, place, other);

    return world_ignores(w, p.a, p.b) || world_goes_through(w, world_now(w), &p);
}

/* True if a body, in a state that may differ from its place's, crosses a body of the world. */
static bool crosses(struct carom_world *w, const struct body *b, uint32_t place,
                    const struct body_state *state, uint32_t other)
{
    const struct interfere_placed mine = {b, state};
    const struct interfere_placed theirs = {&w->bodies[other], &world_now(w)->bodies[other]};

    if (other == place || !theirs.body->def.mesh || theirs.state->out ||
        !(b->def.moving || theirs.body->def.moving) || !broad_may_touch(b, theirs.body)) {
        return false;
    }
    return !already_pass(w, place, other) && world_overlap(w, mine, theirs);
}

/* True if two bodies that cross come apart within some skins. */
static bool is_shallow(struct carom_world *w, const struct body *b, uint32_t place,
                       const struct body_state *state, uint32_t other)
{
    int32_t skin_q22 = fix_larger(b->def.skin_q22, w->bodies[other].def.skin_q22);
    struct body_state at;
    carom_v3_q30 to;

    for (int way = 0; way < WAYS; way++) {
        if (direction(w, way, &to) &&
            moved(state, &to, ((int64_t)WORLD_SHALLOW_SKINS * skin_q22) << 10, &at) &&
            !crosses(w, b, place, &at, other)) {
            return true;
        }
    }
    return false;
}

/* The first body of the world, from a number on, that a body crosses by more than that. */
static uint32_t next_crossed(struct carom_world *w, const struct body *b, uint32_t place,
                             const struct body_state *state, uint32_t from)
{
    while (from < w->body_count &&
           (!crosses(w, b, place, state, from) || is_shallow(w, b, place, state, from))) {
        from++;
    }
    return from;
}

/* True if a body crosses any other, by however little. */
static bool crosses_any(struct carom_world *w, const struct body *b, uint32_t place,
                        const struct body_state *state)
{
    for (uint32_t i = 0; i < w->body_count; i++) {
        if (crosses(w, b, place, state, i)) {
            return true;
        }
    }
    return false;
}

/*
 * The distance that a body must go along a way to be clear of all others; `most` if it is no less.
 */
static int64_t way_out_q32(struct carom_world *w, const struct body *b, uint32_t place,
                           const struct body_state *state, const carom_v3_q30 *way,
                           int64_t most_q32)
{
    int64_t inside_q32 = 0, skin_q32 = (int64_t)(b->def.skin_q22 > 0 ? b->def.skin_q22 : 256) << 10;
    int64_t out_q32 = WORLD_FIRST_SKINS * skin_q32;
    struct body_state at;

    while (out_q32 < most_q32 &&
           (!moved(state, way, out_q32, &at) || crosses_any(w, b, place, &at))) {
        inside_q32 = out_q32;
        out_q32 *= 2;
    }
    if (out_q32 >= most_q32) {
        out_q32 = most_q32;
        if (!moved(state, way, out_q32 - 1, &at) || crosses_any(w, b, place, &at)) {
            return most_q32;
        }
    }
    for (int i = 0; i < WORLD_HALVINGS; i++) {
        int64_t middle_q32 = (inside_q32 + out_q32) / 2;

        (void)moved(state, way, middle_q32, &at); /* in range: it lies between two that are */
        if (crosses_any(w, b, place, &at)) {
            inside_q32 = middle_q32;
        } else {
            out_q32 = middle_q32;
        }
    }
    return out_q32;
}

/* Move a state along the shortest way out. */
FIX_OWN_FRAME static int push_out(struct carom_world *w, const struct body *b, uint32_t place,
                                  struct body_state *state)
{
    const int64_t most_q32 = ((int64_t)WORLD_WAY_MAX << 32) + ((int64_t)b->def.radius_q22 << 11);
    int64_t best_q32 = most_q32;
    struct body_state best = *state;
    carom_v3_q30 to;

    for (int way = 0; way < WAYS; way++) {
        if (direction(w, way, &to)) {
            int64_t out_q32 = way_out_q32(w, b, place, state, &to, best_q32);

            if (out_q32 < best_q32) {
                (void)moved(state, &to, out_q32, &best); /* in range, as way_out_q32 has seen */
                best_q32 = out_q32;
            }
        }
    }
    *state = best;
    return best_q32 < most_q32 ? CAROM_OK : (int)CAROM_ERR_BLOCKED;
}

/* Check that there is room for all pairs that a body is to pass. */
static int room_to_pass(struct carom_world *w, const struct body *b, uint32_t place,
                        const struct body_state *state)
{
    const struct world_state *now = world_now(w);
    uint32_t room = w->config.caps.pairs - now->touching_count - now->through_count;

    for (uint32_t i = next_crossed(w, b, place, state, 0); i < w->body_count;
         i = next_crossed(w, b, place, state, i + 1)) {
        if (room-- == 0) {
            return CAROM_ERR_PAIRS_FULL;
        }
    }
    return CAROM_OK;
}

int world_settle(struct carom_world *w, const struct body *b, uint32_t place,
                 struct body_state *state, int overlap)
{
    if (b->def.sensor || next_crossed(w, b, place, state, 0) == w->body_count) {
        return CAROM_OK;
    }
    switch (overlap) {
    case CAROM_OVERLAP_PASS:
        return room_to_pass(w, b, place, state);
    case CAROM_OVERLAP_PUSH_OUT:
        return push_out(w, b, place, state);
    default:
        return CAROM_ERR_OVERLAP;
    }
}

void world_let_pass(struct carom_world *w, uint32_t body)
{
    const struct body *b = &w->bodies[body];
    const struct body_state *state = &world_now(w)->bodies[body];

    for (uint32_t i = next_crossed(w, b, body, state, 0); i < w->body_count;
         i = next_crossed(w, b, body, state, i + 1)) {
        const struct pair p = world_name_pair(w, body, i);

        w->passing = true;
        (void)world_note_through(w, w->now, &p);
    }
}
