/* SPDX-License-Identifier: MIT */
/* The world's block: its size, and how it is carved. */
#include "world.h"

/* Room for events while a step runs: a hit of each pair, a cut of each body. */
#define EVENTS(bodies, pairs) ((size_t)(pairs) + (size_t)(bodies))

/* Sizes that CAROM_WORLD_BYTES promises: what each element takes ... */
#define OF_BODY    (sizeof(struct body) + 2 * sizeof(struct body_state) + sizeof(struct carom_event))
#define OF_PAIR    (3 * sizeof(struct pair) + sizeof(struct pair_work) + sizeof(struct carom_event))
#define OF_CONTACT (sizeof(struct contact) + 2 * sizeof(struct rest_warm))
_Static_assert(OF_BODY <= CAROM_BODY_BYTES, "CAROM_BODY_BYTES");
_Static_assert(OF_PAIR <= CAROM_PAIR_BYTES, "CAROM_PAIR_BYTES");
_Static_assert(OF_CONTACT <= CAROM_CONTACT_BYTES, "CAROM_CONTACT_BYTES");
_Static_assert(sizeof(struct carom_face_ref) <= CAROM_FACE_BYTES, "CAROM_FACE_BYTES");
_Static_assert(sizeof(struct zentry) <= CAROM_ENTRY_BYTES, "CAROM_ENTRY_BYTES");
_Static_assert(sizeof(struct candidate) <= CAROM_CANDIDATE_BYTES, "CAROM_CANDIDATE_BYTES");
_Static_assert(sizeof(struct body_extra) <= CAROM_EXTRA_BYTES, "CAROM_EXTRA_BYTES");
_Static_assert(sizeof(struct joint) + 2 * sizeof(struct joint_state) + sizeof(struct pair) +
                       JOINT_ROWS * sizeof(struct joint_row) + JOINT_ROOM * sizeof(int32_t) <=
                   CAROM_JOINT_BYTES,
               "CAROM_JOINT_BYTES");
_Static_assert(sizeof(struct carom_hit) <= CAROM_HIT_BYTES, "CAROM_HIT_BYTES");
_Static_assert(sizeof(struct contact_mixed) <= CAROM_MIXED_BYTES, "CAROM_MIXED_BYTES");
/* ... what arrays may lose by rounding up to 8 bytes, ... */
#define ROUNDING(type)                                                                             \
    (sizeof(type) % 8 == 0 ? 0 : sizeof(type) % 4 == 0 ? 4 : sizeof(type) % 2 == 0 ? 6 : 7)
#define ROUNDINGS                                                                                  \
    (ROUNDING(struct carom_world) + ROUNDING(struct contact_work) +                                \
     ROUNDING(struct contact_roll) + ROUNDING(struct body) + 3 * ROUNDING(struct pair) +           \
     ROUNDING(struct pair_work) + 2 * ROUNDING(struct body_state) +                                \
     2 * ROUNDING(struct rest_warm) + ROUNDING(struct carom_event) + ROUNDING(struct contact) +    \
     ROUNDING(struct carom_face_ref) + ROUNDING(struct zentry) + ROUNDING(struct candidate) +      \
     ROUNDING(struct body_extra))
/* ... less what a body, a pair and a contact leave of theirs: there is at least one of each. */
_Static_assert(sizeof(struct carom_world) + ROUNDINGS + OF_BODY + OF_PAIR + OF_CONTACT <=
                   CAROM_WORLD_FIXED_BYTES + CAROM_BODY_BYTES + CAROM_PAIR_BYTES +
                       CAROM_CONTACT_BYTES,
               "CAROM_WORLD_FIXED_BYTES");
/* one scratch, rounded up */
_Static_assert((sizeof(union world_scratch) + 7) / 8 * 8 <= CAROM_SCRATCH_BYTES,
               "CAROM_SCRATCH_BYTES");
_Static_assert(sizeof(struct contact_work) <= CAROM_WORK_BYTES, "CAROM_WORK_BYTES");
_Static_assert(sizeof(struct contact_roll) <= CAROM_ROLL_BYTES, "CAROM_ROLL_BYTES");
_Static_assert(ZLIST_CELLS_MAX * sizeof(uint16_t) <= CAROM_HEADS_BYTES, "CAROM_HEADS_BYTES");

/* -------------------------------------------------------------------- init */

static bool capacities_in_range(const struct carom_caps *caps)
{
/* 1 is added on both sides so that 0 may be the smallest */
#define IN_RANGE(name, bytes, low, high) (caps->name + 1 > (low) && caps->name <= (high)) &&
    return CAROM_POOLS(IN_RANGE) true;
#undef IN_RANGE
}

size_t carom_world_bytes(const struct carom_caps *caps)
{
    return !caps ? 0
                 : CAROM_WORLD_BYTES(caps->bodies, caps->pairs, caps->contacts, caps->faces,
                                     caps->entries, caps->candidates, caps->joints, caps->extras,
                                     caps->hits);
}

