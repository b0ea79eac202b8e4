/* SPDX-License-Identifier: MIT */
/* Motions with a known outcome: falls, throws, bounces and impacts of two bodies. */
#include <math.h>
#include <stdio.h>

#include "physics.h"
#include "real.h"

/* The time since a body that goes up now left a height, by its parabola. */
static double since(const struct oracle_body *now, double height)
{
    double v = now->velocity[2];

    return (sqrt(fmax(0, v * v + 2 * PHYSICS_G * (now->position[2] - height))) - v) / PHYSICS_G;
}

/* The height of a body's highest vertex over its centre. */
static double half_height(const struct fixture *f, int mesh)
{
    const struct oracle_mesh *solid = &f->meshes[mesh].solid;
    double most = 0;

    for (size_t v = 0; v < solid->vertex_count; v++) {
        most = fmax(most, solid->vertices[v][2]);
    }
    return most;
}

/* A box of 1 x 0.6 x 0.3 at a height over the plane, thrown; body 1. Returns where its centre is at a hit. */
static double throw_box(struct fixture *f, double above, const double velocity[3])
{
    const double none[3] = {0};
    double height;
    int mesh;

    fixture_plane(f);
    mesh = physics_box(f, 1, 0.6, 0.3);
    height = half_height(f, mesh) + fixture_skin(f, mesh) / 2;
    fixture_body(f, mesh, 0, 0, height + above, fixture_upright);
    fixture_throw(f, 1, velocity, none);
    return height;
}

/* Step until a hit of the box and the plane; returns its time, found from the motion after it. */
static double next_hit(struct fixture *f, double height, long *frame, double *speed)
{
    struct oracle_body now;

    do {
        physics_step(f);
        ++*frame;
        *speed = physics_hit(f, 1, 0);
    } while (*speed == 0 && *frame < 1000);
    now = physics_body(f, 1);
    return (double)*frame / PHYSICS_FPS - since(&now, height);
}

static void drop(void)
{
    const double none[3] = {0}, fall = 5;
    struct fixture *f = physics_begin("drop", 0.5);
    double height = throw_box(f, fall, none), speed, at;
    long frame = 0;

    physics_start(f, 1);
    at = next_hit(f, height, &frame, &speed);
    physics_row("drop: time of the fall", "t = sqrt(2 h / g)", sqrt(2 * fall / PHYSICS_G), at, 1e-6,
                NULL);
    physics_row("drop: speed at the hit", "v = sqrt(2 g h)", sqrt(2 * PHYSICS_G * fall), speed,
                1e-6, NULL);
    fixture_free(f);
}

/* The sixth hit comes after five bounces, each e times as long as the one before. */
static void bounces(double e)
{
    const double none[3] = {0}, fall = 5;
    struct fixture *f = physics_begin("bounces", 0.5);
    double height = throw_box(f, fall, none), speed, at = 0, sum = 1;
    long frame = 0;
    char name[80];

    physics_start(f, e);
    for (int hit = 0; hit < 6; hit++) {
        at = next_hit(f, height, &frame, &speed);
        sum += hit > 0 ? 2 * pow(e, hit) : 0;
    }
    snprintf(name, sizeof name, "bounces, e = %.1f: time of the sixth hit", e);
    physics_row(name, "t = sqrt(2 h / g) (1 + 2 e + ... + 2 e^5)", sum * sqrt(2 * fall / PHYSICS_G),
                at, 1e-5, "each hit is solved to 2^-20 of its speed");
    snprintf(name, sizeof name, "bounces, e = %.1f: speed at the sixth hit", e);
    physics_row(name, "v = e^5 sqrt(2 g h)", pow(e, 5) * sqrt(2 * PHYSICS_G * fall), speed, 1e-5,
                "likewise");
    fixture_free(f);
}

