/* SPDX-License-Identifier: MIT */
/*
 * The closest points of two bodies that are apart: a vertex over a face, or two edges. All places
 * are in b's axes, from b's centre of mass. Pairs of leaves whose spheres, and pairs of faces whose
 * boxes, are farther apart than the best distance so far are skipped.
 */
#include "query.h"
#include "../interfere/narrow.h"

/* Bodies may be this far apart along an axis of b, so that places fit 2^33 in q22. */
#define FAR_Q32 ((int64_t)500 << 32)
/* Edges count as parallel if the sine squared is below this, q30. */
#define PARALLEL_Q30 (1 << 8)

struct point {
    int64_t c[3]; /* q22 */
};

struct nearest {
    const struct body *body[2];
    carom_m3_q30 axes; /* from a's axes to b's */
    int64_t at_q22[3]; /* a's centre of mass */

    /* vertices of a's leaf at hand */
    struct point p[CAROM_LEAF_VERTICES];

    uint64_t best_q40; /* square of the best distance */
    struct point point[2];
    uint16_t face[2];
};

static struct point placed(const struct nearest *n, uint32_t vertex)
{
    carom_v3_q22 v = mesh_vertex(n->body[0]->def.mesh, vertex);
    struct point p;

    for (int k = 0; k < 3; k++) {
        p.c[k] = carom_round(carom_dot(n->axes.c[k], v.c), 30) + n->at_q22[k];
    }
    return p;
}

static struct point of_b(const struct nearest *n, uint32_t vertex)
{
    carom_v3_q22 v = mesh_vertex(n->body[1]->def.mesh, vertex);

    return (struct point){{v.c[0], v.c[1], v.c[2]}};
}

/* Differences are below 2^33 in q22 and 2^31 in q20, sums of squares below 2^64. */
static uint64_t square_q40(const struct point *p, const struct point *q)
{
    uint64_t sum = 0;

    for (int k = 0; k < 3; k++) {
        int64_t d = (p->c[k] - q->c[k]) >> 2;

        sum += (uint64_t)(d * d);
    }
    return sum;
}

/* The displacement from one place to another along a direction, q22. */
static int64_t along_q22(const struct point *from, const struct point *to, const int32_t n_q30[3])
{
    int64_t d[3];

    for (int k = 0; k < 3; k++) {
        d[k] = to->c[k] - from->c[k];
    }
    return fix_dot_q30(d, n_q30);
}

static struct point moved(const struct point *p, int64_t by_q22, const int32_t n_q30[3])
{
    struct point to;

    for (int k = 0; k < 3; k++) {
        to.c[k] = p->c[k] + fix_mul_q30(by_q22, n_q30[k]);
    }
    return to;
}

/* Keep two points if they are the closest so far. */
static void offer(struct nearest *n, const struct point *a, const struct point *b, uint16_t face_a,
                  uint16_t face_b)
{
    uint64_t square = square_q40(a, b);

    if (square < n->best_q40) {
        n->best_q40 = square;
        n->point[0] = *a;
        n->point[1] = *b;
        n->face[0] = face_a;
        n->face[1] = face_b;
    }
}

/* ------------------------------------------------------------------- features */

/*
 * A face in b's axes: corners, normal, and the directions of its edges, running from corner to
 * corner.
 */
struct facet {
    uint16_t number;
    struct point p[3];
    int32_t n_q30[3], e_q30[3][3], length_q22[3];
    int64_t low[3], high[3];
};

/* Turn a direction of a's (side 0) or b's mesh into b's axes. */
static void turned(const struct nearest *n, int side, int32_t out[3], const int32_t d[3])
{
    if (side == 0) {
        carom_rotate(out, &n->axes, d);
    } else {
        memcpy(out, d, 3 * sizeof d[0]);
    }
}

static void set_box(struct facet *f)
{
    for (int k = 0; k < 3; k++) {
        f->low[k] = f->high[k] = f->p[0].c[k];
        for (int i = 1; i < 3; i++) {
            f->low[k] = f->p[i].c[k] < f->low[k] ? f->p[i].c[k] : f->low[k];
            f->high[k] = f->p[i].c[k] > f->high[k] ? f->p[i].c[k] : f->high[k];
        }
    }
}

static void set_directions(const struct nearest *n, int side, struct facet *f)
{
    const struct carom_mesh *mesh = n->body[side]->def.mesh;

    turned(n, side, f->n_q30, mesh->faces[f->number].normal.c);
    for (int k = 0; k < 3; k++) {
        const struct carom_edge *edge = &mesh->edges[mesh->faces[f->number].edge[k]];
        const bool back = edge->vertex[0] != mesh->raw.faces[f->number][k];

        turned(n, side, f->e_q30[k], edge->direction.c);
        f->length_q22[k] = edge->length_q22;
        for (int i = 0; back && i < 3; i++) {
            f->e_q30[k][i] = -f->e_q30[k][i];
        }
    }
}

