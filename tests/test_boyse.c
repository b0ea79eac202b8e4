/* SPDX-License-Identifier: MIT */
/*
 * The paper's four kernels as special cases, with times worked out by hand, and the start of a
 * slice.
 */
#include "boyse/place.h"
#include "lib/duo.h"
#include "lib/real.h"
#include "lib/test.h"

/* ------------------------------------------------------- the paper's kernels */

static const double still[3] = {0, 0, 0};

/* A box of 1 x 0.6 x 0.3 units at a height over a plane, or over a ridge along y. */
static void above(double x, double y, double z, bool ridge)
{
    double to[3] = {x, y, z};

    if (ridge) {
        shape_box(&duo.shape[1], 10, 1024, 8192, 1024);
    } else {
        shape_plane(&duo.shape[1], 9, 2, 8192);
    }
    shape_box(&duo.shape[0], 12, 4096, 2400, 1200);
    duo_begin(false);
    if (ridge) {
        /* an eighth of a turn about y: one edge along y is on top, at 1/sqrt 2 */
        duo.state[1].rotation = (carom_quat_q30){{992008094, 0, 410903207, 0}};
    }
    for (int k = 0; k < 3; k++) {
        duo.state[0].position.c[k] = real_round(to[k] * real_power2(32));
    }
}

/*
 * The candidate of a kind whose features meet first, and the time at which the search stops for it.
 */
static bool first_of_all(int kind, struct boyse_hit *best)
{
    uint32_t ni = kind == CANDIDATE_EDGE_EDGE ? duo.shape[0].mesh.edge_count
                                              : duo.shape[duo_vertex_side(kind)].raw.vertex_count;
    uint32_t nj = kind == CANDIDATE_EDGE_EDGE ? duo.shape[1].mesh.edge_count
                                              : duo.shape[1 - duo_vertex_side(kind)].raw.face_count;
    bool any = false;
    uint32_t roots = 0;

    memset(best, 0, sizeof *best);
    for (uint32_t n = 0; n < ni * nj; n++) {
        struct candidate c = {0, (uint8_t)kind, n / nj, n % nj};
        struct boyse_hit hit;

        if (kind == CANDIDATE_EDGE_EDGE &&
            !(shape_owns_edge(&duo.shape[0], c.i) && shape_owns_edge(&duo.shape[1], c.j))) {
            continue;
        }
        if (boyse_first(&duo.pair, &c, &hit, &roots) && (!any || hit.t_q30 < best->t_q30)) {
            *best = hit;
            best->candidate = c;
            any = true;
        }
    }
    if (any) {
        boyse_touch(&duo.pair, &best->candidate, best->root_q30, &best->touch);
    }
    return any;
}

/*
 * The time of impact is right within the search's slack at that speed: four units of length, and
 * rounding.
 */
static void check_time(const struct boyse_hit *hit, double t, double speed)
{
    CHECK_AT_MOST(real_abs(real(hit->t_q30, 30) - t), 7 * DUO_UNIT / speed + 1e-8);
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
            duo.state[0].rotation = (carom_quat_q30){{0, CAROM_ONE_Q30, 0, 0}};
        }
        duo_set_paths((double[3]){0.125, 0, -0.25}, still, NULL);
        event = real(duo.pair.skin_q22 / 2, 22);
        CHECK(first_of_all(CANDIDATE_VERTEX_FACE, &hit));
        /* its lowest corners are at 0.2 - 600/4096 */
        check_time(&hit, (0.2 - 600. / 4096 - event) / 0.25, 0.25);
        CHECK_EQ(hit.touch.normal.c[2], CAROM_ONE_Q30);
        CHECK(!first_of_all(CANDIDATE_EDGE_EDGE, &hit));
        CHECK(!first_of_all(CANDIDATE_FACE_VERTEX, &hit));
    }
    above(0.25, 0.3, 0.2, false);
    duo_set_paths(still, still, &gravity);
    CHECK(first_of_all(CANDIDATE_VERTEX_FACE, &hit));
    /* g t^2 / 2 is the distance */
    event = 2 * real_sqrt(0.2 - 600. / 4096 - event);
    check_time(&hit, event, event / 2);
    duo_set_paths((double[3]){0.5, 0.5, 0.25}, still, NULL);
    CHECK(!first_of_all(CANDIDATE_VERTEX_FACE, &hit)); /* the box rises */
    duo_set_paths((double[3]){0, 0, -0.05}, still, NULL);
    CHECK(!first_of_all(CANDIDATE_VERTEX_FACE, &hit)); /* too slow to arrive */
}

