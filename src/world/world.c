/* SPDX-License-Identifier: MIT */
/* The world's block: sizes, carving, and adding, removing, reading and setting bodies. */
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

/* ------------------------------------------------------------------ bodies */

int world_set_mass(struct body *b, uint32_t mass_q20)
{
    int64_t mass_q32 = mass_q20 ? (int64_t)mass_q20 << 12 : b->def.mesh->mass.volume_q32;
    const int32_t *inverse = b->def.mesh->inverse.m;

    if (mass_q32 < (int64_t)1 << 22 || mass_q32 > (int64_t)1 << 42) {
        return mass_q20 ? CAROM_ERR_ARGUMENT : CAROM_ERR_RANGE;
    }
    if ((inverse[0] | inverse[1] | inverse[2]) == 0) { /* the diagonal holds the largest entry */
        return CAROM_ERR_RANGE;
    }
    body_set_mass(b, fix_scale(mass_q32, 32));
    return CAROM_OK;
}

/* Make a body and its state from its definition. */
static int make_body(struct body *b, struct body_state *s, const struct carom_body_def *def)
{
    int result = CAROM_OK;

    memset(b, 0, sizeof *b);
    memset(s, 0, sizeof *s);
    s->position = def->position;
    s->rotation = def->rotation;
    if (def->restitution_q30 < 0 || def->restitution_q30 > CAROM_ONE_Q30 ||
        def->friction_q16 > CAROM_MU_MAX_Q16 || !world_rotation_valid(&s->rotation) ||
        (!def->stationary && def->mesh->raw.kind != CAROM_SOLID) ||
        def->one_way > CAROM_ONE_WAY_MINUS_Z || def->overlap > CAROM_OVERLAP_PASS ||
        (def->stationary && def->kinematic)) {
        return CAROM_ERR_ARGUMENT;
    }
    if (!world_position_in_range(&def->position) ||
        (!def->stationary && (def->mesh->radius_q22 > BODY_RADIUS_MAX_Q22 ||
                              def->mesh->radius_q22 < BODY_RADIUS_MIN_Q22))) {
        return CAROM_ERR_RANGE;
    }
    b->def.mesh = def->mesh;
    b->def.user = def->user;
    b->def.moving = b->def.goes = !def->stationary && !def->kinematic;
    b->def.sensor = def->sensor;
    b->def.one_way = (uint8_t)def->one_way & 7u;
    world_filter(b, &def->filter);
    b->def.restitution_q30 = def->restitution_q30;
    b->def.friction_q16 = def->friction_q16;
    b->def.radius_q22 = def->mesh->radius_q22;
    if (def->kinematic && !world_drive_in_range(b, &def->velocity, &def->spin)) {
        return CAROM_ERR_RANGE;
    }
    if (b->def.moving) {
        b->def.unit_bits = (int8_t)fix_bits((uint64_t)b->def.radius_q22);
        b->def.skin_q22 = b->def.radius_q22 >> 11 > 256 ? b->def.radius_q22 >> 11 : 256;
        if (!world_motion_in_range(b, &def->velocity, &def->spin)) {
            return CAROM_ERR_RANGE;
        }
        result = world_set_mass(b, def->mass_q20);
        if (result < 0) {
            return result;
        }
        world_set_motion(b, s, &def->velocity, &def->spin);
    }
    return result;
}

/* The first place without a body; there is one. */
static uint32_t free_place(const struct carom_world *w)
{
    uint32_t place = 0;

    while (place < w->body_count && w->bodies[place].def.mesh) {
        place++;
    }
    return place;
}

/* Leave a place without a body. Its generation stays: old ids name no later body. */
static void clear_place(struct carom_world *w, uint32_t place)
{
    uint16_t generation = w->bodies[place].def.generation;

    memset(&w->bodies[place], 0, sizeof w->bodies[place]);
    w->bodies[place].def.generation = generation;
}

/*
 * Make a body in a free place, and find where it starts: `state`. After an error the place must be
 * cleared.
 */
