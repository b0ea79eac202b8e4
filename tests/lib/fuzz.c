/* SPDX-License-Identifier: MIT */
/* Random calls of a small world, half of them with hostile arguments. */
#include "fuzz.h"

#include <stdlib.h>
#include <string.h>

#include "real.h"

/* ------------------------------------------------------------------------ numbers */

int fuzz_pick(struct fuzz *f, int count)
{
    return (int)test_random_range(&f->r, 0, count - 1);
}

int64_t fuzz_number(struct fuzz *f, int bits)
{
    static const int64_t extreme[] = {0,         1,        -1, INT64_MAX, INT64_MIN, INT64_MIN + 1,
                                      INT32_MAX, INT32_MIN};
    const int64_t most = (int64_t)1 << bits;

    switch (fuzz_pick(f, 24)) {
    case 0:
        return extreme[fuzz_pick(f, 8)];
    case 1:
        return (int64_t)((uint64_t)1 << fuzz_pick(f, 64)) - fuzz_pick(f, 3);
    case 2:
        return -(int64_t)((uint64_t)1 << fuzz_pick(f, 63)) + fuzz_pick(f, 3);
    default:
        return test_random_range(&f->r, -most, most) >> fuzz_pick(f, bits);
    }
}

void fuzz_vector(struct fuzz *f, int64_t v[3], int bits)
{
    bool hostile = fuzz_pick(f, 3) == 0;

    for (int k = 0; k < 3; k++) {
        v[k] = hostile ? fuzz_number(f, bits)
                       : test_random_range(&f->r, -((int64_t)1 << bits), (int64_t)1 << bits);
    }
}

static int32_t number32(struct fuzz *f, int64_t low, int64_t high)
{
    return fuzz_pick(f, 12) == 0 ? (int32_t)(uint32_t)fuzz_number(f, 30)
                                 : (int32_t)test_random_range(&f->r, low, high);
}

void fuzz_rotation(struct fuzz *f, carom_quat_q30 *q)
{
    double v[4], length = 0;

    for (int k = 0; k < 4; k++) {
        v[k] = (double)test_random_range(&f->r, -1000, 1000);
        length += v[k] * v[k];
    }
    for (int k = 0; k < 4; k++) {
        q->c[k] = length > 0 ? (int32_t)(v[k] / real_sqrt(length) * CAROM_ONE_Q30) : 0;
    }
    if (fuzz_pick(f, 12) == 0) {
        q->c[fuzz_pick(f, 4)] = (int32_t)(uint32_t)fuzz_number(f, 30);
    }
}

int fuzz_body(struct fuzz *f)
{
    int body = fuzz_pick(f, 14);

    switch (fuzz_pick(f, 16)) {
    case 0:
        return (int)(uint32_t)fuzz_number(f, 30);
    case 1:
        return body - 3;
    case 2:
        return body | 1 << 12 | fuzz_pick(f, 3) << 12;
    case 3:
    case 4:
        return carom_body_id(f->world, body);
    default:
        return body;
    }
}

/* -------------------------------------------------------------------- definitions */

static uint8_t kind(struct fuzz *f, int count)
{
    return (uint8_t)(fuzz_pick(f, 20) == 0 ? fuzz_pick(f, 256) : fuzz_pick(f, count));
}

static void set_filter(struct fuzz *f, struct carom_filter *filter)
{
    if (fuzz_pick(f, 3) == 0) {
        *filter =
            (struct carom_filter){(uint16_t)fuzz_pick(f, 65536), (uint16_t)fuzz_pick(f, 65536),
                                  (int16_t)(fuzz_pick(f, 5) - 2)};
    }
}

void fuzz_body_def(struct fuzz *f, struct carom_body_def *def)
{
    memset(def, 0, sizeof *def);
    def->mesh = fuzz_pick(f, 40) == 0 ? NULL : &f->meshes[fuzz_pick(f, FUZZ_MESHES - 1)];
    def->stationary = fuzz_pick(f, 4) == 0 || (def->mesh && def->mesh->raw.kind == CAROM_SURFACE);
    def->kinematic = fuzz_pick(f, 5) == 0;
    fuzz_vector(f, def->position.c, 34);
    fuzz_rotation(f, &def->rotation);
    if (fuzz_pick(f, 2)) {
        fuzz_vector(f, def->velocity.c, 36);
        fuzz_vector(f, def->spin.c, 36);
    }
    def->mass_q20 = (uint32_t)number32(f, 0, 1 << 24);
    def->restitution_q30 = number32(f, 0, CAROM_ONE_Q30);
    def->friction_q16 = (uint32_t)number32(f, 0, 1 << 17);
    set_filter(f, &def->filter);
    def->sensor = fuzz_pick(f, 6) == 0;
    def->one_way = fuzz_pick(f, 5) == 0 ? kind(f, 7) : 0;
    def->overlap = kind(f, 3);
}

void fuzz_drive(struct fuzz *f, struct carom_joint_drive *d)
{
    memset(d, 0, sizeof *d);
    d->limited = fuzz_pick(f, 2);
    d->lower_q32 = fuzz_number(f, 32);
    d->upper_q32 =
        fuzz_pick(f, 4) ? d->lower_q32 / 2 + ((int64_t)fuzz_pick(f, 4) << 31) : fuzz_number(f, 32);
    d->motor = fuzz_pick(f, 3) == 0;
    d->motor_speed_q40 = fuzz_number(f, 40);
    d->motor_most_q40 = fuzz_number(f, 40);
    d->spring = fuzz_pick(f, 3) == 0;
    d->rest_q32 = fuzz_number(f, 32);
    d->stiffness_q40 = fuzz_number(f, 44);
    d->damping_q40 = fuzz_number(f, 44);
    if (fuzz_pick(f, 4)) {
        d->motor_most_q40 &= INT64_MAX >> 4;
        d->stiffness_q40 &= INT64_MAX >> 4;
        d->damping_q40 &= INT64_MAX >> 4;
    }
}

