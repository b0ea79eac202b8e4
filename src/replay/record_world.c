/* SPDX-License-Identifier: MIT */
/*
 * Recording a world from the middle of its life: calls that make a world of the same bodies and joints, then a snapshot that puts
 * them where they are. While bodies are added they all lie at 0 and may touch nothing.
 */
#include "../mesh/mesh.h"
#include "record.h"

/* Stands for a body in a place that is free: it is added and removed again. */
static const int16_t corners[][3] = {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}};
static const uint16_t side[][3] = {{0, 1, 2}};
static const struct carom_mesh stopgap = {.raw = {corners, side, 3, 1, 8, CAROM_SURFACE}};

/* Returns 0 for a mass that follows from the mesh, since 2^-20 need not hold it. */
static uint32_t mass_of(const struct body *b)
{
    const struct fix_scaled by_volume = fix_scale(b->def.mesh->mass.volume_q32, 32);

    return !b->def.moving || (by_volume.m == b->def.mass.m && by_volume.e == b->def.mass.e)
               ? 0
               : (uint32_t)fix_mul_scaled((int64_t)1 << 20, b->def.mass);
}

static struct carom_body_def def_of(const struct body *b)
{
    struct carom_body_def def;

    memset(&def, 0, sizeof def);
    def.filter.category = 1; /* without a mask; the snapshot has the filter */
    def.mesh = &stopgap;
    def.stationary = true;
    if (b->def.mesh) {
        def.mesh = b->def.mesh;
        def.kinematic = world_is_kinematic(b);
        def.stationary = !b->def.moving && !def.kinematic;
        def.mass_q20 = mass_of(b);
        def.restitution_q30 = b->def.restitution_q30;
        def.friction_q16 = b->def.friction_q16;
        def.sensor = b->def.sensor;
        def.one_way = b->def.one_way;
    }
    return def;
}

/* Write a call with at most two numbers. */
FIX_OWN_FRAME static void note_made(struct carom_record *r, enum carom_replay_call op, int body,
                                    int64_t first, int64_t second)
{
    struct replay_call call = {.op = (uint8_t)op, .body = body};

    call.u.numbers[0] = first;
    call.u.numbers[1] = second;
    record_made(r, &call, CAROM_OK);
}

/* Write a body; a surface as it was when the last step ended. */
FIX_OWN_FRAME static void note_body(struct carom_record *r, int body)
{
    const struct body *b = &r->world->bodies[body];
    struct replay_call call = {.op = CAROM_CALL_body_add, .body = body};
    struct carom_mesh mesh;

    call.u.def = def_of(b);
    mesh = *call.u.def.mesh;
    if (mesh.surface) {
        mesh.raw.vertices = (const int16_t(*)[3])mesh.surface->before;
    }
    call.mesh = record_mesh(r, &mesh);
    record_made(r, &call, body);
}

/* Move a surface from there to where it is. */
FIX_OWN_FRAME static void note_move(struct carom_record *r, int body)
{
    const struct carom_mesh *mesh = r->world->bodies[body].def.mesh;
    struct replay_call call = {.op = CAROM_CALL_surface_move, .body = body};

    if (mesh && mesh->surface && mesh->surface->most_q22 != 0) {
        call.count = mesh->raw.vertex_count;
        record_call(r, &call);
        record_vertices(r, (const int16_t(*)[3])mesh->surface->now, call.count);
        record_result(r, call.op, CAROM_OK);
    }
}

/*
 * Write materials by face. The world does not know how many there are: write those that faces use, and one more with the
 * largest e and mu of all.
 */
FIX_OWN_FRAME static void note_faces(struct carom_record *r, int body,
                                     const struct body_extra *extra)
{
    struct replay_call call = {.op = CAROM_CALL_body_set_face_materials, .body = body};
    struct carom_material most = {.restitution_q30 = extra->most_restitution_q30,
                                  .friction_q16 = extra->most_friction_q16};
    uint32_t used = 0;

    call.faces = r->world->bodies[body].def.mesh->raw.face_count;
    for (uint32_t i = 0; i < call.faces; i++) {
        used = extra->face_material[i] >= used ? extra->face_material[i] + 1u : used;
    }
    call.count = used < 256 ? used + 1 : used;
    record_call(r, &call);
    for (uint32_t i = 0; i < call.count; i++) {
        record_material(r, i < used ? &extra->materials[i] : &most);
    }
    record_bytes(r, extra->face_material, call.faces);
    record_result(r, call.op, CAROM_OK);
}

