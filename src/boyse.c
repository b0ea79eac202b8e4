/* SPDX-License-Identifier: MIT */
#include "boyse.h"

/* Units of the last place of q22 that rounding may be off by in the place of a point. */
#define POINT_NOISE_Q22 2
/* A pair that starts clear of contact is followed to a surface this much nearer (see boyse_first). */
#define ROOT_LEVEL_Q22 3
/* Sine of the angle below which edges count as parallel: 0.01. */
#define PARALLEL_Q30 10737418

void boyse_pair_init(struct boyse_pair *pair, struct body *a, struct body *b)
{
    pair->a = a;
    pair->b = b;
    pair->skin_q22 = a->skin_q22 > b->skin_q22 ? a->skin_q22 : b->skin_q22;
    for (int k = 0; k < 3; k++) {
        pair->offset_q22[k] = (int32_t)(b->path.origin_q22[k] - a->path.origin_q22[k]);
    }
}

/* ------------------------------------------------------------ places at t */

static carom_v3_q22 point_of_a(const struct boyse_pair *pair, int32_t t_q30, uint32_t v)
{
    carom_v3_q22 local = mesh_vertex(pair->a->mesh, v);

    return body_point(body_pose_at(pair->a, t_q30), &local);
}

static carom_v3_q22 point_of_b(const struct boyse_pair *pair, int32_t t_q30, uint32_t v)
{
    carom_v3_q22 local = mesh_vertex(pair->b->mesh, v);
    carom_v3_q22 p = body_point(body_pose_at(pair->b, t_q30), &local);

    for (int k = 0; k < 3; k++) {
        p.c[k] += pair->offset_q22[k];
    }
    return p;
}

static void direction_at(struct body *b, int32_t t_q30, const carom_v3_q30 *local, int32_t out[3])
{
    carom_rotate(out, &body_pose_at(b, t_q30)->r, local->c);
}

static void difference(int32_t d[3], const carom_v3_q22 *p, const carom_v3_q22 *q)
{
    for (int k = 0; k < 3; k++) {
        d[k] = p->c[k] - q->c[k];
    }
}

/* A vertex against a face: the vertex, a corner of the face and its normal at t. */
struct vertex_face {
    carom_v3_q22 vertex, corner;
    int32_t n[3];
    struct body *vertex_body, *face_body;
    bool vertex_on_a;
};

static void place_vertex_face(const struct boyse_pair *pair, const struct candidate *c,
                              int32_t t_q30, struct vertex_face *vf)
{
    vf->vertex_on_a = c->kind == CANDIDATE_VERTEX_FACE;
    vf->vertex_body = vf->vertex_on_a ? pair->a : pair->b;
    vf->face_body = vf->vertex_on_a ? pair->b : pair->a;
    if (vf->vertex_on_a) {
        vf->vertex = point_of_a(pair, t_q30, c->i);
        vf->corner = point_of_b(pair, t_q30, pair->b->mesh->raw.faces[c->j][0]);
    } else {
        vf->vertex = point_of_b(pair, t_q30, c->i);
        vf->corner = point_of_a(pair, t_q30, pair->a->mesh->raw.faces[c->j][0]);
    }
    direction_at(vf->face_body, t_q30, &vf->face_body->mesh->faces[c->j].normal, vf->n);
}

/* An edge of a against an edge of b: start points and directions, w = e x f and its length. */
struct edge_edge {
    const struct carom_edge *edge_a, *edge_b;
    carom_v3_q22 start_a, start_b;
    int32_t e[3], f[3], w[3], d[3];
    int64_t sine_q30;
};

static void place_edge_edge(const struct boyse_pair *pair, const struct candidate *c,
                            int32_t t_q30, struct edge_edge *ee)
{
    ee->edge_a = &pair->a->mesh->edges[c->i];
    ee->edge_b = &pair->b->mesh->edges[c->j];
    ee->start_a = point_of_a(pair, t_q30, ee->edge_a->vertex[0]);
    ee->start_b = point_of_b(pair, t_q30, ee->edge_b->vertex[0]);
    direction_at(pair->a, t_q30, &ee->edge_a->direction, ee->e);
    direction_at(pair->b, t_q30, &ee->edge_b->direction, ee->f);
    carom_cross(ee->w, ee->e, ee->f, 30);
    difference(ee->d, &ee->start_a, &ee->start_b);
    ee->sine_q30 = fix_sqrt((uint64_t)carom_dot(ee->w, ee->w));
}

