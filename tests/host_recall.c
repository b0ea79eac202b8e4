/* SPDX-License-Identifier: MIT */
/*
 * host_recall - recall of carom_query_faces. The test finds every crossing pair of faces by trying
 * all in exact arithmetic, checks that each is among the query's pairs, and counts how many more
 * the query reports. Poses are random; in every second one the bodies only graze each other.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "lib/box.h"
#include "lib/crossing.h"
#include "lib/lab.h"

#define POSES 1000
#define PAIRS 65536
#define STEPS 64 /* steps on the way to the first pose that touches */

/* Boxes, in quanta of 2^-12 units. */
static int16_t box_vertices[8][3];

static struct carom_mesh_raw make_box(int x, int y, int z)
{
    const int low[3] = {-x / 2, -y / 2, -z / 2}, high[3] = {x / 2, y / 2, z / 2};

    box_corners(box_vertices, low, high);
    return (struct carom_mesh_raw){
        (const int16_t(*)[3])box_vertices, box_faces, 8, 12, 12, CAROM_SOLID};
}

/* A ring about the z axis of 32 x 16 squares. */
#define AROUND 32
#define ACROSS 16
static int16_t torus_vertices[AROUND * ACROSS][3];
static uint16_t torus_faces[2 * AROUND * ACROSS][3];
#define TORUS_RADIUS 0.6
#define TUBE_RADIUS  0.2

static struct carom_mesh_raw make_torus(void)
{
    const double turn = 2 * acos(-1);

    for (int i = 0; i < AROUND; i++) {
        for (int j = 0; j < ACROSS; j++) {
            int v = i * ACROSS + j, right = (i + 1) % AROUND * ACROSS + j;
            int above = i * ACROSS + (j + 1) % ACROSS;
            int both = (i + 1) % AROUND * ACROSS + (j + 1) % ACROSS;
            double r = TORUS_RADIUS + TUBE_RADIUS * cos(turn * j / ACROSS);
            const double p[3] = {r * cos(turn * i / AROUND), r * sin(turn * i / AROUND),
                                 TUBE_RADIUS * sin(turn * j / ACROSS)};
            const int corners[2][3] = {{v, right, both}, {v, both, above}};

            for (int k = 0; k < 3; k++) {
                torus_vertices[v][k] = (int16_t)lab_fixed(p[k], 12);
                torus_faces[2 * v][k] = (uint16_t)corners[0][k];
                torus_faces[2 * v + 1][k] = (uint16_t)corners[1][k];
            }
        }
    }
    return (struct carom_mesh_raw){(const int16_t(*)[3])torus_vertices,
                                   (const uint16_t(*)[3])torus_faces,
                                   AROUND * ACROSS,
                                   2 * AROUND * ACROSS,
                                   12,
                                   CAROM_SOLID};
}

/* --------------------------------------------------------------------- poses */

static struct lab *lab;
static struct carom_body_state state; /* state of the body that is placed */
static struct carom_face_pair pairs[PAIRS];
static uint64_t seed;

static int query(void)
{
    state.overlap = CAROM_OVERLAP_PASS;
    lab_expect(carom_body_set(lab->world, SCENE_BODY, &state), "set");
    return lab_expect(carom_query_faces(lab->world, SCENE_BODY, SCENE_GROUND, pairs, PAIRS),
                      "query");
}

/* The place on a line from a start in a direction. */
static void go(const double start[3], const double way[3], double t)
{
    for (int k = 0; k < 3; k++) {
        state.position.c[k] = lab_fixed(start[k] + t * way[k], 32);
    }
}

/*
 * Move along the line until the bodies touch, narrow that place down to 2^-24 of the line, and move
 * on by `deeper`. The query itself tells where to look; the crossings there come from exact
 * arithmetic.
 */
static void meet(const double start[3], const double way[3], double deeper)
{
    double apart = 0, touching = 1;

    for (int i = 1; i <= STEPS; i++) {
        go(start, way, (double)i / STEPS);
        if (query() > 0) {
            touching = (double)i / STEPS;
            break;
        }
        apart = (double)i / STEPS;
    }
    for (int i = 0; i < 18 && touching > apart; i++) {
        double middle = (apart + touching) / 2;

        go(start, way, middle);
        if (query() > 0) {
            touching = middle;
        } else {
            apart = middle;
        }
    }
    go(start, way, touching + deeper);
}

/*
 * The distance to move past the first touch, as a part of the line: grazing, from 1e-5 on, or deep.
 */
static double depth(int pose)
{
    return pose % 2 ? lab_random(&seed, 0.02, 0.25) : pow(10, lab_random(&seed, -5, -2.5));
}