void fuzz_joint_def(struct fuzz *f, struct carom_joint_def *def)
{
    struct carom_body_state state;
    int64_t axis[3] = {0, 0, 0};

    memset(def, 0, sizeof *def);
    def->kind = kind(f, 5);
    def->touch = fuzz_pick(f, 2);
    def->a = fuzz_body(f);
    def->b = fuzz_pick(f, 4) == 0 ? CAROM_WORLD : fuzz_body(f);
    fuzz_vector(f, def->anchor.c, 32);
    fuzz_vector(f, def->anchor_b.c, 32);
    if (fuzz_pick(f, 3) && carom_body_get(f->world, def->a, &state) >= 0) {
        for (int k = 0; k < 3; k++) {
            def->anchor.c[k] = state.position.c[k] + (def->anchor.c[k] >> 4);
        }
    }
    axis[fuzz_pick(f, 3)] = fuzz_pick(f, 2) ? CAROM_ONE_Q30 : -CAROM_ONE_Q30;
    for (int k = 0; k < 3; k++) {
        def->axis.c[k] =
            fuzz_pick(f, 30) ? (int32_t)axis[k] : (int32_t)(uint32_t)fuzz_number(f, 30);
    }
    if (fuzz_pick(f, 2)) {
        fuzz_drive(f, &def->drive);
    }
    def->most_impulse_q40 = fuzz_pick(f, 3) == 0 ? fuzz_number(f, 40) : 0;
}

/* -------------------------------------------------------------------------- worlds */

/* A callback whose answer depends on its arguments alone. */
static bool contact(void *user, struct carom_touch *touch)
{
    (void)user;
    touch->restitution_q30 = (int32_t)(touch->face_a * 0x9e3779b9u);
    touch->friction_q16 = touch->face_b * 0x85ebca6bu;
    return (touch->a + touch->b) % 5 != 0;
}

static void make_meshes(struct fuzz *f)
{
    static const uint16_t sides[2][3] = {{0, 1, 2}, {1, 3, 2}};
    const struct carom_mesh_raw *const raws[] = {&lab_box, &lab_tetrahedron, &lab_l, &lab_plate,
                                                 &lab_sheet};
    const struct carom_mesh_raw sheet = {
        (const int16_t(*)[3])f->vertices, sides, 4, 2, 8, CAROM_SURFACE};

    for (int i = 0; i < FUZZ_MESHES; i++) {
        const struct carom_mesh_raw *raw = i < FUZZ_MESHES - 1 ? raws[i] : &sheet;
        size_t bytes = CAROM_SURFACE_BYTES(raw->vertex_count, raw->face_count);

        if (!f->mesh_block[i]) {
            f->mesh_block[i] = lab_need(bytes);
        }
        lab_expect(i < FUZZ_MESHES - 1
                       ? carom_mesh_build(&f->meshes[i], raw, f->mesh_block[i], bytes)
                       : carom_surface_build(&f->meshes[i], raw, f->mesh_block[i], bytes),
                   "mesh");
    }
}

void fuzz_begin(struct fuzz *f, uint64_t seed)
{
    struct carom_config config = {
        CAROM_CAPS(FUZZ_CAPS), {{0, 0, -((int64_t)1 << 31)}}, .sleep = true};
    struct carom_body_def def;
    const size_t bytes = CAROM_WORLD_BYTES(FUZZ_CAPS);

    f->r.state = seed * 0x9e3779b97f4a7c15u;
    for (int v = 0; v < 4; v++) {
        f->vertices[v][0] = (int16_t)(v % 2 ? 4000 : -4000);
        f->vertices[v][1] = (int16_t)(v / 2 ? 4000 : -4000);
        f->vertices[v][2] = (int16_t)fuzz_pick(f, 200);
    }
    make_meshes(f);
    for (int i = 0; i < 4; i++) {
        f->materials[i] =
            (struct carom_material){CAROM_ONE_Q30 / 4 * i, (uint32_t)i << 15, 1 << 10, {{0}}};
    }
    for (int i = 0; i < FUZZ_VERTICES; i++) {
        f->of_face[i] = (uint8_t)fuzz_pick(f, 4);
    }
    config.contact = fuzz_pick(f, 2) ? contact : NULL;
    config.sweep_cap = (uint8_t)(fuzz_pick(f, 3) == 0 ? fuzz_pick(f, 256) : 0);
    config.substep_cap = (uint8_t)(fuzz_pick(f, 3) == 0 ? fuzz_pick(f, 256) : 0);
    if (!f->block) {
        f->block = lab_need(bytes);
        f->workspace = lab_need(CAROM_DRAW_BYTES(FUZZ_VERTICES, FUZZ_VERTICES));
    }
    lab_expect(carom_world_init(f->block, bytes, &config, &f->world), "world");
    memset(&def, 0, sizeof def);
    def.mesh = &f->meshes[FUZZ_MESHES - 1];
    def.stationary = true;
    def.position.c[2] = -3 * ((int64_t)1 << 32);
    lab_expect(carom_body_add(f->world, &def), "surface");
    for (int i = 0; i < 6; i++) {
        fuzz_body_def(f, &def);
        (void)carom_body_add(f->world, &def);
    }
}

void fuzz_end(struct fuzz *f)
{
    for (int i = 0; i < FUZZ_MESHES; i++) {
        free(f->mesh_block[i]);
    }
    free(f->block);
    free(f->workspace);
}
