/* SPDX-License-Identifier: MIT */
/*
 * The early test: can two features meet on the path at all?
 *
 * Along a fixed axis a point that starts as x + x' t is at most bend t^2 from there. So two points
 * are at least gap + t rate - t^2 bend apart: concave in t, least at an end of [0, 1]. If that
 * stays above the tolerance at both ends the features do not meet. The axes are the normal and,
 * across it, the directions along which one feature can lie beside the other.
 *
 * Nearly every candidate ends here, so speed decides the form. Lengths are high words of products,
 * q20; tolerances include the truncation. Loops over three components are written out, because
 * compilers leave them as loops. Features of a candidate start within 1000 units of each other and
 * move less than 512; 2048 fit.
 */
#include "place.h"

/* BOYSE_NEAR_Q22, and 6 units for truncation. */
#define NEAR_Q20 (BOYSE_NEAR_Q22 / 4 + 6)
/*
 * The same along edges: the exact test locates the meeting place of nearly parallel edges only
 * roughly.
 */
#define BESIDE_Q20 24
/* Truncation of a bend and a rate. */
#define BEND_SLACK_Q20 8

/* Unsigned, because after the shift of a signed number gcc would carry on with 64 bits. */
static inline int32_t cut(int64_t v, int shift)
{
    return (int32_t)(uint32_t)((uint64_t)v >> shift);
}

static inline int32_t dot(const int32_t a[3], const int32_t b[3], int shift)
{
    return cut(carom_dot(a, b), shift);
}

struct vec {
    int32_t c[3];
};

static inline struct vec cross(const int32_t a[3], const int32_t b[3], int shift)
{
    return (struct vec){{cut((int64_t)a[1] * b[2] - (int64_t)a[2] * b[1], shift),
                         cut((int64_t)a[2] * b[0] - (int64_t)a[0] * b[2], shift),
                         cut((int64_t)a[0] * b[1] - (int64_t)a[1] * b[0], shift)}};
}

/* A point of from's mesh in view axes, at the start. */
static inline struct vec place_q20(const struct boyse_view *view, const carom_v3_q22 *p)
{
    return (struct vec){{dot(view->r.c[0], p->c, 32) + (view->centre.c[0] >> 2),
                         dot(view->r.c[1], p->c, 32) + (view->centre.c[1] >> 2),
                         dot(view->r.c[2], p->c, 32) + (view->centre.c[2] >> 2)}};
}

static inline bool stays_above(int32_t gap, int32_t rate, int32_t bend, int32_t near)
{
    return gap > near && gap + rate - bend > near;
}

/* ------------------------------------------------------------------ vertex, face */

/* True if the vertex at x stays beyond one side of the face. */
static bool vertex_stays_beside(const struct boyse_view *view, uint32_t face, const struct vec *x,
                                const struct vec *velocity)
{
    const struct carom_mesh *mesh = view->to->def.mesh;
    int32_t bend_q20 = (view->seen.bend_q22 >> 2) + BEND_SLACK_Q20;

    for (int k = 0; k < 3; k++) {
        const struct carom_edge *edge = &mesh->edges[mesh->faces[face].edge[k]];
        carom_v3_q30 in = mesh_edge_inward(mesh, edge, edge->face[0] == face ? 0 : 1);
        carom_v3_q22 corner = mesh_corner(mesh, face, k);
        const struct vec to_corner = {{(corner.c[0] >> 2) - x->c[0], (corner.c[1] >> 2) - x->c[1],
                                       (corner.c[2] >> 2) - x->c[2]}};
        int32_t beyond_q20 = dot(in.c, to_corner.c, 30);

        if (stays_above(beyond_q20, -dot(in.c, velocity->c, 30), bend_q20, NEAR_Q20)) {
            return true;
        }
    }
    return false;
}

