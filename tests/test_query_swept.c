/* SPDX-License-Identifier: MIT */
/*
 * Meshes that are in no world: the bodies that they overlap, and the hits on their way. A way is
 * compared with poses on it: before the hit nothing crosses, and a little later something does.
 */
#include <string.h>

#include "lib/asked.h"

#ifdef TEST_LONG
#define WAYS       1500
#define STEPS      40
#define EVERY_WAYS 4000
#else
#define WAYS       8
#define STEPS      8
#define EVERY_WAYS 12
#endif

#define EVERY 8192

static struct shape shape[4];
static struct carom_cast_workspace workspace;

static struct carom_query_mesh put(const struct carom_mesh *mesh, int64_t x, int64_t y, int64_t z)
{
    return (struct carom_query_mesh){mesh, {{x, y, z}}, upright};
}

/* ------------------------------------------------------------------- by hand */

static void test_overlap(void)
{
    struct carom_world *world = asked_world(0);
    struct carom_query_mesh mesh;
    uint16_t bodies[4];

    shape_box(&shape[0], 12, 4096, 4096, 4096);
    shape_box(&shape[1], 12, 512, 512, 512);
    shape_plane(&shape[2], 12, 2, 16384);
    CHECK_EQ(asked_add(world, &shape[2].mesh, false, 0, 0, 0, upright), 0);
    CHECK_EQ(asked_add(world, &shape[0].mesh, true, 0, 0, 2 * UNIT, upright), 1);
    CHECK_EQ(asked_add(world, &shape[1].mesh, true, UNIT, 0, 2 * UNIT, upright), 2);
    /* between both boxes: touches neither, then one, then both; inside one; around the other */
    mesh = put(&shape[1].mesh, 3 * UNIT / 4 - UNIT / 512, 0, 2 * UNIT);
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 4), 0);
    mesh.position.c[0] = UNIT / 2;
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 4), 1);
    CHECK_EQ(bodies[0], 1);
    mesh.position.c[0] = 0;
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 4), 1);
    mesh = put(&shape[0].mesh, 3 * UNIT / 4, UNIT / 16, 2 * UNIT);
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 4), 2);
    CHECK_EQ(bodies[0], 1);
    CHECK_EQ(bodies[1], 2);
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 1), CAROM_ERR_BODIES_FULL);
    CHECK_EQ(bodies[0], 1);
    mesh = put(&shape[0].mesh, 600 * UNIT, 0, -7 * UNIT); /* far beside the plane */
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 4), 0);
    mesh = put(&shape[0].mesh, UNIT, UNIT / 16, -7 * UNIT); /* below the plane */
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 4), 1);
    CHECK_EQ(bodies[0], 0);
    CHECK_EQ(carom_overlap_mesh(NULL, &mesh, NULL, bodies, 4), CAROM_ERR_NULL);
    CHECK_EQ(carom_overlap_mesh(world, NULL, NULL, bodies, 4), CAROM_ERR_NULL);
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, NULL, 4), CAROM_ERR_NULL);
    mesh.rotation.c[0] /= 2;
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 4), CAROM_ERR_ARGUMENT);
    mesh = put(&shape[2].mesh, 0, 0, 0);
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 4), CAROM_ERR_ARGUMENT);
    mesh = put(&shape[0].mesh, 4097 * UNIT, 0, 0);
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 4), CAROM_ERR_RANGE);
}

/*
 * A body 1024, 2048 or 4096 units away along any axes: by 32 bits of the coordinates between it and a mesh, q22, q21 or q20, it would
 * be in one place with it. The mesh does not meet it, straight on or turning.
 */
