/* SPDX-License-Identifier: MIT */
/* The calls that change a world: those of carom.h, carom_body.h and carom_joint.h. */
#include <string.h>

#include "fuzz.h"

/* ------------------------------------------------------------------------- carom.h */

static int add(struct fuzz *f)
{
    struct carom_body_def def;

    fuzz_body_def(f, &def);
    return carom_body_add(f->world, fuzz_pick(f, 50) ? &def : NULL);
}

static int remove_one(struct fuzz *f)
{
    return fuzz_pick(f, 3) ? CAROM_OK : carom_body_remove(f->world, fuzz_body(f));
}

static int set(struct fuzz *f)
{
    struct carom_body_state state;
    int body = fuzz_body(f), result = carom_body_get(f->world, body, &state);

    if (result < 0) {
        memset(&state, 0, sizeof state);
    }
    if (fuzz_pick(f, 2)) {
        fuzz_vector(f, state.position.c, 34);
    }
    if (fuzz_pick(f, 2)) {
        fuzz_rotation(f, &state.rotation);
    }
    fuzz_vector(f, state.velocity.c, 38);
    fuzz_vector(f, state.spin.c, 38);
    state.overlap = (uint8_t)(fuzz_pick(f, 20) ? fuzz_pick(f, 3) : fuzz_pick(f, 256));
    return carom_body_set(f->world, body, &state);
}

static int move_to(struct fuzz *f)
{
    struct carom_body_state state;
    struct carom_pose pose;
    int body = fuzz_body(f);

    memset(&pose, 0, sizeof pose);
    fuzz_vector(f, pose.position.c, 32);
    if (fuzz_pick(f, 4) && carom_body_get(f->world, body, &state) >= 0) {
        for (int k = 0; k < 3; k++) {
            pose.position.c[k] = state.position.c[k] + (pose.position.c[k] >> 3);
        }
    }
    fuzz_rotation(f, &pose.rotation);
    return carom_body_move_to(f->world, body, &pose);
}

static int set_filter(struct fuzz *f)
{
    struct carom_filter filter = {.category = (uint16_t)fuzz_pick(f, 8)};

    filter.mask = (uint16_t)fuzz_pick(f, 65536);
    filter.group = (int16_t)(fuzz_pick(f, 4) - 2);
    return carom_body_set_filter(f->world, fuzz_body(f), &filter);
}

static int set_gravity(struct fuzz *f)
{
    carom_v3_q40 gravity;

    fuzz_vector(f, gravity.c, 34);
    return carom_world_set_gravity(f->world, &gravity);
}

static int push(struct fuzz *f)
{
    carom_v3_q40 impulse;
    carom_v3_q32 point;

    fuzz_vector(f, impulse.c, 36);
    fuzz_vector(f, point.c, 33);
    switch (fuzz_pick(f, 4)) {
    case 0:
        return carom_body_push_centre(f->world, fuzz_body(f), &impulse);
    case 1:
        return carom_body_twist(f->world, fuzz_body(f), &impulse);
    case 2:
        return carom_body_set_force(f->world, fuzz_body(f), &impulse);
    default:
        return carom_body_push(f->world, fuzz_body(f), &impulse, &point);
    }
}

static int move_surface(struct fuzz *f)
{
    int body = fuzz_pick(f, 10) ? 0 : fuzz_body(f);
    int16_t vertices[4][3];

    /* other surfaces have as many vertices or fewer */
    if (carom_body_mesh(f->world, body) != &f->meshes[FUZZ_MESHES - 1]) {
        return CAROM_OK;
    }
    memcpy(vertices, f->vertices, sizeof vertices);
    for (int v = 0; v < 4; v++) {
        vertices[v][2] =
            (int16_t)(fuzz_pick(f, 30) ? fuzz_pick(f, 400) : fuzz_pick(f, 65536) - 32768);
    }
    return fuzz_pick(f, 6) ? carom_surface_move(f->world, body, (const int16_t(*)[3])vertices)
                           : carom_surface_set(f->world, body, (const int16_t(*)[3])vertices);
}

/* -------------------------------------------------------------------- carom_body.h */

static int act_on(struct fuzz *f)
{
    const int32_t small = (int32_t)(uint32_t)fuzz_number(f, 30) >> (fuzz_pick(f, 2) ? 0 : 12),
                  other = (int32_t)(uint32_t)fuzz_number(f, 30);
    carom_v3_q40 v;
    carom_v3_q32 point;

    fuzz_vector(f, v.c, 34);
    fuzz_vector(f, point.c, 33);
    switch (fuzz_pick(f, 4)) {
    case 0:
        return carom_body_set_force_at(f->world, fuzz_body(f), &v, &point);
    case 1:
        return carom_body_set_torque(f->world, fuzz_body(f), &v);
    case 2:
        return carom_body_set_gravity_scale(f->world, fuzz_body(f), small);
    default:
        return carom_body_set_damping(f->world, fuzz_body(f), small, other);
    }
}