static bool vertex_may_meet(const struct boyse_pair *pair, const struct candidate *c)
{
    const struct boyse_view *view = boyse_view(pair, c);
    const struct carom_mesh *mesh = view->to->def.mesh;
    const struct carom_face *face = &mesh->faces[c->j];
    const carom_v3_q22 vertex = mesh_vertex(view->from->def.mesh, c->i);
    const struct vec x = place_q20(view, &vertex);
    const int32_t *n = face->normal.c;
    /*
     * a vertex that starts below the face must come up before it can hit; one that touches goes on
     * to the exact test
     */
    int32_t below_q20 = (pair->skin_q22 >> 3) + NEAR_Q20, way_q20 = view->seen.way_q22 >> 2;
    int32_t gap_q20 = dot(n, x.c, 30) - (face->offset_q22 >> 2), rate_q20, bend_q20;
    struct vec velocity;

    if (gap_q20 - way_q20 > NEAR_Q20 || gap_q20 + way_q20 < -below_q20) {
        return false;
    }
    velocity = cross(view->u_relative.c, x.c, 29);
    velocity.c[0] += view->field.c[0] >> 2;
    velocity.c[1] += view->field.c[1] >> 2;
    velocity.c[2] += view->field.c[2] >> 2;
    rate_q20 = dot(n, velocity.c, 30);
    bend_q20 = (view->seen.bend_q22 >> 2) + BEND_SLACK_Q20;
    if (gap_q20 < -below_q20 && mesh_two_sided(mesh)) {
        /* it may hit the other side */
        if (stays_above(-gap_q20, -rate_q20, bend_q20, NEAR_Q20)) {
            return false;
        }
    } else if (gap_q20 < -below_q20) {
        /* it must rise above the plane, then fall: the bend must be able to flip the rate's sign */
        if (gap_q20 + rate_q20 + bend_q20 <= -below_q20 || rate_q20 >= 3 * bend_q20) {
            return false;
        }
    } else if (stays_above(gap_q20, rate_q20, bend_q20, NEAR_Q20)) {
        return false;
    }
    return !vertex_stays_beside(view, c->j, &x, &velocity);
}

/* ------------------------------------------------------------------- edge, edge */

/*
 * A linear quantity along an edge: its value at the edge's start, and its growth to the edge's end.
 */
struct stretch {
    int32_t start, more;
};

static inline int32_t least(struct stretch s)
{
    return s.start + (s.more < 0 ? s.more : 0);
}

static inline int32_t most(struct stretch s)
{
    return s.start + (s.more > 0 ? s.more : 0);
}

/*
 * Speed along an axis of the edge's points by the turn u of their body: axis . 2 u x p = 2 (axis x
 * u) . p. `bits` is the format of `direction`.
 */
static inline struct stretch turning_rate(const struct vec *axis, const carom_v3_q30 *u,
                                          const struct vec *start_q20, const int32_t direction[3],
                                          int bits, int32_t length_q22)
{
    const struct vec turn = cross(axis->c, u->c, 32); /* q28 */
    int32_t growth_q31 = dot(turn.c, direction, bits - 3);

    return (struct stretch){dot(turn.c, start_q20->c, 27),
                            cut((int64_t)growth_q31 * length_q22, 32)};
}

/* |axis|_1 >= |axis| */
static inline uint32_t size_of(const struct vec *axis)
{
    return (uint32_t)fix_abs32(axis->c[0]) + (uint32_t)fix_abs32(axis->c[1]) +
           (uint32_t)fix_abs32(axis->c[2]);
}

/* A q22 length times |axis|, in q20. */
static inline int32_t scaled(uint32_t size_q30, int32_t length_q22)
{
    return (int32_t)((uint64_t)size_q30 * (uint32_t)length_q22 >> 32);
}

/*
 * Two edges at the start, in b's axes: places and d (from b's start to a's) in q20, directions e
 * and f.
 */
struct edge_lines {
    const struct carom_edge *edge_a, *edge_b;
    struct vec start_a, start_b, d, e_q28;
    const int32_t *f;
};

