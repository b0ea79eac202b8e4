/* SPDX-License-Identifier: MIT */
/* The functions that record, one for each function that changes a world. */
#include "record.h"

/* Functions with an argument by pointer. For NULL the plain call returns the error. */
#define RECORD_GIVEN(name, field, type)                                                            \
    int carom_record_##name(struct carom_record *r, struct carom_world *w, int body,               \
                            const type *given)                                                     \
    {                                                                                              \
        struct replay_call call = {.op = CAROM_CALL_##name, .body = body};                         \
                                                                                                   \
        if (!given) {                                                                              \
            return carom_##name(w, body, given);                                                   \
        }                                                                                          \
        call.u.field = *given;                                                                     \
        return record_do(r, w, &call);                                                             \
    }
#define RECORD_POINT(name)                                                                         \
    int carom_record_##name(struct carom_record *r, struct carom_world *w, int body,               \
                            const carom_v3_q40 *vector, const carom_v3_q32 *point)                 \
    {                                                                                              \
        struct replay_call call = {.op = CAROM_CALL_##name, .body = body};                         \
                                                                                                   \
        if (!vector || !point) {                                                                   \
            return carom_##name(w, body, vector, point);                                           \
        }                                                                                          \
        call.u.act.vector = *vector;                                                               \
        call.u.act.point = *point;                                                                 \
        return record_do(r, w, &call);                                                             \
    }

RECORD_GIVEN(body_set, state, struct carom_body_state)
RECORD_GIVEN(body_move_to, pose, struct carom_pose)
RECORD_GIVEN(body_set_filter, filter, struct carom_filter)
RECORD_GIVEN(body_set_material, material, struct carom_material)
RECORD_GIVEN(body_set_force, act.vector, carom_v3_q40)
RECORD_GIVEN(body_set_torque, act.vector, carom_v3_q40)
RECORD_GIVEN(body_push_centre, act.vector, carom_v3_q40)
RECORD_GIVEN(body_twist, act.vector, carom_v3_q40)
RECORD_GIVEN(joint_set, drive, struct carom_joint_drive)
RECORD_POINT(body_set_force_at)
RECORD_POINT(body_push)

static int numbers(struct carom_record *r, struct carom_world *w, enum carom_replay_call op,
                   int body, int64_t first, int64_t second)
{
    struct replay_call call = {.op = (uint8_t)op, .body = body};

    call.u.numbers[0] = first;
    call.u.numbers[1] = second;
    return record_do(r, w, &call);
}

int carom_record_world_step(struct carom_record *r, struct carom_world *w)
{
    return numbers(r, w, CAROM_CALL_world_step, 0, 0, 0);
}

int carom_record_world_set_combine(struct carom_record *r, struct carom_world *w,
                                   enum carom_combine restitution, enum carom_combine friction)
{
    return numbers(r, w, CAROM_CALL_world_set_combine, 0, restitution, friction);
}

int carom_record_body_remove(struct carom_record *r, struct carom_world *w, int body)
{
    return numbers(r, w, CAROM_CALL_body_remove, body, 0, 0);
}

int carom_record_joint_remove(struct carom_record *r, struct carom_world *w, int joint)
{
    return numbers(r, w, CAROM_CALL_joint_remove, joint, 0, 0);
}

int carom_record_body_set_gravity_scale(struct carom_record *r, struct carom_world *w, int body,
                                        int32_t scale_q16)
{
    return numbers(r, w, CAROM_CALL_body_set_gravity_scale, body, scale_q16, 0);
}

int carom_record_body_set_damping(struct carom_record *r, struct carom_world *w, int body,
                                  int32_t linear_q30, int32_t angular_q30)
{
    return numbers(r, w, CAROM_CALL_body_set_damping, body, linear_q30, angular_q30);
}

int carom_record_body_set_mass(struct carom_record *r, struct carom_world *w, int body,
                               uint32_t mass_q20)
{
    return numbers(r, w, CAROM_CALL_body_set_mass, body, mass_q20, 0);
}

int carom_record_world_set_gravity(struct carom_record *r, struct carom_world *w,
                                   const carom_v3_q40 *gravity)
{
    struct replay_call call = {.op = CAROM_CALL_world_set_gravity};

    if (!gravity) {
        return carom_world_set_gravity(w, gravity);
    }
    call.u.act.vector = *gravity;
    return record_do(r, w, &call);
}

int carom_record_body_add(struct carom_record *r, struct carom_world *w,
                          const struct carom_body_def *def)
{
    struct replay_call call = {.op = CAROM_CALL_body_add};

    if (!def || !def->mesh) {
        return carom_body_add(w, def);
    }
    if (record_is_open(r, w)) {
        call.mesh = record_mesh(r, def->mesh);
    }
    call.u.def = *def;
    return record_do(r, w, &call);
}

int carom_record_joint_add(struct carom_record *r, struct carom_world *w,
                           const struct carom_joint_def *def)
{
    struct replay_call call = {.op = CAROM_CALL_joint_add};

    if (!def) {
        return carom_joint_add(w, def);
    }
    call.u.joint = *def;
    return record_do(r, w, &call);
}

/* ------------------------------------------------------------- calls with much behind them */

int carom_record_body_set_face_materials(struct carom_record *r, struct carom_world *w, int body,
                                         const struct carom_material *materials, uint32_t count,
                                         const uint8_t *of_face)
{
    const struct carom_mesh *mesh = carom_body_mesh(w, body);
    const bool given = materials && of_face && mesh && count >= 1 && count <= 256;
    const struct replay_call call = {.op = CAROM_CALL_body_set_face_materials,
                                     .body = body,
                                     .count = given ? count : 0,
                                     .faces = given ? mesh->raw.face_count : 0};
    const bool open = record_is_open(r, w) && (given || !materials);
    int result;

    if (open) {
        record_call(r, &call);
        for (uint32_t i = 0; i < call.count; i++) {
            record_material(r, &materials[i]);
        }
        record_bytes(r, of_face, call.faces);
    }
    result = carom_body_set_face_materials(w, body, materials, count, of_face);
    if (open) {
        record_result(r, call.op, result);
    }
    return result;
}

static int surface(struct carom_record *r, struct carom_world *w, enum carom_replay_call op,
                   int body, const int16_t (*vertices)[3])
{
    const struct carom_mesh *mesh = carom_body_mesh(w, body);
    const struct replay_call call = {.op = (uint8_t)op,
                                     .body = body,
                                     .count = mesh && vertices ? mesh->raw.vertex_count : 0,
                                     .vertices = vertices};
    const bool open = record_is_open(r, w) && vertices;
    int result;

    if (open) {
        record_call(r, &call);
        record_vertices(r, vertices, call.count);
    }
    result = replay_do(w, &call);
    if (open) {
        record_result(r, call.op, result);
    }
    return result;
}

int carom_record_surface_move(struct carom_record *r, struct carom_world *w, int body,
                              const int16_t (*vertices)[3])
{
    return surface(r, w, CAROM_CALL_surface_move, body, vertices);
}

int carom_record_surface_set(struct carom_record *r, struct carom_world *w, int body,
                             const int16_t (*vertices)[3])
{
    return surface(r, w, CAROM_CALL_surface_set, body, vertices);
}

int carom_record_snapshot_load(struct carom_record *r, struct carom_world *w, const void *in,
                               size_t bytes)
{
    const struct replay_call call = {
        .op = CAROM_CALL_snapshot_load, .count = (uint32_t)bytes, .data = in};
    const bool open = record_is_open(r, w) && in && bytes <= UINT32_MAX;
    int result;

    if (open) {
        record_call(r, &call);
        record_bytes(r, in, call.count);
    }
    result = carom_snapshot_load(w, in, bytes);
    if (open) {
        record_result(r, call.op, result);
    }
    return result;
}
