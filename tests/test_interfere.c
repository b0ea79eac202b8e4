/* SPDX-License-Identifier: MIT */
/*
 * Candidates against trying everything in double precision: every vertex with every face, and every
 * two edges, of two meshes.
 */
#include "interfere/narrow.h"
#include "lib/real.h"
#include "lib/solids.h"
#include "lib/test.h"

#ifdef TEST_LONG
#define POSES 2000 /* poses for each two shapes */
#define FIELD 12
#else
#define POSES 9
#define FIELD 4
#endif

#define CANDIDATES 4096
#define FACES      2048
#define ENTRIES    512
/* Rounding of the places and directions that the engine works with. */
#define PLACE_NOISE_Q22 16
#define ANGLE_NOISE     1e-6

static struct shape shape_a, shape_b;
static struct solid a = {.shape = &shape_a}, b = {.shape = &shape_b};
static struct solid turned = {.shape = &shape_a}; /* a, turned by the largest allowed turn */
static struct body bodies[2];
static struct body_state states[2];
static const struct pair pairs[1] = {{0, 1}};

static uint16_t heads[ZLIST_CELLS_MAX];
static struct zentry entries[ENTRIES];
static struct candidate candidates[CANDIDATES];
static struct carom_face_ref faces[FACES];
static struct pool entry_pool, candidate_pool, face_pool;
static struct interfere work;
static struct interfere_leaf leaf;
static struct pair_work meeting;
static bool by_paths; /* gather for the paths at hand, not for the regions */

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
    const struct interfere_pairs all = {bodies, pairs, 1};

    interfere_note_faces(&work, &all, c, n);
    to->count += n;
    to->largest = n > to->largest ? n : to->largest;
    for (uint32_t k = 0; k < n; k++) {
        uint32_t place = place_in_set(c[k].kind, c[k].i, c[k].j);

        CHECK_EQ(c[k].pair, 0);
        CHECK_LESS(place / 8, SET_BYTES);
        to->set->bits[place / 8] |= (uint8_t)(1 << place % 8);
    }
}

static int visit(struct collector *to)
{
    const struct interfere_pairs all = {bodies, pairs, 1};
    const struct interfere_span span = {0, 0, 0, UINT32_MAX, false};

    if (!by_paths) {
        return interfere_visit(&work, bodies, pairs, 1, &to->base);
    }
    memset(&meeting, 0, sizeof meeting);
    work.meetings = &meeting;
    return interfere_visit_pair(&work, &all, 0, &span, false, &to->base);
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
    work.leaf = &leaf;
    work.candidates = candidates;
    work.candidate_pool = &candidate_pool;
    work.faces = faces;
    work.face_pool = &face_pool;
    memset(to, 0, sizeof *to);
    to->base.visit = collect;
    to->set = set;
    result = visit(to);
    interfere_finish(&work);
    return result;
}

/* ------------------------------------------------------------------- scenes */

static void place(int i)
{
    body_place(&bodies[i], &states[i]);
    body_region_begin(&bodies[i], &states[i], CAROM_ONE_Q30, CAROM_ONE_Q30,
                      bodies[i].search.region.room_q22);
    solid_place(i == 0 ? &a : &b, &states[i]);
}

/* A random point inside a face or on an edge, and a direction in which the surface looks there. */
static void random_place(struct test_random *r, const struct solid *s, double out[3], double n[3])
{
    const struct carom_mesh *mesh = &s->shape->mesh;
    uint32_t e = (uint32_t)test_random_range(r, 0, mesh->edge_count - 1);
    const struct carom_edge *edge = &mesh->edges[e];
    const uint16_t *c = s->shape->faces[edge->face[0]];
    bool on_edge = test_random_range(r, 0, 1);
    double along = real(test_random_range(r, 1, 7), 3);

    for (int k = 0; k < 3; k++) {
        double p = s->p[edge->vertex[0]][k], q = s->p[edge->vertex[1]][k];
        double middle = (s->p[c[0]][k] + s->p[c[1]][k] + s->p[c[2]][k]) / 3;

        out[k] = on_edge ? p + along * (q - p) : middle;
        n[k] = s->normal[edge->face[0]][k];
        if (on_edge && edge->face[1] != CAROM_NO_FACE) {
            n[k] += s->normal[edge->face[1]][k];
        }
    }
}

