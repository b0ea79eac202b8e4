/* SPDX-License-Identifier: MIT */
/* The functions that record, one for each function that changes a world. */
#include "record.h"

/*
 * Each function writes its call, makes it, and writes the result. What writes keeps its locals out of the functions' frames: the
 * call that is made may be a step, where the stack is deepest.
 */

/* Write a call, with what it is given, if calls on the world are recorded. Returns whether they are. */
FIX_OWN_FRAME static bool note(struct carom_record *r, const struct carom_world *w,
                               enum carom_replay_call op, int body, const void *given, size_t bytes)
{
    const bool open = record_is_open(r, w);
    struct replay_call call = {.op = (uint8_t)op, .body = body};

    if (open) {
        memcpy(&call.u, given, bytes); /* what each call is given begins where the union does */
        record_call(r, &call);
    }
    return open;
}

/* Write a call that is given nothing beside the number of a body or a joint. */
FIX_OWN_FRAME static bool note_bare(struct carom_record *r, const struct carom_world *w,
                                    enum carom_replay_call op, int body)
{
    return note(r, w, op, body, "", 0);
}

static bool note_numbers(struct carom_record *r, const struct carom_world *w,
                         enum carom_replay_call op, int body, int64_t first, int64_t second)
{
    const int64_t given[2] = {first, second};

    return note(r, w, op, body, given, sizeof given);
}

static bool note_act(struct carom_record *r, const struct carom_world *w, enum carom_replay_call op,
                     int body, const carom_v3_q40 *vector, const carom_v3_q32 *point)
{
    struct replay_act given;

    if (!vector || !point) {
        return false;
    }
    given.vector = *vector;
    given.point = *point;
    return note(r, w, op, body, &given, sizeof given);
}

/* Write the result of a call that was written. */
static int noted(struct carom_record *r, bool open, enum carom_replay_call op, int result)
{
    if (open) {
        record_result(r, (uint8_t)op, result);
    }
    return result;
}

