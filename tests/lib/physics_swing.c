/* SPDX-License-Identifier: MIT */
/* Motions with a known outcome: what swings on joints and springs. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "carom_joint.h"
#include "physics.h"
#include "real.h"

static const double origin[3], along_y[3] = {0, 1, 0};

/* A rod of this length that hangs by its end from the origin, aside by so much; body 0. */
static int hang(struct fixture *f, double length, double degrees)
{
    const double angle = degrees * REAL_PI / 180;
    int mesh = physics_box(f, 0.1, 0.1, length);

    return fixture_body(f, mesh, length / 2 * sin(angle), 0, -length / 2 * cos(angle),
                        lab_turn(0, -1, 0, angle));
}

/* The angle of a rod from hanging down. */
static double lean(const struct oracle_body *rod)
{
    double axis[3];

    physics_axis(rod, 2, axis);
    return atan2(-axis[0], axis[2]);
}

/* A pendulum of any amplitude: T = 4 sqrt(I / (m g d)) K(sin(a / 2)). */
static void pendulum(double degrees)
{
    const double length = 1, d = length / 2;
    struct physics_crossings c = {0};
    struct fixture *f = physics_begin("pendulum", 0);
    struct oracle_body now;
    double inertia, wanted;
    char name[80];

    hang(f, length, degrees);
    physics_start(f, 0);
    physics_joint(f, CAROM_JOINT_HINGE, 0, CAROM_WORLD, origin, along_y);
    now = physics_body(f, 0);
    inertia = now.inertia[1] + d * d;
    wanted = 4 * sqrt(inertia / (PHYSICS_G * d)) * physics_elliptic(sin(degrees / 360 * REAL_PI));
    for (int frame = 0; frame < 1200; frame++) {
        physics_cross(&c, -lean(&now));
        physics_step(f);
        now = physics_body(f, 0);
    }
    snprintf(name, sizeof name, "pendulum, %.0f degrees: period", degrees);
    physics_row(name, "4 sqrt(I / (m g d)) K(sin(a / 2))", wanted, physics_period(&c), 2e-3,
                "a slice turns by the spin of its middle: some w^2 h^2 / 24");
    fixture_free(f);
}

/* A rod that goes round the vertical at a steady lean and does not turn about itself otherwise. */
static void conical(double degrees)
{
    const double length = 1, d = length / 2, angle = degrees * REAL_PI / 180;
    struct fixture *f = physics_begin("conical", 0);
    struct physics_crossings c = {0};
    struct oracle_body now;
    double rate, most = 0;
    const double *inertia = f->meshes[0].weight.inertia;
    double turning[3] = {0}, velocity[3] = {0};
    char name[80];

    hang(f, length, degrees);
    /* the moment of weight, m g d sin a, turns L, whose level part is rate (I + m d^2 - I3) sin a cos a */
    rate = sqrt(PHYSICS_G * d / ((inertia[1] + d * d - inertia[2]) * cos(angle)));
    turning[2] = rate;
    velocity[1] = rate * d * sin(angle);
    fixture_throw(f, 0, velocity, turning);
    physics_start(f, 0);
    physics_joint(f, CAROM_JOINT_BALL, 0, CAROM_WORLD, origin, along_y);
    for (int frame = 0; frame < 1200; frame++) {
        double axis[3];

        now = physics_body(f, 0);
        physics_axis(&now, 2, axis);
        most = fmax(most, fabs(acos(axis[2]) - angle) / angle);
        physics_cross(&c, now.position[1]);
        physics_step(f);
    }
    snprintf(name, sizeof name, "conical pendulum, %.0f degrees: period", degrees);
    physics_row(name, "2 pi sqrt((I - I3) cos a / (m g d))", 2 * REAL_PI / rate, physics_period(&c),
                1e-3, "likewise");
    snprintf(name, sizeof name, "conical pendulum, %.0f degrees: change of its lean", degrees);
    physics_row(name, "0", 0, most, 2e-3, "likewise");
    fixture_free(f);
}

/*
 * Two rods, one below the other, swing a little in one of their two modes: det(K - w^2 M) = 0. For rods without thickness
 * w^2 = 3 g / l (1 -+ 2 / sqrt 7).
 */
