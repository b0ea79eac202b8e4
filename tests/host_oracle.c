/* SPDX-License-Identifier: MIT */
/*
 * host_oracle - the oracle against cases counted by hand, and its sweep against trying every pair.
 * Prints TAP.
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <time.h>

#include "carom.h"
#include "lib/oracle.h"

extern const struct carom_mesh_raw head_mesh, field_mesh;

#define TOLERANCE 1e-9

static struct {
    unsigned count, failed;
} tests;

static void report(bool ok, const char *name)
{
    tests.count++;
    tests.failed += !ok;
    printf("%s %u - oracle/%s\n", ok ? "ok" : "not ok", tests.count, name);
}

/* Whether two numbers agree; prints them when they do not. */
static bool near(double a, double b, double tolerance)
{
    if (fabs(a - b) <= tolerance) {
        return true;
    }
    printf("# %.17g against %.17g\n", a, b);
    return false;
}

static bool found(const struct oracle_crossings *c, size_t pairs, size_t by_a, size_t by_b)
{
    if (c->pairs == pairs && c->by_a == by_a && c->by_b == by_b) {
        return true;
    }
    printf("# pairs %zu, by a %zu, by b %zu; wanted %zu, %zu, %zu\n", c->pairs, c->by_a, c->by_b,
           pairs, by_a, by_b);
    return false;
}

/* -------------------------------------------------------------------- meshes */

/*
 * A cube of side 1 with a corner at the origin. The diagonal of each face joins the corners at
 * which the two coordinates along the face are equal.
 */
