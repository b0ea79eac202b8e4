/* SPDX-License-Identifier: MIT */
/* Playing: the calls of a file are made again, and what comes of them is compared. No byte of it is trusted. */

#include "call.h"

/* ------------------------------------------------------------------ memory, bytes */

/* Room that stays taken; NULL when there is none left. */
static void *take(struct carom_replay *p, size_t bytes)
{
    const size_t rounded = (bytes + 7) / 8 * 8;
    uint8_t *at = p->mem + p->used;

    if (bytes > p->room || rounded > p->room - p->used) {
        return NULL;
    }
    p->used += rounded;
    return at;
}

/* A block that the next call may have again. */
static void *take_again(struct carom_replay *p, uint8_t **block, size_t *had, size_t bytes)
{
    if (!*block || *had < bytes) {
        *block = (uint8_t *)take(p, bytes);
        *had = *block ? bytes : 0;
    }
    return *block;
}

static struct replay_coder rest_of(const struct carom_replay *p)
{
    return (struct replay_coder){.in = p->file + p->at, .size = p->bytes - p->at};
}

/* How much was read; true if all of it was there and meant something. */
static bool done(struct carom_replay *p, const struct replay_coder *c)
{
    p->at += c->at;
    return !c->bad;
}

static bool next_is(const struct carom_replay *p, uint8_t token)
{
    return p->run == 0 && p->at < p->bytes && p->file[p->at] == token;
}

/* The first difference of a frame is the one that is told. */
static void differ(struct carom_replay *p, int difference, int64_t wanted, int64_t found)
{
    if (p->difference == CAROM_REPLAY_SAME) {
        p->difference = (uint8_t)difference;
        p->wanted = wanted;
        p->found = found;
    }
}

/* ----------------------------------------------------------------------- contacts */

/* Answers as the program did: what is next in the file, if it is about this question. */
static bool answer_as_recorded(void *user, struct carom_touch *touch)
{
    struct carom_replay *p = (struct carom_replay *)user;
    struct replay_coder c = rest_of(p);
    int64_t asked, e_q30, mu_q16;
    bool keep;

    p->asked++;
    if (!next_is(p, REPLAY_TOKEN_ANSWER)) {
        return true;
    }
    c.at = 1;
    asked = replay_number(&c, 0, 1, UINT32_MAX);
    keep = replay_fixed(&c, 0, 1) != 0;
    e_q30 = replay_number(&c, 0, INT32_MIN, INT32_MAX);
    mu_q16 = replay_number(&c, 0, 0, UINT32_MAX);
    if (c.bad || (uint32_t)asked != p->asked) {
        return true;
    }
    p->at += c.at;
    p->asked = 0;
    touch->restitution_q30 = (int32_t)e_q30;
    touch->friction_q16 = (uint32_t)mu_q16;
    return keep;
}

/* ------------------------------------------------------------------------- meshes */

static void read_vertices(struct replay_coder *c, int16_t (*out)[3], uint32_t count)
{
    for (uint32_t i = 0; i < 3 * count; i++) {
        out[i / 3][i % 3] = (int16_t)(uint16_t)replay_fixed(c, 0, 2);
    }
}