/*
 * Write materials, and an extra for a body that has one. A world mixes materials by its rules from the first change of a
 * material on, so write a change and take it back.
 */
FIX_OWN_FRAME static void note_extras(struct carom_record *r, int body)
{
    const struct body *b = &r->world->bodies[body];
    struct replay_call call = {.op = CAROM_CALL_body_set_material, .body = body};

    if (r->world->rest.list.materials) {
        struct carom_material *m = &call.u.material;
        uint32_t *changed = b->def.extra ? &m->rolling_q16 : &m->friction_q16;
        uint32_t is;

        carom_body_material(r->world, body, m);
        is = *changed;
        *changed = is > 0 ? is - 1 : 1;
        record_made(r, &call, CAROM_OK);
        *changed = is;
        record_made(r, &call, CAROM_OK);
    }
    if (b->def.extra && b->def.extra->materials) {
        note_faces(r, body, b->def.extra);
    }
    for (int k = 1; b->def.extra && b->def.moving && k >= 0; k--) {
        note_made(r, CAROM_CALL_body_set_damping, body, k, 0);
    }
}

/* To write a joint leaves it as it is. */
FIX_OWN_FRAME static void note_joint(struct carom_record *r, struct joint *j)
{
    uint8_t out[REPLAY_CALL_BYTES];
    struct replay_coder c = {.out = out, .size = sizeof out};

    record_token(r, REPLAY_TOKEN_JOINT);
    replay_joint(&c, j);
    record_bytes(r, out, (uint32_t)c.at);
}

FIX_OWN_FRAME static void note_all(struct carom_record *r)
{
    const struct carom_world *w = r->world;

    note_made(r, CAROM_CALL_world_set_combine, 0, w->rest.list.restitution_rule,
              w->rest.list.friction_rule);
    for (uint32_t i = 0; i < w->body_count; i++) {
        note_body(r, (int)i);
        note_move(r, (int)i);
    }
    for (uint32_t i = 0; i < w->body_count; i++) {
        if (w->bodies[i].def.mesh) {
            note_extras(r, (int)i);
        } else {
            note_made(r, CAROM_CALL_body_remove, (int)i, 0, 0);
        }
    }
    for (uint32_t i = 0; i < w->rest.joints.count; i++) {
        note_joint(r, &w->rest.joints.joints[i]);
    }
}

/* Make the world forget what it keeps beside its state to be faster. A player starts without it, and the digests of stages must agree. */
static void forget(struct carom_world *w)
{
    for (uint32_t i = 0; i < w->body_count; i++) {
        body_forget(&w->bodies[i]);
    }
    w->idle = false;
    w->regions_stale = true;
    w->sense_anew = w->sensors > 0; /* as after a load */
}

int carom_record_world(struct carom_record *r, struct carom_world *w, void *mem, size_t bytes)
{
    struct replay_call call = {.op = CAROM_CALL_world_init};
    int size;

    if (!r || !w || !mem) {
        return CAROM_ERR_NULL;
    }
    if (!r->write || r->world) {
        return CAROM_ERR_ARGUMENT;
    }
    size = carom_snapshot_save(w, mem, bytes);
    if (size < 0) {
        return size;
    }
    r->world = w;
    call.u.config = w->config;
    record_made(r, &call, CAROM_OK);
    note_all(r);
    call = (struct replay_call){.op = CAROM_CALL_snapshot_load, .count = (uint32_t)size};
    record_call(r, &call);
    record_bytes(r, mem, call.count);
    record_result(r, call.op, CAROM_OK);
    record_ask(r, &w->config);
    forget(w);
    return CAROM_OK;
}
