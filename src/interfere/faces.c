/* SPDX-License-Identifier: MIT */
/* The list of interfering faces, its order, and the order of candidates. */
#include "../num/sort.h"
#include "narrow.h"

int candidate_compare(const struct candidate *a, const struct candidate *b)
{
    if (a->pair != b->pair) {
        return a->pair < b->pair ? -1 : 1;
    }
    if (a->kind != b->kind) {
        return a->kind < b->kind ? -1 : 1;
    }
    if (a->i != b->i) {
        return a->i < b->i ? -1 : 1;
    }
    return a->j < b->j ? -1 : a->j > b->j;
}

static uint32_t face_key(struct carom_face_ref f)
{
    return (uint32_t)f.body << 16 | f.face;
}

SORT_DEFINE(sort_faces, struct carom_face_ref, face_key)

void interfere_finish(struct interfere *in)
{
    struct carom_face_ref *f = in->faces;
    uint32_t n = in->face_pool->used, kept = 0;

    sort_faces(f, n);
    for (uint32_t i = 0; i < n; i++) {
        if (kept == 0 || face_key(f[i]) != face_key(f[kept - 1])) {
            f[kept++] = f[i];
        }
    }
    in->face_pool->used = kept;
    if (kept > in->face_pool->peak) {
        in->face_pool->peak = kept;
    }
}

static bool face_before(const void *record, const void *key)
{
    return face_key(*(const struct carom_face_ref *)record) <
           face_key(*(const struct carom_face_ref *)key);
}

/* True if the sorted list contains the face. */
static bool has_face(const struct interfere *in, struct carom_face_ref face)
{
    uint32_t used = in->face_pool->used;
    uint32_t place = sort_lower_bound(in->faces, used, sizeof *in->faces, &face, face_before);

    return place < used && face_key(in->faces[place]) == face_key(face);
}

/* True if the face is one of the last INTERFERE_LAST_FACES in the list. */
static bool is_among_last(const struct interfere *in, struct carom_face_ref face)
{
    uint32_t used = in->face_pool->used,
             first = used > INTERFERE_LAST_FACES ? used - INTERFERE_LAST_FACES : 0;

    for (uint32_t i = used; i-- > first;) {
        if (face_key(in->faces[i]) == face_key(face)) {
            return true;
        }
    }
    return false;
}

static void add_face(struct interfere *in, uint16_t body, uint16_t face)
{
    struct carom_face_ref ref = {body, face};
    struct pool *pool = in->face_pool;

    if (is_among_last(in, ref)) {
        return;
    }
    if (pool->used == pool->size) {
        interfere_finish(in); /* a full list is mostly repetitions */
        if (has_face(in, ref)) {
            return;
        }
    }
    if (pool->used == pool->size) {
        pool->refused++;
        in->error = CAROM_ERR_FACES_FULL;
        return;
    }
    in->faces[pool->used++] = ref;
}

/* The face that owns a vertex: the first one that has it as a corner, see mesh/edge.c. */
static uint16_t owner_of_vertex(const struct carom_mesh *mesh, uint32_t v)
{
    uint16_t first = CAROM_NO_FACE; /* comes after all faces */

    for (uint32_t r = mesh->ring_start[v]; r < mesh->ring_start[v + 1]; r++) {
        const struct carom_edge *edge = &mesh->edges[mesh->ring[r] >> 1];

        first = edge->face[0] < first ? edge->face[0] : first;
        first = edge->face[1] < first ? edge->face[1] : first;
    }
    return first;
}

void interfere_note_faces(struct interfere *in, const struct interfere_pairs *all,
                          const struct candidate *c, uint32_t n)
{
    for (uint32_t i = 0; i < n && !in->error; i++) {
        const struct pair *p = &all->pairs[c[i].pair];
        const struct carom_mesh *a = all->bodies[p->a].def.mesh, *b = all->bodies[p->b].def.mesh;
        uint16_t of_a, of_b;

        if (c[i].kind == CANDIDATE_EDGE_EDGE) {
            of_a = a->edges[c[i].i].face[0]; /* which owns it */
            of_b = b->edges[c[i].j].face[0];
        } else if (c[i].kind == CANDIDATE_VERTEX_FACE) {
            of_a = owner_of_vertex(a, c[i].i);
            of_b = (uint16_t)c[i].j;
        } else {
            of_a = (uint16_t)c[i].j;
            of_b = owner_of_vertex(b, c[i].i);
        }
        add_face(in, p->a, of_a);
        add_face(in, p->b, of_b);
    }
}
