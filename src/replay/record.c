/* SPDX-License-Identifier: MIT */
/* Recording: write each call and its result as it is made. */
#include "../num/fnv.h"
#include "record.h"

/* ------------------------------------------------------------------ what is written */

static void put(struct carom_record *r, const void *bytes, size_t count)
{
    if (count > 0) { /* no bytes may have no address, which memcpy in a writer must not see */
        r->sum = replay_sum(r->sum, (const uint8_t *)bytes, count);
        r->write(r->user, bytes, count);
    }
}

static void put_fixed(struct carom_record *r, uint64_t value, int bytes)
{
    uint8_t out[8];
    struct replay_coder c = {.out = out, .size = sizeof out};

    replay_fixed(&c, value, bytes);
    put(r, out, c.at);
}

static void put_number(struct carom_record *r, int64_t value)
{
    uint8_t out[10];
    struct replay_coder c = {.out = out, .size = sizeof out};

    replay_number(&c, value, INT64_MIN, INT64_MAX);
    put(r, out, c.at);
}

/* Write the run of calls that came in the same order as before. */
static void put_run(struct carom_record *r)
{
    if (r->run > 0) {
        put_fixed(r, REPLAY_TOKEN_RUN + r->run - 1, 1);
        r->run = 0;
    }
}

void record_token(struct carom_record *r, uint8_t token)
{
    put_run(r);
    put_fixed(r, token, 1);
}

/* Record body numbers, not ids: ids depend on what happened before the recording began. An id that names no body becomes `none`. */
static int numbered(const struct carom_record *r, int body, int none)
{
    return world_find_body(r->world, &body) ? body : none;
}

static void put_numbers(const struct carom_record *r, struct replay_call *call)
{
    if (call->op == CAROM_CALL_joint_add) {
        struct carom_joint_def *def = &call->u.joint;

        def->a = numbered(r, def->a, CAROM_WORLD - 1);
        def->b = def->b == CAROM_WORLD ? def->b : numbered(r, def->b, CAROM_WORLD - 1);
    } else if (replay_is_of_body(call->op)) {
        call->body = numbered(r, call->body, -1);
    }
}

static void put_call(struct carom_record *r, const struct replay_call *call)
{
    uint8_t bytes[REPLAY_CALL_BYTES] = {call->op};
    struct replay_coder c = {.out = bytes, .at = 1, .size = sizeof bytes};
    struct replay_call copy = *call;
    uint32_t slot;

    replay_code(&c, &copy);
    slot = replay_find(&r->memory, bytes, c.at);
    if (slot != UINT32_MAX && slot == r->memory.slots[r->memory.last].next) {
        r->memory.last = (uint8_t)slot;
        if (++r->run == REPLAY_RUN_MAX) {
            put_run(r);
        }
    } else if (slot != UINT32_MAX) {
        record_token(r, (uint8_t)(REPLAY_TOKEN_SLOT + slot));
        replay_follow(&r->memory, slot);
    } else {
        put_run(r);
        put(r, bytes, c.at);
        if (!replay_has_data(call->op)) {
            replay_keep(&r->memory, bytes, c.at);
        }
    }
}

static void put_check(struct carom_record *r)
{
    uint64_t digests[CAROM_REPLAY_PARTS];

    record_token(r, REPLAY_TOKEN_CHECK);
    if (r->stages) {
        carom_replay_digests(r->world, digests);
        for (int part = 0; part < CAROM_REPLAY_STATE; part++) {
            put_fixed(r, digests[part], 2);
        }
    }
    r->frames++;
    put_fixed(r, carom_world_hash(r->world), r->frames % REPLAY_FULL_EVERY == 0 ? 8 : 2);
}

/* ------------------------------------------------------------------------ calls */

bool record_is_open(const struct carom_record *r, const struct carom_world *world)
{
    return r && r->write && world && r->world == world;
}

void record_call(struct carom_record *r, const struct replay_call *call)
{
    struct replay_call copy = *call;

    put_numbers(r, &copy);
    put_call(r, &copy);
    if (call->op == CAROM_CALL_world_step) {
        put_run(r);
    }
}

void record_made(struct carom_record *r, const struct replay_call *call, int result)
{
    put_call(r, call);
    record_result(r, call->op, result);
}

void record_result(struct carom_record *r, uint8_t op, int result)
{
    result = replay_result(op, result);
    if (result != CAROM_OK) {
        record_token(r, REPLAY_TOKEN_RESULT);
        put_number(r, result);
    }
    if (op == CAROM_CALL_world_step) {
        put_check(r);
    }
}

/* ----------------------------------------------------------------------- data */

void record_vertices(struct carom_record *r, const int16_t (*vertices)[3], uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            put_fixed(r, (uint16_t)vertices[i][k], 2);
        }
    }
}

void record_bytes(struct carom_record *r, const void *bytes, uint32_t count)
{
    put(r, bytes, count);
}

void record_material(struct carom_record *r, const struct carom_material *material)
{
    uint8_t out[REPLAY_CALL_BYTES];
    struct replay_coder c = {.out = out, .size = sizeof out};
    struct carom_material copy = *material;

    replay_material(&c, &copy);
    put(r, out, c.at);
}