static int64_t divide_floor(int64_t n, int64_t d)
{
    int64_t q = n / d;

    return q - (n % d != 0 && (n < 0) != (d < 0));
}

/* w.d is kept whole until it is divided by |w|: nearly parallel edges lose nothing. */
static int32_t edge_gap(const struct edge_edge *ee, int sign)
{
    int64_t sine_q30 = ee->sine_q30 > PARALLEL_Q30 ? ee->sine_q30 : PARALLEL_Q30;
    int64_t gap = divide_floor(sign * carom_dot(ee->w, ee->d), sine_q30);

    if (gap > INT32_MAX || gap < -INT32_MAX) {
        return gap > 0 ? INT32_MAX : -INT32_MAX; /* nearly parallel and far apart */
    }
    return (int32_t)gap;
}

static int32_t plane_gap(const struct vertex_face *vf)
{
    int32_t d[3];

    difference(d, &vf->vertex, &vf->corner);
    return (int32_t)(carom_dot(vf->n, d) >> 30);
}

int32_t boyse_gap(const struct boyse_pair *pair, const struct candidate *c, int32_t t_q30, int sign)
{
    if (c->kind == CANDIDATE_EDGE_EDGE) {
        struct edge_edge ee;

        place_edge_edge(pair, c, t_q30, &ee);
        return edge_gap(&ee, sign);
    } else {
        struct vertex_face vf;

        place_vertex_face(pair, c, t_q30, &vf);
        return plane_gap(&vf);
    }
}

/* --------------------------------------------------------- the exact test */

/* Whether a point lies over a face, in the face's own frame: d from corner 0, q22. */
static bool inside_face(const struct carom_mesh *mesh, uint32_t face, const int32_t d[3])
{
    const struct carom_face *f = &mesh->faces[face];
    carom_v3_q22 first = mesh_corner(mesh, face, 0);

    for (int k = 0; k < 3; k++) {
        const struct carom_edge *edge = &mesh->edges[f->edge[k]];
        int side = edge->face[0] == face ? 0 : 1;
        carom_v3_q30 in = mesh_edge_inward(mesh, edge, side);
        carom_v3_q22 corner = mesh_corner(mesh, face, k);
        int32_t from[3];

        for (int i = 0; i < 3; i++) {
            from[i] = d[i] + first.c[i] - corner.c[i];
        }
        if ((carom_dot(in.c, from) >> 30) < -POINT_NOISE_Q22) {
            return false;
        }
    }
    return true;
}

static void touch_vertex_face(const struct boyse_pair *pair, const struct candidate *c,
                              int32_t t_q30, struct boyse_touch *touch)
{
    struct vertex_face vf;
    carom_v3_q22 foot;
    int32_t d[3], n[3];

    place_vertex_face(pair, c, t_q30, &vf);
    touch->gap_q22 = plane_gap(&vf);
    touch->sign = 1;
    for (int k = 0; k < 3; k++) {
        foot.c[k] = vf.vertex.c[k] - (int32_t)carom_round((int64_t)vf.n[k] * touch->gap_q22, 30);
        touch->normal.c[k] = vf.vertex_on_a ? vf.n[k] : -vf.n[k];
    }
    touch->on_a = vf.vertex_on_a ? vf.vertex : foot;
    touch->on_b = vf.vertex_on_a ? foot : vf.vertex;

    difference(d, &vf.vertex, &vf.corner);
    carom_rotate_back(d, &body_pose_at(vf.face_body, t_q30)->r, d);
    carom_rotate_back(n, &body_pose_at(vf.vertex_body, t_q30)->r, vf.n);
    touch->valid = inside_face(vf.face_body->mesh, c->j, d) &&
                   mesh_vertex_cone(vf.vertex_body->mesh, c->i, n, INTERFERE_CONE_Q30);
}

