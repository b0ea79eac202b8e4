/* SPDX-License-Identifier: MIT */
/*
 * First hits against the true motion in double precision: the distance of two features is sampled
 * over the slice and every change of its sign is closed in on.
 */
#include "boyse.h"
#include "real.h"
#include "shapes.h"
#include "test.h"

#ifdef TEST_LONG
#define CASES   4000 /* of each kind */
#define SAMPLES 256
#else
#define CASES   6
#define SAMPLES 24
#endif

#define UNIT (1.0 / 4194304) /* a unit of the last place of q22 */

static struct shape shape_a, shape_b;
static struct body bodies[2];
static struct body_state states[2];
static struct boyse_pair pair;

/* ---------------------------------------------------- the motion, in double */

/* A body's path: where a point of it is at t. */
struct motion {
    double x[3], v[3], g[3], q[4], u[3];
};

static struct motion motion[2];
static struct shape *const shapes[2] = {&shape_a, &shape_b};

static void read_motion(int side)
{
    const struct body_path *path = &bodies[side].path;
    struct motion *m = &motion[side];

    for (int k = 0; k < 3; k++) {
        m->x[k] = real(states[side].position.c[k], 32);
        m->v[k] = real(path->v.c[k], 40);
        m->g[k] = real(path->g.c[k], 40);
        m->u[k] = real(path->u.c[k], 30);
    }
    for (int k = 0; k < 4; k++) {
        m->q[k] = real(states[side].rotation.c[k], 30);
    }
}

/* A body at one time: centre and axes. */
struct pose {
    double x[3], r[3][3];
};

static void pose_at(struct pose *p, int side, double t)
{
    const struct motion *m = &motion[side];
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
    const struct carom_mesh *mesh = &shapes[side]->mesh;

    for (int k = 0; k < 3; k++) {
        out[k] = real(shapes[side]->vertices[v][k], mesh->raw.quantum_bits) -
                 real(mesh->mass.centre.c[k], 22);
    }
}

static void vertex_world(double out[3], int side, struct pose *p, uint32_t v)
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

/* The two features at a time. */
struct features {
    struct pose pose[2];
    double gap;           /* signed distance; edges: of the lines, along w */
    double n[3];          /* what the gap is measured along */
    double p[3], c[3][3]; /* vertex and face */
    double e[2][3], from[2][3], length[2], sine;
};

static int vertex_side(int kind)
{
    return kind == CANDIDATE_VERTEX_FACE ? 0 : 1;
}