/* The lowest vertex along n, or a point of the flattest edge that leaves it. */
static void lowest_place(struct test_random *r, const struct solid *s, const double n[3],
                         double out[3])
{
    double along = test_random_range(r, 0, 1) ? real(test_random_range(r, 1, 7), 3) : 0;
    uint32_t lowest = 0, next = 0;
    double least = 1e9;

    for (uint32_t v = 1; v < s->shape->raw.vertex_count; v++) {
        lowest = real_dot(s->p[v], n) < real_dot(s->p[lowest], n) ? v : lowest;
    }
    for (uint32_t v = 0; v < s->shape->raw.vertex_count; v++) {
        double d[3], rise;

        for (int k = 0; k < 3; k++) {
            d[k] = s->p[v][k] - s->p[lowest][k];
        }
        rise = v == lowest ? 1e9 : real_dot(d, n) / real_length(d);
        next = rise < least ? v : next;
        least = rise < least ? rise : least;
    }
    for (int k = 0; k < 3; k++) {
        out[k] = s->p[lowest][k] + along * (s->p[next][k] - s->p[lowest][k]);
    }
}

/*
 * Turn the bodies at random, anywhere in the world, with a point of one near a point of the other.
 */
static void random_scene(struct test_random *r, bool turn_b)
{
    double on_a[3], on_b[3], n[3];

    for (int i = 0; i < 2; i++) {
        bodies[i].search.region.room_q22 =
            (int32_t)test_random_range(r, 64, (int64_t)1 << test_random_range(r, 8, 19));
        states[i].rotation = (carom_quat_q30){{CAROM_ONE_Q30, 0, 0, 0}};
    }
    states[0].rotation = shape_random_turn(r);
    if (turn_b) {
        states[1].rotation = shape_random_turn(r);
    }
    for (int k = 0; k < 3; k++) {
        states[1].position.c[k] = test_random_range(r, -((int64_t)3000 << 32), (int64_t)3000 << 32);
    }
    states[0].position = states[1].position;
    place(0);
    place(1);
    random_place(r, &b, on_b, n);
    lowest_place(r, &a, n, on_a);
    for (int k = 0; k < 3; k++) {
        int64_t near_q22 = bodies[0].search.region.room_q22 + bodies[1].search.region.room_q22;

        states[0].position.c[k] += real_round((on_b[k] - on_a[k]) * real_power2(32)) +
                                   test_random_range(r, -near_q22, near_q22) * 512;
    }
    place(0);
}

/* ------------------------------------------------------------ by trying all */

/* Reach and turn of both bodies together. */
static int64_t reach_q22;
static double turn;

/* Whether a vertex of a lies behind a face of b with normal n, if b has two sides. */
static bool is_behind(int kind, const struct solid *cone, uint32_t v, const double n[3],
                      double tolerance)
{
    const double back[3] = {-n[0], -n[1], -n[2]};

    return kind == CANDIDATE_VERTEX_FACE && mesh_two_sided(&shape_b.mesh) &&
           solid_vertex_cone(cone, v, back, tolerance);
}

/*
 * Every vertex of one body near a face of the other must be a candidate if it faces the other after
 * the turn of on_a. Near means near at the start. Returns how many there are.
 */
static uint32_t try_vertices(const struct solid *on_a, int kind, double tolerance)
{
    const struct solid *from = kind == CANDIDATE_VERTEX_FACE ? &a : &b;
    const struct solid *to = kind == CANDIDATE_VERTEX_FACE ? &b : &a;
    const struct solid *cone = kind == CANDIDATE_VERTEX_FACE ? on_a : &b;
    const struct solid *plane = kind == CANDIDATE_VERTEX_FACE ? &b : on_a;
    uint32_t count = 0;

    for (uint32_t v = 0; v < from->shape->raw.vertex_count; v++) {
        for (uint32_t f = 0; f < to->shape->raw.face_count && from->own_vertex[v]; f++) {
            if (solid_vertex_near(from, v, to, f, reach_q22 - PLACE_NOISE_Q22) &&
                (solid_vertex_cone(cone, v, plane->normal[f], tolerance) ||
                 is_behind(kind, cone, v, plane->normal[f], tolerance))) {
                CHECK(in_set(&found, kind, v, f));
                count++;
            }
        }
    }
    return count;
}