static void test_far(void)
{
    struct carom_mesh_way way = {{{UNIT / 2, UNIT / 4, UNIT / 8}}, {{0, 0, 0}}};
    struct carom_world *world = asked_world(0);
    struct carom_body_state state;
    struct carom_mesh_hit hit;
    uint16_t body;

    shape_box(&shape[0], 12, 4096, 3000, 2000);
    shape_ball(&shape[1], 12, 2000);
    CHECK_EQ(asked_add(world, &shape[1].mesh, true, 0, 0, 0, upright), 0);
    CHECK_EQ(carom_body_get(world, 0, &state), CAROM_OK);
    state.overlap = CAROM_OVERLAP_PASS;
    for (int n = 0; n < 343; n++) {
        static const int away[] = {-4096, -2048, -1024, 0, 1024, 2048, 4096};

        state.position.c[0] = away[n % 7] * UNIT;
        state.position.c[1] = away[n / 7 % 7] * UNIT;
        state.position.c[2] = away[n / 49] * UNIT;
        CHECK_EQ(carom_body_set(world, 0, &state), CAROM_OK);
        for (int mesh = 0; mesh < 2; mesh++) {
            struct carom_query_mesh asked = put(&shape[mesh].mesh, -5 * UNIT / 4, 0, 0);
            const int here = n == 343 / 2;

            way.turn.c[2] = 0;
            CHECK_EQ(carom_cast_mesh(world, &asked, &way, NULL, &workspace, &hit), here);
            way.turn.c[2] = CAROM_ONE_Q30 / 8;
            CHECK_EQ(carom_cast_mesh(world, &asked, &way, NULL, &workspace, &hit), here);
            asked.position.c[0] = 0;
            CHECK_EQ(carom_overlap_mesh(world, &asked, NULL, &body, 1), here);
        }
    }
}

/* Down on a plane, past a box; into the box from the side; away from it and along it. */
static void test_by_hand(void)
{
    struct carom_world *world = asked_world(0);
    struct carom_mesh_way way = {{{0, 0, -8 * UNIT}}, {{0, 0, 0}}};
    struct carom_query_mesh mesh;
    struct carom_mesh_hit hit;
    int64_t gap;

    shape_box(&shape[0], 12, 4096, 4096, 4096);
    shape_box(&shape[1], 12, 2048, 1024, 512);
    shape_plane(&shape[2], 12, 2, 16384);
    CHECK_EQ(asked_add(world, &shape[2].mesh, false, 0, 0, 0, upright), 0);
    CHECK_EQ(asked_add(world, &shape[0].mesh, true, 0, 0, UNIT, upright), 1);
    mesh = put(&shape[1].mesh, 2 * UNIT, UNIT / 32, 6 * UNIT);
    gap = (int64_t)(shape[1].mesh.radius_q22 >> 11) << 9; /* half a skin */
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), 1);
    CHECK_EQ(hit.body, 0);
    CHECK_MORE(hit.normal.c[2], CAROM_ONE_Q30 - 1000);
    CHECK_NEAR(hit.position.c[2], UNIT / 16 + gap, gap / 2);
    CHECK_NEAR(hit.t_q30, CAROM_ONE_Q30 / 128 * 95, CAROM_ONE_Q30 >> 12);
    CHECK_NEAR(hit.point.c[2], 0, gap);
    CHECK_LESS(shape[1].mesh.faces[hit.own_face].normal.c[2], -CAROM_ONE_Q30 + 1000);
    /* sideways */
    mesh.position.c[2] = UNIT;
    way.way = (carom_v3_q32){{-4 * UNIT, 0, 0}};
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), 1);
    CHECK_EQ(hit.body, 1);
    CHECK_MORE(hit.normal.c[0], CAROM_ONE_Q30 - 1000);
    CHECK_MORE(shape[0].mesh.faces[hit.face].normal.c[0], CAROM_ONE_Q30 - 1000);
    CHECK_NEAR(hit.position.c[0], 3 * UNIT / 4, UNIT >> 10);
    CHECK_NEAR(hit.point.c[0], UNIT / 2, UNIT >> 10);
    mesh.position = hit.position; /* from there it may leave and slide, but not go on */
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), 1);
    CHECK_LESS(hit.t_q30, CAROM_ONE_Q30 >> 12);
    way.way = (carom_v3_q32){{UNIT, 0, 0}};
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), 0);
    way.way = (carom_v3_q32){{0, 2 * UNIT, 0}};
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), 0);
    /* a turn about z alone brings the long side round to the box */
    mesh.rotation = (carom_quat_q30){{759250125, 0, 0, 759250125}};
    mesh.position = (carom_v3_q32){{UNIT / 2 + UNIT / 7, UNIT / 50, UNIT}};
    way = (struct carom_mesh_way){{{0, 0, 0}}, {{0, 0, CAROM_ONE_Q30 / 4}}};
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), 1);
    CHECK_EQ(hit.body, 1);
    CHECK_MORE(hit.t_q30, 0);
    CHECK_MORE(hit.rotation.c[3], mesh.rotation.c[3]);
    mesh.position.c[0] = UNIT / 2;
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), CAROM_ERR_OVERLAP);
    CHECK_EQ(carom_cast_mesh(NULL, &mesh, &way, NULL, &workspace, &hit), CAROM_ERR_NULL);
    CHECK_EQ(carom_cast_mesh(world, &mesh, NULL, NULL, &workspace, &hit), CAROM_ERR_NULL);
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, NULL), CAROM_ERR_NULL);
    way.turn.c[0] = 1 << 20;
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), CAROM_ERR_RANGE);
    way = (struct carom_mesh_way){{{600 * UNIT, 0, 0}}, {{0, 0, 0}}};
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), CAROM_ERR_RANGE);
}

