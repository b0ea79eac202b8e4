/* SPDX-License-Identifier: MIT */
/* Materials and masses of bodies, which may change between steps. */
#include "world.h"

#define SURFACE_SPEED_LIMIT 16 /* units a frame, for each component of a surface velocity */

static bool material_in_range(const struct carom_material *m)
{
    return m->restitution_q30 >= 0 && m->restitution_q30 <= CAROM_ONE_Q30 &&
           m->friction_q16 <= CAROM_MU_MAX_Q16 && m->rolling_q16 <= 1 << 16 &&
           world_each_within(m->surface_velocity.c, (int64_t)SURFACE_SPEED_LIMIT << 40);
}

static struct carom_material material_of(const struct body *b)
{
    struct carom_material m;

    memset(&m, 0, sizeof m);
    m.restitution_q30 = b->def.restitution_q30;
    m.friction_q16 = b->def.friction_q16;
    m.rolling_q16 = b->def.extra ? b->def.extra->rolling_q16 : BODY_ROLLING_Q16;
    if (b->def.extra) {
        m.surface_velocity = b->def.extra->surface_velocity;
    }
    return m;
}

static bool needs_extra(const struct carom_material *m)
{
    const int64_t *v = m->surface_velocity.c;

    return m->rolling_q16 != BODY_ROLLING_Q16 || (v[0] | v[1] | v[2]) != 0;
}

/* A body's material has changed: forget its kept impulses and wake its neighbours. */
static void stir(struct carom_world *w, uint32_t body)
{
    world_forget_impulses(w, body); /* they may exceed the new friction */
    world_wake_around(w, body);
}

int carom_body_set_material(struct carom_world *w, int body, const struct carom_material *material)
{
    struct carom_material now;
    struct body *b;

    if (!w || !material) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    if (!material_in_range(material)) {
        return CAROM_ERR_ARGUMENT;
    }
    b = &w->bodies[body];
    now = material_of(b);
    if (now.restitution_q30 == material->restitution_q30 &&
        now.friction_q16 == material->friction_q16 && now.rolling_q16 == material->rolling_q16 &&
        memcmp(&now.surface_velocity, &material->surface_velocity, sizeof now.surface_velocity) ==
            0) {
        return CAROM_OK;
    }
    if (needs_extra(material) && !world_extra(w, (uint32_t)body)) {
        return CAROM_ERR_EXTRAS_FULL;
    }
    b->def.restitution_q30 = material->restitution_q30;
    b->def.friction_q16 = material->friction_q16;
    w->rest.list.materials = contact_mix_materials;
    if (b->def.extra) {
        b->def.extra->rolling_q16 = material->rolling_q16;
        b->def.extra->surface_velocity = material->surface_velocity;
    }
    stir(w, (uint32_t)body);
    return CAROM_OK;
}

int carom_body_material(const struct carom_world *w, int body, struct carom_material *material)
{
    if (!w || !material) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    *material = material_of(&w->bodies[body]);
    return CAROM_OK;
}

/* True if all materials of an array are in range, and each face of a mesh has one of them. */
static bool materials_in_range(const struct carom_mesh *mesh, const struct carom_material *m,
                               uint32_t count, const uint8_t *of_face)
{
    bool good = count >= 1 && count <= 256;

    for (uint32_t i = 0; good && i < count; i++) {
        good = material_in_range(&m[i]);
    }
    for (uint32_t i = 0; good && i < mesh->raw.face_count; i++) {
        good = of_face[i] < count;
    }
    return good;
}

/* Set a body's materials by face, with their largest e and mu. */
static void take_materials(struct body_extra *extra, const struct carom_material *materials,
                           uint32_t count, const uint8_t *of_face)
{
    extra->materials = materials;
    extra->face_material = of_face;
    extra->most_restitution_q30 = 0;
    extra->most_friction_q16 = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct carom_material *m = &materials[i];

        extra->most_restitution_q30 = fix_larger(extra->most_restitution_q30, m->restitution_q30);
        if (m->friction_q16 > extra->most_friction_q16) {
            extra->most_friction_q16 = m->friction_q16;
        }
    }
}