static uint32_t try_edges(const struct solid *on_a, double tolerance)
{
    uint32_t count = 0;

    for (uint32_t i = 0; i < shape_a.mesh.edge_count; i++) {
        for (uint32_t j = 0; j < shape_b.mesh.edge_count && a.own_edge[i]; j++) {
            if (b.own_edge[j] && solid_edges_near(&a, i, &b, j, reach_q22 - PLACE_NOISE_Q22) &&
                solid_edge_cones(on_a, i, &b, j, tolerance)) {
                CHECK(in_set(&found, CANDIDATE_EDGE_EDGE, i, j));
                count++;
            }
        }
    }
    return count;
}

/*
 * Interfering faces are sorted, each is listed once, and the faces of every candidate are among
 * them.
 */
static void check_faces(void)
{
    for (uint32_t i = 0; i < face_pool.used; i++) {
        CHECK_AT_MOST(faces[i].body, 1);
        CHECK(i == 0 || faces[i].body > faces[i - 1].body ||
              (faces[i].body == faces[i - 1].body && faces[i].face > faces[i - 1].face));
    }
    for (uint32_t f = 0; f < shape_b.raw.face_count; f++) {
        bool is_candidate = false, is_listed = false;

        for (uint32_t v = 0; v < shape_a.raw.vertex_count; v++) {
            is_candidate = is_candidate || in_set(&found, CANDIDATE_VERTEX_FACE, v, f);
        }
        for (uint32_t i = 0; i < face_pool.used && is_candidate && !is_listed; i++) {
            is_listed = faces[i].body == 1 && faces[i].face == f;
        }
        CHECK_EQ(is_candidate, is_listed);
    }
}

/* ---------------------------------------------------------------------- tests */

static void start(struct test_random *r, bool turn_b)
{
    random_scene(r, turn_b);
    reach_q22 = bodies[0].search.region.room_q22 + bodies[1].search.region.room_q22;
    turn = real(body_region_turn_off_q30(&bodies[0]) + body_region_turn_off_q30(&bodies[1]), 30);
}

static void make(int which)
{
    switch (which) {
    case 0:
        shape_box(&shape_a, 12, 4096, 2458, 1228);
        break;
    case 1:
        shape_ball(&shape_a, 12, 2048);
        break;
    default:
        shape_l(&shape_a, 12, 2048);
    }
    shape_body(&shape_a, true, &bodies[0], &states[0]);
    shape_body(&shape_b, false, &bodies[1], &states[1]);
    solid_note_owned(&a);
    solid_note_owned(&b);
}

/* Turn a about some axis by the largest angle that both bodies may turn against each other. */
static void turn_a(struct test_random *r)
{
    struct body_state state = states[0];
    double u[3], q[4], p[4], length, sine, cosine;

    for (int k = 0; k < 3; k++) {
        u[k] = real(test_random_range(r, -100, 100), 0) + 0.5;
    }
    length = real_length(u);
    real_sine_cosine(turn / 2, &sine, &cosine);
    for (int k = 0; k < 4; k++) {
        q[k] = real(state.rotation.c[k], 30);
        p[k] = k == 0 ? cosine : u[k - 1] / length * sine;
    }
    state.rotation.c[0] = (int32_t)real_round(
        (p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3]) * CAROM_ONE_Q30);
    for (int k = 1; k <= 3; k++) {
        int i = k % 3 + 1, j = i % 3 + 1;

        state.rotation.c[k] = (int32_t)real_round(
            (p[0] * q[k] + p[k] * q[0] + p[i] * q[j] - p[j] * q[i]) * CAROM_ONE_Q30);
    }
    solid_place(&turned, &state);
}

