/* SPDX-License-Identifier: MIT */
/*
 * The state hash and snapshots. Both go through one description of the state, so that the hash is
 * of exactly the bytes that a snapshot holds: little-endian on every machine, 64-bit FNV-1a.
 *
 *   u32 magic, gravity 3 x i64, u32 body places
 *   a place: u8 0 free, 1 stationary, 2 moving; then, if not free: position 3 x i64, momentum
 *       3 x i64, angular momentum 3 x i64, force 3 x i64, rotation 4 x i32,
 *       u8 asleep, out, quiet, woken
 *   u32 count of kept impulses; each: u16 a, b, arm 3 x i32, normal 3 x i32, i64, tangent 3 x i64
 *   u32 count of touching pairs; each: u16 a, b
 *   u64 for each body that is a surface of carom_surface_build: FNV-1a of its vertices and of those of
 *       the last step, int16 x, y, z each; the caller has put the surface there before it is loaded
 *   u64 FNV-1a of all bytes before
 */
#include "../num/fnv.h"
#include "world.h"

#define MAGIC 0x32534d43u /* "CMS2" */

/* Bytes going out or coming in; `bytes` may be NULL when only their number or hash is wanted. */
struct stream {
    uint8_t *out;
    const uint8_t *in;
    size_t size, at;
    uint64_t fnv;
    carom_v3_q40 gravity; /* that was read */
    bool loading, failed;
};

/* One number of `bytes` bytes; returns what the stream holds there. */
static uint64_t word(struct stream *s, uint64_t v, int bytes)
{
    uint64_t read = 0;

    for (int i = 0; i < bytes; i++) {
        uint8_t b = (uint8_t)(v >> (8 * i));

        if (s->loading) {
            if (s->at >= s->size) {
                s->failed = true;
                return 0;
            }
            b = s->in[s->at];
        } else if (s->out) {
            s->out[s->at] = b;
        }
        read |= (uint64_t)b << (8 * i);
        s->fnv = fnv_add(s->fnv, b);
        s->at++;
    }
    return read;
}

/* Numbers change only when they are read: a world that is saved stays as it is. */
static void number64(struct stream *s, int64_t *v)
{
    uint64_t read = word(s, (uint64_t)*v, 8);

    if (s->loading) {
        *v = (int64_t)read;
    }
}

static void number32(struct stream *s, int32_t *v)
{
    uint32_t read = (uint32_t)word(s, (uint32_t)*v, 4);

    if (s->loading) {
        *v = (int32_t)read;
    }
}

static void number16(struct stream *s, uint16_t *v)
{
    uint16_t read = (uint16_t)word(s, *v, 2);

    if (s->loading) {
        *v = read;
    }
}

static void number8(struct stream *s, uint8_t *v)
{
    uint8_t read = (uint8_t)word(s, *v, 1);

    if (s->loading) {
        *v = read;
    }
}

/* A count or a constant that must be what it is here. */
static void expect(struct stream *s, uint32_t v, int bytes)
{
    if (word(s, v, bytes) != v) {
        s->failed = true;
    }
}

static void vector64(struct stream *s, int64_t v[3])
{
    for (int k = 0; k < 3; k++) {
        number64(s, &v[k]);
    }
}

static void vector32(struct stream *s, int32_t *v, int n)
{
    for (int k = 0; k < n; k++) {
        number32(s, &v[k]);
    }
}

static void stream_body(struct stream *s, const struct carom_world *w, uint32_t i,
                        struct body_state *state)
{
    struct body *b = &w->bodies[i];

    expect(s, b->mesh ? (b->moving ? 2 : 1) : 0, 1);
    if (b->mesh) {
        vector64(s, state->position.c);
        vector64(s, state->momentum.c);
        vector64(s, state->angular.c);
        vector64(s, s->loading ? world_force_read(w, i)->c : b->force.c);
        vector32(s, state->rotation.c, 4);
        number8(s, &state->asleep);
        number8(s, &state->out);
        number8(s, &state->quiet);
        number8(s, &state->woken);
    }
}

