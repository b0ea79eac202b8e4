/* SPDX-License-Identifier: MIT */
/*
 * The state hash and snapshots. Both use one description of the state, so the hash is of exactly
 * the bytes that a snapshot holds: little-endian on every machine, 64-bit FNV-1a.
 *
 *   u32 magic, gravity 3 x i64, u32 body places
 *   a place: u8 0 free, 1 stationary, 2 moving, 3 kinematic; then, if not free: position 3 x i64,
 *       momentum 3 x i64, angular momentum 3 x i64, force 3 x i64, rotation 4 x i32,
 *       u8 asleep, out, quiet, woken
 *   u32 count of kept impulses; each: u16 a, b, arm 3 x i32, normal 3 x i32, i64, tangent 3 x i64
 *   u32 count of touching pairs; each: u16 a, b
 *   u64 for each body that is a surface of carom_surface_build: FNV-1a of its vertices and of those
 *       of the last step, int16 x, y, z each; the caller puts the surface there before loading
 *   where each kinematic body is led: u8 0 nowhere, 1 on, 2 to a pose; 1: velocity 3 x i64,
 *       spin 3 x i64; 2: position 3 x i64, rotation 4 x i32
 *   if the world has had joints: u32 of their places; each: u8 0 free, 1 there; then, if there:
 *       u8 broken, limited, motor, spring, seven i64 of the drive, 6 x i64 impulses,
 *       push and moment 3 x i64 each, axial i64, owed i64 and u64
 *   sections that only some worlds have, each after a tag of four bytes:
 *   "FLT1", if a body has a filter of its own; each body: u16 category, mask, group
 *   "THR1", if pairs pass through each other: u32 count; each: u16 a, b
 *   "FOC1", if something acts on a body beside its force: u32 count of such bodies;
 *       each, by number: u16 body, torque 3 x i64, i32 gravity scale, linear and angular damping
 *   u64 FNV-1a of all bytes before
 */
#include "stream.h"

#define FILTERS      0x31544c46u /* "FLT1" */
#define THROUGH      0x31524854u /* "THR1" */
#define MAGIC        0x32534d43u /* "CMS2" */
#define FORCES_MAGIC 0x31434f46u /* "FOC1" */

static void stream_body(struct stream *s, const struct carom_world *w, uint32_t i,
                        struct body_state *state)
{
    const struct body *b = &w->bodies[i];
    carom_v3_q40 force = b->def.force;

    stream_expect(s, !b->def.mesh ? 0 : b->def.moving ? 2 : world_is_kinematic(b) ? 3 : 1, 1);
    if (b->def.mesh) {
        stream_vector64(s, state->position.c);
        stream_vector64(s, state->momentum.c);
        stream_vector64(s, state->angular.c);
        stream_vector64(s, force.c);
        if (s->loading) {
            PHASE_BEGIN(s->into[i].solve.work_phase, BODY_LOADED);
            body_loaded(&s->into[i])->forces =
                (struct carom_forces){.force = force, .gravity_scale_q16 = 1 << 16};
        }
        stream_vector32(s, state->rotation.c, 4);
        stream_8(s, &state->asleep);
        stream_8(s, &state->out);
        stream_8(s, &state->quiet);
        stream_8(s, &state->woken);
    }
}

static void stream_warm(struct stream *s, struct rest_warm *warm)
{
    struct rest_warm_parts parts = {0};

    if (!s->loading) {
        parts = rest_warm_parts(warm);
    }
    stream_16(s, &warm->a);
    stream_16(s, &warm->b);
    stream_vector32(s, warm->arm.c, 3);
    stream_vector32(s, warm->normal.c, 3);
    stream_64(s, &parts.normal_q40);
    stream_vector64(s, parts.tangent.c);
    if (s->loading && !rest_warm_join(warm, &parts)) {
        s->failed = true;
    }
}

FIX_APART static uint64_t hash_vertices(const int16_t (*v)[3], uint32_t count, uint64_t fnv)
{
    for (uint32_t i = 0; i < 3 * count; i++) {
        uint16_t c = (uint16_t)v[i / 3][i % 3];

        fnv = fnv_add(fnv_add(fnv, (uint8_t)c), (uint8_t)(c >> 8));
    }
    return fnv;
}

