/* SPDX-License-Identifier: MIT */
/* How a surface that the caller moves does so at a contact. */
#include "contact.h"

void contact_drift(const struct boyse_pair *pair, const struct candidate *key,
                   const carom_v3_q40 *arm, carom_v3_q40 *drift)
{
    const struct body *b = pair->b;
    const struct mesh_moving *surface;
    carom_v3_q22 at;
    int64_t local[3];

    *drift = (carom_v3_q40){{0, 0, 0}};
    if (mesh_drift_most(b->mesh) == 0) {
        return;
    }
    surface = b->mesh->surface->does;
    fix_rotate_back(local, &b->path.start.r, arm->c);
    for (int k = 0; k < 3; k++) {
        at.c[k] = (int32_t)carom_round(local[k], 18);
    }
    if (key->kind == CANDIDATE_VERTEX_FACE) {
        surface->drift_face(b->mesh, key->j, &at, drift);
    } else if (key->kind == CANDIDATE_FACE_VERTEX) {
        surface->drift_vertex(b->mesh, key->i, drift);
    } else {
        surface->drift_edge(b->mesh, key->j, &at, drift);
    }
    fix_rotate(drift->c, &b->path.start.r, drift->c);
}