/* True if the edges stay apart along an axis of length at most 1. */
static bool edges_stay_beside(const struct boyse_view *view, const struct edge_lines *l,
                              const struct vec *axis)
{
    const struct body_path *path_b = body_path(view->to);
    int32_t length_a = l->edge_a->length_q22, length_b = l->edge_b->length_q22;
    int32_t slope_a = dot(axis->c, l->e_q28.c, 28), slope_b = dot(axis->c, l->f, 30);
    uint32_t size = size_of(axis);
    int32_t near = scaled(size, 4 * BESIDE_Q20) + 6;
    int32_t bend = scaled(size, view->fixed.bend_q22) + BEND_SLACK_Q20;
    struct stretch a0 = {dot(axis->c, l->d.c, 30), cut((int64_t)slope_a * length_a, 32)};
    struct stretch b0 = {0, cut((int64_t)slope_b * length_b, 32)};
    struct stretch a1 = turning_rate(axis, &view->u, &l->start_a, l->e_q28.c, 28, length_a);
    struct stretch b1 = {0, 0};

    if (path_b->turns) {
        b1 = turning_rate(axis, &path_b->u, &l->start_b, l->f, 30, length_b);
    }
    /* from rates to places at the end of the path, without the bend */
    a1.start += a0.start + dot(axis->c, view->field.c, 32);
    a1.more += a0.more;
    b1.more += b0.more;
    return (least(a0) - most(b0) > near && least(a1) - most(b1) - bend > near) ||
           (least(b0) - most(a0) > near && least(b1) - most(a1) - bend > near);
}

static bool edges_may_meet(const struct boyse_pair *pair, const struct candidate *c)
{
    const struct boyse_view *view = &pair->view[0];
    const struct carom_edge *edge_a = &pair->a->def.mesh->edges[c->i];
    const struct carom_edge *edge_b = &pair->b->def.mesh->edges[c->j];
    const int32_t *direction = edge_a->direction.c, *f = edge_b->direction.c;
    const carom_v3_q22 local_a = mesh_vertex(pair->a->def.mesh, edge_a->vertex[0]);
    const carom_v3_q22 local_b = mesh_vertex(pair->b->def.mesh, edge_b->vertex[0]);
    const struct vec p = place_q20(view, &local_a);
    const struct vec q = {{local_b.c[0] >> 2, local_b.c[1] >> 2, local_b.c[2] >> 2}};
    const struct vec d = {{p.c[0] - q.c[0], p.c[1] - q.c[1], p.c[2] - q.c[2]}};
    const struct vec e_q28 = {{dot(view->r.c[0], direction, 32), dot(view->r.c[1], direction, 32),
                               dot(view->r.c[2], direction, 32)}};
    struct vec w = cross(e_q28.c, f, 28), axis;
    uint32_t size = size_of(&w);
    /* edges that touch may be on either side */
    int32_t near = scaled(size, (pair->skin_q22 >> 1) + 4 * NEAR_Q20) + 2;
    int32_t gap = dot(w.c, d.c, 30); /* gap, near and way below are all |w| times a length, q20 */

    if (gap < 0) {
        gap = -gap;
        w = (struct vec){{-w.c[0], -w.c[1], -w.c[2]}};
    }
    if (gap > near + scaled(size, view->fixed.way_q22)) {
        return false;
    }
    if (gap > near) {
        int32_t rate = dot(w.c, view->field.c, 32) +
                       least(turning_rate(&w, &view->u, &p, e_q28.c, 28, edge_a->length_q22));

        if (view->to->path.turns) {
            rate -= most(turning_rate(&w, &body_path(view->to)->u, &q, f, 30, edge_b->length_q22));
        }
        if (stays_above(gap, rate, scaled(size, view->fixed.bend_q22) + BEND_SLACK_Q20, near)) {
            return false;
        }
    }
    /* made here, so that only the few candidates that come this far pay for its memory */
    const struct edge_lines l = {edge_a, edge_b, p, q, d, e_q28, f};

    axis = cross(w.c, f, 30);
    if (edges_stay_beside(view, &l, &axis)) {
        return false;
    }
    axis = cross(w.c, e_q28.c, 28);
    return !edges_stay_beside(view, &l, &axis);
}

bool boyse_may_meet(const struct boyse_pair *pair, const struct candidate *c)
{
    return c->kind == CANDIDATE_EDGE_EDGE ? edges_may_meet(pair, c) : vertex_may_meet(pair, c);
}