static int make_of(struct fuzz *f)
{
    const int body = fuzz_body(f), pick = fuzz_pick(f, 45);
    struct carom_material m = {.restitution_q30 = (int32_t)(uint32_t)fuzz_number(f, 29)};

    m.friction_q16 = (uint32_t)fuzz_number(f, 17);
    m.rolling_q16 = (uint32_t)fuzz_number(f, 15);
    switch (fuzz_pick(f, 5)) {
    case 0:
        return carom_body_set_mass(f->world, body, (uint32_t)fuzz_number(f, 24));
    case 1:
        return carom_body_set_face_materials(f->world, body, pick % 5 ? f->materials : NULL,
                                             (uint32_t)(pick / 5 ? 4 : pick % 2), f->of_face);
    case 2:
        return carom_world_set_combine(f->world, (enum carom_combine)(pick % 5),
                                       (enum carom_combine)(pick / 5 % 5));
    case 3:
        fuzz_vector(f, m.surface_velocity.c, 38);
        return carom_body_set_material(f->world, body, &m);
    default:
        return carom_body_set_user(f->world, body, f);
    }
}

static int look_at(struct fuzz *f)
{
    struct carom_matrix matrix;
    struct carom_forces forces;
    struct carom_material material;
    struct carom_filter filter;
    carom_v3_q32 point, out;
    carom_v3_q40 v;
    uint32_t mass;
    int body = fuzz_body(f);

    fuzz_vector(f, point.c, 34);
    fuzz_vector(f, v.c, 60);
    (void)carom_body_matrix(f->world, body, &matrix);
    (void)carom_body_forces(f->world, body, &forces);
    (void)carom_body_material(f->world, body, &material);
    (void)carom_body_get_filter(f->world, body, &filter);
    (void)carom_body_mass(f->world, body, &mass);
    (void)carom_body_user(f->world, body);
    (void)carom_body_number(body);
    (void)carom_body_world_vector(f->world, body, v.c, v.c);
    (void)carom_body_local_vector(f->world, body, v.c, v.c);
    (void)carom_body_local_point(f->world, body, &point, &out);
    (void)carom_body_velocity_at(f->world, body, &point, &v);
    return carom_body_world_point(f->world, body, &point, &out);
}

/* ------------------------------------------------------------------- carom_joint.h */

static int join(struct fuzz *f)
{
    struct carom_joint_def def;

    fuzz_joint_def(f, &def);
    return carom_joint_add(f->world, fuzz_pick(f, 50) ? &def : NULL);
}

static int change_joint(struct fuzz *f)
{
    int joint = fuzz_pick(f, 12) ? fuzz_pick(f, 8) : (int)(uint32_t)fuzz_number(f, 30);
    struct carom_joint_drive drive;
    struct carom_joint_state state;

    fuzz_drive(f, &drive);
    switch (fuzz_pick(f, 4)) {
    case 0:
        return carom_joint_remove(f->world, joint);
    case 1:
        return carom_joint_get(f->world, joint, &state);
    default:
        return carom_joint_set(f->world, joint, &drive);
    }
}

/* Events and their details. */
static int read_events(struct fuzz *f)
{
    const struct carom_event *events;
    struct carom_contact contacts[4];
    struct carom_hit hit;
    struct carom_event event;
    int n = carom_events(f->world, &events);

    for (int i = 0; i < n; i++) {
        (void)carom_event_hit(f->world, &events[i], &hit);
    }
    memset(&event, 0, sizeof event);
    event.kind = (uint8_t)fuzz_pick(f, 14);
    event.details = (uint16_t)fuzz_pick(f, 65536);
    (void)carom_event_hit(f->world, &event, &hit);
    return carom_contacts(f->world, contacts, fuzz_pick(f, 5));
}

int fuzz_call(struct fuzz *f)
{
    static int (*const calls[])(struct fuzz *) = {
        add,      remove_one, set,     move_to, move_to,     set_filter,  set_gravity,
        push,     act_on,     make_of, look_at, join,        join,        change_joint,
        fuzz_ask, fuzz_draw,  set,     add,     read_events, move_surface};

    f->last = fuzz_pick(f, sizeof calls / sizeof *calls);
    return calls[f->last](f);
}
