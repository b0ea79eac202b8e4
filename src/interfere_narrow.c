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

static struct interfere_vec opposite(const struct interfere_vec *a)
{
    return (struct interfere_vec){{-a->c[0], -a->c[1], -a->c[2]}};
}

/* ------------------------------------------------------------------- planes */

/* Whether the leaf's slab, swept, has all of b's face on one side. */
static bool beside_slab(const struct interfere *w, const struct target *t)
{
    const struct interfere_leaf *l = &w->leaf;
    int32_t a = interfere_dot(l->axis_q30, t->p[0].c), b = interfere_dot(l->axis_q30, t->p[1].c),
            c = interfere_dot(l->axis_q30, t->p[2].c);

    return (a > l->slab_high_q18 && b > l->slab_high_q18 && c > l->slab_high_q18) ||
           (a < l->slab_low_q18 && b < l->slab_low_q18 && c < l->slab_low_q18);
}

/*
 * Which vertices of the leaf stay over the plane of b's face on their way, and which under it. False
 * when all do.
 */
static bool part_by_plane(const struct interfere *w, struct target *t)
{
    const struct interfere_leaf *l = &w->leaf;
    const int32_t *n = t->face->normal.c;
    /* one unit for each cut */
    int32_t offset_q18 = t->face->offset_q22 >> 4, away_q18 = interfere_dot(n, l->shift.c);
    int32_t near_q18 = (l->near_q20 >> 2) + 4;
    int32_t above_q18 = offset_q18 + near_q18 - least(away_q18, 0),
            below_q18 = offset_q18 - near_q18 - most(away_q18, 0);
    uint32_t count = l->leaf->vertex_count, all = 0xffffffffu >> (32 - count);
    uint32_t over = 0, under = 0;
    int32_t top[3], bottom[3];

    for (int k = 0; k < 3; k++) {
        top[k] = n[k] > 0 ? l->high.c[k] : l->low.c[k];
        bottom[k] = n[k] > 0 ? l->low.c[k] : l->high.c[k];
    }
    if (interfere_dot(n, bottom) > above_q18 || interfere_dot(n, top) < below_q18) {
        return false;
    }
    for (const struct interfere_vec *p = &l->p[count]; p-- > l->p;) {
        int32_t height_q18 = interfere_dot(n, p->c);

        /* the signs of differences: heights are below 2^30 */
        over = over << 1 | (uint32_t)(above_q18 - height_q18) >> 31;
        under = under << 1 | (uint32_t)(height_q18 - below_q18) >> 31;
    }
    t->over = over;
    t->under = under;
    return over != all && under != all;
}

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

static void bound_target(struct target *t)
{
    for (int i = 0; i < 3; i++) {
        t->low.c[i] = least(t->p[0].c[i], least(t->p[1].c[i], t->p[2].c[i]));
        t->high.c[i] = most(t->p[0].c[i], most(t->p[1].c[i], t->p[2].c[i]));
    }
}

/* Which corners each face of the leaf has. */
static void list_corners(struct interfere *w)
{
    struct interfere_leaf *l = &w->leaf;

    l->listed = true;
    for (uint32_t i = 0; i < l->leaf->face_count; i++) {
        const uint8_t *corner = w->a->mesh->leaf_corners[l->leaf->first_face + i];

        l->corners[i] = 1u << corner[0] | 1u << corner[1] | 1u << corner[2];
    }
}

/* ---------------------------------------------------------- vertices, faces */

/*
 * Whether a point that moves by `shift`, or by a part of it, stays beside a triangle with normal n:
 * seen along the axis that n is most along.
 */
static bool stays_beside(const struct interfere_vec *p, const struct interfere_vec *const t[3],
                         const int32_t n[3], const struct interfere_vec *shift, int32_t near)
{
    int64_t x = carom_abs(n[0]), y = carom_abs(n[1]), z = carom_abs(n[2]);
    int axis = z >= x && z >= y ? 2 : x >= y ? 0 : 1;
    int i = axis == 2 ? 0 : axis + 1, j = i == 2 ? 0 : i + 1;

    for (int k = 0; k < 3; k++) {
        const int32_t *from = t[k]->c, *to = t[k == 2 ? 0 : k + 1]->c;
        int32_t ex = to[i] - from[i], ey = to[j] - from[j];
        int64_t inside = (int64_t)ex * (p->c[j] - from[j]) - (int64_t)ey * (p->c[i] - from[i]);
        int64_t gain = (int64_t)ex * shift->c[j] - (int64_t)ey * shift->c[i];
        int64_t size = carom_abs(ex) + carom_abs(ey);

        if (n[axis] < 0) {
            inside = -inside;
            gain = -gain;
        }
        if (inside + (gain > 0 ? gain : 0) < -size * near) {
            return true;
        }
    }
    return false;
}

