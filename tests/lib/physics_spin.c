/* SPDX-License-Identifier: MIT */
/* Motions with a known outcome: bodies that spin, free, on a pivot, on a floor. */
#include <math.h>
#include <stdio.h>

#include "carom_joint.h"
#include "physics.h"
#include "real.h"

#define MIDPOINT "the midpoint rule turns by w^2 h^2 / 12 too little"

static const double origin[3], along_y[3] = {0, 1, 0};

/* L over the mass, world axes. */
static void angular(const struct oracle_body *body, double out[3])
{
    double local[3], m[3][3];

    physics_local(body, body->spin, local);
    for (int k = 0; k < 3; k++) {
        local[k] *= body->inertia[k];
    }
    real_matrix(m, body->quaternion);
    real_rotate(out, m, local);
}

/* A square box that spins off its axis: the axis goes round L at L / I1. */
static void wobble(void)
{
    const double spin[3] = {2, 0, 5}, none[3] = {0};
    struct fixture *f = physics_begin("wobble", 0);
    struct physics_crossings c = {0};
    struct oracle_body now;
    double l[3], aside[3];

    physics_gravity(f, 0, 0, 0);
    fixture_body(f, physics_box(f, 1, 1, 0.4), 0, 0, 0, fixture_upright);
    fixture_throw(f, 0, none, spin);
    physics_start(f, 0);
    now = physics_body(f, 0);
    angular(&now, l);
    real_cross(aside, l, along_y);
    for (int frame = 0; frame < 1200; frame++) {
        double axis[3];

        physics_axis(&now, 2, axis);
        physics_cross(&c, axis[1]);
        physics_step(f);
        now = physics_body(f, 0);
    }
    physics_row("square box that spins off its axis: period of the wobble", "2 pi I1 / L",
                2 * REAL_PI * now.inertia[0] / real_length(l), physics_period(&c), 2e-3, MIDPOINT);
    fixture_free(f);
}

/*
 * The period in which a body that spins about its middle axis turns over and back (Landau and Lifshitz, section 37):
 * 4 K(k) / n.
 */
static double turns_over(const double inertia[3], const double spin[3])
{
    double l2 = 0, energy2 = 0, low = inertia[2], middle = inertia[1], high = inertia[0], n, k;

    for (int i = 0; i < 3; i++) {
        l2 += inertia[i] * inertia[i] * spin[i] * spin[i];
        energy2 += inertia[i] * spin[i] * spin[i];
    }
    if (l2 < energy2 * middle) {
        low = inertia[0];
        high = inertia[2];
    }
    n = sqrt((high - middle) * (l2 - energy2 * low) / (low * middle * high));
    k = sqrt((middle - low) * (energy2 * high - l2) / ((high - middle) * (l2 - energy2 * low)));
    return 4 * physics_elliptic(k) / n;
}

static void dzhanibekov(double rate, double off)
{
    const double spin[3] = {0, rate, off * rate}, none[3] = {0};
    struct fixture *f = physics_begin("dzhanibekov", 0);
    struct physics_crossings c = {0};
    struct oracle_body now;
    char name[80];

    physics_gravity(f, 0, 0, 0);
    fixture_body(f, physics_box(f, 0.4, 0.7, 1), 0, 0, 0, fixture_upright);
    fixture_throw(f, 0, none, spin);
    physics_start(f, 0);
    for (int frame = 0; frame < 3600; frame++) {
        double local[3];

        now = physics_body(f, 0);
        physics_local(&now, now.spin, local);
        physics_cross(&c, local[1]);
        physics_step(f);
    }
    snprintf(name, sizeof name, "box about its middle axis, %.0f rad/s, %g off: turns over", rate,
             off);
    physics_row(name, "period 4 K(k) / n (Landau and Lifshitz, 37)", turns_over(now.inertia, spin),
                physics_period(&c), 1e-3, MIDPOINT);
    fixture_free(f);
}

/* A square box on a pivot below it, leaning so far, with a spin about its axis. Moves steadily if `round` is right. */
static void put_top(struct fixture *f, double lean, double d, double spin, double round)
{
    const double axis[3] = {sin(lean), 0, cos(lean)}, velocity[3] = {0, round * d * sin(lean), 0};
    const double turning[3] = {(spin - round * axis[2]) * axis[0], 0,
                               (spin - round * axis[2]) * axis[2] + round};

    fixture_body(f, physics_box(f, 0.8, 0.8, 0.1), d * axis[0], 0, d * axis[2],
                 lab_turn(0, 1, 0, lean));
    fixture_throw(f, 0, velocity, turning);
    physics_start(f, 0);
    physics_joint(f, CAROM_JOINT_BALL, 0, CAROM_WORLD, origin, along_y);
}