static void projectile(double degrees)
{
    const double angle = degrees * REAL_PI / 180, speed = 12,
                 velocity[3] = {speed * cos(angle), 0, speed * sin(angle)};
    struct fixture *f = physics_begin("projectile", 0);
    double height = throw_box(f, 0, velocity), hit, top = 0;
    struct oracle_body now;
    long frame = 0;
    char name[80];

    physics_start(f, 1);
    do {
        physics_step(f);
        frame++;
        now = physics_body(f, 1);
        top = fmax(top, now.position[2]);
        hit = physics_hit(f, 1, 0);
    } while (hit == 0 && frame < 1000);
    snprintf(name, sizeof name, "throw at %.0f degrees: range", degrees);
    physics_row(name, "x = v^2 sin(2 a) / g", speed * speed * sin(2 * angle) / PHYSICS_G,
                now.position[0] - now.velocity[0] * since(&now, height), 1e-6, NULL);
    fixture_free(f);
}

/* A box of mass 1 meets another one face to face. */
static void meet(double other, double e)
{
    const double velocity[3] = {3, 0, 0}, none[3] = {0};
    struct fixture *f = physics_begin("collision", 0.5);
    int mesh = physics_box(f, 0.5, 0.5, 0.5);
    char name[80];

    physics_gravity(f, 0, 0, 0);
    fixture_body(f, mesh, -1, 0, 0, fixture_upright);
    fixture_body(f, mesh, 0, 0, 0, fixture_upright);
    fixture_weigh(f, 0, 1);
    fixture_weigh(f, 1, other);
    fixture_throw(f, 0, velocity, none);
    physics_start(f, e);
    for (int frame = 0; frame < 30; frame++) {
        physics_step(f);
    }
    snprintf(name, sizeof name, "1 kg hits %g kg, e = %.1f: its speed", other, e);
    physics_row(name, "v1 = v (1 - e m2) / (1 + m2)", 3 * (1 - e * other) / (1 + other),
                physics_body(f, 0).velocity[0], 1e-6, NULL);
    snprintf(name, sizeof name, "1 kg hits %g kg, e = %.1f: the other's speed", other, e);
    physics_row(name, "v2 = v (1 + e) / (1 + m2)", 3 * (1 + e) / (1 + other),
                physics_body(f, 1).velocity[0], 1e-6, NULL);
    fixture_free(f);
}

/* A level rod falls on a ridge at x = d and turns away. */
static void rod(double d, double e)
{
    static const double ridge[3][2] = {{0, 0}, {-0.5, -0.5}, {0.5, -0.5}};
    const double velocity[3] = {0, 0, -4}, none[3] = {0};
    struct fixture *f = physics_begin("rod", 0);
    struct oracle_body now;
    double k2, spin;
    char name[80];

    physics_gravity(f, 0, 0, 0);
    fixture_shape_prism(&f->shape, ridge, 3, -1, 1);
    fixture_fixed(f, fixture_mesh(f), d, 0, 0, fixture_upright);
    fixture_body(f, physics_box(f, 2, 0.1, 0.1), 0, 0, 0.8, fixture_upright);
    fixture_throw(f, 1, velocity, none);
    physics_start(f, e);
    for (int frame = 0; frame < 20; frame++) {
        physics_step(f);
    }
    now = physics_body(f, 1);
    k2 = now.inertia[1];
    /* the spin is found at the hit, with the rod level */
    spin = (1 + e) * 4 * d / (k2 + d * d);
    snprintf(name, sizeof name, "rod on a ridge %.1f m beside its middle, e = %.1f: its spin", d,
             e);
    physics_row(name, "w = (1 + e) v d / (k^2 + d^2)", spin, real_length(now.spin), 1e-5, NULL);
    snprintf(name, sizeof name, "rod on a ridge %.1f m beside its middle, e = %.1f: its speed", d,
             e);
    physics_row(name, "v' = v - w k^2 / d", 4 - spin * k2 / d, -now.velocity[2], 1e-5, NULL);
    fixture_free(f);
}

