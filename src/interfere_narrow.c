/* SPDX-License-Identifier: MIT */
/* From a swept leaf and a face that is near to the features of theirs that can touch. */
#include "interfere_narrow.h"

static void emit(struct interfere *w, uint8_t kind, uint32_t i, uint32_t j)
{
    struct pool *pool = w->candidate_pool;
    struct candidate *c;
    int32_t place = pool_take(pool);

    if (place < 0) {
        /* a chunk: hand over what there is and go on */
        w->visitor->visit(w->visitor, w->candidates, pool->used);
        w->whole = false;
        pool_clear(pool);
        place = pool_take(pool);
    }
    c = &w->candidates[place];
    c->pair = w->pair;
    c->kind = kind;
    c->i = i;
    c->j = j;
    w->candidate_count++;
    if (pool->used > w->enough) {
        w->error = INTERFERE_TOO_MANY;
    }
}

static inline int32_t least(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static inline int32_t most(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

static struct interfere_vec difference(const struct interfere_vec *a, const struct interfere_vec *b)
{
    return (struct interfere_vec){{a->c[0] - b->c[0], a->c[1] - b->c[1], a->c[2] - b->c[2]}};
}

/* -------------------------------------------------------------------- boxes */

static void place_target(const struct interfere *w, struct target *t)
{
    const struct carom_mesh *mb = w->b->mesh;

    for (int k = 0; k < 3; k++) {
        carom_v3_q22 corner = mesh_corner(mb, t->number, k);

        for (int i = 0; i < 3; i++) {
            t->p[k].c[i] = corner.c[i] >> 2;
        }
    }
}

static inline void bound_axis(int32_t x, int32_t y, int32_t z, int32_t *low, int32_t *high)
{
    int32_t less = x < y ? x : y, more = x < y ? y : x;

    *low = z < less ? z : less;
    *high = z > more ? z : more;
}

/* Spelled out, because compilers leave loops over three components. */
static inline void bound(const struct interfere_vec *p, const struct interfere_vec *q,
                         const struct interfere_vec *r, struct interfere_vec *low,
                         struct interfere_vec *high)
{
    bound_axis(p->c[0], q->c[0], r->c[0], &low->c[0], &high->c[0]);
    bound_axis(p->c[1], q->c[1], r->c[1], &low->c[1], &high->c[1]);
    bound_axis(p->c[2], q->c[2], r->c[2], &low->c[2], &high->c[2]);
}

/* Corners of the leaf's faces. */
static void list_faces(struct interfere *w)
{
    struct interfere_leaf *l = w->leaf;

    l->listed = true;
    l->boxed = l->placed = 0;
    for (uint32_t i = 0; i < l->leaf->face_count; i++) {
        const uint8_t *corner = interfere_corners(w, i);

        l->corners[i] = 1u << corner[0] | 1u << corner[1] | 1u << corner[2];
    }
}

/* The box around the way of a face of the leaf. */
static void box_face(struct interfere *w, uint32_t i)
{
    struct interfere_leaf *l = w->leaf;
    const uint8_t *corner = interfere_corners(w, i);

    l->boxed |= 1u << i;
    bound(&l->p[corner[0]], &l->p[corner[1]], &l->p[corner[2]], &l->face_low[i], &l->face_high[i]);
    for (int k = 0; k < 3; k++) {
        l->face_low[i].c[k] -= l->reach.c[k];
        l->face_high[i].c[k] += l->reach.c[k];
    }
}

/* Whether the box around a leaf's face's way meets that of b's face. */
static inline bool boxes_meet(struct interfere *w, const struct target *t, uint32_t i)
{
    struct interfere_leaf *l = w->leaf;
    const int32_t *low = l->face_low[i].c, *high = l->face_high[i].c;

    if (!(l->boxed >> i & 1)) {
        box_face(w, i);
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

/* The plane of a face of the leaf. */
static const struct interfere_plane *plane_of(struct interfere *w, uint32_t i)
{
    struct interfere_leaf *l = w->leaf;
    struct interfere_plane *plane = &l->planes[i];

    if (!(l->placed >> i & 1)) {
        l->placed |= 1u << i;
        carom_rotate(plane->n_q30, &w->leaf->to_b,
                     w->a->mesh->faces[interfere_face(w, i)].normal.c);
        plane->offset_q18 = interfere_dot(plane->n_q30, l->p[interfere_corners(w, i)[0]].c);
        plane->reach_q18 = interfere_reach_q18(l, plane->n_q30);
    }
    return plane;
}

/* Whether b's face reaches to both sides of the plane of face i of the leaf, or near to it. */
static bool is_reached(struct interfere *w, struct target *t, uint32_t i)
{
    const struct interfere_plane *plane = plane_of(w, i);
    const int32_t *n = plane->n_q30;
    int32_t above_q18 = plane->offset_q18 + plane->reach_q18;
    int32_t below_q18 = plane->offset_q18 - plane->reach_q18;
    int32_t p_q18 = interfere_dot(n, t->p[0].c), q_q18 = interfere_dot(n, t->p[1].c),
            r_q18 = interfere_dot(n, t->p[2].c);

    t->corners_over = is_less(above_q18, p_q18) | is_less(above_q18, q_q18) << 1 |
                      is_less(above_q18, r_q18) << 2;
    t->corners_under = is_less(p_q18, below_q18) | is_less(q_q18, below_q18) << 1 |
                       is_less(r_q18, below_q18) << 2;
    return t->corners_over != 7 && t->corners_under != 7;
}

/* ---------------------------------------------------------- vertices, faces */

/* Whether a point stays beside a triangle with normal n: seen along the axis that n is most along. */
static bool stays_beside(const struct interfere_leaf *l, const struct interfere_vec *p,
                         const struct interfere_vec *const t[3], const int32_t n[3])
{
    int64_t x = carom_abs(n[0]), y = carom_abs(n[1]), z = carom_abs(n[2]);
    int axis = z >= x && z >= y ? 2 : x >= y ? 0 : 1;
    int i = axis == 2 ? 0 : axis + 1, j = i == 2 ? 0 : i + 1;

    for (int k = 0; k < 3; k++) {
        const int32_t *from = t[k]->c, *to = t[k == 2 ? 0 : k + 1]->c;
        int32_t ex = to[i] - from[i], ey = to[j] - from[j];
        int64_t inside = (int64_t)ex * (p->c[j] - from[j]) - (int64_t)ey * (p->c[i] - from[i]);

        if (n[axis] < 0) {
            inside = -inside;
        }
        if (inside < -(carom_abs(ex) * l->reach.c[j] + carom_abs(ey) * l->reach.c[i])) {
            return true;
        }
    }
    return false;
}

/* Whether a point is outside a box grown by `reach`. */
static bool outside(const struct interfere_vec *p, const struct interfere_vec *low,
                    const struct interfere_vec *high, const struct interfere_vec *reach)
{
    for (int k = 2; k >= 0; k--) {
        if (p->c[k] + reach->c[k] < low->c[k] || p->c[k] - reach->c[k] > high->c[k]) {
            return true;
        }
    }
    return false;
}

/* A vertex of the leaf that reaches the plane of b's face and its box. */
static bool vertex_face(struct interfere *w, const struct target *t, uint32_t at)
{
    const struct interfere_leaf *l = w->leaf;
    const struct carom_mesh *ma = w->a->mesh;
    const struct interfere_vec *const corners[3] = {&t->p[0], &t->p[1], &t->p[2]};
    int32_t n[3];
    uint32_t v;

    if (stays_beside(l, &l->p[at], corners, t->face->normal.c)) {
        return false;
    }
    carom_rotate_back(n, &l->to_b, t->face->normal.c);
    v = ma->leaf_vertices[l->leaf->first_vertex + at];
    if (!mesh_vertex_cone(ma, v, n, l->cone_q30)) {
        return false;
    }
    emit(w, CANDIDATE_VERTEX_FACE, v, t->number);
    return true;
}

/* The corners that face i of the leaf owns against b's face. */
static bool vertices_face(struct interfere *w, const struct target *t, uint32_t i)
{
    const struct interfere_leaf *l = w->leaf;
    uint32_t left = w->a->mesh->faces[interfere_face(w, i)].own & 7;
    const uint8_t *corner = interfere_corners(w, i);
    bool any = false;

    for (; left != 0; left >>= 1, corner++) {
        any |= (left & 1) && !((t->over | t->under) >> *corner & 1) &&
               !outside(&l->p[*corner], &t->low, &t->high, &l->reach) && vertex_face(w, t, *corner);
    }
    return any;
}

/* Corner k of b's face, which reaches the plane of face i of the leaf and its box. */
static bool face_vertex(struct interfere *w, const struct target *t, uint32_t i, int k)
{
    const struct interfere_leaf *l = w->leaf;
    const uint8_t *corner = interfere_corners(w, i);
    const struct interfere_vec *const p[3] = {&l->p[corner[0]], &l->p[corner[1]], &l->p[corner[2]]};
    const int32_t *n = l->planes[i].n_q30;
    uint32_t v = w->b->mesh->raw.faces[t->number][k];

    if (stays_beside(l, &t->p[k], p, n) ||
        !mesh_vertex_cone(w->b->mesh, v, n, w->leaf->cone_q30)) {
        return false;
    }
    emit(w, CANDIDATE_FACE_VERTEX, v, interfere_face(w, i));
    return true;
}

/* The corners that b's face owns against face i of the leaf. */
static bool face_vertices(struct interfere *w, const struct target *t, uint32_t i)
{
    const struct interfere_leaf *l = w->leaf;
    const struct interfere_vec none = {{0, 0, 0}}; /* the box of face i has it */
    uint32_t left = t->face->own & ~(t->corners_over | t->corners_under) & 7;
    bool any = false;

    for (int k = 0; left >> k != 0; k++) {
        any |= (left >> k & 1) &&
               !outside(&t->p[k], &l->face_low[i], &l->face_high[i], &none) &&
               face_vertex(w, t, i, k);
    }
    return any;
}

/* -------------------------------------------------------------------- edges */

/* Two edges in the middle of the way, in b's mesh axes. */
struct lines {
    const struct carom_edge *a, *b;
    const struct interfere_vec *start_a, *start_b;
    int32_t e[3]; /* direction of a's; of b's: b->direction */
    int32_t w[3]; /* e x f, q30 */
};

static int64_t size_of(const int32_t v[3])
{
    return carom_abs(v[0]) + carom_abs(v[1]) + carom_abs(v[2]);
}

/*
 * Which of +w and -w lies between the faces of an edge, a bit each, d being the direction of the other
 * edge: square to its edge in a face with normal n, (e x f).(n x f) is e.n, and (e x f).(n x e) is -f.n.
 */
static uint32_t sides_between(const struct carom_mesh *mesh, const struct carom_edge *edge,
                              const int32_t d[3], int32_t tolerance_q28)
{
    int32_t on_q28[2];

    for (int side = 0; side < 2; side++) {
        uint16_t face = edge->face[side];

        on_q28[side] = face == CAROM_NO_FACE ? 0 : interfere_dot(mesh->faces[face].normal.c, d);
    }
    return (uint32_t)(on_q28[0] <= tolerance_q28 && -on_q28[1] <= tolerance_q28) |
           (uint32_t)(-on_q28[0] <= tolerance_q28 && on_q28[1] <= tolerance_q28) << 1;
}

/*
 * Whether +w or -w can be the normal: it must lie in the normal cones of both edges (Gauss arcs).
 * The angle turned moves w / |w| by up to turn / sine; all is multiplied by the sine.
 */
static bool arcs_meet(const struct interfere *in, const struct lines *l, int64_t sine_q30)
{
    int64_t turn_q30 = (int64_t)in->leaf->cone_q30 - INTERFERE_CONE_Q30;
    int64_t tolerance_q60 = in->leaf->cone_q30 * sine_q30 + carom_shl(turn_q30, 30);
    int32_t f_a[3], tolerance_q28 = (int32_t)(tolerance_q60 >> 32) + 1;
    uint32_t sides = sides_between(in->b->mesh, l->b, l->e, tolerance_q28);

    if (sides == 0) {
        return false;
    }
    carom_rotate_back(f_a, &in->leaf->to_b, l->b->direction.c);
    return (sides & sides_between(in->a->mesh, l->a, f_a, tolerance_q28)) != 0;
}

/*
 * Whether an edge stays beside the line of the other one, seen along w: what begins at `start` from
 * the line and runs along `other`.
 */
static bool passes_by(const struct interfere *in, const int32_t w[3], const int32_t line[3],
                      const struct interfere_vec *start, const int32_t other[3], int32_t length_q22)
{
    int32_t axis[3];
    int64_t from, run, limit;

    carom_cross(axis, w, line, 30);
    from = carom_dot(axis, start->c);
    run = (carom_dot(axis, other) >> 30) * (length_q22 >> 2);
    limit = (size_of(axis) + 4) * (in->leaf->near_q20 + 4) + length_q22 +
            carom_abs(carom_dot(axis, in->leaf->shift.c)) / 2;
    return from + (run < 0 ? run : 0) > limit || from + (run > 0 ? run : 0) < -limit;
}

/* Whether two edges of which neither box keeps them apart can touch. */
static bool edges_may_touch(const struct interfere *in, struct lines *l)
{
    const int32_t *f = l->b->direction.c;
    struct interfere_vec d, d_back;
    int64_t sine_q30, limit;
    int32_t largest;

    carom_rotate(l->e, &in->leaf->to_b, l->a->direction.c);
    carom_cross(l->w, l->e, f, 30);
    largest = most(most((int32_t)carom_abs(l->w[0]), (int32_t)carom_abs(l->w[1])),
                   (int32_t)carom_abs(l->w[2]));
    if (largest < CAROM_ONE_Q30 / 64 + (in->leaf->cone_q30 - INTERFERE_CONE_Q30)) {
        return true; /* may be parallel somewhere on the way: leave it to the exact test */
    }
    sine_q30 = size_of(l->w) + 4; /* at least */
    d = difference(l->start_a, l->start_b);
    limit = sine_q30 * (in->leaf->near_q20 + 4) + carom_abs(carom_dot(l->w, in->leaf->shift.c)) / 2;
    if (carom_abs(carom_dot(l->w, d.c)) > limit || !arcs_meet(in, l, sine_q30)) {
        return false;
    }
    d_back = difference(l->start_b, l->start_a);
    return !passes_by(in, l->w, f, &d, l->e, l->a->length_q22) &&
           !passes_by(in, l->w, l->e, &d_back, f, l->b->length_q22);
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

/* An edge that face i of the leaf owns against one of b's face. */
static bool edge_edge(struct interfere *w, const struct target *t, uint32_t i, int k, int j)
{
    const struct interfere_leaf *l = w->leaf;
    const uint8_t *corner = interfere_corners(w, i);
    const struct interfere_vec *p = &l->p[corner[k]], *q = &l->p[corner[k == 2 ? 0 : k + 1]];
    const struct interfere_vec *c = &t->p[j], *d = &t->p[j == 2 ? 0 : j + 1];
    uint32_t edge_a, edge_b = t->face->edge[j];
    struct lines lines;

    if (boxes_miss(w, p, q, c, d)) {
        return false;
    }
    edge_a = w->a->mesh->faces[interfere_face(w, i)].edge[k];
    /* an owned edge runs with its face */
    lines.a = &w->a->mesh->edges[edge_a];
    lines.b = &w->b->mesh->edges[edge_b];
    lines.start_a = p;
    lines.start_b = c;
    if (!edges_may_touch(w, &lines)) {
        return false;
    }
    emit(w, CANDIDATE_EDGE_EDGE, edge_a, edge_b);
    return true;
}

/* The edges that face i of the leaf owns and that reach the plane of b's face, a bit each. */
static uint32_t edges_left(const struct interfere *w, const struct target *t, uint32_t i)
{
    const uint8_t *corner = interfere_corners(w, i);
    uint32_t left = 0, own = w->a->mesh->faces[interfere_face(w, i)].own >> 3;

    for (int k = 0; own >> k != 0; k++) {
        uint32_t both = 1u << corner[k] | 1u << corner[k == 2 ? 0 : k + 1];

        if ((own >> k & 1) && (both & ~t->over) != 0 && (both & ~t->under) != 0) {
            left |= 1u << k;
        }
    }
    return left;
}

static bool edges_edges(struct interfere *w, const struct target *t, uint32_t i)
{
    /* bit k of these: both ends of edge k */
    uint32_t over = t->corners_over & (t->corners_over >> 1 | t->corners_over << 2);
    uint32_t under = t->corners_under & (t->corners_under >> 1 | t->corners_under << 2);
    uint32_t left = (uint32_t)t->face->own >> 3 & ~over & ~under & 7;
    uint32_t edges = left != 0 ? edges_left(w, t, i) : 0;
    bool any = false;

    for (int k = 0; edges >> k != 0; k++) {
        for (int j = 0; (edges >> k & 1) && left >> j != 0; j++) {
            any |= (left >> j & 1) && edge_edge(w, t, i, k, j);
        }
    }
    return any;
}

bool interfere_features(struct interfere *w, const struct target *t, uint32_t i)
{
    bool any = vertices_face(w, t, i);

    any |= face_vertices(w, t, i);
    any |= edges_edges(w, t, i);
    return any;
}

void interfere_narrow(struct interfere *w, uint16_t face_b)
{
    struct interfere_leaf *l = w->leaf;
    struct target t; /* the rest of it is set by and by: nearly all end here */
    uint32_t busy = 0;

    t.number = face_b;
    t.face = &w->b->mesh->faces[face_b];
    if (!part_by_plane(w, &t)) {
        return;
    }
    place_target(w, &t);
    bound(&t.p[0], &t.p[1], &t.p[2], &t.low, &t.high);
    if (!l->listed) {
        list_faces(w);
    }
    for (uint32_t i = 0, over = t.over, under = t.under, n = l->leaf->face_count; i < n; i++) {
        uint32_t corners = l->corners[i];

        /* does it reach to both sides of the plane, or near to it? */
        if ((corners & ~over) != 0 && (corners & ~under) != 0 && boxes_meet(w, &t, i) &&
            is_reached(w, &t, i) && w->meet(w, &t, i)) {
            busy |= 1u << i;
        }
    }
    if (busy != 0) {
        l->busy |= busy;
        interfere_add_face(w, w->body_b, face_b);
    }
}
