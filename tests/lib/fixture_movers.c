/* SPDX-License-Identifier: MIT */
/* A screw in its nut, dominoes, knives on ridges, and a solid that stands on one face only. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "fixture.h"
#include "real.h"

/* ------------------------------------------------------------------- a screw */

#define PITCH 0.5
#define PLAY  0.012

/*
 * The nut's thread is the bolt's with some play. The bolt starts one pitch deep in the nut and goes
 * down by its weight, without friction.
 */
static void make_screw(struct fixture *f)
{
    struct fixture_thread bolt = {PITCH, {0, 0.06, 0.19, 0.25}, {0.33, 0.45, 0.45, 0.33}, 24, 28};
    struct fixture_thread nut = {PITCH,
                                 {-PLAY, 0.06 - PLAY, 0.19 + PLAY, 0.25 + PLAY},
                                 {0.33 + PLAY, 0.45 + PLAY, 0.45 + PLAY, 0.33 + PLAY},
                                 24,
                                 8};

    fixture_shape_nut(&f->shape, &nut, 1.2);
    fixture_fixed(f, fixture_mesh(f), 0, 0, 0, fixture_upright);
    fixture_shape_bolt(&f->shape, &bolt);
    fixture_body(f, fixture_mesh(f), 0, 0, -PITCH, fixture_upright);
}

/* Add up the screw's turn frame by frame. */
static void watch_screw(struct fixture *f)
{
    f->mark[0] += f->bodies[1].now.spin[2];
}

/*
 * Without losses the bolt falls at g / (1 + (turn / pitch)^2 inertia / mass). It must fall at least
 * half of that way, and way and turn must agree within the play.
 */
static bool judge_screw(struct fixture *f)
{
    const struct fixture_body *bolt = &f->bodies[1];
    double gear = 2 * REAL_PI / PITCH, n = (double)f->tally.frames;
    double ideal = FIXTURE_G / (1 + gear * gear * bolt->now.inertia[2]) * n * n / 2;
    double way = bolt->first.position[2] - bolt->now.position[2];
    double strays = fabs(way - fabs(f->mark[0]) / gear);

    fixture_say(f, "goes %.3f, %.2f turns, %.2f of the ideal way", way, f->mark[0] / (2 * REAL_PI),
                way / ideal);
    return way > ideal / 2 && strays < 3 * PLAY + 0.02 * way && bolt->now.spin[2] < 0;
}

/* ------------------------------------------------------------------ dominoes */

#define TALL  1.0
#define THICK 0.15
#define EVERY 0.45

static void make_dominoes(struct fixture *f)
{
    const double spin = 2.5, velocity[3] = {spin * TALL / 2, 0, spin * THICK / 2},
                 turning[3] = {0, spin, 0};
    int mesh;

    fixture_plane(f);
    fixture_shape_box(&f->shape, THICK, 0.5, TALL);
    mesh = fixture_mesh(f);
    for (int i = 0; i < f->scene->n; i++) {
        fixture_body(f, mesh, i * EVERY - 5, 0, TALL / 2 + fixture_skin(f, mesh), fixture_upright);
    }
    /* about its front lower edge */
    fixture_throw(f, 1, velocity, turning);
}

static bool judge_dominoes(struct fixture *f)
{
    int fallen = 0;
    double last = fixture_tilt(f, f->scene->n, 2);

    for (int i = 1; i <= f->scene->n; i++) {
        fallen += fixture_tilt(f, i, 2) > REAL_PI / 4;
    }
    fixture_say(f, "%d of %d fell, the last by %.0f degrees", fallen, f->scene->n,
                last * 180 / REAL_PI);
    return fallen == f->scene->n && last > 80 * REAL_PI / 180;
}

/* -------------------------------------------------------------------- knives */

/*
 * A prism over a triangle from y = -half to half, in so many pieces, so that its edges have
 * vertices.
 */
static int piecewise(struct fixture *f, const double corner[3][2], double half, int pieces)
{
    struct fixture_shape *s = &f->shape;

    fixture_shape_begin(s);
    for (int i = 0; i <= pieces; i++) {
        for (int k = 0; k < 3; k++) {
            fixture_shape_vertex(s, corner[k][0], (2.0 * i / pieces - 1) * half, corner[k][1]);
        }
    }
    fixture_shape_face(s, 0, 1, 2);
    fixture_shape_face(s, 3 * pieces, 3 * pieces + 2, 3 * pieces + 1);
    for (int i = 0; i < 3 * pieces; i++) {
        int next = i % 3 == 2 ? i - 2 : i + 1;

        fixture_shape_quad(s, i, i + 3, next + 3, next);
    }
    return fixture_mesh(f);
}

