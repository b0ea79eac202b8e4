/* SPDX-License-Identifier: MIT */
/*
 * The paper's interference detection in place of Carom's gather. It finds the faces that interfere
 * at the end of the frame, and gives each pair with all its vertices and edges to Boyse's test of
 * the way there.
 *
 * Programs are linked with -Wl,--wrap=interfere_leaves, so this file replaces the gather of a
 * pair's leaves; and likewise interfere_note_faces.
 */
#include "paper.h"
#include "interfere/narrow.h"

void __real_interfere_leaves(struct interfere *w);
void __wrap_interfere_leaves(struct interfere *w);
void __real_interfere_note_faces(struct interfere *w, const struct interfere_pairs *all,
                                 const struct candidate *c, uint32_t n);
void __wrap_interfere_note_faces(struct interfere *w, const struct interfere_pairs *all,
                                 const struct candidate *c, uint32_t n);

struct gather {
    struct paper_visitor base;
    struct interfere *w;
};

/* Whether an edge is convex: then one of its faces owns it. */
static bool edge_counts(const struct carom_mesh *mesh, uint32_t edge)
{
    for (int side = 0; side < 2; side++) {
        uint16_t face = mesh->edges[edge].face[side];

        for (int k = 0; k < 3 && face != CAROM_NO_FACE; k++) {
            if (mesh->faces[face].edge[k] == edge && mesh->faces[face].own & 8 << k) {
                return true;
            }
        }
    }
    return false;
}

static bool vertex_counts(const struct carom_mesh *mesh, uint32_t v)
{
    for (uint32_t i = mesh->ring_start[v]; i < mesh->ring_start[v + 1]; i++) {
        if (edge_counts(mesh, mesh->ring[i] >> 1)) {
            return true;
        }
    }
    return false;
}

static void visit_pair(struct paper_visitor *self, uint16_t face_a, uint16_t face_b)
{
    struct interfere *w = ((struct gather *)self)->w;
    const struct carom_mesh *ma = w->a->def.mesh, *mb = w->b->def.mesh;

    for (int i = 0; i < 3; i++) {
        uint32_t vertex_a = ma->raw.faces[face_a][i], vertex_b = mb->raw.faces[face_b][i];

        if (vertex_counts(ma, vertex_a)) {
            interfere_emit(w, CANDIDATE_VERTEX_FACE, vertex_a, face_b);
        }
        if (vertex_counts(mb, vertex_b)) {
            interfere_emit(w, CANDIDATE_FACE_VERTEX, vertex_b, face_a);
        }
        for (int j = 0; j < 3 && edge_counts(ma, ma->faces[face_a].edge[i]); j++) {
            if (edge_counts(mb, mb->faces[face_b].edge[j])) {
                interfere_emit(w, CANDIDATE_EDGE_EDGE, ma->faces[face_a].edge[i],
                               mb->faces[face_b].edge[j]);
            }
        }
    }
}

/* Both bodies at the end of the time for which the pair is gathered, seen from the middle of a. */
static void gather_pair(struct interfere *w)
{
    struct body_sweep a, b;
    struct paper_placed placed_a = {w->a->def.mesh, &a.end, {0, 0, 0}};
    struct paper_placed placed_b = {w->b->def.mesh, &b.end, {0, 0, 0}};
    struct gather gather = {{visit_pair}, w};

    body_region_sweep(&w->a->search.region, w->span.from_a_q30, w->span.time_q30, &a);
    body_region_sweep(&w->b->search.region, w->span.from_b_q30, w->span.time_q30, &b);
    for (int k = 0; k < 3; k++) {
        int64_t at_q32 = b.at.c[k] - a.at.c[k] + ((b.way.c[k] - a.way.c[k]) >> 8);

        if (carom_abs(at_q32) > (int64_t)512 << 32) {
            return;
        }
        placed_b.at_q20[k] = (int32_t)(at_q32 >> 12);
    }
    paper_pairs(&placed_a, &placed_b, &gather.base);
}

/* A query asks for faces, not for candidates, so Carom's own code answers it. */
void __wrap_interfere_leaves(struct interfere *w)
{
    if (w->meet == interfere_features) {
        gather_pair(w);
    } else {
        __real_interfere_leaves(w);
    }
}

/*
 * For bodies deep in each other this method names many more faces than Carom's. Faces beyond the
 * list's room are left out.
 */
void __wrap_interfere_note_faces(struct interfere *w, const struct interfere_pairs *all,
                                 const struct candidate *c, uint32_t n)
{
    const struct pool *pool = w->face_pool;

    for (uint32_t i = 0; i < n; i++) {
        if (pool->size - pool->used < 2) {
            interfere_finish(w);
        }
        if (pool->size - pool->used >= 2) {
            __real_interfere_note_faces(w, all, &c[i], 1);
        }
    }
}
