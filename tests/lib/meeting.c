/* SPDX-License-Identifier: MIT */
/* Two bodies whose features meet at a known time, and their true places. */
#include "meeting.h"
#include "real.h"

/* ------------------------------------------------------------------- vectors */

static long double dot(const long double a[3], const long double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(long double out[3], const long double a[3], const long double b[3])
{
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;

        out[k] = a[i] * b[j] - a[j] * b[i];
    }
}

static void minus(long double out[3], const long double p[3], const long double q[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = p[k] - q[k];
    }
}

/* Newton's iteration, because boards have no mathematics library. */
static long double length_of(const long double v[3])
{
    long double square = dot(v, v), root = (long double)real_sqrt((double)square);

    return root > 0 ? (root + square / root) / 2 : 0;
}

static long double unit(long double v[3])
{
    long double length = length_of(v);

    for (int k = 0; k < 3; k++) {
        v[k] /= length;
    }
    return length;
}

static long double fixed(int64_t v, int bits)
{
    return (long double)v * (long double)real_power2(-bits);
}

/* -------------------------------------------------------------------- motion */

/* x + v t + g t^2, and the axes of the quaternion q (1, t u) of any length. */
static void pose_at(const struct meeting *m, int side, long double t, struct meeting_features *f)
{
    const struct body_path *path = &m->body[side].path;
    const int64_t *origin = m->body[0].path.origin_q22;
    long double q[4], b[3], w, x, y, z, s;

    for (int k = 0; k < 3; k++) {
        f->x[side][k] = fixed(path->origin_q22[k] - origin[k], 22) +
                        fixed(path->start_x_q32[k], 32) +
                        t * (fixed(path->v.c[k], 40) + t * fixed(path->g.c[k], 40));
        b[k] = t * fixed(path->u.c[k], 30);
    }
    for (int k = 0; k < 4; k++) {
        q[k] = fixed(path->q.c[k], 30);
    }
    w = q[0] - q[1] * b[0] - q[2] * b[1] - q[3] * b[2];
    x = q[1] + q[0] * b[0] + q[2] * b[2] - q[3] * b[1];
    y = q[2] + q[0] * b[1] + q[3] * b[0] - q[1] * b[2];
    z = q[3] + q[0] * b[2] + q[1] * b[1] - q[2] * b[0];
    s = 2 / (w * w + x * x + y * y + z * z);
    f->r[side][0][0] = 1 - s * (y * y + z * z);
    f->r[side][1][1] = 1 - s * (x * x + z * z);
    f->r[side][2][2] = 1 - s * (x * x + y * y);
    f->r[side][0][1] = s * (x * y - w * z);
    f->r[side][1][0] = s * (x * y + w * z);
    f->r[side][0][2] = s * (x * z + w * y);
    f->r[side][2][0] = s * (x * z - w * y);
    f->r[side][1][2] = s * (y * z - w * x);
    f->r[side][2][1] = s * (y * z + w * x);
}

/* A vertex relative to its body's centre of mass. */
static void local_vertex(const struct meeting *m, int side, uint32_t v, long double out[3])
{
    const struct shape *shape = &m->shape[side];

    for (int k = 0; k < 3; k++) {
        out[k] = fixed(shape->vertices[v][k], shape->raw.quantum_bits) -
                 fixed(shape->mesh.mass.centre.c[k], 22);
    }
}

static void vertex_at(const struct meeting *m, int side, uint32_t v,
                      const struct meeting_features *f, long double out[3])
{
    long double local[3];

    local_vertex(m, side, v, local);
    for (int k = 0; k < 3; k++) {
        out[k] = f->x[side][k] + dot(f->r[side][k], local);
    }
}

static int vertex_side(const struct candidate *c)
{
    return c->kind == CANDIDATE_VERTEX_FACE ? 0 : 1;
}

