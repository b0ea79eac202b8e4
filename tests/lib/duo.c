/* SPDX-License-Identifier: MIT */
/* Two bodies on their paths, and the true motion of their features in double precision. */
#include "duo.h"
#include "real.h"
#include "test.h"

struct duo duo;

/* -------------------------------------------------------------------- motion */

void duo_begin(bool b_moves)
{
    shape_body(&duo.shape[0], true, &duo.body[0], &duo.state[0]);
    shape_body(&duo.shape[1], b_moves, &duo.body[1], &duo.state[1]);
}

static void read_motion(int side)
{
    const struct body_path *path = &duo.body[side].path;
    struct duo_motion *m = &duo.motion[side];

    for (int k = 0; k < 3; k++) {
        m->x[k] = real(duo.state[side].position.c[k], 32);
        m->v[k] = real(path->v.c[k], 40);
        m->g[k] = real(path->g.c[k], 40);
        m->u[k] = real(path->u.c[k], 30);
    }
    for (int k = 0; k < 4; k++) {
        m->q[k] = real(duo.state[side].rotation.c[k], 30);
    }
}

void duo_read_motion(void)
{
    read_motion(0);
    read_motion(1);
}

void duo_set_motion(int side, const double v[3], const double w[3])
{
    carom_v3_q40 v_q40, w_q40;

    for (int k = 0; k < 3; k++) {
        v_q40.c[k] = real_round(v[k] * real_power2(40));
        w_q40.c[k] = real_round(w[k] * real_power2(40));
    }
    body_set_motion(&duo.body[side], &duo.state[side], &v_q40, &w_q40);
}

void duo_set_paths(const double v[3], const double w[3], const carom_v3_q40 *gravity)
{
    duo_set_motion(0, v, w);
    body_predict(&duo.body[0], &duo.state[0], CAROM_ONE_Q30, gravity);
    body_predict(&duo.body[1], &duo.state[1], CAROM_ONE_Q30, gravity);
    boyse_pair_init(&duo.pair, &duo.body[0], &duo.body[1]);
    duo_read_motion();
}

static void pose_at(struct duo_pose *p, int side, double t)
{
    const struct duo_motion *m = &duo.motion[side];
    const double *a = m->q;
    double b[3] = {t * m->u[0], t * m->u[1], t * m->u[2]};
    double q[4] = {a[0] - a[1] * b[0] - a[2] * b[1] - a[3] * b[2],
                   a[1] + a[0] * b[0] + a[2] * b[2] - a[3] * b[1],
                   a[2] + a[0] * b[1] + a[3] * b[0] - a[1] * b[2],
                   a[3] + a[0] * b[2] + a[1] * b[1] - a[2] * b[0]};

    real_matrix(p->r, q);
    for (int k = 0; k < 3; k++) {
        p->x[k] = m->x[k] + t * m->v[k] + t * t * m->g[k];
    }
}

static void vertex_local(double out[3], int side, uint32_t v)
{
    const struct carom_mesh *mesh = &duo.shape[side].mesh;

    for (int k = 0; k < 3; k++) {
        out[k] = real(duo.shape[side].vertices[v][k], mesh->raw.quantum_bits) -
                 real(mesh->mass.centre.c[k], 22);
    }
}

static void vertex_world(double out[3], int side, struct duo_pose *p, uint32_t v)
{
    double local[3];

    vertex_local(local, side, v);
    real_rotate(out, p->r, local);
    for (int k = 0; k < 3; k++) {
        out[k] += p->x[k];
    }
}

static void minus(double out[3], const double p[3], const double q[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = p[k] - q[k];
    }
}

static void unit(double v[3])
{
    double length = real_length(v);

    for (int k = 0; k < 3; k++) {
        v[k] /= length;
    }
}

int duo_vertex_side(int kind)
{
    return kind == CANDIDATE_VERTEX_FACE ? 0 : 1;
}

void duo_features_at(struct duo_features *f, const struct candidate *c, double t)
{
    double d[3];

    pose_at(&f->pose[0], 0, t);
    pose_at(&f->pose[1], 1, t);
    if (c->kind == CANDIDATE_EDGE_EDGE) {
        uint32_t edge[2] = {c->i, c->j};

        for (int s = 0; s < 2; s++) {
            const struct carom_edge *mesh_edge = &duo.shape[s].mesh.edges[edge[s]];
            double to[3];

            vertex_world(f->from[s], s, &f->pose[s], mesh_edge->vertex[0]);
            vertex_world(to, s, &f->pose[s], mesh_edge->vertex[1]);
            minus(f->e[s], to, f->from[s]);
            f->length[s] = real_length(f->e[s]);
            unit(f->e[s]);
        }
        real_cross(f->n, f->e[0], f->e[1]);
        f->sine = real_length(f->n);
        unit(f->n);
        minus(d, f->from[0], f->from[1]);
    } else {
        int v = duo_vertex_side(c->kind);
        double e[3], g[3];

        vertex_world(f->p, v, &f->pose[v], c->i);
        for (int k = 0; k < 3; k++) {
            vertex_world(f->c[k], 1 - v, &f->pose[1 - v], duo.shape[1 - v].faces[c->j][k]);
        }
        minus(e, f->c[1], f->c[0]);
        minus(g, f->c[2], f->c[0]);
        real_cross(f->n, e, g);
        unit(f->n);
        f->sine = 1;
        minus(d, f->p, f->c[0]);
    }
    f->gap = real_dot(f->n, d);
}