static void features_at(struct features *f, const struct candidate *c, double t)
{
    double d[3];

    pose_at(&f->pose[0], 0, t);
    pose_at(&f->pose[1], 1, t);
    if (c->kind == CANDIDATE_EDGE_EDGE) {
        uint32_t edge[2] = {c->i, c->j};

        for (int s = 0; s < 2; s++) {
            const struct carom_edge *mesh_edge = &shapes[s]->mesh.edges[edge[s]];
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
        int v = vertex_side(c->kind);
        double e[3], g[3];

        vertex_world(f->p, v, &f->pose[v], c->i);
        for (int k = 0; k < 3; k++) {
            vertex_world(f->c[k], 1 - v, &f->pose[1 - v], shapes[1 - v]->faces[c->j][k]);
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

static double gap_at(const struct candidate *c, double t)
{
    struct features f;

    features_at(&f, c, t);
    return f.gap;
}

/* ----------------------------------------------------------------- validity */

/* How far inside the face the vertex is; how far inside their edges the nearest points are. */
static double inside(const struct features *f, const struct candidate *c)
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

/* The least rise along n, a cosine, of the edges that leave a vertex. */
static double vertex_rise(int side, const struct pose *p, uint32_t v, const double n[3])
{
    double least = 1, local[3], rotated[3], d[3];

    vertex_local(local, side, v);
    for (uint32_t f = 0; f < shapes[side]->raw.face_count; f++) {
        const uint16_t *c = shapes[side]->faces[f];

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

/* The most that n points into a face of an edge, a cosine. */
static double into_faces(int side, struct pose *p, uint32_t number, const double n[3])
{
    const struct carom_edge *edge = &shapes[side]->mesh.edges[number];
    double most = -1, from[3], to[3], e[3];

    vertex_world(from, side, p, edge->vertex[0]);
    vertex_world(to, side, p, edge->vertex[1]);
    minus(e, to, from);
    unit(e);
    for (int s = 0; s < 2; s++) {
        for (int k = 0; k < 3 && edge->face[s] != CAROM_NO_FACE; k++) {
            uint16_t v = shapes[side]->faces[edge->face[s]][k];
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

/*
 * How far within the cone tolerance the normal is, `sign` times n being N from b into a (edges) or
 * the face's (vertex and face).
 */
static double in_cones(struct features *f, const struct candidate *c, int sign)
{
    double tolerance = real(INTERFERE_CONE_Q30, 30), n[3], back[3], x[2];

    if (c->kind != CANDIDATE_EDGE_EDGE) {
        int v = vertex_side(c->kind);

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

/* The first root at which the features meet while approaching, by sampling. */
struct answer {
    bool found;
    bool doubtful; /* too close to call at some root on the way */
    double t;      /* of the root */
    double from;   /* of the root before */
    double open;   /* the largest gap in between */
    double slope;  /* of the gap at the root, downwards */
    int sign;
};

static double find_root(const struct candidate *c, double low, double high, bool positive_low)
{
    for (int k = 0; k < 40; k++) {
        double t = (low + high) / 2;

        if ((gap_at(c, t) > 0) == positive_low) {
            low = t;
        } else {
            high = t;
        }
    }
    return low;
}

static void try_root(struct answer *a, const struct candidate *c, double t, bool falls)
{
    struct features f;
    double place, cones, slope, loose;
    int sign = falls ? 1 : -1;

    features_at(&f, c, t);
    slope = real_abs(gap_at(c, t + 1e-5) - gap_at(c, t - 1e-5)) / 2e-5;
    if (c->kind != CANDIDATE_EDGE_EDGE && !falls) {
        a->from = t;
        a->open = 0;
        return; /* out through the back */
    }
    place = inside(&f, c);
    cones = in_cones(&f, c, sign);
    /* the root that is tested may be one of a surface three units nearer: when, and how turned? */
    loose = 2e-5 + 6 * UNIT / (f.sine * f.sine * slope + 1e-9);
    if (place > loose && cones > loose && f.sine * slope > 1e-3 && f.sine > 0.03) {
        a->found = true;
        a->t = t;
        a->slope = slope;
        a->sign = c->kind == CANDIDATE_EDGE_EDGE ? sign : 1;
        return;
    }
    a->doubtful = a->doubtful || !(place < -loose || cones < -loose);
    a->from = t;
    a->open = 0;
}

static struct answer answer_for(const struct candidate *c)
{
    struct answer a = {false, false, 0, 0, 0, 0, 1};
    double last = gap_at(c, 0);

    a.open = real_abs(last);
    for (int k = 1; k <= SAMPLES && !a.found && !a.doubtful; k++) {
        double t = (double)k / SAMPLES, gap = gap_at(c, t);

        if ((gap > 0) != (last > 0)) {
            try_root(&a, c, find_root(c, t - 1.0 / SAMPLES, t, last > 0), last > 0);
        }
        a.open = real_abs(gap) > a.open && !a.found ? real_abs(gap) : a.open;
        last = gap;
    }
    return a;
}

/* -------------------------------------------------------------------- cases */

static void random_vector(struct test_random *r, double size, double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = size * real(test_random_range(r, -(1 << 20), 1 << 20), 20);
    }
}

/* Set a's motion, in units or radians a frame, and both paths. */
static void set_paths(const double v[3], const double w[3], const carom_v3_q40 *gravity)
{
    carom_v3_q40 v_q40, w_q40;

    for (int k = 0; k < 3; k++) {
        v_q40.c[k] = real_round(v[k] * real_power2(40));
        w_q40.c[k] = real_round(w[k] * real_power2(40));
    }
    body_set_motion(&bodies[0], &states[0], &v_q40, &w_q40);
    body_predict(&bodies[0], &states[0], CAROM_ONE_Q30, gravity);
    body_predict(&bodies[1], &states[1], CAROM_ONE_Q30, gravity);
    boyse_pair_init(&pair, &bodies[0], &bodies[1]);
    read_motion(0);
    read_motion(1);
}

static void make(int which)
{
    if (which % 2) {
        shape_l(&shape_a, 12, 1700);
    } else {
        shape_box(&shape_a, 12, 4096, 2458, 1228);
    }
    switch (which / 2 % 3) {
    case 0:
        shape_l(&shape_b, 12, 1900);
        break;
    case 1:
        shape_plane(&shape_b, 9, 2, 8192);
        break;
    default:
        shape_field(&shape_b, 10, 4, 700, 500, 3);
    }
    shape_body(&shape_a, true, &bodies[0], &states[0]);
    shape_body(&shape_b, false, &bodies[1], &states[1]);
}

/* Any turn of both bodies, any motion, far out in the world. */
static void random_motion(struct test_random *r)
{
    carom_v3_q40 gravity;
    double v[3], w[3], g[3], x[3];

    for (int s = 0; s < 2; s++) {
        states[s].rotation = shape_random_turn(r);
        body_normalise(&states[s].rotation);
    }
    random_vector(r, 2000, x);
    random_vector(r, 0.3, v);
    random_vector(r, 0.25, w);
    random_vector(r, 0.01, g);
    for (int k = 0; k < 3; k++) {
        states[0].position.c[k] = states[1].position.c[k] = real_round(x[k] * real_power2(32));
        gravity.c[k] = real_round(g[k] * real_power2(40));
    }
    set_paths(v, w, &gravity);
}

/* One of the convex edges: no others are candidates. */
static uint32_t random_edge(struct test_random *r, const struct shape *s)
{
    uint32_t edge;

    do {
        edge = (uint32_t)test_random_range(r, 0, s->mesh.edge_count - 1);
    } while (!shape_owns_edge(s, edge));
    return edge;
}

static void random_features(struct test_random *r, struct candidate *c)
{
    int side = vertex_side(c->kind);

    if (c->kind == CANDIDATE_EDGE_EDGE) {
        c->i = random_edge(r, &shape_a);
        c->j = random_edge(r, &shape_b);
    } else {
        c->i = (uint32_t)test_random_range(r, 0, shapes[side]->raw.vertex_count - 1);
        c->j = (uint32_t)test_random_range(r, 0, shapes[1 - side]->raw.face_count - 1);
    }
}

/* Two features that meet at some time; of most cases such that can be touching. */
static void random_case(struct test_random *r, struct candidate *c, int kind)
{
    double d[3], t = real(test_random_range(r, 10, 1000), 10);
    double s = real(test_random_range(r, 1, 511), 10), q = real(test_random_range(r, 1, 511), 10);
    struct features f;
    bool facing = false;

    memset(c, 0, sizeof *c);
    c->kind = (uint8_t)kind;
    for (int n = 0; n < 40 && !facing; n++) {
        random_motion(r);
        random_features(r, c);
        features_at(&f, c, t);
        facing = in_cones(&f, c, 1) > 0 || in_cones(&f, c, -1) > 0;
    }
    for (int k = 0; k < 3; k++) {
        if (kind == CANDIDATE_EDGE_EDGE) {
            d[k] = f.from[1][k] + 2 * q * f.length[1] * f.e[1][k] - f.from[0][k] -
                   2 * s * f.length[0] * f.e[0][k];
        } else {
            d[k] = f.c[0][k] + s * (f.c[1][k] - f.c[0][k]) + q * (f.c[2][k] - f.c[0][k]) - f.p[k];
            d[k] = kind == CANDIDATE_VERTEX_FACE ? d[k] : -d[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        states[0].position.c[k] += real_round(d[k] * real_power2(32));
        bodies[0].path.origin_q22[k] = carom_round(states[0].position.c[k], 10);
        bodies[0].path.start.x.c[k] =
            states[0].position.c[k] - carom_shl(bodies[0].path.origin_q22[k], 10);
    }
    bodies[0].path.now = bodies[0].path.start;
    boyse_pair_init(&pair, &bodies[0], &bodies[1]);
    read_motion(0);
}

/*
 * The places and the normal, from b into a, at the root. The root that is found is one of a surface
 * up to three units nearer.
 */
static void check_touch(const struct boyse_touch *touch, const struct candidate *c,
                        const struct answer *a)
{
    double early, place;
    struct features f;

    features_at(&f, c, a->t);
    early = 6 * UNIT / (f.sine * a->slope);
    place = 3 * UNIT + early; /* no point is faster than a unit a frame */
    for (int k = 0; k < 3; k++) {
        double n = (c->kind == CANDIDATE_FACE_VERTEX ? -1 : a->sign) * f.n[k];
        double origin = real(bodies[0].path.origin_q22[k], 22);
        double on_a = real(touch->on_a.c[k], 22), on_b = real(touch->on_b.c[k], 22);

        CHECK(real_abs(real(touch->normal.c[k], 30) - n) < 1e-8 + early / f.sine);
        if (c->kind != CANDIDATE_EDGE_EDGE) {
            CHECK(real_abs(on_a + origin - f.p[k]) < place);
        }
        CHECK(real_abs(on_a - on_b) < 6 * UNIT / f.sine);
    }
}

/* A returned hit against the true motion. Returns whether there was one that could be judged. */
static bool check_case(const struct candidate *c)
{
    double event = real(pair.skin_q22 / 2, 22), gap, t;
    struct answer a = answer_for(c);
    struct boyse_hit hit;
    struct features f;
    uint32_t roots = 0;
    bool is_hit = boyse_first(&pair, c, &hit, &roots);

    if (a.doubtful || real_abs(gap_at(c, 0)) < 4 * event) {
        return false;
    }
    if (!a.found) {
        if (is_hit) {
            /* only where the surfaces come within the few units that the search looks ahead by */
            double least = 1e9;

            for (int k = 0; k <= 4096; k++) {
                gap = real_abs(gap_at(c, (double)k / 4096));
                least = gap < least ? gap : least;
            }
            CHECK(least < 2e-5);
        }
        return false;
    }
    CHECK(is_hit && roots == 1);
    if (!is_hit) {
        return true;
    }
    t = real(hit.t_q30, 30);
    features_at(&f, c, t);
    gap = a.sign * f.gap;
    CHECK(hit.t_q30 >= 0 && t <= a.t);
    CHECK(gap >= 0); /* never past the surface */
    CHECK(hit.touch.valid && hit.touch.sign == a.sign);
    if (a.open > 1.1 * event) {
        /* the event gap within two units and the rounding of places, in w.d for edges */
        CHECK(real_abs(gap - event) <= 3 * UNIT / f.sine + 1e-8);
    } else {
        CHECK(gap <= event + 3 * UNIT / f.sine);
    }
    /* and stays below it until they meet */
    for (int k = 1; k < 8; k++) {
        CHECK(a.sign * gap_at(c, t + (a.t - t) * k / 8) < gap + UNIT);
    }
    check_touch(&hit.touch, c, &a);
    return true;
}

static void check_kind(int kind)
{
    struct test_random r = {(uint64_t)kind + 1};
    int hits = 0;

    for (int n = 0; n < CASES; n++) {
        struct candidate c;

        if (n % (CASES / 6) == 0) {
            make(n / (CASES / 6));
        }
        random_case(&r, &c, kind);
        hits += check_case(&c);
    }
    CHECK(20 * hits >= CASES);
}

static void test_vertex_face(void)
{
    check_kind(CANDIDATE_VERTEX_FACE);
}

static void test_face_vertex(void)
{
    check_kind(CANDIDATE_FACE_VERTEX);
}

static void test_edge_edge(void)
{
    check_kind(CANDIDATE_EDGE_EDGE);
}

/* --------------------------------------------------------------- polynomial */

/* P(t) = p(t) (1 + s^2 t^2), p being the distance, or w.d for edges, in double. */
static void test_polynomial(void)
{
    struct test_random r = {9};

    for (int n = 0; n < CASES; n++) {
        struct candidate c;
        int64_t a_q40[5];
        double s2;

        if (n % (CASES / 6) == 0) {
            make(n / (CASES / 6));
        }
        random_case(&r, &c, n % 3);
        boyse_polynomial(&pair, &c, a_q40);
        s2 = real_dot(motion[0].u, motion[0].u);
        for (int k = 0; k <= 4; k++) {
            double t = k == 4 ? 1 : real(test_random_range(&r, 0, 1024), 10), value = 0;
            struct features f;

            features_at(&f, &c, t);
            for (int i = 4; i >= 0; i--) {
                CHECK(carom_abs(a_q40[i]) < (int64_t)1 << 49);
                value = value * t + real(a_q40[i], 40);
            }
            /* places are rounded to a unit, directions to 2^-30 on lengths of up to 30 units */
            CHECK(real_abs(value - f.gap * f.sine * (1 + s2 * t * t)) < 3 * UNIT);
        }
    }
}

/* ------------------------------------------------------- the paper's kernels */

static const double still[3] = {0, 0, 0};

/* A box of 1 x 0.6 x 0.3 units at a height over a plane, or over a ridge along y. */
static void above(double x, double y, double z, bool ridge)
{
    static const double size[3] = {4096, 2400, 1200};
    double to[3] = {x, y, z};

    if (ridge) {
        shape_box(&shape_b, 10, 1024, 8192, 1024);
    } else {
        shape_plane(&shape_b, 9, 2, 8192);
    }
    shape_box(&shape_a, 12, (int)size[0], (int)size[1], (int)size[2]);
    shape_body(&shape_a, true, &bodies[0], &states[0]);
    shape_body(&shape_b, false, &bodies[1], &states[1]);
    if (ridge) {
        /* an eighth of a turn about y: one edge along y is on top, at 1/sqrt 2 */
        states[1].rotation = (carom_quat_q30){{992008094, 0, 410903207, 0}};
    }
    for (int k = 0; k < 3; k++) {
        states[0].position.c[k] = real_round(to[k] * real_power2(32));
    }
}

/* The candidate of a kind whose features meet first, and when they meet and the search stops. */
static bool first_of_all(int kind, struct boyse_hit *best)
{
    uint32_t ni = kind == CANDIDATE_EDGE_EDGE ? shape_a.mesh.edge_count
                                              : shapes[vertex_side(kind)]->raw.vertex_count;
    uint32_t nj = kind == CANDIDATE_EDGE_EDGE ? shape_b.mesh.edge_count
                                              : shapes[1 - vertex_side(kind)]->raw.face_count;
    bool any = false;
    uint32_t roots = 0;

    memset(best, 0, sizeof *best);
    for (uint32_t n = 0; n < ni * nj; n++) {
        struct candidate c = {0, (uint8_t)kind, n / nj, n % nj};
        struct boyse_hit hit;

        if (kind == CANDIDATE_EDGE_EDGE &&
            !(shape_owns_edge(&shape_a, c.i) && shape_owns_edge(&shape_b, c.j))) {
            continue;
        }
        if (boyse_first(&pair, &c, &hit, &roots) && (!any || hit.t_q30 < best->t_q30)) {
            *best = hit;
            best->candidate = c;
            any = true;
        }
    }
    return any;
}

/* Within two units of length at that speed. */
static void check_time(const struct boyse_hit *hit, double t, double speed)
{
    CHECK(real_abs(real(hit->t_q30, 30) - t) <= 3 * UNIT / speed + 1e-8);
}

static uint32_t edge_between(const struct shape *s, uint16_t v, uint16_t w)
{
    uint32_t e = 0;

    while (e + 1 < s->mesh.edge_count &&
           !((s->mesh.edges[e].vertex[0] == v && s->mesh.edges[e].vertex[1] == w) ||
             (s->mesh.edges[e].vertex[0] == w && s->mesh.edges[e].vertex[1] == v))) {
        e++;
    }
    return e;
}

/* Figure 2a: a corner of the box falls on the plane, straight and on a parabola. */
static void test_translating_vertex(void)
{
    const carom_v3_q40 gravity = {{0, 0, -CAROM_RATIO(1, 2, 40)}};
    struct boyse_hit hit;
    double event;

    for (int flip = 0; flip < 2; flip++) {
        above(0.25, 0.3, 0.2, false);
        if (flip) {
            states[0].rotation = (carom_quat_q30){{0, CAROM_ONE_Q30, 0, 0}};
        }
        set_paths((double[3]){0.125, 0, -0.25}, still, NULL);
        event = real(pair.skin_q22 / 2, 22);
        CHECK(first_of_all(CANDIDATE_VERTEX_FACE, &hit));
        /* its lowest corners are at 0.2 - 600/4096 */
        check_time(&hit, (0.2 - 600. / 4096 - event) / 0.25, 0.25);
        CHECK_EQ(hit.touch.normal.c[2], CAROM_ONE_Q30);
        CHECK(!first_of_all(CANDIDATE_EDGE_EDGE, &hit));
        CHECK(!first_of_all(CANDIDATE_FACE_VERTEX, &hit));
    }
    above(0.25, 0.3, 0.2, false);
    set_paths(still, still, &gravity);
    CHECK(first_of_all(CANDIDATE_VERTEX_FACE, &hit));
    /* g t^2 / 2 is the way */
    event = 2 * real_sqrt(0.2 - 600. / 4096 - event);
    check_time(&hit, event, event / 2);
    set_paths((double[3]){0.5, 0.5, 0.25}, still, NULL);
    CHECK(!first_of_all(CANDIDATE_VERTEX_FACE, &hit)); /* rises */
    set_paths((double[3]){0, 0, -0.05}, still, NULL);
    CHECK(!first_of_all(CANDIDATE_VERTEX_FACE, &hit)); /* too slow to arrive */
}

/* The other role: the box comes down with its lower face on the upper corners of another box. */
static void test_translating_face(void)
{
    struct boyse_hit hit;

    above(0, 0, 1.25, true);
    shape_box(&shape_b, 12, 800, 800, 2048);
    shape_body(&shape_b, false, &bodies[1], &states[1]);
    set_paths((double[3]){0.01, -0.02, -1}, still, NULL);
    CHECK(first_of_all(CANDIDATE_FACE_VERTEX, &hit));
    check_time(&hit, 1.25 - 600. / 4096 - 0.25 - real(pair.skin_q22 / 2, 22), 1);
    CHECK_EQ(hit.touch.normal.c[2], CAROM_ONE_Q30); /* from b into a */
    CHECK(!first_of_all(CANDIDATE_VERTEX_FACE, &hit));
}

/* Figure 3a: an edge along x falls on a ridge along y. */
static void test_translating_edge(void)
{
    struct boyse_hit hit;
    double gap = 1 - real_sqrt(0.5) - 600. / 4096;

    above(0.1, -0.7, 1, true);
    set_paths((double[3]){0, 0.25, -0.5}, still, NULL);
    CHECK(first_of_all(CANDIDATE_EDGE_EDGE, &hit));
    check_time(&hit, (gap - real(pair.skin_q22 / 2, 22)) / 0.5, 0.5);
    CHECK_NEAR(hit.touch.normal.c[2], CAROM_ONE_Q30, 4);
    CHECK(!first_of_all(CANDIDATE_VERTEX_FACE, &hit));
    CHECK(!first_of_all(CANDIDATE_FACE_VERTEX, &hit));
}

/*
 * A point (x, z) on a circle about the centre of the box reaches the height -h at the angle of
 * which (z - h) tau^2 + 2 x tau - (z + h) = 0, tau = tan(angle / 2); the box turns by Cayley(t u),
 * so that tau = t |u|.
 */
static double circle_time(double x, double z, double h, double u)
{
    double root = real_sqrt(x * x + z * z - h * h);
    double tau[2] = {(-x - root) / (z - h), (-x + root) / (z - h)};

    for (int k = 0; k < 2; k++) {
        if (tau[k] <= 0) {
            tau[k] = 1e9;
        }
    }
    return (tau[0] < tau[1] ? tau[0] : tau[1]) / u;
}

/* Figure 2b: the box turns about y until a corner meets the plane. */
static void test_turning_vertex(void)
{
    double x = 0.5, z = -600. / 4096, h, t, u;
    struct boyse_hit hit;

    above(0.3, 0.2, 0.25, false);
    set_paths(still, (double[3]){0, 0.48, 0}, NULL);
    u = real_length(motion[0].u);
    CHECK(real_abs(u - 0.24) < 1e-6);
    h = 0.25 - real(pair.skin_q22 / 2, 22);
    CHECK(first_of_all(CANDIDATE_VERTEX_FACE, &hit));
    /* turning about +y takes +x down */
    t = circle_time(x, z, h, u);
    CHECK(t > 0 && t < 1);
    check_time(&hit, t, 0.2);
}

/* The other role: the box turns about y until its lower face meets the tip of a tetrahedron. */
static void test_turning_face(void)
{
    /* from the diagonal of a cube to the vertical: cos = 1/sqrt 3 about (1, -1, 0) */
    double cosine = real_sqrt((1 + real_sqrt(1. / 3)) / 2);
    double sine = real_sqrt((1 - real_sqrt(1. / 3)) / 4), x = 0.375, z = -0.2, t;
    struct boyse_hit hit;

    above(0, 0, 0, false);
    shape_tetrahedron(&shape_b, 12, 1024);
    shape_body(&shape_b, false, &bodies[1], &states[1]);
    states[1].rotation.c[0] = (int32_t)real_round(cosine * CAROM_ONE_Q30);
    states[1].rotation.c[1] = (int32_t)real_round(sine * CAROM_ONE_Q30);
    states[1].rotation.c[2] = -states[1].rotation.c[1];
    /* the tip is sqrt 3 / 4 over the centre */
    states[1].position.c[0] = real_round(x * real_power2(32));
    states[1].position.c[2] = real_round((z - real_sqrt(3) / 4) * real_power2(32));
    set_paths(still, (double[3]){0, 0.48, 0}, NULL);
    CHECK(first_of_all(CANDIDATE_FACE_VERTEX, &hit));
    /* seen from the box the tip turns back, up to the face at -600/4096 */
    t = circle_time(-x, z, 600. / 4096 + real(pair.skin_q22 / 2, 22), real_length(motion[0].u));
    CHECK(t > 0 && t < 1);
    check_time(&hit, t, 0.15);
    CHECK(hit.touch.normal.c[2] > 0 && hit.touch.normal.c[0] > 0);
}

/* Figure 3b: the box turns about z until an upright edge of it meets a ridge along x. */
static void test_turning_edge(void)
{
    double x = 0.5, y = -1200. / 4096, wall = 0.4, t;
    struct boyse_hit hit;

    above(0, 0, 0, false);
    shape_box(&shape_b, 12, 8192, 2048, 2048);
    shape_body(&shape_b, false, &bodies[1], &states[1]);
    /* an eighth of a turn about x: an edge looks along y, at sqrt 2 / 4 from the centre */
    states[1].rotation = (carom_quat_q30){{992008094, 410903207, 0, 0}};
    states[1].position.c[1] = -real_round((wall + real_sqrt(0.125)) * real_power2(32));
    set_paths(still, (double[3]){0, 0, -0.48}, NULL);
    CHECK(first_of_all(CANDIDATE_EDGE_EDGE, &hit));
    /* y' = y cos - x sin, as above with y for z */
    t = circle_time(x, y, wall - real(pair.skin_q22 / 2, 22), real_length(motion[0].u));
    CHECK(t > 0 && t < 1);
    check_time(&hit, t, 0.2);
    CHECK_NEAR(hit.touch.normal.c[1], CAROM_ONE_Q30, 1 << 10);
    CHECK(!first_of_all(CANDIDATE_VERTEX_FACE, &hit));
}

/*
 * Two ridges so flat that the normal and its opposite are both within the tolerance of the cones:
 * the side that the faces look to is the one that counts, whichever way the edges run.
 */
static void test_flat_ridges(void)
{
    for (int flip = 0; flip < 2; flip++) {
        struct candidate c = {0, CANDIDATE_EDGE_EDGE, 0, 0};
        struct boyse_touch touch;
        struct boyse_hit hit;
        uint32_t roots = 0;

        above(0, 0, 0.25, false);
        /* the diagonal of the box's lower side and the middle of the field stand out */
        shape_a.vertices[0][2] = shape_a.vertices[3][2] = -604;
        CHECK_EQ(carom_mesh_build(&shape_a.mesh, &shape_a.raw, shape_a.block, sizeof shape_a.block),
                 CAROM_OK);
        shape_field(&shape_b, 9, 2, 2048, 0, 0);
        for (int y = 0; y < 3; y++) {
            shape_b.vertices[3 * y + 1][2] = 4;
        }
        CHECK_EQ(carom_mesh_build(&shape_b.mesh, &shape_b.raw, shape_b.block, sizeof shape_b.block),
                 CAROM_OK);
        states[0].rotation =
            (carom_quat_q30){{flip ? 0 : CAROM_ONE_Q30, 0, 0, flip ? CAROM_ONE_Q30 : 0}};
        set_paths((double[3]){0, 0, -0.125}, still, NULL);
        c.i = edge_between(&shape_a, 0, 3);
        c.j = edge_between(&shape_b, 1, 4);
        states[0].position.c[1] = -((int64_t)2 << 32); /* over the middle of that edge */
        set_paths((double[3]){0, 0, -0.125}, still, NULL);
        CHECK(shape_owns_edge(&shape_a, c.i) && shape_owns_edge(&shape_b, c.j));
        boyse_touch(&pair, &c, 0, &touch);
        CHECK(touch.valid && touch.normal.c[2] > CAROM_ONE_Q30 / 10 * 9);
        CHECK(touch.gap_q22 > 0);
        CHECK(boyse_first(&pair, &c, &hit, &roots));
    }
}

/* ----------------------------------------------------------------- the start */

/* A corner over the plane at `gap` units of q22 and moving at `speed`, a unit a frame at most. */
static bool start_at(int32_t gap, double speed, struct boyse_hit *hit)
{
    above(0.25, 0.3, 600. / 4096, false);
    states[0].position.c[2] += carom_shl(gap, 10);
    set_paths((double[3]){0, 0, speed}, still, NULL);
    return first_of_all(CANDIDATE_VERTEX_FACE, hit);
}

static void test_at_start(void)
{
    struct boyse_hit hit;
    int32_t skin;

    start_at(0, 0, &hit);
    skin = pair.skin_q22;
    CHECK_EQ(skin, bodies[0].radius_q22 >> 11);
    /* clear of the event gap: it goes on to that */
    CHECK(start_at(skin, -0.125, &hit));
    check_time(&hit, real(skin - skin / 2, 22) / 0.125, 0.125);
    /* closer than that: to half of what there is */
    CHECK(start_at(skin / 4, -0.125, &hit));
    CHECK(hit.t_q30 > 0 && real(hit.t_q30, 30) * 0.125 <= real(skin / 4, 22));
    /* touching or overlapping: at once while it approaches, never while it leaves */
    CHECK(start_at(0, -0.125, &hit) && hit.t_q30 == 0 && hit.touch.gap_q22 == 0);
    CHECK(start_at(-skin / 4, -0.125, &hit) && hit.t_q30 == 0 && hit.touch.gap_q22 == -skin / 4);
    CHECK(!start_at(0, 0.125, &hit));
    CHECK(!start_at(-skin / 4, 0.125, &hit));
    CHECK(!start_at(skin / 4, 0.125, &hit));
    /* far below: on its way out through the back */
    CHECK(!start_at(-4 * skin, -0.125, &hit));
    /* resting: no motion, no hit */
    CHECK(!start_at(skin, 0, &hit));
}

const struct test tests_boyse[] = {
    {"boyse/vertex_face", test_vertex_face},
    {"boyse/face_vertex", test_face_vertex},
    {"boyse/edge_edge", test_edge_edge},
    {"boyse/polynomial", test_polynomial},
    {"boyse/translating_vertex", test_translating_vertex},
    {"boyse/translating_face", test_translating_face},
    {"boyse/translating_edge", test_translating_edge},
    {"boyse/turning_vertex", test_turning_vertex},
    {"boyse/turning_face", test_turning_face},
    {"boyse/turning_edge", test_turning_edge},
    {"boyse/flat_ridges", test_flat_ridges},
    {"boyse/at_start", test_at_start},
    {0},
};