/* The other role: the lower face of the box comes down on the upper corners of another box. */
static void test_translating_face(void)
{
    struct boyse_hit hit;

    above(0, 0, 1.25, true);
    shape_box(&duo.shape[1], 12, 800, 800, 2048);
    shape_body(&duo.shape[1], false, &duo.body[1], &duo.state[1]);
    duo_set_paths((double[3]){0.01, -0.02, -1}, still, NULL);
    CHECK(first_of_all(CANDIDATE_FACE_VERTEX, &hit));
    check_time(&hit, 1.25 - 600. / 4096 - 0.25 - real(duo.pair.skin_q22 / 2, 22), 1);
    CHECK_EQ(hit.touch.normal.c[2], CAROM_ONE_Q30); /* the normal leads from b into a */
    CHECK(!first_of_all(CANDIDATE_VERTEX_FACE, &hit));
}

/* Figure 3a: an edge along x falls on a ridge along y. */
static void test_translating_edge(void)
{
    struct boyse_hit hit;
    double gap = 1 - real_sqrt(0.5) - 600. / 4096;

    above(0.1, -0.7, 1, true);
    duo_set_paths((double[3]){0, 0.25, -0.5}, still, NULL);
    CHECK(first_of_all(CANDIDATE_EDGE_EDGE, &hit));
    check_time(&hit, (gap - real(duo.pair.skin_q22 / 2, 22)) / 0.5, 0.5);
    CHECK_NEAR(hit.touch.normal.c[2], CAROM_ONE_Q30, 4);
    CHECK(!first_of_all(CANDIDATE_VERTEX_FACE, &hit));
    CHECK(!first_of_all(CANDIDATE_FACE_VERTEX, &hit));
}

/*
 * A point (x, z) on a circle about the centre of the box reaches the height -h at the angle for
 * which (z - h) tau^2 + 2 x tau - (z + h) = 0, tau = tan(angle / 2). The box turns by Cayley(t u),
 * so tau = t |u|.
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
    duo_set_paths(still, (double[3]){0, 0.48, 0}, NULL);
    u = real_length(duo.motion[0].u);
    CHECK_LESS(real_abs(u - 0.24), 1e-6);
    h = 0.25 - real(duo.pair.skin_q22 / 2, 22);
    CHECK(first_of_all(CANDIDATE_VERTEX_FACE, &hit));
    /* turning about +y takes +x down */
    t = circle_time(x, z, h, u);
    CHECK_MORE(t, 0);
    CHECK_LESS(t, 1);
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
    shape_tetrahedron(&duo.shape[1], 12, 1024);
    shape_body(&duo.shape[1], false, &duo.body[1], &duo.state[1]);
    duo.state[1].rotation.c[0] = (int32_t)real_round(cosine * CAROM_ONE_Q30);
    duo.state[1].rotation.c[1] = (int32_t)real_round(sine * CAROM_ONE_Q30);
    duo.state[1].rotation.c[2] = -duo.state[1].rotation.c[1];
    /* the tip is sqrt 3 / 4 above the centre */
    duo.state[1].position.c[0] = real_round(x * real_power2(32));
    duo.state[1].position.c[2] = real_round((z - real_sqrt(3) / 4) * real_power2(32));
    duo_set_paths(still, (double[3]){0, 0.48, 0}, NULL);
    CHECK(first_of_all(CANDIDATE_FACE_VERTEX, &hit));
    /* seen from the box, the tip turns back, up to the face at -600/4096 */
    t = circle_time(-x, z, 600. / 4096 + real(duo.pair.skin_q22 / 2, 22),
                    real_length(duo.motion[0].u));
    CHECK_MORE(t, 0);
    CHECK_LESS(t, 1);
    check_time(&hit, t, 0.15);
    CHECK_MORE(hit.touch.normal.c[2], 0);
    CHECK_MORE(hit.touch.normal.c[0], 0);
}