/* A heavy top in steady precession: I3 s W - (I1 + d^2) W^2 cos a = g d. */
static void top(double spin, double degrees)
{
    const double lean = degrees * REAL_PI / 180, d = 0.4;
    struct fixture *f = physics_begin("top", 0);
    struct physics_crossings c = {0};
    double most = 0, moment, along, round;
    char name[80];

    physics_box(f, 0.8, 0.8, 0.1);
    along = f->meshes[0].weight.inertia[2] * spin;
    moment = (f->meshes[0].weight.inertia[0] + d * d) * cos(lean);
    round = (along - sqrt(along * along - 4 * moment * PHYSICS_G * d)) / (2 * moment);
    put_top(f, lean, d, spin, round);
    for (int frame = 0; frame < 3600; frame++) {
        struct oracle_body now = physics_body(f, 0);

        most = fmax(most, fabs(acos(now.position[2] / d) - lean) / lean);
        physics_cross(&c, now.position[1]);
        physics_step(f);
    }
    snprintf(name, sizeof name, "top that leans %.0f degrees, %.0f rad/s: period of precession",
             degrees, spin);
    physics_row(name, "I3 s W - I1 W^2 cos a = m g d", 2 * REAL_PI / round, physics_period(&c),
                1e-3, MIDPOINT);
    snprintf(name, sizeof name, "top that leans %.0f degrees, %.0f rad/s: change of its lean",
             degrees, spin);
    physics_row(name, "0", 0, most, 1e-2, MIDPOINT);
    fixture_free(f);
}

/* Whether a top at so much of the least spin falls. */
static bool falls(double part)
{
    const double d = 0.4;
    struct fixture *f = physics_begin("sleeping top", 0);
    double most = 0, least;

    physics_box(f, 0.8, 0.8, 0.1);
    least = sqrt(4 * (f->meshes[0].weight.inertia[0] + d * d) * PHYSICS_G * d) /
            f->meshes[0].weight.inertia[2];
    put_top(f, 0.002, d, part * least, 0);
    for (int frame = 0; frame < 900; frame++) {
        struct oracle_body now = physics_body(f, 0);

        most = fmax(most, acos(fmin(1, now.position[2] / d)));
        physics_step(f);
    }
    fixture_free(f);
    return most > 0.1;
}

/*
 * A coin that rolls round on its lower edge while its middle stays where it is: the spin is along the line from the edge to
 * the middle, and the moment of the weight turns L. Without thickness the rate is W^2 = 4 g / (r sin a).
 */
struct coin {
    double r, t, across, along; /* radius, half the thickness, moments of inertia by the mass */
};

static double coin_rate(const struct coin *c, double a)
{
    return sqrt(PHYSICS_G * (c->r * cos(a) - c->t * sin(a)) /
                (sin(a) * (c->across * cos(a) - c->t / c->r * c->along * sin(a))));
}

/* The mesh's axis is y; it is to lean towards +x. Body 1. */
static struct coin put_coin(struct fixture *f, double a)
{
    struct coin c = {.r = 8, .t = 0.1};
    int mesh = physics_roller(f, c.r, 2 * c.t, 128);
    double rate, turning[3];
    const double none[3] = {0};

    c.across = f->meshes[mesh].weight.inertia[0];
    c.along = f->meshes[mesh].weight.inertia[1];
    rate = coin_rate(&c, a);
    turning[0] = -rate * sin(a) * (cos(a) - c.t / c.r * sin(a));
    turning[1] = 0;
    turning[2] = rate * sin(a) * (sin(a) + c.t / c.r * cos(a));
    fixture_body(f, mesh, 0, 0, c.r * sin(a) + c.t * cos(a) + fixture_skin(f, mesh) / 2,
                 fixture_compose(lab_turn(0, 1, 0, a), lab_turn(1, 0, 0, REAL_PI / 2)));
    fixture_weigh(f, 1, 1);
    fixture_throw(f, 1, none, turning);
    return c;
}

/* It leans more and more, since its rim has corners; at any time the rate is that of its lean. */
static void coin(double degrees)
{
    const double a = degrees * REAL_PI / 180;
    struct fixture *f = physics_begin("coin", 0.8);
    struct coin c;
    double angle = 0, first = 0, wanted = 0, lean = a;
    int frames;
    char name[80];

    fixture_plane(f);
    c = put_coin(f, a);
    physics_start(f, 0);
    frames = (int)(2 * REAL_PI / coin_rate(&c, a) * PHYSICS_FPS);
    for (int frame = 0; frame <= frames; frame++) {
        struct oracle_body now = physics_body(f, 1);
        double axis[3], at;

        physics_axis(&now, 1, axis);
        at = atan2(axis[1], axis[0]);
        angle = at + 2 * REAL_PI * round((angle - at) / (2 * REAL_PI));
        first = frame == 0 ? angle : first;
        lean = acos(fabs(axis[2]));
        wanted += frame > 0 ? coin_rate(&c, lean) / frames : 0;
        physics_step(f);
    }
    snprintf(name, sizeof name, "coin that rolls round, %.0f degrees at first: rate of its axis",
             degrees);
    physics_row(name, "W^2 = 4 g / (r sin a), and its thickness, at the leans found", wanted,
                fabs(angle - first) / (frames / PHYSICS_FPS), 3e-2, "its rim has 128 corners");
    snprintf(name, sizeof name, "coin that rolls round, %.0f degrees at first: after a round",
             degrees);
    physics_miss(name, "a, without losses", a, lean, 5e-2, 0.5,
                 "what resists rolling: see the balls and cylinders");
    fixture_free(f);
}

