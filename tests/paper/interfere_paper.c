/* SPDX-License-Identifier: MIT */
/*
 * The paper's way in place of Carom's gather: the faces that interfere where the frame ends, each
 * pair with all its vertices and edges, for Boyse's test of the way there.
 *
 * Programs are linked with -Wl,--wrap=interfere_visit, so what asks for interfere_visit gets this.
 */
#include "paper.h"
#include "interfere/narrow.h"

int __wrap_interfere_visit(struct interfere *w, const struct body *bodies, const struct pair *pairs,
                           uint32_t pair_count, struct candidate_visitor *visitor);

struct gather {
    struct paper_visitor base;
    struct interfere *w;
};

#define CANDIDATES 65536

/* They do not fit the pools of a world. What finds no room here is missed. */
static struct {
    struct candidate candidate[CANDIDATES];
    uint32_t count;
} found;

static void emit(struct interfere *w, uint8_t kind, uint32_t i, uint32_t j)
{
    if (found.count < CANDIDATES) {
        found.candidate[found.count++] = (struct candidate){w->pair, kind, i, j};
        w->candidate_count++;
    }
}

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
    const struct carom_mesh *ma = w->a->mesh, *mb = w->b->mesh;

    interfere_add_face(w, w->body_a, face_a);
    interfere_add_face(w, w->body_b, face_b);
    for (int i = 0; i < 3; i++) {
        uint32_t vertex_a = ma->raw.faces[face_a][i], vertex_b = mb->raw.faces[face_b][i];

        if (vertex_counts(ma, vertex_a)) {
            emit(w, CANDIDATE_VERTEX_FACE, vertex_a, face_b);
        }
        if (vertex_counts(mb, vertex_b)) {
            emit(w, CANDIDATE_FACE_VERTEX, vertex_b, face_a);
        }
        for (int j = 0; j < 3 && edge_counts(ma, ma->faces[face_a].edge[i]); j++) {
            if (edge_counts(mb, mb->faces[face_b].edge[j])) {
                emit(w, CANDIDATE_EDGE_EDGE, ma->faces[face_a].edge[i], mb->faces[face_b].edge[j]);
            }
        }
    }
}

/* Both bodies where the path ends, seen from the middle of a. */
static void gather_pair(struct interfere *w)
{
    const struct body_region *a = &w->a->region, *b = &w->b->region;
    const carom_v3_q40 way_a = body_region_way(a), way_b = body_region_way(b);
    carom_m3_q30 start, r_a, r_b;
    struct paper_placed placed_a = {w->a->mesh, &r_a, {0, 0, 0}};
    struct paper_placed placed_b = {w->b->mesh, &r_b, {0, 0, 0}};
    struct gather gather = {{visit_pair}, w};

    body_region_axes(a, &start, &r_a);
    body_region_axes(b, &start, &r_b);
    for (int k = 0; k < 3; k++) {
        int64_t at_q32 = b->at.c[k] - a->at.c[k] + ((way_b.c[k] - way_a.c[k]) >> 8);

        if (carom_abs(at_q32) > (int64_t)512 << 32) {
            return;
        }
        placed_b.at_q20[k] = (int32_t)(at_q32 >> 12);
    }
    paper_pairs(&placed_a, &placed_b, &gather.base);
}

int __wrap_interfere_visit(struct interfere *w, const struct body *bodies, const struct pair *pairs,
                           uint32_t pair_count, struct candidate_visitor *visitor)
{
    if (!w->whole) {
        w->whole = true;
        w->gathers++;
        found.count = 0;
        for (uint32_t i = 0; i < pair_count && !w->error; i++) {
            w->pair = (uint16_t)i;
            w->body_a = pairs[i].a;
            w->body_b = pairs[i].b;
            w->a = &bodies[pairs[i].a];
            w->b = &bodies[pairs[i].b];
            gather_pair(w);
        }
        if (w->error) {
            w->whole = false;
            return w->error;
        }
    }
    visitor->visit(visitor, found.candidate, found.count);
    return CAROM_OK;
}