/* Offer a corner of one face and its foot on the other face, if that is inside all three edges. */
static void try_corner(struct nearest *n, const struct point *p, const struct facet *on, int side,
                       uint16_t face)
{
    int64_t height = along_q22(&on->p[0], p, on->n_q30);
    struct point foot = moved(p, -height, on->n_q30);

    for (int k = 0; k < 3; k++) {
        int32_t in_q30[3];

        carom_cross(in_q30, on->n_q30, on->e_q30[k], 30);
        if (along_q22(&on->p[k], &foot, in_q30) < 0) {
            return;
        }
    }
    if (side == 0) {
        offer(n, p, &foot, face, on->number);
    } else {
        offer(n, &foot, p, on->number, face);
    }
}

static int64_t clamped(int64_t s, int64_t length)
{
    return s < 0 ? 0 : s > length ? length : s;
}

/*
 * Offer the closest points of two edges p + s e and q + t f. s = (b g - c) / (1 - b^2) with b =
 * e.f, c = e.r, g = f.r, r = p - q; then t from s, clamped, and s again from t. Bounds: c and g are
 * below 2^34, so with 4 bits dropped the dividend is below 2^62.
 */
static void try_edges(struct nearest *n, const struct facet *a, int i, const struct facet *b, int j)
{
    const int32_t *e = a->e_q30[i], *f = b->e_q30[j];
    int64_t b_q30 = carom_dot(e, f) >> 30, s = 0, t;
    int64_t rest_q30 = CAROM_ONE_Q30 - (b_q30 * b_q30 >> 30);
    int64_t c = along_q22(&b->p[j], &a->p[i], e), g = along_q22(&b->p[j], &a->p[i], f);
    struct point on[2];

    if (rest_q30 > PARALLEL_Q30) {
        s = clamped((fix_mul(g, (int32_t)b_q30, 30) - c) * (1 << 26) / (rest_q30 >> 4),
                    a->length_q22[i]);
    }
    t = clamped(g + fix_mul_q30(s, (int32_t)b_q30), b->length_q22[j]);
    s = clamped(fix_mul_q30(t, (int32_t)b_q30) - c, a->length_q22[i]);
    t = clamped(g + fix_mul_q30(s, (int32_t)b_q30), b->length_q22[j]);
    on[0] = moved(&a->p[i], s, e);
    on[1] = moved(&b->p[j], t, f);
    offer(n, &on[0], &on[1], a->number, b->number);
}

/* True if the boxes of two faces are farther apart than the best distance so far. */
static bool boxes_far(const struct nearest *n, const struct facet *a, const struct facet *b)
{
    uint64_t sum = 0;

    for (int k = 0; k < 3; k++) {
        int64_t d = a->low[k] > b->high[k] ? a->low[k] - b->high[k] : b->low[k] - a->high[k];

        d = d > 0 ? d >> 2 : 0;
        sum += (uint64_t)(d * d);
    }
    return sum >= n->best_q40;
}

static void try_faces(struct nearest *n, struct facet *a, struct facet *b)
{
    set_directions(n, 0, a);
    set_directions(n, 1, b);
    for (int i = 0; i < 3; i++) {
        try_corner(n, &a->p[i], b, 0, a->number);
        try_corner(n, &b->p[i], a, 1, b->number);
        for (int j = 0; j < 3; j++) {
            try_edges(n, a, i, b, j);
        }
    }
}

/* --------------------------------------------------------------------- leaves */

/* Square of the distance between the centres of two leaves, q24. */
static int64_t apart_q24(const int64_t centre[3], const struct carom_leaf *b)
{
    int64_t sum = 0;

    for (int k = 0; k < 3; k++) {
        int64_t d = (centre[k] - b->centre.c[k]) >> 10;

        sum += d * d;
    }
    return sum;
}

static void leaf_centre(const struct nearest *n, const struct carom_leaf *a, int64_t centre[3])
{
    for (int k = 0; k < 3; k++) {
        centre[k] = carom_round(carom_dot(n->axes.c[k], a->centre.c), 30) + n->at_q22[k];
    }
}

static void try_leaves(struct nearest *n, const struct carom_leaf *a, const struct carom_leaf *b)
{
    const struct carom_mesh *ma = n->body[0]->def.mesh, *mb = n->body[1]->def.mesh;

    for (uint32_t i = a->first_face; i < a->first_face + a->face_count; i++) {
        struct facet f = {.number = ma->leaf_faces[i]};

        for (int k = 0; k < 3; k++) {
            f.p[k] = n->p[ma->leaf_corners[i][k]];
        }
        set_box(&f);
        for (uint32_t j = b->first_face; j < b->first_face + b->face_count; j++) {
            struct facet g = {.number = mb->leaf_faces[j]};

            for (int k = 0; k < 3; k++) {
                g.p[k] = of_b(n, mb->raw.faces[g.number][k]);
            }
            set_box(&g);
            if (!boxes_far(n, &f, &g)) {
                try_faces(n, &f, &g);
            }
        }
    }
}

static void place_leaf(struct nearest *n, const struct carom_leaf *a)
{
    for (int i = 0; i < a->vertex_count; i++) {
        n->p[i] = placed(n, n->body[0]->def.mesh->leaf_vertices[a->first_vertex + (uint32_t)i]);
    }
}

