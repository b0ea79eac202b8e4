/* SPDX-License-Identifier: MIT */
/* From two faces that are near to the features of theirs that can touch, and the lists of both. */
#include "interfere_narrow.h"

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

/* ------------------------------------------------------- interfering faces */

static uint32_t face_key(struct carom_face_ref f)
{
    return (uint32_t)f.body << 16 | f.face;
}

static void sift_down(struct carom_face_ref *heap, uint32_t at, uint32_t n)
{
    struct carom_face_ref moving = heap[at];

    while (2 * at + 1 < n) {
        uint32_t child = 2 * at + 1;

        if (child + 1 < n && face_key(heap[child]) < face_key(heap[child + 1])) {
            child++;
        }
        if (face_key(heap[child]) <= face_key(moving)) {
            break;
        }
        heap[at] = heap[child];
        at = child;
    }
    heap[at] = moving;
}

void interfere_finish(struct interfere *w)
{
    struct carom_face_ref *f = w->faces;
    uint32_t n = w->face_pool->used, kept = 0;

    for (uint32_t i = n / 2; i-- > 0;) {
        sift_down(f, i, n);
    }
    for (uint32_t end = n; end-- > 1;) {
        struct carom_face_ref top = f[0];

        f[0] = f[end];
        f[end] = top;
        sift_down(f, 0, end);
    }
    for (uint32_t i = 0; i < n; i++) {
        if (kept == 0 || face_key(f[i]) != face_key(f[kept - 1])) {
            f[kept++] = f[i];
        }
    }
    w->face_pool->used = kept;
    if (kept > w->face_pool->peak) {
        w->face_pool->peak = kept;
    }
}