/* A box on the way to a box, and a later body behind that one, turned by an eighth: all of the answer is about the first one. */
static void test_before_later(void)
{
    static const carom_quat_q30 eighth = {{992008094, 0, 0, 410903207}};
    const struct carom_mesh_way way = {{{-4 * UNIT, 0, 0}}, {{0, 0, 0}}};
    struct carom_world *world = asked_world(0);
    struct carom_query_mesh mesh;
    struct carom_mesh_hit hit;

    shape_box(&shape[0], 12, 4096, 4096, 4096);
    shape_box(&shape[1], 12, 2048, 1024, 512);
    CHECK_EQ(asked_add(world, &shape[0].mesh, true, 0, 0, 0, upright), 0);
    CHECK_EQ(asked_add(world, &shape[0].mesh, true, -2 * UNIT, 0, 0, eighth), 1);
    mesh = put(&shape[1].mesh, 2 * UNIT, UNIT / 32, 0);
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit), 1);
    CHECK_EQ(hit.body, 0);
    CHECK_MORE(hit.normal.c[0], CAROM_ONE_Q30 - 1000);
    CHECK_MORE(shape[0].mesh.faces[hit.face].normal.c[0], CAROM_ONE_Q30 - 1000);
    CHECK_LESS(shape[1].mesh.faces[hit.own_face].normal.c[0], -CAROM_ONE_Q30 + 1000);
    CHECK_NEAR(hit.point.c[0], UNIT / 2, UNIT >> 10);
}

/*
 * A plane of 256 x 256 units about its middle, and one with its origin far beside and below it, which no place near a body can be
 * measured from: the cast over that one says so, in the first part of the way and before the next body.
 */
static void test_too_large(void)
{
    const struct carom_mesh_way way = {{{0, 0, -3 * UNIT}}, {{0, 0, CAROM_ONE_Q30 / 16}}};
    struct carom_query_mesh mesh;
    struct carom_mesh_hit hit;

    shape_box(&shape[0], 12, 4096, 4096, 4096);
    shape_plane(&shape[2], 7, 2, 16384);
    for (int off = 0; off < 2; off++) {
        struct carom_world *world = asked_world(0);
        const int to[3] = {off * 16383, off * 16383, off * 16000};

        for (uint32_t v = 0; v < shape[2].raw.vertex_count; v++) {
            for (int k = 0; k < 3; k++) {
                shape[2].vertices[v][k] = (int16_t)(shape[2].vertices[v][k] + to[k]);
            }
        }
        CHECK_EQ(
            carom_mesh_build(&shape[2].mesh, &shape[2].raw, shape[2].block, sizeof shape[2].block),
            CAROM_OK);
        CHECK_EQ(asked_add(world, &shape[2].mesh, false, 0, 0, 0, upright), 0);
        CHECK_EQ(asked_add(world, &shape[0].mesh, true, 0, 0, 300 * UNIT, upright), 1);
        mesh = put(&shape[0].mesh, to[0] * (UNIT >> 7) + UNIT / 4, to[1] * (UNIT >> 7),
                   to[2] * (UNIT >> 7) + 2 * UNIT);
        hit.t_q30 = -1;
        CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit),
                 off ? CAROM_ERR_RANGE : 1);
        if (off) {
            CHECK_EQ(hit.t_q30, -1);
        } else { /* it comes down by 3/2 of 3 */
            CHECK_NEAR(hit.t_q30, CAROM_ONE_Q30 / 2, CAROM_ONE_Q30 >> 10);
        }
    }
}

/* --------------------------------------------------------------- random scenes */

static void random_scene(struct carom_world *world, struct test_random *r,
                         struct carom_query_mesh *m, struct carom_mesh_way *way)
{
    int64_t n = test_random_range(r, 2, 4);