/* No pair that can touch is missing, for any shapes, poses, reach and turn. */
static void check_recall(uint64_t seed)
{
    double cone = real(INTERFERE_CONE_Q30, 30) - ANGLE_NOISE;
    struct test_random r = {seed};
    uint32_t vertices = 0, edges = 0, handed = 0;

    for (int which = 0; which < 3; which++) {
        make(which);
        for (int n = 0; n < POSES / 3; n++) {
            struct collector to;

            start(&r, n % 2);
            CHECK_EQ(gather(&found, ENTRIES, CANDIDATES, FACES, &to), CAROM_OK);
            vertices += try_vertices(&a, CANDIDATE_VERTEX_FACE, cone + turn);
            vertices += try_vertices(&a, CANDIDATE_FACE_VERTEX, cone + turn);
            edges += try_edges(&a, cone + turn);
            turn_a(&r);
            try_vertices(&turned, CANDIDATE_VERTEX_FACE, cone);
            try_vertices(&turned, CANDIDATE_FACE_VERTEX, cone);
            try_edges(&turned, cone);
            handed += to.count;
            check_faces();
        }
    }
    CHECK_AT_LEAST(vertices, POSES / 4);
    CHECK_AT_LEAST(20 * edges + 20, POSES); /* the oracle finds some */
    /* and not everything is a candidate */
    CHECK_LESS(handed, 10 * (vertices + edges) + 40 * POSES);
}

/* ------------------------------------------------------------------- motion */

/* The bodies at a time of their paths, moved off them by a part of what their regions allow. */
static void place_at(struct test_random *r, int32_t t_q30)
{
    struct solid *solids[2] = {&a, &b};

    for (int i = 0; i < 2; i++) {
        struct body_state state = states[i];
        int64_t off = bodies[i].search.region.room_q22 * 500; /* q32, by axis: 0.86 of the room */

        body_advance(&bodies[i], &state, t_q30, CAROM_ONE_Q30, NULL);
        for (int k = 0; k < 3; k++) {
            state.position.c[k] += test_random_range(r, -off, off);
        }
        solid_place(solids[i], &state);
    }
}

/*
 * Both bodies get paths on which a point of one comes near a point of the other at the returned
 * time.
 */
static int32_t random_motion(struct test_random *r)
{
    double on_a[3], on_b[3], n[3];
    int32_t t_q30 = (int32_t)test_random_range(r, 0, CAROM_ONE_Q30);

    for (int i = 0; i < 2; i++) {
        struct body *body = &bodies[i];
        int64_t speed = (int64_t)1 << test_random_range(r, 30, 40);
        int64_t spin =
            ((int64_t)1 << 40) / test_random_range(r, 4, 40) * test_random_range(r, 0, 1);
        const carom_v3_q40 g = {{0, 0, -((int64_t)1 << 37)}};
        carom_v3_q40 v, w;

        states[i].rotation = shape_random_turn(r);
        for (int k = 0; k < 3; k++) {
            states[i].position.c[k] = 0;
            v.c[k] = test_random_range(r, -speed, speed);
            w.c[k] = test_random_range(r, -spin, spin);
        }
        body_set_motion(body, &states[i], &v, &w);
        body_predict(body, &states[i], CAROM_ONE_Q30, test_random_range(r, 0, 3) == 0 ? &g : NULL);
        body->search.region.room_q22 = 0;
    }
    place_at(r, t_q30);
    random_place(r, &b, on_b, n);
    lowest_place(r, &a, n, on_a);
    for (int k = 0; k < 3; k++) {
        states[0].position.c[k] += real_round((on_b[k] - on_a[k]) * real_power2(32)) +
                                   test_random_range(r, -1, 1) * bodies[0].def.skin_q22 * 2048;
    }
    for (int i = 0; i < 2; i++) {
        const carom_v3_q40 g = bodies[i].path.g;

        body_predict(&bodies[i], &states[i], CAROM_ONE_Q30, NULL);
        bodies[i].path.g = g;
        body_region_begin(
            &bodies[i], &states[i], CAROM_ONE_Q30, CAROM_ONE_Q30,
            by_paths ? 0 : (int32_t)test_random_range(r, 0, 1) * bodies[i].def.skin_q22 * 10);
    }
    return t_q30;
}

/* Body a is a sheet of many small leaves that moves like a box of its size. */
static void make_sheet(void)
{
    static struct shape box;
    struct body *body = &bodies[0];

    shape_box(&box, 12, FIELD * 256, FIELD * 256, 512);
    shape_body(&box, true, body, &states[0]);
    shape_field(&shape_a, 12, FIELD, 256, 200, 9);
    shape_a.mesh.raw.kind = CAROM_SOLID; /* what moves has one side */
    body->def.mesh = &shape_a.mesh;
    body->def.radius_q22 = shape_a.mesh.radius_q22;
    solid_note_owned(&a);
}

