/* SPDX-License-Identifier: MIT */
/*
 * Candidates against trying everything: in double precision, every vertex and face, and every two
 * edges, of two meshes.
 */
#include "interfere.h"
#include "real.h"
#include "shapes.h"
#include "test.h"

#ifdef TEST_LONG
#define POSES 2000 /* of each two shapes */
#define FIELD 12
#else
#define POSES 12
#define FIELD 5
#endif

#define CANDIDATES 4096
#define FACES      2048
#define ENTRIES    512
/* Rounding of the places and directions that the engine works with. */
#define PLACE_NOISE 4e-6
#define ANGLE_NOISE 1e-6

/* One of the two bodies, in world axes. */
struct solid {
    struct shape *shape;
    double p[SHAPE_VERTICES][3];
    double normal[SHAPE_FACES][3];
};

static struct shape shape_a, shape_b;
static struct solid a = {.shape = &shape_a}, b = {.shape = &shape_b};
static struct body bodies[2];
static struct body_state states[2];
static const struct pair pairs[1] = {{0, 1}};

static uint16_t heads[ZLIST_CELLS_MAX];
static struct zentry entries[ENTRIES];
static struct candidate candidates[CANDIDATES];
static struct carom_face_ref faces[FACES];
static struct pool entry_pool, candidate_pool, face_pool;
static struct interfere work;

/* --------------------------------------------------------------- the answer */

#define SET_BYTES (1 << 16)
struct set {
    uint8_t bits[SET_BYTES];
};

static struct set found, again;

static uint32_t place_in_set(int kind, uint32_t i, uint32_t j)
{
    const struct carom_mesh *ma = &shape_a.mesh, *mb = &shape_b.mesh;
    uint32_t first = ma->raw.vertex_count * mb->raw.face_count;

    switch (kind) {
    case CANDIDATE_VERTEX_FACE:
        return i * mb->raw.face_count + j;
    case CANDIDATE_FACE_VERTEX:
        return first + i * ma->raw.face_count + j;
    default:
        return first + mb->raw.vertex_count * ma->raw.face_count + i * mb->edge_count + j;
    }
}

static bool in_set(const struct set *s, int kind, uint32_t i, uint32_t j)
{
    uint32_t place = place_in_set(kind, i, j);

    return s->bits[place / 8] >> place % 8 & 1;
}

struct collector {
    struct candidate_visitor base;
    struct set *set;
    uint32_t count, largest;
};

static void collect(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    struct collector *to = (struct collector *)self;

    to->count += n;
    to->largest = n > to->largest ? n : to->largest;
    for (uint32_t k = 0; k < n; k++) {
        uint32_t place = place_in_set(c[k].kind, c[k].i, c[k].j);

        CHECK_EQ(c[k].pair, 0);
        CHECK(place / 8 < SET_BYTES);
        to->set->bits[place / 8] |= (uint8_t)(1 << place % 8);
    }
}

/* Gather from the start with pools of these sizes. */
static int gather(struct set *set, uint32_t entry_size, uint32_t candidate_size, uint32_t face_size,
                  struct collector *to)
{
    int result;

    memset(&work, 0, sizeof work);
    memset(set, 0, sizeof *set);
    entry_pool = (struct pool){entry_size, 0, 0, 0};
    candidate_pool = (struct pool){candidate_size, 0, 0, 0};
    face_pool = (struct pool){face_size, 0, 0, 0};
    work.lists = (struct zlist){heads, entries, &entry_pool};
    work.candidates = candidates;
    work.candidate_pool = &candidate_pool;
    work.faces = faces;
    work.face_pool = &face_pool;
    memset(to, 0, sizeof *to);
    to->base.visit = collect;
    to->set = set;
    interfere_begin(&work);
    result = interfere_visit(&work, bodies, pairs, 1, &to->base);
    interfere_finish(&work);
    return result;
}

/* ------------------------------------------------------------------- scenes */

static void place(struct solid *s, struct body *body, const struct body_state *state)
{
    const struct carom_mesh *mesh = &s->shape->mesh;
    double q[4], m[3][3];

    body->gathered_at = state->position;
    body_matrix(&body->gathered_r, &state->rotation);
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
    }
}

/* Body 0 over a place of body 1, turned anyhow; both anywhere in the world. */
static void random_scene(struct test_random *r, bool turn_b)
{
    double q[4], m[3][3], local[3], world[3];
    int half = shape_b.mesh.box[1][0], z = shape_b.mesh.box[1][2];

    states[0].rotation = shape_random_turn(r);
    states[1].rotation =
        turn_b ? shape_random_turn(r) : (carom_quat_q30){{CAROM_ONE_Q30, 0, 0, 0}};
    local[0] = real(test_random_range(r, -half, half), shape_b.raw.quantum_bits);
    local[1] = real(test_random_range(r, -half, half), shape_b.raw.quantum_bits);
    local[2] = real(test_random_range(r, 0, z), shape_b.raw.quantum_bits) +
               real(test_random_range(r, 0, shape_a.mesh.radius_q22), 22);
    for (int k = 0; k < 4; k++) {
        q[k] = states[1].rotation.c[k];
    }
    real_matrix(m, q);
    real_rotate(world, m, local);
    for (int k = 0; k < 3; k++) {
        states[1].position.c[k] =
            test_random_range(r, -((int64_t)3000 << 32), (int64_t)3000 << 32);
        states[0].position.c[k] = states[1].position.c[k] + real_round(world[k] * 4294967296.0);
    }
    for (int i = 0; i < 2; i++) {
        bodies[i].reach_q22 = (int32_t)test_random_range(r, 0, 1) << test_random_range(r, 8, 18);
        bodies[i].turn_q30 = (int32_t)test_random_range(r, 0, CAROM_ONE_Q30 / 10);
    }
    place(&a, &bodies[0], &states[0]);
    place(&b, &bodies[1], &states[1]);
}

