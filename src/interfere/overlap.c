/* SPDX-License-Identifier: MIT */
/*
 * Queries without motion: which face pairs of two bodies cross at their poses?
 *
 * A query walks a's leaves over b's z-lists as a step does. A face pair that no face's plane
 * separates is then tested by directions across one edge of each. Places in b's frame are off by a
 * few units of q20. A pair is dropped only if some direction separates it by more than that, so no
 * crossing pair is lost, however thin.
 */
#include "narrow.h"

/* Margin when boxes of bodies are compared, q22: more than all truncation here. */
#define BOX_MARGIN_Q22 256

struct interfere_query {
    struct interfere_sure *sure; /* exact test of each pair; NULL: list every pair that may cross */
    struct carom_face_pair *out;
    uint32_t room, count;
    bool swapped; /* a is the caller's b */
    bool again;   /* leaves repeat, once for each chunk of b's z-lists */

    /* for the leaf at hand */
    const struct carom_leaf *leaf;
    uint32_t first;     /* index of the leaf's first pair in `out` */
    int32_t edge_scale; /* largest power of two that keeps the leaf's scaled edges below 2^30 */
};

/* ------------------------------------------------------------------- leaves */

/*
 * Largest power of two that keeps lengths up to length_q20 below 2^30 when scaled; 0 < length_q20 <
 * 2^30.
 */
static int32_t scale_for(int32_t length_q20)
{
    CAROM_ASSERT(length_q20 > 0 && length_q20 < 1 << 30);
    return (int32_t)1 << (30 - fix_bits32((uint32_t)length_q20));
}

static void begin_leaf(struct interfere_query *q, const struct carom_leaf *leaf)
{
    q->leaf = leaf;
    q->first = q->again ? 0 : q->count;
    /* an edge is at most the sphere's diameter long, plus truncation */
    q->edge_scale = scale_for((leaf->radius_q22 >> 1) + 8);
}

/* -------------------------------------------------------------------- pairs */

/* Two faces; corner 0 of each is the one alone on its side of the other face's plane. */
struct overlap {
    const struct interfere_vec *p[3], *q[3];
    int32_t scale_p, scale_q; /* for their edges */
    int32_t near_q20;
};

FIX_APART static struct interfere_vec way(const struct interfere_vec *from,
                                          const struct interfere_vec *to, int32_t scale)
{
    return (struct interfere_vec){{(to->c[0] - from->c[0]) * scale, (to->c[1] - from->c[1]) * scale,
                                   (to->c[2] - from->c[2]) * scale}};
}

static int64_t rise(const int32_t w[3], const struct interfere_vec *from,
                    const struct interfere_vec *to)
{
    return carom_dot(w, way(from, to, 1).c);
}

/*
 * True if a direction separates the faces, q being the upper one. The result rests on all six
 * corners.
 *
 * Bounds: |w| is below 2^29. The boxes of the faces meet, so corners differ by less than 2^30, and
 * the three products sum to less than 2^61.
 */
static bool is_above(const struct overlap *m, const int32_t w[3])
{
    const struct interfere_vec *from = m->p[0];
    int64_t limit = (carom_abs(w[0]) + carom_abs(w[1]) + carom_abs(w[2])) * m->near_q20;
    int64_t gap = rise(w, from, m->q[0]), top = 0;

    CAROM_ASSERT(carom_abs(gap) < (int64_t)1 << 61);
    if (gap <= limit) {
        return false;
    }
    for (int i = 1; i < 3; i++) {
        int64_t p = rise(w, from, m->p[i]), q = rise(w, from, m->q[i]);

        top = p > top ? p : top;
        gap = q < gap ? q : gap;
    }
    return gap - top > limit;
}

/*
 * True if the direction across edges 0-k of both faces separates them, q being the upper face or
 * not. Sides and signs only choose which directions to try. Edges are scaled to below 2^30.
 */
static bool apart_across(const struct overlap *m, int k, bool upper)
{
    struct interfere_vec e = way(m->p[0], m->p[k], m->scale_p);
    struct interfere_vec f = way(m->q[0], m->q[k], m->scale_q);
    int32_t w[3];

    if (upper) {
        carom_cross(w, e.c, f.c, 32);
    } else {
        carom_cross(w, f.c, e.c, 32);
    }
    return is_above(m, w);
}