static void stream_warm(struct stream *s, struct rest_warm *w)
{
    struct rest_warm_parts parts = {0};

    if (!s->loading) {
        parts = rest_warm_parts(w);
    }
    number16(s, &w->a);
    number16(s, &w->b);
    vector32(s, w->arm.c, 3);
    vector32(s, w->normal.c, 3);
    number64(s, &parts.normal_q40);
    vector64(s, parts.tangent.c);
    if (s->loading && !rest_warm_join(w, &parts)) {
        s->failed = true;
    }
}

static uint32_t stream_count(struct stream *s, uint32_t count, uint32_t most)
{
    count = (uint32_t)word(s, count, 4);
    if (count > most) {
        s->failed = true;
        count = 0;
    }
    return count;
}

FIX_APART static uint64_t hash_vertices(const int16_t (*v)[3], uint32_t count, uint64_t fnv)
{
    for (uint32_t i = 0; i < 3 * count; i++) {
        uint16_t c = (uint16_t)v[i / 3][i % 3];

        fnv = fnv_add(fnv_add(fnv, (uint8_t)c), (uint8_t)(c >> 8));
    }
    return fnv;
}

/* Where a surface is that moves: the caller has its vertices, so only that they are the same. */
static void stream_surface(struct stream *s, const struct carom_mesh *mesh)
{
    const struct carom_surface *surface = mesh->surface;
    uint32_t n = mesh->raw.vertex_count;
    uint64_t fnv = hash_vertices((const int16_t(*)[3])surface->now, n, FNV_START);

    fnv = hash_vertices((const int16_t(*)[3])surface->before, n, fnv);
    if (word(s, fnv, 8) != fnv) {
        s->failed = true;
    }
}

/* The whole state, out of or into `state`. */
static void stream_state(struct stream *s, const struct carom_world *w, struct world_state *state)
{
    uint64_t check;

    s->fnv = FNV_START;
    expect(s, MAGIC, 4);
    s->gravity = w->config.gravity;
    vector64(s, s->gravity.c);
    expect(s, w->body_count, 4);
    for (uint32_t i = 0; i < w->body_count && !s->failed; i++) {
        stream_body(s, w, i, &state->bodies[i]);
    }
    state->warm_count = stream_count(s, state->warm_count, w->config.caps.contacts);
    for (uint32_t i = 0; i < state->warm_count && !s->failed; i++) {
        stream_warm(s, &state->warm[i]);
    }
    state->touching_count = stream_count(s, state->touching_count, w->config.caps.pairs);
    for (uint32_t i = 0; i < state->touching_count && !s->failed; i++) {
        number16(s, &state->touching[i].a);
        number16(s, &state->touching[i].b);
    }
    for (uint32_t i = 0; i < w->body_count && !s->failed; i++) {
        if (w->bodies[i].mesh && w->bodies[i].mesh->surface) {
            stream_surface(s, w->bodies[i].mesh);
        }
    }
    check = s->fnv;
    if (word(s, check, 8) != check) {
        s->failed = true;
    }
}

/* The present state, which stays as it is. */
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
    s.out = out;
    stream_now(&s, w);
    return size;
}

int carom_snapshot_load(struct carom_world *w, const void *in, size_t bytes)
{
    struct world_state *next;
    struct stream s;
    bool good;

    if (!w || !in) {
        return CAROM_ERR_NULL;
    }
    /* built beside the current state, like a step */
    next = world_next(w);
    memset(&s, 0, sizeof s);
    s.in = in;
    s.size = bytes;
    s.loading = true;
    memset(next->bodies, 0, w->body_count * sizeof *next->bodies);
    stream_state(&s, w, next);
    good = !s.failed && s.at == bytes && world_plausible(w, next, &s.gravity);
    if (good) {
        w->now = next;
        w->config.gravity = s.gravity;
    }
    /* a step relies on what stands still being the same in both states */
    for (uint32_t i = 0; i < w->body_count; i++) {
        if (good && w->bodies[i].mesh) {
            w->bodies[i].force = *world_force_read(w, i);
        }
        world_put(w, i, &world_now(w)->bodies[i]);
    }
    w->idle = false;
    w->interfere.stale = true;
    return good ? CAROM_OK : CAROM_ERR_FORMAT;
}