/* Whether sign * normal leaves b's edge outwards and enters a's: on neither side inside a face. */
static bool normal_in_cones(const struct boyse_pair *pair, const struct edge_edge *ee,
                            int32_t t_q30, const int32_t normal[3], int sign)
{
    int64_t limit_q60 = (int64_t)INTERFERE_CONE_Q30 << 30;
    int32_t n_a[3], n_b[3];

    carom_rotate_back(n_a, &body_pose_at(pair->a, t_q30)->r, normal);
    carom_rotate_back(n_b, &body_pose_at(pair->b, t_q30)->r, normal);
    for (int side = 0; side < 2; side++) {
        carom_v3_q30 in_a = mesh_edge_inward(pair->a->mesh, ee->edge_a, side);
        carom_v3_q30 in_b = mesh_edge_inward(pair->b->mesh, ee->edge_b, side);

        if (sign * carom_dot(n_b, in_b.c) > limit_q60 ||
            -sign * carom_dot(n_a, in_a.c) > limit_q60) {
            return false;
        }
    }
    return true;
}

/*
 * Places of nearest approach along the two lines, q22. With b = e.f and D = 1 - b^2 = |w|^2:
 * s = (b d.f - d.e) / D and q = (d.f - b d.e) / D. False when either lies off its edge.
 */
static bool nearest_points(const struct edge_edge *ee, int64_t *s_q22, int64_t *q_q22)
{
    int32_t b_q30 = (int32_t)carom_round(carom_dot(ee->e, ee->f), 30);
    int64_t de_q32 = carom_round(carom_dot(ee->d, ee->e), 20);
    int64_t df_q32 = carom_round(carom_dot(ee->d, ee->f), 20);
    int64_t d_q30 = carom_round(ee->sine_q30 * ee->sine_q30, 30); /* >= 1e-4 */

    /* q32 numbers of at most 2^41 by q20: |d| <= 2^9 units */
    *s_q22 = divide_floor((fix_mul(df_q32, b_q30, 30) - de_q32) * ((int64_t)1 << 20), d_q30);
    *q_q22 = divide_floor((df_q32 - fix_mul(de_q32, b_q30, 30)) * ((int64_t)1 << 20), d_q30);
    return *s_q22 >= -POINT_NOISE_Q22 && *s_q22 <= ee->edge_a->length_q22 + POINT_NOISE_Q22 &&
           *q_q22 >= -POINT_NOISE_Q22 && *q_q22 <= ee->edge_b->length_q22 + POINT_NOISE_Q22;
}

static void touch_edge_edge(const struct boyse_pair *pair, const struct candidate *c,
                            int32_t t_q30, struct boyse_touch *touch)
{
    struct edge_edge ee;
    int64_t s_q22, q_q22;
    int32_t n[3];

    place_edge_edge(pair, c, t_q30, &ee);
    touch->valid = false;
    touch->sign = 1;
    touch->gap_q22 = edge_gap(&ee, 1);
    if (ee.sine_q30 < PARALLEL_Q30 || !nearest_points(&ee, &s_q22, &q_q22)) {
        return;
    }
    for (int k = 0; k < 3; k++) {
        n[k] = (int32_t)((int64_t)ee.w[k] * CAROM_ONE_Q30 / ee.sine_q30);
        touch->on_a.c[k] = ee.start_a.c[k] + (int32_t)carom_round(ee.e[k] * s_q22, 30);
        touch->on_b.c[k] = ee.start_b.c[k] + (int32_t)carom_round(ee.f[k] * q_q22, 30);
    }
    for (int sign = 1; sign >= -1 && !touch->valid; sign -= 2) {
        if (normal_in_cones(pair, &ee, t_q30, n, sign)) {
            touch->valid = true;
            touch->sign = (int8_t)sign;
            touch->gap_q22 = edge_gap(&ee, sign);
            for (int k = 0; k < 3; k++) {
                touch->normal.c[k] = sign * n[k];
            }
        }
    }
}

void boyse_touch(const struct boyse_pair *pair, const struct candidate *c, int32_t t_q30,
                 struct boyse_touch *touch)
{
    if (c->kind == CANDIDATE_EDGE_EDGE) {
        touch_edge_edge(pair, c, t_q30, touch);
    } else {
        touch_vertex_face(pair, c, t_q30, touch);
    }
}