/* Gather for both paths from one time to another. */
static int gather_part(const int32_t times_q30[2], struct collector *to)
{
    const struct body_path paths[2] = {bodies[0].path, bodies[1].path};
    int result;

    for (int i = 0; i < 2 && by_paths; i++) {
        body_cut_path(&bodies[i], &states[i], times_q30[0], times_q30[1]);
    }
    result = gather(&found, ENTRIES, CANDIDATES, FACES, to);
    for (int i = 0; i < 2; i++) {
        bodies[i].path = paths[i];
    }
    return result;
}

/*
 * If a feature is within the margin and faces the other body at some time of the motion, it was a
 * candidate from the start. The motion may be any that the regions allow; with by_paths, it is a
 * part of the paths.
 */
static void check_motion(uint64_t seed, bool small_b)
{
    struct test_random r = {seed};
    double cone = real(INTERFERE_CONE_Q30, 30) - ANGLE_NOISE;
    uint32_t vertices = 0, edges = 0, handed = 0, swapped = 0;

    for (int which = 0; which < 4; which++) {
        make(which % 3);
        if (which == 3) {
            make_sheet();
        }
        shape_body(&shape_b, true, &bodies[1], &states[1]);
        reach_q22 =
            5 * (int64_t)(bodies[0].def.skin_q22 > bodies[1].def.skin_q22 ? bodies[0].def.skin_q22
                                                                          : bodies[1].def.skin_q22);
        for (int n = 0; n < POSES / 3; n++) {
            struct collector to;
            int32_t t_q30 = random_motion(&r), part_q30[2] = {0, CAROM_ONE_Q30};

            if (by_paths) {
                part_q30[0] = (int32_t)test_random_range(&r, 0, t_q30 - t_q30 / 8);
                part_q30[1] = (int32_t)test_random_range(&r, t_q30 + 1, CAROM_ONE_Q30);
            }
            CHECK_EQ(gather_part(part_q30, &to), CAROM_OK);
            handed += to.count;
            swapped += work.swapped;
            for (int k = 0; k <= 8; k++) {
                place_at(&r, k == 0 ? t_q30 : part_q30[0] + (part_q30[1] - part_q30[0]) / 8 * k);
                vertices += try_vertices(&a, CANDIDATE_VERTEX_FACE, cone);
                vertices += try_vertices(&a, CANDIDATE_FACE_VERTEX, cone);
                edges += try_edges(&a, cone);
            }
        }
    }
    CHECK_AT_LEAST(8 * vertices, POSES);
    CHECK_AT_LEAST(8 * edges + 8, POSES); /* the oracle finds some */
    CHECK_LESS(handed, 10 * (vertices + edges) + 60 * POSES);
    CHECK(small_b ? swapped >= POSES / 8 : swapped < POSES);
}

/* Fields, and solids that move. */
static void test_motion(void)
{
    shape_l(&shape_b, 11, 1500);
    check_motion(1, false);
    shape_ball(&shape_b, 11, 2048);
    check_motion(2, false);
    shape_ball(&shape_b, 12, 700);
    check_motion(3, true); /* b is the body that is searched, and it spins */
}

/* The same for parts of the paths at hand. */
static void test_paths(void)
{
    by_paths = true;
    test_motion();
    by_paths = false;
}

static void test_plane(void)
{
    shape_plane(&shape_b, 9, FIELD, 512);
    check_recall(1);
}

static void test_field(void)
{
    shape_field(&shape_b, 9, FIELD, 400, 300, 7);
    check_recall(2);
}

/* A field finer than the body: its vertices lie against the body's faces. */
static void test_fine_field(void)
{
    shape_field(&shape_b, 12, FIELD, 512, 500, 8);
    check_recall(3);
}

/* The searched body is a solid. */
static void test_solid(void)
{
    shape_l(&shape_b, 11, 1500);
    check_recall(4);
}

