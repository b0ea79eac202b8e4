/* SPDX-License-Identifier: MIT */
/*
 * From a swept leaf and a face that is near to the faces of the leaf that no plane parts from it, and to
 * the candidates of two such faces.
 */
#include "narrow.h"

/* -------------------------------------------------------------------- boxes */

static void place_target(const struct interfere *w, struct target *t)
{
    const struct carom_mesh *mb = w->b->mesh;

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

/* Whether the box around a leaf's face's way meets that of b's face. */
static inline bool boxes_meet(struct interfere *w, const struct interfere_leaf *l,
                              const struct target *t, uint32_t i)
{
    const int32_t *low = l->face_low[i].c, *high = l->face_high[i].c;

    if (!(l->boxed >> i & 1)) {
        interfere_box_face(w, i);
    }
    return low[0] <= t->high.c[0] && high[0] >= t->low.c[0] && low[1] <= t->high.c[1] &&
           high[1] >= t->low.c[1] && low[2] <= t->high.c[2] && high[2] >= t->low.c[2];
}

/* ------------------------------------------------------------------- planes */

/* 1 when a is less than b; they differ by less than 2^31. */
static inline uint32_t is_less(int32_t a, int32_t b)
{
    return (uint32_t)(a - b) >> 31;
}

/*
 * Which vertices of the leaf stay over the plane of b's face on their way, or under it. False when
 * all of them do the same.
 */
static bool part_by_plane(const struct interfere *w, struct target *t)
{
    const struct interfere_leaf *l = w->leaf;
    const int32_t *n = t->face->normal.c;
    int32_t offset_q18 = t->face->offset_q22 >> 4, reach_q18 = interfere_reach_q18(l, n);
    int32_t above_q18 = offset_q18 + reach_q18, below_q18 = offset_q18 - reach_q18;
    uint32_t over = 0, under = 0, all = UINT32_MAX >> (32 - l->leaf->vertex_count);

    for (const struct interfere_vec *p = &l->p[l->leaf->vertex_count]; p > l->p;) {
        int32_t height_q18;

        p--;
        height_q18 = interfere_dot(n, p->c);
        over = over << 1 | is_less(above_q18, height_q18);
        under = under << 1 | is_less(height_q18, below_q18);
    }
    t->over = over;
    t->under = under;
    return over != all && under != all;
}

/* Whether b's face reaches to both sides of the plane of face i of the leaf, or near to it. */
static bool is_reached(struct interfere *w, struct target *t, uint32_t i)
{
    const struct interfere_plane *plane = &w->leaf->planes[i];
    int32_t above_q18, below_q18, p_q18, q_q18, r_q18;

    if (!(w->leaf->placed >> i & 1)) {
        interfere_place_plane(w, i);
    }
    above_q18 = plane->above_q18;
    below_q18 = plane->below_q18;
    p_q18 = interfere_dot(plane->n_q30, t->p[0].c);
    q_q18 = interfere_dot(plane->n_q30, t->p[1].c);
    r_q18 = interfere_dot(plane->n_q30, t->p[2].c);
    t->corners_over =
        is_less(above_q18, p_q18) | is_less(above_q18, q_q18) << 1 | is_less(above_q18, r_q18) << 2;
    t->corners_under =
        is_less(p_q18, below_q18) | is_less(q_q18, below_q18) << 1 | is_less(r_q18, below_q18) << 2;
    return t->corners_over != 7 && t->corners_under != 7;
}

/* ----------------------------------------------------------------- features */

/* Whether a point of the leaf stays out of the box of b's face on its way. */
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

/* Whether a corner of b's face is out of the box around the way of face i of the leaf. */
static bool outside_face(const struct interfere_leaf *l, const struct interfere_vec *p, uint32_t i)
{
    const int32_t *low = l->face_low[i].c, *high = l->face_high[i].c;

    return p->c[2] < low[2] || p->c[2] > high[2] || p->c[1] < low[1] || p->c[1] > high[1] ||
           p->c[0] < low[0] || p->c[0] > high[0];
}

/* The corners that face i of the leaf owns against b's face. */
static bool vertices_face(struct interfere *w, const struct target *t, uint32_t i, uint32_t own)
{
    const struct interfere_leaf *l = w->leaf;
    const uint8_t *corner = interfere_corners(w, i);
    bool any = false;

    for (; own != 0; own >>= 1, corner++) {
        if ((own & 1) && !((t->over | t->under) >> *corner & 1) &&
            !outside_target(l, &l->p[*corner], t) && interfere_vertex_face(w, t, *corner)) {
            interfere_emit(w, CANDIDATE_VERTEX_FACE, interfere_vertex(w, *corner), t->number);
            any = true;
        }
    }
    return any;
}

/* The corners of b's face that are left, a bit each, against face i of the leaf. */
static bool face_vertices(struct interfere *w, const struct target *t, uint32_t i, uint32_t left)
{
    bool any = false;

    for (int k = 0; left >> k != 0; k++) {
        if ((left >> k & 1) && !outside_face(w->leaf, &t->p[k], i) &&
            interfere_face_vertex(w, t, i, k)) {
            interfere_emit(w, CANDIDATE_FACE_VERTEX, w->b->mesh->raw.faces[t->number][k],
                           interfere_face(w, i));
            any = true;
        }
    }
    return any;
}

/* Whether two places are both before two others; nearly always the first two say no. */
static inline bool both_before(int32_t p, int32_t q, int32_t c, int32_t d)
{
    return p < c && p < d && q < c && q < d;
}

/* Whether the way of an edge of the leaf, between p and q, keeps clear of one between c and d. */
static bool boxes_miss(const struct interfere *w, const struct interfere_vec *p,
                       const struct interfere_vec *q, const struct interfere_vec *c,
                       const struct interfere_vec *d)
{
    const struct interfere_leaf *l = w->leaf;

    for (int k = 0; k < 3; k++) {
        int32_t reach = l->reach.c[k];

        if (both_before(p->c[k] + reach, q->c[k] + reach, c->c[k], d->c[k]) ||
            both_before(c->c[k] + reach, d->c[k] + reach, p->c[k], q->c[k])) {
            return true;
        }
    }
    return false;
}

/* The edges that face i of the leaf owns against those of b's face that are left, a bit each. */
static bool edges_edges(struct interfere *w, const struct target *t, uint32_t i, uint32_t own,
                        uint32_t left)
{
    const struct interfere_leaf *l = w->leaf;
    const uint8_t *corner = interfere_corners(w, i);
    bool any = false;

    for (int k = 0; own >> k != 0; k++) {
        uint32_t from = corner[k], to = corner[k == 2 ? 0 : k + 1], both = 1u << from | 1u << to;

        /* does it reach the plane of b's face? */
        if (!(own >> k & 1) || (both & ~t->over) == 0 || (both & ~t->under) == 0) {
            continue;
        }
        for (int j = 0; left >> j != 0; j++) {
            if ((left >> j & 1) &&
                !boxes_miss(w, &l->p[from], &l->p[to], &t->p[j], &t->p[j == 2 ? 0 : j + 1]) &&
                interfere_edge_edge(w, t, i, k, j)) {
                interfere_emit(w, CANDIDATE_EDGE_EDGE,
                               w->a->mesh->faces[interfere_face(w, i)].edge[k], t->face->edge[j]);
                any = true;
            }
        }
    }
    return any;
}

bool interfere_features(struct interfere *w, const struct target *t, uint32_t i)
{
    uint32_t own_a = w->a->mesh->faces[interfere_face(w, i)].own, own_b = t->face->own;
    /* what stays on one side of the plane of the leaf's face, an edge with both of its ends */
    uint32_t over = t->corners_over, under = t->corners_under, beside = over | under;
    uint32_t edges_beside = (over & (over >> 1 | over << 2)) | (under & (under >> 1 | under << 2));
    uint32_t corners = own_b & ~beside & 7, edges = own_b >> 3 & ~edges_beside & 7;
    bool any = false;

    if ((own_a & 7) != 0) {
        any = vertices_face(w, t, i, own_a & 7);
    }
    if (corners != 0) {
        any |= face_vertices(w, t, i, corners);
    }
    if (edges != 0 && own_a >> 3 != 0) {
        any |= edges_edges(w, t, i, own_a >> 3, edges);
    }
    return any;
}

void interfere_narrow(struct interfere *w, uint16_t face_b)
{
    struct interfere_leaf *l = w->leaf;
    struct target t; /* the rest of it is set by and by: nearly all end here */

    t.number = face_b;
    t.face = &w->b->mesh->faces[face_b];
    if (!part_by_plane(w, &t)) {
        return;
    }
    place_target(w, &t);
    interfere_bound(&t.p[0], &t.p[1], &t.p[2], &t.low, &t.high);
    if (!l->listed) {
        interfere_list_faces(w);
    }
    for (uint32_t i = 0, over = t.over, under = t.under, n = l->leaf->face_count; i < n; i++) {
        uint32_t corners = l->corners[i];

        /* does it reach to both sides of the plane, or near to it? */
        if ((corners & ~over) != 0 && (corners & ~under) != 0 && boxes_meet(w, l, &t, i) &&
            is_reached(w, &t, i)) {
            w->meet(w, &t, i);
        }
    }
}
