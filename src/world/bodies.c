/* SPDX-License-Identifier: MIT */
/* Bodies come and go, are placed and are asked where they are. */
#include "world.h"

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
    const bool odd = def->stationary ? def->kinematic : def->mesh->raw.kind != CAROM_SOLID;
    int result = CAROM_OK;

    memset(b, 0, sizeof *b);
    memset(s, 0, sizeof *s);
    s->position = def->position;
    s->rotation = def->rotation;
    if (def->restitution_q30 < 0 || def->restitution_q30 > CAROM_ONE_Q30 ||
        def->friction_q16 > CAROM_MU_MAX_Q16 || !world_rotation_valid(&s->rotation) || odd ||
        def->one_way > CAROM_ONE_WAY_MINUS_Z || def->overlap > CAROM_OVERLAP_PASS) {
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

/*
 * Drop the contacts of a body that is removed: they name it, and their points are those of its path.
 */
static void drop_contacts(struct carom_world *w, uint32_t body)
{
    struct contact_list *list = &w->rest.list;
    uint32_t kept = 0;

    for (uint32_t i = 0; i < list->pool->used; i++) {
        const struct pair *p = &w->pairs[list->contacts[i].key.pair];

        if (p->a != body && p->b != body) {
            list->contacts[kept++] = list->contacts[i];
        }
    }
    list->pool->used = kept;
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
    drop_contacts(w, (uint32_t)body);
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