/* ------------------------------------------------------------- coefficients */

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
    struct vertex_face vf;
    carom_v3_q22 local = mesh_vertex(pair->a->mesh, c->i);
    int32_t d[3], arm[3], w1[3], w2[3];
    int64_t v, g;

    place_vertex_face(pair, c, 0, &vf);
    difference(d, &vf.vertex, &vf.corner);
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
    struct vertex_face vf;
    struct turning n;
    int32_t d[3], d0[3], d1[3], d2[3];
    int64_t gap, corner;

    place_vertex_face(pair, c, 0, &vf);
    if (out_of_range(vf.vertex.c)) { /* a's centre is within a unit of the place of the origin */
        never(a);
        return;
    }
    difference(d, &vf.vertex, &vf.corner);
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
    struct edge_edge ee;
    struct turning e;
    carom_v3_q22 local;
    int32_t arm[3], near[3], from[3], d0[3], d1[3], d2[3], k0[3], k1[3], k2[3];
    int64_t fk, along_q22;

    place_edge_edge(pair, c, 0, &ee);
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

/* -------------------------------------------------------------------- roots */

#define ROOT_BITS 27   /* of the largest coefficient */
#define ROOT_NOISE 4   /* Horner's rounding, in the units of the coefficients */

struct quartic {
    int32_t a[5];
    int64_t bend; /* a bound of |P''| on [0, 1] */
    int shift;    /* a = a_q40 / 2^shift */
};

static void quartic_at(const struct quartic *q, int32_t t_q30, int64_t *p, int64_t *slope)
{
    int64_t v = q->a[4], d = 4 * (int64_t)q->a[4];

    for (int k = 3; k >= 0; k--) {
        v = (v * t_q30 >> 30) + q->a[k];
    }
    for (int k = 3; k >= 1; k--) {
        d = (d * t_q30 >> 30) + k * (int64_t)q->a[k];
    }
    *p = v;
    *slope = d;
}

/*
 * Scale the coefficients to ROOT_BITS. False when P keeps its sign on [0, 1] because its constant
 * term outweighs all others: nearly every candidate ends here.
 */
static bool quartic_init(struct quartic *q, int64_t a[5])
{
    uint64_t all = 0;
    int64_t reach = 0;

    for (int k = 1; k < 5; k++) {
        reach += carom_abs(a[k]);
    }
    if (carom_abs(a[0]) > reach + (reach >> 20) + ((int64_t)1 << 16)) {
        return false;
    }
    for (int k = 0; k < 5; k++) {
        all |= (uint64_t)carom_abs(a[k]);
    }
    q->shift = fix_bits(all) - ROOT_BITS;
    if (all == 0) {
        return false;
    }
    for (int k = 0; k < 5; k++) {
        q->a[k] = q->shift > 0 ? (int32_t)carom_round(a[k], q->shift)
                               : (int32_t)carom_shl(a[k], -q->shift);
    }
    q->bend = 2 * carom_abs(q->a[2]) + 6 * carom_abs(q->a[3]) + 12 * carom_abs(q->a[4]) + 1;
    return true;
}

/*
 * The farthest step from t that cannot pass a root: |P| + slope s - bend s^2 / 2 = 0, slope being
 * that of |P|. Terms: |P| < 2^30, |slope| < 2^31, bend < 2^32, so the discriminant is below 2^64.
 */
static int64_t safe_step_q30(int64_t p, int64_t slope, int64_t bend)
{
    int64_t size = carom_abs(p), d = p >= 0 ? slope : -slope;
    int64_t root = (int64_t)fix_sqrt((uint64_t)(d * d) + 2 * (uint64_t)(bend * size)) + 1;
    int64_t step;

    if (d >= 0) {
        step = (d + root - 1) * CAROM_ONE_Q30 / bend;
    } else {
        step = 2 * size * CAROM_ONE_Q30 / (root - d);
    }
    return step;
}

/* ---------------------------------------------------------------- event time */

/*
 * The last time before the root at which the gap equals the event gap (half the skin), searched back
 * no further than `from`, the root before. A pair that never opens that far in between gets half of
 * its largest opening; one that is never open gets 0.
 *
 * The search is on the gap of the true, rounded poses, so that what is committed is what was tested.
 */
