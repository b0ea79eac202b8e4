/* SPDX-License-Identifier: MIT */
/* Motions with a known outcome: stones that stand, rock and fall on each other. */
#include <math.h>
#include <stdio.h>

#include "physics.h"
#include "real.h"

/* ---------------------------------------------------------------------- arch */

#define STONES 13
#define RADIUS 5.0

/* Whether an arch so thick, a part of its radius, stands for eight seconds. */
static bool arch_stands(double part)
{
    struct fixture *f = physics_begin("arch", 2);
    bool stands = true;

    fixture_arch(f, STONES, RADIUS, part * RADIUS);
    physics_start(f, 0);
    for (int frame = 0; frame < 480 && stands; frame++) {
        physics_step(f);
        for (int i = 0; i < f->body_count && stands; i++) {
            double way = physics_body(f, i).position[2] - f->bodies[i].first.position[2];

            stands = fabs(way) < 0.05 * part * RADIUS;
        }
    }
    fixture_free(f);
    return stands;
}

/* Whether there is a line of thrust within it. */
static int stones;
static bool thrust_fits(double part)
{
    return fixture_arch_margin(stones, RADIUS, part * RADIUS) > 0;
}
static bool thrust_leaves(double part)
{
    return !thrust_fits(0.2 - part);
}

/* physics_threshold looks for where a test ceases to hold, so thickness counts down from 0.2. */
static void arch(void)
{
    double wanted, least = 0, falls = 0;

    stones = 101;
    physics_row("oracle of arches: least t / R of a half circle, 101 stones",
                "0.1075 (Milankovitch 1907; Heyman 0.106, Couplet 0.101)", 0.1075,
                0.2 - physics_threshold(thrust_leaves, 0.2 - 0.05, 0, 14), 1e-2,
                "a line of thrust in double precision; not the engine");
    stones = STONES;
    wanted = 0.2 - physics_threshold(thrust_leaves, 0.2 - 0.05, 0, 14);
    for (int i = 0; i <= 24; i++) {
        double part = wanted * (0.94 + i * 0.005);

        if (!arch_stands(part)) {
            falls = part;
        } else if (least == 0) {
            least = part;
        }
    }
    physics_row("arch of 13 stones: least t / R that stands", "line of thrust through 13 stones",
                wanted, least, 2e-2, "thickness goes up by 0.5 %");
    physics_row("arch of 13 stones: largest t / R that falls", "line of thrust through 13 stones",
                wanted, falls, 5e-2, "stones begin a skin apart, and it falls by that at first");
}

/* ------------------------------------------------------------------- rocking */

/* A block is let go from a lean on its edge, falls back, and leans the other way (Housner 1963). */
static void rock(double wide, double high, double part)
{
    const double alpha = atan(wide / high), lean = part * alpha, half = hypot(wide, high) / 2;
    struct fixture *f = physics_begin("rock", 2);
    double p2, ratio, other, most = 0, down = 0, before = 0;
    struct oracle_body now;
    int mesh;
    char name[80];

    fixture_plane(f);
    mesh = physics_box(f, wide, 2, high);
    /* on its edge at x = wide / 2: the middle is at half (-sin, cos) of alpha - lean from there */
    fixture_body(f, mesh, wide / 2 - half * sin(alpha - lean), 0,
                 half * cos(alpha - lean) + fixture_skin(f, mesh), lab_turn(0, 1, 0, lean));
    physics_start(f, 0);
    now = physics_body(f, 1);
    p2 = PHYSICS_G * half / (now.inertia[1] + half * half);
    for (int frame = 0; frame < 360; frame++) {
        double axis[3], angle;

        physics_step(f);
        now = physics_body(f, 1);
        physics_axis(&now, 2, axis);
        angle = atan2(axis[0], axis[2]);
        if (down == 0 && angle <= 0) {
            down = (frame + 1 - angle / (angle - before)) / PHYSICS_FPS;
        }
        before = angle;
        most = fmax(most, -angle);
    }
    snprintf(name, sizeof name, "block of %.1f x %.1f rocks: time to fall back", wide, high);
    physics_row(name, "acosh(1 / (1 - b / a)) / p (Housner 1963)", acosh(1 / (1 - part)) / sqrt(p2),
                down, 2e-2, "Housner's angles are small");
    ratio = 1 - half * half * (1 - cos(2 * alpha)) / (now.inertia[1] + half * half);
    other = 1 - sqrt(1 - ratio * ratio * (1 - (1 - part) * (1 - part)));
    snprintf(name, sizeof name, "block of %.1f x %.1f rocks: lean on the other side", wide, high);
    physics_miss(name, "1 - (1 - b' / a)^2 = r^2 (1 - (1 - b / a)^2), r = 1 - 3/2 sin^2 a",
                 other * alpha, most, 5e-2, 0.15,
                 "the edge that it turns about lifts a little in each frame, and falls back");
    fixture_free(f);
}