int carom_body_set_face_materials(struct carom_world *w, int body,
                                  const struct carom_material *materials, uint32_t count,
                                  const uint8_t *of_face)
{
    struct body *b;

    if (!w || (materials && !of_face)) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    b = &w->bodies[body];
    if (materials && !materials_in_range(b->def.mesh, materials, count, of_face)) {
        return CAROM_ERR_ARGUMENT;
    }
    if (materials && !world_extra(w, (uint32_t)body)) {
        return CAROM_ERR_EXTRAS_FULL;
    }
    w->rest.list.materials = contact_mix_materials;
    if (b->def.extra) {
        take_materials(b->def.extra, materials, materials ? count : 0, materials ? of_face : NULL);
        stir(w, (uint32_t)body);
    }
    return CAROM_OK;
}

int carom_world_set_combine(struct carom_world *w, enum carom_combine restitution,
                            enum carom_combine friction)
{
    if (!w) {
        return CAROM_ERR_NULL;
    }
    if ((unsigned)restitution > CAROM_MEAN || (unsigned)friction > CAROM_MEAN) {
        return CAROM_ERR_ARGUMENT;
    }
    if (w->rest.list.restitution_rule != restitution || w->rest.list.friction_rule != friction) {
        w->rest.list.restitution_rule = restitution & 3u;
        w->rest.list.friction_rule = friction & 3u;
        w->now->warm_count = 0; /* they may exceed the new friction */
        world_wake_all(w);
    }
    return CAROM_OK;
}

/*
 * Change the momenta so that the motion stays with another mass. Returns false if they do not fit.
 */
static bool change_mass(const struct body *from, const struct body *to, struct body_state *s)
{
    for (int k = 0; k < 3; k++) {
        int64_t l_q40 = fix_mul_scaled(s->angular.c[k], from->def.inverse_mass);

        /*
         * the product with the mass, at most 2^10, must fit; a thin body about its axis stays below
         */
        if (carom_abs(l_q40) >> 51 != 0) {
            return false;
        }
        s->angular.c[k] = fix_mul_scaled(l_q40, to->def.mass);
        s->momentum.c[k] =
            fix_mul_scaled(fix_mul_scaled(s->momentum.c[k], from->def.inverse_mass), to->def.mass);
    }
    return world_in_range(to, s);
}

int carom_body_set_mass(struct carom_world *w, int body, uint32_t mass_q20)
{
    struct body_state state;
    struct carom_forces forces;
    struct body changed;
    int result;

    if (!w) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    changed = w->bodies[body];
    if (!changed.def.moving) {
        return CAROM_ERR_ARGUMENT;
    }
    result = world_set_mass(&changed, mass_q20);
    if (result < 0 || (changed.def.mass.m == w->bodies[body].def.mass.m &&
                       changed.def.mass.e == w->bodies[body].def.mass.e)) {
        return result;
    }
    state = world_now(w)->bodies[body];
    forces = world_forces(&changed);
    if (world_check_forces(&changed, &w->config.gravity, &forces) < 0 ||
        !change_mass(&w->bodies[body], &changed, &state)) {
        return CAROM_ERR_RANGE;
    }
    w->bodies[body] = changed;
    world_put(w, (uint32_t)body, &state);
    world_forget_impulses(w, (uint32_t)body);
    world_wake_island(w, (uint32_t)body);
    return CAROM_OK;
}

int carom_body_mass(const struct carom_world *w, int body, uint32_t *mass_q20)
{
    if (!w || !mass_q20) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(w, &body)) {
        return CAROM_ERR_BODY;
    }
    *mass_q20 = w->bodies[body].def.moving
                    ? (uint32_t)fix_mul_scaled((int64_t)1 << 20, w->bodies[body].def.mass)
                    : 0;
    return CAROM_OK;
}