void meeting_at(const struct meeting *m, long double t, struct meeting_features *f)
{
    const struct candidate *c = &m->candidate;
    const uint32_t number[2] = {c->i, c->j};
    int v = vertex_side(c);
    long double d[3], e[3], g[3];

    pose_at(m, 0, t, f);
    pose_at(m, 1, t, f);
    f->sine = 1;
    if (c->kind == CANDIDATE_EDGE_EDGE) {
        for (int s = 0; s < 2; s++) {
            const uint16_t *ends = m->shape[s].mesh.edges[number[s]].vertex;

            vertex_at(m, s, ends[0], f, f->from[s]);
            vertex_at(m, s, ends[1], f, f->e[s]);
            minus(f->e[s], f->e[s], f->from[s]);
            f->edge[s] = unit(f->e[s]);
        }
        cross(f->n, f->e[0], f->e[1]);
        f->sine = unit(f->n);
        minus(d, f->from[0], f->from[1]);
    } else {
        vertex_at(m, v, c->i, f, f->p);
        for (int k = 0; k < 3; k++) {
            vertex_at(m, 1 - v, m->shape[1 - v].faces[c->j][k], f, f->corner[k]);
        }
        minus(e, f->corner[1], f->corner[0]);
        minus(g, f->corner[2], f->corner[0]);
        cross(f->n, e, g);
        unit(f->n);
        minus(d, f->p, f->corner[0]);
    }
    f->gap = dot(f->n, d);
}

long double meeting_slope(const struct meeting *m, long double t)
{
    const long double step = 1.0L / 65536;
    struct meeting_features before, after;

    meeting_at(m, t - step, &before);
    meeting_at(m, t + step, &after);
    return (after.gap - before.gap) / (2 * step);
}

/* ------------------------------------------------------------------ validity */

long double meeting_inside(const struct meeting *m, const struct meeting_features *f)
{
    long double least = 1000, d[3];

    if (m->candidate.kind == CANDIDATE_EDGE_EDGE) {
        long double b = dot(f->e[0], f->e[1]), along[2], d0, d1;

        minus(d, f->from[0], f->from[1]);
        d0 = dot(d, f->e[0]);
        d1 = dot(d, f->e[1]);
        along[0] = (b * d1 - d0) / (f->sine * f->sine);
        along[1] = (d1 - b * d0) / (f->sine * f->sine);
        for (int s = 0; s < 2; s++) {
            least = along[s] < least ? along[s] : least;
            least = f->edge[s] - along[s] < least ? f->edge[s] - along[s] : least;
        }
        return least;
    }
    for (int k = 0; k < 3; k++) {
        long double e[3], in[3], far;

        minus(e, f->corner[(k + 1) % 3], f->corner[k]);
        unit(e);
        cross(in, f->n, e);
        minus(d, f->p, f->corner[k]);
        far = dot(in, d);
        least = far < least ? far : least;
    }
    return least;
}

/* n in the axes of a body. */
static void into_body(const struct meeting_features *f, int side, const long double n[3],
                      long double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = f->r[side][0][k] * n[0] + f->r[side][1][k] * n[1] + f->r[side][2][k] * n[2];
    }
}

/* The smallest rise along n, a cosine, of the sides of faces that leave a vertex. */
static long double vertex_rise(const struct meeting *m, int side, uint32_t v,
                               const long double n[3])
{
    const struct shape *shape = &m->shape[side];
    long double least = 1, here[3], there[3];

    local_vertex(m, side, v, here);
    for (uint32_t f = 0; f < shape->raw.face_count; f++) {
        const uint16_t *corner = shape->faces[f];

        for (int k = 0; k < 9; k++) {
            if (corner[k / 3] == v && k / 3 != k % 3) {
                long double rise;

                local_vertex(m, side, corner[k % 3], there);
                minus(there, there, here);
                rise = dot(there, n) / length_of(there);
                least = rise < least ? rise : least;
            }
        }
    }
    return least;
}

/* The largest component, a cosine, of n (perpendicular to an edge) into one of the edge's faces. */
static long double into_faces(const struct meeting *m, int side, uint32_t number,
                              const long double n[3])
{
    const struct shape *shape = &m->shape[side];
    const uint16_t *ends = shape->mesh.edges[number].vertex;
    long double most = -1, from[3], e[3], in[3], into;

    local_vertex(m, side, ends[0], from);
    local_vertex(m, side, ends[1], e);
    minus(e, e, from);
    unit(e);
    for (uint32_t f = 0; f < shape->raw.face_count; f++) {
        const uint16_t *corner = shape->faces[f];

        for (int k = 0; k < 3; k++) {
            uint16_t p = corner[(k + 1) % 3], q = corner[(k + 2) % 3];

            if (!((p == ends[0] && q == ends[1]) || (p == ends[1] && q == ends[0]))) {
                continue;
            }
            local_vertex(m, side, corner[k], in);
            minus(in, in, from);
            into = dot(in, e);
            for (int i = 0; i < 3; i++) {
                in[i] -= into * e[i];
            }
            into = dot(in, n) / length_of(in);
            most = into > most ? into : most;
        }
    }
    return most;
}

