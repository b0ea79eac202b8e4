/* SPDX-License-Identifier: MIT */
/* Reading what a recording holds beside calls: meshes, and the data behind a call. No byte of it is trusted. */
#include "play.h"

/* ------------------------------------------------------------------ memory, bytes */

/* Memory that stays taken; NULL if there is none left. */
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

/* A block that the next call may use again. */
void *play_take_again(struct carom_replay *p, uint8_t **block, size_t *had, size_t bytes)
{
    if (!*block || *had < bytes) {
        *block = (uint8_t *)take(p, bytes);
        *had = *block ? bytes : 0;
    }
    return *block;
}

struct replay_coder play_rest(const struct carom_replay *p)
{
    return (struct replay_coder){.in = p->file + p->at, .size = p->bytes - p->at};
}

/* Advance past what was read. True if all bytes were there and meant something. */
bool play_done(struct carom_replay *p, const struct replay_coder *c)
{
    p->at += c->at;
    return !c->bad;
}

/* ------------------------------------------------------------------------- meshes */

static void read_vertices(struct replay_coder *c, int16_t (*out)[3], uint32_t count)
{
    for (uint32_t i = 0; i < 3 * count; i++) {
        out[i / 3][i % 3] = (int16_t)(uint16_t)replay_fixed(c, 0, 2);
    }
}

/* Read a mesh. */
struct mesh_parts {
    bool moving;
    struct carom_mesh_raw raw;
    struct carom_mesh *mesh;
    int16_t (*vertices)[3];
    uint16_t (*faces)[3];
    size_t bytes;
    void *block;
};

/* Make room for a mesh and its index; false if there is none. */
static bool take_mesh(struct carom_replay *p, struct mesh_parts *m)
{
    m->bytes = m->moving ? CAROM_SURFACE_BYTES(m->raw.vertex_count, m->raw.face_count)
                         : CAROM_MESH_BYTES(m->raw.vertex_count, m->raw.face_count);
    m->mesh = (struct carom_mesh *)take(p, sizeof *m->mesh);
    m->vertices = (int16_t(*)[3])take(p, m->raw.vertex_count * sizeof *m->vertices);
    m->faces = (uint16_t(*)[3])take(p, m->raw.face_count * sizeof *m->faces);
    m->block = take(p, m->bytes);
    return m->mesh && m->vertices && m->faces && m->block;
}

int play_mesh(struct carom_replay *p)
{
    struct replay_coder c = play_rest(p);
    struct mesh_parts m = {.moving = replay_fixed(&c, 0, 1) != 0};
    int result;

    m.raw.kind = (uint8_t)replay_fixed(&c, 0, 1);
    m.raw.quantum_bits = (uint8_t)replay_fixed(&c, 0, 1);
    m.raw.vertex_count = (uint32_t)replay_fixed(&c, 0, 4);
    m.raw.face_count = (uint32_t)replay_fixed(&c, 0, 4);
    if (c.bad || m.raw.vertex_count < 3 || m.raw.vertex_count > 65535 || m.raw.face_count < 1 ||
        m.raw.face_count > 65535 ||
        (size_t)6 * (m.raw.vertex_count + m.raw.face_count) > c.size - c.at) {
        return CAROM_ERR_FORMAT;
    }
    if (!take_mesh(p, &m)) {
        return CAROM_ERR_MEMORY;
    }
    read_vertices(&c, m.vertices, m.raw.vertex_count);
    for (uint32_t i = 0; i < 3 * m.raw.face_count; i++) {
        m.faces[i / 3][i % 3] = (uint16_t)replay_fixed(&c, 0, 2);
    }
    m.raw.vertices = (const int16_t(*)[3])m.vertices;
    m.raw.faces = (const uint16_t(*)[3])m.faces;
    result = m.moving ? carom_surface_build(m.mesh, &m.raw, m.block, m.bytes)
                      : carom_mesh_build(m.mesh, &m.raw, m.block, m.bytes);
    p->at += c.at; /* its bytes are there: the counts fit the rest of the file */
    if (result < 0) {
        return CAROM_ERR_FORMAT;
    }
    p->meshes[p->mesh_count++ % CAROM_REPLAY_MESHES] = m.mesh;
    return CAROM_OK;
}

/* Read a joint that existed when the recording began. */
int play_joint(struct carom_replay *p)
{
    struct replay_coder c = play_rest(p);
    struct joint joint;

    memset(&joint, 0, sizeof joint);
    replay_joint(&c, &joint);
    return !play_done(p, &c) || !p->world ? CAROM_ERR_FORMAT : step_restore_joint(p->world, &joint);
}

/* ----------------------------------------------------------- what follows a call */

static int read_surface(struct carom_replay *p, struct replay_call *call)
{
    const struct carom_mesh *mesh = carom_body_mesh(p->world, call->body);
    struct replay_coder c = play_rest(p);
    int16_t(*vertices)[3];

    if (call->count != (mesh ? mesh->raw.vertex_count : 0) || 6 * (size_t)call->count > c.size) {
        return CAROM_ERR_FORMAT;
    }
    vertices = (int16_t(*)[3])play_take_again(p, &p->scratch, &p->scratch_bytes,
                                              6 * (size_t)call->count + 8);
    if (!vertices) {
        return CAROM_ERR_MEMORY;
    }
    read_vertices(&c, vertices, call->count);
    call->vertices = (const int16_t(*)[3])vertices;
    p->at += c.at; /* all are there: the count fits the rest of the file */
    return CAROM_OK;
}

static int read_materials(struct carom_replay *p, struct replay_call *call)
{
    const struct carom_mesh *mesh = carom_body_mesh(p->world, call->body);
    struct replay_coder c = play_rest(p);
    struct carom_material *materials;
    uint8_t *of_face;

    if (call->faces == 0 && call->count == 0) {
        return CAROM_OK; /* the body's own material again */
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
    return play_done(p, &c) ? CAROM_OK : (int)CAROM_ERR_FORMAT;
}

int play_data(struct carom_replay *p, struct replay_call *call)
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