/* Pass a moving surface: the caller owns the vertices, so only their equality is checked. */
static void stream_surface(struct stream *s, const struct carom_mesh *mesh)
{
    const struct carom_surface *surface = mesh->surface;
    uint32_t n = mesh->raw.vertex_count;
    uint64_t fnv = hash_vertices((const int16_t(*)[3])surface->now, n, FNV_START);

    fnv = hash_vertices((const int16_t(*)[3])surface->before, n, fnv);
    if (stream_word(s, fnv, 8) != fnv) {
        s->failed = true;
    }
}

/* The next body from `i` on that needs more than its force stored, or the end of all. */
static uint32_t next_acted_on(const struct carom_world *w, uint32_t i)
{
    for (; i < w->body_count; i++) {
        struct carom_forces f = world_forces(&w->bodies[i]);

        if (w->bodies[i].def.mesh && world_forces_need_extra(&f)) {
            break;
        }
    }
    return i;
}

/* Pass everything that acts on a body beside its force. */
static void stream_forces(struct stream *s, const struct carom_world *w, uint32_t i)
{
    struct carom_forces f =
        s->loading ? body_loaded(&s->into[i])->forces : world_forces(&w->bodies[i]);

    stream_vector64(s, f.torque.c);
    stream_32(s, &f.gravity_scale_q16);
    stream_32(s, &f.linear_damping_q30);
    stream_32(s, &f.angular_damping_q30);
    if (s->loading) {
        body_loaded(&s->into[i])->forces = f;
        s->failed |= !world_forces_need_extra(&f);
    }
}

static void stream_all_forces(struct stream *s, const struct carom_world *w)
{
    uint32_t count = 0, next = 0;

    for (uint32_t i = s->loading ? w->body_count : next_acted_on(w, 0); i < w->body_count;
         i = next_acted_on(w, i + 1)) {
        count++;
    }
    if (!stream_section(s, FORCES_MAGIC, count > 0)) {
        return;
    }
    count = stream_count(s, count, w->body_count);
    s->failed |= count == 0;
    for (uint32_t n = 0; n < count && !s->failed; n++) {
        uint16_t body = (uint16_t)(s->loading ? 0 : next_acted_on(w, next));

        stream_16(s, &body);
        if (body < next || body >= w->body_count || !w->bodies[body].def.mesh) {
            s->failed = true;
            return;
        }
        stream_forces(s, w, body);
        next = body + 1u;
    }
}

static bool is_own(uint16_t category, uint16_t mask, int16_t group)
{
    return !(category == 1 && mask == 0xffff && group == 0);
}

static bool has_filter(const struct body *b)
{
    return b->def.mesh && is_own(b->def.category, b->def.mask, b->def.group);
}

/* Pass all filters. Those of a section are not all of the usual kind, and none is of zeros. */
static void stream_filters(struct stream *s, const struct carom_world *w)
{
    bool any = false, own = false;

    for (uint32_t i = 0; i < w->body_count; i++) {
        any = any || has_filter(&w->bodies[i]);
    }
    any = stream_section(s, FILTERS, any);
    for (uint32_t i = 0; i < w->body_count && !s->failed; i++) {
        const struct body *b = &w->bodies[i];
        uint16_t parts[3] = {b->def.category, b->def.mask, (uint16_t)b->def.group};

        if (!b->def.mesh) {
            continue;
        }
        if (s->loading) {
            parts[0] = 1;
            parts[1] = 0xffff;
            parts[2] = 0;
        }
        for (int k = 0; k < 3 && any; k++) {
            stream_16(s, &parts[k]);
        }
        if (s->loading) {
            int group = parts[2] < 0x8000 ? parts[2] : parts[2] - 0x10000;
            struct carom_filter *filter = &body_loaded(&s->into[i])->filter;

            *filter = (struct carom_filter){parts[0], parts[1], (int16_t)group};
            own = own || is_own(filter->category, filter->mask, filter->group);
            s->failed |= (parts[0] | parts[1] | parts[2]) == 0;
        }
    }
    s->failed |= s->loading && any && !own;
}

/* Give a body the filter and the forces that were read for it. */
static void take_loaded(struct carom_world *w, uint32_t i)
{
    struct body *b = &w->bodies[i];
    const struct body_loaded *loaded = body_loaded(b);

    b->def.category = loaded->filter.category;
    b->def.mask = loaded->filter.mask;
    b->def.group = loaded->filter.group;
    (void)world_set_forces(w, i, &loaded->forces);
}