/* Small working pools give the same candidates, in chunks; the same faces interfere. */
static void test_chunks(void)
{
    static const uint32_t sizes[][2] = {{ENTRIES, 1}, {1, CANDIDATES}, {1, 1}, {3, 7}};
    static struct carom_face_ref listed[FACES];
    struct test_random r = {5};

    shape_field(&shape_b, 11, FIELD, 400, 300, 7);
    make(2);
    for (int n = 0; n < POSES / 3; n++) {
        struct collector all, to;
        uint32_t face_count;

        start(&r, n % 2);
        CHECK_EQ(gather(&found, ENTRIES, CANDIDATES, FACES, &all), CAROM_OK);
        CHECK(work.whole);
        CHECK_EQ(entry_pool.refused, 0);
        CHECK_EQ(candidate_pool.refused, 0);
        CHECK_EQ(work.candidate_count, all.count);
        face_count = face_pool.used;
        memcpy(listed, faces, sizeof listed);
        for (unsigned i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
            CHECK_EQ(gather(&again, sizes[i][0], sizes[i][1], FACES, &to), CAROM_OK);
            CHECK_EQ(memcmp(&found, &again, sizeof found), 0);
            CHECK_AT_MOST(to.largest, sizes[i][1]);
            CHECK_EQ(work.whole, to.count <= sizes[i][1]);
            CHECK_EQ(face_pool.used, face_count);
            CHECK_EQ(memcmp(listed, faces, face_count * sizeof faces[0]), 0);
        }
    }
}

static void note(struct candidate_visitor *self, const struct candidate *c, uint32_t n)
{
    struct collector *to = (struct collector *)self;

    to->count += n;
    for (uint32_t k = 0; k < n; k++) {
        uint32_t place = place_in_set(c[k].kind, c[k].i, c[k].j);

        to->set->bits[place / 8] |= (uint8_t)(1 << place % 8);
    }
}

/*
 * Two pairs are gathered, the first one goes, the second one takes its number, and a pair comes: the pool, which has not room for three,
 * then holds the candidates of both that are there, and no others.
 */
static void test_kept(void)
{
    static const struct pair two[2] = {{0, 1}, {0, 1}};
    const struct interfere_pairs all = {bodies, two, 2};
    const struct interfere_span span = {0, 0, INT64_MAX, UINT32_MAX, false};
    struct test_random r = {8};
    int several = 0;

    shape_field(&shape_b, 12, FIELD, 400, 300, 7);
    make(1);
    for (int n = 0; n < POSES && several < 4; n++) {
        struct pair_work meetings[2] = {{.kept = false}};
        struct collector first, to = {{note}, &again, 0, 0};

        start(&r, true);
        CHECK_EQ(gather(&found, ENTRIES, CANDIDATES, FACES, &first), CAROM_OK);
        if (first.count < 8 || 3 * first.count > CANDIDATES) {
            continue;
        }
        several++;
        work.meetings = meetings;
        candidate_pool = (struct pool){3 * first.count - 1, 0, 0, 0};
        CHECK_EQ(interfere_visit_pair(&work, &all, 0, &span, true, &to.base), CAROM_OK);
        CHECK_EQ(interfere_visit_pair(&work, &all, 1, &span, true, &to.base), CAROM_OK);
        meetings[0] = meetings[1];
        meetings[1] = (struct pair_work){.kept = false};
        CHECK_EQ(interfere_visit_pair(&work, &all, 1, &span, true, &to.base), CAROM_OK);
        CHECK_EQ(candidate_pool.refused, 0);
        CHECK_EQ(candidate_pool.used, 2 * first.count);
        for (uint32_t number = 0; number < 2; number++) {
            CHECK(meetings[number].kept);
            memset(&again, 0, sizeof again);
            to.count = 0;
            interfere_visit_kept(&work, number, &to.base);
            CHECK_EQ(to.count, first.count);
            CHECK_EQ(memcmp(&found, &again, sizeof found), 0);
        }
    }
    CHECK_MORE(several, 0);
}