/*
 * True if a direction across an edge of one face t, p or q, in its plane, separates two faces that
 * lie in one plane.
 */
FIX_OWN_FRAME static bool apart_beside(const struct overlap *m,
                                       const struct interfere_vec *const t[3], int32_t scale)
{
    struct interfere_vec e = way(t[0], t[1], scale), w = way(t[0], t[2], scale), n;

    carom_cross(n.c, e.c, w.c, 32);
    for (int k = 0; k < 3; k++) {
        e = way(t[k], t[k == 2 ? 0 : k + 1], scale);
        /* out of p, or into q */
        if (t == m->p) {
            carom_cross(w.c, e.c, n.c, 32);
        } else {
            carom_cross(w.c, n.c, e.c, 32);
        }
        if (is_above(m, w.c)) {
            return true;
        }
    }
    return false;
}

/* The corner alone on its side of a plane, indexed by the bits of the corners above the plane. */
static const uint8_t lone[8] = {0, 0, 1, 2, 2, 1, 0, 0};

/*
 * The corners of a face above a plane, by the bits of those surely above and below it: those at the
 * plane count as above if no other is, so that a lone corner is one that parts the face.
 */
static uint32_t corners_above(uint32_t over, uint32_t under)
{
    return over != 0 ? over : 7 & ~under;
}

/*
 * True if two faces that each reach the other's plane do not meet. Where both planes
 * intersect each face covers an interval, bounded by its two edges at the lone corner. If the
 * intervals overlap the faces cross. Otherwise the direction across the two edges at the facing
 * ends separates them. The sides of the lone corners say which ends face each other.
 */
static bool intervals_apart(struct overlap *m, const struct interfere_vec *const p[3],
                            const struct interfere_vec q[3], uint32_t over_p, uint32_t over_q)
{
    static const uint8_t next[3] = {1, 2, 0}, last[3] = {2, 0, 1};
    int i = lone[over_p], j = lone[over_q];
    bool p_over = over_p == 1u << i, q_over = over_q == 1u << j, same = p_over == q_over;

    m->p[0] = p[i];
    m->p[1] = p[next[i]];
    m->p[2] = p[last[i]];
    m->q[0] = &q[j];
    m->q[1] = &q[same ? next[j] : last[j]];
    m->q[2] = &q[same ? last[j] : next[j]];
    return ((over_p == 7 || over_q == 7) &&
            (apart_beside(m, m->p, m->scale_p) || apart_beside(m, m->q, m->scale_q))) ||
           apart_across(m, 1, !q_over) || apart_across(m, 2, q_over);
}

/* Add a pair unless listed: a face lies in several cells and may come up again. */
static void add_pair(struct interfere *in, uint16_t face_a, uint16_t face_b)
{
    struct interfere_query *q = in->query;
    const struct carom_face_pair pair = {q->swapped ? face_b : face_a,
                                         q->swapped ? face_a : face_b};

    for (uint32_t i = q->first; i < q->count; i++) {
        if (q->out[i].a == pair.a && q->out[i].b == pair.b) {
            return;
        }
    }
    if (q->count == q->room) {
        in->error = CAROM_ERR_FACES_FULL;
        return;
    }
    q->out[q->count++] = pair;
}

/*
 * True if face i of the leaf and b's face may have a common point. Precondition: each reaches the
 * other's plane.
 *
 * A corner at the other's plane may count as below it or as above it: the edges that one choice
 * gives may part the faces by too little to be sure, and those of the other by far.
 */
static bool faces_cross(const struct interfere *in, const struct target *t, uint32_t i)
{
    const struct interfere_leaf *l = in->leaf;
    const uint8_t *corner = interfere_corners(in, i);
    const struct interfere_vec *const p[3] = {&l->p[corner[0]], &l->p[corner[1]], &l->p[corner[2]]};
    struct overlap m = {.scale_p = in->query->edge_scale, .near_q20 = l->near_q20};
    uint32_t over = 0, under = 0, above_p[2], above_q[2];
    int32_t size = 0;

    for (int k = 0; k < 3; k++) {
        size |= t->high.c[k] - t->low.c[k]; /* has as many bits as the largest side */
        over |= (t->over >> corner[k] & 1) << k;
        under |= (t->under >> corner[k] & 1) << k;
    }
    m.scale_q = scale_for(size);
    above_p[0] = corners_above(over, under);
    above_p[1] = 7 & ~under;
    above_q[0] = corners_above(t->corners_over, t->corners_under);
    above_q[1] = 7 & ~t->corners_under;
    for (int k = 0; k < 4; k++) {
        bool repeats =
            ((k & 1) && above_p[0] == above_p[1]) || ((k & 2) && above_q[0] == above_q[1]);

        if (!repeats && intervals_apart(&m, p, t->p, above_p[k & 1], above_q[k >> 1])) {
            return false;
        }
    }
    return true;
}