long double meeting_in_cones(const struct meeting *m, const struct meeting_features *f, int sign)
{
    const struct candidate *c = &m->candidate;
    const uint32_t number[2] = {c->i, c->j};
    long double least = 1, n[3], along[3], room;

    if (c->kind != CANDIDATE_EDGE_EDGE) {
        into_body(f, vertex_side(c), f->n, n);
        return vertex_rise(m, vertex_side(c), c->i, n);
    }
    for (int s = 0; s < 2; s++) {
        /* N leaves b, and its opposite leaves a */
        for (int k = 0; k < 3; k++) {
            along[k] = (s == 0 ? -sign : sign) * f->n[k];
        }
        into_body(f, s, along, n);
        room = -into_faces(m, s, number[s], n);
        least = room < least ? room : least;
    }
    return least;
}

/* ----------------------------------------------------------------- invention */

void meeting_shapes(struct meeting *m, unsigned which, const struct meeting_plan *plan)
{
    shape_box(&m->shape[0], 12, 4096, 2458, 1228);
    if (which % 3 == 1) {
        shape_l(&m->shape[0], 12, 1700);
    } else if (which % 3 == 2) {
        shape_tetrahedron(&m->shape[0], 12, 1900);
    }
    if (!plan->both && which % 2 == 0) { /* a stationary body may be a field */
        shape_field(&m->shape[1], 10, 4, 700, 500, which);
    } else if (which % 4 == 1) {
        shape_l(&m->shape[1], 12, 1900);
    } else {
        shape_box(&m->shape[1], 12, 2150, 5003, 1501);
    }
    shape_body(&m->shape[0], true, &m->body[0], &m->state[0]);
    shape_body(&m->shape[1], plan->both, &m->body[1], &m->state[1]);
}

/* A number from 2^low to 2^high, log-uniform. */
static double random_size(struct test_random *r, int low, int high)
{
    return (1 + real(test_random_range(r, 0, 1023), 10)) *
           real_power2((int)test_random_range(r, low, high - 1));
}

/* A vector of that length in any direction. */
static void random_vector(struct test_random *r, double length, carom_v3_q40 *out)
{
    double v[3], sum = 2;

    while (sum > 1 || sum < 0.01) {
        for (int k = 0; k < 3; k++) {
            v[k] = real(test_random_range(r, -(1 << 20), 1 << 20), 20);
        }
        sum = real_dot(v, v);
    }
    for (int k = 0; k < 3; k++) {
        out->c[k] = real_round(v[k] / real_sqrt(sum) * length * real_power2(40));
    }
}

static void set_paths(struct meeting *m, const carom_v3_q40 *gravity)
{
    body_predict(&m->body[0], &m->state[0], CAROM_ONE_Q30, gravity);
    body_predict(&m->body[1], &m->state[1], CAROM_ONE_Q30, gravity);
    boyse_pair_init(&m->pair, &m->body[0], &m->body[1]);
}

/*
 * Any rotation and any motion of both: from 1/512 unit a slice to 4 units, from 1/512 radian to
 * 1/2. A fast body gets gravity that bends its path.
 */
static void random_motion(struct meeting *m, struct test_random *r, const struct meeting_plan *plan,
                          carom_v3_q40 *gravity)
{
    double speed = random_size(r, -9, 2);

    random_vector(r, plan->translate ? speed * real(test_random_range(r, 0, 512), 10) : 0, gravity);
    for (int s = 0; s < 2; s++) {
        carom_v3_q40 v = {{0, 0, 0}}, w = {{0, 0, 0}};

        m->state[s].rotation = shape_random_turn(r);
        body_normalise(&m->state[s].rotation);
        if (plan->translate) {
            random_vector(r, s == 0 ? speed : random_size(r, -9, 2), &v);
        }
        if (plan->turn) {
            random_vector(r, random_size(r, -9, -1), &w);
        }
        if (m->body[s].def.moving) {
            body_set_motion(&m->body[s], &m->state[s], &v, &w);
        }
    }
}

