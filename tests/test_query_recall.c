/* SPDX-License-Identifier: MIT */
/*
 * Recall of queries at random poses: they find every crossing pair of faces, which the test finds
 * by trying all in exact arithmetic. Half of the poses are grazing. host_recall.c is the long form.
 */
#include "lib/crossing.h"
#include "lib/real.h"
#include "scene.h"
#include "lib/shapes.h"

#ifdef TEST_LONG
#define POSES       600 /* poses for each two shapes */
#define SCENE_POSES 12
#else
#define POSES       16
#define SCENE_POSES 2
#endif

#define ROOM 4096

static struct shape shape_a, shape_b;
static struct body bodies[2];
static struct body_state states[2];
static struct interfere_leaf leaf;
static struct interfere work = {.leaf = &leaf};
static struct carom_face_pair found[ROOM];

static struct scene scene;

static int32_t corner_a[SCENE_HEAD_VERTICES][3], corner_b[SCENE_FIELD_VERTICES][3];
static struct crossing_face near_a[SCENE_HEAD_FACES], near_b[SCENE_FIELD_FACES];
static struct crossing_body exact_a = {NULL, corner_a, near_a}, exact_b = {NULL, corner_b, near_b};
static uint8_t bits[CROSSING_BITS(SCENE_HEAD_FACES, SCENE_FIELD_FACES)];

static void place_exactly(void)
{
    exact_a.mesh = bodies[0].def.mesh;
    exact_b.mesh = bodies[1].def.mesh;
    crossing_place(&exact_a, &states[0].position, &states[0].rotation, &states[1].position);
    crossing_place(&exact_b, &states[1].position, &states[1].rotation, &states[1].position);
}

/* The middle of a face of b, and a normal there of any length. */
static void face_of_b(uint32_t face, double middle[3], double n[3])
{
    const uint16_t *c = exact_b.mesh->raw.faces[face];
    double u[3], v[3];

    for (int k = 0; k < 3; k++) {
        const double p[3] = {corner_b[c[0]][k], corner_b[c[1]][k], corner_b[c[2]][k]};

        middle[k] = (p[0] + p[1] + p[2]) / 3;
        u[k] = p[1] - p[0];
        v[k] = p[2] - p[0];
    }
    real_cross(n, u, v);
}

/*
 * Both bodies are turned at random, b only if it is solid. Grazing: a's last vertex along the
 * normal of a face of b is in the middle of that face, a little deeper; otherwise by up to a good
 * part of a's size.
 */
static void random_pose(struct test_random *r, bool turn_b, bool grazing)
{
    double middle[3], n[3], lowest = 1e30;
    uint32_t best = 0;
    int64_t off_q22 =
        grazing ? (int64_t)1 << test_random_range(r, 8, 16) : bodies[0].def.radius_q22 / 4;

    states[0].rotation = shape_random_turn(r);
    for (int k = 0; k < 3; k++) {
        states[1].position.c[k] = test_random_range(r, -((int64_t)3000 << 32), (int64_t)3000 << 32);
    }
    if (turn_b) {
        states[1].rotation = shape_random_turn(r);
    }
    states[0].position = states[1].position;
    place_exactly();
    face_of_b((uint32_t)test_random_range(r, 0, exact_b.mesh->raw.face_count - 1), middle, n);
    for (uint32_t v = 0; v < exact_a.mesh->raw.vertex_count; v++) {
        const double p[3] = {corner_a[v][0], corner_a[v][1], corner_a[v][2]};

        best = real_dot(p, n) < lowest ? v : best;
        lowest = real_dot(p, n) < lowest ? real_dot(p, n) : lowest;
    }
    for (int k = 0; k < 3; k++) {
        int64_t deeper_q22 = real_round(n[k] / real_length(n) * real(off_q22, 0));

        states[0].position.c[k] += (real_round(middle[k]) - corner_a[best][k] - deeper_q22 +
                                    test_random_range(r, -off_q22 / 2, off_q22 / 2)) *
                                   1024;
    }
    place_exactly();
}

static void check_recall(uint64_t seed, int poses, bool turn_b)
{
    struct test_random r = {seed};
    struct crossing_tally tally = {0};

    for (int n = 0; n < poses; n++) {
        struct interfere_placed a = {&bodies[0], &states[0]}, b = {&bodies[1], &states[1]};
        int count;

        random_pose(&r, turn_b, n % 2 == 0);
        count = interfere_query(&work, a, b, found, ROOM);
        CHECK_AT_LEAST(count, 0);
        crossing_compare(&exact_a, &exact_b, found, count < 0 ? 0 : (uint32_t)count, bits, &tally);
        CHECK_EQ(tally.missed, 0);
        CHECK_EQ(tally.repeated, 0);
    }
    /* the oracle finds some, and hardly anything else is found */
    CHECK_MORE(2 * tally.touching, tally.poses);
    CHECK_MORE(tally.crossing, tally.poses);
    CHECK_AT_MOST(tally.found - tally.crossing, 2 + tally.crossing / 50);
}

static void make_a(int which)
{
    if (which == 0) {
        shape_box(&shape_a, 12, 4096, 2458, 1228);
    } else if (which == 1) {
        shape_ball(&shape_a, 12, 2048);
    } else {
        shape_l(&shape_a, 12, 2048);
    }
    shape_body(&shape_a, false, &bodies[0], &states[0]);
}

static void check_shapes(uint64_t seed, bool turn_b)
{
    shape_body(&shape_b, false, &bodies[1], &states[1]);
    for (int which = 0; which < 3; which++) {
        make_a(which);
        check_recall(seed + (uint64_t)which, POSES, turn_b);
    }
}

static void test_field(void)
{
    shape_field(&shape_b, 9, 12, 400, 300, 7);
    check_shapes(10, false);
    shape_field(&shape_b, 12, 12, 512, 500, 8);
    check_shapes(20, true);
}

static void test_solid(void)
{
    shape_ball(&shape_b, 11, 1700);
    check_shapes(30, true);
    shape_l(&shape_b, 11, 1500);
    check_shapes(40, true);
}

/* The head on the field, and in another head. */
static void test_head(void)
{
    memset(bodies, 0, sizeof bodies);
    memset(states, 0, sizeof states);
    CHECK_EQ(scene_load(&scene, "head", NULL, shape_scene_block, sizeof shape_scene_block),
             CAROM_OK);
    bodies[0].def.mesh = scene.body.mesh;
    bodies[0].def.radius_q22 = scene.body.mesh->radius_q22;
    bodies[1].def.mesh = scene.ground.mesh;
    states[1].rotation.c[0] = CAROM_ONE_Q30;
    check_recall(50, SCENE_POSES, true);
    bodies[1].def.mesh = scene.body.mesh;
    check_recall(60, SCENE_POSES, true);
}

const struct test tests_query_recall[] = {{"query_recall/field", test_field},
                                          {"query_recall/solid", test_solid},
                                          {"query_recall/head", test_head},
                                          {0}};