/* Try the two leaves whose centres are closest, for a good first distance. */
static void begin_nearest(struct nearest *n)
{
    const struct carom_mesh *ma = n->body[0]->def.mesh, *mb = n->body[1]->def.mesh;
    const struct carom_leaf *best[2] = {ma->leaves, mb->leaves};
    int64_t least = INT64_MAX, centre[3];

    for (uint32_t i = 0; i < ma->leaf_count; i++) {
        leaf_centre(n, &ma->leaves[i], centre);
        for (uint32_t j = 0; j < mb->leaf_count; j++) {
            int64_t apart = apart_q24(centre, &mb->leaves[j]);

            if (apart < least) {
                least = apart;
                best[0] = &ma->leaves[i];
                best[1] = &mb->leaves[j];
            }
        }
    }
    place_leaf(n, best[0]);
    try_leaves(n, best[0], best[1]);
}

/* Try all pairs of leaves whose spheres are within the best distance so far. */
static void search(struct nearest *n)
{
    const struct carom_mesh *ma = n->body[0]->def.mesh, *mb = n->body[1]->def.mesh;

    for (uint32_t i = 0; i < ma->leaf_count; i++) {
        const struct carom_leaf *a = &ma->leaves[i];
        bool is_placed = false;
        int64_t centre[3], reach_q12 = (int64_t)(fix_sqrt(n->best_q40) >> 8) + 4;

        leaf_centre(n, a, centre);
        for (uint32_t j = 0; j < mb->leaf_count; j++) {
            const struct carom_leaf *b = &mb->leaves[j];
            int64_t reach = reach_q12 + ((a->radius_q22 + b->radius_q22) >> 10);

            if (apart_q24(centre, b) > reach * reach) {
                continue;
            }
            if (!is_placed) {
                place_leaf(n, a);
                is_placed = true;
            }
            try_leaves(n, a, b);
            reach_q12 = (int64_t)(fix_sqrt(n->best_q40) >> 8) + 4;
        }
    }
}

/* Turn the result from b's axes to the world's. */
static void complete(const struct nearest *n, const struct body_state *b, struct carom_closest *out)
{
    carom_m3_q30 r;
    int64_t d[3];

    fix_matrix(&r, &b->rotation);
    for (int side = 0; side < 2; side++) {
        for (int k = 0; k < 3; k++) {
            d[k] = carom_shl(n->point[side].c[k], 10);
        }
        fix_rotate(d, &r, d);
        for (int k = 0; k < 3; k++) {
            out->point[side].c[k] = b->position.c[k] + d[k];
        }
        out->face[side] = n->face[side];
    }
    for (int k = 0; k < 3; k++) {
        d[k] = out->point[0].c[k] - out->point[1].c[k];
    }
    out->distance_q32 = fix_length(d);
    out->normal = (carom_v3_q30){{0, 0, 0}};
    fix_normalise(&out->normal, d);
}

static bool overlap(struct carom_world *w, int a, int b)
{
    return carom_query_faces(w, a, b, NULL, 0) != 0 || carom_query_inside(w, a, b) > 0 ||
           (w->bodies[a].def.mesh->raw.kind == CAROM_SOLID &&
            w->bodies[b].def.mesh->raw.kind == CAROM_SOLID && carom_query_inside(w, b, a) > 0);
}

/* Search both bodies, whose centres are less than FAR_Q32 from each other, in b's axes. */
static FIX_OWN_FRAME void find_nearest(const struct carom_world *world, int a, int b,
                                       const int64_t at_q32[3], const carom_m3_q30 r[2],
                                       struct carom_closest *out)
{
    struct nearest n;

    interfere_relate(&n.axes, &r[1], &r[0]);
    for (int k = 0; k < 3; k++) {
        n.at_q22[k] = carom_round(at_q32[k], 10);
    }
    n.body[0] = &world->bodies[a];
    n.body[1] = &world->bodies[b];
    n.best_q40 = UINT64_MAX;
    begin_nearest(&n);
    search(&n);
    complete(&n, &world_now(world)->bodies[b], out);
}

int carom_closest_points(struct carom_world *world, int a, int b, struct carom_closest *out)
{
    const struct body_state *states;
    carom_m3_q30 r[2];
    int64_t at_q32[3];

    if (!world || !out) {
        return CAROM_ERR_NULL;
    }
    if (!world_find_body(world, &a) || !world_find_body(world, &b)) {
        return CAROM_ERR_BODY;
    }
    if (a == b) {
        return CAROM_ERR_ARGUMENT;
    }
    states = world_now(world)->bodies;
    for (int k = 0; k < 3; k++) {
        at_q32[k] = states[a].position.c[k] - states[b].position.c[k];
    }
    fix_matrix(&r[0], &states[a].rotation);
    fix_matrix(&r[1], &states[b].rotation);
    fix_rotate_back(at_q32, &r[1], at_q32);
    if (!world_each_within(at_q32, FAR_Q32)) {
        return CAROM_ERR_RANGE;
    }
    if (overlap(world, a, b)) {
        return CAROM_ERR_OVERLAP;
    }
    find_nearest(world, a, b, at_q32, r, out);
    return CAROM_OK;
}
