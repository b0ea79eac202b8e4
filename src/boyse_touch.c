/* SPDX-License-Identifier: MIT */
/* Features of a candidate at a given time: their places, their distance, and the exact test. */
#include "boyse_place.h"

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

void boyse_place_vertex_face(const struct boyse_pair *pair, const struct candidate *c,
                             int32_t t_q30, struct boyse_vertex_face *vf)
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

void boyse_place_edge_edge(const struct boyse_pair *pair, const struct candidate *c, int32_t t_q30,
                           struct boyse_edge_edge *ee)
{
    ee->edge_a = &pair->a->mesh->edges[c->i];
    ee->edge_b = &pair->b->mesh->edges[c->j];
    ee->start_a = point_of_a(pair, t_q30, ee->edge_a->vertex[0]);
    ee->start_b = point_of_b(pair, t_q30, ee->edge_b->vertex[0]);
    direction_at(pair->a, t_q30, &ee->edge_a->direction, ee->e);
    direction_at(pair->b, t_q30, &ee->edge_b->direction, ee->f);
    carom_cross(ee->w, ee->e, ee->f, 30);
    boyse_difference(ee->d, &ee->start_a, &ee->start_b);
    ee->sine_q30 = fix_sqrt((uint64_t)carom_dot(ee->w, ee->w));
}

static int64_t divide_floor(int64_t n, int64_t d)
{
    int64_t q = n / d;

    return q - (n % d != 0 && (n < 0) != (d < 0));
}

/* w.d is kept whole until it is divided by |w|: nearly parallel edges lose nothing. */
static int32_t edge_gap(const struct boyse_edge_edge *ee, int sign)
{
    int64_t sine_q30 = ee->sine_q30 > BOYSE_PARALLEL_Q30 ? ee->sine_q30 : BOYSE_PARALLEL_Q30;
    int64_t gap = divide_floor(sign * carom_dot(ee->w, ee->d), sine_q30);

    if (gap > INT32_MAX || gap < -INT32_MAX) {
        return gap > 0 ? INT32_MAX : -INT32_MAX; /* nearly parallel and far apart */
    }
    return (int32_t)gap;
}

static int32_t plane_gap(const struct boyse_vertex_face *vf)
{
    int32_t d[3];

    boyse_difference(d, &vf->vertex, &vf->corner);
    return (int32_t)(carom_dot(vf->n, d) >> 30);
}

int32_t boyse_gap(const struct boyse_pair *pair, const struct candidate *c, int32_t t_q30, int sign)
{
    if (c->kind == CANDIDATE_EDGE_EDGE) {
        struct boyse_edge_edge ee;

        boyse_place_edge_edge(pair, c, t_q30, &ee);
        return edge_gap(&ee, sign);
    } else {
        struct boyse_vertex_face vf;

        boyse_place_vertex_face(pair, c, t_q30, &vf);
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
        if ((carom_dot(in.c, from) >> 30) < -BOYSE_POINT_NOISE_Q22) {
            return false;
        }
    }
    return true;
}

static void touch_vertex_face(const struct boyse_pair *pair, const struct candidate *c,
                              int32_t t_q30, struct boyse_touch *touch)
{
    struct boyse_vertex_face vf;
    carom_v3_q22 foot;
    int32_t d[3], n[3];

    boyse_place_vertex_face(pair, c, t_q30, &vf);
    touch->gap_q22 = plane_gap(&vf);
    touch->sign = 1;
    for (int k = 0; k < 3; k++) {
        foot.c[k] = vf.vertex.c[k] - (int32_t)carom_round((int64_t)vf.n[k] * touch->gap_q22, 30);
        touch->normal.c[k] = vf.vertex_on_a ? vf.n[k] : -vf.n[k];
    }
    touch->on_a = vf.vertex_on_a ? vf.vertex : foot;
    touch->on_b = vf.vertex_on_a ? foot : vf.vertex;

    boyse_difference(d, &vf.vertex, &vf.corner);
    carom_rotate_back(d, &body_pose_at(vf.face_body, t_q30)->r, d);
    carom_rotate_back(n, &body_pose_at(vf.vertex_body, t_q30)->r, vf.n);
    touch->valid = inside_face(vf.face_body->mesh, c->j, d) &&
                   mesh_vertex_cone(vf.vertex_body->mesh, c->i, n, INTERFERE_CONE_Q30);
}