static void stream_through(struct stream *s, const struct carom_world *w, struct world_state *state)
{
    struct pair *list;
    uint32_t count = state->through_count;

    if (s->loading) {
        state->through_count = 0;
    }
    if (stream_section(s, THROUGH, count > 0)) {
        state->through_count = stream_count(s, count, w->config.caps.pairs - state->touching_count);
        list = world_through(w, state);
        for (uint32_t i = 0; i < state->through_count && !s->failed; i++) {
            stream_16(s, &list[i].a);
            stream_16(s, &list[i].b);
        }
        s->failed = s->failed || state->through_count == 0;
    }
}

static void stream_drive(struct stream *s, struct body_drive *drive)
{
    stream_8(s, &drive->kind);
    if (drive->kind == BODY_DRIVE_ON) {
        stream_vector64(s, drive->velocity.c);
        stream_vector64(s, drive->spin.c);
    } else if (drive->kind == BODY_DRIVE_TO) {
        stream_vector64(s, drive->position.c);
        stream_vector32(s, drive->rotation.c, 4);
    }
}

/*
 * Pass the drives of kinematic bodies. When loading, bytes are skipped at first, checked once all
 * poses are known to be plausible, and taken once everything is.
 */
enum drives { DRIVES_PASS, DRIVES_ASK, DRIVES_TAKE };

static void stream_drives(struct stream *s, const struct carom_world *w,
                          const struct world_state *state, enum drives what)
{
    s->drives = s->at;
    for (uint32_t i = 0; i < w->body_count && !s->failed; i++) {
        const struct body *b = &w->bodies[i];
        struct body_drive drive = {.kind = BODY_DRIVE_NONE};

        if (!b->def.mesh || !world_is_kinematic(b)) {
            continue;
        }
        drive = s->loading ? drive : b->def.extra->drive;
        stream_drive(s, &drive);
        if (what == DRIVES_TAKE) {
            s->into[i].def.extra->drive = drive;
            s->into[i].def.goes = drive.kind != BODY_DRIVE_NONE;
        } else if (what == DRIVES_ASK) {
            s->failed |= !world_drive_plausible(b, &state->bodies[i], &drive);
        }
    }
}

static void stream_joint(struct stream *s, struct joint_state *state)
{
    struct carom_joint_drive *d = &state->drive;
    int64_t low = (int64_t)state->owed2.lo;

    stream_8(s, &state->broken);
    stream_flag(s, &d->limited);
    stream_flag(s, &d->motor);
    stream_flag(s, &d->spring);
    stream_64(s, &d->lower_q32);
    stream_64(s, &d->upper_q32);
    stream_64(s, &d->motor_speed_q40);
    stream_64(s, &d->motor_most_q40);
    stream_64(s, &d->rest_q32);
    stream_64(s, &d->stiffness_q40);
    stream_64(s, &d->damping_q40);
    for (int i = 0; i < JOINT_ROWS; i++) {
        stream_64(s, &state->impulse_q40[i]);
    }
    stream_vector64(s, state->push.c);
    stream_vector64(s, state->moment.c);
    stream_64(s, &state->axial_q40);
    stream_64(s, &state->owed2.hi);
    stream_64(s, &low);
    if (s->loading) {
        state->owed2.lo = (uint64_t)low;
    }
}

static void stream_joints(struct stream *s, const struct carom_world *w, struct world_state *state)
{
    const struct joint_list *list = &w->rest.joints;

    stream_expect(s, list->count, 4);
    for (uint32_t i = 0; i < list->count && !s->failed; i++) {
        stream_expect(s, list->joints[i].used, 1);
        if (list->joints[i].used) {
            stream_joint(s, &state->joints[i]);
            s->failed = s->failed || (s->loading && !w->joint_steps->plausible(&list->joints[i],
                                                                               &state->joints[i]));
        }
    }
}

/* Read the drives again. */
static bool drives_again(struct stream *s, const struct carom_world *w,
                         const struct world_state *state, enum drives what)
{
    s->at = s->drives;
    stream_drives(s, w, state, what);
    return !s->failed;
}