static int read_mesh(struct carom_replay *p)
{
    struct replay_coder c = rest_of(p);
    const bool moving = replay_fixed(&c, 0, 1) != 0;
    struct carom_mesh_raw raw = {0};
    struct carom_mesh *mesh = (struct carom_mesh *)take(p, sizeof *mesh);
    int16_t(*vertices)[3];
    uint16_t(*faces)[3];
    size_t bytes;
    void *block;
    int result;

    raw.kind = (uint8_t)replay_fixed(&c, 0, 1);
    raw.quantum_bits = (uint8_t)replay_fixed(&c, 0, 1);
    raw.vertex_count = (uint32_t)replay_fixed(&c, 0, 4);
    raw.face_count = (uint32_t)replay_fixed(&c, 0, 4);
    if (c.bad || raw.vertex_count < 3 || raw.vertex_count > 65535 || raw.face_count < 1 ||
        raw.face_count > 65535 || (size_t)6 * (raw.vertex_count + raw.face_count) > c.size - c.at) {
        return CAROM_ERR_FORMAT;
    }
    bytes = moving ? CAROM_SURFACE_BYTES(raw.vertex_count, raw.face_count)
                   : CAROM_MESH_BYTES(raw.vertex_count, raw.face_count);
    vertices = (int16_t(*)[3])take(p, raw.vertex_count * sizeof *vertices);
    faces = (uint16_t(*)[3])take(p, raw.face_count * sizeof *faces);
    block = take(p, bytes);
    if (!mesh || !vertices || !faces || !block) {
        return CAROM_ERR_MEMORY;
    }
    read_vertices(&c, vertices, raw.vertex_count);
    for (uint32_t i = 0; i < 3 * raw.face_count; i++) {
        faces[i / 3][i % 3] = (uint16_t)replay_fixed(&c, 0, 2);
    }
    raw.vertices = (const int16_t(*)[3])vertices;
    raw.faces = (const uint16_t(*)[3])faces;
    result = moving ? carom_surface_build(mesh, &raw, block, bytes)
                    : carom_mesh_build(mesh, &raw, block, bytes);
    p->meshes[p->mesh_count++ % CAROM_REPLAY_MESHES] = mesh;
    return done(p, &c) && result >= 0 ? CAROM_OK : CAROM_ERR_FORMAT;
}

/* ----------------------------------------------------------- what follows a call */

static int read_surface(struct carom_replay *p, struct replay_call *call)
{
    const struct carom_mesh *mesh = carom_body_mesh(p->world, call->body);
    struct replay_coder c = rest_of(p);
    int16_t(*vertices)[3];

    if (call->count != (mesh ? mesh->raw.vertex_count : 0) || 6 * (size_t)call->count > c.size) {
        return CAROM_ERR_FORMAT;
    }
    vertices =
        (int16_t(*)[3])take_again(p, &p->scratch, &p->scratch_bytes, 6 * (size_t)call->count + 8);
    if (!vertices) {
        return CAROM_ERR_MEMORY;
    }
    read_vertices(&c, vertices, call->count);
    call->vertices = (const int16_t(*)[3])vertices;
    return done(p, &c) ? CAROM_OK : CAROM_ERR_FORMAT;
}

static int read_materials(struct carom_replay *p, struct replay_call *call)
{
    const struct carom_mesh *mesh = carom_body_mesh(p->world, call->body);
    struct replay_coder c = rest_of(p);
    struct carom_material *materials;
    uint8_t *of_face;

    if (call->faces == 0 && call->count == 0) {
        return CAROM_OK; /* the body's own again */
    }
    if (!mesh || call->faces != mesh->raw.face_count || call->count > 256 || call->count == 0) {
        return CAROM_ERR_FORMAT;
    }
    materials = (struct carom_material *)take(p, call->count * sizeof *materials);
    of_face = (uint8_t *)take(p, call->faces);
    if (!materials || !of_face) {
        return CAROM_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < call->count; i++) {
        replay_material(&c, &materials[i]);
    }
    for (uint32_t i = 0; i < call->faces; i++) {
        of_face[i] = (uint8_t)replay_fixed(&c, 0, 1);
    }
    call->data = materials;
    call->of_face = of_face;
    return done(p, &c) ? CAROM_OK : CAROM_ERR_FORMAT;
}

static int read_data(struct carom_replay *p, struct replay_call *call)
{
    if (call->op == CAROM_CALL_body_set_face_materials) {
        return read_materials(p, call);
    }
    if (call->op != CAROM_CALL_snapshot_load) {
        return read_surface(p, call);
    }
    if (call->count > p->bytes - p->at) {
        return CAROM_ERR_FORMAT;
    }
    call->data = p->file + p->at;
    p->at += call->count;
    return CAROM_OK;
}

/* -------------------------------------------------------------------------- calls */

static int make_world(struct carom_replay *p, struct replay_call *call)
{
    struct carom_config *config = &call->u.config;
    const size_t bytes = carom_world_bytes(&config->caps);

    config->contact = config->contact_user ? answer_as_recorded : NULL;
    config->contact_user = p;
    if (!take_again(p, &p->block, &p->block_bytes, bytes)) {
        return CAROM_ERR_MEMORY;
    }
    p->world = NULL;
    return carom_world_init(p->block, p->block_bytes, config, &p->world) < 0 ? CAROM_ERR_FORMAT
                                                                             : CAROM_OK;
}