    for (int i = 0; i < n; i++) {
        int64_t at[3];

        for (int k = 0; k < 3; k++) {
            at[k] = test_random_range(r, -UNIT, UNIT);
        }
        CHECK_AT_LEAST(asked_add(world, &shape[i].mesh, i != 3, at[0], at[1],
                                 i == 3 ? at[2] - UNIT : at[2], shape_random_turn(r)),
                       0);
    }
    m->mesh = &shape[test_random_range(r, 0, 2)].mesh;
    m->rotation = shape_random_turn(r);
    for (int k = 0; k < 3; k++) {
        int64_t to = test_random_range(r, -UNIT, UNIT);

        m->position.c[k] = test_random_range(r, -4 * UNIT, 4 * UNIT);
        way->way.c[k] = (to - m->position.c[k]) * 3 / 2;
        way->turn.c[k] = (int32_t)test_random_range(r, -(1 << 27), 1 << 27);
        if (r->state & 1 << 20) {
            way->turn.c[k] = 0;
        }
    }
}

/* The pose at a part of the way. */
static struct carom_query_mesh pose_at(const struct carom_query_mesh *m,
                                       const struct carom_mesh_way *way, int32_t t_q30)
{
    struct carom_query_mesh at = *m;
    struct body body;
    struct body_state state;

    CHECK_EQ(query_put(m, &body, &state), CAROM_OK);
    body_place(&body, &state);
    for (int k = 0; k < 3; k++) {
        at.position.c[k] += fix_mul_q30(way->way.c[k], t_q30);
    }
    body.path.u = way->turn;
    body.path.turns = true;
    at.rotation = body_rotation_at(&body, t_q30);
    return at;
}

static void test_random_ways(void)
{
    struct test_random r = {3};
    int met = 0, late = 0, began = 0;

    shape_l(&shape[0], 12, 1500);
    shape_ball(&shape[1], 12, 2400);
    shape_box(&shape[2], 12, 3000, 1800, 700);
    shape_field(&shape[3], 11, 8, 4000, 2500, 6); /* so wide that no mesh enters from its side */
    for (int n = 0; n < WAYS; n++) {
        struct carom_world *world = asked_world(0);
        struct carom_query_mesh mesh, at;
        struct carom_mesh_way way;
        struct carom_mesh_hit hit;
        uint16_t bodies[6];
        uint64_t hash;
        int found;

        random_scene(world, &r, &mesh, &way);
        hash = carom_world_hash(world);
        found = carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit);
        CHECK_EQ(carom_world_hash(world), hash);
        if (found == CAROM_ERR_OVERLAP) {
            CHECK_MORE(carom_overlap_mesh(world, &mesh, NULL, bodies, 6), 0);
            began++;
            continue;
        }
        CHECK_AT_LEAST(found, 0);
        hit.t_q30 = found > 0 ? hit.t_q30 : CAROM_ONE_Q30;
        for (int i = 0; i <= STEPS; i++) {
            at = pose_at(&mesh, &way, (int32_t)((int64_t)hit.t_q30 * i / STEPS));
            CHECK_EQ(carom_overlap_mesh(world, &at, NULL, bodies, 6), 0);
        }
        if (found > 0) {
            int32_t more = CAROM_ONE_Q30 / 512; /* a hundredth of a unit */

            for (int k = 0; k < 3; k++) {
                CHECK_NEAR(at.position.c[k], hit.position.c[k], 1);
            }
            at = pose_at(&mesh, &way,
                         hit.t_q30 < CAROM_ONE_Q30 - more ? hit.t_q30 + more : CAROM_ONE_Q30);
            late += carom_overlap_mesh(world, &at, NULL, bodies, 6) == 0;
            met++;
        }
    }
    CHECK_MORE(met, WAYS / 8);
    CHECK_AT_MOST(began, WAYS * 3 / 4);
    CHECK_AT_MOST(late * 10, met + 10); /* those that graze */
}

/* --------------------------------------------------------------- every feature */

static struct candidate every[EVERY];