/* A puck of a quarter of the rod's mass gives all its motion to the end of a thin rod that is free. */
static void puck_and_rod(void)
{
    const double velocity[3] = {3, 0, 0}, none[3] = {0}, end = 0.9;
    struct fixture *f = physics_begin("puck", 0);
    struct oracle_body now;
    double k2;

    physics_gravity(f, 0, 0, 0);
    fixture_body(f, physics_box(f, 0.1, 0.1, 2), 0, 0, 0, fixture_upright);
    fixture_body(f, physics_box(f, 0.2, 0.2, 0.2), -0.8, 0, end, fixture_upright);
    k2 = f->meshes[0].weight.inertia[1];
    fixture_weigh(f, 0, 1);
    fixture_weigh(f, 1, 1 / (1 + end * end / k2));
    fixture_throw(f, 1, velocity, none);
    physics_start(f, 1);
    for (int frame = 0; frame < 20; frame++) {
        physics_step(f);
    }
    now = physics_body(f, 0);
    physics_row("puck against a rod, 0.9 m from its middle: its speed",
                "0, if its mass is m / (1 + d^2 / k^2)", 0, physics_body(f, 1).velocity[0], 2e-2,
                "the puck meets the rod with a face, at places 0.8 to 1 m from the middle: these "
                "turn the puck");
    physics_row("puck against a rod: the rod's speed", "v m2 / m", 3 / (1 + end * end / k2),
                now.velocity[0], 1e-2, "likewise");
    fixture_free(f);
}

/* One bounce of a ball off the floor at a slant: the speed along the floor and the spin after it. */
static void bounce_ball(double mu, double across, double e, int cuts, carom_quat_q30 turn,
                        double *speed, double *spin)
{
    const double velocity[3] = {across, 0, -4}, none[3] = {0};
    struct fixture *f = physics_begin("slant", mu);
    struct oracle_body now;

    physics_gravity(f, 0, 0, 0);
    fixture_plane(f);
    fixture_body(f, physics_ball(f, 0.5, cuts), 0, 0, 0.8, turn);
    fixture_throw(f, 1, velocity, none);
    physics_start(f, e);
    for (int frame = 0; frame < 20; frame++) {
        physics_step(f);
    }
    now = physics_body(f, 1);
    *speed = now.velocity[0];
    *spin = now.spin[1];
    fixture_free(f);
}

/*
 * With little friction it slides throughout, with more it leaves rolling. It comes down on a corner; one of 1280 faces, whose
 * other corners are then out of the margin.
 */
static void slant(double mu)
{
    const double across = 6, e = 0.7, k2 = 0.4;
    const bool slides = across > mu * (1 + e) * 4 * (1 + 1 / k2);
    const carom_quat_q30 corner_down = lab_turn(1, 0, 0, REAL_PI / 2 + atan((1 + sqrt(5)) / 2));
    double speed, spin;
    char name[80];

    bounce_ball(mu, across, e, 3, corner_down, &speed, &spin);
    snprintf(name, sizeof name, "ball bounces at a slant, mu = %.1f: speed along the floor", mu);
    physics_row(name, slides ? "v - mu (1 + e) v_z (Brody 1984)" : "5/7 v (Brody 1984)",
                slides ? across - mu * (1 + e) * 4 : across * 5 / 7, speed, 1e-2,
                "the moment of inertia of 1280 faces is 1 % off that of a ball");
    snprintf(name, sizeof name, "ball bounces at a slant, mu = %.1f: spin", mu);
    physics_row(name, slides ? "5/2 mu (1 + e) v_z / r" : "5/7 v / r",
                (slides ? 2.5 * mu * (1 + e) * 4 : across * 5 / 7) / 0.5, spin, 2e-2, "likewise");
}

/* The same for 5120 faces in any pose, where several corners are within the margin. */
static void slant_anyhow(void)
{
    const int poses = 24;
    uint64_t random = 3;
    double mean = 0;

    for (int i = 0; i < poses; i++) {
        double speed, spin;

        bounce_ball(0.1, 6, 0.7, 4, lab_random_turn(&random), &speed, &spin);
        mean += spin / poses;
    }
    physics_miss(
        "the same, of 5120 faces in any pose: spin", "5/2 mu (1 + e) v_z / r",
        2.5 * 0.1 * 1.7 * 4 / 0.5, mean, 2e-2, 0.3,
        "corners within five skins, 0.07 r around the lowest, take part in the hit: it lands as on "
        "a small "
        "flat, which resists the spin by up to 0.07 r of the impulse, beside 0.1 r of friction");
}

void physics_fall(void)
{
    drop();
    bounces(0.8);
    bounces(0.7);
    projectile(45);
    projectile(20);
    meet(1, 1);
    meet(3, 1);
    meet(0.1, 0.5);
    meet(200, 0.7);
    rod(0.7, 1);
    rod(0.3, 0);
    puck_and_rod();
    slant(0.1);
    slant(0.5);
    slant_anyhow();
}