/* The pool of faces holds all of them or gives its error; working pools do not matter. */
static void test_faces_full(void)
{
    struct test_random r = {6};
    int several = 0;

    shape_field(&shape_b, 12, FIELD, 400, 300, 7);
    make(1);
    for (int n = 0; n < POSES; n++) {
        struct collector to;
        uint32_t needed;

        start(&r, true);
        CHECK_EQ(gather(&found, ENTRIES, CANDIDATES, FACES, &to), CAROM_OK);
        needed = face_pool.used;
        CHECK_EQ(face_pool.peak, needed);
        if (needed < 4) {
            continue;
        }
        several++;
        CHECK_EQ(gather(&found, ENTRIES, CANDIDATES, needed, &to), CAROM_OK);
        CHECK_EQ(face_pool.used, needed);
        /* gathered twice, because the candidates do not fit */
        CHECK_EQ(gather(&found, 2, 1, needed, &to), CAROM_OK);
        CHECK_EQ(interfere_visit(&work, bodies, pairs, 1, &to.base), CAROM_OK);
        interfere_finish(&work);
        CHECK_EQ(face_pool.used, needed);
        CHECK_EQ(gather(&found, ENTRIES, CANDIDATES, needed - 1, &to), CAROM_ERR_FACES_FULL);
        CHECK_MORE(face_pool.refused, 0);
        CHECK_EQ(gather(&found, 2, 1, needed - 1, &to), CAROM_ERR_FACES_FULL);
    }
    CHECK_MORE(several, 0);
}

/* Put the box on the plane z = 0. */
static void lie_down(void)
{
    states[0].position.c[2] = (int64_t)614 << 20;
    place(0);
    place(1);
}

/* The first of two pairs is too large: the second one is not gathered. */
static void test_too_large(void)
{
    static const struct pair two[2] = {{0, 1}, {0, 1}};
    struct collector to;

    shape_plane(&shape_b, 9, FIELD, 512);
    make(0);
    lie_down();
    CHECK_EQ(gather(&found, ENTRIES, CANDIDATES, FACES, &to), CAROM_OK);
    CHECK_MORE(to.count, 0);
    bodies[0].search.reach_q22 = INT32_MAX / 2;
    memset(&to, 0, sizeof to);
    to.base.visit = collect;
    to.set = &found;
    CHECK_EQ(interfere_visit(&work, bodies, two, 2, &to.base), CAROM_ERR_RANGE);
    CHECK_EQ(to.count, 0);
    CHECK_EQ(work.pair, 0);
}

static const struct mesh_moving in_step = {mesh_drift_vertex,    mesh_drift_edge,
                                           mesh_drift_face,      mesh_list_face,
                                           interfere_area_under, interfere_make_lists};

/* Make b a surface whose z-lists are made in a step, in `entries` at a time. */
static void make_moving(uint32_t entries)
{
    static struct carom_surface surface;
    struct collector to;

    surface.does = &in_step;
    surface.mesh = &shape_b.mesh;
    shape_b.mesh.surface = &surface;
    make(0);
    lie_down();
    CHECK_EQ(gather(&found, entries, CANDIDATES, FACES, &to), CAROM_OK);
}

/* A gather that may find no candidate ends at the first, though more chunks of z-lists would follow. */
static void test_too_many(void)
{
    const struct interfere_pairs all = {bodies, pairs, 1};
    struct interfere_span span = {0, 0, CAROM_ONE_Q30, UINT32_MAX, false};
    struct collector to;
    uint32_t whole;

    shape_plane(&shape_b, 11, FIELD, 512);
    make_moving(1);
    memset(&meeting, 0, sizeof meeting);
    memset(&to, 0, sizeof to);
    to.base.visit = collect;
    to.set = &found;
    work.meetings = &meeting;
    interfere_forget_lists(&work);
    work.candidate_count = 0;
    CHECK_EQ(interfere_visit_pair(&work, &all, 0, &span, true, &to.base), CAROM_OK);
    CHECK_MORE(entry_pool.refused, 0);
    whole = work.candidate_count;
    span.most = 0;
    work.candidate_count = 0;
    interfere_forget_lists(&work);
    CHECK_EQ(interfere_visit_pair(&work, &all, 0, &span, true, &to.base), INTERFERE_TOO_MANY);
    CHECK_MORE(work.candidate_count, 0);
    CHECK_LESS(work.candidate_count, whole);
    shape_b.mesh.surface = NULL;
}