static const double blade_corner[3][2] = {{0, 0}, {0.06, 0.4}, {-0.06, 0.4}};
static const double ridge_corner[3][2] = {{0, 0}, {-0.5, -0.5}, {0.5, -0.5}};

/*
 * Its edge is along the ridge, up to `value` radians. When edges are in pieces, it leans by 40
 * times as much.
 */
static void make_knife(struct fixture *f)
{
    const double velocity[3] = {0, 10, 0}, none[3] = {0};
    int mesh, knife, pieces = f->scene->n;

    fixture_fixed(f, piecewise(f, ridge_corner, 12, pieces), 0, 0, 0, fixture_upright);
    mesh = piecewise(f, blade_corner, 0.5, 1 + pieces / 8);
    knife = fixture_body(f, mesh, 0, -6, fixture_skin(f, mesh),
                         fixture_compose(lab_turn(0, 0, 1, f->scene->value),
                                         lab_turn(0, 1, 0, pieces > 1 ? 40 * f->scene->value : 0)));
    fixture_throw(f, knife, velocity, none);
    f->mark[0] = knife;
}

/* Its edge lies across two ridges. */
static void make_skate(struct fixture *f)
{
    const double velocity[3] = {0, 10, 0}, none[3] = {0};
    int mesh = piecewise(f, ridge_corner, 12, f->scene->n), knife;

    fixture_fixed(f, mesh, -0.3, 0, 0, fixture_upright);
    fixture_fixed(f, mesh, 0.3, 0, 0, fixture_upright);
    mesh = piecewise(f, blade_corner, 0.5, 1);
    knife = fixture_body(f, mesh, 0, -6, fixture_skin(f, mesh), lab_turn(0, 0, 1, acos(-1) / 2));
    fixture_throw(f, knife, velocity, none);
    f->mark[0] = knife;
}

/*
 * Only friction pushes along the ridge. As long as the knife stands, both sides of the ridge press
 * on it at 45 degrees, with 1.41 times its weight. When it begins to fall they press less.
 */
static bool judge_knife(struct fixture *f)
{
    const struct fixture_body *knife = &f->bodies[(int)f->mark[0]];
    double way = knife->now.position[1] - knife->first.position[1], n = (double)f->tally.frames;
    double free = 10 * n / 60,
           least = free - 1.01 * sqrt(2) * f->scene->mu * FIXTURE_G * n * (n + 1) / 2;
    double most = free - 0.8 * f->scene->mu * FIXTURE_G * n * (n - 1) / 2;

    fixture_say(f, "slides %.3f of %.3f to %.3f", way, least, most);
    return way > least - 0.01 && way < most + 0.01;
}

/* -------------------------------------------------------------------- gomboc */

/* The plane of face n, seen from the middle: its normal and its distance. */
static double plane_of(const struct oracle_mesh *mesh, size_t n, const double centre[3],
                       double normal[3])
{
    double side[2][3], from[3], length;

    for (int k = 0; k < 3; k++) {
        const double *corner = mesh->vertices[mesh->faces[n][0]];

        side[0][k] = mesh->vertices[mesh->faces[n][1]][k] - corner[k];
        side[1][k] = mesh->vertices[mesh->faces[n][2]][k] - corner[k];
        from[k] = corner[k] - centre[k];
    }
    real_cross(normal, side[0], side[1]);
    length = real_length(normal);
    for (int k = 0; k < 3; k++) {
        normal[k] /= length;
    }
    return real_dot(normal, from);
}

/*
 * The largest distance, within the plane of face n, from a line in which another face's plane cuts
 * it, outwards to the foot of the middle.
 */
static double beyond(const struct oracle_mesh *mesh, size_t n, const double centre[3])
{
    double normal[3], height = plane_of(mesh, n, centre, normal), most = -HUGE_VAL;

    for (size_t i = 0; i < mesh->face_count; i++) {
        double other[3], at = plane_of(mesh, i, centre, other), cosine = real_dot(other, normal);

        if (cosine < 1 - 1e-5) {
            most = fmax(most, (height * cosine - at) / sqrt(1 - cosine * cosine));
        }
    }
    return most;
}

/*
 * The single face on which a convex solid stands: the foot of its centre of mass lies on that face.
 * For all other faces the foot must be outside by a margin, a part of the radius.
 */
