/* SPDX-License-Identifier: MIT */
/* Calls of a small world, half of them with hostile arguments. */
#include "fuzz.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "real.h"

/* ------------------------------------------------------------------------ numbers */

int fuzz_pick(struct fuzz *f, int count)
{
    return chance_pick(&f->chance, count);
}

int64_t fuzz_number(struct fuzz *f, int bits)
{
    return chance_number(&f->chance, bits);
}

void fuzz_vector(struct fuzz *f, int64_t v[3], int bits)
{
    bool hostile = fuzz_pick(f, 3) == 0;

    for (int k = 0; k < 3; k++) {
        v[k] = hostile ? fuzz_number(f, bits)
                       : chance_range(&f->chance, -((int64_t)1 << bits), (int64_t)1 << bits);
    }
}

static int32_t number32(struct fuzz *f, int64_t low, int64_t high)
{
    return fuzz_pick(f, 12) == 0 ? (int32_t)(uint32_t)fuzz_number(f, 30)
                                 : (int32_t)chance_range(&f->chance, low, high);
}

void fuzz_rotation(struct fuzz *f, carom_quat_q30 *q)
{
    double v[4], length = 0;

    for (int k = 0; k < 4; k++) {
        v[k] = (double)chance_range(&f->chance, -1000, 1000);
        length += v[k] * v[k];
    }
    for (int k = 0; k < 4; k++) {
        q->c[k] = length > 0 ? (int32_t)(v[k] / real_sqrt(length) * CAROM_ONE_Q30) : 0;
    }
    if (fuzz_pick(f, 12) == 0) {
        const int k = fuzz_pick(f, 4);

        q->c[k] = (int32_t)(uint32_t)fuzz_number(f, 30);
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
        filter->category = (uint16_t)fuzz_pick(f, 65536);
        filter->mask = (uint16_t)fuzz_pick(f, 65536);
        filter->group = (int16_t)(fuzz_pick(f, 5) - 2);
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
    if (def->overlap == CAROM_OVERLAP_PUSH_OUT && f->searches-- <= 0) {
        def->overlap = CAROM_OVERLAP_PASS;
    }
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
    int along;

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
    along = fuzz_pick(f, 3);
    axis[along] = fuzz_pick(f, 2) ? CAROM_ONE_Q30 : -CAROM_ONE_Q30;
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

/* The surface that moves is made anew, the solids once. */
static void make_meshes(struct fuzz *f)
{
    static const uint16_t sides[2][3] = {{0, 1, 2}, {1, 3, 2}};
    const struct carom_mesh_raw *const raws[] = {&lab_box, &lab_tetrahedron, &lab_l, &lab_plate,
                                                 &lab_sheet};
    const struct carom_mesh_raw sheet = {
        (const int16_t(*)[3])f->vertices, sides, 4, 2, 8, CAROM_SURFACE};
    const size_t room = CAROM_SURFACE_BYTES(4, 2);

    for (int i = 0; i < FUZZ_MESHES - 1 && !f->mesh_block[i]; i++) {
        size_t bytes = CAROM_MESH_BYTES(raws[i]->vertex_count, raws[i]->face_count);

        f->mesh_block[i] = lab_need(bytes);
        lab_expect(carom_mesh_build(&f->meshes[i], raws[i], f->mesh_block[i], bytes), "mesh");
    }
    if (!f->block) {
        f->mesh_block[FUZZ_MESHES - 1] = lab_need(room);
        f->block = lab_need(CAROM_WORLD_BYTES(FUZZ_CAPS));
        f->workspace = lab_need(FUZZ_WORKSPACE);
        f->pixels = (uint32_t *)lab_need(FUZZ_PIXELS * FUZZ_PIXELS * sizeof *f->pixels);
        f->others = (uint32_t *)lab_need(FUZZ_PIXELS * FUZZ_PIXELS * sizeof *f->others);
    }
    lab_expect(carom_surface_build(&f->meshes[FUZZ_MESHES - 1], &sheet,
                                   f->mesh_block[FUZZ_MESHES - 1], room),
               "surface");
}

static void make_materials(struct fuzz *f)
{
    for (int i = 0; i < 4; i++) {
        f->materials[i] =
            (struct carom_material){CAROM_ONE_Q30 / 4 * i, (uint32_t)i << 15, 1 << 10, {{0}}};
    }
    for (int i = 0; i < FUZZ_VERTICES; i++) {
        f->of_face[i] = (uint8_t)(i % 7 % 4);
    }
}

static void begin(struct fuzz *f, int bodies)
{
    struct carom_config config = {
        CAROM_CAPS(FUZZ_CAPS), {{0, 0, -((int64_t)1 << 31)}}, .sleep = true};
    struct carom_body_def def;

    for (int v = 0; v < 4; v++) {
        f->vertices[v][0] = (int16_t)(v % 2 ? 4000 : -4000);
        f->vertices[v][1] = (int16_t)(v / 2 ? 4000 : -4000);
        f->vertices[v][2] = (int16_t)fuzz_pick(f, 200);
    }
    make_meshes(f);
    make_materials(f);
    config.contact = fuzz_pick(f, 2) ? contact : NULL;
    config.sweep_cap = (uint8_t)(fuzz_pick(f, 3) == 0 ? fuzz_pick(f, 256) : 0);
    config.substep_cap = (uint8_t)(fuzz_pick(f, 3) == 0 ? fuzz_pick(f, 256) : 0);
    lab_expect(carom_world_init(f->block, CAROM_WORLD_BYTES(FUZZ_CAPS), &config, &f->world),
               "world");
    memset(&def, 0, sizeof def);
    def.mesh = &f->meshes[FUZZ_MESHES - 1];
    def.stationary = true;
    def.position.c[2] = -3 * ((int64_t)1 << 32);
    lab_expect(carom_body_add(f->world, &def), "surface");
    for (int i = 0; i < bodies; i++) {
        fuzz_body_def(f, &def);
        (void)carom_body_add(f->world, &def);
    }
}

void fuzz_begin(struct fuzz *f, uint64_t seed, int bodies)
{
    f->chance = (struct chance){.r.state = seed * 0x9e3779b97f4a7c15u};
    f->searches = INT_MAX;
    begin(f, bodies);
}

void fuzz_begin_bytes(struct fuzz *f, const uint8_t *bytes, size_t count)
{
    f->chance = (struct chance){.bytes = bytes, .left = count};
    f->searches = 0;
    begin(f, fuzz_pick(f, 4));
}

const char *fuzz_try(struct fuzz *f, int (*call)(struct fuzz *f), int *result)
{
    const uint64_t before = carom_world_hash(f->world);

    *result = call(f);
    return *result >= 0                           ? NULL
           : *result < CAROM_ERR_JOINTS_FULL      ? "no error of carom.h"
           : carom_world_hash(f->world) != before ? "an error that changed the world"
                                                  : NULL;
}

/* A step may only lack room, or find a body too fast beside too large a mesh. */
const char *fuzz_try_step(struct carom_world *world, int *result)
{
    const uint64_t before = carom_world_hash(world);

    *result = carom_world_step(world);
    if (*result >= 0) {
        return NULL;
    }
    if (*result != CAROM_ERR_PAIRS_FULL && *result != CAROM_ERR_CONTACTS_FULL &&
        *result != CAROM_ERR_FACES_FULL && *result != CAROM_ERR_RANGE) {
        return "no error of a step";
    }
    return carom_world_hash(world) == before ? NULL : "a step that failed changed the world";
}

void fuzz_end(struct fuzz *f)
{
    for (int i = 0; i < FUZZ_MESHES; i++) {
        free(f->mesh_block[i]);
    }
    free(f->block);
    free(f->workspace);
    free(f->pixels);
    free(f->others);
}