/* Figure 3b: the box turns about z until an upright edge of it meets a ridge along x. */
static void test_turning_edge(void)
{
    double x = 0.5, y = -1200. / 4096, wall = 0.4, t;
    struct boyse_hit hit;

    above(0, 0, 0, false);
    shape_box(&duo.shape[1], 12, 8192, 2048, 2048);
    shape_body(&duo.shape[1], false, &duo.body[1], &duo.state[1]);
    /* an eighth of a turn about x: an edge points along y, at sqrt 2 / 4 from the centre */
    duo.state[1].rotation = (carom_quat_q30){{992008094, 410903207, 0, 0}};
    duo.state[1].position.c[1] = -real_round((wall + real_sqrt(0.125)) * real_power2(32));
    duo_set_paths(still, (double[3]){0, 0, -0.48}, NULL);
    CHECK(first_of_all(CANDIDATE_EDGE_EDGE, &hit));
    /* y' = y cos - x sin; the formula above, with y in place of z */
    t = circle_time(x, y, wall - real(duo.pair.skin_q22 / 2, 22), real_length(duo.motion[0].u));
    CHECK_MORE(t, 0);
    CHECK_LESS(t, 1);
    check_time(&hit, t, 0.2);
    CHECK_NEAR(hit.touch.normal.c[1], CAROM_ONE_Q30, 1 << 10);
    CHECK(!first_of_all(CANDIDATE_VERTEX_FACE, &hit));
}

/*
 * Two ridges are so flat that the tolerance of the normal cones admits both the normal and its
 * opposite. The side that the faces look to decides, whichever way the edges run.
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
        duo.shape[0].vertices[0][2] = duo.shape[0].vertices[3][2] = -604;
        CHECK_EQ(carom_mesh_build(&duo.shape[0].mesh, &duo.shape[0].raw, duo.shape[0].block,
                                  sizeof duo.shape[0].block),
                 CAROM_OK);
        shape_field(&duo.shape[1], 9, 2, 2048, 0, 0);
        for (int y = 0; y < 3; y++) {
            duo.shape[1].vertices[3 * y + 1][2] = 4;
        }
        CHECK_EQ(carom_mesh_build(&duo.shape[1].mesh, &duo.shape[1].raw, duo.shape[1].block,
                                  sizeof duo.shape[1].block),
                 CAROM_OK);
        duo.state[0].rotation =
            (carom_quat_q30){{flip ? 0 : CAROM_ONE_Q30, 0, 0, flip ? CAROM_ONE_Q30 : 0}};
        duo_set_paths((double[3]){0, 0, -0.125}, still, NULL);
        c.i = edge_between(&duo.shape[0], 0, 3);
        c.j = edge_between(&duo.shape[1], 1, 4);
        duo.state[0].position.c[1] = -((int64_t)2 << 32); /* above the middle of that edge */
        duo_set_paths((double[3]){0, 0, -0.125}, still, NULL);
        CHECK(shape_owns_edge(&duo.shape[0], c.i));
        CHECK(shape_owns_edge(&duo.shape[1], c.j));
        boyse_touch(&duo.pair, &c, 0, &touch);
        CHECK(touch.valid);
        CHECK_MORE(touch.normal.c[2], CAROM_ONE_Q30 / 10 * 9);
        CHECK_MORE(touch.gap_q22, 0);
        CHECK(boyse_first(&duo.pair, &c, &hit, &roots));
    }
}

/* -------------------------------------------------------- the ends of formats */

/*
 * A side of the box comes down on the middle of a field of 256 x 256 units, whose vertices are farther from its centre than the finest
 * format of P allows for.
 */
