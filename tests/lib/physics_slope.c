/* SPDX-License-Identifier: MIT */
/* Motions with a known outcome: blocks on slopes, against walls, over edges. */
#include <math.h>
#include <stdio.h>

#include "physics.h"
#include "real.h"

/* Ground, gravity and bodies are turned alike, so that no axis is special. */
static carom_quat_q30 askew(void)
{
    return lab_turn(3, -2, 1, 0.4);
}

/* Gravity in a plane that falls towards its own x by so much. */
static void lean(struct fixture *f, double slope)
{
    const double angle = atan(slope),
                 along[3] = {PHYSICS_G * sin(angle), 0, -PHYSICS_G * cos(angle)};
    carom_quat_q30 turn = askew();
    double gravity[3];

    lab_rotate(gravity, &turn, along);
    physics_gravity(f, gravity[0], gravity[1], gravity[2]);
}

/* A block of sides x, y, z on that plane: body 1. */
static void lay(struct fixture *f, double slope, double x, double y, double z)
{
    carom_quat_q30 turn = askew();
    double above[3] = {0}, at[3];
    int mesh;

    lean(f, slope);
    fixture_shape_plane(&f->shape, 1, 60);
    fixture_fixed(f, fixture_mesh(f), 0, 0, 0, turn);
    mesh = physics_box(f, x, y, z);
    above[2] = z / 2 + fixture_skin(f, mesh);
    lab_rotate(at, &turn, above);
    fixture_body(f, mesh, at[0], at[1], at[2], turn);
}

/* The speed down the slope. */
static double downhill(const struct fixture *f)
{
    const double x[3] = {1, 0, 0};
    carom_quat_q30 turn = askew();
    struct oracle_body now = physics_body(f, 1);
    double along[3];

    lab_rotate(along, &turn, x);
    return real_dot(now.velocity, along);
}

static void run(struct fixture *f, int frames)
{
    for (int frame = 0; frame < frames; frame++) {
        physics_step(f);
    }
}

/* How far a body is from where it was put. */
static double went(const struct fixture *f, int body)
{
    struct oracle_body now = physics_body(f, body);
    double way[3];

    for (int k = 0; k < 3; k++) {
        way[k] = now.position[k] - f->bodies[body].first.position[k];
    }
    return real_length(way);
}

static void slide(double mu, double degrees)
{
    const double angle = degrees * REAL_PI / 180;
    struct fixture *f = physics_begin("slide", mu);
    double before;
    char name[80];

    lay(f, tan(angle), 1, 0.6, 0.3);
    physics_start(f, 0);
    run(f, 30);
    before = downhill(f);
    run(f, 120);
    snprintf(name, sizeof name, "block slides down %.0f degrees, mu = %.1f: acceleration", degrees,
             mu);
    physics_row(name, "g (sin a - mu cos a)", PHYSICS_G * (sin(angle) - mu * cos(angle)),
                (downhill(f) - before) / 2, 1e-4, "mu has 16 bits");
    fixture_free(f);
}

/* Whether a block of these sides is within `most` of its place after so many frames on a slope. */
static bool rests(const char *name, double mu, double slope, const double sides[3], int frames,
                  double most)
{
    struct fixture *f = physics_begin(name, mu);
    bool rested;

    lay(f, slope, sides[0], sides[1], sides[2]);
    physics_start(f, 0);
    run(f, frames);
    rested = went(f, 1) < most;
    fixture_free(f);
    return rested;
}

static bool sticks(double slope)
{
    return rests("sticks", 0.5, slope, (const double[]){1, 0.6, 0.3}, 180, 0.01);
}

/* Whether a block twice and a half as high as wide stands; friction holds it. */
static bool stands(double slope)
{
    return rests("stands", 2, slope, (const double[]){0.4, 0.6, 1}, 240, 0.05);
}