static void two_rods(int mode)
{
    const double l = 1, d = l / 2, below[3] = {0, 0, -l}, g = PHYSICS_G;
    struct fixture *f = physics_begin("two rods", 0);
    struct physics_crossings c = {0};
    double k2, a, b, e, square, ratio, swing = 0.02;
    int mesh = physics_box(f, 0.02, 0.02, l);

    k2 = f->meshes[0].weight.inertia[1];
    /* M = (k2 + d^2 + l^2, l d; l d, k2 + d^2), K = g (d + l, 0; 0, d) */
    a = (k2 + d * d + l * l) * (k2 + d * d) - l * d * l * d;
    b = -g * ((d + l) * (k2 + d * d) + d * (k2 + d * d + l * l));
    e = g * g * (d + l) * d;
    square = (-b + (mode ? 1 : -1) * sqrt(b * b - 4 * a * e)) / (2 * a);
    ratio = (g * (d + l) - square * (k2 + d * d + l * l)) / (square * l * d);
    /* thrown through the middle; a turn about y takes what hangs towards -x */
    for (int i = 0; i < 2; i++) {
        double rate[2] = {swing, swing * ratio};
        const double turning[3] = {0, rate[i], 0},
                     velocity[3] = {i == 0 ? -rate[0] * d : -rate[0] * l - rate[1] * d, 0, 0};

        fixture_body(f, mesh, 0, 0, i == 0 ? -d : -l - d, fixture_upright);
        fixture_weigh(f, i, 1);
        fixture_throw(f, i, velocity, turning);
    }
    physics_start(f, 0);
    physics_joint(f, CAROM_JOINT_HINGE, 0, CAROM_WORLD, origin, along_y);
    physics_joint(f, CAROM_JOINT_HINGE, 1, 0, below, along_y);
    for (int frame = 0; frame < 1200; frame++) {
        struct oracle_body now = physics_body(f, 0);

        physics_cross(&c, lean(&now));
        physics_step(f);
    }
    physics_row(mode ? "double pendulum: period of the fast mode"
                     : "double pendulum: period of the slow mode",
                mode ? "w^2 = 3 g / l (1 + 2 / sqrt 7), and the rods' thickness"
                     : "w^2 = 3 g / l (1 - 2 / sqrt 7), and the rods' thickness",
                2 * REAL_PI / sqrt(square), physics_period(&c), 5e-3, "likewise");
    fixture_free(f);
}

/* A weight on a slider with a spring, no gravity. */
static void spring(double period)
{
    const double along[3] = {1, 0, 0}, velocity[3] = {0.5, 0, 0}, none[3] = {0};
    const double k = 4 * REAL_PI * REAL_PI / period / period;
    struct fixture *f = physics_begin("spring", 0);
    struct physics_crossings c = {0};
    struct carom_joint_state joint;
    int number;
    char name[80];

    physics_gravity(f, 0, 0, 0);
    fixture_body(f, physics_box(f, 1, 1, 1), 0, 0, 0, fixture_upright);
    fixture_weigh(f, 0, 1);
    fixture_throw(f, 0, velocity, none);
    physics_start(f, 0);
    number = physics_joint(f, CAROM_JOINT_SLIDER, 0, CAROM_WORLD, none, along);
    lab_expect(carom_joint_get(f->world, number, &joint), "joint");
    joint.drive.spring = true;
    joint.drive.stiffness_q40 = lab_fixed(k / PHYSICS_FPS / PHYSICS_FPS, 40);
    lab_expect(carom_joint_set(f->world, number, &joint.drive), "joint");
    for (int frame = 0; frame < 1800; frame++) {
        physics_cross(&c, physics_body(f, 0).position[0]);
        physics_step(f);
    }
    snprintf(name, sizeof name, "weight on a spring, %g s: period", period);
    physics_row(name, "2 pi sqrt(m / k)", period, physics_period(&c), 1e-2,
                "a spring acts once a slice, by its mean over the slice");
    fixture_free(f);
}

/* Newton's cradle: so many of five balls swing in, the others hang. */
static void cradle(int count)
{
    enum { BALLS = 5 };
    const double from = 30, pitch = 0.31, length = 1, side = REAL_PI / 16;
    struct fixture *f = physics_begin("cradle", 0);
    double high[BALLS] = {0}, least = HUGE_VAL, others = 0;
    char name[80];
    int mesh = physics_roller(f, 0.15 / cos(side), 0.3, 16);

    /* a flat side looks at the next one */
    for (int i = 0; i < BALLS; i++) {
        const double angle = (i < count ? from : 0) * REAL_PI / 180;

        fixture_body(f, mesh, i * pitch - length * sin(angle), 0, -length * cos(angle),
                     lab_turn(0, 1, 0, angle + side));
    }
    physics_start(f, 1);
    for (int i = 0; i < BALLS; i++) {
        const double pivot[3] = {i * pitch, 0, 0};

        physics_joint(f, CAROM_JOINT_HINGE, i, CAROM_WORLD, pivot, along_y);
    }
    for (int frame = 0; frame < 75; frame++) {
        physics_step(f);
        for (int i = 0; i < BALLS; i++) {
            struct oracle_body now = physics_body(f, i);

            if (frame > 40) {
                high[i] = fmax(high[i], (length + now.position[2]) / length);
            }
        }
    }
    for (int i = 0; i < BALLS; i++) {
        if (i >= BALLS - count) {
            least = fmin(least, high[i]);
        } else {
            others = fmax(others, high[i]);
        }
    }
    snprintf(name, sizeof name, "cradle, %d of five: height that as many reach beyond", count);
    physics_row(name, "l (1 - cos a)", 1 - cos(from * REAL_PI / 180), least, 1e-2,
                "balls hang 10 mm apart and meet one after the other");
    snprintf(name, sizeof name, "cradle, %d of five: height of the others", count);
    physics_row(name, "0", 0, others, 1e-3, "likewise");
    fixture_free(f);
}

void physics_swing(void)
{
    pendulum(5);
    pendulum(90);
    pendulum(170);
    conical(30);
    two_rods(0);
    two_rods(1);
    spring(1);
    spring(0.2);
    spring(0.05);
    cradle(1);
    cradle(2);
    cradle(3);
}
