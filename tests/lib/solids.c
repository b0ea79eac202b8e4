/* SPDX-License-Identifier: MIT */
/* Posed meshes in double precision: distances and normal cones from all faces. */
#include "solids.h"
#include "real.h"

/* -------------------------------------------------------------------- places */

/* The box of some vertices. */
static struct solid_bounds bound(const struct solid *s, const uint16_t *vertices, int count)
{
    struct solid_bounds box = s->vertex[vertices[0]];

    for (int i = 1; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            int64_t x = s->vertex[vertices[i]].low_q22[k];

            box.low_q22[k] = x < box.low_q22[k] ? x : box.low_q22[k];
            box.high_q22[k] = x > box.high_q22[k] ? x : box.high_q22[k];
        }
    }
    return box;
}

void solid_note_owned(struct solid *s)
{
    for (uint32_t v = 0; v < s->shape->raw.vertex_count; v++) {
        s->own_vertex[v] = shape_owns_vertex(s->shape, v);
    }
    for (uint32_t e = 0; e < s->shape->mesh.edge_count; e++) {
        s->own_edge[e] = shape_owns_edge(s->shape, e);
        s->behind[e] = mesh_edge_behind(&s->shape->mesh, e);
    }
}

void solid_place(struct solid *s, const struct body_state *state)
{
    const struct carom_mesh *mesh = &s->shape->mesh;
    double q[4], m[3][3];

    for (int k = 0; k < 4; k++) {
        q[k] = state->rotation.c[k];
    }
    real_matrix(m, q);
    for (uint32_t v = 0; v < mesh->raw.vertex_count; v++) {
        double local[3];

        for (int k = 0; k < 3; k++) {
            local[k] = real(s->shape->vertices[v][k], mesh->raw.quantum_bits) -
                       real(mesh->mass.centre.c[k], 22);
        }
        real_rotate(s->p[v], m, local);
        for (int k = 0; k < 3; k++) {
            s->p[v][k] += real(state->position.c[k], 32);
            s->vertex[v].low_q22[k] = real_round(s->p[v][k] * real_power2(22));
            s->vertex[v].high_q22[k] = s->vertex[v].low_q22[k];
        }
    }
    for (uint32_t f = 0; f < mesh->raw.face_count; f++) {
        const uint16_t *c = s->shape->faces[f];
        double e[3], g[3], n[3], length;

        for (int k = 0; k < 3; k++) {
            e[k] = s->p[c[1]][k] - s->p[c[0]][k];
            g[k] = s->p[c[2]][k] - s->p[c[0]][k];
        }
        real_cross(n, e, g);
        length = real_length(n);
        for (int k = 0; k < 3; k++) {
            s->normal[f][k] = n[k] / length;
        }
        s->face[f] = bound(s, c, 3);
    }
    for (uint32_t e = 0; e < mesh->edge_count; e++) {
        s->edge[e] = bound(s, mesh->edges[e].vertex, 2);
    }
}

/* ----------------------------------------------------------------- distances */

static void minus(double out[3], const double p[3], const double q[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = p[k] - q[k];
    }
}

static double clamp(double v)
{
    return v < 0 ? 0 : v > 1 ? 1 : v;
}

/* The distance of p0 p1 from q0 q1: try the inner optimum, then each end. */
static double between_segments(const double p0[3], const double p1[3], const double q0[3],
                               const double q1[3])
{
    double e[3], f[3], d[3], best = 1e9, ee, ef, ff, det;

    minus(e, p1, p0);
    minus(f, q1, q0);
    minus(d, p0, q0);
    ee = real_dot(e, e);
    ef = real_dot(e, f);
    ff = real_dot(f, f);
    det = ee * ff - ef * ef;
    for (int i = 0; i < 5; i++) {
        double s, q, x[3];

        if (i < 2) {
            s = i;
            q = clamp((real_dot(d, f) + s * ef) / ff);
        } else if (i < 4) {
            q = i - 2;
            s = clamp((q * ef - real_dot(d, e)) / ee);
        } else if (det > 1e-12 * ee * ff) {
            s = clamp((ef * real_dot(d, f) - ff * real_dot(d, e)) / det);
            q = clamp((ee * real_dot(d, f) - ef * real_dot(d, e)) / det);
        } else {
            break;
        }
        for (int k = 0; k < 3; k++) {
            x[k] = d[k] + s * e[k] - q * f[k];
        }
        best = real_length(x) < best ? real_length(x) : best;
    }
    return best;
}