/* Pass the whole state, out of or into `state`. */
static void stream_state(struct stream *s, const struct carom_world *w, struct world_state *state)
{
    uint64_t check;

    s->fnv = FNV_START;
    stream_expect(s, MAGIC, 4);
    s->gravity = w->config.gravity;
    stream_vector64(s, s->gravity.c);
    stream_expect(s, w->body_count, 4);
    for (uint32_t i = 0; i < w->body_count && !s->failed; i++) {
        stream_body(s, w, i, &state->bodies[i]);
    }
    state->warm_count = stream_count(s, state->warm_count, w->config.caps.contacts);
    for (uint32_t i = 0; i < state->warm_count && !s->failed; i++) {
        stream_warm(s, &state->warm[i]);
    }
    state->touching_count = stream_count(s, state->touching_count, w->config.caps.pairs);
    for (uint32_t i = 0; i < state->touching_count && !s->failed; i++) {
        stream_16(s, &state->touching[i].a);
        stream_16(s, &state->touching[i].b);
    }
    for (uint32_t i = 0; i < w->body_count && !s->failed; i++) {
        if (w->bodies[i].def.mesh && w->bodies[i].def.mesh->surface) {
            stream_surface(s, w->bodies[i].def.mesh);
        }
    }
    stream_drives(s, w, state, DRIVES_PASS);
    if (w->rest.joints.calls && !s->failed) {
        stream_joints(s, w, state);
    }
    if (!s->failed) {
        stream_filters(s, w);
        stream_through(s, w, state);
        stream_all_forces(s, w);
    }
    check = s->fnv;
    if (stream_word(s, check, 8) != check) {
        s->failed = true;
    }
}

/* Pass the present state out; the world stays as it is. */
static void stream_now(struct stream *s, const struct carom_world *w)
{
    struct world_state now = *world_now(w);

    stream_state(s, w, &now);
}

uint64_t carom_world_hash(const struct carom_world *w)
{
    struct stream s;

    if (!w) {
        return 0;
    }
    memset(&s, 0, sizeof s);
    stream_now(&s, w);
    return s.fnv;
}

int carom_snapshot_size(const struct carom_world *w)
{
    struct stream s;

    if (!w) {
        return CAROM_ERR_NULL;
    }
    memset(&s, 0, sizeof s);
    stream_now(&s, w);
    return (int)s.at;
}

int carom_snapshot_save(const struct carom_world *w, void *out, size_t bytes)
{
    struct stream s;
    int size = carom_snapshot_size(w);

    if (size < 0 || !out) {
        return CAROM_ERR_NULL;
    }
    if (bytes < (size_t)size) {
        return CAROM_ERR_MEMORY;
    }
    memset(&s, 0, sizeof s);
    s.out = (uint8_t *)out;
    stream_now(&s, w);
    return size;
}

/* True if there are extras for all bodies that need one. */
static bool extras_suffice(struct carom_world *w)
{
    const struct pool *pool = &w->pools[CAROM_POOL_extras];
    uint32_t missing = 0;

    for (uint32_t i = 0; i < w->body_count; i++) {
        struct body *b = &w->bodies[i];

        missing += b->def.mesh && !b->def.extra && world_forces_need_extra(&body_loaded(b)->forces);
    }
    return missing <= pool->size - pool->used;
}

int carom_snapshot_load(struct carom_world *w, const void *in, size_t bytes)
{
    struct world_state *next;
    struct stream s;
    bool good, fits;

    if (!w || !in) {
        return CAROM_ERR_NULL;
    }
    /* build beside the current state, as a step does */
    next = world_next(w);
    memset(&s, 0, sizeof s);
    s.in = (const uint8_t *)in;
    s.size = bytes;
    s.loading = true;
    s.into = w->bodies;
    memset(next->bodies, 0, w->body_count * sizeof *next->bodies);
    stream_state(&s, w, next);
    good = !s.failed && s.at == bytes && world_plausible(w, next, &s.gravity) &&
           drives_again(&s, w, next, DRIVES_ASK);
    fits = !good || extras_suffice(w);
    good = good && fits;
    if (good) {
        w->now = next;
        w->config.gravity = s.gravity;
        w->passing |= next->through_count > 0;
        w->route_to = body_route_to;    /* a body may be led to a pose */
        w->sense_anew = w->sensors > 0; /* a sensor may have come after the last step */
        (void)drives_again(&s, w, next, DRIVES_TAKE);
    }
    /* a step relies on bodies that stand still being equal in both states */
    for (uint32_t i = 0; i < w->body_count; i++) {
        if (good && w->bodies[i].def.mesh) {
            take_loaded(w, i);
        }
        world_put(w, i, &world_now(w)->bodies[i]);
    }
    if (good && w->joint_steps) {
        w->joint_steps->regroup(w);
    }
    w->idle = false;
    w->regions_stale = true;
    return good ? CAROM_OK : fits ? CAROM_ERR_FORMAT : CAROM_ERR_EXTRAS_FULL;
}