static void random_features(struct test_random *r, struct meeting *m)
{
    struct candidate *c = &m->candidate;
    const struct shape *v = &m->shape[vertex_side(c)], *f = &m->shape[1 - vertex_side(c)];

    if (c->kind == CANDIDATE_EDGE_EDGE) {
        do {
            c->i = (uint32_t)test_random_range(r, 0, m->shape[0].mesh.edge_count - 1);
        } while (!shape_owns_edge(&m->shape[0], c->i));
        do {
            c->j = (uint32_t)test_random_range(r, 0, m->shape[1].mesh.edge_count - 1);
        } while (!shape_owns_edge(&m->shape[1], c->j));
    } else {
        do {
            c->i = (uint32_t)test_random_range(r, 0, v->raw.vertex_count - 1);
        } while (!shape_owns_vertex(v, c->i));
        c->j = (uint32_t)test_random_range(r, 0, f->raw.face_count - 1);
    }
}

/* Whether the features look at each other when they come near, from either side. */
static bool face_each_other(const struct meeting *m, const struct meeting_features *f)
{
    return f->sine > 1.0L / 64 &&
           (meeting_in_cones(m, f, 1) > 0.01L ||
            (m->candidate.kind == CANDIDATE_EDGE_EDGE && meeting_in_cones(m, f, -1) > 0.01L));
}

/* Move a so that a point well inside one feature lies on a point well inside the other. */
static void bring_together(struct meeting *m, struct test_random *r,
                           const struct meeting_features *f)
{
    long double s = (long double)real(test_random_range(r, 50, 950), 10), d[3];
    long double q = (long double)real(test_random_range(r, 50, 950), 10);

    if (m->candidate.kind != CANDIDATE_EDGE_EDGE && s + q > 0.95L) {
        s /= 2; /* at most 0.93 together in that case */
        q /= 2;
    }
    for (int k = 0; k < 3; k++) {
        if (m->candidate.kind == CANDIDATE_EDGE_EDGE) {
            d[k] = f->from[1][k] + q * f->edge[1] * f->e[1][k] - f->from[0][k] -
                   s * f->edge[0] * f->e[0][k];
        } else {
            d[k] = f->corner[0][k] + s * (f->corner[1][k] - f->corner[0][k]) +
                   q * (f->corner[2][k] - f->corner[0][k]) - f->p[k];
            d[k] = m->candidate.kind == CANDIDATE_VERTEX_FACE ? d[k] : -d[k];
        }
        m->state[0].position.c[k] += real_round((double)d[k] * real_power2(32));
    }
}

static long double path_length(const struct meeting *m)
{
    long double length = 0;

    for (int s = 0; s < 2; s++) {
        const struct body_path *path = &m->body[s].path;
        long double v[3], g[3], u[3];

        for (int k = 0; k < 3; k++) {
            v[k] = fixed(path->v.c[k], 40);
            g[k] = fixed(path->g.c[k], 40);
            u[k] = fixed(path->u.c[k], 30);
        }
        length +=
            length_of(v) + length_of(g) + 2 * length_of(u) * fixed(m->body[s].def.radius_q22, 22);
    }
    return length;
}

/* A motion with features that face each other, and their meeting. False: try again. */
static bool try_meeting(struct meeting *m, struct test_random *r, const struct meeting_plan *plan)
{
    struct meeting_features f;
    carom_v3_q40 gravity, place;
    bool found = false;
    long double slope;

    random_motion(m, r, plan, &gravity);
    random_vector(r, (double)test_random_range(r, 0, 2000), &place);
    for (int k = 0; k < 3; k++) {
        m->state[0].position.c[k] = m->state[1].position.c[k] = place.c[k] >> 8;
    }
    set_paths(m, &gravity);
    m->time = (long double)real(test_random_range(r, 10, 1000), 10);
    for (int n = 0; n < 40 && !found; n++) {
        random_features(r, m);
        meeting_at(m, m->time, &f);
        found = face_each_other(m, &f);
    }
    if (!found) {
        return false;
    }
    bring_together(m, r, &f);
    set_paths(m, &gravity);
    m->length = path_length(m);
    /* they approach, with the normal in the right cones */
    slope = meeting_slope(m, m->time);
    return (plan->kind == CANDIDATE_EDGE_EDGE || slope < 0) &&
           meeting_in_cones(m, &f, slope < 0 ? 1 : -1) > 0.01L;
}

void meeting_make(struct meeting *m, struct test_random *r, const struct meeting_plan *plan)
{
    memset(&m->candidate, 0, sizeof m->candidate);
    m->candidate.kind = (uint8_t)plan->kind;
    while (!try_meeting(m, r, plan)) {
    }
}