static int make_at(struct carom_world *w, uint32_t place, struct body_state *state,
                   const struct carom_body_def *def)
{
    struct body *b = &w->bodies[place];
    uint16_t last = b->def.generation;
    int result = make_body(b, state, def);

    b->def.generation = last;
    if (result < 0) {
        return result;
    }
    if (def->kinematic && !world_may_have_extra(w)) {
        return CAROM_ERR_EXTRAS_FULL;
    }
    return world_settle(w, b, place, state, def->overlap);
}

/* The error of a body for which there is no place: its definition's own, if it has one. */
static FIX_OWN_FRAME int refuse(struct pool *pool, const struct carom_body_def *def)
{
    struct body made;
    struct body_state state;
    int result = make_body(&made, &state, def);

    if (result < 0) {
        return result;
    }
    (void)pool_take(pool); /* which counts it */
    return CAROM_ERR_BODIES_FULL;
}

int carom_body_add(struct carom_world *w, const struct carom_body_def *def)
{
    struct pool *pool;
    struct body_state state;
    struct body *b;
    uint32_t place;
    int result;

    if (!w || !def || !def->mesh) {
        return CAROM_ERR_NULL;
    }
    if (def->mesh->surface && w->config.caps.entries == 0) {
        return CAROM_ERR_NO_ENTRIES;
    }
    pool = &w->pools[CAROM_POOL_bodies];
    if (pool->used == pool->size) {
        return refuse(pool, def);
    }
    place = free_place(w);
    b = &w->bodies[place];
    result = make_at(w, place, &state, def);
    if (result < 0) {
        clear_place(w, place);
        return result;
    }
    (void)pool_take(pool);
    if (place == w->body_count) {
        w->body_count++;
    }
    b->def.generation = b->def.generation < UINT16_MAX ? (uint16_t)(b->def.generation + 1) : 1;
    world_put(w, place, &state);
    if (def->kinematic) {
        struct body_drive drive = world_drive_on(&def->velocity, &def->spin);

        world_extra(w, place)->kinematic = true;
        world_drive(w, place, &drive);
    }
    if (b->def.mesh->surface) {
        mesh_surface_halt(b->def.mesh->surface);
    }
    w->sensors = (uint16_t)(w->sensors + b->def.sensor);
    w->passing |= b->def.sensor || b->def.one_way != CAROM_BOTH_WAYS;
    if (def->overlap == CAROM_OVERLAP_PASS) {
        world_let_pass(w, place);
    }
    world_wake_around(w, place);
    return (int)place;
}

void world_put(struct carom_world *w, uint32_t body, const struct body_state *state)
{
    w->states[0].bodies[body] = w->states[1].bodies[body] = *state;
    body_not_standing(&w->bodies[body]);
    world_accelerate(w, body);
}

void world_forget_impulses(struct carom_world *w, uint32_t body)
{
    struct world_state *s = w->now;
    uint32_t kept = 0;

    for (uint32_t i = 0; i < s->warm_count; i++) {
        if (s->warm[i].a != body && s->warm[i].b != body) {
            s->warm[kept++] = s->warm[i];
        }
    }
    s->warm_count = kept;
}

int carom_body_remove(struct carom_world *w, int body)
{
    struct world_state *s;
    uint32_t kept = 0;

    if (!w) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    s = w->now;
    world_wake_around(w, (uint32_t)body);
    if (w->joint_steps) {
        w->joint_steps->forget_body(w, (uint16_t)body);
    }
    interfere_forget_lists(&w->interfere);
    world_drop_through(w, s, (uint32_t)body);
    w->sensors = (uint16_t)(w->sensors - w->bodies[body].def.sensor);
    world_drop_extra(w, (uint32_t)body);
    clear_place(w, (uint32_t)body);
    for (int i = 0; i < 2; i++) {
        memset(&w->states[i].bodies[body], 0, sizeof w->states[i].bodies[body]);
    }
    world_forget_impulses(w, (uint32_t)body);
    for (uint32_t i = 0; i < s->touching_count; i++) {
        if (s->touching[i].a != body && s->touching[i].b != body) {
            s->touching[kept++] = s->touching[i];
        }
    }
    s->touching_count = kept;
    w->pools[CAROM_POOL_bodies].used--;
    return CAROM_OK;
}