static void list_pair(struct interfere *in, const struct target *t, uint32_t i)
{
    struct interfere_query *q = in->query;

    if (q->leaf != in->leaf->leaf) {
        begin_leaf(q, in->leaf->leaf);
    }
    if (faces_cross(in, t, i) &&
        (!q->sure || q->sure->cross(q->sure, (uint16_t)interfere_face(in, i), t->number))) {
        add_pair(in, (uint16_t)interfere_face(in, i), t->number);
    }
}

/* True if b's face reaches the plane of face i of the leaf; sets corners_over and corners_under. */
static bool is_reached(struct interfere *in, struct target *t, uint32_t i)
{
    const struct interfere_plane *plane = &in->leaf->planes[i];
    int32_t above_q18, below_q18, p_q18, q_q18, r_q18;

    if (!(in->leaf->placed >> i & 1)) {
        interfere_place_plane(in, i);
    }
    above_q18 = plane->above_q18;
    below_q18 = plane->below_q18;
    p_q18 = interfere_dot(plane->n_q30, t->p[0].c);
    q_q18 = interfere_dot(plane->n_q30, t->p[1].c);
    r_q18 = interfere_dot(plane->n_q30, t->p[2].c);
    t->corners_over = interfere_is_less(above_q18, p_q18) |
                      interfere_is_less(above_q18, q_q18) << 1 |
                      interfere_is_less(above_q18, r_q18) << 2;
    t->corners_under = interfere_is_less(p_q18, below_q18) |
                       interfere_is_less(q_q18, below_q18) << 1 |
                       interfere_is_less(r_q18, below_q18) << 2;
    return t->corners_over != 7 && t->corners_under != 7;
}

/*
 * in->meet of a query: list the leaf's faces that neither boxes nor planes separate from b's face.
 */
static void meet(struct interfere *in, struct target *t)
{
    uint32_t near = interfere_faces_near(in, t);

    for (uint32_t i = 0; near != 0; i++, near >>= 1) {
        if ((near & 1) && is_reached(in, t, i)) {
            list_pair(in, t, i);
        }
    }
}

/* ------------------------------------------------------------------- bodies */

/* A side of the mesh's box along axis k, from its centre of mass. */
static int32_t side_q20(const struct carom_mesh *mesh, int side, int k)
{
    return mesh->box[side][k] * ((int32_t)1 << (20 - mesh->raw.quantum_bits)) -
           (mesh->mass.centre.c[k] >> 2);
}

/* True if the box around a's sphere, in b's axes, is apart from b's box. */
static bool sphere_apart(const struct interfere *in, const int64_t d_q32[3])
{
    int64_t around = (in->a->def.radius_q22 + BOX_MARGIN_Q22) >> 2;

    for (int k = 0; k < 3; k++) {
        int64_t at = d_q32[k] >> 12;

        if (at + around < side_q20(in->b->def.mesh, 0, k) ||
            at - around > side_q20(in->b->def.mesh, 1, k)) {
            return true;
        }
    }
    return false;
}

/* True if the box around a's own box, in b's axes, is apart from b's box. */
static bool box_apart(const struct interfere *in)
{
    const struct interfere_leaf *l = in->leaf;
    int32_t middle[3], half[3];

    for (int k = 0; k < 3; k++) {
        int32_t low = side_q20(in->a->def.mesh, 0, k), high = side_q20(in->a->def.mesh, 1, k);

        middle[k] = (low + high) / 2;
        half[k] = (high - low) / 2 + 1;
    }
    for (int k = 0; k < 3; k++) {
        int64_t at = l->at.c[k], around = BOX_MARGIN_Q22 >> 2;

        for (int i = 0; i < 3; i++) {
            at += carom_mul_q30(middle[i], l->to_b.c[k][i]);
            around += carom_mul_q30(half[i], (int32_t)carom_abs(l->to_b.c[k][i]));
        }
        if (at + around < side_q20(in->b->def.mesh, 0, k) ||
            at - around > side_q20(in->b->def.mesh, 1, k)) {
            return true;
        }
    }
    return false;
}

