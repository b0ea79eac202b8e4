/* SPDX-License-Identifier: MIT */
/*
 * Can two features of faces near each other touch? Tests each by its place (beside, above) and by
 * the normal cones (paper, section 2).
 */
#include "../num/plane.h"
#include "narrow.h"

static struct interfere_vec difference(const struct interfere_vec *a, const struct interfere_vec *b)
{
    return (struct interfere_vec){{a->c[0] - b->c[0], a->c[1] - b->c[1], a->c[2] - b->c[2]}};
}

/* ---------------------------------------------------------- vertices, faces */

/* True if a point stays beside a triangle with normal n all span, seen along n's largest axis. */
static bool stays_beside(const struct interfere_leaf *l, const struct interfere_vec *p,
                         const struct interfere_vec *const t[3], const int32_t n[3])
{
    const int axis = plane_axis(n), i = fix_next(axis), j = fix_next(i);
    const int32_t reach[2] = {l->reach.c[i], l->reach.c[j]};

    for (int k = 0; k < 3; k++) {
        const int32_t *from = t[k]->c, *to = t[k == 2 ? 0 : k + 1]->c;
        const int32_t edge[2] = {to[i] - from[i], to[j] - from[j]};
        const int32_t off[2] = {p->c[i] - from[i], p->c[j] - from[j]};

        if (plane_outside(edge, off, reach, n[axis] < 0)) {
            return true;
        }
    }
    return false;
}

bool interfere_vertex_face(const struct interfere *in, const struct target *t, uint32_t at)
{
    const struct interfere_leaf *l = in->leaf;
    const struct interfere_vec *const corners[3] = {&t->p[0], &t->p[1], &t->p[2]};
    int32_t n[3];

    if (stays_beside(l, &l->p[at], corners, t->face->normal.c)) {
        return false;
    }
    carom_rotate_back(n, &l->to_b, t->face->normal.c);
    return mesh_vertex_cone(in->a->def.mesh, interfere_vertex(in, at), n, l->cone_q30) ||
           (mesh_two_sided(in->b->def.mesh) &&
            mesh_vertex_below(in->a->def.mesh, interfere_vertex(in, at), n, l->cone_q30));
}

bool interfere_face_vertex(const struct interfere *in, const struct target *t, uint32_t i, int k)
{
    const struct interfere_leaf *l = in->leaf;
    const uint8_t *corner = interfere_corners(in, i);
    const struct interfere_vec *const p[3] = {&l->p[corner[0]], &l->p[corner[1]], &l->p[corner[2]]};
    const int32_t *n = l->planes[i].n_q30;
    const struct carom_mesh *mb = in->b->def.mesh;

    return !stays_beside(l, &t->p[k], p, n) &&
           mesh_vertex_cone(mb, mb->raw.faces[t->number][k], n, l->cone_q30);
}

/* -------------------------------------------------------------------- edges */

/* Two edges at mid-span, in b's mesh axes. */
struct edge_pair {
    const struct carom_edge *a, *b;
    const struct interfere_vec *start_a, *start_b;
    int32_t e[3]; /* direction of a's edge; that of b's edge is b->direction */
    int32_t w[3]; /* e x f, q30; along the normal of an edge/edge contact */
};

static int64_t size_of(const int32_t v[3])
{
    return (int64_t)((uint32_t)fix_abs32(v[0]) + (uint32_t)fix_abs32(v[1]) +
                     (uint32_t)fix_abs32(v[2]));
}

/*
 * Which of +w (bit 0) and -w (bit 1) lies between the two faces of an edge. d is the direction of
 * the other edge. In a face with normal n the direction square to its own edge is n x f or n x e,
 * and (e x f).(n x f) = e.n, (e x f).(n x e) = -f.n: so the sign of n.d decides.
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
 * True if +w or -w lies in the normal cones of both edges, the arcs between their faces' normals. A
 * turn by an angle moves w / |w| by up to angle / sine, so tolerances are multiplied by the sine.
 */
static bool arcs_meet(const struct interfere *in, const struct edge_pair *l, int64_t sine_q30)
{
    int64_t turn_q30 = (int64_t)in->leaf->cone_q30 - INTERFERE_CONE_Q30;
    int64_t tolerance_q60 = in->leaf->cone_q30 * sine_q30 + carom_shl(turn_q30, 30);
    int32_t f_a[3], tolerance_q28 = (int32_t)(tolerance_q60 >> 32) + 1;
    uint32_t sides = sides_between(in->b->def.mesh, l->b, l->e, tolerance_q28);

    if (sides == 0) {
        return false;
    }
    carom_rotate_back(f_a, &in->leaf->to_b, l->b->direction.c);
    return (sides & sides_between(in->a->def.mesh, l->a, f_a, tolerance_q28)) != 0;
}

/*
 * True if an edge stays beside the other edge's line, seen along w. The edge begins at `start` from
 * that line and runs along `other`.
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

/* True if two edges can touch. Precondition: their boxes meet. */
static bool edges_may_touch(const struct interfere *in, struct edge_pair *l)
{
    const int32_t *f = l->b->direction.c;
    struct interfere_vec d, d_back;
    int64_t sine_q30, limit;
    int32_t largest;

    carom_rotate(l->e, &in->leaf->to_b, l->a->direction.c);
    carom_cross(l->w, l->e, f, 30);
    largest = fix_larger(fix_larger(fix_abs32(l->w[0]), fix_abs32(l->w[1])), fix_abs32(l->w[2]));
    if (largest < CAROM_ONE_Q30 / 64 + (in->leaf->cone_q30 - INTERFERE_CONE_Q30)) {
        return true; /* may become parallel during the span: leave them to the exact test */
    }
    sine_q30 = size_of(l->w) + 4; /* at least |w| */
    d = difference(l->start_a, l->start_b);
    limit = sine_q30 * (in->leaf->near_q20 + 4) + carom_abs(carom_dot(l->w, in->leaf->shift.c)) / 2;
    if (carom_abs(carom_dot(l->w, d.c)) > limit || !arcs_meet(in, l, sine_q30)) {
        return false;
    }
    d_back = difference(l->start_b, l->start_a);
    return !passes_by(in, l->w, f, &d, l->e, l->a->length_q22) &&
           !passes_by(in, l->w, l->e, &d_back, f, l->b->length_q22);
}

bool interfere_edge_edge(const struct interfere *in, const struct target *t, uint32_t i, int k,
                         int j)
{
    /* an owned edge runs in the direction of its face's corners */
    struct edge_pair edges;

    edges.a = &in->a->def.mesh->edges[in->a->def.mesh->faces[interfere_face(in, i)].edge[k]];
    edges.b = &in->b->def.mesh->edges[t->face->edge[j]];
    edges.start_a = &in->leaf->p[interfere_corners(in, i)[k]];
    edges.start_b = &t->p[j];
    return edges_may_touch(in, &edges);
}