void world_motion(const struct body *b, const struct body_state *s, carom_v3_q40 *velocity,
                  carom_v3_q40 *spin)
{
    carom_m3_q30 r;

    if (world_is_kinematic(b) && b->def.extra->drive.kind == BODY_DRIVE_ON) {
        *velocity = b->def.extra->drive.velocity;
        *spin = b->def.extra->drive.spin;
        return;
    }
    fix_matrix(&r, &s->rotation);
    body_velocity(b, s, velocity);
    body_spin(b, s, &r, spin);
}

int carom_body_get(const struct carom_world *w, int body, struct carom_body_state *out)
{
    const struct body_state *s;

    if (!w || !out) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    s = &world_now(w)->bodies[body];
    out->position = s->position;
    out->rotation = s->rotation;
    world_motion(&w->bodies[body], s, &out->velocity, &out->spin);
    out->asleep = s->asleep;
    out->out = s->out;
    out->overlap = CAROM_OVERLAP_REFUSE;
    return CAROM_OK;
}

int carom_body_look(const struct carom_world *w, int body, struct carom_body_look *out)
{
    const struct body_state *s;

    if (!w || !out) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    s = &world_now(w)->bodies[body];
    out->mesh = w->bodies[body].def.mesh;
    out->position = s->position;
    out->rotation = s->rotation;
    out->moving = w->bodies[body].def.moving || world_is_kinematic(&w->bodies[body]);
    return CAROM_OK;
}

const struct carom_mesh *carom_body_mesh(const struct carom_world *w, int body)
{
    return w && world_find_body(w, &body) ? w->bodies[body].def.mesh : NULL;
}

int carom_body_count(const struct carom_world *w)
{
    return w ? (int)w->body_count : CAROM_ERR_NULL;
}

/* Lead a kinematic body that was set as its new state says. */
static void lead_on(struct carom_world *w, uint32_t body, const struct carom_body_state *in)
{
    if (world_is_kinematic(&w->bodies[body])) {
        struct body_drive drive = world_drive_on(&in->velocity, &in->spin);

        world_drive(w, body, &drive);
    }
}

int carom_body_set(struct carom_world *w, int body, const struct carom_body_state *in)
{
    struct body_state state;
    carom_quat_q30 q;
    int result;

    if (!w || !in) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    q = in->rotation;
    if (!world_rotation_valid(&q) || in->overlap > CAROM_OVERLAP_PASS) {
        return CAROM_ERR_ARGUMENT;
    }
    if (!world_position_in_range(&in->position) ||
        (w->bodies[body].def.moving &&
         !world_motion_in_range(&w->bodies[body], &in->velocity, &in->spin)) ||
        (world_is_kinematic(&w->bodies[body]) &&
         !world_drive_in_range(&w->bodies[body], &in->velocity, &in->spin))) {
        return CAROM_ERR_RANGE;
    }
    state = world_now(w)->bodies[body];
    if (!w->bodies[body].def.moving &&
        memcmp(&state.position, &in->position, sizeof state.position) == 0 &&
        memcmp(&state.rotation, &q, sizeof q) == 0) {
        lead_on(w, (uint32_t)body, in);
        return CAROM_OK; /* nothing moved: nothing wakes */
    }
    state.position = in->position;
    state.rotation = q;
    state.out = 0;
    if (w->bodies[body].def.moving) {
        world_set_motion(&w->bodies[body], &state, &in->velocity, &in->spin);
    }
    if (memcmp(&state.position, &world_now(w)->bodies[body].position, sizeof state.position) != 0 ||
        memcmp(&state.rotation, &world_now(w)->bodies[body].rotation, sizeof q) != 0 ||
        world_now(w)->bodies[body].out) {
        result = world_settle(w, &w->bodies[body], (uint32_t)body, &state, in->overlap);
        if (result < 0) {
            return result;
        }
    }
    world_put(w, (uint32_t)body, &state);
    lead_on(w, (uint32_t)body, in);
    if (in->overlap == CAROM_OVERLAP_PASS) {
        world_let_pass(w, (uint32_t)body);
    }
    world_wake_around(w, (uint32_t)body);
    return CAROM_OK;
}
