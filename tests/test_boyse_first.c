/* SPDX-License-Identifier: MIT */
/*
 * First hits against the true motion in double precision. The test samples the distance of two
 * features over the slice and narrows down every change of its sign.
 */
#include "boyse/event.h"
#include "lib/duo.h"
#include "lib/real.h"
#include "lib/test.h"

#ifdef TEST_LONG
#define CASES   4000 /* cases of each kind */
#define SAMPLES 256
#else
#define CASES   8
#define SAMPLES 24
#endif

/* --------------------------------------------------------------- the true hit */

/* The first root at which the features meet while approaching, by sampling. */
struct answer {
    bool found;
    bool doubtful; /* some root on the way is too close to call */
    double t;      /* time of the root */
    int refused;   /* earlier roots that are no hits */
    double open;   /* the largest gap since the last of those roots */
    double slope;  /* speed at which the gap closes at the root */
    int sign;
};

static double find_root(const struct candidate *c, double low, double high, bool positive_low)
{
    for (int k = 0; k < 40; k++) {
        double t = (low + high) / 2;

        if ((duo_gap_at(c, t) > 0) == positive_low) {
            low = t;
        } else {
            high = t;
        }
    }
    return low;
}

static void try_root(struct answer *a, const struct candidate *c, double t, bool falls)
{
    struct duo_features f;
    double place, cones, slope, loose;
    int sign = falls ? 1 : -1;

    duo_features_at(&f, c, t);
    slope = real_abs(duo_gap_at(c, t + 1e-5) - duo_gap_at(c, t - 1e-5)) / 2e-5;
    if (c->kind != CANDIDATE_EDGE_EDGE && !falls) {
        a->refused++;
        a->open = 0;
        return; /* out through the back */
    }
    place = duo_inside(&f, c);
    cones = duo_in_cones(&f, c, sign);
    /* the tested root may belong to a surface three units nearer: its time and rotation differ by
     * so much */
    loose = 2e-5 + 6 * DUO_UNIT / (f.sine * f.sine * slope + 1e-9);
    if (place > loose && cones > loose && f.sine * slope > 1e-3 && f.sine > 0.03) {
        a->found = true;
        a->t = t;
        a->slope = slope;
        a->sign = c->kind == CANDIDATE_EDGE_EDGE ? sign : 1;
        return;
    }
    a->doubtful = a->doubtful || !(place < -loose || cones < -loose);
    a->refused++;
    a->open = 0;
}

static struct answer answer_for(const struct candidate *c)
{
    struct answer a = {.sign = 1};
    double last = duo_gap_at(c, 0);