/* A block pushed along a level floor. */
static void stop(double mu, double speed)
{
    const double velocity[3] = {speed, 0, 0}, none[3] = {0};
    struct fixture *f = physics_begin("stop", mu);
    int mesh;

    fixture_plane(f);
    mesh = physics_box(f, 1, 0.6, 0.3);
    fixture_body(f, mesh, -20, 0, 0.15 + fixture_skin(f, mesh), fixture_upright);
    fixture_throw(f, 1, velocity, none);
    physics_start(f, 0);
    run(f, 400);
    physics_row("block pushed along a floor: way until it stops", "v^2 / (2 mu g)",
                speed * speed / (2 * mu * PHYSICS_G), went(f, 1), 1e-2,
                "friction of a frame acts where the frame begins: half a frame's way is missing");
    fixture_free(f);
}

/*
 * A plank slides down between a wall and a floor, both smooth. It leaves the wall at 2/3 of the height from which it began;
 * from then on nothing pushes it along the floor.
 */
static void ladder(void)
{
    const double length = 2, thick = 0.02, angle = 70 * REAL_PI / 180;
    struct fixture *f = physics_begin("ladder", 0);
    double skin;
    int mesh;

    fixture_plane(f);
    fixture_fixed(f, physics_box(f, 1, 4, 6), -0.5, 0, 3.1, fixture_upright);
    mesh = physics_box(f, length, 0.3, thick);
    skin = fixture_skin(f, mesh);
    fixture_body(f, mesh, length / 2 * cos(angle) + thick / 2 * sin(angle) + skin, 0,
                 length / 2 * sin(angle) + thick / 2 * cos(angle) + skin, lab_turn(0, 1, 0, angle));
    physics_start(f, 0);
    while (physics_body(f, 2).position[2] > 0.2) {
        physics_step(f);
    }
    physics_row("ladder between wall and floor, both smooth: speed with which it leaves the wall",
                "sqrt(g l sin^3 a) / 3, at 2/3 of the height",
                sqrt(PHYSICS_G * length * pow(sin(angle), 3)) / 3, physics_body(f, 2).velocity[0],
                2e-2, "the plank is 0.02 m thick");
    fixture_free(f);
}

/* Whether four blocks stand over an edge, each over the one below by x / (2 n), n counted from above. */
static bool overhangs(double x)
{
    const int blocks = 4;
    struct fixture *f = physics_begin("overhang", 0.8);
    double at = 0, skin;
    bool stay = true;
    int mesh;

    fixture_fixed(f, physics_box(f, 2, 1, 1), -1, 0, -0.5, fixture_upright);
    mesh = physics_box(f, 1, 0.5, 0.1);
    skin = fixture_skin(f, mesh);
    /* the lowest first: its middle is x / (2 blocks) out from its own half */
    for (int i = 0; i < blocks; i++) {
        at += x / (2 * (blocks - i)) - (i == 0 ? 0.5 : 0);
        fixture_body(f, mesh, at, 0, 0.05 + skin + i * (0.1 + skin), fixture_upright);
    }
    physics_start(f, 0);
    run(f, 300);
    for (int i = 1; i <= blocks; i++) {
        stay = stay && went(f, i) < 0.01;
    }
    fixture_free(f);
    return stay;
}

void physics_slope(void)
{
    slide(0.3, 20);
    slide(0, 35);
    physics_row("slope at which a block begins to slide, mu = 0.5", "tan a = mu", 0.5,
                physics_threshold(sticks, 0.45, 0.55, 9), 2e-3, "nine halvings");
    physics_row("slope at which a block of 0.4 x 1 tips over", "tan a = width / height", 0.4,
                physics_threshold(stands, 0.35, 0.45, 9), 2e-3, "nine halvings");
    stop(0.3, 12);
    ladder();
    physics_row("four blocks over an edge: the largest overhang, of 1/2 + 1/4 + 1/6 + 1/8",
                "1 (harmonic sum)", 1, physics_threshold(overhangs, 0.9, 1.1, 8), 1e-2,
                "eight halvings");
}