/* Whether a point that moves by `shift` stays clear of a box, by `near`. */
static bool stays_clear(const struct interfere_vec *p, const struct interfere_vec *low,
                        const struct interfere_vec *high, const struct interfere_vec *shift,
                        int32_t near)
{
    for (int k = 2; k >= 0; k--) {
        if (p->c[k] + most(shift->c[k], 0) + near < low->c[k] ||
            p->c[k] + least(shift->c[k], 0) - near > high->c[k]) {
            return true;
        }
    }
    return false;
}

/* The face of the leaf that a vertex belongs to interferes. */
static void note_owner(struct interfere *w, uint32_t vertex)
{
    const struct carom_mesh *ma = w->a->mesh;
    const struct carom_leaf *leaf = w->leaf.leaf;

    for (uint32_t i = 0; i < leaf->face_count; i++) {
        const uint8_t *corner = ma->leaf_corners[leaf->first_face + i];
        uint8_t own = ma->faces[ma->leaf_faces[leaf->first_face + i]].own;

        for (int k = 0; k < 3; k++) {
            if (corner[k] == vertex && own & 1 << k) {
                w->leaf.busy |= 1u << i;
            }
        }
    }
}

/* Vertices of the leaf against the face. */
static bool vertices_face(struct interfere *w, const struct target *t)
{
    const struct interfere_leaf *l = &w->leaf;
    const struct carom_mesh *ma = w->a->mesh;
    const struct interfere_vec *const corners[3] = {&t->p[0], &t->p[1], &t->p[2]};
    uint32_t left = l->leaf->owned & ~t->over & ~t->under;
    int32_t n[3];
    bool any = false;

    for (uint32_t i = 0; left >> i != 0; i++) {
        const struct interfere_vec *p = &l->p[i];
        uint32_t v;

        if (!(left >> i & 1) || stays_clear(p, &t->low, &t->high, &l->shift, l->near_q20) ||
            stays_beside(p, corners, t->face->normal.c, &l->shift, l->near_q20)) {
            continue;
        }
        carom_rotate_back(n, &w->to_b, t->face->normal.c);
        v = ma->leaf_vertices[l->leaf->first_vertex + i];
        if (mesh_vertex_cone(ma, v, n, w->cone_q30)) {
            emit(w, CANDIDATE_VERTEX_FACE, v, t->number);
            note_owner(w, i);
            any = true;
        }
    }
    return any;
}

/* Whether vertex v of b, at y, may touch face i of the leaf. */
static bool face_may_touch(const struct interfere *w, uint32_t i, uint32_t v,
                           const struct interfere_vec *y, const struct interfere_vec *back)
{
    const struct interfere_leaf *l = &w->leaf;
    const struct carom_mesh *ma = w->a->mesh;
    const uint8_t *corner = ma->leaf_corners[l->leaf->first_face + i];
    const struct interfere_vec *const p[3] = {&l->p[corner[0]], &l->p[corner[1]], &l->p[corner[2]]};
    struct interfere_vec low, high, d;
    int32_t n[3], height_q18, closes_q18, near_q18 = (l->near_q20 >> 2) + 4;

    for (int k = 0; k < 3; k++) {
        low.c[k] = least(p[0]->c[k], least(p[1]->c[k], p[2]->c[k]));
        high.c[k] = most(p[0]->c[k], most(p[1]->c[k], p[2]->c[k]));
    }
    if (stays_clear(y, &low, &high, back, l->near_q20)) {
        return false;
    }
    carom_rotate(n, &w->to_b, ma->faces[ma->leaf_faces[l->leaf->first_face + i]].normal.c);
    d = difference(y, p[0]);
    height_q18 = interfere_dot(n, d.c);
    closes_q18 = interfere_dot(n, back->c);
    return height_q18 + least(closes_q18, 0) <= near_q18 &&
           height_q18 + most(closes_q18, 0) >= -near_q18 &&
           !stays_beside(y, p, n, back, l->near_q20) &&
           mesh_vertex_cone(w->b->mesh, v, n, w->cone_q30);
}

