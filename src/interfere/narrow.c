/* SPDX-License-Identifier: MIT */
/*
 * Cull a swept leaf against one face of b: by that face's plane, then the leaf's faces by plane and
 * box, then pairs of features; emit the candidates that are left.
 */
#include "narrow.h"

static void place_target(const struct interfere *in, struct target *t)
{
    const struct carom_mesh *mb = in->b->def.mesh;

    const uint16_t *corner = mb->raw.faces[t->number];
    const int32_t *centre = mb->mass.centre.c, x = centre[0], y = centre[1], z = centre[2];
    int shift = 22 - mb->raw.quantum_bits;

    for (int k = 0; k < 3; k++) {
        const int16_t *from = mb->raw.vertices[corner[k]];

        t->p[k].c[0] = (from[0] * (1 << shift) - x) >> 2;
        t->p[k].c[1] = (from[1] * (1 << shift) - y) >> 2;
        t->p[k].c[2] = (from[2] * (1 << shift) - z) >> 2;
    }
}

/* ------------------------------------------------------------------- planes */

/*
 * Set which of the leaf's vertices stay above or below the plane of b's face all span. Returns
 * false if all stay on the same side.
 */
static bool part_by_plane(const struct interfere *in, struct target *t)
{
    const struct interfere_leaf *l = in->leaf;
    const int32_t *n = t->face->normal.c;
    int32_t offset_q18 = t->face->offset_q22 >> 4, reach_q18 = interfere_reach_q18(l, n);
    int32_t above_q18 = offset_q18 + reach_q18, below_q18 = offset_q18 - reach_q18;
    uint32_t over = 0, under = 0, all = UINT32_MAX >> (32 - l->leaf->vertex_count);

    for (const struct interfere_vec *p = &l->p[l->leaf->vertex_count]; p > l->p;) {
        int32_t height_q18;

        p--;
        height_q18 = interfere_dot(n, p->c);
        over = over << 1 | interfere_is_less(above_q18, height_q18);
        under = under << 1 | interfere_is_less(height_q18, below_q18);
    }
    t->over = over;
    t->under = under;
    return over != all && under != all;
}

/* True if the swept box of the leaf's face i meets the box of b's face. */
static inline bool boxes_meet(struct interfere *in, const struct target *t, uint32_t i)
{
    const struct interfere_leaf *l = in->leaf;
    const int32_t *low = l->face_low[i].c, *high = l->face_high[i].c;

    if (!(l->boxed >> i & 1)) {
        interfere_box_face(in, i);
    }
    return low[0] <= t->high.c[0] && high[0] >= t->low.c[0] && low[1] <= t->high.c[1] &&
           high[1] >= t->low.c[1] && low[2] <= t->high.c[2] && high[2] >= t->low.c[2];
}

uint32_t interfere_faces_near(struct interfere *in, const struct target *t)
{
    const struct interfere_leaf *l = in->leaf;
    uint32_t near = 0;

    for (uint32_t i = 0, n = l->leaf->face_count; i < n; i++) {
        uint32_t corners = l->corners[i];

        /* some corner may get below the plane, and some above it */
        if ((corners & ~t->over) != 0 && (corners & ~t->under) != 0 && boxes_meet(in, t, i)) {
            near |= 1u << i;
        }
    }
    return near;
}

/* ----------------------------------------------------------------- features */

/* True if a point of the leaf stays outside the box of b's face all span. */
static bool outside_target(const struct interfere_leaf *l, const struct interfere_vec *p,
                           const struct target *t)
{
    for (int k = 2; k >= 0; k--) {
        if (p->c[k] + l->reach.c[k] < t->low.c[k] || p->c[k] - l->reach.c[k] > t->high.c[k]) {
            return true;
        }
    }
    return false;
}

/* True if a corner of b's face is outside the swept box of the leaf's face i. */
static bool outside_face(const struct interfere_leaf *l, const struct interfere_vec *p, uint32_t i)
{
    const int32_t *low = l->face_low[i].c, *high = l->face_high[i].c;

    return p->c[2] < low[2] || p->c[2] > high[2] || p->c[1] < low[1] || p->c[1] > high[1] ||
           p->c[0] < low[0] || p->c[0] > high[0];
}

/* True if a corner of b's face can reach the plane of the leaf's face i. */
static bool reaches_plane(struct interfere *in, const struct interfere_vec *p, uint32_t i)
{
    const struct interfere_plane *plane = &in->leaf->planes[i];
    int32_t height_q18;

    if (!(in->leaf->placed >> i & 1)) {
        interfere_place_plane(in, i);
    }
    height_q18 = interfere_dot(plane->n_q30, p->c);
    return height_q18 <= plane->above_q18 && height_q18 >= plane->below_q18;
}

/* True if two coordinates are both below or both above an interval. */
static inline bool both_beside(int32_t p, int32_t q, int32_t low, int32_t high)
{
    return p < low ? q < low : p > high && q > high;
}