static int32_t event_time(const struct boyse_pair *pair, const struct candidate *c, int32_t from,
                          int32_t root, int64_t slope_q40, int sign)
{
    int32_t wanted = pair->skin_q22 / 2, open = from, closed = root, best = 0;
    int64_t back;

    /* first guess: twice the way at the closing speed of the root */
    slope_q40 = carom_abs(slope_q40) + 1;
    back = ((int64_t)wanted << 19) / ((slope_q40 >> 30) + 1);
    if (back < 64) {
        back = 64;
    }
    for (;;) {
        int32_t t = back < root - from ? root - (int32_t)back : from;

        best = boyse_gap(pair, c, t, sign);
        open = t;
        if (best > wanted || t == from) {
            break;
        }
        closed = t;
        back *= 2;
    }
    if (best <= wanted) {
        closed = root;
        for (int k = 0; k < 32 && best <= wanted; k++) {
            int32_t t = from + (int32_t)((int64_t)(root - from) * (2 * k + 1) >> 6);
            int32_t gap = boyse_gap(pair, c, t, sign);

            if (gap > best) {
                best = gap;
                open = t;
            }
        }
        if (best <= 0) {
            return 0;
        }
        if (best <= wanted) {
            wanted = best / 2;
        }
    }
    while (closed - open > 1) {
        int32_t t = open + (closed - open) / 2;

        if (boyse_gap(pair, c, t, sign) > wanted) {
            open = t;
        } else {
            closed = t;
        }
    }
    return open;
}

/* A pair that already touches or overlaps at the start and still approaches. */
static bool touches_at_start(const struct boyse_pair *pair, const struct candidate *c,
                             int64_t slope, struct boyse_hit *hit)
{
    int32_t gap = boyse_gap(pair, c, 0, 1);

    if (carom_abs(gap) >= pair->skin_q22 / 2) {
        return false;
    }
    boyse_touch(pair, c, 0, &hit->touch);
    hit->t_q30 = 0;
    return hit->touch.valid && hit->touch.sign * slope < 0 && hit->touch.gap_q22 <= 0 &&
           hit->touch.gap_q22 > -(pair->skin_q22 * 5 / 2);
}

bool boyse_first(const struct boyse_pair *pair, const struct candidate *c, struct boyse_hit *hit,
                 uint32_t *roots)
{
    const int64_t level = (int64_t)ROOT_LEVEL_Q22 << 18;
    int64_t a[5];
    struct quartic q;
    int64_t hop = 16;
    int32_t t = 0, last_root = 0, side = 0;

    boyse_polynomial(pair, c, a);
    /*
     * A frame may end with a gap so small that there is no root on [0, 1], and rounding would then
     * commit an overlap: look for the root of a surface a little nearer.
     */
    if (a[0] > 2 * level) {
        a[0] -= level;
    } else if (a[0] < -2 * level && c->kind == CANDIDATE_EDGE_EDGE) {
        a[0] += level;
    }
    if (!quartic_init(&q, a)) {
        return false;
    }
    ++*roots;
    if (touches_at_start(pair, c, a[1], hit)) {
        return true;
    }
    for (int round = 0; round < 300 && t < CAROM_ONE_Q30; round++) {
        int64_t p, slope, step;
        bool crossed;

        quartic_at(&q, t, &p, &slope);
        step = safe_step_q30(p, slope, q.bend);
        /* rounding may carry t across a root: a change of sign is one as well */
        crossed = side != 0 && (p > 0 ? 1 : -1) == -side && carom_abs(p) > ROOT_NOISE;
        if (carom_abs(p) > ROOT_NOISE) {
            side = p > 0 ? 1 : -1;
        }
        if (carom_abs(p) > ROOT_NOISE && step > 1 && !crossed) {
            t = step < CAROM_ONE_Q30 - t ? t + (int32_t)step : CAROM_ONE_Q30;
            hop = 16;
            continue;
        }
        boyse_touch(pair, c, t, &hit->touch);
        if (hit->touch.valid && hit->touch.sign * slope < 0) {
            int64_t slope_q40 = q.shift > 0 ? carom_shl(slope, q.shift) : slope >> -q.shift;

            hit->t_q30 = event_time(pair, c, last_root, t, slope_q40, hit->touch.sign);
            return true;
        }
        /* not a hit: step over it, in growing strides while P stays in the noise */
        last_root = t;
        if (step < hop) {
            step = hop;
            hop *= 2;
        } else {
            hop = 16;
        }
        t = step < CAROM_ONE_Q30 - t ? t + (int32_t)step : CAROM_ONE_Q30;
    }
    return false;
}