static size_t only_face(const struct fixture *f, int mesh_number, double *margin)
{
    const struct fixture_mesh *mesh = &f->meshes[mesh_number];
    double centre[3], normal[3], down[3] = {0};
    size_t found = mesh->solid.face_count;

    lab_weigh(&mesh->solid, centre);
    *margin = HUGE_VAL;
    for (size_t n = 0; n < mesh->solid.face_count; n++) {
        double out = beyond(&mesh->solid, n, centre) / mesh->radius;

        plane_of(&mesh->solid, n, centre, normal);
        if (out > 0) {
            *margin = fmin(*margin, out);
        } else if (found == mesh->solid.face_count || real_dot(down, normal) > 1 - 1e-5) {
            found = n;
            plane_of(&mesh->solid, n, centre, down);
        } else {
            *margin = 0;
        }
    }
    return found;
}

/*
 * Turned away from its standing pose by so many degrees, about its length, or across it if n is
 * odd; the fine solid from n = 2.
 */
static void make_gomboc(struct fixture *f)
{
    double margin, low = HUGE_VAL;
    carom_quat_q30 turn;
    size_t face;
    int mesh;

    fixture_plane(f);
    fixture_shape_monostable(&f->shape, f->scene->n >= 2);
    for (uint32_t v = 0; v < f->shape.vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            f->shape.p[v][k] *= 0.39; /* uses the range of quanta well */
        }
    }
    mesh = fixture_mesh(f);
    face = only_face(f, mesh, &margin);
    fixture_say(f, "margin %.4f r", margin);
    if (face == f->meshes[mesh].solid.face_count || margin < 0.001) {
        printf("Bail out! the solid stands on more than one face: %s\n", f->said);
        exit(1);
    }
    turn = lab_turn(f->scene->n % 2, 1 - f->scene->n % 2, 0, f->scene->value * REAL_PI / 180);
    for (size_t v = 0; v < f->meshes[mesh].solid.vertex_count; v++) {
        double at[3];

        lab_rotate(at, &turn, f->meshes[mesh].solid.vertices[v]);
        low = fmin(low, at[2]);
    }
    fixture_body(f, mesh, 0, 0, 2 * fixture_skin(f, mesh) - low, turn);
}

/* Its ridge is up again, and its standing face looks down. */
static bool judge_gomboc(struct fixture *f)
{
    double angle = acos(fmin(1, f->bodies[1].pose.rotation.row[2][2])) * 180 / REAL_PI;

    fixture_say(f, "%.1f degrees from standing, %.3f/s", angle, fixture_fastest(f));
    return angle < 2 && fixture_fastest(f) < 0.05;
}

#define DOWN "turns down"
#define FALL "all fall"
#define ON   "slides on"
#define UP   "rights itself"
const struct fixture_scene fixture_movers[] = {
    {"screw", DOWN, 105, 105, make_screw, watch_screw, judge_screw, 0, 0, 0},
    {"dominoes", FALL, 500, 500, make_dominoes, NULL, judge_dominoes, 20, 0, 0.5},
    {"dominoes5", FALL, 300, 300, make_dominoes, NULL, judge_dominoes, 5, 0, 0.5},
    {"knife", ON, 60, 60, make_knife, NULL, judge_knife, 1, 0, 0},
    {"knife-pieces", ON, 60, 60, make_knife, NULL, judge_knife, 24, 0, 0},
    {"knife-rough", ON, 60, 60, make_knife, NULL, judge_knife, 24, 0, 0.3},
    {"knife-yawed", ON, 60, 60, make_knife, NULL, judge_knife, 1, 1e-3, 0},
    {"knife-leaning", ON, 60, 60, make_knife, NULL, judge_knife, 24, 1e-3, 0},
    {"knife-across", ON, 60, 60, make_skate, NULL, judge_knife, 24, 0, 0},
    {"knife-across-rough", ON, 60, 60, make_skate, NULL, judge_knife, 24, 0, 0.3},
    {"gomboc-over", UP, 2000, 2000, make_gomboc, NULL, judge_gomboc, 0, 175, 0.8},
    {"gomboc-aside", UP, 1500, 1500, make_gomboc, NULL, judge_gomboc, 0, -90, 0.8},
    {"gomboc-ahead", UP, 1500, 1500, make_gomboc, NULL, judge_gomboc, 1, 80, 0.8},
    {"gomboc-fine-over", UP, 2000, 2000, make_gomboc, NULL, judge_gomboc, 2, 175, 0.8},
    {"gomboc-fine-aside", UP, 1500, 1500, make_gomboc, NULL, judge_gomboc, 2, -90, 0.8},
    {"gomboc-fine-ahead", UP, 1500, 1500, make_gomboc, NULL, judge_gomboc, 3, 80, 0.8},
    {0}};