/* ------------------------------------------------------------ by trying all */

static double reach, turn;

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

/* Distance of p0 p1 from q0 q1: try the inner optimum, then each end. */
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

/* Whether boxes around two sets of points are farther apart than the reach: only to save time. */
static bool boxes_apart(const double (*const p[3]), int np, const double (*const q[3]), int nq)
{
    for (int k = 0; k < 3; k++) {
        double p0 = 1e9, p1 = -1e9, q0 = 1e9, q1 = -1e9;

        for (int i = 0; i < np; i++) {
            p0 = (*p[i])[k] < p0 ? (*p[i])[k] : p0;
            p1 = (*p[i])[k] > p1 ? (*p[i])[k] : p1;
        }
        for (int i = 0; i < nq; i++) {
            q0 = (*q[i])[k] < q0 ? (*q[i])[k] : q0;
            q1 = (*q[i])[k] > q1 ? (*q[i])[k] : q1;
        }
        if (p1 < q0 - reach || q1 < p0 - reach) {
            return true;
        }
    }
    return false;
}

/* No edge of the vertex goes down along n by more than the tolerance. */
static bool vertex_cone(const struct solid *s, uint32_t v, const double n[3], double tolerance)
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

/* How much of a unit vector n points into the faces of an edge, at most. */
static double into_faces(const struct solid *s, const struct carom_edge *edge, const double n[3])
{
    double most = -1;

    for (int side = 0; side < 2; side++) {
        const double *from = s->p[edge->vertex[0]];
        double e[3], d[3], in[3], along;
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

static bool edge_cones(const struct carom_edge *ea, const struct carom_edge *eb, double tolerance)
{
    double e[3], f[3], w[3], length;

    minus(e, a.p[ea->vertex[1]], a.p[ea->vertex[0]]);
    minus(f, b.p[eb->vertex[1]], b.p[eb->vertex[0]]);
    real_cross(w, e, f);
    length = real_length(w);
    if (length < 0.01 * real_length(e) * real_length(f)) {
        return false; /* parallel: vertices and faces are enough */
    }
    for (int sign = -1; sign <= 1; sign += 2) {
        double n[3], back[3];

        for (int k = 0; k < 3; k++) {
            n[k] = sign * w[k] / length;
            back[k] = -n[k];
        }
        if (into_faces(&b, eb, n) < tolerance && into_faces(&a, ea, back) < tolerance) {
            return true;
        }
    }
    return false;
}

static bool owned(const struct carom_mesh *mesh, uint32_t v)
{
    for (uint32_t f = 0; f < mesh->raw.face_count; f++) {
        for (int k = 0; k < 3; k++) {
            if (mesh->raw.faces[f][k] == v && mesh->faces[f].own >> k & 1) {
                return true;
            }
        }
    }
    return false;
}

static bool owned_edge(const struct carom_mesh *mesh, uint32_t e)
{
    uint32_t f = mesh->edges[e].face[0];

    for (int k = 0; k < 3; k++) {
        if (mesh->faces[f].edge[k] == e) {
            return mesh->faces[f].own >> (3 + k) & 1;
        }
    }
    return false;
}

/* Every vertex of `from` near a face of `to` is a candidate. Returns how many there are. */
static uint32_t try_vertices(const struct solid *from, const struct solid *to, int kind)
{
    double tolerance = real(INTERFERE_CONE_Q30, 30) + turn - ANGLE_NOISE;
    uint32_t count = 0;

    for (uint32_t v = 0; v < from->shape->raw.vertex_count; v++) {
        if (!owned(&from->shape->mesh, v)) {
            continue;
        }
        for (uint32_t f = 0; f < to->shape->raw.face_count; f++) {
            const uint16_t *c = to->shape->faces[f];
            const double(*const corners[3])[3] = {&to->p[c[0]], &to->p[c[1]], &to->p[c[2]]};
            const double(*const point[1])[3] = {&from->p[v]};

            if (!boxes_apart((const double(*const *)[3])point, 1, (const double(*const *)[3])corners, 3) &&
                from_face(from->p[v], to, f) <= reach - PLACE_NOISE &&
                vertex_cone(from, v, to->normal[f], tolerance)) {
                CHECK(in_set(&found, kind, v, f));
                count++;
            }
        }
    }
    return count;
}

static uint32_t try_edges(void)
{
    uint32_t count = 0;

    for (uint32_t i = 0; i < shape_a.mesh.edge_count; i++) {
        const struct carom_edge *ea = &shape_a.mesh.edges[i];
        const double *p0 = a.p[ea->vertex[0]], *p1 = a.p[ea->vertex[1]];

        for (uint32_t j = 0; j < shape_b.mesh.edge_count && owned_edge(&shape_a.mesh, i); j++) {
            const struct carom_edge *eb = &shape_b.mesh.edges[j];
            const double *q0 = b.p[eb->vertex[0]], *q1 = b.p[eb->vertex[1]];
        }
    }
    return count;
}
