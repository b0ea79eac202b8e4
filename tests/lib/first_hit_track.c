/* SPDX-License-Identifier: MIT */
/* The true motion of two bodies of the first-hit test, and the places of their features. */
#include <math.h>

#include "first_hit_track.h"
#include "lab.h"
#include "real.h"

#define SAMPLES     300
#define SAMPLES_MAX 8000
#define CROSSING    1e-9 /* deeper than this is a crossing */

/* -------------------------------------------------------------- the true motion */

/* Places are relative to `origin`, so that doubles hold them exactly. */
static struct first_hit_track track_of(const struct body *body, const struct body_state *state,
                                       const carom_v3_q32 *origin)
{
    const struct body_path *path = &body->path;
    struct first_hit_track t;

    for (int k = 0; k < 3; k++) {
        t.x[k] = lab_double(state->position.c[k] - origin->c[k], 32);
        t.v[k] = lab_double(path->v.c[k], 40);
        t.g[k] = lab_double(path->g.c[k], 40);
        t.u[k] = lab_double(path->u.c[k], 30);
    }
    for (int k = 0; k < 4; k++) {
        t.q[k] = lab_double(state->rotation.c[k], 30);
    }
    t.radius = lab_double(body->def.radius_q22, 22);
    return t;
}

struct oracle_pose first_hit_pose(const struct first_hit_track *m, const double centre[3], double t)
{
    const double *a = m->q;
    double x[3], b[3] = {t * m->u[0], t * m->u[1], t * m->u[2]};
    double q[4] = {a[0] - a[1] * b[0] - a[2] * b[1] - a[3] * b[2],
                   a[1] + a[0] * b[0] + a[2] * b[2] - a[3] * b[1],
                   a[2] + a[0] * b[1] + a[3] * b[0] - a[1] * b[2],
                   a[3] + a[0] * b[2] + a[1] * b[1] - a[2] * b[0]};

    for (int k = 0; k < 3; k++) {
        x[k] = m->x[k] + t * (m->v[k] + t * m->g[k]);
    }
    return oracle_pose_make(x, q, centre);
}

static void between(double out[3], const double from[3], const double to[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = to[k] - from[k];
    }
}

double first_hit_speed(const struct first_hit_track track[2])
{
    double v[3], g[3];

    between(v, track[0].v, track[1].v);
    between(g, track[0].g, track[1].g);
    return real_length(v) + 2 * real_length(g) + 2 * track[0].radius * real_length(track[0].u) +
           2 * track[1].radius * real_length(track[1].u);
}

void first_hit_read_tracks(struct first_hit_track track[2], const struct step *s)
{
    for (int i = 0; i < 2; i++) {
        track[i] = track_of(&s->w->bodies[i], &s->next->bodies[i], &s->next->bodies[0].position);
    }
}

bool first_hit_cross(const struct first_hit_motion *motion, const struct first_hit_track track[2],
                     double t)
{
    struct oracle_pose pose[2];

    for (int i = 0; i < 2; i++) {
        pose[i] = first_hit_pose(&track[i], motion->mesh[i]->centre, t);
    }
    return oracle_crossings(&motion->mesh[1]->doubles, &pose[1], &motion->mesh[0]->doubles,
                            &pose[0], CROSSING)
               .pairs != 0;
}

double first_hit_crossing(const struct first_hit_motion *motion,
                          const struct first_hit_track track[2], double end)
{
    double thin = fmin(motion->mesh[0]->thin, motion->mesh[1]->thin);
    double wanted = ceil(end * first_hit_speed(track) / (thin / 2));
    int samples = (int)fmin(fmax(wanted, SAMPLES), SAMPLES_MAX);

    for (int i = 0; i <= samples; i++) {
        double t = end * i / samples, apart = 0;

        for (int k = 0; k < 3; k++) {
            double d = track[1].x[k] - track[0].x[k] +
                       t * (track[1].v[k] - track[0].v[k] + t * (track[1].g[k] - track[0].g[k]));

            apart += d * d;
        }
        if (sqrt(apart) < track[0].radius + track[1].radius && first_hit_cross(motion, track, t)) {
            return t;
        }
    }
    return 2;
}

/* ------------------------------------------------------------------- features */

void first_hit_point(double out[3], const struct first_hit_mesh *mesh,
                     const struct oracle_pose *pose, uint32_t vertex)
{
    for (int k = 0; k < 3; k++) {
        out[k] =
            pose->position[k] + real_dot(pose->rotation.row[k], mesh->doubles.vertices[vertex]);
    }
}

