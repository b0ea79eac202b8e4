/* SPDX-License-Identifier: MIT */
/*
 * Meshes that are in no world: what they overlap, and what they meet on a way. A way is held against poses on it:
 * up to the hit nothing is crossed, and a little later something is.
 */
#include <string.h>

#include "query/query.h"
#include "shapes.h"
#include "test.h"

#ifdef TEST_LONG
#define WAYS  1500
#define STEPS 40
#else
#define WAYS  8
#define STEPS 8
#endif

#define CAPS 6, 15, 64, 256, 64, 64
#define UNIT ((int64_t)1 << 32)

static _Alignas(8) uint8_t block[2][CAROM_WORLD_BYTES(CAPS)];
static struct shape shape[4];
static const carom_quat_q30 upright = {{CAROM_ONE_Q30, 0, 0, 0}};

static struct carom_world *make_world(int n)
{
    const struct carom_config config = {.caps = CAROM_CAPS(CAPS),
                                        .gravity = {{0, 0, -((int64_t)1 << 31)}}};
    struct carom_world *world = NULL;

    CHECK_EQ(carom_world_init(block[n], sizeof block[n], &config, &world), CAROM_OK);
    return world;
}

static int add(struct carom_world *world, const struct carom_mesh *mesh, bool moving, int64_t x,
               int64_t y, int64_t z, carom_quat_q30 turn)
{
    struct carom_body_def def;

    memset(&def, 0, sizeof def);
    def.mesh = mesh;
    def.overlap = CAROM_OVERLAP_PASS; /* bodies lie as chance has it */
    def.stationary = !moving;
    def.position = (carom_v3_q32){{x, y, z}};
    def.rotation = turn;
    def.restitution_q30 = CAROM_ONE_Q30 / 2;
    return carom_body_add(world, &def);
}

static struct carom_query_mesh put(const struct carom_mesh *mesh, int64_t x, int64_t y, int64_t z)
{
    return (struct carom_query_mesh){mesh, {{x, y, z}}, upright};
}

/* ------------------------------------------------------------------- by hand */

static void test_overlap(void)
{
    struct carom_world *world = make_world(0);
    struct carom_query_mesh mesh;
    uint16_t bodies[4];

    shape_box(&shape[0], 12, 4096, 4096, 4096);
    shape_box(&shape[1], 12, 512, 512, 512);
    shape_plane(&shape[2], 12, 2, 16384);
    CHECK_EQ(add(world, &shape[2].mesh, false, 0, 0, 0, upright), 0);
    CHECK_EQ(add(world, &shape[0].mesh, true, 0, 0, 2 * UNIT, upright), 1);
    CHECK_EQ(add(world, &shape[1].mesh, true, UNIT, 0, 2 * UNIT, upright), 2);
    /* between both boxes: touches neither, then the one, then both; inside the one; around the other */
    mesh = put(&shape[1].mesh, 3 * UNIT / 4 - UNIT / 512, 0, 2 * UNIT);
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 4), 0);
    mesh.position.c[0] = UNIT / 2;
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 4), 1);
    CHECK_EQ(bodies[0], 1);
    mesh.position.c[0] = 0;
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 4), 1);
    mesh = put(&shape[0].mesh, 3 * UNIT / 4, UNIT / 16, 2 * UNIT);
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 4), 2);
    CHECK(bodies[0] == 1 && bodies[1] == 2);
    CHECK_EQ(carom_overlap_mesh(world, &mesh, NULL, bodies, 1), CAROM_ERR_BODIES_FULL);
    CHECK_EQ(bodies[0], 1);
    mesh = put(&shape[0].mesh, UNIT, UNIT / 16, -7 * UNIT); /* under the plane */
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