/* The path of a mesh on a part of its way (SPEC.md section 5.13). */
static void set_part(struct body *a, const struct body_state *start,
                     const struct carom_mesh_way *way, int32_t from_q30, int32_t to_q30)
{
    body_place(a, start);
    for (int k = 0; k < 3; k++) {
        a->path.v.c[k] = carom_shl(way->way.c[k], 8);
        a->path.u.c[k] = way->turn.c[k];
    }
    a->path.turns = (way->turn.c[0] | way->turn.c[1] | way->turn.c[2]) != 0;
    a->path.u2_q30 = (int32_t)carom_round(carom_dot(a->path.u.c, a->path.u.c), 30);
    if (from_q30 > 0 || to_q30 < CAROM_ONE_Q30) {
        body_cut_path(a, start, from_q30, to_q30);
    }
}

/*
 * The first hit of any feature of the mesh with any feature of a body on a part of the way; true
 * when it is before `best`.
 */
static bool first_of_body(struct body *a, struct body *b, const struct shape *of[2],
                          struct boyse_hit *best, bool found)
{
    static struct boyse_pair pair;
    uint32_t roots = 0, n = shape_candidates(of[0], of[1], 0, every, EVERY);
    bool better = false;

    CHECK_AT_MOST(n, EVERY);
    boyse_pair_init(&pair, a, b);
    for (uint32_t i = 0; i < n; i++) {
        struct boyse_hit hit;

        if (boyse_first(&pair, &every[i], &hit, &roots) && (!found || hit.t_q30 < best->t_q30)) {
            *best = hit;
            best->candidate = every[i];
            found = better = true;
        }
    }
    return better;
}

/* The body that is hit first, or -1; `hit` belongs to the part that begins at `from`. */
static int first_of_all(struct carom_world *world, const struct shape *own,
                        const struct shape *const others[], const struct carom_query_mesh *mesh,
                        const struct carom_mesh_way *way, struct carom_mesh_hit *out)
{
    struct body a;
    struct body_state start;
    struct boyse_hit hit = {0};
    int32_t length_q30;
    int body = -1;

    CHECK_EQ(query_put(mesh, &a, &start), CAROM_OK);
    length_q30 = (int32_t)(2 * fix_length(way->way.c) / ((int64_t)a.def.radius_q22 << 10)) + 1;
    length_q30 = CAROM_ONE_Q30 / length_q30;
    for (int32_t from = 0, to; from < CAROM_ONE_Q30 && body < 0; from = to) {
        to = length_q30 < CAROM_ONE_Q30 - from ? from + length_q30 : CAROM_ONE_Q30;
        set_part(&a, &start, way, from, to);
        for (uint32_t i = 0; i < world->body_count; i++) {
            const struct shape *of[2] = {own, others[i]};
            struct body b = world->bodies[i];

            body_place(&b, &world->now->bodies[i]);
            body = first_of_body(&a, &b, of, &hit, body >= 0) ? (int)i : body;
        }
        out->t_q30 = from + (int32_t)((int64_t)(to - from) * hit.t_q30 >> 30);
    }
    out->face =
        hit.candidate.kind == CANDIDATE_VERTEX_FACE ? (uint16_t)hit.candidate.j : CAROM_NO_FACE;
    out->own_face =
        hit.candidate.kind == CANDIDATE_FACE_VERTEX ? (uint16_t)hit.candidate.j : CAROM_NO_FACE;
    return body;
}

/*
 * The hit is the one that trying all features on all parts gives, bit for bit: neither the order of
 * the search nor what it skips behind the hit changes it.
 */