/* Whether sign * normal leaves b's edge outwards and enters a's: on neither side inside a face. */
static bool normal_in_cones(const struct boyse_pair *pair, const struct boyse_edge_edge *ee,
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
 * The sign of N by the way that the faces of both edges look: out of b and against a. Edges that
 * are nearly flat have both normals within the tolerance of their cones.
 */
static int facing_sign(const struct boyse_pair *pair, const struct boyse_edge_edge *ee,
                       int32_t t_q30, const int32_t normal[3])
{
    int32_t n_a[3], n_b[3];
    int64_t out = 0;

    carom_rotate_back(n_a, &body_pose_at(pair->a, t_q30)->r, normal);
    carom_rotate_back(n_b, &body_pose_at(pair->b, t_q30)->r, normal);
    for (int side = 0; side < 2; side++) {
        uint16_t face_a = ee->edge_a->face[side], face_b = ee->edge_b->face[side];

        out -= face_a == CAROM_NO_FACE ? 0 : carom_dot(n_a, pair->a->mesh->faces[face_a].normal.c);
        out += face_b == CAROM_NO_FACE ? 0 : carom_dot(n_b, pair->b->mesh->faces[face_b].normal.c);
    }
    return out >= 0 ? 1 : -1;
}

/*
 * Places of nearest approach along the two lines, q22. With b = e.f and D = 1 - b^2 = |w|^2:
 * s = (b d.f - d.e) / D and q = (d.f - b d.e) / D. False when either lies off its edge.
 */
static bool nearest_points(const struct boyse_edge_edge *ee, int64_t *s_q22, int64_t *q_q22)
{
    int32_t b_q30 = (int32_t)carom_round(carom_dot(ee->e, ee->f), 30);
    int64_t de_q32 = carom_round(carom_dot(ee->d, ee->e), 20);
    int64_t df_q32 = carom_round(carom_dot(ee->d, ee->f), 20);
    int64_t d_q30 = carom_round(ee->sine_q30 * ee->sine_q30, 30); /* >= 1e-4 */

    /* q32 numbers of at most 2^41 by q20: |d| <= 2^9 units */
    *s_q22 = divide_floor((fix_mul(df_q32, b_q30, 30) - de_q32) * ((int64_t)1 << 20), d_q30);
    *q_q22 = divide_floor((df_q32 - fix_mul(de_q32, b_q30, 30)) * ((int64_t)1 << 20), d_q30);
    return *s_q22 >= -BOYSE_POINT_NOISE_Q22 &&
           *s_q22 <= ee->edge_a->length_q22 + BOYSE_POINT_NOISE_Q22 &&
           *q_q22 >= -BOYSE_POINT_NOISE_Q22 &&
           *q_q22 <= ee->edge_b->length_q22 + BOYSE_POINT_NOISE_Q22;
}

static void touch_edge_edge(const struct boyse_pair *pair, const struct candidate *c, int32_t t_q30,
                            struct boyse_touch *touch)
{
    struct boyse_edge_edge ee;
    int64_t s_q22, q_q22;
    int32_t n[3];
    int likely;

    boyse_place_edge_edge(pair, c, t_q30, &ee);
    touch->valid = false;
    touch->sign = 1;
    touch->gap_q22 = edge_gap(&ee, 1);
    if (ee.sine_q30 < BOYSE_PARALLEL_Q30 || !nearest_points(&ee, &s_q22, &q_q22)) {
        return;
    }
    for (int k = 0; k < 3; k++) {
        n[k] = (int32_t)((int64_t)ee.w[k] * CAROM_ONE_Q30 / ee.sine_q30);
        touch->on_a.c[k] = ee.start_a.c[k] + (int32_t)carom_round(ee.e[k] * s_q22, 30);
        touch->on_b.c[k] = ee.start_b.c[k] + (int32_t)carom_round(ee.f[k] * q_q22, 30);
    }
    likely = facing_sign(pair, &ee, t_q30, n);
    for (int k = 0; k < 2 && !touch->valid; k++) {
        int sign = k == 0 ? likely : -likely;

        if (normal_in_cones(pair, &ee, t_q30, n, sign)) {
            touch->valid = true;
            touch->sign = (int8_t)sign;
            touch->gap_q22 = edge_gap(&ee, sign);
            for (int i = 0; i < 3; i++) {
                touch->normal.c[i] = sign * n[i];
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