/*
 * Carve the events, and behind them the room that stages share. At the end of a step, when all
 * solves are done, more events go on into that room: beginnings and ends of touching; bodies that
 * wake, rest or are out. Between steps users of the scratch have a part of their own.
 */
static void carve_shared(struct carom_world *w, struct arena *arena)
{
    const struct carom_caps *caps = &w->config.caps;
    size_t works = caps->contacts * sizeof *w->rest.works;
    size_t solve = works + CAROM_LESS_(caps->pairs, caps->contacts) * sizeof *w->rest.rolls;
    size_t found = CAROM_FOUND_BYTES_(caps->bodies, caps->pairs, caps->joints);
    uint8_t *room;

    ARENA_CARVE(arena, w->events, EVENTS(caps->bodies, caps->pairs));
    ARENA_CARVE(arena, room, CAROM_MORE_(solve, found + sizeof *w->scratch));
    w->rest.works = (struct contact_work *)room;
    w->rest.rolls = (struct contact_roll *)(room + works);
    w->scratch = (union world_scratch *)(room + found);
}

/* Carve every array. The caller has checked that the block is large enough. */
static void carve(struct carom_world *w, struct arena *arena)
{
    const struct carom_caps *caps = &w->config.caps;

    carve_shared(w, arena);
    ARENA_CARVE(arena, w->bodies, caps->bodies);
    ARENA_CARVE(arena, w->pairs, caps->pairs);
    ARENA_CARVE(arena, w->meetings, caps->pairs);
    for (int i = 0; i < 2; i++) {
        struct world_state *s = &w->states[i];

        ARENA_CARVE(arena, s->bodies, caps->bodies);
        ARENA_CARVE(arena, s->warm, caps->contacts);
        ARENA_CARVE(arena, s->touching, caps->pairs);
    }
    ARENA_CARVE(arena, w->rest.list.contacts, caps->contacts);
    if (caps->entries + caps->extras >
        0) { /* needed by surfaces and bodies that the caller moves */
        ARENA_CARVE(arena, w->rest.list.drifts, caps->contacts);
    }
    if (caps->extras > 0) {
        ARENA_CARVE(arena, w->rest.list.mixed, caps->contacts);
    }
    ARENA_CARVE(arena, w->interfere.faces, caps->faces);
    ARENA_CARVE(arena, w->interfere.lists.entry, caps->entries);
    if (caps->entries > 0) {
        ARENA_CARVE(arena, w->interfere.lists.head, ZLIST_CELLS_MAX);
    }
    ARENA_CARVE(arena, w->interfere.candidates, caps->candidates);
    ARENA_CARVE(arena, w->hits, caps->hits);
    ARENA_CARVE(arena, w->extras, caps->extras);
    ARENA_CARVE(arena, w->rest.joints.joints, caps->joints);
    ARENA_CARVE(arena, w->rest.joints.rows, caps->joints * JOINT_ROWS);
    w->rest.joints.room_size = caps->joints * JOINT_ROOM;
    ARENA_CARVE(arena, w->rest.joints.room, caps->joints * JOINT_ROOM);
    ARENA_CARVE(arena, w->ignored, caps->joints);
    for (int i = 0; i < 2; i++) {
        ARENA_CARVE(arena, w->states[i].joints, caps->joints);
    }
}

int carom_world_init(void *mem, size_t bytes, const struct carom_config *config,
                     struct carom_world **world)
{
    struct arena arena;
    struct carom_world *w;

    if (!mem || !config || !world) {
        return CAROM_ERR_NULL;
    }
    if (!capacities_in_range(&config->caps) || (config->contact && config->caps.extras == 0)) {
        return CAROM_ERR_ARGUMENT;
    }
    if (!world_gravity_in_range(&config->gravity)) {
        return CAROM_ERR_RANGE;
    }
    if ((uintptr_t)mem % 8 != 0 || bytes < carom_world_bytes(&config->caps)) {
        return CAROM_ERR_MEMORY;
    }
    arena_init(&arena, mem, bytes);
    ARENA_CARVE(&arena, w, 1);
    w->config = *config;
    w->now = w->states;
#define SET_SIZE(name, item, low, high) w->pools[CAROM_POOL_##name].size = config->caps.name;
    CAROM_POOLS(SET_SIZE)
#undef SET_SIZE
    carve(w, &arena);
    w->rest.gauss = &w->scratch->gauss;
    w->rest.sweep_cap = config->sweep_cap;
    w->interfere.leaf = &w->scratch->gather.leaf;
    w->rest.list.pool = &w->pools[CAROM_POOL_contacts];
    w->interfere.face_pool = &w->pools[CAROM_POOL_faces];
    w->interfere.lists.pool = &w->pools[CAROM_POOL_entries];
    w->interfere.candidate_pool = &w->pools[CAROM_POOL_candidates];
    w->interfere.meetings = w->meetings;
    *world = w;
    return CAROM_OK;
}