/* Whether a face is in the list, which must be sorted. */
static bool has_face(const struct interfere *w, struct carom_face_ref face)
{
    uint32_t low = 0, high = w->face_pool->used;

    while (low < high) {
        uint32_t middle = (low + high) / 2;

        if (face_key(w->faces[middle]) < face_key(face)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < w->face_pool->used && face_key(w->faces[low]) == face_key(face);
}

static void add_face(struct interfere *w, uint16_t body, uint16_t face)
{
    struct carom_face_ref ref = {body, face};
    struct pool *pool = w->face_pool;

    if (pool->used == pool->size) {
        interfere_finish(w); /* most of a full list are repetitions */
        if (has_face(w, ref)) {
            return;
        }
    }
    if (pool->used == pool->size) {
        pool->refused++;
        w->error = CAROM_ERR_FACES_FULL;
        return;
    }
    w->faces[pool->used++] = ref;
}

/* -------------------------------------------------------------- candidates */

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

/* Distance of p from the plane through q with normal n, q22. */
static int64_t above(const carom_v3_q30 *n, const carom_v3_q22 *p, const carom_v3_q22 *q)
{
    int32_t d[3];

    for (int k = 0; k < 3; k++) {
        d[k] = p->c[k] - q->c[k];
    }
    return carom_dot(n->c, d) >> 30;
}

/* Whether p lies over the triangle grown by the reach on all sides, seen along its normal. */
static bool over_triangle(const struct interfere *w, const carom_v3_q22 *p, const carom_v3_q22 t[3],
                          const carom_v3_q30 *n)
{
    for (int k = 0; k < 3; k++) {
        const carom_v3_q22 *from = &t[k], *to = &t[(k + 1) % 3];
        int32_t edge[3], in[3], d[3];
        int64_t length = 0;

        for (int i = 0; i < 3; i++) {
            edge[i] = to->c[i] - from->c[i];
            d[i] = p->c[i] - from->c[i];
            length += carom_abs(edge[i]); /* at least the edge's length: errs to the outside */
        }
        carom_cross(in, n->c, edge, 30);
        /* q22 x q22 = q44: within the mesh and its surroundings below 2^62 */
        if (carom_dot(in, d) < -length * w->reach_q22) {
            return false;
        }
    }
    return true;
}

static int32_t cone_tolerance(const struct interfere *w)
{
    int64_t sum = (int64_t)INTERFERE_CONE_Q30 + w->turn_q30;

    return sum > CAROM_ONE_Q30 ? CAROM_ONE_Q30 : (int32_t)sum;
}

/* Owned vertices of `from` against the face `to`; both given in b's frame. */
static bool vertex_face(struct interfere *w, const struct interfere_face *from,
                        const struct interfere_face *to, uint8_t kind)
{
    const struct carom_mesh *mesh = kind == CANDIDATE_VERTEX_FACE ? w->a->mesh : w->b->mesh;
    bool any = false;

    for (int k = 0; k < 3; k++) {
        uint32_t v = mesh->raw.faces[from->number][k];
        carom_v3_q30 n = to->normal;

        if (!(from->face->own & (1 << k)) ||
            carom_abs(above(&to->normal, &from->p[k], &to->p[0])) > w->reach_q22 ||
            !over_triangle(w, &from->p[k], to->p, &to->normal)) {
            continue;
        }
        if (kind == CANDIDATE_VERTEX_FACE) {
            carom_rotate_back(n.c, &w->to_b, n.c);
        }
        if (mesh_vertex_cone(mesh, v, n.c, cone_tolerance(w))) {
            emit(w, kind, v, to->number);
            any = true;
        }
    }
    return any;
}

/*
 * Whether two edges with directions e, f and start points d apart can come within reach: distance
 * of their lines, and the places of nearest approach. w = e x f, |w| the sine of their angle.
 * Points that meet were within reach of each other at the start, so on lines at that angle they lie
 * within reach / sine of the nearest approach.
 */
static bool lines_near(const struct interfere *in, const struct carom_edge *ea, const int32_t e[3],
                       const struct carom_edge *eb, const int32_t d[3], const int32_t w[3],
                       int64_t sine_q30)
{
    const int32_t *f = eb->direction.c;
    int64_t limit = in->reach_q22 * sine_q30; /* q52 */
    int64_t cos_q30, de_q22, df_q22, s_q22, q_q22, sine2_q30, slack_q22;

    if (carom_abs(carom_dot(w, d)) > limit) {
        return false;
    }
    cos_q30 = carom_round(carom_dot(e, f), 30);
    de_q22 = carom_round(carom_dot(e, d), 30);
    df_q22 = carom_round(carom_dot(f, d), 30);
    sine2_q30 = (sine_q30 * sine_q30) >> 30;
    slack_q22 = (limit >> 30) + 8;
    s_q22 = fix_mul(df_q22, (int32_t)cos_q30, 30) - de_q22; /* times sine^2 */
    q_q22 = df_q22 - fix_mul(de_q22, (int32_t)cos_q30, 30);
    return s_q22 >= -slack_q22 && q_q22 >= -slack_q22 &&
           s_q22 <= ((ea->length_q22 * sine2_q30) >> 30) + slack_q22 &&
           q_q22 <= ((eb->length_q22 * sine2_q30) >> 30) + slack_q22;
}

/*
 * Whether +w or -w can be the normal: it must lie in the normal cones of both edges (Gauss arcs).
 */
static bool arcs_meet(const struct interfere *in, const struct carom_edge *ea,
                      const struct carom_edge *eb, const int32_t w[3], int64_t sine_q30)
{
    /* the angle turned moves w / |w| by up to turn / sine; all is multiplied by the sine */
    int64_t tolerance_q60 =
        ((int64_t)INTERFERE_CONE_Q30 + in->turn_q30) * sine_q30 + ((int64_t)in->turn_q30 << 30);
    bool plus = true, minus = true;
    int32_t w_a[3];

    carom_rotate_back(w_a, &in->to_b, w);
    for (int side = 0; side < 2; side++) {
        carom_v3_q30 in_a = mesh_edge_inward(in->a->mesh, ea, side);
        carom_v3_q30 in_b = mesh_edge_inward(in->b->mesh, eb, side);
        int64_t on_a = carom_dot(w_a, in_a.c), on_b = carom_dot(w, in_b.c);

        plus = plus && on_b <= tolerance_q60 && -on_a <= tolerance_q60;
        minus = minus && -on_b <= tolerance_q60 && on_a <= tolerance_q60;
    }
    return plus || minus;
}

static bool edges_near(const struct interfere *in, const struct carom_edge *ea,
                       const carom_v3_q22 pa[2], const struct carom_edge *eb,
                       const carom_v3_q22 pb[2])
{
    carom_v3_q30 e;
    int32_t w[3], d[3];
    int64_t sine_q30;

    for (int k = 0; k < 3; k++) {
        int32_t grow = in->reach_q22;
        int32_t a0 = pa[0].c[k], a1 = pa[1].c[k], b0 = pb[0].c[k], b1 = pb[1].c[k];

        if ((a0 < b0 - grow && a0 < b1 - grow && a1 < b0 - grow && a1 < b1 - grow) ||
            (a0 > b0 + grow && a0 > b1 + grow && a1 > b0 + grow && a1 > b1 + grow)) {
            return false;
        }
        d[k] = a0 - b0;
    }
    carom_rotate(e.c, &in->to_b, ea->direction.c);
    carom_cross(w, e.c, eb->direction.c, 30);
    sine_q30 = (int64_t)fix_sqrt((uint64_t)carom_dot(w, w)) + 1;
    if (sine_q30 < CAROM_ONE_Q30 / 64 + (int64_t)in->turn_q30) {
        return true; /* may be parallel somewhere on the way: leave it to the exact test */
    }
    return lines_near(in, ea, e.c, eb, d, w, sine_q30) && arcs_meet(in, ea, eb, w, sine_q30);
}

static bool edge_edge(struct interfere *w, const struct interfere_face *a,
                      const struct interfere_face *b)
{
    bool any = false;

    for (int i = 0; i < 3; i++) {
        const struct carom_edge *ea = &w->a->mesh->edges[a->face->edge[i]];
        carom_v3_q22 pa[2] = {a->p[i], a->p[(i + 1) % 3]}; /* an owned edge runs with its face */

        if (!(a->face->own & (8 << i))) {
            continue;
        }
        for (int j = 0; j < 3; j++) {
            const struct carom_edge *eb = &w->b->mesh->edges[b->face->edge[j]];
            carom_v3_q22 pb[2] = {b->p[j], b->p[(j + 1) % 3]};

            if ((b->face->own & (8 << j)) && edges_near(w, ea, pa, eb, pb)) {
                emit(w, CANDIDATE_EDGE_EDGE, a->face->edge[i], b->face->edge[j]);
                any = true;
            }
        }
    }
    return any;
}

/*
 * Set up face b, unless its box is farther than the reach from that of face a (which is grown by
 * it). Most pairs end here.
 */
static bool boxes_meet(const struct interfere *w, const struct interfere_face *a,
                       struct interfere_face *b)
{
    const struct carom_mesh *mb = w->b->mesh;

    for (int k = 0; k < 3; k++) {
        b->p[k] = mesh_corner(mb, b->number, k);
    }
    for (int k = 2; k >= 0; k--) {
        int32_t x = b->p[0].c[k], y = b->p[1].c[k], z = b->p[2].c[k];

        if ((x > a->high.c[k] && y > a->high.c[k] && z > a->high.c[k]) ||
            (x < a->low.c[k] && y < a->low.c[k] && z < a->low.c[k])) {
            return false;
        }
    }
    b->face = &mb->faces[b->number];
    b->normal = b->face->normal;
    return true;
}

/* Whether all corners of t lie on one side of the plane of `plane`, farther than the reach. */
static bool apart(const struct interfere *w, const struct interfere_face *t,
                  const struct interfere_face *plane)
{
    int over = 0, under = 0;

    for (int k = 0; k < 3; k++) {
        int64_t height = above(&plane->normal, &t->p[k], &plane->p[0]);

        over += height > w->reach_q22;
        under += height < -w->reach_q22;
    }
    return over == 3 || under == 3;
}

void interfere_narrow(struct interfere *w, uint16_t leaf_face, uint16_t face_b)
{
    struct interfere_face *a = &w->leaf_faces[leaf_face];
    struct interfere_face b = {.number = face_b};
    bool any;

    if (!boxes_meet(w, a, &b) || apart(w, a, &b)) {
        return;
    }
    carom_rotate(a->normal.c, &w->to_b, a->face->normal.c);
    if (apart(w, &b, a)) {
        return;
    }
    any = vertex_face(w, a, &b, CANDIDATE_VERTEX_FACE);
    any |= vertex_face(w, &b, a, CANDIDATE_FACE_VERTEX);
    any |= edge_edge(w, a, &b);
    if (any) {
        add_face(w, w->body_a, a->number);
        add_face(w, w->body_b, b.number);
    }
}