static void test_large_field(void)
{
    struct boyse_hit hit;

    above(0.1, 0.05, 0.2, false);
    shape_plane(&duo.shape[1], 7, 2, 16384);
    shape_body(&duo.shape[1], false, &duo.body[1], &duo.state[1]);
    duo_set_paths((double[3]){0, 0, -0.25}, still, NULL);
    CHECK_EQ(duo.pair.view[1].fine, 0);
    CHECK(first_of_all(CANDIDATE_FACE_VERTEX, &hit));
    check_time(&hit, (0.2 - 600. / 4096 - real(duo.pair.skin_q22 / 2, 22)) / 0.25, 0.25);
}

/* Bounds that no q22 number holds become the largest: far and fast bodies, seen from a body that turns. */
static void test_far_bounds(void)
{
    const double far = 400, fast = 100, turn = 0.48;
    const double s = turn / 2, reach = real_sqrt(3) * (far + fast);

    above(far, far, far, false);
    duo_set_motion(1, still, (double[3]){0, 0, turn});
    shape_box(&duo.shape[1], 12, 4096, 4096, 4096);
    duo_begin(true);
    for (int k = 0; k < 3; k++) {
        duo.state[0].position.c[k] = (int64_t)far << 32;
    }
    duo_set_motion(1, still, (double[3]){0, 0, turn});
    duo_set_paths((double[3]){fast, fast, fast}, still, NULL);
    CHECK_MORE(real_sqrt(3) * fast + 2 * s * reach, 512);
    CHECK_EQ(duo.pair.view[0].seen.way_q22, INT32_MAX);
    CHECK_LESS(real(duo.pair.view[0].fixed.way_q22, 22), 180);
}

/* A vertex too far aside of a face that turns for P's format: its P has no root. */
static void test_far_aside(void)
{
    int64_t a_q40[BOYSE_DEGREE + 1];
    int degree;

    above(0, 0, 0, false);
    shape_box(&duo.shape[1], 12, 4096, 4096, 4096);
    duo_begin(true);
    duo.state[0].position.c[0] = (int64_t)100 << 32;
    duo_set_motion(1, still, (double[3]){0, 0, 0.25});
    duo_set_paths(still, still, NULL);
    for (uint32_t n = 0; n < 8 * 12; n++) {
        struct candidate c = {0, CANDIDATE_VERTEX_FACE, n % 8, n / 8};

        boyse_place_start(&duo.pair, &c);
        degree = boyse_polynomial(&duo.pair, &c, a_q40);
        CHECK_MORE(a_q40[0], 0);
        for (int k = 1; k <= degree; k++) {
            CHECK_EQ(a_q40[k], 0);
        }
    }
}

/* Two edges across each other whose lines are more than 512 units apart: the largest number of q22, or its opposite. */
static void test_far_edges(void)
{
    uint32_t far = 0;

    above(0, 490, 490, false);
    shape_box(&duo.shape[1], 12, 4096, 4096, 4096);
    duo_begin(false);
    duo.state[0].position.c[1] = duo.state[0].position.c[2] = (int64_t)490 << 32;
    duo.state[0].rotation = (carom_quat_q30){{992008094, 410903207, 0, 0}};
    duo_set_paths(still, still, NULL);
    for (uint32_t n = 0; n < 18 * 18; n++) {
        struct candidate c = {0, CANDIDATE_EDGE_EDGE, n / 18, n % 18};
        struct boyse_touch touch;
        struct duo_features f;

        duo_features_at(&f, &c, 0);
        if (f.sine > 0.1 && real_abs(f.gap) > 513) {
            boyse_touch(&duo.pair, &c, 0, &touch);
            CHECK_EQ(touch.gap_q22, f.gap * touch.sign > 0 ? INT32_MAX : -INT32_MAX);
            far |= touch.gap_q22 > 0 ? 1 : 2;
        }
    }
    CHECK_EQ(far, 3);
}

/* ----------------------------------------------------------------- the start */