/* Down on a plane, past a box; into the box from the side; away from it and along it. */
static void test_by_hand(void)
{
    struct carom_world *world = make_world(0);
    struct carom_mesh_way way = {{{0, 0, -8 * UNIT}}, {{0, 0, 0}}};
    struct carom_query_mesh mesh;
    struct carom_mesh_hit hit;
    int64_t gap;

    shape_box(&shape[0], 12, 4096, 4096, 4096);
    shape_box(&shape[1], 12, 2048, 1024, 512);
    shape_plane(&shape[2], 12, 2, 16384);
    CHECK_EQ(add(world, &shape[2].mesh, false, 0, 0, 0, upright), 0);
    CHECK_EQ(add(world, &shape[0].mesh, true, 0, 0, UNIT, upright), 1);
    mesh = put(&shape[1].mesh, 2 * UNIT, UNIT / 32, 6 * UNIT);
    gap = (int64_t)(shape[1].mesh.radius_q22 >> 11) << 9; /* half a skin */
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &hit), 1);
    CHECK(hit.body == 0 && hit.normal.c[2] > CAROM_ONE_Q30 - 1000);
    CHECK_NEAR(hit.position.c[2], UNIT / 16 + gap, gap / 2);
    CHECK_NEAR(hit.t_q30, CAROM_ONE_Q30 / 128 * 95, CAROM_ONE_Q30 >> 12);
    CHECK_NEAR(hit.point.c[2], 0, gap);
    CHECK(shape[1].mesh.faces[hit.own_face].normal.c[2] < -CAROM_ONE_Q30 + 1000);
    /* sideways */
    mesh.position.c[2] = UNIT;
    way.way = (carom_v3_q32){{-4 * UNIT, 0, 0}};
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &hit), 1);
    CHECK(hit.body == 1 && hit.normal.c[0] > CAROM_ONE_Q30 - 1000);
    CHECK(shape[0].mesh.faces[hit.face].normal.c[0] > CAROM_ONE_Q30 - 1000);
    CHECK_NEAR(hit.position.c[0], 3 * UNIT / 4, UNIT >> 10);
    CHECK_NEAR(hit.point.c[0], UNIT / 2, UNIT >> 10);
    mesh.position = hit.position; /* there it may leave and slide, not go on */
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &hit), 1);
    CHECK(hit.t_q30 < CAROM_ONE_Q30 >> 12);
    way.way = (carom_v3_q32){{UNIT, 0, 0}};
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &hit), 0);
    way.way = (carom_v3_q32){{0, 2 * UNIT, 0}};
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &hit), 0);
    /* a turn about z alone: the long side comes round to the box */
    mesh.rotation = (carom_quat_q30){{759250125, 0, 0, 759250125}};
    mesh.position = (carom_v3_q32){{UNIT / 2 + UNIT / 7, UNIT / 50, UNIT}};
    way = (struct carom_mesh_way){{{0, 0, 0}}, {{0, 0, CAROM_ONE_Q30 / 4}}};
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &hit), 1);
    CHECK(hit.body == 1 && hit.t_q30 > 0 && hit.rotation.c[3] > mesh.rotation.c[3]);
    mesh.position.c[0] = UNIT / 2;
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &hit), CAROM_ERR_OVERLAP);
    CHECK_EQ(carom_cast_mesh(NULL, &mesh, &way, NULL, &hit), CAROM_ERR_NULL);
    CHECK_EQ(carom_cast_mesh(world, &mesh, NULL, NULL, &hit), CAROM_ERR_NULL);
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, NULL), CAROM_ERR_NULL);
    way.turn.c[0] = 1 << 20;
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &hit), CAROM_ERR_RANGE);
    way = (struct carom_mesh_way){{{600 * UNIT, 0, 0}}, {{0, 0, 0}}};
    CHECK_EQ(carom_cast_mesh(world, &mesh, &way, NULL, &hit), CAROM_ERR_RANGE);
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
        CHECK(add(world, &shape[i].mesh, i != 3, at[0], at[1], i == 3 ? at[2] - UNIT : at[2],
                  shape_random_turn(r)) >= 0);
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
    shape_field(&shape[3], 11, 8, 4000, 2500, 6); /* so wide that none comes in from its side */
    for (int n = 0; n < WAYS; n++) {
        struct carom_world *world = make_world(0);
        struct carom_query_mesh mesh, at;
        struct carom_mesh_way way;
        struct carom_mesh_hit hit;
        uint16_t bodies[6];
        uint64_t hash;
        int found;

        random_scene(world, &r, &mesh, &way);
        hash = carom_world_hash(world);
        found = carom_cast_mesh(world, &mesh, &way, NULL, &hit);
        CHECK(carom_world_hash(world) == hash);
        if (found == CAROM_ERR_OVERLAP) {
            CHECK(carom_overlap_mesh(world, &mesh, NULL, bodies, 6) > 0);
            began++;
            continue;
        }
        CHECK(found >= 0);
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
    CHECK(met > WAYS / 8 && began <= WAYS * 3 / 4);
    CHECK(late * 10 <= met + 10); /* those that graze */
}

/* Of two worlds that do the same one is asked everything between its steps. */
static void test_no_change(void)
{
    struct test_random r = {12};
    struct carom_world *world[2];
    int met = 0;

    shape_box(&shape[0], 12, 4096, 2868, 2048);
    shape_field(&shape[1], 12, 8, 2048, 500, 6);
    shape_ball(&shape[2], 12, 900);
    for (int n = 0; n < 2; n++) {
        world[n] = make_world(n);
        CHECK_EQ(add(world[n], &shape[1].mesh, false, 0, 0, 0, upright), 0);
        CHECK_EQ(add(world[n], &shape[0].mesh, true, 0, 0, 2 * UNIT, upright), 1);
        CHECK_EQ(add(world[n], &shape[0].mesh, true, UNIT / 3, 0, 4 * UNIT, upright), 2);
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
        met += carom_cast_mesh(world[0], &mesh, &way, NULL, &hit) > 0;
        met += carom_overlap_mesh(world[0], &mesh, NULL, bodies, 4) > 0;
        CHECK(carom_world_hash(world[0]) == hash);
        CHECK_EQ(carom_usage(world[0], usage[0]), CAROM_OK);
        CHECK_EQ(carom_usage(world[1], usage[1]), CAROM_OK);
        CHECK_EQ(memcmp(usage[0], usage[1], sizeof usage[0]), 0);
        CHECK(carom_world_step(world[0]) >= 0 && carom_world_step(world[1]) >= 0);
        CHECK(carom_world_hash(world[0]) == carom_world_hash(world[1]));
    }
    CHECK(met > 5);
}

const struct test tests_swept[] = {{"swept/overlap", test_overlap},
                                   {"swept/by_hand", test_by_hand},
                                   {"swept/random_ways", test_random_ways},
                                   {"swept/no_change", test_no_change},
                                   {0}};