static double length_along(const double offset[3], const double a[3], double s, const double b[3],
                           double t)
{
    double d[3];

    for (int k = 0; k < 3; k++) {
        d[k] = offset[k] + s * a[k] - t * b[k];
    }
    return real_length(d);
}

static double clamp(double t)
{
    return t < 0 ? 0 : t > 1 ? 1 : t;
}

/*
 * The distance of two segments: the smallest of the inner solution and of each end against the
 * other segment.
 */
static double segment_distance(const double p[3], const double q[3], const double u[3],
                               const double v[3])
{
    double a[3], b[3], offset[3], aa, bb, ab, ao, bo, determinant, least = HUGE_VAL;

    between(a, p, q);
    between(b, u, v);
    between(offset, u, p);
    aa = real_dot(a, a);
    bb = real_dot(b, b);
    ab = real_dot(a, b);
    ao = real_dot(a, offset);
    bo = real_dot(b, offset);
    determinant = aa * bb - ab * ab;
    if (determinant > 1e-12 * aa * bb) {
        double s = (ab * bo - bb * ao) / determinant, t = (aa * bo - ab * ao) / determinant;

        if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
            least = length_along(offset, a, s, b, t);
        }
    }
    for (int end = 0; end < 2; end++) {
        least = fmin(least, length_along(offset, a, end, b, clamp((bo + end * ab) / bb)));
        least = fmin(least, length_along(offset, a, clamp((end * ab - ao) / aa), b, end));
    }
    return least;
}

static struct first_hit_features edges(double p[2][3], double q[2][3], const double n[3])
{
    double e[3], f[3], w[3], d[3];
    struct first_hit_features out = {.sharp = 1};

    between(e, p[0], p[1]);
    between(f, q[0], q[1]);
    between(d, q[0], p[0]);
    real_cross(w, e, f);
    out.sine = real_length(w) / real_length(e) / real_length(f);
    out.gap = real_dot(w, d) / real_length(w) * (real_dot(w, n) < 0 ? -1 : 1);
    out.distance = segment_distance(p[0], p[1], q[0], q[1]);
    return out;
}

static struct first_hit_features vertex_and_face(const double p[3], double corner[3][3])
{
    struct first_hit_features out = {0, HUGE_VAL, 1, 1};
    double side[2][3], n[3], d[3];
    bool inside = true;

    between(side[0], corner[0], corner[1]);
    between(side[1], corner[0], corner[2]);
    between(d, corner[0], p);
    real_cross(n, side[0], side[1]);
    out.gap = real_dot(n, d) / real_length(n);
    for (int k = 0; k < 3; k++) {
        double in[3], next[3], last[3];

        between(next, corner[k], corner[(k + 1) % 3]);
        between(last, corner[k], corner[(k + 2) % 3]);
        out.sharp = fmin(out.sharp, real_length(n) / real_length(next) / real_length(last));

        between(side[0], corner[k], corner[(k + 1) % 3]);
        between(d, corner[k], p);
        real_cross(in, n, side[0]);
        inside = inside && real_dot(in, d) >= 0;
        out.distance =
            fmin(out.distance,
                 length_along(d, side[0], -clamp(real_dot(d, side[0]) / real_dot(side[0], side[0])),
                              side[0], 0));
    }
    if (inside) {
        out.distance = fabs(out.gap);
    }
    return out;
}

struct first_hit_features first_hit_features(const struct first_hit_motion *motion,
                                             const struct first_hit_track track[2],
                                             const struct candidate *c, const double n[3], double t)
{
    const struct first_hit_mesh *b = motion->mesh[0], *a = motion->mesh[1];
    struct oracle_pose pose_b = first_hit_pose(&track[0], b->centre, t);
    struct oracle_pose pose_a = first_hit_pose(&track[1], a->centre, t);
    double p[3][3], q[3][3];

    if (c->kind == CANDIDATE_EDGE_EDGE) {
        for (int k = 0; k < 2; k++) {
            first_hit_point(p[k], a, &pose_a, a->mesh.edges[c->i].vertex[k]);
            first_hit_point(q[k], b, &pose_b, b->mesh.edges[c->j].vertex[k]);
        }
        return edges(p, q, n);
    }
    if (c->kind == CANDIDATE_FACE_VERTEX) {
        struct oracle_pose pose = pose_a;
        const struct first_hit_mesh *mesh = a;

        a = b;
        b = mesh;
        pose_a = pose_b;
        pose_b = pose;
    }
    first_hit_point(p[0], a, &pose_a, c->i);
    for (int k = 0; k < 3; k++) {
        first_hit_point(q[k], b, &pose_b, b->doubles.faces[c->j][k]);
    }
    return vertex_and_face(p[0], q);
}
