/* SPDX-License-Identifier: MIT */
/*
 * Faces that lie on each other. Where their borders cross, N is along the product of two edges in
 * nearly the same plane, and leans by the faces' angle over the sine of the edges' angle. Under a
 * heavy body that would squeeze a light one out.
 */
#include "contact.h"

/* A face's normal in world axes. */
static void normal_of(const struct body *b, uint16_t face, int32_t normal[3])
{
    carom_rotate(normal, &b->path.start.r, b->def.mesh->faces[face].normal.c);
}

static bool opposite(const int32_t a[3], const int32_t b[3])
{
    for (int k = 0; k < 3; k++) {
        if (carom_abs((int64_t)a[k] + b[k]) > CONTACT_LEAN_MAX_Q30) {
            return false;
        }
    }
    return true;
}

/*
 * Set the world normals of b's faces at an edge that are nearly N, seen from the side of N if the
 * faces have two; returns how many.
 */
static int nearly_along(const struct body *b, const struct carom_edge *edge,
                        const carom_v3_q30 *normal, int32_t along[2][3])
{
    int count = 0;

    for (int side = 0; side < 2; side++) {
        int32_t *own = along[count];
        int64_t cosine_q30;

        if (edge->face[side] == CAROM_NO_FACE) {
            continue;
        }
        normal_of(b, edge->face[side], own);
        cosine_q30 = carom_dot(own, normal->c) >> 30;
        if (cosine_q30 < 0 && mesh_two_sided(b->def.mesh)) {
            cosine_q30 = -cosine_q30;
            for (int k = 0; k < 3; k++) {
                own[k] = -own[k];
            }
        }
        count += cosine_q30 > CONTACT_SAME_NORMAL_Q30;
    }
    return count;
}

void contact_flatten(const struct boyse_pair *pair, const struct candidate *c, carom_v3_q30 *normal)
{
    const struct carom_edge *edge;
    int32_t of_a[3], of_b[2][3];
    int n;

    if (c->kind != CANDIDATE_EDGE_EDGE) {
        return;
    }
    n = nearly_along(pair->b, &pair->b->def.mesh->edges[c->j], normal, of_b);
    edge = &pair->a->def.mesh->edges[c->i]; /* of a body that moves, so of a solid */
    for (int side = 0; n > 0 && side < 2; side++) {
        normal_of(pair->a, edge->face[side], of_a);
        for (int j = 0; j < n; j++) {
            if (opposite(of_a, of_b[j])) {
                memcpy(normal->c, of_b[j], sizeof normal->c);
                return;
            }
        }
    }
}