/* ------------------------------------------------------------------ dominoes */

#define TALL     4.0
#define THICK    0.6
#define GAP      1.2
#define PITCH    (THICK + GAP)
#define DOMINOES 24
#define LEANING  DOMINOES

/* A row that falls without friction between dominoes, each about its lower front edge, touching from the hit on. */
struct row {
    int count;              /* dominoes that lean; the foremost last */
    double w[DOMINOES + 1]; /* turn of each over that of the foremost */
};

/* Angles of all from that of the foremost, and what they weigh against: see physics_domino. */
static double pose(struct row *row, double front, double angle[])
{
    double height = 0;

    for (int i = row->count - 1; i >= 0; i--) {
        if (i == row->count - 1) {
            angle[i] = front;
            row->w[i] = 1;
        } else {
            /* TALL sin(a - b) = PITCH cos b - THICK, a behind b */
            double a = angle[i + 1], s = (PITCH * cos(a) - THICK) / TALL;

            angle[i] = a + asin(s);
            row->w[i] = row->w[i + 1] * (1 - PITCH * sin(a) / TALL / sqrt(1 - s * s));
        }
        height += PHYSICS_G / 2 * (TALL * cos(angle[i]) + THICK * sin(angle[i]));
    }
    return height;
}

static double turning(const struct row *row)
{
    double sum = 0;

    for (int i = 0; i < row->count; i++) {
        sum += row->w[i] * row->w[i];
    }
    return sum * (TALL * TALL + THICK * THICK) / 3;
}

/*
 * The speed of the wave, the mean from one domino to another (van Leeuwen 2010): energy stays between hits; a hit is plastic, its
 * impulses do no work along the motion that touching dominoes share.
 */
static double wave_speed(double rate, int from, int to)
{
    const double last = asin(GAP / TALL);
    const int parts = 4000;
    struct row row = {.count = 1};
    double time = 0, angle[DOMINOES + 1];

    for (; row.count <= to; row.count++) {
        double energy, before[DOMINOES + 1], momentum = 0, was;

        energy = pose(&row, 0, angle);
        energy += turning(&row) * rate * rate / 2;
        for (int n = 0; n < parts; n++) {
            double height = pose(&row, last * (n + 0.5) / parts, angle);
            double speed = sqrt(2 * (energy - height) / turning(&row));

            time += row.count > from ? last / parts / speed : 0;
        }
        was = sqrt(2 * (energy - pose(&row, last, angle)) / turning(&row));
        for (int i = 0; i < row.count; i++) {
            before[i] = row.w[i] * was;
        }
        row.count++;
        pose(&row, 0, angle);
        for (int i = 0; i < row.count - 1; i++) {
            momentum += row.w[i] * before[i];
        }
        rate = momentum * (TALL * TALL + THICK * THICK) / 3 / turning(&row);
        row.count--;
    }
    return (to - from) * PITCH / time;
}

/* Dominoes are smooth to each other and rough to the floor, which is body 0. */
static bool smooth(void *user, struct carom_touch *touch)
{
    (void)user;
    touch->friction_q16 = touch->a != 0 && touch->b != 0 ? 0 : CAROM_MU_MAX_Q16;
    return true;
}

static void dominoes(void)
{
    const double rate = 0.8, spin[3] = {0, rate, 0},
                 velocity[3] = {rate * TALL / 2, 0, rate * THICK / 2};
    const int from = 10, to = 20;
    struct fixture *f = physics_begin("dominoes", 4);
    double hit[DOMINOES + 1] = {0}, wanted = wave_speed(rate, from, to);
    int mesh;

    f->config.contact = smooth;
    fixture_plane(f);
    mesh = physics_box(f, THICK, 2, TALL);
    for (int i = 0; i < DOMINOES; i++) {
        fixture_body(f, mesh, i * PITCH - 22, 0, TALL / 2 + fixture_skin(f, mesh), fixture_upright);
    }
    fixture_throw(f, 1, velocity, spin);
    physics_start(f, 0);
    for (int frame = 1; frame < 600; frame++) {
        physics_step(f);
        for (int i = 1; i < DOMINOES; i++) {
            double speed = physics_hit(f, i, i + 1);

            hit[i] = hit[i] == 0 && speed > 0 ? frame / PHYSICS_FPS : hit[i];
        }
    }
    physics_row("dominoes, smooth to each other: speed of the wave",
                "van Leeuwen 2010, without friction", wanted,
                (to - from) * PITCH / (hit[to] - hit[from]), 3e-2, "hits are counted by frames");
    fixture_free(f);
}

void physics_stone(void)
{
    rock(0.4, 2, 0.5);
    rock(0.8, 2, 0.6);
    dominoes();
    arch();
}
