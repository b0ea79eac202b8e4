/* SPDX-License-Identifier: MIT */
/* The coefficients of P(t) for one moving body. */
#include "boyse_place.h"

/*
 * Formats below: directions q30, lengths and displacements q24, so their dot products are q54, kept
 * as q40. Displacements of a slice are below 64 units and points of a within 64 units of its
 * centre, so every q24 component fits int32 and every sum stays below 2^62.
 */
static int64_t dot_q40(const int32_t direction[3], const int32_t length_q24[3])
{
    return carom_round(carom_dot(direction, length_q24), 14);
}

/* v times s^2; |v| < 2^49. */
static int64_t times_u2(int64_t v_q40, const struct body_path *path)
{
    return path->u2_q30 ? fix_mul(v_q40, path->u2_q30, 30) : 0;
}

/* A vertex of the moving body against a standing face. */
static void moving_vertex(const struct boyse_pair *pair, const struct candidate *c, int64_t a[5])
{
    const struct body_path *path = &pair->a->path;
    struct boyse_vertex_face vf;
    carom_v3_q22 local = mesh_vertex(pair->a->mesh, c->i);
    int32_t d[3], arm[3], w1[3], w2[3];
    int64_t v, g;

    boyse_place_vertex_face(pair, c, 0, &vf);
    boyse_difference(d, &vf.vertex, &vf.corner);
    a[0] = carom_round(carom_dot(vf.n, d), 12);
    v = dot_q40(vf.n, path->v_q24.c);
    g = dot_q40(vf.n, path->g_q24.c);
    a[1] = v;
    a[2] = g;
    if (path->turns) {
        /* r(t) (1 + s^2 t^2) = r + 2t u x r + t^2 (s^2 r + 2 u x (u x r)) */
        carom_rotate(arm, &path->start.r, local.c);
        carom_cross(w1, path->u_world.c, arm, 27); /* 2 u x r: q52 to q24, doubled */
        carom_cross(w2, path->u_world.c, w1, 30);
        a[1] += dot_q40(vf.n, w1);
        a[2] += dot_q40(vf.n, w2) + times_u2(a[0], path);
    }
    a[3] = times_u2(v, path);
    a[4] = times_u2(g, path);
}

/* n(t) (1 + s^2 t^2) = n + 2t n1 + t^2 m for a direction n of the turning body. */
struct turning {
    int32_t n[3], n1[3], m[3];
};

static void turning_direction(const struct body_path *path, const int32_t n[3], struct turning *d)
{
    int32_t n2[3];

    memcpy(d->n, n, sizeof d->n);
    carom_cross(d->n1, path->u_world.c, n, 30);
    carom_cross(n2, path->u_world.c, d->n1, 30);
    for (int k = 0; k < 3; k++) {
        d->m[k] = carom_mul_q30(path->u2_q30, n[k]) + 2 * n2[k];
    }
}

/* (n + 2t n1 + t^2 m) . (d0 + d1 t + d2 t^2) */
static void multiply_turning(const struct turning *n, const int32_t d0[3], const int32_t d1[3],
                             const int32_t d2[3], int64_t a[5])
{
    a[0] = dot_q40(n->n, d0);
    a[1] = dot_q40(n->n, d1) + 2 * dot_q40(n->n1, d0);
    a[2] = dot_q40(n->n, d2) + 2 * dot_q40(n->n1, d1) + dot_q40(n->m, d0);
    a[3] = 2 * dot_q40(n->n1, d2) + dot_q40(n->m, d1);
    a[4] = dot_q40(n->m, d2);
}

/*
 * Whether a point lies farther from the centre of body a than any point of it can get in a slice
 * (32 units of radius and 64 of way): such a pair cannot meet, and its numbers need not fit.
 */
static bool out_of_range(const int32_t from_centre_q22[3])
{
    const int32_t limit = 120 << 22;

    for (int k = 0; k < 3; k++) {
        if (carom_abs(from_centre_q22[k]) > limit) {
            return true;
        }
    }
    return false;
}