static uint64_t hash_mesh(const struct carom_mesh_raw *raw)
{
    const int64_t head = (int64_t)raw->vertex_count << 40 ^ (int64_t)raw->face_count << 16 ^
                         raw->quantum_bits << 8 ^ raw->kind;
    uint64_t hash = (uint64_t)head * 0x9e3779b97f4a7c15u;

    for (uint32_t i = 0; i < 3 * raw->vertex_count; i++) {
        hash = (hash ^ (uint16_t)raw->vertices[i / 3][i % 3]) * 0x100000001b3u;
        hash ^= hash >> 29;
    }
    for (uint32_t i = 0; i < 3 * raw->face_count; i++) {
        hash = (hash ^ raw->faces[i / 3][i % 3]) * 0x100000001b3u;
        hash ^= hash >> 29;
    }
    return hash | 1; /* 0 means no mesh */
}

uint32_t record_mesh(struct carom_record *r, const struct carom_mesh *mesh)
{
    const struct carom_mesh_raw *raw = &mesh->raw;
    const uint64_t hash = mesh->surface ? 0 : hash_mesh(raw);
    uint32_t at = r->mesh_count % CAROM_REPLAY_MESHES;

    for (uint32_t i = 0; hash != 0 && i < CAROM_REPLAY_MESHES; i++) {
        if (r->meshes[i] == hash) {
            return i;
        }
    }
    r->meshes[at] = hash;
    r->mesh_count++;
    record_token(r, REPLAY_TOKEN_MESH);
    put_fixed(r, mesh->surface != NULL, 1);
    put_fixed(r, raw->kind, 1);
    put_fixed(r, raw->quantum_bits, 1);
    put_fixed(r, raw->vertex_count, 4);
    put_fixed(r, raw->face_count, 4);
    record_vertices(r, raw->vertices, raw->vertex_count);
    for (uint32_t i = 0; i < 3 * raw->face_count; i++) {
        put_fixed(r, raw->faces[i / 3][i % 3], 2);
    }
    return at;
}

/* ----------------------------------------------------------------------- contacts */

/* Ask the program, and write its answer unless it is "as it is". */
static bool ask_program(void *user, struct carom_touch *touch)
{
    struct carom_record *r = (struct carom_record *)user;
    const struct carom_touch was = *touch;
    const bool keep = r->contact(r->contact_user, touch);

    r->asked++;
    if (!keep || was.restitution_q30 != touch->restitution_q30 ||
        was.friction_q16 != touch->friction_q16) {
        record_token(r, REPLAY_TOKEN_ANSWER);
        put_number(r, r->asked);
        put_fixed(r, keep, 1);
        put_number(r, touch->restitution_q30);
        put_number(r, touch->friction_q16);
        r->asked = 0;
    }
    return keep;
}

/* ------------------------------------------------------------------ begin and end */

int carom_record_begin(struct carom_record *r, carom_record_write *write, void *user, bool stages,
                       const char *note)
{
    size_t length = 0;

    if (!r || !write) {
        return CAROM_ERR_NULL;
    }
    memset(r, 0, sizeof *r);
    r->write = write;
    r->user = user;
    r->stages = stages;
    r->sum = FNV32_START;
    while (note && length < REPLAY_NOTE_MAX && note[length] != 0) {
        length++;
    }
    put(r, REPLAY_MAGIC, 4);
    put_fixed(r, REPLAY_VERSION, 1);
    put_fixed(r, stages ? REPLAY_STAGES : 0, 1);
    put_fixed(r, length, 1);
    put(r, note ? note : "", length);
    return CAROM_OK;
}

void record_ask(struct carom_record *r, struct carom_config *config)
{
    r->contact = config->contact;
    r->contact_user = config->contact_user;
    if (config->contact) {
        config->contact = ask_program;
        config->contact_user = r;
    }
}

void record_ask_no_more(struct carom_record *r)
{
    if (r->world && r->contact) {
        r->world->config.contact = r->contact;
        r->world->config.contact_user = r->contact_user;
    }
}

int carom_record_end(struct carom_record *r)
{
    if (!r) {
        return CAROM_ERR_NULL;
    }
    if (r->write) {
        record_token(r, REPLAY_TOKEN_END);
        put_fixed(r, r->frames, 4);
        put_fixed(r, carom_world_hash(r->world), 8);
        put_fixed(r, r->sum, 4);
    }
    record_ask_no_more(r);
    r->write = NULL;
    r->world = NULL;
    return CAROM_OK;
}

int carom_record_world_init(struct carom_record *r, void *mem, size_t bytes,
                            const struct carom_config *config, struct carom_world **world)
{
    struct replay_call call = {.op = CAROM_CALL_world_init};
    int result;

    if (!r || !r->write || !config || !world ||
        (r->world && (const void *)r->world != (const void *)mem)) {
        return carom_world_init(mem, bytes, config, world);
    }
    call.u.config = *config;
    result = carom_world_init(mem, bytes, config, world);
    if (result >= 0) {
        record_ask(r, &(*world)->config);
        r->world = *world;
        record_call(r, &call);
        record_result(r, call.op, result);
    }
    return result;
}