double duo_gap_at(const struct candidate *c, double t)
{
    struct duo_features f;

    duo_features_at(&f, c, t);
    return f.gap;
}

/* ----------------------------------------------------------------- validity */

double duo_inside(const struct duo_features *f, const struct candidate *c)
{
    double least = 1e9, d[3];

    if (c->kind == CANDIDATE_EDGE_EDGE) {
        double b = real_dot(f->e[0], f->e[1]), d0, d1, s[2];

        minus(d, f->from[0], f->from[1]);
        d0 = real_dot(d, f->e[0]);
        d1 = real_dot(d, f->e[1]);
        s[0] = (b * d1 - d0) / (f->sine * f->sine);
        s[1] = (d1 - b * d0) / (f->sine * f->sine);
        for (int k = 0; k < 2; k++) {
            least = s[k] < least ? s[k] : least;
            least = f->length[k] - s[k] < least ? f->length[k] - s[k] : least;
        }
        return least;
    }
    for (int k = 0; k < 3; k++) {
        double e[3], in[3], x;

        minus(e, f->c[(k + 1) % 3], f->c[k]);
        unit(e);
        real_cross(in, f->n, e);
        minus(d, f->p, f->c[k]);
        x = real_dot(in, d);
        least = x < least ? x : least;
    }
    return least;
}

/* The smallest rise along n, a cosine, of the edges that leave a vertex. */
static double vertex_rise(int side, const struct duo_pose *p, uint32_t v, const double n[3])
{
    double least = 1, local[3], rotated[3], d[3];

    vertex_local(local, side, v);
    for (uint32_t f = 0; f < duo.shape[side].raw.face_count; f++) {
        const uint16_t *c = duo.shape[side].faces[f];

        for (int k = 0; k < 9; k++) {
            if (c[k / 3] == v && k / 3 != k % 3) {
                double other[3], rise;

                vertex_local(other, side, c[k % 3]);
                minus(d, other, local);
                real_rotate(rotated, (double(*)[3])p->r, d);
                rise = real_dot(rotated, n) / real_length(d);
                least = rise < least ? rise : least;
            }
        }
    }
    return least;
}

/* The largest component of n, a cosine, into a face of an edge. */
static double into_faces(int side, struct duo_pose *p, uint32_t number, const double n[3])
{
    const struct carom_edge *edge = &duo.shape[side].mesh.edges[number];
    double most = -1, from[3], to[3], e[3];

    vertex_world(from, side, p, edge->vertex[0]);
    vertex_world(to, side, p, edge->vertex[1]);
    minus(e, to, from);
    unit(e);
    for (int s = 0; s < 2; s++) {
        for (int k = 0; k < 3 && edge->face[s] != CAROM_NO_FACE; k++) {
            uint16_t v = duo.shape[side].faces[edge->face[s]][k];
            double corner[3], in[3], x;

            if (v == edge->vertex[0] || v == edge->vertex[1]) {
                continue;
            }
            vertex_world(corner, side, p, v);
            minus(in, corner, from);
            x = real_dot(in, e);
            for (int i = 0; i < 3; i++) {
                in[i] -= x * e[i];
            }
            unit(in);
            most = real_dot(in, n) > most ? real_dot(in, n) : most;
        }
    }
    return most;
}

double duo_in_cones(struct duo_features *f, const struct candidate *c, int sign)
{
    double tolerance = real(INTERFERE_CONE_Q30, 30), n[3], back[3], x[2];

    if (c->kind != CANDIDATE_EDGE_EDGE) {
        int v = duo_vertex_side(c->kind);

        return vertex_rise(v, &f->pose[v], c->i, f->n) + tolerance;
    }
    for (int k = 0; k < 3; k++) {
        n[k] = sign * f->n[k];
        back[k] = -n[k];
    }
    x[0] = tolerance - into_faces(0, &f->pose[0], c->i, back);
    x[1] = tolerance - into_faces(1, &f->pose[1], c->j, n);
    return x[0] < x[1] ? x[0] : x[1];
}