/* Coefficients without a root. */
static void never(int64_t a[5])
{
    memset(a, 0, 5 * sizeof a[0]);
    a[0] = (int64_t)1 << 40;
}

/* A standing vertex against a face of the moving body: p = n(t).(x - c(t)) - n.(corner - c). */
static void moving_face(const struct boyse_pair *pair, const struct candidate *c, int64_t a[5])
{
    const struct body_path *path = &pair->a->path;
    struct boyse_vertex_face vf;
    struct turning n;
    int32_t d[3], d0[3], d1[3], d2[3];
    int64_t gap, corner;

    boyse_place_vertex_face(pair, c, 0, &vf);
    if (out_of_range(vf.vertex.c)) { /* a's centre is within a unit of the place of the origin */
        never(a);
        return;
    }
    boyse_difference(d, &vf.vertex, &vf.corner);
    gap = carom_round(carom_dot(vf.n, d), 12);
    for (int k = 0; k < 3; k++) {
        d0[k] = vf.vertex.c[k] * 4 - (int32_t)carom_round(path->start.x.c[k], 8);
        d1[k] = -path->v_q24.c[k];
        d2[k] = -path->g_q24.c[k];
    }
    turning_direction(path, vf.n, &n);
    multiply_turning(&n, d0, d1, d2, a);
    corner = a[0] - gap; /* constant: the corner turns with the normal */
    a[0] = gap;
    a[2] -= times_u2(corner, path);
}

/*
 * An edge of the moving body, direction e through r from its centre, against a standing edge f
 * through y: w.d = e.(f x (c - y)) + f.(r x e), where r x e turns with the body.
 */
static void moving_edge(const struct boyse_pair *pair, const struct candidate *c, int64_t a[5])
{
    const struct body_path *path = &pair->a->path;
    struct boyse_edge_edge ee;
    struct turning e;
    carom_v3_q22 local;
    int32_t arm[3], near[3], from[3], d0[3], d1[3], d2[3], k0[3], k1[3], k2[3];
    int64_t fk, along_q22;

    boyse_place_edge_edge(pair, c, 0, &ee);
    /* any point of the standing line serves: the one nearest to a keeps long edges in range */
    along_q22 = -carom_round(carom_dot(ee.f, ee.start_b.c), 30);
    for (int k = 0; k < 3; k++) {
        near[k] = ee.start_b.c[k] + (int32_t)fix_mul(along_q22, ee.f[k], 30);
    }
    if (out_of_range(near)) {
        never(a);
        return;
    }
    local = mesh_vertex(pair->a->mesh, ee.edge_a->vertex[0]);
    carom_rotate(arm, &path->start.r, local.c);
    for (int k = 0; k < 3; k++) {
        from[k] = (int32_t)carom_round(path->start.x.c[k], 8) - near[k] * 4;
    }
    carom_cross(d0, ee.f, from, 30);
    carom_cross(d1, ee.f, path->v_q24.c, 30);
    carom_cross(d2, ee.f, path->g_q24.c, 30);
    turning_direction(path, ee.e, &e);
    multiply_turning(&e, d0, d1, d2, a);
    carom_cross(k0, arm, ee.e, 28); /* q22 x q30 to q24 */
    carom_cross(k1, path->u_world.c, k0, 30);
    carom_cross(k2, path->u_world.c, k1, 30);
    fk = dot_q40(ee.f, k0);
    a[0] += fk;
    a[1] += 2 * dot_q40(ee.f, k1);
    a[2] += 2 * dot_q40(ee.f, k2) + times_u2(fk, path);
}

void boyse_polynomial(const struct boyse_pair *pair, const struct candidate *c, int64_t a_q40[5])
{
    CAROM_ASSERT(!pair->b->path.turns);
    switch (c->kind) {
    case CANDIDATE_VERTEX_FACE:
        moving_vertex(pair, c, a_q40);
        break;
    case CANDIDATE_FACE_VERTEX:
        moving_face(pair, c, a_q40);
        break;
    default:
        moving_edge(pair, c, a_q40);
    }
}