/* Functions with an argument by pointer. For NULL the plain call returns the error. */
#define RECORD_GIVEN(name, type)                                                                   \
    int carom_record_##name(struct carom_record *r, struct carom_world *w, int body,               \
                            const type *given)                                                     \
    {                                                                                              \
        const bool open = given && note(r, w, CAROM_CALL_##name, body, given, sizeof *given);      \
                                                                                                   \
        return noted(r, open, CAROM_CALL_##name, carom_##name(w, body, given));                    \
    }
#define RECORD_POINT(name)                                                                         \
    int carom_record_##name(struct carom_record *r, struct carom_world *w, int body,               \
                            const carom_v3_q40 *vector, const carom_v3_q32 *point)                 \
    {                                                                                              \
        const bool open = note_act(r, w, CAROM_CALL_##name, body, vector, point);                  \
                                                                                                   \
        return noted(r, open, CAROM_CALL_##name, carom_##name(w, body, vector, point));            \
    }

RECORD_GIVEN(body_set, struct carom_body_state)
RECORD_GIVEN(body_move_to, struct carom_pose)
RECORD_GIVEN(body_set_filter, struct carom_filter)
RECORD_GIVEN(body_set_material, struct carom_material)
RECORD_GIVEN(body_set_force, carom_v3_q40)
RECORD_GIVEN(body_set_torque, carom_v3_q40)
RECORD_GIVEN(body_push_centre, carom_v3_q40)
RECORD_GIVEN(body_twist, carom_v3_q40)
RECORD_GIVEN(joint_set, struct carom_joint_drive)
RECORD_POINT(body_set_force_at)
RECORD_POINT(body_push)

int carom_record_world_step(struct carom_record *r, struct carom_world *w)
{
    const bool open = note_bare(r, w, CAROM_CALL_world_step, 0);

    return noted(r, open, CAROM_CALL_world_step, carom_world_step(w));
}

int carom_record_body_remove(struct carom_record *r, struct carom_world *w, int body)
{
    const bool open = note_bare(r, w, CAROM_CALL_body_remove, body);

    return noted(r, open, CAROM_CALL_body_remove, carom_body_remove(w, body));
}

int carom_record_joint_remove(struct carom_record *r, struct carom_world *w, int joint)
{
    const bool open = note_bare(r, w, CAROM_CALL_joint_remove, joint);

    return noted(r, open, CAROM_CALL_joint_remove, carom_joint_remove(w, joint));
}

int carom_record_world_set_combine(struct carom_record *r, struct carom_world *w,
                                   enum carom_combine restitution, enum carom_combine friction)
{
    const bool open = note_numbers(r, w, CAROM_CALL_world_set_combine, 0, restitution, friction);

    return noted(r, open, CAROM_CALL_world_set_combine,
                 carom_world_set_combine(w, restitution, friction));
}

int carom_record_body_set_gravity_scale(struct carom_record *r, struct carom_world *w, int body,
                                        int32_t scale_q16)
{
    const bool open = note_numbers(r, w, CAROM_CALL_body_set_gravity_scale, body, scale_q16, 0);

    return noted(r, open, CAROM_CALL_body_set_gravity_scale,
                 carom_body_set_gravity_scale(w, body, scale_q16));
}

int carom_record_body_set_damping(struct carom_record *r, struct carom_world *w, int body,
                                  int32_t linear_q30, int32_t angular_q30)
{
    const bool open =
        note_numbers(r, w, CAROM_CALL_body_set_damping, body, linear_q30, angular_q30);

    return noted(r, open, CAROM_CALL_body_set_damping,
                 carom_body_set_damping(w, body, linear_q30, angular_q30));
}

int carom_record_body_set_mass(struct carom_record *r, struct carom_world *w, int body,
                               uint32_t mass_q20)
{
    const bool open = note_numbers(r, w, CAROM_CALL_body_set_mass, body, mass_q20, 0);

    return noted(r, open, CAROM_CALL_body_set_mass, carom_body_set_mass(w, body, mass_q20));
}

int carom_record_world_set_gravity(struct carom_record *r, struct carom_world *w,
                                   const carom_v3_q40 *gravity)
{
    const bool open =
        gravity && note(r, w, CAROM_CALL_world_set_gravity, 0, gravity, sizeof *gravity);

    return noted(r, open, CAROM_CALL_world_set_gravity, carom_world_set_gravity(w, gravity));
}

FIX_OWN_FRAME static bool note_body(struct carom_record *r, const struct carom_world *w,
                                    const struct carom_body_def *def)
{
    const bool open = def && def->mesh && record_is_open(r, w);
    struct replay_call call = {.op = CAROM_CALL_body_add};

    if (open) {
        call.mesh = record_mesh(r, def->mesh);
        call.u.def = *def;
        record_call(r, &call);
    }
    return open;
}

int carom_record_body_add(struct carom_record *r, struct carom_world *w,
                          const struct carom_body_def *def)
{
    const bool open = note_body(r, w, def);

    return noted(r, open, CAROM_CALL_body_add, carom_body_add(w, def));
}

int carom_record_joint_add(struct carom_record *r, struct carom_world *w,
                           const struct carom_joint_def *def)
{
    const bool open = def && note(r, w, CAROM_CALL_joint_add, 0, def, sizeof *def);

    return noted(r, open, CAROM_CALL_joint_add, carom_joint_add(w, def));
}

/* ------------------------------------------------------------- calls with much behind them */

FIX_OWN_FRAME static bool note_face_materials(struct carom_record *r, const struct carom_world *w,
                                              int body, const struct carom_material *materials,
                                              uint32_t count, const uint8_t *of_face)
{
    const struct carom_mesh *mesh = carom_body_mesh(w, body);
    const bool given = materials && of_face && mesh && count >= 1 && count <= 256;
    const struct replay_call call = {.op = CAROM_CALL_body_set_face_materials,
                                     .body = body,
                                     .count = given ? count : 0,
                                     .faces = given ? mesh->raw.face_count : 0};
    const bool open = record_is_open(r, w) && (given || !materials);

    if (open) {
        record_call(r, &call);
        for (uint32_t i = 0; i < call.count; i++) {
            record_material(r, &materials[i]);
        }
        record_bytes(r, of_face, call.faces);
    }
    return open;
}

int carom_record_body_set_face_materials(struct carom_record *r, struct carom_world *w, int body,
                                         const struct carom_material *materials, uint32_t count,
                                         const uint8_t *of_face)
{
    const bool open = note_face_materials(r, w, body, materials, count, of_face);

    return noted(r, open, CAROM_CALL_body_set_face_materials,
                 carom_body_set_face_materials(w, body, materials, count, of_face));
}

FIX_OWN_FRAME static bool note_surface(struct carom_record *r, const struct carom_world *w,
                                       enum carom_replay_call op, int body,
                                       const int16_t (*vertices)[3])
{
    const struct carom_mesh *mesh = carom_body_mesh(w, body);
    const struct replay_call call = {
        .op = (uint8_t)op, .body = body, .count = mesh && vertices ? mesh->raw.vertex_count : 0};
    const bool open = record_is_open(r, w) && vertices;

    if (open) {
        record_call(r, &call);
        record_vertices(r, vertices, call.count);
    }
    return open;
}

int carom_record_surface_move(struct carom_record *r, struct carom_world *w, int body,
                              const int16_t (*vertices)[3])
{
    const bool open = note_surface(r, w, CAROM_CALL_surface_move, body, vertices);

    return noted(r, open, CAROM_CALL_surface_move, carom_surface_move(w, body, vertices));
}

int carom_record_surface_set(struct carom_record *r, struct carom_world *w, int body,
                             const int16_t (*vertices)[3])
{
    const bool open = note_surface(r, w, CAROM_CALL_surface_set, body, vertices);

    return noted(r, open, CAROM_CALL_surface_set, carom_surface_set(w, body, vertices));
}

FIX_OWN_FRAME static bool note_snapshot(struct carom_record *r, const struct carom_world *w,
                                        const void *in, size_t bytes)
{
    const struct replay_call call = {.op = CAROM_CALL_snapshot_load, .count = (uint32_t)bytes};
    const bool open = record_is_open(r, w) && in && bytes <= UINT32_MAX;

    if (open) {
        record_call(r, &call);
        record_bytes(r, in, call.count);
    }
    return open;
}

int carom_record_snapshot_load(struct carom_record *r, struct carom_world *w, const void *in,
                               size_t bytes)
{
    const bool open = note_snapshot(r, w, in, bytes);

    return noted(r, open, CAROM_CALL_snapshot_load, carom_snapshot_load(w, in, bytes));
}
