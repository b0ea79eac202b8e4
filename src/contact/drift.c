/* SPDX-License-Identifier: MIT */
/* The drift at a contact: how a surface or a body that the caller moves goes there. */
#include "contact.h"

void contact_drift(const struct boyse_pair *pair, const struct candidate *key,
                   const carom_v3_q40 *arm, carom_v3_q40 *drift)
{
    const struct body *b = pair->b;
    const struct mesh_moving *surface;
    carom_v3_q22 at;
    int64_t local[3];

    *drift = (carom_v3_q40){{0, 0, 0}};
    if (body_travels(b)) {
        body_route_velocity(b, arm, drift);
        return;
    }
    if (mesh_drift_most(b->def.mesh) == 0) {
        return;
    }
    surface = b->def.mesh->surface->does;
    fix_rotate_back(local, &b->path.start.r, arm->c);
    for (int k = 0; k < 3; k++) {
        at.c[k] = (int32_t)carom_round(local[k], 18);
    }
    if (key->kind == CANDIDATE_VERTEX_FACE) {
        surface->drift_face(b->def.mesh, key->j, &at, drift);
    } else if (key->kind == CANDIDATE_FACE_VERTEX) {
        surface->drift_vertex(b->def.mesh, key->i, drift);
    } else {
        surface->drift_edge(b->def.mesh, key->j, &at, drift);
    }
    fix_rotate(drift->c, &b->path.start.r, drift->c);
}

/* True if a contact in the list uses that drift. */
static bool is_kept(const struct contact_list *list, const carom_v3_q40 *drift)
{
    for (uint32_t i = 0; i < list->pool->used; i++) {
        if (list->contacts[i].drift == drift) {
            return true;
        }
    }
    return false;
}

/* Contacts may be removed, moved or copied over: a drift that none of them uses is free. */
void contact_keep_drift(struct contact_list *list, struct contact *c, const carom_v3_q40 *drift,
                        const struct contact_mixed *mixed)
{
    c->drift = NULL;
    if (!mixed && (drift->c[0] | drift->c[1] | drift->c[2]) == 0) {
        return;
    }
    while (is_kept(list, &list->drifts[list->next_drift])) {
        list->next_drift = (uint16_t)((list->next_drift + 1u) % list->pool->size);
    }
    c->drift = &list->drifts[list->next_drift];
    *c->drift = *drift;
    if (list->mixed) {
        list->mixed[list->next_drift] = mixed ? *mixed : (struct contact_mixed){-1, 0};
    }
}

void contact_hold_drift(struct contact *c, int64_t rise_q40)
{
    for (int k = 0; k < 3; k++) {
        int64_t rise = fix_mul(rise_q40, c->normal.c[k], 30);

        c->drift->c[k] -= rise;
        contact_velocity(c)->c[k] += rise;
    }
}