/* What the step left against what it left when it was recorded. */
static int check(struct carom_replay *p)
{
    struct replay_coder c = rest_of(p);
    uint64_t digests[CAROM_REPLAY_PARTS];

    p->frames++;
    if (!next_is(p, REPLAY_TOKEN_CHECK)) {
        return p->at < p->bytes ? CAROM_ERR_FORMAT : CAROM_REPLAY_CUT;
    }
    c.at = 1;
    carom_replay_digests(p->world, digests);
    for (int part = p->stages ? 0 : CAROM_REPLAY_STATE; part < CAROM_REPLAY_PARTS; part++) {
        const bool full = part == CAROM_REPLAY_STATE && p->frames % REPLAY_FULL_EVERY == 0;
        const uint64_t wanted = replay_fixed(&c, 0, full ? 8 : 2);
        const uint64_t found = full ? digests[part] : digests[part] & 0xffff;

        if (wanted != found && !c.bad && p->difference == CAROM_REPLAY_SAME) {
            p->part = (uint8_t)part;
            differ(p, CAROM_REPLAY_IN_PART, (int64_t)wanted, (int64_t)found);
        }
    }
    if (!done(p, &c)) {
        return CAROM_REPLAY_CUT; /* the program ended in this step */
    }
    return p->difference == CAROM_REPLAY_SAME ? CAROM_REPLAY_FRAME : CAROM_REPLAY_DIFFERS;
}

/* Make a call and compare its result; an error of the file, or how a step went, or CAROM_OK. */
static int perform(struct carom_replay *p, struct replay_call *call)
{
    struct replay_coder c;
    int64_t wanted = 0;
    int result;

    p->call = call->op;
    if (call->op == CAROM_CALL_world_init) {
        result = make_world(p, call);
        return result;
    }
    if (!p->world) {
        return CAROM_ERR_FORMAT;
    }
    if (call->op == CAROM_CALL_body_add) {
        if (call->mesh >= CAROM_REPLAY_MESHES || !p->meshes[call->mesh]) {
            return CAROM_ERR_FORMAT;
        }
        call->u.def.mesh = p->meshes[call->mesh];
    }
    result = replay_result(call->op, replay_do(p->world, call));
    if (call->op == CAROM_CALL_body_add && p->meshes[call->mesh]->surface) {
        p->meshes[call->mesh] = NULL; /* such a mesh is one body's */
    }
    if (next_is(p, REPLAY_TOKEN_ANSWER)) {
        differ(p, CAROM_REPLAY_IN_ANSWER, 0, p->asked);
        return CAROM_REPLAY_DIFFERS;
    }
    if (next_is(p, REPLAY_TOKEN_RESULT)) {
        c = rest_of(p);
        c.at = 1;
        wanted = replay_number(&c, 0, INT32_MIN, INT32_MAX);
        if (!done(p, &c)) {
            return CAROM_REPLAY_CUT;
        }
    }
    if (result != wanted && p->run == 0 && p->at >= p->bytes) {
        return CAROM_REPLAY_CUT; /* before the result was written */
    }
    if (result != wanted) {
        differ(p, CAROM_REPLAY_IN_RESULT, wanted, result);
    }
    return call->op == CAROM_CALL_world_step ? check(p) : CAROM_OK;
}

/* A call of a slot. */
static int perform_again(struct carom_replay *p, uint8_t slot)
{
    const struct carom_replay_slot *s = &p->memory.slots[slot];
    struct replay_coder c = {.in = s->bytes, .at = 1, .size = s->size};
    struct replay_call call = {.op = s->bytes[0]};

    if (s->size == 0) {
        return CAROM_ERR_FORMAT;
    }
    replay_follow(&p->memory, slot);
    replay_code(&c, &call);
    return c.bad ? CAROM_ERR_FORMAT : perform(p, &call);
}