/* Emit vertices that the leaf owns against b's face. */
static void vertices_face(struct interfere *in, const struct target *t)
{
    const struct interfere_leaf *l = in->leaf;
    uint32_t left = l->leaf->owned & ~(t->over | t->under);

    for (uint32_t at = 0; left != 0; at++, left >>= 1) {
        if ((left & 1) && !outside_target(l, &l->p[at], t) && interfere_vertex_face(in, t, at)) {
            interfere_emit(in, CANDIDATE_VERTEX_FACE, interfere_vertex(in, at), t->number);
        }
    }
}

/* Emit corner k of b's face against the leaf's faces `near`, a bit each. */
static void face_vertex(struct interfere *in, const struct target *t, int k, uint32_t near)
{
    for (uint32_t i = 0; near != 0; i++, near >>= 1) {
        if ((near & 1) && !outside_face(in->leaf, &t->p[k], i) && reaches_plane(in, &t->p[k], i) &&
            interfere_face_vertex(in, t, i, k)) {
            interfere_emit(in, CANDIDATE_FACE_VERTEX, in->b->def.mesh->raw.faces[t->number][k],
                           interfere_face(in, i));
        }
    }
}

/* Box of the edge c-d of b's face, grown by the leaf's reach. */
static void box_edge(const struct interfere_leaf *l, const struct interfere_vec *c,
                     const struct interfere_vec *d, struct interfere_vec *low,
                     struct interfere_vec *high)
{
    for (int k = 0; k < 3; k++) {
        bool up = c->c[k] < d->c[k];

        low->c[k] = (up ? c : d)->c[k] - l->reach.c[k];
        high->c[k] = (up ? d : c)->c[k] + l->reach.c[k];
    }
}

/* Emit the edges that face i of the leaf owns and that meet the box, against edge j of b's face. */
static void edges_edge(struct interfere *in, const struct target *t, uint32_t i, int j,
                       const struct interfere_vec *low, const struct interfere_vec *high)
{
    const struct interfere_leaf *l = in->leaf;
    const uint8_t *corner = interfere_corners(in, i);

    for (int k = 0, own = l->own_edges[i]; own != 0; k++, own >>= 1) {
        uint32_t from = corner[k], to = corner[k == 2 ? 0 : k + 1], both = 1u << from | 1u << to;
        const int32_t *p = l->p[from].c, *q = l->p[to].c;

        if ((own & 1) && (both & ~t->over) != 0 && (both & ~t->under) != 0 &&
            !both_beside(p[2], q[2], low->c[2], high->c[2]) &&
            !both_beside(p[1], q[1], low->c[1], high->c[1]) &&
            !both_beside(p[0], q[0], low->c[0], high->c[0]) &&
            interfere_edge_edge(in, t, i, k, j)) {
            interfere_emit(in, CANDIDATE_EDGE_EDGE,
                           in->a->def.mesh->faces[interfere_face(in, i)].edge[k], t->face->edge[j]);
        }
    }
}

/* Emit edge j of b's face against edges of the leaf's faces `near`, a bit each. */
static void edge_edges(struct interfere *in, const struct target *t, int j, uint32_t near)
{
    struct interfere_vec low, high;

    box_edge(in->leaf, &t->p[j], &t->p[j == 2 ? 0 : j + 1], &low, &high);
    for (uint32_t i = 0; near != 0; i++, near >>= 1) {
        if (near & 1) {
            edges_edge(in, t, i, j, &low, &high);
        }
    }
}

/* The corners and edges of b's face that the leaf may touch, as in carom_face. */
static inline uint32_t tested(struct interfere *in, const struct target *t)
{
    uint32_t own = t->face->own, behind = t->face->behind;

    return behind != 0 && mesh_two_sided(in->b->def.mesh) && interfere_faces_up(in) != 0
               ? own | behind
               : own;
}

/* Those of the leaf's near faces that can touch a feature of b's face: a bit of `tested`. */
static inline uint32_t faces_for(const struct interfere *in, const struct target *t, int bit,
                                 uint32_t near)
{
    return t->face->own >> bit & 1 ? near : near & in->leaf->up;
}

void interfere_features(struct interfere *in, struct target *t)
{
    uint32_t features = tested(in, t), near = features != 0 ? interfere_faces_near(in, t) : 0;

    vertices_face(in, t);
    for (int k = 0; near != 0 && k < 3; k++) {
        if (features >> k & 1) {
            face_vertex(in, t, k, faces_for(in, t, k, near));
        }
        if (features >> (3 + k) & 1) {
            edge_edges(in, t, k, faces_for(in, t, 3 + k, near));
        }
    }
}

void interfere_narrow(struct interfere *in, uint16_t face_b)
{
    struct target t; /* set step by step: nearly all faces fail the plane */

    t.number = face_b;
    t.face = &in->b->def.mesh->faces[face_b];
    if (!part_by_plane(in, &t)) {
        return;
    }
    place_target(in, &t);
    interfere_bound(&t.p[0], &t.p[1], &t.p[2], &t.low, &t.high);
    if (!in->leaf->listed) {
        interfere_list_faces(in);
    }
    in->meet(in, &t);
}