/*
 * A tippe top: a ball that is cut off above, with a stem. Its middle of mass is a below the ball's; it turns over if
 * 1 - a / r < I1 / I3 < 1 + a / r (Cohen 1977), until it spins on stem and rim. Jellett's L . (r up - a axis) stays, whatever
 * friction does, while it spins on the ball.
 */
#define TIPPE_R    0.5
#define TIPPE_STEM 0.3 /* polar angles: of the stem, of the rim */
#define TIPPE_RIM  1.3
#define TIPPE_TALL 1.5 /* of the radius */

static int make_tippe(struct fixture *f)
{
    double floor = TIPPE_R * cos(TIPPE_RIM);

    physics_ball(f, TIPPE_R, 4);
    for (uint32_t v = 0; v < f->shape.vertex_count; v++) {
        double *p = f->shape.p[v], polar = atan2(hypot(p[0], p[1]), p[2]);

        p[2] = polar < TIPPE_STEM ? TIPPE_R * TIPPE_TALL : polar < TIPPE_RIM ? floor : p[2];
    }
    return fixture_mesh(f);
}

/* Spins it; returns what is left of Jellett's number when its axis is level, and its mean lean in the end. */
static double spin_tippe(struct fixture *f, int mesh, double spin, double *lean)
{
    const double off = 0.1, turning[3] = {spin * sin(off), 0, spin * cos(off)}, none[3] = {0};
    const int frames = 1200, mean = 300;
    double a = -f->meshes[mesh].centre[2], first = 0, level = 0;

    fixture_body(f, mesh, 0, 0, TIPPE_R + 2 * fixture_skin(f, mesh), lab_turn(0, 1, 0, off));
    fixture_throw(f, 1, none, turning);
    physics_start(f, 0);
    *lean = 0;
    for (int frame = 0; frame < frames; frame++) {
        struct oracle_body now = physics_body(f, 1);
        double axis[3], l[3], jellett;

        physics_axis(&now, 2, axis);
        angular(&now, l);
        jellett = TIPPE_R * l[2] - a * real_dot(l, axis);
        first = frame == 0 ? jellett : first;
        level = level == 0 && axis[2] < 0 ? jellett / first : level;
        *lean += frame >= frames - mean ? acos(axis[2]) * 180 / REAL_PI / mean : 0;
        physics_step(f);
    }
    return level;
}

static void tippe(void)
{
    struct fixture *f = physics_begin("tippe", 0.3);
    double level, lean, part, ratio, rim, stands;
    int mesh;

    fixture_plane(f);
    mesh = make_tippe(f);
    part = -f->meshes[mesh].centre[2] / TIPPE_R;
    ratio = f->meshes[mesh].weight.inertia[0] / f->meshes[mesh].weight.inertia[2];
    level = spin_tippe(f, mesh, 40, &lean);
    /* rim and stem equally high: (tall - cos rim) cos lean = (sin stem - sin rim) sin lean */
    rim = TIPPE_TALL - cos(TIPPE_RIM);
    stands = atan2(rim, sin(TIPPE_STEM) - sin(TIPPE_RIM)) * 180 / REAL_PI;
    physics_row("tippe top: (I1 / I3 - 1) r / a, which lets it turn over",
                "from -1 to 1 (Cohen 1977)", 0, (ratio - 1) / part, 1, NULL);
    physics_row("tippe top: degrees by which it has turned over", "it spins on rim and stem",
                stands, lean, 0.1, "it goes round, with its weight a little back from there");
    physics_row("tippe top: Jellett's number when its axis is level, of that at first", "1", 1,
                level, 5e-2, "its ball has 5120 faces");
    fixture_free(f);
}

void physics_spin(void)
{
    wobble();
    dzhanibekov(5, 0.01);
    dzhanibekov(5, 0.2);
    dzhanibekov(15, 0.01);
    top(30, 20);
    top(30, 60);
    top(60, 40);
    physics_row("top that stands upright: the least spin", "s^2 = 4 I1 m g d / I3^2", 1,
                physics_threshold(falls, 0.8, 1.2, 8), 2e-2, "eight halvings, 15 s each");
    coin(30);
    coin(15);
    tippe();
}
