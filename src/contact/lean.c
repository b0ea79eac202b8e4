/* SPDX-License-Identifier: MIT */
/*
 * Faces that lie on each other. Where their borders cross, N is along the product of two edges in
 * nearly the same plane, which leans by what the faces are off parallel over the sine of the edges'
 * angle. Under a heavy body that squeezes a light one out.
 */
#include "contact.h"

/* World normals of the faces at an edge; returns how many. */
static int faces_at(const struct body *b, const struct carom_edge *edge, int32_t normal[2][3])
{
    int count = edge->face[1] == CAROM_NO_FACE ? 1 : 2;

    for (int i = 0; i < count; i++) {
        carom_rotate(normal[i], &b->path.start.r, b->mesh->faces[edge->face[i]].normal.c);
    }
    return count;
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

void contact_flatten(const struct boyse_pair *pair, const struct candidate *c, carom_v3_q30 *normal)
{
    const struct body *a = pair->a, *b = pair->b;
    int32_t of_a[2][3], of_b[2][3];
    int m, n;

    if (c->kind != CANDIDATE_EDGE_EDGE) {
        return;
    }
    m = faces_at(a, &a->mesh->edges[c->i], of_a);
    n = faces_at(b, &b->mesh->edges[c->j], of_b);
    for (int i = 0; i < m; i++) {
        for (int j = 0; j < n; j++) {
            if (opposite(of_a[i], of_b[j]) &&
                carom_dot(of_b[j], normal->c) >> 30 > CONTACT_SAME_NORMAL_Q30) {
                memcpy(normal->c, of_b[j], sizeof normal->c);
                return;
            }
        }
    }
}