static double from_face(const double p[3], const struct solid *s, uint32_t f)
{
    const uint16_t *c = s->shape->faces[f];
    double d[3], height, best = 1e9;
    bool inside = true;

    minus(d, p, s->p[c[0]]);
    height = real_dot(d, s->normal[f]);
    for (int k = 0; k < 3; k++) {
        double e[3], in[3];

        minus(e, s->p[c[(k + 1) % 3]], s->p[c[k]]);
        minus(d, p, s->p[c[k]]);
        real_cross(in, s->normal[f], e);
        inside = inside && real_dot(in, d) >= 0;
    }
    if (inside) {
        return real_abs(height);
    }
    for (int k = 0; k < 3; k++) {
        double x = between_segments(p, p, s->p[c[k]], s->p[c[(k + 1) % 3]]);

        best = x < best ? x : best;
    }
    return best;
}

/* Whether boxes are farther apart than the reach; this only saves time. */
static bool bounds_apart(const struct solid_bounds *p, const struct solid_bounds *q,
                         int64_t reach_q22)
{
    for (int k = 0; k < 3; k++) {
        if (p->high_q22[k] + reach_q22 + 2 < q->low_q22[k] ||
            q->high_q22[k] + reach_q22 + 2 < p->low_q22[k]) {
            return true;
        }
    }
    return false;
}

bool solid_vertex_near(const struct solid *from, uint32_t vertex, const struct solid *to,
                       uint32_t face, int64_t reach_q22)
{
    return !bounds_apart(&from->vertex[vertex], &to->face[face], reach_q22) &&
           from_face(from->p[vertex], to, face) <= real(reach_q22, 22);
}

bool solid_edges_near(const struct solid *a, uint32_t i, const struct solid *b, uint32_t j,
                      int64_t reach_q22)
{
    const uint16_t *on_a = a->shape->mesh.edges[i].vertex, *on_b = b->shape->mesh.edges[j].vertex;

    return !bounds_apart(&a->edge[i], &b->edge[j], reach_q22) &&
           between_segments(a->p[on_a[0]], a->p[on_a[1]], b->p[on_b[0]], b->p[on_b[1]]) <=
               real(reach_q22, 22);
}

/* -------------------------------------------------------------------- cones */

bool solid_vertex_cone(const struct solid *s, uint32_t v, const double n[3], double tolerance)
{
    for (uint32_t f = 0; f < s->shape->raw.face_count; f++) {
        const uint16_t *c = s->shape->faces[f];

        for (int k = 0; k < 3; k++) {
            for (int i = 1; i < 3 && c[k] == v; i++) {
                double e[3];

                minus(e, s->p[c[(k + i) % 3]], s->p[v]);
                if (real_dot(e, n) < -tolerance * real_length(e)) {
                    return false;
                }
            }
        }
    }
    return true;
}

/* The largest component of a unit vector n into the faces of an edge. */
static double into_faces(const struct solid *s, const struct carom_edge *edge, const double n[3])
{
    double most = -1;

    for (int side = 0; side < 2; side++) {
        const double *from = s->p[edge->vertex[0]];
        double e[3], d[3] = {0, 0, 0}, in[3], along;
        const uint16_t *c;

        if (edge->face[side] == CAROM_NO_FACE) {
            continue;
        }
        c = s->shape->faces[edge->face[side]];
        minus(e, s->p[edge->vertex[1]], from);
        for (int k = 0; k < 3; k++) {
            if (c[k] != edge->vertex[0] && c[k] != edge->vertex[1]) {
                minus(d, s->p[c[k]], from);
            }
        }
        along = real_dot(d, e) / real_dot(e, e);
        for (int k = 0; k < 3; k++) {
            in[k] = d[k] - along * e[k];
        }
        along = real_dot(n, in) / real_length(in);
        most = along > most ? along : most;
    }
    return most;
}

/* The component of n along the sum of the normals of an edge's two faces. */
static double along_faces(const struct solid *s, const struct carom_edge *edge, const double n[3])
{
    return real_dot(n, s->normal[edge->face[0]]) + real_dot(n, s->normal[edge->face[1]]);
}

bool solid_edge_cones(const struct solid *a, uint32_t i, const struct solid *b, uint32_t j,
                      double tolerance)
{
    const struct carom_edge *ea = &a->shape->mesh.edges[i], *eb = &b->shape->mesh.edges[j];
    double e[3], f[3], w[3], length;

    minus(e, a->p[ea->vertex[1]], a->p[ea->vertex[0]]);
    minus(f, b->p[eb->vertex[1]], b->p[eb->vertex[0]]);
    real_cross(w, e, f);
    length = real_length(w);
    if (length < 0.01 * real_length(e) * real_length(f)) {
        return false; /* parallel edges: vertices and faces are enough */
    }
    for (int sign = -1; sign <= 1; sign += 2) {
        double n[3], back[3];

        for (int k = 0; k < 3; k++) {
            n[k] = sign * w[k] / length;
            back[k] = -n[k];
        }
        if (into_faces(b, eb, n) < tolerance && into_faces(a, ea, back) < tolerance &&
            !(b->behind[j] && (along_faces(b, eb, n) > 0 || along_faces(a, ea, n) > 0))) {
            return true;
        }
    }
    return false;
}