/* Vertices of the face against those of the leaf's faces that its plane does not keep apart. */
static bool face_vertices(struct interfere *w, const struct target *t)
{
    const struct interfere_leaf *l = &w->leaf;
    const struct interfere_vec none = {{0, 0, 0}}, back = opposite(&l->shift);
    bool any = false;

    for (int k = 0; k < 3; k++) {
        uint32_t v = w->b->mesh->raw.faces[t->number][k];

        if (!(t->face->own & 1 << k) ||
            stays_clear(&t->p[k], &l->swept_low, &l->swept_high, &none, 0)) {
            continue;
        }
        for (uint32_t i = 0; i < l->leaf->face_count; i++) {
            if ((l->corners[i] & ~t->over) != 0 && (l->corners[i] & ~t->under) != 0 &&
                face_may_touch(w, i, v, &t->p[k], &back)) {
                emit(w, CANDIDATE_FACE_VERTEX, v, w->a->mesh->leaf_faces[l->leaf->first_face + i]);
                any = true;
            }
        }
    }
    return any;
}

/* -------------------------------------------------------------------- edges */

/* Two edges at the start, in b's mesh axes. */
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
 * Whether +w or -w can be the normal: it must lie in the normal cones of both edges (Gauss arcs).
 * The angle turned moves w / |w| by up to turn / sine; all is multiplied by the sine.
 */
static bool arcs_meet(const struct interfere *in, const struct lines *l, int64_t sine_q30)
{
    int64_t turn_q30 = (int64_t)in->cone_q30 - INTERFERE_CONE_Q30;
    int64_t tolerance_q60 = in->cone_q30 * sine_q30 + carom_shl(turn_q30, 30);
    bool plus = true, minus = true;
    int32_t w_a[3];

    for (int side = 0; side < 2; side++) {
        carom_v3_q30 in_b = mesh_edge_inward(in->b->mesh, l->b, side);
        int64_t on_b = carom_dot(l->w, in_b.c);

        plus = plus && on_b <= tolerance_q60;
        minus = minus && -on_b <= tolerance_q60;
    }
    if (!plus && !minus) {
        return false;
    }
    carom_rotate_back(w_a, &in->to_b, l->w);
    for (int side = 0; side < 2; side++) {
        carom_v3_q30 in_a = mesh_edge_inward(in->a->mesh, l->a, side);
        int64_t on_a = carom_dot(w_a, in_a.c);

        plus = plus && -on_a <= tolerance_q60;
        minus = minus && on_a <= tolerance_q60;
    }
    return plus || minus;
}

/*
 * Whether an edge stays beside the line of the other one, seen along w: what begins at `start` from
 * the line, runs along `other`, and moves by `shift`.
 */
static bool passes_by(const struct interfere *in, const int32_t w[3], const int32_t line[3],
                      const struct interfere_vec *start, const int32_t other[3], int32_t length_q22,
                      const struct interfere_vec *shift)
{
    int32_t axis[3];
    int64_t from, run, gain, limit;

    carom_cross(axis, w, line, 30);
    from = carom_dot(axis, start->c);
    run = (carom_dot(axis, other) >> 30) * (length_q22 >> 2);
    gain = carom_dot(axis, shift->c);
    limit = (size_of(axis) + 4) * (in->leaf.near_q20 + 4) + length_q22;
    return from + (run < 0 ? run : 0) + (gain < 0 ? gain : 0) > limit ||
           from + (run > 0 ? run : 0) + (gain > 0 ? gain : 0) < -limit;
}

/* Whether two edges of which neither box keeps them apart can touch. */
static bool edges_may_touch(const struct interfere *in, struct lines *l)
{
    const struct interfere_vec *shift = &in->leaf.shift;
    const int32_t *f = l->b->direction.c;
    struct interfere_vec d, d_back, back;
    int64_t sine_q30, gap, gain, limit;
    int32_t largest;

    carom_rotate(l->e, &in->to_b, l->a->direction.c);
    carom_cross(l->w, l->e, f, 30);
    largest = most(most((int32_t)carom_abs(l->w[0]), (int32_t)carom_abs(l->w[1])),
                   (int32_t)carom_abs(l->w[2]));
    if (largest < CAROM_ONE_Q30 / 64 + (in->cone_q30 - INTERFERE_CONE_Q30)) {
        return true; /* may be parallel somewhere on the way: leave it to the exact test */
    }
    sine_q30 = size_of(l->w) + 4; /* at least */
    d = difference(l->start_a, l->start_b);
    gap = carom_dot(l->w, d.c);
    gain = carom_dot(l->w, shift->c);
    limit = sine_q30 * (in->leaf.near_q20 + 4);
    if (gap + (gain < 0 ? gain : 0) > limit || gap + (gain > 0 ? gain : 0) < -limit ||
        !arcs_meet(in, l, sine_q30)) {
        return false;
    }
    d_back = difference(l->start_b, l->start_a);
    back = opposite(shift);
    return !passes_by(in, l->w, f, &d, l->e, l->a->length_q22, shift) &&
           !passes_by(in, l->w, l->e, &d_back, f, l->b->length_q22, &back);
}