static void test_every_feature(void)
{
    static const struct shape *const others[3] = {&shape[0], &shape[2], &shape[3]};
    struct test_random r = {31};
    int met = 0;

    shape_l(&shape[0], 12, 1500);
    shape_tetrahedron(&shape[1], 12, 1700);
    shape_box(&shape[2], 12, 3000, 1800, 700);
    shape_field(&shape[3], 11, 6, 1400, 700, 6);
    for (int n = 0; n < EVERY_WAYS; n++) {
        struct carom_world *world = asked_world(0);
        const struct shape *own = &shape[n % 4 == 0 ? 0 : n % 2 + 1];
        struct carom_query_mesh mesh = {&own->mesh, {{0, 0, 0}}, shape_random_turn(&r)};
        struct carom_mesh_way way = {{{0, 0, 0}}, {{0, 0, 0}}};
        struct carom_mesh_hit hit, expected;
        int found, body;

        for (int i = 0; i < 3; i++) {
            CHECK_EQ(asked_add(world, &others[i]->mesh, true, (i - 1) * UNIT / 2, 0, -i * UNIT / 2,
                               i == 2 ? upright : shape_random_turn(&r)),
                     i);
        }
        for (int k = 0; k < 3; k++) {
            mesh.position.c[k] = test_random_range(&r, -UNIT, UNIT) + (k == 2 ? 2 * UNIT : 0);
            way.way.c[k] = test_random_range(&r, -UNIT, UNIT) - (k == 2 ? 5 * UNIT / 2 : 0);
            way.turn.c[k] = n % 5 == 0 ? (int32_t)test_random_range(&r, -(1 << 27), 1 << 27) : 0;
        }
        found = carom_cast_mesh(world, &mesh, &way, NULL, &workspace, &hit);
        if (found == CAROM_ERR_OVERLAP) {
            continue;
        }
        body = first_of_all(world, own, others, &mesh, &way, &expected);
        CHECK_EQ(found, body >= 0);
        if (found == 1 && body >= 0) {
            CHECK_EQ(hit.body, body);
            CHECK_EQ(hit.t_q30, expected.t_q30);
            CHECK(expected.face == CAROM_NO_FACE || hit.face == expected.face);
            CHECK(expected.own_face == CAROM_NO_FACE || hit.own_face == expected.own_face);
            met++;
        }
    }
    CHECK_MORE(met, EVERY_WAYS / 6);
}

/*
 * Two worlds run the same steps; one of them is asked everything between its steps. Both stay
 * equal.
 */
static void test_no_change(void)
{
    struct test_random r = {12};
    struct carom_world *world[2];
    int met = 0;

    shape_box(&shape[0], 12, 4096, 2868, 2048);
    shape_field(&shape[1], 12, 8, 2048, 500, 6);
    shape_ball(&shape[2], 12, 900);
    for (int n = 0; n < 2; n++) {
        world[n] = asked_world(n);
        CHECK_EQ(asked_add(world[n], &shape[1].mesh, false, 0, 0, 0, upright), 0);
        CHECK_EQ(asked_add(world[n], &shape[0].mesh, true, 0, 0, 2 * UNIT, upright), 1);
        CHECK_EQ(asked_add(world[n], &shape[0].mesh, true, UNIT / 3, 0, 4 * UNIT, upright), 2);
    }
    for (int frame = 0; frame < 40; frame++) {
        struct carom_query_mesh mesh = put(&shape[2].mesh, 0, 0, 0);
        struct carom_mesh_way way = {{{0, 0, 0}}, {{1 << 26, 1 << 25, 0}}};
        struct carom_usage usage[2][CAROM_POOL_COUNT];
        struct carom_mesh_hit hit;
        uint16_t bodies[4];
        uint64_t hash = carom_world_hash(world[0]);

        for (int k = 0; k < 3; k++) {
            mesh.position.c[k] = test_random_range(&r, -2 * UNIT, 2 * UNIT);
            way.way.c[k] = test_random_range(&r, -2 * UNIT, 2 * UNIT);
        }
        mesh.position.c[2] += 3 * UNIT;
        way.way.c[2] -= 2 * UNIT;
        met += carom_cast_mesh(world[0], &mesh, &way, NULL, &workspace, &hit) > 0;
        met += carom_overlap_mesh(world[0], &mesh, NULL, bodies, 4) > 0;
        CHECK_EQ(carom_world_hash(world[0]), hash);
        CHECK_EQ(carom_usage(world[0], usage[0]), CAROM_OK);
        CHECK_EQ(carom_usage(world[1], usage[1]), CAROM_OK);
        CHECK_EQ(memcmp(usage[0], usage[1], sizeof usage[0]), 0);
        CHECK_AT_LEAST(carom_world_step(world[0]), 0);
        CHECK_AT_LEAST(carom_world_step(world[1]), 0);
        CHECK_EQ(carom_world_hash(world[0]), carom_world_hash(world[1]));
    }
    CHECK_MORE(met, 5);
}

const struct test tests_query_swept[] = {{"query_swept/overlap", test_overlap},
                                         {"query_swept/too_large", test_too_large},
                                         {"query_swept/by_hand", test_by_hand},
                                         {"query_swept/far", test_far},
                                         {"query_swept/before_later", test_before_later},
                                         {"query_swept/random_ways", test_random_ways},
                                         {"query_swept/every_feature", test_every_feature},
                                         {"query_swept/no_change", test_no_change},
                                         {0}};
