/* SPDX-License-Identifier: MIT */
/*
 * An island in the air that goes through a frame as one rigid body: the last resort where its
 * contacts gained energy that its bodies' motion against each other does not have. The frame is
 * undone for it; no other island notices.
 */
#include "../solve/rigid.h"
#include "parts.h"

static const struct body_state *before(const struct step *s, uint32_t i)
{
    return &world_now(s->w)->bodies[i];
}

/* True if the island's bodies were awake when the frame began, and have one acceleration. */
static bool fall_alike(const struct step *s, uint32_t first)
{
    const struct carom_world *w = s->w;
    const carom_v3_q40 *pull = &w->bodies[first].def.acceleration;

    for (uint32_t i = first; i != ISLAND_END; i = w->bodies[i].island.next) {
        const struct body *b = &w->bodies[i];

        if (!broad_active(b, before(s, i)) || !broad_active(b, &s->next->bodies[i]) ||
            memcmp(&b->def.acceleration, pull, sizeof *pull) != 0) {
            return false;
        }
    }
    return true;
}

/* Radius of a sphere around the island's centre that holds all of its bodies. */
static int64_t island_radius_q22(const struct step *s, const struct rest_rigid *rigid)
{
    int64_t radius_q22 = 0;

    for (uint32_t i = rigid->first; i != ISLAND_END; i = s->w->bodies[i].island.next) {
        int64_t arm_q32[3], far_q22;

        for (int k = 0; k < 3; k++) {
            arm_q32[k] = before(s, i)->position.c[k] - rigid->centre.c[k];
        }
        far_q22 = (fix_length_bound(arm_q32) >> 10) + 1 + s->w->bodies[i].def.radius_q22;
        radius_q22 = far_q22 > radius_q22 ? far_q22 : radius_q22;
    }
    return radius_q22;
}

/* A sphere and the way that it goes. */
struct sphere {
    int64_t from_q32[3], way_q32[3], radius_q22;
};

/* True if the box around a sphere's way stays apart from a box. */
static bool passes(const struct sphere *s, const int64_t low_q22[3], const int64_t high_q22[3])
{
    for (int k = 0; k < 3; k++) {
        int64_t from_q22 = s->from_q32[k] >> 10, to_q22 = (s->from_q32[k] + s->way_q32[k]) >> 10;

        if ((from_q22 > to_q22 ? from_q22 : to_q22) + s->radius_q22 + 1 < low_q22[k] ||
            (from_q22 < to_q22 ? from_q22 : to_q22) - s->radius_q22 > high_q22[k]) {
            return true;
        }
    }
    return false;
}

/* The sphere around the island. */
static struct sphere around_island(const struct step *s, const struct rest_rigid *rigid)
{
    const int64_t *pull = s->w->bodies[rigid->first].def.acceleration.c;
    struct sphere sphere;

    for (int k = 0; k < 3; k++) {
        sphere.from_q32[k] = rigid->centre.c[k];
        sphere.way_q32[k] = carom_round(rigid->velocity.c[k], 8);
    }
    sphere.radius_q22 = island_radius_q22(s, rigid) + (fix_length_bound(pull) >> 18) + 1;
    return sphere;
}

/* True if a sphere passes a body that stands still: it passes the mesh's box in the body's axes. */
static bool passes_standing(const struct sphere *sphere, const struct body *b,
                            const struct body_state *state)
{
    const struct carom_mesh *mesh = b->def.mesh;
    const int shift = 22 - mesh->raw.quantum_bits;
    struct sphere own = *sphere;
    int64_t low_q22[3], high_q22[3];
    carom_m3_q30 axes;

    fix_matrix(&axes, &state->rotation);
    for (int k = 0; k < 3; k++) {
        own.from_q32[k] -= state->position.c[k];
    }
    fix_rotate_back(own.from_q32, &axes, own.from_q32);
    fix_rotate_back(own.way_q32, &axes, own.way_q32);
    for (int k = 0; k < 3; k++) {
        own.from_q32[k] += carom_shl(mesh->mass.centre.c[k], 10);
        low_q22[k] = carom_shl(mesh->box[0][k], shift);
        high_q22[k] = carom_shl(mesh->box[1][k], shift);
    }
    own.radius_q22 += 8; /* roundings of the axes */
    return passes(&own, low_q22, high_q22);
}

/*
 * True if a sphere passes a body that moved. Where it was between start and end is not kept: it may
 * have been beside the way, and a part as long as the way is left for that. One that bounced farther
 * may have been in the island's way; at the end of the frame it is not.
 */
static bool passes_moved(const struct sphere *sphere, const struct body *b,
                         const struct body_state *from, const struct body_state *to)
{
    int64_t way_q32[3], low_q22[3], high_q22[3], room_q22;

    for (int k = 0; k < 3; k++) {
        way_q32[k] = to->position.c[k] - from->position.c[k];
    }
    room_q22 = b->def.radius_q22 + (fix_length_bound(way_q32) >> 10) + 1;
    for (int k = 0; k < 3; k++) {
        bool up = way_q32[k] > 0;

        low_q22[k] = ((up ? from : to)->position.c[k] >> 10) - room_q22;
        high_q22[k] = ((up ? to : from)->position.c[k] >> 10) + room_q22;
    }
    return passes(sphere, low_q22, high_q22);
}

/* True if no other body was or is where the island may go. */
static bool is_clear(const struct step *s, const struct rest_rigid *rigid)
{
    const struct carom_world *w = s->w;
    const struct sphere sphere = around_island(s, rigid);

    for (uint32_t i = 0; i < w->body_count; i++) {
        const struct body *b = &w->bodies[i];

        if (b->def.mesh && !b->def.sensor &&
            b->island.lowest != w->bodies[rigid->first].island.lowest &&
            !(b->def.goes ? passes_moved(&sphere, b, before(s, i), &s->next->bodies[i])
                          : passes_standing(&sphere, b, before(s, i)))) {
            return false;
        }
    }
    return true;
}

/*
 * Find the rigid motion that an island had when the frame began. False if it cannot go through the
 * frame with it.
 */
static FIX_OWN_FRAME bool may_go(struct step *s, uint32_t first, struct rest_rigid *rigid)
{
    struct carom_world *w = s->w;
    bool found;

    if (!fall_alike(s, first)) {
        return false;
    }
    w->rest.states = w->now->bodies;
    found = rest_rigid_motion(&w->rest, first, rigid);
    w->rest.states = s->next->bodies;
    return found && fix_length_bound(rigid->spin.c) <= STEP_AS_ONE_SPIN_MAX_Q40 &&
           is_clear(s, rigid);
}

bool step_go_as_one(struct step *s, uint32_t first)
{
    struct carom_world *w = s->w;
    struct rest_rigid rigid;

    if (!may_go(s, first, &rigid)) {
        return false;
    }
    for (uint32_t i = first; i != ISLAND_END; i = w->bodies[i].island.next) {
        struct body_state *state = &s->next->bodies[i];

        state->position = before(s, i)->position;
        state->rotation = before(s, i)->rotation;
        state->momentum = before(s, i)->momentum;
        state->angular = before(s, i)->angular;
    }
    rest_go_rigid(&w->rest, &rigid, &w->bodies[first].def.acceleration);
    w->stats.calmed++;
    w->regions_stale = true; /* its path did not stay in its regions */
    return true;
}