static double cube_vertices[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                     {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
static uint32_t cube_faces[12][3] = {{0, 3, 1}, {0, 2, 3}, {4, 5, 7}, {4, 7, 6},
                                     {0, 1, 5}, {0, 5, 4}, {2, 7, 3}, {2, 6, 7},
                                     {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
static const struct oracle_mesh cube = {8, 12, cube_vertices, cube_faces};

/* A plate of 8 x 8 at z = 0; its diagonal is x = y. Face 0 is where x > y. */
static double plate_vertices[4][3] = {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}};
static uint32_t plate_faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
static const struct oracle_mesh plate = {4, 2, plate_vertices, plate_faces};

/* A needle from z = -1, where it is about 0.04 wide, to its tip at z = 1. */
static double needle_vertices[4][3] = {
    {0.02, 0, -1}, {-0.02, 0.01, -1}, {-0.02, -0.01, -1}, {0, 0, 1}};
static uint32_t needle_faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
static const struct oracle_mesh needle = {4, 4, needle_vertices, needle_faces};

static const double upright[4] = {1, 0, 0, 0}, no_centre[3] = {0, 0, 0};

static struct oracle_pose at(double x, double y, double z)
{
    const double position[3] = {x, y, z};

    return oracle_pose_make(position, upright, no_centre);
}

/* ---------------------------------------------------------------- hand cases */

static struct oracle_crossings cubes(double x, double y, double z, double tolerance)
{
    struct oracle_pose a = at(0, 0, 0), b = at(x, y, z);

    return oracle_crossings(&cube, &a, &cube, &b, tolerance);
}

/*
 * Cube b at (0.6, 0.7, 0.8): the surfaces meet in a hexagon. Each side of the hexagon lies in one
 * square of a and one of b. A side is cut once more wherever it crosses a diagonal of either
 * square:
 *
 *   a's face  b's face  side                     crosses a's diagonal  b's diagonal      pairs
 *   x = 1     y = 0.7   z = 0.8 .. 1             z = 0.7: no           z = 1.2: no       1
 *   x = 1     z = 0.8   y = 0.7 .. 1             y = 0.8: yes          y = 1.1: no       2
 *   y = 1     x = 0.6   z = 0.8 .. 1             z = 0.6: no           z = 1.1: no       1
 *   y = 1     z = 0.8   x = 0.6 .. 1             x = 0.8: yes          x = 0.9: yes      3
 *   z = 1     x = 0.6   y = 0.7 .. 1             y = 0.6: no           y = 0.9: yes      2
 *   z = 1     y = 0.7   x = 0.6 .. 1             x = 0.7: yes          x = 0.8: yes      3
 */
static void test_cubes_that_cross(void)
{
    struct oracle_crossings there = cubes(0.6, 0.7, 0.8, TOLERANCE);
    struct oracle_crossings back = cubes(-0.6, -0.7, -0.8, TOLERANCE);

    report(near((double)there.pairs, 12, 0), "cubes_that_cross");
    report(found(&back, there.pairs, there.by_b, there.by_a) &&
               near(back.depth, there.depth, 1e-12),
           "roles_change_places");
}

/* The same two cubes, moved together: nothing may change. */
static void test_moved_together(void)
{
    const double turn[4] = {0.9, -0.5, 0.3, 0.7}, place[3] = {1000, -2000, 30};
    const double apart[3] = {-0.6, -0.7, -0.8}; /* b's corner, taken as the centre of rotation */
    struct oracle_pose a = oracle_pose_make(place, turn, no_centre);
    struct oracle_pose b = oracle_pose_make(place, turn, apart);
    struct oracle_crossings still = cubes(0.6, 0.7, 0.8, TOLERANCE);
    struct oracle_crossings moved = oracle_crossings(&cube, &a, &cube, &b, TOLERANCE);

    report(found(&moved, still.pairs, still.by_a, still.by_b) &&
               near(moved.depth, still.depth, 1e-11),
           "moved_together");
}

/* A quarter turn about z carries x to y, about the centre (1, 0, 0), which goes to (5, 6, 7). */
static void test_turn(void)
{
    const double position[3] = {5, 6, 7}, quarter[4] = {2, 0, 0, 2}, centre[3] = {1, 0, 0};
    struct oracle_pose pose = oracle_pose_make(position, quarter, centre);

    /* the origin is one before the centre along x, and comes to one before it along y */
    report(near(pose.rotation.row[1][0], 1, 1e-15) && near(pose.rotation.row[0][1], -1, 1e-15) &&
               near(pose.rotation.row[2][2], 1, 1e-15) && near(pose.position[0], 5, 1e-14) &&
               near(pose.position[1], 5, 1e-14) && near(pose.position[2], 7, 1e-14),
           "quarter_turn");
}

static void test_cubes_that_do_not_cross(void)
{
    const double places[6][3] = {{1, 0.3, 0.2},   {1, 1, 0.2}, {1, 1, 1},
                                 {1.001, 0.3, 0}, {0, 0, 0},   {0.1, 0.1, 5}};
    const char *names[6] = {"faces_touch", "edges_touch", "corners_touch",
                            "a_gap",       "the_same",    "far_apart"};

    for (int i = 0; i < 6; i++) {
        struct oracle_crossings c = cubes(places[i][0], places[i][1], places[i][2], TOLERANCE);

        report(found(&c, 0, 0, 0) && c.depth == 0, names[i]);
    }
}

static void test_tolerance(void)
{
    struct oracle_crossings fine = cubes(1 - 1e-6, 0.3, 0.2, TOLERANCE);
    struct oracle_crossings coarse = cubes(1 - 1e-6, 0.3, 0.2, 1e-5);

    report(fine.pairs > 0 && near(fine.depth, 1e-6, 1e-12), "shallow_depth");
    report(found(&coarse, 0, 0, 0), "below_the_tolerance");
}

/*
 * Off the plate's diagonal, each of the three long faces has two edges through one face of the
 * plate.
 */
static void test_needle(void)
{
    struct oracle_pose ground = at(0, 0, 0), pose = at(1, -1, 0.3);
    struct oracle_crossings c = oracle_crossings(&needle, &pose, &plate, &ground, TOLERANCE);

    report(found(&c, 3, 3, 0) && c.face_b == 0, "needle_through_plate");
    report(near(c.depth, 0.7, 1e-12), "needle_depth"); /* the tip is 1.3 above the plate, the other
                                                        * end 0.7 below */

    /* The diagonal cuts the needle's section and leaves one corner, with x > y, on face 0. So two
     * of the long faces cross both faces of the plate, and the diagonal pierces these two. */
    pose = at(1, 1, 0);
    c = oracle_crossings(&needle, &pose, &plate, &ground, TOLERANCE);
    report(found(&c, 5, 5, 4), "needle_through_diagonal");

    pose = at(1, -1, 1.001);
    c = oracle_crossings(&needle, &pose, &plate, &ground, TOLERANCE);
    report(found(&c, 0, 0, 0), "needle_above_plate");

    pose = at(4.5, 0, 0);
    c = oracle_crossings(&needle, &pose, &plate, &ground, TOLERANCE);
    report(found(&c, 0, 0, 0), "needle_beside_plate");
}

/* The edge p q through the face (0, 0, 0), (4, 0, 0), (0, 4, 0). */
static double through_face(const double p[3], const double q[3])
{
    const double a[3] = {0, 0, 0}, b[3] = {4, 0, 0}, c[3] = {0, 4, 0};

    return oracle_piercing(p, q, a, b, c);
}

static void test_piercing(void)
{
    const double up[3] = {1, 1, 0.7}, down[3] = {1, 1, -0.3}, on[3] = {1, 1, 0};
    const double rim_up[3] = {1, 0.125, 1}, rim_down[3] = {1, 0.125, -1};
    const double out_up[3] = {2.5, 2.5, 1}, out_down[3] = {2.5, 2.5, -1};
    const double slant_up[3] = {0, 1, 1}, slant_down[3] = {2, 1, -1}; /* meets the plane at 1, 1 */

    report(near(through_face(up, down), 0.3, 1e-15) && near(through_face(down, up), 0.3, 1e-15),
           "depth_along_the_normal");
    report(near(through_face(rim_up, rim_down), 0.125, 1e-15), "depth_to_the_border");
    report(near(through_face(slant_up, slant_down), 1, 1e-15), "slanting_edge");
    report(through_face(out_up, out_down) <= 0, "beside_the_face");
    report(through_face(up, on) <= 0, "end_on_the_plane");
    report(through_face(up, slant_up) <= 0, "above_the_face");
}

/* ------------------------------------------------------------------ the sweep */

struct triangle {
    double corner[3][3];
};

static struct triangle triangle_at(const struct oracle_mesh *mesh, const struct oracle_pose *pose,
                                   size_t face)
{
    struct triangle t;

    for (int i = 0; i < 3; i++) {
        const double *v = mesh->vertices[mesh->faces[face][i]];

        for (int k = 0; k < 3; k++) {
            t.corner[i][k] = pose->position[k];
            for (int j = 0; j < 3; j++) {
                t.corner[i][k] += pose->rotation.row[k][j] * v[j];
            }
        }
    }
    return t;
}

/* Whether an edge of one triangle pierces the other. */
static bool pierces(const struct triangle *edges, const struct triangle *face)
{
    for (int k = 0; k < 3; k++) {
        if (oracle_piercing(edges->corner[k], edges->corner[(k + 1) % 3], face->corner[0],
                            face->corner[1], face->corner[2]) > TOLERANCE) {
            return true;
        }
    }
    return false;
}

/* Crossing face pairs, found by trying every pair. */
static size_t try_every_pair(const struct oracle_mesh *a, const struct oracle_pose *pose_a,
                             const struct oracle_mesh *b, const struct oracle_pose *pose_b)
{
    size_t pairs = 0;

    for (size_t i = 0; i < a->face_count; i++) {
        const struct triangle face_a = triangle_at(a, pose_a, i);

        for (size_t j = 0; j < b->face_count; j++) {
            const struct triangle face_b = triangle_at(b, pose_b, j);

            pairs += pierces(&face_a, &face_b) || pierces(&face_b, &face_a);
        }
    }
    return pairs;
}

static double random_unit(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / (1 << 24);
}

static void test_sweep_on_cubes(void)
{
    uint32_t state = 1;
    size_t wrong = 0, crossing = 0;

    for (int i = 0; i < 2000; i++) {
        double position[3], turn[4];
        struct oracle_pose a = at(0, 0, 0), b;
        struct oracle_crossings c;

        for (int k = 0; k < 4; k++) {
            turn[k] = random_unit(&state) - 0.5;
        }
        for (int k = 0; k < 3; k++) {
            position[k] = 3 * random_unit(&state) - 1.5;
        }
        b = oracle_pose_make(position, turn, no_centre);
        c = oracle_crossings(&cube, &a, &cube, &b, TOLERANCE);
        wrong += c.pairs != try_every_pair(&cube, &a, &cube, &b);
        crossing += c.pairs > 0;
    }
    printf("# %zu of 2000 poses cross\n", crossing);
    report(wrong == 0 && crossing > 200 && crossing < 1800, "sweep_finds_every_pair");
}

/* ------------------------------------------------------------ near and inside */

/*
 * Cubes that are turned alike: their distance is that of aligned boxes, known by its three parts.
 */
static void test_near(void)
{
    uint32_t state = 7;
    size_t wrong = 0, near_count = 0;

    for (int i = 0; i < 3000; i++) {
        double turn[4], apart[3], place[3] = {0}, distance = 0, limit = 0.5 * random_unit(&state);
        struct oracle_pose a, b;

        for (int k = 0; k < 4; k++) {
            turn[k] = random_unit(&state) - 0.5;
        }
        for (int k = 0; k < 3; k++) {
            double gap;

            apart[k] = 3 * random_unit(&state) - 1.5;
            gap = fabs(apart[k]) - 1;
            distance += gap > 0 ? gap * gap : 0;
        }
        a = oracle_pose_make(no_centre, turn, no_centre);
        for (int k = 0; k < 3; k++) {
            for (int j = 0; j < 3; j++) {
                place[k] += a.rotation.row[k][j] * apart[j];
            }
        }
        b = oracle_pose_make(place, turn, no_centre);
        wrong += oracle_near(&cube, &a, &cube, &b, limit) != (sqrt(distance) <= limit);
        near_count += sqrt(distance) <= limit;
    }
    printf("# %zu of 3000 pairs are near\n", near_count);
    report(wrong == 0 && near_count > 500 && near_count < 2500, "near");
}

static void test_inside(void)
{
    uint32_t state = 9;
    size_t wrong = 0;

    for (int i = 0; i < 1000; i++) {
        double p[3];
        bool in = true;

        for (int k = 0; k < 3; k++) {
            p[k] = 2 * random_unit(&state) - 0.5;
            in = in && p[k] > 0 && p[k] < 1;
        }
        wrong += oracle_inside(&cube, p) != in;
        for (int k = 0; k < 3; k++) {
            p[k] = 12 * random_unit(&state) - 6;
        }
        wrong += oracle_under(&plate, p) != (fabs(p[0]) < 4 && fabs(p[1]) < 4 && p[2] < 0);
    }
    report(wrong == 0, "inside_and_under");
}

static struct oracle_mesh doubles_of(const struct carom_mesh_raw *raw)
{
    return oracle_mesh_make(raw->vertices, raw->vertex_count, raw->faces, raw->face_count,
                            raw->quantum_bits);
}

/* The paper's head on its field: the same pairs as by trying all, and fast enough for long runs. */
static void test_head_on_field(void)
{
    struct oracle_mesh head = doubles_of(&head_mesh), field = doubles_of(&field_mesh);
    struct oracle_pose ground = at(0, 0, 0), above = at(0.3, -0.2, 3), within = at(0.3, -0.2, 1.2);
    struct oracle_crossings none, some = {0};
    clock_t start;
    double milliseconds;

    none = oracle_crossings(&head, &above, &field, &ground, TOLERANCE);
    report(found(&none, 0, 0, 0), "head_above_field");
    start = clock();
    for (int i = 0; i < 100; i++) {
        some = oracle_crossings(&head, &within, &field, &ground, TOLERANCE);
    }
    milliseconds = (double)(clock() - start) / CLOCKS_PER_SEC * 1000 / 100;
    printf("# %zu pairs to a depth of %.3g in %.2f ms\n", some.pairs, some.depth, milliseconds);
    report(some.pairs > 0 && some.pairs == try_every_pair(&head, &within, &field, &ground),
           "head_in_field");
    oracle_mesh_free(&head);
    oracle_mesh_free(&field);
}

/* --------------------------------------------------------------------- energy */

/* A box of 3 x 2 x 1 and mass 2: inertia by mass 5/12, 10/12, 13/12. */
static void test_energy(void)
{
    const double gravity[3] = {0, 0, -0.5};
    struct oracle_body box = {.mass = 2,
                              .inertia = {5. / 12, 10. / 12, 13. / 12, 0, 0, 0},
                              .position = {7, 7, 4},
                              .quaternion = {1, 0, 0, 0},
                              .velocity = {1, 2, 2},
                              .spin = {0, 0, 2}};

    report(near(oracle_energy(&box, gravity), 9 + 13. / 3 + 4, 1e-14), "energy");
    box.quaternion[1] = 1; /* a quarter turn about x: the box's y is up */
    report(near(oracle_energy(&box, gravity), 9 + 10. / 3 + 4, 1e-14), "energy_turned");
}

int main(void)
{
    test_cubes_that_cross();
    test_moved_together();
    test_turn();
    test_cubes_that_do_not_cross();
    test_tolerance();
    test_needle();
    test_piercing();
    test_sweep_on_cubes();
    test_near();
    test_inside();
    test_head_on_field();
    test_energy();
    printf("1..%u\n", tests.count);
    return tests.failed != 0;
}