/* A corner above the plane, at `gap` units of q22, moves at `speed`, at most a unit a frame. */
static bool start_at(int32_t gap, double speed, struct boyse_hit *hit)
{
    above(0.25, 0.3, 600. / 4096, false);
    duo.state[0].position.c[2] += carom_shl(gap, 10);
    duo_set_paths((double[3]){0, 0, speed}, still, NULL);
    return first_of_all(CANDIDATE_VERTEX_FACE, hit);
}

static void test_at_start(void)
{
    struct boyse_hit hit;
    int32_t skin;

    start_at(0, 0, &hit);
    skin = duo.pair.skin_q22;
    CHECK_EQ(skin, duo.body[0].def.radius_q22 >> 11);
    /* clear of the event gap: the hit comes at the event gap */
    CHECK(start_at(skin, -0.125, &hit));
    check_time(&hit, real(skin - skin / 2, 22) / 0.125, 0.125);
    /* closer than the event gap: the hit comes at once, or the corner would come closer with every
     * hit */
    CHECK(start_at(skin / 4, -0.125, &hit));
    CHECK_AT_MOST(real(hit.t_q30, 30) * 0.125, 4 * DUO_UNIT);
    /* touching or overlapping: at once while it approaches, never while it leaves */
    CHECK(start_at(0, -0.125, &hit));
    CHECK_EQ(hit.t_q30, 0);
    CHECK_EQ(hit.touch.gap_q22, 0);
    CHECK(start_at(-skin / 4, -0.125, &hit));
    CHECK_EQ(hit.t_q30, 0);
    CHECK_EQ(hit.touch.gap_q22, -skin / 4);
    CHECK(!start_at(0, 0.125, &hit));
    CHECK(!start_at(-skin / 4, 0.125, &hit));
    CHECK(!start_at(skin / 4, 0.125, &hit));
    /* far below: on its way out through the back */
    CHECK(!start_at(-4 * skin, -0.125, &hit));
    /* resting: no motion, no hit */
    CHECK(!start_at(skin, 0, &hit));
}

/* A cube's edge over another's, along y but for a small angle. */
struct ridges {
    int32_t gap_q22;
    double half_yaw; /* half of the angle */
    double comes,
        along; /* it comes down by so much; its middle is so far along the other one's, and comes back to twice less */
};

/* Nearly parallel edges in turning cubes: true if they hit. Sets the gap at the time that counts: the start, or the end if the edge slides. */
static bool ridges_hit(const struct ridges *r, int32_t *found_q22)
{
    const double eighth = 992008094, other = 410903207;
    const int32_t t_q30 = r->along > 0 ? CAROM_ONE_Q30 : 0;
    struct boyse_touch touch;
    struct boyse_hit hit;
    uint32_t roots = 0, facing = 0;
    bool any = false;

    above(0, 0, 2 * real_sqrt(0.5), true);
    shape_box(&duo.shape[0], 12, 4096, 4096, 4096);
    shape_body(&duo.shape[0], true, &duo.body[0], &duo.state[0]);
    duo.state[0].position.c[1] += real_round(r->along * real_power2(32));
    duo.state[0].position.c[2] =
        real_round(2 * real_sqrt(0.5) * real_power2(32)) + carom_shl(r->gap_q22, 10);
    duo.state[0].rotation = (carom_quat_q30){{(int32_t)eighth, -(int32_t)(r->half_yaw * other),
                                              (int32_t)other, (int32_t)(r->half_yaw * eighth)}};
    body_normalise(&duo.state[0].rotation);
    duo_set_paths((double[3]){0, r->along > 0 ? 2 * (0.5 - r->along) : 0, -r->comes},
                  (double[3]){0, 0, 0.0001}, NULL);
    for (uint32_t n = 0; n < 18 * 18; n++) {
        struct candidate c = {0, CANDIDATE_EDGE_EDGE, n / 18, n % 18};

        if (shape_owns_edge(&duo.shape[0], c.i) && shape_owns_edge(&duo.shape[1], c.j)) {
            boyse_touch(&duo.pair, &c, t_q30, &touch);
            if (touch.valid && touch.normal.c[2] > CAROM_ONE_Q30 / 10 * 9 &&
                touch.gap_q22 < duo.pair.skin_q22) {
                facing++;
                *found_q22 = touch.gap_q22;
                any = boyse_first(&duo.pair, &c, &hit, &roots);
            }
        }
    }
    CHECK_EQ(facing, 1);
    return any;
}