/* A pose down on the ground, anywhere. */
static void pose_over_ground(int pose)
{
    double start[3] = {lab_random(&seed, -2.5, 2.5), lab_random(&seed, -2.5, 2.5), 3};
    const double way[3] = {0, 0, -4};

    state.rotation = lab_random_turn(&seed);
    meet(start, way, depth(pose));
}

/* A pose on a line from any side through the other body. */
static void pose_from_aside(int pose)
{
    const double along[3] = {0, 0, 3};
    carom_quat_q30 turn = lab_random_turn(&seed);
    double start[3], way[3];

    state.rotation = lab_random_turn(&seed);
    lab_rotate(start, &turn, along);
    for (int k = 0; k < 3; k++) {
        way[k] = -1.5 * start[k];
        start[k] += lab_random(&seed, -0.5, 0.5);
    }
    meet(start, way, depth(pose));
}

/* Two rings that go through each other, moved until they touch. */
static void pose_linked(int pose)
{
    const double start[3] = {TORUS_RADIUS, 0, 0};
    carom_quat_q30 turn = lab_random_turn(&seed);
    const double along[3] = {1, 0, 0};
    double way[3];

    state.rotation = lab_turn(1, lab_random(&seed, -0.2, 0.2), lab_random(&seed, -0.2, 0.2),
                              lab_random(&seed, 1.2, 1.9));
    lab_rotate(way, &turn, along);
    meet(start, way, depth(pose));
}

/* --------------------------------------------------------------------- tests */

static struct crossing_body body_of(const struct carom_mesh *mesh)
{
    return (struct crossing_body){mesh, lab_need(mesh->raw.vertex_count * sizeof(int32_t[3])),
                                  lab_need(mesh->raw.face_count * sizeof(struct crossing_face))};
}

static void free_body(struct crossing_body *body)
{
    free(body->p_q22);
    free(body->near);
}

/* The query with the bodies exchanged finds the same pairs in the same order. */
static bool same_swapped(int count)
{
    static struct carom_face_pair swapped[PAIRS];
    bool same = carom_query_faces(lab->world, SCENE_GROUND, SCENE_BODY, swapped, PAIRS) == count;

    for (int i = 0; i < count && same; i++) {
        same = swapped[i].a == pairs[i].b && swapped[i].b == pairs[i].a;
    }
    return same;
}

static void run(const char *name, struct lab *loaded, void (*pose)(int number))
{
    struct crossing_body a, b;
    struct crossing_tally tally = {0};
    uint8_t *bits;
    bool swaps = true;
    char title[64];

    lab = loaded;
    lab->scene.body.mass_q20 = 1 << 20; /* a needle's own mass is too small */
    lab->scene.body.position.c[2] = (int64_t)20 << 32;
    lab_start(lab);
    state = lab_state(lab->world, SCENE_BODY);
    a = body_of(lab->scene.body.mesh);
    b = body_of(lab->scene.ground.mesh);
    bits = lab_need(CROSSING_BITS(a.mesh->raw.face_count, b.mesh->raw.face_count));
    seed = 1;
    for (int i = 0; i < POSES; i++) {
        const struct carom_body_state ground = lab_state(lab->world, SCENE_GROUND);
        int count;

        pose(i);
        count = query();
        crossing_place(&a, &state.position, &state.rotation, &ground.position);
        crossing_place(&b, &ground.position, &ground.rotation, &ground.position);
        crossing_compare(&a, &b, pairs, (uint32_t)count, bits, &tally);
        swaps = swaps && (b.mesh->raw.kind != CAROM_SURFACE || same_swapped(count));
    }
    snprintf(title, sizeof title, "recall/%s", name);
    lab_report(tally.missed == 0 && tally.repeated == 0 && tally.crossing > 0 && swaps &&
                   2 * tally.touching > tally.poses,
               title, "%u pairs cross in %u of %u poses, %u missed; found %u, precision %.4f",
               tally.crossing, tally.touching, tally.poses, tally.missed, tally.found,
               tally.crossing / (double)tally.found);
    free(bits);
    free_body(&a);
    free_body(&b);
    lab_free(lab);
}

int main(void)
{
    struct carom_mesh_raw mesh;

    run("head", lab_load_scene("head"), pose_over_ground);
    mesh = make_box(4096, 80, 80);
    run("needle", lab_load(&field_mesh, &mesh), pose_over_ground);
    run("plate", lab_load(&field_mesh, &lab_plate), pose_over_ground);
    mesh = make_box(2048, 2048, 2048);
    run("cube", lab_load(&field_mesh, &mesh), pose_over_ground);
    run("heads", lab_load(&head_mesh, &head_mesh), pose_from_aside);
    mesh = make_torus();
    run("torus", lab_load(&mesh, &mesh), pose_linked);
    return lab_finish();
}