/* A face is listed for an area that it reaches into with its second or third corner alone. */
static void test_listed_corner(void)
{
    for (int turn = 0; turn < 3; turn++) {
        for (int axis = 0; axis < 2; axis++) {
            struct interfere_area area = {{-512, -512}, {512, 512}};
            struct interfere_place from = {0, 0};

            /* one square, a triangle at each side of its diagonal */
            shape_plane(&shape_b, 11, 1, 1024);
            for (int f = 0; f < 2; f++) {
                uint16_t *c = shape_b.faces[f], first = c[0];

                for (int k = 0; k < turn; k++, first = c[0]) {
                    c[0] = c[1];
                    c[1] = c[2];
                    c[2] = first;
                }
            }
            CHECK_EQ(
                carom_mesh_build(&shape_b.mesh, &shape_b.raw, shape_b.block, sizeof shape_b.block),
                CAROM_OK);
            make_moving(ENTRIES);
            area.high[axis] = -300; /* it grows by a part of its width */
            interfere_forget_lists(&work);
            CHECK(interfere_make_lists(&work, &shape_b.mesh, &area, &from));
            CHECK_EQ(from.face, 2);
            CHECK_AT_LEAST(entry_pool.used, 2);
        }
    }
    shape_b.mesh.surface = NULL;
}

static void test_order(void)
{
    static const struct candidate sorted[] = {{0, 0, 0, 5}, {0, 0, 0, 6}, {0, 0, 3, 1},
                                              {0, 1, 0, 0}, {0, 2, 0, 0}, {1, 0, 0, 0}};

    for (int i = 0; i < 6; i++) {
        for (int k = 0; k < 6; k++) {
            int order = candidate_compare(&sorted[i], &sorted[k]);

            CHECK_EQ((order > 0) - (order < 0), (i > k) - (i < k));
        }
    }
}

/* Bodies far from each other, and no pairs at all. */
static void test_nothing(void)
{
    struct collector to;

    shape_plane(&shape_b, 9, FIELD, 512);
    make(0);
    states[0].position.c[2] = (int64_t)2 << 32;
    bodies[0].search.region.room_q22 = 1 << 21;
    place(0);
    place(1);
    CHECK_EQ(gather(&found, ENTRIES, CANDIDATES, FACES, &to), CAROM_OK);
    CHECK_EQ(to.count, 0);
    CHECK_EQ(face_pool.used, 0);
    states[0].position.c[2] = (int64_t)4000 << 32;
    place(0);
    CHECK_EQ(gather(&found, ENTRIES, CANDIDATES, FACES, &to), CAROM_OK);
    CHECK_EQ(to.count, 0);
    CHECK_EQ(face_pool.used, 0);
}

/*
 * The area under a body 100 units away, in quanta of 2^-20 units, is at most 2^20 quanta away; around it are the body's radius, a
 * unit, and 2 for rounding.
 */
static void test_far_area(void)
{
    const int32_t end = 1 << 20, around = (1 << 20) + 2;
    struct interfere_area area;

    shape_plane(&shape_b, 20, 1, 4096);
    memset(bodies, 0, sizeof bodies);
    for (int i = 0; i < 2; i++) {
        bodies[i].def.mesh = &shape_b.mesh;
        bodies[i].search.region.q.c[0] = CAROM_ONE_Q30;
    }
    bodies[0].def.radius_q22 = 1 << 22;
    bodies[0].search.region.at.c[0] = CAROM_RATIO(100, 1, 32);
    bodies[0].search.region.at.c[1] = CAROM_RATIO(-100, 1, 32);
    area = interfere_area_under(bodies, pairs, 1, 1);
    CHECK_EQ(area.low[0], end - around);
    CHECK_EQ(area.high[0], end + around);
    CHECK_EQ(area.low[1], -end - around);
    CHECK_EQ(area.high[1], around - end);
}

const struct test tests_interfere[] = {
    {"interfere/plane", test_plane},
    {"interfere/field", test_field},
    {"interfere/fine_field", test_fine_field},
    {"interfere/solid", test_solid},
    {"interfere/motion", test_motion},
    {"interfere/paths", test_paths},
    {"interfere/chunks", test_chunks},
    {"interfere/kept", test_kept},
    {"interfere/faces_full", test_faces_full},
    {"interfere/order", test_order},
    {"interfere/far_area", test_far_area},
    {"interfere/nothing", test_nothing},
    {"interfere/too_large", test_too_large},
    {"interfere/too_many", test_too_many},
    {"interfere/listed_corner", test_listed_corner},
    {0},
};