/* Nearly parallel edges that overlap by more than half a skin, or come to: no hit. From farther apart it is one. */
static void test_deep_ridges(void)
{
    int32_t gap_q22, skin;

    CHECK(ridges_hit(&(struct ridges){64, 0.0025, 0.001, 0}, &gap_q22));
    CHECK_NEAR(gap_q22, 64, 8);
    skin = duo.pair.skin_q22;
    for (int32_t deep = -16; deep < 48; deep += 4) {
        bool hits = ridges_hit(&(struct ridges){-skin / 2 - deep, 0.0025, 0.001, 0}, &gap_q22);

        CHECK_NEAR(gap_q22, -skin / 2 - deep, 8);
        CHECK(gap_q22 > -skin / 2 || !hits);
    }
}

/*
 * An edge slides over the end of another one, half way on its path, deep in the other cube: it comes to face the other edge there, and
 * does not hit it. Where they cross is the middle of the edge that slides. Turned either way, since the sign of their product differs.
 */
static void test_ridges_that_slide(void)
{
    int32_t gap_q22;

    CHECK(ridges_hit(&(struct ridges){64, 0.0025, 0.001, 0}, &gap_q22));
    for (int n = 0; n < 16; n++) {
        const struct ridges r = {-duo.pair.skin_q22 - 200, n % 2 ? 0.0025 : -0.0025, 0,
                                 0.503 + 0.001 * n};

        CHECK(!ridges_hit(&r, &gap_q22));
        CHECK_LESS(gap_q22, -duo.pair.skin_q22 / 2);
    }
}

/*
 * The middle of a field is higher or lower than the rest, by so little that every direction near the vertical is in its cones. A box lies
 * on it. It touches a middle that is higher, and none that is lower: only a box under the field touches that one.
 */
static void test_flat_valley(void)
{
    enum { MIDDLE = 4, FACES = 12 };

    for (int n = 0; n < 3; n++) {
        const bool low = n > 0, under = n > 1;
        bool touches = false;

        above(0.1, 0.05, (under ? -600. / 4096 : 600. / 4096) + (low ? -1. / 512 : 1. / 512),
              false);
        duo.shape[1].vertices[MIDDLE][2] = low ? -1 : 1;
        CHECK_EQ(carom_mesh_build(&duo.shape[1].mesh, &duo.shape[1].raw, duo.shape[1].block,
                                  sizeof duo.shape[1].block),
                 CAROM_OK);
        duo_set_paths(still, still, NULL);
        for (uint32_t face = 0; face < FACES; face++) {
            const struct candidate c = {0, CANDIDATE_FACE_VERTEX, MIDDLE, face};
            struct boyse_touch touch;

            boyse_touch(&duo.pair, &c, 0, &touch);
            touches |= touch.valid && carom_abs(touch.gap_q22) <= 4;
        }
        CHECK_EQ(touches, low == under);
    }
}

const struct test tests_boyse[] = {
    {"boyse/flat_valley", test_flat_valley},
    {"boyse/deep_ridges", test_deep_ridges},
    {"boyse/ridges_that_slide", test_ridges_that_slide},
    {"boyse/translating_vertex", test_translating_vertex},
    {"boyse/translating_face", test_translating_face},
    {"boyse/translating_edge", test_translating_edge},
    {"boyse/turning_vertex", test_turning_vertex},
    {"boyse/turning_face", test_turning_face},
    {"boyse/turning_edge", test_turning_edge},
    {"boyse/flat_ridges", test_flat_ridges},
    {"boyse/large_field", test_large_field},
    {"boyse/far_bounds", test_far_bounds},
    {"boyse/far_aside", test_far_aside},
    {"boyse/far_edges", test_far_edges},
    {"boyse/at_start", test_at_start},
    {0},
};
