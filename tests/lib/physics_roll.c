/* SPDX-License-Identifier: MIT */
/* Motions with a known outcome: rolling, down slopes, from a slide, on a turning disc, in a trough. */
#include <math.h>
#include <stdio.h>

#include "physics.h"
#include "real.h"

/*
 * A path that begins at a corner leaves the circle about that corner along the tangent, and the body falls back to it by the
 * next frames: that takes v h / (2 r) of its weight, h being a frame, beside what a polygon loses at its corners.
 */
#define RESISTS                                                                                    \
    "a corner that it turns about lifts by w^2 r h^2 / 2 a frame and falls back, which resists "   \
    "by up to 0.02 of its weight"

/* Lay a body of this mesh on the plane, its lowest vertex a skin above it. */
static int lay(struct fixture *f, int mesh, double x, double y, carom_quat_q30 turn)
{
    const struct oracle_mesh *solid = &f->meshes[mesh].solid;
    double low = HUGE_VAL;

    for (size_t v = 0; v < solid->vertex_count; v++) {
        double at[3];

        lab_rotate(at, &turn, solid->vertices[v]);
        low = fmin(low, at[2]);
    }
    return fixture_body(f, mesh, x, y, fixture_skin(f, mesh) - low, turn);
}

enum { BALL, ROLLER, SHAPES };

static int make(struct fixture *f, int shape, double r)
{
    return shape == BALL ? physics_ball(f, r, 4) : physics_roller(f, r, r, 128);
}

/*
 * Acceleration on a slope, from rest, over a second at r = 1; the mean of several poses. A body of another radius goes as far
 * in radii, which takes it more frames.
 */
static double acceleration(int shape, double degrees, double r)
{
    const double angle = degrees * REAL_PI / 180;
    const int poses = shape == BALL ? 8 : 1, frames = (int)(60 * sqrt(r));
    uint64_t random = 7;
    double sum = 0;

    for (int i = 0; i < poses; i++) {
        struct fixture *f = physics_begin("down", 0.8);

        physics_gravity(f, PHYSICS_G * sin(angle), 0, -PHYSICS_G * cos(angle));
        fixture_plane(f);
        lay(f, make(f, shape, r), -20, 0,
            shape == BALL ? lab_random_turn(&random) : fixture_upright);
        fixture_weigh(f, 1, 1);
        physics_start(f, 0);
        for (int frame = 0; frame < frames; frame++) {
            physics_step(f);
        }
        sum += physics_body(f, 1).velocity[0] / poses;
        fixture_free(f);
    }
    return sum / (frames / PHYSICS_FPS);
}

static void down(int shape, double degrees)
{
    const double part[SHAPES] = {5.0 / 7, 2.0 / 3},
                 wanted = part[shape] * PHYSICS_G * sin(degrees * REAL_PI / 180);
    const char *from = shape == BALL ? "5/7 g sin a" : "2/3 g sin a";
    char name[80], fine[160];

    snprintf(name, sizeof name, "%s rolls down %.0f degrees: acceleration",
             shape == BALL ? "ball" : "cylinder", degrees);
    snprintf(fine, sizeof fine, "%s; 16 times as large, in 4 times as many frames", name);
    physics_miss(name, from, wanted, acceleration(shape, degrees, 1), 1e-2, 8e-2, RESISTS);
    physics_miss(fine, from, wanted, acceleration(shape, degrees, 16), 1e-2, 5e-2,
                 "less of that, and what a polygon loses at its corners");
}

/* A ball that is pushed without a spin slides until it rolls. */
static void bowl(double mu, double speed)
{
    const double velocity[3] = {speed, 0, 0}, none[3] = {0};
    const int poses = 6;
    double final = 0, after = 0;
    uint64_t random = 11;

    for (int i = 0; i < poses; i++) {
        struct fixture *f = physics_begin("bowl", mu);
        struct oracle_body now;
        long frame = 0;

        fixture_plane(f);
        lay(f, physics_ball(f, 1, 4), -25, 0, lab_random_turn(&random));
        fixture_throw(f, 1, velocity, none);
        physics_start(f, 0);
        do {
            physics_step(f);
            frame++;
            now = physics_body(f, 1);
        } while (now.velocity[0] - now.spin[1] > 0.02 * speed && frame < 600);
        after += (double)frame / PHYSICS_FPS / 0.98 / poses;
        final += now.velocity[0] / poses;
        fixture_free(f);
    }
    physics_row("ball slides, then rolls: its speed then", "5/7 v", speed * 5 / 7, final, 2e-2,
                RESISTS);
    physics_row("ball slides, then rolls: time until then", "2 v / (7 mu g)",
                2 * speed / (7 * mu * PHYSICS_G), after, 1e-1, RESISTS);
}

/* The angle of the velocity along the ground, going on from the one before. */
static double heading(const struct oracle_body *now, double before)
{
    double angle = atan2(now->velocity[1], now->velocity[0]);

    return angle + 2 * REAL_PI * round((before - angle) / (2 * REAL_PI));
}

/*
 * A ball rolls on a disc that turns: its path is a circle about the axis, at 2/7 of the disc's rate. Runs for a part of the
 * circle; returns the rate, and how the speed has grown.
 */
static double turntable(double rate, double circle, double part, uint64_t *random, double *grown)
{
    const double r = 1, along = rate * 2 / 7 * circle, turning[3] = {0, 0, rate}, none[3] = {0};
    const double velocity[3] = {0, along, 0}, spin[3] = {(rate * circle - along) / r, 0, 0};
    const int frames = (int)(part * 2 * REAL_PI / (rate * 2 / 7) * PHYSICS_FPS);
    struct fixture *f = physics_begin("turntable", 0.8);
    struct oracle_body now;
    double angle, first;

    fixture_fixed(f, physics_box(f, 30, 30, 2), 0, 0, -1, fixture_upright);
    f->bodies[0].def.stationary = false;
    f->bodies[0].def.kinematic = true;
    fixture_throw(f, 0, none, turning);
    lay(f, physics_ball(f, r, 4), circle, 0, lab_random_turn(random));
    fixture_throw(f, 1, velocity, spin);
    physics_start(f, 0);
    now = physics_body(f, 1);
    angle = first = heading(&now, 0);
    for (int frame = 0; frame < frames; frame++) {
        physics_step(f);
        now = physics_body(f, 1);
        angle = heading(&now, angle);
    }
    *grown = hypot(now.velocity[0], now.velocity[1]) / along;
    fixture_free(f);
    return (angle - first) / (frames / PHYSICS_FPS) / rate;
}

static void turntables(void)
{
    const int poses = 8;
    uint64_t random = 13;
    double sum = 0, growth = 0, grown;

    for (int i = 0; i < poses; i++) {
        sum += turntable(2, 2, 1.0 / 6, &random, &grown) / poses;
        growth += grown / poses;
    }
    physics_row("ball on a turning disc: rate of its circle, of the disc's", "2/7 (Weltner 1979)",
                2.0 / 7, sum, 2e-2, RESISTS);
    physics_miss("ball on a turning disc: speed after a sixth of a circle, of that at first", "1",
                 1, growth, 5e-2, 0.5,
                 "what resists rolling makes the circle wider, as it does on a real disc");
}

void physics_roll(void)
{
    down(BALL, 10);
    down(BALL, 25);
    down(ROLLER, 10);
    down(ROLLER, 25);
    bowl(0.3, 6);
    turntables();
}
