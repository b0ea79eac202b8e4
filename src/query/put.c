/* SPDX-License-Identifier: MIT */
/* A mesh that belongs to no world: a body of it in a pose, and the bodies it overlaps. */
#include "query.h"
#include "cross.h"

int query_put(const struct carom_query_mesh *mesh, struct body *body, struct body_state *state)
{
    memset(body, 0, sizeof *body);
    memset(state, 0, sizeof *state);
    state->position = mesh->position;
    state->rotation = mesh->rotation;
    if (mesh->mesh->raw.kind != CAROM_SOLID || !world_rotation_valid(&state->rotation)) {
        return CAROM_ERR_ARGUMENT;
    }
    if (!world_position_in_range(&mesh->position) || mesh->mesh->radius_q22 > BODY_RADIUS_MAX_Q22 ||
        mesh->mesh->radius_q22 < BODY_RADIUS_MIN_Q22) {
        return CAROM_ERR_RANGE;
    }
    body->def.mesh = mesh->mesh;
    body->def.moving = true;
    body->def.radius_q22 = mesh->mesh->radius_q22;
    body->def.skin_q22 = body->def.radius_q22 >> 11 > 256 ? body->def.radius_q22 >> 11 : 256;
    return CAROM_OK;
}

/* True if the boxes around two spheres are apart. */
static bool spheres_apart(const struct body *a, const struct body_state *at_a, const struct body *b,
                          const struct body_state *at_b)
{
    int64_t reach_q32 = ((int64_t)a->def.radius_q22 + b->def.radius_q22) << 10;

    for (int k = 0; k < 3; k++) {
        if (carom_abs(at_a->position.c[k] - at_b->position.c[k]) > reach_q32) {
            return true;
        }
    }
    return false;
}

bool query_overlaps(struct carom_world *w, const struct body *body, const struct body_state *state,
                    uint32_t other)
{
    const struct interfere_placed a = {body, state};
    const struct interfere_placed b = {&w->bodies[other], &world_now(w)->bodies[other]};
    struct cross c;

    /* under a surface counts as inside, however deep */
    if (b.body->def.mesh->raw.kind == CAROM_SOLID && spheres_apart(body, state, b.body, b.state)) {
        return false;
    }
    cross_begin(&c, a, b);
    return interfere_query_sure(&w->interfere, a, b, &c.base) || cross_inside(&c) ||
           (b.body->def.mesh->raw.kind == CAROM_SOLID && cross_around(&c));
}

int carom_overlap_mesh(struct carom_world *world, const struct carom_query_mesh *mesh,
                       const struct carom_query_filter *filter, uint16_t *bodies, uint32_t room)
{
    struct body body;
    struct body_state state;
    uint32_t count = 0;
    int result;

    if (!world || !mesh || !mesh->mesh || (!bodies && room > 0)) {
        return CAROM_ERR_NULL;
    }
    result = query_put(mesh, &body, &state);
    if (result < 0) {
        return result;
    }
    for (uint32_t i = 0; i < world->body_count; i++) {
        if (query_wants(world, filter, i) && query_overlaps(world, &body, &state, i)) {
            if (count == room) {
                return CAROM_ERR_BODIES_FULL;
            }
            bodies[count++] = (uint16_t)i;
        }
    }
    return (int)count;
}