/* The box in which an edge of the leaf must start or end to reach an edge of b. */
struct reach {
    struct interfere_vec low, high;
};

static bool misses(const struct reach *r, const struct interfere_vec *p,
                   const struct interfere_vec *q)
{
    for (int k = 2; k >= 0; k--) {
        if ((p->c[k] < r->low.c[k] && q->c[k] < r->low.c[k]) ||
            (p->c[k] > r->high.c[k] && q->c[k] > r->high.c[k])) {
            return true;
        }
    }
    return false;
}

/* Edge j of the face against the edges of one of the leaf's faces. */
static bool edge_edges(struct interfere *w, const struct target *t, int j,
                       const struct reach *reach, uint32_t i)
{
    const struct carom_mesh *ma = w->a->mesh;
    const struct interfere_leaf *l = &w->leaf;
    const struct carom_face *face = &ma->faces[ma->leaf_faces[l->leaf->first_face + i]];
    const uint8_t *corner = ma->leaf_corners[l->leaf->first_face + i];
    bool any = false;

    for (int k = 0; k < 3; k++) {
        uint32_t p = corner[k], q = corner[k == 2 ? 0 : k + 1], both = 1u << p | 1u << q;
        struct lines lines;

        if (!(face->own & 8 << k) || (t->over & both) == both || (t->under & both) == both ||
            misses(reach, &l->p[p], &l->p[q])) {
            continue;
        }
        /* an owned edge runs with its face */
        lines.a = &ma->edges[face->edge[k]];
        lines.b = &w->b->mesh->edges[t->face->edge[j]];
        lines.start_a = &l->p[p];
        lines.start_b = &t->p[j];
        if (edges_may_touch(w, &lines)) {
            emit(w, CANDIDATE_EDGE_EDGE, face->edge[k], t->face->edge[j]);
            w->leaf.busy |= 1u << i;
            any = true;
        }
    }
    return any;
}

static bool edges_edges(struct interfere *w, const struct target *t)
{
    const struct interfere_leaf *l = &w->leaf;
    bool any = false;

    for (int j = 0; j < 3; j++) {
        const struct interfere_vec *p = &t->p[j], *q = &t->p[j == 2 ? 0 : j + 1];
        const struct reach whole = {l->swept_low, l->swept_high};
        struct reach reach;

        if (!(t->face->own & 8 << j) || misses(&whole, p, q)) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            int32_t shift = l->shift.c[k];

            reach.low.c[k] = least(p->c[k], q->c[k]) - l->near_q20 - most(shift, 0);
            reach.high.c[k] = most(p->c[k], q->c[k]) + l->near_q20 - least(shift, 0);
        }
        for (uint32_t i = 0; i < l->leaf->face_count; i++) {
            if ((l->corners[i] & ~t->over) != 0 && (l->corners[i] & ~t->under) != 0) {
                any |= edge_edges(w, t, j, &reach, i);
            }
        }
    }
    return any;
}

void interfere_features(struct interfere *w, const struct target *t)
{
    bool any = vertices_face(w, t);

    any |= face_vertices(w, t);
    any |= edges_edges(w, t);
    if (any) {
        interfere_add_face(w, w->body_b, t->number);
    }
}

void interfere_narrow(struct interfere *w, uint16_t face_b)
{
    struct target t; /* the rest of it is set by and by: nearly all end here */

    t.number = face_b;
    t.face = &w->b->mesh->faces[face_b];
    place_target(w, &t);
    if (beside_slab(w, &t) || !part_by_plane(w, &t)) {
        return;
    }
    bound_target(&t);
    if (!w->leaf.listed) {
        list_corners(w);
    }
    w->meet(w, &t);
}