/*
 * Place a as seen from b. Returns false if their boxes are apart. Bounds: each point of a body is
 * within 444 units of its centre and of its origin, so if the boxes meet every place in b's frame
 * is within 1332 units and fits q20.
 */
static bool place_pair(struct interfere *in, const struct body_state *a, const struct body_state *b)
{
    carom_m3_q30 r_a, r_b;
    int64_t d_q32[3];

    fix_matrix(&r_b, &b->rotation);
    for (int k = 0; k < 3; k++) {
        d_q32[k] = a->position.c[k] - b->position.c[k];
    }
    fix_rotate_back(d_q32, &r_b, d_q32);
    if (sphere_apart(in, d_q32)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        in->leaf->at.c[k] = (int32_t)(d_q32[k] >> 12);
    }
    fix_matrix(&r_a, &a->rotation);
    interfere_relate(&in->leaf->to_b, &r_b, &r_a);
    return !box_apart(in);
}

/* The rectangle of b that a may reach, in b's quanta; everything is below 2^31 in q20. */
static struct interfere_area area_at(const struct interfere *in)
{
    int shift = 20 - in->b->def.mesh->raw.quantum_bits;
    int32_t around = (in->a->def.radius_q22 >> 2) + BOX_MARGIN_Q22;
    struct interfere_area area;

    for (int k = 0; k < 2; k++) {
        area.low[k] = (in->leaf->at.c[k] - around) >> shift;
        area.high[k] = (in->leaf->at.c[k] + around) >> shift;
    }
    return area;
}

/* Visit all leaves of a, against each chunk of b's z-lists if those are made from the pool. */
static void visit_leaves(struct interfere *in)
{
    const struct interfere_area area = area_at(in);
    struct interfere_place place = {0, 0};
    bool last = false;

    in->pooled = mesh_lists_in_step(in->b->def.mesh);
    while (!last && !in->error) {
        last = !in->pooled ||
               in->b->def.mesh->surface->does->make_lists(in, in->b->def.mesh, &area, &place);
        interfere_leaves(in);
        in->query->again = true;
    }
}

/* interfere_query if sure is NULL, else only pairs that `sure` confirms. */
static int query(struct interfere *in, struct interfere_placed a, struct interfere_placed b,
                 struct interfere_sure *sure, struct carom_face_pair *out, uint32_t room)
{
    struct interfere_query q;
    int result;

    q.sure = sure;
    q.swapped = a.body->def.mesh->raw.kind == CAROM_SURFACE;
    in->a = q.swapped ? b.body : a.body;
    in->b = q.swapped ? a.body : b.body;
    if (!place_pair(in, q.swapped ? b.state : a.state, q.swapped ? a.state : b.state)) {
        return 0;
    }
    q.out = out;
    q.room = room;
    q.count = 0;
    q.leaf = NULL;
    q.again = false;
    memset(&in->leaf->change, 0, sizeof in->leaf->change);
    memset(&in->leaf->moves, 0, sizeof in->leaf->moves);
    in->leaf->near_q22 = 0;
    in->leaf->angle_q30 = in->leaf->skew_q30 = 0;
    in->error = CAROM_OK;
    in->meet = meet;
    in->query = &q;
    visit_leaves(in);
    in->query = NULL;
    result = in->error ? in->error : (int)q.count;
    in->error = CAROM_OK;
    return result;
}

int interfere_query(struct interfere *in, struct interfere_placed a, struct interfere_placed b,
                    struct carom_face_pair *out, uint32_t room)
{
    return query(in, a, b, NULL, out, room);
}

bool interfere_query_sure(struct interfere *in, struct interfere_placed a,
                          struct interfere_placed b, struct interfere_sure *sure)
{
    CAROM_ASSERT(a.body->def.mesh->raw.kind == CAROM_SOLID);
    return query(in, a, b, sure, NULL, 0) !=
           0; /* room is 0: the first pair found ends the search with an error */
}