    a.open = real_abs(last);
    for (int k = 1; k <= SAMPLES && !a.found && !a.doubtful; k++) {
        double t = (double)k / SAMPLES, gap = duo_gap_at(c, t);

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

#define PAIRINGS 8

/* Choose two shapes; in the last two pairings both move. */
static void make(int which)
{
    if (which % 2) {
        shape_l(&duo.shape[0], 12, 1700);
    } else {
        shape_box(&duo.shape[0], 12, 4096, 2458, 1228);
    }
    switch (which / 2 % 3) {
    case 0:
        shape_l(&duo.shape[1], 12, 1900);
        break;
    case 1:
        shape_plane(&duo.shape[1], 9, 2, 8192);
        break;
    default:
        shape_field(&duo.shape[1], 10, 4, 700, 500, 3);
    }
    duo_begin(which % 6 / 2 == 0 && which >= 6); /* a field is stationary */
}

/* Any rotation of both bodies, any motion, far out in the world. */
static void random_motion(struct test_random *r)
{
    carom_v3_q40 gravity;
    double v[3], w[3], g[3], x[3];

    for (int s = 0; s < 2; s++) {
        duo.state[s].rotation = shape_random_turn(r);
        body_normalise(&duo.state[s].rotation);
    }
    random_vector(r, 2000, x);
    if (duo.body[1].def.moving) {
        random_vector(r, 0.3, v);
        random_vector(r, 0.25, w);
        duo_set_motion(1, v, w);
    }
    random_vector(r, 0.3, v);
    random_vector(r, 0.25, w);
    random_vector(r, 0.01, g);
    for (int k = 0; k < 3; k++) {
        duo.state[0].position.c[k] = duo.state[1].position.c[k] =
            real_round(x[k] * real_power2(32));
        gravity.c[k] = real_round(g[k] * real_power2(40));
    }
    duo_set_paths(v, w, &gravity);
}

/* One of the convex edges; other edges are no candidates. */
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
    int side = duo_vertex_side(c->kind);

    if (c->kind == CANDIDATE_EDGE_EDGE) {
        c->i = random_edge(r, &duo.shape[0]);
        c->j = random_edge(r, &duo.shape[1]);
    } else {
        c->i = (uint32_t)test_random_range(r, 0, duo.shape[side].raw.vertex_count - 1);
        c->j = (uint32_t)test_random_range(r, 0, duo.shape[1 - side].raw.face_count - 1);
    }
}

/*
 * Two features, or points a little beyond them, that meet at some time. In most cases they are able
 * to touch.
 */
static void random_case(struct test_random *r, struct candidate *c, int kind)
{
    double d[3], t = real(test_random_range(r, 10, 1000), 10);
    double s = real(test_random_range(r, -20, 550), 10);
    double q = real(test_random_range(r, -20, 550), 10);
    struct duo_features f;
    bool facing = false;

    memset(c, 0, sizeof *c);
    c->kind = (uint8_t)kind;
    for (int n = 0; n < 40 && !facing; n++) {
        random_motion(r);
        random_features(r, c);
        duo_features_at(&f, c, t);
        facing = duo_in_cones(&f, c, 1) > 0 || duo_in_cones(&f, c, -1) > 0;
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
        duo.state[0].position.c[k] += real_round(d[k] * real_power2(32));
        duo.body[0].path.origin_q22[k] = carom_round(duo.state[0].position.c[k], 10);
        duo.body[0].path.start_x_q32[k] =
            (int16_t)(duo.state[0].position.c[k] - carom_shl(duo.body[0].path.origin_q22[k], 10));
    }
    boyse_pair_init(&duo.pair, &duo.body[0], &duo.body[1]);
    duo_read_motion();
}

/* The normal at the root, from b into a. The root belongs to a surface up to three units nearer. */
static void check_touch(const struct boyse_touch *touch, const struct candidate *c,
                        const struct answer *a)
{
    double early;
    struct duo_features f;

    duo_features_at(&f, c, a->t);
    early = 6 * DUO_UNIT / (f.sine * a->slope);
    for (int k = 0; k < 3; k++) {
        double n = (c->kind == CANDIDATE_FACE_VERTEX ? -1 : a->sign) * f.n[k];

        CHECK_LESS(real_abs(real(touch->normal.c[k], 30) - n), 1e-8 + early / f.sine);
    }
}

/* Compare a returned hit with the true motion. Returns whether the case could be judged. */
static bool check_case(const struct candidate *c)
{
    double event = real(duo.pair.skin_q22 / 2, 22), gap, t;
    struct answer a = answer_for(c);
    struct boyse_hit hit;
    struct duo_features f;
    uint32_t roots = 0;
    bool is_hit = boyse_first(&duo.pair, c, &hit, &roots);

    if (a.doubtful || real_abs(duo_gap_at(c, 0)) < 4 * event) {
        return false;
    }
    if (!a.found) {
        if (is_hit) {
            /* there is none if the features do not meet, except for the few units that the search
             * looks ahead */
            double least = 1e9;

            for (int k = 0; k <= 4096; k++) {
                gap = real_abs(duo_gap_at(c, (double)k / 4096));
                least = gap < least ? gap : least;
            }
            CHECK_EQ(a.refused, 0);
            CHECK_LESS(least, 2e-5);
        }
        return false;
    }
    CHECK(is_hit);
    CHECK_EQ(roots, 1);
    if (!is_hit) {
        return true;
    }
    boyse_touch(&duo.pair, c, hit.root_q30, &hit.touch);
    t = real(hit.t_q30, 30);
    duo_features_at(&f, c, t);
    gap = a.sign * f.gap;
    CHECK_AT_LEAST(hit.t_q30, 0);
    CHECK_AT_MOST(t, a.t);
    CHECK_AT_LEAST(gap, 0); /* never beyond the surface */
    CHECK(hit.touch.valid);
    CHECK_EQ(hit.touch.sign, a.sign);
    if (a.open > 1.1 * event) {
        /*
         * the event gap within four units and the rounding of places, in w.d for edges; |w| is
         * taken at the root, and changes by half a radian a slice at most
         */
        CHECK_AT_MOST(real_abs(gap - event), 7 * DUO_UNIT / f.sine + (a.t - t) * event / 2 + 1e-8);
    } else {
        CHECK_AT_MOST(gap, event + 3 * DUO_UNIT / f.sine);
    }
    /* and the gap stays below it until they meet */
    for (int k = 1; k < 8; k++) {
        CHECK_LESS(a.sign * duo_gap_at(c, t + (a.t - t) * k / 8), gap + DUO_UNIT);
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

        if (n % (CASES / PAIRINGS) == 0) {
            make(n / (CASES / PAIRINGS));
        }
        random_case(&r, &c, kind);
        hits += check_case(&c);
    }
    CHECK_AT_LEAST(20 * hits, CASES);
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

/* P(t) = p(t) (1 + s_a^2 t^2) (1 + s_b^2 t^2), in double. p is the distance, or w.d for edges. */
static void test_polynomial(void)
{
    struct test_random r = {9};

    for (int n = 0; n < CASES; n++) {
        struct candidate c;
        int64_t a_q40[BOYSE_DEGREE + 1];
        double s2[2];
        int degree;

        if (n % (CASES / PAIRINGS) == 0) {
            make(n / (CASES / PAIRINGS));
        }
        random_case(&r, &c, n % 3);
        boyse_place_start(&duo.pair, &c);
        degree = boyse_polynomial(&duo.pair, &c, a_q40);
        CHECK_EQ(degree, duo.body[1].def.moving ? 6 : 4);
        for (int k = 0; k < 2; k++) {
            s2[k] = real_dot(duo.motion[k].u, duo.motion[k].u);
        }
        for (int k = 0; k <= 4; k++) {
            double t = k == 4 ? 1 : real(test_random_range(&r, 0, 1024), 10), value = 0;
            struct duo_features f;

            duo_features_at(&f, &c, t);
            for (int i = degree; i >= 0; i--) {
                CHECK_LESS(carom_abs(a_q40[i]), (int64_t)1 << 49);
                value = value * t + real(a_q40[i], 40);
            }
            /* places are rounded to a unit, directions to 2^-30 on lengths of up to 30 units */
            CHECK_LESS(real_abs(value - f.gap * f.sine * (1 + s2[0] * t * t) * (1 + s2[1] * t * t)),
                       4 * DUO_UNIT);
        }
    }
}

/* ---------------------------------------------------------------- divisions */

/*
 * A quotient is rounded down, by less than one part in 2^14 plus one. Steps made of such quotients
 * pass no root.
 */
static void test_quotient(void)
{
    struct test_random r = {3};

    for (int n = 0; n < 100 * CASES; n++) {
        uint32_t top = (uint32_t)(test_random_next(&r) >> 32) >> n % 32;
        uint32_t below = ((uint32_t)(test_random_next(&r) >> 32) >> n / 32 % 32) | 1;
        uint64_t exact = ((uint64_t)top << 30) / below;
        uint32_t found = curve_quotient_q30(top, below);

        if (found == UINT32_MAX) {
            CHECK_AT_LEAST(exact, (uint64_t)1 << 31);
        } else {
            CHECK_AT_MOST(found, exact);
            CHECK_AT_MOST(exact - found, (exact >> 14) + 1);
        }
    }
    CHECK_EQ(curve_quotient_q30(0, 5), 0);
    CHECK_EQ(curve_quotient_q30(5, 0), UINT32_MAX);
}

/* Horner's rule in 32 bits stays within the noise of P, with the largest coefficients. */
static void test_curve_at(void)
{
    struct test_random r = {4};

    for (int n = 0; n < CASES; n++) {
        int64_t a_q40[BOYSE_DEGREE + 1] = {0};
        int degree = 2 + 2 * (n % 3), bits = 6 + n % 45;
        struct curve curve;

        a_q40[0] = test_random_range(&r, -1, 1);
        for (int k = 1; k <= degree; k++) {
            a_q40[k] = test_random_range(&r, -((int64_t)1 << bits), (int64_t)1 << bits);
        }
        if (!curve_init(&curve, a_q40, degree)) {
            continue;
        }
        for (int k = 0; k <= 8; k++) {
            double t = k / 8.0, value = 0, unit = 1;

            for (int i = degree; i >= 0; i--) {
                value = value * t + (double)a_q40[i];
            }
            for (int i = 0; i < (curve.shift < 0 ? -curve.shift : curve.shift); i++) {
                unit *= curve.shift < 0 ? 0.5 : 2;
            }
            CHECK_AT_MOST(real_abs(curve_at(&curve, k << 27) - value / unit), CURVE_NOISE);
        }
    }
}

/* ------------------------------------------------------------------- bounds */

/* Where a vertex of one body is: from the other's place `to`, in the world's axes and in its own. */
static void seen_at(double axes[2][3], int from, uint32_t v, const double to[3], double t)
{
    const carom_v3_q22 local = mesh_vertex(&duo.shape[from].mesh, v);
    struct candidate any = {.kind = CANDIDATE_VERTEX_FACE};
    struct duo_features f;
    double p[3], other[3];

    duo_features_at(&f, &any, t);
    real_rotate(p, f.pose[from].r,
                (double[3]){real(local.c[0], 22), real(local.c[1], 22), real(local.c[2], 22)});
    real_rotate(other, f.pose[1 - from].r, to);
    for (int k = 0; k < 3; k++) {
        p[k] += f.pose[from].x[k] - f.pose[1 - from].x[k];
        axes[0][k] = p[k] - other[k];
    }
    real_rotate_back(axes[1], f.pose[1 - from].r, p);
}

/* The displacement of a vertex is within both bounds: in axes that do not turn, and as seen. */
static void check_bounds(const struct boyse_view *view, int from, uint32_t v, const double to[3],
                         double t)
{
    const double h = 1e-5, loose = 2e-9;
    double at[2][3], start[2][3], before[2][3], after[2][3];

    seen_at(start, from, v, to, 0);
    seen_at(before, from, v, to, -h);
    seen_at(after, from, v, to, h);
    seen_at(at, from, v, to, t);
    for (int axes = 0; axes < 2; axes++) {
        const struct boyse_bound *bound = axes == 0 ? &view->fixed : &view->seen;
        double way[3], bend[3];

        for (int k = 0; k < 3; k++) {
            way[k] = at[axes][k] - start[axes][k];
            bend[k] = way[k] - (after[axes][k] - before[axes][k]) / (2 * h) * t;
        }
        CHECK_AT_MOST(real_length(way), real(bound->way_q22, 22) + loose);
        CHECK_AT_MOST(real_length(bend), real(bound->bend_q22, 22) + loose);
    }
}

/*
 * Every vertex of either body, as the other sees it and from the other's farthest places. Some
 * motions are almost turns or almost falls alone.
 */
static void test_bounds(void)
{
    struct test_random r = {17};

    for (int n = 0; n < CASES / 4; n++) {
        double v[3], w[3];

        make(n % PAIRINGS);
        random_motion(&r);
        random_vector(&r, n / 8 % 2 ? 0.3 : 0, v);
        random_vector(&r, n / 16 % 2 ? 0.25 : 0, w);
        memset(duo.state[0].position.c, 0, sizeof duo.state[0].position.c);
        memset(duo.state[1].position.c, 0, sizeof duo.state[1].position.c);
        duo_set_paths(v, w, NULL);
        for (int view = 0; view < 2; view++) {
            const struct shape *of = &duo.shape[view], *other = &duo.shape[1 - view];

            for (uint32_t i = 0; i < of->raw.vertex_count; i++) {
                const carom_v3_q22 to = mesh_vertex(
                    &other->mesh, (uint32_t)test_random_range(&r, 0, other->raw.vertex_count - 1));

                check_bounds(&duo.pair.view[view], view, i,
                             (double[3]){real(to.c[0], 22), real(to.c[1], 22), real(to.c[2], 22)},
                             real(test_random_range(&r, 0, 2), 1));
            }
        }
    }
}

/*
 * A corner of a small cube that turns by a hundredth about an axis square to it, while the cube goes the same way by a few units of q22:
 * no point of the cube goes farther, so only rounding is between its way and the bound.
 */
static void test_tight_bounds(void)
{
    static const double corner[3] = {1. / 32, 1. / 32, 1. / 32}, none[3] = {0, 0, 0};
    struct test_random r = {18};

    make(3);
    shape_box(&duo.shape[0], 12, 256, 256, 256);
    duo_begin(false);
    for (int n = 0; n < 400; n++) {
        const double goes = real(test_random_range(&r, 1 << 9, 1 << 13), 32);
        const double turns = real(test_random_range(&r, 1 << 22, 3 << 21), 30);
        double axis[3] = {turns, -turns, 0}, way[3], length;

        memset(duo.state[0].position.c, 0, sizeof duo.state[0].position.c);
        memset(duo.state[1].position.c, 0, sizeof duo.state[1].position.c);
        real_cross(way, axis, corner);
        length = real_length(way);
        for (int k = 0; k < 3; k++) {
            way[k] *= goes / length;
        }
        duo_set_paths(way, axis, NULL);
        check_bounds(&duo.pair.view[0], 0, 7, none, 1);
    }
}

const struct test tests_boyse_first[] = {
    {"boyse_first/tight_bounds", test_tight_bounds},
    {"boyse_first/vertex_face", test_vertex_face},
    {"boyse_first/face_vertex", test_face_vertex},
    {"boyse_first/edge_edge", test_edge_edge},
    {"boyse_first/polynomial", test_polynomial},
    {"boyse_first/quotient", test_quotient},
    {"boyse_first/curve_at", test_curve_at},

    {"boyse_first/bounds", test_bounds},
    {0},
};