/* A call that is written out. */
static int perform_new(struct carom_replay *p, uint8_t op)
{
    const uint8_t *bytes = p->file + p->at - 1;
    struct replay_coder c = rest_of(p);
    struct replay_call call = {.op = op};
    int result;

    replay_code(&c, &call);
    if (!done(p, &c)) {
        return p->at >= p->bytes ? CAROM_REPLAY_CUT : CAROM_ERR_FORMAT;
    }
    if (!replay_has_data(op)) {
        replay_keep(&p->memory, bytes, c.at + 1);
        return perform(p, &call);
    }
    if (!p->world) {
        return CAROM_ERR_FORMAT;
    }
    result = read_data(p, &call);
    return result < 0 ? result : perform(p, &call);
}

/* The end: is it that of this file? */
static int end(struct carom_replay *p)
{
    const uint32_t sum = replay_sum(REPLAY_SUM_START, p->file, p->bytes >= 4 ? p->bytes - 4 : 0);
    struct replay_coder c = rest_of(p);
    const uint64_t frames = replay_fixed(&c, 0, 4), hash = replay_fixed(&c, 0, 8);
    const uint64_t wanted = replay_fixed(&c, 0, 4);

    if (!done(p, &c)) {
        return CAROM_REPLAY_CUT;
    }
    if (p->at != p->bytes || wanted != sum || frames != p->frames ||
        hash != carom_world_hash(p->world)) {
        differ(p, CAROM_REPLAY_IN_SUM, (int64_t)wanted, sum);
        p->at = p->bytes;
        return CAROM_REPLAY_DIFFERS;
    }
    return CAROM_REPLAY_END;
}

static int go_on(struct carom_replay *p)
{
    uint8_t token;

    if (p->run > 0) {
        p->run--;
        return perform_again(p, p->memory.slots[p->memory.last].next);
    }
    if (p->at >= p->bytes) {
        return CAROM_REPLAY_CUT;
    }
    token = p->file[p->at++];
    if (token >= REPLAY_TOKEN_RUN) {
        p->run = (uint32_t)(token - REPLAY_TOKEN_RUN) + 1;
        return CAROM_OK;
    }
    if (token >= REPLAY_TOKEN_SLOT && token < REPLAY_TOKEN_SLOT + CAROM_REPLAY_SLOTS) {
        return perform_again(p, (uint8_t)(token - REPLAY_TOKEN_SLOT));
    }
    if (token == REPLAY_TOKEN_MESH) {
        return read_mesh(p);
    }
    return token < CAROM_CALL_COUNT ? perform_new(p, token) : CAROM_ERR_FORMAT;
}

int carom_replay_frame(struct carom_replay *p)
{
    int result = CAROM_OK;

    if (!p) {
        return CAROM_ERR_NULL;
    }
    p->difference = CAROM_REPLAY_SAME;
    while (result == CAROM_OK) {
        if (next_is(p, REPLAY_TOKEN_END)) {
            p->at++;
            return end(p);
        }
        result = go_on(p);
    }
    return result;
}

int carom_replay_begin(struct carom_replay *p, const void *file, size_t bytes, void *mem,
                       size_t room)
{
    struct replay_coder c = {.in = (const uint8_t *)file, .at = 4, .size = bytes};
    uint64_t version, flags;

    if (!p || !file || !mem) {
        return CAROM_ERR_NULL;
    }
    memset(p, 0, sizeof *p);
    if ((uintptr_t)mem % 8 != 0) {
        return CAROM_ERR_MEMORY;
    }
    version = replay_fixed(&c, 0, 1);
    flags = replay_fixed(&c, 0, 1);
    p->note_bytes = (uint8_t)replay_fixed(&c, 0, 1);
    if (c.bad || memcmp(file, REPLAY_MAGIC, 4) != 0 || version != REPLAY_VERSION ||
        flags > REPLAY_STAGES || p->note_bytes > REPLAY_NOTE_MAX || p->note_bytes > bytes - c.at) {
        return CAROM_ERR_FORMAT;
    }
    p->file = (const uint8_t *)file;
    p->bytes = bytes;
    p->note = (const char *)p->file + c.at;
    p->at = c.at + p->note_bytes;
    p->stages = flags & REPLAY_STAGES;
    p->mem = (uint8_t *)mem;
    p->room = room;
    return CAROM_OK;
}
